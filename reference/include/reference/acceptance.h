// Acceptance: the largest permitted distance of a result from the exact value, by the accuracy rule
// (vectors/INTERPRETING.md states its formulas), in exact rational arithmetic.
//
// The GL promises that a single floating-point operation is accurate to about one part in 10^5. The
// acceptance interval contains every result that any usual order of evaluation can give under that promise.
//
// Notation of the rule: eps = 10738 * 2^-30, D = u2 - u1, t = (u - u1)/D, s = (u2 - u)/D, n = order - 1, m
// = vorder - 1. Functions throw the exceptions of bernstein.h.
#pragma once

#include <optional>

#include <reference/bernstein.h>

namespace evalcts::reference {

// Returns the relative error that the GL allows a single operation, just above 1e-5.
Rational epsilon();

// Exponents of the largest magnitude that the GL promises to represent: 2^32, or 2^10 for colours and, before
// GL 2.0, texture coordinates (EV-NUM-RANGE-POS, EV-NUM-RANGE-COLOR).
inline constexpr int kFullRange = 32;
inline constexpr int kReducedRange = 10;

// Returns the bound such that a result `got` is accepted if |got - exact| <= bound: A*W(T,S) - W(|t|,|s|) + U
// with W over the tensor product of both directions.
Rational acceptance_bound(const Surface& surface, const Argument& u, const Argument& v = {});

// Returns true if the bound is a "must"; otherwise any result is accepted. The conditions are:
//   2^-60 <= |D| <= 2^60 and no domain end subnormal in single precision, in each direction;
//   (|t| + |s|)^n * max|R| <= 2^range, with the factors of both directions;
//   every input is below overflow in single precision (U-OVERFLOW), and the domain ends differ there
//   (U-DOUBLE-CLOSE).
bool must_applies(const Surface& surface, const Argument& u, const Argument& v = {}, int range = kFullRange);

// Returns the error bound of good single precision, 2^-24 * 2*(n + 2) * magnitude, where magnitude = S0 = SUM
// |B_i| * |R_i| and `degree` is n + m.
Rational quality_bound(int degree, const Rational& magnitude);

// Returns K * eps * magnitude, a lower bound of the acceptance bound (A >= 1 + K*eps, T >= |t|, S >= |s|). A
// result within it is accepted without computing the full bound. K = n*m + 5*(n + m) + 4.
Rational acceptance_bound_below(int udegree, int vdegree, const Rational& magnitude);

// Returns |got - exact| <= bound. -0 counts as +0; infinity and NaN are never within.
bool is_within(float got, const Rational& exact, const Rational& bound);

// The exact value, the bounds and the conditions for one value.
struct Acceptance {
  Rational exact;
  Rational magnitude;
  Rational bound;
  Rational quality_bound;
  bool must_applies;
};
Acceptance acceptance(const Surface& surface, const Argument& u, const Argument& v = {},
                      int range = kFullRange);

// Returns the bound of x/w from the exact values x and w and their bounds, for captures whose values the
// judge divides: q + 4*eps*(|x/w| + q) with q = (x_bound + |x/w| * w_bound)/(|w| - w_bound). Returns nothing
// (not judged) if w_bound >= |w|/2.
std::optional<Rational> quotient_bound(const Rational& x, const Rational& x_bound, const Rational& w,
                                       const Rational& w_bound);

}  // namespace evalcts::reference
