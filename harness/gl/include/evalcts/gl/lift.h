// Rewrites a one-dimensional case in two dimensions. Its drawing stays the same in exact arithmetic.
#pragma once

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// Replaces each command by one command, so that Refs stay valid:
// - Map1 by Map2: the curve runs along u, or along v; in the other direction the net is constant, of order 1,
//   2 or 3 in turn, over [0,1];
// - EvalCoord1 by EvalCoord2, the other argument being kAcross;
// - the names of MAP1 targets by those of MAP2 targets and the reverse, wherever one is an argument.
// Commands without a counterpart (grids, queries of maps) are not changed.
Case lift(const Case& script, bool along_v);

// Returns the MAP2 target for a MAP1 target, and any other token unchanged.
GLenum in_two_dimensions(GLenum token);

inline constexpr double kAcross = 0.375;

}  // namespace evalcts::gl
