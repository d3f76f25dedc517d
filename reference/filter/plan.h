// Computes the inputs of the kernels for a map exactly: the quantities of PROOF.md.
#pragma once

#include <reference/filter.h>

#include "kernels.h"

namespace evalcts::reference {

// Plans one direction of a valid map. Throws std::invalid_argument if the grid has less than one segment.
// `applies` is false if a grid end is not finite.
DirectionPlan direction_plan(const Direction& direction, const std::optional<Arguments::Grid>& grid);

// Computes the coefficients, M and q. `applies` of the direction u is false if |q| is too large. Both
// directions are planned for coordinates. Throws the exceptions of bernstein.h.
KernelPlan kernel_plan(const Surface& surface);

}  // namespace evalcts::reference
