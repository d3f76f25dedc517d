// Steps that draw meshes and grid points in another way: by loops over indices, and at arguments that are
// computed in single precision.
#pragma once

#include "rules.h"

namespace evalcts::faults {

// --- By index ----------------------------------------------------------------------------------------------

inline const Value kIsMode1 = kMode == GL_POINT || kMode == GL_LINE;
inline const Value kIsMode2 = kIsMode1 || kMode == GL_FILL;

inline Value curve(GLenum mode, Value i1, Value i2) { return call(EvalMesh1, {mode, i1, i2}); }
inline Value surface(GLenum mode, Value i1, Value i2, Value j1, Value j2) {
  return call(EvalMesh2, {mode, i1, i2, j1, j2});
}
inline Value point(Value i, Value j) { return call(EvalPoint2, {i, j}); }

// EvalMesh2: the strips of LINE along u and those along v.
inline const Value kRows = loop(kRow, kJ1, kJ2, surface(GL_LINE, kI1, kI2, kRow, kRow));
inline const Value kColumns = loop(kColumn, kI1, kI2, surface(GL_LINE, kColumn, kColumn, kJ1, kJ2));
// A vertex at the origin for each index of u.
inline Value draw_origins(Value primitive_mode) {
  return primitive(primitive_mode, loop(kColumn, kI1, kI2, call(Vertex4f, {0, 0, 0, 1})));
}
// The strips of FILL as primitives of that mode, with the vertices (i, j + first), (i, j + 1 - first).
inline Value draw_strips(GLenum mode, int first = 0) {
  return loop(kRow, kJ1, kJ2 - 1,
              primitive(mode, loop(kColumn, kI1, kI2,
                                   {point(kColumn, kRow + first), point(kColumn, kRow + (1 - first))})));
}
// The quads of FILL as independent primitives of that mode. The corners are counted from (i, j) on, in the
// order of the strips' outline: (i, j), (i, j+1), (i+1, j+1), (i+1, j).
Value draw_quads(GLenum mode, std::initializer_list<int> corners);

// --- By argument -------------------------------------------------------------------------------------------

// An index of a mesh, or of EvalPoint, and its direction of the grid, in single precision.
struct GridIndex {
  GLint segments = 1;
  GLfloat first = 0, last = 1;
  GLint i = 0;
  GLint from = 0;              // the first index of the mesh
  GLint lower = 0;             // the lower row of the strip of FILL
  bool other_is_last = false;  // in POINT: the index of the other direction

  bool is_last() const { return i == segments; }
  GLfloat step() const { return (last - first) / static_cast<GLfloat>(segments); }
  // Positions without the rule for the last index.
  GLfloat at(GLint k) const { return static_cast<GLfloat>(k) * step() + first; }
  GLfloat at() const { return at(i); }
  // Positions with it.
  GLfloat exact(GLint k) const { return k == segments ? last : at(k); }
  GLfloat exact() const { return exact(i); }
  // By steps from the index `from` on, and from the last end down.
  GLfloat from_start() const { return at(from) + static_cast<GLfloat>(i - from) * step(); }
  GLfloat from_end() const { return last - static_cast<GLfloat>(segments - i) * step(); }
};
using Coordinate = GLfloat (*)(const GridIndex& index);
inline constexpr Coordinate kExact = [](const GridIndex& index) { return index.exact(); };
inline constexpr Coordinate kInexact = [](const GridIndex& index) { return index.at(); };

// A mesh that can be drawn: outside primitives, with a mode and a range that are legal.
inline const Value kDrawsCurve = kIsMode1 && !kInside && kI1 <= kI2;
// EvalMesh1 as a loop of EvalCoord1f at these arguments, if the condition holds of a mesh that can be drawn.
Rule curve_at(Value condition, Coordinate u);
// EvalMesh2 in that mode as loops of EvalCoord2f. In LINE, the rows are as they should be.
Rule surface_at(GLenum mode, Value condition, Coordinate u, Coordinate v);
// EvalPoint as EvalCoord, with the grid as it is at Begin.
Rules point1_at(Value condition, Coordinate u);
Rules point2_at(Value condition, Coordinate u, Coordinate v);
// Elements of these grids, as arguments of MapGrid1 and MapGrid2: noted by point1_at() and point2_at().
Rule note_grids();
Value noted_grid1(int i);
Value noted_grid2(int i);

}  // namespace evalcts::faults
