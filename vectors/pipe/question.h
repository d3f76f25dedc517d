// A random case as a line of text.
#pragma once

#include <string>

#include "random_cases.h"

namespace evalcts::vectors {

// Returns the case that was drawn last, with the end of the line.
std::string question(const RandomCases& cases);

}  // namespace evalcts::vectors
