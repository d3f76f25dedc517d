// The accuracy rule (acceptance.h): its terms for one direction of a map, and the error bound of a Bernstein
// sum.
#pragma once

#include <reference/acceptance.h>

#include "homogeneous.h"

namespace evalcts::reference {

// Returns true if all control values are representable in single precision.
bool points_are_single(const Surface& surface);

// Returns K of a surface of degrees n and m: the operations on the control values may add an error of K *
// eps.
int operations(int n, int m, bool single);

// An argument in one direction of a map, both valid.
struct Coordinate {
  Coordinate(const Direction& of_map, const Argument& u);

  int degree() const { return direction.order - 1; }
  // Returns true if domain and argument are representable in single precision.
  bool is_single() const;
  // Returns tau, the absolute part of the error of t and s. `single`: all inputs, including the control
  // values, are representable in single precision.
  Rational tau(bool single) const;
  // Returns (|t| + |s|)^n, the sum of the magnitudes of the Bernstein polynomials.
  Rational growth() const;

  Direction direction;
  Argument argument;
  Rational value;  // of the argument
  Rational width;  // |D|
  Rational t, s;   // |t| and |s|
};

// The weights of one direction in the bound for a sum of degree n: those of W(T,S), of W(|t|,|s|), and of the
// sum in U.
struct BoundWeights {
  BoundWeights(const Coordinate& at, int n, bool single);

  Weights widened, plain, underflow;
};

// Returns the bound (A + more)*W(T,S) - W(|t|,|s|) + U for k operations, with W over a net of magnitudes.
Rational error_bound(const Net& magnitudes, const BoundWeights& u, const BoundWeights& v, int k,
                     const Rational& more = 0);

// Returns the largest control value of a net of magnitudes.
Rational largest(const Net& magnitudes);

// Returns true if the conditions of must_applies() in acceptance.h hold for maps whose largest control value
// is max|R|.
bool must_applies(const Coordinate& u, const Coordinate& v, const Rational& largest, int range);

}  // namespace evalcts::reference
