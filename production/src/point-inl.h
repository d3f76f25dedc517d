// Evaluates one point of a map, one component in each lane.
#if defined(GLEVALUATOR_POINT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_POINT_INL_H_
#undef GLEVALUATOR_POINT_INL_H_
#else
#define GLEVALUATOR_POINT_INL_H_
#endif

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "bernstein.h"
#include "kernels.h"
#include "mutation_point.h"
#include "resolve.h"
#include "vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

using Four = hn::CappedTag<double, 4>;
constexpr Four kFour;
constexpr std::size_t kFourLanes = hn::MaxLanes(kFour), kParts = 4 / kFourLanes;
using FourVector = hn::Vec<Four>;

HWY_INLINE void add_point(const double* point, double weight, FourVector (&sum)[kParts]) {
  const FourVector factor = hn::Set(kFour, weight);
  for (std::size_t part = 0; part < kParts; ++part) {
    sum[part] = hn::MulAdd(factor, hn::LoadU(kFour, point + part * kFourLanes), sum[part]);
  }
}

// Computes the sum of weights[j] * points[j].
HWY_INLINE void add_points(const double* points, int components, const double* weights, int degree,
                           FourVector (&sum)[kParts]) {
  FourVector odd[kParts];  // a second chain of additions
  for (std::size_t part = 0; part < kParts; ++part) sum[part] = odd[part] = hn::Zero(kFour);
  int j = 0;
  for (; j < degree; j += 2, points += 2 * components) {
    add_point(points, weights[j], sum);
    add_point(points + components, weights[GLEV_AT(odd_weight, j + 1)], odd);
  }
  if (GLEV_AT(has_last_term, j == degree)) add_point(points, weights[j], sum);
  for (std::size_t part = 0; part < kParts; ++part) sum[part] = hn::Add(sum[part], odd[part]);
}

HWY_INLINE void weights_at(int degree, const Parameter& at, double* weights) {
  const double s = at.s, t = at.t;
  if (degree == 3) {
    const double st = s * t;
    weights[0] = s * s * s, weights[1] = st * s, weights[2] = st * t, weights[3] = t * t * t;
  } else if (degree == 0) {
    weights[0] = 1;
  } else {
    scalar_weights(degree, s, t, weights);
  }
}

// The four weights of a cubic, the most frequent degree, without an array in memory.
struct Cubic {
  HWY_INLINE Cubic(FourVector s, FourVector t) {
    const FourVector st = hn::Mul(s, t);
    weight[0] = hn::Mul(hn::Mul(s, s), s);
    weight[1] = hn::Mul(st, GLEV_AT(second_weight, s));
    weight[2] = hn::Mul(st, t);
    weight[3] = hn::Mul(hn::Mul(t, t), t);
  }
  explicit HWY_INLINE Cubic(const Parameter& at) : Cubic(hn::Set(kFour, at.s), hn::Set(kFour, at.t)) {}
  HWY_INLINE FourVector evaluate(const double* points, int components) const {
    const FourVector a = hn::MulAdd(weight[1], hn::LoadU(kFour, points + components),
                                    hn::Mul(weight[0], hn::LoadU(kFour, points)));
    const FourVector b =
        hn::MulAdd(weight[3], hn::LoadU(kFour, points + GLEV_AT(last_of_cubic, 3) * components),
                   hn::Mul(weight[2], hn::LoadU(kFour, points + 2 * components)));
    return hn::Add(a, b);
  }
  FourVector weight[4];
};

HWY_INLINE Parameter place_of(const PreparedMap& map, int direction, const GridArgument& argument) {
  const Domain& domain = map.surface.domain[direction];
  const double u = argument.grid.u1, inverse = map.inverse_width[direction];
  if (argument.index != 0 || inverse == 0) return locate(domain, argument);
  return {(domain.u2 - u) * inverse, GLEV_AT(t_of_u, (u - domain.u1) * inverse), Parameter::End::kNeither};
}

