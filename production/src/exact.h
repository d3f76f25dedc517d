// Polynomials in Bernstein form, exactly, rounded once: for the arguments at which double does not say which
// float is the nearest, or more is asked for than it can say.
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
  std::array<Domain, 2> domain;  // that of a direction of order 1 is not looked at
};

// V = sum of C(n, i) C(m, j) t_u^i (1 - t_u)^(n - i) t_v^j (1 - t_v)^(m - j) R_ij, where t_u is the real
// number (u - u1) / (u2 - u1) and t_v likewise, rounded once: to nearest, ties to even, |V| >= 2^128 - 2^103
// to infinity, gradually to subnormal numbers. V = 0 gives +0; another V that rounds to zero keeps its sign.
//
// Arguments are finite, inside the domain or not, with indices of at most 33 bits. A plain argument u is
// {{u, u, 1}, 0}. Takes only memory of the stack, up to 90 KB in the worst of cases and 2 KB in ordinary
// ones. Integers alone decide: the rounding mode of the caller has no influence. Real: float, or double, to
// which the same applies with its limits.
template <class Real = float>
Real round_exactly(const Component& component, const GridArgument& u, const GridArgument& v);

}  // namespace glev
