// One direction of a map in the acceptance bound (the accuracy rule, see acceptance.h).
#pragma once

#include <reference/acceptance.h>

namespace evalcts::reference {

// Returns the smallest normal number of single precision.
Rational smallest_normal();

// Return true if x, or all control values, are representable in single precision.
bool is_single(double x);
bool points_are_single(const Surface& surface);

// Returns K of a surface of degrees n and m: the operations on the control values may add an error of K *
// eps.
int operations(int n, int m, bool single);

// The degree, domain and argument in one direction.
struct Direction {
  int degree;
  double u1, u2;
  const Argument& u;

  Rational width() const;  // |D|
  Rational t() const;      // |t|
  Rational s() const;      // |s|

  // Returns true if domain and argument are representable in single precision.
  bool is_single() const;

  // Returns tau, the absolute part of the error of t and s. `single`: all inputs, including the control
  // values, are representable in single precision.
  Rational tau(bool single) const;
  // Return T and S, the upper bounds of |t| and |s| with their errors.
  Rational widened_t(bool single) const;
  Rational widened_s(bool single) const;

  // Returns (|t| + |s|)^n, the sum of the magnitudes of the Bernstein polynomials.
  Rational growth() const;

  // Returns true if domain and argument satisfy the conditions of must_applies() in acceptance.h.
  bool must_applies() const;
};

}  // namespace evalcts::reference
