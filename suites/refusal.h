// Commands that have to be refused: each raises one of its errors, once, and leaves everything as it was.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "maps2.h"

namespace evalcts {

using Calls = std::function<void(gl::Case&)>;

struct NamedCalls {
  std::string name;
  Calls issue;
};

// The commands that define maps and grids and draw meshes, in all forms: none may stand between Begin and
// End, each would have an effect outside.
std::vector<NamedCalls> forbidden_in_primitives();

// Plays the bad calls one behind the other in a context where all 18 maps, both grids and the current values
// differ from the initial ones and every second map is enabled. Each raises one of the allowed errors, once;
// after the last everything is as before the first. A bad call that needs Begin brings its End.
void expect_refused(Test& t, const std::string& identity, const std::vector<Calls>& bad_calls,
                    std::initializer_list<GLenum> allowed);

}  // namespace evalcts
