#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

#include "harness/cli/catalogue.h"
#include "harness/cli/commands.h"
#include "harness/implementations/gl_environment.h"
#include "harness/implementations/implementation.h"
#include "harness/runner/baseline.h"
#include "harness/runner/child_process.h"
#include "harness/runner/runner.h"
#include "reports/text.h"

namespace evalcts::cli {
namespace {

using nlohmann::json;

json implementations() {
  json all = json::array();
  for (const ImplementationKind& kind : implementation_kinds()) {
    const std::string reason = why_not(kind.name);
    json entry = {
        {"name", kind.name}, {"what", kind.what}, {"available", reason.empty()}, {"package", kind.package}};
    if (!reason.empty()) entry["reason"] = reason;
    all.push_back(entry);
  }
  return all;
}

}  // namespace

std::string why_not(const std::string& implementation) {
  char name[] = "/tmp/evalcts-answer-XXXXXX";
  const int descriptor = mkstemp(name);
  if (descriptor < 0) throw std::runtime_error("cannot make a temporary file");
  close(descriptor);
  ChildProcess child(
      {places().suite_program.string(), "--implementation", implementation, "--describe", "--answer", name},
      "");
  const auto ending = child.wait(30);
  std::ifstream stream(name);
  const json answer = json::parse(stream, nullptr, false);
  std::filesystem::remove(name);
  if (answer.is_object() && answer.contains("cannot_start")) return answer["cannot_start"];
  if (!ending) return "it does not answer within 30 seconds";
  if (!ending->signalled && ending->value == 0) return {};
  return fmt::format("the process that loads the library ended with {}{}", describe(*ending),
                     describe_gl_environment());
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

std::vector<std::string> default_implementations() {
  std::vector<std::string> names;
  for (const ImplementationKind& kind : implementation_kinds()) {
    if (!kind.by_default) continue;
    names.push_back(kind.name);
    if (kind.name != "osmesa") continue;
    const std::string reason = why_not("osmesa");
    if (reason.empty()) continue;
    std::cout << fmt::format("osmesa does not start ({}): egl takes its place\n", reports::clean(reason));
    names.back() = "egl";
  }
  return names;
}

int list(const std::string& what, bool as_json) {
  if (what == "implementations") {
    const json all = implementations();
    if (as_json) {
      std::cout << json{{"implementations", all}}.dump(1) << "\n";
    } else {
      for (const json& entry : all)
        std::cout << fmt::format("{:<12} {:<14} {}\n", entry["name"].get<std::string>(),
                                 entry["available"].get<bool>() ? "available" : "not available",
                                 entry["available"].get<bool>()
                                     ? entry["what"].get<std::string>()
                                     : reports::clean(entry["reason"].get<std::string>()));
    }
  } else if (what == "interpretations") {
    if (as_json) {
      std::cout << json{{"interpretations", interpretations()}}.dump(1) << "\n";
    } else {
      for (const json& entry : interpretations())
        for (const auto& [reading, meaning] : entry["readings"].items())
          std::cout << fmt::format("{:<36} {}\n", entry["id"].get<std::string>() + "=" + reading,
                                   meaning.get<std::string>());
    }
  } else if (what == "baselines") {
    list_baselines(as_json);
  } else if (what == "faults") {
    const json all = list_faults();
    if (as_json) {
      std::cout << all.dump(1) << "\n";
    } else {
      for (const json& fault : all["faults"])
        std::cout << fmt::format("{:<44} {}\n", fault["name"].get<std::string>(),
                                 fault["what"].get<std::string>());
    }
  } else if (what == "requirements") {
    if (as_json) {
      std::cout << catalogue().dump(1) << "\n";
    } else {
      for (const json& requirement : catalogue()["requirements"])
        std::cout << fmt::format("{:<28} {}\n", requirement["id"].get<std::string>(),
                                 requirement["text"].get<std::string>());
    }
  } else {
    const json tests = list_tests(places().suite_program);
    if (as_json) {
      std::cout << tests.dump(1) << "\n";
    } else {
      for (const json& test : tests["tests"])
        std::cout << fmt::format("{:<60} {}\n", test["name"].get<std::string>(),
                                 fmt::join(test["requirements"].get<std::vector<std::string>>(), " "));
    }
  }
  return kNothingUnexpected;
}

}  // namespace evalcts::cli
