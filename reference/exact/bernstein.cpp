// Arguments, and evaluation through a BernsteinForm.
#include <reference/bernstein.h>
#include <reference/bernstein_form.h>

#include <cmath>
#include <stdexcept>

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

bool is_finite(const Surface& surface) {
  for (const double end : {surface.u.first, surface.u.last, surface.v.first, surface.v.last}) {
    if (!std::isfinite(end)) return false;
  }
  for (int i = 0; i < surface.u.order; ++i) {
    for (int j = 0; j < surface.v.order; ++j) {
      if (!std::isfinite(surface.at(i, j))) return false;
    }
  }
  return true;
}

Evaluation evaluate_with_magnitude(const Surface& surface, const Argument& u, const Argument& v) {
  return BernsteinForm(surface).evaluate_with_magnitude(u, v);
}

Rational evaluate(const Surface& surface, const Argument& u, const Argument& v) {
  return BernsteinForm(surface).evaluate(u, v);
}

}  // namespace evalcts::reference
