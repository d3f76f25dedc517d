// Tests EvalPoint and EvalMesh: the calls of the sink, exact arguments, extreme indices, and callbacks. The
// conformance suite tests the rules of the GL (suites/meshes.cpp, suites/mesh_errors.cpp, suites/points.cpp).
#include <climits>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "fixture.h"

namespace glev_tests {
namespace {

constexpr glev_enum kMeshModes[] = {GLEV_POINT, GLEV_LINE, GLEV_FILL};

bool same_bits(const glev_vertex& a, const glev_vertex& b) {
  return std::memcmp(&a, &b, offsetof(glev_vertex, edge_flag) + 1) == 0;
}

// A primitive of a mesh, drawn by EvalPoint with the loops of GL §21.1.
struct Primitive {
  glev_enum mode;
  std::vector<std::pair<int, int>> points;
};

std::vector<Primitive> loops(glev_enum mode, int i1, int i2, int j1, int j2) {
  std::vector<Primitive> result;
  if (mode == GLEV_POINT) {
    result.push_back({GLEV_POINTS, {}});
    for (int j = j1; j <= j2; ++j) {
      for (int i = i1; i <= i2; ++i) result[0].points.emplace_back(i, j);
    }
  } else if (mode == GLEV_LINE) {
    for (int j = j1; j <= j2; ++j) {
      result.push_back({GLEV_LINE_STRIP, {}});
      for (int i = i1; i <= i2; ++i) result.back().points.emplace_back(i, j);
    }
    for (int i = i1; i <= i2; ++i) {
      result.push_back({GLEV_LINE_STRIP, {}});
      for (int j = j1; j <= j2; ++j) result.back().points.emplace_back(i, j);
    }
  } else {
    for (int j = j1; j < j2; ++j) {
      result.push_back({GLEV_QUAD_STRIP, {}});
      for (int i = i1; i <= i2; ++i) {
        result.back().points.emplace_back(i, j);
        result.back().points.emplace_back(i, j + 1);
      }
    }
  }
  return result;
}

// Random maps of all attributes, on a grid that is not their domain.
class Meshes : public ContextTest {
 protected:
  Meshes() {
    for (std::size_t i = 0; i < points_.size(); ++i)
      points_[i] = static_cast<float>(std::sin(1.7 * static_cast<double>(i)) + 0.1);
    for (const TargetRow& row : kTargetRows) {
      if (row.offset == GLEV_MAP1_VERTEX_4 - GLEV_MAP1_COLOR_4) continue;
      const glev_enum one = GLEV_MAP1_COLOR_4 + row.offset, two = GLEV_MAP2_COLOR_4 + row.offset;
      const float* points = points_.data() + 5 * row.offset;
      glevMap1f(gl, one, 0.25f, 2.1f, 4, 5, points);
      glevMap2f(gl, two, 0.2f, 1.3f, 12, 4, 2, -1, 4, 3, points);
      glevEnable(gl, one);
      glevEnable(gl, two);
    }
    glevMapGrid1f(gl, 7, 0.1f, 0.7f);
    glevMapGrid2f(gl, 5, 0.1f, 1.7f, 3, -0.9f, 2.2f);
  }
  glev_vertex point_at(int i) {
    return one_vertex([&] { glevEvalPoint1(gl, i); });
  }
  glev_vertex point_at(int i, int j) {
    return one_vertex([&] { glevEvalPoint2(gl, i, j); });
  }
  void mesh2(glev_enum mode, int i1, int i2, int j1, int j2) {
    recording = {};
    expect_accepted([&] { glevEvalMesh2(gl, mode, i1, i2, j1, j2); });
  }
  void mesh1(glev_enum mode, int i1, int i2) {
    recording = {};
    expect_accepted([&] { glevEvalMesh1(gl, mode, i1, i2); });
  }

