// Determines the distinct bugs behind the failing tests of a run.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <evalcts/fuzz/reduction.h>
#include <evalcts/results/known_bugs.h>
#include <evalcts/results/run_result.h>
#include <evalcts/runner/worker.h>

namespace evalcts::fuzz {

struct BugRequest {
  // Command that starts the suite program for the implementation, with --captures.
  std::vector<std::string> suite_command;
  int jobs = 1;                   // number of processes that share the failing cases
  double seconds = 60;            // time limit for the whole reduction
  std::filesystem::path scratch;  // an existing folder for temporary files
  Limits limits;
};

// Reduces the first failing case of each failing test of the run to a minimal program, and sets `bugs` and
// `bugs_note` of the run. A failure that the baseline expects for a known bug is not reduced if a program of
// this bug fails here as the register describes (or, if the bug has no program, in any case), unless the
// baseline cannot compare failing cases: of each bug, the first tests are reduced then. Failures of a second
// pass are not reduced, because they depend on earlier tests. Throws CannotWrite.
void find_bugs(RunResult& run, const BugRequest& request,
               const std::function<void(std::size_t done, std::size_t total)>& progress);

// The findings of known bugs whose own programs fail on the implementation as the register describes, by the
// ID of the bug.
using Proofs = std::map<std::string, Finding>;

// Groups the failing tests into bugs. Tests are one bug if their minimal programs have the same cause, if the
// library crashes or hangs in them at the same place, or if they are of the same known bug. A bug is called
// known only if there is a proof: the finding of a test is that of a known program, or the baseline names the
// bug for a failure that it expects, and the bug is in `proofs` or has no program. Other tests that could not
// be reduced are grouped by requirement, kind of difference and family ("Mesh.LastIsExact" for
// Mesh1.LastIsExact/LINE). If the reason was lack of time or a death of the library, they join the bug of a
// reduced test that agrees in all three. `reductions`: by test.
std::vector<Bug> bugs_of(const RunResult& run, const std::map<std::string, Reduction>& reductions,
                         const Proofs& proofs);

// Returns the text by which failures that were not reduced are grouped: family, requirement and
// kind of difference.
std::string likeness_of(const TestRecord& test);

// Removes the bugs that are not in the register and that explicit vertices show as well. Tests that no other
// bug explains are not observed then.
void set_aside_shared_bugs(RunResult& run);

}  // namespace evalcts::fuzz
