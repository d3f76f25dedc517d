// Controls: a case without evaluators. Explicit commands stand where it evaluates; all commands that define,
// enable or ask for maps and grids, and EVAL_BIT in the masks of PushAttrib, are left out.
#pragma once

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// Returns the case with each EvalCoord and EvalPoint replaced by a Vertex3f, and each EvalMesh replaced by
// the primitives that GL 1.0 5.1 defines it by, of at most 16 vertices in each direction, or by nothing
// between Begin and End.
Case with_explicit_vertices(const Case& script);

// The same, with a PointSize for each command of evaluators that is an error between Begin and End. Tells
// whether any such error disturbs the primitive.
Case with_refused_commands(const Case& script);

// Returns the case with each evaluation replaced by the commands into which many implementations translate
// it: attributes from the enabled maps of its dimension, then a vertex if one of these maps generates
// vertices; and each filled mesh replaced by triangle strips. Enables are followed in the order in which they
// are written, through PushAttrib and PopAttrib, inside display lists as well.
Case with_explicit_commands(const Case& script);

// Returns the case with each EvalCoord and EvalPoint replaced by a CallList of a list that does not exist,
// and each EvalMesh replaced by a primitive of points with such a call in it: commands that also make an
// implementation leave the path of plain vertices while it compiles a list.
Case with_calls_of_no_list(const Case& script);

}  // namespace evalcts::gl
