// Correct rounding against exact integers, in every rounding mode.
#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "fixture.h"
#include "nearest.h"
#include "src/exact.h"

namespace glev_tests {
namespace {

using glev::Domain, glev::GridArgument;

constexpr double kTiny = 0x1p-1074, kHuge = std::numeric_limits<double>::max();

GridArgument Plain(double u) { return {{u, u, 1}, 0}; }

struct Problem {
  std::array<int, 2> order = {1, 1};
  std::array<Domain, 2> domain;
  std::vector<double> points;  // v fastest
  std::array<GridArgument, 2> at = {Plain(0), Plain(0)};
};

Problem Curve(const Domain& domain, std::vector<double> points, const GridArgument& u) {
  return {{static_cast<int>(points.size()), 1}, {domain, Domain{}}, std::move(points), {u, Plain(0)}};
}

std::string Show(const Problem& problem) {
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

// What a caller may have done to the processor.
constexpr int kModes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO, -1};

float RoundIn(int mode, const glev::Component& component, const std::array<GridArgument, 2>& at) {
#if defined(__SSE2__)
  const unsigned control = _mm_getcsr();
  if (mode < 0) _mm_setcsr(control | 0x8040);  // subnormal numbers taken for zero, flushed to zero
#endif
  if (mode >= 0) std::fesetround(mode);
  const float result = glev::RoundExactly(component, at[0], at[1]);
  std::fesetround(FE_TONEAREST);
#if defined(__SSE2__)
  _mm_setcsr(control);
#endif
  return result;
}

std::uint32_t Bits(float x) { return std::bit_cast<std::uint32_t>(x); }

// The result is `expected` in the first `modes` modes, whatever the stride.
void ExpectRounded(const Problem& problem, float expected, int modes = std::size(kModes)) {
  constexpr int kStride = 3;
  std::vector<double> spread(problem.points.size() * kStride, kNaN);
  for (std::size_t i = 0; i < problem.points.size(); ++i) spread[i * kStride] = problem.points[i];
  for (int i = 0; i < modes; ++i) {
    const bool dense = i % 2 == 0;
    const glev::Component component = {dense ? problem.points.data() : spread.data(), dense ? 1 : kStride,
                                       problem.order, problem.domain};
    const float got = RoundIn(kModes[i], component, problem.at);
    EXPECT_EQ(Bits(got), Bits(expected))
        << got << " for " << expected << ", mode " << kModes[i] << ": " << Show(problem);
  }
}

void ExpectNearest(const Problem& problem, int modes = std::size(kModes)) {
  const auto t = [&](int k) {
    return problem.order[k] == 1 ? Rational(0) : ExactT(problem.domain[k], problem.at[k]);
  };
  ExpectRounded(problem, Nearest(ExactValue(problem.points, problem.order, t(0), t(1))), modes);
}

// ---- The oracle

TEST(Nearest, IsWhatTheProcessorRoundsTo) {
  std::mt19937_64 random{kSeed};
  const auto check = [](double x) {
    const Rational exact = Exactly(x);
    EXPECT_EQ(Bits(Nearest({numerator(exact), denominator(exact)})), Bits(static_cast<float>(x))) << x;
  };
  for (int i = 0; i < 2000; ++i) {
    const double significand = 1 + static_cast<double>(random() >> 12) * 0x1p-52;
    check(std::ldexp(i % 2 == 0 ? significand : -significand, static_cast<int>(random() % 300) - 160));
    // a tie, and next to it
    const double tie =
        std::ldexp(static_cast<double>(random() % 0x1000000 * 2 + 1), static_cast<int>(random() % 260) - 160);
    for (double x : {tie, std::nextafter(tie, 0), std::nextafter(tie, kHuge)}) check(x);
  }
  for (double x :
       {0x1p128 - 0x1p103, std::nextafter(0x1p128 - 0x1p103, 0), 0x1p-150, -0x1p-150, 0x1.8p-149, 0.0})
    check(x);
  EXPECT_EQ(Nearest({1, 3}), 1.0f / 3.0f);
}

TEST(Nearest, TheFractionIsThePolynomial) {
  const std::vector<double> points = {1, -2, 4, 8};
  const Fraction value = ExactValue(points, {4, 1}, Rational(1, 4), 0);
  EXPECT_EQ(Rational(value.numerator, value.denominator), Bezier(2, 6, points, 3).value);
  EXPECT_EQ(ExactT({2, 6}, {{1, 5, 4}, 2}), Rational(1, 4));
  // (1 - u)(1 - v) 1 + (1 - u) v 2 + u (1 - v) 3 + u v 5 at 1/3, 1/4
  const Fraction surface = ExactValue({1, 2, 3, kTiny}, {2, 2}, Rational(1, 3), Rational(1, 4));
  EXPECT_EQ(Rational(surface.numerator, surface.denominator), Rational(6 + 4 + 9, 12) + Exactly(kTiny) / 12);
}

// ---- Random problems

class RoundExactly : public ::testing::Test {
 protected:
  int Below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  double Unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  double Signed() { return 2 * Unit() - 1; }
  template <class... Reals>
  double OneOf(Reals... reals) {
    const double all[] = {static_cast<double>(reals)...};
    return all[Below(sizeof...(reals))];
  }
  double AnyDouble() {
    while (true) {
      const auto x = std::bit_cast<double>(random_());
      if (std::isfinite(x)) return x;
    }
  }
  float AnyFloat() {
    while (true) {
      const auto x = std::bit_cast<float>(static_cast<std::uint32_t>(random_()));
      if (std::isfinite(x)) return x;
    }
  }

