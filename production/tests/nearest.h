// The oracle of correct rounding: polynomials as fractions of integers, and the float nearest a fraction,
// found by bisection. It shares only the types of arguments with the library.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "exact.h"
#include "src/parameter.h"

namespace glev_tests {

// The fraction numerator / denominator, not reduced; denominator > 0.
struct Fraction {
  Integer numerator, denominator;
};

// Returns t of a grid argument. A real argument is {{u, u, 1}, 0}.
inline Rational exact_t(const glev::Domain& domain, const glev::GridArgument& at) {
  const Rational u = to_rational(at.grid.u1) + (to_rational(at.grid.u2) - to_rational(at.grid.u1)) *
                                                   Rational(Integer(at.index), Integer(at.grid.segments));
  return (u - to_rational(domain.u1)) / (to_rational(domain.u2) - to_rational(domain.u1));
}

// Returns C(n, i) p^i (q - p)^(n - i) for t = p / q.
inline std::vector<Integer> integer_basis(const Rational& t, int order) {
  const Integer p = numerator(t), rest = denominator(t) - p;
  std::vector<Integer> basis(order, 1);
  Integer power = 1, binomial = 1;
  for (int i = 1; i < order; ++i) basis[i] = basis[i - 1] * p;
  for (int i = order - 1; i >= 0; --i) {
    basis[i] *= power * binomial;
    power *= rest;
    binomial = binomial * i / (order - i);
  }
  return basis;
}

// Returns the value at t of the polynomial with these control points, v fastest. A curve has order 1 in v.
inline Fraction exact_value(const std::vector<double>& points, std::array<int, 2> order, const Rational& t_u,
                            const Rational& t_v) {
  constexpr int kScale = 1074;  // every double is a multiple of 2^-1074
  const std::vector<Integer> in_u = integer_basis(t_u, order[0]), in_v = integer_basis(t_v, order[1]);
  Fraction value = {0, pow(denominator(t_u), order[0] - 1) * pow(denominator(t_v), order[1] - 1)};
  for (int i = 0; i < order[0]; ++i) {
    Integer row = 0;
    for (int j = 0; j < order[1]; ++j) {
      int exponent = 0;
      const double fraction = std::frexp(points[i * order[1] + j], &exponent);
      // The term is multiplied by 2^kScale. The remaining factor 2^(exponent - 53 + kScale) is at least 1/2.
      Integer term = in_v[j] * static_cast<long long>(std::ldexp(fraction, 53));
      const int shift = exponent - 53 + kScale;
      if (shift >= 0) {
        term <<= shift;
      } else {
        term /= Integer(1) << -shift;  // exact: the lowest bits of a subnormal number are zero
      }
      row += term;
    }
    value.numerator += in_u[i] * row;
  }
  value.denominator <<= kScale;
  return value;
}

// Returns the nearest float, ties to even, and infinity from 2^128 - 2^103 on. Zero gives +0; other numbers
// that round to zero keep their sign.
inline float nearest_float(const Fraction& x) {
  const Integer magnitude = abs(x.numerator) << 150;
  // Compares the magnitude with the midpoint of the float of these bits and the next one, in units of 2^-150.
  const auto compare = [&](std::uint32_t bits) {
    const std::uint32_t field = bits >> 23, fraction = bits & 0x7FFFFF;
    Integer middle = 2 * (field == 0 ? fraction : fraction + 0x800000) + 1;
    middle <<= field == 0 ? 0 : field - 1;
    return magnitude.compare(middle * x.denominator);
  };
  std::uint32_t low = 0, high = 0x7F800000;  // the first float whose midpoint with the next is above
  while (low < high) {
    const std::uint32_t middle = (low + high) / 2;
    const int side = compare(middle);
    if (side > 0 || (side == 0 && middle % 2 == 1)) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return std::bit_cast<float>(low | (x.numerator < 0 ? 0x80000000U : 0U));
}

}  // namespace glev_tests
