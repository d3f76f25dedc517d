// Evaluates curves of low degree and bicubic surfaces at scattered arguments, one in each lane.
#if defined(GLEVALUATOR_LOW_DEGREE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_LOW_DEGREE_INL_H_
#undef GLEVALUATOR_LOW_DEGREE_INL_H_
#else
#define GLEVALUATOR_LOW_DEGREE_INL_H_
#endif

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>

#include "arguments-inl.h"
#include "mutation_point.h"
#include "resolve.h"
#include "writer-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

// Evaluates correctly rounded maps of degrees kN and kM by Horner's rule in x = t - s of each direction.
// Arguments outside the domain are undecided. If kM is 0, `input_v` is not used.
template <int kComponents, int kN, int kM>
void evaluate_low_degree(const PreparedMap& map, const Input& input_u, const Input& input_v,
                         std::size_t count, const Destination& to) {
  const Place place_u(map, 0), place_v(map, kM == 0 ? 0 : 1);
  const double* const centred = map.centred;
  const Writer<kComponents> writer(map.centred_test, to, to.data);
  const Vector one = hn::Set(kDoubles, 1), nan = hn::Set(kDoubles, std::numeric_limits<double>::quiet_NaN());
  const Arguments arguments_u(input_u, count), arguments_v(kM == 0 ? input_u : input_v, count);
  for (std::size_t begin = 0; begin < count; begin += kStep) {
    const std::size_t part_count = std::min(kStep, count - begin);
    Vector x[kUnroll], y[kUnroll], farthest = hn::Zero(kDoubles);
    const auto load = [&](const Arguments& arguments, const Place& place, Vector(&at)[kUnroll]) HWY_ATTR {
      arguments.load(begin, at);
      for (std::size_t part = 0; part < kUnroll; ++part) {
        at[part] = place.x_of(at[part]);
        farthest = hn::Max(farthest, hn::Abs(at[part]));
      }
    };
    load(arguments_u, place_u, x);
    if constexpr (kM != 0) load(arguments_v, place_v, y);
    if (HWY_UNLIKELY(!GLEV_AT(all_are_inside, hn::AllTrue(kDoubles, hn::Le(farthest, one))))) {
      for (std::size_t part = 0; part < kUnroll; ++part) {
        x[part] = hn::IfThenElse(hn::Le(hn::Abs(x[part]), one), x[part], nan);
        if constexpr (kM != 0) x[part] = hn::IfThenElse(hn::Le(hn::Abs(y[part]), one), x[part], nan);
      }
    }
    Vector value[kUnroll][kComponents];
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
    writer.write(writer.round(value), begin, part_count, [&](std::size_t i, int k) {
      return resolve(map, k, argument_at(input_u[i]), argument_at(kM == 0 ? 0 : input_v[i]));
    });
  }
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
void evaluate_fast_bicubic_surfaces(const PreparedMap& map, const Input& input_u, const Input& input_v,
                                    std::size_t count, const Destination& to) {
  constexpr int kOrder = 4;
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
    if (HWY_LIKELY(packed && part_count == kStep)) {
      interleave<kComponents>(value, reinterpret_cast<float*>(data));
    } else {
      alignas(64) float values[kStep * kComponents];
      interleave<kComponents>(value, values);
      scatter<kComponents>(values, part_count, to, data);
    }
    if (HWY_LIKELY(hn::AllTrue(kWhole, inside))) continue;
    float exact[kStep * kComponents];
    const auto part_of = [&](const Input& input) {
      return Input{input.data + begin * input.stride, input.stride, input.is_double};
    };
    evaluate_low_degree<kComponents, 3, 3>(
        map, part_of(input_u), part_of(input_v), part_count,
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

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_LOW_DEGREE_INL_H_
