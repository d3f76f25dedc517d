// The text of an issue for the bug tracker of a library.
#pragma once

#include <string>
#include <vector>

#include <evalcts/results/bug.h>
#include <evalcts/results/known_bugs.h>
#include <evalcts/results/run_result.h>

namespace evalcts::cli {

// Returns the program of a known bug as C: its first program, or its example; empty if it has neither.
std::vector<std::string> program_of(const KnownBug& bug);

// Returns the lines of a program with equal neighbours as loops, with decimal numbers only, and with the
// middle of what is still long left out.
std::vector<std::string> short_program(const std::vector<std::string>& calls);

// Returns "0" for "[-3e-37, 3e-37]" and "0.5 +- 2e-05" for "[0.49998, 0.50002]"; other texts as they are.
std::string in_plain_numbers(const std::string& expected);

// Returns the issue in Markdown: title, affected versions, program, expected and observed result, rule with
// links, cause, and effect. `bug` is a bug of the run, and `known` a bug of the register; one of them may be
// null. `calls` is the program.
std::string issue_text(const RunResult* run, const Bug* bug, const KnownBug* known,
                       const std::vector<std::string>& calls);

}  // namespace evalcts::cli