  std::vector<double> Points(int count, int kind) {
    std::vector<double> points(count);
    for (double& point : points) {
      switch (kind) {
        case 0:
          point = static_cast<float>(Signed());
          break;
        case 1:
          point = Below(21) - 10;
          break;
        case 2:
          point = Signed();
          break;
        case 3:
          point = AnyFloat();
          break;
        case 4:
          point = Below(3) == 0 ? 0 : std::ldexp(1 + Unit(), -149 + Below(10));
          break;
        case 5:
          point = std::ldexp(Signed(), 128);
          break;
        default:
          point = AnyDouble();
      }
    }
    return points;
  }
  static constexpr int kPointKinds = 7;

  Domain AnyDomain(int kind) {
    switch (kind) {
      case 0:
        return {0, 1};
      case 1:
        return {1, 0};
      case 2:
        return {static_cast<float>(Signed()), 1 + static_cast<float>(Unit())};
      case 3:
        return {5 + Unit(), -2 * Unit()};
      case 4:
        return {0, 3};
      case 5:
        return {0.1, std::nextafter(0.1, OneOf(0, 1))};
      case 6:
        return {OneOf(0, kTiny), 0x1p-1070};
      case 7:
        return {-kHuge, kHuge};
      default:
        return {AnyDouble(), AnyDouble()};
    }
  }
  static constexpr int kDomainKinds = 9;

  GridArgument AnyArgument(const Domain& domain) {
    const auto& [u1, u2] = domain;
    const auto index = [&](glev_int n) {
      return static_cast<std::int64_t>(
          OneOf(0, n, Unit() * n, Unit() * n, -Unit() * 0x1p32, Unit() * 0x1p32));
    };
    const auto segments =
        static_cast<glev_int>(OneOf(1, 2, 3, 7, 10, 300, 1024, 1 + Below(1000), 0x7FFFFFFF));
    switch (Below(10)) {
      case 0:
        return Plain(OneOf(u1, u2, std::nextafter(u1, u2), std::nextafter(u2, u1)));
      case 1:
        return Plain(u1 / 2 + u2 / 2);
      case 2:
        return Plain(OneOf(0, -1, 0.5, 1024, kTiny, kHuge, -1e308, 0x1p-40));
      case 3:
        return Plain(AnyFloat());
      case 4:
        return {{u1, u2, segments}, index(segments)};
      case 5:
        return {{u2, u1, segments}, index(segments)};
      case 6:
        return {{OneOf(u1, 0, 0.25), OneOf(u2, 0, 1, 2.5), segments}, index(segments)};
      case 7:
        return {{AnyDouble(), AnyFloat(), segments}, index(segments)};
      default: {
        const double t =
            OneOf(Unit(), Unit(), static_cast<float>(Unit()), 2 * Signed(), Below(1025) / 1024.0);
        return Plain(std::clamp((1 - t) * u1 + t * u2, -kHuge, kHuge));
      }
    }
  }

