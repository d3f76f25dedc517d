// Formats floats and fractions, and rounds intervals inward.
#include "text.h"

#include <reference/rounding.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include <evalcts/gl/hexadecimal.h>

namespace evalcts::vectors {

using reference::Integer;
using reference::Rational;

std::string hexadecimal(double value) {
  if (std::isnan(value)) throw std::domain_error("NaN has no place in a vector");
  return evalcts::hexadecimal(value);
}

std::string fraction(const Rational& x) {
  Integer numerator = x.numerator(), denominator = x.denominator();
  const Integer common = gcd(numerator, denominator);
  numerator /= common;
  denominator /= common;
  // Both are odd (or the numerator is zero), so that the power of two belongs to one of them entirely.
  if (x.is_zero()) return "0/1";
  (x.exponent() >= 0 ? numerator : denominator) <<= static_cast<unsigned>(std::abs(x.exponent()));
  return numerator.str() + "/" + denominator.str();
}

namespace {

constexpr float kLargest = std::numeric_limits<float>::max();

// Returns the least float that is not below x. x is at most kLargest.
float least_not_below(const Rational& x) {
  if (x < Rational(-kLargest)) return -kLargest;
  const float nearest = reference::round_to_float(x);
  const float up = std::isfinite(nearest) && Rational(nearest) >= x
                       ? nearest
                       : std::nextafter(nearest, std::numeric_limits<float>::infinity());
  return up == 0 ? 0.0f : up;
}

}  // namespace

float round_up(const Rational& x) {
  if (x > Rational(kLargest)) throw std::domain_error("beyond the largest float");
  return least_not_below(x);
}

std::optional<Interval> accepted(const Rational& exact, const Rational& bound) {
  const Rational low = exact - bound, high = exact + bound;
  if (low > Rational(kLargest) || high < Rational(-kLargest)) return std::nullopt;
  const float downward = -least_not_below(-high);
  const Interval interval{least_not_below(low), downward == 0 ? 0.0f : downward};
  if (interval.low > interval.high) return std::nullopt;
  return interval;
}

}  // namespace evalcts::vectors
