// Tests values against exact rational arithmetic.
#include <cmath>
#include <cstring>
#include <random>

#include "exact.h"
#include "fixture.h"
#include "src/bernstein.h"

namespace glev_tests {
namespace {

class Numerics : public ContextTest {
 protected:
  Numerics() { glevEnable(gl, GLEV_MAP1_VERTEX_3); }

  void define(double u1, double u2, const std::vector<double>& points) {
    glevMap1d(gl, GLEV_MAP1_TEXTURE_COORD_1, u1, u2, 1, static_cast<int>(points.size()), points.data());
    glevEnable(gl, GLEV_MAP1_TEXTURE_COORD_1);
    u1_ = u1;
    u2_ = u2;
    points_ = points;
  }
  float evaluate_at(double u) {
    return one_vertex([&] { glevEvalCoord1d(gl, u); }).texcoord[0][0];
  }

  // Expects a value within the documented bound, (13n + 4) * 2^-53 of the sum of absolute terms, and one
  // rounding to float.
  void expect_within_bound(double u) {
    const Sum<Rational> exact =
        exact_point(points_, {static_cast<int>(points_.size()), 1}, exact_t(u1_, u2_, u));
    const float got = evaluate_at(u);
    ASSERT_TRUE(std::isfinite(got)) << "u = " << u;
    const double n = static_cast<double>(points_.size()) - 1;
    const Rational in_double = exact.magnitude * to_rational((13 * n + 4) * 0x1p-53 * (1 + 0x1p-40));
    const Rational rounding = std::max(abs(to_rational(got)) * to_rational(0x1p-24), to_rational(0x1p-150));
    EXPECT_LE(abs(to_rational(got) - exact.value), in_double + rounding)
        << "u = " << u << " in [" << u1_ << "," << u2_ << "], order " << points_.size() << ", got " << got
        << ", exact " << static_cast<double>(exact.value) << ", seed " << kSeed;
  }

