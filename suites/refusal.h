// Commands that have to be rejected: each raises one of its errors, once, and leaves everything as it was.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "maps.h"

namespace evalcts {

using Calls = std::function<void(gl::Case&)>;

struct NamedCalls {
  std::string name;
  Calls issue;
};

// The commands that define maps and grids and draw meshes, in all forms: none may stand between Begin and
// End, each would have an effect outside.
std::vector<NamedCalls> forbidden_in_primitives();

// The commands that evaluate, in all forms: they may stand there.
std::vector<NamedCalls> allowed_in_primitives();

// State that differs from the initial one before a bad call: the current values and, with every second map
// enabled, the nine one-dimensional maps or all maps and grids.
enum class Prepared { kMaps1, kEverything };
// The state that a rejected command must leave unchanged.
void prepare(gl::Case& c, Prepared prepared, bool odd_enabled);

// Runs the bad calls one behind the other in a prepared context. Each raises one of the allowed errors,
// once; after the last everything is as before the first. A bad call that needs Begin brings its End.
void expect_refused(Test& t, const std::string& identity, const std::vector<Calls>& bad_calls,
                    std::initializer_list<GLenum> allowed, Prepared prepared = Prepared::kEverything);

// Checks the error of a query between Begin and End. Where it raises none, `other`, a query of state that is
// not the evaluators', is run in its place: if that raises none either, the queries of the library are at
// fault, and NotObservable is thrown.
void expect_error_of_query(Test& t, Played& played, gl::Ref error, const Calls& other);

// --- Bad maps --------------------------------------------------------------------------------------------

// A legal map, to be spoiled by the test. Memory for much more than it needs stands behind it (for order 65
// at any stride used here), so that a library which checks late reads nothing that it must not.
Map legal_map(GLenum target);

// A direction of a map: where its parameters lie.
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

// The calls between Begin and End, first or after a vertex.
Calls in_primitive(GLenum mode, bool after_vertex, const Calls& calls);

// One bad call; of a map of one dimension, among one-dimensional maps only.
void expect_refused(Test& t, const std::string& identity, const Map& bad, bool doubles,
                    std::initializer_list<GLenum> allowed);

}  // namespace evalcts
