// Writes a case as a stand-alone C program, which needs only the Khronos headers (or glevaluator.h) and the
// library under test.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/gl/case.h>
#include <evalcts/gl/check.h>
#include <evalcts/gl/player.h>

namespace evalcts::gl {

// Thrown if there is no C program for this kind of context; the message states the reason.
struct NoCProgram : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct CProgram {
  // The kind of contexts: "osmesa", "egl", "egl-gles2", "provider", "sink", "none" or "production".
  std::string context;
  std::string context_library = {};  // the file that makes the context, if the commands come from `library`
  std::string library;               // the file that was judged; empty for "production"
  std::string library_below = {};    // see Implementation::library_below()
  const Case* script = nullptr;
  const Check* check = nullptr;      // null: the failure is a crash or a hang in the commands
  const Trace* trace = nullptr;      // the recorded answers, for Check::Rule::kUnlike
  std::size_t emitted_vertices = 0;  // when the failure was recorded, for "sink" and "production"
};

// Returns the program. Its exit code is 1 if the check does not hold or the library crashes, 0 if the check
// holds, and 2 if the program cannot start. The macro SECONDS sets its time limit. Throws NoCProgram.
std::string to_c(const CProgram& program);

}  // namespace evalcts::gl
