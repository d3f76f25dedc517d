// Tests correct rounding against exact integers, in every rounding mode.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include "exact.h"
#include "fixture.h"
#include "rounding_modes.h"
#include "src/exact.h"

namespace glev_tests {
namespace {

using glev::Domain, glev::GridArgument;

constexpr double kTiny = 0x1p-1074, kHuge = std::numeric_limits<double>::max();

GridArgument plain(double u) { return {{u, u, 1}, 0}; }

struct Problem {
  std::array<int, 2> order = {1, 1};
  std::array<Domain, 2> domain;
  std::vector<double> points;  // v fastest
  std::array<GridArgument, 2> at = {plain(0), plain(0)};
};

Problem curve_problem(const Domain& domain, std::vector<double> points, const GridArgument& u) {
  return {{static_cast<int>(points.size()), 1}, {domain, Domain{}}, std::move(points), {u, plain(0)}};
}

std::string show(const Problem& problem) {
  std::ostringstream out;
  out << std::hexfloat;
  for (int k : {0, 1}) {
    const auto& [grid, index] = problem.at[k];
    out << "order " << problem.order[k] << " on [" << problem.domain[k].u1 << ", " << problem.domain[k].u2
        << "] at " << index << " / " << grid.segments << " of [" << grid.u1 << ", " << grid.u2 << "]; ";
  }
  out << "points";
  for (std::size_t i = 0; i < std::min<std::size_t>(problem.points.size(), 8); ++i)
    out << " " << problem.points[i];
  return out.str();
}

// The result is `expected` in the first `modes` modes, for dense and strided points.
void expect_rounded(const Problem& problem, float expected, int modes = std::size(kModes)) {
  constexpr int kStride = 3;
  std::vector<double> spread(problem.points.size() * kStride, kNaN);
  for (std::size_t i = 0; i < problem.points.size(); ++i) spread[i * kStride] = problem.points[i];
  for (int i = 0; i < modes; ++i) {
    const bool dense = i % 2 == 0;
    const glev::Component component = {dense ? problem.points.data() : spread.data(), dense ? 1 : kStride,
                                       problem.order, problem.domain};
    float got = 0;
    call_in_mode(kModes[i], [&] { got = glev::round_exactly(component, problem.at[0], problem.at[1]); });
    EXPECT_EQ(float_bits(got), float_bits(expected))
        << got << " for " << expected << ", mode " << kModes[i] << ": " << show(problem);
  }
}

void expect_nearest(const Problem& problem, int modes = std::size(kModes)) {
  const auto t = [&](int k) {
    return problem.order[k] == 1 ? Rational(0) : exact_t(problem.domain[k], problem.at[k]);
  };
  expect_rounded(problem, nearest_float(exact_point(problem.points, problem.order, t(0), t(1)).value), modes);
}

// ---- The oracle

TEST(Nearest, IsWhatTheProcessorRoundsTo) {
  std::mt19937_64 random{kSeed};
  const auto check = [](double x) {
    EXPECT_EQ(float_bits(nearest_float(to_rational(x))), float_bits(static_cast<float>(x))) << x;
  };
  for (int i = 0; i < 2000; ++i) {
    const double significand = 1 + static_cast<double>(random() >> 12) * 0x1p-52;
    check(std::ldexp(i % 2 == 0 ? significand : -significand, static_cast<int>(random() % 300) - 160));
    // A tie and its neighbours.
    const double tie =
        std::ldexp(static_cast<double>(random() % 0x1000000 * 2 + 1), static_cast<int>(random() % 260) - 160);
    for (double x : {tie, std::nextafter(tie, 0), std::nextafter(tie, kHuge)}) check(x);
  }
  for (double x :
       {0x1p128 - 0x1p103, std::nextafter(0x1p128 - 0x1p103, 0), 0x1p-150, -0x1p-150, 0x1.8p-149, 0.0})
    check(x);
  EXPECT_EQ(nearest_float(Rational(1, 3)), 1.0f / 3.0f);
}

TEST(Nearest, TheOracleKnowsASurface) {
  EXPECT_EQ(exact_t(glev::Domain{2, 6}, glev::GridArgument{{1, 5, 4}, 2}), Rational(1, 4));
  // (1 - u)(1 - v) 1 + (1 - u) v 2 + u (1 - v) 3 + u v kTiny at 1/3, 1/4
  EXPECT_EQ(exact_point({1, 2, 3, kTiny}, {2, 2}, Rational(1, 3), Rational(1, 4)).value,
            Rational(6 + 4 + 9, 12) + to_rational(kTiny) / 12);
}

// ---- Random problems

class RoundExactly : public ::testing::Test {
 protected:
  int integer_below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  double random_unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  double random_signed_unit() { return 2 * random_unit() - 1; }
  template <class... Reals>
  double one_of(Reals... reals) {
    const double all[] = {static_cast<double>(reals)...};
    return all[integer_below(sizeof...(reals))];
  }
  double any_double() {
    while (true) {
      const auto x = std::bit_cast<double>(random_());
      if (std::isfinite(x)) return x;
    }
  }
  float any_float() {
    while (true) {
      const auto x = std::bit_cast<float>(static_cast<std::uint32_t>(random_()));
      if (std::isfinite(x)) return x;
    }
  }

