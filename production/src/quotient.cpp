// Rounds quotients of integers, with an approximate denominator first and exactly if necessary.
#include "quotient.h"
#include "mutation_point.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace glev {
namespace {

template <class Real>
struct Format {
  using Limits = std::numeric_limits<Real>;
  using Bits = std::conditional_t<sizeof(Real) == sizeof(float), std::uint32_t, std::uint64_t>;
  static constexpr int kMaxExponent = Limits::max_exponent - 1, kFractionBits = Limits::digits - 1,
                       kLowestBit = Limits::min_exponent - Limits::digits;
  static constexpr Bits kInfinityBits = std::bit_cast<Bits>(Limits::infinity());
};

// Returns the bits of the Real nearest x * 2^exponent, x != 0. If `more`, the number is larger by less than
// 2^exponent, and x must have 128 bits.
template <class Real>
typename Format<Real>::Bits nearest_bits(Limb2 x, int exponent, bool more) {
  using F = Format<Real>;
  const int top = bit_width(x) - 1 + exponent;
  if (top > F::kMaxExponent) return GLEV_AT(overflow, F::kInfinityBits);
  const int last = GLEV_AT(last_bit, std::max(top - F::kFractionBits, F::kLowestBit)),
            dropped = last - exponent;
  if (dropped > 128) return 0;  // less than half of the smallest number
  Limb2 significand = x << std::max(-dropped, 0);
  if (dropped > 0) {
    significand = dropped == 128 ? 0 : x >> dropped;
    const Limb2 half = Limb2{1} << (dropped - 1), rest = x & (half + (half - 1));
    if (GLEV_AT(rounds_up, rest > half || (rest == half && (more || (significand & 1) != 0)))) ++significand;
  }
  // A carry into the next binade, into the first normal number or into infinity is a carry into the exponent.
  using Bits = typename F::Bits;
  return (static_cast<Bits>(last - F::kLowestBit) << F::kFractionBits) + static_cast<Bits>(significand);
}

Limb2 leading_bits(const Limb* x, int size, int position) {
  return Limb2{bits_at(x, size, position + kLimbBits)} << kLimbBits | bits_at(x, size, position);
}

bool is_power_of_two(const IntegerPower& power) {
  return power.exponent == 0 || trailing_zeros(power.base) == bit_width(power.base, power.size) - 1;
}

// A number between mantissa * 2^exponent and upper() * 2^exponent, where 2^62 <= mantissa < 2^63. Each of the
// few errors is a factor below 1 + 2^-62, so two units for each error are sufficient, with one more for the
// products of errors.
struct Approximation {
  static constexpr int kBits = 63;
  Limb mantissa = Limb{1} << (kBits - 1);
  int exponent = 1 - kBits;
  int errors = 0;

