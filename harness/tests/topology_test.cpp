// Tests topologies: the way in which lines and polygons are split is learned from explicit vertices.
#include <gtest/gtest.h>

#include <cmath>

#include <evalcts/judge/judge.h>

namespace evalcts {
namespace {

Prediction predicted(GLenum mode, int vertices) {
  gl::Case c;
  c.Begin(mode);
  for (int i = 0; i < vertices; ++i) c.Vertex2f(static_cast<float>(10 + i), 1);
  c.End();
  return predict(c, 8);
}

// Returns primitives whose vertices have these numbers as x.
Observation observed(GLenum mode, const std::vector<std::vector<float>>& primitives) {
  Observation observation;
  observation.attributes = kPosition;
  for (const std::vector<float>& numbers : primitives) {
    ObservedPrimitive& primitive = observation.primitives.emplace_back();
    primitive.mode = mode;
    for (const float x : numbers) {
      primitive.vertices.emplace_back().position = {x, x < 10 ? 0.0f : 1.0f, 0, 1};
    }
  }
  return observation;
}

TEST(Topology, LearnsTrianglesOfAQuad) {
  const Prediction quad = predicted(GL_QUADS, 5);  // the fifth is left over
  const auto topology = read_topology(quad, observed(GL_TRIANGLES, {{0, 1, 3}, {1, 2, 3}}));
  ASSERT_TRUE(topology);
  EXPECT_EQ(topology->vertices, (std::vector<std::size_t>{0, 1, 3, 1, 2, 3}));
  EXPECT_TRUE(
      judge(quad, *topology, observed(GL_TRIANGLES, {{10, 11, 13}, {11, 12, 13}}), {}).mismatches.empty());
  EXPECT_EQ(
      judge(quad, *topology, observed(GL_TRIANGLES, {{10, 11, 13}, {11, 13, 12}}), {}).mismatches.size(), 2u);
}

TEST(Topology, AnotherShapeIsAMismatch) {
  const Prediction loop = predicted(GL_LINE_LOOP, 3);
  const auto topology = read_topology(loop, observed(GL_LINES, {{0, 1}, {1, 2}, {2, 0}}));
  ASSERT_TRUE(topology);
  const Judgement judgement = judge(loop, *topology, observed(GL_LINES, {{10, 11}, {11, 12}}), {});
  ASSERT_EQ(judgement.mismatches.size(), 1u);
  EXPECT_EQ(judgement.mismatches[0].what, "primitives");
  EXPECT_EQ(judgement.mismatches[0].expected, "3 LINES of 2 vertices");
}

TEST(Topology, IsUnknownWhereExplicitVerticesAreLost) {
  const Prediction strip = predicted(GL_LINE_STRIP, 3);
  EXPECT_FALSE(read_topology(strip, observed(GL_LINES, {{0, 1}})));
  EXPECT_FALSE(read_topology(strip, observed(GL_LINES, {{0, 1}, {1, 2.5f}})));
  EXPECT_FALSE(read_topology(strip, observed(GL_LINES, {{0, 1}, {1, 3}})));
  EXPECT_TRUE(read_topology(predicted(GL_LINE_STRIP, 1), observed(GL_LINES, {})));
  EXPECT_TRUE(read_topology(predicted(GL_TRIANGLES, 4), observed(GL_TRIANGLES, {{0, 1, 2}})));
}

TEST(Topology, CapturesThatTakeApartDifferentlyAgree) {
  const Prediction quad = predicted(GL_QUADS, 4);
  const auto triangles = read_topology(quad, observed(GL_TRIANGLES, {{0, 1, 3}, {1, 2, 3}}));
  const auto polygon = read_topology(quad, observed(GL_POLYGON, {{0, 1, 2, 3}}));
  const Observation two = observed(GL_TRIANGLES, {{10, 11, 13}, {11, 12, 13}});
  EXPECT_EQ(disagreement({two, *triangles}, {observed(GL_POLYGON, {{10, 11, 12, 13}}), *polygon}), "");
  EXPECT_NE(disagreement({two, *triangles}, {observed(GL_POLYGON, {{10, 11, 12, 14}}), *polygon}), "");
}

// --- Quads matched by their values -----------------------------------------------------------------------

using Numbers = std::vector<std::size_t>;

TEST(MatchQuads, FindsEitherDiagonalAndAnyTurn) {
  const Prediction strip = predicted(GL_QUAD_STRIP, 6);  // 0 1 3 2 and 2 3 5 4
  const auto matched =
      match_quads(strip, observed(GL_TRIANGLES, {{13, 12, 10}, {11, 13, 10}, {12, 13, 14}, {13, 15, 14}}));
  ASSERT_TRUE(matched);
  EXPECT_EQ(matched->vertices, (Numbers{3, 2, 0, 1, 3, 0, 2, 3, 4, 3, 5, 4}));
  const auto whole = match_quads(strip, observed(GL_POLYGON, {{13, 12, 10, 11}, {12, 13, 15, 14}}));
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->vertices, (Numbers{3, 2, 0, 1, 2, 3, 5, 4}));
}

TEST(MatchQuads, SeesTheOtherWindingAndTheWrongQuad) {
  const Prediction quad = predicted(GL_QUADS, 4);
  const auto mismatches = [&](const Observation& seen) {
    const auto matched = match_quads(quad, seen);
    return matched ? judge(quad, *matched, seen, {}).mismatches.size() : 99;
  };
  EXPECT_EQ(mismatches(observed(GL_TRIANGLES, {{10, 11, 12}, {12, 13, 10}})), 0u);
  EXPECT_GT(mismatches(observed(GL_TRIANGLES, {{10, 12, 11}, {12, 13, 10}})), 0u);
  EXPECT_GT(mismatches(observed(GL_POLYGON, {{13, 12, 11, 10}})), 0u);
  EXPECT_GT(mismatches(observed(GL_POLYGON, {{10, 11, 12, 14}})), 0u);
  EXPECT_GT(mismatches(observed(GL_TRIANGLES, {{10, 11, 12}, {10, 11, 12}})), 0u);
}

// Clamped colours do not identify a vertex.
TEST(MatchQuads, ClampedColorsDoNotMislead) {
  gl::Case c;
  c.Begin(GL_QUADS);
  for (int i = 0; i < 4; ++i) {
    c.Color4f(i % 2 ? -20 : 0.5f, 0, 0, 1);
    c.Vertex2f(static_cast<float>(10 + i), 1);
  }
  c.End();
  const Prediction quad = predict(c, 8);
  Observation seen = observed(GL_TRIANGLES, {{10, 11, 13}, {11, 12, 13}});
  seen.attributes |= kColor;
  seen.clamped_colors = true;
  for (ObservedPrimitive& triangle : seen.primitives)
    for (ObservedVertex& vertex : triangle.vertices)
      vertex.color = {std::fmod(vertex.position[0], 2.0f) == 0 ? 0.5f : 0.0f, 0, 0, 1};
  const auto matched = match_quads(quad, seen);
  ASSERT_TRUE(matched);
  EXPECT_EQ(matched->vertices, (Numbers{0, 1, 3, 1, 2, 3}));
}

TEST(MatchQuads, NeedsAsManyAsThereAre) {
  const Prediction quads = predicted(GL_QUADS, 9);  // the ninth is left over
  EXPECT_TRUE(match_quads(quads, observed(GL_POLYGON, {{10, 11, 12, 13}, {14, 15, 16, 17}})));
  EXPECT_FALSE(match_quads(quads, observed(GL_POLYGON, {{10, 11, 12, 13}})));
  EXPECT_FALSE(
      match_quads(quads, observed(GL_POLYGON, {{10, 11, 12, 13}, {14, 15, 16, 17}, {14, 15, 16, 17}})));
  EXPECT_FALSE(match_quads(quads, observed(GL_TRIANGLES, {{10, 11, 12}, {10, 12, 13}, {14, 15, 16}})));
  EXPECT_FALSE(match_quads(predicted(GL_TRIANGLES, 3), observed(GL_TRIANGLES, {{10, 11, 12}})));
}

TEST(MatchQuads, TakesNoStripForAQuad) {
  EXPECT_FALSE(match_quads(predicted(GL_QUADS, 4), observed(GL_TRIANGLE_STRIP, {{10, 11, 13, 12}})));
}

// Sinks hand over the strips of a mesh unchanged.
TEST(TrianglesOfMeshes, AreTakenForQuads) {
  gl::Case c;
  c.Map2f(GL_MAP2_VERTEX_3, 0.0f, 1.0f, 3, 2, 0.0f, 1.0f, 6, 2,
          std::vector<float>{10, 1, 0, 11, 1, 0, 20, 1, 0, 21, 1, 0});
  c.Enable(GL_MAP2_VERTEX_3);
  c.Begin(GL_QUAD_STRIP);
  for (int i = 0; i < 4; ++i) c.Vertex2f(static_cast<float>(10 + i), 1);
  c.End();
  c.EvalMesh2(GL_FILL, 0, 1, 0, 1);
  const Prediction prediction = predict(c, 8);
  const auto topology = read_topology(prediction, observed(GL_QUAD_STRIP, {{0, 1, 2, 3}, {4, 5, 6, 7}}));
  ASSERT_TRUE(topology);
  Observation seen = observed(GL_QUAD_STRIP, {{10, 11, 12, 13}});
  seen.primitives.push_back(observed(GL_TRIANGLE_STRIP, {{10, 20, 11, 21}}).primitives[0]);
  EXPECT_FALSE(judge(prediction, *topology, seen, {}).mismatches.empty());
  take_triangles_of_meshes_for_quads(prediction, *topology, seen);
  EXPECT_TRUE(judge(prediction, *topology, seen, {}).mismatches.empty());
  seen.primitives[0].mode = GL_TRIANGLE_STRIP;  // not of the mesh
  take_triangles_of_meshes_for_quads(prediction, *topology, seen);
  EXPECT_FALSE(judge(prediction, *topology, seen, {}).mismatches.empty());
}

// --- Meshes in another order -----------------------------------------------------------------------------

// Returns a mesh of n x 1 segments, with vertex (i, j) at x = 10 + i + 10 j.
gl::Case mesh(GLenum mode, int n) {
  gl::Case c;
  const auto last = static_cast<float>(10 + n);
  c.Map2f(GL_MAP2_VERTEX_3, 0, 1, 6, 2, 0, 1, 3, 2,
          std::vector<float>{10, 1, 0, 20, 1, 0, last, 1, 0, last + 10, 1, 0});
  c.Enable(GL_MAP2_VERTEX_3);
  c.MapGrid2f(n, 0, 1, 1, 0, 1);
  c.EvalMesh2(mode, 0, n, 0, 1);
  return c;
}

// Returns the prediction of two such meshes with a vertex between them.
Prediction predicted_meshes(GLenum mode) {
  gl::Case c = mesh(mode, 2);
  c.Begin(GL_POINTS);
  c.Vertex2f(30, 1);
  c.End();
  c.EvalMesh2(mode, 0, 1, 0, 1);
  return predict(c, 8);
}

// Returns the number of mismatches if meshes may be drawn in another order.
std::size_t wrong_in_own_order(const Prediction& prediction, const Topology& topology,
                               const Observation& seen) {
  const auto matched = match_meshes(prediction, topology, seen);
  return matched ? judge(prediction, *matched, seen, {}).mismatches.size() : 99;
}

TEST(MatchMeshes, FindsPointsWhereverTheyAreInTheMesh) {
  const Prediction points = predicted_meshes(GL_POINT);
  const Topology text = Topology::points(11);
  const auto wrong = [&](const std::vector<float>& numbers) {
    std::vector<std::vector<float>> single;
    for (const float number : numbers) single.push_back({number});
    return wrong_in_own_order(points, text, observed(GL_POINTS, single));
  };
  EXPECT_EQ(wrong({10, 11, 12, 20, 21, 22, 30, 10, 11, 20, 21}), 0u);
  EXPECT_EQ(wrong({10, 20, 11, 21, 12, 22, 30, 21, 11, 20, 10}), 0u);
  EXPECT_GT(wrong({10, 20, 11, 21, 12, 12, 30, 21, 11, 20, 10}), 0u);  // one vertex is drawn twice
  EXPECT_GT(wrong({10, 20, 11, 21, 12, 30, 22, 21, 11, 20, 10}), 0u);  // one vertex is drawn too late
  EXPECT_GT(wrong({21, 11, 20, 10, 30, 10, 20, 11, 21, 12, 22}), 0u);  // the meshes are exchanged
  EXPECT_EQ(wrong({10, 20, 11, 21, 12, 22, 30, 21, 11, 20}), 99u);
  EXPECT_EQ(match_meshes(predicted(GL_POINTS, 1), Topology::points(1), observed(GL_POINTS, {{10}})),
            std::nullopt);
}

// All points of this mesh coincide; their normals do not.
TEST(MatchMeshes, NormalsTellPointsApart) {
  gl::Case c;
  c.Map2f(GL_MAP2_VERTEX_3, 0, 1, 3, 1, 0, 1, 3, 1, std::vector<float>{10, 1, 0});
  c.Map2f(GL_MAP2_NORMAL, 0, 1, 3, 1, 0, 1, 3, 2, std::vector<float>{0, 0, 1, 0, 1, 0});
  c.Enable(GL_MAP2_VERTEX_3);
  c.Enable(GL_MAP2_NORMAL);
  c.MapGrid2f(1, 0, 1, 1, 0, 1);
  c.EvalMesh2(GL_POINT, 0, 1, 0, 1);
  Observation seen = observed(GL_POINTS, {{10}, {10}, {10}, {10}});
  seen.attributes |= kNormal;
  for (std::size_t i = 0; i < 4; ++i)
    seen.primitives[i].vertices[0].normal =
        i % 2 ? std::array<float, 3>{0, 1, 0} : std::array{0.0f, 0.0f, 1.0f};
  EXPECT_EQ(wrong_in_own_order(predict(c, 8), Topology::points(4), seen), 0u);
}

// A triangle with a pole, at which there is no automatic normal. The captured normals of the other vertices
// have another length or sign.
TEST(MatchMeshes, AutomaticNormalsDoNotMislead) {
  gl::Case c;
  c.Map2f(GL_MAP2_VERTEX_3, 0, 1, 6, 2, 0, 1, 3, 2,
          std::vector<float>{10, 1, 0, 11, 1, 0, 10, 1, 0, 11, 1, 1});
  c.Enable(GL_MAP2_VERTEX_3);
  c.Enable(GL_AUTO_NORMAL);
  c.MapGrid2f(1, 0, 1, 1, 0, 1);
  c.EvalMesh2(GL_POINT, 0, 1, 0, 1);
  Observation seen = observed(GL_POINTS, {{11}, {10}, {11}, {10}});
  seen.attributes |= kNormal;
  seen.primitives[0].vertices[0].position[2] = 1;
  for (ObservedPrimitive& primitive : seen.primitives) primitive.vertices[0].normal = {0, 50, 0};
  seen.primitives[2].vertices[0].normal = {0, -1, 0};
  const auto matched = match_meshes(predict(c, 8), Topology::points(4), seen);
  ASSERT_TRUE(matched);
  EXPECT_EQ(matched->vertices[0], 3u);
  EXPECT_EQ(matched->vertices[2], 2u);
}

TEST(MatchMeshes, LinesGoEitherWay) {
  const Prediction lines = predict(mesh(GL_LINE, 1), 8);
  const auto text = read_topology(lines, observed(GL_LINES, {{0, 1}, {2, 3}, {4, 5}, {6, 7}}));
  ASSERT_TRUE(text);
  const auto wrong = [&](const std::vector<std::vector<float>>& numbers) {
    return wrong_in_own_order(lines, *text, observed(GL_LINES, numbers));
  };
  EXPECT_EQ(wrong({{10, 11}, {20, 21}, {10, 20}, {11, 21}}), 0u);
  EXPECT_EQ(wrong({{20, 10}, {11, 10}, {20, 21}, {21, 11}}), 0u);
  EXPECT_GT(wrong({{20, 10}, {11, 10}, {20, 21}, {20, 11}}), 0u);
  EXPECT_GT(wrong({{10, 11}, {10, 11}, {10, 20}, {11, 21}}), 0u);
}

// Each of 4000 lines, and of 4000 quads, is found, although comparing every one with every other would take
// long. The quads are much longer in u than the mesh is in v.
TEST(MatchMeshes, LongMeshesInTheOppositeOrder) {
  constexpr int kCount = 4000, kWidth = 100'000;
  gl::Case grid;
  grid.Map2f(GL_MAP2_VERTEX_3, 0, 1, 6, 2, 0, kCount, 3, 2,
             std::vector<float>{10, 1, 0, 10 + kCount, 1, 0, 10 + kWidth, 1, 0, 10 + kWidth + kCount, 1, 0});
  grid.Enable(GL_MAP2_VERTEX_3);
  grid.MapGrid2f(1, 0, 1, kCount, 0, kCount);
  for (const GLenum mode : {GL_LINE, GL_FILL}) {
    const bool is_filled = mode == GL_FILL;
    gl::Case c = grid;
    c.EvalMesh2(mode, 0, is_filled ? 1 : 0, 0, kCount);
    std::vector<std::vector<float>> in_order, opposite;
    for (int j = 0; j < kCount; ++j) {
      // The rows of the lines come first, which have one vertex each.
      const auto first = static_cast<float>(is_filled ? 4 * j : kCount + 1 + j);
      const auto end = static_cast<float>(9 + kCount - j);
      in_order.push_back({first, first + 1});
      opposite.push_back({end + 1, end});
      if (!is_filled) continue;
      in_order.back().insert(in_order.back().end(), {first + 3, first + 2});
      opposite.back() = {end, end + 1, end + 1 + kWidth, end + kWidth};
    }
    const GLenum kind = is_filled ? GL_POLYGON : GL_LINES;
    const Prediction mesh = predict(c, 8);
    const auto text = read_topology(mesh, observed(kind, in_order));
    ASSERT_TRUE(text);
    const Observation seen = observed(kind, opposite);
    EXPECT_EQ(wrong_in_own_order(mesh, *text, seen), 0u);
    EXPECT_EQ(judge(mesh, with_meshes_in_own_order(mesh, *text, seen, {}), seen, {}).mismatches.size(), 0u);
    opposite[7] = opposite[8];
    EXPECT_GT(wrong_in_own_order(mesh, *text, observed(kind, opposite)), 0u);
  }
}

TEST(MatchMeshes, QuadsAndTheirTriangles) {
  const Prediction filled = predict(mesh(GL_FILL, 2), 8);
  const auto text =
      read_topology(filled, observed(GL_TRIANGLES, {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}}));
  ASSERT_TRUE(text);
  const auto wrong = [&](GLenum mode, const std::vector<std::vector<float>>& numbers) {
    return wrong_in_own_order(filled, *text, observed(mode, numbers));
  };
  EXPECT_EQ(wrong(GL_TRIANGLES, {{10, 20, 21}, {10, 21, 11}, {11, 21, 22}, {11, 22, 12}}), 0u);
  EXPECT_EQ(wrong(GL_TRIANGLES, {{22, 12, 11}, {21, 22, 11}, {21, 11, 10}, {10, 20, 21}}), 0u);
  EXPECT_EQ(wrong(GL_POLYGON, {{22, 12, 11, 21}, {10, 20, 21, 11}}), 0u);
  EXPECT_GT(wrong(GL_POLYGON, {{22, 12, 11, 21}, {22, 12, 11, 21}}), 0u);
  EXPECT_GT(wrong(GL_POLYGON, {{22, 21, 11, 12}, {10, 20, 21, 11}}), 0u);  // one quad has the other winding
  EXPECT_EQ(wrong(GL_POLYGON, {{22, 12, 11, 21}}), 99u);
}

}  // namespace
}  // namespace evalcts
