// Polynomials in Bernstein form, in double.
#pragma once

#include <array>

#include "parameter.h"

namespace glev {

// A curve: the sum of C(degree, i) * t^i * s^(degree - i) * R_i, with control points R_i of 1 to 4
// components.
struct Curve {
  int degree = 0;
  int components = 0;  // 0: no curve
  Domain domain;
  const double* scaled = nullptr;  // C(degree, i) * R_i, all components of a point adjacent
};

// A surface: a tensor product, which is a curve in u for every v. If the degree in v is 0, the curve is the
// same for every v.
struct Surface {
  std::array<int, 2> degree{};  // in u and v
  int components = 0;           // 0: no surface
  std::array<Domain, 2> domain;
  const double* scaled = nullptr;  // C(degree[0], i) * C(degree[1], j) * R_ij, v fastest
};

// Writes t^i s^(degree - i) for i from 0 to degree.
inline void scalar_weights(int degree, double s, double t, double* weights) {
  weights[0] = 1;
  for (int i = 1; i <= degree; ++i) weights[i] = weights[i - 1] * t;
  double power = s;
  for (int i = degree - 1; i >= 0; --i, power *= s) weights[i] *= power;
}

// Writes scaled[i][j] = C(order[0] - 1, i) * C(order[1] - 1, j) * points[i][j], v fastest. Orders are 1 to
// 64. `scaled` may be equal to `points`.
void scale_by_binomials(const double* points, std::array<int, 2> order, int components, double* scaled);

// Writes the curve.components values at `at`. At the ends of the domain, these are the first and last control
// point bit for bit; a curve of degree 0 has its control point everywhere. Elsewhere, with u = 2^-53,
//   |error| <= (13 * degree + 4) * u * (1 + O(u)) * sum of C(degree, i) * |t^i * s^(degree - i) * R_i|
// as long as nothing overflows or becomes subnormal. Never traps or loops on non-finite values.
void evaluate(const Curve& curve, const Parameter& at, double* result);

// Returns the curve in u at one v: control point i is the curve in v of row i of the net, by the rule above.
// evaluate() of this curve is the point of the surface, with an |error| of at most
//   (13 * (degree[0] + degree[1]) + 8) * u * (1 + O(u)) * sum of |terms|.
// No code uses another order than v before u, so a point always has the same bits. Because both steps copy
// control points at the ends, the four boundary curves have the bits of the curves of the boundary points.
// `room`: (degree[0] + 1) * components doubles, to which the returned curve refers unless degree[1] is 0.
Curve curve_at(const Surface& surface, const Parameter& v, double* room);

}  // namespace glev
