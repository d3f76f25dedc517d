// Numbers as the vectors write them (INTERPRETING.md, "Numbers").
#pragma once

#include <reference/rational.h>

#include <optional>
#include <string>

namespace evalcts::vectors {

// "0x1.8p-3", "-0x0p+0", "inf": one digit before the point, no zeros at the end. Floats are given as doubles,
// which is exact. Throws std::domain_error for NaN.
std::string hexadecimal(double value);

// "-3/8": in lowest terms, the denominator positive and always there.
std::string fraction(const reference::Rational& x);

// The least and the greatest finite floats within `bound` >= 0 of `exact`; zero is +0. None if there is none.
struct Interval {
  float low, high;
};
std::optional<Interval> accepted(const reference::Rational& exact, const reference::Rational& bound);

// The least binary32 that is not below x. Throws std::domain_error beyond the largest.
float round_up(const reference::Rational& x);

}  // namespace evalcts::vectors
