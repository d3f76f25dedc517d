// Defines the words that distinguish causes of differences. Private to harness/fuzz.
#pragma once

#include <set>
#include <string>

#include <evalcts/gl/case.h>

namespace evalcts::fuzz {

inline constexpr char kPrimitives[] = "primitives";
inline constexpr char kOrder[] = "order";  // of the points, lines or quads of a mesh
// Returns the kind of a difference, "position" for "position.x of vertex 3". A wrong number of vertices is of
// the kind kPrimitives.
std::string kind_of(const std::string& what);
// Returns the outcomes in which a difference of this kind shows.
Outcomes outcomes_of(const std::string& kind);

// Returns the words of the program's commands in a cause, see Finding::cause.
std::set<std::string> words_of(const gl::Case& program);
// Returns the program without the commands that have this word.
gl::Case without_word(const gl::Case& program, const std::string& word);

}  // namespace evalcts::fuzz
