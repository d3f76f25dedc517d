// Tests AUTO_NORMAL against exact derivatives, and where it has no normal. The conformance suite tests when
// it is used (suites/automatic_normals.cpp).
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "exact.h"
#include "fixture.h"
#include "src/normal.h"

namespace glev_tests {
namespace {

class Normals : public ContextTest {
 protected:
  Normals() { glevEnable(gl, GLEV_AUTO_NORMAL); }

  void define(std::array<double, 4> domain, int n, int m, int components, const std::vector<double>& points) {
    domain_ = domain;
    n_ = n;
    m_ = m;
    components_ = components;
    points_ = points;
    const glev_enum target = components == 3 ? GLEV_MAP2_VERTEX_3 : GLEV_MAP2_VERTEX_4;
    glevMap2d(gl, target, domain[0], domain[1], m * components, n, domain[2], domain[3], components, m,
              points.data());
    glevEnable(gl, target);
  }
  // Defines a plane with u along +x and v along +y.
  void define_plane(double size = 1) {
    define({0, 1, 0, 1}, 2, 2, 3, {0, 0, 0, 0, size, 0, size, 0, 0, size, size, 0});
  }
  Floats normal_at(double u, double v) {
    return values_of(one_vertex([&] { glevEvalCoord2d(gl, u, v); }).normal);
  }

  // Returns q_u x q_v, normalised, by the quotient rule; only the length is computed in double.
  std::array<double, 3> exact_normal_at(double u, double v) const {
    const Rational t_u = exact_t(domain_[0], domain_[1], u), t_v = exact_t(domain_[2], domain_[3], v);
    std::array<Rational, 4> p = {0, 0, 0, 1}, p_u = {0, 0, 0, 0}, p_v = {0, 0, 0, 0};
    for (int k = 0; k < components_; ++k) {
      const auto derivative = [&](std::array<int, 2> order) {
        return exact_point(points_, {n_, m_}, t_u, t_v, order, components_, k).value;
      };
      p[k] = derivative({0, 0});
      p_u[k] = derivative({1, 0});
      p_v[k] = derivative({0, 1});
    }
    std::array<Rational, 3> a, b;
    for (int k = 0; k < 3; ++k) {
      a[k] = (p_u[k] * p[3] - p[k] * p_u[3]) / (p[3] * p[3]);
      b[k] = (p_v[k] * p[3] - p[k] * p_v[3]) / (p[3] * p[3]);
    }
    const std::array<Rational, 3> m = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                       a[0] * b[1] - a[1] * b[0]};
    const Rational largest = std::max({Rational(abs(m[0])), Rational(abs(m[1])), Rational(abs(m[2]))});
    EXPECT_NE(largest, 0);
    std::array<double, 3> normal;
    for (int k = 0; k < 3; ++k) normal[k] = static_cast<double>(Rational(m[k] / largest));
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    for (double& x : normal) x /= length;
    return normal;
  }

  void expect_exact(double u, double v) {
    const std::array<double, 3> expected = exact_normal_at(u, v);
    const Floats got = normal_at(u, v);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(got[k], expected[k], 0x1p-23) << "component " << k << " at (" << u << "," << v << ") order "
                                                << n_ << "x" << m_ << ", seed " << kSeed;
    }
    EXPECT_NEAR(std::hypot(got[0], got[1], got[2]), 1, 0x1p-23);
  }

  // Returns a bumpy sheet, whose derivatives are not parallel anywhere near the domain.
  std::vector<double> sheet(int n, int m, int components, double size = 1) {
    std::uniform_real_distribution<double> noise(-0.3, 0.3), weight(0.5, 2);
    std::vector<double> points;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < m; ++j) {
        const double w = components == 4 ? weight(random_) : 1;
        for (double x : {1.0 * i / (n - 1) + noise(random_) / n, 1.0 * j / (m - 1) + noise(random_) / m,
                         noise(random_)}) {
          points.push_back(static_cast<float>(x * w * size));
        }
        if (components == 4) points.push_back(static_cast<float>(w));
      }
    }
    return points;
  }

  std::mt19937 random_{kSeed};
  std::array<double, 4> domain_;
  int n_, m_, components_;
  std::vector<double> points_;
};

TEST_F(Normals, AgreeWithTheExactOne) {
  std::uniform_real_distribution<double> inside(0, 1);
  const std::array<double, 4> domains[] = {{0, 1, 0, 1}, {2, 5, -3, -1}, {1, 0, 0.1, 0.7}, {0, 1, 5, -2}};
  int turn = 0;
  for (int components : {3, 4}) {
    for (auto [n, m] : {std::pair{2, 2}, {2, 5}, {4, 4}, {7, 3}, {3, 12}, {16, 2}}) {
      const std::array<double, 4>& d = domains[turn++ % 4];
      define(d, n, m, components, sheet(n, m, components));
      for (auto [s, t] : {std::pair{0.0, 0.0},
                          {1.0, 1.0},
                          {0.0, 1.0},
                          {1.0, 0.0},
                          {0.5, 0.5},
                          {0.0, 0.3},
                          {0.6, 1.0},
                          {inside(random_), inside(random_)},
                          {-0.05, 1.02}}) {
        expect_exact(s == 1 ? d[1] : d[0] + s * (d[1] - d[0]), t == 1 ? d[3] : d[2] + t * (d[3] - d[2]));
      }
    }
    glevDisable(gl, GLEV_MAP2_VERTEX_3);
  }
}

