// The history of an implementation: verdicts and bugs of several runs, by date and by version.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <evalcts/results/run_result.h>

namespace evalcts::reports {

// A run of a history, without the evidence of its tests, so that many runs fit into memory.
struct PastRun {
  struct PastBug {
    std::string id, title;  // id: of the known bug, if it is one

    auto operator<=>(const PastBug&) const = default;
  };

  std::string run;        // name of its folder
  std::string series;     // implementation and depth: "osmesa, full depth"; runs of a series are compared
  std::string version;    // the product in GL_VERSION, "Mesa 22.3.6", or all of GL_VERSION
  std::string started;    // in UTC, "2026-11-28T11:27:22Z"; empty in results of earlier versions of evalcts
  bool is_whole = false;  // all tests of the depth were run
  bool has_bugs = false;  // failures were reduced to bugs
  std::vector<PastBug> bugs;  // sorted
  Counts counts{};            // tests by verdict
  std::uint64_t new_failures = 0, known_failures = 0;
};

// Returns the run of a result in the folder called `run`.
PastRun past_run(const RunResult& result, const std::string& run);

// Returns the history for a terminal: for each series a line for each run, the oldest first, and a line for
// each version, with the bugs that came and went. Runs of a part of the tests are counted only. `columns`:
// width of the terminal, to which lines are limited; 0: unknown.
std::string history_text(const std::vector<PastRun>& runs, std::size_t columns);

// Returns the same as HTML, with a plot of bugs and failing tests for each series.
std::string history_html(const std::vector<PastRun>& runs);

}  // namespace evalcts::reports
