// Tests accepted(): the least and the greatest float within a bound, compared with all floats around.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "pipe/dice.h"
#include "write/text.h"

namespace evalcts::vectors {
namespace {

using reference::Rational;

constexpr float kMost = std::numeric_limits<float>::max();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

bool is_within(float x, const Rational& exact, const Rational& bound) {
  return std::isfinite(x) && abs(Rational(x) - exact) <= bound;
}

// Expects the ends of the interval to be within the bound, and the floats beyond them not to be.
void expect_ends(const Rational& exact, const Rational& bound) {
  const std::optional<Interval> interval = accepted(exact, bound);
  ASSERT_TRUE(interval) << exact << " " << bound;
  EXPECT_LE(interval->low, interval->high);
  EXPECT_TRUE(is_within(interval->low, exact, bound)) << exact << " " << bound;
  EXPECT_TRUE(is_within(interval->high, exact, bound)) << exact << " " << bound;
  EXPECT_FALSE(is_within(std::nextafter(interval->low, -kInfinity), exact, bound)) << exact << " " << bound;
  EXPECT_FALSE(is_within(std::nextafter(interval->high, kInfinity), exact, bound)) << exact << " " << bound;
  EXPECT_FALSE(interval->low == 0 && std::signbit(interval->low));
  EXPECT_FALSE(interval->high == 0 && std::signbit(interval->high));
}

TEST(Accepted, EndsAtTheLastFloatsWithin) {
  Dice dice("accepted");
  for (int i = 0; i < 4000; ++i) {
    const double center = dice.scaled(53, -160, 126);
    const Rational exact = Rational(center) + Rational(dice.real(20)) * Rational::power_of_two(-150) / 3;
    // The bound is large enough for the nearest float.
    const Rational bound =
        abs(exact) * Rational::power_of_two(-dice.between(2, 23)) + Rational::power_of_two(-149);
    expect_ends(exact, bound);
  }
}

// Compares the interval with a search of all floats in [from, to].
void expect_by_counting(const Rational& exact, const Rational& bound, float from, float to) {
  float least = kInfinity, greatest = -kInfinity;
  for (float x = from; x <= to; x = std::nextafter(x, kInfinity))
    if (is_within(x, exact, bound)) {
      least = std::min(least, x);
      greatest = std::max(greatest, x);
    }
  const auto interval = accepted(exact, bound);
  ASSERT_TRUE(interval);
  EXPECT_EQ(interval->low, least);
  EXPECT_EQ(interval->high, greatest);
}

TEST(Accepted, IsEveryFloatWithinByCounting) {
  const Rational small = Rational::power_of_two(-20);
  // The spacing of floats changes at 1.
  expect_by_counting(1, small, 0.99999f, 1.00001f);
  expect_by_counting(Rational(1) + Rational::power_of_two(-26), small, 0.99999f, 1.00001f);
  expect_by_counting(Rational(-1) / 3, small, -0.33335f, -0.33332f);
  // The interval contains subnormal numbers on both sides of zero.
  expect_by_counting(0, Rational(100) * Rational::power_of_two(-149), -0x1p-140f, 0x1p-140f);
  expect_by_counting(Rational(1) / 3 * Rational::power_of_two(-148),
                     Rational(7) * Rational::power_of_two(-148), -0x1p-140f, 0x1p-140f);
}

TEST(Accepted, KeepsToTheFiniteFloats) {
  const auto beyond = accepted(Rational::power_of_two(128), Rational::power_of_two(127));
  ASSERT_TRUE(beyond);
  EXPECT_EQ(beyond->low, 0x1p127f);
  EXPECT_EQ(beyond->high, kMost);
  const auto all = accepted(0, Rational::power_of_two(200));
  ASSERT_TRUE(all);
  EXPECT_EQ(all->low, -kMost);
  EXPECT_EQ(all->high, kMost);
  EXPECT_FALSE(accepted(Rational::power_of_two(130), 1));
  EXPECT_FALSE(accepted(-Rational::power_of_two(130), 1));
}

TEST(Accepted, IsNothingBetweenTwoFloats) {
  const Rational middle = Rational(1) + Rational::power_of_two(-24);
  EXPECT_FALSE(accepted(middle, Rational::power_of_two(-25)));
  EXPECT_TRUE(accepted(middle, Rational::power_of_two(-24)));
  EXPECT_TRUE(accepted(1, 0));
}

TEST(Accepted, WritesZeroWithoutASign) {
  const auto tiny = accepted(-Rational::power_of_two(-160), Rational::power_of_two(-160));
  ASSERT_TRUE(tiny);
  EXPECT_EQ(hexadecimal(tiny->low), "0x0p+0");
  EXPECT_EQ(hexadecimal(tiny->high), "0x0p+0");
}

TEST(RoundUp, IsTheNextFloatNotBelow) {
  EXPECT_EQ(round_up(1), 1);
  EXPECT_EQ(round_up(Rational(1) + Rational::power_of_two(-60)), 0x1.000002p+0f);
  EXPECT_EQ(round_up(Rational(-1) - Rational::power_of_two(-60)), -1);
  EXPECT_EQ(round_up(Rational::power_of_two(-200)), 0x1p-149f);
  EXPECT_EQ(round_up(Rational(kMost)), kMost);
  EXPECT_THROW(round_up(Rational::power_of_two(128)), std::domain_error);
}

}  // namespace
}  // namespace evalcts::vectors
