// Drawings and settings that the tests of display lists compile (display_lists.cpp, display_list_errors.cpp,
// display_list_state.cpp).
#pragma once

#include <vector>

#include "grid_cases.h"
#include "rejection.h"

namespace evalcts::suite_display_lists {

inline constexpr GLuint kList = 3, kOther = 4, kThird = 5;

void compile(gl::Case& c, GLuint list, const Calls& calls, GLenum mode = GL_COMPILE);

// Commands that change evaluator state from its initial value.
using Setting = NamedCalls;
std::vector<Setting> settings();
// Enables all capabilities before the setting "Disable", so that it changes something.
void prepare_for(gl::Case& c, const Setting& setting);

// Draws three points by EvalCoord and three by EvalPoint.
void evaluate_and_eval_points(gl::Case& c, bool two);
void mesh_of_points(gl::Case& c, bool two);
// Compiles the commands of both functions above into the list.
void compile_points(gl::Case& c, GLuint list, bool two, GLenum mode = GL_COMPILE);
void set_grid(gl::Case& c, bool two, const Grid& u = {4, -0.5f, 2.0f});
// Returns a case that begins with enable_maps() and set_grid().
gl::Case with_maps(Test& t, const std::string& identity, bool two, const Grid& u = {4, -0.5f, 2.0f});
// Defines a new random map of VERTEX_3.
void define_vertices(Test& t, gl::Case& c, bool two);

}  // namespace evalcts::suite_display_lists
