// The fixture of tests of single values: a map of one component, evaluated by EvalCoord.
#pragma once

#include <random>

#include "exact.h"
#include "fixture.h"

namespace glev_tests {

class Numerics : public ContextTest {
 protected:
  Numerics() {
    for (glev_enum cap :
         {GLEV_MAP1_VERTEX_3, GLEV_MAP1_TEXTURE_COORD_1, GLEV_MAP2_VERTEX_3, GLEV_MAP2_TEXTURE_COORD_1})
      glevEnable(gl, cap);
  }

  // Defines a surface of n x m points, v fastest, and if m is 1 the same curve.
  void define(const std::array<double, 4>& domain, int n, int m, const std::vector<double>& points) {
    domain_ = domain;
    order_ = {n, m};
    points_ = points;
    glevMap2d(gl, GLEV_MAP2_TEXTURE_COORD_1, domain[0], domain[1], m, n, domain[2], domain[3], 1, m,
              points.data());
    if (m == 1) glevMap1d(gl, GLEV_MAP1_TEXTURE_COORD_1, domain[0], domain[1], 1, n, points.data());
  }
  std::vector<double> random_net(int n, int m) {
    std::uniform_real_distribution<double> value(-1, 1);
    std::vector<double> points(static_cast<std::size_t>(n) * m);
    for (double& point : points) point = static_cast<float>(value(random_));
    return points;
  }

  // Evaluates the surface, and expects that the curve, if there is one, has the same bits.
  float evaluate_at(double u, double v = 0.5) {
    const float value = one_vertex([&] { glevEvalCoord2d(gl, u, v); }).texcoord[0][0];
    if (order_[1] == 1) {
      const float on_curve = one_vertex([&] { glevEvalCoord1d(gl, u); }).texcoord[0][0];
      EXPECT_EQ(float_bits(on_curve), float_bits(value)) << "curve of order " << order_[0] << " at " << u;
    }
    return value;
  }
  void expect_bits(float expected, double u, double v = 0.5) {
    const float got = evaluate_at(u, v);
    EXPECT_EQ(float_bits(got), float_bits(expected))
        << std::hexfloat << got << " for " << expected << " at " << u << ", " << v << ", orders " << order_[0]
        << " x " << order_[1] << ", seed " << kSeed;
  }
  void expect_nearest(double u, double v = 0.5) {
    expect_bits(nearest_float(exact_point(points_, order_, exact_t(domain_[0], domain_[1], u),
                                          exact_t(domain_[2], domain_[3], v))
                                  .value),
                u, v);
  }

  std::mt19937 random_{kSeed};
  std::array<double, 4> domain_{};
  std::array<int, 2> order_{};
  std::vector<double> points_;
};

}  // namespace glev_tests
