// Computes the inputs of the kernels with exact rationals.
#include "plan.h"

#include <reference/rounding.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bound.h"
#include "exact/homogeneous.h"

namespace evalcts::reference {
namespace {

double upward(const Rational& x) {
  const double nearest = x.to_double();
  return Rational(nearest) < x ? std::nextafter(nearest, std::numeric_limits<double>::infinity()) : nearest;
}

// Returns k with 2^(k-1) <= |x| < 2^k; x must not be zero.
std::int64_t binade(const Rational& x) { return floor_log2(x) + 1; }

// Returns c = 2^-k * |D|.
Rational scaled_width(const Direction& direction) {
  const Rational width = abs(Rational(direction.last) - Rational(direction.first));
  return width * Rational::power_of_two(-binade(width));
}

// Returns c^n.
Rational denominator(const Direction& direction) {
  return pow(scaled_width(direction), static_cast<unsigned>(direction.order - 1));
}

// Returns the nearest double, and the nearest double of the remainder.
DoubleDouble to_double_double(const Rational& x) {
  const double high = round_to_double(x);
  if (!std::isfinite(high)) return {high, 0};
  return {high, round_to_double(x - Rational(high))};
}

}  // namespace

DirectionPlan direction_plan(const Direction& direction, const std::optional<Arguments::Grid>& grid) {
  if (grid && grid->segments < 1) throw std::invalid_argument("a grid needs at least one segment");
  const Rational first(direction.first), last(direction.last), width = last - first;
  const std::int64_t k = binade(width);
  const Rational scale = Rational(width.sign()) * Rational::power_of_two(-k);
  DirectionPlan plan{};
  plan.degree = direction.order - 1;
  plan.applies = std::abs(k) <= kLargestDomainExponent;
  plan.first = direction.first;
  plan.last = direction.last;
  plan.scale = round_to_double(scale);
  plan.inverse_width = upward(1 / scaled_width(direction));
  plan.is_grid = grid.has_value();
  if (!grid) return plan;
  if (!std::isfinite(grid->first) || !std::isfinite(grid->last)) {
    plan.applies = false;
    return plan;
  }
  const Rational g1(grid->first), g2(grid->last);
  plan.delta = to_double_double(scale * (g2 - g1) / Rational(grid->segments));
  plan.alpha = to_double_double(scale * (g1 - first));
  plan.beta = to_double_double(scale * (last - g1));
  return plan;
}

KernelPlan kernel_plan(const Surface& surface) {
  check(surface);
  KernelPlan plan{direction_plan(surface.u, {}), direction_plan(surface.v, {}), {}, 0, 1};
  const int n = plan.u.degree, m = plan.v.degree;
  const Rational inverse = 1 / (denominator(surface.u) * denominator(surface.v));
  std::vector<Rational> coefficients;
  Rational largest_value, largest;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= m; ++j) {
      const Rational value(surface.at(i, j));
      const Integer weight = Integer(binomial(n, i)) * binomial(m, j);
      coefficients.push_back(Rational(weight) * value * inverse);
      largest_value = std::max(largest_value, abs(value));
      largest = std::max(largest, abs(coefficients.back()));
    }
  }
  const std::int64_t q = largest.is_zero() ? 0 : binade(largest);
  if (std::abs(q) > kLargestScale) plan.u.applies = false;
  const Rational scale = Rational::power_of_two(-q);
  for (const Rational& coefficient : coefficients) {
    plan.coefficients.push_back(to_double_double(coefficient * scale));
  }
  plan.largest = upward(largest_value * scale);
  plan.scale = std::ldexp(1.0, static_cast<int>(std::clamp<std::int64_t>(q, -1022, 1023)));
  return plan;
}

}  // namespace evalcts::reference
