// The frames of short C programs: headers, and a main program that makes a context.
#pragma once

#include <string>

#include <evalcts/gl/c_program.h>

namespace evalcts::gl {

struct CFrame {
  std::string headers;
  std::string main;  // the beginning of the function that makes the calls and the check
};

// Returns the frame of a program in a short style. `kind`: the kind of its context, see contexts.h; 0: as
// usual. `has_errors`: the program needs a GL that reports errors. Throws NoCProgram if the platform's
// libraries do not make such contexts.
CFrame c_frame(const CProgram& program, GLuint kind, bool has_errors);

}  // namespace evalcts::gl
