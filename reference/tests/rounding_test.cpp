// Tests correct rounding, ULP and the error measures.
#include <gtest/gtest.h>
#include <reference/rounding.h>

#include <cfenv>
#include <cmath>
#include <limits>

#include "random_data.h"
#include "second_route.h"

namespace evalcts::reference {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

bool has_even_significand(float x) { return std::bit_cast<std::uint32_t>(x) % 2 == 0; }
bool has_even_significand(double x) { return std::bit_cast<std::uint64_t>(x) % 2 == 0; }

// Expects that no other floating-point number is nearer to x, and that a tie was rounded to an even
// significand.
template <typename Float>
void expect_nearest(const Rational& x, Float rounded) {
  ASSERT_TRUE(std::isfinite(rounded)) << describe(x);
  const Fraction exact = fraction(x);
  const Fraction distance = abs(Fraction(fraction(rounded) - exact));
  for (const Float direction : {std::numeric_limits<Float>::max(), -std::numeric_limits<Float>::max()}) {
    const Float neighbour = std::nextafter(rounded, direction);
    if (neighbour == rounded) continue;  // the largest
    const Fraction other = abs(Fraction(fraction(neighbour) - exact));
    EXPECT_LE(distance, other) << describe(x) << " rounded to " << rounded;
    if (distance == other) {
      EXPECT_TRUE(has_even_significand(rounded)) << describe(x);
    }
  }
}

template <typename Float>
Float rounded_to(const Rational& x) {
  if constexpr (std::is_same_v<Float, float>) return round_to_float(x);
  return round_to_double(x);
}

template <typename T>
class RoundingOf : public testing::Test {};
using FloatingPointTypes = testing::Types<float, double>;
TYPED_TEST_SUITE(RoundingOf, FloatingPointTypes);

template <typename Float>
Float any(std::mt19937_64& generator) {
  if constexpr (std::is_same_v<Float, float>) return any_float(generator);
  return any_double(generator);
}

TYPED_TEST(RoundingOf, IsNearestAmongAllNeighbours) {
  std::mt19937_64 generator = make_generator();
  for (int i = 0; i < 1500; ++i) {
    const TypeParam base = any<TypeParam>(generator);
    const TypeParam next = std::nextafter(base, std::numeric_limits<TypeParam>::infinity());
    if (!std::isfinite(next)) continue;
    // Values between two neighbours: thirds, the midpoint (a tie), and values very near to the ends and the
    // midpoint.
    const Rational gap = Rational(next) - Rational(base);
    const Rational tiny = Rational::power_of_two(-1300);
    for (const Rational& x :
         {Rational(base) + gap / 3, Rational(base) + gap / 2, Rational(base) + gap / 2 + tiny,
          Rational(base) + gap / 2 - tiny / 3, Rational(base) + tiny, Rational(next) - tiny}) {
      expect_nearest(x, rounded_to<TypeParam>(x));
      expect_nearest(x, rounded_to<TypeParam>(x * 3 / 3));  // x as an unreduced fraction
    }
    EXPECT_EQ(rounded_to<TypeParam>(base), base);
  }
}

TYPED_TEST(RoundingOf, KeepsTheSignOfWhatRoundsToZero) {
  using Limits = std::numeric_limits<TypeParam>;
  const Rational least = Limits::denorm_min();
  EXPECT_FALSE(std::signbit(rounded_to<TypeParam>(0)));
  EXPECT_EQ(rounded_to<TypeParam>(-least / 2), 0);  // a tie, and zero is even
  EXPECT_TRUE(std::signbit(rounded_to<TypeParam>(-least / 2)));
  EXPECT_FALSE(std::signbit(rounded_to<TypeParam>(least / 2)));
  EXPECT_TRUE(std::signbit(rounded_to<TypeParam>(-Rational::power_of_two(-100000))));
  EXPECT_EQ(rounded_to<TypeParam>(-Rational::power_of_two(-100000)), 0);
  EXPECT_EQ(rounded_to<TypeParam>(least * 2 / 3), Limits::denorm_min());
  EXPECT_EQ(rounded_to<TypeParam>(least / 2 + Rational::power_of_two(-3000)), Limits::denorm_min());
  EXPECT_EQ(rounded_to<TypeParam>(least * 3 / 2), 2 * Limits::denorm_min());
  EXPECT_EQ(rounded_to<TypeParam>(least * 5 / 2), 2 * Limits::denorm_min());
  // The step from subnormal to normal.
  EXPECT_EQ(rounded_to<TypeParam>(Rational(Limits::min()) - least / 2), Limits::min());
  EXPECT_EQ(rounded_to<TypeParam>(Rational(Limits::min()) - least * 3 / 4),
            Limits::min() - Limits::denorm_min());
}

TYPED_TEST(RoundingOf, OverflowsHalfAUnitAboveTheLargest) {
  using Limits = std::numeric_limits<TypeParam>;
  const int top = Limits::max_exponent;
  const Rational threshold = Rational::power_of_two(top) - Rational::power_of_two(top - Limits::digits - 1);
  const Rational tiny = Rational::power_of_two(-2000);
  EXPECT_EQ(rounded_to<TypeParam>(threshold), Limits::infinity());
  EXPECT_EQ(rounded_to<TypeParam>(-threshold), -Limits::infinity());
  EXPECT_EQ(rounded_to<TypeParam>(threshold - tiny), Limits::max());
  EXPECT_EQ(rounded_to<TypeParam>(-threshold + tiny), -Limits::max());
  EXPECT_EQ(rounded_to<TypeParam>(threshold + tiny), Limits::infinity());
  EXPECT_EQ(rounded_to<TypeParam>(Rational::power_of_two(100000) / 3), Limits::infinity());
}

// The processor's own arithmetic rounds exact sums, products and quotients correctly.
TYPED_TEST(RoundingOf, AgreesWithTheHardware) {
  ASSERT_EQ(std::fegetround(), FE_TONEAREST);
  std::mt19937_64 generator = make_generator();
  for (int i = 0; i < 20000; ++i) {
    const TypeParam a = any<TypeParam>(generator), b = any<TypeParam>(generator);
    EXPECT_EQ(rounded_to<TypeParam>(Rational(a) * Rational(b)), a * b) << a << " * " << b;
    const TypeParam near = std::ldexp(b, std::ilogb(a) - std::ilogb(b) + pick(generator, -60, 3));
    if (std::isfinite(near)) {
      EXPECT_EQ(rounded_to<TypeParam>(Rational(a) + Rational(near)), a + near) << a << " + " << near;
    }
    if (b != 0) {
      EXPECT_EQ(rounded_to<TypeParam>(Rational(a) / Rational(b)), a / b) << a << " / " << b;
    }
  }
}

TEST(Rounding, ToIntegerIsNearestEven) {
  EXPECT_EQ(round_to_integer(0), 0);
  EXPECT_EQ(round_to_integer(0.5), 0);
  EXPECT_EQ(round_to_integer(1.5), 2);
  EXPECT_EQ(round_to_integer(-2.5), -2);
  EXPECT_EQ(round_to_integer(-3.5), -4);
  EXPECT_EQ(round_to_integer(2.25), 2);
  EXPECT_EQ(round_to_integer(Rational(-8) / 3), -3);
  EXPECT_EQ(round_to_integer(Rational(7) / 3), 2);
  EXPECT_EQ(round_to_integer(1e20), Integer("100000000000000000000"));
}

TEST(Ulp, IsTheGapOfTheClosestStraddlingFloats) {
  std::mt19937_64 generator = make_generator();
  for (int i = 0; i < 5000; ++i) {
    const float a = std::abs(any_float(generator));
    const float b = std::nextafter(a, kInfinity);
    if (!std::isfinite(b)) continue;
    const Rational gap = Rational(b) - Rational(a);
    EXPECT_EQ(ulp(Rational(a) + gap / 3), gap) << a;
    EXPECT_EQ(ulp(-(Rational(a) + gap / 3)), gap) << a;
    // A float has a neighbour on either side; the smaller gap is the one towards zero.
    if (a > 0) {
      EXPECT_EQ(ulp(a), Rational(a) - Rational(std::nextafter(a, 0.0f))) << a;
    }
  }
}

TEST(Ulp, IsDefinedAtTheEdgesOfBinades) {
  const auto two_to = [](int e) { return Rational::power_of_two(e); };
  const Rational tiny = two_to(-300);
  EXPECT_EQ(ulp(1), two_to(-24));
  EXPECT_EQ(ulp(-1), two_to(-24));
  EXPECT_EQ(ulp(1 + tiny), two_to(-23));
  EXPECT_EQ(ulp(1 - tiny), two_to(-24));
  EXPECT_EQ(ulp(0), two_to(-149));
  EXPECT_EQ(ulp(tiny), two_to(-149));
  EXPECT_EQ(ulp(two_to(-126)), two_to(-149));
  EXPECT_EQ(ulp(two_to(-126) + tiny), two_to(-149));
  EXPECT_EQ(ulp(two_to(-125)), two_to(-149));
  EXPECT_EQ(ulp(two_to(-125) + tiny), two_to(-148));
  EXPECT_EQ(ulp(two_to(127)), two_to(103));
  EXPECT_EQ(ulp(two_to(127) + tiny), two_to(104));
  EXPECT_EQ(ulp(two_to(128)), two_to(104));
  EXPECT_EQ(ulp(two_to(128) + tiny), two_to(104));
  EXPECT_EQ(ulp(two_to(500)), two_to(104));
}

TEST(Ulp, DistanceCountsUnits) {
  const float one = 1, above = std::nextafter(1.0f, 2.0f), below = std::nextafter(1.0f, 0.0f);
  EXPECT_EQ(ulp_distance(one, 1), 0);
  EXPECT_EQ(ulp_distance(-0.0f, 0), 0);
  EXPECT_EQ(ulp_distance(above, 1), 2);  // the smaller gap counts at a power of two
  EXPECT_EQ(ulp_distance(below, 1), 1);
  EXPECT_EQ(ulp_distance(one, 1 + Rational::power_of_two(-24)), 0.5);
  EXPECT_EQ(ulp_distance(-1, 1), 0x1p25);
  EXPECT_EQ(ulp_distance(std::numeric_limits<float>::denorm_min(), 0), 1);
  EXPECT_EQ(ulp_distance(kInfinity, std::numeric_limits<float>::max()), 1);
  EXPECT_EQ(ulp_distance(kInfinity, Rational::power_of_two(128)), 0);
  EXPECT_EQ(ulp_distance(-kInfinity, Rational::power_of_two(128)), 0x1p25);
  EXPECT_EQ(ulp_distance(std::numeric_limits<float>::quiet_NaN(), 0), kInfinity);
  for (const int exponent : {129, 200, 2000}) {
    const Rational beyond = Rational::power_of_two(exponent);
    EXPECT_EQ(ulp_distance(kInfinity, beyond), 0);
    EXPECT_EQ(ulp_distance(-kInfinity, -beyond), 0);
    EXPECT_EQ(ulp_distance(std::numeric_limits<float>::max(), beyond), 1);
    EXPECT_EQ(condition_distance(kInfinity, beyond, beyond), 0);
  }
}

TEST(ConditionDistance, IsRelativeToTheMagnitude) {
  EXPECT_EQ(condition_distance(1.5f, 1, 2), 0x1p22);
  EXPECT_EQ(condition_distance(1, 1, 0), 0);
  EXPECT_EQ(condition_distance(0, 0, 0), 0);
  EXPECT_EQ(condition_distance(-0.0f, 0, 0), 0);
  EXPECT_EQ(condition_distance(1, 0, 0), kInfinity);
  EXPECT_EQ(condition_distance(kInfinity, 0, Rational::power_of_two(128)), 0x1p24);
  EXPECT_EQ(condition_distance(std::numeric_limits<float>::quiet_NaN(), 0, 1), kInfinity);
  EXPECT_EQ(condition_distance(std::numeric_limits<float>::quiet_NaN(), 0, 0), kInfinity);
}

}  // namespace
}  // namespace evalcts::reference
