// Collects the errors of results.
#include <evalcts/accuracy/errors.h>

#include <cmath>

#include <reference/rounding.h>

namespace evalcts::accuracy {

using reference::Argument;

reference::Surface Input::surface() const {
  return {points.data(), {vorder, uorder, domain[0], domain[1]}, {1, vorder, domain[2], domain[3]}};
}

reference::Evaluation Input::evaluate(const reference::BernsteinForm& form) const {
  const auto argument = [this](float x, double first, double last) {
    return segments > 0 ? Argument::grid(grid_index(x, first, last, segments), segments, first, last)
                        : Argument::coordinate(x);
  };
  return form.evaluate_with_magnitude(argument(u, domain[0], domain[1]), argument(v, domain[2], domain[3]));
}

void Worst::keep(double other_error, const Input& other, float result, const reference::Rational& value) {
  if (other_error <= error) return;
  *this = {other_error, other, result, reference::round_to_float(value), reference::describe(value), false};
}

void Errors::add(float got, const reference::Evaluation& exact, const Input& input) {
  if (exact.value.is_zero()) {
    ++zeros;
    if (got != 0) ++zeros_wrong;
    return;
  }
  ++values;
  const double distance = reference::ulp_distance(got, exact.value);
  const double condition = reference::condition_distance(got, exact.value, exact.magnitude);
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
}

}  // namespace evalcts::accuracy
