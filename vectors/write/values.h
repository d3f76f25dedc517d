// Makes the members of cases about evaluated values (INTERPRETING.md, "Maps" and "Values").
#pragma once

#include "document.h"
#include "problem.h"

namespace evalcts::vectors {

// The GL version (10 * major + minor) whose guaranteed ranges the vectors use. Later versions guarantee the
// same, earlier ones less.
inline constexpr int kNewestVersion = 21;

// Returns the member "map".
Json map_as_json(const Map& map, Type type);
// Returns a hexadecimal number, or an object for a point of a grid.
Json argument_as_json(const Argument& argument);
// Return numbers as texts.
Json hexadecimals(const Values& values);
Json fractions(const std::vector<Rational>& values);

// Returns {"exact", "magnitude", "float", "double", "accept"} of an evaluated component.
Json entry_of(const reference::Sample& sample);

// Returns true if a value has an acceptance interval only from GL 2.0 on: texture coordinates beyond 2^10.
bool needs_gl_2(const reference::Sample& sample);

// Additional members of a case: none, or "intermediate".
enum class Detail { kNone, kIntermediate };

// Returns {"level", "since", "map", "u", "v", "components"}, "quotients" for maps of VERTEX_4 whose w is not
// zero, and "intermediate" if `detail` requests it.
Json value_case(const Problem& problem, Detail detail = Detail::kNone);

}  // namespace evalcts::vectors
