// Tests the judge: values that it must accept, and values that it must reject.
#include <gtest/gtest.h>
#include <reference/rounding.h>

#include <cmath>
#include <limits>

#include <evalcts/judge/judge.h>

namespace evalcts {
namespace {

// A vertex map of order 4 that is evaluated at a few arguments, and the observation of a perfect
// implementation.
struct Scene {
  gl::Case script;
  Prediction prediction;
  Observation exact;  // correctly rounded

  explicit Scene(GLenum extra = 0) {
    script.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 4,
                 std::vector<float>{1, -2, 3, 0.5, 7, -1, 2, 2, 2, -3, 1, 0.25});
    script.Enable(GL_MAP1_VERTEX_3);
    if (extra == GL_MAP1_COLOR_4) {
      script.Map1f(extra, 0, 1, 4, 2, std::vector<float>{-1, 0.25, 0.5, 1, 3, 0.25, 0.75, 1});
      script.Enable(extra);
    }
    script.Normal3f(0.1f, 0.2f, 0.3f);
    script.Begin(GL_POINTS);
    for (const float u : {0.0f, 0.3f, 0.75f, 1.0f}) script.EvalCoord1f(u);
    script.End();
    prediction = predict(script, 30);
    exact.attributes = kAllAttributes;
    exact.units = kTextureUnits;
    ObservedPrimitive& points = exact.primitives.emplace_back();
    for (const reference::Vertex& vertex : prediction.primitives.at(0).vertices) {
      ObservedVertex& seen = points.vertices.emplace_back();
      for (std::size_t i = 0; i < 4; ++i) seen.position[i] = reference::rounded(vertex.position[i]);
      for (std::size_t i = 0; i < 4; ++i) seen.color[i] = reference::rounded(vertex.color[i]);
      seen.normal = reference::rounded(vertex.normal);
      for (std::size_t unit = 0; unit < kTextureUnits; ++unit)
        for (std::size_t i = 0; i < 4; ++i)
          seen.texture_coordinate[unit][i] = reference::rounded(vertex.texture_coordinate[unit][i]);
    }
  }

