// Stores a case as JSON, so that it can be kept and replayed.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// [["Map1f", "GL_MAP1_VERTEX_3", 0.0, 1.0, 3, 2, {"f32": [0.0, 0.5, ...]}], ["EvalCoord1f", 0.25], ...]: a
// command is the name of its entry point without "gl" and its arguments; enumerants by name where they have
// one, arrays that are read as {type: values}, those that are written as {"out": type, "count": n}, null
// pointers as null. Throws std::invalid_argument for a case that uses results of earlier commands, arrays of
// strings, or values that are not finite.
nlohmann::json to_json(const Case& script);

// The inverse. Throws std::invalid_argument, with words, where the data is none of these.
Case case_from_json(const nlohmann::json& commands);

// The same as text.
std::string to_text(const Case& script);
// Empty where to_text() throws.
std::string to_text_if_possible(const Case& script);
Case parse_case(const std::string& text);

}  // namespace evalcts::gl
