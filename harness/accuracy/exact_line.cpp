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

constexpr int kFactorBits = 53 - 24;  // times a float: exact in double
constexpr int kLeast = -149;          // floats are multiples of 2^this

// x is a multiple of 2^last_bit(x), and of no larger power of two. x is not zero.
int last_bit(double x) {
  int exponent = 0;
  const auto significand = static_cast<std::uint64_t>(std::ldexp(std::abs(std::frexp(x, &exponent)), 53));
  return exponent - 53 + std::countr_zero(significand);
}

bool is_short(double x) { return x == 0 || std::ilogb(x) - last_bit(x) < kFactorBits; }

// The least e with |x| <= 2^e.
int exponent_above(const Rational& x) {
  const double size = std::abs(reference::round_to_double(x));
  return std::ilogb(size) + 2;  // one for rounding
}

// Coefficients of the powers of u: C(n,k) times the k-th difference.
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

  // For |u| <= 2^e the rest is at most twice its first term, whose sign it has:
  Rational others = 0;
  for (std::size_t k = lowest + 1; k < power.size(); ++k) others += abs(power[k]);
  int e = -1;
  if (!others.is_zero()) e = std::min(e, -1 - exponent_above(others / abs(power[lowest])));
  // and it is less than half of 2^last, of which all are multiples: first, product, and the floats near their
  // sum with the middles between them. Nothing is then between the sum and the value but what decides ties.
  const int rest_at_one = exponent_above(power[lowest]) + 1;
  const auto n = static_cast<int>(lowest);
  while (e >= kLeast) {
    int last = std::numeric_limits<int>::max();
    if (line.first_ != 0) last = std::min(last_bit(line.first_), std::ilogb(line.first_) - 25);
    // u has 24 bits. Of smaller ones all of this is smaller, and the rest is by more.
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
  // The product is exact: 24 and 29 bits, and floats are far from the ends of the range of double. Knuth's
  // TwoSum gives the rest that their sum leaves; with it the sum is rounded to odd, after which rounding to
  // float is as of the exact value (Boldo, Melquiond, "Emulation of FMA and correctly rounded sums: proved
  // algorithms using rounding to odd", 2008). The rest of the polynomial decides where their sum leaves none.
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
