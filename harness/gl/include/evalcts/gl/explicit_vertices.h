// Controls: a case without evaluators. Explicit commands stand where it evaluates, and EVAL_BIT is missing in
// the masks of PushAttrib.
#pragma once

#include <optional>

#include <evalcts/gl/case.h>

namespace evalcts::gl {

// Commands that define, enable or ask for maps and grids, and meshes between Begin and End, are left out. If
// `idle` names a capability, Enable or Disable of it stands in the place of each, in turn: it has no effect
// on vertices, but tells whether any change of state, or any error between Begin and End, disturbs the
// primitives. It is chosen by the caller, because no capability is known to every layer.
using IdleCapability = std::optional<GLenum>;

// Returns the case with each EvalCoord and EvalPoint replaced by a Vertex3f, and each EvalMesh outside of
// Begin and End by the primitives that GL 1.0 5.1 defines it by, of at most 16 vertices in each direction.
Case with_explicit_vertices(const Case& script, IdleCapability idle = {});

// Returns the case with each evaluation replaced by the commands into which many implementations translate
// it: attributes from the enabled maps of its dimension, then a vertex if one of these maps generates
// vertices; and each filled mesh replaced by triangle strips. Enables are followed in the order in which they
// are written, through PushAttrib and PopAttrib, inside display lists as well.
Case with_explicit_commands(const Case& script, IdleCapability idle = {});

// Returns the case with each EvalCoord and EvalPoint replaced by a CallList of a list that does not exist,
// and each EvalMesh replaced by a primitive of points with such a call in it: commands that also make an
// implementation leave the path of plain vertices while it compiles a list. Other commands of evaluators are
// left out.
Case with_calls_of_no_list(const Case& script);

}  // namespace evalcts::gl
