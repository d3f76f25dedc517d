// Rounds natural numbers of any size by their leading 64 bits, without constructing a Rational.
#pragma once

#include <reference/rational.h>

#include <cstdint>

namespace evalcts::reference {

// Same as round_to_float() for Float = float, and round_to_double() for Float = double.
template <typename Float>
Float round_to(const Rational& x);

// The highest 64 bits of a natural number that is not zero.
struct LeadingBits {
  std::uint64_t bits;  // the highest one is set
  bool more;           // the truncated lower bits are not all zero
};

// Rounds +-(bits + f) * 2^exponent in the same way, where f = 0, or 0 < f < 1 if `more`.
template <typename Float>
Float round_leading(bool negative, const LeadingBits& leading, std::int64_t exponent);

}  // namespace evalcts::reference
