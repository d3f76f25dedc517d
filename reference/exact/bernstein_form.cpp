// Exact evaluation in short integers if the data permit, otherwise in integers of any size.
#include <reference/bernstein_form.h>

#include <bit>
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

}  // namespace

struct BernsteinForm::Data {
  std::vector<double> points;
  Surface surface;  // with points[i * v.order + j]
  std::optional<ShortTerms> terms;

  explicit Data(const Surface& given);

  Evaluation evaluate_generally(const Argument& u, const Argument& v) const;
  // Computes the sum and returns its divisor, or nothing if the numbers are too long.
  template <bool kMagnitude>
  std::optional<Power> sum_of(const Argument& u, const Argument& v, ShortSum& sum) const;
  template <typename Float>
  Float rounded(const Argument& u, const Argument& v) const;
};

BernsteinForm::Data::Data(const Surface& given) : surface(given) {
  check(given);
  const int uorder = given.u.order, vorder = given.v.order;
  points.reserve(static_cast<std::size_t>(uorder) * vorder);
  for (int i = 0; i < uorder; ++i) {
    for (int j = 0; j < vorder; ++j) points.push_back(given.at(i, j));
  }
  surface.points = points.data();
  surface.u.stride = vorder;
  surface.v.stride = 1;
  terms = short_terms(points, uorder, vorder);
}

Evaluation BernsteinForm::Data::evaluate_generally(const Argument& u, const Argument& v) const {
  const Net net = integer_net(surface);
  const Weights along_u = bernstein_weights(homogenise(u, surface.u), surface.u.order - 1);
  const Weights along_v = bernstein_weights(homogenise(v, surface.v), surface.v.order - 1);
  return {bernstein_sum(net, along_u, along_v),
          bernstein_sum(magnitudes(net), magnitudes(along_u), magnitudes(along_v))};
}

template <bool kMagnitude>
std::optional<Power> BernsteinForm::Data::sum_of(const Argument& u, const Argument& v, ShortSum& sum) const {
  if (!u.is_finite() || !v.is_finite()) throw std::domain_error("an argument is not finite");
  if (!terms) return std::nullopt;
  const auto s = homogenise_short(u, surface.u), t = homogenise_short(v, surface.v);
  if (!s || !t) return std::nullopt;
  short_sum<kMagnitude>(*terms, *s, *t, sum);
  const Power along_u = power_of(s->c, surface.u.order - 1), along_v = power_of(t->c, surface.v.order - 1);
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

BernsteinForm::BernsteinForm(const Surface& surface) : data_(std::make_unique<Data>(surface)) {}
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
