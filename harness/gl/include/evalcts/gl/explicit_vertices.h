// A control: a case in which vertices stand where it evaluates.
#pragma once

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// Each EvalCoord and EvalPoint becomes a Vertex3f, each EvalMesh the primitives that GL 1.0 5.1 defines it
// by, of at most 16 vertices in each direction, or nothing between Begin and End; nothing else changes.
Case with_explicit_vertices(const Case& script);

}  // namespace evalcts::gl
