// Evaluates curves and surfaces at scattered arguments, one in each lane.
#if defined(GLEVALUATOR_SCATTERED_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_SCATTERED_INL_H_
#undef GLEVALUATOR_SCATTERED_INL_H_
#else
#define GLEVALUATOR_SCATTERED_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "arguments-inl.h"
#include "mutation_point.h"
#include "resolve.h"
#include "weights-inl.h"
#include "writer-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

// The arguments of a call. Curves do not use v.
struct ScatteredInputs {
  const Input &u, &v;
  std::size_t count;
};

// Evaluates correctly rounded maps: evaluate(u, v, value) computes values in double of kStep arguments, with
// the error bound of the test. NaN is undecided.
template <int kComponents, bool kIsSurface, class Evaluate>
HWY_INLINE void evaluate_scattered(const PreparedMap& map, const PreparedMap::Test& test,
                                   const ScatteredInputs& inputs, const Destination& to,
                                   const Evaluate& evaluate) {
  const auto& [input_u, input_v, count] = inputs;
  const Writer<kComponents> writer(test, to, to.data);
  const Arguments arguments_u(input_u, count), arguments_v(kIsSurface ? input_v : input_u, count);
  for (std::size_t begin = 0; begin < count; begin += kStep) {
    Vector u[kUnroll], v[kUnroll], value[kUnroll][kComponents];
    arguments_u.load(begin, u);
    if constexpr (kIsSurface) arguments_v.load(begin, v);
    evaluate(u, v, value);
    writer.write(value, begin, std::min(kStep, count - begin), [&](std::size_t i, int k) {
      return resolve(map, k, argument_at(inputs.u[i]), argument_at(kIsSurface ? inputs.v[i] : 0));
    });
  }
}

// Evaluates maps of degrees kN and kM by Horner's rule in x = t - s of each direction. Arguments outside the
// domain are undecided.
template <int kComponents, int kN, int kM>
void evaluate_low_degree(const PreparedMap& map, const ScatteredInputs& inputs, const Destination& to) {
  const Place place_u(map, 0), place_v(map, kM == 0 ? 0 : 1);
  const double* const centred = map.centred;
  const Vector one = hn::Set(kDoubles, 1), nan = hn::Set(kDoubles, std::numeric_limits<double>::quiet_NaN());
  const auto evaluate = [&](Vector(&x)[kUnroll], Vector(&y)[kUnroll],
                            Vector(&value)[kUnroll][kComponents]) HWY_ATTR {
    Vector farthest = hn::Zero(kDoubles);
    const auto locate = [&](const Place& place, Vector(&at)[kUnroll]) HWY_ATTR {
      for (std::size_t part = 0; part < kUnroll; ++part) {
        at[part] = place.x_of(at[part]);
        farthest = hn::Max(farthest, hn::Abs(at[part]));
      }
    };
    locate(place_u, x);
    if constexpr (kM != 0) locate(place_v, y);
    if (HWY_UNLIKELY(!GLEV_AT(all_are_inside, hn::AllTrue(kDoubles, hn::Le(farthest, one))))) {
      for (std::size_t part = 0; part < kUnroll; ++part) {
        x[part] = hn::IfThenElse(hn::Le(hn::Abs(x[part]), one), x[part], nan);
        if constexpr (kM != 0) x[part] = hn::IfThenElse(hn::Le(hn::Abs(y[part]), one), x[part], nan);
      }
    }
    for (int k = 0; k < kComponents; ++k) {
      for (int j = kM; j >= 0; --j) {
        const double* const row = centred + 4 * (kN + 1) * j + k;
        Vector sum[kUnroll];
        for (int i = kN; i >= 0; --i) {
          const Vector next = hn::Set(kDoubles, row[4 * i]);
          for (std::size_t part = 0; part < kUnroll; ++part)
            sum[part] = i == kN ? next : hn::MulAdd(sum[part], x[part], next);
        }
        for (std::size_t part = 0; part < kUnroll; ++part)
          value[part][k] = j == kM ? sum[part] : hn::MulAdd(value[part][k], y[part], sum[part]);
      }
    }
  };
  evaluate_scattered<kComponents, kM != 0>(map, map.centred_test, inputs, to, evaluate);
}

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
void evaluate_high_curves(const PreparedMap& map, const ScatteredInputs& inputs, const Destination& to) {
  const Place place(map, 0);
  const int degree = map.surface.degree[0];
  const double* const last = map.surface.scaled + degree * kComponents;
  // If s >= least, s^degree and (t/s)^degree are between 2^-800 and 2^800.
  const Vector least = hn::Set(kDoubles, GLEV_AT(least_ratio, std::exp2(-800.0 / degree)));
  const Vector nan = hn::Set(kDoubles, std::numeric_limits<double>::quiet_NaN());
  const auto evaluate = [&](const Vector(&u)[kUnroll], const Vector(&)[kUnroll],
                            Vector(&value)[kUnroll][kComponents]) HWY_ATTR {
    Vector ratio[kUnroll], power[kUnroll];
    const double* point = last;
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
  };
  evaluate_scattered<kComponents, false>(map, make_test(map, horner_units(degree, place.roundings()), 1),
                                         inputs, to, evaluate);
}

