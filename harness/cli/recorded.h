// Determines what to replay from the results of an earlier run. Result files may come from anybody, so they
// are validated.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/run_result.h>

namespace evalcts::cli {

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

// Returns the options with which the suite program judged, and --captures. Only options that select the
// implementation and the way of judging are accepted, because others might write files. Throws FormatError.
std::vector<std::string> replay_options(const RunResult& run);

// Returns a file name such as "reproduce-Theme.Test-MAP1_INDEX.c", without characters that leave the folder.
std::string reproducer_name(const std::string& test);

}  // namespace evalcts::cli
