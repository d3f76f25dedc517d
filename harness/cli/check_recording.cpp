// `evalcts check` of a recording: each of its programs is a test, which workers judge as those of the suite.
#include "check_recording.h"

#include <evalcts/reports.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

#include <evalcts/cli/command.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/results/conclusion.h>
#include <evalcts/results/requirements.h>
#include <evalcts/results/serialization.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/child_process.h>
#include <evalcts/runner/runner.h>
#include <evalcts/runner/worker.h>
#include "distinct_bugs.h"
#include "pages.h"
#include "run_folders.h"
#include "wrap.h"

namespace evalcts::cli {
namespace {

namespace fs = std::filesystem;
using record::Program;

constexpr double kBugSeconds = 60;       // time limit for the reduction of failing programs
constexpr std::size_t kMostListed = 10;  // failing programs, and commands that were only counted

// Returns the lines as they are printed: on a terminal, long ones are wrapped.
std::string printed(const std::string& lines) {
  if (screen_of(STDOUT_FILENO).columns == 0) return clean(lines);
  std::string text;
  std::istringstream rest(clean(lines));
  for (std::string line; std::getline(rest, line);) {
    const std::size_t indent = line.find_first_not_of(' ');
    text +=
        std::string(indent, ' ') + wrapped(line.substr(indent), terminal_columns(), "    ", indent) + "\n";
  }
  return text;
}

std::string list_of(const std::vector<record::Counted>& commands) {
  std::vector<std::string> texts;
  for (const record::Counted& command : commands) {
    if (texts.size() == kMostListed) {
      texts.push_back(fmt::format("{} more", commands.size() - kMostListed));
      break;
    }
    texts.push_back(fmt::format("{} ({})", command.name, command.times));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

// Returns what the recording is, and what of it cannot be judged.
std::string describe(const record::Recording& recording, const std::vector<Program>& programs) {
  std::uint64_t all = 0, vertices = 0;
  for (const Program& program : programs) {
    all += program.times;
    vertices += program.times * program.vertices;
  }
  std::string text =
      fmt::format("{}: {} in {}, {} of them different; vertices: {}\n", fmt::join(recording.program(), " "),
                  count(all, "program"), count(recording.contexts(), "context"), programs.size(), vertices);
  if (!recording.problem().empty()) text += fmt::format("note: {}\n", recording.problem());
  if (!recording.left_out().empty())
    text += fmt::format(
        "note: these commands are left out, because this evalcts does not know them or they read "
        "memory of an unknown size: {}\n",
        list_of(recording.left_out()));
  return text;
}

// Finds the bugs behind the failing programs. A frame may show several: each kind and place of its
// differences is reduced, as if it were a test of its own.
void find_bugs(RunResult& result, const RunRequest& request, ProgressLine& line) {
  constexpr char kNumber = '#';  // behind the name of the test, for its further differences
  const std::size_t count = result.tests.size();
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<Failure> others;
    const auto is_new = [&](const Failure& failure) {
      const auto is_same = [&](const Failure& other) {
        return other.difference.kind == failure.difference.kind &&
               other.difference.place == failure.difference.place;
      };
      return !is_same(result.tests[i].failures.front()) && std::ranges::none_of(others, is_same);
    };
    for (const Failure& failure : result.tests[i].failures)
      if (is_new(failure)) others.push_back(failure);
    for (std::size_t k = 0; k < others.size(); ++k) {
      TestRecord other = result.tests[i];
      other.name += kNumber + std::to_string(k + 2);
      other.failures = {others[k]};
      if (const auto commands = result.failing_cases.find(result.tests[i].name);
          commands != result.failing_cases.end())
        result.failing_cases[other.name] = commands->second;
      result.tests.push_back(std::move(other));
    }
  }
  find_distinct_bugs(result, request, kBugSeconds, line);
  result.tests.resize(count);
  result.summarize();
  for (Bug& bug : result.bugs) {
    for (std::string& test : bug.tests) test.resize(std::min(test.find(kNumber), test.size()));
    bug.tests.erase(std::unique(bug.tests.begin(), bug.tests.end()), bug.tests.end());
  }
}

// The vertices of a test that differ.
std::set<std::string> wrong_vertices(const TestRecord& test) {
  constexpr std::string_view kVertex = " of vertex ";
  std::set<std::string> vertices;
  for (const std::string& mismatch : test.mismatches)
    if (const std::size_t at = mismatch.rfind(kVertex); at != std::string::npos)
      vertices.insert(mismatch.substr(at + kVertex.size()));
  return vertices;
}

// Returns the line of a failing program.
std::string line_of(const TestRecord& test, const Program& program, const RunResult& result) {
  std::string what;
  if (const auto wrong = wrong_vertices(test); !wrong.empty())
    what = fmt::format("{}{} of {} vertices: ", test.signature_of_all.empty() ? "" : "at least ",
                       wrong.size(), program.vertices);
  std::vector<std::string> bugs;
  for (const Bug& bug : result.bugs)
    if (std::ranges::binary_search(bug.tests, test.name))
      bugs.push_back(bug.known.empty() ? bug.id : "known: " + bug.known);
  const std::string times = program.times > 1 ? fmt::format(", {} times", program.times) : "";
  return fmt::format("  {}{}: {}{}{}\n", program.name, times, what, test.message,
                     bugs.empty() ? "" : fmt::format(" ({})", fmt::join(bugs, ", ")));
}

// Returns what was found on one implementation.
std::string summary(const RunResult& result, const std::map<std::string, const Program*>& programs) {
  const ImplementationRecord& implementation = result.implementation;
  if (!result.has_started()) return fmt::format("{}: {}\n", implementation.name, result.reason);
  std::uint64_t passed = 0, wrong = 0;
  Accuracy accuracy;
  std::map<std::string, std::uint64_t> unobserved, incomplete;
  std::string lines;
  std::size_t listed = 0;
  for (const TestRecord& test : result.tests) {
    const Program& program = *programs.at(test.name);
    if (test.verdict == Verdict::kPass) {
      if (test.accuracy) accuracy.add(*test.accuracy);
      passed += program.times;
      if (!test.unobserved.empty()) incomplete[test.unobserved] += program.times;
    } else if (is_failure(test.verdict)) {
      wrong += program.times;
      if (++listed <= kMostListed) lines += line_of(test, program, result);
    } else {
      unobserved[test.message] += program.times;
    }
  }
  std::string text =
      fmt::format("{}: {} ({}): {} wrong, {} right\n", implementation.name, implementation.version,
                  implementation.renderer, count(wrong, "program"), passed);
  text += lines;
  if (listed > kMostListed) text += fmt::format("  and {} more\n", listed - kMostListed);
  for (const auto& [what, times] : incomplete)
    text += fmt::format("  {} of the right ones without: {}\n", times, what);
  for (const auto& [why, times] : unobserved)
    text += fmt::format("  {} not observed: {}\n", count(times, "program"), why);
  if (accuracy.values > 0)
    text += accuracy.not_correctly_rounded == 0
                ? fmt::format("  right ones: {} evaluated values, correctly rounded\n", accuracy.values)
                : fmt::format(
                      "  right ones: {} evaluated values, off by at most {:.1g} relative to their terms\n",
                      accuracy.values, std::ldexp(accuracy.condition_aware.error, -24));
  return text;
}

// Returns kGood only if all programs ran and most of them were observed.
CheckOutcome outcome_of(const RunResult& result) {
  const Conclusion conclusion = conclusion_of(result);
  if (std::ranges::any_of(result.tests, [](const TestRecord& test) { return is_failure(test.verdict); }))
    return CheckOutcome::kBad;
  if (!result.is_complete() || conclusion.internal_errors > 0) return CheckOutcome::kCannotBeJudged;
  if (!is_mostly_unobserved(conclusion.observed, result.tests.size())) return CheckOutcome::kGood;
  std::cerr << fmt::format(
      "evalcts: {}: only {} of {} different programs could be observed, which decides nothing\n",
      result.implementation.name, conclusion.observed, result.tests.size());
  return CheckOutcome::kCannotBeJudged;
}

// Returns the outcome for two implementations.
CheckOutcome worse(CheckOutcome a, CheckOutcome b) {
  for (const CheckOutcome outcome : {CheckOutcome::kBad, CheckOutcome::kCannotBeJudged})
    if (a == outcome || b == outcome) return outcome;
  return CheckOutcome::kGood;
}

}  // namespace

CheckOutcome check_recording(const RecordingCheck& check) {
  const record::Recording recording{fs::path(check.file)};
  ProgressLine line;
  const std::vector<Program> programs = record::programs_of(
      recording, check.frames,
      [&](std::uint64_t commands) { line.show("recording", fmt::format("{} commands read", commands)); });
  if (programs.empty()) {
    line.print("");
    std::cout << "cannot be judged: in these frames no evaluator command is executed";
    if (!recording.commands().empty())
      std::cout << ", directly or in a display list; recorded commands: " << list_of(recording.commands());
    if (!recording.others().empty()) std::cout << "; only counted: " << list_of(recording.others());
    std::cout << "\n";
    return CheckOutcome::kCannotBeJudged;
  }
  const fs::path output = check.output.empty() ? create_run_folder("recording") : fs::path(check.output);
  const FolderLock lock = claim(output, check.command);
  const fs::path file = fs::absolute(output / "programs.txt");
  record::write_programs(file, programs);
  line.print(printed(describe(recording, programs)));
  std::map<std::string, const Program*> by_name;
  RunRequest request;
  for (const Program& program : programs) {
    const std::string name = "Recording." + program.name;
    by_name[name] = &program;
    request.tests.push_back({name, {"EV-COORD-ASIF"}, Level::kMust});
  }
  request.suite_program = places().suite_program;
  request.more_options = {"--programs", file.string()};
  request.limits.seconds_per_test = check.seconds_per_test;
  request.jobs = usual_jobs();
  request.output = output;
  request.run = check.output.empty() ? output.filename().string() : "";
  request.command = check.command;
  request.program = check.program;
  request.recording = check.file;
  request.baseline.known_bugs = false;
  stop_when_asked();
  adopt_orphans();
  std::vector<RunResult> results;
  CheckOutcome outcome = CheckOutcome::kGood;
  for (const ImplementationOptions& implementation : check.implementations) {
    if (interrupted) break;
    request.implementation = implementation;
    request.name = implementation.name.empty() ? "library" : implementation.name;
    Pace pace;
    RunResult result = run_implementation(request, [&](const Progress& progress) {
      line.show(request.name,
                progress.phase == "test" ? pace.at(progress.done, progress.total) : progress.phase);
    });
    find_bugs(result, request, line);
    write_atomically(output / fmt::format("results-{}.json", result.file_label()), to_text(result));
    line.print(printed(summary(result, by_name)));
    outcome = worse(outcome, outcome_of(result));
    if (!result.bugs.empty())
      line.print(reports::bug_list(result, catalogue(), shows_colour(), false) + "\n");
    results.push_back(std::move(result));
  }
  write_pages(output, results, {});
  if (check.output.empty()) set_latest(output);
  if (interrupted) std::cerr << "evalcts: interrupted; the results so far are in the output folder\n";
  std::cout << fmt::format("Report: {}\n", (output / "index.html").string());
  return interrupted ? worse(outcome, CheckOutcome::kCannotBeJudged) : outcome;
}

}  // namespace evalcts::cli
