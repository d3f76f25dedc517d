// The second of the three routes to a correctly rounded result: double-double arithmetic.
#pragma once

#include <cstdint>

#include "binomials.h"
#include "double_double.h"
#include "exact.h"

namespace glev {

struct Enclosure {
  DoubleDouble value;
  double error = 0;  // |value - V| <= error; infinity or NaN means no bound
};

// Encloses V. `largest` is max|R|. With k = n + m, the sum of the degrees, the error is
//   ((90 + 3 e) k + 48) 2^-106 max|R| * (|t| + |1 - t|)^degree of both directions, plus 2^-700,
// where e is 0 for real arguments and for grids that span the domain. For other grids, a = n (u - u1) and b =
// n (u2 - u) are sums of n (grid.u1 - u1) or n (u2 - grid.u1) and +-i (grid.u2 - grid.u1), with errors of 8
// units of these terms, and e is 16 times the sum of the terms over the larger of |a| and |b| (at most 2^40,
// otherwise there is no bound). The units are 32 + 2 e for a ratio, 13 more for a step of Horner's rule, and
// 41 + e per degree for its power. If the smaller of a and b cancels, the error of the ratio is absolute.
// This makes no difference, because it enters the sum with the derivative, which is at most degree times the
// sum of magnitudes at a ratio of at most 1. There is no bound if magnitudes are above 2^300 or below 2^-300,
// because products could then leave the range of double.
Enclosure enclose(const Component& component, double largest, const GridArgument& u, const GridArgument& v);

// Returns C(n, i), which is below 2^60 and so a sum of two doubles.
inline DoubleDouble exact_binomial(int n, int i) {
  const std::uint64_t binomial = binomial_row(n)[i];
  return fast_two_sum(static_cast<double>(binomial & ~0xFFFull), static_cast<double>(binomial & 0xFFF));
}

// The type of enclose() and of its counterpart in the kernels, which requires at least three readable values
// behind the control points of a component.
using Encloses = Enclosure (*)(const Component& component, double largest, const GridArgument& u,
                               const GridArgument& v);

// One direction of an enclosure: V is `power` times a Horner sum in `ratio`, from the last or the first
// point.
struct PreparedDirection {
  bool from_last = false;
  DoubleDouble ratio, power{1, 0};
  double growth = 1;  // infinity if there is no bound
  double argument_error = 0;
};
PreparedDirection prepare_direction(const Domain& domain, const GridArgument& argument, int degree);
bool is_claimed(const PreparedDirection& in_u, const PreparedDirection& in_v, double largest);
// Returns the enclosure of a sum in both ratios. Requires is_claimed().
Enclosure enclosure_of(const DoubleDouble& sum, std::array<int, 2> degree, const PreparedDirection& in_u,
                       const PreparedDirection& in_v, double largest);

// The orders of a partial derivative in u and v. Their sum is 1 or 2.
using Derivative = std::array<int, 2>;

// Encloses a derivative with respect to the normalised coordinates. For each order, its control points are
// differences of control points, times the degree. Differences of first order are exact. The result is
// exactly zero if all differences of first order are zero.
Enclosure enclose_derivative(const Component& component, const Derivative& derivative, const GridArgument& u,
                             const GridArgument& v);

// Computes the float to which every number from value - error to value + error rounds. Returns false if there
// is no such float (+0 and -0 are different) or the error is not finite.
bool settle(const DoubleDouble& value, double error, float* result);

}  // namespace glev
