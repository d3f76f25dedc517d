// Tests unit vectors (enclosures, correct rounding, comparison) against a hundred decimal digits, and in
// cases that a hundred digits cannot decide.
#include <gtest/gtest.h>
#include <reference/normal.h>
#include <reference/rounding.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <limits>
#include <stdexcept>

#include "random_data.h"
#include "second_route.h"

namespace evalcts::reference {
namespace {

using Decimal = boost::multiprecision::cpp_bin_float_100;
using Floats = std::array<float, 3>;

Decimal decimal(const Rational& x) {
  const Fraction f = fraction(x);
  return Decimal(numerator(f)) / Decimal(denominator(f));
}

Decimal decimal_length(const Vector& m) {
  Decimal sum = 0;
  for (const Rational& x : m) sum += decimal(x) * decimal(x);
  return sqrt(sum);
}

Vector random_vector(std::mt19937_64& generator) {
  const int kind = pick(generator, 0, 4);
  Vector m;
  for (Rational& x : m) {
    switch (kind) {
      case 0:
        x = Rational(uniform(generator, -1, 1));
        break;
      case 1:
        x = Rational(pick(generator, -5, 5));
        break;
      case 2:
        x = Rational(pick(generator, -1000, 1000)) / Rational(pick(generator, 1, 99));
        break;
      case 3:
        x = Rational(uniform(generator, -1, 1)) * Rational::power_of_two(pick(generator, -160, 0));
        break;
      default:
        x = Rational(uniform(generator, -1, 1)) * Rational::power_of_two(-3000 + pick(generator, 0, 20));
    }
  }
  if (is_degenerate(m)) m[pick(generator, 0, 2)] = 1;
  return m;
}

TEST(UnitVector, EnclosesTheComponents) {
  std::mt19937_64 generator = make_generator();
  for (int repetition = 0; repetition < 500; ++repetition) {
    const Vector m = random_vector(generator);
    const int bits = pick(generator, 0, 200);
    const std::array<Interval, 3> unit = unit_vector(m, bits);
    for (int c = 0; c < 3; ++c) {
      ASSERT_LE(unit[c].high - unit[c].low, Rational::power_of_two(-bits));
      const Decimal exact = decimal(m[c]) / decimal_length(m);
      const Decimal slack("1e-90");
      ASSERT_LE(decimal(unit[c].low), exact + slack);
      ASSERT_GE(decimal(unit[c].high), exact - slack);
    }
  }
}

TEST(UnitVector, IsExactWhereItCanBe) {
  const Rational scale = Rational(7) / 11;
  for (const Interval& x : unit_vector({scale, 0, 0}, 0)) EXPECT_EQ(x.low, x.high);
  EXPECT_EQ(unit_vector({0, -scale, 0}, 40)[1].low, -1);
  const std::array<Interval, 3> unit = unit_vector({3 * scale, 0, -4 * scale}, 60);
  EXPECT_LT(unit[0].low, Rational(3) / 5);
  EXPECT_GT(unit[0].high, Rational(3) / 5);
  EXPECT_LT(unit[2].low, Rational(-4) / 5);
  EXPECT_GT(unit[2].high, Rational(-4) / 5);
}

TEST(UnitVector, RefusesWhatHasNoDirection) {
  EXPECT_THROW(unit_vector({0, 0, 0}, 10), std::domain_error);
  EXPECT_THROW(unit_vector({1, 0, 0}, -1), std::invalid_argument);
  EXPECT_THROW(length({1, 0, 0}, -1), std::invalid_argument);
  EXPECT_THROW(rounded_unit_vector({0, 0, 0}), std::domain_error);
  EXPECT_THROW(is_within({0, 0, 1}, {0, 0, 0}, 1, true), std::domain_error);
  EXPECT_THROW(direction_is_within({0, 0, 1}, {0, 0, 0}, 1, true), std::domain_error);
}

TEST(Length, EnclosesTheLength) {
  std::mt19937_64 generator = make_generator();
  for (int repetition = 0; repetition < 500; ++repetition) {
    const Vector m = random_vector(generator);
    const int bits = pick(generator, 0, 200);
    const Interval length = reference::length(m, bits);
    const Rational square = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
    ASSERT_LE(length.low * length.low, square);
    ASSERT_GE(length.high * length.high, square);
    ASSERT_GT(length.low.sign(), 0);
    ASSERT_LE(length.high - length.low, Rational::power_of_two(-bits) * length.low);
  }
  EXPECT_EQ(length({0, 0, 0}, 10).high, 0);
  EXPECT_EQ(length({2, -3, 6}, 5).low, 7);
  EXPECT_EQ(length({2, -3, 6}, 5).high, 7);
}

TEST(RoundedUnitVector, IsTheNearest) {
  std::mt19937_64 generator = make_generator();
  int subnormal = 0;
  for (int repetition = 0; repetition < 2000; ++repetition) {
    const Vector m = random_vector(generator);
    const Floats floats = rounded_unit_vector(m);
    const std::array<double, 3> doubles = rounded_unit_vector_to_double(m);
    for (int c = 0; c < 3; ++c) {
      // A hundred digits are never close to a midpoint, except if the value is exact.
      const Decimal exact = decimal(m[c]) / decimal_length(m);
      ASSERT_EQ(floats[c], exact.convert_to<float>()) << exact;
      ASSERT_EQ(doubles[c], exact.convert_to<double>()) << exact;
      subnormal += floats[c] != 0 && std::fabs(floats[c]) < std::numeric_limits<float>::min();
      // A component that is rounded to zero keeps its sign, and zero is +0.
      ASSERT_EQ(std::signbit(floats[c]), m[c].sign() < 0);
      ASSERT_EQ(std::signbit(doubles[c]), m[c].sign() < 0);
    }
  }
  EXPECT_GT(subnormal, 10);
}

TEST(RoundedUnitVector, OfWholeLengthsIsTheRoundedQuotient) {
  const int quadruples[][4] = {{3, 4, 0, 5},    {1, 2, 2, 3},    {2, 3, 6, 7},    {5, 12, 0, 13},
                               {1, 4, 8, 9},    {8, 9, 12, 17},  {0, 0, 4, 4},    {6, 10, 15, 19},
                               {0, 20, 21, 29}, {2, 10, 11, 15}, {12, 15, 16, 25}};
  for (const auto& q : quadruples) {
    const Rational scale = Rational(-13) / 7;
    const Floats rounded = rounded_unit_vector({scale * q[0], scale * q[1], scale * q[2]});
    for (int c = 0; c < 3; ++c) EXPECT_EQ(rounded[c], round_to_float(Rational(-q[c]) / q[3]));
  }
  EXPECT_EQ(rounded_unit_vector({0, 0, Rational::power_of_two(-9000)}), (Floats{0, 0, 1}));
  EXPECT_EQ(rounded_unit_vector({Rational::power_of_two(9000), 0, 0}), (Floats{1, 0, 0}));
}

// x/sqrt(x^2 + y^2) is closer to a midpoint h than a hundred digits would show: y is sqrt(x^2/h^2 - x^2),
// rounded down and up at hundreds of bits.
TEST(RoundedUnitVector, DecidesNearlyTiedCases) {
  std::mt19937_64 generator = make_generator();
  for (int repetition = 0; repetition < 100; ++repetition) {
    const int exponent = pick(generator, 0, 1) ? pick(generator, -30, -1) : pick(generator, -149, -1);
    const bool subnormal = exponent <= -127;
    const std::int64_t below =
        subnormal ? pick(generator, 1, 1 << 10) : pick(generator, 1 << 23, (1 << 24) - 1);
    const std::int64_t unit = subnormal ? -149 : exponent - 23;
    const Rational low = Rational(below) * Rational::power_of_two(unit);
    const Rational high = Rational(below + 1) * Rational::power_of_two(unit);
    const Rational middle = Rational(2 * below + 1) * Rational::power_of_two(unit - 1);
    // x = 1: y^2 = 1/h^2 - 1
    const Rational square = 1 / (middle * middle) - 1;
    const int bits = 700;
    const Integer root = sqrt(Integer((square.numerator() << (2 * bits + square.exponent() + 400)) /
                                      (square.denominator() << 400)));
    for (const int step : {0, 1}) {
      const Rational y = Rational(root + step) * Rational::power_of_two(-bits);
      // A smaller y gives a larger x/|m|.
      EXPECT_EQ(Rational(rounded_unit_vector({1, y, 0})[0]), step == 0 ? high : low);
      EXPECT_EQ(Rational(rounded_unit_vector({-1, 0, y})[0]), step == 0 ? -high : -low);
      EXPECT_LT(abs(decimal(middle) - 1 / decimal_length({1, y, 0})), Decimal("1e-95"));
    }
  }
}

TEST(RoundedUnitVectorToDouble, OfWholeLengthsIsTheRoundedQuotient) {
  const Rational scale = Rational(-13) / 7;
  const std::array<double, 3> rounded = rounded_unit_vector_to_double({scale * 2, scale * 3, scale * 6});
  EXPECT_EQ(rounded, (std::array<double, 3>{-2.0 / 7, -3.0 / 7, -6.0 / 7}));
  // 2^-1100 of a length of 1 is below the least subnormal number: zero with its sign.
  const std::array<double, 3> lost = rounded_unit_vector_to_double({1, -Rational::power_of_two(-1100), 0});
  EXPECT_EQ(lost, (std::array<double, 3>{1, 0, 0}));
  EXPECT_TRUE(std::signbit(lost[1]));
  EXPECT_EQ(rounded_unit_vector_to_double({1, Rational::power_of_two(-1074), 0})[1], 0x1p-1074);
  EXPECT_THROW(rounded_unit_vector_to_double({0, 0, 0}), std::domain_error);
}

TEST(IsWithin, JudgesEachComponentOfTheUnitVector) {
  const Vector m{Rational(3) / 7, 0, Rational(-4) / 7};  // (0.6, 0, -0.8)
  const Floats got{0.5f, 0.25f, -0.75f};
  const Rational tiny = Rational::power_of_two(-300);
  // The largest difference, 0.25, is that of y; those of x and z are 0.1 and 0.05.
  EXPECT_TRUE(is_within(got, m, Rational(1) / 4, false));
  EXPECT_FALSE(is_within(got, m, Rational(1) / 4 - tiny, false));
  EXPECT_TRUE(is_within({0.5f, 0, -0.75f}, m, Rational(1) / 10, false));
  EXPECT_FALSE(is_within({0.5f, 0, -0.75f}, m, Rational(1) / 10 - tiny, false));
  EXPECT_TRUE(is_within({0.625f, 0, -0.75f}, m, Rational(1) / 20, false));
  EXPECT_FALSE(is_within({0.625f, 0, -0.75f}, m, Rational(1) / 20 - tiny, false));
  // Either side of zero.
  EXPECT_TRUE(is_within({-0.5f, 0, -0.75f}, m, Rational(11) / 10, false));
  EXPECT_FALSE(is_within({-0.5f, 0, -0.75f}, m, Rational(11) / 10 - tiny, false));
  EXPECT_FALSE(is_within(got, m, -1, false));
  EXPECT_TRUE(is_within({0, 0, 1}, {0, 0, 9}, 0, false));
  EXPECT_FALSE(is_within({0, 0, 9}, {0, 0, 9}, 1, false));  // the length is wrong
}

TEST(IsWithin, TakesTheOppositeWhereTheSignIsFree) {
  const Vector m{3, 0, -4};
  EXPECT_FALSE(is_within({-0.6f, 0, 0.8f}, m, Rational(1) / 1000, false));
  EXPECT_TRUE(is_within({-0.6f, 0, 0.8f}, m, Rational(1) / 1000, true));
  EXPECT_TRUE(is_within({0.6f, 0, -0.8f}, m, Rational(1) / 1000, true));
  EXPECT_FALSE(is_within({0.6f, 0, 0.8f}, m, Rational(1) / 1000, true));  // one sign for all components
  EXPECT_TRUE(direction_is_within({-6, 0, 8}, m, Rational(1) / 1000, true));
  EXPECT_FALSE(direction_is_within({-6, 0, 8}, m, Rational(1) / 1000, false));
  EXPECT_FALSE(direction_is_within({-6, 0, -8}, m, Rational(1) / 1000, true));
}

TEST(IsWithin, RefusesWhatIsNoVector) {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Rational wide = Rational::power_of_two(200);
  for (const Floats& got : {Floats{infinity, 0, 0}, Floats{0, nan, 0}, Floats{0, 0, -infinity}}) {
    EXPECT_FALSE(is_within(got, {0, 0, 1}, wide, true));
    EXPECT_FALSE(direction_is_within(got, {0, 0, 1}, wide, true));
  }
  EXPECT_FALSE(direction_is_within({0, -0.0f, 0}, {0, 0, 1}, wide, true));
  EXPECT_TRUE(is_within({0, 0, 0}, {0, 0, 1}, 1, false));
}

TEST(DirectionIsWithin, EndsAtTheBound) {
  const Rational tiny = Rational::power_of_two(-300);
  // The directions are equal, although the lengths are irrational.
  EXPECT_TRUE(direction_is_within({1, 1, 1}, {2, 2, 2}, 0, false));
  EXPECT_FALSE(direction_is_within({1, 1, 1}, {2, 2, 2 + tiny}, 0, false));
  EXPECT_TRUE(direction_is_within({1, 1, 1}, {2, 2, 2 + tiny}, tiny, false));
  // (0.6, 0, 0.8) and (0.8, 0, 0.6).
  EXPECT_TRUE(direction_is_within({3, 0, 4}, {4, 0, 3}, Rational(1) / 5, false));
  EXPECT_FALSE(direction_is_within({3, 0, 4}, {4, 0, 3}, Rational(1) / 5 - tiny, false));
  // Opposite signs.
  EXPECT_TRUE(direction_is_within({-3, 0, 4}, {3, 0, 4}, Rational(6) / 5, false));
  EXPECT_FALSE(direction_is_within({-3, 0, 4}, {3, 0, 4}, Rational(6) / 5 - tiny, false));
  // The length does not matter.
  EXPECT_TRUE(direction_is_within({0x1p-149f, 0, 0}, {5, 0, 0}, 0, false));
  EXPECT_TRUE(direction_is_within({0x1p127f, 0x1p127f, 0}, {1, 1, 0}, 0, false));
}

TEST(DirectionIsWithin, AgreesWithAHundredDigits) {
  std::mt19937_64 generator = make_generator();
  int accepted = 0;
  for (int repetition = 0; repetition < 2000; ++repetition) {
    const Vector m = random_vector(generator);
    Floats got, unit = rounded_unit_vector(m);
    const double spread = std::ldexp(1.0, -pick(generator, 0, 20));
    for (int c = 0; c < 3; ++c) got[c] = static_cast<float>(unit[c] + spread * uniform(generator, -1, 1));
    const Rational bound(spread * uniform(generator, 0, 2));
    const Vector exact_got{got[0], got[1], got[2]};
    Decimal farthest = 0, farthest_direction = 0;
    for (int c = 0; c < 3; ++c) {
      const Decimal expected = decimal(m[c]) / decimal_length(m);
      farthest = std::max<Decimal>(farthest, abs(Decimal(got[c]) - expected));
      farthest_direction =
          std::max<Decimal>(farthest_direction, abs(Decimal(got[c]) / decimal_length(exact_got) - expected));
    }
    ASSERT_EQ(is_within(got, m, bound, false), farthest <= decimal(bound));
    ASSERT_EQ(direction_is_within(got, m, bound, false), farthest_direction <= decimal(bound));
    accepted += farthest <= decimal(bound);
  }
  EXPECT_GT(accepted, 500);
  EXPECT_LT(accepted, 1800);
}

}  // namespace
}  // namespace evalcts::reference