TEST_F(Normals, SizeDoesNotMatter) {
  for (double size : {1e-30, 1e30, 1e-3, 1e-300, 1e300, 0x1p-1060}) {
    define_plane(size);
    EXPECT_EQ(normal_at(0.3, 0.6), (Floats{0, 0, 1})) << size;
  }
  for (double size : {1e-30, 1e30, 1e-44}) {
    for (int components : {3, 4}) {
      glevDisable(gl, GLEV_MAP2_VERTEX_4);
      define({0, 1, 0, 1}, 4, 3, components, sheet(4, 3, components, size));
      expect_exact(0.3, 0.6);
      expect_exact(1, 0);
    }
  }
}

TEST_F(Normals, TheCommonFactorOfHomogeneousCoordinatesDoesNotMatter) {
  for (double factor : {1e-300, 1e-200, 1e-30, 1e30, 1e200, 1e300}) {
    std::vector<double> points = {0, 0, 5, 1, 0, 2, 10, 2, 3, 0, 15, 3, 4, 4, 20, 4};
    for (double& x : points) x *= factor;
    define({0, 1, 0, 1}, 2, 2, 4, points);
    const Floats normal = normal_at(0.3, 0.6);
    EXPECT_NEAR(normal[0], 0, 1e-12) << factor;
    EXPECT_NEAR(normal[1], 0, 1e-12) << factor;
    EXPECT_EQ(normal[2], 1) << factor;
  }
}

TEST_F(Normals, AThinSliverHasOne) {
  for (double thin : {1e-20, 1e-150, 1e-200, 1e-300}) {
    define({0, 1, 0, 1}, 2, 2, 3, {0, 0, 0, 1, thin, 0, 1, 0, 0, 2, thin, 0});
    EXPECT_EQ(normal_at(0.3, 0.6), (Floats{0, 0, 1})) << thin;
  }
}

TEST_F(Normals, AReversedDomainDoesNotTurnThem) {
  const std::vector<double> plane = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
  for (const auto& domain :
       {std::array{1.0, 0.0, 0.0, 1.0}, {0, 1, 1, 0}, {1, 0, 1, 0}, {0, 1e-6, 7, -1e6}}) {
    define(domain, 2, 2, 3, plane);
    EXPECT_EQ(normal_at(domain[0], domain[3]), (Floats{0, 0, 1}));
  }
}

TEST_F(Normals, AreZeroWhereThereIsNone) {
  const Floats zero = {0, 0, 0};
  // Order 1 in one direction or in both.
  define({0, 1, 0, 1}, 1, 2, 3, {0, 0, 0, 1, 2, 3});
  EXPECT_EQ(normal_at(0.5, 0.5), zero);
  define({0, 1, 0, 1}, 2, 1, 3, {0, 0, 0, 1, 2, 3});
  EXPECT_EQ(normal_at(0.5, 0.5), zero);
  define({0, 1, 0, 1}, 1, 1, 3, {1, 2, 3});
  EXPECT_EQ(normal_at(0.5, 0.5), zero);
  // A patch that is one point, and parallel derivatives.
  define({0, 1, 0, 1}, 2, 2, 3, {1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3});
  EXPECT_EQ(normal_at(0.5, 0.5), zero);
  define({0, 1, 0, 1}, 2, 2, 3, {0, 0, 0, 1, 1, 1, 1, 1, 1, 2, 2, 2});
  EXPECT_EQ(normal_at(0.5, 0.5), zero);
  // An edge that is one point: the normal is zero only there.
  define({0, 1, 0, 1}, 2, 2, 3, {0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0});
  EXPECT_EQ(normal_at(0, 0.5), zero);
  EXPECT_EQ(normal_at(0x1p-30, 0.5), (Floats{0, 0, 1}));
  // Derivatives that overflow.
  constexpr double kMost = std::numeric_limits<double>::max();
  define({0, 1, 0, 1}, 2, 2, 3, {kMost, 0, 0, -kMost, 1, 0, -kMost, 0, 1, kMost, 1, 1});
  EXPECT_EQ(normal_at(0, 0), zero);
}

TEST_F(Normals, NeverNaNFromFiniteCoordinates) {
  std::uniform_int_distribution<int> exponent(-1070, 1023);
  std::uniform_real_distribution<double> value(-1, 1);
  const auto vector = [&] {
    std::array<double, 4> v;
    for (double& x : v) x = std::ldexp(value(random_), exponent(random_));
    if (value(random_) < -0.7) v[random_() % 4] = 0;
    return v;
  };
  for (int i = 0; i < 20000; ++i) {
    const std::array<double, 3> n = glev::unit_normal(vector(), vector(), vector());
    const double length = std::hypot(n[0], n[1], n[2]);
    ASSERT_TRUE(length == 0 || std::fabs(length - 1) < 1e-15) << length << ", seed " << kSeed;
  }
}

TEST_F(Normals, NonFiniteCoordinatesGiveZero) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (double bad : {kInf, -kInf, std::nan("")}) {
    EXPECT_EQ(glev::unit_normal({0, 0, 0, 1}, {bad, 0, 0, 0}, {0, 1, 0, 0}),
              (std::array<double, 3>{0, 0, 0}));
    EXPECT_EQ(glev::unit_normal({0, 0, 0, 1}, {1, 0, 0, 0}, {0, 1, bad, 0}),
              (std::array<double, 3>{0, 0, 0}));
  }
}

}  // namespace
}  // namespace glev_tests