  std::vector<double> random_points(int count, int kind) {
    std::vector<double> points(count);
    for (double& point : points) {
      switch (kind) {
        case 0:
          point = static_cast<float>(random_signed_unit());
          break;
        case 1:
          point = integer_below(21) - 10;
          break;
        case 2:
          point = random_signed_unit();
          break;
        case 3:
          point = any_float();
          break;
        case 4:
          point = integer_below(3) == 0 ? 0 : std::ldexp(1 + random_unit(), -149 + integer_below(10));
          break;
        case 5:
          point = std::ldexp(random_signed_unit(), 128);
          break;
        default:
          point = any_double();
      }
    }
    return points;
  }
  static constexpr int kPointKinds = 7;

  Domain any_domain(int kind) {
    switch (kind) {
      case 0:
        return {0, 1};
      case 1:
        return {1, 0};
      case 2:
        return {static_cast<float>(random_signed_unit()), 1 + static_cast<float>(random_unit())};
      case 3:
        return {5 + random_unit(), -2 * random_unit()};
      case 4:
        return {0, 3};
      case 5:
        return {0.1, std::nextafter(0.1, one_of(0, 1))};
      case 6:
        return {one_of(0, kTiny), 0x1p-1070};
      case 7:
        return {-kHuge, kHuge};
      default:
        return {any_double(), any_double()};
    }
  }
  static constexpr int kDomainKinds = 9;

  GridArgument any_argument(const Domain& domain) {
    const auto& [u1, u2] = domain;
    const auto index = [&](glev_int n) {
      return static_cast<std::int64_t>(one_of(0, n, random_unit() * n, random_unit() * n,
                                              -random_unit() * 0x1p32, random_unit() * 0x1p32));
    };
    const auto segments =
        static_cast<glev_int>(one_of(1, 2, 3, 7, 10, 300, 1024, 1 + integer_below(1000), 0x7FFFFFFF));
    switch (integer_below(10)) {
      case 0:
        return plain(one_of(u1, u2, std::nextafter(u1, u2), std::nextafter(u2, u1)));
      case 1:
        return plain(u1 / 2 + u2 / 2);
      case 2:
        return plain(one_of(0, -1, 0.5, 1024, kTiny, kHuge, -1e308, 0x1p-40));
      case 3:
        return plain(any_float());
      case 4:
        return {{u1, u2, segments}, index(segments)};
      case 5:
        return {{u2, u1, segments}, index(segments)};
      case 6:
        return {{one_of(u1, 0, 0.25), one_of(u2, 0, 1, 2.5), segments}, index(segments)};
      case 7:
        return {{any_double(), any_float(), segments}, index(segments)};
      default: {
        const double t = one_of(random_unit(), random_unit(), static_cast<float>(random_unit()),
                                2 * random_signed_unit(), integer_below(1025) / 1024.0);
        return plain(std::clamp((1 - t) * u1 + t * u2, -kHuge, kHuge));
      }
    }
  }

  Problem any_problem(std::array<int, 2> order, int domains) {
    Problem problem = {order, {}, random_points(order[0] * order[1], integer_below(kPointKinds)), {}};
    for (int k : {0, 1}) {
      do {
        problem.domain[k] = any_domain(integer_below(domains));
      } while (problem.domain[k].u1 == problem.domain[k].u2);
      problem.at[k] = any_argument(problem.domain[k]);
    }
    return problem;
  }

