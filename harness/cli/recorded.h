// Results of earlier runs as what to play again: files that anybody may have written.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "harness/results/json.h"

namespace evalcts::cli {

// A file of results does not follow its format; the message says where.
struct BadResults : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// One test of a run.
struct Candidate {
  nlohmann::json run;  // without its tests
  nlohmann::json test;
  std::string label() const { return run["implementation"]["name"]; }
  std::string name() const { return test["name"]; }
  std::string full_name() const { return label() + ":" + name(); }
  bool failed() const;
};

// The tests of a result record; none of a second pass, in which tests fail after others only, so that no
// program of one case shows it. All members that are looked at later have the types that they should. Throws
// BadResults.
std::vector<Candidate> candidates_of(nlohmann::json run);

// The options with which the suite program judged, and the captures: those that say what is judged, and how.
// No option gets through that writes a file, whatever the record holds. Throws BadResults.
std::vector<std::string> replay_options(const nlohmann::json& run);

// "reproduce-Theme.Test-MAP1_INDEX.c": a name in the folder of the results, whatever the test is called.
std::string reproducer_name(const std::string& test);

}  // namespace evalcts::cli
