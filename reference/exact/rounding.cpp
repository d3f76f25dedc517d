// Correct rounding of rationals and of long integers, ULP, and the two error measures.
#include <reference/rounding.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "binary.h"
#include "leading_bits.h"

namespace evalcts::reference {
namespace {

// Returns |x| * 2^-exponent rounded to the nearest integer, ties to even.
Integer round_scaled(const Rational& x, std::int64_t exponent) {
  const std::int64_t shift = x.exponent() - exponent;
  Integer numerator = abs(x.numerator());
  if (shift >= 0) numerator <<= shift;
  if (x.denominator() == 1) {
    if (shift >= 0) return numerator;
    // The numerator is odd, so this is a tie only if a single bit is cut off.
    const unsigned cut = static_cast<unsigned>(-shift);
    const bool half = bit_test(numerator, cut - 1);
    numerator >>= cut;
    if (half && (cut > 1 || bit_test(numerator, 0))) ++numerator;
    return numerator;
  }
  Integer denominator = x.denominator();
  if (shift < 0) denominator <<= -shift;
  Integer quotient, remainder;
  divide_qr(numerator, denominator, quotient, remainder);
  const int half = Integer(remainder << 1).compare(denominator);
  if (half > 0 || (half == 0 && bit_test(quotient, 0))) ++quotient;
  return quotient;
}

// Returns the exponent of a unit in the last place of numbers in [2^magnitude, 2^(magnitude + 1)).
template <typename Float>
std::int64_t unit_in_the_last_place(std::int64_t magnitude) {
  using Limits = std::numeric_limits<Float>;
  return std::max<std::int64_t>(magnitude, Limits::min_exponent - 1) - (Limits::digits - 1);
}

// Returns the value of `got`; infinity counts as 2^128. `got` must not be NaN.
Rational extended(float got) {
  return std::isinf(got) ? Rational(got > 0 ? 1 : -1) * Rational::power_of_two(128) : Rational(got);
}

}  // namespace

template <typename Float>
Float round_to(const Rational& x) {
  using Limits = std::numeric_limits<Float>;
  if (x.is_zero()) return 0;
  const Float sign = x.sign() < 0 ? Float{-1} : Float{1};
  const std::int64_t magnitude = floor_log2(x);
  if (magnitude >= Limits::max_exponent) return std::copysign(Limits::infinity(), sign);
  const std::int64_t unit = unit_in_the_last_place<Float>(magnitude);
  if (magnitude < unit - 1) return std::copysign(Float{0}, sign);
  const auto significand = static_cast<Float>(static_cast<std::uint64_t>(round_scaled(x, unit)));
  // Exact, except that a significand that was rounded up to 2^digits may overflow.
  return std::copysign(std::ldexp(significand, static_cast<int>(unit)), sign);
}

template <typename Float>
Float round_leading(bool negative, const LeadingBits& leading, std::int64_t exponent) {
  using Limits = std::numeric_limits<Float>;
  const Float sign = negative ? Float{-1} : Float{1};
  const std::int64_t magnitude = exponent + 63;
  if (magnitude >= Limits::max_exponent) return std::copysign(Limits::infinity(), sign);
  const std::int64_t unit = unit_in_the_last_place<Float>(magnitude);
  const std::int64_t cut = unit - exponent;  // number of bits that are cut off, > 0
  if (cut > 64) return std::copysign(Float{0}, sign);
  const std::uint64_t kept = cut == 64 ? 0 : leading.bits >> cut;
  const std::uint64_t half = std::uint64_t{1} << (cut - 1), rest = leading.bits & (half - 1);
  const bool up = (leading.bits & half) != 0 && (rest != 0 || leading.more || kept % 2 != 0);
  return std::copysign(std::ldexp(static_cast<Float>(kept + (up ? 1 : 0)), static_cast<int>(unit)), sign);
}

template float round_to<float>(const Rational& x);
template double round_to<double>(const Rational& x);
template float round_leading<float>(bool negative, const LeadingBits& leading, std::int64_t exponent);
template double round_leading<double>(bool negative, const LeadingBits& leading, std::int64_t exponent);

float round_to_float(const Rational& x) { return round_to<float>(x); }
double round_to_double(const Rational& x) { return round_to<double>(x); }

Integer round_to_integer(const Rational& x) {
  Integer magnitude = round_scaled(x, 0);
  return x.sign() < 0 ? Integer(-magnitude) : magnitude;
}

Rational ulp(const Rational& x) {
  constexpr int kLowest = -149, kHighest = 104;
  if (x.is_zero()) return Rational::power_of_two(kLowest);
  const std::int64_t magnitude = floor_log2(x);
  const bool power_of_two = abs(x) == Rational::power_of_two(magnitude);
  return Rational::power_of_two(
      std::clamp<std::int64_t>(magnitude - 23 - (power_of_two ? 1 : 0), kLowest, kHighest));
}

namespace {

// Returns |got - exact|, both clamped to +-2^128, so that a correct infinity has no error.
Rational distance(float got, const Rational& exact) {
  const Rational infinity = Rational::power_of_two(128);
  return abs(extended(got) - (exact > infinity ? infinity : exact < -infinity ? -infinity : exact));
}

}  // namespace

double ulp_distance(float got, const Rational& exact) {
  if (std::isnan(got)) return std::numeric_limits<double>::infinity();
  return (distance(got, exact) / ulp(exact)).to_double();
}

double condition_distance(float got, const Rational& exact, const Rational& magnitude) {
  if (std::isnan(got)) return std::numeric_limits<double>::infinity();
  const Rational error = distance(got, exact);
  if (error.is_zero()) return 0;
  if (magnitude.is_zero()) return std::numeric_limits<double>::infinity();
  return (error / (Rational::power_of_two(-24) * magnitude)).to_double();
}

}  // namespace evalcts::reference
