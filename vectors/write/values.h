// Statements of the vectors on evaluated values (INTERPRETING.md, "Maps" and "Values").
#pragma once

#include <reference/component.h>

#include <optional>

#include "document.h"
#include "maps.h"

namespace evalcts::vectors {

using reference::Argument;

// The version of the GL whose promises the vectors take: the newest texts promise more than the oldest.
inline constexpr int kNewestVersion = 21;

// A map and where it is evaluated; `v` for surfaces.
struct Problem {
  Map map;
  Type type;
  Argument u;
  std::optional<Argument> v = {};
};

// The map as it is defined. Throws std::logic_error where a number is not of the type.
Json map_as_json(const Map& map, Type type);
// A hexadecimal number, or an object for a point of a grid.
Json argument_as_json(const Argument& argument);
// Numbers as text.
Json hexadecimals(const Values& values);
Json fractions(const std::vector<Rational>& values);

// {"exact", "magnitude", "float", "double", "accept"} of an evaluated component.
Json entry_of(const reference::Sample& sample);

// Returns true if only GL 2.0 and later promise what `entry_of` accepts: texture coordinates beyond 2^10.
bool needs_gl_2(const reference::Sample& sample);

// More than the components.
enum class Detail { kNone, kIntermediate };

// {"level", "since", "map", "u", "v", "components"}, "quotients" for maps of four vertex coordinates where w
// is not zero, and "intermediate".
Json value_case(const Problem& problem, Detail detail = Detail::kNone);

}  // namespace evalcts::vectors
