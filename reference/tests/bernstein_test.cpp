// Tests exact evaluation against a second method, and its rounding.
#include <gtest/gtest.h>
#include <reference/bernstein.h>
#include <reference/bernstein_form.h>
#include <reference/rounding.h>

#include <limits>
#include <stdexcept>

#include "random_data.h"
#include "second_route.h"

namespace evalcts::reference {
namespace {

struct Domain {
  double u1, u2;
};

// Domains: unit, narrow, shifted, reversed, huge, tiny, subnormal.
const std::vector<Domain> kDomains{{0, 1},
                                   {1, 0},
                                   {2, 5},
                                   {-3, -1},
                                   {1000, 1000 + 0x1p-20},
                                   {0.1f, 0.7f},
                                   {0.1, 0.7},
                                   {5, -2},
                                   {-0x1p60, 0x1p60},
                                   {0, 0x1p-149},
                                   {-0x1p-1074, 0x1p-1070},
                                   {1e300, -1e300},
                                   {-0.0, 3}};

// Returns an argument in the domain, at its ends, outside or far outside, as a coordinate or as a grid point.
Argument random_argument(std::mt19937_64& generator, const Domain& domain) {
  const double width = domain.u2 / 2 - domain.u1 / 2;
  const double inside = domain.u1 + 2 * width * uniform(generator, 0, 1);
  switch (pick(generator, 0, 7)) {
    case 0:
      return Argument::coordinate(domain.u1);
    case 1:
      return Argument::coordinate(domain.u2);
    case 2:
      return Argument::coordinate(inside);
    case 3:
      return Argument::coordinate(domain.u1 - 3 * (width / 4));
    case 4:
      return Argument::coordinate(pick(generator, -3, 3));
    case 5:
      return Argument::grid(pick(generator, -3, 12), pick(generator, 1, 9), domain.u1, domain.u2);
    case 6:
      return Argument::grid(pick(generator, 0, 7), 7, inside, inside / 3);
    default:
      return Argument::coordinate(std::abs(inside) < 1e30 ? static_cast<float>(inside) : inside / 3);
  }
}

Fraction argument_value(const Argument& u) {
  if (!u.is_grid()) return fraction(u.coordinate());
  return Fraction(u.index()) * (fraction(u.last()) - fraction(u.first())) / u.segments() +
         fraction(u.first());
}

Fraction normalised(const Argument& u, const Direction& direction) {
  return (argument_value(u) - fraction(direction.first)) /
         (fraction(direction.last) - fraction(direction.first));
}

template <typename Float>
bool same_bits(Float a, Float b) {
  return a == b && std::signbit(a) == std::signbit(b);
}

void expect_agrees(const Surface& surface, const Argument& u, const Argument& v = {}) {
  const Fraction t = normalised(u, surface.u), s = normalised(v, surface.v);
  std::vector<Fraction> rows, row_magnitudes, row_derivatives;
  for (int i = 0; i < surface.u.order; ++i) {
    std::vector<Fraction> row;
    for (int j = 0; j < surface.v.order; ++j)
      row.push_back(fraction(surface.points[i * surface.u.stride + j * surface.v.stride]));
    rows.push_back(de_casteljau(row, s));
    row_magnitudes.push_back(term_by_term(row, s, 1 - s));
    row_derivatives.push_back(de_casteljau_derivative(row, s));
  }
  const Evaluation evaluation = evaluate_with_magnitude(surface, u, v);
  ASSERT_EQ(fraction(u.value()), argument_value(u));
  ASSERT_EQ(fraction(evaluation.value), de_casteljau(rows, t));
  ASSERT_EQ(fraction(evaluation.magnitude), term_by_term(row_magnitudes, t, 1 - t));
  ASSERT_EQ(evaluate(surface, u, v), evaluation.value);
  const BernsteinForm form(surface);
  ASSERT_TRUE(same_bits(form.to_float(u, v), round_to_float(evaluation.value)));
  ASSERT_TRUE(same_bits(form.to_double(u, v), round_to_double(evaluation.value)));
  const Jet jet = reference::jet(surface, u, v);
  ASSERT_EQ(jet.value, evaluation.value);
  ASSERT_EQ(fraction(jet.u), de_casteljau_derivative(rows, t));
  ASSERT_EQ(fraction(jet.v), de_casteljau(row_derivatives, t));
}

TEST(Curve, AgreesWithDeCasteljauAtEveryOrder) {
  std::mt19937_64 generator = make_generator();
  for (int order = 1; order <= kMaxOrder; ++order) {
    const int repetitions = order <= 8 ? 40 : order <= 20 ? 8 : 1;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      const Data kind = static_cast<Data>(pick(generator, 0, static_cast<int>(Data::kSparse)));
      const std::vector<double> points = control_values(generator, kind, order);
      // High orders use only domains in which the slow method is fast enough.
      const Domain domain =
          kDomains[pick(generator, 0, order <= 20 ? static_cast<int>(kDomains.size()) - 1 : 3)];
      const Argument u = order <= 20 ? random_argument(generator, domain)
                                     : Argument::coordinate(std::ldexp(pick(generator, -600, 600), -8));
      SCOPED_TRACE(testing::Message() << "order " << order << " data " << static_cast<int>(kind) << " domain "
                                      << domain.u1 << " " << domain.u2 << " u " << u.value().to_double());
      expect_agrees({points.data(), {1, order, domain.u1, domain.u2}}, u);
    }
  }
}

TEST(Curve, AgreesWithDeCasteljauOnExtremeData) {
  std::mt19937_64 generator = make_generator();
  for (const Data kind : {Data::kWide, Data::kSubnormal, Data::kAnyFloat, Data::kAnyDouble}) {
    for (const Domain& domain : kDomains) {
      for (const int order : {1, 2, 3, 5, 8}) {
        const std::vector<double> points = control_values(generator, kind, order);
        SCOPED_TRACE(testing::Message() << "order " << order << " data " << static_cast<int>(kind)
                                        << " domain " << domain.u1 << " " << domain.u2);
        expect_agrees({points.data(), {1, order, domain.u1, domain.u2}}, random_argument(generator, domain));
      }
    }
  }
}

TEST(Curve, ReadsOnlyItsControlValues) {
  const double poison = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> points{1, poison, poison, 4, poison, poison, 9};
  expect_agrees({points.data(), {3, 3, 2, 5}}, Argument::coordinate(3));
  EXPECT_TRUE(is_finite(Surface{points.data(), {3, 3, 2, 5}}));
  EXPECT_FALSE(is_finite(Surface{points.data(), {1, 3, 2, 5}}));
}

TEST(Surface, AgreesWithDeCasteljau) {
  std::mt19937_64 generator = make_generator();
  for (int repetition = 0; repetition < 150; ++repetition) {
    const int uorder = pick(generator, 1, 6), vorder = pick(generator, 1, 6);
    const Data kind = static_cast<Data>(pick(generator, 0, static_cast<int>(Data::kAnyFloat)));
    const std::vector<double> points = control_values(generator, kind, uorder * vorder * 2);
    const Domain du = kDomains[pick(generator, 0, 7)], dv = kDomains[pick(generator, 0, 7)];
    const Argument u = random_argument(generator, du), v = random_argument(generator, dv);
    const bool u_major = pick(generator, 0, 1) == 1;
    expect_agrees({points.data(),
                   {u_major ? 2 * vorder : 2, uorder, du.u1, du.u2},
                   {u_major ? 2 : 2 * uorder, vorder, dv.u1, dv.u2}},
                  u, v);
    if (HasFatalFailure()) return;
  }
}

TEST(Surface, OfOrderOneIsACurve) {
  const std::vector<double> points{1, -4, 0.25, 7};
  const Argument u = Argument::coordinate(0.375), v = Argument::coordinate(-100);
  const Surface curve{points.data(), {1, 4, 0, 1}};
  const Surface along_u{points.data(), {1, 4, 0, 1}, {1, 1, 3, 4}},
      along_v{points.data(), {1, 1, 3, 4}, {1, 4, 0, 1}};
  EXPECT_EQ(evaluate(along_u, u, v), evaluate(curve, u));
  EXPECT_EQ(evaluate(along_v, v, u), evaluate(curve, u));
  EXPECT_TRUE(jet(along_u, u, v).v.is_zero());
  EXPECT_TRUE(jet(along_v, v, u).u.is_zero());
}

TEST(Surface, OfTheLargestOrdersPartitionsUnity) {
  const std::vector<double> points(kMaxOrder * kMaxOrder, 3.5);
  const Surface surface{points.data(), {kMaxOrder, kMaxOrder, 0, 1}, {1, kMaxOrder, 2, 0}};
  EXPECT_EQ(evaluate(surface, Argument::coordinate(0.3), Argument::coordinate(7)), Rational(3.5));
}

// The identity u -> u, as a line and elevated to higher degrees, is rounded as by the hardware, including
// ties.
TEST(BernsteinForm, RoundsAsTheHardwareDoes) {
  std::mt19937_64 generator = make_generator();
  for (int round = 0; round < 20000; ++round) {
    const int order = pick(generator, 2, 9);
    std::vector<double> points;
    for (int i = 0; i < order; ++i) points.push_back(i);
    const BernsteinForm form(Surface{points.data(), {1, order, 0, static_cast<double>(order - 1)}});
    // The midpoint between two floats, or a double next to it; sometimes subnormal or too large.
    double u = std::ldexp(static_cast<double>((generator() >> 40 << 1) | 1), pick(generator, -180, 110));
    if (pick(generator, 0, 1) == 0) u = std::nextafter(u, pick(generator, 0, 1) == 0 ? 0.0 : 1e300);
    if (pick(generator, 0, 1) == 0) u = -u;
    ASSERT_TRUE(same_bits(form.to_float(Argument::coordinate(u)), static_cast<float>(u))) << u;
    ASSERT_TRUE(same_bits(form.to_double(Argument::coordinate(u)), u)) << u;
  }
}

// 1 + 2^-24 lies midway between two floats, of which the lower one is even. A difference of 2^-90 decides the
// rounding.
TEST(BernsteinForm, SeesOnWhichSideOfATieTheValueLies) {
  const double tie = 1 + 0x1p-24;
  const Argument u = Argument::coordinate(0x1p-30);
  for (const double more : {-0x1p-30, 0.0, 0x1p-30}) {
    const double points[] = {tie, tie, tie + more};
    const BernsteinForm form(Surface{points, {1, 3, 0, 1}});
    EXPECT_EQ(form.to_float(u), more > 0 ? 1 + 0x1p-23f : 1.0f) << more;
    EXPECT_EQ(form.to_float(u), round_to_float(form.evaluate(u))) << more;
  }
}

TEST(GridArgument, IsExactWithAnyIndex) {
  const auto lowest = std::numeric_limits<std::int64_t>::min(),
             highest = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(Argument::grid(lowest, 1, 0, 1).value(), Rational(lowest));
  EXPECT_EQ(Argument::grid(highest, highest, 0.1, 0.7).value(), Rational(0.7));
  EXPECT_EQ(Argument::grid(5, 3, 5, 5).value(), Rational(5));
  const double points[] = {0, 1};
  EXPECT_EQ(evaluate(Surface{points, {1, 2, 0, 1}}, Argument::grid(lowest, 1, 0, 1)), Rational(lowest));
}

TEST(Bernstein, RefusesWhatHasNoValue) {
  const double infinity = std::numeric_limits<double>::infinity(),
               nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> points(65, 1.0);
  const Argument zero = Argument::coordinate(0);
  EXPECT_THROW(evaluate(Surface{points.data(), {1, 0, 0, 1}}, zero), std::invalid_argument);
  EXPECT_THROW(evaluate(Surface{points.data(), {1, 65, 0, 1}}, zero), std::invalid_argument);
  EXPECT_THROW(evaluate(Surface{points.data(), {1, 2, 0, 1}, {1, 0, 0, 1}}, zero, zero),
               std::invalid_argument);
  EXPECT_THROW(evaluate(Surface{points.data(), {1, 2, 1, 1}}, zero), std::domain_error);
  EXPECT_THROW(evaluate(Surface{points.data(), {1, 1, 1, 1}}, zero), std::domain_error);
  EXPECT_THROW(evaluate(Surface{points.data(), {1, 2, 0, infinity}}, zero), std::domain_error);
  EXPECT_THROW(evaluate(Surface{points.data(), {1, 2, 0, 1}}, Argument::coordinate(nan)), std::domain_error);
  EXPECT_THROW(evaluate(Surface{&nan, {1, 1, 0, 1}}, zero), std::domain_error);
  EXPECT_THROW(jet(Surface{&nan, {1, 1, 0, 1}}, zero), std::domain_error);
  EXPECT_THROW(Argument::grid(0, 0, 0, 1), std::invalid_argument);
  EXPECT_THROW(Argument::grid(0, -1, 0, 1), std::invalid_argument);
  EXPECT_FALSE(Argument::grid(0, 1, 0, infinity).is_finite());
  EXPECT_FALSE(Argument::coordinate(nan).is_finite());
  EXPECT_THROW(Argument::coordinate(infinity).value(), std::domain_error);
  EXPECT_FALSE(is_finite(Surface{points.data(), {1, 2, nan, 1}}));
  EXPECT_FALSE(is_finite(Surface{points.data(), {1, 2, 0, 1}, {1, 2, 0, infinity}}));
  EXPECT_TRUE(is_finite(Surface{points.data(), {1, 2, 0, 1}, {1, 2, 0, 1}}));
}

}  // namespace
}  // namespace evalcts::reference
