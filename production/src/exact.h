// Exact evaluation of polynomials in Bernstein form, rounded once. It is used if faster methods cannot decide
// the result.
#pragma once

#include <array>
#include <cstddef>

#include "parameter.h"

namespace glev {

// One component of a map. Control point (i, j) is points[(i * order[1] + j) * stride].
struct Component {
  const double* points;  // finite
  std::ptrdiff_t stride;
  std::array<int, 2> order;      // in u and v, 1..64; a curve is of order 1 in v
  std::array<Domain, 2> domain;  // ignored in a direction of order 1
};

// Returns V = sum of C(n, i) C(m, j) t_u^i (1 - t_u)^(n - i) t_v^j (1 - t_v)^(m - j) R_ij, where t_u is the
// real number (u - u1) / (u2 - u1) and t_v likewise, rounded once: to nearest, ties to even, with gradual
// underflow, and to infinity if |V| >= 2^128 - 2^103. V = 0 gives +0; another V that rounds to zero keeps its
// sign.
//
// With a derivative {a, b}, a + b <= 2, V is the partial derivative of order a in u and b in v instead. In a
// direction of order 1, the domain must then be valid as well.
//
// Arguments must be finite, with indices of at most 33 bits, and may lie outside the domain. A real argument
// u is {{u, u, 1}, 0}. Uses only stack memory: about 2 KB in ordinary cases, at most 90 KB. Computes in
// integers, so the rounding mode of the caller has no effect. Real is float or double, with the limits of
// that type.
template <class Real = float>
Real round_exactly(const Component& component, const GridArgument& u, const GridArgument& v,
                   const std::array<int, 2>& derivative = {});

}  // namespace glev
