// Random legal commands of evaluators and around them: a past for the commands under test.
#pragma once

#include <random>

#include "harness/gl/case.h"

namespace evalcts {

// Appends about `count` commands that the executable specification knows, whatever state the case has reached
// outside Begin and End: maps of all targets in both forms, grids, enables, current values, evaluation in all
// ways (drawing points only), queries, display lists, saved and restored state, commands that are refused and
// asked for their error. At the end no list is open, the attribute stack is as before, texture unit 0 is
// active and no error is left.
void add_random_commands(gl::Case& c, std::mt19937& random, int count);

}  // namespace evalcts