  std::array<float, 400> points_;
};

TEST_F(Meshes, Mesh2FollowsTheLoopsWithTheVerticesOfEvalPoint) {
  for (bool automatic : {false, true}) {
    (automatic ? glevEnable : glevDisable)(gl, GLEV_AUTO_NORMAL);
    for (glev_enum mode : kMeshModes) {
      for (auto [i1, i2, j1, j2] : {std::array{0, 5, 0, 3},
                                    {1, 3, 1, 2},
                                    {-2, 7, -1, 5},
                                    {-1, 6, -3, 0},
                                    {2, 2, 0, 3},
                                    {0, 5, 2, 2},
                                    {2, 2, 1, 1},
                                    {3, 2, 0, 3},
                                    {0, 5, 2, 1},
                                    {3, 2, 2, 1}}) {
        SCOPED_TRACE(testing::Message() << std::hex << mode << std::dec << " i " << i1 << ".." << i2 << " j "
                                        << j1 << ".." << j2);
        const std::vector<Primitive> expected = loops(mode, i1, i2, j1, j2);
        mesh2(mode, i1, i2, j1, j2);
        const Recording drawn = recording;
        std::vector<glev_enum> begun;
        std::vector<std::pair<int, int>> points;
        for (const Primitive& primitive : expected) {
          begun.push_back(primitive.mode);
          points.insert(points.end(), primitive.points.begin(), primitive.points.end());
        }
        EXPECT_EQ(drawn.begun, begun);
        EXPECT_EQ(drawn.ended, static_cast<int>(begun.size()));
        ASSERT_EQ(drawn.vertices.size(), points.size());
        for (std::size_t k = 0; k < points.size(); ++k) {
          EXPECT_TRUE(same_bits(drawn.vertices[k], point_at(points[k].first, points[k].second)))
              << "vertex " << k;
        }
      }
    }
  }
}

TEST_F(Meshes, VerticesAreInTheirPrimitives) {
  // Records begin, vertices and end in one sequence.
  std::vector<int> events;
  const glev_sink sink = {
      sizeof(glev_sink), &events,
      [](void* user, glev_enum mode) {
        static_cast<std::vector<int>*>(user)->push_back(100 + static_cast<int>(mode));
      },
      [](void* user, const glev_vertex*) { static_cast<std::vector<int>*>(user)->push_back(1); },
      [](void* user) { static_cast<std::vector<int>*>(user)->push_back(-1); }};
  glevSetSink(gl, &sink);
  const auto expect_events = [&](const std::vector<int>& expected) {
    EXPECT_EQ(events, expected);
    events.clear();
  };
  glevEvalMesh2(gl, GLEV_POINT, 0, 1, 0, 1);
  expect_events({100, 1, 1, 1, 1, -1});
  glevEvalMesh2(gl, GLEV_FILL, 0, 1, 0, 2);
  expect_events({108, 1, 1, 1, 1, -1, 108, 1, 1, 1, 1, -1});
  glevEvalMesh2(gl, GLEV_LINE, 0, 1, 0, 2);
  expect_events({103, 1, 1, -1, 103, 1,   1, -1, 103, 1, 1, -1,  //
                 103, 1, 1, 1,  -1,  103, 1, 1,  1,   -1});
  glevEvalMesh1(gl, GLEV_LINE, 0, 2);
  expect_events({103, 1, 1, 1, -1});
  for (auto [i1, i2] : {std::pair{5, 4}, {INT_MAX, INT_MIN}}) {
    glevEvalMesh1(gl, GLEV_POINT, i1, i2);
    glevEvalMesh1(gl, GLEV_LINE, i1, i2);
    expect_events({100, -1, 103, -1});
  }
  expect_error(GLEV_NO_ERROR);
}

TEST_F(Meshes, TheEndsOfTheGridAreExact) {
  // With rounding, u1 + n * (u2 - u1) / n would differ from many of these ends.
  const double ramp[] = {0, 0, 0, 1, 1, 1};
  for (int n = 1; n <= 20; ++n) {
    for (auto [u1, u2] : {std::pair{0.1, 0.7}, {1.0 / 3, -5.1}, {1000.1, 1e-3}, {0.3, 0.1}}) {
      glevMapGrid1d(gl, n, u1, u2);
      glevMapGrid2d(gl, n, u1, u2, n, u2, u1);
      for (auto [index, u] : {std::pair{0, u1}, {n, u2}}) {
        glevMap1d(gl, GLEV_MAP1_VERTEX_3, u, std::nextafter(u, 2e3), 3, 2, ramp);
        ASSERT_EQ(point_at(index).position[0], 0) << n << " " << u;
        glevMap2d(gl, GLEV_MAP2_VERTEX_3, u, std::nextafter(u, 2e3), 3, 2, 0, 1, 3, 1, ramp);
        ASSERT_EQ(point_at(index, 0).position[0], 0) << n << " " << u;
        glevMap2d(gl, GLEV_MAP2_VERTEX_3, 0, 1, 3, 1, u, std::nextafter(u, 2e3), 3, 2, ramp);
        ASSERT_EQ(point_at(0, n - index).position[0], 0) << n << " " << u;
        mesh2(GLEV_FILL, 0, 0, n - index, n - index + 1);
        ASSERT_EQ(recording.vertices.at(0).position[0], 0) << n << " " << u;
      }
    }
  }
}

TEST_F(Meshes, PointsInBetweenAreNotRoundedOrAccumulated) {
  // For a line over the grid, point i is at i/n.
  const float line[] = {0, 0, 0, 3, 3, 3};
  for (int n : {3, 10, 10000, INT_MAX}) {
    glevMapGrid1f(gl, n, 0.1f, 0.7f);
    glevMapGrid2f(gl, n, 0.1f, 0.7f, n, -2, 5);
    glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0.1f, 0.7f, 3, 2, line);
    for (int i : {1, 2, n / 2, n - 1, n + (n < INT_MAX ? 1 : 0), -1, -n}) {
      const auto expected = static_cast<float>(3.0 * i / n);
      EXPECT_EQ(point_at(i).position[0], expected) << i << "/" << n;
      glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0.1f, 0.7f, 3, 2, 0, 1, 3, 1, line);
      EXPECT_EQ(point_at(i, 5).position[0], expected) << i << "/" << n;
      glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 3, 1, -2, 5, 3, 2, line);
      EXPECT_EQ(point_at(5, i).position[0], expected) << i << "/" << n;
    }
  }
}

