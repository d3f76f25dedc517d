// Tests values of surfaces against exact rational arithmetic, and values that must be exact.
#include <cmath>
#include <cstring>
#include <random>

#include "exact.h"
#include "fixture.h"
#include "src/bernstein.h"

namespace glev_tests {
namespace {

class SurfaceNumerics : public ContextTest {
 protected:
  SurfaceNumerics() {
    glevEnable(gl, GLEV_MAP2_VERTEX_3);
    glevEnable(gl, GLEV_MAP2_TEXTURE_COORD_1);
  }

  void define(std::array<double, 4> domain, int n, int m, const std::vector<double>& points) {
    domain_ = domain;
    n_ = n;
    m_ = m;
    points_ = points;
    glevMap2d(gl, GLEV_MAP2_TEXTURE_COORD_1, domain[0], domain[1], m, n, domain[2], domain[3], 1, m,
              points.data());
  }
  std::vector<double> random_net(int n, int m) {
    std::uniform_real_distribution<double> value(-1, 1);
    std::vector<double> points(static_cast<std::size_t>(n) * m);
    for (double& point : points) point = static_cast<float>(value(random_));
    return points;
  }
  float evaluate_texcoord(double u, double v) {
    return one_vertex([&] { glevEvalCoord2d(gl, u, v); }).texcoord[0][0];
  }

  // Expects a value within the documented bound and one rounding to float.
  void expect_within_bound(double u, double v) {
    const Sum<Rational> exact = exact_point(points_, {n_, m_}, exact_t(domain_[0], domain_[1], u),
                                            exact_t(domain_[2], domain_[3], v));
    const float got = evaluate_texcoord(u, v);
    ASSERT_TRUE(std::isfinite(got)) << u << "," << v;
    const double degrees = n_ + m_ - 2;
    const Rational in_double = exact.magnitude * to_rational((13 * degrees + 8) * 0x1p-53 * (1 + 0x1p-40));
    const Rational rounding = std::max(abs(to_rational(got)) * to_rational(0x1p-24), to_rational(0x1p-150));
    EXPECT_LE(abs(to_rational(got) - exact.value), in_double + rounding)
        << "(" << u << "," << v << ") order " << n_ << "x" << m_ << ", got " << got << ", exact "
        << static_cast<double>(exact.value) << ", seed " << kSeed;
  }

  std::mt19937 random_{kSeed};
  std::array<double, 4> domain_;
  int n_, m_;
  std::vector<double> points_;
};

TEST_F(SurfaceNumerics, TheOracleKnowsABiquadratic) {
  const Rational t(1, 4), s(3, 4);
  EXPECT_EQ(bernstein(3, t, s), (std::vector<Rational>{Rational(9, 16), Rational(6, 16), Rational(1, 16)}));
  EXPECT_EQ(bernstein(3, t, s, 1), (std::vector<Rational>{Rational(-3, 2), 1, Rational(1, 2)}));
  EXPECT_EQ(bernstein(3, t, s, 2), (std::vector<Rational>{2, -4, 2}));
  const Sum<Rational> point = tensor<Rational>({1, 2}, {3, 5}, {1, -2, 4, 8});
  EXPECT_EQ(point.value, 3 - 10 + 2 * (12 + 40));
  EXPECT_EQ(point.magnitude, 3 + 10 + 2 * (12 + 40));
}

TEST_F(SurfaceNumerics, OrdersInsideAndOutsideTheDomain) {
  std::uniform_real_distribution<double> inside(0, 1);
  const std::array<double, 4> domains[] = {
      {0, 1, 0, 1}, {2, 5, -3, -1}, {1, 0, 0.1, 0.7}, {0, 1, 5, -2}, {1000, 1008, 1, 0}};
  int turn = 0;
  const auto check = [&](int n, int m, int arguments) {
    const std::array<double, 4>& domain = domains[turn++ % std::size(domains)];
    define(domain, n, m, random_net(n, m));
    const double places[] = {inside(random_), 0.5, 1e-9, 1 - 1e-9, -0.125, 1 + 1.0 / n};
    for (int k = 0; k < arguments; ++k) {
      const double t = places[k], s = k % 2 == 0 ? inside(random_) : places[arguments - 1 - k];
      expect_within_bound(domain[0] + t * (domain[1] - domain[0]), domain[2] + s * (domain[3] - domain[2]));
    }
  };
  for (int n = 1; n <= 8; ++n) {
    for (int m = 1; m <= 8; ++m) check(n, m, 6);
  }
  for (auto [n, m] : {std::pair{1, 64}, {64, 1}, {2, 33}, {30, 3}, {17, 19}}) check(n, m, 2);
  check(64, 64, 1);
}

TEST_F(SurfaceNumerics, CancellationStaysWithinTheBound) {
  for (auto [n, m] : {std::pair{4, 4}, {10, 3}, {2, 20}}) {
    std::vector<double> points;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < m; ++j) points.push_back((i + j) % 2 == 0 ? 1 : -1);
    }
    define({0, 1, 0, 1}, n, m, points);
    for (double u : {0.5, 0.499, 0.3}) {
      for (double v : {0.501, 0.5, 0.75, 0x1p-53, 1 - 0x1p-53}) expect_within_bound(u, v);
    }
  }
}

