// Determines legal programs, whose outcome the specification defines.
#pragma once

#include <optional>

#include <evalcts/judge/prediction.h>

namespace evalcts::fuzz {

// Returns the outcome of a program, whose commands the executable specification must support. Returns none
// unless the specification defines the whole outcome: vertices are only between Begin and End
// (U-OUTSIDE-VERTEX), no primitive or list stays open, and GetError follows each error before the next one is
// raised (an implementation may keep several).
std::optional<Specified> specify_if_defined(const gl::Case& program, int max_eval_order);

// Returns the program with GetError added after each command that raises an error, unless it already follows.
// The result may still be undefined: a list may raise several errors, and GetError is not allowed between
// Begin and End.
gl::Case with_errors_asked_for(const gl::Case& program, int max_eval_order);

}  // namespace evalcts::fuzz
