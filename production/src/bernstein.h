// Polynomials in Bernstein form, in double.
#pragma once

#include <array>

#include "parameter.h"

namespace glev {

// sum of C(degree, i) * t^i * s^(degree - i) * R_i over points R_i of 1 to 4 components.
struct Curve {
  int degree = 0;
  int components = 0;  // 0: no curve
  Domain domain;
  const double* scaled = nullptr;  // C(degree, i) * R_i, point after point
};

// The tensor product: for every v a curve in u. Of degree 0 in v it is one curve, the same for every v.
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

// scaled[i][j] = C(order[0] - 1, i) * C(order[1] - 1, j) * points[i][j], v fastest; orders from 1 to 64.
// scaled may be points.
void scale_by_binomials(const double* points, std::array<int, 2> order, int components, double* scaled);

// Writes curve.components values. The ends of the domain give the first and last control point bit for bit; a
// curve of degree 0 gives its control point everywhere. Elsewhere, with u = 2^-53,
//   |error| <= (13 * degree + 4) * u * (1 + O(u)) * sum of C(degree, i) * |t^i * s^(degree - i) * R_i|
// as long as nothing overflows or becomes subnormal. Never traps or loops on non-finite values.
void evaluate(const Curve& curve, const Parameter& at, double* result);

// The curve in u at one v: point i is the curve in v of row i of the net, by the rule above. Then Evaluate
// gives the point of the surface; |error| is at most
//   (13 * (degree[0] + degree[1]) + 8) * u * (1 + O(u)) * sum of |terms|.
// This order, v before u, is the only one used, so a point has the same bits wherever it is needed. As both
// steps copy at the ends, the four boundary curves have the bits of the curves of the boundary points,
// whichever direction and end they are reached by. room: (degree[0] + 1) * components doubles, which the
// curve then uses unless degree[1] is 0.
Curve curve_at(const Surface& surface, const Parameter& v, double* room);

}  // namespace glev
