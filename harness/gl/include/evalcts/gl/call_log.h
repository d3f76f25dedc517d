// The commands of a case as C statements: for failure records and for stand-alone reproducers.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// "0x1.8p-1f", "-0.0", "NAN", ...: a C constant that reads back as the same value.
std::string c_constant(float value);
std::string c_constant(double value);

// One command, e.g. "glMap1f(GL_MAP1_INDEX, 0x0p+0f, 0x1p+0f, 1, 2, (GLfloat[]){0x1p+0f, 0x1p+1f});".
// Arrays longer than `most_elements` are cut ("... 96 more"); 0 means no limit.
std::string to_c(const Command& command, std::size_t most_elements = 0);

// The same with some arguments in words of the caller: `own` gets an argument's position and answers its
// text, or nothing for the usual one.
using OwnText = std::function<std::string(std::size_t position)>;
std::string to_c(const Command& command, const OwnText& own, std::size_t most_elements = 0);

// The elements of a client array: "0x0p+0f, 0x1p+0f".
std::string elements_of(const Input& input, std::size_t most_elements = 0);
// "GLfloat"
const char* c_type(Scalar type);
// A C string literal.
std::string quoted(const std::string& text);

// The commands first..last (inclusive, clipped), at most `most_lines` lines: a long middle is left out and
// counted.
std::vector<std::string> to_c(const Case& script, int first, int last, std::size_t most_lines = 60,
                              std::size_t most_elements = 64);
// The same for all commands.
std::vector<std::string> all_calls(const Case& script, std::size_t most_lines = 60,
                                   std::size_t most_elements = 64);

}  // namespace evalcts::gl