TEST_F(Meshes, IndicesAtTheEndsOfInt) {
  glevMapGrid1f(gl, INT_MAX, 0, 1);
  glevMapGrid2f(gl, 1, 0, 1, 1, 0, 1);
  for (int i : {INT_MIN, INT_MAX}) {
    point_at(i);
    point_at(i, i);
    point_at(i, 0);
  }
  mesh1(GLEV_LINE, INT_MAX - 2, INT_MAX);
  EXPECT_EQ(recording.vertices.size(), 3u);
  mesh1(GLEV_POINT, INT_MIN, INT_MIN + 1);
  EXPECT_EQ(recording.vertices.size(), 2u);
  for (glev_enum mode : kMeshModes) {
    mesh2(mode, INT_MAX - 1, INT_MAX, INT_MAX - 1, INT_MAX);
    EXPECT_EQ(recording.vertices.size(), mode == GLEV_LINE ? 8u : 4u);
    mesh2(mode, INT_MIN, INT_MIN + 1, INT_MIN, INT_MIN + 1);
    EXPECT_EQ(recording.vertices.size(), mode == GLEV_LINE ? 8u : 4u);
  }
  // Without a vertex map no primitive begins, which does not take as long as all points.
  glevDisable(gl, GLEV_MAP1_VERTEX_3);
  glevDisable(gl, GLEV_MAP2_VERTEX_3);
  mesh1(GLEV_LINE, INT_MIN, INT_MAX);
  EXPECT_TRUE(recording.begun.empty());
  for (glev_enum mode : kMeshModes) {
    mesh2(mode, INT_MIN, INT_MAX, INT_MIN, INT_MAX);
    EXPECT_TRUE(recording.begun.empty());
  }
}

// ---- A sink that calls back

struct Caller {
  glev_context* gl;
  void (*call)(glev_context*);
  std::vector<glev_vertex> vertices;
  int ended = 0;

  glev_sink make_sink() {
    return {sizeof(glev_sink), this, nullptr,
            [](void* user, const glev_vertex* v) {
              auto* self = static_cast<Caller*>(user);
              self->vertices.push_back(*v);
              self->call(self->gl);
            },
            [](void* user) { ++static_cast<Caller*>(user)->ended; }};
  }
};

