// Legal programs: those whose outcome the specification defines.
#pragma once

#include <optional>

#include <evalcts/judge/prediction.h>

namespace evalcts::fuzz {

// Returns the outcome of a program made of commands that the executable specification has; none if the
// specification does not define all of it: vertices have to come between Begin and End only
// (U-OUTSIDE-VERTEX), no primitive and no list stays open, each error has one possible code (U-WHICH-ERROR)
// and is asked for before the next one is raised (an implementation may keep several).
std::optional<Specified> specify_if_defined(const gl::Case& program, int max_eval_order);

// Returns the program with a GetError behind each command that raises an error and is followed by none:
// errors of lists that are called twice come before they are asked for. Commands that raise errors inside
// Begin and End leave the program undefined still.
gl::Case with_errors_asked_for(const gl::Case& program, int max_eval_order);

}  // namespace evalcts::fuzz
