// Roles of entry points, by which programs are analysed regardless of the forms of their commands.
#pragma once

#include <string>

#include <evalcts/gl/case.h>

namespace evalcts::gl {

enum class Role {
  kMap,           // Map1, Map2
  kMapGrid,       // MapGrid1, MapGrid2
  kEvalCoord,     // EvalCoord1, EvalCoord2
  kEvalPoint,     // EvalPoint1, EvalPoint2
  kEvalMesh,      // EvalMesh1, EvalMesh2
  kGetMap,        // GetMap, GetnMap
  kGet,           // GetBooleanv, GetIntegerv, GetFloatv, GetDoublev
  kVertex,        // Vertex
  kCurrentValue,  // Color, Normal, TexCoord, MultiTexCoord, Index, EdgeFlag
  kOther
};
Role role_of(EntryPoint entry);

// Returns true for EvalCoord, EvalPoint and EvalMesh.
bool is_evaluation(EntryPoint entry);
// Returns true for EvalCoord, EvalPoint and Vertex, each of which emits one vertex between Begin and End.
bool emits_vertex(EntryPoint entry);

// Returns true for commands that ask: GetError, GetMap, GetnMap, Get..., IsEnabled, IsList.
bool asks(EntryPoint entry);

// Returns the name without the form of its arguments: "Map1" for glMap1fv, "Vertex" for glVertex3f, "Get" for
// glGetFloatv, "PushAttrib" for glPushAttrib.
std::string stem_of(EntryPoint entry);
// Returns the stem without the dimension: "Map" for glMap2d.
std::string stem_without_dimension(EntryPoint entry);
// Returns the dimension, 1 or 2, of a command of evaluators; 0 for other commands.
int dimension_of(EntryPoint entry);

// Returns the rules on strides, orders and domains that a Map command for a target of its dimension breaks:
// "stride too small, order below 1". Empty if it breaks none, and for other commands.
std::string broken_map_rules(const Command& command, int max_order);

// Returns an integer argument; 0 if the argument is missing or is not an integer.
std::int64_t integer_of(const Command& command, std::size_t argument);

}  // namespace evalcts::gl
