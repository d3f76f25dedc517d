// Makes the members of cases about evaluated values (INTERPRETING.md, "Maps" and "Values").
#pragma once

#include <reference/component.h>

#include <optional>

#include "document.h"
#include "maps.h"

namespace evalcts::vectors {

using reference::Argument;

// The GL version (10 * major + minor) whose guaranteed ranges the vectors use. Later versions guarantee the
// same, earlier ones less.
inline constexpr int kNewestVersion = 21;

// A map and its argument. Surfaces have `v`.
struct Problem {
  Map map;
  Type type;
  Argument u;
  std::optional<Argument> v = {};
};

// Return a direction with this domain, and an argument that is not a point of a grid.
Direction along(int order, const Ends& ends = {0, 1});
Argument at(double u);
// Returns u1 + i/parts * (u2 - u1) for a random i from 0 to `parts`, rounded to the type.
double inside(Dice& dice, const Direction& u, Type type, int parts = 32);

// Returns the member "map". Throws std::logic_error if a number is not of the type.
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
