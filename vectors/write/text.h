// Writes numbers as the files have them (INTERPRETING.md, "Numbers").
#pragma once

#include <reference/rational.h>

#include <optional>
#include <string>

namespace evalcts::vectors {

// Returns a number as in "0x1.8p-3", "-0x0p+0" or "inf": one digit before the point, no trailing zeros.
// Throws std::domain_error for NaN.
std::string hexadecimal(double value);

// Returns a number as in "-3/8" or "2/1": in lowest terms, always with a denominator, which is positive.
std::string fraction(const reference::Rational& x);

struct Interval {
  float low, high;
};
// Returns the least and the greatest finite float within `bound` >= 0 of `exact`, or nothing if there is
// none. Zero is +0.
std::optional<Interval> accepted(const reference::Rational& exact, const reference::Rational& bound);

// Returns the least binary32 that is not below x. Throws std::domain_error if x is above the largest one.
float round_up(const reference::Rational& x);

}  // namespace evalcts::vectors
