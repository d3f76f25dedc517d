// Tests EvalCoord1: the maps that it evaluates, its vertices, and the state that it must not change.
#include <cmath>
#include <cstring>
#include <limits>

#include "fixture.h"

namespace glev_tests {
namespace {

class Evaluation : public ContextTest {
 protected:
  // Defines a line from `from` to `to` over [0,1] with equal components.
  void define_line(glev_enum target, float from, float to) {
    const float points[] = {from, from, from, from, to, to, to, to};
    glevMap1f(gl, target, 0, 1, 4, 2, points);
    glevEnable(gl, target);
  }
  glev_vertex evaluate_at(double u) {
    return one_vertex([&] { glevEvalCoord1d(gl, u); });
  }
};

TEST_F(Evaluation, Vertex3HasWOneAndVertex4HasItsOwn) {
  define_line(GLEV_MAP1_VERTEX_3, 0, 8);
  EXPECT_EQ(values_of(evaluate_at(0.25).position), (Floats{2, 2, 2, 1}));
  define_line(GLEV_MAP1_VERTEX_4, 0, 16);
  EXPECT_EQ(values_of(evaluate_at(0.25).position), (Floats{4, 4, 4, 4})) << "not divided";
}

TEST_F(Evaluation, ComponentsKeepTheirOrder) {
  const float points[] = {1, 2, 3, 4, 5, 7, 9, 11};
  for (const TargetRow& row : target_rows()) {
    glevMap1f(gl, GLEV_MAP1_COLOR_4 + row.offset, 0, 1, 4, 2, points);
    glevEnable(gl, GLEV_MAP1_COLOR_4 + row.offset);
  }
  const glev_vertex vertex = evaluate_at(0.5);
  EXPECT_EQ(values_of(vertex.position), (Floats{3, 4.5f, 6, 7.5f}));
  EXPECT_EQ(values_of(vertex.color), (Floats{3, 4.5f, 6, 7.5f})) << "not clamped";
  EXPECT_EQ(values_of(vertex.normal), (Floats{3, 4.5f, 6})) << "not normalised";
  EXPECT_EQ(values_of(vertex.texcoord[0]), (Floats{3, 4.5f, 6, 7.5f}));
}

TEST_F(Evaluation, AMapThatWasNeverDefinedIsItsInitialConstant) {
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  for (double u : {-3.0, 0.0, 0.5, 7.0}) EXPECT_EQ(values_of(evaluate_at(u).position), (Floats{0, 0, 0, 1}));
  glevNormal3f(gl, 9, 9, 9);
  glevColor4f(gl, 9, 9, 9, 9);
  glevTexCoord4f(gl, 9, 9, 9, 9);
  for (glev_enum target : {GLEV_MAP1_NORMAL, GLEV_MAP1_COLOR_4, GLEV_MAP1_TEXTURE_COORD_3})
    glevEnable(gl, target);
  EXPECT_EQ(values_of(evaluate_at(0.5).normal), (Floats{0, 0, 1}));
  EXPECT_EQ(values_of(evaluate_at(0.5).color), (Floats{1, 1, 1, 1}));
  EXPECT_EQ(values_of(evaluate_at(0.5).texcoord[0]), (Floats{0, 0, 0, 1}));
}

TEST_F(Evaluation, WithoutAVertexMapNothingAtAllHappens) {
  for (glev_enum target : {GLEV_MAP1_COLOR_4, GLEV_MAP1_INDEX, GLEV_MAP1_NORMAL, GLEV_MAP1_TEXTURE_COORD_4}) {
    define_line(target, 2, 3);
  }
  glevEnable(gl, GLEV_MAP2_VERTEX_3);
  glevEnable(gl, GLEV_MAP2_VERTEX_4);
  const std::vector<double> before = query_state();
  glevBegin(gl, GLEV_POINTS);
  glevEvalCoord1f(gl, 0.5f);
  glevEnd(gl);
  expect_error(GLEV_NO_ERROR);
  EXPECT_TRUE(recording.vertices.empty());
  EXPECT_EQ(query_state(), before);
}

TEST_F(Evaluation, OnlyOneDimensionalMapsAreLookedAt) {
  define_line(GLEV_MAP1_VERTEX_3, 0, 1);
  for (const TargetRow& row : target_rows()) glevEnable(gl, GLEV_MAP2_COLOR_4 + row.offset);
  glevEnable(gl, GLEV_AUTO_NORMAL);
  glevColor4f(gl, 0.1f, 0.2f, 0.3f, 0.4f);
  glevNormal3f(gl, 5, 6, 7);
  glevTexCoord4f(gl, 1, 2, 3, 4);
  const glev_vertex vertex = evaluate_at(0.5);
  EXPECT_EQ(values_of(vertex.position), (Floats{0.5f, 0.5f, 0.5f, 1}));
  EXPECT_EQ(values_of(vertex.color), (Floats{0.1f, 0.2f, 0.3f, 0.4f}));
  EXPECT_EQ(values_of(vertex.normal), (Floats{5, 6, 7}));
  EXPECT_EQ(values_of(vertex.texcoord[0]), (Floats{1, 2, 3, 4}));
}

TEST_F(Evaluation, CurrentValuesAreLeftAlone) {
  for (glev_enum target : {GLEV_MAP1_COLOR_4, GLEV_MAP1_INDEX, GLEV_MAP1_NORMAL, GLEV_MAP1_TEXTURE_COORD_1,
                           GLEV_MAP1_VERTEX_4}) {
    define_line(target, 2, 3);
  }
  glevColor4f(gl, 0.1f, 0.2f, 0.3f, 0.4f);
  glevNormal3f(gl, 5, 6, 7);
  glevTexCoord4f(gl, 5, 6, 7, 8);
  glevIndexf(gl, 17);
  glevEdgeFlag(gl, GLEV_FALSE);
  const std::vector<double> before = query_state();
  const glev_vertex evaluated = evaluate_at(0.5);
  EXPECT_EQ(query_state(), before);
  EXPECT_EQ(values_of(evaluated.texcoord[0]), (Floats{2.5f, 0, 0, 1}));
  // A Vertex in the same primitive uses the unchanged current values.
  recording = {};
  glevBegin(gl, GLEV_POINTS);
  glevEvalCoord1f(gl, 0.5f);
  glevVertex3f(gl, 1, 1, 1);
  glevEvalCoord1f(gl, 0.5f);
  glevEnd(gl);
  ASSERT_EQ(recording.vertices.size(), 3u);
  const glev_vertex& plain = recording.vertices[1];
  EXPECT_EQ(values_of(plain.position), (Floats{1, 1, 1, 1}));
  EXPECT_EQ(values_of(plain.color), (Floats{0.1f, 0.2f, 0.3f, 0.4f}));
  EXPECT_EQ(values_of(plain.normal), (Floats{5, 6, 7}));
  EXPECT_EQ(values_of(plain.texcoord[0]), (Floats{5, 6, 7, 8}));
  EXPECT_EQ(values_of(recording.vertices[2].color), (Floats{2.5f, 2.5f, 2.5f, 2.5f}));
}

TEST_F(Evaluation, WhatHasNoMapComesFromTheCurrentValuesAtThatMoment) {
  define_line(GLEV_MAP1_VERTEX_3, 0, 1);
  glevBegin(gl, GLEV_POINTS);
  for (float value : {2.0f, 3.0f}) {
    glevColor4f(gl, value, value, value, value);
    glevNormal3f(gl, value, value, value);
    for (int unit = 0; unit < 8; ++unit) {
      glevMultiTexCoord4f(gl, GLEV_TEXTURE0 + unit, value, static_cast<float>(unit), value, value);
    }
    glevIndexf(gl, value);
    glevEdgeFlag(gl, value == 2);
    glevEvalCoord1f(gl, 0.5f);
  }
  glevEnd(gl);
  expect_error(GLEV_NO_ERROR);
  ASSERT_EQ(recording.vertices.size(), 2u);
  for (std::size_t i : {0, 1}) {
    const float value = 2.0f + static_cast<float>(i);
    const glev_vertex& vertex = recording.vertices[i];
    EXPECT_EQ(values_of(vertex.color), (Floats{value, value, value, value}));
    EXPECT_EQ(values_of(vertex.normal), (Floats{value, value, value}));
    for (int unit = 0; unit < 8; ++unit) {
      EXPECT_EQ(values_of(vertex.texcoord[unit]), (Floats{value, static_cast<float>(unit), value, value}));
    }
    EXPECT_EQ(vertex.index, value);
    EXPECT_EQ(vertex.edge_flag, i == 0 ? GLEV_TRUE : GLEV_FALSE);
  }
}

TEST_F(Evaluation, IndexMapsDoNothing) {
  define_line(GLEV_MAP1_VERTEX_3, 0, 1);
  glevIndexf(gl, 17);
  const glev_vertex without = evaluate_at(0.5);
  define_line(GLEV_MAP1_INDEX, 40, 50);
  const glev_vertex with = evaluate_at(0.5);
  EXPECT_EQ(with.index, 17);
  EXPECT_EQ(values_of(with.position), values_of(without.position));
  float index;
  glevGetFloatv(gl, GLEV_CURRENT_INDEX, &index);
  EXPECT_EQ(index, 17);
}

TEST_F(Evaluation, TextureMapsFeedUnitZeroWhateverIsActive) {
  define_line(GLEV_MAP1_VERTEX_3, 0, 1);
  define_line(GLEV_MAP1_TEXTURE_COORD_2, 2, 4);
  for (int unit = 0; unit < 8; ++unit) {
    glevMultiTexCoord4f(gl, GLEV_TEXTURE0 + unit, static_cast<float>(unit), 9, 9, 9);
  }
  for (glev_enum active : {0, 1, 7}) {
    glevActiveTexture(gl, GLEV_TEXTURE0 + active);
    const glev_vertex vertex = evaluate_at(0.5);
    EXPECT_EQ(values_of(vertex.texcoord[0]), (Floats{3, 3, 0, 1}));
    for (int unit = 1; unit < 8; ++unit) {
      EXPECT_EQ(values_of(vertex.texcoord[unit]), (Floats{static_cast<float>(unit), 9, 9, 9}));
    }
  }
}

// ---- Precedence

TEST_F(Evaluation, TheTextureMapWithMostCoordinatesWins) {
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  for (bool backwards : {false, true}) {
    for (int subset = 1; subset < 16; ++subset) {
      int most = 0;
      for (int k = 1; k <= 4; ++k) glevDisable(gl, GLEV_MAP1_TEXTURE_COORD_1 + k - 1);
      for (int step = 1; step <= 4; ++step) {
        const int n = backwards ? 5 - step : step;
        if (!(subset & 1 << (n - 1))) continue;
        define_line(GLEV_MAP1_TEXTURE_COORD_1 + n - 1, 10.0f * n, 10.0f * n + 2);
        most = std::max(most, n);
      }
      Floats expected = {0, 0, 0, 1};
      std::fill_n(expected.begin(), most, 10.0f * most + 1);
      EXPECT_EQ(values_of(evaluate_at(0.5).texcoord[0]), expected) << "subset " << subset;
    }
  }
}

TEST_F(Evaluation, DisablingTheWinnerMakesTheNextEffective) {
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  for (int n = 1; n <= 4; ++n) define_line(GLEV_MAP1_TEXTURE_COORD_1 + n - 1, 10.0f * n, 10.0f * n + 2);
  glevTexCoord4f(gl, 5, 6, 7, 8);
  for (int n = 4; n >= 1; --n) {
    EXPECT_EQ(evaluate_at(0.5).texcoord[0][0], 10.0f * n + 1);
    glevDisable(gl, GLEV_MAP1_TEXTURE_COORD_1 + n - 1);
  }
  EXPECT_EQ(values_of(evaluate_at(0.5).texcoord[0]), (Floats{5, 6, 7, 8}));
}

TEST_F(Evaluation, Vertex4WinsOverVertex3) {
  define_line(GLEV_MAP1_VERTEX_4, 0, 4);
  define_line(GLEV_MAP1_VERTEX_3, 0, 2);
  EXPECT_EQ(values_of(evaluate_at(0.5).position), (Floats{2, 2, 2, 2}));
  glevDisable(gl, GLEV_MAP1_VERTEX_4);
  EXPECT_EQ(values_of(evaluate_at(0.5).position), (Floats{1, 1, 1, 1}));
  glevEnable(gl, GLEV_MAP1_VERTEX_4);
  EXPECT_EQ(values_of(evaluate_at(0.5).position), (Floats{2, 2, 2, 2}));
}

TEST_F(Evaluation, AWinnerThatWasNeverDefinedStillWins) {
  define_line(GLEV_MAP1_VERTEX_3, 5, 6);
  glevEnable(gl, GLEV_MAP1_VERTEX_4);
  EXPECT_EQ(values_of(evaluate_at(0.5).position), (Floats{0, 0, 0, 1}));
}

// ---- The command itself

TEST_F(Evaluation, FormsAgreeBitForBit) {
  const float points[] = {0.1f, 0.7f, -0.3f, 0.9f};
  glevMap1f(gl, GLEV_MAP1_TEXTURE_COORD_1, 0.1f, 0.7f, 1, 4, points);
  glevEnable(gl, GLEV_MAP1_TEXTURE_COORD_1);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  for (float f : {0.1f, 0.3f, 0.7f, -4.0f}) {
    const double d = f;
    glevBegin(gl, GLEV_POINTS);
    recording = {};
    glevEvalCoord1f(gl, f);
    glevEvalCoord1d(gl, d);
    glevEvalCoord1fv(gl, &f);
    glevEvalCoord1dv(gl, &d);
    glevEvalCoord1f(gl, f);
    glevEnd(gl);
    ASSERT_EQ(recording.vertices.size(), 5u);
    for (const glev_vertex& vertex : recording.vertices) {
      EXPECT_EQ(vertex.texcoord[0][0], recording.vertices[0].texcoord[0][0]);
    }
  }
  expect_rejected_in_primitive(GLEV_INVALID_VALUE, [&] { glevEvalCoord1fv(gl, nullptr); });
  expect_rejected_in_primitive(GLEV_INVALID_VALUE, [&] { glevEvalCoord1dv(gl, nullptr); });
}

TEST_F(Evaluation, ARedefinedMapTakesEffectAtOnce) {
  define_line(GLEV_MAP1_VERTEX_3, 0, 1);
  EXPECT_EQ(evaluate_at(0.5).position[0], 0.5f);
  const float same_order[] = {10, 10, 10, 20, 20, 20};
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, same_order);
  EXPECT_EQ(evaluate_at(0.5).position[0], 15.0f);
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 2, 3, 2, same_order);
  EXPECT_EQ(evaluate_at(0.5).position[0], 12.5f);
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 1, same_order);
  EXPECT_EQ(evaluate_at(0.5).position[0], 10.0f);
  // while disabled
  glevDisable(gl, GLEV_MAP1_VERTEX_3);
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 1, same_order + 3);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  EXPECT_EQ(evaluate_at(0.5).position[0], 20.0f);
}

