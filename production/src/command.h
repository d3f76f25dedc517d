// The commands that a display list can hold, without the forms of their arguments (f, d, v). Each structure
// has the stored arguments and calls its method of the context.
#pragma once

#include <array>

#include <glevaluator.h>

#include "context.h"
#include "display_list.h"

namespace glev {

// The entry that a command with wrong arguments or a null pointer leaves in a list.
struct ErrorCommand {
  static constexpr Opcode kOpcode = Opcode::kError;
  glev_enum error;
  void run(glev_context& gl) const { gl.record_error(error); }
};

// In a list, the packed control points follow. The target and the arguments are valid.
struct DefineMapCommand {
  static constexpr Opcode kOpcode = Opcode::kDefineMap;
  int dimension;
  glev_enum target;
  std::array<MapDirection, 2> directions;
  void run(glev_context& gl, const void* points) const {
    gl.define_map(dimension, target, directions, static_cast<const double*>(points));
  }
};

struct SetEnabledCommand {
  static constexpr Opcode kOpcode = Opcode::kSetEnabled;
  glev_enum cap;
  bool enabled;
  void run(glev_context& gl) const { gl.set_enabled(cap, enabled); }
};

struct SetGridCommand {
  static constexpr Opcode kOpcode = Opcode::kSetGrid;
  int dimension;
  std::array<Grid, 2> grid;
  void run(glev_context& gl) const { gl.set_grid(dimension, grid); }
};

struct EvalCoordCommand {
  static constexpr Opcode kOpcode = Opcode::kEvalCoord;
  int dimension;
  double u, v;
  void run(glev_context& gl) const { gl.eval_coord(dimension, u, v); }
};

struct EvalPointCommand {
  static constexpr Opcode kOpcode = Opcode::kEvalPoint;
  int dimension;
  glev_int i, j;
  void run(glev_context& gl) const { gl.eval_point(dimension, i, j); }
};

struct EvalMesh1Command {
  static constexpr Opcode kOpcode = Opcode::kEvalMesh1;
  glev_enum mode;
  glev_int i1, i2;
  void run(glev_context& gl) const { gl.eval_mesh1(mode, i1, i2); }
};

struct EvalMesh2Command {
  static constexpr Opcode kOpcode = Opcode::kEvalMesh2;
  glev_enum mode;
  glev_int i1, i2, j1, j2;
  void run(glev_context& gl) const { gl.eval_mesh2(mode, i1, i2, j1, j2); }
};

struct BeginCommand {
  static constexpr Opcode kOpcode = Opcode::kBegin;
  glev_enum mode;
  void run(glev_context& gl) const { gl.begin(mode); }
};

struct EndCommand {
  static constexpr Opcode kOpcode = Opcode::kEnd;
  void run(glev_context& gl) const { gl.end(); }
};

struct VertexCommand {
  static constexpr Opcode kOpcode = Opcode::kVertex;
  std::array<float, 4> position;
  void run(glev_context& gl) const { gl.vertex(position); }
};

struct ColorCommand {
  static constexpr Opcode kOpcode = Opcode::kColor;
  std::array<float, 4> color;
  void run(glev_context& gl) const { gl.color(color); }
};

struct NormalCommand {
  static constexpr Opcode kOpcode = Opcode::kNormal;
  std::array<float, 3> normal;
  void run(glev_context& gl) const { gl.normal(normal); }
};

struct IndexCommand {
  static constexpr Opcode kOpcode = Opcode::kIndex;
  float index;
  void run(glev_context& gl) const { gl.index(index); }
};

struct EdgeFlagCommand {
  static constexpr Opcode kOpcode = Opcode::kEdgeFlag;
  bool flag;
  void run(glev_context& gl) const { gl.edge_flag(flag); }
};

struct MultiTexCoordCommand {
  static constexpr Opcode kOpcode = Opcode::kMultiTexCoord;
  glev_enum texture;
  std::array<float, 4> texcoord;
  void run(glev_context& gl) const { gl.multi_tex_coord(texture, texcoord); }
};

struct ActiveTextureCommand {
  static constexpr Opcode kOpcode = Opcode::kActiveTexture;
  glev_enum texture;
  void run(glev_context& gl) const { gl.active_texture(texture); }
};

struct PushAttribCommand {
  static constexpr Opcode kOpcode = Opcode::kPushAttrib;
  glev_bitfield mask;
  void run(glev_context& gl) const { gl.push_attrib(mask); }
};

struct PopAttribCommand {
  static constexpr Opcode kOpcode = Opcode::kPopAttrib;
  void run(glev_context& gl) const { gl.pop_attrib(); }
};

struct CallListCommand {
  static constexpr Opcode kOpcode = Opcode::kCallList;
  glev_uint list;
  void run(glev_context& gl) const { gl.call_list(list); }
};

// In a list, the offsets follow in their original type. Count and type are valid.
struct CallListsCommand {
  static constexpr Opcode kOpcode = Opcode::kCallLists;
  glev_int count;
  glev_enum type;
  void run(glev_context& gl, const void* offsets) const { gl.call_lists(count, type, offsets); }
};

struct ListBaseCommand {
  static constexpr Opcode kOpcode = Opcode::kListBase;
  glev_uint base;
  void run(glev_context& gl) const { gl.list_base(base); }
};

}  // namespace glev
