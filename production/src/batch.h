// Evaluation of batches, after their arguments have been checked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernels.h"
#include "outputs.h"
#include "plan.h"

namespace glev {

// Returns the bytes of scratch memory, of any alignment, that a mesh of `columns` columns needs.
std::size_t scratch_of(const glev_plan& plan, std::size_t columns);

// Evaluates the plan at `count` arguments. `v` is null for curves. `fast`: with GLEV_FAST.
void evaluate_arguments(const glev_plan& plan, const Input& u, const Input* v, std::size_t count, bool fast,
                        const Outputs& outputs);

void evaluate_range(const glev_plan& plan, const MeshRange& range, bool fast, const Outputs& outputs,
                    std::byte* scratch);

}  // namespace glev
