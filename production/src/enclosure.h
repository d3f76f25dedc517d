// The second of the three routes to a correctly rounded result: double-double arithmetic.
#pragma once

#include "double_double.h"
#include "exact.h"

namespace glev {

struct Enclosure {
  DoubleDouble value;
  double error = 0;  // |value - V| <= error; infinite or NaN where nothing is claimed
};

// With k = n + m, the degrees, an error of
//   ((90 + 3 e) k + 48) 2^-106 max|R| * (|t| + |1 - t|)^degree of both directions, plus 2^-700,
// where e is 0 for real arguments and for grids that span the domain. Else a = n (u - u1) and b = n (u2 - u)
// are sums of n (grid.u1 - u1) resp. n (u2 - grid.u1) and +-i (grid.u2 - grid.u1), with errors of 8 units of
// these parts, and e is 16 times the parts over the larger one of |a| and |b| (up to 2^40, or nothing is
// claimed). The units: a ratio 32 + 2 e, a step of Horner's rule 13 more, its power 41 + e a degree. The
// error of the ratio is absolute where the smaller one cancels; as it enters the sum by its derivative, no
// larger than degree times the sum of magnitudes at a ratio of at most 1, that makes no difference. Nothing
// is claimed where magnitudes are beyond 2^300 or 2^-300: then products of parts could leave the range.
Enclosure enclose(const Component& component, double largest, const GridArgument& u, const GridArgument& v);

// The type of Enclose, and of what a set of kernels has in its place: for maps that have at least three
// values behind the control points of a component.
using Encloses = Enclosure (*)(const Component& component, double largest, const GridArgument& u,
                               const GridArgument& v);

// One direction of it: V is power times a Horner sum in ratio, from the last point or the first.
struct PreparedDirection {
  bool from_last = false;
  DoubleDouble ratio, power{1, 0};
  double growth = 1;  // infinite where nothing is claimed
  double argument_error = 0;
};
PreparedDirection prepare_direction(const Domain& domain, const GridArgument& argument, int degree);
bool is_claimed(const PreparedDirection& in_u, const PreparedDirection& in_v, double largest);
// Returns the enclosure of a sum in both ratios, if something is claimed of it.
Enclosure enclosure_of(const DoubleDouble& sum, std::array<int, 2> degree, const PreparedDirection& in_u,
                       const PreparedDirection& in_v, double largest);

// The derivative by the normalised coordinate of a direction (0: u, 1: v), from the exact differences of
// control points: R is degree times these, and the degree in that direction is one less. Exactly zero if they
// all are.
Enclosure enclose_derivative(const Component& component, int direction, const GridArgument& u,
                             const GridArgument& v);

// The float that every number from value - error to value + error rounds to; false if there is no such float,
// signs of zeros included, or the error is not finite.
bool settle(const DoubleDouble& value, double error, float* result);

}  // namespace glev
