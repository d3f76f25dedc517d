// From exact values to floating-point numbers and back: correct rounding, and the two measures of error.
#pragma once

#include <reference/rational.h>

namespace evalcts::reference {

// Correct rounding (IEEE 754 roundTiesToEven) with gradual underflow. Overflows to infinity from half an ULP
// above the largest finite number on (binary32: |x| >= 2^128 - 2^103, binary64: |x| >= 2^1024 - 2^970). Zero
// gives +0; anything else that rounds to zero keeps its sign.
float round_to_float(const Rational& x);
double round_to_double(const Rational& x);

// The nearest integer, ties to even.
Integer round_to_integer(const Rational& x);

// ULP for binary32 after Harrison: b - a for the closest adjacent floats a <= x <= b, a < b, so the smaller
// gap at a power of two; 2^-149 for |x| <= 2^-126; 2^104 above 2^127, infinity counted as 2^128.
Rational ulp(const Rational& x);

// |got - exact| / ulp(exact), to the nearest double. An infinite `got` counts as 2^128 of its sign; NaN is
// infinitely far away.
double ulp_distance(float got, const Rational& exact);

// |got - exact| / (2^-24 * magnitude), the error in units that do not explode under cancellation; `magnitude`
// is the sum of |B_i| * |R_i|, >= 0. For magnitude 0: 0 if got equals exact, else infinity. Infinity and NaN
// as above.
double condition_distance(float got, const Rational& exact, const Rational& magnitude);

}  // namespace evalcts::reference
