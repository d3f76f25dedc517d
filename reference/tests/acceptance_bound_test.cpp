// Compares the bounds of the accuracy rule (acceptance.h) with a second implementation, and tests the inputs
// to which the rule applies.
#include <gtest/gtest.h>
#include <reference/acceptance.h>

#include <algorithm>
#include <limits>

#include "random_data.h"
#include "second_bound.h"

namespace evalcts::reference {
namespace {

Fraction second_bound_of(const std::vector<double>& points, const SecondDirection& u,
                         const SecondDirection& v, int k) {
  std::vector<Fraction> magnitudes;
  for (const double point : points) magnitudes.push_back(abs(fraction(point)));
  const bool fit = u.fits() && v.fits() && std::all_of(points.begin(), points.end(), fits_single);
  return second_bound(magnitudes, u, v, k, fit);
}

SecondDirection random_direction(std::mt19937_64& generator, int n) {
  const auto number = [&] {
    const double x = uniform(generator, -3, 3);
    return pick(generator, 0, 3) == 0 ? x : static_cast<float>(x);  // sometimes beyond single precision
  };
  const double a = number(), b = number();
  if (pick(generator, 0, 1)) return {n, a, b, Argument::coordinate(number())};
  return {n, a, b, Argument::grid(pick(generator, -2, 8), pick(generator, 1, 6), number(), number())};
}

std::vector<double> random_points(std::mt19937_64& generator, int count) {
  const Data kinds[] = {Data::kFloats,   Data::kFloats, Data::kDoubles,
                        Data::kIntegers, Data::kSparse, Data::kWide};
  return control_values(generator, kinds[pick(generator, 0, 5)], count);
}

TEST(AcceptanceBound, IsThatOfTheRequirements) {
  std::mt19937_64 generator = make_generator();
  for (int repetition = 0; repetition < 210; ++repetition) {
    const bool is_curve = repetition < 150;
    const int n = pick(generator, 0, is_curve ? 8 : 4), m = is_curve ? 0 : pick(generator, 0, 4);
    const std::vector<double> points = random_points(generator, (n + 1) * (m + 1));
    const SecondDirection u = random_direction(generator, n),
                          v = is_curve ? SecondDirection{0, 0, 1, {}} : random_direction(generator, m);
    const Surface surface{points.data(), {m + 1, n + 1, u.u1, u.u2}, {1, m + 1, v.u1, v.u2}};
    ASSERT_EQ(fraction(acceptance_bound(surface, u.argument, v.argument)),
              second_bound_of(points, u, v, n * m + 5 * (n + m) + 4));
  }
}

TEST(AcceptanceBound, OfOrderOneInNumbers) {
  const double r = 3;
  // K = 4; W = |R|; U = 4 * 2^-126 * 3.
  const Rational x = 4 * epsilon();
  EXPECT_EQ(acceptance_bound(Surface{&r, {1, 1, 0, 1}}, Argument::coordinate(0.5)),
            (x + x * x) * 3 + 12 * Rational::power_of_two(-126));
  EXPECT_GT(epsilon(), Rational(1) / 100000);
  EXPECT_LT(epsilon(), Rational(1.0001) / 100000);
}

TEST(AcceptanceBound, IsNeverUnderItsLowerEstimate) {
  std::mt19937_64 generator = make_generator();
  for (int repetition = 0; repetition < 300; ++repetition) {
    const int order = pick(generator, 1, 30);
    const std::vector<double> points = random_points(generator, order);
    const SecondDirection u = random_direction(generator, order - 1);
    const Surface curve{points.data(), {1, order, u.u1, u.u2}};
    const Rational estimate =
        acceptance_bound_below(order - 1, 0, evaluate_with_magnitude(curve, u.argument).magnitude);
    ASSERT_LE(estimate, acceptance_bound(curve, u.argument));
    ASSERT_EQ(estimate,
              (5 * (order - 1) + 4) * epsilon() * evaluate_with_magnitude(curve, u.argument).magnitude);
  }
  EXPECT_EQ(acceptance_bound_below(2, 3, 1), (6 + 25 + 4) * epsilon());
}

TEST(Acceptance, EndsAtTheBound) {
  const Rational exact(1.5), bound = Rational(1) / 3, tiny = Rational::power_of_two(-200);
  EXPECT_TRUE(is_within(1.5f, exact, 0));
  EXPECT_TRUE(is_within(1.0f, 1 + bound, bound));
  EXPECT_FALSE(is_within(1.0f, 1 + bound + tiny, bound));
  EXPECT_TRUE(is_within(1.0f, 1 - bound, bound));
  EXPECT_FALSE(is_within(1.0f, 1 - bound - tiny, bound));
  EXPECT_TRUE(is_within(-0.0f, 0, 0));
  EXPECT_FALSE(is_within(std::numeric_limits<float>::infinity(), Rational::power_of_two(128),
                         Rational::power_of_two(2000)));
  EXPECT_FALSE(is_within(std::numeric_limits<float>::quiet_NaN(), 0, 1));
}

TEST(Acceptance, HoldsEverythingAboutAValue) {
  const std::vector<double> points{1, -2, 4};
  const Surface curve{points.data(), {1, 3, 0, 2}};
  const Argument u = Argument::coordinate(0.5);
  const Acceptance acceptance = reference::acceptance(curve, u);
  EXPECT_EQ(acceptance.exact, evaluate(curve, u));
  EXPECT_EQ(acceptance.magnitude, evaluate_with_magnitude(curve, u).magnitude);
  EXPECT_EQ(acceptance.bound, acceptance_bound(curve, u));
  EXPECT_EQ(acceptance.quality_bound,
            Rational::power_of_two(-24) * 8 * evaluate_with_magnitude(curve, u).magnitude);
  EXPECT_TRUE(acceptance.must_applies);
}

// Returns must_applies() for a line over [u1, u2] with control values `first` and `last`. acceptance(), which
// decides all conditions in exact arithmetic, must agree.
bool must_of_line(double u1, double u2, const Argument& u, double first = 1, double last = 1,
                  int range = kFullRange) {
  const double points[] = {first, last};
  const Surface curve{points, {1, 2, u1, u2}};
  const bool of_curve = must_applies(curve, u, {}, range);
  EXPECT_EQ(reference::acceptance(curve, u, {}, range).must_applies, of_curve)
      << u1 << ' ' << u2 << ' ' << u.first() << ' ' << u.last() << ' ' << first;
  // A surface that is the same line along v must give the same result.
  const Surface surface{points, {1, 1, 0, 1}, {1, 2, u1, u2}};
  EXPECT_EQ(must_applies(surface, Argument::coordinate(0), u, range), of_curve);
  return of_curve;
}

TEST(MustApplies, ToOrdinaryDomains) {
  const Argument zero = Argument::coordinate(0);
  EXPECT_TRUE(must_of_line(0, 1, zero));
  EXPECT_TRUE(must_of_line(5, -2, zero));
  EXPECT_TRUE(must_of_line(0, 0x1p60, zero));
  EXPECT_FALSE(must_of_line(0, 0x1.000002p60, zero));
  EXPECT_TRUE(must_of_line(0, 0x1p-60, zero));
  EXPECT_FALSE(must_of_line(0, 0x1.fffffep-61, zero));
  EXPECT_FALSE(must_of_line(0x1p-127, 1, zero));
  EXPECT_FALSE(must_of_line(1, -0x1p-1074, zero));
  EXPECT_TRUE(must_of_line(0x1p-126, 1, zero));
  EXPECT_TRUE(must_of_line(-0.0, 1, zero));
}

TEST(MustApplies, UpToTheRangeThatTheGlPromises) {
  const Argument zero = Argument::coordinate(0);
  EXPECT_TRUE(must_of_line(0, 1, zero, 0x1p32, 0));
  EXPECT_FALSE(must_of_line(0, 1, zero, 0, -0x1.000002p32));
  EXPECT_TRUE(must_of_line(0, 1, zero, -0x1p10, 0, kReducedRange));
  EXPECT_FALSE(must_of_line(0, 1, zero, 0x1.000002p10, 0, kReducedRange));
  // Outside the domain, |t| + |s| = 2|u| - 1.
  EXPECT_TRUE(must_of_line(0, 1, Argument::coordinate(0x1p15), 0x1p16, 0));
  EXPECT_FALSE(must_of_line(0, 1, Argument::coordinate(0x1.002p15), 0x1p16, 0));
  // The weights are intermediate results, too (U-OVERFLOW).
  EXPECT_FALSE(must_of_line(0, 1, Argument::coordinate(0x1p33), 0x1p-30, 0));
  EXPECT_FALSE(must_of_line(0, 1, Argument::coordinate(0x1p33), 0, 0));
  // The limit is raised to the power of the degree in both directions.
  const std::vector<double> points(9, 1.0);
  const auto square = [&](double u, double v) {
    const Surface surface{points.data(), {3, 3, 0, 1}, {1, 3, 0, 1}};
    return must_applies(surface, Argument::coordinate(u), Argument::coordinate(v));
  };
  EXPECT_TRUE(square(0x1p15, 0.5));
  EXPECT_FALSE(square(0x1.002p15, 1.5));
  EXPECT_TRUE(square(0x1p7, -0x1p7 + 1));
  EXPECT_FALSE(square(0x1p8, -0x1p8));
}

TEST(MustApplies, OnlyToInputsWithinSinglePrecision) {
  const double one[] = {1, 1};
  const auto constant = [&](const Argument& u) { return must_applies(Surface{one, {1, 1, 0, 1}}, u); };
  EXPECT_TRUE(constant(Argument::coordinate(0x1.fffffep127)));
  EXPECT_FALSE(constant(Argument::coordinate(0x1p128)));
  EXPECT_TRUE(constant(Argument::grid(1, 2, 0, 0x1p126)));
  EXPECT_FALSE(constant(Argument::grid(0, 1, 0, 0x1p128)));
  EXPECT_FALSE(constant(Argument::grid(0, 1, -0x1p127, 0x1p127)));
  EXPECT_FALSE(constant(Argument::grid(16, 2, 0, 0x1p126)));
  EXPECT_FALSE(constant(Argument::grid(-2, 1, 0, 0x1p127)));
  // The ends coincide in single precision (U-DOUBLE-CLOSE).
  EXPECT_FALSE(must_of_line(1, 1 + 0x1p-40, Argument::coordinate(1)));
  EXPECT_TRUE(must_of_line(1, 1 + 0x1p-23, Argument::coordinate(1)));
}

TEST(MustApplies, ByTheExactConditions) {
  const double values[] = {0, -0.0, 1, 1 + 0x1p-40, -2, 0x1p-60, 0x1p-127, 0x1p40, 0x1p61, -0x1p127};
  for (const double u1 : values)
    for (const double u2 : values) {
      if (u1 == u2) continue;
      for (const double a : values)
        for (const double control : {1.0, 0x1p32, 0x1.8p32}) {
          must_of_line(u1, u2, Argument::coordinate(a), control, -1);
          for (const std::int64_t i : {-1, 0, 2, 3, 4})
            must_of_line(u1, u2, Argument::grid(i, 3, a, u2), 1, control);
        }
    }
}

TEST(QuotientBound, CoversTheWorstQuotient) {
  EXPECT_FALSE(quotient_bound(1, 0, 2, 1));
  EXPECT_FALSE(quotient_bound(1, 0, -2, 1));
  EXPECT_FALSE(quotient_bound(1, 0, 0, 0));
  const Rational x(3), x_bound(0.5), w(-4), w_bound(1);
  // q = (0.5 + 0.75 * 1) / (4 - 1) = 5/12
  const Rational q = Rational(5) / 12;
  ASSERT_TRUE(quotient_bound(x, x_bound, w, w_bound));
  EXPECT_EQ(*quotient_bound(x, x_bound, w, w_bound), q + 4 * epsilon() * (Rational(3) / 4 + q));
  for (const int sx : {-1, 1}) {
    for (const int sw : {-1, 1}) {
      EXPECT_LE(abs((x + sx * x_bound) / (w + sw * w_bound) - x / w), q);
    }
  }
}

TEST(Acceptance, RefusesWhatHasNoValue) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(acceptance_bound(Surface{&nan, {1, 1, 0, 1}}, Argument::coordinate(0)), std::domain_error);
  const double one = 1;
  EXPECT_THROW(must_applies(Surface{&one, {1, 1, 2, 2}}, Argument::coordinate(0)), std::domain_error);
  EXPECT_THROW(acceptance(Surface{&one, {1, 1, 0, 1}}, Argument::coordinate(nan)), std::domain_error);
  EXPECT_THROW(must_applies(Surface{&nan, {1, 1, 0, 1}}, Argument::coordinate(0)), std::domain_error);
  EXPECT_THROW(must_applies(Surface{&one, {1, 1, 0, 1}}, Argument::coordinate(nan)), std::domain_error);
  EXPECT_THROW(must_applies(Surface{&one, {1, 1, 0, 1}}, Argument::grid(0, 1, 0, nan)), std::domain_error);
  EXPECT_THROW(must_applies(Surface{&one, {1, 0, 0, 1}}, Argument::coordinate(0)), std::invalid_argument);
  EXPECT_THROW(acceptance(Surface{&one, {1, 0, 0, 1}}, Argument::coordinate(0)), std::invalid_argument);
}

}  // namespace
}  // namespace evalcts::reference
