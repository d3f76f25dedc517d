// Acceptance bounds of values (the accuracy rule, see acceptance.h): curves and surfaces in one form.
#include <reference/acceptance.h>

#include <algorithm>
#include <cmath>

#include "direction.h"
#include "homogeneous.h"

namespace evalcts::reference {
namespace {

// The common form of curves and surfaces: a curve is a surface of order 1 in v.
struct Problem {
  Net net;
  Direction u, v;
  bool single;  // all inputs are representable in single precision
};

// Returns the v of a curve, which may be any value, because the curve does not depend on it.
const Argument& no_argument() {
  static const Argument kZero = Argument::coordinate(0);
  return kZero;
}

Surface as_surface(const Curve& curve) {
  return {curve.points, curve.stride, 0, curve.order, 1, curve.u1, curve.u2, 0, 1};
}

Problem problem(const Surface& surface, const Argument& u, const Argument& v) {
  // All arguments are checked before the computation.
  Net net = integer_net(surface);
  homogenise(u, surface.u1, surface.u2);
  homogenise(v, surface.v1, surface.v2);
  Problem p{std::move(net),
            {surface.uorder - 1, surface.u1, surface.u2, u},
            {surface.vorder - 1, surface.v1, surface.v2, v},
            points_are_single(surface)};
  p.single = p.single && p.u.is_single() && p.v.is_single();
  return p;
}

// Returns max|R|.
Rational largest(const Net& net) {
  Integer most = 0;
  for (const Integer& value : net.values) most = std::max<Integer>(most, abs(value));
  return Rational(most, 1, net.exponent);
}

// Returns SUM C(n,i) * C(m,j) * max(1,|R_ij|).
Rational binomial_sum(const Net& net) {
  Rational sum;
  for (int i = 0; i < net.rows; ++i) {
    for (int j = 0; j < net.columns; ++j) {
      const Rational value(abs(net.values[static_cast<std::size_t>(i) * net.columns + j]), 1, net.exponent);
      sum += Rational(Integer(binomial(net.rows - 1, i)) * binomial(net.columns - 1, j)) *
             std::max(Rational(1), value);
    }
  }
  return sum;
}

Rational bound(const Problem& p) {
  const auto widened = [&](const Direction& d) {
    return homogenise(d.widened_t(p.single), d.widened_s(p.single));
  };
  const auto plain = [](const Direction& d) { return homogenise(d.t(), d.s()); };
  const Net net = magnitudes(p.net);
  const Rational outer = bernstein_sum(net, widened(p.u), widened(p.v)).value;
  const Rational inner = bernstein_sum(net, plain(p.u), plain(p.v)).value;

  const Rational k = operations(p.u.degree, p.v.degree, p.single);
  const Rational x = k * epsilon();
  const auto extent = [](const Direction& d) {
    return pow(std::max({Rational(1), d.t(), d.s()}), static_cast<unsigned>(d.degree));
  };
  const Rational underflow = k * smallest_normal() * extent(p.u) * extent(p.v) * binomial_sum(p.net);
  return (1 + x + x * x) * outer - inner + underflow;
}

// Returns true if domain and argument satisfy the conditions of must_applies() by a wide margin, and the
// argument lies in the domain, so that |t| + |s| = 1. False for NaN.
bool plainly_inside(double u1, double u2, const Argument& u) {
  const auto ordinary = [](double x) { return x == 0 || (std::abs(x) >= 0x1p-100 && std::abs(x) <= 0x1p50); };
  const auto inside = [&](double x) { return std::min(u1, u2) <= x && x <= std::max(u1, u2); };
  return ordinary(u1) && ordinary(u2) && std::abs(u2 - u1) >= 0x1p-50 &&
         static_cast<float>(u1) != static_cast<float>(u2) && inside(u.first()) && inside(u.last()) &&
         0 <= u.index() && u.index() <= u.segments();
}

// Returns true if must() holds by the criterion above, which saves exact arithmetic for almost all values.
bool plainly_must(const Surface& surface, const Argument& u, const Argument& v, int range) {
  if (!plainly_inside(surface.u1, surface.u2, u) || !plainly_inside(surface.v1, surface.v2, v)) return false;
  if (std::max(surface.uorder, surface.vorder) > kMaxOrder) return false;
  const double most = std::ldexp(1.0, range);
  for (int i = 0; i < surface.uorder; ++i)
    for (int j = 0; j < surface.vorder; ++j)
      if (!(std::abs(surface.points[i * surface.ustride + j * surface.vstride]) <= most)) return false;
  return surface.uorder > 0 && surface.vorder > 0;
}

bool must(const Problem& p, int range) {
  if (!p.u.must_applies() || !p.v.must_applies()) return false;
  const Rational growth = p.u.growth() * p.v.growth();
  return growth <= Rational::power_of_two(kFullRange) &&
         growth * largest(p.net) <= Rational::power_of_two(range);
}

Acceptance judge(const Problem& p, const Evaluation& evaluation, int range) {
  return {evaluation.value, evaluation.magnitude, bound(p),
          quality_bound(p.u.degree + p.v.degree, evaluation.magnitude), must(p, range)};
}

}  // namespace

Rational epsilon() { return 10738 * Rational::power_of_two(-30); }

Rational acceptance_bound(const Curve& curve, const Argument& u) {
  return bound(problem(as_surface(curve), u, no_argument()));
}

Rational acceptance_bound(const Surface& surface, const Argument& u, const Argument& v) {
  return bound(problem(surface, u, v));
}

bool must_applies(const Curve& curve, const Argument& u, int range) {
  return must_applies(as_surface(curve), u, no_argument(), range);
}

bool must_applies(const Surface& surface, const Argument& u, const Argument& v, int range) {
  return plainly_must(surface, u, v, range) || must(problem(surface, u, v), range);
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

Acceptance acceptance(const Curve& curve, const Argument& u, int range) {
  return judge(problem(as_surface(curve), u, no_argument()), evaluate_with_magnitude(curve, u), range);
}

Acceptance acceptance(const Surface& surface, const Argument& u, const Argument& v, int range) {
  return judge(problem(surface, u, v), evaluate_with_magnitude(surface, u, v), range);
}

std::optional<Rational> quotient_bound(const Rational& x, const Rational& x_bound, const Rational& w,
                                       const Rational& w_bound) {
  if (2 * w_bound >= abs(w)) return std::nullopt;
  const Rational quotient = abs(x / w);
  const Rational q = (x_bound + quotient * w_bound) / (abs(w) - w_bound);
  return q + 4 * epsilon() * (quotient + q);
}

}  // namespace evalcts::reference
