// Tests the natural numbers on the stack against Boost integers.
#include "exact/natural.h"

#include <gtest/gtest.h>

#include <limits>

#include "random_data.h"

namespace evalcts::reference {
namespace {

// Returns limbs with long runs of ones and zeros, through which carries propagate.
std::uint64_t limb(std::mt19937_64& random) {
  switch (pick(random, 0, 3)) {
    case 0:
      return std::numeric_limits<std::uint64_t>::max();
    case 1:
      return std::uint64_t{1} << pick(random, 0, 63);
    case 2:
      return 0;
    default:
      return random();
  }
}

// One number in two representations.
struct Pair {
  Natural natural;
  Integer integer;
  explicit Pair(std::uint64_t value) : natural(value), integer(value) {}
};

Pair random_pair(std::mt19937_64& random) {
  Pair x(limb(random));
  const Natural one(1);
  for (int length = pick(random, 0, 6); length > 0; --length) {
    const std::uint64_t factor = limb(random), term = limb(random);
    x.natural.multiply(factor);
    x.natural.add_product(one, term);
    x.integer = x.integer * factor + term;
  }
  return x;
}

TEST(Natural, CalculatesAsIntegersDo) {
  std::mt19937_64 random = make_generator();
  for (int round = 0; round < 20000; ++round) {
    Pair x = random_pair(random);
    const Pair y = random_pair(random), z = random_pair(random);
    ASSERT_EQ(x.natural.to_integer(), x.integer);
    ASSERT_EQ(x.natural.to_integer(true), -x.integer);
    ASSERT_EQ(x.natural.is_zero(), x.integer.is_zero());
    ASSERT_EQ(x.natural.bits(), x.integer.is_zero() ? 0 : static_cast<int>(msb(x.integer)) + 1);

    Natural difference;
    ASSERT_EQ(Natural::subtract(x.natural, y.natural, difference), x.integer < y.integer);
    ASSERT_EQ(difference.to_integer(), abs(Integer(x.integer - y.integer)));

    x.natural.add_product(y.natural, z.natural);
    x.integer += y.integer * z.integer;
    ASSERT_EQ(x.natural.to_integer(), x.integer);

    const std::uint64_t low = limb(random), high = limb(random);
    x.natural.add_product(y.natural, static_cast<unsigned __int128>(high) << 64 | low);
    x.integer += y.integer * ((Integer(high) << 64) + low);
    ASSERT_EQ(x.natural.to_integer(), x.integer);
  }
}

TEST(Natural, LeadingBitsAreThoseOfTheNumber) {
  std::mt19937_64 random = make_generator();
  for (int round = 0; round < 20000; ++round) {
    const Pair x = random_pair(random);
    if (x.integer.is_zero()) continue;
    const int cut = x.natural.bits() - 64;
    const Integer leading = cut > 0 ? Integer(x.integer >> cut) : Integer(x.integer << -cut);
    const bool more = cut > 0 && (leading << cut) != x.integer;
    ASSERT_EQ(Integer(x.natural.leading_bits().bits), leading);
    ASSERT_EQ(x.natural.leading_bits().more, more);
  }
}

TEST(Natural, HoldsTheLongestSum) {
  // (2^62)^63 * (2^62)^63 * 2^63 times the sums of the binomial coefficients, with |a| + |b| < 2^63.
  Natural x(1);
  for (int i = 0; i < 2 * 63; ++i) x.multiply((std::uint64_t{1} << 63) - 1);
  x.multiply((std::uint64_t{1} << 63) - 1);
  EXPECT_LE(x.bits(), (Natural::kCapacity - 1) * 64);
  EXPECT_EQ(x.to_integer(), pow((Integer(1) << 63) - 1, 127));
}

}  // namespace
}  // namespace evalcts::reference
