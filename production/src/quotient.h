// The float or double nearest a quotient of integers.
#pragma once

#include <array>

#include "wide_integer.h"

namespace glev {

struct IntegerPower {
  const Limb* base;  // positive, without leading zero limbs
  int size;          // of the base
  int exponent;      // 0..63
};

// +-numerator * 2^exponent / (*denominator[0] * *denominator[1])
struct Quotient {
  const Limb* numerator;  // positive, without leading zero limbs
  int size;
  bool negative;
  int exponent;
  std::array<const IntegerPower*, 2> denominator;
};

// The number of limbs that Round needs to work in.
int rounding_room(const IntegerPower& first, const IntegerPower& second);

// To nearest, ties to even, once: overflow gives infinity, underflow is gradual, the sign stays. The leading
// 128 bits of the numerator and 63 of the denominator decide, unless the quotient is within about 2^-61 *
// (sum of exponents) of the middle between two floats: then everything is multiplied out. Real: float or
// double.
template <class Real>
Real round_quotient(const Quotient& quotient, Limb* room);

}  // namespace glev
