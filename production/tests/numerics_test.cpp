// Tests that single values are correctly rounded, with rational arithmetic as the oracle, and the internal
// argument type.
#include "numerics.h"

#include <cmath>

#include "src/parameter.h"

namespace glev_tests {
namespace {

TEST_F(Numerics, TheOracleKnowsACubicAndABiquadratic) {
  // B(3,i,1/4) = 27/64, 27/64, 9/64, 1/64
  const Sum<Rational> point = exact_point({1, -2, 4, 8}, {4, 1}, exact_t(2, 6, 3));
  EXPECT_EQ(point.value, Rational(27 - 54 + 36 + 8, 64));
  EXPECT_EQ(point.magnitude, Rational(27 + 54 + 36 + 8, 64));
  EXPECT_EQ(to_rational(-0.375), Rational(-3, 8));
  EXPECT_EQ(to_rational(0x1p-1074), Rational(1, Integer(1) << 1074));
  const Rational t(1, 4), s(3, 4);
  EXPECT_EQ(bernstein(3, t, s), (std::vector<Rational>{Rational(9, 16), Rational(6, 16), Rational(1, 16)}));
  EXPECT_EQ(bernstein(3, t, s, 1), (std::vector<Rational>{Rational(-3, 2), 1, Rational(1, 2)}));
  EXPECT_EQ(bernstein(3, t, s, 2), (std::vector<Rational>{2, -4, 2}));
  const Sum<Rational> sum = tensor<Rational>({1, 2}, {3, 5}, {1, -2, 4, 8});
  EXPECT_EQ(sum.value, 3 - 10 + 2 * (12 + 40));
  EXPECT_EQ(sum.magnitude, 3 + 10 + 2 * (12 + 40));
}

TEST_F(Numerics, OrdersInsideAndOutsideTheDomain) {
  std::uniform_real_distribution<double> inside(0, 1);
  const std::array<double, 4> domains[] = {{0, 1, 0, 1},       {2, 5, -3, -1},   {-3, -1, 2, 5},
                                           {1000, 1008, 1, 0}, {1, 0, 0.1, 0.7}, {5, -2, 0, 1},
                                           {0.1, 0.7, 5, -2}};
  int turn = 0;
  const auto check = [&](int n, int m, int arguments) {
    const std::array<double, 4>& domain = domains[turn++ % std::size(domains)];
    define(domain, n, m, random_net(n, m));
    const double places[] = {inside(random_), 0.5, 1e-9, 1 - 1e-9, -0.125, 1 + 1.0 / n, 1.125, -1.0 / n};
    for (int k = 0; k < arguments; ++k) {
      const double t = places[k], s = k % 2 == 0 ? inside(random_) : places[arguments - 1 - k];
      expect_nearest(domain[0] + t * (domain[1] - domain[0]), domain[2] + s * (domain[3] - domain[2]));
    }
  };
  for (int n = 1; n <= 64; ++n) check(n, 1, 8);
  for (int n = 1; n <= 8; ++n) {
    for (int m = 2; m <= 8; ++m) check(n, m, 6);
  }
  for (auto [n, m] : {std::pair{1, 64}, {2, 33}, {30, 3}, {17, 19}}) check(n, m, 2);
  check(64, 64, 1);
}

TEST_F(Numerics, Cancellation) {
  // (1 - 2u)^n (1 - 2v)^m: the sum of absolute terms is 1 everywhere, the value nearly 0 around 1/2.
  for (auto [n, m] : {std::pair{2, 1}, {4, 1}, {10, 1}, {30, 1}, {64, 1}, {4, 4}, {10, 3}, {2, 20}}) {
    std::vector<double> points;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < m; ++j) points.push_back((i + j) % 2 == 0 ? 1 : -1);
    }
    define({0, 1, 0, 1}, n, m, points);
    for (double u : {0.5, 0.499, 0.501, 0.4, 0.3, 0.75}) {
      for (double v : {0.501, 0.5, 0.75, 0x1p-53, 1 - 0x1p-53}) expect_nearest(u, v);
    }
  }
}

