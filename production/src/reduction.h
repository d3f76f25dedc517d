// Degree reduction: a degree-elevated line is a line.
#pragma once

#include <array>

#include "exact.h"

namespace glev {

// Writes the control points of the same polynomial at the lowest orders that have doubles as control points,
// v fastest, to `reduced`, which has room for order[0] * order[1], and returns the orders: those of the
// component, with its points, if there are none lower. Exact, or not at all. Zeros of a direction that is
// reduced become +0.
//
// The directions take turns, v first, until neither goes down. What would need numbers of more than 448 bits
// stays as it is: rows or columns with points that are more than 320 binades apart, which floats never are.
// Data without structure is recognised after the first row and column.
std::array<int, 2> reduce(const Component& component, double* reduced);

}  // namespace glev
