// Writes a case as a C program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <evalcts/gl/case.h>
#include <evalcts/gl/check.h>
#include <evalcts/gl/player.h>

namespace evalcts::gl {

// Thrown if there is no C program for this kind of context; the message states the reason.
struct NoCProgram : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Forms of a C program.
//   kShort    for a bug report: links the platform's EGL and GL, its GL with GLX, or OSMesa. It cannot
//   protect client arrays
//             against accesses, or use several contexts.
//   kFull     loads the library by its name, which may be given as an argument, and catches crashes and
//   hangs;
//             needs only the Khronos headers, or glevaluator.h.
//   kPiglit   a test of piglit.
enum class CStyle { kShort, kFull, kPiglit };
std::optional<CStyle> c_style_named(std::string_view name);  // "short", "full" or "piglit"

struct CProgram {
  CStyle style = CStyle::kFull;
  // The kind of contexts: "osmesa", "egl", "glx-indirect", "egl-gles2", "provider", "sink", "none" or
  // "production".
  std::string context;
  std::string context_library = {};  // the file that makes the context, if the commands come from `library`
  std::string library;               // the file that was judged; empty for "production"
  std::string library_below = {};    // see Implementation::library_below()
  const Case* script = nullptr;
  std::size_t first_own = 0;         // index of the test's first command; a capture's commands are before it,
  std::size_t own = SIZE_MAX;        // and behind this number of commands; SIZE_MAX: all are the test's
  const Check* check = nullptr;      // null: the failure is a crash or a hang in the commands
  const Trace* trace = nullptr;      // the recorded answers, for Check::Rule::kUnlike
  std::size_t emitted_vertices = 0;  // when the failure was recorded, for "sink" and "production"
};

// Returns a program in a short style that consists of these statements and fails if the C expression `fails`
// is true, or if the library crashes in it. `program` has the style, context and library; `kind` is the kind
// of context, see contexts.h, or 0. Throws NoCProgram.
std::string to_c(const CProgram& program, const std::vector<std::string>& statements,
                 const std::string& fails, GLuint kind);

// Returns the program. Its exit code is 1 if the check does not hold, 0 if the check holds, and 2 if the
// program cannot start; in the full style, 1 if the library crashes, and the macro SECONDS sets its time
// limit. A test of piglit returns its result. Throws NoCProgram.
std::string to_c(const CProgram& program);

}  // namespace evalcts::gl
