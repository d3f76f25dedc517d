// Bernstein sums over short numbers, without memory allocation during the sum.
#include "short_sum.h"

#include <array>
#include <bit>
#include <cstdlib>

#include "binary.h"
#include "homogeneous.h"

namespace evalcts::reference {
namespace {

using Limb = Natural::Limb;
using TwoLimbs = Natural::TwoLimbs;
using SignedTwoLimbs = __int128;

constexpr int kArgumentBits = 62;
constexpr int kValueBits = 63;
constexpr int kPairBits = 94;

TwoLimbs magnitude_of(SignedTwoLimbs x) {
  return x < 0 ? -static_cast<TwoLimbs>(x) : static_cast<TwoLimbs>(x);
}

// Returns x * 2^-exponent, or nothing if this integer has more than `bits` bits.
std::optional<std::int64_t> scaled(const Binary& x, int exponent, int bits) {
  if (x.significand == 0) return 0;
  const int shift = x.exponent - exponent;
  const int length = 64 - std::countl_zero(static_cast<Limb>(std::abs(x.significand)));
  if (length + shift > bits) return std::nullopt;
  return x.significand * (std::int64_t{1} << shift);
}

// Returns true if a^i * b^(n-i) is negative, provided that it is not zero.
bool is_negative(const ShortHomogeneous& t, int n, int i) {
  return (t.a < 0 && i % 2 != 0) != (t.b < 0 && (n - i) % 2 != 0);
}

template <bool kMagnitude>
void sum_row(const SignedTwoLimbs* terms, int count, const ShortHomogeneous& t, bool pairs, ShortSum& sum) {
  const Limb a = std::abs(t.a), b = std::abs(t.b);
  Natural power(1);
  const auto term = [&](int i) { return is_negative(t, count - 1, i) ? -terms[i] : terms[i]; };
  const auto add = [&](SignedTwoLimbs x) {
    if (x != 0) (x < 0 ? sum.negative : sum.positive).add_product(power, magnitude_of(x));
  };
  const auto multiply = [&](Limb by_b, Limb by_a) {
    sum.positive.multiply(by_b);
    sum.negative.multiply(by_b);
    power.multiply(by_a);
  };
  // Horner's scheme with power = a^i. A step adds two terms if all factors fit into 32 bits.
  int i = 0;
  if (pairs && (a | b) >> 32 == 0) {
    for (; i + 1 < count; i += 2) {
      if (i > 0) multiply(b * b, a * a);
      const SignedTwoLimbs first = term(i) * b, second = term(i + 1) * a;
      if (kMagnitude) {
        add(first);
        add(second);
      } else {
        add(first + second);
      }
    }
    if (i > 0) power.multiply(a);
  }
  for (; i < count; ++i) {
    if (i > 0) multiply(b, a);
    add(term(i));
  }
}

}  // namespace

std::optional<ShortHomogeneous> homogenise_short(const Argument& u, const Direction& direction) {
  if (direction.order == 1) return ShortHomogeneous{0, 1, 1};
  const std::array<Binary, 4> numbers{decompose(u.first()), decompose(u.last()), decompose(direction.first),
                                      decompose(direction.last)};
  const int exponent = common_exponent(numbers);
  std::array<std::int64_t, 4> integers;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto integer = scaled(numbers[k], exponent, kArgumentBits - 1);
    if (!integer) return std::nullopt;
    integers[k] = *integer;
  }
  SignedTwoLimbs x = integers[0], x1 = integers[2], x2 = integers[3];
  if (u.is_grid()) {
    const SignedTwoLimbs n = u.segments(), i = u.index();
    if ((magnitude_of(n) | magnitude_of(i)) >> 32 != 0) return std::nullopt;
    x = (n - i) * integers[0] + i * integers[1];
    x1 *= n;
    x2 *= n;
  }
  SignedTwoLimbs a = x - x1, b = x2 - x, c = x2 - x1;
  if (c < 0) {
    a = -a;
    b = -b;
    c = -c;
  }
  // Common divisors of a and b divide c, because a + b = c.
  const TwoLimbs bits = magnitude_of(a) | magnitude_of(b);
  const auto low = static_cast<Limb>(bits);
  const int zeros = low != 0 ? std::countr_zero(low) : 64 + std::countr_zero(static_cast<Limb>(bits >> 64));
  if ((bits | static_cast<TwoLimbs>(c)) >> zeros >> kArgumentBits != 0) return std::nullopt;
  return ShortHomogeneous{static_cast<std::int64_t>(a >> zeros), static_cast<std::int64_t>(b >> zeros),
                          static_cast<std::int64_t>(c >> zeros)};
}

std::optional<ShortTerms> short_terms(std::span<const double> points, int rows, int columns) {
  std::vector<Binary> numbers;
  numbers.reserve(points.size());
  for (const double x : points) numbers.push_back(decompose(x));
  ShortTerms terms{{}, rows, columns, common_exponent(numbers), true};
  terms.values.reserve(points.size());
  const int count = columns == 1 ? rows : columns;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto value = scaled(numbers[k], terms.exponent, kValueBits);
    if (!value) return std::nullopt;
    terms.values.push_back(SignedTwoLimbs{*value} * binomial(count - 1, static_cast<int>(k) % count));
    if (magnitude_of(terms.values.back()) >> kPairBits != 0) terms.pairs = false;
  }
  return terms;
}

template <bool kMagnitude>
void short_sum(const ShortTerms& terms, const ShortHomogeneous& u, const ShortHomogeneous& v, ShortSum& sum) {
  if (terms.rows == 1 || terms.columns == 1) {
    return sum_row<kMagnitude>(terms.values.data(), static_cast<int>(terms.values.size()),
                               terms.columns == 1 ? u : v, terms.pairs, sum);
  }
  const Limb a = std::abs(u.a), b = std::abs(u.b);
  const int n = terms.rows - 1;
  Natural power(1);
  for (int i = 0; i <= n; ++i) {
    if (i > 0) {
      sum.positive.multiply(b);
      sum.negative.multiply(b);
      power.multiply(a);
      if (power.is_zero()) continue;
    }
    ShortSum row;
    sum_row<kMagnitude>(&terms.values[static_cast<std::size_t>(i) * terms.columns], terms.columns, v,
                        terms.pairs, row);
    Natural weight(power);
    weight.multiply(binomial(n, i));
    bool negative = is_negative(u, n, i);
    if (kMagnitude) {
      (negative ? sum.negative : sum.positive).add_product(weight, row.positive);
      (negative ? sum.positive : sum.negative).add_product(weight, row.negative);
    } else {
      Natural difference;
      if (Natural::subtract(row.positive, row.negative, difference)) negative = !negative;
      (negative ? sum.negative : sum.positive).add_product(weight, difference);
    }
  }
}

template void short_sum<false>(const ShortTerms&, const ShortHomogeneous&, const ShortHomogeneous&,
                               ShortSum&);
template void short_sum<true>(const ShortTerms&, const ShortHomogeneous&, const ShortHomogeneous&, ShortSum&);

}  // namespace evalcts::reference
