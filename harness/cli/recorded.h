// Results of earlier runs as what to replay: files that anybody may have written.
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

// The tests of a run, which has to live as long; none of a second pass, in which tests fail only after
// others, so that no program of one case shows it. Throws FormatError if something that a replay needs is
// missing.
std::vector<Candidate> candidates_of(const RunResult& run);

// The options with which the suite program judged, and the captures: those that say what is judged, and how.
// No option gets through that writes a file, whatever the record holds. Throws FormatError.
std::vector<std::string> replay_options(const RunResult& run);

// "reproduce-Theme.Test-MAP1_INDEX.c": a name in the folder of the results, whatever the test is called.
std::string reproducer_name(const std::string& test);

}  // namespace evalcts::cli
