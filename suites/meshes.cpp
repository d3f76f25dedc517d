// Sections 15 and 16 of the requirements: the primitives of a mesh and their vertices. See mesh_pipeline.cpp
// for the pipeline after evaluation.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include <evalcts/gl/hexadecimal.h>
#include <evalcts/judge/prediction.h>
#include <evalcts/testkit/registration.h>
#include "dimensions.h"
#include "grid_cases.h"

namespace evalcts::suite_meshes {
namespace {

constexpr std::span kModes1(kMeshModes, 2);
constexpr std::span kModes2(kMeshModes);

const Grid kV = {5, 1.9f, 1.2f};

// The range of a mesh. In one dimension only i1 and i2 are used.
struct Range {
  int i1, i2, j1 = 0, j2 = 0;
};

// Draws meshes over all ranges on each of the grids, and judges their vertices. The second grid of each pair,
// that of v, is used in two dimensions only.
void expect_meshes(Test& t, bool two, const MeshMode& mode, const std::string& identity,
                   const std::vector<std::pair<Grid, Grid>>& grids, const std::vector<Range>& ranges) {
  gl::Case c(identity);
  enable_maps(t, c, two);
  for (const auto& [u, v] : grids) {
    map_grid(c, two, u, v);
    for (const auto& [i1, i2, j1, j2] : ranges) eval_mesh(c, two, mode.mode, i1, i2, j1, j2);
  }
  t.judge_vertices(c, kUnit0);
}
void expect_meshes1(Test& t, const MeshMode& mode, const std::string& identity,
                    const std::vector<Grid>& grids, const std::vector<Range>& ranges) {
  std::vector<std::pair<Grid, Grid>> pairs;
  for (const Grid& grid : grids) pairs.emplace_back(grid, kV);
  expect_meshes(t, false, mode, identity, pairs, ranges);
}
void expect_meshes2(Test& t, const MeshMode& mode, const std::string& identity,
                    const std::vector<std::pair<Grid, Grid>>& grids, const std::vector<Range>& ranges) {
  expect_meshes(t, true, mode, identity, grids, ranges);
}

// --- EvalMesh1 -------------------------------------------------------------------------------------------

EVALCTS_TEST(Mesh1, Points, kMust, "EV-MESH1-POINT", "EV-MESH1-COORDS", by(gl::list_deliveries()))
(Test& t) {
  expect_meshes1(t, kModes1[0], "whole meshes of points",
                 {{1, 0, 1}, {4, -0.5f, 2.5f}, {7, 2, -1}, {10, 0.1f, 0.7f}}, {{0, 1}, {0, 4}, {0, 10}});
  expect_meshes1(t, kModes1[0], "many points", {{300, -0.5f, 2.5f}}, {{0, 300}});
};

// A mesh of LINE is one LINE_STRIP (C-MESH1-LINES).
EVALCTS_TEST(Mesh1, Lines, kMust, "EV-MESH1-LINE", "EV-MESH1-COORDS", by(gl::list_deliveries()))
(Test& t) {
  expect_meshes1(t, kModes1[1], "whole meshes of lines",
                 {{1, 0, 1}, {4, -0.5f, 2.5f}, {7, 2, -1}, {10, 0.1f, 0.7f}}, {{0, 1}, {0, 4}, {0, 10}});
  expect_meshes1(t, kModes1[1], "one long strip", {{300, -0.5f, 2.5f}}, {{0, 300}});
};

EVALCTS_TEST(Mesh1, SubRange, kMust, "EV-MESH1-SUBRANGE", "EV-MESH1-COORDS",
             combine(kModes1).by(gl::list_deliveries()))
(Test& t, const MeshMode& mode) {
  expect_meshes1(t, mode, "parts of meshes", awkward_grids(),
                 {{1, 3}, {2, 3}, {0, 2}, {5, 9}, {40, 44}, {997, 1000}, {65530, 65536}});
};

EVALCTS_TEST(Mesh1, EmptyRange, kMust, "EV-MESH1-EMPTY", combine(kModes1).by(gl::list_deliveries()))
(Test& t, const MeshMode& mode) {
  expect_meshes1(t, mode, "i1 above i2 draws nothing", {{4, 0, 1}},
                 {{1, 0}, {4, 0}, {0, -1}, {5, -5}, {3, 2}, {kHighest, -kHighest}, {kHighest, kLowest}});
};
// A mesh of POINT draws one point; a mesh of LINE is a strip of one vertex, which draws nothing.
EVALCTS_TEST(Mesh1, SinglePoint, kMust, "EV-MESH1-SINGLE", combine(kModes1).by(gl::list_deliveries()))
(Test& t, const MeshMode& mode) {
  expect_meshes1(t, mode, "i1 equal to i2", {{4, 0, 1}, {3, 0.1f, 0.7f}},
                 {{0, 0}, {1, 1}, {3, 3}, {4, 4}, {-1, -1}, {7, 7}});
};

// One-dimensional meshes have no mode FILL.
const auto kEachMode = [](bool two) { return combine(two ? kModes2 : kModes1).by(gl::list_deliveries()); };

EVALCTS_TEST_PAIR(Mesh1.OutsideTheGrid, Mesh2.OutsideTheGrid, kMust,
                  decide("EV-MESH1-NEGATIVE", "EV-MESH2-RANGE"), kEachMode)
(Test& t, bool two, const MeshMode& mode) {
  two ? expect_meshes2(t, mode, "indices below 0 and above un and vn",
                       {{{4, 0, 1}, {3, 1, 2}}, {{3, 0.1f, 0.7f}, {1, 1.5f, 1}}},
                       {{-1, 5, -1, 4}, {-4, -2, 1, 2}, {1, 2, 5, 6}, {6, 8, -3, -1}})
      : expect_meshes1(t, mode, "indices below 0 and above n",
                       {{4, 0, 1}, {3, 0.1f, 0.7f}, {5, 2, -1}, {1, 1, 1.5f}},
                       {{-2, 6}, {-7, -3}, {8, 11}, {-1, 0}, {3, 8}});
};

EVALCTS_TEST_PAIR(Mesh1.EmptyRangeBetween, Mesh2.EmptyRangeBetween, kMust,
                  decide("EV-MESH1-EMPTY", "EV-MESH2-EMPTY"), kEachMode)
(Test& t, bool two, const MeshMode& mode) {
  const auto ranges = two ? std::vector<Range>{{0, 2, 0, 1}, {1, 0, 0, 3}, {2, 4, 1, 3}, {0, 4, 1, 0}}
                          : std::vector<Range>{{0, 2}, {1, 0}, {2, 4}, {0, -1}};
  expect_meshes(t, two, mode, "nothing between meshes that draw", {{{4, 0, 1}, {3, 1, 2}}}, ranges);
};

EVALCTS_TEST_PAIR(Mesh1.EqualEnds, Mesh2.EqualEnds, kMust, "EV-GRID-EQUAL", kEachMode)
(Test& t, bool two, const MeshMode& mode) {
  two ? expect_meshes2(t, mode, "all points, or all of a row, coincide",
                       {{{3, 0.7f, 0.7f}, {2, 1, 1}}, {{3, 0.7f, 0.7f}, {2, 1, 2}}, {{3, 0, 1}, {2, 1, 1}}},
                       {{0, 3, 0, 2}})
      : expect_meshes1(t, mode, "all points coincide", {{3, 0.7f, 0.7f}, {1, -1, -1}}, {{0, 3}, {-1, 5}});
};

EVALCTS_TEST_PAIR(Mesh1.ReversedGrid, Mesh2.ReversedGrid, kMust, "EV-GRID-REVERSED", kEachMode)
(Test& t, bool two, const MeshMode& mode) {
  two ? expect_meshes2(t, mode, "du, dv and both negative",
                       {{{3, 0.7f, 0.1f}, {2, 1, 2}}, {{3, 0, 1}, {2, 2, 1}}, {{3, 1, -1}, {2, 1.7f, 1.1f}}},
                       {{0, 3, 0, 2}})
      : expect_meshes1(t, mode, "du is negative", {{3, 0.7f, 0.1f}, {8, 2.5f, -0.9f}}, {{0, 3}, {2, 8}});
};

EVALCTS_TEST_PAIR(Mesh1.AfterEmptyPrimitives, Mesh2.AfterEmptyPrimitives, kMust,
                  decide("EV-MESH1-COORDS", "EV-MESH2-COORDS"), kEachMode)
(Test& t, bool two, const MeshMode& mode) {
  gl::Case c("meshes after Begin and End without vertices, and after empty meshes");
  enable_maps(t, c, two);
  map_grid(c, two, {4, 0, 1}, kV);
  for (GLenum primitive = GL_POINTS; primitive <= GL_POLYGON; ++primitive) {
    eval_mesh(c, two, mode.mode, 2, 1, 0, 1);
    for (const GLenum empty : {primitive, GL_POLYGON - primitive}) {
      // In display lists of Mesa 22.3 an empty LINE_LOOP draws a line, also without evaluators.
      if (empty == GL_LINE_LOOP && t.is_delivered_in_lists()) continue;
      c.Begin(empty);
      c.End();
    }
    eval_mesh(c, two, mode.mode, 0, 2, 0, 1);
  }
  t.judge_vertices(c, kUnit0);
};

EVALCTS_TEST_PAIR(Mesh1.NothingWithoutVertexMap, Mesh2.NothingWithoutVertexMap, kMust,
                  decide("EV-MESH1-NOVERTEX", "EV-MESH2-NOVERTEX"), kEachMode)
(Test& t, bool two, const MeshMode& mode) {
  gl::Case c(fmt::format("all maps but those of vertices, and those of {}",
                         two ? "one dimension" : "two dimensions"));
  enable_maps(t, c, two);
  enable_maps(t, c, !two);
  c.Disable(target_in(two, GL_MAP1_VERTEX_4));
  if (two) c.Enable(GL_AUTO_NORMAL);
  map_grid(c, two, {4, 0, 1}, kV);
  eval_mesh(c, two, mode.mode, 0, 4, 0, 3);
  t.judge_vertices(c, kPosition);
};

EVALCTS_TEST_PAIR(Mesh1.OtherDimensionHasNoEffect, Mesh2.OtherDimensionHasNoEffect, kMust,
                  decide("EV-MESH1-ONLY1D", "EV-MESH2-ONLY2D"), kEachMode)
(Test& t, bool two, const MeshMode& mode) {
  gl::Case c =
      with_current_values(two ? "MAP1 maps and another grid" : "MAP2 maps, another grid and AUTO_NORMAL");
  enable_maps(t, c, !two);
  if (!two) c.Enable(GL_AUTO_NORMAL);
  const int segments = two ? 3 : 4;
  map_grid(c, two, {segments, 0.1f, 0.7f}, kV);
  map_grid(c, !two, {two ? 4 : 3, -1, 2}, kV);
  define_and_enable(c, random_map(t, target_in(two, GL_MAP1_VERTEX_3), {4, 3}));
  eval_mesh(c, two, mode.mode, 0, segments, 0, 3);
  t.judge_vertices(c, kUnit0);
};

EVALCTS_TEST_PAIR(Mesh1.CurrentValues, Mesh2.CurrentValues, kMust,
                  decide("EV-MESH1-CURRENT", "EV-MESH2-COORDS"), decide(nullptr, "EV-COORD-CURRENT/2-D"),
                  kEachMode)
(Test& t, bool two, const MeshMode& mode) {
  gl::Case c("a vertex map only, current values changed between meshes");
  define_and_enable(c, random_map(t, target_in(two, GL_MAP1_VERTEX_4), {4, 3}));
  const int segments = two ? 3 : 6;
  map_grid(c, two, {segments, 0, 1}, {2, 0, 1});
  eval_mesh(c, two, mode.mode, 0, segments, 0, 2);
  set_current_values(c);
  eval_mesh(c, two, mode.mode, 0, segments, 0, 2);
  c.Color3f(0.9f, 0.8f, 0.7f);
  c.TexCoord1f(-3);
  eval_mesh(c, two, mode.mode, segments / 3, two ? 2 : 4, 1, 2);
  t.judge_vertices(c, kUnit0);
};

// Returns a range that contains the whole grid if it has at most `whole` segments, otherwise some steps on
// both sides of the end.
std::pair<int, int> range_at(const Grid& grid, bool last, int whole) {
  if (grid.segments <= whole) return {-1, grid.segments + 1};
  return last ? std::pair{grid.segments - 3, grid.segments + 1} : std::pair{-3, 3};
}

// Returns a range of up to three steps that begins at the first or ends at the last grid point.
std::pair<int, int> range_ending_at(const Grid& grid, bool last) {
  const int steps = std::min(grid.segments, 3);
  return last ? std::pair{grid.segments - steps, grid.segments} : std::pair{0, steps};
}

EVALCTS_TEST_PAIR(Mesh1.FirstIsExact, Mesh1.LastIsExact, kMust,
                  decide("EV-MESH1-EXACT-0", "EV-MESH1-EXACT-N"), combine(kModes1).by(gl::list_deliveries()))
(Test& t, bool last, const MeshMode& mode) {
  std::size_t most = 0;
  for (const Grid& grid : probed_grids(t)) most += 2 * static_cast<std::size_t>(grid.segments + 8);
  expect_exact_end(
      t, kAlong[0], last, mode.kind,
      [&](gl::Case& c, const Grid& grid) {
        const auto [first, end] = range_at(grid, last, t.by_depth(60, 300, 300));
        c.EvalMesh1(mode.mode, first, end);
        const auto [at_first, at_end] = range_ending_at(grid, last);
        c.EvalMesh1(mode.mode, at_first, at_end);
      },
      2 * most);
};

// A mode of EvalMesh2, a direction, and an end of the grid.
struct MeshAlong {
  std::string name;
  MeshMode mode;
  Along along;
  bool last;
};
std::vector<MeshAlong> all_along() {
  std::vector<MeshAlong> all;
  for (const MeshMode& mode : kModes2)
    for (const Along& along : {kAlong[1], kAlong[2]})
      for (const bool last : {false, true})
        all.push_back({fmt::format("{}_{}_{}", mode.name, along.v ? "V" : "U", last ? "LAST" : "FIRST"), mode,
                       along, last});
  return all;
}

// The mesh has one step across the direction under test, because FILL needs two rows.
EVALCTS_TEST(Mesh2, EndsAreExact, kMust, "EV-MESH2-EXACT", combine(all_along()).by(gl::list_deliveries()))
(Test& t, const MeshAlong& which) {
  const int whole = t.by_depth(20, 40, 200);
  std::size_t most = 0;
  for (const Grid& grid : probed_grids(t))
    most += static_cast<std::size_t>(12 * (std::min(grid.segments, whole) + 8));
  expect_exact_end(
      t, which.along, which.last, which.mode.kind,
      [&](gl::Case& c, const Grid& grid) {
        for (const auto& [first, end] :
             {range_at(grid, which.last, whole), range_ending_at(grid, which.last)})
          which.along.v ? c.EvalMesh2(which.mode.mode, 0, 1, first, end)
                        : c.EvalMesh2(which.mode.mode, first, end, 1, 2);
      },
      most);
};

// --- EvalMesh2 -------------------------------------------------------------------------------------------

const std::vector<std::pair<Grid, Grid>> kGrids2 = {
    {{1, 0, 1}, {1, 0, 1}}, {{4, -0.5f, 2.5f}, {3, 0.1f, 0.7f}}, {{3, 2, -1}, {6, 1, 2}}};

void expect_whole_meshes2(Test& t, const MeshMode& mode) {
  t.judge_order_of_meshes();
  expect_meshes2(t, mode, "whole meshes", kGrids2, {{0, 1, 0, 1}, {0, 4, 0, 3}, {0, 3, 0, 6}});
  // Long strips along u and along v.
  expect_meshes2(t, mode, "long strips", {{{90, -0.5f, 2.5f}, {90, 2, 1}}}, {{0, 90, 0, 1}, {0, 1, 0, 90}});
}

EVALCTS_TEST(Mesh2, Points, kMust, "EV-MESH2-POINT", "EV-MESH2-COORDS", by(gl::list_deliveries()))
(Test& t) { expect_whole_meshes2(t, kModes2[0]); };
// The strips along i come first, then those along j; none are merged.
EVALCTS_TEST(Mesh2, Lines, kMust, "EV-MESH2-LINE", "EV-MESH2-COORDS", "EV-MESH2-LINE-OVERLAP",
             by(gl::list_deliveries()))
(Test& t) { expect_whole_meshes2(t, kModes2[1]); };
// Quads come row by row, each of them whole or as two triangles.
EVALCTS_TEST(Mesh2, Quads, kMust, "EV-MESH2-FILL", "EV-MESH2-COORDS", by(gl::list_deliveries()))
(Test& t) { expect_whole_meshes2(t, kModes2[2]); };

EVALCTS_TEST(Mesh2, SubRange, kMust, "EV-MESH2-COORDS", combine(kModes2).by(gl::list_deliveries()))
(Test& t, const MeshMode& mode) {
  std::vector<std::pair<Grid, Grid>> grids;
  for (const Grid& grid : awkward_grids()) grids.emplace_back(grid, kV);
  grids.emplace_back(kV, Grid{1000, 0.1f, 0.7f});
  expect_meshes2(t, mode, "parts of meshes", grids, {{1, 3, 2, 4}, {2, 3, 0, 1}, {5, 7, 3, 5}, {0, 2, 4, 5}});
  expect_meshes2(t, mode, "far from the first row and column", {{{1000, 0.1f, 0.7f}, {1000, -0.3f, 1}}},
                 {{1, 2, 996, 998}, {300, 302, 2, 3}, {999, 1000, 513, 514}});
};

EVALCTS_TEST(Mesh2, EmptyRange, kMust, "EV-MESH2-EMPTY", combine(kModes2).by(gl::list_deliveries()))
(Test& t, const MeshMode& mode) {
  expect_meshes2(t, mode, "i1 above i2, j1 above j2, both", {{{4, 0, 1}, {3, 1, 2}}},
                 {{1, 0, 0, 3},
                  {0, 4, 1, 0},
                  {2, 1, 2, 1},
                  {4, 0, 0, 0},
                  {0, 0, 3, 2},
                  {0, -5, 0, 2},
                  {kHighest, kLowest, 0, 2},
                  {0, 2, kHighest, kLowest}});
  if (mode.mode == GL_FILL)
    expect_meshes2(t, mode, "FILL without width or height", {{{4, 0, 1}, {3, 1, 2}}},
                   {{2, 2, 0, 3}, {0, 4, 1, 1}, {1, 1, 2, 2}});
};

// Meshes of one row or column have strips in one direction only; a single point draws nothing.
EVALCTS_TEST(Mesh2, LinesOfOneRow, kMust, "EV-MESH2-LINE-DEGENERATE", by(gl::list_deliveries()))
(Test& t) {
  expect_meshes2(t, kModes2[1], "i1 = i2, j1 = j2, both", {{{4, 0, 1}, {3, 1, 2}}},
                 {{2, 2, 0, 3}, {0, 4, 1, 1}, {1, 1, 2, 2}, {0, 0, 0, 1}, {4, 4, 3, 3}});
};

// --- Long meshes -----------------------------------------------------------------------------------------

// Expects a mesh of 10005 steps not to accumulate rounding errors. The map is linear over the grid, so that
// its values show the arguments. In [2,3] the step is nearly half an ulp away from a multiple of the ulp, so
// that each addition of it rounds in the same direction. The error of a sum of that many steps leaves the
// acceptance interval; the error of one product and one sum does not.
void expect_no_accumulation(Test& t, const MeshMode& mode, const Along& along) {
  const Grid grid = {10005, 1, 3};
  gl::Case map;
  const Interval ends = {grid.first, grid.last};
  const Map net = make_map2(target_in(along.two, GL_MAP1_VERTEX_3), along.v ? 1 : 2, along.v ? 2 : 1,
                            {-1, 0, 1, 1, 2, -1});
  define_and_enable(map, along.v ? over(net, {0, 1}, ends) : over(net, ends));
  map_grid(map, along, grid);
  const auto mesh = [&](GLenum how, int first, int last) {
    const int across = how == GL_FILL ? 1 : 0;
    gl::Case c = map;
    along.v ? eval_mesh(c, true, how, 0, across, first, last)
            : eval_mesh(c, along.two, how, first, last, 0, across);
    return c;
  };
  // The points that are judged: in the middle and near the end. Another test judges the end itself.
  std::vector<int> indices;
  for (int i = 0; i < 8; ++i) indices.insert(indices.end(), {grid.segments / 2 + i, grid.segments - 9 + i});

  gl::Case c = mesh(mode.mode, 0, grid.segments);
  c.set_identity(fmt::format("{} segments from 1 to 3", grid.segments));
  const auto segments = static_cast<std::size_t>(grid.segments);
  t.expect_observation(c, kPosition, 8 * segments, mode.kind, [&](const Observation& seen) {
    std::vector<ObservedVertex> vertices;
    for (const ObservedPrimitive& primitive : seen.primitives)
      if (primitive.mode == GL_POINTS || primitive.vertices.size() > 1)  // without strips of one vertex
        vertices.insert(vertices.end(), primitive.vertices.begin(), primitive.vertices.end());
    // Vertices are grouped by grid point (points and strips) or by step (lines and quads). x rises along the
    // mesh.
    const std::size_t groups = vertices.size() % (segments + 1) == 0 ? segments + 1 : segments;
    if (vertices.empty() || vertices.size() % groups != 0)
      throw NotObservable("points of the mesh are missing, which other tests report");
    // Other tests judge the order of rows.
    if (vertices.back().position[0] < vertices.front().position[0]) std::ranges::reverse(vertices);
    const auto size = static_cast<std::ptrdiff_t>(vertices.size() / groups);
    const auto judge_point = [&](int i) {
      const auto group = vertices.begin() + i * size;
      Observation point;
      point.attributes = kPosition;
      point.primitives.push_back(
          {GL_POINTS, {*std::min_element(group, group + size, [](const auto& one, const auto& other) {
             return one.position[0] < other.position[0];
           })}});
      return judge(predict(mesh(GL_POINT, i, i), t.max_order()), point, {}).mismatches;
    };
    if (!judge_point(1).empty())
      throw NotObservable("the second point is wrong as well, which other tests report");
    std::vector<Mismatch> mismatches;
    for (const int i : indices) {
      for (Mismatch& mismatch : judge_point(i)) {
        mismatch.what = fmt::format("point {}: {}", i, mismatch.what);
        mismatch.message = fmt::format("point {}: {}", i, mismatch.message);
        mismatches.push_back(std::move(mismatch));
      }
    }
    return mismatches;
  });
}

struct LongMesh {
  std::string name;
  MeshMode mode;
  Along along;
};
std::vector<LongMesh> long_meshes2() {
  std::vector<LongMesh> all;
  for (const MeshMode& mode : kModes2)
    for (const Along& along : {kAlong[1], kAlong[2]})
      all.push_back({fmt::format("{}_{}", mode.name, along.v ? "V" : "U"), mode, along});
  return all;
}

EVALCTS_TEST(Mesh1, ErrorDoesNotAccumulate, kMust, "EV-MESH1-NOACCUM", combine(kModes1).by(in_lists()))
(Test& t, const MeshMode& mode) { expect_no_accumulation(t, mode, kAlong[0]); };
EVALCTS_TEST(Mesh2, ErrorDoesNotAccumulate, kMust, "EV-MESH2-NOACCUM", combine(long_meshes2()).by(in_lists()))
(Test& t, const LongMesh& mesh) { expect_no_accumulation(t, mesh.mode, mesh.along); };

// --- The same vertex wherever it is drawn ----------------------------------------------------------------

// Captured positions by the indices of their grid points.
using ByPoint = std::map<std::pair<int, int>, std::vector<std::array<float, 4>>>;

// Draws meshes over the ranges with a texture map that is linear over the grid, whose values identify the
// grid point of each captured vertex.
ByPoint draw_numbered(Test& t, const MeshMode& mode, const std::vector<Range>& ranges, const Map& vertices) {
  const bool two = vertices.two;
  const Grid u = {two ? 37 : 100, 0.1f, 0.7f}, v = {11, 1.9f, 1.2f};
  const char* const drawn = ranges.size() == 1 ? "a whole mesh" : two ? "a mesh in parts" : "parts of it";
  gl::Case c(two ? fmt::format("{} in {}", drawn, mode.name) : drawn);
  define_and_enable(c, vertices);
  define_and_enable(c, two ? over(make_map2(GL_MAP2_TEXTURE_COORD_2, 2, 2, {0, 0, 0, 11, 37, 0, 37, 11}),
                                  {u.first, u.last}, {v.first, v.last})
                           : make_map1(GL_MAP1_TEXTURE_COORD_1, u.first, u.last, 1, {0, 100}));
  map_grid(c, two, u, v);
  for (const auto& [i1, i2, j1, j2] : ranges) eval_mesh(c, two, mode.mode, i1, i2, j1, j2);
  ByPoint points;
  for (const ObservedVertex& vertex :
       vertices_of(t.observe(c, kPosition | kTextureCoordinate0, two ? 6 * 40 * 12 : 300, mode.kind))) {
    const auto index = [&](std::size_t k) {
      return static_cast<int>(std::lround(std::clamp(vertex.texture_coordinate[0][k], -200.0f, 200.0f)));
    };
    points[{index(0), index(1)}].push_back(vertex.position);
  }
  return points;
}

std::string in_words(const std::array<float, 4>& p) {
  return fmt::format("{}, {}, {}, {}", hexadecimal(p[0]), hexadecimal(p[1]), hexadecimal(p[2]),
                     hexadecimal(p[3]));
}

void fail_at(Test& t, const std::string& what, const std::pair<int, int>& point,
             const std::array<float, 4>& a, const std::array<float, 4>& b) {
  Failure failure;
  failure.case_identity = what;
  failure.what = fmt::format("point ({}, {})", point.first, point.second);
  failure.expected = in_words(a);
  failure.captured = in_words(b);
  failure.message = fmt::format("{} has other bits {}", failure.what, what);
  t.fail(std::move(failure));
}

// Expects the first positions of the points that both have to have the same bits. Throws NotObservable if
// these are fewer than twelve. `what`: the place of the others, for messages.
void expect_same_bits(Test& t, const std::string& what, const ByPoint& all, const ByPoint& others) {
  std::size_t compared = 0;
  for (const auto& [point, positions] : others) {
    const auto found = all.find(point);
    if (found == all.end()) continue;
    ++compared;
    if (found->second.front() != positions.front())
      fail_at(t, what, point, found->second.front(), positions.front());
  }
  if (compared < 12) throw NotObservable("points of the mesh are missing, which other tests report");
}

const Range kWhole = {0, 37, 0, 11};

// A grid point that several primitives of a mesh share has the same position in all of them, so that there
// are no cracks.
EVALCTS_TEST(Mesh2, SharedVertices, kMust, "EV-MESH2-SHAREDROW",
             combine((std::vector<MeshMode>{kModes2[1], kModes2[2]})).by(gl::list_deliveries()))
(Test& t, const MeshMode& mode) {
  const ByPoint points = draw_numbered(t, mode, {kWhole}, random_map(t, GL_MAP2_VERTEX_4, {4, 4}));
  std::size_t shared = 0;
  for (const auto& [point, positions] : points) {
    if (positions.size() > 1) ++shared;
    const auto other =
        std::ranges::find_if(positions, [&first = positions.front()](const auto& p) { return p != first; });
    if (other != positions.end())
      fail_at(t, "in the primitives that share it", point, positions.front(), *other);
  }
  if (shared < 100) throw NotObservable("points of the mesh are missing, which other tests report");
};

EVALCTS_TEST(Mesh2, ModesAgree, kQuality, "EV-MESH2-MODESAGREE", by(gl::list_deliveries()))
(Test& t) {
  const Map map = random_map(t, GL_MAP2_VERTEX_4, {4, 4});
  const ByPoint points = draw_numbered(t, kModes2[0], {kWhole}, map);
  expect_same_bits(t, "in LINE than in POINT", points, draw_numbered(t, kModes2[1], {kWhole}, map));
  expect_same_bits(t, "in FILL than in POINT", points, draw_numbered(t, kModes2[2], {kWhole}, map));
};

EVALCTS_TEST(Mesh2, PartsAgree, kQuality, "EV-MESH2-MODESAGREE", combine(kModes2).by(gl::list_deliveries()))
(Test& t, const MeshMode& mode) {
  const Map map = random_map(t, GL_MAP2_VERTEX_4, {4, 4});
  const ByPoint whole = draw_numbered(t, mode, {kWhole}, map);
  expect_same_bits(t, "in a part of the mesh", whole,
                   draw_numbered(t, mode, {{3, 9, 2, 4}, {30, 37, 5, 11}, {20, 22, 0, 1}}, map));
};

// A part of a one-dimensional mesh has the same bits as the whole.
EVALCTS_TEST(Mesh1, PartsAgree, kQuality, "EV-MESH1-SUBRANGE", combine(kModes1).by(gl::list_deliveries()))
(Test& t, const MeshMode& mode) {
  const Map map = random_map(t, GL_MAP1_VERTEX_4, 4);
  const ByPoint whole = draw_numbered(t, mode, {{0, 100}}, map);
  expect_same_bits(t, "in a part of the mesh", whole,
                   draw_numbered(t, mode, {{2, 9}, {50, 60}, {97, 100}}, map));
};

}  // namespace
}  // namespace evalcts::suite_meshes
