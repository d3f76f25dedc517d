// `evalcts explain`: describes a requirement, an ambiguous passage, a known bug, a test or a verdict, or
// searches for words.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <iostream>
#include <sstream>

#include <evalcts/cli/command.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/specified_run.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/results/coverage.h>
#include <evalcts/results/documents.h>
#include <evalcts/results/known_bugs.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/worker.h>
#include "help.h"
#include "issue.h"
#include "result_files.h"
#include "run_folders.h"
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

void print_documents(const std::string& source) {
  for (const Document& document : documents_in(source))
    std::cout << fmt::format("    {}: {}\n", document.name, document.address);
}

void explain_requirement(const Requirement& requirement) {
  std::cout << requirement.id << "\n";
  paragraph(requirement.text);
  labelled("Quotation", text_of(requirement.quote));
  labelled("Section", requirement.section);
  labelled("Source", requirement.source);
  print_documents(requirement.source + "; " + requirement.quote.source);
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
  for (const KnownBug& bug : known_bugs())
    if (std::ranges::any_of(bug.requirements,
                            [&](const RequirementId& id) { return id.id == requirement.id; }))
      paragraph(fmt::format("Broken in {}: {} ({})", bug.affects.text(), bug.title, bug.id));
}

void explain_bug(const KnownBug& bug) {
  std::cout << fmt::format("{}: a known bug of {}\n", bug.id, bug.affects.text());
  paragraph(bug.title);
  labelled("Violates", fmt::format("{}", fmt::join(texts_of(bug.requirements), ", ")));
  labelled("Tested", bug.affects.tested_text());
  labelled("Clause", bug.clause);
  const Quote quote = bug.quoted_rule();
  labelled("Quotation", text_of(quote));
  print_documents(bug.clause + "; " + quote.source);
  const std::vector<std::string> program = program_of(bug);
  if (!program.empty()) paragraph("Program:");
  for (const std::string& line : program) std::cout << "    " << line << "\n";
  labelled("Expected", bug.expected);
  labelled("Instead", bug.captured);
  labelled(bug.suspected ? "Suspected cause" : "Cause", bug.cause);
  labelled("Real programs", bug.real_programs);
  labelled("Verified", bug.verified);
  paragraph(fmt::format("'evalcts check {}' says whether a library has it.", bug.id));
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
  std::cout << fmt::format("{} ({}, from depth {}): {}\n", test.name, name_of(test.level), name_of(test.from),
                           test.source);
  for (const RequirementId& id : test.requirements)
    if (const Requirement* const requirement = catalogue().find(id)) {
      paragraph(id.text() + ": " + requirement->text);
      paragraph("Source: " + requirement->source, 4);
    }
  explain_cases(run_of(test.name));
}

