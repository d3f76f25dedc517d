// Correct rounding of values that evaluation in double cannot decide.
#pragma once

#include "parameter.h"
#include "prepared_map.h"

namespace glev {

// Returns component k of the map at (u, v): V rounded to nearest, ties to even; +0 for 0. Tries exact
// evaluation in double, exact evaluation of lines, double-double, and finally integers. If the map or the
// arguments are not finite, the result is computed in double.
float resolve(const PreparedMap& map, int k, const GridArgument& u, const GridArgument& v);
// The same if a value in double and its error bound are known, which may already decide the result. The bound
// may be infinity.
float resolve(const PreparedMap& map, int k, const GridArgument& u, const GridArgument& v, double value,
              double error);

// Returns the component as a double within one ULP (GLEV_DOUBLE of glevaluator.h), by double-double or, if
// that has no sufficient bound, exactly.
double resolve_in_double(const PreparedMap& map, int k, const GridArgument& u, const GridArgument& v);

// Returns a partial derivative of component k, rounded as above: correctly to float, or to a double within
// one ULP. `value` and `error` are as above.
template <class Real>
Real resolve_derivative(const PreparedMap& map, const Derivative& derivative, int k, const GridArgument& u,
                        const GridArgument& v, double value, double error);

}  // namespace glev
