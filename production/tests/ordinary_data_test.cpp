// Tests that results of EvalCoord, EvalPoint, batches and meshes are correctly rounded for typical data of
// programs, in which ties, lower degrees and zeros are frequent, and at the ends of the range of float.
#include <cmath>
#include <limits>

#include "batches.h"
#include "exact.h"
#include "src/parameter.h"

namespace glev_tests {
namespace {

using glev::GridArgument;

class OrdinaryData : public ContextTest {
 protected:
  static constexpr int kSegments = 24;
  static constexpr glev::Domain kUnit = {0, 1};

  // Expects correctly rounded results of a curve of one component, and of the same points as surfaces that
  // are constant in the other direction.
  void expect_nearest_curve(const std::vector<float>& points) {
    const int order = static_cast<int>(points.size());
    std::vector<float> twice;
    for (float point : points) twice.insert(twice.end(), {point, point});
    glevMap1f(gl, GLEV_MAP1_TEXTURE_COORD_1, 0, 1, 1, order, points.data());
    glevMap2f(gl, GLEV_MAP2_TEXTURE_COORD_1, 0, 1, 2, order, 0, 1, 1, 2, twice.data());
    enable();
    const std::vector<double> exact(points.begin(), points.end());
    const auto nearest = [&](const GridArgument& at) {
      return nearest_float(exact_point(exact, {order, 1}, exact_t(kUnit, at)).value);
    };
    expect([&](const GridArgument& u, const GridArgument&) { return nearest(u); });
  }

  // Expects correctly rounded results of a surface of one component, v fastest, and of its edge at v = 0 as a
  // curve.
  void expect_nearest_surface(const std::vector<float>& points, int n, int m) {
    glevMap1f(gl, GLEV_MAP1_TEXTURE_COORD_1, 0, 1, m, n, points.data());
    glevMap2f(gl, GLEV_MAP2_TEXTURE_COORD_1, 0, 1, m, n, 0, 1, 1, m, points.data());
    enable();
    const std::vector<double> exact(points.begin(), points.end());
    expect([&](const GridArgument& u, const GridArgument& v) {
      return nearest_float(exact_point(exact, {n, m}, exact_t(kUnit, u), exact_t(kUnit, v)).value);
    });
  }

 private:
  void enable() {
    for (glev_enum target :
         {GLEV_MAP1_VERTEX_3, GLEV_MAP1_TEXTURE_COORD_1, GLEV_MAP2_VERTEX_3, GLEV_MAP2_TEXTURE_COORD_1})
      glevEnable(gl, target);
    glevMapGrid1f(gl, kSegments, 0, 1);
    glevMapGrid2f(gl, kSegments, 0, 1, 4, 0, 1);
  }

