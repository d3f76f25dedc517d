// The functions of bernstein.h: evaluation through a BernsteinForm, derivatives from differences of the
// control values.
#include <reference/bernstein.h>
#include <reference/bernstein_form.h>

#include <cmath>
#include <stdexcept>

#include "homogeneous.h"

namespace evalcts::reference {

Argument Argument::coordinate(double u) { return Argument(0, 0, u, u); }

Argument Argument::grid(std::int64_t i, std::int64_t n, double g1, double g2) {
  if (n <= 0) throw std::invalid_argument("a grid needs at least one segment");
  return Argument(i, n, g1, g2);
}

bool Argument::is_finite() const { return std::isfinite(first_) && std::isfinite(last_); }

Rational Argument::value() const {
  if (!is_grid()) return Rational(first_);
  const Rational g1(first_), g2(last_);
  return Rational(index_) * (g2 - g1) / Rational(segments_) + g1;
}

bool is_finite(const Curve& curve) {
  return is_finite(Surface{curve.points, curve.stride, 0, curve.order, 1, curve.u1, curve.u2, 0, 1});
}

bool is_finite(const Surface& surface) {
  for (const double end : {surface.u1, surface.u2, surface.v1, surface.v2}) {
    if (!std::isfinite(end)) return false;
  }
  for (std::ptrdiff_t i = 0; i < surface.uorder; ++i) {
    for (std::ptrdiff_t j = 0; j < surface.vorder; ++j) {
      if (!std::isfinite(surface.points[i * surface.ustride + j * surface.vstride])) return false;
    }
  }
  return true;
}

Evaluation evaluate_with_magnitude(const Curve& curve, const Argument& u) {
  return BernsteinForm(curve).evaluate_with_magnitude(u);
}

Evaluation evaluate_with_magnitude(const Surface& surface, const Argument& u, const Argument& v) {
  return BernsteinForm(surface).evaluate_with_magnitude(u, v);
}

Rational evaluate(const Curve& curve, const Argument& u) { return BernsteinForm(curve).evaluate(u); }

Rational evaluate(const Surface& surface, const Argument& u, const Argument& v) {
  return BernsteinForm(surface).evaluate(u, v);
}

Rational magnitude(const Curve& curve, const Argument& u) {
  return evaluate_with_magnitude(curve, u).magnitude;
}

Rational magnitude(const Surface& surface, const Argument& u, const Argument& v) {
  return evaluate_with_magnitude(surface, u, v).magnitude;
}

// The derivative of a Bernstein sum of degree n is n times that of degree n - 1 over the differences.

Rational derivative(const Curve& curve, const Argument& u) {
  const Net net = integer_net(curve);
  const Homogeneous t = homogenise(u, curve.u1, curve.u2);
  if (net.rows == 1) return 0;
  return (net.rows - 1) * bernstein_sum(differences_u(net), t).value;
}

Rational derivative_u(const Surface& surface, const Argument& u, const Argument& v) {
  const Net net = integer_net(surface);
  const Homogeneous t = homogenise(u, surface.u1, surface.u2), s = homogenise(v, surface.v1, surface.v2);
  if (net.rows == 1) return 0;
  return (net.rows - 1) * bernstein_sum(differences_u(net), t, s).value;
}

Rational derivative_v(const Surface& surface, const Argument& u, const Argument& v) {
  const Net net = integer_net(surface);
  const Homogeneous t = homogenise(u, surface.u1, surface.u2), s = homogenise(v, surface.v1, surface.v2);
  if (net.columns == 1) return 0;
  return (net.columns - 1) * bernstein_sum(differences_v(net), t, s).value;
}

}  // namespace evalcts::reference
