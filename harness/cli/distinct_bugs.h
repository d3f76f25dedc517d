// Reduces the failing tests of a run to distinct bugs.
#pragma once

#include <evalcts/cli/terminal.h>
#include <evalcts/runner/runner.h>

namespace evalcts::cli {

// Sets result.bugs, or result.bugs_note with the reason why there are none. `seconds`: time limit; 0: the
// user wants no reduction. Throws CannotWrite.
void find_distinct_bugs(RunResult& result, const RunRequest& request, double seconds, ProgressLine& line);

}  // namespace evalcts::cli