  // Checks all deliveries. The curve is the edge of the surface at v = 0.
  template <class Right>
  void expect(const Right& right) {
    const Plan curve(gl, 1), surface(gl, 2);
    const std::vector<float> u = {0,    0.5F,     0.25F,        0.375F, 1, 1.0F / 3,
                                  0.1F, 0x1p-20F, 1 - 0x1p-24F, 0.75F,  2, -0.5F},
                             v = {0, 0.5F, 0.1F, 1, 0.75F, 0.3F, 0x1p-12F, 0.5F, 0, 0.25F, 1, 2};
    const Floats curves = evaluate_scattered(curve, GLEV_ATTRIBUTE_TEXCOORD, u),
                 surfaces = evaluate_scattered(surface, GLEV_ATTRIBUTE_TEXCOORD, u, v);
    draw([&] {
      for (std::size_t i = 0; i < u.size(); ++i) glevEvalCoord1f(gl, u[i]), glevEvalCoord2f(gl, u[i], v[i]);
    });
    for (std::size_t i = 0; i < u.size(); ++i) {
      const std::uint32_t on_curve = float_bits(right(glev::argument_at(u[i]), glev::argument_at(0))),
                          on_surface = float_bits(right(glev::argument_at(u[i]), glev::argument_at(v[i])));
      EXPECT_EQ(float_bits(curves[i]), on_curve) << u[i];
      EXPECT_EQ(float_bits(recording.vertices[2 * i].texcoord[0][0]), on_curve) << u[i];
      EXPECT_EQ(float_bits(surfaces[i]), on_surface) << u[i] << ", " << v[i];
      EXPECT_EQ(float_bits(recording.vertices[2 * i + 1].texcoord[0][0]), on_surface) << u[i] << ", " << v[i];
    }
    const Floats row = evaluate_grid(curve, GLEV_ATTRIBUTE_TEXCOORD, {0, kSegments});
    const Floats mesh = evaluate_grid(surface, GLEV_ATTRIBUTE_TEXCOORD, {0, kSegments, 0, 4});
    for (int j = 0; j <= 4; ++j) {
      for (int i = 0; i <= kSegments; ++i) {
        const GridArgument at = {{0, 1, kSegments}, i};
        const std::size_t k = static_cast<std::size_t>(j) * (kSegments + 1) + i;
        EXPECT_EQ(float_bits(mesh[k]), float_bits(right(at, {{0, 1, 4}, j}))) << i << ", " << j;
      }
    }
    for (int i = 0; i <= kSegments; ++i) {
      EXPECT_EQ(float_bits(row[static_cast<std::size_t>(i)]),
                float_bits(right({{0, 1, kSegments}, i}, glev::argument_at(0))))
          << i;
    }
  }
};

TEST_F(OrdinaryData, LinesGivenAsCurvesOfHigherDegree) {
  for (int order : {2, 3, 4, 5, 8, 10}) {
    for (auto [first, step] : {std::pair{0.0F, 1.0F}, {-7.0F, 2.0F}, {100.0F, -0.25F}, {0.0F, 0x1p-30F}}) {
      std::vector<float> points;
      for (int i = 0; i < order; ++i) points.push_back(first + static_cast<float>(i) * step);
      expect_nearest_curve(points);
    }
  }
}

TEST_F(OrdinaryData, QuadraticsGivenAsCubics) {
  // Degree-elevated quadratics: R_0, (R_0 + 2 R_1) / 3, (2 R_1 + R_2) / 3, R_2.
  for (auto [a, b, c] : {std::array{0.0F, 3.0F, 0.0F}, {3.0F, 6.0F, -9.0F}, {1.0F, -0.5F, 4.0F}})
    expect_nearest_curve({a, (a + 2 * b) / 3, (2 * b + c) / 3, c});
  expect_nearest_curve({0, 0, 1, 3});  // control points of 3 t^2
  expect_nearest_curve({0, 0, 0, 1, 4, 10});
}

// Evaluates symmetric and antisymmetric nets of short decimals and dyadic numbers with few segments, on every
// instruction set. Whole rows are zeros or ties.
TEST_F(OrdinaryData, BicubicModelsOnDyadicGrids) {
  constexpr std::size_t kPointSize = 3;
  Chance chance;
  on_every_instruction_set([&](glev_context* other) {
    for (int round = 0; round < 60; ++round) {
      const int n = chance.whole(2, 4), m = chance.whole(1, 4);
      std::vector<float> points(static_cast<std::size_t>(n * m) * kPointSize);
      for (std::size_t k = 0; k < kPointSize; ++k) {
        const float unit = chance.one_of({0.1F, 0.01F, 0x1p-4F, 0x1p-22F}),
                    sign = chance.one_of({0.0F, 1.0F, -1.0F});
        const auto at = [&](int i, int j) -> float& {
          return points[static_cast<std::size_t>(i * m + j) * kPointSize + k];
        };
        for (int i = 0; i < n; ++i) {
          for (int j = 0; j < m; ++j) {
            at(i, j) = static_cast<float>(chance.whole(-2000, 2000)) * unit;
            if (chance.whole(0, 1) == 0 && (i == 0 || i == n - 1)) at(i, j) = 0;
            if (sign != 0 && 2 * i >= n - 1)
              at(i, j) = 2 * i == n - 1 && sign < 0 ? 0 : sign * at(n - 1 - i, j);
          }
        }
      }
      glevMap2f(other, GLEV_MAP2_VERTEX_3, 0, 1, m * 3, n, 0, 1, 3, m, points.data());
      glevEnable(other, GLEV_MAP2_VERTEX_3);
      const int segments = chance.one_of({1, 2, 4, 8, 16, 32, 64, 10, 12});
      glevMapGrid2f(other, segments, 0, 1, 4, 0, 1);
      const Plan plan(other, 2);
      const Floats mesh = evaluate_grid(plan, GLEV_ATTRIBUTE_VERTEX, {0, segments, 0, 4});
      for (std::size_t k = 0; k < kPointSize; ++k) {
        std::vector<double> exact;
        for (std::size_t i = k; i < points.size(); i += kPointSize) exact.push_back(points[i]);
        for (int j = 0; j <= 4; ++j) {
          for (int i = 0; i <= segments; ++i) {
            const float right =
                nearest_float(exact_point(exact, {n, m}, Rational(i, segments), Rational(j, 4)).value);
            const float got = mesh[static_cast<std::size_t>(j * (segments + 1) + i) * kPointSize + k];
            ASSERT_EQ(float_bits(got), float_bits(right))
                << "orders " << n << " x " << m << ", " << segments << " segments, " << i << ", " << j;
          }
        }
      }
    }
  });
}

TEST_F(OrdinaryData, SmallIntegersAndConstants) {
  expect_nearest_curve({1, 2, 2, 1});
  expect_nearest_curve({1, 3, 3, 1});
  expect_nearest_curve({5, 5, 5, 5, 5, 5});
  expect_nearest_curve({0.1F, 0.1F, 0.1F});
  expect_nearest_curve({0x1p-149F, 0x1p-149F});
}

TEST_F(OrdinaryData, BicubicPatchesThatAreBilinear) {
  for (auto [a, b, c, d] : {std::array{0.0F, 3.0F, 6.0F, 9.0F},
                            {1.0F, 1.0F, 1.0F, 1.0F},
                            {0.0F, 9.0F, 0.0F, -9.0F},
                            {-3.0F, 5.0F, 0.25F, 7.0F}}) {
    std::vector<float> points;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        const auto u = static_cast<float>(i), v = static_cast<float>(j);
        points.push_back(((3 - u) * ((3 - v) * a + v * b) + u * ((3 - v) * c + v * d)) / 9);
      }
    }
    expect_nearest_surface(points, 4, 4);
  }
}

