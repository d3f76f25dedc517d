// Exact evaluation of the polynomials of the evaluators (GL 2.1 section 5.1): for a map of order n + 1,
//
//   p(u) = SUM i=0..n of B(n,i,t) * R_i,   B(n,i,t) = C(n,i) * t^i * (1-t)^(n-i),   t = (u - u1) / (u2 - u1),
//
// with 0^0 = 1, for any finite u, inside the domain or not (EV-MAP1-BEZIER, EV-MAP1-ZEROPOW, EV-MAP1-DOMAIN,
// EV-MAP1-EXTRAPOLATE), and the tensor product of two of them for surfaces (EV-MAP2-BEZIER).
//
// Every function throws std::invalid_argument if an order is outside 1..kMaxOrder, and std::domain_error if a
// domain is empty (u1 = u2) or an argument, a domain end or a control value is not finite. The functions
// is_finite() check the last condition.
//
// A one-dimensional map is a surface of order 1 in v. It does not depend on v.
#pragma once

#include <cstddef>
#include <cstdint>

#include <reference/rational.h>

namespace evalcts::reference {

inline constexpr int kMaxOrder = 64;

// One direction of a map. The default is the v of a one-dimensional map.
struct Direction {
  std::ptrdiff_t stride = 0;  // distance between consecutive control points, in values
  int order = 1;              // 1..kMaxOrder
  double first = 0,
         last = 1;  // the domain: u1 and u2, or v1 and v2; first > last is legal, first = last is not
};

// One component of a map: R_ij is points[i * u.stride + j * v.stride]. Float data is held in doubles, which
// is exact.
struct Surface {
  const double* points;
  Direction u, v = {};

  double at(int i, int j) const { return points[i * u.stride + j * v.stride]; }
};

// The argument at which a map is evaluated: a coordinate of EvalCoord, or a grid point of EvalPoint or
// EvalMesh, which need not be a floating-point number.
class Argument {
 public:
  // The coordinate 0, for the v of one-dimensional maps.
  Argument() = default;
  // Returns the argument u, which may be any double; see is_finite().
  static Argument coordinate(double u);
  // Returns the argument i * (g2 - g1) / n + g1, which is exactly g1 at i = 0 and exactly g2 at i = n
  // (EV-POINT-EXACT-0, EV-POINT-EXACT-N). g1 = g2 and any i are legal. Throws std::invalid_argument if n <=
  // 0.
  static Argument grid(std::int64_t i, std::int64_t n, double g1, double g2);

  bool is_finite() const;
  // Returns the argument as a rational number. Throws std::domain_error if it is not finite.
  Rational value() const;

  bool is_grid() const { return segments_ != 0; }
  // The argument of coordinate().
  double coordinate() const { return first_; }
  // The arguments of grid().
  std::int64_t index() const { return index_; }
  std::int64_t segments() const { return segments_; }
  double first() const { return first_; }
  double last() const { return last_; }

 private:
  Argument(std::int64_t i, std::int64_t n, double g1, double g2)
      : index_(i), segments_(n), first_(g1), last_(g2) {}

  std::int64_t index_ = 0;
  std::int64_t segments_ = 0;    // 0 for a coordinate
  double first_ = 0, last_ = 0;  // both equal the coordinate for a coordinate
};

// Returns true if all control values and domain ends are finite.
bool is_finite(const Surface& surface);

// A value and its magnitude S0 = SUM |B_i(t)| * |R_i|, the sum of the magnitudes of its terms (over all i,
// j).
struct Evaluation {
  Rational value;
  Rational magnitude;
};

// Returns value and magnitude in one pass, which costs little more than one of them.
Evaluation evaluate_with_magnitude(const Surface& surface, const Argument& u, const Argument& v = {});
Rational evaluate(const Surface& surface, const Argument& u, const Argument& v = {});

// A value and its derivatives with respect to the normalised coordinates t = (u - u1)/(u2 - u1) and
// (v - v1)/(v2 - v1) (the literal reading of the AUTO_NORMAL rule, see U-AUTON-REVSIGN); divide by u2 - u1
// for the derivative in u. The derivative along a direction of order 1 is zero.
struct Jet {
  Rational value, u, v;
};
Jet jet(const Surface& surface, const Argument& u, const Argument& v = {});

}  // namespace evalcts::reference
