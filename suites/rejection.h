// Programs of commands that have to be rejected: each raises its error, once, and leaves all state unchanged.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "maps.h"

namespace evalcts {

using Calls = std::function<void(gl::Case&)>;

struct NamedCalls {
  std::string name;
  Calls issue;
};

// Returns the commands of `all` that the implementation has.
template <class T>
std::vector<T> existing_calls(Test& t, const std::vector<T>& all) {
  return existing(t, all, [](gl::Case& c, const T& each) { each.issue(c); });
}

// The commands that define maps and grids and draw meshes, in all forms: none is allowed between Begin and
// End, and outside each has an effect.
std::vector<NamedCalls> forbidden_in_primitives();

// EvalCoord and EvalPoint in all forms, which are allowed between Begin and End.
std::vector<NamedCalls> allowed_in_primitives();

// State that prepare() changes from the initial one: the current values and the nine one-dimensional maps, or
// these and the two-dimensional maps and the grids.
enum class Prepared { kMaps1, kEverything };
// Appends commands that set the state that a rejected command must leave unchanged. Every second
// one-dimensional map is enabled and, with kEverything, the two-dimensional maps of the other kinds.
// `odd_enabled` chooses which half and, with kEverything, enables AUTO_NORMAL.
void prepare(gl::Case& c, Prepared prepared, bool odd_enabled);

// Judges the bad calls, one after the other, in a prepared context: each raises its error, once, and the
// snapshot after the last call is the one before the first. A bad call between Begin and End appends these
// itself.
void judge_rejected(Test& t, const std::string& identity, const std::vector<Calls>& bad_calls,
                    Prepared prepared = Prepared::kEverything);

// --- Bad maps --------------------------------------------------------------------------------------------

// Returns a legal map, of which a test then changes one argument.
Map legal_map(GLenum target);
// Gives the map so many values that a library which reads the points before it rejects the call stays within
// the array, also if it takes the points as packed or exchanges the strides. The values behind the last point
// are there, too (U-TAIL).
Map with_room(Map map);

// The members of Map that belong to one direction.
struct Direction {
  int Map::*order;
  int Map::*stride;
  double Map::*first;
  double Map::*last;
};
inline constexpr Direction kU = {&Map::uorder, &Map::ustride, &Map::u1, &Map::u2};
inline constexpr Direction kV = {&Map::vorder, &Map::vstride, &Map::v1, &Map::v2};
std::vector<Direction> directions(bool two);

Calls defining(const Map& map, bool doubles);

// Returns the calls between Begin(mode) and End, after a Vertex if `after_vertex`.
Calls in_primitive(GLenum mode, bool after_vertex, const Calls& calls);

// The same for definitions of bad maps. If they are one-dimensional, only one-dimensional maps are prepared.
void judge_rejected(Test& t, const std::string& identity, const std::vector<Map>& bad, bool doubles);

}  // namespace evalcts
