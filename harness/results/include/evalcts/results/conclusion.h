// The conclusion of a run: the counts that decide its exit code, and the line that every report shows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <evalcts/results/run_result.h>

namespace evalcts {

struct Conclusion {
  std::uint64_t internal_errors = 0;
  std::uint64_t supported = 0, observed = 0;  // tests that the implementation supports; those that it shows
  // The reasons why a run that has started is not green: "3 new failures", "1 stale baseline entry
  // (--strict): NAME".
  std::vector<std::string> problems;
  // "No new failures; 578 known (baseline mesa)", or the problems in place of "No new failures"; "Not judged:
  // REASON" for a run that has not started.
  std::string text;
};
Conclusion conclusion_of(const RunResult& result);

// True if so few of the cases or tests could be observed that their result is not a pass.
inline bool is_mostly_unobserved(std::uint64_t observed, std::uint64_t asked) { return 2 * observed < asked; }

}  // namespace evalcts
