// Judges one implementation in child processes and makes its result record. A library that crashes or hangs
// costs the test in flight, nothing else.
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
#include <evalcts/runner/suite_child.h>

namespace evalcts {

struct RunRequest {
  std::filesystem::path suite_program;
  ImplementationOptions implementation;
  std::string name;               // of the output: the implementation's, or the user's label
  std::optional<Shard> shard;     // if `tests` are a part of all
  std::vector<ListedTest> tests;  // those to run
  Depth depth = Depth::kFull;
  std::vector<std::string> readings;  // NAME=READING, asked for
  std::uint32_t seed = 1;
  Limits limits;
  int retries = 1;  // how often an unexpected fail is run again
  int jobs = 1;     // processes that share the tests (a pass over one shared context: always one)
  std::filesystem::path output;     // an existing folder
  std::string command;              // as the user typed it, for the record
  std::string program = "evalcts";  // how the user calls it, for the commands that a failure is shown with
  bool own_output = false;          // whether the user chose the output folder
  // The baseline that fits states the tests that are not run, and the failures that are not investigated
  // further.
  std::vector<BaselineFiles> baselines;
  std::string baseline;  // name of the base or overlay that the user chose; empty: the one that fits
  // The result of the pass with fresh contexts: this is the second pass, over one shared context.
  const RunResult* first_pass = nullptr;
};

struct Progress {
  std::string phase;  // "starting", "test", "confirming", "running again", "searching a history"
  std::size_t done = 0;
  std::size_t total = 0;
  std::string test;
};

// The most unexpected fails that are all run again. If there are more, one of each group of fails that
// look alike is.
inline constexpr std::size_t kMostPlayedAgain = 100;

// Runs everything and returns the content of results-NAME.json (format "evalcts-results-1"), written by
// write_atomically. While it runs, records-NAME.jsonl grows in the output folder, one line for each test, and
// log-NAME.txt holds what the library and the suite print. An implementation that cannot be started gives a
// record with the status "not-started" and its reason. Where the folder cannot be written any more (disk
// full) the run ends, "interrupted" with the reason; CannotWrite where not even what was obtained can be
// written: it is in records-NAME.jsonl.
//
// A fail that no baseline knows is run again, alone in a new process, up to `retries` times (see
// kMostPlayedAgain); a crash or timeout always once. What does not come out the same either shows
// again behind tests that came before it, which the message and "history" then name, or it is a flake:
// "flake" is true and "again" what came. It keeps its verdict, for that is what the library did.
//
// A second pass has files of its own and "pass": "reuse-context" in its record. What fails in it as it failed
// in the first is marked as expected and as "also_in_fresh_context"; for anything else that fails, the
// shortest history found stands in the message and, as data, in "history" (names of tests, in order; none:
// its own earlier cases) and "history_case" (the one case of the one test that it takes).
RunResult run_implementation(const RunRequest& request, const std::function<void(const Progress&)>& progress);

}  // namespace evalcts
