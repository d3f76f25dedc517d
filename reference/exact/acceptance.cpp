// Acceptance of values by the accuracy rule.
#include <reference/acceptance.h>

#include <algorithm>
#include <cmath>

#include "accuracy_rule.h"

namespace evalcts::reference {
namespace {

// The inputs of the accuracy rule, which must be valid.
struct Problem {
  Problem(const Surface& surface, const Argument& at_u, const Argument& at_v)
      : net(magnitudes(integer_net(surface))),
        u(surface.u, at_u),
        v(surface.v, at_v),
        single(points_are_single(surface) && u.is_single() && v.is_single()) {}

  Rational bound() const {
    const int n = u.degree(), m = v.degree();
    return error_bound(net, BoundWeights(u, n, single), BoundWeights(v, m, single), operations(n, m, single));
  }
  bool must(int range) const { return must_applies(u, v, largest(net), range); }

  Net net;  // of magnitudes
  Coordinate u, v;
  bool single;  // all inputs are representable in single precision
};

Problem problem(const Surface& surface, const Argument& u, const Argument& v) {
  check(surface, u, v);
  return {surface, u, v};
}

// Returns true if domain and argument satisfy the conditions of must_applies() by a wide margin, and the
// argument lies in the domain, so that |t| + |s| = 1. False for NaN.
bool plainly_inside(const Direction& direction, const Argument& u) {
  const double u1 = direction.first, u2 = direction.last;
  const auto ordinary = [](double x) { return x == 0 || (std::abs(x) >= 0x1p-100 && std::abs(x) <= 0x1p50); };
  const auto inside = [&](double x) { return std::min(u1, u2) <= x && x <= std::max(u1, u2); };
  return 0 < direction.order && direction.order <= kMaxOrder && ordinary(u1) && ordinary(u2) &&
         std::abs(u2 - u1) >= 0x1p-50 && static_cast<float>(u1) != static_cast<float>(u2) &&
         inside(u.first()) && inside(u.last()) && 0 <= u.index() && u.index() <= u.segments();
}

// Returns true if must() holds by the criterion above, which saves exact arithmetic for almost all values.
bool plainly_must(const Surface& surface, const Argument& u, const Argument& v, int range) {
  if (!plainly_inside(surface.u, u) || !plainly_inside(surface.v, v)) return false;
  const double most = std::ldexp(1.0, range);
  for (int i = 0; i < surface.u.order; ++i)
    for (int j = 0; j < surface.v.order; ++j)
      if (!(std::abs(surface.at(i, j)) <= most)) return false;
  return true;
}

}  // namespace

Rational epsilon() { return 10738 * Rational::power_of_two(-30); }

Rational acceptance_bound(const Surface& surface, const Argument& u, const Argument& v) {
  return problem(surface, u, v).bound();
}

bool must_applies(const Surface& surface, const Argument& u, const Argument& v, int range) {
  return plainly_must(surface, u, v, range) || problem(surface, u, v).must(range);
}

Rational quality_bound(int degree, const Rational& magnitude) {
  return Rational::power_of_two(-24) * (2 * (degree + 2)) * magnitude;
}

Rational acceptance_bound_below(int udegree, int vdegree, const Rational& magnitude) {
  return operations(udegree, vdegree, true) * epsilon() * magnitude;
}

bool is_within(float got, const Rational& exact, const Rational& bound) {
  return std::isfinite(got) && abs(Rational(got) - exact) <= bound;
}

Acceptance acceptance(const Surface& surface, const Argument& u, const Argument& v, int range) {
  const Problem p = problem(surface, u, v);
  const auto [value, magnitude] = evaluate_with_magnitude(surface, u, v);
  return {value, magnitude, p.bound(), quality_bound(p.u.degree() + p.v.degree(), magnitude), p.must(range)};
}

std::optional<Rational> quotient_bound(const Rational& x, const Rational& x_bound, const Rational& w,
                                       const Rational& w_bound) {
  if (2 * w_bound >= abs(w)) return std::nullopt;
  const Rational quotient = abs(x / w);
  const Rational q = (x_bound + quotient * w_bound) / (abs(w) - w_bound);
  return q + 4 * epsilon() * (quotient + q);
}

}  // namespace evalcts::reference
