// Tests rational arithmetic and its text.
#include <gtest/gtest.h>
#include <reference/rational.h>

#include <limits>
#include <stdexcept>

#include "random_data.h"
#include "second_route.h"

namespace evalcts::reference {
namespace {

// Returns a signed integer, a double of any magnitude, or a quotient.
Rational random_rational(std::mt19937_64& generator) {
  switch (pick(generator, 0, 3)) {
    case 0:
      return pick(generator, -5, 5);
    case 1:
      return any_double(generator);
    case 2:
      return Rational(uniform(generator, -1, 1)) / Rational(pick(generator, 1, 1000));
    default:
      return Rational(Integer(generator()), -Integer(generator() | 1), pick(generator, -300, 300));
  }
}

TEST(Rational, HoldsWhatItWasMadeFrom) {
  EXPECT_TRUE(Rational().is_zero());
  EXPECT_EQ(Rational(0.75), Rational(3) / Rational(4));
  EXPECT_EQ(Rational(Integer(3), Integer(-4)), Rational(-0.75));
  EXPECT_EQ(Rational(Integer(6), Integer(8), 2), Rational(3));
  EXPECT_EQ(Rational(std::numeric_limits<std::int64_t>::min()), -Rational::power_of_two(63));
  EXPECT_EQ(Rational(std::numeric_limits<double>::denorm_min()), Rational::power_of_two(-1074));
  EXPECT_EQ(Rational(std::numeric_limits<double>::max()),
            Rational::power_of_two(1024) - Rational::power_of_two(971));
  EXPECT_TRUE(Rational(-0.0).is_zero());
  EXPECT_EQ(Rational(-0.0).sign(), 0);
  EXPECT_GT(Rational(Integer(1), Integer(-3)).denominator(), 0);
}

TEST(Rational, RefusesWhatIsNoNumber) {
  EXPECT_THROW(Rational{std::numeric_limits<double>::infinity()}, std::domain_error);
  EXPECT_THROW(Rational{std::numeric_limits<float>::quiet_NaN()}, std::domain_error);
  EXPECT_THROW(Rational(Integer(1), Integer(0)), std::domain_error);
  EXPECT_THROW(Rational(1) / Rational(0), std::domain_error);
  EXPECT_THROW(floor_log2(Rational(0)), std::domain_error);
}

TEST(Rational, ArithmeticAgreesWithReducedFractions) {
  std::mt19937_64 generator = make_generator();
  for (int i = 0; i < 300; ++i) {
    const Rational a = random_rational(generator), b = random_rational(generator);
    const Fraction x = fraction(a), y = fraction(b);
    EXPECT_EQ(fraction(a + b), x + y);
    EXPECT_EQ(fraction(a - b), x - y);
    EXPECT_EQ(fraction(a - a), 0);
    EXPECT_EQ(fraction(a * b), x * y);
    if (!b.is_zero()) {
      EXPECT_EQ(fraction(a / b), x / y);
    }
    EXPECT_EQ(fraction(-a), -x);
    EXPECT_EQ(fraction(abs(a)), abs(x));
    EXPECT_EQ(fraction(pow(a, 3)), x * x * x);
    EXPECT_EQ(a.sign(), x.sign());
    EXPECT_EQ(a < b, x < y);
    EXPECT_EQ(a == b, x == y);
    EXPECT_EQ(a > b, x > y);
    EXPECT_TRUE(a == a * Rational(3) / Rational(3));
    EXPECT_TRUE(a * Rational(3) / Rational(3) <= a);
    EXPECT_TRUE(a.is_zero() || (bit_test(abs(a.numerator()), 0) && bit_test(a.denominator(), 0)));
  }
  EXPECT_EQ(pow(Rational(0), 0), 1);
}

TEST(Rational, FloorLog2FindsTheBinade) {
  std::mt19937_64 generator = make_generator();
  for (int i = 0; i < 300; ++i) {
    const Rational x = random_rational(generator);
    if (x.is_zero()) continue;
    const std::int64_t k = floor_log2(x);
    EXPECT_LE(Rational::power_of_two(k), abs(x));
    EXPECT_LT(abs(x), Rational::power_of_two(k + 1));
  }
  EXPECT_EQ(floor_log2(Rational(1) / Rational(3)), -2);
  EXPECT_EQ(floor_log2(Rational(-8)), 3);
}

TEST(Rational, DescribesItselfInDecimalAndHexadecimal) {
  EXPECT_EQ(describe(0), "0 (0x0p+0)");
  EXPECT_EQ(describe(1), "1 (0x1p+0)");
  EXPECT_EQ(describe(-10), "-10 (-0x1.4p+3)");
  EXPECT_EQ(describe(0.1f), "0.10000000149011612 (0x1.99999ap-4)");
  EXPECT_EQ(describe(Rational(1) / 3), "0.33333333333333333 (0x1.5555555555p-2)");
  EXPECT_EQ(describe(Rational(2) / 3), "0.66666666666666667 (0x1.5555555555p-1)");
  EXPECT_EQ(describe(Rational(-1) / 1024), "-0.0009765625 (-0x1p-10)");
  EXPECT_EQ(describe(1e16), "10000000000000000 (0x1.1c37937e08p+53)");
  EXPECT_EQ(describe(Rational(100) * pow(Rational(10), 20)), "1e+22 (0x1.0f0cf064ddp+73)");
  EXPECT_EQ(describe(Rational::power_of_two(-149)), "1.4012984643248171e-45 (0x1p-149)");
  EXPECT_EQ(describe(Rational::power_of_two(2000)), "1.1481306952742545e+602 (0x1p+2000)");
  // The digits are rounded up to the next power of ten, and of two.
  EXPECT_EQ(describe(1 - pow(Rational(1) / 10, 20)), "1 (0x1p+0)");
  EXPECT_EQ(describe(1000 - pow(Rational(1) / 10, 20)), "1000 (0x1.f4p+9)");
  EXPECT_EQ(describe(Rational(0.00001)), "0.000010000000000000001 (0x1.4f8b588e37p-17)");
}

TEST(Rational, ToDoubleIsNearest) {
  EXPECT_EQ((Rational(1) / 3).to_double(), 1.0 / 3.0);
  EXPECT_EQ((Rational(2) / 3).to_double(), 2.0 / 3.0);
  EXPECT_EQ(Rational::power_of_two(-2000).to_double(), 0);
  EXPECT_EQ(Rational::power_of_two(2000).to_double(), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace evalcts::reference
