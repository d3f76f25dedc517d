// Integers of many limbs in memory of the caller, least significant limb first, with the operations that
// exact evaluation needs. Signed integers are in two's complement, so products and sums modulo 2^(64 * size)
// do not depend on signs.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace glev {

using Limb = std::uint64_t;
__extension__ using Limb2 = unsigned __int128;
inline constexpr int kLimbBits = 64;

constexpr Limb high_limb(Limb2 x) { return static_cast<Limb>(x >> kLimbBits); }
constexpr int bit_width(Limb x) { return static_cast<int>(std::bit_width(x)); }
constexpr int bit_width(Limb2 x) {
  return high_limb(x) != 0 ? kLimbBits + bit_width(high_limb(x)) : bit_width(static_cast<Limb>(x));
}
// Returns the number of trailing zeros of x != 0.
constexpr int trailing_zeros(Limb2 x) {
  return static_cast<Limb>(x) != 0 ? std::countr_zero(static_cast<Limb>(x))
                                   : kLimbBits + std::countr_zero(high_limb(x));
}

// The finite double +-mantissa * 2^exponent with an odd mantissa; 0 has mantissa 0.
struct Decoded {
  Limb mantissa;
  int exponent;
  bool negative;
};

inline Decoded decode(double x) {
  constexpr int kFraction = 52;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int field = static_cast<int>(bits >> kFraction & 0x7FF);
  Limb mantissa = bits & ((Limb{1} << kFraction) - 1);
  if (field != 0) mantissa |= Limb{1} << kFraction;
  if (mantissa == 0) return {};
  const int zeros = std::countr_zero(mantissa);
  return {mantissa >> zeros, std::max(field, 1) - (1023 + kFraction) + zeros, bits >> 63 != 0};
}

// ---- Sizes, in limbs

constexpr int limbs_for(int bits) { return (bits + kLimbBits - 1) / kLimbBits; }

// Returns the size without leading zero limbs.
inline int trimmed_size(const Limb* x, int size) {
  while (size > 0 && x[size - 1] == 0) --size;
  return size;
}

inline bool is_negative(const Limb* x, int size) { return x[size - 1] >> (kLimbBits - 1) != 0; }

// Extends a signed integer to more limbs.
inline void sign_extend(Limb* x, int size, int new_size) {
  const Limb sign = is_negative(x, size) ? ~Limb{0} : 0;
  for (int i = size; i < new_size; ++i) x[i] = sign;
}

inline void negate(Limb* x, int size) {
  Limb carry = 1;
  for (int i = 0; i < size; ++i) {
    x[i] = ~x[i] + carry;
    carry &= x[i] == 0;
  }
}

// ---- Sums of products

// Computes x += carry, modulo 2^(64 * size).
inline void add(Limb* x, int size, Limb carry) {
  for (int i = 0; i < size && carry != 0; ++i) {
    x[i] += carry;
    carry = x[i] < carry;
  }
}

inline void subtract(Limb* x, int size, Limb borrow) {
  for (int i = 0; i < size && borrow != 0; ++i) {
    const Limb old = x[i];
    x[i] -= borrow;
    borrow = old < borrow;
  }
}

// Computes x *= factor. Returns the limb that is carried out.
inline Limb multiply(Limb* x, int size, Limb factor) {
  Limb carry = 0;
  for (int i = 0; i < size; ++i) {
    const Limb2 product = Limb2{x[i]} * factor + carry;
    x[i] = static_cast<Limb>(product);
    carry = high_limb(product);
  }
  return carry;
}

// Computes sum += x * factor, modulo 2^(64 * sum_size).
inline void add_product(Limb* sum, int sum_size, const Limb* x, int size, Limb factor) {
  const int used = std::min(size, sum_size);
  Limb carry = 0;
  for (int i = 0; i < used; ++i) {
    const Limb2 product = Limb2{x[i]} * factor + sum[i] + carry;
    sum[i] = static_cast<Limb>(product);
    carry = high_limb(product);
  }
  add(sum + used, sum_size - used, carry);
}

// Computes sum -= x * factor, modulo 2^(64 * sum_size).
inline void subtract_product(Limb* sum, int sum_size, const Limb* x, int size, Limb factor) {
  const int used = std::min(size, sum_size);
  Limb borrow = 0;
  for (int i = 0; i < used; ++i) {
    const Limb2 product = Limb2{x[i]} * factor + borrow;
    const auto low = static_cast<Limb>(product);
    borrow = high_limb(product) + (sum[i] < low);
    sum[i] -= low;
  }
  subtract(sum + used, sum_size - used, borrow);
}

// Computes x *= factor in place, modulo 2^(64 * size).
inline void multiply(Limb* x, int size, const Limb* factor, int factor_size) {
  if (factor_size == 1) {
    multiply(x, size, factor[0]);
    return;
  }
  // Starts at the top limb, because the products of a limb change only limbs that have been processed.
  for (int i = size - 1; i >= 0; --i) {
    const Limb limb = x[i];
    x[i] = 0;
    if (limb != 0) add_product(x + i, size - i, factor, factor_size, limb);
  }
}

// Computes x *= factor for x >= 0 and returns the new size. x must have room for size + factor_size limbs.
inline int multiply_and_grow(Limb* x, int size, const Limb* factor, int factor_size) {
  std::fill_n(x + size, factor_size, Limb{0});
  multiply(x, size + factor_size, factor, factor_size);
  return trimmed_size(x, size + factor_size);
}

// ---- Bits of a non-negative integer

// Returns the width of a number without leading zero limbs.
inline int bit_width(const Limb* x, int size) {
  return size == 0 ? 0 : (size - 1) * kLimbBits + bit_width(x[size - 1]);
}

// Returns the bits position ... position + 63. Bits below 0 and above the top are zero.
inline Limb bits_at(const Limb* x, int size, int position) {
  const int limb = position >> 6, shift = position & 63;  // rounds down
  const auto at = [&](int i) { return i >= 0 && i < size ? x[i] : 0; };
  return shift == 0 ? at(limb) : at(limb) >> shift | at(limb + 1) << (kLimbBits - shift);
}

// Returns the number of trailing zeros of a number that is not 0.
inline int trailing_zeros(const Limb* x) {
  int zeros = 0;
  for (; *x == 0; ++x) zeros += kLimbBits;
  return zeros + std::countr_zero(*x);
}

inline void shift_right(Limb* x, int size, int bits) {
  // Each limb is read before it is written.
  for (int i = 0; i < size; ++i) x[i] = bits_at(x, size, i * kLimbBits + bits);
}

}  // namespace glev
