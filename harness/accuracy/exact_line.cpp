// Correctly rounded evaluation of lines in double, by rounding to odd.
#include <evalcts/accuracy/exact_line.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <reference/rational.h>
#include <reference/rounding.h>

namespace evalcts::accuracy {
namespace {

using reference::Rational;

constexpr int kFactorBits = 53 - 24;  // a product with a float is exact in double
constexpr int kLeast = -149;          // floats are multiples of 2^kLeast

// Returns the exponent of the largest power of two that divides x. x must not be zero.
int last_bit(double x) {
  int exponent = 0;
  const auto significand = static_cast<std::uint64_t>(std::ldexp(std::abs(std::frexp(x, &exponent)), 53));
  return exponent - 53 + std::countr_zero(significand);
}

bool is_short(double x) { return x == 0 || std::ilogb(x) - last_bit(x) < kFactorBits; }

// Returns an e with |x| <= 2^e, at most 2 above the least.
int exponent_above(const Rational& x) {
  const double size = std::abs(reference::round_to_double(x));
  return std::ilogb(size) + 2;  // one for rounding
}

// Returns the coefficients of the powers of u: C(n,k) times the k-th difference.
std::vector<Rational> power_basis(const std::vector<double>& points) {
  std::vector<Rational> differences(points.begin(), points.end()), coefficients;
  Rational binomial = 1;
  const std::size_t order = points.size();
  for (std::size_t k = 0; k < order; ++k) {
    coefficients.push_back(binomial * differences[0]);
    for (std::size_t i = 0; i + 1 < differences.size(); ++i)
      differences[i] = differences[i + 1] - differences[i];
    differences.pop_back();
    binomial = binomial * Rational(static_cast<std::int64_t>(order - 1 - k)) /
               Rational(static_cast<std::int64_t>(k + 1));
  }
  return coefficients;
}

}  // namespace

std::optional<ExactLine> ExactLine::of(const std::vector<double>& points) {
  std::vector<Rational> power = power_basis(points);
  power.resize(std::max<std::size_t>(power.size(), 2), 0);
  ExactLine line;
  line.first_ = points.front();
  line.slope_ = reference::round_to_double(power[1]);
  if (Rational(line.slope_) != power[1] || !is_short(line.slope_)) return std::nullopt;
  line.reach_ = std::numeric_limits<double>::infinity();
  std::size_t lowest = 2;
  while (lowest < power.size() && power[lowest].is_zero()) ++lowest;
  if (lowest == power.size()) return line;
  if (line.first_ == 0 && line.slope_ == 0) return std::nullopt;

  // For |u| <= 2^e, the rest of the polynomial is at most twice its first term and has the sign of that term.
  Rational others = 0;
  for (std::size_t k = lowest + 1; k < power.size(); ++k) others += abs(power[k]);
  int e = -1;
  if (!others.is_zero()) e = std::min(e, -1 - exponent_above(others / abs(power[lowest])));
  // The rest must also be less than half of 2^last, where `first`, the product, and the floats and midpoints
  // near their sum are all multiples of 2^last. Then no float and no midpoint lies between the sum and the
  // value, so the rest matters only for the side of a tie.
  const int rest_at_one = exponent_above(power[lowest]) + 1;
  const auto n = static_cast<int>(lowest);
  while (e >= kLeast) {
    int last = std::numeric_limits<int>::max();
    if (line.first_ != 0) last = std::min(last_bit(line.first_), std::ilogb(line.first_) - 25);
    // u has 24 bits. For smaller |u| these quantities are smaller, and the rest decreases faster.
    if (line.slope_ != 0) last = std::min(last, last_bit(line.slope_) + e - 25);
    // The sum is at least half of `first`.
    const bool no_zero =
        line.first_ == 0 || line.slope_ == 0 || std::ilogb(line.slope_) + 1 + e < std::ilogb(line.first_);
    if (rest_at_one + n * e < last - 1 && no_zero) break;
    --e;
  }
  if (e < kLeast) return std::nullopt;
  line.reach_ = std::ldexp(1.0, e);
  const int sign = power[lowest] > 0 ? 1 : -1;
  line.side_[0] = sign;
  line.side_[1] = lowest % 2 == 0 ? sign : -sign;
  return line;
}

float ExactLine::to_float(float u) const {
  // The product is exact, because its factors have 24 and 29 bits and floats are far from the ends of the
  // range of double. Knuth's TwoSum gives the error of the sum. With this error, the sum is rounded to odd,
  // after which rounding to float gives the rounded exact value (Boldo, Melquiond, "Emulation of FMA and
  // correctly rounded sums: proved algorithms using rounding to odd", 2008). If the sum is exact, the rest of
  // the polynomial takes the place of its error.
  const double product = slope_ * static_cast<double>(u);
  double sum = first_ + product;
  const double of_product = sum - first_;
  double rest = (first_ - (sum - of_product)) + (product - of_product);
  if (rest == 0 && u != 0) rest = side_[u < 0 ? 1 : 0];
  if (rest != 0 && std::bit_cast<std::uint64_t>(sum) % 2 == 0)
    sum = std::bit_cast<double>(std::bit_cast<std::uint64_t>(sum) + ((rest > 0) == (sum > 0) ? 1 : -1));
  return static_cast<float>(sum);
}

}  // namespace evalcts::accuracy
