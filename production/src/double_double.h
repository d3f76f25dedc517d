// Double-double arithmetic: numbers are unevaluated sums high + low of two doubles, where `high` is the
// double nearest the sum.
//
// Algorithms of Knuth, Dekker and Veltkamp; see Joldes, Muller, Popescu, "Tight and rigorous error bounds for
// basic building blocks of double-word arithmetic" (ACM TOMS 44, 2017). Errors are in units of u^2 = 2^-106
// and hold if nothing overflows and no product is below 2^-960. All functions require rounding to nearest.
#pragma once

#include <cmath>

#include "mutation_point.h"

namespace glev {

struct DoubleDouble {
  double high = 0, low = 0;

  DoubleDouble operator-() const { return {-high, -low}; }
};

inline DoubleDouble fast_two_sum(double x, double y) {  // |x| >= |y|, or x = 0; exact
  const double sum = x + y;
  return {sum, y - (sum - x)};
}

inline DoubleDouble two_sum(double x, double y) {  // exact
  const double sum = x + y, part = sum - x;
  return {sum, (x - (sum - part)) + (y - part)};
}

inline DoubleDouble two_product(double x, double y) {  // exact up to 2^995
  const auto split = [](double z) {
    const double shifted = z * (0x1p27 + 1), high = shifted - (shifted - z);
    return DoubleDouble{high, z - high};
  };
  const double product = x * y;
  const DoubleDouble a = split(x), b = split(y);
  const double rest = ((a.high * b.high - product) + a.high * b.low) + a.low * b.high;
  return {product, rest + GLEV_AT(last_product, a.low * b.low)};
}

// |error| <= 4 units of |x| + |y|.
inline DoubleDouble operator+(const DoubleDouble& x, const DoubleDouble& y) {
  const DoubleDouble sum = two_sum(x.high, y.high);
  return two_sum(sum.high, sum.low + (x.low + y.low));
}

inline DoubleDouble operator-(const DoubleDouble& x, const DoubleDouble& y) { return x + -y; }

// |error| <= 9 units of |x * y|.
inline DoubleDouble operator*(const DoubleDouble& x, const DoubleDouble& y) {
  const DoubleDouble product = two_product(x.high, y.high);
  return fast_two_sum(product.high, product.low + (x.high * y.low + x.low * y.high));
}

// |error| <= 4 units of |x * y|.
inline DoubleDouble operator*(const DoubleDouble& x, double y) {
  const DoubleDouble product = two_product(x.high, y);
  return fast_two_sum(product.high, product.low + x.low * y);
}

// |error| <= 32 units of |x / y|.
inline DoubleDouble operator/(const DoubleDouble& x, const DoubleDouble& y) {
  const double quotient = x.high / y.high;
  const DoubleDouble rest = x - y * quotient;
  return fast_two_sum(quotient, rest.high / y.high);
}

// Returns base^exponent for exponents >= 0. Number is double or DoubleDouble.
template <class Number>
Number raise_to_power(Number base, int exponent) {
  Number power = {1};
  for (;; base = base * base) {
    if (exponent & 1) power = power * base;
    exponent >>= 1;
    if (exponent == 0) return power;
  }
}

}  // namespace glev
