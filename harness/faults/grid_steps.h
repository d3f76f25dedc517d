// Defines steps (see rules.h) that draw meshes and grid points differently: by loops over indices, or at
// arguments that are computed in single precision.
#pragma once

#include "rules.h"

namespace evalcts::faults {

// --- By index ----------------------------------------------------------------------------------------------

inline const Value kIsMode1 = kMode == GL_POINT || kMode == GL_LINE;
inline const Value kIsMode2 = kIsMode1 || kMode == GL_FILL;
inline const Value kMeshDimension{[](Call& c) { return c.entry == EvalMesh1 ? 1 : 2; }};

inline Value curve(GLenum mode, Value i1, Value i2) { return call(EvalMesh1, {mode, i1, i2}); }
inline Value surface(GLenum mode, Value i1, Value i2, Value j1, Value j2) {
  return call(EvalMesh2, {mode, i1, i2, j1, j2});
}
inline Value point(Value i, Value j) { return call(EvalPoint2, {i, j}); }

// The strips of a LINE mesh of EvalMesh2 along u, and the strips along v.
inline const Value kRows = loop(kRow, kJ1, kJ2, surface(GL_LINE, kI1, kI2, kRow, kRow));
inline const Value kColumns = loop(kColumn, kI1, kI2, surface(GL_LINE, kColumn, kColumn, kJ1, kJ2));
// Draws a vertex at the origin for each index of u.
inline Value draw_origins(Value primitive_mode) {
  return primitive(primitive_mode, loop(kColumn, kI1, kI2, call(Vertex4f, {0, 0, 0, 1})));
}
// Draws the strips of a FILL mesh as primitives of this mode, with the vertices (i, j + first), (i, j +
// 1 - first).
inline Value draw_strips(GLenum mode, int first = 0) {
  return loop(kRow, kJ1, kJ2 - 1,
              primitive(mode, loop(kColumn, kI1, kI2,
                                   {point(kColumn, kRow + first), point(kColumn, kRow + (1 - first))})));
}
// Draws the quads of a FILL mesh as independent primitives of this mode. `corners` are indices into (i, j),
// (i, j+1), (i+1, j+1), (i+1, j).
Value draw_quads(GLenum mode, std::initializer_list<int> corners);

// --- By argument -------------------------------------------------------------------------------------------

// An index of a mesh or of EvalPoint, and the grid in its direction, in single precision.
struct GridIndex {
  GLint segments = 1;
  GLfloat first = 0, last = 1;
  GLint i = 0;
  GLint from = 0;              // the first index of the mesh
  GLint lower = 0;             // the lower row of the strip of a FILL mesh
  bool other_is_last = false;  // in a POINT mesh: the index of the other direction is the last

  bool is_last() const { return i == segments; }
  GLfloat step() const { return (last - first) / static_cast<GLfloat>(segments); }
  // Return positions without the rule that the last index gives exactly the end of the grid.
  GLfloat at(GLint k) const { return static_cast<GLfloat>(k) * step() + first; }
  GLfloat at() const { return at(i); }
  // Return positions with this rule.
  GLfloat exact(GLint k) const { return k == segments ? last : at(k); }
  GLfloat exact() const { return exact(i); }
  // Return the position, computed by steps from the index `from`, or by steps from the end of the grid.
  GLfloat from_start() const { return at(from) + static_cast<GLfloat>(i - from) * step(); }
  GLfloat from_end() const { return last - static_cast<GLfloat>(segments - i) * step(); }
};
using Coordinate = GLfloat (*)(const GridIndex& index);
inline constexpr Coordinate kExact = [](const GridIndex& index) { return index.exact(); };
inline constexpr Coordinate kInexact = [](const GridIndex& index) { return index.at(); };

// Replaces EvalMesh1 by a loop of EvalCoord1f at the arguments `u`, if it draws and the condition holds.
Rule curve_at(Value condition, Coordinate u);
// Replaces EvalMesh2 of this mode by loops of EvalCoord2f. The rows of a LINE mesh are drawn correctly.
Rule surface_at(GLenum mode, Value condition, Coordinate u, Coordinate v);
// Replace EvalPoint by EvalCoord, with the grid that is current at Begin.
Rules point1_at(Value condition, Coordinate u);
Rules point2_at(Value condition, Coordinate u, Coordinate v);
// Notes the grids at each Begin; part of point1_at() and point2_at(). noted_grid1(i) and noted_grid2(i)
// return argument i of the MapGrid1 or MapGrid2 that sets the noted grid.
Rule note_grids();
Value noted_grid1(int i);
Value noted_grid2(int i);

}  // namespace evalcts::faults
