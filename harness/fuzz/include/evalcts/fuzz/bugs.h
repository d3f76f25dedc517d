// The distinct bugs behind the failing tests of a run.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <evalcts/fuzz/reduction.h>
#include <evalcts/results/run_result.h>
#include <evalcts/runner/suite_child.h>

namespace evalcts::fuzz {

struct BugRequest {
  // Starts the suite program for the implementation, captures included.
  std::vector<std::string> suite_command;
  int jobs = 1;                   // processes that share the failing cases
  double seconds = 60;            // for all of it
  std::filesystem::path scratch;  // an existing folder, for files of this step
  Limits limits;
};

// Reduces the first failing case of each failing test of the run to a minimal program, and sets `bugs` and
// `bugs_note` of the run. Failures of a second pass are not reduced, because they depend on what was run
// before. Throws CannotWrite.
void find_bugs(RunResult& run, const BugRequest& request,
               const std::function<void(std::size_t done, std::size_t total)>& progress);

// Groups the failing tests: those whose minimal programs have the same normal form are one bug, and so are
// those that are the same known bug. Tests that could not be reduced are grouped by requirement, by what
// differed and by their family ("Mesh.LastIsExact" for Mesh1.LastIsExact/LINE), and join the bug of a reduced
// test that is alike in all three if the time for reduction was over. `reductions`: by test.
std::vector<Bug> bugs_of(const RunResult& run, const std::map<std::string, Reduction>& reductions,
                         int max_eval_order);

// The text by which unreduced failures of the test are grouped.
std::string likeness_of(const TestRecord& test);

// The commands as C, at most a screen of them: values that are no short decimals are hexadecimal, with the
// decimal value in a comment.
std::vector<std::string> readable_calls(const gl::Case& program);

}  // namespace evalcts::fuzz
