// Tests EvalCoord2: the maps that it evaluates, its vertices, and their accuracy.
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "exact.h"
#include "fixture.h"
#include "src/bernstein.h"

namespace glev_tests {
namespace {

class Surfaces : public ContextTest {
 protected:
  // Defines a bilinear map with these corners and equal components.
  void bilinear(glev_enum target, float r00, float r01, float r10, float r11) {
    std::vector<float> points;
    for (float corner : {r00, r01, r10, r11}) points.insert(points.end(), 4, corner);
    glevMap2f(gl, target, 0, 1, 8, 2, 0, 1, 4, 2, points.data());
    glevEnable(gl, target);
  }
  glev_vertex evaluate_at(double u, double v) {
    return one_vertex([&] { glevEvalCoord2d(gl, u, v); });
  }
};

// ---- What is evaluated

TEST_F(Surfaces, UComesFirstAndIsTheFirstIndex) {
  bilinear(GLEV_MAP2_VERTEX_3, 0, 1, 10, 11);
  EXPECT_EQ(values_of(evaluate_at(0.5, 0).position), (Floats{5, 5, 5, 1}));
  EXPECT_EQ(values_of(evaluate_at(0, 0.5).position), (Floats{0.5f, 0.5f, 0.5f, 1}));
  EXPECT_EQ(values_of(evaluate_at(-1, 2).position), (Floats{-8, -8, -8, 1})) << "extrapolated";
}

TEST_F(Surfaces, EachDirectionHasItsDomain) {
  const float points[] = {0, 1, 10, 11};
  glevEnable(gl, GLEV_MAP2_VERTEX_3);
  glevEnable(gl, GLEV_MAP2_TEXTURE_COORD_1);
  for (auto [u1, u2, v1, v2] :
       {std::array{2.0f, 6.0f, -1.0f, 1.0f}, {6, 2, -1, 1}, {2, 6, 1, -1}, {6, 2, 1, -1}}) {
    glevMap2f(gl, GLEV_MAP2_TEXTURE_COORD_1, u1, u2, 2, 2, v1, v2, 1, 2, points);
    EXPECT_EQ(evaluate_at(u1, v1).texcoord[0][0], 0);
    EXPECT_EQ(evaluate_at(u1, v2).texcoord[0][0], 1);
    EXPECT_EQ(evaluate_at(u2, v1).texcoord[0][0], 10);
    EXPECT_EQ(evaluate_at(u2, v2).texcoord[0][0], 11);
    EXPECT_EQ(evaluate_at(u1 + (u2 - u1) / 4, v1 + (v2 - v1) / 2).texcoord[0][0], 3);
  }
}

TEST_F(Surfaces, ComponentsGoToTheirAttributes) {
  const float points[] = {1, 2, 3, 4, 5, 7, 9, 11};
  for (const TargetRow& row : target_rows()) {
    glevMap2f(gl, GLEV_MAP2_COLOR_4 + row.offset, 0, 1, 4, 2, 0, 1, 4, 1, points);
    glevEnable(gl, GLEV_MAP2_COLOR_4 + row.offset);
  }
  glevIndexf(gl, 17);
  glevMultiTexCoord4f(gl, GLEV_TEXTURE0 + 1, 6, 7, 8, 9);
  const glev_vertex vertex = evaluate_at(0.5, 0.3);
  EXPECT_EQ(values_of(vertex.position), (Floats{3, 4.5f, 6, 7.5f})) << "VERTEX_4 wins";
  EXPECT_EQ(values_of(vertex.color), (Floats{3, 4.5f, 6, 7.5f}));
  EXPECT_EQ(values_of(vertex.normal), (Floats{3, 4.5f, 6})) << "not normalised";
  EXPECT_EQ(values_of(vertex.texcoord[0]), (Floats{3, 4.5f, 6, 7.5f}));
  EXPECT_EQ(values_of(vertex.texcoord[1]), (Floats{6, 7, 8, 9}));
  EXPECT_EQ(vertex.index, 17);
  glevDisable(gl, GLEV_MAP2_VERTEX_4);
  EXPECT_EQ(values_of(evaluate_at(0.5, 0.3).position), (Floats{3, 4.5f, 6, 1}));
}

TEST_F(Surfaces, TheTextureMapWithMostCoordinatesWins) {
  glevEnable(gl, GLEV_MAP2_VERTEX_3);
  for (int subset = 1; subset < 16; ++subset) {
    int most = 0;
    for (int n = 1; n <= 4; ++n) {
      glevDisable(gl, GLEV_MAP2_TEXTURE_COORD_1 + n - 1);
      if (!(subset & 1 << (n - 1))) continue;
      const auto value = static_cast<float>(10 * n);
      bilinear(GLEV_MAP2_TEXTURE_COORD_1 + n - 1, value, value, value, value);
      most = n;
    }
    Floats expected = {0, 0, 0, 1};
    std::fill_n(expected.begin(), most, 10.0f * static_cast<float>(most));
    EXPECT_EQ(values_of(evaluate_at(0.5, 0.25).texcoord[0]), expected) << "subset " << subset;
  }
}

TEST_F(Surfaces, OnlyTwoDimensionalMapsAreLookedAt) {
  const float points[] = {9, 9, 9, 9};
  for (const TargetRow& row : target_rows()) {
    glevMap1f(gl, GLEV_MAP1_COLOR_4 + row.offset, 0, 1, 4, 1, points);
    glevEnable(gl, GLEV_MAP1_COLOR_4 + row.offset);
  }
  glevBegin(gl, GLEV_POINTS);
  glevEvalCoord2f(gl, 0.5f, 0.5f);
  glevEnd(gl);
  expect_error(GLEV_NO_ERROR);
  EXPECT_TRUE(recording.vertices.empty());
  bilinear(GLEV_MAP2_VERTEX_3, 0, 1, 10, 11);
  glevColor4f(gl, 0.1f, 0.2f, 0.3f, 0.4f);
  glevNormal3f(gl, 5, 6, 7);
  glevTexCoord4f(gl, 1, 2, 3, 4);
  const glev_vertex vertex = evaluate_at(0.5, 0.5);
  EXPECT_EQ(values_of(vertex.position), (Floats{5.5f, 5.5f, 5.5f, 1}));
  EXPECT_EQ(values_of(vertex.color), (Floats{0.1f, 0.2f, 0.3f, 0.4f}));
  EXPECT_EQ(values_of(vertex.normal), (Floats{5, 6, 7}));
  EXPECT_EQ(values_of(vertex.texcoord[0]), (Floats{1, 2, 3, 4}));
}

TEST_F(Surfaces, BothDimensionsInOnePrimitive) {
  bilinear(GLEV_MAP2_VERTEX_3, 0, 1, 10, 11);
  const float points[] = {7, 7, 7};
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 1, points);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  glevBegin(gl, GLEV_POINTS);
  glevEvalCoord2f(gl, 1, 0);
  glevEvalCoord1f(gl, 1);
  glevVertex2f(gl, 3, 3);
  glevEvalCoord2f(gl, 0, 1);
  glevEnd(gl);
  ASSERT_EQ(recording.vertices.size(), 4u);
  for (auto [k, x] : {std::pair{0, 10}, {1, 7}, {2, 3}, {3, 1}}) {
    EXPECT_EQ(recording.vertices[k].position[0], static_cast<float>(x));
  }
}

TEST_F(Surfaces, CurrentValuesAreLeftAlone) {
  for (const TargetRow& row : target_rows()) bilinear(GLEV_MAP2_COLOR_4 + row.offset, 2, 3, 4, 5);
  glevEnable(gl, GLEV_AUTO_NORMAL);
  glevTexCoord4f(gl, 5, 6, 7, 8);
  const std::vector<double> before = query_state();
  evaluate_at(0.5, 0.5);
  EXPECT_EQ(query_state(), before);
}

TEST_F(Surfaces, MapsThatWereNeverDefinedAreTheirInitialConstants) {
  for (const TargetRow& row : target_rows()) glevEnable(gl, GLEV_MAP2_COLOR_4 + row.offset);
  for (double u : {-3.0, 0.0, 0.5, 7.0}) {
    const glev_vertex vertex = evaluate_at(u, 1 - u);
    EXPECT_EQ(values_of(vertex.position), (Floats{0, 0, 0, 1}));
    EXPECT_EQ(values_of(vertex.normal), (Floats{0, 0, 1}));
    EXPECT_EQ(values_of(vertex.color), (Floats{1, 1, 1, 1}));
  }
}

TEST_F(Surfaces, ARedefinedMapTakesEffectAtOnce) {
  bilinear(GLEV_MAP2_VERTEX_3, 0, 1, 10, 11);
  EXPECT_EQ(evaluate_at(0.5, 0).position[0], 5);
  bilinear(GLEV_MAP2_VERTEX_3, 0, 1, 20, 21);
  EXPECT_EQ(evaluate_at(0.5, 0).position[0], 10);
  glevDisable(gl, GLEV_MAP2_VERTEX_3);
  bilinear(GLEV_MAP2_VERTEX_3, 0, 1, 30, 31);
  EXPECT_EQ(evaluate_at(0.5, 0).position[0], 15);
}

TEST_F(Surfaces, FormsAgreeBitForBit) {
  bilinear(GLEV_MAP2_VERTEX_3, 0.1f, 0.7f, -0.3f, 0.9f);
  const float f[] = {0.3f, 0.7f, kNaN};
  const double d[] = {0.3f, 0.7f, kNaN};
  glevBegin(gl, GLEV_POINTS);
  glevEvalCoord2f(gl, f[0], f[1]);
  glevEvalCoord2d(gl, d[0], d[1]);
  glevEvalCoord2fv(gl, f);
  glevEvalCoord2dv(gl, d);
  glevEnd(gl);
  ASSERT_EQ(recording.vertices.size(), 4u);
  for (const glev_vertex& vertex : recording.vertices) {
    EXPECT_EQ(vertex.position[0], recording.vertices[0].position[0]);
  }
  expect_rejected_in_primitive(GLEV_INVALID_VALUE, [&] { glevEvalCoord2fv(gl, nullptr); });
  expect_rejected_in_primitive(GLEV_INVALID_VALUE, [&] { glevEvalCoord2dv(gl, nullptr); });
}

// ---- Accuracy

class SurfaceNumerics : public Surfaces {
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
  float evaluate_texcoord(double u, double v) { return evaluate_at(u, v).texcoord[0][0]; }

