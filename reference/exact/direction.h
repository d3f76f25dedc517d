// One direction of a map as the acceptance bound sees it: section 0.5 of the requirements.
#pragma once

#include <reference/acceptance.h>

namespace evalcts::reference {

// The smallest normal number of single precision.
Rational smallest_normal();

// Whether x is representable in single precision, and whether all control values are.
bool is_single(double x);
bool points_are_single(const Surface& surface);

// K of a surface of degrees n and m: so many times eps is what the operations on the control values may add.
int operations(int n, int m, bool single);

// The degree, domain and argument.
struct Direction {
  int degree;
  double u1, u2;
  const Argument& u;

  Rational width() const;  // |D|
  Rational t() const;      // |t|
  Rational s() const;      // |s|

  // Whether domain and argument are representable in single precision.
  bool is_single() const;

  // The absolute error of t and s that is not a multiple of them. `single`: all inputs, the control values
  // included, are representable in single precision.
  Rational tau(bool single) const;
  // T and S, which |t| and |s| become through errors.
  Rational widened_t(bool single) const;
  Rational widened_s(bool single) const;

  // (|t| + |s|)^n, the sum of the magnitudes of the Bernstein polynomials.
  Rational growth() const;

  // What must_applies() in acceptance.h says of a domain and an argument.
  bool must_applies() const;
};

}  // namespace evalcts::reference