TEST_F(SurfaceNumerics, LargeAndSmallDataOfTheGLRange) {
  for (double scale : {0x1p32, 0x1p-126, 0x1p-149, 0x1p127}) {
    std::vector<double> points;
    for (int i = 0; i < 20; ++i) points.push_back(i % 3 == 0 ? -scale : scale);
    define({-0x1p32, 0x1p32, 1, 1 + 0x1p-23}, 5, 4, points);
    expect_within_bound(12345678.9, 1 + 0x1p-24);
    expect_within_bound(-0x1p31, 1 + 0x1p-25);
  }
}

// ---- Exactness

TEST_F(SurfaceNumerics, CornersGiveTheirControlPoints) {
  for (auto [n, m] : {std::pair{2, 2}, {3, 3}, {4, 2}, {3, 17}, {64, 64}, {5, 64}}) {
    for (const auto& domain : {std::array{0.0, 1.0, 0.0, 1.0}, {0.1, 0.7, 5.0, -2.0}, {1e9, 1e9 + 1, 3, 2}}) {
      for (float corner : {0.1f, -0.0f, 0x1p-149f, 4.2e9f}) {
        // The other control points must not affect the result.
        std::vector<double> points(static_cast<std::size_t>(n) * m, kNaN);
        const float corners[] = {corner, -corner, corner + 1, 2 * corner};
        points[0] = corners[0];
        points[m - 1] = corners[1];
        points[(n - 1) * m] = corners[2];
        points[n * m - 1] = corners[3];
        define(domain, n, m, points);
        for (int k = 0; k < 4; ++k) {
          // A zero result is +0.
          const float got = evaluate_texcoord(domain[k / 2], domain[2 + k % 2]), expected = corners[k] + 0.0f;
          EXPECT_EQ(std::memcmp(&got, &expected, sizeof got), 0) << k << ": " << got << " " << expected;
        }
      }
    }
  }
}

TEST_F(SurfaceNumerics, OrderOneIsConstantInItsDirection) {
  const std::vector<double> anywhere = {2, 5, 3, -1e30, 1e300, kInfinity, kNaN};
  define({2, 5, 2, 5}, 1, 1, {0.1});
  for (double u : anywhere) {
    for (double v : anywhere) EXPECT_EQ(evaluate_texcoord(u, v), 0.1f);
  }
  // In the other direction, the surface is equal to the curve.
  const std::vector<double> curve = random_net(1, 7);
  glevMap1d(gl, GLEV_MAP1_TEXTURE_COORD_1, 2, 5, 1, 7, curve.data());
  glevEnable(gl, GLEV_MAP1_TEXTURE_COORD_1);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  for (double along : {2.0, 2.7, 4.9, 5.0, -8.0}) {
    const float expected = one_vertex([&] { glevEvalCoord1d(gl, along); }).texcoord[0][0];
    for (double across : anywhere) {
      define({2, 5, 2, 5}, 1, 7, curve);
      EXPECT_EQ(evaluate_texcoord(across, along), expected);
      define({2, 5, 2, 5}, 7, 1, curve);
      EXPECT_EQ(evaluate_texcoord(along, across), expected);
    }
  }
}

// An edge of a net: its direction, and if it is the last one.
struct Edge {
  int along;
  bool last;
};
constexpr Edge kEdges[] = {{0, false}, {0, true}, {1, false}, {1, true}};

// A surface with the control points `points` along one edge and others elsewhere. Its domain along the edge
// is [0.1, 0.7].
struct EdgeSurface {
  EdgeSurface(const Edge& along_edge, const std::vector<double>& points, int other_order,
              std::mt19937& random)
      : edge(along_edge), order{static_cast<int>(points.size()), other_order} {
    if (edge.along == 1) std::swap(order[0], order[1]);
    std::uniform_real_distribution<double> value(-1, 1);
    net.resize(static_cast<std::size_t>(order[0]) * order[1]);
    for (double& point : net) point = value(random);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const int across = edge.last ? other_order - 1 : 0, here = static_cast<int>(k);
      net[edge.along == 0 ? here * order[1] + across : across * order[1] + here] = points[k];
    }
  }
  std::array<double, 4> edge_domain() const {
    return edge.along == 0 ? std::array{0.1, 0.7, 3.0, 5.0} : std::array{3.0, 5.0, 0.1, 0.7};
  }
  std::array<double, 2> argument_along(double along) const {
    const double across = edge.last ? 5 : 3;
    return edge.along == 0 ? std::array{along, across} : std::array{across, along};
  }

  Edge edge;
  std::array<int, 2> order;
  std::vector<double> net;
};

