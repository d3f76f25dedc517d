// Polynomials in Bernstein form in double, by Horner's rule in a ratio of at most 1.
#include "bernstein.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "binomials.h"
#include "mutation_point.h"

namespace glev {
namespace {

// The quantities of Horner's rule that depend on the argument alone. The rule uses the ratio of the smaller
// to the larger of |s| and |t|: with a ratio of magnitude at most 1 it is stable, and no power underflows.
struct Step {
  Parameter::End end;  // at an end, the result is the control point there
  bool from_last;      // ratio t / s from the last point, otherwise s / t from the first
  double ratio;
  // The larger of s and t to the power of the degree is power * 2^exponent. The exponent is 0 unless the
  // power could overflow.
  double power;
  int exponent;
};

Step step_of(const Parameter& at, int degree) {
  constexpr double kPowerIsFinite = 0x1p16;  // (2^16)^63 < 2^1024
  if (at.end != Parameter::End::kNeither) return {at.end, at.end == Parameter::End::kLast, 0, 1, 0};
  const bool from_last = GLEV_AT(from_last, std::fabs(at.t) <= std::fabs(at.s));
  const double smaller = from_last ? at.t : at.s, larger = from_last ? at.s : at.t;
  Step step = {at.end, from_last, smaller / larger, 1, 0};
  if (std::fabs(larger) < kPowerIsFinite || !std::isfinite(larger)) {
    step.power = raise_to_power(larger, degree);
  } else {
    int two = 0;
    const double significand = 2 * std::frexp(larger, &two);  // 1 <= |significand| < 2
    step.power = raise_to_power(significand, degree);
    step.exponent = (two - 1) * degree;
  }
  return step;
}

// Evaluates `count` consecutive curves of the same degree at one argument. The loops over components are
// unrolled by hand, because sums in registers are several times as fast.
template <std::size_t... kComponent>
void evaluate_steps(const double* first, int count, int degree, const Step& step, double* result,
                    std::index_sequence<kComponent...>) {
  constexpr std::ptrdiff_t kComponents = sizeof...(kComponent);
  const std::ptrdiff_t to_last = degree * kComponents;
  const std::ptrdiff_t next = step.from_last ? -kComponents : kComponents;
  for (int i = 0; i < count; ++i) {
    const double* point = step.from_last ? first + to_last : first;
    std::array<double, sizeof...(kComponent)> sum = {point[kComponent]...};
    if (step.end == Parameter::End::kNeither) {
      for (int k = 0; k < degree; ++k) {
        point += next;
        ((sum[kComponent] = sum[kComponent] * step.ratio + point[kComponent]), ...);
      }
      ((sum[kComponent] *= step.power), ...);
      if (step.exponent != 0) ((sum[kComponent] = std::ldexp(sum[kComponent], step.exponent)), ...);
    }
    ((result[kComponent] = sum[kComponent]), ...);
    first += to_last + kComponents;
    result += kComponents;
  }
}

void evaluate_curves(const double* first, int components, int count, int degree, const Parameter& at,
                     double* result) {
  const Step step = step_of(at, degree);
  switch (components) {
    case 1:
      return evaluate_steps(first, count, degree, step, result, std::make_index_sequence<1>{});
    case 2:
      return evaluate_steps(first, count, degree, step, result, std::make_index_sequence<2>{});
    case 3:
      return evaluate_steps(first, count, degree, step, result, std::make_index_sequence<3>{});
    case 4:
      return evaluate_steps(first, count, degree, step, result, std::make_index_sequence<4>{});
  }
}

}  // namespace

void scale_by_binomials(const double* points, std::array<int, 2> order, int components, double* scaled) {
  const std::uint64_t* const row_u = binomial_row(order[0] - 1);
  const std::uint64_t* const row_v = GLEV_AT(binomials_of_v, binomial_row(order[1] - 1));
  // The binomials of v, once for each value of a row.
  std::array<double, kMaxOrder * 4> factors;
  const int row = order[1] * components;
  for (int j = 0; j < order[1]; ++j)
    std::fill_n(factors.begin() + j * components, components,
                static_cast<double>(GLEV_AT(binomial_of_v, row_v[j])));
  for (int i = 0; i < order[0]; ++i, points += row, scaled += row) {
    const auto in_u = static_cast<double>(GLEV_AT(binomial_of_u, row_u[i]));
    for (int k = 0; k < row; ++k)
      scaled[k] = GLEV_AT(scaled_point, in_u * (factors[static_cast<std::size_t>(k)] * points[k]));
  }
}

void evaluate(const Curve& curve, const Parameter& at, double* result) {
  evaluate_curves(curve.scaled, curve.components, 1, curve.degree, at, result);
}

Curve curve_at(const Surface& surface, const Parameter& v, double* room) {
  const auto [degree_u, degree_v] = surface.degree;
  const bool constant = degree_v == 0;
  if (!constant) evaluate_curves(surface.scaled, surface.components, degree_u + 1, degree_v, v, room);
  return {degree_u, surface.components, surface.domain[0], constant ? surface.scaled : room};
}

}  // namespace glev
