// Converts random cases to lines of text.
#pragma once

#include <string>

#include "random_cases.h"

namespace evalcts::vectors {

// Returns the case that was drawn last as a line with a newline.
std::string question(const RandomCases& cases);

}  // namespace evalcts::vectors
