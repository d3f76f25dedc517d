// `evalcts list`: prints the implementations, requirements, interpretations, tests, faults or known bugs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include <evalcts/backends/implementation.h>
#include <evalcts/cli/command.h>
#include <evalcts/cli/default_implementations.h>
#include <evalcts/cli/places.h>
#include <evalcts/faults/trial.h>
#include <evalcts/results/filter.h>
#include <evalcts/results/json.h>
#include <evalcts/results/known_bugs.h>
#include <evalcts/results/requirements.h>
#include <evalcts/results/serialization.h>
#include <evalcts/runner/worker.h>
#include "help.h"

namespace evalcts::cli {
namespace {

using nlohmann::json;

const std::vector<std::string> kLists = {"implementations", "requirements", "interpretations",
                                         "tests",           "faults",       "bugs"};

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

// Prints the known bugs, each with the versions that have it.
void list_bugs(bool as_json) {
  json all = json::array();
  for (const KnownBug& bug : known_bugs()) {
    json tests = json::array();
    for (const FailingTests& failing : bug.tests)
      for (const std::string& pattern : failing.tests) tests.push_back(pattern);
    all.push_back({{"id", bug.id},
                   {"title", bug.title},
                   {"affects", bug.affects.text()},
                   {"requirements", texts_of(bug.requirements)},
                   {"tests", tests}});
    if (!as_json) std::cout << fmt::format("{:<32} {}: {}\n", bug.id, bug.affects.text(), bug.title);
  }
  if (as_json) std::cout << json{{"bugs", all}}.dump(1) << "\n";
}

int list(const std::string& what, bool as_json, const std::string& filter) {
  const auto line = [](std::size_t width, const std::string& name, const std::string& text) {
    std::cout << fmt::format("{:<{}} {}\n", name, width, text);
  };
  if (what == "implementations") {
    list_implementations(as_json);
  } else if (what == "bugs") {
    list_bugs(as_json);
  } else if (what == "interpretations") {
    if (as_json)
      std::cout << interpretations_as_json() << "\n";
    else
      for (const Ambiguity* const entry : catalogue().interpretations())
        for (const auto& [reading, meaning] : entry->readings) line(36, entry->id + "=" + reading, meaning);
  } else if (what == "faults") {
    const std::vector<faults::ListedChange> all = faults::list_faults(places().faulty_suite_program);
    if (as_json)
      std::cout << faults::to_text(all);
    else
      for (const faults::ListedChange& fault : all) line(44, fault.name, fault.what);
  } else if (what == "requirements") {
    if (as_json)
      std::cout << catalogue_as_json() << "\n";
    else
      for (const Requirement& requirement : catalogue().requirements)
        line(28, requirement.id, requirement.text);
  } else {
    const std::vector<ListedTest> tests = matching(list_tests(places().suite_program), filter);
    if (tests.empty()) return wrong_use(fmt::format("no test matches '{}'", filter));
    if (as_json)
      std::cout << to_text(tests);
    else
      for (const ListedTest& test : tests)
        line(60, test.name, fmt::format("{}", fmt::join(texts_of(test.requirements), " ")));
  }
  return kNothingUnexpected;
}

std::function<int()> define_list(CLI::App& app, const Call&) {
  struct Options {
    std::string what;
    bool as_json = false;
    std::string filter;  // of tests
  };
  const auto options = std::make_shared<Options>();
  app.add_option("what", options->what)
      ->required()
      ->check(CLI::Validator(
          [](const std::string& what) {
            if (std::ranges::count(kLists, what) > 0) return std::string();
            const std::string meant = nearest(what, kLists);
            return fmt::format("'{}' is none of {}{}", what, fmt::join(kLists, ", "),
                               meant.empty() ? "" : "; did you mean " + meant + "?");
          },
          fmt::format("{{{}}}", fmt::join(kLists, ","))));
  app.add_flag("--json", options->as_json, "print JSON");
  app.add_option("--filter", options->filter,
                 "with tests: only those that match GoogleTest patterns, such as 'Map1*:-*Copy*'");
  return [options] {
    if (!options->filter.empty() && options->what != "tests")
      return wrong_use("--filter selects tests: evalcts list tests --filter ...");
    return list(options->what, options->as_json, options->filter);
  };
}

}  // namespace

const Command kListCommand = {
    "list", "list implementations, requirements, interpretations, tests, faults or known bugs",
    R"(  $ evalcts list implementations
  $ evalcts list tests --filter 'Map1Errors.*'
  $ evalcts list tests --json)",
    define_list};

}  // namespace evalcts::cli
