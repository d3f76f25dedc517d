// Which programs say something: those whose outcome the specification defines.
#pragma once

#include "harness/gl/case.h"

namespace evalcts::fuzz {

// Whether the specification says all of what the program, made of commands that the executable specification
// has, does: vertices come between Begin and End only (U-OUTSIDE-VERTEX), no primitive and no list stays
// open, each error has one possible code (U-WHICH-ERROR) and is asked for before the next one is raised (an
// implementation may keep several).
bool is_defined(const gl::Case& program, int max_eval_order);

}  // namespace evalcts::fuzz
