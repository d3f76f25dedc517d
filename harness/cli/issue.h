// The text of an issue for the bug tracker of a library.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/bug.h>
#include <evalcts/results/known_bugs.h>
#include <evalcts/results/run_result.h>

namespace evalcts::cli {

// Returns the program of a known bug as C: its example, or its first program; empty if it has neither.
std::vector<std::string> program_of(const KnownBug& bug);

// Returns the issue in Markdown: title, affected versions, program, expected and observed result, rule with
// links, cause, and effect. `bug` is a bug of the run, and `known` a bug of the register; one of them may be
// null. `calls` is the program.
std::string issue_text(const RunResult* run, const Bug* bug, const KnownBug* known,
                       const std::vector<std::string>& calls);

}  // namespace evalcts::cli
