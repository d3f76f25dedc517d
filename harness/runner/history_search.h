// Searches for the histories of failures by running tests again in new processes.
#pragma once

#include <set>
#include <string>
#include <vector>

#include <evalcts/runner/runner.h>
#include "history.h"
#include "suite_processes.h"

namespace evalcts {

inline constexpr char kHistoryOutOfTime[] = "; the search for the tests that it depends on ran out of time";

// Adds a history that was found, or that none was found, to the message of the failure, and sets `history`
// and `history_case`. `predecessors`: number of tests among which the history was searched for.
void add_history(TestRecord& record, const History& history, std::size_t predecessors);

class HistorySearch {
 public:
  // `request` and `processes` must outlive the object.
  HistorySearch(const RunRequest& request, const SuiteProcesses& processes)
      : request_(request), processes_(processes) {}

  // Must be called with the tests that each process has finished, in their order.
  void add_sequence(const std::vector<std::string>& tests) { sequences_.push_back(tests); }
  // Returns the tests that ran before the test in the same process.
  std::vector<std::string> predecessors_of(const std::string& test) const;

  // Searches for the shortest part of `predecessors` after which the test of the record fails again.
  History find_history(const TestRecord& record, const std::vector<std::string>& predecessors);
  bool has_searched(const std::string& test) const { return searched_.contains(test); }

  // True if the test failed in the first pass with the same verdict and at least the same mismatches. False
  // in the first pass.
  bool fails_in_first_pass(const TestRecord& record) const;

 private:
  std::optional<bool> happens_again(const TestRecord& record, std::vector<Job> jobs) const;
  std::string case_of_history(const TestRecord& record, const std::string& test) const;

  const RunRequest& request_;
  const SuiteProcesses& processes_;
  std::vector<std::vector<std::string>> sequences_;
  std::set<std::string> searched_;
  Deadline deadline_;               // the end of the search in progress
  double seconds_left_ = 120;       // for all searches
  std::vector<std::string> guess_;  // the latest history, which often explains the next failure, too
};

}  // namespace evalcts
