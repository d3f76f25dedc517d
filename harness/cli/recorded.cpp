// Finds failures by name, and reads the options of the suite program from the results. Unexpected options are
// rejected.
#include "recorded.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iostream>
#include <set>
#include <string_view>

#include <evalcts/results/files.h>
#include <evalcts/results/serialization.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/runner.h>
#include "result_files.h"

namespace evalcts::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSuggested = 10;
constexpr std::size_t kLongestName = 200;  // bytes of a test's name in a file name
constexpr double kLongestTimeout = 1e6;    // seconds

bool is_word(const std::string& text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; });
}

std::string suggestions(const std::vector<Candidate>& tests) {
  std::string text;
  for (std::size_t i = 0; i < tests.size() && i < kMostSuggested; ++i) text += "\n  " + tests[i].full_name();
  if (tests.size() > kMostSuggested) text += fmt::format("\n  and {} more", tests.size() - kMostSuggested);
  return text;
}

// Returns the only failing test with the wanted name, or the only one whose name contains it. Throws
// NotRecorded.
Candidate find_test(const std::list<RunResult>& runs, const std::string& wanted) {
  std::vector<Candidate> failing, exact, part;
  bool exists = false;
  for (const RunResult& run : runs)
    for (const Candidate& test : candidates_of(run)) {
      const bool same = wanted == test.name() || wanted == test.full_name();
      exists = exists || same;
      if (!test.failed()) continue;
      failing.push_back(test);
      if (same) exact.push_back(test);
      if (test.full_name().find(wanted) != std::string::npos) part.push_back(test);
    }
  for (std::vector<Candidate>* const tests : {&failing, &exact, &part})
    std::ranges::sort(*tests, {}, &Candidate::full_name);
  const std::vector<Candidate>& matching = exact.empty() ? part : exact;
  if (matching.size() == 1) return matching.front();
  if (matching.size() > 1)
    throw NotRecorded(fmt::format("'{}' names {} failures; name one of them:{}", wanted, matching.size(),
                                  suggestions(matching)));
  if (exists) throw NotRecorded(fmt::format("{} did not fail in that run", wanted));
  throw NotRecorded(failing.empty() ? "nothing failed in that run"
                                    : fmt::format("no failing test is called '{}'; these failed:{}", wanted,
                                                  suggestions(failing)));
}

}  // namespace

std::vector<Candidate> candidates_of(const RunResult& run) {
  if (run.implementation.name.empty()) throw FormatError("implementation.name is missing");
  if (run.timeout && !(*run.timeout > 0 && *run.timeout <= kLongestTimeout))
    throw FormatError("timeout: expected a number of seconds");
  std::vector<Candidate> tests;
  if (run.pass == Pass::kFreshContexts)
    for (const TestRecord& test : run.tests) tests.push_back({&run, &test});
  return tests;
}

std::list<RunResult> recorded_run(const fs::path& folder) {
  std::list<RunResult> runs;
  bool has_tests = false;
  std::error_code error;
  for (const fs::path& file : result_files_in(folder, error)) {
    try {
      RunResult run = parse_run_result(read_file(file));
      has_tests = !candidates_of(run).empty() || has_tests;
      runs.push_back(std::move(run));
    } catch (const FormatError& problem) {
      std::cerr << fmt::format("evalcts: {} holds no results; left out ({})\n", file.string(),
                               clean(problem.what()));
    }
  }
  if (!has_tests)
    throw NotRecorded(fmt::format("'{}' contains no results; 'evalcts run' first, or name a run with --run",
                                  folder.string()));
  return runs;
}

RecordedFailure find_failure(const std::list<RunResult>& runs, const std::string& wanted) {
  std::vector<RecordedFailure> found;
  for (const RunResult& run : runs) {
    const std::string prefix = run.implementation.name + ":";
    const std::string id = wanted.starts_with(prefix) ? wanted.substr(prefix.size()) : wanted;
    for (const Bug& bug : run.bugs)
      if (run.pass == Pass::kFreshContexts && !id.empty() && (id == bug.id || id == bug.known))
        found.push_back({&bug, &run, {}});
  }
  if (found.empty()) {
    const Candidate test = find_test(runs, wanted);
    return {nullptr, test.run, {test.test}};
  }
  if (found.size() > 1) {
    std::string names;
    for (const RecordedFailure& each : found)
      names += fmt::format("\n  {}:{}", each.run->implementation.name, each.bug->id);
    throw NotRecorded(
        fmt::format("{} implementations have the bug {}; name one of them:{}", found.size(), wanted, names));
  }
  RecordedFailure& failure = found.front();
  for (const TestRecord& test : failure.run->tests)
    if (std::ranges::binary_search(failure.bug->tests, test.name)) failure.tests.push_back(&test);
  if (failure.tests.empty()) throw NotRecorded(fmt::format("{} names no test of its run", wanted));
  return failure;
}

std::vector<std::string> replay_options(const RunResult& run) {
  static const std::set<std::string_view> kHarmless = {"--implementation", "--library", "--context",
                                                       "--depth",          "--seed",    "--interpretation",
                                                       "--mesa-build",     "--programs"};
  const std::vector<std::string>& command = run.suite_command;
  if (command.size() % 2 == 0)
    throw FormatError("suite_command: expected a program and pairs of options and values");
  std::vector<std::string> options;
  for (std::size_t i = 1; i < command.size(); i += 2) {
    const std::string &option = command[i], &value = command[i + 1];
    if (option == "--worker") continue;  // a command of a file is never run
    if (!kHarmless.contains(option) || value.starts_with("-"))
      throw FormatError(fmt::format("suite_command: '{} {}' is not a command that judges", option, value));
    options.insert(options.end(), {option, value});
  }
  for (const CaptureRecord& capture : run.implementation.captures)
    if (capture.available && !is_word(capture.name))
      throw FormatError(fmt::format("implementation.captures: '{}' is not a capture", capture.name));
  const std::vector<std::string> captures = captures_option(run.implementation);
  options.insert(options.end(), captures.begin(), captures.end());
  return options;
}

std::string reproducer_name(const std::string& test) {
  std::string name = test.substr(0, kLongestName);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '_' && c != '-') c = '-';
  return "reproduce-" + name + ".c";
}

}  // namespace evalcts::cli
