// Rounding and comparison of m/|m| by squares: the square of each component is rational, so no root is
// approximated.
#include <reference/normal.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace evalcts::reference {
namespace {

Rational squared_length(const Vector& m) { return m[0] * m[0] + m[1] * m[1] + m[2] * m[2]; }

Rational nonzero_squared_length(const Vector& m) {
  Rational square = squared_length(m);
  if (square.is_zero()) throw std::domain_error("a vector of length zero has no direction");
  return square;
}

void check_bits(int bits) {
  if (bits < 0) throw std::invalid_argument("a negative number of bits");
}

// The value floor(2^bits * sqrt(x)); `exact` is true if it equals 2^bits * sqrt(x).
struct Root {
  Integer floor;
  bool exact;
};

Root scaled_root(const Rational& x, std::int64_t bits) {
  Integer numerator = x.numerator(), denominator = x.denominator();
  const std::int64_t shift = x.exponent() + 2 * bits;
  (shift >= 0 ? numerator : denominator) <<= std::abs(shift);
  Integer quotient, remainder, rest;
  divide_qr(numerator, denominator, quotient, remainder);
  const Integer root = sqrt(quotient, rest);
  return {root, rest.is_zero() && remainder.is_zero()};
}

Interval enclose_root(const Rational& x, std::int64_t bits) {
  const Root root = scaled_root(x, bits);
  return {Rational(root.floor, 1, -bits), Rational(root.exact ? root.floor : root.floor + 1, 1, -bits)};
}

// Returns each component of m/|m|, rounded to nearest.
template <typename Float>
std::array<Float, 3> rounded_to(const Vector& m) {
  using Limits = std::numeric_limits<Float>;
  constexpr std::int64_t kLowest = Limits::min_exponent - Limits::digits;  // the smallest exponent of an ULP
  const Rational square = nonzero_squared_length(m);
  std::array<Float, 3> result{};
  for (int c = 0; c < 3; ++c) {
    if (m[c].is_zero()) continue;
    const Rational ratio = m[c] * m[c] / square;
    const std::int64_t twice_magnitude = floor_log2(ratio);
    const std::int64_t magnitude = (twice_magnitude - (twice_magnitude & 1)) / 2;
    const std::int64_t unit = std::max<std::int64_t>(magnitude - (Limits::digits - 1), kLowest);
    // One extra bit decides the rounding, because there are no ties.
    const Integer halves = scaled_root(ratio, 1 - unit).floor;
    const auto significand = static_cast<Float>(static_cast<std::uint64_t>((halves + 1) >> 1));
    result[c] =
        std::copysign(std::ldexp(significand, static_cast<int>(unit)), static_cast<Float>(m[c].sign()));
  }
  return result;
}

// Returns x * |x|, which has the same order as x.
Rational signed_square(const Rational& x) { return x * abs(x); }

// Returns true if |x - y| <= bound for x = a/sqrt(a_square) and y = b/sqrt(b_square). This is equivalent to
//   x^2 + y^2 - bound^2 <= 2xy,
// and both sides keep their order when squared with their signs.
bool differ_at_most(const Rational& a, const Rational& a_square, const Rational& b, const Rational& b_square,
                    const Rational& bound) {
  const Rational left = a * a * b_square + b * b * a_square - bound * bound * a_square * b_square;
  return signed_square(left) <= 4 * signed_square(a * b) * a_square * b_square;
}

// Returns true if each component of g / sqrt(g_square) lies within `bound` of that of m/|m| or, with
// `either_sign`, of -m/|m|.
bool components_within(const Vector& g, const Rational& g_square, const Vector& m, const Rational& bound,
                       bool either_sign) {
  const Rational m_square = nonzero_squared_length(m);
  if (bound.sign() < 0) return false;
  const auto within = [&](int sign) {
    for (int c = 0; c < 3; ++c)
      if (!differ_at_most(g[c], g_square, sign * m[c], m_square, bound)) return false;
    return true;
  };
  return within(1) || (either_sign && within(-1));
}

bool is_finite(const std::array<float, 3>& vector) {
  return std::all_of(vector.begin(), vector.end(), [](float x) { return std::isfinite(x); });
}

Vector exact(const std::array<float, 3>& vector) { return {vector[0], vector[1], vector[2]}; }

}  // namespace

std::array<Interval, 3> unit_vector(const Vector& m, int bits) {
  check_bits(bits);
  const Rational square = nonzero_squared_length(m);
  std::array<Interval, 3> result;
  for (int c = 0; c < 3; ++c) {
    const Interval magnitude = enclose_root(m[c] * m[c] / square, bits);
    result[c] = m[c].sign() < 0 ? Interval{-magnitude.high, -magnitude.low} : magnitude;
  }
  return result;
}

std::array<float, 3> rounded_unit_vector(const Vector& m) { return rounded_to<float>(m); }

std::array<double, 3> rounded_unit_vector_to_double(const Vector& m) { return rounded_to<double>(m); }

Interval length(const Vector& m, int bits) {
  check_bits(bits);
  const Rational square = squared_length(m);
  if (square.is_zero()) return {0, 0};
  // |m| >= 2^(floor_log2(square)/2), rounded down.
  return enclose_root(square, bits - floor_log2(square) / 2 + 1);
}

bool is_within(const std::array<float, 3>& got, const Vector& m, const Rational& bound, bool either_sign) {
  if (!is_finite(got)) return false;
  return components_within(exact(got), 1, m, bound, either_sign);
}

bool direction_is_within(const std::array<float, 3>& got, const Vector& m, const Rational& bound,
                         bool either_sign) {
  if (!is_finite(got) || is_degenerate(exact(got))) return false;
  return components_within(exact(got), squared_length(exact(got)), m, bound, either_sign);
}

}  // namespace evalcts::reference
