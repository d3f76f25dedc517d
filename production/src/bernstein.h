// Polynomials in Bernstein form, in double.
#pragma once

#include "production/src/parameter.h"

namespace glev {

// sum of C(degree, i) * t^i * s^(degree - i) * R_i over points R_i of 1 to 4 components.
struct Curve {
  int degree = 0;
  int components = 0;  // 0: no curve
  Domain domain;
  const double* scaled = nullptr;  // C(degree, i) * R_i, point after point
};

// scaled[i] = C(order - 1, i) * points[i]; order from 1 to 64.
void ScaleByBinomials(const double* points, int order, int components, double* scaled);

// Writes curve.components values. The ends of the domain give the first and last control point bit for bit; a
// curve of degree 0 gives its control point everywhere. Elsewhere, with u = 2^-53,
//   |error| <= (13 * degree + 4) * u * (1 + O(u)) * sum of C(degree, i) * |t^i * s^(degree - i) * R_i|
// as long as nothing overflows or becomes subnormal. Never traps or loops on non-finite values.
void Evaluate(const Curve& curve, const Parameter& at, double* result);

}  // namespace glev
