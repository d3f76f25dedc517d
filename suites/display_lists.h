// Helpers of the tests of display lists (display_lists.cpp, display_list_errors.cpp, display_list_state.cpp).
#pragma once

#include <vector>

#include "grid_cases.h"
#include "refusal.h"

namespace evalcts::suite_display_lists {

inline constexpr GLuint kList = 3, kOther = 4, kThird = 5;

void compile(gl::Case& c, GLuint list, const Calls& calls, GLenum mode = GL_COMPILE);

// Commands that change state, away from the initial one.
using Setting = NamedCalls;
std::vector<Setting> settings();
// So that Disable has something to do.
void prepare_for(gl::Case& c, const Setting& setting);

// Three points by EvalCoord, three by EvalPoint.
void evaluate_and_eval_points(gl::Case& c, bool two);
void mesh_of_points(gl::Case& c, bool two);
// Compiles both.
void compile_points(gl::Case& c, GLuint list, bool two, GLenum mode = GL_COMPILE);
void set_grid(gl::Case& c, bool two, const Grid& u = {4, -0.5f, 2.0f});
// The maps of enable_maps, and a grid.
gl::Case with_maps(Test& t, const std::string& identity, bool two, const Grid& u = {4, -0.5f, 2.0f});
// Other points for the vertex map of enable_maps.
void define_vertices(Test& t, gl::Case& c, bool two);

}  // namespace evalcts::suite_display_lists
