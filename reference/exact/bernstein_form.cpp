// Exact evaluation in short integers if the data permit, otherwise in integers of any size.
#include <reference/bernstein_form.h>

#include <bit>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "homogeneous.h"
#include "leading_bits.h"
#include "short_sum.h"

namespace evalcts::reference {
namespace {

// c^n = denominator * 2^exponent with an odd denominator.
struct Power {
  Integer denominator;
  std::int64_t exponent;
};

Power power_of(std::int64_t c, int n) {
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(c));
  const std::int64_t odd = c >> zeros;
  return {odd == 1 ? Integer(1) : pow(Integer(odd), static_cast<unsigned>(n)), std::int64_t{n} * zeros};
}

void check_argument(const Argument& argument) {
  if (!argument.is_finite()) throw std::domain_error("an argument is not finite");
}

}  // namespace

struct BernsteinForm::Data {
  std::vector<double> points;  // R_ij = points[i * vorder + j]
  int uorder, vorder;
  double u1, u2, v1, v2;
  bool is_curve;
  std::optional<ShortTerms> terms;

  Data(const Surface& surface, bool curve);

  Evaluation evaluate_generally(const Argument& u, const Argument& v) const;
  // Computes the sum and returns its divisor, or nothing if the numbers are too long.
  template <bool kMagnitude>
  std::optional<Power> sum_of(const Argument& u, const Argument& v, ShortSum& sum) const;
  template <typename Float>
  Float rounded(const Argument& u, const Argument& v) const;
};

BernsteinForm::Data::Data(const Surface& surface, bool curve)
    : uorder(surface.uorder),
      vorder(surface.vorder),
      u1(surface.u1),
      u2(surface.u2),
      v1(surface.v1),
      v2(surface.v2),
      is_curve(curve) {
  for (const int order : {uorder, vorder}) {
    if (order < 1 || order > kMaxOrder) throw std::invalid_argument("order outside 1..64");
  }
  for (const double end : {u1, u2, v1, v2}) {
    if (!std::isfinite(end)) throw std::domain_error("a domain end is not finite");
  }
  if (u1 == u2 || v1 == v2) throw std::domain_error("empty domain");
  points.reserve(static_cast<std::size_t>(uorder) * vorder);
  for (std::ptrdiff_t i = 0; i < uorder; ++i) {
    for (std::ptrdiff_t j = 0; j < vorder; ++j) {
      points.push_back(surface.points[i * surface.ustride + j * surface.vstride]);
    }
  }
  terms = short_terms(points, uorder, vorder);
}

Evaluation BernsteinForm::Data::evaluate_generally(const Argument& u, const Argument& v) const {
  const Net net = integer_net(Surface{points.data(), vorder, 1, uorder, vorder, u1, u2, v1, v2});
  if (is_curve) return bernstein_sum(net, homogenise(u, u1, u2));
  return bernstein_sum(net, homogenise(u, u1, u2), homogenise(v, v1, v2));
}

template <bool kMagnitude>
std::optional<Power> BernsteinForm::Data::sum_of(const Argument& u, const Argument& v, ShortSum& sum) const {
  check_argument(u);
  if (!is_curve) check_argument(v);
  if (!terms) return std::nullopt;
  ShortHomogeneous s{0, 1, 1}, t{0, 1, 1};  // arbitrary for a constant
  const auto homogenise_into = [](ShortHomogeneous& result, const Argument& x, double x1, double x2) {
    const auto found = homogenise_short(x, x1, x2);
    if (found) result = *found;
    return found.has_value();
  };
  if (uorder > 1 && !homogenise_into(s, u, u1, u2)) return std::nullopt;
  if (vorder > 1 && !homogenise_into(t, v, v1, v2)) return std::nullopt;
  if (vorder == 1) {
    short_sum<kMagnitude>(*terms, s, sum);
    return power_of(s.c, uorder - 1);
  }
  if (uorder == 1) {
    short_sum<kMagnitude>(*terms, t, sum);
    return power_of(t.c, vorder - 1);
  }
  short_sum<kMagnitude>(*terms, s, t, sum);
  const Power along_u = power_of(s.c, uorder - 1), along_v = power_of(t.c, vorder - 1);
  return Power{along_u.denominator * along_v.denominator, along_u.exponent + along_v.exponent};
}

template <typename Float>
Float BernsteinForm::Data::rounded(const Argument& u, const Argument& v) const {
  ShortSum sum;
  const std::optional<Power> divisor = sum_of<false>(u, v, sum);
  if (!divisor) return round_to<Float>(evaluate_generally(u, v).value);
  Natural numerator;
  const bool negative = Natural::subtract(sum.positive, sum.negative, numerator);
  if (numerator.is_zero()) return 0;
  const std::int64_t exponent = terms->exponent - divisor->exponent;
  if (divisor->denominator == 1) {
    return round_leading<Float>(negative, numerator.leading_bits(), exponent + numerator.bits() - 64);
  }
  return round_to<Float>(Rational(numerator.to_integer(negative), divisor->denominator, exponent));
}

BernsteinForm::BernsteinForm(const Curve& curve)
    : data_(std::make_unique<Data>(
          Surface{curve.points, curve.stride, 0, curve.order, 1, curve.u1, curve.u2, 0, 1}, true)) {}
BernsteinForm::BernsteinForm(const Surface& surface) : data_(std::make_unique<Data>(surface, false)) {}
BernsteinForm::BernsteinForm(BernsteinForm&&) noexcept = default;
BernsteinForm& BernsteinForm::operator=(BernsteinForm&&) noexcept = default;
BernsteinForm::~BernsteinForm() = default;

Rational BernsteinForm::evaluate(const Argument& u, const Argument& v) const {
  ShortSum sum;
  const std::optional<Power> divisor = data_->sum_of<false>(u, v, sum);
  if (!divisor) return data_->evaluate_generally(u, v).value;
  Natural numerator;
  const bool negative = Natural::subtract(sum.positive, sum.negative, numerator);
  return Rational(numerator.to_integer(negative), divisor->denominator,
                  data_->terms->exponent - divisor->exponent);
}

Evaluation BernsteinForm::evaluate_with_magnitude(const Argument& u, const Argument& v) const {
  ShortSum sum;
  const std::optional<Power> divisor = data_->sum_of<true>(u, v, sum);
  if (!divisor) return data_->evaluate_generally(u, v);
  const Integer positive = sum.positive.to_integer(), negative = sum.negative.to_integer();
  const std::int64_t exponent = data_->terms->exponent - divisor->exponent;
  return {Rational(positive - negative, divisor->denominator, exponent),
          Rational(positive + negative, divisor->denominator, exponent)};
}

float BernsteinForm::to_float(const Argument& u, const Argument& v) const {
  return data_->rounded<float>(u, v);
}
double BernsteinForm::to_double(const Argument& u, const Argument& v) const {
  return data_->rounded<double>(u, v);
}

}  // namespace evalcts::reference
