// Makes controls: cases in which explicit commands replace evaluation, and EVAL_BIT is removed from the masks
// of PushAttrib.
#pragma once

#include <optional>

#include <evalcts/gl/case.h>
#include <evalcts/gl/table.h>

namespace evalcts::gl {

// A capability without effect on vertices. All functions below leave out commands that define, enable
// or query maps and grids, and meshes between Begin and End. If a capability is given, Enable and
// Disable of it, in turn, replace these commands, to show if any change of state, or any error between
// Begin and End, disturbs the primitives. The caller chooses the capability, because no capability is
// supported by every layer.
using IdleCapability = std::optional<GLenum>;
// Returns the first capability without effect on vertices that the library accepts; none if it accepts none.
// With the initial LogicOp and PolygonOffset, these capabilities have no effect at all.
IdleCapability find_idle_capability(const Table& table);

// Returns the case with each EvalCoord and EvalPoint replaced by a Vertex3f, and each EvalMesh outside of
// Begin and End by the primitives of its definition (GL 1.0 5.1), with at most 16 vertices in each direction.
Case with_explicit_vertices(const Case& script, IdleCapability idle = {});

// The form of the commands. kScalars: Color4f and so on, for each evaluation. kArray: Color4fv, and nothing
// for an evaluation or a mesh that generates no vertices, as libraries in front of a GL do. In a defective
// pipeline, only one of them may work.
enum class Arguments { kScalars, kArray };

// Returns the case with each evaluation replaced by the commands into which many implementations translate
// it: the attributes that the enabled maps of its dimension generate, then a vertex if one of these maps
// generates vertices. Each filled mesh is replaced by triangle strips. The enabled maps follow from Enable,
// Disable, PushAttrib and PopAttrib in the order in which they are written, inside display lists as well.
Case with_explicit_commands(const Case& script, IdleCapability idle = {},
                            Arguments arguments = Arguments::kScalars);

// Returns the case with each EvalCoord and EvalPoint replaced by a CallList of a list that does not exist,
// and each EvalMesh replaced by a POINTS primitive that contains such a call. These commands, like
// evaluation, make some implementations leave their fast path for vertices while they compile a list.
Case with_calls_of_no_list(const Case& script);

// Returns all these controls of the case; the last one only if the case uses display lists.
std::vector<Case> controls_without_evaluators(const Case& script);

}  // namespace evalcts::gl