  Problem Any(std::array<int, 2> order, int domains) {
    Problem problem = {order, {}, Points(order[0] * order[1], Below(kPointKinds)), {}};
    for (int k : {0, 1}) {
      do {
        problem.domain[k] = AnyDomain(Below(domains));
      } while (problem.domain[k].u1 == problem.domain[k].u2);
      problem.at[k] = AnyArgument(problem.domain[k]);
    }
    return problem;
  }

  std::mt19937_64 random_{kSeed};
};

TEST_F(RoundExactly, CurvesOfAllKinds) {
  for (int i = 0; i < 15000 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
    ExpectNearest(Any({1 + Below(8), 1}, kDomainKinds));
  }
}

TEST_F(RoundExactly, CurvesOfEveryOrder) {
  for (int i = 0; i < 4 * kMax && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
    ExpectNearest(Any({1 + i % kMax, 1}, 6));
  }
  for (int i = 0; i < 30 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "wide case " << i << ", seed " << kSeed);
    ExpectNearest(Any({30 + Below(35), 1}, kDomainKinds), 2);
  }
}

TEST_F(RoundExactly, ASurfaceOfOneRowOrColumnIsACurve) {
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    const Problem across = Any({1, 1 + Below(12)}, kDomainKinds);
    ExpectNearest(across);
    const Problem along = {
        {across.order[1], 1}, {across.domain[1], {}}, across.points, {across.at[1], across.at[0]}};
    ExpectNearest(along);
  }
}

TEST_F(RoundExactly, SurfacesOfAllKinds) {
  for (int i = 0; i < 4000 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
    ExpectNearest(Any({1 + Below(5), 1 + Below(5)}, kDomainKinds));
  }
  for (int i = 0; i < 150 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "larger case " << i << ", seed " << kSeed);
    ExpectNearest(Any({1 + Below(16), 1 + Below(16)}, 6));
  }
}

TEST_F(RoundExactly, TheLargestSurfaces) {
  for (int kind : {0, 3}) {
    Problem problem = {{kMax, kMax},
                       {Domain{0, 1}, Domain{0.1, 0.7}},
                       Points(kMax * kMax, kind),
                       {Plain(0x1.234566p-3), Plain(0.6)}};
    ExpectNearest(problem, 2);
  }
}

TEST_F(RoundExactly, TheWidestOfAll) {
  // Units of 2^-1074 in domains and arguments of 2^1024, 2^31 segments and 2^32 indices; control points
  // likewise.
  Problem problem = {{kMax, kMax}, {}, {}, {}};
  for (int i = 0; i < kMax * kMax; ++i)
    problem.points.push_back(i % 5 == 0 ? kTiny : i % 3 == 0 ? kHuge : -kHuge);
  problem.domain = {Domain{-kHuge, kTiny}, Domain{kHuge, -1.1}};
  problem.at = {GridArgument{{kHuge, -kHuge / 3, 0x7FFFFFFF}, -0x1FFFFFFFFLL},
                Plain(-0x1.123456789abcdp-1022)};
  const glev::Component component = {problem.points.data(), 1, problem.order, problem.domain};
  EXPECT_TRUE(std::isinf(glev::RoundExactly(component, problem.at[0], problem.at[1])));
  // A result that is a number: the 63rd power of t = 1/2 - 2^-1075 / huge.
  problem.domain = {Domain{-kHuge, kHuge}, Domain{-kHuge, kHuge}};
  problem.at = {Plain(-kTiny), Plain(kTiny)};
  for (int i = 0; i < kMax * kMax; ++i) problem.points[i] = i == 0 ? 0x1p126 : i % 2 == 0 ? kTiny : -kTiny;
  ExpectRounded(problem, 1, 1);
  problem.points[1] = problem.points[kMax] = 0;
  problem.points[kMax * kMax - 1] = 0x1p102;  // half of the last bit of 1
  ExpectNearest(problem, 1);
}

