// For wrappers around evaluation: all commands that evaluate at once, and what has gone by so far. In a
// display list the wrappers see what is compiled.
#pragma once

#include <array>

#include "forms.h"
#include "watched.h"

namespace evalcts::faults {

// body(go): EvalCoord1 and EvalPoint1 in all forms.
template <class Body>
void points1(Injection& in, Body) {
  eval_coord1(in, [](auto u, auto go) { Body{}([&] { go(u); }); });
  in.gl.EvalPoint1 = [](GLint i) { Body{}([i] { sound.EvalPoint1(i); }); };
}

// body(go): EvalCoord2 and EvalPoint2 in all forms.
template <class Body>
void points2(Injection& in, Body) {
  eval_coord2(in, [](auto u, auto v, auto go) { Body{}([&] { go(u, v); }); });
  in.gl.EvalPoint2 = [](GLint i, GLint j) { Body{}([i, j] { sound.EvalPoint2(i, j); }); };
}

// body(go): both dimensions.
template <class Body>
void points(Injection& in, Body body) {
  points1(in, body);
  points2(in, body);
}

// body(go): EvalMesh of both dimensions.
template <class Body>
void all_meshes(Injection& in, Body) {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) { Body{}([=] { sound.EvalMesh1(mode, i1, i2); }); };
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    Body{}([=] { sound.EvalMesh2(mode, i1, i2, j1, j2); });
  };
}

// --- What Enable and Disable left --------------------------------------------------------------------------

// body(cap, on, go)
template <class Body>
void switches(Injection& in, Body) {
  in.gl.Enable = [](GLenum cap) { Body{}(cap, true, [cap] { sound.Enable(cap); }); };
  in.gl.Disable = [](GLenum cap) { Body{}(cap, false, [cap] { sound.Disable(cap); }); };
}

// --- Begin and End -----------------------------------------------------------------------------------------

// first() is called before Begin, last() after End.
template <class First, class Last>
void primitives(Injection& in, First, Last) {
  in.gl.Begin = [](GLenum mode) {
    First{}();
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    Last{}();
  };
}

// Whether commands go into a display list only; to be asked for outside Begin and End.
inline bool is_compiling() {
  GLint mode = 0;
  sound.GetIntegerv(GL_LIST_MODE, &mode);
  return mode == GL_COMPILE;
}

// --- Grids -------------------------------------------------------------------------------------------------

// The grid of a dimension, in single precision; to be asked for outside Begin and End.
struct GridNow {
  std::array<GLint, 2> segments{1, 1};
  std::array<GLfloat, 4> domain{0, 1, 0, 1};

  // As an implementation in single precision has it, without the rule for the last index.
  GLfloat at(int direction, GLint i) const {
    const GLfloat first = domain[2 * direction],
                  step = (domain[2 * direction + 1] - first) / segments[direction];
    return static_cast<GLfloat>(i) * step + first;
  }
};
inline GridNow grid_now(int dimension) {
  GridNow grid;
  sound.GetIntegerv(dimension == 1 ? GL_MAP1_GRID_SEGMENTS : GL_MAP2_GRID_SEGMENTS, grid.segments.data());
  sound.GetFloatv(dimension == 1 ? GL_MAP1_GRID_DOMAIN : GL_MAP2_GRID_DOMAIN, grid.domain.data());
  return grid;
}

// The grids as they were at the last Begin, for what is evaluated inside.
inline std::array<GridNow, 2> grids_at_begin;
inline void note_grids(Injection& in) {
  primitives(
      in,
      [] {
        grids_at_begin = {grid_now(1), grid_now(2)};
      },
      [] {});
}

// --- What comes out ----------------------------------------------------------------------------------------

// Notes in memory.count how much was evaluated: what is emitted in a context where nothing is, stays as it
// is.
inline void note_evaluations(Injection& in) {
  points(in, [](auto go) {
    ++memory.count;
    go();
  });
  all_meshes(in, [](auto go) {
    ++memory.count;
    go();
  });
}

// body(vertex): each vertex that comes out of a context in which something is evaluated.
template <class Body>
void emitted_vertices(Injection& in, Body) {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) {
    if (memory.count == 0) return;
    for (ObservedPrimitive& primitive : all)
      for (ObservedVertex& vertex : primitive.vertices) Body{}(vertex);
  };
}

// --- Errors ------------------------------------------------------------------------------------------------

// Calls whose only effect is the error.
inline void raise_invalid_enum() { sound.Enable(0); }
inline void raise_invalid_value() { sound.MapGrid1f(0, 0, 1); }
inline void raise_inside() { sound.Begin(GL_POINTS); }  // INVALID_OPERATION, between Begin and End

}  // namespace evalcts::faults
