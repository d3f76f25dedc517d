// Implements steps that draw meshes point by point, at arguments that the fault computes.
#include "grid_steps.h"

namespace evalcts::faults {
namespace {

// Directions of grids: the one of MapGrid1, and the two of MapGrid2.
enum Direction { kCurveU, kSurfaceU, kSurfaceV };

// First of the places, see kept(), that contain the noted grids.
constexpr int kFirstNoted = 50;

GridIndex direction_of_grid(Direction direction, const std::function<double(int)>& curves,
                            const std::function<double(int)>& surfaces) {
  const int first = direction == kSurfaceV ? 3 : 0;
  const auto at = [&](int i) { return direction == kCurveU ? curves(i) : surfaces(first + i); };
  return {static_cast<GLint>(at(0)), static_cast<GLfloat>(at(1)), static_cast<GLfloat>(at(2))};
}
GridIndex direction_now(Direction direction) {
  Call none;
  return direction_of_grid(
      direction, [&](int i) { return grid1(i)(none); }, [&](int i) { return grid2(i)(none); });
}
GridIndex direction_at_begin(Direction direction) {
  Call none;
  if (!noted_grid1(0).holds(none)) return {};  // no primitive has begun
  return direction_of_grid(
      direction, [&](int i) { return noted_grid1(i)(none); }, [&](int i) { return noted_grid2(i)(none); });
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
  return instead(EvalMesh1, kDrawsCurve && condition, [=](Call& c) {
    const GridIndex direction = direction_now(kCurveU);
    const GLint i1 = c.integer('i');
    unmodified.Begin(c.integer('m') == GL_POINT ? GL_POINTS : GL_LINE_STRIP);
    for (GLint i = i1; i <= c.integer('k'); ++i) unmodified.EvalCoord1f(at(direction, u, i, i1, i));
    unmodified.End();
  });
}

Rule surface_at(GLenum mode, Value condition, Coordinate u, Coordinate v) {
  return instead(EvalMesh2, kMode == mode && !kInside && kI1 <= kI2 && kJ1 <= kJ2 && condition, [=](Call& c) {
    const GridIndex directions[] = {direction_now(kSurfaceU), direction_now(kSurfaceV)};
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

Rule note_grids() {
  Value note = 0;
  for (int i = 0; i < 3; ++i) note = sequence({note, set(kept(kFirstNoted + i), grid1(i))});
  for (int i = 0; i < 6; ++i) note = sequence({note, set(kept(kFirstNoted + 3 + i), grid2(i))});
  return before(Begin, note);
}
Value noted_grid1(int i) { return kept(kFirstNoted + i); }
Value noted_grid2(int i) { return kept(kFirstNoted + 3 + i); }

Rules point1_at(Value condition, Coordinate u) {
  return {note_grids(), instead(EvalPoint1, condition, [=](Call& c) {
            const GLint i = c.integer('i');
            unmodified.EvalCoord1f(at(direction_at_begin(kCurveU), u, i, i, i));
          })};
}
Rules point2_at(Value condition, Coordinate u, Coordinate v) {
  return {note_grids(), instead(EvalPoint2, condition, [=](Call& c) {
            const GLint i = c.integer('i'), j = c.integer('j');
            unmodified.EvalCoord2f(at(direction_at_begin(kSurfaceU), u, i, i, i),
                                   at(direction_at_begin(kSurfaceV), v, j, j, j));
          })};
}

}  // namespace evalcts::faults
