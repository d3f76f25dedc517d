// `evalcts explain`: describes a requirement, an ambiguous passage, a test or a verdict.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include <evalcts/cli/command.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/specified_run.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/results/coverage.h>
#include <evalcts/runner/worker.h>
#include "help.h"
#include "wrap.h"

namespace evalcts::cli {
namespace {

void paragraph(const std::string& text, std::size_t indent = 2) {
  const std::string margin(indent, ' ');
  std::cout << margin << wrapped(text, terminal_columns(), margin, indent) << "\n";
}

// Prints "  label: text", unless the text is empty.
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

// Prints a passage that is ambiguous or leaves something undefined, with its accepted readings and their
// effects on tests.
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

// The run of a test on the executable specification, where it passes.
struct TestRun {
  std::optional<CaseStarted> first;  // its first case that is not a control
  std::optional<TestRecord> record;
};

TestRun run_of(const std::string& test) {
  TestRun run;
  run_on_specification({test}, [&](const Event& event) {
    if (const auto* started = std::get_if<CaseStarted>(&event); started && !started->is_control)
      if (!run.first) run.first = *started;
    if (const auto* finished = std::get_if<TestFinished>(&event)) run.record = finished->record;
  });
  return run;
}

// Returns the queries among the calls, each once: "glGetError, glIsEnabled".
std::string queries_of(const std::vector<std::string>& calls) {
  std::vector<std::string> names;
  for (const std::string& call : calls)
    for (const char* const stem : {"glGet", "glIsEnabled", "glRenderMode"}) {
      if (!call.starts_with(stem)) continue;
      const std::string name = call.substr(0, call.find('('));
      if (std::ranges::count(names, name) == 0) names.push_back(name);
    }
  return fmt::format("{}", fmt::join(names, ", "));
}

void explain_cases(const TestRun& run) {
  if (!run.first || !run.record) return;
  const auto cases = run.record->cases.value_or(1);
  paragraph(fmt::format("{}, '{}':", cases == 1 ? "The only case" : fmt::format("First of {} cases", cases),
                        run.first->identity));
  for (const std::string& call : run.first->calls) std::cout << "    " << call << "\n";
  std::vector<std::string> compared;
  if (!run.record->capture.empty())
    compared.emplace_back(
        "the vertices and primitives that are drawn, with those of the executable specification");
  if (const std::string queries = queries_of(run.first->calls); !queries.empty())
    compared.push_back("the answers of " + queries + ", with the answers that the rules demand");
  labelled("Compared", fmt::format("{}", fmt::join(compared, "; ")));
}

void explain_test(const ListedTest& test) {
  std::cout << fmt::format("{} ({}, from depth {})\n", test.name, name_of(test.level), name_of(test.from));
  for (const RequirementId& id : test.requirements)
    if (const Requirement* const requirement = catalogue().find(id)) {
      paragraph(id.text() + ": " + requirement->text);
      paragraph("Source: " + requirement->source, 4);
    }
  explain_cases(run_of(test.name));
}

// Returns "; did you mean NAME?" for the name that is most similar to the word. For the name of a test
// function, returns the number of its tests and an example.
std::string suggestion_for(const std::string& word, const std::vector<ListedTest>& tests) {
  const auto is_meant = [&](const ListedTest& test) { return test.name.starts_with(word + "/"); };
  if (const auto first = std::ranges::find_if(tests, is_meant); first != tests.end())
    return fmt::format("; it has {} tests, such as {}", std::ranges::count_if(tests, is_meant), first->name);
  std::vector<std::string> names;
  for (const Requirement& requirement : catalogue().requirements) names.push_back(requirement.id);
  for (const Ambiguity* const entry : catalogue().interpretations()) names.push_back(entry->id);
  for (const ListedTest& test : tests) names.push_back(test.name);
  const std::string meant = nearest(word, names);
  return meant.empty() ? "; see 'evalcts list'" : "; did you mean " + meant + "?";
}

int explain(const std::string& name) {
  // For a half, "ID/1-D", the whole requirement is explained.
  if (const Requirement* const requirement = catalogue().find(name)) {
    explain_requirement(*requirement);
    return kNothingUnexpected;
  }
  if (const Ambiguity* const entry = catalogue().find_ambiguity(name)) {
    explain_ambiguity(*entry);
    return kNothingUnexpected;
  }
  const std::vector<ListedTest> tests = list_tests(places().suite_program);
  for (const ListedTest& test : tests)
    if (test.name == name) {
      explain_test(test);
      return kNothingUnexpected;
    }
  if (const std::optional<Verdict> verdict = verdict_named(name)) {
    std::cout << fmt::format("{}: {}\n", name, text_of(*verdict).meaning);
    return kNothingUnexpected;
  }
  return wrong_use(fmt::format("'{}' is not a requirement, interpretation, test or verdict{}", name,
                               suggestion_for(name, tests)));
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