  std::mt19937_64 random_{kSeed};
};

TEST_F(RoundExactly, CurvesOfAllKinds) {
  for (int i = 0; i < 15000 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
    expect_nearest(any_problem({1 + integer_below(8), 1}, kDomainKinds));
  }
}

TEST_F(RoundExactly, CurvesOfEveryOrder) {
  for (int i = 0; i < 4 * kMax && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
    expect_nearest(any_problem({1 + i % kMax, 1}, 6));
  }
  for (int i = 0; i < 30 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "wide case " << i << ", seed " << kSeed);
    expect_nearest(any_problem({30 + integer_below(35), 1}, kDomainKinds), 2);
  }
}

TEST_F(RoundExactly, ASurfaceOfOneRowOrColumnIsACurve) {
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    const Problem across = any_problem({1, 1 + integer_below(12)}, kDomainKinds);
    expect_nearest(across);
    const Problem along = {
        {across.order[1], 1}, {across.domain[1], {}}, across.points, {across.at[1], across.at[0]}};
    expect_nearest(along);
  }
}

TEST_F(RoundExactly, SurfacesOfAllKinds) {
  for (int i = 0; i < 4000 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
    expect_nearest(any_problem({1 + integer_below(5), 1 + integer_below(5)}, kDomainKinds));
  }
  for (int i = 0; i < 150 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "larger case " << i << ", seed " << kSeed);
    expect_nearest(any_problem({1 + integer_below(16), 1 + integer_below(16)}, 6));
  }
}

TEST_F(RoundExactly, TheLargestSurfaces) {
  for (int kind : {0, 3}) {
    Problem problem = {{kMax, kMax},
                       {Domain{0, 1}, Domain{0.1, 0.7}},
                       random_points(kMax * kMax, kind),
                       {plain(0x1.234566p-3), plain(0.6)}};
    expect_nearest(problem, 2);
  }
}

TEST_F(RoundExactly, TheWidestOfAll) {
  // Domains and arguments have units of 2^-1074 and magnitudes of 2^1024, with 2^31 segments and 2^32
  // indices; so do control points.
  Problem problem = {{kMax, kMax}, {}, {}, {}};
  for (int i = 0; i < kMax * kMax; ++i)
    problem.points.push_back(i % 5 == 0 ? kTiny : i % 3 == 0 ? kHuge : -kHuge);
  problem.domain = {Domain{-kHuge, kTiny}, Domain{kHuge, -1.1}};
  problem.at = {GridArgument{{kHuge, -kHuge / 3, 0x7FFFFFFF}, -0x1FFFFFFFFLL},
                plain(-0x1.123456789abcdp-1022)};
  const glev::Component component = {problem.points.data(), 1, problem.order, problem.domain};
  EXPECT_TRUE(std::isinf(glev::round_exactly(component, problem.at[0], problem.at[1])));
}

// The 63rd power of t = 1/2 - 2^-1075 / huge is finite.
TEST_F(RoundExactly, TheWidestOfFiniteResults) {
  Problem problem = {
      {kMax, kMax}, {Domain{-kHuge, kHuge}, Domain{-kHuge, kHuge}}, {}, {plain(-kTiny), plain(kTiny)}};
  for (int i = 0; i < kMax * kMax; ++i)
    problem.points.push_back(i == 0 ? 0x1p126 : i % 2 == 0 ? kTiny : -kTiny);
  expect_rounded(problem, 1, 1);
  problem.points[1] = problem.points[kMax] = 0;
  problem.points[kMax * kMax - 1] = 0x1p102;  // half of the last bit of 1
  expect_nearest(problem, 1);
}

// ---- Ties

