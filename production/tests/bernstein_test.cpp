// Tests the edges of surfaces in double, and that non-finite values do no harm.
#include <cmath>
#include <cstring>

#include "numerics.h"
#include "src/bernstein.h"

namespace glev_tests {
namespace {

// Compares doubles, because rounding to float could hide differences.
TEST(Surfaces, EdgesAreTheCurvesOfTheirPointsBitForBit) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> value(-1, 1), inside(0.1, 0.7);
  const auto scaled = [](std::vector<double> points, std::array<int, 2> order) {
    glev::scale_by_binomials(points.data(), order, 1, points.data());
    return points;
  };
  for (const int order : {1, 2, 3, 4, 9, 64}) {
    std::vector<double> points(order);
    for (double& point : points) point = value(random);
    const std::vector<double> of_curve = scaled(points, {order, 1});
    const glev::Domain along_domain = {0.1, 0.7}, across_domain = {3, 5};
    const glev::Curve curve = {order - 1, 1, along_domain, of_curve.data()};
    for (const int other_order : {2, 3, 4, 7, 64}) {
      for (const bool is_along_u : {true, false}) {
        for (const bool is_last : {false, true}) {
          // A surface with these control points along one edge, and others elsewhere.
          const int n = is_along_u ? order : other_order, m = is_along_u ? other_order : order,
                    across = is_last ? other_order - 1 : 0;
          std::vector<double> net(static_cast<std::size_t>(n) * m);
          for (double& point : net) point = value(random);
          for (int k = 0; k < order; ++k) net[is_along_u ? k * m + across : across * m + k] = points[k];
          net = scaled(net, {n, m});
          const glev::Surface surface = {
              {n - 1, m - 1},
              1,
              {is_along_u ? along_domain : across_domain, is_along_u ? across_domain : along_domain},
              net.data()};
          for (const double along : {0.1, 0.7, 0.4, inside(random), inside(random), 0.05, 3.0, -40.0}) {
            const double at_end = is_last ? 5 : 3, u = is_along_u ? along : at_end,
                         v = is_along_u ? at_end : along;
            double expected, got, room[64];
            glev::evaluate(curve, glev::locate(curve.domain, along), &expected);
            const glev::Curve cut = glev::curve_at(surface, glev::locate(surface.domain[1], v), room);
            glev::evaluate(cut, glev::locate(cut.domain, u), &got);
            EXPECT_EQ(std::memcmp(&expected, &got, sizeof got), 0)
                << "order " << order << " by " << other_order << ", along " << (is_along_u ? "u" : "v")
                << ", last " << is_last << " at " << along << ": " << expected << " " << got;
          }
        }
      }
    }
  }
}

// The conformance suite tests non-finite values with orders up to 4 (Numeric.StateAfterSpecials1 and 2).
TEST_F(Numerics, NonFiniteValuesOfAllOrdersDoNoHarm) {
  for (glev_enum cap : {GLEV_AUTO_NORMAL, GLEV_MAP1_VERTEX_4, GLEV_MAP2_VERTEX_4}) glevEnable(gl, cap);
  for (double bad : {kInfinity, -kInfinity, kNaN, 1.7e308}) {
    const auto evaluate = [&] {
      for (double u : {0.0, 0.25, 1.0, 1e300, bad}) {
        one_vertex([&] { glevEvalCoord1d(gl, u); });
        for (double v : {0.0, 0.25, 1.0, 1e300, bad}) evaluate_at(u, v);
      }
    };
    for (int order : {1, 2, 64}) {
      std::vector<double> points(64 * 64 * 4, 1.0);
      points[0] = bad;
      points[5] = -bad;
      glevMap1d(gl, GLEV_MAP1_VERTEX_4, 0, 1, 4, order, points.data());
      glevMap2d(gl, GLEV_MAP2_VERTEX_4, 0, 1, 4 * order, order, 0, 1, 4, order, points.data());
      evaluate();
      points.assign(points.size(), 1.0);
      glevMap1d(gl, GLEV_MAP1_VERTEX_4, -1.7e308, bad, 4, order, points.data());
      glevMap2d(gl, GLEV_MAP2_VERTEX_4, bad, 1, 4 * order, order, -1.7e308, bad, 4, order, points.data());
      evaluate();
    }
  }
  expect_error(GLEV_NO_ERROR);
  define({0, 1, 0, 1}, 2, 2, {0, 1, 10, 11});
  expect_bits(5.5f, 0.5, 0.5);
}

}  // namespace
}  // namespace glev_tests
