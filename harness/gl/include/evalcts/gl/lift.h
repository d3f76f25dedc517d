// Rewrites a one-dimensional case in two dimensions. In exact arithmetic, both draw the same.
#pragma once

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// Replaces each command by one command, so that Refs stay valid:
// - Map1 by Map2: the curve runs along u, or along v if `along_v`; in the other direction, the control points
//   are constant, over [0,1], with order 1, 2, 3, 1, ... for successive maps;
// - EvalCoord1 by EvalCoord2, with kAcross as the other argument;
// - in Enable, Disable and IsEnabled, MAP1 targets by MAP2 targets and the reverse.
// Commands without a counterpart (grids, queries of maps) are not changed.
Case lift(const Case& script, bool along_v);

// Returns the MAP2 target for a MAP1 target, and any other token unchanged.
GLenum in_two_dimensions(GLenum token);

inline constexpr double kAcross = 0.375;

}  // namespace evalcts::gl