// Returns "; did you mean NAME?" for the name that is most similar to the word.
std::string suggestion_for(const std::string& word, const std::vector<ListedTest>& tests) {
  std::vector<std::string> names;
  for (const Requirement& requirement : catalogue().requirements) names.push_back(requirement.id);
  for (const Ambiguity* const entry : catalogue().interpretations()) names.push_back(entry->id);
  for (const KnownBug& bug : known_bugs()) names.push_back(bug.id);
  for (const ListedTest& test : tests) names.push_back(test.name);
  const std::string meant = nearest(word, names);
  return meant.empty() ? "; see 'evalcts list'" : "; did you mean " + meant + "?";
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Returns the words in lower case, without the prefixes of commands and tokens, which requirements do not
// use.
std::vector<std::string> search_words(const std::vector<std::string>& typed) {
  std::vector<std::string> words;
  for (std::string each : typed) {
    if (each.starts_with("EV-")) {
      each.erase(0, 3);
      std::ranges::replace(each, '-', ' ');
    }
    std::istringstream stream(each);
    for (std::string word; stream >> word;) {
      if (word.starts_with("GL_"))
        word.erase(0, 3);
      else if (word.starts_with("gl") && word.size() > 2 && std::isupper(static_cast<unsigned char>(word[2])))
        word.erase(0, 2);
      words.push_back(lower(word));
    }
  }
  return words;
}

// True if each of the words begins in the text at the beginning of a word, or behind the u or v of "uorder".
bool has_all(const std::string& text, const std::vector<std::string>& words) {
  const std::string in_lower_case = lower(text);
  const auto is_beginning = [&](std::size_t at) {
    return at == 0 || std::isalnum(static_cast<unsigned char>(in_lower_case[at - 1])) == 0;
  };
  const auto is_behind_direction = [&](std::size_t at) {
    return at > 0 && (in_lower_case[at - 1] == 'u' || in_lower_case[at - 1] == 'v') && is_beginning(at - 1);
  };
  return std::ranges::all_of(words, [&](const std::string& word) {
    std::size_t at = in_lower_case.find(word);
    while (at != std::string::npos && !is_beginning(at) && !is_behind_direction(at))
      at = in_lower_case.find(word, at + 1);
    return at != std::string::npos;
  });
}

// Prints what the words occur in. Returns false if there is nothing.
bool search(const std::vector<std::string>& words, const std::vector<ListedTest>& tests) {
  constexpr std::size_t kMostTopics = 30;
  std::vector<const Requirement*> found;
  // Requirements with the words in their ID or rule come first.
  for (const bool in_the_rule : {true, false})
    for (const Requirement& each : catalogue().requirements) {
      const std::string rule = each.id + " " + each.text;
      const bool is_in_rule = has_all(rule, words);
      if (is_in_rule == in_the_rule &&
          (is_in_rule ||
           has_all(fmt::format("{} {} {} {}", rule, each.section, each.source, each.observation), words)))
        found.push_back(&each);
    }
  std::vector<const KnownBug*> bugs;
  for (const KnownBug& bug : known_bugs())
    if (has_all(fmt::format("{} {} {} {}", bug.id, bug.title, bug.cause, bug.affects.text()), words))
      bugs.push_back(&bug);
  std::vector<std::string> functions;  // test functions with the number of their tests
  for (auto test = tests.begin(); test != tests.end();) {
    const std::string function = test->name.substr(0, test->name.find('/'));
    const auto begin = test;
    std::size_t matching_tests = 0;
    for (; test != tests.end() && test->name.substr(0, test->name.find('/')) == function; ++test)
      matching_tests += has_all(test->name, words);
    if (matching_tests == 1)
      functions.push_back(
          std::find_if(begin, test, [&](const ListedTest& each) { return has_all(each.name, words); })->name);
    if (matching_tests > 1)
      functions.push_back(fmt::format("{}: {} tests, such as {}", function, matching_tests,
                                      std::find_if(begin, test, [&](const ListedTest& each) {
                                        return has_all(each.name, words);
                                      })->name));
  }
  if (found.size() == 1 && bugs.empty()) {
    explain_requirement(*found.front());
    return true;
  }
  const auto list = [&](const char* heading, const auto& all, const auto& line_of) {
    if (all.empty()) return;
    std::cout << fmt::format("{} ({}):\n", heading, all.size());
    for (std::size_t i = 0; i < std::min(all.size(), kMostTopics); ++i) paragraph(line_of(all[i]));
    if (all.size() > kMostTopics)
      paragraph(fmt::format("and {} more; another word makes them fewer", all.size() - kMostTopics));
  };
  list("Requirements", found, [](const Requirement* each) {
    return fmt::format("{}: {} [{}]", each->id, each->text, each->source);
  });
  list("Known bugs", bugs, [](const KnownBug* bug) {
    return fmt::format("{}: {} [{}]", bug->id, bug->title, bug->affects.text());
  });
  list("Tests", functions, [](const std::string& function) { return function; });
  return !found.empty() || !bugs.empty() || !functions.empty();
}

// Returns the requirement in the ID of a bug of a run, "EV-COORD-CURRENT-a6d4"; null if it is none.
const Requirement* requirement_of_bug(const std::string& id) {
  const std::size_t dash = id.rfind('-');
  const bool has_hash = dash != std::string::npos && id.size() == dash + 5 &&
                        id.find_first_not_of("0123456789abcdef", dash + 1) == std::string::npos;
  return has_hash ? catalogue().find(id.substr(0, dash)) : nullptr;
}

// Prints a bug of the run with this ID. Returns false if there is none, or no run.
bool explain_bug_of_run(const std::string& id, const std::string& run) {
  try {
    for (const RunResult& result : read_results({run_folder(run).string()}, false))
      for (const Bug& bug : result.bugs)
        if (bug.id == id) {
          paragraph(fmt::format("{}: a bug of {} in {}", id, result.heading("(unnamed)"),
                                run.empty() ? "the last run" : run),
                    0);
          paragraph(bug.title);
          if (!bug.known.empty()) paragraph(fmt::format("Known bug: {}, in {}", bug.known, bug.known_in));
          paragraph(
              fmt::format("{} failing tests; 'evalcts bugs' shows the minimal program", bug.tests.size()));
          return true;
        }
  } catch (const CannotReadResults&) {
    if (!run.empty()) throw;
  }
  return false;
}

int explain(const std::vector<std::string>& words, const std::string& run) {
  const std::string name = fmt::format("{}", fmt::join(words, " "));
  // For a half, "ID/1-D", the whole requirement is explained.
  if (const Requirement* const requirement = catalogue().find(name)) {
    explain_requirement(*requirement);
    return kNothingUnexpected;
  }
  if (const Ambiguity* const entry = catalogue().find_ambiguity(name)) {
    explain_ambiguity(*entry);
    return kNothingUnexpected;
  }
  if (const KnownBug* const bug = find_known_bug(name)) {
    explain_bug(*bug);
    return kNothingUnexpected;
  }
  if (const Requirement* const requirement = requirement_of_bug(name)) {
    if (!explain_bug_of_run(name, run))
      paragraph(fmt::format("{} is a bug of a run, but not of {}. It violates:", name,
                            run.empty() ? "the last one" : run),
                0);
    explain_requirement(*requirement);
    return kNothingUnexpected;
  }
  const std::vector<ListedTest> tests = list_tests(places().suite_program);
  for (const ListedTest& test : tests)
    if (test.name == name) {
      explain_test(test);
      return kNothingUnexpected;
    }
  for (std::size_t i = 0; i < kVerdicts; ++i) {
    const VerdictText& verdict = text_of(static_cast<Verdict>(i));
    if (name != verdict.word && name != verdict.label) continue;
    std::cout << fmt::format("{}: {}\n", verdict.label, verdict.meaning);
    return kNothingUnexpected;
  }
  if (search(search_words(words), tests)) return kNothingUnexpected;
  return wrong_use(fmt::format("nothing is called '{}' or contains it{}", name, suggestion_for(name, tests)));
}

std::function<int()> define_explain(CLI::App& app, const Call&) {
  const auto words = std::make_shared<std::vector<std::string>>();
  const auto run = std::make_shared<std::string>();
  app.add_option("name", *words,
                 "ID of a requirement, known bug or bug of a run, name of an interpretation, test or "
                 "verdict, or words "
                 "to search for, such as a GL command or token")
      ->required();
  add_run(app, *run);
  return [words, run] { return explain(*words, *run); };
}

}  // namespace

const Command kExplainCommand = {
    "explain",
    "explain a requirement, interpretation, bug, test or verdict, or find those about a command or word",
    R"(  $ evalcts explain EV-MAP1-COPY
  $ evalcts explain Map1State.CopyOnCall/UNMAPPED
  $ evalcts explain mesa-point-end
  $ evalcts explain glMap2 stride
  $ evalcts explain not-observable)",
    define_explain};

}  // namespace evalcts::cli
