// Confirms deaths: tests in which a process crashed, hung, or used too much memory. Each runs again alone in
// a new process, which decides whether the evaluators, the rest of the pipeline, or earlier tests are to
// blame.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <evalcts/runner/runner.h>
#include "history_search.h"
#include "run_records.h"
#include "suite_processes.h"

namespace evalcts {

class DeathConfirmation {
 public:
  // All arguments must outlive the object.
  DeathConfirmation(const RunRequest& request, const SuiteProcesses& processes, RunRecords& records,
                    HistorySearch& histories, const std::function<void(const Progress&)>& progress)
      : request_(request),
        processes_(processes),
        records_(records),
        histories_(histories),
        progress_(progress) {}

  // Adds a record for each test in which one of these processes died. A test does not run again if several
  // tests with the same crash in a map command have been confirmed and none had another outcome, or if it
  // hangs at a place where another test hangs alone.
  void confirm_and_record(const std::vector<WorkerRun>& deaths);

 private:
  // Statistics of crashes in one command with the same innermost frames.
  struct SameCrashes {
    std::size_t confirmed = 0;  // tests that crashed in the same way when they ran alone
    std::size_t others = 0;     // tests with another outcome when they ran alone
  };

  bool hangs_like_another(const WorkerRun& run);
  bool has_enough_like_it(const WorkerRun& run, std::map<std::string, std::size_t>& chosen) const;
  bool record_as_same_hang(const WorkerRun& run);
  bool record_as_same_crash(const WorkerRun& run);
  void confirm(const std::vector<const WorkerRun*>& dead);
  void record_as_alone(const WorkerRun& dead, const WorkerRun& alone);
  void count_crash(const WorkerRun& dead, const WorkerRun& alone);
  bool dies_with_explicit_vertices(const std::string& test, const WorkerRun& alone) const;

  const RunRequest& request_;
  const SuiteProcesses& processes_;
  RunRecords& records_;
  HistorySearch& histories_;
  const std::function<void(const Progress&)>& progress_;
  std::map<std::string, SameCrashes> same_crashes_;  // by place
  std::map<std::string, std::string> hangs_;         // by place: the first test that hung there
  std::set<std::string> hung_alone_;                 // tests that hung again when they ran alone
};

}  // namespace evalcts
