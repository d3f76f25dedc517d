// Doubles and integers as binary digits.
#pragma once

#include <reference/rational.h>

#include <cstdint>
#include <span>

namespace evalcts::reference {

// The number significand * 2^exponent with an odd significand, or 0 * 2^0.
struct Binary {
  std::int64_t significand;
  int exponent;
};

// Decomposes a double. Throws std::domain_error if x is not finite.
Binary decompose(double x);

// Returns the smallest exponent of the nonzero numbers; 0 if all are zero.
int common_exponent(std::span<const Binary> numbers);

// Returns the number of trailing zero bits of |x|; 0 for zero.
unsigned trailing_zeros(const Integer& x);

}  // namespace evalcts::reference
