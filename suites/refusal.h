// Commands that have to be refused: each raises one of its errors, once, and leaves everything as it was.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <type_traits>
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

// State that differs from the initial one before a bad call: the current values and, with every second map
// enabled, the nine one-dimensional maps or all maps and grids.
enum class Prepared { maps1, everything };
// The state that a rejected command must leave unchanged.
void prepare(gl::Case& c, Prepared prepared, bool odd_enabled);

// Plays the bad calls one behind the other in a prepared context. Each raises one of the allowed errors,
// once; after the last everything is as before the first. A bad call that needs Begin brings its End.
void expect_refused(Test& t, const std::string& identity, const std::vector<Calls>& bad_calls,
                    std::initializer_list<GLenum> allowed, Prepared prepared = Prepared::everything);

// --- Bad maps --------------------------------------------------------------------------------------------

// A legal map, to be spoiled by the test. Memory for much more than it needs stands behind it (for order 65
// at any stride used here), so that a library which checks late reads nothing that it must not.
template <class Map>
Map legal_map(GLenum target);
template <>
Map1 legal_map(GLenum target);
template <>
Map2 legal_map(GLenum target);

// A direction of a map: where its parameters lie.
template <class Map>
struct Direction {
  int Map::*order;
  int Map::*stride;
  double Map::*first;
  double Map::*last;
};
inline constexpr Direction<Map1> kU1 = {&Map1::order, &Map1::stride, &Map1::u1, &Map1::u2};
inline constexpr Direction<Map2> kU = {&Map2::uorder, &Map2::ustride, &Map2::u1, &Map2::u2};
inline constexpr Direction<Map2> kV = {&Map2::vorder, &Map2::vstride, &Map2::v1, &Map2::v2};
template <class Map>
std::vector<Direction<Map>> directions() {
  if constexpr (std::is_same_v<Map, Map1>) {
    return {kU1};
  } else {
    return {kU, kV};
  }
}

template <class Map>
Calls defining(const Map& map, bool doubles) {
  return [map, doubles](gl::Case& c) { define(c, map, doubles); };
}

// One bad call, in one dimension among one-dimensional maps only.
template <class Map>
void expect_refused(Test& t, const std::string& identity, const Calls& bad_call,
                    std::initializer_list<GLenum> allowed) {
  expect_refused(t, identity, std::vector{bad_call}, allowed,
                 std::is_same_v<Map, Map1> ? Prepared::maps1 : Prepared::everything);
}
template <class Map>
void expect_refused(Test& t, const std::string& identity, const Map& bad, bool doubles,
                    std::initializer_list<GLenum> allowed) {
  expect_refused<Map>(t, identity, defining(bad, doubles), allowed);
}

}  // namespace evalcts
