// Implements steps that draw meshes point by point, at arguments that the fault computes.
#include "grid_steps.h"

namespace evalcts::faults {
namespace {

// First arguments of the directions of grids in the noted grids.
enum Direction { kCurveU = 0, kSurfaceU = 3, kSurfaceV = 6 };

// First of the places, see kept(), that contain the noted grids.
constexpr int kFirstNoted = 50;

const Value kNoteGrids{[](Call& c) {
  for (int i = 0; i < 3; ++i) kept(kFirstNoted + i).assign(c, grid1(i)(c));
  for (int i = 0; i < 6; ++i) kept(kFirstNoted + 3 + i).assign(c, grid2(i)(c));
}};
// Returns a direction of the noted grids; the initial one if no grid was noted.
GridIndex noted(Direction direction, Call& call) {
  const auto at = [&](int i) { return kept(kFirstNoted + direction + i)(call); };
  if (at(0) == 0) return {};
  return {static_cast<GLint>(at(0)), static_cast<GLfloat>(at(1)), static_cast<GLfloat>(at(2))};
}

GLfloat at(GridIndex direction, Coordinate coordinate, GLint i, GLint from, GLint lower,
           bool other_is_last = false) {
  direction.i = i;
  direction.from = from;
  direction.lower = lower;
  direction.other_is_last = other_is_last;
  return coordinate(direction);
}

}  // namespace

Value draw_quads(GLenum mode, std::initializer_list<int> corners) {
  constexpr int kCorners[4][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  Value quad = 0;
  for (const int corner : corners)
    quad = sequence({quad, point(kColumn + kCorners[corner][0], kRow + kCorners[corner][1])});
  return primitive(mode, loop(kRow, kJ1, kJ2 - 1, loop(kColumn, kI1, kI2 - 1, quad)));
}

Rule curve_at(Value condition, Coordinate u) {
  const Value draws = kIsMode1 && !kInside && kI1 <= kI2;
  return instead(EvalMesh1, draws && condition, [=](Call& c) {
    kNoteGrids(c);
    const GridIndex direction = noted(kCurveU, c);
    const GLint i1 = c.integer('i');
    unmodified.Begin(c.integer('m') == GL_POINT ? GL_POINTS : GL_LINE_STRIP);
    for (GLint i = i1; i <= c.integer('k'); ++i) unmodified.EvalCoord1f(at(direction, u, i, i1, i));
    unmodified.End();
  });
}

Rule surface_at(GLenum mode, Value condition, Coordinate u, Coordinate v) {
  return instead(EvalMesh2, kMode == mode && !kInside && kI1 <= kI2 && kJ1 <= kJ2 && condition, [=](Call& c) {
    kNoteGrids(c);
    const GridIndex directions[] = {noted(kSurfaceU, c), noted(kSurfaceV, c)};
    const GLint i1 = c.integer('i'), i2 = c.integer('k'), j1 = c.integer('j'), j2 = c.integer('l');
    const auto x = [&](GLint i) { return at(directions[0], u, i, i1, i); };
    const auto y = [&](GLint j, GLint lower) { return at(directions[1], v, j, j1, lower); };
    if (mode == GL_POINT) {
      unmodified.Begin(GL_POINTS);
      for (GLint j = j1; j <= j2; ++j)
        for (GLint i = i1; i <= i2; ++i)
          unmodified.EvalCoord2f(at(directions[0], u, i, i1, i, j == directions[1].segments),
                                 at(directions[1], v, j, j1, j, i == directions[0].segments));
      unmodified.End();
    } else if (mode == GL_LINE) {
      kRows(c);
      for (GLint i = i1; i <= i2; ++i) {
        unmodified.Begin(GL_LINE_STRIP);
        for (GLint j = j1; j <= j2; ++j) unmodified.EvalCoord2f(x(i), y(j, j));
        unmodified.End();
      }
    } else {
      for (GLint j = j1; j < j2; ++j) {
        const GLfloat lower = y(j, j), upper = y(j + 1, j);
        unmodified.Begin(GL_QUAD_STRIP);
        for (GLint i = i1; i <= i2; ++i) {
          const GLfloat both = x(i);
          unmodified.EvalCoord2f(both, lower);
          unmodified.EvalCoord2f(both, upper);
        }
        unmodified.End();
      }
    }
  });
}

Rule note_grids() { return before(Begin, kNoteGrids); }
Value noted_grid1(int i) { return kept(kFirstNoted + i); }
Value noted_grid2(int i) { return kept(kFirstNoted + 3 + i); }

Rules point1_at(Value condition, Coordinate u) {
  return {note_grids(), instead(EvalPoint1, condition, [=](Call& c) {
            const GLint i = c.integer('i');
            unmodified.EvalCoord1f(at(noted(kCurveU, c), u, i, i, i));
          })};
}
Rules point2_at(Value condition, Coordinate u, Coordinate v) {
  return {note_grids(), instead(EvalPoint2, condition, [=](Call& c) {
            const GLint i = c.integer('i'), j = c.integer('j');
            unmodified.EvalCoord2f(at(noted(kSurfaceU, c), u, i, i, i), at(noted(kSurfaceV, c), v, j, j, j));
          })};
}

}  // namespace evalcts::faults
