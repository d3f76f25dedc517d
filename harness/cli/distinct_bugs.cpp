// Finds the distinct bugs of a run by workers of the same implementation.
#include "distinct_bugs.h"

#include <fmt/format.h>

#include <algorithm>

#include <evalcts/fuzz/bugs.h>
#include <evalcts/results/baseline.h>
#include <evalcts/runner/interruption.h>

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
  fuzz::BugRequest bugs = {.suite_command = result.suite_command,
                           .jobs = request.jobs,
                           .seconds = seconds,
                           .scratch = scratch,
                           .limits = request.limits};
  const std::vector<std::string> captures = captures_option(result.implementation);
  bugs.suite_command.insert(bugs.suite_command.end(), captures.begin(), captures.end());
  // The baseline names the bugs of known failures. It is applied to the result itself later, after
  // --write-baseline.
  RunResult with_baseline = result;
  if (result.has_started())
    Baseline(request.baseline, result.implementation, result.pass).apply(with_baseline, {});
  fuzz::find_bugs(with_baseline, bugs, [&](std::size_t done, std::size_t total) {
    line.show(request.name, fmt::format("reducing failing tests, {} of {}", done, total));
  });
  result.bugs = std::move(with_baseline.bugs);
  result.bugs_note = std::move(with_baseline.bugs_note);
  fuzz::set_aside_shared_bugs(result);
  std::filesystem::remove_all(scratch);
}

}  // namespace evalcts::cli
