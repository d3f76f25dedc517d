// Collects the errors of results.
#include <evalcts/accuracy/errors.h>

#include <algorithm>
#include <cmath>

#include <reference/rounding.h>

namespace evalcts::accuracy {

void Worst::keep(double other_error, const Input& other, float result, const reference::Rational& value) {
  if (other_error <= error) return;
  *this = {other_error, other, result, reference::round_to_float(value), reference::describe(value)};
}

reference::Surface Input::surface() const {
  return {points.data(), vorder, 1, uorder, vorder, domain[0], domain[1], domain[2], domain[3]};
}

std::size_t Errors::bin_of(double ulp) {
  int exponent = 0;
  const double significand = std::frexp(ulp, &exponent);  // in [1/2, 1); times 2^exponent is ulp
  if (ulp <= 0.5) return 0;
  return static_cast<std::size_t>(std::clamp(exponent + (significand == 0.5 ? 0 : 1), 0, kBins - 1));
}

void Errors::add(float got, const reference::Evaluation& exact, const Input& input) {
  if (exact.magnitude.is_zero()) {
    ++without_terms;
    if (got != 0) ++without_terms_wrong;
    return;
  }
  const double condition = reference::condition_distance(got, exact.value, exact.magnitude);
  if (exact.value.is_zero()) {
    ++zeros;
    if (got != 0) {
      ++zeros_wrong;
      zero.keep(condition, input, got, exact.value);
    }
    return;
  }
  ++values;
  const double distance = reference::ulp_distance(got, exact.value);
  const float right = reference::round_to_float(exact.value);
  if (got != right) ++not_correctly_rounded;
  ulp.keep(distance, input, got, exact.value);
  condition_aware.keep(condition, input, got, exact.value);
  if (!std::isfinite(got) && std::isfinite(right)) {
    ++not_finite;
    return;
  }
  sum_of_ulp += distance;
  sum_of_condition_aware += condition;
  ++histogram[bin_of(distance)];
}

}  // namespace evalcts::accuracy
