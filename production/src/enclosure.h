// The second of the three routes to a correctly rounded result: double-double arithmetic.
#pragma once

#include "production/src/double_double.h"
#include "production/src/exact.h"

namespace glev {

struct Enclosure {
  DoubleDouble value;
  double error = 0;  // |value - V| <= error; infinite or NaN where nothing is claimed
};

// With k = n + m, the degrees, an error of
//   ((90 + 3 e) k + 48) 2^-106 max|R| * (|t| + |1 - t|)^degree of both directions, plus 2^-700,
// where e is 0 for real arguments and for grids that span the domain, else 2^10 (for other grids where
// cancellation makes it more, nothing is claimed). The units: a ratio 32 + 2 e, a step of Horner's rule 13
// more, its power 41 + e a degree. Nothing is claimed where magnitudes are beyond 2^300 or 2^-300: then
// products of parts could leave the range.
Enclosure Enclose(const Component& component, double largest, const GridArgument& u, const GridArgument& v);

// The float that every number from value - error to value + error rounds to; false if there is no such float,
// signs of zeros included, or the error is not finite.
bool Settle(const DoubleDouble& value, double error, float* result);

}  // namespace glev
