// `evalcts waive`: adds a failing test or a bug of the last run to a baseline with a reason, or removes it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <set>

#include <evalcts/cli/command.h>
#include <evalcts/results/text.h>
#include "chosen_baseline.h"
#include "recorded.h"
#include "result_files.h"
#include "run_folders.h"

namespace evalcts::cli {
namespace {

struct WaiveOptions {
  std::string failure;   // see find_failure()
  std::string reason;    // empty with --unwaive
  std::string baseline;  // "DIR" or "DIR/NAME"
  std::string run;       // value of --run
  bool unwaive = false;
};

// Returns the result with the tests of the failure only.
RunResult part_of(const RecordedFailure& failure) {
  RunResult part = *failure.run;
  part.tests.clear();
  for (const TestRecord* const test : failure.tests) part.tests.push_back(*test);
  return part;
}

// Returns the reason as the comment of an entry, with the bug if one was named.
std::string comment_of(const RecordedFailure& failure, const std::string& reason) {
  if (!failure.bug) return reason;
  return fmt::format("bug: {}. {}", failure.bug->known.empty() ? failure.bug->id : failure.bug->known,
                     reason);
}

int waive(const WaiveOptions& options) {
  const std::list<RunResult> runs = recorded_run(run_folder(options.run));
  const RecordedFailure failure = find_failure(runs, options.failure);
  const RunResult part = part_of(failure);
  const BaselineChoice choice = choice_of(options.baseline, false);
  const Baseline baseline(choice, part.implementation, part.pass);
  if (!choice.name.empty() && (!baseline.files() || baseline.files()->name != choice.name))
    return wrong_use(fmt::format("--baseline '{}' is for another pass", options.baseline));
  const BaselineFiles renewed =
      baseline.renewed(part, choice, part.file_label(), comment_of(failure, options.reason));
  RunResult judged = part;
  baseline.apply(judged, {});
  std::size_t waived = 0;
  const TestRecord* known = nullptr;  // a test that needs no entry
  for (const TestRecord& test : judged.tests)
    if (renewed.entries.contains(test.name))
      ++waived;
    else
      known = &test;
  if (known)
    std::cout << fmt::format("{} of {} expected anyway, such as {}: {}\n", part.tests.size() - waived,
                             part.tests.size() == 1 ? "1 test is" : count(part.tests.size(), "test") + " are",
                             known->name, clean(known->baseline_reason));
  if (waived == 0) return kNothingUnexpected;
  std::cout << fmt::format("Waived {}: {}\n", count(waived, "test"), options.reason)
            << write_baseline(chosen_files(options.baseline).folder, baseline.files(), renewed);
  return kNothingUnexpected;
}

// Returns the tests of a failure of the run; empty if it has none of this name.
std::set<std::string> tests_in_run(const WaiveOptions& options) {
  std::set<std::string> tests;
  try {
    const std::list<RunResult> runs = recorded_run(run_folder(options.run));
    for (const TestRecord* const test : find_failure(runs, options.failure).tests) tests.insert(test->name);
  } catch (const NotRecorded&) {
  } catch (const CannotReadResults&) {
  }
  return tests;
}

// Returns the entries that a name stands for: that of the test or pattern, those with the ID of the bug in
// their reason, or else those of the tests.
std::vector<std::string> entries_of(const std::string& name, const BaselineFiles& files,
                                    const std::set<std::string>& tests) {
  std::vector<std::string> named, of_tests;
  for (const auto& [test, entry] : files.entries) {
    if (test == name || entry.bug() == name) named.push_back(test);
    if (tests.contains(test)) of_tests.push_back(test);
  }
  return named.empty() ? of_tests : named;
}

int unwaive(const WaiveOptions& options) {
  const BaselineChoice choice = choice_of(options.baseline, true);
  const std::set<std::string> tests = tests_in_run(options);
  std::vector<std::pair<const BaselineFiles*, std::vector<std::string>>> found;
  for (const BaselineFiles& files : choice.files)
    if (choice.name.empty() || files.name == choice.name)
      if (const std::vector<std::string> entries = entries_of(options.failure, files, tests);
          !entries.empty())
        found.emplace_back(&files, entries);
  if (found.empty())
    return wrong_use(fmt::format(
        "'{}' has no entry of a test or bug '{}'. A failure that a pattern or a known bug makes expected is "
        "taken out by the line 'TEST,Pass' with a reason",
        options.baseline, options.failure));
  if (found.size() > 1)
    return wrong_use(
        fmt::format("{} baselines in '{}' have entries of '{}'; name one of them, such as "
                    "--baseline {}",
                    found.size(), options.baseline, options.failure,
                    (chosen_files(options.baseline).folder / found.front().first->name).string()));
  const auto& [files, entries] = found.front();
  BaselineFiles renewed = *files;
  for (const std::string& entry : entries) {
    renewed.entries.erase(entry);
    renewed.signatures.erase(entry);
  }
  std::cout << write_baseline(chosen_files(options.baseline).folder, files, renewed);
  return kNothingUnexpected;
}

int waive_or_unwaive(const WaiveOptions& options) {
  if (options.unwaive) return unwaive(options);
  if (options.reason.find_first_not_of(" \t\n") == std::string::npos)
    return wrong_use("a waiver needs its reason: --reason \"...\"");
  return waive(options);
}

std::function<int()> define_waive(CLI::App& app, const Call&) {
  const auto options = std::make_shared<WaiveOptions>();
  app.add_option("failure", options->failure,
                 "name of a failing test, NAME:TEST, or a part of the name that identifies it; or the ID of "
                 "a bug, for all tests that fail because of it (see 'evalcts bugs')")
      ->required();
  CLI::Option* const reason =
      app.add_option("--reason", options->reason, "the reason, which is stored with the entry");
  app.add_option("--baseline", options->baseline,
                 "the baseline to change: a folder DIR, of which the best fit is used, or one of its "
                 "baselines as DIR/NAME. A folder without one gets a new baseline for the implementation")
      ->required();
  app.add_flag("--unwaive", options->unwaive, "remove the entry of the test, or the entries of the bug")
      ->excludes(reason);
  add_run(app, options->run);
  return [options] { return waive_or_unwaive(*options); };
}

}  // namespace

const Command kWaiveCommand = {
    "waive", "expect a failing test or a bug of the last run from now on, with the reason, in a baseline",
    R"(  $ evalcts waive IntegersSaturate/MAP1_INDEX --reason "fixed in 25.1" --baseline mine
  $ evalcts waive EV-GETMAP-SATURATE-b20f --reason "issue 1234" --baseline mine/library
  $ evalcts waive EV-GETMAP-SATURATE-b20f --unwaive --baseline mine/library)",
    define_waive};

}  // namespace evalcts::cli