// ---- Ties

TEST_F(RoundExactly, TiesAndTheirNeighbours) {
  for (int i = 0; i < 2000 && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
    const int order = 1 + Below(12);
    const double odd = 2.0 * (0x800000 + Below(0x800000)) + 1;
    const double tie = std::ldexp(Below(2) == 0 ? odd : -odd, Below(254) - 150);
    Domain domain = AnyDomain(Below(5));
    const double t = OneOf(0.5, 0.25, Unit(), 0x1p-40, 1 - 0x1p-40);
    Problem problem =
        Curve(domain, std::vector<double>(order, tie), Plain((1 - t) * domain.u1 + t * domain.u2));
    if (Below(3) == 0) problem.at[0] = {{domain.u1, domain.u2, 3 + Below(30)}, 1 + Below(2)};
    const auto magnitude = static_cast<std::int64_t>(std::fabs(odd));
    const float even = static_cast<float>(tie);
    ASSERT_EQ(std::fabs(static_cast<double>(even)) > std::fabs(tie), magnitude / 2 % 2 == 1);
    ExpectRounded(problem, even);
    // The least that a control point can change.
    for (double towards : {kHuge, -kHuge}) {
      for (int changed : {0, order / 2, order - 1}) {
        Problem neighbour = problem;
        neighbour.points[changed] = std::nextafter(tie, towards);
        ExpectNearest(neighbour);
      }
    }
  }
}

TEST_F(RoundExactly, TiesThatALeastBitFarBelowBreaks) {
  // All terms but one sum up to the tie exactly, that one is 2^-1074 times a power of t.
  for (int order : {3, 4, 9, 30, 64}) {
    for (double u : {0.5, 1.0 / 3, 0x1p-24, 0x1p-1074, 0.9}) {
      for (double tiny : {kTiny, -kTiny, 0.0}) {
        Problem problem = Curve({0, 1}, std::vector<double>(order, 0x1.000001p0), Plain(u));
        // points c + tiny C(n, i)^-1 would need more than a double; a curve of its own direction does not
        problem.order = {order, 2};
        std::vector<double> points;
        for (int i = 0; i < order; ++i) {
          points.push_back(2 * 0x1.000001p0);
          points.push_back(i == order - 1 ? tiny : 0);
        }
        problem.points = points;
        problem.domain[1] = {0, 1};
        problem.at[1] = Plain(0.5);
        ExpectRounded(problem, tiny > 0 ? 0x1.000002p0f : 1.0f);
      }
    }
  }
}

TEST_F(RoundExactly, TiesOfLinesAtThirds) {
  // A line of order 4, R_i = r + 3 i d, at t = k / 3 is r + 3 k d; domain and argument are no dyadic numbers.
  for (int i = 0; i < 200 && !HasFailure(); ++i) {
    const int start = Below(1 << 24), slope = Below(1 << 20) - (1 << 19), k = 1 + Below(2);
    std::vector<double> points;
    for (int j = 0; j < 4; ++j) points.push_back((start + 3.0 * j * slope) / 2 + 0x1p24);
    const Problem problem = Curve({0.1, 0.7}, points, {{0.1, 0.7, 3}, k});
    ExpectRounded(problem, static_cast<float>((start + 3.0 * k * slope) / 2 + 0x1p24));
    ExpectNearest(problem);
    const Problem outside = Curve({0, 0.3}, points, {{0, 0.3, 3}, -k});
    ExpectRounded(outside, static_cast<float>((start - 3.0 * k * slope) / 2 + 0x1p24));
  }
}

// ---- The ends of the range