TEST_F(SurfaceNumerics, EdgesAreTheCurvesOfTheirPointsBitForBit) {
  // Compares doubles, because rounding to float could hide differences.
  std::uniform_real_distribution<double> value(-1, 1), inside(0.1, 0.7);
  for (int order : {1, 2, 3, 4, 9, 64}) {
    std::vector<double> points(order);
    for (double& point : points) point = value(random_);
    std::vector<double> scaled(order);
    glev::scale_by_binomials(points.data(), {order, 1}, 1, scaled.data());
    const glev::Curve curve = {order - 1, 1, {0.1, 0.7}, scaled.data()};
    for (const Edge& edge : kEdges) {
      for (int other_order : {2, 3, 4, 7, 64}) {
        const EdgeSurface given(edge, points, other_order, random_);
        const std::array<double, 4> domain = given.edge_domain();
        std::vector<double> net(given.net.size());
        glev::scale_by_binomials(given.net.data(), given.order, 1, net.data());
        const glev::Surface surface = {{given.order[0] - 1, given.order[1] - 1},
                                       1,
                                       {{{domain[0], domain[1]}, {domain[2], domain[3]}}},
                                       net.data()};
        for (double along : {0.1, 0.7, 0.4, inside(random_), inside(random_), 0.05, 3.0, -40.0}) {
          double expected, got;
          glev::evaluate(curve, glev::locate(curve.domain, along), &expected);
          double room[64];
          const auto [u, v] = given.argument_along(along);
          const glev::Curve cut = glev::curve_at(surface, glev::locate(surface.domain[1], v), room);
          glev::evaluate(cut, glev::locate(cut.domain, u), &got);
          EXPECT_EQ(std::memcmp(&expected, &got, sizeof got), 0)
              << "order " << order << " by " << other_order << ", along " << edge.along << " " << edge.last
              << " at " << along << ": " << expected << " " << got;
        }
      }
    }
  }
}

TEST_F(SurfaceNumerics, PatchesWithACommonEdgeAreWatertight) {
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<double> points(4);
  for (double& point : points) point = value(random_);
  const int n = 50;
  const auto edge_vertices = [&](const Edge& edge, int other_order, bool mesh) {
    const EdgeSurface given(edge, points, other_order, random_);
    define(given.edge_domain(), given.order[0], given.order[1], given.net);
    glevMapGrid2d(gl, n, domain_[0], domain_[1], n, domain_[2], domain_[3]);
    const int across = edge.last ? n : 0;
    recording = {};
    if (mesh && edge.along == 0) {
      glevEvalMesh2(gl, GLEV_POINT, 0, n, across, across);
    } else if (mesh) {
      glevEvalMesh2(gl, GLEV_POINT, across, across, 0, n);
    } else {
      glevBegin(gl, GLEV_POINTS);
      for (int k = 0; k <= n; ++k) {
        const auto [u, v] = given.argument_along(0.1 + k * (0.7 - 0.1) / n);
        glevEvalCoord2d(gl, u, v);
      }
      glevEnd(gl);
    }
    Floats values;
    for (const glev_vertex& vertex : recording.vertices) values.push_back(vertex.texcoord[0][0]);
    return values;
  };
  for (bool mesh : {false, true}) {
    const Floats first = edge_vertices(kEdges[0], 4, mesh);
    ASSERT_EQ(first.size(), static_cast<std::size_t>(n) + 1);
    for (const Edge& edge : kEdges) {
      for (int other_order : {2, 5, 30}) EXPECT_EQ(edge_vertices(edge, other_order, mesh), first);
    }
  }
}

// The conformance suite tests non-finite values with orders up to 4 (Numeric.StateAfterSpecials1 and 2).
TEST_F(SurfaceNumerics, NonFiniteValuesOfAllOrdersDoNoHarm) {
  for (glev_enum cap : {GLEV_AUTO_NORMAL, GLEV_MAP1_VERTEX_4, GLEV_MAP2_VERTEX_4}) glevEnable(gl, cap);
  for (double bad : {kInfinity, -kInfinity, kNaN, 1.7e308}) {
    const auto evaluate = [&] {
      for (double u : {0.0, 0.25, 1.0, 1e300, bad}) {
        one_vertex([&] { glevEvalCoord1d(gl, u); });
        for (double v : {0.0, 0.25, 1.0, 1e300, bad}) evaluate_texcoord(u, v);
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
  EXPECT_EQ(evaluate_texcoord(0.5, 0.5), 5.5f);
}

}  // namespace
}  // namespace glev_tests
