// Stores a case as JSON, so that it can be kept and replayed.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// [["Map1f", "GL_MAP1_VERTEX_3", 0.0, 1.0, 3, 2, {"f32": [0.0, 0.5, ...]}], ["EvalCoord1f", 0.25], ...]: a
// command is the name of its entry point without "gl", followed by its arguments. An enumerant with a known
// name is written by name, an array that the command reads as {type: values}, an array that it writes as
// {"out": type, "count": n}, and a null pointer as null. An array that the command reads also has the
// member "after": "overwrite", "unmap" or "protect" if its memory changes after the call (AfterCall), and
// "slot": n if it has a slot. Values that are not finite are "inf", "-inf" and "nan", if that is asked for.
// Throws std::invalid_argument for a case that uses results of earlier commands, arrays of strings, or other
// values that are not finite.
enum class NonFinite { kRejected, kByName };
nlohmann::json to_json(const Case& script, NonFinite non_finite = NonFinite::kRejected);

// Inverse of to_json(). Throws std::invalid_argument, with a message for the user, if the data is not a case.
Case case_from_json(const nlohmann::json& commands);

// Returns the JSON as text. Throws as to_json() does.
std::string to_text(const Case& script, NonFinite non_finite = NonFinite::kRejected);
// Returns the same text, or an empty string if to_text() would throw.
std::string to_text_if_possible(const Case& script);
// Inverse of to_text(). Throws as case_from_json() does, also if the text is not JSON.
Case parse_case(const std::string& text);

}  // namespace evalcts::gl
