// Tests AUTO_NORMAL where its value is known, and where there is no normal. normal_bounds_test.cpp compares
// normals with an oracle; the conformance suite tests when they are used (suites/automatic_normals.cpp).
#include <cmath>
#include <limits>
#include <random>

#include "fixture.h"
#include "src/normal.h"

namespace glev_tests {
namespace {

class Normals : public ContextTest {
 protected:
  Normals() { glevEnable(gl, GLEV_AUTO_NORMAL); }

  void define(std::array<double, 4> domain, int n, int m, int components, const std::vector<double>& points) {
    const glev_enum target = components == 3 ? GLEV_MAP2_VERTEX_3 : GLEV_MAP2_VERTEX_4;
    glevMap2d(gl, target, domain[0], domain[1], m * components, n, domain[2], domain[3], components, m,
              points.data());
    glevEnable(gl, target);
  }
  Floats normal_at(double u, double v) {
    return values_of(one_vertex([&] { glevEvalCoord2d(gl, u, v); }).normal);
  }
};

TEST_F(Normals, SizeDoesNotMatter) {
  for (double size : {1e-30, 1e30, 1e-3, 1e-300, 1e300, 0x1p-1060}) {
    define({0, 1, 0, 1}, 2, 2, 3, {0, 0, 0, 0, size, 0, size, 0, 0, size, size, 0});
    EXPECT_EQ(normal_at(0.3, 0.6), (Floats{0, 0, 1})) << size;
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
  constexpr double kMost = std::numeric_limits<double>::max();
  const Floats zero = {0, 0, 0};
  struct Row {
    const char* what;
    int n, m;
    std::vector<double> points;
  };
  const Row rows[] = {{"order 1 in u", 1, 2, {0, 0, 0, 1, 2, 3}},
                      {"order 1 in v", 2, 1, {0, 0, 0, 1, 2, 3}},
                      {"order 1 in both", 1, 1, {1, 2, 3}},
                      {"one point", 2, 2, {1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3}},
                      {"parallel derivatives", 2, 2, {0, 0, 0, 1, 1, 1, 1, 1, 1, 2, 2, 2}}};
  for (const Row& row : rows) {
    define({0, 1, 0, 1}, row.n, row.m, 3, row.points);
    EXPECT_EQ(normal_at(0.5, 0.5), zero) << row.what;
  }
  // An edge that is one point: the normal is zero only there.
  define({0, 1, 0, 1}, 2, 2, 3, {0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0});
  EXPECT_EQ(normal_at(0, 0.5), zero);
  EXPECT_EQ(normal_at(0x1p-30, 0.5), (Floats{0, 0, 1}));
  // Derivatives that overflow.
  define({0, 1, 0, 1}, 2, 2, 3, {kMost, 0, 0, -kMost, 1, 0, -kMost, 0, 1, kMost, 1, 1});
  EXPECT_EQ(normal_at(0, 0), zero);
}

TEST_F(Normals, NeverNaNFromFiniteCoordinates) {
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> exponent(-1070, 1023);
  std::uniform_real_distribution<double> value(-1, 1);
  const auto vector = [&] {
    std::array<double, 4> v;
    for (double& x : v) x = std::ldexp(value(random), exponent(random));
    if (value(random) < -0.7) v[random() % 4] = 0;
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
