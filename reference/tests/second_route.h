// Evaluates Bernstein polynomials by a slow second method: de Casteljau's construction with reduced fractions
// of Boost. It shares no arithmetic with the code under test.
#pragma once

#include <reference/rational.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

namespace evalcts::reference {

using Fraction = boost::multiprecision::cpp_rational;

inline Fraction power_of_two(long exponent) {
  const boost::multiprecision::cpp_int power = boost::multiprecision::cpp_int(1) << std::labs(exponent);
  return exponent < 0 ? Fraction(1, power) : Fraction(power);
}

inline Fraction fraction(double x) {
  int exponent;
  const double mantissa = std::ldexp(std::frexp(x, &exponent), 53);
  return Fraction(static_cast<long long>(mantissa)) * power_of_two(exponent - 53);
}

inline Fraction fraction(const Rational& x) {
  return Fraction(x.numerator(), x.denominator()) * power_of_two(static_cast<long>(x.exponent()));
}

// Returns the value at t of the polynomial with these control points.
inline Fraction de_casteljau(std::vector<Fraction> points, const Fraction& t) {
  for (std::size_t last = points.size() - 1; last > 0; --last) {
    for (std::size_t i = 0; i < last; ++i) points[i] = (1 - t) * points[i] + t * points[i + 1];
  }
  return points[0];
}

// Returns the derivative at t: n times the difference of the last two points of the construction.
inline Fraction de_casteljau_derivative(std::vector<Fraction> points, const Fraction& t) {
  const std::size_t n = points.size() - 1;
  if (n == 0) return 0;
  for (std::size_t last = n; last > 1; --last) {
    for (std::size_t i = 0; i < last; ++i) points[i] = (1 - t) * points[i] + t * points[i + 1];
  }
  return n * Fraction(points[1] - points[0]);
}

// Returns SUM C(n,i) * |t|^i * |s|^(n-i) * |R_i|, term by term.
inline Fraction term_by_term(const std::vector<Fraction>& points, const Fraction& t, const Fraction& s) {
  const std::size_t n = points.size() - 1;
  Fraction sum = 0, binomial = 1;
  for (std::size_t i = 0; i <= n; ++i) {
    Fraction term = binomial * abs(points[i]);
    for (std::size_t j = 0; j < n; ++j) term *= abs(j < i ? t : s);
    sum += term;
    binomial = binomial * (n - i) / (i + 1);
  }
  return sum;
}

}  // namespace evalcts::reference
