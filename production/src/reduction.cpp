// The control points of a curve of degree n, times their binomials, are the coefficients of a polynomial
//   P(x) = sum of C(n, i) R_i x^i,
// and elevating the degree by one multiplies P by 1 + x. So the degree can be reduced to n - k if (1 + x)^k
// divides P. The divisions are exact in integers; only at the end the coefficients are divided by binomial
// coefficients.
#include "reduction.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "binomials.h"
#include "mutation_point.h"
#include "wide_integer.h"

namespace glev {
namespace {

// A row or a column of control points.
struct Line {
  double* points;
  std::ptrdiff_t step;
  int degree;

  double& operator[](int i) const { return points[i * step]; }
};

// All of the points are multiples of 2^low and below 2^high in magnitude; low > high if they are all zero.
struct Range {
  int low = 1024, high = -1074;
};

Range range_of(const Line& line) {
  Range range;
  for (int i = 0; i <= line.degree; ++i) {
    const Decoded decoded = decode(line[i]);
    if (decoded.mantissa == 0) continue;
    range.low = std::min(range.low, decoded.exponent);
    range.high = std::max(range.high, decoded.exponent + bit_width(decoded.mantissa));
  }
  return range;
}

// Returns false if P(-1) is not 0 modulo 2^64. Then 1 + x does not divide P.
bool may_reduce(const Line& line) {
  const std::uint64_t* const binomials = binomial_row(line.degree);
  const Range range = range_of(line);
  Limb sum = 0;
  for (int i = 0; i <= line.degree; ++i) {
    const Decoded decoded = decode(line[i]);
    const int shift = decoded.exponent - range.low;
    if (decoded.mantissa == 0 || shift >= kLimbBits) continue;
    const Limb term = decoded.mantissa * binomials[i] << shift;
    sum = decoded.negative == (i % 2 == 0) ? sum - term : sum + term;
  }
  return GLEV_AT(degree_is_lower, sum == 0);
}

// Computes +-magnitude / divisor * 2^exponent. Returns false if this is not a double. Overwrites the
// magnitude.
bool to_double(bool negative, Limb* magnitude, int size, Limb divisor, int exponent, double& result) {
  constexpr int kPrecision = 53, kLowest = -1074, kHighest = 1024;
  result = 0;
  size = trimmed_size(magnitude, size);
  if (size == 0) return true;
  const int twos = std::countr_zero(divisor);
  Limb remainder = 0;
  for (int i = size - 1; i >= 0; --i) {
    const Limb2 dividend = Limb2{remainder} << kLimbBits | magnitude[i];
    magnitude[i] = static_cast<Limb>(dividend / (divisor >> twos));
    remainder = static_cast<Limb>(dividend % (divisor >> twos));
  }
  if (GLEV_AT(leaves_remainder, remainder != 0)) return false;
  size = trimmed_size(magnitude, size);
  const int zeros = trailing_zeros(magnitude), width = bit_width(magnitude, size) - zeros;
  exponent += zeros - twos;
  if (width > kPrecision || exponent < kLowest || exponent + width > kHighest) return false;
  // The exponent of the lowest bit of a normal or subnormal number.
  const int last = std::max(exponent + width - kPrecision, kLowest);
  const Limb significand = bits_at(magnitude, size, zeros) << (exponent - last);
  const Limb bits = (static_cast<Limb>(last - kLowest) << (kPrecision - 1)) + significand;
  result = std::bit_cast<double>(bits | static_cast<Limb>(negative) << (kLimbBits - 1));
  return true;
}

// The polynomial P of one line, which can be divided by 1 + x.
class Polynomial {
 public:
  // Loads a line. Returns false if the range of its points is too wide.
  bool load(const Line& line) {
    const Range range = range_of(line);
    if (range.high - range.low > kMaxRange) return false;
    degree_ = line.degree;
    low_ = range.low;
    const std::uint64_t* const binomials = binomial_row(degree_);
    for (int i = 0; i <= degree_; ++i) {
      coefficients_[i] = {};
      const Decoded decoded = decode(line[i]);
      if (decoded.mantissa == 0) continue;
      const Limb2 product = Limb2{decoded.mantissa} * binomials[i];
      const std::array<Limb, 2> limbs = {static_cast<Limb>(product), high_limb(product)};
      const int shift = decoded.exponent - low_, first = shift / kLimbBits;
      const Limb power = Limb{1} << shift % kLimbBits;
      add_product(coefficients_[i].data() + first, kLimbs - first, limbs.data(), 2, power);
      if (decoded.negative) negate(coefficients_[i].data(), kLimbs);
    }
    return true;
  }

