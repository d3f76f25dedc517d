// Correct rounding of exact values, and the two error measures.
#pragma once

#include <reference/rational.h>

namespace evalcts::reference {

// Return the correctly rounded value (IEEE 754 roundTiesToEven) with gradual underflow. Values from half an
// ULP above the largest finite number on overflow to infinity (binary32: |x| >= 2^128 - 2^103, binary64: |x|
// >= 2^1024 - 2^970). Zero gives +0; other values that round to zero keep their sign.
float round_to_float(const Rational& x);
double round_to_double(const Rational& x);

// Returns the nearest integer, ties to even.
Integer round_to_integer(const Rational& x);

// Returns the ULP of x for binary32 (Harrison): b - a for the closest adjacent floats a <= x <= b, a < b, so
// the smaller gap at a power of two; 2^-149 for |x| <= 2^-126; 2^104 above 2^127, infinity counted as 2^128.
Rational ulp(const Rational& x);

// Returns |got - exact| / ulp(exact), rounded to the nearest double. An infinite `got`, and an `exact` beyond
// 2^128, count as 2^128 of their sign; NaN is infinitely far away.
double ulp_distance(float got, const Rational& exact);

// Returns the condition-aware error |got - exact| / (2^-24 * magnitude), which does not explode under
// cancellation; `magnitude` is the sum of |B_i| * |R_i|, >= 0. For magnitude 0: 0 if got equals exact, else
// infinity. Infinity and NaN as above.
double condition_distance(float got, const Rational& exact, const Rational& magnitude);

}  // namespace evalcts::reference
