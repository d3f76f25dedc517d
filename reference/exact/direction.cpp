// The terms of the acceptance bound that belong to one direction of a map.
#include "direction.h"

#include <reference/rounding.h>

#include <cmath>
#include <limits>

namespace evalcts::reference {
namespace {

bool overflows(const Rational& x) { return std::isinf(round_to_float(x)); }
bool is_subnormal(double x) { return x != 0 && abs(Rational(x)) < smallest_normal(); }

// Returns du of a grid.
Rational step(const Argument& u) {
  return (Rational(u.last()) - Rational(u.first())) / Rational(u.segments());
}
// Returns true for grid points that the rounding of du affects: all but the ends, which are exact.
bool is_interior_grid_point(const Argument& u) {
  return u.is_grid() && u.index() != 0 && u.index() != u.segments();
}

}  // namespace

Rational smallest_normal() { return Rational::power_of_two(-126); }

bool is_single(double x) {
  return std::abs(x) <= std::numeric_limits<float>::max() && static_cast<float>(x) == x;
}

bool points_are_single(const Surface& surface) {
  for (std::ptrdiff_t i = 0; i < surface.uorder; ++i) {
    for (std::ptrdiff_t j = 0; j < surface.vorder; ++j) {
      if (!is_single(surface.points[i * surface.ustride + j * surface.vstride])) return false;
    }
  }
  return true;
}

int operations(int n, int m, bool single) { return n * m + 5 * (n + m) + 4 + (single ? 0 : 1); }

Rational Direction::width() const { return abs(Rational(u2) - Rational(u1)); }
Rational Direction::t() const { return abs(u.value() - Rational(u1)) / width(); }
Rational Direction::s() const { return abs(Rational(u2) - u.value()) / width(); }

bool Direction::is_single() const {
  return reference::is_single(u1) && reference::is_single(u2) && reference::is_single(u.first()) &&
         reference::is_single(u.last());
}

Rational Direction::tau(bool single) const {
  Rational tau = smallest_normal() * (1 + 2 / width());
  if (is_interior_grid_point(u)) {
    tau += epsilon() * (4 * abs(Rational(u.index()) * step(u)) + abs(u.value())) / width();
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

Rational Direction::widened_t(bool single) const { return (1 + 8 * epsilon()) * t() + tau(single); }
Rational Direction::widened_s(bool single) const {
  return (1 + 8 * epsilon()) * s() + 8 * epsilon() * t() + tau(single);
}

Rational Direction::growth() const { return pow(t() + s(), static_cast<unsigned>(degree)); }

bool Direction::must_applies() const {
  const Rational d = width();
  if (d < Rational::power_of_two(-60) || d > Rational::power_of_two(60)) return false;
  if (is_subnormal(u1) || is_subnormal(u2)) return false;
  if (overflows(u1) || overflows(u2) || overflows(u.first()) || overflows(u.last())) return false;
  if (u.is_grid() &&
      (overflows(Rational(u.last()) - Rational(u.first())) || overflows(Rational(u.index()) * step(u)))) {
    return false;
  }
  return round_to_float(u1) != round_to_float(u2);
}

}  // namespace evalcts::reference
