// A second implementation of the formulas of the accuracy rule (acceptance.h), in reduced fractions.
#pragma once

#include <reference/bernstein.h>

#include <algorithm>
#include <vector>

#include "second_route.h"

namespace evalcts::reference {

inline const Fraction kEpsilon = Fraction(10738) / (1 << 30);

inline Fraction power(const Fraction& x, int n) {
  Fraction result = 1;
  for (int i = 0; i < n; ++i) result *= x;
  return result;
}

inline Fraction choose(int n, int i) {
  Fraction result = 1;
  for (int k = 1; k <= i; ++k) result = result * (n - i + k) / k;
  return result;
}

inline bool fits_single(double x) { return static_cast<double>(static_cast<float>(x)) == x; }

// Computes T, S, |t| and |s| of one direction.
struct SecondDirection {
  int n;
  double u1, u2;
  Argument argument;

  bool fits() const {
    return fits_single(u1) && fits_single(u2) && fits_single(argument.first()) &&
           fits_single(argument.last());
  }
  Fraction value() const {
    if (!argument.is_grid()) return fraction(argument.coordinate());
    return argument.index() * (fraction(argument.last()) - fraction(argument.first())) / argument.segments() +
           fraction(argument.first());
  }
  Fraction width() const { return abs(Fraction(fraction(u2) - fraction(u1))); }
  Fraction t() const { return abs(Fraction(value() - fraction(u1))) / width(); }
  Fraction s() const { return abs(Fraction(fraction(u2) - value())) / width(); }
  Fraction tau(bool all_fit) const {
    Fraction tau = power_of_two(-126) * (1 + 2 / width());
    const std::int64_t i = argument.index(), segments = argument.segments();
    const Fraction g1 = fraction(argument.first()), g2 = fraction(argument.last());
    if (argument.is_grid() && i != 0 && i != segments) {
      tau += kEpsilon * (4 * abs(Fraction(i * (g2 - g1) / segments)) + abs(value())) / width();
    }
    if (!all_fit) {
      const Fraction size = argument.is_grid()
                                ? Fraction(abs(g1) + abs(Fraction(i) / segments) * (abs(g1) + abs(g2)))
                                : abs(value());
      tau += power_of_two(-23) *
             (size + abs(Fraction(s() * fraction(u1))) + abs(Fraction(t() * fraction(u2)))) / width();
    }
    return tau;
  }
  Fraction wide_t(bool all_fit) const { return (1 + 8 * kEpsilon) * t() + tau(all_fit); }
  Fraction wide_s(bool all_fit) const { return (1 + 8 * kEpsilon) * s() + 8 * kEpsilon * t() + tau(all_fit); }
};

// Returns the acceptance bound. For a curve, v has degree 0. magnitudes[i * (v.n + 1) + j] is |R_ij|. `fit`:
// all inputs are representable in single precision.
inline Fraction second_bound(const std::vector<Fraction>& magnitudes, const SecondDirection& u,
                             const SecondDirection& v, int k, bool fit) {
  if (!fit) ++k;
  const auto weight = [](const SecondDirection& d, int i, const Fraction& t, const Fraction& s) {
    return Fraction(choose(d.n, i) * power(t, i) * power(s, d.n - i));
  };
  const Fraction one = 1;
  Fraction wide = 0, plain = 0, under = 0;
  for (int i = 0; i <= u.n; ++i) {
    for (int j = 0; j <= v.n; ++j) {
      const Fraction& r = magnitudes[i * (v.n + 1) + j];
      wide += weight(u, i, u.wide_t(fit), u.wide_s(fit)) * weight(v, j, v.wide_t(fit), v.wide_s(fit)) * r;
      plain += weight(u, i, u.t(), u.s()) * weight(v, j, v.t(), v.s()) * r;
      under += choose(u.n, i) * choose(v.n, j) * std::max(one, r);
    }
  }
  const Fraction x = k * kEpsilon;
  return (1 + x + x * x) * wide - plain +
         k * power_of_two(-126) * power(std::max({one, u.t(), u.s()}), u.n) *
             power(std::max({one, v.t(), v.s()}), v.n) * under;
}

}  // namespace evalcts::reference
