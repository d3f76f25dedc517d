// Makes excerpts of programs that draw very much and would take too long to reduce. Private to harness/fuzz.
#pragma once

#include <cstdint>

#include <evalcts/gl/case.h>
#include "shrink.h"

namespace evalcts::fuzz {

// Programs with more vertices are first reduced to an excerpt.
inline constexpr std::int64_t kMostVertices = 400;

// Returns the number of vertices that the commands of the program emit. Each command counts once, regardless
// of how often a display list calls it.
std::int64_t vertices_of(const gl::Case& program);

// Returns a part of the program that is interesting. The part has all commands of the program
// except drawings outside of a window of about kMostVertices vertices. Its meshes are then halved as long as
// they are interesting. Returns the whole program if none is interesting of at most 12 windows.
gl::Case excerpt_of(const gl::Case& program, const InterestingnessTest& is_interesting);

}  // namespace evalcts::fuzz
