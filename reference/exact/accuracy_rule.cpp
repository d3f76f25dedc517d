// The terms, the bound and the conditions of the accuracy rule.
#include "accuracy_rule.h"

#include <reference/rounding.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace evalcts::reference {
namespace {

Rational smallest_normal() { return Rational::power_of_two(-126); }  // of single precision

bool is_single(double x) {
  return std::abs(x) <= std::numeric_limits<float>::max() && static_cast<float>(x) == x;
}
bool overflows(const Rational& x) { return std::isinf(round_to_float(x)); }
bool is_subnormal(double x) { return x != 0 && abs(Rational(x)) < smallest_normal(); }

// Returns i * du of a grid.
Rational shift(const Argument& u) {
  return Rational(u.index()) * (Rational(u.last()) - Rational(u.first())) / Rational(u.segments());
}

// Returns true if domain and argument satisfy the conditions of must_applies() in acceptance.h.
bool is_ordinary(const Coordinate& at) {
  const auto& [stride, order, first, last] = at.direction;
  const Argument& u = at.argument;
  if (at.width < Rational::power_of_two(-60) || at.width > Rational::power_of_two(60)) return false;
  if (is_subnormal(first) || is_subnormal(last)) return false;
  for (const double x : {first, last, u.first(), u.last()})
    if (overflows(x)) return false;
  if (u.is_grid() && (overflows(Rational(u.last()) - Rational(u.first())) || overflows(shift(u))))
    return false;
  return round_to_float(first) != round_to_float(last);
}

}  // namespace

bool points_are_single(const Surface& surface) {
  for (int i = 0; i < surface.u.order; ++i) {
    for (int j = 0; j < surface.v.order; ++j)
      if (!is_single(surface.at(i, j))) return false;
  }
  return true;
}

int operations(int n, int m, bool single) { return n * m + 5 * (n + m) + 4 + (single ? 0 : 1); }

Coordinate::Coordinate(const Direction& of_map, const Argument& u)
    : direction(of_map),
      argument(u),
      value(u.value()),
      width(abs(Rational(of_map.last) - Rational(of_map.first))),
      t(abs(value - Rational(of_map.first)) / width),
      s(abs(Rational(of_map.last) - value) / width) {}

bool Coordinate::is_single() const {
  return reference::is_single(direction.first) && reference::is_single(direction.last) &&
         reference::is_single(argument.first()) && reference::is_single(argument.last());
}

Rational Coordinate::tau(bool single) const {
  Rational tau = smallest_normal() * (1 + 2 / width);
  // The rounding of du affects all points of a grid but the ends, which are exact.
  if (argument.is_grid() && argument.index() != 0 && argument.index() != argument.segments()) {
    tau += epsilon() * (4 * abs(shift(argument)) + abs(value)) / width;
  }
  if (!single) {
    const Rational first = abs(Rational(argument.first())), last = abs(Rational(argument.last()));
    Rational stored = first;
    if (argument.is_grid())
      stored += abs(Rational(argument.index()) / Rational(argument.segments())) * (first + last);
    tau += Rational::power_of_two(-23) *
           (stored + abs(s * Rational(direction.first)) + abs(t * Rational(direction.last))) / width;
  }
  return tau;
}

Rational Coordinate::growth() const { return pow(t + s, static_cast<unsigned>(degree())); }

BoundWeights::BoundWeights(const Coordinate& at, int n, bool single) {
  const Rational tau = at.tau(single), extent = std::max({Rational(1), at.t, at.s});
  const Rational widened_t = (1 + 8 * epsilon()) * at.t + tau;
  const Rational widened_s = (1 + 8 * epsilon()) * at.s + 8 * epsilon() * at.t + tau;
  widened = bernstein_weights(homogenise(widened_t, widened_s), n);
  plain = bernstein_weights(homogenise(at.t, at.s), n);
  // C(n,i) * max(1,|t|,|s|)^n
  underflow = bernstein_weights(homogenise(extent, extent), n);
}

Rational error_bound(const Net& magnitudes, const BoundWeights& u, const BoundWeights& v, int k,
                     const Rational& more) {
  Net at_least_one = magnitudes;  // max(1,|R_ij|)
  at_least_one.exponent = std::min<std::int64_t>(magnitudes.exponent, 0);
  const Integer one = Integer(1) << -at_least_one.exponent;
  for (Integer& value : at_least_one.values) {
    value <<= magnitudes.exponent - at_least_one.exponent;
    if (value < one) value = one;
  }
  const Rational x = k * epsilon();
  return (1 + x + x * x + more) * bernstein_sum(magnitudes, u.widened, v.widened) -
         bernstein_sum(magnitudes, u.plain, v.plain) +
         k * smallest_normal() * bernstein_sum(at_least_one, u.underflow, v.underflow);
}

Rational largest(const Net& magnitudes) {
  return Rational(*std::ranges::max_element(magnitudes.values), 1, magnitudes.exponent);
}

bool must_applies(const Coordinate& u, const Coordinate& v, const Rational& largest, int range) {
  if (!is_ordinary(u) || !is_ordinary(v)) return false;
  const Rational growth = u.growth() * v.growth();
  return growth <= Rational::power_of_two(kFullRange) && growth * largest <= Rational::power_of_two(range);
}

}  // namespace evalcts::reference
