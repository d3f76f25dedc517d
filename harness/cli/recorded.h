// Finds failures in the results of an earlier run, and what replays them. Result files may come from anybody,
// so they are validated.
#pragma once

#include <filesystem>
#include <list>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/results/run_result.h>

namespace evalcts::cli {

// Thrown if a run has no such failure. The message names the failures that it has.
struct NotRecorded : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// One test of a run.
struct Candidate {
  const RunResult* run = nullptr;
  const TestRecord* test = nullptr;

  const std::string& label() const { return run->implementation.name; }
  const std::string& name() const { return test->name; }
  std::string full_name() const { return label() + ":" + name(); }
  bool failed() const { return is_failure(test->verdict); }
};

// Returns the tests of a run, which must outlive them. A second pass has none, because its tests fail only
// after others, so that a program with one case does not reproduce the failure. Throws FormatError if the
// name of the implementation is missing or the timeout is invalid.
std::vector<Candidate> candidates_of(const RunResult& run);

// Returns the results in the folder of a run. What is no result is named on standard error and left out.
// Throws NotRecorded if there are no tests.
std::list<RunResult> recorded_run(const std::filesystem::path& folder);

// A failure that the user named: a bug, or a single test.
struct RecordedFailure {
  const Bug* bug = nullptr;  // null if a test was named
  const RunResult* run = nullptr;
  std::vector<const TestRecord*> tests;  // the failing tests of the bug that the run recorded, or the test

  Candidate first() const { return {run, tests.front()}; }
};

// Returns the failure with a name: the ID of a bug or of a known bug, the name of a failing test, or a part
// of a name that occurs in only one failing test; or NAME:ID and NAME:test, in which NAME is an
// implementation. Points into `runs`. Throws NotRecorded if there is none or more than one.
RecordedFailure find_failure(const std::list<RunResult>& runs, const std::string& wanted);

// Returns the options with which the suite program judged, and --captures. Only options that select the
// implementation and the way of judging are accepted, because others might write files. Throws FormatError.
std::vector<std::string> replay_options(const RunResult& run);

// Returns a file name such as "reproduce-Theme.Test-MAP1_INDEX.c", without characters that leave the folder.
std::string reproducer_name(const std::string& test);

}  // namespace evalcts::cli
