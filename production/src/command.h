// The commands that a display list can hold, without the form of their arguments (f, d, v): what is stored of
// each, and the method of the context that it is.
#pragma once

#include <array>

#include <glevaluator.h>

#include "context.h"
#include "display_list.h"

namespace glev {

// What a command with wrong arguments or a null pointer leaves in a list.
struct ErrorCommand {
  static constexpr Opcode kOpcode = Opcode::kError;
  glev_enum error;
  void Run(glev_context& gl) const { gl.RecordError(error); }
};

// In a list the control points follow, packed. The target is right and so are the arguments.
struct DefineMapCommand {
  static constexpr Opcode kOpcode = Opcode::kDefineMap;
  int dimension;
  glev_enum target;
  std::array<MapDirection, 2> directions;
  void Run(glev_context& gl, const void* points) const {
    gl.DefineMap(dimension, target, directions, static_cast<const double*>(points));
  }
};

struct SetEnabledCommand {
  static constexpr Opcode kOpcode = Opcode::kSetEnabled;
  glev_enum cap;
  bool enabled;
  void Run(glev_context& gl) const { gl.SetEnabled(cap, enabled); }
};

struct SetGridCommand {
  static constexpr Opcode kOpcode = Opcode::kSetGrid;
  int dimension;
  std::array<Grid, 2> grid;
  void Run(glev_context& gl) const { gl.SetGrid(dimension, grid); }
};

struct EvalCoordCommand {
  static constexpr Opcode kOpcode = Opcode::kEvalCoord;
  int dimension;
  double u, v;
  void Run(glev_context& gl) const { gl.EvalCoord(dimension, u, v); }
};

struct EvalPointCommand {
  static constexpr Opcode kOpcode = Opcode::kEvalPoint;
  int dimension;
  glev_int i, j;
  void Run(glev_context& gl) const { gl.EvalPoint(dimension, i, j); }
};

struct EvalMesh1Command {
  static constexpr Opcode kOpcode = Opcode::kEvalMesh1;
  glev_enum mode;
  glev_int i1, i2;
  void Run(glev_context& gl) const { gl.EvalMesh1(mode, i1, i2); }
};

struct EvalMesh2Command {
  static constexpr Opcode kOpcode = Opcode::kEvalMesh2;
  glev_enum mode;
  glev_int i1, i2, j1, j2;
  void Run(glev_context& gl) const { gl.EvalMesh2(mode, i1, i2, j1, j2); }
};

struct BeginCommand {
  static constexpr Opcode kOpcode = Opcode::kBegin;
  glev_enum mode;
  void Run(glev_context& gl) const { gl.Begin(mode); }
};

struct EndCommand {
  static constexpr Opcode kOpcode = Opcode::kEnd;
  void Run(glev_context& gl) const { gl.End(); }
};

struct VertexCommand {
  static constexpr Opcode kOpcode = Opcode::kVertex;
  std::array<float, 4> position;
  void Run(glev_context& gl) const { gl.Vertex(position); }
};

struct ColorCommand {
  static constexpr Opcode kOpcode = Opcode::kColor;
  std::array<float, 4> color;
  void Run(glev_context& gl) const { gl.Color(color); }
};

struct NormalCommand {
  static constexpr Opcode kOpcode = Opcode::kNormal;
  std::array<float, 3> normal;
  void Run(glev_context& gl) const { gl.Normal(normal); }
};

struct IndexCommand {
  static constexpr Opcode kOpcode = Opcode::kIndex;
  float index;
  void Run(glev_context& gl) const { gl.Index(index); }
};

struct EdgeFlagCommand {
  static constexpr Opcode kOpcode = Opcode::kEdgeFlag;
  bool flag;
  void Run(glev_context& gl) const { gl.EdgeFlag(flag); }
};

struct MultiTexCoordCommand {
  static constexpr Opcode kOpcode = Opcode::kMultiTexCoord;
  glev_enum texture;
  std::array<float, 4> texcoord;
  void Run(glev_context& gl) const { gl.MultiTexCoord(texture, texcoord); }
};

struct ActiveTextureCommand {
  static constexpr Opcode kOpcode = Opcode::kActiveTexture;
  glev_enum texture;
  void Run(glev_context& gl) const { gl.ActiveTexture(texture); }
};

struct PushAttribCommand {
  static constexpr Opcode kOpcode = Opcode::kPushAttrib;
  glev_bitfield mask;
  void Run(glev_context& gl) const { gl.PushAttrib(mask); }
};

struct PopAttribCommand {
  static constexpr Opcode kOpcode = Opcode::kPopAttrib;
  void Run(glev_context& gl) const { gl.PopAttrib(); }
};

struct CallListCommand {
  static constexpr Opcode kOpcode = Opcode::kCallList;
  glev_uint list;
  void Run(glev_context& gl) const { gl.CallList(list); }
};

// In a list the offsets follow as they were given. Count and type are right.
struct CallListsCommand {
  static constexpr Opcode kOpcode = Opcode::kCallLists;
  glev_int count;
  glev_enum type;
  void Run(glev_context& gl, const void* offsets) const { gl.CallLists(count, type, offsets); }
};

struct ListBaseCommand {
  static constexpr Opcode kOpcode = Opcode::kListBase;
  glev_uint base;
  void Run(glev_context& gl) const { gl.ListBase(base); }
};

}  // namespace glev
