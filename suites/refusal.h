// Commands that have to be refused: each raises one of its errors, once, and leaves everything as it was.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "suites/maps.h"

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

}  // namespace evalcts
