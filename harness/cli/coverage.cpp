// `evalcts coverage`: prints the tests that decide each requirement, or the reason why no test can.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <map>

#include <evalcts/cli/command.h>
#include <evalcts/cli/places.h>
#include <evalcts/results/coverage.h>
#include <evalcts/runner/worker.h>
#include "wrap.h"

namespace evalcts::cli {
namespace {

using State = Coverage::State;
constexpr State kStates[] = {State::kDecided, State::kInPart, State::kUndecidable, State::kUndecided};

// Returns the counts of a section, "12 decided, 3 in part, 4 undecided".
std::string counted(const std::map<State, int>& counts) {
  std::vector<std::string> parts;
  for (const State state : kStates)
    if (counts.contains(state)) parts.push_back(fmt::format("{} {}", counts.at(state), name_of(state)));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string state_of(const Coverage& entry) {
  return entry.lacks.empty() ? name_of(entry.state) : fmt::format("in part, not {}", entry.lacks);
}

std::string tests_of(const Coverage& entry) {
  if (entry.tests.empty()) return {};
  if (entry.tests.size() == 1) return entry.tests.front();
  return fmt::format("{} and {} more", entry.tests.front(), entry.tests.size() - 1);
}

void show(const std::vector<Coverage>& all, std::size_t tests) {
  std::map<std::string, std::map<State, int>> sections;
  std::map<State, int> total;
  for (const Coverage& entry : all) {
    ++sections[entry.section][entry.state];
    ++total[entry.state];
  }
  const std::size_t columns = terminal_columns();
  std::string section;
  for (const Coverage& entry : all) {
    if (entry.section != section) {
      std::cout << fmt::format("{}{}: {}\n", section.empty() ? "" : "\n", entry.section,
                               counted(sections[entry.section]));
      section = entry.section;
    }
    std::string line = fmt::format("  {:<28} {:<16} {}", entry.id, state_of(entry), tests_of(entry));
    line.erase(line.find_last_not_of(' ') + 1);
    std::cout << line << "\n";
    if (!entry.reason.empty()) std::cout << "      " << wrapped(entry.reason, columns, "      ", 6) << "\n";
  }
  std::cout << fmt::format("\n{} requirements: {}; {} tests\n", all.size(), counted(total), tests);
}

int coverage(bool as_json, bool complete) {
  const std::vector<ListedTest> tests = list_tests(places().suite_program);
  const std::vector<Coverage> all = coverage_of(catalogue(), tests);
  const std::vector<std::string> problems = lint(catalogue(), tests);
  if (as_json)
    std::cout << to_text(all, problems);
  else
    show(all, tests.size());
  for (const std::string& problem : problems) std::cerr << "evalcts: " << problem << "\n";
  if (!problems.empty()) return kOwnFault;
  const auto is_open = [](const Coverage& entry) {
    return entry.state == State::kUndecided || (entry.state == State::kInPart && entry.reason.empty());
  };
  return complete && std::ranges::any_of(all, is_open) ? kUnexpected : kNothingUnexpected;
}

std::function<int()> define_coverage(CLI::App& app, const Call&) {
  struct Options {
    bool as_json = false, complete = false;
  };
  const auto options = std::make_shared<Options>();
  app.add_flag("--json", options->as_json, "print JSON");
  app.add_flag("--complete", options->complete,
               "exit code 1 if a requirement is neither decided by a test nor known to be undecidable");
  return [options] { return coverage(options->as_json, options->complete); };
}

}  // namespace

const Command kCoverageCommand = {"coverage",
                                  "show for each requirement the tests that decide it, or why no test can",
                                  R"(  $ evalcts coverage
  $ evalcts coverage --complete --json)",
                                  define_coverage};

}  // namespace evalcts::cli
