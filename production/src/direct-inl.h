// Evaluates points of vertex maps for consecutive calls, without the set-up and the exact routes of
// point-inl.h.
#if defined(GLEVALUATOR_DIRECT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_DIRECT_INL_H_
#undef GLEVALUATOR_DIRECT_INL_H_
#else
#define GLEVALUATOR_DIRECT_INL_H_
#endif

#include <cstddef>

#include "mutation_point.h"
#include "plan.h"
#include "point-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

inline bool is_nearest(const PreparedMap::Probe& probe) {
  using Two = hn::CappedTag<double, 2>;
  constexpr Two kTwo;
  bool is_nearest = true;
  for (std::size_t i = 0; i < 2; i += hn::MaxLanes(kTwo)) {
    const auto sum = hn::Add(hn::LoadU(kTwo, &probe.first[i]), hn::LoadU(kTwo, &probe.second[i]));
    is_nearest &= hn::AllTrue(kTwo, hn::Eq(sum, hn::LoadU(kTwo, &probe.sum[i])));
  }
  return GLEV_AT(rounds_to_nearest, is_nearest);
}

inline bool evaluate_directly(const glev_plan& plan, double u, double v, float* position) {
  const PreparedMap& map = plan.map(Attribute::kVertex);
  const auto [n, m] = map.surface.degree;
  const auto place = [&](int direction, double argument) -> Parameter {
    const Domain& domain = map.surface.domain[direction];
    const double width = domain.u2 - domain.u1;
    return {(domain.u2 - argument) / width, (argument - domain.u1) / width, Parameter::End::kNeither};
  };
  const Parameter at_u = n == 0 ? Parameter{1, 0, Parameter::End::kNeither} : place(0, u);
  const Parameter at_v = m == 0 ? Parameter{1, 0, Parameter::End::kNeither} : place(1, v);
  if (!(GLEV_AT(is_inside, at_u.s >= 0 && at_u.t >= 0 && at_v.s >= 0 && at_v.t >= 0))) return false;
  FourVector sum[kParts];
  value_at(map, at_u, at_v, sum);
  const int components = map.surface.components;
  const unsigned wanted = (1U << components) - 1, settled = settle(map.test, sum, position) & wanted;
  if (components == 3) position[3] = 1;
  return settled == wanted && is_nearest(map.probe);
}

// Evaluates cubics in powers of x and y, in a domain whose width has an exact inverse.
template <bool kSurface>
bool evaluate_cubic_directly(const glev_plan& plan, double u, double v, float* position) {
  const PreparedMap& map = plan.map(Attribute::kVertex);
  const auto place = [&](int direction, double argument) {
    const auto& [scale, middle] = map.place[direction];
    return hn::MulSub(hn::Set(kFour, argument), hn::Set(kFour, scale), hn::Set(kFour, middle));
  };
  const FourVector x = place(0, u);
  FourVector farthest = hn::Abs(x), y;
  if constexpr (kSurface) {
    y = place(1, v);
    farthest = hn::Max(farthest, hn::Abs(y));
  }
  FourVector sum[kParts];
  for (std::size_t part = 0; part < kParts; ++part) {
    const double* const centred = map.centred + part * kFourLanes;
    const auto cubic = [&](const double* first, FourVector at) {
      FourVector value = hn::Load(kFour, first + 12);
      for (int i = 2; i >= 0; --i) value = hn::MulAdd(value, at, hn::Load(kFour, first + 4 * i));
      return value;
    };
    if constexpr (kSurface) {
      sum[part] = cubic(centred + 48, x);
      for (int j = 2; j >= 0; --j)
        sum[part] = hn::MulAdd(sum[part], y, cubic(centred + GLEV_AT(row_of_coefficients, 16) * j, x));
    } else {
      sum[part] = cubic(centred, x);
    }
  }
  const bool inside = hn::AllTrue(kFour, hn::Le(farthest, hn::Set(kFour, 1)));
  return settle(map.centred_test, sum, position) == 0xF && inside && is_nearest(map.probe);
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_DIRECT_INL_H_
