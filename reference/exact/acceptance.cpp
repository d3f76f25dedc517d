#include <reference/acceptance.h>
#include <reference/rounding.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "reference/exact/homogeneous.h"

namespace evalcts::reference {
namespace {

// The smallest normal number of single precision.
Rational smallest_normal() { return Rational::power_of_two(-126); }

bool is_single(double x) { return round_to_float(x) == x; }
bool overflows(const Rational& x) { return std::isinf(round_to_float(x)); }
bool is_subnormal(double x) { return x != 0 && abs(Rational(x)) < smallest_normal(); }

// One direction of a map: its degree, domain and argument.
struct Direction {
  int degree;
  double u1, u2;
  const Argument& u;

  Rational width() const { return abs(Rational(u2) - Rational(u1)); }     // |D|
  Rational t() const { return abs(u.value() - Rational(u1)) / width(); }  // |t|
  Rational s() const { return abs(Rational(u2) - u.value()) / width(); }  // |s|
  Rational step() const { return (Rational(u.last()) - Rational(u.first())) / Rational(u.segments()); }  // du
  bool is_interior_grid_point() const { return u.is_grid() && u.index() != 0 && u.index() != u.segments(); }
  bool is_single() const {
    return reference::is_single(u1) && reference::is_single(u2) && reference::is_single(u.first()) &&
           reference::is_single(u.last());
  }

  // The absolute error of t and s that is not a multiple of them.
  Rational tau(bool single) const {
    Rational tau = smallest_normal() * (1 + 2 / width());
    if (is_interior_grid_point()) {
      tau += epsilon() * (4 * abs(Rational(u.index()) * step()) + abs(u.value())) / width();
    }
    if (!single) {
      const Rational argument =
          u.is_grid() ? abs(Rational(u.first())) + abs(Rational(u.index()) / Rational(u.segments())) *
                                                       (abs(Rational(u.first())) + abs(Rational(u.last())))
                      : abs(Rational(u.first()));
      tau += Rational::power_of_two(-23) * (argument + abs(s() * Rational(u1)) + abs(t() * Rational(u2))) /
             width();
    }
    return tau;
  }

  // (|t| + |s|)^n, the sum of the magnitudes of the Bernstein polynomials.
  Rational growth() const { return pow(t() + s(), static_cast<unsigned>(degree)); }

  bool must_applies() const {
    const Rational d = width();
    if (d < Rational::power_of_two(-60) || d > Rational::power_of_two(60)) return false;
    if (is_subnormal(u1) || is_subnormal(u2)) return false;
    if (overflows(u1) || overflows(u2) || overflows(u.first()) || overflows(u.last())) return false;
    if (u.is_grid() &&
        (overflows(Rational(u.last()) - Rational(u.first())) || overflows(Rational(u.index()) * step()))) {
      return false;
    }
    return round_to_float(u1) != round_to_float(u2);
  }
};

// Curve and surface as one: a curve is a surface of order 1 in v.
struct Problem {
  Net net;
  Direction u, v;
  bool single;  // all inputs are representable in single precision

  int k() const {
    const int n = u.degree, m = v.degree;
    return n * m + 5 * (n + m) + 4 + (single ? 0 : 1);
  }
};

// The v of a curve: any value does, as the curve does not depend on it.
const Argument& no_argument() {
  static const Argument zero = Argument::coordinate(0);
  return zero;
}

Surface as_surface(const Curve& curve) {
  return {curve.points, curve.stride, 0, curve.order, 1, curve.u1, curve.u2, 0, 1};
}

bool points_are_single(const Surface& surface) {
  for (std::ptrdiff_t i = 0; i < surface.uorder; ++i) {
    for (std::ptrdiff_t j = 0; j < surface.vorder; ++j) {
      if (!is_single(surface.points[i * surface.ustride + j * surface.vstride])) return false;
    }
  }
  return true;
}

Problem problem(const Surface& surface, const Argument& u, const Argument& v) {
  // Checks everything that can be wrong, before anything is computed.
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

// max|R|
Rational largest(const Net& net) {
  Integer most = 0;
  for (const Integer& value : net.values) most = std::max<Integer>(most, abs(value));
  return Rational(most, 1, net.exponent);
}

// SUM C(n,i) * C(m,j) * max(1,|R_ij|)
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
  const Rational eps = epsilon();
  // W((1 + 8*eps)*|t| + tau, (1 + 8*eps)*|s| + 8*eps*|t| + tau), in each direction.
  const auto widened = [&](const Direction& d) {
    const Rational t = d.t(), s = d.s(), tau = d.tau(p.single);
    return homogenise((1 + 8 * eps) * t + tau, (1 + 8 * eps) * s + 8 * eps * t + tau);
  };
  const auto plain = [](const Direction& d) { return homogenise(d.t(), d.s()); };
  const Net net = magnitudes(p.net);
  const Rational outer = bernstein_sum(net, widened(p.u), widened(p.v)).value;
  const Rational inner = bernstein_sum(net, plain(p.u), plain(p.v)).value;

  const Rational k = p.k();
  const Rational x = k * eps;
  const auto extent = [](const Direction& d) {
    return pow(std::max({Rational(1), d.t(), d.s()}), static_cast<unsigned>(d.degree));
  };
  const Rational underflow = k * smallest_normal() * extent(p.u) * extent(p.v) * binomial_sum(p.net);
  return (1 + x + x * x) * outer - inner + underflow;
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
  return must(problem(as_surface(curve), u, no_argument()), range);
}

bool must_applies(const Surface& surface, const Argument& u, const Argument& v, int range) {
  return must(problem(surface, u, v), range);
}

Rational quality_bound(int degree, const Rational& magnitude) {
  return Rational::power_of_two(-24) * (2 * (degree + 2)) * magnitude;
}

Rational acceptance_bound_below(int udegree, int vdegree, const Rational& magnitude) {
  return (udegree * vdegree + 5 * (udegree + vdegree) + 4) * epsilon() * magnitude;
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
