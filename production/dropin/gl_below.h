// The GL below: the GL that is loaded and to which the drop-in library passes commands.
#pragma once

#include <GL/gl.h>
#include <GL/glext.h>

#include "setters.h"

namespace glev::dropin {

// The GL commands that this library issues or passes on, except those of setters.h.
// clang-format off
#define DROPIN_EVALUATORS(X)                                                                \
  X(Map1f) X(Map1d) X(Map2f) X(Map2d) X(MapGrid1f) X(MapGrid1d) X(MapGrid2f) X(MapGrid2d)   \
  X(EvalCoord1f) X(EvalCoord1d) X(EvalCoord1fv) X(EvalCoord1dv)                             \
  X(EvalCoord2f) X(EvalCoord2d) X(EvalCoord2fv) X(EvalCoord2dv)                             \
  X(EvalPoint1) X(EvalPoint2) X(EvalMesh1) X(EvalMesh2)                                     \
  X(GetMapfv) X(GetMapdv) X(GetMapiv) X(GetnMapfv) X(GetnMapdv) X(GetnMapiv)
#define DROPIN_COMMANDS(X)                                                                  \
  X(Begin) X(End) X(Vertex3fv) X(Vertex4fv)                                                 \
  X(Enable) X(Disable) X(IsEnabled)                                                         \
  X(GetBooleanv) X(GetIntegerv) X(GetInteger64v) X(GetFloatv) X(GetDoublev)                 \
  X(GetError) X(GetString) X(GetStringi) X(ActiveTexture)                                   \
  X(PushAttrib) X(PopAttrib)                                                                \
  X(NewList) X(EndList) X(CallList) X(CallLists) X(ListBase)                                \
  X(GenLists) X(IsList) X(DeleteLists)                                                      \
  X(GetAttachedShaders) X(GetShaderiv) X(GetProgramPipelineiv)
// clang-format on

// The commands of the GL below. A pointer is null if the GL does not have the command.
struct GlBelow {
#define X(name) decltype(&::gl##name) name;
  DROPIN_EVALUATORS(X)
  DROPIN_COMMANDS(X)
#undef X
#define X(attribute, command, n, most, letter, type) \
  decltype(&::gl##command##n##letter##v) command##n##letter##v;
  DROPIN_SETTERS(X)
  DROPIN_UNIT_SETTERS(X)
#undef X
#define X(attribute, command) decltype(&::gl##command) command;
  DROPIN_PACKED_SETTERS(X)
#undef X
#define X(command) decltype(&::gl##command) command;
  DROPIN_PACKED_UNIT_SETTERS(X)
#undef X
};

// Returns the commands. The first call finds them, and aborts the program with a message if there is no GL.
const GlBelow& gl_below();

// Returns a symbol of the library that GLEVALUATOR_GL names or, if it is not set, of the next loaded library
// that exports the symbol. Returns null if there is none.
void* find_below(const char* symbol);

}  // namespace glev::dropin
