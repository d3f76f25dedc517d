#include "harness/accuracy/exact_line.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include <reference/rational.h>

namespace evalcts::accuracy {
namespace {

constexpr int kFactorBits = 53 - 24;  // times a float: exact in double

bool is_short(double x) {
  int exponent = 0;
  const double significand = std::ldexp(std::frexp(x, &exponent), kFactorBits);
  return significand == std::floor(significand);
}

}  // namespace

std::optional<ExactLine> ExactLine::of(const std::vector<double>& points) {
  using reference::Rational;
  const auto degree = static_cast<std::int64_t>(points.size()) - 1;
  const Rational first = points.front(), rise = Rational(points.back()) - first;
  for (std::int64_t i = 1; i < degree; ++i)
    if (Rational(degree) * (Rational(points[static_cast<std::size_t>(i)]) - first) != Rational(i) * rise)
      return std::nullopt;
  const double difference = points.back() - points.front();
  if (Rational(difference) != rise || !is_short(difference)) return std::nullopt;
  return ExactLine(points.front(), difference);
}

float ExactLine::to_float(float u) const {
  // The product is exact: 24 and 29 bits, and floats are far from the ends of the range of double. Knuth's
  // TwoSum gives the rest that their sum leaves; with it the sum is rounded to odd, after which rounding to
  // float is as of the exact value (Boldo, Melquiond, "Emulation of FMA and correctly rounded sums: proved
  // algorithms using rounding to odd", 2008).
  const double product = difference_ * static_cast<double>(u);
  double sum = first_ + product;
  const double of_product = sum - first_;
  const double rest = (first_ - (sum - of_product)) + (product - of_product);
  if (rest != 0 && std::bit_cast<std::uint64_t>(sum) % 2 == 0)
    sum = std::bit_cast<double>(std::bit_cast<std::uint64_t>(sum) + ((rest > 0) == (sum > 0) ? 1 : -1));
  return static_cast<float>(sum);
}

}  // namespace evalcts::accuracy
