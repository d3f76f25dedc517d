// Computes the inputs of the kernels for a map exactly: the quantities of PROOF.md.
#pragma once

#include <reference/filter.h>

#include "kernels.h"

namespace evalcts::reference {

// Returns the nearest double, and the nearest double of the remainder.
DoubleDouble to_double_double(const Rational& x);

// Plans one direction. Throws std::domain_error if the domain is empty or an end not finite,
// std::invalid_argument if the grid has less than one segment. `applies` is false if a grid end is not
// finite.
DirectionPlan direction_plan(int order, double first, double last,
                             const std::optional<Arguments::Grid>& grid);

// Computes the coefficients, M and q. `applies` of the direction u is false if |q| is too large. Both
// directions are planned for coordinates.
KernelPlan kernel_plan(const Surface& surface);

}  // namespace evalcts::reference
