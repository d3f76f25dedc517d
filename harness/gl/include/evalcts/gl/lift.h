// A one-dimensional case made two-dimensional: what it draws stays the same in exact arithmetic.
#pragma once

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// Replaces one for one, so that Refs stay what they are:
// - Map1 by Map2: the curve runs along u, or along v; in the other direction the net is constant, of order 1,
//   2 or 3 in turn, over [0,1];
// - EvalCoord1 by EvalCoord2, the other argument being kAcross;
// - the names of MAP1 targets by those of MAP2 targets and the reverse, wherever one is an argument.
// What has no counterpart (grids, queries of maps) stays as it is.
Case lift(const Case& script, bool along_v);

// The MAP2 target for a MAP1 target; any other token stays as it is.
GLenum in_two_dimensions(GLenum token);

inline constexpr double kAcross = 0.375;

}  // namespace evalcts::gl