TEST_F(RoundExactly, TiesAndTheirNeighbours) {
  for (int i = 0; i < 2000 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
    const int order = 1 + integer_below(12);
    const double odd = 2.0 * (0x800000 + integer_below(0x800000)) + 1;
    const double tie = std::ldexp(integer_below(2) == 0 ? odd : -odd, integer_below(254) - 150);
    Domain domain = any_domain(integer_below(5));
    const double t = one_of(0.5, 0.25, random_unit(), 0x1p-40, 1 - 0x1p-40);
    Problem problem =
        curve_problem(domain, std::vector<double>(order, tie), plain((1 - t) * domain.u1 + t * domain.u2));
    if (integer_below(3) == 0)
      problem.at[0] = {{domain.u1, domain.u2, 3 + integer_below(30)}, 1 + integer_below(2)};
    const auto magnitude = static_cast<std::int64_t>(std::fabs(odd));
    const float even = static_cast<float>(tie);
    ASSERT_EQ(std::fabs(static_cast<double>(even)) > std::fabs(tie), magnitude / 2 % 2 == 1);
    expect_rounded(problem, even);
    // The smallest change of a control point.
    for (double towards : {kHuge, -kHuge}) {
      for (int changed : {0, order / 2, order - 1}) {
        Problem neighbour = problem;
        neighbour.points[changed] = std::nextafter(tie, towards);
        expect_nearest(neighbour);
      }
    }
  }
}

TEST_F(RoundExactly, TiesThatALeastBitFarBelowBreaks) {
  // The sum of all terms but one is exactly the tie; the other term is 2^-1074 times a power of t.
  for (int order : {3, 4, 9, 30, 64}) {
    for (double u : {0.5, 1.0 / 3, 0x1p-24, 0x1p-1074, 0.9}) {
      for (double tiny : {kTiny, -kTiny, 0.0}) {
        Problem problem = curve_problem({0, 1}, std::vector<double>(order, 0x1.000001p0), plain(u));
        // Control points c + tiny C(n, i)^-1 are not doubles. A second direction of order 2 avoids them.
        problem.order = {order, 2};
        std::vector<double> points;
        for (int i = 0; i < order; ++i) {
          points.push_back(2 * 0x1.000001p0);
          points.push_back(i == order - 1 ? tiny : 0);
        }
        problem.points = points;
        problem.domain[1] = {0, 1};
        problem.at[1] = plain(0.5);
        expect_rounded(problem, tiny > 0 ? 0x1.000002p0f : 1.0f);
      }
    }
  }
}

TEST_F(RoundExactly, TiesOfLinesAtThirds) {
  // A line of order 4, R_i = r + 3 i d, at t = k / 3 is r + 3 k d; domain and argument are not dyadic.
  for (int i = 0; i < 200 && !HasFailure(); ++i) {
    const int start = integer_below(1 << 24), slope = integer_below(1 << 20) - (1 << 19),
              k = 1 + integer_below(2);
    std::vector<double> points;
    for (int j = 0; j < 4; ++j) points.push_back((start + 3.0 * j * slope) / 2 + 0x1p24);
    const Problem problem = curve_problem({0.1, 0.7}, points, {{0.1, 0.7, 3}, k});
    expect_rounded(problem, static_cast<float>((start + 3.0 * k * slope) / 2 + 0x1p24));
    expect_nearest(problem);
    const Problem outside = curve_problem({0, 0.3}, points, {{0, 0.3, 3}, -k});
    expect_rounded(outside, static_cast<float>((start - 3.0 * k * slope) / 2 + 0x1p24));
  }
}

// ---- The ends of the range

TEST_F(RoundExactly, Overflow) {
  const double threshold = 0x1p128 - 0x1p103, below = std::nextafter(threshold, 0),
               above = std::nextafter(threshold, kHuge);
  const float largest = std::numeric_limits<float>::max(), infinity = std::numeric_limits<float>::infinity();
  for (int order : {1, 2, 3, 10, 64}) {
    for (const GridArgument& at :
         {plain(0), plain(1), plain(0.25), plain(0.1), plain(-0x1p-20), GridArgument{{0, 1, 3}, 1}}) {
      for (double sign : {1.0, -1.0}) {
        const auto s = static_cast<float>(sign);
        expect_rounded(curve_problem({0, 1}, std::vector<double>(order, sign * below), at), s * largest);
        expect_rounded(curve_problem({0, 1}, std::vector<double>(order, sign * threshold), at), s * infinity);
        expect_rounded(curve_problem({0, 1}, std::vector<double>(order, sign * above), at), s * infinity);
        expect_rounded(curve_problem({0, 1}, std::vector<double>(order, sign * kHuge), at), s * infinity);
      }
    }
  }
  // The value is below the threshold by one unit of 2^-1074.
  expect_rounded({{2, 2}, {}, {2 * threshold, -kTiny, 2 * threshold, 0}, {plain(0.3), plain(0.5)}}, largest);
  expect_rounded({{2, 2}, {}, {2 * threshold, kTiny, 2 * threshold, 0}, {plain(0.3), plain(0.5)}}, infinity);
  expect_rounded(curve_problem({0, 1}, std::vector<double>{0, kHuge}, plain(kHuge)), infinity);
  expect_rounded(curve_problem({0, 1}, std::vector<double>{0, kTiny}, plain(-kHuge)), -0x1p-50f);
}