TEST_F(Numerics, AnArgumentNextToAnEnd) {
  // t/s is up to 2^53, and its 63rd power would overflow; so would that of 2^149 for the smallest floats.
  for (int order : {2, 5, 22, 64}) {
    define({0, 1, 0, 1}, order, 1, random_net(order, 1));
    for (double u : {0x1p-53, 0x1p-149, 1 - 0x1p-53, 1 - 1e-12, 1 + 0x1p-52, -1e-30}) expect_nearest(u);
  }
}

TEST_F(Numerics, TheEndsGiveTheEndPoints) {
  for (auto [n, m] : {std::pair{2, 1},
                      {3, 1},
                      {4, 1},
                      {17, 1},
                      {64, 1},
                      {2, 2},
                      {3, 3},
                      {4, 2},
                      {3, 17},
                      {64, 64},
                      {5, 64}}) {
    for (const auto& domain :
         {std::array{0.0, 1.0, 0.0, 1.0}, {0.1, 0.7, 5.0, -2.0}, {1e9, 1e9 + 1, 3, 2}, {5, -2, 0.1, 0.7}}) {
      for (float end : {0.1f, -0.0f, 0x1p-149f, 4.2e9f}) {
        // The other control points must not affect the result.
        std::vector<double> points(static_cast<std::size_t>(n) * m, n * m > 2 ? kNaN : 0);
        const auto corner = [&, n = n, m = m](int k) -> double& {
          return points[k / 2 * (n - 1) * m + k % 2 * (m - 1)];
        };
        corner(0) = end;
        corner(3) = -end;
        if (m > 1) corner(1) = end + 1, corner(2) = 2 * end;
        define(domain, n, m, points);
        // A zero result is +0.
        for (int k = 0; k < 4; ++k)
          expect_bits(static_cast<float>(corner(k)) + 0.0f, domain[k / 2], domain[2 + k % 2]);
      }
    }
  }
  define({0, 1, 0, 1}, 2, 1, {3, 5});
  expect_bits(3, -0.0);
}

TEST_F(Numerics, OrderOneIsConstantInItsDirection) {
  const std::vector<double> anywhere = {2, 5, 3, -1e30, 1e300, kInfinity, kNaN};
  define({2, 5, 2, 5}, 1, 1, {0.1});
  for (double u : anywhere) {
    for (double v : anywhere) expect_bits(0.1f, u, v);
  }
  // In the other direction, the surface is equal to the curve.
  const std::vector<double> points = random_net(1, 7);
  for (double along : {2.0, 2.7, 4.9, 5.0, -8.0}) {
    define({2, 5, 2, 5}, 7, 1, points);
    const float expected = evaluate_at(along);
    for (double across : anywhere) expect_bits(expected, along, across);
    define({2, 5, 2, 5}, 1, 7, points);
    for (double across : anywhere) expect_bits(expected, across, along);
  }
}

TEST_F(Numerics, LargeAndSmallDataOfTheGLRange) {
  std::uniform_real_distribution<double> inside(0, 1);
  for (auto [n, m] : {std::pair{2, 1}, {4, 1}, {31, 1}, {64, 1}, {5, 4}}) {
    for (double scale : {0x1p32, 0x1p-126, 0x1p-149, 0x1p127}) {
      std::vector<double> points;
      for (int i = 0; i < n * m; ++i) points.push_back(i % 3 == 0 ? -scale : scale);
      define({-0x1p32, 0x1p32, 1, 1 + 0x1p-23}, n, m, points);
      for (int i = 0; i < 4; ++i)
        expect_nearest((2 * inside(random_) - 1) * 0x1p32, 1 + inside(random_) * 0x1p-23);
      define({1, 1 + 0x1p-23, -0x1p32, 0x1p32}, n, m, points);
      for (int i = 0; i < 4; ++i)
        expect_nearest(1 + inside(random_) * 0x1p-23, (2 * inside(random_) - 1) * 0x1p32);
    }
  }
}

TEST_F(Numerics, PowersOverflowOnlyIfTheResultDoes) {
  // t^63 is 2^1134, and its product with the control point is 2^114.
  std::vector<double> points(64);
  points.back() = 0x1p-1020;
  define({0, 1, 0, 1}, 64, 1, points);
  expect_bits(0x1p114f, 0x1p18);
  expect_bits(-0x1p114f, -0x1p18);
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
