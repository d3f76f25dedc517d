// Tests numbers as text, which are read back with other libraries.
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "pipe/dice.h"
#include "write/text.h"

namespace evalcts::vectors {
namespace {

using reference::Rational;
using Limits = std::numeric_limits<double>;

TEST(Hexadecimal, HasOneForm) {
  EXPECT_EQ(hexadecimal(0), "0x0p+0");
  EXPECT_EQ(hexadecimal(-0.0), "-0x0p+0");
  EXPECT_EQ(hexadecimal(1), "0x1p+0");
  EXPECT_EQ(hexadecimal(-0.1875), "-0x1.8p-3");
  EXPECT_EQ(hexadecimal(0.1), "0x1.999999999999ap-4");
  EXPECT_EQ(hexadecimal(std::numeric_limits<float>::max()), "0x1.fffffep+127");
  EXPECT_EQ(hexadecimal(0x1p-149), "0x1p-149");
  EXPECT_EQ(hexadecimal(3 * 0x1p-1074), "0x1.8p-1073");
  EXPECT_EQ(hexadecimal(Limits::max()), "0x1.fffffffffffffp+1023");
  EXPECT_EQ(hexadecimal(Limits::infinity()), "inf");
  EXPECT_EQ(hexadecimal(-Limits::infinity()), "-inf");
  EXPECT_THROW(hexadecimal(Limits::quiet_NaN()), std::domain_error);
}

TEST(Hexadecimal, ReadsBackAsTheSameNumber) {
  Dice dice("hexadecimal");
  for (int i = 0; i < 20000; ++i) {
    const auto bits = static_cast<std::uint64_t>(dice.below(INT64_MAX)) << 1 | (i & 1);
    double value = 0;
    static_assert(sizeof value == sizeof bits);
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    const double back = std::strtod(hexadecimal(value).c_str(), nullptr);
    ASSERT_EQ(back, value);
    ASSERT_EQ(std::signbit(back), std::signbit(value));
  }
}

TEST(Fraction, IsInLowestTerms) {
  EXPECT_EQ(fraction(0), "0/1");
  EXPECT_EQ(fraction(2), "2/1");
  EXPECT_EQ(fraction(Rational(-6) / 16), "-3/8");
  EXPECT_EQ(fraction(Rational(7 * 9 * 32) / (9 * 64 * 5)), "7/10");
  EXPECT_EQ(fraction(Rational(10) / 15), "2/3");
  EXPECT_EQ(fraction(Rational::power_of_two(70)), "1180591620717411303424/1");
  EXPECT_EQ(fraction(-Rational::power_of_two(-3)), "-1/8");
}

TEST(Fraction, IsTheNumberOfBoost) {
  Dice dice("fraction");
  for (int i = 0; i < 2000; ++i) {
    const std::int64_t a = dice.below(2000001) - 1000000, b = 1 + dice.below(1000000);
    const boost::multiprecision::cpp_rational expected(a, b);
    ASSERT_EQ(fraction(Rational(a) / Rational(b)),
              numerator(expected).str() + "/" + denominator(expected).str());
  }
}

}  // namespace
}  // namespace evalcts::vectors
