// Builds and runs the short C programs of bug reports.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <evalcts/results/known_bugs.h>
#include <evalcts/runner/child_process.h>

namespace evalcts::cli {

// Returns the value of an option of the suite program; empty if it is not given.
std::string value_of(const std::vector<std::string>& options, const std::string& option);

// Returns the example of a known bug as a C program for the implementation that the options of the suite
// program choose. `style`: "short" or "piglit". Throws gl::NoCProgram if the implementation cannot be linked.
std::string example_program(const KnownBug& bug, const std::vector<std::string>& options,
                            const std::string& style);

// Returns a shell line that compiles the C file `source` to `program` and runs it, with the implementation
// that the options of the suite program choose. `text`: the C program.
std::string compile_line(const std::vector<std::string>& options, const std::string& text,
                         const std::string& source, const std::string& program);

// The end of a C program that was compiled and run.
struct ProgramRun {
  // The error of the compiler, or the reason why the Mesa of --mesa-build was not used; empty: it was run.
  std::string not_built;
  std::optional<Ending> ending;  // none: it ran for more than 10 seconds
  std::string output;

  bool hangs() const { return not_built.empty() && !ending; }
  bool crashes() const;
};
// Builds and runs a C program with the implementation that the options of the suite program choose. With
// --mesa-build, it sets the environment of this process, see use_mesa_build().
ProgramRun build_and_run(const std::vector<std::string>& options, const std::string& text);

}  // namespace evalcts::cli