  // Expects a value within the documented bound and one rounding to float.
  void expect_within_bound(double u, double v) {
    const ExactPoint exact = tensor(exact_basis(domain_[0], domain_[1], n_, u).values,
                                    exact_basis(domain_[2], domain_[3], m_, v).values, points_);
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
  const ExactBasis basis = exact_basis(2, 6, 3, 3);  // t = 1/4
  EXPECT_EQ(basis.values, (std::vector<Rational>{Rational(9, 16), Rational(6, 16), Rational(1, 16)}));
  EXPECT_EQ(basis.derivatives, (std::vector<Rational>{Rational(-3, 2), 1, Rational(1, 2)}));
  const ExactPoint point = tensor({1, 2}, {3, 5}, {1, -2, 4, 8});
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

TEST_F(SurfaceNumerics, NearlyAllResultsAreCorrectlyRounded) {
  std::uniform_real_distribution<double> inside(0, 1);
  int misrounded = 0;
  for (int surface = 0; surface < 25; ++surface) {
    define({0, 1, 0, 1}, 4, 4, random_net(4, 4));
    for (int i = 0; i < 20; ++i) {
      const auto u = static_cast<float>(inside(random_)), v = static_cast<float>(inside(random_));
      const float got = evaluate_texcoord(u, v);
      const Rational exact =
          tensor(exact_basis(0, 1, 4, u).values, exact_basis(0, 1, 4, v).values, points_).value;
      const Rational error = abs(to_rational(got) - exact);
      for (float next : {std::nextafter(got, -2.0f), std::nextafter(got, 2.0f)}) {
        misrounded += abs(to_rational(next) - exact) < error;
      }
    }
  }
  EXPECT_LE(misrounded, 2) << "of 500, seed " << kSeed;
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

TEST_F(SurfaceNumerics, ANetThatIsConstantInOneDirectionIsTheCurve) {
  const std::vector<double> curve = random_net(1, 5);
  glevMap1d(gl, GLEV_MAP1_TEXTURE_COORD_1, 0, 1, 1, 5, curve.data());
  glevEnable(gl, GLEV_MAP1_TEXTURE_COORD_1);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  std::vector<double> along_u, along_v;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 4; ++j) along_u.push_back(curve[i]);
  }
  for (int i = 0; i < 4; ++i) along_v.insert(along_v.end(), curve.begin(), curve.end());
  for (double t : {0.3, 0.8, -0.5}) {
    const float expected = one_vertex([&] { glevEvalCoord1d(gl, t); }).texcoord[0][0];
    define({0, 1, 0, 1}, 5, 4, along_u);
    EXPECT_FLOAT_EQ(evaluate_texcoord(t, 0.37), expected);
    define({0, 1, 0, 1}, 4, 5, along_v);
    EXPECT_FLOAT_EQ(evaluate_texcoord(0.37, t), expected);
  }
}

TEST_F(SurfaceNumerics, NonFiniteValuesDoNoHarm) {
  glevEnable(gl, GLEV_AUTO_NORMAL);
  glevEnable(gl, GLEV_MAP2_VERTEX_4);
  for (double bad : {kInfinity, -kInfinity, kNaN, 1.7e308}) {
    for (int order : {1, 2, 64}) {
      std::vector<double> points(64 * 64 * 4, 1.0);
      const auto evaluate = [&] {
        for (double u : {0.0, 0.25, 1.0, 1e300, bad}) {
          for (double v : {0.0, 0.25, 1.0, 1e300, bad}) evaluate_at(u, v);
        }
      };
      points[0] = bad;
      points[5] = -bad;
      glevMap2d(gl, GLEV_MAP2_VERTEX_4, 0, 1, 4 * order, order, 0, 1, 4, order, points.data());
      evaluate();
      points.assign(points.size(), 1.0);
      glevMap2d(gl, GLEV_MAP2_VERTEX_4, bad, 1, 4 * order, order, -1.7e308, bad, 4, order, points.data());
      evaluate();
    }
  }
  expect_error(GLEV_NO_ERROR);
  glevDisable(gl, GLEV_MAP2_VERTEX_4);
  bilinear(GLEV_MAP2_VERTEX_3, 0, 1, 10, 11);
  EXPECT_EQ(evaluate_at(0.5, 0.5).position[0], 5.5f);
}

}  // namespace
}  // namespace glev_tests
