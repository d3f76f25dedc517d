#include "production/src/bernstein.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "production/src/target.h"

namespace glev {
namespace {

// Row n of Pascal's triangle begins at n * (n + 1) / 2. All entries up to C(63, 31) < 2^60 are exact as
// integers.
constexpr std::size_t kTriangle = kMaxOrder * (kMaxOrder + 1) / 2;

constexpr std::size_t RowOf(int n) { return static_cast<std::size_t>(n) * (n + 1) / 2; }

constexpr std::array<std::uint64_t, kTriangle> PascalsTriangle() {
  std::array<std::uint64_t, kTriangle> triangle{};
  for (int n = 0; n < kMaxOrder; ++n) {
    for (int i = 0; i <= n; ++i) {
      const std::uint64_t* above = n == 0 ? nullptr : triangle.data() + RowOf(n - 1);
      triangle[RowOf(n) + i] = i == 0 || i == n ? 1 : above[i - 1] + above[i];
    }
  }
  return triangle;
}

constexpr auto kBinomials = PascalsTriangle();

double Power(double base, int exponent) {
  double power = 1;
  for (;; base *= base) {
    if (exponent & 1) power *= base;
    exponent >>= 1;
    if (exponent == 0) return power;
  }
}

// value * base^exponent. |base| >= 1/2 unless it is not finite; where the power alone could overflow, its
// exponent of two is kept apart.
double TimesPower(double value, double base, int exponent) {
  constexpr double kPowerIsFinite = 0x1p16;  // (2^16)^63 < 2^1024
  if (std::fabs(base) < kPowerIsFinite || !std::isfinite(base)) return value * Power(base, exponent);
  int two = 0;
  const double significand = 2 * std::frexp(base, &two);  // 1 <= |significand| < 2
  return std::ldexp(value * Power(significand, exponent), (two - 1) * exponent);
}

// Horner's rule in the ratio of the smaller to the larger of |s| and |t|: with a ratio of magnitude at most 1
// it is stable, and no power underflows. `next` is the step from one scaled point to the next.
template <int kComponents>
void Horner(const double* first, std::ptrdiff_t next, int degree, double ratio, double larger,
            double* result) {
  std::array<double, kComponents> sum;
  std::copy_n(first, kComponents, sum.begin());
  for (int i = 0; i < degree; ++i) {
    first += next;
    for (int k = 0; k < kComponents; ++k) sum[k] = sum[k] * ratio + first[k];
  }
  for (int k = 0; k < kComponents; ++k) result[k] = TimesPower(sum[k], larger, degree);
}

template <int kComponents>
void EvaluateComponents(const Curve& curve, const Parameter& at, double* result) {
  const double* const first = curve.scaled;
  const double* const last = first + static_cast<std::ptrdiff_t>(curve.degree) * kComponents;
  if (at.end == Parameter::End::kFirst) {
    std::copy_n(first, kComponents, result);
  } else if (at.end == Parameter::End::kLast) {
    std::copy_n(last, kComponents, result);
  } else if (std::fabs(at.t) <= std::fabs(at.s)) {
    Horner<kComponents>(last, -kComponents, curve.degree, at.t / at.s, at.s, result);
  } else {
    Horner<kComponents>(first, kComponents, curve.degree, at.s / at.t, at.t, result);
  }
}

}  // namespace

void ScaleByBinomials(const double* points, int order, int components, double* scaled) {
  const std::uint64_t* row = kBinomials.data() + RowOf(order - 1);
  for (int i = 0; i < order; ++i) {
    for (int k = 0; k < components; ++k) *scaled++ = static_cast<double>(row[i]) * *points++;
  }
}

void Evaluate(const Curve& curve, const Parameter& at, double* result) {
  switch (curve.components) {
    case 1:
      return EvaluateComponents<1>(curve, at, result);
    case 2:
      return EvaluateComponents<2>(curve, at, result);
    case 3:
      return EvaluateComponents<3>(curve, at, result);
    case 4:
      return EvaluateComponents<4>(curve, at, result);
  }
}

}  // namespace glev
