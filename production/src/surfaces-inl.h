// Evaluates surfaces at scattered arguments, one in each lane.
#if defined(GLEVALUATOR_SURFACES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_SURFACES_INL_H_
#undef GLEVALUATOR_SURFACES_INL_H_
#else
#define GLEVALUATOR_SURFACES_INL_H_
#endif

#include <algorithm>
#include <cstddef>

#include "arguments-inl.h"
#include "mutation_point.h"
#include "resolve.h"
#include "weights-inl.h"
#include "writer-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

template <int kComponents>
void evaluate_surfaces(const PreparedMap& map, const Input& input_u, const Input& input_v, std::size_t count,
                       const Destination& to) {
  const Place place_u(map, 0), place_v(map, 1);
  const auto [n, m] = map.surface.degree;
  const double units = weight_units(n, m, std::max(place_u.roundings(), place_v.roundings()));
  const Writer<kComponents> writer(make_test(map, units, 1), to, to.data);
  const Arguments arguments_u(input_u, count), arguments_v(input_v, count);
  for (std::size_t begin = 0; begin < count; begin += kStep) {
    const std::size_t part_count = std::min(kStep, count - begin);
    Vector u[kUnroll], v[kUnroll], value[kUnroll][kComponents];
    arguments_u.load(begin, u);
    arguments_v.load(begin, v);
    for (std::size_t part = 0; part < kUnroll; ++part) {
      Vector weights_u[kMaxOrder], weights_v[kMaxOrder];
      const Vector su = place_u.s_of(u[part]), sv = place_v.s_of(v[part]);
      weights_of(n, su, nan_outside(place_u.t_of(u[part]), su), weights_u);
      weights_of(m, sv, GLEV_AT(t_inside_in_v, nan_outside(place_v.t_of(v[part]), sv)), weights_v);
      for (int k = 0; k < kComponents; ++k) value[part][k] = hn::Zero(kDoubles);
      const double* point = map.surface.scaled;
      for (int i = 0; i <= n; ++i) {
        Vector sum[kComponents];
        for (int k = 0; k < kComponents; ++k) sum[k] = hn::Zero(kDoubles);
        for (int j = 0; j <= m; ++j, point += kComponents) {
          for (int k = 0; k < kComponents; ++k)
            sum[k] = hn::MulAdd(weights_v[j], hn::Set(kDoubles, point[k]), sum[k]);
        }
        for (int k = 0; k < kComponents; ++k)
          value[part][k] = hn::MulAdd(weights_u[i], sum[k], value[part][k]);
      }
    }
    writer.write(writer.round(value), begin, part_count, [&](std::size_t i, int k) {
      return resolve(map, k, argument_at(input_u[i]), argument_at(input_v[i]));
    });
  }
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_SURFACES_INL_H_
