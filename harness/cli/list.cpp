#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

#include "harness/cli/commands.h"
#include "harness/implementations/implementation.h"
#include "harness/results/baseline.h"
#include "harness/results/json.h"
#include "harness/results/requirements.h"
#include "harness/results/serialization.h"
#include "harness/runner/question.h"

namespace evalcts::cli {
namespace {

using nlohmann::json;

void list_implementations(bool as_json) {
  json all = json::array();
  for (const ImplementationKind& kind : implementation_kinds()) {
    const std::string reason = why_not(kind.name);
    json entry = {
        {"name", kind.name}, {"what", kind.what}, {"available", reason.empty()}, {"package", kind.package}};
    if (!reason.empty()) entry["reason"] = reason;
    all.push_back(entry);
    if (!as_json)
      std::cout << fmt::format("{:<12} {:<14} {}\n", kind.name,
                               reason.empty() ? "available" : "not available",
                               reason.empty() ? kind.what : reason);
  }
  if (as_json) std::cout << json{{"implementations", all}}.dump(1) << "\n";
}

// The shipped baselines and overlays, each with its header and the number of its entries.
void list_baselines(bool as_json) {
  json all = json::array();
  for (const BaselineFiles& files : BaselineFiles::read_all(places().baselines)) {
    json header = json::object();
    for (const auto& [key, value] : files.header.fields()) header[key] = value;
    all.push_back({{"name", files.name}, {"header", header}, {"entries", files.entries.size()}});
    if (as_json) continue;
    std::vector<std::string> fields;
    for (const auto& [key, value] : files.header.fields())
      fields.push_back(fmt::format("{}: {}", key, value));
    std::cout << fmt::format("{:<20} {:>4} entries   {}\n", files.name, files.entries.size(),
                             fmt::join(fields, "; "));
  }
  if (as_json) std::cout << json{{"baselines", all}}.dump(1) << "\n";
}

}  // namespace

std::string why_not(const std::string& implementation) {
  std::string reason;
  return describe_implementation({places().suite_program.string(), "--implementation", implementation},
                                 reason)
             ? std::string()
             : reason;
}

std::vector<std::string> default_implementations() {
  std::vector<std::string> names;
  for (const ImplementationKind& kind : implementation_kinds()) {
    if (!kind.by_default) continue;
    names.push_back(kind.name);
    if (kind.name != "osmesa") continue;
    const std::string reason = why_not("osmesa");
    if (reason.empty()) continue;
    std::cout << fmt::format("osmesa does not start ({}): egl takes its place\n", reason);
    names.back() = "egl";
  }
  return names;
}

int list(const std::string& what, bool as_json) {
  const auto line = [](std::size_t width, const std::string& name, const std::string& text) {
    std::cout << fmt::format("{:<{}} {}\n", name, width, text);
  };
  if (what == "implementations") {
    list_implementations(as_json);
  } else if (what == "baselines") {
    list_baselines(as_json);
  } else if (what == "interpretations") {
    if (as_json)
      std::cout << interpretations_as_json() << "\n";
    else
      for (const Ambiguity* const entry : catalogue().interpretations())
        for (const auto& [reading, meaning] : entry->readings) line(36, entry->id + "=" + reading, meaning);
  } else if (what == "faults") {
    const std::vector<faults::ListedFault> all = list_faults();
    if (as_json)
      std::cout << faults::to_text(all);
    else
      for (const faults::ListedFault& fault : all) line(44, fault.name, fault.what);
  } else if (what == "requirements") {
    if (as_json)
      std::cout << catalogue_as_json() << "\n";
    else
      for (const Requirement& requirement : catalogue().requirements)
        line(28, requirement.id, requirement.text);
  } else {
    const std::vector<ListedTest> tests = list_tests(places().suite_program);
    if (as_json)
      std::cout << to_text(tests);
    else
      for (const ListedTest& test : tests)
        line(60, test.name, fmt::format("{}", fmt::join(test.requirements, " ")));
  }
  return kNothingUnexpected;
}

}  // namespace evalcts::cli
