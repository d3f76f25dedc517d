// Tests values that evaluation in double does not decide. Batches, meshes and single calls must each detect
// them.
#include <cmath>
#include <vector>

#include "batches.h"
#include "exact.h"

namespace glev_tests {
namespace {

class Undecided : public ContextTest {};

// A cubic with two roots inside the domain and one far outside. Near the latter, the error in double is at
// least one ULP of float, although all control points are small.
class NextToARootOutside : public Undecided {
 protected:
  static constexpr double kRoot[] = {-30, 51, 44, -27};  // 3 (x - 19) (x^2 - 1/2) for x = 2 t - 1
  static constexpr int kSegments = 251;
  static constexpr double kLength = 0x1p-18;  // length of a grid that begins at the root
  static constexpr Range kPoints = {2, 120};

  static std::vector<double> undecided_arguments() {
    std::vector<double> arguments;
    for (int i = kPoints.i1; i <= kPoints.i2; ++i) arguments.push_back(10 + i * kLength / kSegments);
    return arguments;
  }

  static void expect_right(float got, const Rational& t) {
    const std::vector<double> exact(std::begin(kRoot), std::end(kRoot));
    EXPECT_EQ(float_bits(got), float_bits(nearest_float(exact_point(exact, {4, 1}, t).value)))
        << static_cast<double>(t);
  }
  static void expect_right_at(const std::vector<double>& arguments, const Floats& positions) {
    ASSERT_EQ(positions.size(), 3 * arguments.size());
    for (std::size_t i = 0; i < arguments.size(); ++i)
      expect_right(positions[3 * i], to_rational(arguments[i]));
  }
  static void expect_right_on_grid(const Floats& positions) {
    ASSERT_EQ(positions.size(), 3 * kPoints.columns());
    for (int i = kPoints.i1; i <= kPoints.i2; ++i)
      expect_right(positions[3 * static_cast<std::size_t>(i - kPoints.i1)],
                   10 + Rational(i, kSegments) * to_rational(kLength));
  }
};

TEST_F(NextToARootOutside, OnCurves) {
  std::vector<double> points;
  for (const double x : kRoot) points.insert(points.end(), {x, 1, 2});
  glevMap1d(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 4, points.data());
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  glevMapGrid1d(gl, kSegments, 10, 10 + kLength);
  const std::vector<double> arguments = undecided_arguments();
  draw([&] {
    for (const double u : arguments) glevEvalCoord1d(gl, u);
  });
  expect_right_at(arguments, recorded_positions(3));
  const Plan plan(gl, 1);
  expect_right_at(arguments, evaluate_scattered(plan, GLEV_ATTRIBUTE_VERTEX, arguments));
  expect_right_on_grid(evaluate_grid(plan, GLEV_ATTRIBUTE_VERTEX, kPoints));
}

TEST_F(NextToARootOutside, InVOfSurfaces) {
  for (const int order_u : {1, 2, 4}) {
    std::vector<double> points;
    for (int i = 0; i < order_u; ++i) {
      for (const double x : kRoot) points.insert(points.end(), {x, 1, static_cast<double>(i * i)});
    }
    glevMap2d(gl, GLEV_MAP2_VERTEX_3, 0, 1, 12, order_u, 0, 1, 3, 4, points.data());
    glevEnable(gl, GLEV_MAP2_VERTEX_3);
    glevMapGrid2d(gl, 8, 0, 1, kSegments, 10, 10 + kLength);
    const std::vector<double> v = undecided_arguments(), u(v.size(), 0.375);
    draw([&] {
      for (std::size_t i = 0; i < v.size(); ++i) glevEvalCoord2d(gl, u[i], v[i]);
    });
    expect_right_at(v, recorded_positions(3));
    // Each point is the first call of a primitive.
    recording = {};
    for (std::size_t i = 0; i < v.size(); ++i) {
      glevBegin(gl, GLEV_POINTS);
      glevEvalCoord2d(gl, u[i], v[i]);
      glevEnd(gl);
    }
    expect_right_at(v, recorded_positions(3));
    const Plan plan(gl, 2);
    expect_right_at(v, evaluate_scattered(plan, GLEV_ATTRIBUTE_VERTEX, u, v));
    expect_right_on_grid(evaluate_grid(plan, GLEV_ATTRIBUTE_VERTEX, Range{3, 3, kPoints.i1, kPoints.i2}));
  }
}

// Evaluates a line through midpoints of floats, at 2, 4, 8, ...
TEST_F(Undecided, ColumnsOfLongMeshes) {
  constexpr int kSegments = 1500;
  constexpr double kThird = 500 * (1 + 0x1p-24);
  const double points[] = {0, kThird, 2 * kThird, 3 * kThird};
  glevMap1d(gl, GLEV_MAP1_TEXTURE_COORD_1, 0, 1, 1, 4, points);
  glevEnable(gl, GLEV_MAP1_TEXTURE_COORD_1);
  glevMapGrid1f(gl, kSegments, 0, 1);
  const Plan plan(gl, 1);
  const Floats values = evaluate_grid(plan, GLEV_ATTRIBUTE_TEXCOORD, Range{0, kSegments});
  for (int i = 0; i <= kSegments; ++i)
    EXPECT_EQ(float_bits(values[static_cast<std::size_t>(i)]),
              float_bits(static_cast<float>(i * (1 + 0x1p-24))))
        << i;
}

// t / s to the power of the degree overflows, and s to that power underflows.
TEST_F(Undecided, CurvesOfTheHighestOrderNextToTheirEnd) {
  Floats points;
  for (int i = 0; i < kMax; ++i) points.push_back(static_cast<float>(std::sin(i) + 2));
  glevMap1f(gl, GLEV_MAP1_TEXTURE_COORD_1, 0, 1, 1, kMax, points.data());
  glevEnable(gl, GLEV_MAP1_TEXTURE_COORD_1);
  std::vector<float> u;
  for (int digits = 4; digits <= 24; ++digits) u.push_back(1 - std::ldexp(1.0F, -digits));
  const Plan plan(gl, 1);
  const Floats values = evaluate_scattered(plan, GLEV_ATTRIBUTE_TEXCOORD, u);
  const std::vector<double> exact(points.begin(), points.end());
  for (std::size_t i = 0; i < u.size(); ++i)
    EXPECT_EQ(float_bits(values[i]),
              float_bits(nearest_float(exact_point(exact, {kMax, 1}, to_rational(u[i])).value)))
        << u[i];
}

}  // namespace
}  // namespace glev_tests