TEST_F(RoundExactly, Overflow) {
  const double threshold = 0x1p128 - 0x1p103, below = std::nextafter(threshold, 0),
               above = std::nextafter(threshold, kHuge);
  const float largest = std::numeric_limits<float>::max(), infinity = std::numeric_limits<float>::infinity();
  for (int order : {1, 2, 3, 10, 64}) {
    for (const GridArgument& at :
         {Plain(0), Plain(1), Plain(0.25), Plain(0.1), Plain(-0x1p-20), GridArgument{{0, 1, 3}, 1}}) {
      for (double sign : {1.0, -1.0}) {
        const auto s = static_cast<float>(sign);
        ExpectRounded(Curve({0, 1}, std::vector<double>(order, sign * below), at), s * largest);
        ExpectRounded(Curve({0, 1}, std::vector<double>(order, sign * threshold), at), s * infinity);
        ExpectRounded(Curve({0, 1}, std::vector<double>(order, sign * above), at), s * infinity);
        ExpectRounded(Curve({0, 1}, std::vector<double>(order, sign * kHuge), at), s * infinity);
      }
    }
  }
  // Just below by one bit of 2^-1074.
  ExpectRounded({{2, 2}, {}, {2 * threshold, -kTiny, 2 * threshold, 0}, {Plain(0.3), Plain(0.5)}}, largest);
  ExpectRounded({{2, 2}, {}, {2 * threshold, kTiny, 2 * threshold, 0}, {Plain(0.3), Plain(0.5)}}, infinity);
  ExpectRounded(Curve({0, 1}, std::vector<double>{0, kHuge}, Plain(kHuge)), infinity);
  ExpectRounded(Curve({0, 1}, std::vector<double>{0, kTiny}, Plain(-kHuge)), -0x1p-50f);
}

TEST_F(RoundExactly, UnderflowAndZero) {
  const float least = 0x1p-149f;
  for (int order : {1, 2, 3, 10, 64}) {
    for (const GridArgument& at :
         {Plain(0), Plain(1), Plain(0.25), Plain(0.1), Plain(-0x1p-20), GridArgument{{0, 1, 3}, 1}}) {
      for (double sign : {1.0, -1.0}) {
        const auto s = static_cast<float>(sign);
        const auto expect = [&](double constant, float expected) {
          ExpectRounded(Curve({0, 1}, std::vector<double>(order, sign * constant), at), s * expected);
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
      ExpectRounded(Curve({0, 1}, std::vector<double>(order, -0.0), at), 0);
      ExpectRounded(Curve({0, 1}, std::vector<double>(order, 0.0), at), 0);
    }
  }
  // far below any double: 2^-1074 * 2^(-1074 * 63)
  std::vector<double> points(64);
  for (double sign : {1.0, -1.0}) {
    points.back() = sign * kTiny;
    ExpectRounded(Curve({0, 1}, points, Plain(kTiny)), static_cast<float>(0.0 * sign));
    ExpectRounded(Curve({0, 1}, points, Plain(-kTiny)), static_cast<float>(-0.0 * sign));
  }
  // zeros of a polynomial that is none
  ExpectRounded(Curve({0, 1}, {1, -1}, Plain(0.5)), 0);
  ExpectRounded(Curve({0, 1}, {-1, 1}, Plain(0.5)), 0);
  ExpectRounded(Curve({0, 1}, {-2, 1}, {{0, 1, 3}, 2}), 0);
  ExpectRounded(Curve({-0.0, 1}, {-0.0, 1}, Plain(0)), 0);
  ExpectRounded(Curve({0, 1}, {-0.0, 1}, Plain(-0.0)), 0);
  ExpectRounded(Curve({1, -0.0}, {5, -0.0}, Plain(0)), 0);
  ExpectRounded({{2, 2}, {}, {1, -1, -1, 1}, {Plain(0.25), Plain(0.5)}}, 0);
}

TEST_F(RoundExactly, WhatIsNotLookedAtHasNoInfluence) {
  // At an end only the point there; in a direction of order 1 neither domain nor argument.
  ExpectRounded({{3, 1}, {Domain{2, 5}, Domain{1, 1}}, {0x1p100, kTiny, -kHuge}, {Plain(2), Plain(kNaN)}},
                0x1p100f);
  ExpectRounded(
      {{3, 1}, {Domain{2, 5}, Domain{1, 1}}, {kHuge, kTiny, 3}, {GridArgument{{7, 5, 2}, 2}, Plain(kNaN)}},
      3);
  ExpectRounded({{1, 1}, {Domain{1, 1}, Domain{1, 1}}, {-7}, {Plain(kNaN), Plain(kNaN)}}, -7);
}

}  // namespace
}  // namespace glev_tests