  ObservedVertex& vertex(std::size_t i) { return exact.primitives[0].vertices[i]; }
};

TEST(Judge, AcceptsCorrectlyRoundedValues) {
  const Scene scene;
  const Judgement judgement = judge(scene.prediction, scene.exact, {});
  EXPECT_TRUE(judgement.mismatches.empty());
  EXPECT_EQ(judgement.accuracy.values, 12u);
  EXPECT_EQ(judgement.accuracy.not_correctly_rounded, 0u);
  EXPECT_LE(judgement.accuracy.ulp.error, 0.5);
  EXPECT_EQ(judgement.accuracy.condition_aware.error, 0);
}

TEST(Judge, MeasuresValuesThatAreNotCorrectlyRounded) {
  Scene scene;
  float& x = scene.vertex(1).position[0];
  x = std::nextafter(x, 10.0f);
  const Judgement judgement = judge(scene.prediction, scene.exact, {});
  EXPECT_EQ(judgement.accuracy.not_correctly_rounded, 1u);
  EXPECT_GT(judgement.accuracy.ulp.error, 0.5);
  EXPECT_GT(judgement.accuracy.condition_aware.error, 0);
}

TEST(Judge, CountsVertices) {
  Scene scene;
  scene.exact.primitives[0].vertices.resize(1);
  const Judgement judgement = judge(scene.prediction, scene.exact, {});
  ASSERT_EQ(judgement.mismatches.size(), 1u);
  EXPECT_EQ(judgement.mismatches[0].message, "1 vertex instead of 4 vertices");
}

TEST(Judge, ValuesAreTheFormula) {
  // The expected value is the Bernstein sum in long double, computed independently of the oracle.
  const Scene scene;
  const long double t = 0.75L, s = 0.25L;
  const long double x = s * s * s * 1 + 3 * t * s * s * 0.5L + 3 * t * t * s * 2 + t * t * t * -3;
  EXPECT_EQ(scene.exact.primitives[0].vertices[2].position[0], static_cast<float>(x));
}

TEST(Judge, AcceptsUpToTheBoundAndNotBeyond) {
  for (const Level level : {Level::kMust, Level::kQuality}) {
    Scene scene;
    const reference::Component& component = scene.prediction.primitives[0].vertices[1].position[1];
    const reference::Rational bound =
        level == Level::kMust ? reference::acceptance_bound(component) : reference::quality_bound(component);
    const reference::Rational exact = reference::exact(component);
    // `inside` is the largest float within the bound; the next float is outside.
    float inside = reference::round_to_float(exact + bound);
    if (!reference::is_within(inside, exact, bound)) inside = std::nextafterf(inside, -HUGE_VALF);
    const float outside = std::nextafterf(inside, HUGE_VALF);
    scene.vertex(1).position[1] = inside;
    EXPECT_TRUE(judge(scene.prediction, scene.exact, {.level = level}).mismatches.empty());
    scene.vertex(1).position[1] = outside;
    const Judgement judgement = judge(scene.prediction, scene.exact, {.level = level});
    ASSERT_EQ(judgement.mismatches.size(), 1u);
    EXPECT_EQ(judgement.mismatches[0].what, "position.y of vertex 1");
    EXPECT_GT(judgement.mismatches[0].ulp, 1);
  }
}

TEST(Judge, RefusesWhatIsNoNumber) {
  for (const float value : {std::nanf(""), HUGE_VALF, -HUGE_VALF}) {
    Scene scene;
    scene.vertex(2).position[0] = value;
    EXPECT_EQ(judge(scene.prediction, scene.exact, {}).mismatches.size(), 1u);
  }
}

TEST(Judge, GivenValuesComeBackBitForBitButNegativeZero) {
  Scene scene;
  scene.vertex(0).normal[1] = std::nextafterf(0.2f, 1.0f);
  EXPECT_EQ(judge(scene.prediction, scene.exact, {}).mismatches.size(), 1u);
  scene.vertex(0).normal[1] = 0.2f;
  scene.vertex(0).texture_coordinate[3][0] = -0.0f;
  EXPECT_TRUE(judge(scene.prediction, scene.exact, {}).mismatches.empty());
}

TEST(Judge, JudgesOnlyWhatWasObservedAndAskedFor) {
  Scene scene;
  scene.vertex(0).normal[0] = 9;
  EXPECT_EQ(judge(scene.prediction, scene.exact, {.attributes = kPosition}).mismatches.size(), 0u);
  scene.exact.attributes = kPosition | kColor;
  EXPECT_EQ(judge(scene.prediction, scene.exact, {}).mismatches.size(), 0u);
  scene.exact.attributes = kNormal;
  EXPECT_EQ(judge(scene.prediction, scene.exact, {}).mismatches.size(), 1u);
}

TEST(Judge, MissingAndSurplusVerticesAreOneMismatch) {
  Scene scene;
  scene.exact.primitives[0].vertices.pop_back();
  EXPECT_EQ(judge(scene.prediction, scene.exact, {}).mismatches.size(), 1u);
  scene.exact.primitives[0].vertices.resize(5);
  EXPECT_EQ(judge(scene.prediction, scene.exact, {}).mismatches.size(), 1u);
}

TEST(Judge, ClampedColors) {
  Scene scene(GL_MAP1_COLOR_4);
  scene.exact.clamped_colors = true;
  for (ObservedVertex& vertex : scene.exact.primitives[0].vertices)
    for (float& value : vertex.color) value = std::fmin(std::fmax(value, 0.0f), 1.0f);
  EXPECT_TRUE(judge(scene.prediction, scene.exact, {}).mismatches.empty());
  scene.vertex(1).color[0] = 0.9f;  // the correct value is 0.2
  EXPECT_EQ(judge(scene.prediction, scene.exact, {}).mismatches.size(), 1u);
  scene.vertex(1).color[0] = 1.0f;  // also wrong, although 1 could be the result of clamping
  EXPECT_EQ(judge(scene.prediction, scene.exact, {}).mismatches.size(), 1u);
}

TEST(Judge, MakesNoDemandBeyondThePromisedRange) {
  gl::Case c;
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, std::vector<float>{0x1p40f, 0, 0, 0x1p41f, 0, 0});
  c.Enable(GL_MAP1_VERTEX_3);
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.5f);
  c.End();
  Observation observation;
  observation.attributes = kPosition;
  observation.primitives.push_back({GL_POINTS, {ObservedVertex{}}});
  observation.primitives[0].vertices[0].position = {-1, 0, 0, 1};
  const Judgement judgement = judge(predict(c, 30), observation, {});
  EXPECT_TRUE(judgement.mismatches.empty());
  EXPECT_EQ(judgement.accuracy.not_judged, 1u);
}

