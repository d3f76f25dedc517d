// Reads and clears the errors of a context. Implemented in player.cpp.
#pragma once

#include <vector>

#include <evalcts/gl/table.h>

namespace evalcts::gl {

// Calls GetError until it returns NO_ERROR, at most 16 times, and returns the errors. Must not be called
// between Begin and End. Returns no errors if the table has no GetError.
std::vector<GLenum> take_errors(const Table& table);

}  // namespace evalcts::gl
