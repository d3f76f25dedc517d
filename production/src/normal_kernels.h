// Automatic normals of whole meshes, for each instruction set.
#pragma once

#include <cstddef>

#include "production/src/kernels.h"
#include "production/src/plan.h"

namespace glev {

// Normals of a plan that has automatic ones, with the bits of NormalRow. Of a VERTEX_3 map also the vertices,
// the correctly rounded ones, if `with_vertices` says so: each lies right before its normal. `to` is of
// floats. scratch: NormalMeshScratch bytes, aligned to a cache line. In the default environment.
using NormalMesh = void (*)(const glev_plan& plan, const MeshRange& range, const Destination& to,
                            bool with_vertices, std::byte* scratch);

// That of the same instruction set; null if there is none.
NormalMesh NormalMeshOf(const Kernels& kernels);

// Bytes for so many columns of a vertex map of so high a degree in u.
std::size_t NormalMeshScratch(int degree, std::size_t columns);

}  // namespace glev
