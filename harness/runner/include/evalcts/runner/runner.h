// Judges one implementation in workers and makes its result record. A crash or hang of the library
// affects only the test that is running.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/results/baseline.h>
#include <evalcts/results/files.h>
#include <evalcts/results/run_result.h>
#include <evalcts/runner/interruption.h>
#include <evalcts/runner/worker.h>

namespace evalcts {

struct RunRequest {
  std::filesystem::path suite_program;
  ImplementationOptions implementation;
  std::vector<std::string> more_options = {};  // further options of the suite program
  std::string name;               // the user's label, or the name of the implementation; part of file names
  std::optional<Shard> shard;     // set if `tests` are a part of all tests
  std::vector<ListedTest> tests;  // the tests to run
  std::string filter;             // that selected the tests; empty: all of the depth are run
  Depth depth = Depth::kFull;
  std::vector<std::string> readings;  // readings that the user chose, as NAME=READING
  std::uint32_t seed = 1;
  Limits limits;
  int retries = 1;  // number of times that an unexpected fail is repeated
  int jobs = 1;     // number of processes that share the tests; those of a shared context run in one
  std::filesystem::path output;     // an existing folder
  std::string command;              // the command that the user typed, for the record
  std::string program = "evalcts";  // evalcts as the user types it, for the commands shown with a failure
  std::string run;                  // name of the output folder for --run; empty: its path is the name
  std::string recording = {};       // as the user named it, if `tests` are its programs
  // False: tests run in one warm context first, and what does not pass there runs in fresh contexts, which
  // decide.
  bool only_fresh_contexts = false;
  // Determines the tests that are not run, and the failures that are not investigated further.
  BaselineChoice baseline;
  // The result of the first pass, with fresh contexts, if this run is the second pass; null in
  // the first pass.
  const RunResult* first_pass = nullptr;

  bool is_second_pass() const { return first_pass != nullptr; }
};

struct Progress {
  std::string phase;  // "starting", "test", "confirming", "running again", "searching a history"
  std::size_t done = 0;
  std::size_t total = 0;
  std::string test;
};

// Maximum number of unexpected fails of which each is repeated. If there are more, they are grouped by test
// function and compared value, and only one of each group is repeated.
inline constexpr std::size_t kMostRerun = 100;

// Returns the option of the suite program for the captures that are available: {"--captures", "a,b"}.
std::vector<std::string> captures_option(const ImplementationRecord& implementation);

// Returns the reason why the answers of a worker cannot be used, because it was built from other sources than
// this program, which has these tests; empty if they can.
std::string why_other_suite(const std::vector<ListedTest>& tests, const Description& description);

// Runs the tests, writes results-NAME.json (format "evalcts-results-1") and returns its content. During the
// run, records-NAME.jsonl in the output folder grows by a line for each test that starts, for each first
// failing case and for each record, and log-NAME.txt contains the output of the library and the suite. If the
// implementation cannot be started, the result has the status "not-started" and the reason. If the folder
// becomes unwritable (disk full), or no more processes can be started, the run ends with the status
// "interrupted" and the reason. Throws CannotWrite if results-NAME.json cannot be written; the results are
// then in records-NAME.jsonl.
//
// A fail that the baseline does not list is repeated alone in a new process, up to `retries` times (see
// kMostRerun), a crash or timeout once. If the outcome differs and the failure does not happen again after
// the tests that ran before it (which the message and "history" would then name), "again" is the other
// outcome. If that is no failure, the test is a flake ("flake"): a fail is then undecided (not-observable), a
// crash or timeout keeps its verdict.
//
// A second pass has its own files, and "pass": "reuse-context" in its record. A test that fails in the same
// way as in the first pass is marked as expected and as "also_in_fresh_context". For any other failure, the
// message and "history" state the shortest history that was found (names of tests in order; none: the test's
// own earlier cases), and "history_case" the last necessary case if the history is one test.
RunResult run_implementation(const RunRequest& request, const std::function<void(const Progress&)>& progress);

}  // namespace evalcts