TEST(Captures, DisagreementIsSeenButNotForSubnormalsAndZeros) {
  Scene scene;
  Observation other = scene.exact;
  const Topology points = Topology::points(scene.prediction.vertex_count());
  EXPECT_EQ(disagreement({scene.exact, points}, {other, points}), "");
  other.primitives[0].vertices[1].texture_coordinate[0][2] = 1e-39f;
  EXPECT_EQ(disagreement({scene.exact, points}, {other, points}), "");
  other.primitives[0].vertices[1].position[0] =
      std::nextafterf(other.primitives[0].vertices[1].position[0], 9.0f);
  EXPECT_NE(disagreement({scene.exact, points}, {other, points}), "");
  other = scene.exact;
  other.primitives[0].vertices.pop_back();
  EXPECT_NE(disagreement({scene.exact, points}, {other, points}), "");
}

TEST(Accuracy, KeepsTheWorst) {
  Accuracy a, b;
  a.values = 3, a.ulp = {2, "a", 0, ""};
  b.values = 4, b.ulp = {7, "b", 0, ""}, b.not_correctly_rounded = 1;
  a.add(b);
  EXPECT_EQ(a.values, 7u);
  EXPECT_EQ(a.ulp.where, "b");
  EXPECT_EQ(a.not_correctly_rounded, 1u);
}

// --- Automatic normals -----------------------------------------------------------------------------------

// A plane of 10 by 10 whose normal is (0,0,1), with length 100 before normalisation. Its domain in u is [1,0]
// if `reversed`, its domain in v is [1,0] if `v_reversed`.
struct Plane {
  Prediction prediction;
  Observation seen;

  Plane(bool reversed, Attributes how, std::array<float, 3> normal, bool v_reversed = false) {
    gl::Case c;
    c.Map2f(GL_MAP2_VERTEX_3, reversed, !reversed, 6, 2, v_reversed, !v_reversed, 3, 2,
            std::vector<float>{0, 0, 5, 0, 10, 5, 10, 0, 5, 10, 10, 5});
    c.Enable(GL_MAP2_VERTEX_3);
    c.Enable(GL_AUTO_NORMAL);
    c.Begin(GL_POINTS);
    c.EvalCoord2f(0.5f, 0.25f);
    c.End();
    prediction = predict(c, 8);
    seen.attributes = kNormal | how;
    seen.primitives.push_back({GL_POINTS, {ObservedVertex{}}});
    seen.primitives[0].vertices[0].normal = normal;
  }

  std::size_t mismatches(JudgeOptions options = {}) const {
    return judge(prediction, seen, options).mismatches.size();
  }
};

TEST(JudgeNormals, DemandUnitLengthWithoutAShader) {
  EXPECT_EQ(Plane(false, kUnitNormal, {0, 0, 1}).mismatches(), 0u);
  EXPECT_EQ(Plane(false, kUnitNormal, {0, 0, 100}).mismatches(), 1u);
  EXPECT_EQ(Plane(false, kUnitNormal, {0, 0, -1}).mismatches(), 1u);
  EXPECT_EQ(Plane(false, kUnitNormal, {0, 0, 0}).mismatches(), 1u);
  EXPECT_EQ(Plane(false, kUnitNormal, {0.01f, 0, 1}).mismatches(), 1u);
  EXPECT_EQ(Plane(false, kUnitNormal, {NAN, 0, 1}).mismatches(), 1u);
}

