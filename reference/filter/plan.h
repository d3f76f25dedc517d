// What the kernels have to know of a map, computed exactly: the quantities of PROOF.md.
#pragma once

#include <reference/filter.h>

#include "kernels.h"

namespace evalcts::reference {

// The nearest double, and the nearest double of what is left.
DoubleDouble to_double_double(const Rational& x);

// Throws std::domain_error if the domain is empty or an end not finite, std::invalid_argument if the grid has
// less than one segment. A grid whose ends are not finite does not apply.
DirectionPlan direction_plan(int order, double first, double last,
                             const std::optional<Arguments::Grid>& grid);

// The coefficients, M and q; `applies` of one of the directions becomes false where q is too large. Both
// directions are as for coordinates.
KernelPlan kernel_plan(const Surface& surface);

}  // namespace evalcts::reference
