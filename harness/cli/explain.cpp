// evalcts explain: a requirement, an ambiguous text, a test or a verdict in words.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <map>

#include <evalcts/results/coverage.h>
#include <evalcts/runner/question.h>
#include "command.h"
#include "places.h"
#include "wrap.h"

namespace evalcts::cli {
namespace {

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
  for (const RequirementId& id : test.requirements)
    if (const Requirement* const requirement = catalogue().find(id)) {
      paragraph(id.text() + ": " + requirement->text);
      paragraph("Source: " + requirement->source, 4);
    }
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
  return wrong_use(
      fmt::format("'{}' is not a requirement, interpretation, test or verdict; see 'evalcts list'", name));
}

std::function<int()> define_explain(CLI::App& app, const Call&) {
  const auto name = std::make_shared<std::string>();
  app.add_option("name", *name, "ID of a requirement, or name of an interpretation, test or verdict")
      ->required();
  return [name] { return explain(*name); };
}

}  // namespace

const Command kExplainCommand = {"explain", "explain a requirement, interpretation, test or verdict",
                                 R"(  $ evalcts explain EV-MAP1-COPY
  $ evalcts explain Map1State.CopyOnCall/UNMAPPED
  $ evalcts explain not-observable)",
                                 define_explain};

}  // namespace evalcts::cli
