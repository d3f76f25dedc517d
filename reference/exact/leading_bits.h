// Rounding of what has just been computed, without making a Rational of it.
#pragma once

#include <reference/rational.h>

#include <cstdint>

namespace evalcts::reference {

// As round_to_float() and round_to_double(); Float is one of the two.
template <typename Float>
Float round_to(const Rational& x);

// The highest 64 bits of a natural number that is not zero.
struct LeadingBits {
  std::uint64_t bits;  // the highest one is set
  bool more;           // lower bits, that are cut off here, are not all zero
};

// +-(bits + something below 1 if there is more) * 2^exponent, rounded in the same way.
template <typename Float>
Float round_leading(bool negative, const LeadingBits& leading, std::int64_t exponent);

}  // namespace evalcts::reference
