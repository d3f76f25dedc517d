// Orders the runs of a history by implementation, date and version.
#pragma once

#include <string>
#include <vector>

#include "evalcts/history.h"

namespace evalcts::reports {

// A run, compared with the one before it.
struct Step {
  const PastRun* run = nullptr;
  std::vector<PastRun::PastBug> came, went;  // empty for the first run
};

struct Series {
  std::string name;
  std::vector<Step> by_date;
  std::vector<Step> by_version;  // the last run of each version
  std::size_t left_out = 0;      // runs of a part of the tests
};

// Returns the series by name. They point into `runs`.
std::vector<Series> series_of(const std::vector<PastRun>& runs);

// Returns the number of bugs, or "-" if failures were not reduced to bugs.
std::string bugs_in_words(const PastRun& run);

// Returns "2026-11-28 11:27", or "unknown".
std::string date_in_words(const PastRun& run);

// Returns "2 new bugs: A, B; 1 gone: C"; empty if nothing changed.
std::string step_in_words(const Step& step);

}  // namespace evalcts::reports
