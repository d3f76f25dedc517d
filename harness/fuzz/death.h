// Reduces programs in which the library crashes or hangs. Private to harness/fuzz.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include <evalcts/fuzz/finding.h>
#include <evalcts/runner/worker.h>

namespace evalcts::fuzz {

// Runs the program in a process of its own. `command`: starts the suite program with the implementation.
WorkerRun run_program(const std::vector<std::string>& command, const gl::Case& program,
                      const std::filesystem::path& log, const Limits& limits);

// Returns the difference that the end of a process is: a crash or hang, whose place is that of the innermost
// frames, or the command in flight for a hang. Returns none if the process ran to its end, or ended for
// another reason: an interruption, a fault of its own, or a library that does not start.
std::optional<Difference> death_of(const WorkerRun& run);

// Returns the named finding of a program in which the library dies.
Finding finding_of_death(const gl::Case& program, const Difference& death, int max_eval_order);

// Runs a program in a separate process, and returns its death_of().
using RunAlone = std::function<std::optional<Difference>(const gl::Case&)>;

// Returns the finding of a program in which the library dies at the given place: that of a known bug whose
// program dies there, or one of `seen` that died there, and otherwise one with a minimal program, which is
// added to `seen`. Returns none if the library survives the program, or dies elsewhere. Only programs
// whose outcome is specified are run, about `most` of them.
std::optional<Finding> reduce_death(const gl::Case& program, const Difference& death, const RunAlone& run,
                                    std::vector<Finding>& seen, int most, int max_eval_order);

}  // namespace evalcts::fuzz
