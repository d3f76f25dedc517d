// Finds the distinct bugs of a run by workers of the same implementation.
#include "distinct_bugs.h"

#include <fmt/format.h>

#include <algorithm>

#include <evalcts/fuzz/bugs.h>
#include <evalcts/results/baseline.h>
#include <evalcts/runner/interruption.h>
#include "recorded.h"

namespace evalcts::cli {

void find_distinct_bugs(RunResult& result, const RunRequest& request, double seconds, ProgressLine& line) {
  if (std::ranges::none_of(result.tests, [](const TestRecord& test) { return is_failure(test.verdict); }))
    return;
  if (seconds == 0 || interrupted) {
    result.bugs_note = seconds == 0 ? "--no-bugs: the failing tests were not reduced to distinct bugs"
                                    : "interrupted before the failing tests were reduced to distinct bugs";
    return;
  }
  const std::filesystem::path scratch = request.output / ("scratch-bugs-" + result.file_label());
  std::filesystem::remove_all(scratch);
  std::filesystem::create_directory(scratch);
  fuzz::BugRequest bugs = {.suite_command = replay_options(result),
                           .jobs = request.jobs,
                           .seconds = seconds,
                           .scratch = scratch,
                           .limits = request.limits};
  bugs.suite_command.insert(bugs.suite_command.begin(), request.suite_program.string());
  // The baseline names the bugs of known failures. It is applied to the result itself later, after
  // --write-baseline.
  RunResult judged = result;
  if (result.has_started()) Baseline(request.baseline, result.implementation, result.pass).apply(judged, {});
  fuzz::find_bugs(judged, bugs, [&](std::size_t done, std::size_t total) {
    line.show(request.name, fmt::format("reducing failing tests, {} of {}", done, total));
  });
  result.bugs = std::move(judged.bugs);
  result.bugs_note = std::move(judged.bugs_note);
  fuzz::set_aside_shared_bugs(result);
  std::filesystem::remove_all(scratch);
}

}  // namespace evalcts::cli