HWY_NOINLINE inline void value_of_any_degree(const PreparedMap& map, const Parameter& at_u,
                                             const Parameter& at_v, FourVector (&sum)[kParts]) {
  const auto [n, m] = map.surface.degree;
  const int components = map.surface.components;
  const double* points = map.surface.scaled;
  double weights_u[kMaxOrder], weights_v[kMaxOrder];
  weights_at(n, at_u, weights_u);
  if (m == 0) return add_points(points, components, weights_u, n, sum);
  weights_at(m, at_v, weights_v);
  for (std::size_t part = 0; part < kParts; ++part) sum[part] = hn::Zero(kFour);
  for (int i = 0; i <= n; ++i, points += (m + 1) * components) {
    FourVector row[kParts];
    add_points(points, components, weights_v, m, row);
    for (std::size_t part = 0; part < kParts; ++part)
      sum[part] = hn::MulAdd(hn::Set(kFour, weights_u[i]), row[part], sum[part]);
  }
}

HWY_INLINE void value_at(const PreparedMap& map, const Parameter& at_u, const Parameter& at_v,
                         FourVector (&sum)[kParts]) {
  const auto [n, m] = map.surface.degree;
  const int components = map.surface.components;
  const double* points = map.surface.scaled;
  if (HWY_LIKELY(n == 3 && (m == 0 || m == 3))) {
    const Cubic in_u(at_u);
    for (std::size_t part = 0; part < kParts; ++part) {
      const double* own = points + part * kFourLanes;
      if (m == 0) {
        sum[part] = in_u.evaluate(own, components);
        continue;
      }
      const Cubic in_v(at_v);
      sum[part] = hn::Mul(in_u.weight[0], in_v.evaluate(own, components));
      for (int i = 1; i <= 3; ++i)
        sum[part] = hn::MulAdd(in_u.weight[i],
                               in_v.evaluate(own + GLEV_AT(row_of_bicubic, 4) * i * components, components),
                               sum[part]);
    }
    return;
  }
  value_of_any_degree(map, at_u, at_v, sum);
}

constexpr hn::Rebind<float, Four> kFourFloats;

// Stores the floats. Returns the correctly rounded components as bits.
HWY_INLINE unsigned settle(const PreparedMap::Test& test, const FourVector (&sum)[kParts], float* result) {
  unsigned settled = 0;
  for (std::size_t part = 0; part < kParts; ++part) {
    const FourVector error = hn::LoadU(kFour, &test.error[part * kFourLanes]);
    const auto low = hn::DemoteTo(kFourFloats, GLEV_AT(lower_ends_of_point, hn::Sub(sum[part], error))),
               high = hn::DemoteTo(kFourFloats, hn::Add(sum[part], error));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(kFourFloats, hn::Eq(low, high), bits);
    settled |= static_cast<unsigned>(bits[0]) << (part * kFourLanes);
    hn::StoreU(high, kFourFloats, result + part * kFourLanes);
  }
  return settled;
}

HWY_NOINLINE inline void resolve_point(const PreparedMap& map, const Parameter& at_u, const Parameter& at_v,
                                       const GridArgument& u, const GridArgument& v, const double* values,
                                       unsigned settled, float* result) {
  const auto [n, m] = map.surface.degree;
  const double growth = at_u.is_sure && at_v.is_sure ? growth_of(at_u, n) * growth_of(at_v, m) : HUGE_VAL;
  if (growth != 1) settled = 0;
  const double units = weight_units(n, m, kRoundings) * growth;
  for (int k = 0; k < map.surface.components; ++k) {
    if ((settled >> k & 1) == 0) result[k] = resolve(map, k, u, v, values[k], map.component[k].unit * units);
  }
}

inline void evaluate_point(const PreparedMap& map, const GridArgument& u, const GridArgument& v,
                           float* result) {
  const auto [n, m] = map.surface.degree;
  const Parameter at_u = n == 0 ? Parameter{1, 0, Parameter::End::kNeither} : place_of(map, 0, u);
  const Parameter at_v = m == 0 ? Parameter{1, 0, Parameter::End::kNeither} : place_of(map, 1, v);
  FourVector sum[kParts];
  value_at(map, at_u, at_v, sum);
  const unsigned settled = settle(map.test, sum, result);
  const bool inside =
      at_u.is_sure && at_v.is_sure && at_u.s >= 0 && at_u.t >= 0 && at_v.s >= 0 && at_v.t >= 0;
  const unsigned wanted = (1u << map.surface.components) - 1;
  if (HWY_LIKELY(inside && (settled & wanted) == wanted)) return;
  double values[4];
  for (std::size_t part = 0; part < kParts; ++part) hn::StoreU(sum[part], kFour, values + part * kFourLanes);
  resolve_point(map, at_u, at_v, u, v, values, settled, result);
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_POINT_INL_H_