  std::mt19937 random_{kSeed};
  double u1_ = 0, u2_ = 1;
  std::vector<double> points_;
};

TEST_F(Numerics, TheOracleKnowsACubic) {
  // B(3,i,1/4) = 27/64, 27/64, 9/64, 1/64
  const Sum<Rational> point = exact_point({1, -2, 4, 8}, {4, 1}, exact_t(2, 6, 3));
  EXPECT_EQ(point.value, Rational(27 - 54 + 36 + 8, 64));
  EXPECT_EQ(point.magnitude, Rational(27 + 54 + 36 + 8, 64));
  EXPECT_EQ(to_rational(-0.375), Rational(-3, 8));
  EXPECT_EQ(to_rational(0x1p-1074), Rational(1, Integer(1) << 1074));
}

TEST_F(Numerics, EveryOrderInsideAndOutsideTheDomain) {
  std::uniform_real_distribution<double> value(-1, 1), inside(0, 1);
  const std::pair<double, double> domains[] = {{0, 1}, {2, 5},  {-3, -1},  {1000, 1008},
                                               {1, 0}, {5, -2}, {0.1, 0.7}};
  for (int order = 1; order <= 64; ++order) {
    const auto [u1, u2] = domains[order % std::size(domains)];
    std::vector<double> points(order);
    for (double& point : points) point = static_cast<float>(value(random_));
    define(u1, u2, points);
    for (double t : {inside(random_), inside(random_), 0.5, 1e-9, 1 - 1e-9})
      expect_within_bound(u1 + t * (u2 - u1));
    for (double t : {-0.125, 1.125, -1.0 / order, 1 + 1.0 / order}) expect_within_bound(u1 + t * (u2 - u1));
  }
}

TEST_F(Numerics, CancellationStaysWithinTheBound) {
  // (1 - 2u)^n: the sum of absolute terms is 1 everywhere, the value nearly 0 around 1/2.
  for (int order : {2, 4, 10, 30, 64}) {
    std::vector<double> points(order);
    for (int i = 0; i < order; ++i) points[i] = i % 2 == 0 ? 1 : -1;
    define(0, 1, points);
    for (double u : {0.5, 0.499, 0.501, 0.4, 0.3, 0.75}) expect_within_bound(u);
  }
}

TEST_F(Numerics, AnArgumentNextToAnEnd) {
  // t/s is up to 2^53, and its 63rd power would overflow; so would that of 2^149 for the smallest floats.
  std::uniform_real_distribution<double> value(-1, 1);
  for (int order : {2, 5, 22, 64}) {
    std::vector<double> points(order);
    for (double& point : points) point = value(random_);
    define(0, 1, points);
    for (double u : {0x1p-53, 0x1p-149, 1 - 0x1p-53, 1 - 1e-12, 1 + 0x1p-52, -1e-30}) expect_within_bound(u);
  }
}

TEST_F(Numerics, TheEndsGiveTheEndPoints) {
  for (int order : {2, 3, 4, 17, 64}) {
    for (auto [u1, u2] : {std::pair{0.0, 1.0}, {0.1, 0.7}, {5.0, -2.0}, {1e9, 1e9 + 1}}) {
      for (float end : {0.1f, -0.0f, 0x1p-149f, 4.2e9f}) {
        // The other control points must not affect the result.
        std::vector<double> points(order, order > 2 ? kNaN : 0.0);
        points.front() = end;
        points.back() = -end;
        define(u1, u2, points);
        // A zero result is +0.
        const float plus = end + 0.0f, first = evaluate_at(u1), last = evaluate_at(u2), minus = -end + 0.0f;
        EXPECT_EQ(std::memcmp(&first, &plus, sizeof plus), 0) << first << " for " << end;
        EXPECT_EQ(std::memcmp(&last, &minus, sizeof end), 0) << last << " for " << minus;
      }
    }
  }
  define(0, 1, {3, 5});
  EXPECT_EQ(evaluate_at(-0.0), 3.0f);
}

TEST_F(Numerics, OrderOneIsConstantEverywhere) {
  define(2, 5, {0.1});
  for (double u : {2.0, 5.0, 3.0, -1e30, 1e300, kInfinity, std::nan("")})
    EXPECT_EQ(evaluate_at(u), 0.1f) << u;
}

TEST_F(Numerics, LargeAndSmallDataOfTheGLRange) {
  std::uniform_real_distribution<double> inside(0, 1);
  for (int order : {2, 4, 31, 64}) {
    for (double scale : {0x1p32, 0x1p-126, 0x1p-149, 0x1p127}) {
      std::vector<double> points(order);
      for (int i = 0; i < order; ++i) points[i] = i % 3 == 0 ? -scale : scale;
      define(-0x1p32, 0x1p32, points);
      for (int i = 0; i < 4; ++i) expect_within_bound((2 * inside(random_) - 1) * 0x1p32);
      define(1, 1 + 0x1p-23, points);
      for (int i = 0; i < 4; ++i) expect_within_bound(1 + inside(random_) * 0x1p-23);
    }
  }
}

TEST_F(Numerics, PowersOverflowOnlyIfTheResultDoes) {
  // t^63 is 2^1134, and its product with the control point is 2^114.
  std::vector<double> points(64);
  points.back() = 0x1p-1020;
  define(0, 1, points);
  EXPECT_EQ(evaluate_at(0x1p18), 0x1p114f);
  EXPECT_EQ(evaluate_at(-0x1p18), -0x1p114f);
}

// ---- Parameters: the internal argument type, for real arguments and for grid points

TEST(Parameters, RealArguments) {
  const glev::Domain domain = {2, 5};
  using End = glev::Parameter::End;
  EXPECT_EQ(glev::locate(domain, 2.0).end, End::kFirst);
  EXPECT_EQ(glev::locate(domain, 5.0).end, End::kLast);
  const glev::Parameter third = glev::locate(domain, 3.0);
  EXPECT_EQ(third.end, End::kNeither);
  EXPECT_EQ(third.t, 1.0 / 3.0);
  EXPECT_EQ(third.s, 2.0 / 3.0);
  // s has its own division: 1 - t would be 0 here
  EXPECT_EQ(glev::locate({0, 1}, 1 - 0x1p-53).s, 0x1p-53);
}

TEST(Parameters, GridPointsOfTheDomainItselfAreCorrectlyRounded) {
  for (glev_int n : {1, 3, 7, 10, 300, 2147483647}) {
    const glev::Domain domain = {0.1, 0.7};
    const glev::Grid grid = {0.1, 0.7, n};
    for (std::int64_t i : {std::int64_t{1}, std::int64_t{2}, std::int64_t{n / 2}, std::int64_t{n - 1}}) {
      if (i <= 0 || i >= n) continue;
      const glev::Parameter at = glev::locate(domain, glev::GridArgument{grid, i});
      EXPECT_EQ(at.t, static_cast<double>(i) / n);
      EXPECT_EQ(at.s, static_cast<double>(n - i) / n);
    }
    EXPECT_EQ(glev::locate(domain, glev::GridArgument{grid, 0}).end, glev::Parameter::End::kFirst);
    EXPECT_EQ(glev::locate(domain, glev::GridArgument{grid, n}).end, glev::Parameter::End::kLast);
  }
}

TEST(Parameters, AGridOfEqualEndsIsThatArgument) {
  const glev::Domain domain = {0.1, 0.73};
  for (glev_int n : {1, 3, 7, 10}) {
    for (double u : {0.37, 0.1, 0.73, -5.3}) {
      const glev::Parameter one = glev::locate(domain, u);
      for (std::int64_t i = -3; i <= n + 3; ++i) {
        const glev::Parameter at = glev::locate(domain, glev::GridArgument{{u, u, n}, i});
        EXPECT_TRUE(at.s == one.s && at.t == one.t && at.end == one.end) << i << "/" << n << " of " << u;
      }
    }
  }
}

TEST(Parameters, GridPointsOfOtherGridsAreCloseToTheExactPoint) {
  const glev::Domain domain = {2, 5};
  for (const glev::Grid& grid : {glev::Grid{0, 10, 7}, {4.9, 2.2, 13}, {3, 3, 4}}) {
    for (std::int64_t i = -3; i <= grid.segments + 3; ++i) {
      const glev::Parameter at = glev::locate(domain, glev::GridArgument{grid, i});
      const Rational u =
          to_rational(grid.u1) + (to_rational(grid.u2) - to_rational(grid.u1)) * i / grid.segments;
      const Rational t = (u - 2) / 3;
      EXPECT_LE(abs(to_rational(at.t) - t), to_rational(1e-14)) << i;
      EXPECT_LE(abs(to_rational(at.s) - (1 - t)), to_rational(1e-14)) << i;
    }
    EXPECT_EQ(glev::locate(domain, glev::GridArgument{grid, 0}).t, glev::locate(domain, grid.u1).t);
    EXPECT_EQ(glev::locate(domain, glev::GridArgument{grid, grid.segments}).t,
              glev::locate(domain, grid.u2).t);
  }
}

}  // namespace
}  // namespace glev_tests