TEST(JudgeNormals, AllowAnyMethodUnlessQualityIsAsked) {
  for (const float error : {0.0015f, 0.00005f, 1e-7f}) {
    const Plane plane(false, kUnitNormal, {error, 0, std::sqrt(1 - error * error)});
    EXPECT_EQ(plane.mismatches(), 0u);
    EXPECT_EQ(plane.mismatches({.level = Level::kQuality}), error > 1e-6f ? 1u : 0u) << error;
  }
}

TEST(JudgeNormals, HaveAnyLengthWithAShaderUnlessAsked) {
  EXPECT_EQ(Plane(false, kShaderNormal, {0, 0, 100}).mismatches(), 0u);
  EXPECT_EQ(Plane(false, kShaderNormal, {0, 0, 1}).mismatches(), 0u);
  EXPECT_EQ(Plane(false, kShaderNormal, {0, 0, -100}).mismatches(), 1u);
  const JudgeOptions lengths{.lengths_of_shader_normals = true};
  EXPECT_EQ(Plane(false, kShaderNormal, {0, 0, 100}).mismatches(lengths), 0u);
  EXPECT_EQ(Plane(false, kShaderNormal, {0, 0, 1}).mismatches(lengths), 1u);
}

TEST(JudgeNormals, HaveEitherSignWhereOneDirectionIsReversed) {
  EXPECT_EQ(Plane(true, kUnitNormal, {0, 0, 1}).mismatches(), 0u);
  EXPECT_EQ(Plane(true, kUnitNormal, {0, 0, -1}).mismatches(), 0u);
  EXPECT_EQ(Plane(false, kUnitNormal, {0, 0, 1}, true).mismatches(), 0u);
  EXPECT_EQ(Plane(false, kUnitNormal, {0, 0, -1}, true).mismatches(), 0u);
  // If both directions are reversed, all readings agree.
  EXPECT_EQ(Plane(true, kUnitNormal, {0, 0, 1}, true).mismatches(), 0u);
  EXPECT_EQ(Plane(true, kUnitNormal, {0, 0, -1}, true).mismatches(), 1u);
  EXPECT_EQ(Plane(true, kShaderNormal, {0, 0, -3}, true).mismatches(), 1u);
  EXPECT_EQ(Plane(true, kUnitNormal, {0, 1, 0}).mismatches(), 1u);
}

// --- Transformed vectors ---------------------------------------------------------------------------------

// A transformation turns infinity in one component into NaN in the others.
TEST(JudgeVectors, CountAsAWholeWhereTheyWereTransformed) {
  const auto mismatches = [](float most, const JudgeOptions& options) {
    gl::Case c;
    const std::vector<float> points = {0, 0, 0, most, 0, 0}, coordinates = {0, 0, most, 0};
    c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, points);
    c.Map1f(GL_MAP1_TEXTURE_COORD_2, 0, 1, 2, 2, coordinates);
    c.Enable(GL_MAP1_VERTEX_3);
    c.Enable(GL_MAP1_TEXTURE_COORD_2);
    c.Begin(GL_POINTS);
    c.EvalCoord1f(1000);
    c.End();
    const float infinity = std::numeric_limits<float>::infinity(), none = std::nanf("");
    Observation seen;
    seen.attributes = kPosition | kTextureCoordinate0;
    seen.units = 1;
    ObservedVertex vertex;
    vertex.position = {infinity, none, none, 1};
    vertex.texture_coordinate[0] = {infinity, none, none, 1};
    seen.primitives = {{GL_POINTS, {vertex}}};
    return judge(predict(c, 8), seen, options).mismatches.size();
  };
  EXPECT_EQ(mismatches(3e38f, {.vectors_as_a_whole = true}), 0u);
  EXPECT_EQ(mismatches(3e38f, {}), 4u);  // mismatches of y, z, t and r
  EXPECT_EQ(mismatches(1, {.vectors_as_a_whole = true}), 6u);
}

}  // namespace
}  // namespace evalcts