// Evaluates surfaces as sums of products with weights.
template <int kComponents>
void evaluate_high_surfaces(const PreparedMap& map, const ScatteredInputs& inputs, const Destination& to) {
  const Place place_u(map, 0), place_v(map, 1);
  const int n = map.surface.degree[0], m = map.surface.degree[1];
  const double* const points = map.surface.scaled;
  const auto evaluate = [&](const Vector(&u)[kUnroll], const Vector(&v)[kUnroll],
                            Vector(&value)[kUnroll][kComponents]) HWY_ATTR {
    for (std::size_t part = 0; part < kUnroll; ++part) {
      Vector weights_u[kMaxOrder], weights_v[kMaxOrder];
      const Vector su = place_u.s_of(u[part]), sv = place_v.s_of(v[part]);
      weights_of(n, su, nan_outside(place_u.t_of(u[part]), su), weights_u);
      weights_of(m, sv, GLEV_AT(t_inside_in_v, nan_outside(place_v.t_of(v[part]), sv)), weights_v);
      for (int k = 0; k < kComponents; ++k) value[part][k] = hn::Zero(kDoubles);
      const double* point = points;
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
  };
  const double units = weight_units(n, m, std::max(place_u.roundings(), place_v.roundings()));
  evaluate_scattered<kComponents, true>(map, make_test(map, units, 1), inputs, to, evaluate);
}

// Computes the weights of arguments in one direction in float, from s and t with one to three roundings.
struct FastPlace {
  FastPlace(const PreparedMap& map, int direction, const Input& input) : place(map, direction) {
    const auto [u1, u2] = map.surface.domain[direction];
    const auto is_float = [](double x) { return static_cast<double>(static_cast<float>(x)) == x; };
    is_in_float = !input.is_double && input.stride == sizeof(float) && place.has_inverse && is_float(u1) &&
                  is_float(u2) && is_float(map.inverse_width[direction]);
    first = hn::Set(kWhole, static_cast<float>(u1)), last = hn::Set(kWhole, static_cast<float>(u2));
    inverse = hn::Set(kWhole, static_cast<float>(map.inverse_width[direction]));
  }

  // Computes the weights of `count` <= kStep arguments from `begin` on. Returns the lanes whose s and t are
  // positive.
  HWY_INLINE hn::Mask<decltype(kWhole)> weigh(const Input& input, std::size_t begin, std::size_t count,
                                              Whole* weights) const {
    Whole s, t;
    if (HWY_LIKELY(is_in_float && count == kStep)) {
      const Whole u = hn::LoadU(kWhole, reinterpret_cast<const float*>(input.data) + begin);
      s = hn::Mul(hn::Sub(last, u), inverse), t = hn::Mul(hn::Sub(u, first), inverse);
    } else {
      Vector u[kUnroll];
      Arguments(input, begin + count).load(begin, u);
      Half parts_s[kUnroll], parts_t[kUnroll];
      for (std::size_t part = 0; part < kUnroll; ++part) {
        parts_s[part] = hn::DemoteTo(kHalves, place.s_of(u[part]));
        parts_t[part] = hn::DemoteTo(kHalves, place.t_of(u[part]));
      }
      s = join(parts_s), t = join(parts_t);
    }
    const auto zero = hn::Zero(kWhole);
    const auto is_inside = GLEV_AT(strictly_inside, hn::And(hn::Gt(s, zero), hn::Gt(t, zero)));
    // Weights of smaller numbers would be subnormal, which is slow. The error is below 2^-38 max|R|.
    const Whole least = hn::Set(kWhole, 0x1p-40F);
    s = hn::IfThenElseZero(hn::Ge(s, least), s), t = hn::IfThenElseZero(hn::Ge(t, least), t);
    const Whole st = hn::Mul(s, t);
    weights[0] = hn::Mul(hn::Mul(s, s), s), weights[1] = hn::Mul(st, s);
    weights[2] = hn::Mul(st, t), weights[3] = hn::Mul(hn::Mul(t, t), t);
    return is_inside;
  }

  Place place;
  Whole first, last, inverse;
  bool is_in_float;  // if that is as accurate
};

// Evaluates surfaces with GLEV_FAST, in float, as sums of products with weights t^i s^(3-i). In units of
// 2^-24 of the sum of the magnitudes of the terms, which is at most max|R|, the errors of a term are 3
// roundings of t or s and 2 of products in each direction, 1 of the coefficient, and at most 4 of each of the
// two sums. So the bound of GLEV_FAST, 48, holds. Points outside the domain and on its boundary are correctly
// rounded.
template <int kComponents>
void evaluate_fast_bicubic_surfaces(const PreparedMap& map, const ScatteredInputs& inputs,
                                    const Destination& to) {
  constexpr int kOrder = 4;
  const auto& [input_u, input_v, count] = inputs;
  const FastPlace fast_u(map, 0, input_u), fast_v(map, 1, input_v);
  float points[kOrder * kOrder * kComponents];
  for (int i = 0; i < kOrder * kOrder * kComponents; ++i)
    points[i] = static_cast<float>(map.surface.scaled[i]);
  const bool packed = is_packed(kComponents, to);
  for (std::size_t begin = 0; begin < count; begin += kStep) {
    const std::size_t part_count = std::min(kStep, count - begin);
    Whole weights_u[kOrder], weights_v[kOrder];
    const auto inside = hn::And(fast_u.weigh(input_u, begin, part_count, weights_u),
                                fast_v.weigh(input_v, begin, part_count, weights_v));
    Whole value[kComponents];
    for (int k = 0; k < kComponents; ++k) {
      for (int i = 0; i < kOrder; ++i) {
        const float* const row = points + i * kOrder * kComponents + k;
        Whole sum = hn::Mul(weights_v[0], hn::Set(kWhole, row[0]));
        for (int j = 1; j < kOrder; ++j)
          sum = hn::MulAdd(weights_v[j], hn::Set(kWhole, row[j * kComponents]), sum);
        value[k] = i == 0 ? hn::Mul(weights_u[0], sum) : hn::MulAdd(weights_u[i], sum, value[k]);
      }
    }
    std::byte* const data = to.data + begin * to.stride;
    store_points<kComponents>(value, part_count, packed, to, data);
    if (HWY_LIKELY(hn::AllTrue(kWhole, inside))) continue;
    float exact[kStep * kComponents];
    const auto part_of = [begin](const Input& input) {
      return Input{input.data + begin * input.stride, input.stride, input.is_double};
    };
    evaluate_low_degree<kComponents, 3, 3>(
        map, {part_of(input_u), part_of(input_v), part_count},
        {reinterpret_cast<std::byte*>(exact), kComponents * sizeof(float), 0, kComponents});
    for (std::size_t i = 0; i < part_count; ++i) {
      const auto is_inside = [](const Domain& domain, double u) {
        return std::min(domain.u1, domain.u2) < u && u < std::max(domain.u1, domain.u2);
      };
      if (is_inside(map.surface.domain[0], input_u[begin + i]) &&
          is_inside(map.surface.domain[1], input_v[begin + i]))
        continue;
      std::memcpy(data + i * to.stride, exact + i * kComponents, kComponents * sizeof(float));
    }
  }
}

template <int kComponents>
void evaluate_curves(const PreparedMap& map, const ScatteredInputs& inputs, const Destination& to) {
  switch (map.surface.degree[0]) {
    case 1:
      return evaluate_low_degree<kComponents, 1, 0>(map, inputs, to);
    case 2:
      return evaluate_low_degree<kComponents, 2, 0>(map, inputs, to);
    case 3:
      return evaluate_low_degree<kComponents, 3, 0>(map, inputs, to);
    default:
      return evaluate_high_curves<kComponents>(map, inputs, to);
  }
}

template <int kComponents>
void evaluate_surfaces(const PreparedMap& map, const ScatteredInputs& inputs, bool fast,
                       const Destination& to) {
  // The instruction sets before these convert too slowly.
  constexpr bool kHasFast = HWY_NATIVE_FMA || HWY_TARGET == HWY_SSE4;
  const bool is_bicubic = map.surface.degree == std::array{3, 3};
  const auto evaluate = kHasFast && is_bicubic && fast && has_fast_bound(map)
                            ? evaluate_fast_bicubic_surfaces<kComponents>
                        : is_bicubic ? evaluate_low_degree<kComponents, 3, 3>
                                     : evaluate_high_surfaces<kComponents>;
  evaluate(map, inputs, to);
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_SCATTERED_INL_H_
