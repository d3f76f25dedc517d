// A control: a case in which vertices stand where it evaluates.
#pragma once

#include "harness/gl/case.h"

namespace evalcts::gl {

// Each EvalCoord and EvalPoint becomes a Vertex3f, each EvalMesh a primitive of two of them, or nothing
// between Begin and End; nothing else changes.
Case with_explicit_vertices(const Case& script);

}  // namespace evalcts::gl
