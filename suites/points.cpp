// Section 14 of the requirements, and the rules of section 13 about values: evaluation at the points of a
// grid.
#include <fmt/format.h>

#include <algorithm>

#include <evalcts/gl/hexadecimal.h>
#include <evalcts/testkit/registration.h>

#include "dimensions.h"
#include "grid_cases.h"

namespace evalcts::suite_points {
namespace {

const Grid kOther = {5, 1.9f, 1.2f};  // the grid of v

void point(gl::Case& c, bool two, int i) {
  eval_point(c, two, i, (3 * i % 7 + 7) % 7 - 1);
}  // j from -1 to 5

void eval_points(gl::Case& c, bool two, int first, int last) {
  c.Begin(GL_POINTS);
  for (int i = first; i <= last; ++i) point(c, two, i);
  c.End();
}

void expect_points(Test& t, bool two, const std::string& identity, const std::vector<Grid>& grids,
                   int outside) {
  gl::Case c(identity);
  // Maps and grid of the other dimension must have no effect.
  enable_maps(t, c, !two);
  map_grid(c, !two, {6, 0.3f, 1.9f}, kOther);
  enable_maps(t, c, two);
  for (const Grid& grid : grids) {
    map_grid(c, two, grid, kOther);
    eval_points(c, two, -outside, std::min(grid.segments, 12) + outside);
    if (grid.segments > 12) eval_points(c, two, grid.segments / 2, grid.segments / 2 + 3);
    if (grid.segments > 12) eval_points(c, two, grid.segments - 3, grid.segments + outside);
    if (!two) continue;
    // Points along v.
    map_grid(c, kOther, grid);
    c.Begin(GL_POINTS);
    for (const int j : {-outside, 1, grid.segments / 2, grid.segments + outside}) c.EvalPoint2(3, j);
    c.End();
  }
  t.judge_vertices(c, kUnit0);
}

EVALCTS_TEST_PAIR(Points.SameAsEvalCoord1, Points.SameAsEvalCoord2, kMust,
                  decide("EV-POINT1-EQUIV", "EV-POINT2-EQUIV"),
                  decide("EV-GRID-NOTMAP/1-D", "EV-GRID-NOTMAP/2-D"),
                  decide("EV-POINT-LIKEMESH/1-D", "EV-POINT-LIKEMESH/2-D"), by(gl::list_deliveries()))
(Test& t, bool two) { expect_points(t, two, "awkward grids", awkward_grids(), 0); };

EVALCTS_TEST(Points, OutsideTheGrid, kMust, "EV-POINT-RANGE", combine(kDimensions).by(gl::list_deliveries()))
(Test& t, const Dimension& d) {
  expect_points(t, d.two, "indices from -4 to n+4", {{4, 0, 1}, {3, 0.1f, 0.7f}, {100, 2, -1}, {1, 1, 1.5f}},
                4);
};

EVALCTS_TEST(Points, EqualEnds, kMust, "EV-GRID-EQUAL", combine(kDimensions).by(gl::list_deliveries()))
(Test& t, const Dimension& d) {
  expect_points(t, d.two, "all points of the grid coincide", {{3, 0.7f, 0.7f}, {1, -1, -1}, {1000, 0, 0}}, 3);
};

EVALCTS_TEST(Points, Reversed, kMust, "EV-GRID-REVERSED", combine(kDimensions).by(gl::list_deliveries()))
(Test& t, const Dimension& d) {
  expect_points(t, d.two, "from the larger end to the smaller",
                {{4, 1, 0}, {3, 0.7f, 0.1f}, {50, 2.5f, -0.9f}}, 2);
};

// Grids up to 2^31 - 1 segments, on which the argument is a large index times a small step.
EVALCTS_TEST(Points, LargestCounts, kMust, "EV-GRID-LARGE", combine(kDimensions).by(gl::list_deliveries()))
(Test& t, const Dimension& d) {
  gl::Case c("up to 2^31-1 segments");
  enable_maps(t, c, d.two);
  for (const int segments : {1 << 20, 1 << 24, (1 << 24) + 1, 1 << 30, 0x7fffffff}) {
    map_grid(c, d.two, {segments, 0.25f, 2}, kOther);
    c.Begin(GL_POINTS);
    for (const int i : {0, 1, segments / 3, segments / 2, segments - 1, segments}) eval_point(c, d.two, i, 2);
    c.End();
  }
  t.judge_vertices(c, kUnit0);
};

// Points and meshes use the grid at the time of the command.
EVALCTS_TEST(Points, GridOfTheMoment, kMust, "EV-GRID-LATE", combine(kDimensions).by(gl::list_deliveries()))
(Test& t, const Dimension& d) {
  gl::Case c("grids change between points, between meshes, with and without maps");
  map_grid(c, d.two, {4, 0, 1}, kOther);
  enable_maps(t, c, d.two);
  eval_points(c, d.two, 0, 4);
  for (const Grid& grid : {Grid{4, 1, 2}, Grid{8, 1, 2}, Grid{8, 0, 2}, Grid{2, -1, 1}}) {
    map_grid(c, d.two, grid, kOther);
    eval_points(c, d.two, 0, 3);
    eval_mesh(c, d.two, GL_POINT, 0, d.two ? 2 : 3, 1, 2);
  }
  if (d.two)  // only the grid of v changes
    for (const Grid& v : {Grid{5, 1, 1.75f}, Grid{3, 1, 1.75f}}) {
      map_grid(c, {2, -1, 1}, v);
      c.EvalMesh2(GL_POINT, 0, 2, 0, 2);
      eval_points(c, true, 0, 3);
    }
  t.judge_vertices(c, kUnit0);
};

EVALCTS_TEST_PAIR(Points.FirstIsExact, Points.LastIsExact, kMust,
                  decide("EV-POINT-EXACT-0", "EV-POINT-EXACT-N"), combine(kAlong).by(gl::list_deliveries()))
(Test& t, bool last, const Along& along) {
  const auto draw = [&](gl::Case& c, const Grid& grid) {
    const int i = last ? grid.segments : 0;
    c.Begin(GL_POINTS);
    eval_point(c, along.two, along.v ? 1 : i, along.v ? i : 1);
    c.End();
  };
  expect_exact_end(t, along, last, kPoints, draw, 20000);
};

// EvalPoint and EvalMesh evaluate an index at the same argument, so their vertices have the same bits.
EVALCTS_TEST(Points, SameBitsAsMesh, kQuality, "EV-POINT-LIKEMESH",
             combine(kDimensions).by(gl::list_deliveries()))
(Test& t, const Dimension& d) {
  gl::Case c("points, then meshes of them");
  enable_maps(t, c, d.two);
  std::size_t count = 0;
  for (const Grid& grid : awkward_grids()) {
    const int last = std::min(grid.segments, 40);
    map_grid(c, d.two, grid, kOther);
    c.Begin(GL_POINTS);
    for (int j = 0; j <= (d.two ? 2 : 0); ++j)
      for (int i = -2; i <= last; ++i) {
        eval_point(c, d.two, i, j);
        ++count;
      }
    c.End();
    // Each mesh has one row, because the order of rows is not judged here.
    for (int j = 0; j <= (d.two ? 2 : 0); ++j) eval_mesh(c, d.two, GL_POINT, -2, last, j, j);
  }
  const Attributes shown = t.shown_exactly(kUnit0);
  const Observation seen = t.observe(c, shown, 2 * count);
  const std::vector<ObservedVertex> vertices = vertices_of(seen);
  if (vertices.size() != 2 * count)
    throw NotObservable("the number of vertices is wrong, which other tests report");
  std::size_t first = 0;
  for (const Grid& grid : awkward_grids()) {
    const auto of_grid = static_cast<std::size_t>(std::min(grid.segments, 40) + 3) * (d.two ? 3 : 1);
    for (std::size_t i = first; i < first + of_grid; ++i) {
      const ObservedVertex &point = vertices[i], &mesh = vertices[i + of_grid];
      if (same_vertex(point, mesh, shown)) continue;
      const std::string what = fmt::format("point {} of the grid of {} segments from {} to {}", i - first,
                                           grid.segments, hexadecimal(grid.first), hexadecimal(grid.last));
      t.fail(failure_of(c, what, what + " has other values in a mesh",
                        fmt::format("x = {} as by EvalPoint", hexadecimal(point.position[0])),
                        "x = " + hexadecimal(mesh.position[0])));
    }
    first += 2 * of_grid;
  }
};

}  // namespace
}  // namespace evalcts::suite_points
