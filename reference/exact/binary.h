// Integers seen as strings of binary digits.
#pragma once

#include <reference/rational.h>

#include <cstdint>
#include <span>

namespace evalcts::reference {

// significand * 2^exponent with an odd significand, or 0 * 2^0.
struct Binary {
  std::int64_t significand;
  int exponent;
};

// Throws std::domain_error if x is not finite.
Binary decompose(double x);

// The least exponent of the numbers that are not zero; 0 if all are.
int common_exponent(std::span<const Binary> numbers);

// The number of zero bits below the lowest one of |x|; 0 for zero.
unsigned trailing_zeros(const Integer& x);

}  // namespace evalcts::reference
