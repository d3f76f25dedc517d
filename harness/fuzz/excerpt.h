// Excerpts of programs that draw very much, which take too long to be reduced as a whole. Private to
// harness/fuzz.
#pragma once

#include <cstdint>
#include <functional>

#include <evalcts/gl/case.h>

namespace evalcts::fuzz {

// Programs with more vertices are reduced to an excerpt first.
inline constexpr std::int64_t kMostVertices = 400;

// Number of vertices that the commands of the program stand for: each command counts once, however often a
// display list with it is called.
std::int64_t vertices_of(const gl::Case& program);

// Returns a part of the program for which `still` holds, as it may do for the program: state and other
// commands are kept, and drawings are removed until few vertices are left. The largest meshes that are left
// are halved as long as `still` holds. Returns the program itself if `still` holds for none of a few such
// parts.
gl::Case excerpt_of(const gl::Case& program, const std::function<bool(const gl::Case&)>& still);

}  // namespace evalcts::fuzz
