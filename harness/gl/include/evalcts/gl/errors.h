// Takes the errors of a context. Defined next to the player.
#pragma once

#include <vector>

#include <evalcts/gl/table.h>

namespace evalcts::gl {

// Takes the errors that GetError returns until it returns NO_ERROR, at most 16. Must not be called between
// Begin and End. Returns none if the table has no GetError.
std::vector<GLenum> take_errors(const Table& table);

}  // namespace evalcts::gl
