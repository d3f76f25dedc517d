// The oracle of these tests: the formulas of the GL in exact arithmetic, or with 600 binary digits, and the
// float nearest a rational number, found by bisection. It shares no code with the library or ../../reference.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace glev_tests {

using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;
// For lengths, which are not rational.
using Wide = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<600, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

// Every double is a multiple of 2^-kScale.
inline constexpr int kScale = 1074;

// Returns a finite double as a number; as an Integer, times 2^kScale.
template <class Number>
Number convert(double x) {
  if constexpr (std::is_same_v<Number, Integer>) {
    int exponent = 0;
    const double fraction = std::frexp(x, &exponent);
    const Integer significand(static_cast<long long>(std::ldexp(fraction, 53)));
    const int shift = exponent - 53 + kScale;
    if (shift >= 0) return significand << shift;
    return significand / (Integer(1) << -shift);  // exact: the lowest bits of a subnormal number are zero
  } else if constexpr (std::is_same_v<Number, Rational>) {
    return Rational(convert<Integer>(x), Integer(1) << kScale);
  } else {
    return Number(x);
  }
}

inline Rational to_rational(double x) { return convert<Rational>(x); }

// Returns (u - u1) / (u2 - u1).
inline Rational exact_t(double u1, double u2, double u) {
  return (to_rational(u) - to_rational(u1)) / (to_rational(u2) - to_rational(u1));
}
// Returns t of a grid argument. A real argument is {{u, u, 1}, 0}.
template <class Domain, class GridArgument>
Rational exact_t(const Domain& domain, const GridArgument& at) {
  const Rational from = to_rational(at.grid.u1), to = to_rational(at.grid.u2);
  const Rational u = from + (to - from) * Rational(Integer(at.index), Integer(at.grid.segments));
  return (u - to_rational(domain.u1)) / (to_rational(domain.u2) - to_rational(domain.u1));
}

// Returns the Bernstein polynomials of degree n = order - 1 at t = a / (a + b), times (a + b)^n: C(n,i) a^i
// b^(n-i). Derivatives by t have the factor (a + b)^(n - derivative), and follow the recurrence
// d B(i,n) / dt = n (B(i-1,n-1) - B(i,n-1)).
template <class Number>
std::vector<Number> bernstein(int order, const Number& a, const Number& b, int derivative = 0) {
  std::vector<Number> basis(static_cast<std::size_t>(order), Number(derivative == 0 ? 1 : 0));
  if (derivative > 0) {
    if (order == 1) return basis;
    const std::vector<Number> lower = bernstein(order - 1, a, b, derivative - 1);
    for (std::size_t i = 0; i < lower.size(); ++i) {
      basis[i] -= (order - 1) * lower[i];
      basis[i + 1] += (order - 1) * lower[i];
    }
    return basis;
  }
  for (std::size_t i = 1; i < basis.size(); ++i) basis[i] = basis[i - 1] * a;
  Number power = 1, binomial = 1;
  for (int i = order - 1; i >= 0; --i) {
    basis[static_cast<std::size_t>(i)] *= power * binomial;
    power *= b;
    binomial = binomial * i / (order - i);
  }
  return basis;
}

template <class Number>
struct Sum {
  Number value = 0, magnitude = 0;  // sum of the terms, sum of their absolute values
};

// Returns the sum of u[i] * v[j] * R_ij, v fastest, for component k of points with `components` values.
template <class Number>
Sum<Number> tensor(const std::vector<Number>& u, const std::vector<Number>& v,
                   const std::vector<double>& points, int components = 1, int k = 0) {
  Sum<Number> sum;
  std::size_t at = static_cast<std::size_t>(k);
  for (const Number& u_i : u) {
    Sum<Number> row;
    for (const Number& v_j : v) {
      const Number term = v_j * convert<Number>(points[at]);
      row.value += term;
      row.magnitude += abs(term);
      at += static_cast<std::size_t>(components);
    }
    sum.value += u_i * row.value;
    sum.magnitude += abs(u_i) * row.magnitude;
  }
  return sum;
}

// Returns a point of the polynomial with these control points, v fastest, or its derivative by t_u and t_v. A
// curve has order 1 in v. The only divisions are at the end.
inline Sum<Rational> exact_point(const std::vector<double>& points, std::array<int, 2> order,
                                 const Rational& t_u, const Rational& t_v = 0,
                                 std::array<int, 2> derivative = {}, int components = 1, int k = 0) {
  const auto basis = [&](std::size_t d, const Rational& t) {
    return bernstein<Integer>(order[d], numerator(t), denominator(t) - numerator(t), derivative[d]);
  };
  const auto whole = [&](std::size_t d, const Rational& t) -> Integer {
    return pow(denominator(t), static_cast<unsigned>(std::max(order[d] - 1 - derivative[d], 0)));
  };
  const Sum<Integer> sum = tensor(basis(0, t_u), basis(1, t_v), points, components, k);
  const Integer divisor = whole(0, t_u) * whole(1, t_v) << kScale;
  return {Rational(sum.value, divisor), Rational(sum.magnitude, divisor)};
}

// Returns the nearest float, ties to even, and infinity from 2^128 - 2^103 on. Zero gives +0; other numbers
// that round to zero keep their sign.
inline float nearest_float(const Rational& x) {
  const Integer magnitude = abs(numerator(x)) << 150;
  // Compares the magnitude with the midpoint of the float of these bits and the next one, in units of 2^-150.
  const auto compare = [&](std::uint32_t bits) {
    const std::uint32_t field = bits >> 23, fraction = bits & 0x7FFFFF;
    Integer midpoint = 2 * (field == 0 ? fraction : fraction + 0x800000) + 1;
    midpoint <<= field == 0 ? 0 : field - 1;
    return magnitude.compare(midpoint * denominator(x));
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
  return std::bit_cast<float>(low | (x < 0 ? 0x80000000U : 0U));
}

// ---- Vectors with 600 binary digits

using WideVector = std::array<Wide, 3>;

inline WideVector cross_product(const WideVector& a, const WideVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Wide length_of(const WideVector& v) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

}  // namespace glev_tests