  int degree() const { return degree_; }

  // Divides by 1 + x. Returns false, and changes nothing, if there is a remainder.
  bool divide() {
    if (degree_ == 0) return false;
    for (int i = 1; i <= degree_; ++i) {
      subtract_product(coefficients_[i].data(), kLimbs, coefficients_[i - 1].data(), kLimbs, 1);
    }
    --degree_;
    if (trimmed_size(coefficients_[degree_ + 1].data(), kLimbs) == 0) return true;
    multiply();
    return false;
  }

  void multiply() {
    ++degree_;
    for (int i = degree_; i > 0; --i) {
      add_product(coefficients_[i].data(), kLimbs, coefficients_[i - 1].data(), kLimbs, 1);
    }
  }

  // Computes the control points of the current degree. Returns false if not all of them are doubles.
  bool get_points(std::array<double, kMaxOrder>& points) const {
    const std::uint64_t* const binomials = binomial_row(degree_);
    for (int i = 0; i <= degree_; ++i) {
      Coefficient magnitude = coefficients_[i];
      const bool negative = is_negative(magnitude.data(), kLimbs);
      if (negative) negate(magnitude.data(), kLimbs);
      if (!to_double(negative, magnitude.data(), kLimbs, binomials[i], low_, points[i])) return false;
    }
    return true;
  }

 private:
  // After k divisions a coefficient, or the remainder, is a sum of C(n, j) R_j times binomials of rows up to
  // n, so below 2^(2n) * max |R|.
  static constexpr int kLimbs = 7, kMaxRange = 320;
  static_assert(kMaxRange + 2 * (kMaxOrder - 1) + 1 <= kLimbs * kLimbBits);
  using Coefficient = std::array<Limb, kLimbs>;  // in two's complement, times 2^low

  std::array<Coefficient, kMaxOrder> coefficients_;
  int degree_;
  int low_;
};

// Reduces in place, and returns the new degree of the lines i * line_step, i < count.
int reduce_lines(double* points, std::ptrdiff_t line_step, int count, std::ptrdiff_t step, int degree) {
  const auto line = [=](int i) { return Line{points + i * line_step, step, degree}; };
  for (int i = 0; i < count; ++i) {
    if (!may_reduce(line(i))) return degree;
  }

  Polynomial polynomial;
  int lowest = 0;
  for (int i = 0; i < count && lowest < degree; ++i) {
    if (!polynomial.load(line(i))) return degree;
    while (polynomial.degree() > lowest && polynomial.divide()) continue;
    lowest = polynomial.degree();
  }

  // Finds a degree at which the control points of all lines are doubles. A line may have doubles at one
  // degree and not at a higher one, so if a line needs a higher degree, all others are checked again.
  std::array<double, kMaxOrder> reduced;
  for (int i = 0, agreed = 0; agreed < count; i = (i + 1) % count) {
    polynomial.load(line(i));
    while (polynomial.degree() > lowest) polynomial.divide();
    while (!polynomial.get_points(reduced)) polynomial.multiply();
    agreed = GLEV_AT(rows_agreed, polynomial.degree() == lowest ? agreed + 1 : 1);
    lowest = polynomial.degree();
    if (lowest == degree) return degree;
  }

  // Rows are moved together, each after it has been read.
  const std::ptrdiff_t new_step = step == 1 ? lowest + 1 : line_step;
  for (int i = 0; i < count; ++i) {
    polynomial.load(line(i));
    while (polynomial.degree() > lowest) polynomial.divide();
    polynomial.get_points(reduced);
    const Line to = {points + i * new_step, step, lowest};
    for (int j = 0; j <= lowest; ++j) to[j] = reduced[j];
  }
  return lowest;
}

}  // namespace

std::array<int, 2> reduce(const Component& component, double* reduced) {
  std::array<int, 2> order = component.order;
  const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(order[0]) * order[1];
  for (std::ptrdiff_t i = 0; i < count && component.points != reduced; ++i)
    reduced[i] = component.points[i * component.stride];
  for (int unchanged = 0, direction = 1; unchanged < 2; direction = 1 - direction) {
    const int before = order[direction];
    if (before > 1) {
      const std::ptrdiff_t row = order[1];
      order[direction] = 1 + (direction == 1 ? reduce_lines(reduced, row, order[0], 1, before - 1)
                                             : reduce_lines(reduced, 1, order[1], row, before - 1));
    }
    unchanged = order[direction] == before ? unchanged + 1 : 0;
  }
  return order;
}

}  // namespace glev
