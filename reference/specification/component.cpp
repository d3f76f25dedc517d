// Values, bounds and rounding of emitted components, from the exact functions for their maps.
#include <reference/component.h>
#include <reference/rounding.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace evalcts::reference {
namespace {

// Calls f(curve, u) or f(surface, u, v), depending on the dimension of the sample's map.
template <typename F>
auto with_polynomial(const Sample& sample, F&& f) {
  const Map& map = sample.map();
  if (map.is_two_dimensional()) return f(map.surface(sample.component), sample.u(), sample.v().value());
  return f(map.curve(sample.component), sample.u());
}

bool is_finite(const AutomaticNormal& normal) {
  return std::ranges::all_of(normal.map->surfaces(),
                             [](const Surface& surface) { return is_finite(surface); }) &&
         normal.u.is_finite() && normal.v.is_finite();
}

// Returns the acceptance of an explicit value: the bounds are zero and a must.
Acceptance plain(float value) { return {value, abs(Rational(value)), 0, 0, true}; }

int degree(const Sample& sample) { return sample.map().u.order - 1 + sample.map().v.order - 1; }

}  // namespace

bool is_finite(const Component& component) {
  if (const float* value = std::get_if<float>(&component)) return std::isfinite(*value);
  const Sample& sample = std::get<Sample>(component);
  return with_polynomial(sample, [](const auto& polynomial, const auto&... arguments) {
    return is_finite(polynomial) && (arguments.is_finite() && ...);
  });
}

Rational exact(const Component& component) { return exact_with_magnitude(component).value; }

Evaluation exact_with_magnitude(const Component& component) {
  if (const float* value = std::get_if<float>(&component)) {
    return {plain(*value).exact, plain(*value).magnitude};
  }
  return with_polynomial(std::get<Sample>(component), [](const auto& polynomial, const auto&... arguments) {
    return evaluate_with_magnitude(polynomial, arguments...);
  });
}

float rounded(const Component& component) {
  if (const float* value = std::get_if<float>(&component)) return *value;
  if (!is_finite(component)) return std::numeric_limits<float>::quiet_NaN();
  return round_to_float(exact(component));
}

Rational acceptance_bound(const Component& component) {
  if (const float* value = std::get_if<float>(&component)) return plain(*value).bound;
  return with_polynomial(std::get<Sample>(component), [](const auto& polynomial, const auto&... arguments) {
    return acceptance_bound(polynomial, arguments...);
  });
}

bool must_applies(const Component& component, int range) {
  if (const float* value = std::get_if<float>(&component)) return plain(*value).must_applies;
  return with_polynomial(std::get<Sample>(component),
                         [range](const auto& polynomial, const auto&... arguments) {
                           return must_applies(polynomial, arguments..., range);
                         });
}

Rational quality_bound(const Component& component) {
  if (const float* value = std::get_if<float>(&component)) return plain(*value).quality_bound;
  return quality_bound(degree(std::get<Sample>(component)), exact_with_magnitude(component).magnitude);
}

Acceptance acceptance(const Component& component, int range) {
  if (const float* value = std::get_if<float>(&component)) return plain(*value);
  return with_polynomial(std::get<Sample>(component),
                         [range](const auto& polynomial, const auto&... arguments) {
                           return acceptance(polynomial, arguments..., range);
                         });
}

std::array<float, 3> rounded(const Normal& normal) {
  if (const auto* components = std::get_if<0>(&normal))
    return {rounded((*components)[0]), rounded((*components)[1]), rounded((*components)[2])};
  const AutomaticNormal& automatic = std::get<AutomaticNormal>(normal);
  const std::vector<Surface> surfaces = automatic.map->surfaces();
  const auto w_is_zero = [&] {
    return surfaces.size() == 4 && evaluate(surfaces[3], automatic.u, automatic.v).is_zero();
  };
  if (is_finite(automatic) && !w_is_zero()) {
    const Vector m = normal_vector(surfaces, automatic.u, automatic.v);
    if (!is_degenerate(m)) return rounded_unit_vector(m);
  }
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  return {kNaN, kNaN, kNaN};
}

std::optional<NormalAcceptance> acceptance(const AutomaticNormal& normal, int range) {
  if (!is_finite(normal)) return {};
  return normal_acceptance(normal.map->surfaces(), normal.u, normal.v, range);
}

}  // namespace evalcts::reference