  Limb upper() const { return errors == 0 ? mantissa : mantissa + 2 * static_cast<Limb>(errors) + 1; }
};

Approximation operator*(const Approximation& x, const Approximation& y) {
  const Limb2 product = Limb2{x.mantissa} * y.mantissa;
  const int dropped = bit_width(product) - Approximation::kBits;
  const auto mantissa = static_cast<Limb>(product >> dropped);
  const bool exact = Limb2{mantissa} << dropped == product;
  return {mantissa, x.exponent + y.exponent + dropped, x.errors + y.errors + (exact ? 0 : 1)};
}

Approximation approximate(const IntegerPower& power) {
  Approximation result;
  if (power.exponent == 0) return result;
  const int exponent = bit_width(power.base, power.size) - Approximation::kBits;
  Approximation base = {bits_at(power.base, power.size, exponent), exponent, 0};
  if (exponent > trailing_zeros(power.base)) base.errors = 1;
  for (int n = power.exponent; n != 0; n >>= 1) {
    if (n & 1) result = result * base;
    if (n > 1) base = base * base;
  }
  return result;
}

// Returns the sign of x * 2^x_exponent - y * 2^y_exponent.
int compare(const Limb* x, int x_size, int x_exponent, const Limb* y, int y_size, int y_exponent) {
  int x_bits = bit_width(x, x_size), y_bits = bit_width(y, y_size);
  if (x_bits + x_exponent != y_bits + y_exponent) return x_bits + x_exponent < y_bits + y_exponent ? -1 : 1;
  while (x_bits > 0 || y_bits > 0) {
    x_bits -= kLimbBits;
    y_bits -= kLimbBits;
    const Limb in_x = bits_at(x, x_size, x_bits), in_y = bits_at(y, y_size, y_bits);
    if (in_x != in_y) return in_x < in_y ? -1 : 1;
  }
  return 0;
}

// Returns the sign of quotient - m, where m is the midpoint of the Real of these bits and the next one.
template <class Real>
int compare_with_middle(const Quotient& quotient, typename Format<Real>::Bits bits, Limb* room) {
  using F = Format<Real>;
  constexpr Limb kHidden = Limb{1} << F::kFractionBits;
  const Limb field = bits >> F::kFractionBits, fraction = bits & (kHidden - 1);
  const Limb significand = field == 0 ? fraction : fraction | kHidden;
  const int exponent = F::kLowestBit + std::max(static_cast<int>(field), 1) - 1;
  room[0] = 2 * significand + 1;
  int size = 1;
  for (const IntegerPower* const power : quotient.denominator) {
    for (int i = 0; i < power->exponent; ++i) size = multiply_and_grow(room, size, power->base, power->size);
  }
  return compare(quotient.numerator, quotient.size, quotient.exponent, room, size, exponent - 1);
}

}  // namespace

int rounding_room(const Denominator& denominator) {
  int bits = Format<double>::kFractionBits + 2, largest = 0;
  for (const IntegerPower* const power : denominator) {
    if (power->exponent == 0) continue;
    bits += power->exponent * bit_width(power->base, power->size);
    largest = std::max(largest, power->size);
  }
  return limbs_for(bits) + largest;
}

template <class Real>
Real round_quotient(const Quotient& quotient, Limb* room) {
  const int cut = bit_width(quotient.numerator, quotient.size) - 128;
  const Limb2 leading = leading_bits(quotient.numerator, quotient.size, cut);
  const int exponent = quotient.exponent + cut;
  const Denominator& factors = quotient.denominator;

  typename Format<Real>::Bits bits;
  if (std::all_of(factors.begin(), factors.end(),
                  [](const auto* power) { return is_power_of_two(*power); })) {
    int shift = 0;
    for (const IntegerPower* const power : factors) {
      if (power->exponent != 0) shift += power->exponent * (bit_width(power->base, power->size) - 1);
    }
    bits = nearest_bits<Real>(leading, exponent - shift, cut > trailing_zeros(quotient.numerator));
  } else {
    Approximation denominator;
    for (const IntegerPower* const power : factors) denominator = denominator * approximate(*power);
    // leading <= numerator < leading + 1, in units of 2^cut, and the largest quotient of the latter by an
    // integer is at most one more than the quotient rounded down.
    const Limb2 below = leading / denominator.upper(), above = leading / denominator.mantissa + 1;
    bits = nearest_bits<Real>(below, exponent - denominator.exponent, false);
    if (bits != nearest_bits<Real>(above, exponent - denominator.exponent, false)) {
      const int side = compare_with_middle<Real>(quotient, bits, room);
      if (GLEV_AT(fraction_rounds_up, side > 0 || (side == 0 && (bits & 1) != 0))) ++bits;
    }
  }
  const auto sign = static_cast<decltype(bits)>(quotient.negative) << (8 * sizeof(Real) - 1);
  return std::bit_cast<Real>(bits | sign);
}

template float round_quotient(const Quotient&, Limb*);
template double round_quotient(const Quotient&, Limb*);

}  // namespace glev
