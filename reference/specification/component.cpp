// Values, bounds and rounding of emitted components, from the exact functions for their maps.
#include <reference/component.h>
#include <reference/rounding.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace evalcts::reference {
namespace {

bool is_finite(const AutomaticNormal& normal) {
  return std::ranges::all_of(normal.map->surfaces(),
                             [](const Surface& surface) { return is_finite(surface); }) &&
         normal.u.is_finite() && normal.v.is_finite();
}

// Returns the acceptance of an explicit value: the bounds are zero and a must.
Acceptance plain(float value) { return {value, abs(Rational(value)), 0, 0, true}; }

// Calls f(surface, u, v) for the map of a sample.
template <typename F>
auto apply(const Sample& sample, F&& f) {
  return f(sample.map().surface(sample.component), sample.u(), sample.v().value_or(Argument()));
}

}  // namespace

bool is_finite(const Component& component) {
  if (const float* value = std::get_if<float>(&component)) return std::isfinite(*value);
  return apply(std::get<Sample>(component), [](const Surface& surface, const Argument& u, const Argument& v) {
    return is_finite(surface) && u.is_finite() && v.is_finite();
  });
}

Rational exact(const Component& component) { return exact_with_magnitude(component).value; }

Evaluation exact_with_magnitude(const Component& component) {
  if (const float* value = std::get_if<float>(&component)) return {*value, abs(Rational(*value))};
  return apply(std::get<Sample>(component), evaluate_with_magnitude);
}

float rounded(const Component& component) {
  if (const float* value = std::get_if<float>(&component)) return *value;
  if (!is_finite(component)) return std::numeric_limits<float>::quiet_NaN();
  return round_to_float(exact(component));
}

Rational acceptance_bound(const Component& component) {
  if (const float* value = std::get_if<float>(&component)) return plain(*value).bound;
  return apply(std::get<Sample>(component), [](const auto&... of) { return acceptance_bound(of...); });
}

bool must_applies(const Component& component, int range) {
  if (const float* value = std::get_if<float>(&component)) return plain(*value).must_applies;
  return apply(std::get<Sample>(component), [=](const auto&... of) { return must_applies(of..., range); });
}

Rational quality_bound(const Component& component) {
  if (const float* value = std::get_if<float>(&component)) return plain(*value).quality_bound;
  const Map& map = std::get<Sample>(component).map();
  return quality_bound(map.u.order + map.v.order - 2, exact_with_magnitude(component).magnitude);
}

Acceptance acceptance(const Component& component, int range) {
  if (const float* value = std::get_if<float>(&component)) return plain(*value);
  return apply(std::get<Sample>(component), [=](const auto&... of) { return acceptance(of..., range); });
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
