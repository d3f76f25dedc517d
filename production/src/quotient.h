// Rounds a quotient of integers to the nearest float or double.
#pragma once

#include <array>

#include "wide_integer.h"

namespace glev {

struct IntegerPower {
  const Limb* base;  // positive, without leading zero limbs
  int size;          // limbs of the base
  int exponent;      // 0..63
};

// The factors of a denominator.
using Denominator = std::array<const IntegerPower*, 4>;

// +-numerator * 2^exponent / denominator
struct Quotient {
  const Limb* numerator;  // positive, without leading zero limbs
  int size;
  bool negative;
  int exponent;
  Denominator denominator;
};

// Returns the number of limbs of scratch memory that round_quotient() needs.
int rounding_room(const Denominator& denominator);

// Rounds once to nearest, ties to even. Overflow gives infinity, underflow is gradual, and zero keeps the
// sign. The leading 128 bits of the numerator and 63 of the denominator are sufficient, unless the quotient
// is within about 2^-61 * (sum of exponents) of the midpoint of two floats; then the denominator is
// multiplied out. Real: float or double.
template <class Real>
Real round_quotient(const Quotient& quotient, Limb* room);

}  // namespace glev
