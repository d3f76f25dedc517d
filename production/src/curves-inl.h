// Evaluates curves at many arguments, one in each lane.
#if defined(GLEVALUATOR_CURVES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_CURVES_INL_H_
#undef GLEVALUATOR_CURVES_INL_H_
#else
#define GLEVALUATOR_CURVES_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "arguments-inl.h"
#include "low_degree-inl.h"
#include "mutation_point.h"
#include "resolve.h"
#include "writer-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

HWY_INLINE Vector raise_to_power(Vector base, int exponent) {
  Vector power = hn::Set(kDoubles, 1);
  for (;; base = hn::Mul(base, base)) {
    if (exponent & 1) power = hn::Mul(power, base);
    exponent >>= 1;
    if (exponent == 0) return power;
  }
}

// Evaluates curves by Horner's rule in t / s, which is stable for all ratios >= 0. If the ratio is so large
// that a value could overflow, the lane is undecided.
template <int kComponents>
void evaluate_high_curves(const PreparedMap& map, const Input& input, std::size_t count,
                          const Destination& to) {
  const Place place(map, 0);
  const int degree = map.surface.degree[0];
  const double* const points = map.surface.scaled;
  const Writer<kComponents> writer(make_test(map, horner_units(degree, place.roundings()), 1), to, to.data);
  // If s >= least, s^degree and (t/s)^degree are between 2^-800 and 2^800.
  const Vector least = hn::Set(kDoubles, GLEV_AT(least_ratio, std::exp2(-800.0 / degree)));
  const Vector nan = hn::Set(kDoubles, std::numeric_limits<double>::quiet_NaN());
  const Arguments arguments(input, count);
  for (std::size_t begin = 0; begin < count; begin += kStep) {
    const std::size_t part_count = std::min(kStep, count - begin);
    Vector u[kUnroll], value[kUnroll][kComponents], ratio[kUnroll], power[kUnroll];
    arguments.load(begin, u);
    const double* point = points + degree * kComponents;
    for (std::size_t part = 0; part < kUnroll; ++part) {
      const Vector s = place.s_of(u[part]), t = nan_outside(place.t_of(u[part]), s);
      ratio[part] = hn::Div(t, hn::IfThenElse(hn::Ge(s, least), s, nan));
      power[part] = raise_to_power(s, degree);
      for (int k = 0; k < kComponents; ++k) value[part][k] = hn::Set(kDoubles, point[k]);
    }
    for (int i = 0; i < degree; ++i) {
      point -= kComponents;
      for (int k = 0; k < kComponents; ++k) {
        const Vector next = hn::Set(kDoubles, point[k]);
        for (std::size_t part = 0; part < kUnroll; ++part)
          value[part][k] = hn::MulAdd(value[part][k], ratio[part], next);
      }
    }
    for (std::size_t part = 0; part < kUnroll; ++part) {
      for (int k = 0; k < kComponents; ++k) value[part][k] = hn::Mul(value[part][k], power[part]);
    }
    writer.write(writer.round(value), begin, part_count, [&](std::size_t i, int k) {
      return resolve(map, k, argument_at(input[i]), argument_at(0));
    });
  }
}

template <int kComponents>
void evaluate_curves(const PreparedMap& map, const Input& input, std::size_t count, const Destination& to) {
  switch (map.surface.degree[0]) {
    case 1:
      return evaluate_low_degree<kComponents, 1, 0>(map, input, {}, count, to);
    case 2:
      return evaluate_low_degree<kComponents, 2, 0>(map, input, {}, count, to);
    case 3:
      return evaluate_low_degree<kComponents, 3, 0>(map, input, {}, count, to);
    default:
      return evaluate_high_curves<kComponents>(map, input, count, to);
  }
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_CURVES_INL_H_
