// Correct rounding where double cannot tell.
#pragma once

#include "parameter.h"
#include "prepared_map.h"

namespace glev {

// Component k of the map at (u, v): V rounded to nearest, ties to even; +0 for 0. Tries double
// where it is exact, straight lines, exactly, then double-double, and exact integers. For what is not finite,
// whatever double gives.
float resolve(const PreparedMap& map, int k, const GridArgument& u, const GridArgument& v);
// The same where a value in double with its bound, perhaps infinite, is known and may decide already.
float resolve(const PreparedMap& map, int k, const GridArgument& u, const GridArgument& v, double value,
              double error);

// In double, by double-double or, where that claims nothing, exactly: GLEV_DOUBLE of glevaluator.h.
double resolve_in_double(const PreparedMap& map, int k, const GridArgument& u, const GridArgument& v);

// The derivative by u (direction 0) or v (1), likewise. False where double-double claims nothing.
bool resolve_derivative_in_double(const PreparedMap& map, int direction, int k, const GridArgument& u,
                                  const GridArgument& v, double* result);

}  // namespace glev
