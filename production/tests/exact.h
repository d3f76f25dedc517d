// The slow oracle of these tests: the formula of the GL in exact rational arithmetic. It shares no code with
// the library.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <vector>

namespace glev_tests {

using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;

// Returns the value of a finite double.
inline Rational to_rational(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  const Integer mantissa(static_cast<long long>(std::ldexp(fraction, 53)));
  exponent -= 53;
  return exponent >= 0 ? Rational(mantissa << exponent) : Rational(mantissa, Integer(1) << -exponent);
}

struct ExactPoint {
  Rational value;      // sum of C(n,i) t^i s^(n-i) R_i
  Rational magnitude;  // sum of the absolute values
};

inline ExactPoint exact_bezier(double u1, double u2, const std::vector<double>& points, double u) {
  // t = a / (a + b). The common denominator is (a + b)^n, so the only division is at the end.
  const Rational a = to_rational(u) - to_rational(u1), b = to_rational(u2) - to_rational(u);
  const std::size_t n = points.size() - 1;
  std::vector<Rational> powers_of_b(n + 1, 1);
  for (std::size_t i = 1; i <= n; ++i) powers_of_b[i] = powers_of_b[i - 1] * b;
  Rational power_of_a = 1, binomial = 1, whole = 1;
  ExactPoint sum;
  for (std::size_t i = 0; i <= n; ++i) {
    const Rational term = binomial * power_of_a * powers_of_b[n - i] * to_rational(points[i]);
    sum.value += term;
    sum.magnitude += abs(term);
    power_of_a *= a;
    binomial = binomial * (n - i) / (i + 1);
    if (i < n) whole *= a + b;
  }
  return {sum.value / whole, abs(sum.magnitude / whole)};
}

// The Bernstein polynomials of one direction at one argument, and their derivatives by t, by the textbook
// formulas.
struct ExactBasis {
  std::vector<Rational> values, derivatives;
};

inline ExactBasis exact_basis(double u1, double u2, std::size_t order, double u) {
  const Rational t = (to_rational(u) - to_rational(u1)) / (to_rational(u2) - to_rational(u1)), s = 1 - t;
  std::vector<Rational> powers_of_t = {1}, powers_of_s = {1};
  for (std::size_t i = 1; i < order; ++i) {
    powers_of_t.push_back(powers_of_t.back() * t);
    powers_of_s.push_back(powers_of_s.back() * s);
  }
  const std::size_t n = order - 1;
  Rational binomial = 1;
  ExactBasis basis;
  for (std::size_t i = 0; i <= n; ++i) {
    basis.values.push_back(binomial * powers_of_t[i] * powers_of_s[n - i]);
    Rational slope = 0;
    if (i > 0) slope += i * powers_of_t[i - 1] * powers_of_s[n - i];
    if (i < n) slope -= (n - i) * powers_of_t[i] * powers_of_s[n - i - 1];
    basis.derivatives.push_back(binomial * slope);
    binomial = binomial * (n - i) / (i + 1);
  }
  return basis;
}

// Returns the sum of u[i] * v[j] * R_ij, v fastest, for component k of points with `components` values.
inline ExactPoint tensor(const std::vector<Rational>& u, const std::vector<Rational>& v,
                         const std::vector<double>& points, std::size_t components = 1, std::size_t k = 0) {
  ExactPoint sum;
  for (std::size_t i = 0; i < u.size(); ++i) {
    ExactPoint row;
    for (std::size_t j = 0; j < v.size(); ++j) {
      const Rational term = v[j] * to_rational(points[(i * v.size() + j) * components + k]);
      row.value += term;
      row.magnitude += abs(term);
    }
    sum.value += u[i] * row.value;
    sum.magnitude += abs(u[i]) * row.magnitude;
  }
  return sum;
}

}  // namespace glev_tests