TEST_F(Meshes, ACallbackMayChangeCurrentValues) {
  glevDisable(gl, GLEV_MAP2_COLOR_4);
  glevColor4f(gl, 0, 0, 0, 1);
  Caller caller = {gl,
                   [](glev_context* context) {
                     glevColor4f(context, 1, 0, 0, 1);
                     glevEdgeFlag(context, GLEV_FALSE);
                   },
                   {}};
  const glev_sink sink = caller.make_sink();
  glevSetSink(gl, &sink);
  for (glev_enum mode : kMeshModes) {
    glevColor4f(gl, 0, 0, 0, 1);
    caller.vertices.clear();
    expect_accepted([&] { glevEvalMesh2(gl, mode, 0, 2, 0, 2); });
    for (std::size_t k = 0; k < caller.vertices.size(); ++k) {
      EXPECT_EQ(caller.vertices[k].color[0], k == 0 ? 0.0f : 1.0f) << k;
    }
  }
}

TEST_F(Meshes, ACallbackCannotEndTheMeshOrChangeItsMaps) {
  Caller caller = {gl, nullptr, {}};
  const glev_sink sink = caller.make_sink();
  glevSetSink(gl, &sink);
  const std::vector<double> before = query_state();
  void (*const calls[])(glev_context*) = {
      [](glev_context* context) { glevEnd(context); },
      [](glev_context* context) { glevBegin(context, GLEV_POINTS); },
      [](glev_context* context) { glevDisable(context, GLEV_MAP2_VERTEX_3); },
      [](glev_context* context) { glevMapGrid2f(context, 9, 0, 1, 9, 0, 1); },
      [](glev_context* context) { glevEvalMesh2(context, GLEV_POINT, 0, 3, 0, 3); },
  };
  for (const auto& call : calls) {
    caller.call = call;
    caller.vertices.clear();
    caller.ended = 0;
    glevEvalMesh2(gl, GLEV_FILL, 0, 2, 0, 2);
    expect_error(GLEV_INVALID_OPERATION);
    EXPECT_EQ(caller.vertices.size(), 12u);
    EXPECT_EQ(caller.ended, 2);
    caller.vertices.clear();
    glevEvalMesh1(gl, GLEV_LINE, 0, 2);
    expect_error(GLEV_INVALID_OPERATION);
    EXPECT_EQ(caller.vertices.size(), 3u);
    EXPECT_EQ(query_state(), before);
  }
  // Outside meshes, callers may call End.
  caller.call = [](glev_context*) {};
  expect_accepted([&] { glevBegin(gl, GLEV_POINTS), glevEnd(gl); });
}

TEST_F(Meshes, ACallbackMayEvaluate) {
  static int depth;
  depth = 0;
  Caller caller = {gl,
                   [](glev_context* context) {
                     if (depth != 0) return;
                     ++depth;
                     glevEvalCoord1f(context, 0.5f);
                     glevEvalPoint2(context, 1, 1);
                     --depth;
                   },
                   {}};
  const glev_vertex one = one_vertex([&] { glevEvalCoord1f(gl, 0.5f); }), two = point_at(1, 1);
  mesh2(GLEV_POINT, 0, 1, 0, 0);
  const std::vector<glev_vertex> plain = recording.vertices;
  const glev_sink sink = caller.make_sink();
  glevSetSink(gl, &sink);
  expect_accepted([&] { glevEvalMesh2(gl, GLEV_POINT, 0, 1, 0, 0); });
  ASSERT_EQ(caller.vertices.size(), 6u);
  const glev_vertex expected[] = {plain[0], one, two, plain[1], one, two};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_TRUE(same_bits(caller.vertices[k], expected[k])) << k;
}

TEST_F(Meshes, WithoutASinkNothingBreaks) {
  glevSetSink(gl, nullptr);
  for (glev_enum mode : kMeshModes) expect_accepted([&] { glevEvalMesh2(gl, mode, 0, 2, 0, 2); });
  expect_accepted([&] { glevEvalMesh1(gl, GLEV_LINE, 0, 2); });
}

}  // namespace
}  // namespace glev_tests
