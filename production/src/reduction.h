// Exact degree reduction, for example of a degree-elevated line to a line.
#pragma once

#include <array>

#include "exact.h"

namespace glev {

// Writes the control points of the same polynomial at the lowest orders whose control points are doubles, v
// fastest, to `reduced`, which must have room for order[0] * order[1] values. Returns the orders, which are
// those of the component if no reduction is possible. The reduction is exact. Zeros of a reduced direction
// become +0.
//
// The directions are reduced alternately, v first, until no order decreases. Rows or columns whose points are
// more than 320 binades apart (never floats) are not reduced, because they would need numbers of more than
// 448 bits. Irreducible data is detected in the first row and column.
std::array<int, 2> reduce(const Component& component, double* reduced);

}  // namespace glev
