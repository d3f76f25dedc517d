// A map made ready: what the routes of evaluation need of it, computed once, when a plan is made.
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
    kUnclaimed,  // a control point or the domain is not finite: values are whatever double gives
    kConstant,
    kLine,  // in one direction, the other one does not matter
    kGeneral,
  };
  Kind kind = Kind::kUnclaimed;
  Component lowest;           // of the lowest orders, for the exact routes
  double lowest_largest = 0;  // max |R| of these
  float constant = 0;
  // The form of a line: V = first + t * slope, both exact.
  int line_direction = 0;
  double first = 0, slope = 0;
  double largest = 0;  // max |R|
  // Error of an evaluation in double: |value - V| <= units * unit, where the units are those of its route,
  // times growth outside the domain. Infinite if nothing can be said.
  double unit = 0;
};

// The units of routes, for parameters of `roundings` roundings each. Underflow adds at most 2^-1074, times a
// coefficient below 2^120 max|R|, for each of some 2^13 operations, which a unit contains.
//
// Horner's rule in t / s, of a curve: 2 roundings + 1 of a ratio and 2 of a step for each degree, those of s
// and 1 of a power for each, 3 of a coefficient.
constexpr double horner_units(int n, int roundings) { return (3 * roundings + 4) * n + 4; }
// Sums of products with weights t^i s^(n-i): for each degree, the roundings of a factor, 1 of a product of
// factors and 1 of a sum; 4 of a coefficient, and products with weights and a sum of two chains of sums for
// each direction.
constexpr double weight_units(int n, int m, int roundings) { return (roundings + 2) * (n + m) + 8; }
// Roundings of parameters of locate.
inline constexpr int kRoundings = 3;
// Horner's rule in x = t - s and y, from -1 to 1, with the coefficients of centre, whose magnitudes are
// together `sum` times max|R|: 2 roundings of a step; x is off by 4 units, where the derivative is at most n
// max|R|. Coefficients that are not exact have n + 1 roundings of their own for each direction, of terms that
// are at most 2^(n+m) max|R| together.
constexpr double centred_units(int n, int m, double sum, bool is_exact) {
  return 2 * (n + m) * sum + (is_exact ? 0 : (n + m + 2) * (1 << (n + m))) + 4 * (n + m) + 8;
}
// The highest degree for which that is a good way.
inline constexpr int kMaxCentredDegree = 3;
// Values of centred coefficients, which vectors may read and write beyond.
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

// No components: no map.
struct PreparedMap {
  Surface surface;
  std::array<PreparedComponent, 4> component;
  // The test of vectors of values in double: V lies between value - error and value + error, in which the
  // roundings of these sums are contained. So where both round to the same float V does, too.
  struct Test {
    std::array<double, 4> error{};
  };
  Test test;  // of weights with parameters of locate
  // Coefficients of the powers of x and y: component k of that of x^i y^j is centred[row * j + 4 * i + k],
  // with row = 4 * (degree[0] + 1); those that the map has not are (0,0,0,1)'s. Null where a degree is too
  // high.
  const double* centred = nullptr;
  // The sum of the magnitudes of the coefficients of a component is at most 2^high and all are multiples of
  // 2^low, exactly: high - low. Horner's rule rounds nothing where these bits and those of the powers of x
  // and y are at most kExactBits together. kManyBits if they are not exact or their magnitudes are extreme.
  std::array<int, 4> centred_bits{};
  std::array<double, 4> centred_sum{};  // at least that of the magnitudes
  // The test of Horner's rule with those, inside the domain. Not below `test`, from which is_direct follows:
  // control points are blossoms at -1 and 1, so none is larger than the sum of the coefficients' magnitudes.
  Test centred_test;
  // 1 / (u2 - u1) of each direction where that and u1 + u2 are exact, else 0.
  std::array<double, 2> inverse_width{};
  Encloses encloses = enclose;
  // Sums that are these only in rounding to nearest. In memory, as compilers take that for granted.
  struct Probe {
    std::array<double, 2> first = {1, 1}, second = {0x1p-54, 0x3p-54}, sum = {1, 1 + 0x1p-52};
  };
  Probe probe;
  // Evaluation in double reads and settles no subnormal number, so that nothing is flushed to zero that
  // counts.
  bool is_direct = false;
};

// A cubic or bicubic map of vertices for one call after another, where the inverse of each width is exact.
struct DirectMap {
  // x = u * scale - middle
  struct Place {
    double scale = 0, middle = 0;
  };
  std::array<Place, 2> place;
};

// Control points without padding, v fastest, `points`; the arrays are the caller's: `scaled` has room for
// three values more, `lowest` for as many, `centred` for centred_values where both degrees are low.
PreparedMap prepare_map(const double* points, std::array<int, 2> order, int components,
                        const std::array<Domain, 2>& domain, double* scaled, double* lowest, double* centred);

// Tells if a map of vertices has a direct map, and returns it.
bool has_direct_map(const PreparedMap& map);
DirectMap direct_map_of(const PreparedMap& map);

// // Component k inside the domain, where doubles hold all that Horner's rule computes, which is where ties
// and zeros are ordinary: at dyadic places, and along lines at such places where it is constant. False, and
// nothing claimed, elsewhere.
bool evaluate_exactly(const PreparedMap& map, int k, const GridArgument& u, const GridArgument& v,
                      double* value);

// The bits behind the point of x at all points of a grid inside the domain, at most; kManyBits if they are
// not known to be dyadic.
int bits_of_places(const Domain& domain, const Grid& grid);

// (|t| + |1 - t|)^degree: what an error inside the domain is multiplied with outside; rounded upward. At
// least 1.
double growth_of(const Parameter& at, int degree);

// The test of values within units * unit * growth of V; infinite, and so never passed, where that claims
// nothing.
PreparedMap::Test make_test(const PreparedMap& map, double units, double growth);

}  // namespace glev
