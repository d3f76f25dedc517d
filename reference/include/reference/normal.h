// Automatic normals (GL 2.1 section 5.1, GL_AUTO_NORMAL), exactly:
//
//   m = dq/du x dq/dv,   q = (x,y,z) for MAP2_VERTEX_3, (x/w, y/w, z/w) for MAP2_VERTEX_4,   normal = m /
//   |m|,
//
// without the division by |m| if a vertex shader or program is active (EV-AUTON-DIRECTION, EV-AUTON-UNIT,
// EV-AUTON-RATIONAL, EV-AUTON-SHADER). Derivatives are taken with respect to the normalised coordinates, as
// in bernstein.h. A domain other than [0,1] only scales m, and a reversed domain may flip it
// (U-AUTON-REVSIGN, U-AUTON-MAGN).
//
// No decision uses approximated square roots: squares of rationals are compared.
//
// Functions of a map throw the exceptions of bernstein.h, and std::invalid_argument if the components are not
// three or four maps of the same orders over the same domain. Functions of a vector that needs a direction
// throw std::domain_error if it is degenerate.
#pragma once

#include <array>
#include <optional>
#include <span>

#include <reference/acceptance.h>

namespace evalcts::reference {

// The vertex map of a surface, component by component: x, y, z or x, y, z, w.
using VertexSurface = std::span<const Surface>;

using Vector = std::array<Rational, 3>;

// Returns m. Throws std::domain_error if w = 0.
Vector normal_vector(VertexSurface surface, const Argument& u, const Argument& v);

// Returns true if m is exactly zero; the normal is then unspecified (EV-AUTON-DEGENERATE, U-AUTON-ZERO).
bool is_degenerate(const Vector& m);

struct Interval {
  Rational low, high;
};

// Encloses each component of m/|m| in an interval no wider than 2^-bits. Throws std::invalid_argument if bits
// is negative.
std::array<Interval, 3> unit_vector(const Vector& m, int bits);

// Return m/|m|, each component rounded to the nearest binary32 or binary64. Ties do not occur: x^2 + y^2 +
// z^2 = n^2 has no solution in integers without a common factor if n is even, so a component that is a binary
// fraction is 0 or +-1.
std::array<float, 3> rounded_unit_vector(const Vector& m);
std::array<double, 3> rounded_unit_vector_to_double(const Vector& m);

// Encloses |m|: high - low <= 2^-bits * |m|. Throws std::invalid_argument if bits is negative. m may be zero.
Interval length(const Vector& m, int bits);

// The largest permitted distance of a result from the exact normal by the rule in
// vectors/INTERPRETING.md, rounded outward by less than one part in 10^6.
struct NormalAcceptance {
  // The vector a x b of that rule, which has the direction of normal_vector(): m itself, or w^4 * m for
  // four components (w may be negative). Zero if m or w is zero.
  Vector m;
  // True if the bounds are a "must"; otherwise any result is accepted. The conditions of acceptance.h hold
  // for all components, and single precision can square the intermediate values, before and after the
  // division by w, for derivatives in t or in u: components of the tangents up to 2^32, |m| from 2^-32 to
  // 2^32.
  bool must_applies;
  // Bound for each component of m/|m|. Empty (not judged) if the errors of the derivatives may exceed the
  // exact normal, for example if m or w is zero.
  std::optional<Rational> bound;
  // Bound for each component of m, for EV-AUTON-SHADER. Empty under the same condition.
  std::optional<Rational> vector_bound;
};
NormalAcceptance normal_acceptance(VertexSurface surface, const Argument& u, const Argument& v,
                                   int range = kFullRange);

// Returns the allowance that is added to the bound of m/|m|, because GL 1.1 and later leave the method of
// computing normals open (EV-AUTON-METHOD, U-AUTON-METHOD). All levels but quality are judged with the sum.
// The allowance for m is this value times |m|.
Rational normal_method_allowance();

// Returns 2^-7 of the bound of m/|m|, with which quality is judged: the bound is for operations accurate to
// one part in 10^5, good single precision is about 2^7 times as accurate.
Rational normal_quality_bound(const Rational& bound);

// Returns true if each component of `got` lies within `bound` of that of m/|m|, which judges the length as
// well. `either_sign`: -m/|m| is accepted, too, for all components at once (U-AUTON-REVSIGN). Infinity and
// NaN are never within.
bool is_within(const std::array<float, 3>& got, const Vector& m, const Rational& bound, bool either_sign);

// The same for got/|got|, which judges only the direction. The zero vector has no direction and is never
// within.
bool direction_is_within(const std::array<float, 3>& got, const Vector& m, const Rational& bound,
                         bool either_sign);

}  // namespace evalcts::reference
