// Formats the commands of a case as C statements, for failure records and for stand-alone reproducers.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// Return a C constant with exactly this value, as the shortest decimal, such as "0.1f", "-0.0" or "NAN".
std::string c_constant(float value);
std::string c_constant(double value);

// Returns the names of the attribute groups of a mask of PushAttrib ("GL_EVAL_BIT"); empty if a bit has none.
std::vector<const char*> names_of_bits(GLbitfield mask);

// Returns one command, such as "glMap1f(GL_MAP1_INDEX, 0.0f, 1.0f, 1, 2, (GLfloat[]){1.0f, 2.0f});". Arrays
// longer than `most_elements` are cut ("... 96 more"); 0 means no limit.
std::string to_c(const Command& command, std::size_t most_elements = 0);

// Returns the text of the argument at a position, or an empty string for the default text.
using OwnText = std::function<std::string(std::size_t position)>;
// Returns one command as above, with the texts that `own` returns for its arguments.
std::string to_c(const Command& command, const OwnText& own, std::size_t most_elements = 0);

// Returns the elements of a client array, such as "0.0f, 1.0f".
std::string elements_of(const Input& input, std::size_t most_elements = 0);
// Returns a client array as a C expression: a string literal for a printable text, otherwise a compound
// literal such as "(GLfloat[]){0.0f, 1.0f}".
std::string literal_of(const Input& input, std::size_t most_elements = 0);
// Returns the C type of a scalar, such as "GLfloat".
const char* c_type(Scalar type);
// Returns a text as a C string literal.
std::string quoted(const std::string& text);

// Returns the commands first..last (inclusive, clipped to the case) in at most `most_lines` lines. If there
// are more, the number of omitted commands stands for those in the middle.
std::vector<std::string> to_c(const Case& script, int first, int last, std::size_t most_lines = 60,
                              std::size_t most_elements = 64);
// Returns all commands of the case in the same way.
std::vector<std::string> all_calls(const Case& script, std::size_t most_lines = 60,
                                   std::size_t most_elements = 64);

// Returns the lines with repetitions as loops: four or more equal runs of up to six lines.
std::vector<std::string> with_loops(const std::vector<std::string>& lines);
// Returns all commands of the case with repetitions as loops, in at most `most_lines` lines.
std::vector<std::string> program_of(const Case& script, std::size_t most_lines = 40);

}  // namespace evalcts::gl
