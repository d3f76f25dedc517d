// evalcts coverage and evalcts explain: the requirements in words, and what the tests decide of them.
#include <fmt/format.h>

#include <fmt/ranges.h>
#include <algorithm>

#include <iostream>
#include <map>

#include "harness/cli/commands.h"
#include "harness/cli/wrap.h"
#include "harness/results/coverage.h"
#include "harness/runner/question.h"

namespace evalcts::cli {
namespace {

// --- coverage ----------------------------------------------------------------------------------------------

using State = Coverage::State;
constexpr State kStates[] = {State::kDecided, State::kInPart, State::kUndecidable, State::kUndecided};

// "7. Evaluation commands: 12 decided, 3 in part, 4 undecided"
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

// --- explain -----------------------------------------------------------------------------------------------

void paragraph(const std::string& text, std::size_t indent = 2) {
  const std::string margin(indent, ' ');
  std::cout << margin << wrapped(text, terminal_columns(), margin, indent) << "\n";
}

// "  label: text", unless the text is empty.
void labelled(const std::string& label, const std::string& text) {
  if (!text.empty()) paragraph(label + ": " + text);
}

void explain_requirement(const Requirement& requirement) {
  std::cout << requirement.id << "\n";
  paragraph(requirement.text);
  labelled("Section", requirement.section);
  labelled("Source", requirement.source);
  labelled("Since", requirement.since);
  labelled("How it shows", requirement.observation);
  labelled("What it concerns", requirement.severity);
  labelled("Level", requirement.level);
  if (requirement.inferred)
    paragraph("Inferred: no single sentence says it; it follows from those that are named.");
  for (const Coverage& covered : coverage_of(catalogue(), list_tests(places().suite_program))) {
    if (covered.id != requirement.id) continue;
    std::string state = name_of(covered.state);
    if (!covered.lacks.empty()) state += fmt::format(": no test decides its {} half", covered.lacks);
    if (!covered.reason.empty()) state += ". " + covered.reason;
    paragraph("Tests: " + state);
    for (const std::string& test : covered.tests) std::cout << "    " << test << "\n";
  }
}

// A text that is ambiguous, or leaves something undefined, and what this suite makes of it.
void explain_ambiguity(const Ambiguity& entry) {
  const bool is_undefined = entry.kind == Ambiguity::Kind::kUndefined;
  std::cout << entry.id
            << (is_undefined ? ": undefined, or left to the implementation\n"
                             : ": an interpretation, since the documents do not agree\n");
  if (!is_undefined) labelled("The documents", entry.where);
  labelled("They disagree", entry.conflict);
  labelled("What changed between them", entry.change);
  labelled("The slip", entry.slip);
  labelled("Taken here", entry.take);
  labelled("Why", entry.why);
  labelled("When", entry.situation);
  labelled("A test may assert", entry.may_assert);
  labelled("A test must not assert", entry.must_not_assert);
  labelled("Section", entry.section);
  if (entry.readings.empty()) return;
  paragraph(
      "Readings that are accepted; 'evalcts run' records which one an implementation follows, and with "
      "--interpretation NAME=READING fails another:");
  for (const auto& [reading, meaning] : entry.readings)
    paragraph(fmt::format("{}={}: {}", entry.id, reading, meaning), 4);
}

void explain_test(const ListedTest& test) {
  std::cout << fmt::format("{} ({})\n", test.name, name_of(test.level));
  for (const std::string& id : test.requirements)
    if (const Requirement* const requirement = catalogue().find(id)) {
      paragraph(id + ": " + requirement->text);
      paragraph("Source: " + requirement->source, 4);
    }
}

}  // namespace

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

int explain(const std::string& name) {
  // A half, "ID/1-D", is explained with its requirement.
  if (const Requirement* const requirement = catalogue().find(name)) {
    explain_requirement(*requirement);
    return kNothingUnexpected;
  }
  if (const Ambiguity* const entry = catalogue().find_ambiguity(name)) {
    explain_ambiguity(*entry);
    return kNothingUnexpected;
  }
  for (const ListedTest& test : list_tests(places().suite_program))
    if (test.name == name) {
      explain_test(test);
      return kNothingUnexpected;
    }
  if (const std::optional<Verdict> verdict = verdict_named(name)) {
    std::cout << fmt::format("{}: {}\n", name, text_of(*verdict).meaning);
    return kNothingUnexpected;
  }
  std::cerr << fmt::format(
      "evalcts: '{}' is no requirement, interpretation, test or verdict; see 'evalcts list'\n", name);
  return kWrongUse;
}

}  // namespace evalcts::cli