// V = 0 gives +0, independently of the signs of terms.
TEST_F(OrdinaryData, ZerosArePositive) {
  expect_nearest_curve({-0.0F, -0.0F, -0.0F, -0.0F});
  expect_nearest_curve({-0.0F});
  expect_nearest_curve({-0.0F, 0, -0.0F});
  expect_nearest_curve({-1, 0, 1});
  expect_nearest_curve({1, -1, 1, -1});
  expect_nearest_curve({-1, 1, -1});  // a double zero at 1/2
  expect_nearest_curve({-0.0F, 1, -1, -0.0F});
  expect_nearest_surface({-1, 1, 1, -1}, 2, 2);
  expect_nearest_surface({-0.0F, -0.0F, -0.0F, -0.0F, -0.0F, -0.0F}, 3, 2);
}

// 2^128 - 2^103 and beyond is infinite. Only the d form has control points there.
TEST_F(OrdinaryData, OverflowIsRounding) {
  constexpr double kThreshold = 0x1p128 - 0x1p103;
  constexpr float kInfinite = std::numeric_limits<float>::infinity(),
                  kMost = std::numeric_limits<float>::max();
  const auto expect = [&](const std::vector<double>& points, double u, float expected) {
    glevMap1d(gl, GLEV_MAP1_TEXTURE_COORD_1, 0, 1, 1, static_cast<int>(points.size()), points.data());
    glevEnable(gl, GLEV_MAP1_TEXTURE_COORD_1);
    glevEnable(gl, GLEV_MAP1_VERTEX_3);
    glevMapGrid1d(gl, 4, u, u);
    const Plan curve(gl, 1);
    EXPECT_EQ(evaluate_scattered(curve, GLEV_ATTRIBUTE_TEXCOORD, std::vector<double>{u}), Floats{expected})
        << u;
    EXPECT_EQ(evaluate_grid(curve, GLEV_ATTRIBUTE_TEXCOORD, {2, 2}), Floats{expected}) << u;
    EXPECT_EQ(one_vertex([&] { glevEvalCoord1d(gl, u); }).texcoord[0][0], expected) << u;
  };
  for (double sign : {1.0, -1.0}) {
    const double tie = sign * kThreshold, below = std::nextafter(tie, 0),
                 above = std::nextafter(tie, 2 * tie);
    const auto s = static_cast<float>(sign);
    for (double u : {0.0, 0.3, 0.5, 1.0, 2.0}) {
      expect({tie, tie, tie, tie}, u, s * kInfinite);
      expect({below, below, below, below}, u, s * kMost);
      expect({above, above}, u, s * kInfinite);
    }
    expect({2 * tie, 0}, 0.5, s * kInfinite);
    expect({2 * below, 0}, 0.5, s * kMost);
    expect({8 * tie, 0, 0, 0}, 0.5, s * kInfinite);
    expect({8 * below, 0, 0, 0}, 0.5, s * kMost);
    expect({sign * 1e300, -sign * 1e300}, 0.5, 0);
    expect({0, sign * kMost}, 2, s * kInfinite);
  }
}

TEST_F(OrdinaryData, SubnormalResults) {
  constexpr float kLeast = std::numeric_limits<float>::denorm_min(),
                  kNormal = std::numeric_limits<float>::min();
  expect_nearest_curve({0, kLeast, 0});
  expect_nearest_curve({kLeast, 0});  // half of it is a tie, to 0
  expect_nearest_curve({-kLeast, 0, -kLeast});
  expect_nearest_curve({-kLeast, 0, 0, 0});  // rounds to -0
  expect_nearest_curve({kNormal, 0, kNormal, -kNormal});
  expect_nearest_curve({1e-40F, 3e-39F, -2e-38F, 1.17e-38F});
  expect_nearest_curve({1, 0, 0, 0, 0, 0, 0, 0, 0, 1e-38F});
  expect_nearest_surface({1e-38F, -1e-38F, kLeast, kNormal, 1e-37F, -3e-38F, 0, 5e-39F, 0}, 3, 3);
}

TEST_F(OrdinaryData, RandomFloatsOfManyMagnitudes) {
  Chance chance;
  for (int k = 0; k < 20; ++k) {
    std::vector<float> points = chance.next_points(12);
    for (float& point : points) point = std::ldexp(point, chance.whole(-140, 126));
    expect_nearest_surface(points, 4, 3);
    expect_nearest_curve(points);
  }
}

}  // namespace
}  // namespace glev_tests
