#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

#include "harness/cli/catalogue.h"
#include "harness/cli/commands.h"
#include "harness/implementations/implementation.h"
#include "harness/runner/child_process.h"
#include "harness/runner/runner.h"

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
  return !ending->signalled && ending->value == 0 ? "" : "it ended with " + describe(*ending);
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
                                 entry["available"].get<bool>() ? entry["what"].get<std::string>()
                                                                : entry["reason"].get<std::string>());
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

int coverage(bool as_json) {
  const json tests = list_tests(places().suite_program);
  const std::vector<Coverage> all = coverage_of(tests);
  const std::vector<std::string> problems = lint(tests);
  int decided = 0, in_part = 0;
  for (const Coverage& entry : all) {
    decided += entry.state == "decided";
    in_part += entry.state == "in part";
  }
  if (as_json) {
    json rows = json::array();
    for (const Coverage& entry : all)
      rows.push_back({{"id", entry.id}, {"state", entry.state}, {"tests", entry.tests}});
    std::cout << json{{"requirements", rows}, {"problems", problems}}.dump(1) << "\n";
  } else {
    for (const Coverage& entry : all)
      std::cout << fmt::format("{:<28} {:<10} {}\n", entry.id, entry.state,
                               entry.tests.empty()       ? ""
                               : entry.tests.size() == 1 ? entry.tests.front()
                                                         : fmt::format("{} and {} more", entry.tests.front(),
                                                                       entry.tests.size() - 1));
    std::cout << fmt::format(
        "\n{} requirements: {} decided, {} in part (one of the two dimensions), {} undecided; {} tests\n",
        all.size(), decided, in_part, static_cast<int>(all.size()) - decided - in_part,
        tests["tests"].size());
  }
  for (const std::string& problem : problems) std::cerr << "evalcts: " << problem << "\n";
  return problems.empty() ? kNothingUnexpected : kOwnFault;
}

int explain(const std::string& name) {
  for (const char* group : {"requirements", "contradictions", "undefined"})
    for (const json& entry : catalogue()[group]) {
      if (entry["id"] != name) continue;
      std::cout << name << "\n";
      for (const auto& [key, value] : entry.items()) {
        if (key == "id") continue;
        std::cout << fmt::format("  {}: {}\n", key,
                                 value.is_string() ? value.get<std::string>() : value.dump());
      }
      if (std::string(group) == "requirements") {
        for (const Coverage& covered : coverage_of(list_tests(places().suite_program)))
          if (covered.id == name) {
            std::cout << fmt::format("  {}\n", covered.state);
            for (const std::string& test : covered.tests) std::cout << fmt::format("    {}\n", test);
          }
      }
      return kNothingUnexpected;
    }
  const json tests = list_tests(places().suite_program);
  for (const json& test : tests["tests"]) {
    if (test["name"] != name) continue;
    std::cout << fmt::format("{} ({})\n", name, test["level"].get<std::string>());
    for (const std::string id : test["requirements"])
      for (const json& requirement : catalogue()["requirements"])
        if (requirement["id"] == id.substr(0, id.find('/')))
          std::cout << fmt::format("  {}: {}\n    source: {}\n", id, requirement["text"].get<std::string>(),
                                   requirement["source"].get<std::string>());
    return kNothingUnexpected;
  }
  const std::pair<const char*, const char*> verdicts[] = {
      {"pass", "every case of the test came out as the requirement demands"},
      {"fail", "at least one case contradicts citable text of the specification"},
      {"quality-warning", "conforming, but worse than good single precision; never a failure"},
      {"not-supported", "the version or extension that the rule belongs to is missing"},
      {"not-observable", "nothing that this implementation offers can show it; never a pass"},
      {"skipped", "left out on purpose, with a reason"},
      {"crash", "the process that ran the test ended by a signal or by itself"},
      {"timeout", "the test did not end within its time"},
      {"internal-error", "a fault of evalcts itself"}};
  for (const auto& [verdict, meaning] : verdicts)
    if (name == verdict) {
      std::cout << fmt::format("{}: {}\n", verdict, meaning);
      return kNothingUnexpected;
    }
  std::cerr << fmt::format("evalcts: '{}' is no requirement, test or verdict; see 'evalcts list'\n", name);
  return kWrongUse;
}

}  // namespace evalcts::cli
