// Bernstein sums over integers of any size.
#include "homogeneous.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "binary.h"

namespace evalcts::reference {
namespace {

using BinomialTable = std::array<std::array<std::uint64_t, kMaxOrder>, kMaxOrder>;

constexpr BinomialTable pascal() {
  BinomialTable table{};
  for (int n = 0; n < kMaxOrder; ++n) {
    table[n][0] = 1;
    for (int i = 1; i <= n; ++i) table[n][i] = table[n - 1][i - 1] + (i < n ? table[n - 1][i] : 0);
  }
  return table;
}

constexpr BinomialTable kBinomials = pascal();  // the largest, C(63,31), has 60 bits

Integer scaled(const Binary& x, int exponent) {
  Integer integer = x.significand;
  if (x.significand != 0) integer <<= x.exponent - exponent;
  return integer;
}

Integer dot(const std::vector<Integer>& weights, const Integer* values) {
  Integer sum = 0;
  for (const Integer& weight : weights) sum += weight * *values++;
  return sum;
}

}  // namespace

void check(const Surface& surface, const Argument& u, const Argument& v) {
  for (const int order : {surface.u.order, surface.v.order})
    if (order < 1 || order > kMaxOrder) throw std::invalid_argument("order outside 1..64");
  for (const Direction& direction : {surface.u, surface.v})
    if (direction.first == direction.last) throw std::domain_error("empty domain");
  if (!is_finite(surface)) throw std::domain_error("a domain end or a control value is not finite");
  if (!u.is_finite() || !v.is_finite()) throw std::domain_error("an argument is not finite");
}

std::uint64_t binomial(int n, int i) { return kBinomials[n][i]; }

Homogeneous homogenise(const Argument& u, const Direction& direction) {
  // A grid point is u = ((n - i) * g1 + i * g2) / n. For a coordinate, n = 1 and u = g1.
  const std::array<Binary, 4> numbers{decompose(u.first()), decompose(u.last()), decompose(direction.first),
                                      decompose(direction.last)};
  const int exponent = common_exponent(numbers);
  Integer x = scaled(numbers[0], exponent);
  Integer x1 = scaled(numbers[2], exponent), x2 = scaled(numbers[3], exponent);
  if (u.is_grid()) {
    const Integer n = u.segments(), i = u.index();
    x = (n - i) * x + i * scaled(numbers[1], exponent);
    x1 *= n;
    x2 *= n;
  }
  Homogeneous t{x - x1, x2 - x, x2 - x1};
  if (t.c.sign() < 0) {
    t.a.backend().negate();
    t.b.backend().negate();
    t.c.backend().negate();
  }
  // Common divisors of a and b divide c, because a + b = c.
  const unsigned zeros = t.a.is_zero()   ? trailing_zeros(t.b)
                         : t.b.is_zero() ? trailing_zeros(t.a)
                                         : std::min(trailing_zeros(t.a), trailing_zeros(t.b));
  if (zeros != 0) {
    t.a >>= zeros;
    t.b >>= zeros;
    t.c >>= zeros;
  }
  return t;
}

Homogeneous homogenise(const Rational& t, const Rational& s) {
  Integer a = t.numerator(), b = s.numerator(), c = t.denominator();
  if (t.denominator() != s.denominator()) {
    a *= s.denominator();
    b *= t.denominator();
    c *= s.denominator();
  }
  const std::int64_t exponent = std::min<std::int64_t>({t.exponent(), s.exponent(), 0});
  a <<= t.exponent() - exponent;
  b <<= s.exponent() - exponent;
  c <<= -exponent;
  return {std::move(a), std::move(b), std::move(c)};
}

Weights bernstein_weights(const Homogeneous& t, int n) {
  Weights weights{std::vector<Integer>(n + 1), pow(t.c, static_cast<unsigned>(n))};
  Integer power = 1;
  for (int i = 0; i <= n; ++i, power *= t.a) weights.values[i] = power * binomial(n, i);
  power = 1;
  for (int i = n; i >= 0; --i, power *= t.b) weights.values[i] *= power;
  return weights;
}

Net integer_net(const Surface& surface) {
  Net net{surface.u.order, surface.v.order, {}, 0};
  std::vector<Binary> binary;
  binary.reserve(static_cast<std::size_t>(net.rows) * net.columns);
  for (int i = 0; i < net.rows; ++i) {
    for (int j = 0; j < net.columns; ++j) binary.push_back(decompose(surface.at(i, j)));
  }
  const int exponent = common_exponent(binary);
  net.exponent = exponent;
  net.values.reserve(binary.size());
  for (const Binary& x : binary) net.values.push_back(scaled(x, exponent));
  return net;
}

Net magnitudes(Net net) {
  for (Integer& value : net.values) value = abs(value);
  return net;
}

Weights magnitudes(Weights weights) {
  for (Integer& value : weights.values) value = abs(value);
  return weights;
}

namespace {

Net neighbours(const Net& net, int rows, int columns, std::size_t distance, int sign) {
  Net result{rows, columns, {}, net.exponent};
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const Integer* value = &net.values[static_cast<std::size_t>(i) * net.columns + j];
      result.values.push_back(value[distance] + sign * value[0]);
    }
  }
  return result;
}

}  // namespace

Net neighbours_u(const Net& net, int sign) {
  return neighbours(net, net.rows - 1, net.columns, net.columns, sign);
}

Net neighbours_v(const Net& net, int sign) { return neighbours(net, net.rows, net.columns - 1, 1, sign); }

Rational bernstein_sum(const Net& net, const Weights& u, const Weights& v) {
  std::vector<Integer> rows;
  rows.reserve(net.rows);
  for (int i = 0; i < net.rows; ++i) {
    rows.push_back(dot(v.values, &net.values[static_cast<std::size_t>(i) * net.columns]));
  }
  return Rational(dot(u.values, rows.data()), u.denominator * v.denominator, net.exponent);
}

}  // namespace evalcts::reference