TEST_F(RoundExactly, UnderflowAndZero) {
  const float least = 0x1p-149f;
  for (int order : {1, 2, 3, 10, 64}) {
    for (const GridArgument& at :
         {plain(0), plain(1), plain(0.25), plain(0.1), plain(-0x1p-20), GridArgument{{0, 1, 3}, 1}}) {
      for (double sign : {1.0, -1.0}) {
        const auto s = static_cast<float>(sign);
        const auto expect = [&](double constant, float expected) {
          expect_rounded(curve_problem({0, 1}, std::vector<double>(order, sign * constant), at),
                         s * expected);
        };
        expect(0x1p-150, 0);
        expect(std::nextafter(0x1p-150, 1), least);
        expect(std::nextafter(0x1p-150, 0), 0);
        expect(0x1.8p-149, 2 * least);
        expect(std::nextafter(0x1.8p-149, 0), least);
        expect(kTiny, 0);
        expect(0x1.fffffcp-127, 0x1.fffffcp-127f);
        expect(0x1.fffffep-127, 0x1p-126f);
        expect(std::nextafter(0x1.fffffep-127, 0), 0x1.fffffcp-127f);
      }
      expect_rounded(curve_problem({0, 1}, std::vector<double>(order, -0.0), at), 0);
      expect_rounded(curve_problem({0, 1}, std::vector<double>(order, 0.0), at), 0);
    }
  }
  // The value is far below any double: 2^-1074 * 2^(-1074 * 63).
  std::vector<double> points(64);
  for (double sign : {1.0, -1.0}) {
    points.back() = sign * kTiny;
    expect_rounded(curve_problem({0, 1}, points, plain(kTiny)), static_cast<float>(0.0 * sign));
    expect_rounded(curve_problem({0, 1}, points, plain(-kTiny)), static_cast<float>(-0.0 * sign));
  }
  // Exact zeros of a polynomial that is not zero.
  expect_rounded(curve_problem({0, 1}, {1, -1}, plain(0.5)), 0);
  expect_rounded(curve_problem({0, 1}, {-1, 1}, plain(0.5)), 0);
  expect_rounded(curve_problem({0, 1}, {-2, 1}, {{0, 1, 3}, 2}), 0);
  expect_rounded(curve_problem({-0.0, 1}, {-0.0, 1}, plain(0)), 0);
  expect_rounded(curve_problem({0, 1}, {-0.0, 1}, plain(-0.0)), 0);
  expect_rounded(curve_problem({1, -0.0}, {5, -0.0}, plain(0)), 0);
  expect_rounded({{2, 2}, {}, {1, -1, -1, 1}, {plain(0.25), plain(0.5)}}, 0);
}

TEST_F(RoundExactly, WhatIsNotLookedAtHasNoInfluence) {
  // At an end of the domain, only the control point there is used; in a direction of order 1, neither domain
  // nor argument.
  expect_rounded({{3, 1}, {Domain{2, 5}, Domain{1, 1}}, {0x1p100, kTiny, -kHuge}, {plain(2), plain(kNaN)}},
                 0x1p100f);
  expect_rounded(
      {{3, 1}, {Domain{2, 5}, Domain{1, 1}}, {kHuge, kTiny, 3}, {GridArgument{{7, 5, 2}, 2}, plain(kNaN)}},
      3);
  expect_rounded({{1, 1}, {Domain{1, 1}, Domain{1, 1}}, {-7}, {plain(kNaN), plain(kNaN)}}, -7);
}

}  // namespace
}  // namespace glev_tests
