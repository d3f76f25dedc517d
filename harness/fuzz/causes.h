// The words that tell causes of differences from each other. Private to harness/fuzz.
#pragma once

#include <set>
#include <string>

#include <evalcts/gl/case.h>

namespace evalcts::fuzz {

// "position.x of vertex 3" -> "position". Vertices too many or too few show in their number where all are
// points, else in the primitives.
inline constexpr char kPrimitives[] = "primitives";
std::string kind_of(const std::string& what);

// The words of a cause that the commands of the program give it: see Finding::cause.
std::set<std::string> words_of(const gl::Case& program);
// The program without the commands that give the cause this word.
gl::Case without_word(const gl::Case& program, const std::string& word);

// The commands of the program that the executable specification has, without those that enable or ask for
// state that it does not have. Throws std::invalid_argument for a case
// of several contexts.
gl::Case commands_of_specification(const gl::Case& script);

}  // namespace evalcts::fuzz