TEST_F(Evaluation, EveryFiniteArgumentIsLegalAndOthersDoNoHarm) {
  define_line(GLEV_MAP1_VERTEX_3, 0, 1);
  const float before = evaluate_at(0.3).position[0];
  constexpr float kLargest = std::numeric_limits<float>::max(), kInf = std::numeric_limits<float>::infinity();
  for (float u : {-kLargest, -1.0f, -0.0f, 0x1p-149f, kLargest, kInf, -kInf, std::nanf("")}) {
    one_vertex([&] { glevEvalCoord1f(gl, u); });
  }
  EXPECT_EQ(values_of(evaluate_at(-0.0).position), (Floats{0, 0, 0, 1}));
  EXPECT_EQ(evaluate_at(0.3).position[0], before);
  expect_error(GLEV_NO_ERROR);
}

TEST_F(Evaluation, NonFiniteMapsDoNoHarm) {
  constexpr double kInf = std::numeric_limits<double>::infinity(),
                   kNaN = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> points(64 * 4, 1.0);
  for (double bad : {kInf, -kInf, kNaN, 1.7e308}) {
    for (int order : {1, 2, 64}) {
      points.assign(64 * 4, bad);
      glevMap1d(gl, GLEV_MAP1_VERTEX_4, 0, 1, 4, order, points.data());
      glevEnable(gl, GLEV_MAP1_VERTEX_4);
      for (double u : {0.0, 0.25, 1.0, 3.0, 1e300, kInf, kNaN}) evaluate_at(u);
      points.assign(64 * 4, 1.0);
      for (auto [u1, u2] : {std::pair{0.0, bad}, {bad, 0.0}, {-1.7e308, bad}}) {
        glevMap1d(gl, GLEV_MAP1_VERTEX_4, u1, u2, 4, order, points.data());
        for (double u : {0.0, 0.25, 1.0, 3.0, 1e300, kInf, kNaN}) evaluate_at(u);
      }
    }
  }
  define_line(GLEV_MAP1_VERTEX_4, 0, 1);
  EXPECT_EQ(evaluate_at(0.5).position[0], 0.5f);
  expect_error(GLEV_NO_ERROR);
}

}  // namespace
}  // namespace glev_tests
