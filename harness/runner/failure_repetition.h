// Repeats the fails that the baseline does not list, alone in new processes, to tell flakes and failures that
// depend on earlier tests apart from others. Runs after all tests; crashes and timeouts are repeated by
// DeathConfirmation.
#pragma once

#include <cstdint>
#include <functional>

#include <evalcts/results/baseline.h>
#include <evalcts/runner/runner.h>
#include "history_search.h"
#include "run_records.h"
#include "suite_processes.h"

namespace evalcts {

// Repeats each fail up to request.retries times. Adds the other outcome or the history to the records of
// those that do not fail in the same way. Returns the number of failures that were not repeated, because one
// of their group failed again (see kMostRerun).
std::uint64_t repeat_failures(const RunRequest& request, const Baseline& baseline,
                              const SuiteProcesses& processes, RunRecords& records, HistorySearch& histories,
                              const std::function<void(const Progress&)>& progress);

}  // namespace evalcts
