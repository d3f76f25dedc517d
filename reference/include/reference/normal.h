// Automatic normals (GL 2.1 section 5.1, GL_AUTO_NORMAL), exactly:
//
//   m = dq/du x dq/dv,   q = (x,y,z) for MAP2_VERTEX_3, (x/w, y/w, z/w) for MAP2_VERTEX_4,   normal = m /
//   |m|,
//
// without the division by |m| where a vertex shader or program is active (EV-AUTON-DIRECTION, EV-AUTON-UNIT,
// EV-AUTON-RATIONAL, EV-AUTON-SHADER). Derivatives are those with respect to the normalised coordinates, as
// in bernstein.h: a domain other than [0,1] only scales m, a reversed one may flip it (U-AUTON-REVSIGN,
// U-AUTON-MAGN).
//
// Square roots are never approximated where something is decided: what is compared is squares of rationals.
//
// Functions of a map throw as those of bernstein.h do, and std::invalid_argument if the components are not
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

// dq/du and dq/dv. Throws std::domain_error where w = 0.
struct Tangents {
  Vector u, v;
};
Tangents tangents(VertexSurface surface, const Argument& u, const Argument& v);

// m. Throws std::domain_error where w = 0.
Vector normal_vector(VertexSurface surface, const Argument& u, const Argument& v);

// Whether m is zero, exactly: the normal is then unspecified (EV-AUTON-DEGENERATE, U-AUTON-ZERO).
bool is_degenerate(const Vector& m);

struct Interval {
  Rational low, high;
};

// Encloses each component of m/|m| in an interval no wider than 2^-bits. Throws std::invalid_argument if bits
// is negative.
std::array<Interval, 3> unit_vector(const Vector& m, int bits);

// m/|m|, each component rounded to the nearest binary32 or binary64. There are no ties to break: x^2 + y^2 +
// z^2 = n^2 has no solution in integers without a common factor where n is even, so a component that is a
// binary fraction is 0 or +-1.
std::array<float, 3> rounded_unit_vector(const Vector& m);
std::array<double, 3> rounded_unit_vector_to_double(const Vector& m);

// Encloses |m|: high - low <= 2^-bits * |m|. Throws std::invalid_argument if bits is negative. m may be zero.
Interval length(const Vector& m, int bits);

// How far from the exact normal a result may be: section 0.5 of the requirements, rounded outward (by less
// than one part in 10^6).
struct NormalAcceptance {
  // a x b of section 0.5, which points where m of normal_vector() points: m itself, for four components w^4 *
  // m (w may be negative). Zero where m is, and where w is.
  Vector m;
  // Whether the bounds are a "must" here; elsewhere any result will do. As for the values of all components
  // (acceptance.h); and single precision has to be able to square what is met on the way, before and after
  // the division by w, for derivatives in t or in u: the components of the tangents
  // up to 2^32, |m| from 2^-32 to 2^32.
  bool must_applies;
  // Of each component of m/|m|. None (not judged) where the exact normal is lost in the errors of the
  // derivatives, as where m or w is zero.
  std::optional<Rational> bound;
  // Of each component of m, for EV-AUTON-SHADER. None in the same places.
  std::optional<Rational> vector_bound;
};
NormalAcceptance normal_acceptance(VertexSurface surface, const Argument& u, const Argument& v,
                                   int range = kFullRange);

// What is allowed on top of the bound of m/|m| because GL 1.1 and later leave the method of computing normals
// open (EV-AUTON-METHOD, U-AUTON-METHOD): a must is judged with the sum, an interpretation with the bound
// alone. For m the same times |m|.
Rational normal_method_allowance();

// Whether each component of `got` lies within `bound` of that of m/|m|; this judges the length as well.
// `either_sign`: -m/|m| will do too, for all components at once (U-AUTON-REVSIGN). Infinity and NaN are never
// within.
bool is_within(const std::array<float, 3>& got, const Vector& m, const Rational& bound, bool either_sign);

// The same for got/|got|, which only judges the direction. Zero has none and is never within.
bool direction_is_within(const std::array<float, 3>& got, const Vector& m, const Rational& bound,
                         bool either_sign);

}  // namespace evalcts::reference
