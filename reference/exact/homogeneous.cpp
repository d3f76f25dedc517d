// Bernstein sums over integers of any size.
#include "homogeneous.h"

#include <algorithm>
#include <array>
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

// A sum with separate positive and negative terms, so that one pass gives value and magnitude.
struct Parts {
  Integer positive, negative;  // both >= 0
};

Evaluation finish(const Parts& sum, const Integer& denominator, std::int64_t exponent) {
  return {Rational(sum.positive - sum.negative, denominator, exponent),
          Rational(sum.positive + sum.negative, denominator, exponent)};
}

// Computes SUM i=0..n of C(n,i) * a^i * b^(n-i) * R_i by Horner's scheme. add(i, weight, negative, sum) must
// add weight * R_i, or -weight * R_i if `negative`, to the sum.
template <typename Add>
Parts horner(const Homogeneous& t, int n, Add&& add) {
  const Integer a = abs(t.a), b = abs(t.b);
  const bool a_negative = t.a.sign() < 0, b_negative = t.b.sign() < 0;
  Parts sum;
  Integer power = 1, weight;
  for (int i = 0; i <= n; ++i) {
    if (i > 0) {
      sum.positive *= b;
      sum.negative *= b;
      power *= a;
      if (power.is_zero()) continue;
    }
    weight = power * binomial(n, i);
    const bool negative = (a_negative && i % 2 != 0) != (b_negative && (n - i) % 2 != 0);
    add(i, weight, negative, sum);
  }
  return sum;
}

// The argument `add` of horner() for the control values R_i = values[i].
class Row {
 public:
  explicit Row(const Integer* values) : values_(values) {}
  void operator()(int i, const Integer& weight, bool negative, Parts& sum) {
    const Integer& value = values_[i];
    if (value.is_zero()) return;
    product_ = weight * value;
    if (value.sign() < 0) product_.backend().negate();
    ((value.sign() < 0) != negative ? sum.negative : sum.positive) += product_;
  }

 private:
  const Integer* values_;
  Integer product_;
};

void check_order(int order) {
  if (order < 1 || order > kMaxOrder) throw std::invalid_argument("order outside 1..64");
}

}  // namespace

std::uint64_t binomial(int n, int i) { return kBinomials[n][i]; }

Homogeneous homogenise(const Argument& u, double u1, double u2) {
  if (u1 == u2) throw std::domain_error("empty domain");
  // A grid point is u = ((n - i) * g1 + i * g2) / n. For a coordinate, n = 1 and u = g1.
  const std::array<Binary, 4> numbers{decompose(u.first()), decompose(u.last()), decompose(u1),
                                      decompose(u2)};
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

Net integer_net(const Curve& curve) {
  return integer_net(Surface{curve.points, curve.stride, 0, curve.order, 1, curve.u1, curve.u2, 0, 1});
}

Net integer_net(const Surface& surface) {
  check_order(surface.uorder);
  check_order(surface.vorder);
  Net net{surface.uorder, surface.vorder, {}, 0};
  std::vector<Binary> binary;
  binary.reserve(static_cast<std::size_t>(net.rows) * net.columns);
  for (std::ptrdiff_t i = 0; i < net.rows; ++i) {
    for (std::ptrdiff_t j = 0; j < net.columns; ++j) {
      binary.push_back(decompose(surface.points[i * surface.ustride + j * surface.vstride]));
    }
  }
  const int exponent = common_exponent(binary);
  net.exponent = exponent;
  net.values.reserve(binary.size());
  for (const Binary& x : binary) net.values.push_back(scaled(x, exponent));
  return net;
}

Net differences_u(const Net& net) {
  Net result{net.rows - 1, net.columns, {}, net.exponent};
  for (std::size_t i = 0; i + net.columns < net.values.size(); ++i) {
    result.values.push_back(net.values[i + net.columns] - net.values[i]);
  }
  return result;
}

Net differences_v(const Net& net) {
  Net result{net.rows, net.columns - 1, {}, net.exponent};
  for (std::size_t i = 0; i < net.values.size(); ++i) {
    if ((i + 1) % net.columns != 0) result.values.push_back(net.values[i + 1] - net.values[i]);
  }
  return result;
}

Net magnitudes(Net net) {
  for (Integer& value : net.values) value = abs(value);
  return net;
}

Evaluation bernstein_sum(const Net& net, const Homogeneous& u) {
  const int n = net.rows - 1;
  return finish(horner(u, n, Row(net.values.data())), pow(u.c, static_cast<unsigned>(n)), net.exponent);
}

Evaluation bernstein_sum(const Net& net, const Homogeneous& u, const Homogeneous& v) {
  const int n = net.rows - 1, m = net.columns - 1;
  const Parts sum = horner(u, n, [&](int i, const Integer& weight, bool negative, Parts& total) {
    const Parts row = horner(v, m, Row(&net.values[static_cast<std::size_t>(i) * net.columns]));
    (negative ? total.negative : total.positive) += weight * row.positive;
    (negative ? total.positive : total.negative) += weight * row.negative;
  });
  const Integer denominator = pow(u.c, static_cast<unsigned>(n)) * pow(v.c, static_cast<unsigned>(m));
  return finish(sum, denominator, net.exponent);
}

}  // namespace evalcts::reference
