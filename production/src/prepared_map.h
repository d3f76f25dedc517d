// A prepared map: the data that the methods of evaluation need, computed once when a plan is made.
#pragma once

#include <array>
#include <cmath>

#include "bernstein.h"
#include "enclosure.h"
#include "exact.h"
#include "parameter.h"

namespace glev {

// One component of the control points. V is the exact value of its polynomial.
struct PreparedComponent {
  enum class Kind {
    kUnclaimed,  // a control point or the domain is not finite: double, without a bound
    kConstant,
    kLine,  // linear in one direction, constant in the other one
    kGeneral,
  };
  Kind kind = Kind::kUnclaimed;
  Component lowest;           // with the lowest orders, for the exact routes
  double lowest_largest = 0;  // max |R| of `lowest`
  float constant = 0;
  // The form of a line: V = first + t * slope, both exact.
  int line_direction = 0;
  double first = 0, slope = 0;
  double largest = 0;  // max |R|
  // The error of an evaluation in double is |value - V| <= units * unit, times the growth outside the domain;
  // the number of units depends on the method. Infinity if there is no bound.
  double unit = 0;
};

// The units of the methods, for parameters of `roundings` roundings each. Underflow adds at most 2^-1074,
// times a coefficient below 2^120 max|R|, for each of about 2^13 operations. A unit covers this.
//
// Horner's rule in t / s, of a curve. For each degree there are 2 roundings + 1 of a ratio, 2 of a step, and
// those of s and 1 of a power; in addition, 3 of a coefficient.
constexpr double horner_units(int n, int roundings) { return (3 * roundings + 4) * n + 4; }
// Sums of products with weights t^i s^(n-i). For each degree there are the roundings of a factor, 1 of a
// product of factors and 1 of a sum; in addition, 4 of a coefficient and, for each direction, 1 of the
// product with a weight and 1 of the sum of two chains.
constexpr double weight_units(int n, int m, int roundings) { return (roundings + 2) * (n + m) + 8; }
// The number of roundings of the parameters of locate().
inline constexpr int kRoundings = 3;
// Horner's rule in x = t - s and y, from -1 to 1, with the coefficients of centre(), whose magnitudes have
// the sum `sum` times max|R|. A step has 2 roundings. x has an error of 4 units, and the derivative is at
// most n max|R|. Coefficients that are not exact have n + 1 roundings for each direction, of terms whose sum
// is at most 2^(n+m) max|R|.
constexpr double centred_units(int n, int m, double sum, bool is_exact) {
  return 2 * (n + m) * sum + (is_exact ? 0 : (n + m + 2) * (1 << (n + m))) + 4 * (n + m) + 8;
}
// The highest degree for which this method is used.
inline constexpr int kMaxCentredDegree = 3;
// Returns the number of values of centred coefficients, with padding that vectors may read and write.
constexpr int centred_values(int n, int m) { return 4 * (n + 1) * (m + 1) + 8; }
// The range in which evaluation in double neither overflows nor loses significant bits to underflow.
inline constexpr double kLargestOrdinary = 0x1p900, kSmallestOrdinary = 0x1p-900;
inline bool is_ordinary(const Domain& domain) {
  const double width = std::fabs(domain.u2 - domain.u1);
  return std::fabs(domain.u1) <= kLargestOrdinary && std::fabs(domain.u2) <= kLargestOrdinary &&
         width >= kSmallestOrdinary;
}
// Bits of the significand of a double; and a number larger than any other.
inline constexpr int kExactBits = 53, kManyBits = 1 << 20;

// A prepared map. It has no components if there is no map.
struct PreparedMap {
  Surface surface;
  std::array<PreparedComponent, 4> component;
  // The rounding test of values in double: V is between value - error and value + error. The error covers the
  // roundings of these sums. So if both sums round to the same float, V does, too.
  struct Test {
    std::array<double, 4> error{};
  };
  Test test;  // for sums of weights with the parameters of locate()
  // Coefficients of the powers of x and y: component k of that of x^i y^j is centred[row * j + 4 * i + k],
  // with row = 4 * (degree[0] + 1). Components that the map does not have are those of (0,0,0,1). Null if a
  // degree is too high.
  const double* centred = nullptr;
  // high - low, where the sum of the magnitudes of the coefficients of a component is at most 2^high and all
  // are exact multiples of 2^low. Horner's rule does not round if these bits and those of the powers of x and
  // y are at most kExactBits together. kManyBits if coefficients are not exact or have extreme magnitudes.
  std::array<int, 4> centred_bits{};
  std::array<double, 4> centred_sum{};  // at least the sum of the magnitudes
  // The test of Horner's rule with these coefficients, inside the domain. It is not below `test`, so
  // is_direct is valid for it, too: control points are blossoms at -1 and 1, so none is larger than the sum
  // of the magnitudes of the coefficients.
  Test centred_test;
  // 1 / (u2 - u1) of each direction if that and u1 + u2 are exact, otherwise 0.
  std::array<double, 2> inverse_width{};
  Encloses encloses = enclose;
  // Sums that have these values only if rounding is to nearest. They are in memory, because compilers assume
  // rounding to nearest.
  struct Probe {
    std::array<double, 2> first = {1, 1}, second = {0x1p-54, 0x3p-54}, sum = {1, 1 + 0x1p-52};
  };
  Probe probe;
  // If a direction has an inverse width, x = u * scale - middle has one rounding.
  struct Place {
    double scale = 0, middle = 0;
  };
  std::array<Place, 2> place;
  // True if evaluation in double neither reads subnormal numbers nor accepts subnormal results, so that
  // flush-to-zero has no effect.
  bool is_direct = false;
};

// Prepares the map with the control points `points`, without padding, v fastest. The caller provides the
// arrays: `scaled` with three more values than `points`, `lowest` with as many, and `centred` with
// centred_values() if both degrees are low.
PreparedMap prepare_map(const double* points, std::array<int, 2> order, int components,
                        const std::array<Domain, 2>& domain, double* scaled, double* lowest, double* centred);

// Evaluates component k exactly if Horner's rule does not round: inside the domain, at dyadic x and y, or
// along lines at a dyadic x or y on which the component is constant. Ties and zeros are frequent there.
// Returns false otherwise; `value` is then undefined.
bool evaluate_exactly(const PreparedMap& map, int k, const GridArgument& u, const GridArgument& v,
                      double* value);

// Returns the largest number of fractional bits of x at the points of a grid inside the domain; kManyBits if
// they are not known to be dyadic.
int bits_of_places(const Domain& domain, const Grid& grid);

// Returns (|t| + |1 - t|)^degree, the factor of errors outside the domain, rounded upward. At least 1.
double growth_of(const Parameter& at, int degree);

// Returns the test of values within units * unit * growth of V. Its error is infinity, so that no value
// passes, if there is no bound.
PreparedMap::Test make_test(const PreparedMap& map, double units, double growth);

}  // namespace glev
