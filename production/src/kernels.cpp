// Compiled once for each instruction set. The bounds of what is computed in double: prepared_map.h; all else
// follows from results being correctly rounded.
#include "production/src/kernels.h"

#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>

#include "production/src/binomials.h"
#include "production/src/plan.h"
#include "production/src/resolve.h"
#include "production/src/triples.h"

// Assertions of Highway need its library, which has nothing else that is needed here.
#define HWY_IS_DEBUG_BUILD 0
// Without fused operations these would be one more way to do the same; scalable vectors cannot be in arrays.
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "production/src/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Doubles>;
constexpr Doubles kDoubles;
constexpr std::size_t kLanes = hn::MaxLanes(kDoubles);
constexpr hn::Rebind<float, Doubles> kHalves;  // as many floats

using Half = hn::Vec<decltype(kHalves)>;

// ---- Results of a few points, lane by lane

#if HWY_TARGET == HWY_SCALAR
constexpr std::size_t kUnroll = 1;
constexpr decltype(kHalves) kWhole;
HWY_INLINE Half Join(const Half (&parts)[kUnroll]) { return parts[0]; }
#else
constexpr std::size_t kUnroll = 2;
constexpr hn::Twice<decltype(kHalves)> kWhole;
HWY_INLINE hn::Vec<decltype(kWhole)> Join(const Half (&parts)[kUnroll]) {
  return hn::Combine(kWhole, parts[1], parts[0]);
}
#endif
constexpr std::size_t kStep = kUnroll * kLanes;
using Whole = hn::Vec<decltype(kWhole)>;

// Whether points can be stored one behind the other. Single floats cannot where they are not aligned.
template <int kComponents>
bool IsPacked(const Destination& to) {
  const bool is_aligned =
      reinterpret_cast<std::uintptr_t>(to.data) % alignof(float) == 0 && to.row_stride % alignof(float) == 0;
  return to.components == kComponents && to.stride == kComponents * sizeof(float) &&
         (kLanes > 1 || is_aligned);
}

// Points one behind the other, that vectors have written, to where they belong.
template <int kComponents>
HWY_NOINLINE void Scatter(const float* values, std::size_t count, const Destination& to, std::byte* data) {
  if constexpr (kComponents == 3) {
    if (count % 4 == 0 && to.components == 3) return CopyTriples(values, count, to.stride, data);
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 4> element = {0, 0, 0, 1};
    std::memcpy(element.data(), values + i * kComponents, kComponents * sizeof(float));
    std::memcpy(data + i * to.stride, element.data(), to.components * sizeof(float));
  }
}

// The results of a map. Lanes that are NaN are not settled.
template <int kComponents>
class Writer {
 public:
  // Values as floats, and which of them are right.
  struct Rounded {
    Whole value[kComponents];
    hn::Mask<decltype(kWhole)> settled[kComponents];
  };

  Writer(const PreparedMap::Test& test, const Destination& to, std::byte* data) : to_(to), data_(data) {
    for (int k = 0; k < kComponents; ++k) error_[k] = hn::Set(kDoubles, test.error[k]);
    is_packed_ = IsPacked<kComponents>(to);
  }

  HWY_INLINE Rounded Round(const Vector (&value)[kUnroll][kComponents]) const {
    Rounded rounded;
    for (int k = 0; k < kComponents; ++k) {
      Half low[kUnroll], high[kUnroll];
      for (std::size_t part = 0; part < kUnroll; ++part) {
        low[part] = hn::DemoteTo(kHalves, hn::Sub(value[part][k], error_[k]));
        high[part] = hn::DemoteTo(kHalves, hn::Add(value[part][k], error_[k]));
      }
      rounded.value[k] = Join(high);
      rounded.settled[k] = hn::Eq(Join(low), rounded.value[k]);
    }
    return rounded;
  }

  // The elements from `begin` on, `count` <= kStep of them. Where one is not settled resolve(element,
  // component) is right.
  template <class Resolver>
  HWY_INLINE void Write(const Rounded& rounded, std::size_t begin, std::size_t count,
                        const Resolver& resolve) const {
    if (HWY_LIKELY(is_packed_ && count == kStep)) {
      Interleave(rounded, reinterpret_cast<float*>(data_ + begin * to_.stride));
    } else {
      alignas(64) float values[kStep * kComponents];
      Interleave(rounded, values);
      Scatter<kComponents>(values, count, to_, data_ + begin * to_.stride);
    }
    auto settled = rounded.settled[0];
    for (int k = 1; k < kComponents; ++k) settled = hn::And(settled, rounded.settled[k]);
    if (HWY_UNLIKELY(!hn::AllTrue(kWhole, settled))) {
      std::uint8_t bits[kComponents][8];
      for (int k = 0; k < kComponents; ++k) hn::StoreMaskBits(kWhole, rounded.settled[k], bits[k]);
      Repair(bits, begin, count, resolve);
    }
  }

 private:
  static HWY_INLINE void Interleave(const Rounded& rounded, float* to) {
#if HWY_TARGET == HWY_SCALAR
    for (int k = 0; k < kComponents; ++k) to[k] = hn::GetLane(rounded.value[k]);
#else
    const auto& value = rounded.value;
    if constexpr (kComponents == 1) hn::StoreU(value[0], kWhole, to);
    if constexpr (kComponents == 2) hn::StoreInterleaved2(value[0], value[1], kWhole, to);
    if constexpr (kComponents == 3) hn::StoreInterleaved3(value[0], value[1], value[2], kWhole, to);
    if constexpr (kComponents == 4) hn::StoreInterleaved4(value[0], value[1], value[2], value[3], kWhole, to);
#endif
  }

  template <class Resolver>
  HWY_NOINLINE void Repair(const std::uint8_t (&settled)[kComponents][8], std::size_t begin,
                           std::size_t count, const Resolver& resolve) const {
    for (std::size_t i = 0; i < count; ++i) {
      for (int k = 0; k < kComponents; ++k) {
        if ((settled[k][i / 8] >> (i % 8) & 1) != 0) continue;
        const float result = resolve(begin + i, k);
        std::memcpy(data_ + (begin + i) * to_.stride + k * sizeof(float), &result, sizeof result);
      }
    }
  }

  const Destination& to_;
  std::byte* data_;
  bool is_packed_;
  Vector error_[kComponents];
};

// ---- Arguments

// What t and s are computed from.
struct Place {
  Place(const PreparedMap& map, int direction)
      : u1(hn::Set(kDoubles, map.surface.domain[direction].u1)),
        u2(hn::Set(kDoubles, map.surface.domain[direction].u2)),
        width(hn::Sub(u2, u1)),
        inverse(hn::Set(kDoubles, map.inverse_width[direction])),
        scale(hn::Add(inverse, inverse)),
        middle(hn::Mul(hn::Add(u1, u2), inverse)),
        has_inverse(map.inverse_width[direction] != 0) {}
  HWY_INLINE Vector Divided(Vector x) const { return has_inverse ? hn::Mul(x, inverse) : hn::Div(x, width); }
  HWY_INLINE Vector T(Vector u) const { return Divided(hn::Sub(u, u1)); }
  HWY_INLINE Vector S(Vector u) const { return Divided(hn::Sub(u2, u)); }

  // t - s where there is an inverse: it is a power of two, so that this is rounded once.
  HWY_INLINE Vector X(Vector u) const { return hn::MulSub(u, scale, middle); }

  // Of t and s.
  int roundings() const { return has_inverse ? 1 : 3; }

  Vector u1, u2, width, inverse, scale, middle;
  bool has_inverse;  // that is exact
};

// The arguments from `begin` on, kStep of them; those from `count` on are the last one.
HWY_INLINE void Fetch(const Input& input, std::size_t begin, std::size_t count, double* arguments) {
  if (!input.is_double && input.stride == sizeof(float) && count == kStep) {
    const auto* floats = reinterpret_cast<const float*>(input.data) + begin;
    for (std::size_t i = 0; i < kStep; i += kLanes)
      hn::Store(hn::PromoteTo(kDoubles, hn::LoadU(kHalves, floats + i)), kDoubles, arguments + i);
    return;
  }
  for (std::size_t i = 0; i < kStep; ++i) arguments[i] = input[begin + std::min(i, count - 1)];
}

// t inside the domain, NaN elsewhere.
HWY_INLINE Vector Inside(Vector t, Vector s) {
  const Vector nan = hn::Set(kDoubles, std::numeric_limits<double>::quiet_NaN());
  return hn::IfThenElse(hn::Ge(hn::Min(t, s), hn::Zero(kDoubles)), t, nan);
}

HWY_INLINE Vector Power(Vector base, int exponent) {
  Vector power = hn::Set(kDoubles, 1);
  for (;; base = hn::Mul(base, base)) {
    if (exponent & 1) power = hn::Mul(power, base);
    exponent >>= 1;
    if (exponent == 0) return power;
  }
}

// ---- Curves

// In powers of t - s.
template <int kComponents, int kDegree>
void LowCurves(const PreparedMap& map, const Input& input, std::size_t count, const Destination& to) {
  const Place place(map, 0);
  const double* const centred = map.centred;
  const Writer<kComponents> writer(map.centred_test, to, to.data);
  const Vector one = hn::Set(kDoubles, 1), nan = hn::Set(kDoubles, std::numeric_limits<double>::quiet_NaN());
  const bool is_packed = !input.is_double && input.stride == sizeof(float) && place.has_inverse;
  for (std::size_t begin = 0; begin < count; begin += kStep) {
    const std::size_t part_count = std::min(kStep, count - begin);
    Vector x[kUnroll];
    if (HWY_LIKELY(is_packed && part_count == kStep)) {
      const auto* const floats = reinterpret_cast<const float*>(input.data) + begin;
      for (std::size_t part = 0; part < kUnroll; ++part)
        x[part] = place.X(hn::PromoteTo(kDoubles, hn::LoadU(kHalves, floats + part * kLanes)));
    } else {
      alignas(64) double arguments[kStep];
      Fetch(input, begin, part_count, arguments);
      for (std::size_t part = 0; part < kUnroll; ++part) {
        const Vector u = hn::Load(kDoubles, arguments + part * kLanes);
        x[part] = hn::Sub(place.T(u), place.S(u));
      }
    }
    Vector farthest = hn::Abs(x[0]);
    for (std::size_t part = 1; part < kUnroll; ++part) farthest = hn::Max(farthest, hn::Abs(x[part]));
    if (HWY_UNLIKELY(!hn::AllTrue(kDoubles, hn::Le(farthest, one)))) {
      for (std::size_t part = 0; part < kUnroll; ++part)
        x[part] = hn::IfThenElse(hn::Le(hn::Abs(x[part]), one), x[part], nan);
    }
    Vector value[kUnroll][kComponents];
    for (int k = 0; k < kComponents; ++k) {
      for (int i = kDegree; i >= 0; --i) {
        const Vector next = hn::Set(kDoubles, centred[i * kComponents + k]);
        for (std::size_t part = 0; part < kUnroll; ++part)
          value[part][k] = i == kDegree ? next : hn::MulAdd(value[part][k], x[part], next);
      }
    }
    writer.Write(writer.Round(value), begin, part_count,
                 [&](std::size_t i, int k) { return Resolve(map, k, At(input[i]), At(0)); });
  }
}

// Horner's rule in t / s, which is stable for all of them from 0 on: where it is so large that something
// could overflow the lane is not sure.
template <int kComponents>
void HighCurves(const PreparedMap& map, const Input& input, std::size_t count, const Destination& to) {
  const Place place(map, 0);
  const int degree = map.surface.degree[0];
  const double* const points = map.surface.scaled;
  const Writer<kComponents> writer(TestOf(map, HornerUnits(degree, place.roundings()), 1), to, to.data);
  // s^degree and (t/s)^degree stay within 2^800 and 2^-800 then.
  const Vector least = hn::Set(kDoubles, std::exp2(-800.0 / degree));
  const Vector nan = hn::Set(kDoubles, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t begin = 0; begin < count; begin += kStep) {
    const std::size_t part_count = std::min(kStep, count - begin);
    alignas(64) double arguments[kStep];
    Fetch(input, begin, part_count, arguments);
    Vector value[kUnroll][kComponents], ratio[kUnroll], power[kUnroll];
    const double* point = points + degree * kComponents;
    for (std::size_t part = 0; part < kUnroll; ++part) {
      const Vector u = hn::Load(kDoubles, arguments + part * kLanes);
      const Vector s = place.S(u), t = Inside(place.T(u), s);
      ratio[part] = hn::Div(t, hn::IfThenElse(hn::Ge(s, least), s, nan));
      power[part] = Power(s, degree);
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
    writer.Write(writer.Round(value), begin, part_count,
                 [&](std::size_t i, int k) { return Resolve(map, k, At(input[i]), At(0)); });
  }
}

template <int kComponents>
void CurvesOf(const PreparedMap& map, const Input& input, std::size_t count, const Destination& to) {
  switch (map.surface.degree[0]) {
    case 1:
      return LowCurves<kComponents, 1>(map, input, count, to);
    case 2:
      return LowCurves<kComponents, 2>(map, input, count, to);
    case 3:
      return LowCurves<kComponents, 3>(map, input, count, to);
    default:
      return HighCurves<kComponents>(map, input, count, to);
  }
}

// ---- Weights t^i s^(n-i)

HWY_INLINE void WeightsOf(int degree, Vector s, Vector t, Vector* weights) {
  weights[0] = hn::Set(kDoubles, 1);
  for (int i = 1; i <= degree; ++i) weights[i] = hn::Mul(weights[i - 1], t);
  Vector power = s;
  for (int i = degree - 1; i >= 0; --i, power = hn::Mul(power, s)) weights[i] = hn::Mul(weights[i], power);
}

void WeightsOf(int degree, double s, double t, double* weights) {
  weights[0] = 1;
  for (int i = 1; i <= degree; ++i) weights[i] = weights[i - 1] * t;
  double power = s;
  for (int i = degree - 1; i >= 0; --i, power *= s) weights[i] *= power;
}

// ---- Surfaces at scattered points

template <int kComponents>
void Surfaces(const PreparedMap& map, const Input& input_u, const Input& input_v, std::size_t count,
              const Destination& to) {
  const Place place_u(map, 0), place_v(map, 1);
  const auto [n, m] = map.surface.degree;
  const double units = WeightUnits(n, m, std::max(place_u.roundings(), place_v.roundings()));
  const Writer<kComponents> writer(TestOf(map, units, 1), to, to.data);
  for (std::size_t begin = 0; begin < count; begin += kStep) {
    const std::size_t part_count = std::min(kStep, count - begin);
    alignas(64) double arguments_u[kStep], arguments_v[kStep];
    Fetch(input_u, begin, part_count, arguments_u);
    Fetch(input_v, begin, part_count, arguments_v);
    Vector value[kUnroll][kComponents];
    for (std::size_t part = 0; part < kUnroll; ++part) {
      const Vector u = hn::Load(kDoubles, arguments_u + part * kLanes),
                   v = hn::Load(kDoubles, arguments_v + part * kLanes);
      Vector weights_u[kMaxOrder], weights_v[kMaxOrder];
      const Vector su = place_u.S(u), sv = place_v.S(v);
      WeightsOf(n, su, Inside(place_u.T(u), su), weights_u);
      WeightsOf(m, sv, Inside(place_v.T(v), sv), weights_v);
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
    writer.Write(writer.Round(value), begin, part_count,
                 [&](std::size_t i, int k) { return Resolve(map, k, At(input_u[i]), At(input_v[i])); });
  }
}

// ---- One point: lanes are components

using Four = hn::CappedTag<double, 4>;
constexpr Four kFour;
constexpr std::size_t kParts = 4 / hn::MaxLanes(kFour);
using FourVector = hn::Vec<Four>;

HWY_INLINE void AddPoint(const double* point, double weight, FourVector (&sum)[kParts]) {
  const FourVector factor = hn::Set(kFour, weight);
  for (std::size_t part = 0; part < kParts; ++part) {
    sum[part] = hn::MulAdd(factor, hn::LoadU(kFour, point + part * hn::MaxLanes(kFour)), sum[part]);
  }
}

// sum of weights[j] * points[j]
HWY_INLINE void AddPoints(const double* points, int components, const double* weights, int degree,
                          FourVector (&sum)[kParts]) {
  FourVector odd[kParts];  // a second chain of additions
  for (std::size_t part = 0; part < kParts; ++part) sum[part] = odd[part] = hn::Zero(kFour);
  int j = 0;
  for (; j < degree; j += 2, points += 2 * components) {
    AddPoint(points, weights[j], sum);
    AddPoint(points + components, weights[j + 1], odd);
  }
  if (j == degree) AddPoint(points, weights[j], sum);
  for (std::size_t part = 0; part < kParts; ++part) sum[part] = hn::Add(sum[part], odd[part]);
}

HWY_INLINE void WeightsAt(int degree, const Parameter& at, double* weights) {
  const double s = at.s, t = at.t;
  if (degree == 3) {
    const double st = s * t;
    weights[0] = s * s * s, weights[1] = st * s, weights[2] = st * t, weights[3] = t * t * t;
  } else if (degree == 0) {
    weights[0] = 1;
  } else {
    WeightsOf(degree, s, t, weights);
  }
}

// The four products of cubics, the most frequent ones, without an array.
struct Cubic {
  HWY_INLINE Cubic(FourVector s, FourVector t) {
    const FourVector st = hn::Mul(s, t);
    weight[0] = hn::Mul(hn::Mul(s, s), s);
    weight[1] = hn::Mul(st, s);
    weight[2] = hn::Mul(st, t);
    weight[3] = hn::Mul(hn::Mul(t, t), t);
  }
  explicit HWY_INLINE Cubic(const Parameter& at) : Cubic(hn::Set(kFour, at.s), hn::Set(kFour, at.t)) {}
  HWY_INLINE FourVector At(const double* points, int components) const {
    const FourVector a = hn::MulAdd(weight[1], hn::LoadU(kFour, points + components),
                                    hn::Mul(weight[0], hn::LoadU(kFour, points)));
    const FourVector b = hn::MulAdd(weight[3], hn::LoadU(kFour, points + 3 * components),
                                    hn::Mul(weight[2], hn::LoadU(kFour, points + 2 * components)));
    return hn::Add(a, b);
  }
  FourVector weight[4];
};

HWY_INLINE Parameter PlaceOf(const PreparedMap& map, int direction, const GridArgument& argument) {
  const Domain& domain = map.surface.domain[direction];
  const double u = argument.grid.u1, inverse = map.inverse_width[direction];
  if (argument.index != 0 || inverse == 0) return Locate(domain, argument);
  return {(domain.u2 - u) * inverse, (u - domain.u1) * inverse, Parameter::End::kNeither};
}

HWY_NOINLINE void ValueOfAnyDegree(const PreparedMap& map, const Parameter& at_u, const Parameter& at_v,
                                   FourVector (&sum)[kParts]) {
  const auto [n, m] = map.surface.degree;
  const int components = map.surface.components;
  const double* points = map.surface.scaled;
  double weights_u[kMaxOrder], weights_v[kMaxOrder];
  WeightsAt(n, at_u, weights_u);
  if (m == 0) return AddPoints(points, components, weights_u, n, sum);
  WeightsAt(m, at_v, weights_v);
  for (std::size_t part = 0; part < kParts; ++part) sum[part] = hn::Zero(kFour);
  for (int i = 0; i <= n; ++i, points += (m + 1) * components) {
    FourVector row[kParts];
    AddPoints(points, components, weights_v, m, row);
    for (std::size_t part = 0; part < kParts; ++part)
      sum[part] = hn::MulAdd(hn::Set(kFour, weights_u[i]), row[part], sum[part]);
  }
}

HWY_INLINE void ValueAt(const PreparedMap& map, const Parameter& at_u, const Parameter& at_v,
                        FourVector (&sum)[kParts]) {
  const auto [n, m] = map.surface.degree;
  const int components = map.surface.components;
  const double* points = map.surface.scaled;
  if (HWY_LIKELY(n == 3 && (m == 0 || m == 3))) {
    const Cubic in_u(at_u);
    for (std::size_t part = 0; part < kParts; ++part) {
      const double* own = points + part * hn::MaxLanes(kFour);
      if (m == 0) {
        sum[part] = in_u.At(own, components);
        continue;
      }
      const Cubic in_v(at_v);
      sum[part] = hn::Mul(in_u.weight[0], in_v.At(own, components));
      for (int i = 1; i <= 3; ++i)
        sum[part] = hn::MulAdd(in_u.weight[i], in_v.At(own + 4 * i * components, components), sum[part]);
    }
    return;
  }
  ValueOfAnyDegree(map, at_u, at_v, sum);
}

constexpr hn::Rebind<float, Four> kFourFloats;
using FourFloats = hn::Vec<decltype(kFourFloats)>;

// What the ends of the interval of a test round to.
struct Sides {
  FourFloats low, high;
};
HWY_INLINE Sides SidesOf(const PreparedMap::Test& test, FourVector value, std::size_t part) {
  const FourVector error = hn::LoadU(kFour, &test.error[part * hn::MaxLanes(kFour)]);
  return {hn::DemoteTo(kFourFloats, hn::Sub(value, error)), hn::DemoteTo(kFourFloats, hn::Add(value, error))};
}

HWY_NOINLINE void ResolvePoint(const PreparedMap& map, const Parameter& at_u, const Parameter& at_v,
                               const GridArgument& u, const GridArgument& v, const double* values,
                               unsigned settled, float* result) {
  const auto [n, m] = map.surface.degree;
  const double growth = at_u.is_sure && at_v.is_sure ? Growth(at_u, n) * Growth(at_v, m) : HUGE_VAL;
  if (growth != 1) settled = 0;
  const double units = WeightUnits(n, m, kRoundings) * growth;
  for (int k = 0; k < map.surface.components; ++k) {
    if ((settled >> k & 1) == 0) result[k] = Resolve(map, k, u, v, values[k], map.component[k].unit * units);
  }
}

void Point(const PreparedMap& map, const GridArgument& u, const GridArgument& v, float* result) {
  const auto [n, m] = map.surface.degree;
  const Parameter at_u = n == 0 ? Parameter{1, 0, Parameter::End::kNeither} : PlaceOf(map, 0, u);
  const Parameter at_v = m == 0 ? Parameter{1, 0, Parameter::End::kNeither} : PlaceOf(map, 1, v);
  FourVector sum[kParts];
  ValueAt(map, at_u, at_v, sum);
  unsigned settled = 0;
  for (std::size_t part = 0; part < kParts; ++part) {
    constexpr std::size_t kCount = hn::MaxLanes(kFour);
    const auto [low, high] = SidesOf(map.test, sum[part], part);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(kFourFloats, hn::Eq(low, high), bits);
    settled |= static_cast<unsigned>(bits[0]) << (part * kCount);
    hn::StoreU(high, kFourFloats, result + part * kCount);
  }
  const bool inside =
      at_u.is_sure && at_v.is_sure && at_u.s >= 0 && at_u.t >= 0 && at_v.s >= 0 && at_v.t >= 0;
  const unsigned wanted = (1u << map.surface.components) - 1;
  if (HWY_LIKELY(inside && (settled & wanted) == wanted)) return;
  double values[4];
  for (std::size_t part = 0; part < kParts; ++part)
    hn::StoreU(sum[part], kFour, values + part * hn::MaxLanes(kFour));
  ResolvePoint(map, at_u, at_v, u, v, values, settled, result);
}

// ---- One call after another

bool IsNearest(const PreparedMap::Probe& probe) {
  using Two = hn::CappedTag<double, 2>;
  constexpr Two kTwo;
  bool is_nearest = true;
  for (std::size_t i = 0; i < 2; i += hn::MaxLanes(kTwo)) {
    const auto sum = hn::Add(hn::LoadU(kTwo, &probe.first[i]), hn::LoadU(kTwo, &probe.second[i]));
    is_nearest &= hn::AllTrue(kTwo, hn::Eq(sum, hn::LoadU(kTwo, &probe.sum[i])));
  }
  return is_nearest;
}

// Stores the floats; whether the wanted ones are right.
HWY_INLINE bool Settled(const PreparedMap::Test& test, const FourVector (&sum)[kParts], unsigned wanted,
                        float* result) {
  unsigned settled = 0;
  for (std::size_t part = 0; part < kParts; ++part) {
    const auto [low, high] = SidesOf(test, sum[part], part);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(kFourFloats, hn::Eq(low, high), bits);
    settled |= static_cast<unsigned>(bits[0]) << (part * hn::MaxLanes(kFour));
    hn::StoreU(high, kFourFloats, result + part * hn::MaxLanes(kFour));
  }
  return (settled & wanted) == wanted;
}

bool Direct(const glev_plan& plan, double u, double v, float* position) {
  const PreparedMap& map = plan.map(Attribute::kVertex);
  const auto [n, m] = map.surface.degree;
  const auto place = [&](int direction, double argument) -> Parameter {
    const Domain& domain = map.surface.domain[direction];
    const double width = domain.u2 - domain.u1;
    return {(domain.u2 - argument) / width, (argument - domain.u1) / width, Parameter::End::kNeither};
  };
  const Parameter at_u = n == 0 ? Parameter{1, 0, Parameter::End::kNeither} : place(0, u);
  const Parameter at_v = m == 0 ? Parameter{1, 0, Parameter::End::kNeither} : place(1, v);
  if (!(at_u.s >= 0 && at_u.t >= 0 && at_v.s >= 0 && at_v.t >= 0)) return false;
  FourVector sum[kParts];
  ValueAt(map, at_u, at_v, sum);
  const int components = map.surface.components;
  const bool settled = Settled(map.test, sum, (1U << components) - 1, position);
  if (components == 3) position[3] = 1;
  return settled && IsNearest(map.probe);
}

// Cubics in powers of x and y, in a domain that has an exact inverse of its width.
template <bool kSurface>
bool DirectCubic(const glev_plan& plan, double u, double v, float* position) {
  const DirectMap& map = plan.direct_map();
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
    const double* const centred = map.centred + part * hn::MaxLanes(kFour);
    const auto cubic = [&](const double* first, FourVector at) {
      FourVector value = hn::Load(kFour, first + 12);
      for (int i = 2; i >= 0; --i) value = hn::MulAdd(value, at, hn::Load(kFour, first + 4 * i));
      return value;
    };
    if constexpr (kSurface) {
      sum[part] = cubic(centred + 48, y);
      for (int i = 2; i >= 0; --i) sum[part] = hn::MulAdd(sum[part], x, cubic(centred + 16 * i, y));
    } else {
      sum[part] = cubic(centred, x);
    }
  }
  const bool inside = hn::AllTrue(kFour, hn::Le(farthest, hn::Set(kFour, 1)));
  return Settled(map.test, sum, 0xF, position) && inside && IsNearest(map.probe);
}

// ---- Meshes: the columns' weights are computed once, then each row is a curve

// The points of the grid are i / n of the domain, then, with one rounding each.
bool Spans(const Grid& grid, const Domain& domain) { return grid.u1 == domain.u1 && grid.u2 == domain.u2; }

// t and s of the columns, in place of the weights that are computed from them. Returns the largest growth.
double PlaceColumns(const Domain& domain, const MeshRange& range, int degree, std::size_t padded, double* t,
                    double* s) {
  const Grid& grid = range.u;
  const double n = grid.segments;
  double growth = 1;
  if (Spans(grid, domain) && range.i1 >= 0 &&
      range.i1 + static_cast<std::int64_t>(range.columns) - 1 <= grid.segments) {
    const Vector segments = hn::Set(kDoubles, n);
    for (std::size_t c = 0; c < padded; c += kLanes) {
      const Vector index = hn::Iota(kDoubles, static_cast<double>(range.i1) + static_cast<double>(c));
      hn::Store(hn::Div(index, segments), kDoubles, t + c);
      hn::Store(hn::Div(hn::Sub(segments, index), segments), kDoubles, s + c);
    }
    return growth;
  }
  for (std::size_t c = 0; c < padded; ++c) {
    const std::size_t column = std::min(c, range.columns - 1);
    const Parameter at = Locate(domain, GridArgument{grid, range.i1 + static_cast<std::int64_t>(column)});
    const double own = at.is_sure ? Growth(at, degree) : HUGE_VAL;
    // A lane that is NaN is never settled.
    t[c] = own < 0x1p40 ? at.t : std::numeric_limits<double>::quiet_NaN();
    s[c] = at.s;
    if (own < 0x1p40) growth = std::max(growth, own);
  }
  return growth;
}

template <int kComponents>
HWY_INLINE void RowOf(const Surface& surface, const double* weights_v, double* row) {
  const auto [n, m] = surface.degree;
  const double* points = surface.scaled;
  for (int i = 0; i <= n; ++i, points += (m + 1) * kComponents, row += 4) {
    FourVector sum[kParts];
    AddPoints(points, kComponents, weights_v, m, sum);
    for (std::size_t part = 0; part < kParts; ++part)
      hn::StoreU(sum[part], kFour, row + part * hn::MaxLanes(kFour));
  }
}

// Sums of products of so many weights, one row of them after another, and control points of four values each.
template <int kComponents>
HWY_INLINE void SumOf(int degree, const double* weights, std::size_t padded, const double* points,
                      Vector (&value)[kUnroll][kComponents]) {
  for (int k = 0; k < kComponents; ++k) {
    for (std::size_t part = 0; part < kUnroll; ++part)
      value[part][k] = hn::Mul(hn::Load(kDoubles, weights + part * kLanes), hn::Set(kDoubles, points[k]));
  }
  for (int i = 1; i <= degree; ++i) {
    weights += padded;
    points += 4;
    Vector weight[kUnroll];
    for (std::size_t part = 0; part < kUnroll; ++part)
      weight[part] = hn::Load(kDoubles, weights + part * kLanes);
    for (int k = 0; k < kComponents; ++k) {
      const Vector next = hn::Set(kDoubles, points[k]);
      for (std::size_t part = 0; part < kUnroll; ++part)
        value[part][k] = hn::MulAdd(weight[part], next, value[part][k]);
    }
  }
}

template <int kComponents>
void RoundedMesh(const PreparedMap& map, const MeshRange& range, const Destination& to, double* weights) {
  const auto [n, m] = map.surface.degree;
  const std::size_t padded = (range.columns + kStep - 1) / kStep * kStep;
  double* const t = weights + (n + 1) * padded;
  double* const s = t + padded;
  const double growth_u = PlaceColumns(map.surface.domain[0], range, n, padded, t, s);
  for (std::size_t c = 0; c < padded; c += kLanes) {
    Vector column[kMaxOrder];
    WeightsOf(n, hn::Load(kDoubles, s + c), hn::Load(kDoubles, t + c), column);
    for (int i = 0; i <= n; ++i) hn::Store(column[i], kDoubles, weights + i * padded + c);
  }
  const auto [domain_u, domain_v] = map.surface.domain;
  const int roundings = Spans(range.u, domain_u) && (m == 0 || Spans(range.v, domain_v)) ? 1 : kRoundings;
  const double units = WeightUnits(n, m, roundings);
  const PreparedMap::Test test = TestOf(map, units, 1);
  // The weights of a block of columns stay in the nearest cache for a group of rows.
  constexpr std::size_t kRows = 8, kBlock = 2048;
  const std::size_t block = std::max(kBlock / (n + 1) / kStep, std::size_t{1}) * kStep;
  for (std::size_t first = 0; first < range.rows; first += kRows) {
    const std::size_t rows = std::min(kRows, range.rows - first);
    PreparedMap::Test tests[kRows];
    double row[kRows][4 * kMaxOrder];
    for (std::size_t r = 0; r < rows; ++r) {
      const Parameter at_v = Locate(map.surface.domain[1], range.v_of(first + r));
      double weights_v[kMaxOrder];
      WeightsAt(m, at_v, weights_v);
      RowOf<kComponents>(map.surface, weights_v, row[r]);
      const double growth = at_v.is_sure ? growth_u * Growth(at_v, m) : HUGE_VAL;
      tests[r] = growth == 1 ? test : TestOf(map, units, growth);
    }
    for (std::size_t begin = 0; begin < range.columns; begin += block) {
      const std::size_t end = std::min(begin + block, range.columns);
      for (std::size_t r = 0; r < rows; ++r) {
        const Writer<kComponents> writer(tests[r], to, to.data + (first + r) * to.row_stride);
        for (std::size_t c = begin; c < end; c += kStep) {
          Vector value[kUnroll][kComponents];
          SumOf<kComponents>(n, weights + c, padded, row[r], value);
          writer.Write(writer.Round(value), c, std::min(kStep, end - c), [&](std::size_t i, int k) {
            return Resolve(map, k, range.u_of(i), range.v_of(first + r));
          });
        }
      }
    }
  }
}

// ---- Meshes of low degree inside their domain, in powers of x and y

// Points one behind the other are a sequence of values. Each column stands there as often as a point has
// components, so that the values come out in their order and nothing has to be interleaved.
template <class Tag, int kComponents>
class Sequence {
  using Value = hn::TFromD<Tag>;
  using Values = hn::Vec<Tag>;
  static constexpr Tag kTag{};
  static constexpr std::size_t kWidth = hn::MaxLanes(Tag());

 public:
  // Vectors after which the components come in the same order again, and values of those.
  static constexpr std::size_t kPeriod = kComponents / std::gcd(std::size_t{kComponents}, kWidth);
  static constexpr std::size_t kGroup = kPeriod * kWidth;

  Sequence() {
    for (std::size_t i = 0; i < kComponents * kWidth; ++i) {
      column_[i] = static_cast<Index>(i / kComponents);
      component_[i] = static_cast<Index>(i % kComponents);
    }
  }

  // Each of so many values, and of those that fill the last vector, as often.
  HWY_INLINE void Repeat(const Value* values, std::size_t count, Value* to) const {
    for (std::size_t c = 0; c < count; c += kWidth) {
      const Values value = hn::Load(kTag, values + c);
      for (std::size_t i = 0; i < kComponents * kWidth; i += kWidth) {
        hn::Store(hn::TableLookupLanes(value, hn::SetTableIndices(kTag, column_ + i)), kTag,
                  to + c * kComponents + i);
      }
    }
  }

  // The components of a point, where vectors may read on, as vector number `part` of a period.
  HWY_INLINE Values Of(const Value* point, std::size_t part) const {
    if constexpr (kWidth >= 4) {
      return hn::TableLookupLanes(hn::LoadU(kTag, point),
                                  hn::SetTableIndices(kTag, component_ + part * kWidth));
    } else {
      HWY_ALIGN Value lanes[kWidth];
      for (std::size_t i = 0; i < kWidth; ++i) lanes[i] = point[component_[part * kWidth + i]];
      return hn::Load(kTag, lanes);
    }
  }

 private:
  using Index = hwy::MakeSigned<Value>;
  HWY_ALIGN Index column_[kComponents * kWidth], component_[kComponents * kWidth];
};

// evaluate(begin, group) gives so many floats of `count`, those from `begin` on.
template <std::size_t kGroup, class Evaluate>
HWY_INLINE void InGroups(std::size_t count, float* out, const Evaluate& evaluate) {
  std::size_t begin = 0;
  for (; begin + kGroup <= count; begin += kGroup) evaluate(begin, out + begin);
  if (begin < count) {
    float group[kGroup];
    evaluate(begin, group);
    std::memcpy(out + begin, group, (count - begin) * sizeof(float));
  }
}

bool IsInside(const Domain& domain, const Grid& grid, std::int64_t index) {
  const Parameter at = Locate(domain, GridArgument{grid, index});
  return at.is_sure && at.t >= 0 && at.s >= 0;
}

// t - s
double CentredAt(const Domain& domain, const GridArgument& argument) {
  const Parameter at = Locate(domain, argument);
  return at.t - at.s;
}

// A row: its coefficients, four values for each power of x, after which vectors may read on; for x^0 both
// ends of the interval. The error of the test contains the roundings of these and one more, as it contains
// those of its own sums elsewhere.
template <int kComponents, int kDegree>
struct CentredRow {
  double power[4 * (kDegree + 1) + kLanes], high[4 + kLanes];

  void Set(const PreparedMap& map, const GridArgument& v) {
    const int m = map.surface.degree[1];
    const double y = m == 0 ? 0 : CentredAt(map.surface.domain[1], v);
    const double* row = map.centred;
    for (int i = 0; i <= kDegree; ++i, row += (m + 1) * kComponents) {
      for (int k = 0; k < kComponents; ++k) {
        double sum = row[m * kComponents + k];
        for (int j = m - 1; j >= 0; --j) sum = sum * y + row[j * kComponents + k];
        power[4 * i + k] = sum;
      }
    }
    for (int k = 0; k < kComponents; ++k) {
      high[k] = power[k] + map.centred_test.error[k];
      power[k] -= map.centred_test.error[k];
    }
  }
};

// The same in vectors, and what they give: both ends of the intervals, as floats.
template <int kComponents, int kDegree>
class CentredCurve {
 public:
  using Values = Sequence<Doubles, kComponents>;

  HWY_INLINE CentredCurve(const CentredRow<kComponents, kDegree>& row, const Values& sequence) {
    for (std::size_t part = 0; part < Values::kPeriod; ++part) {
      for (int i = 0; i <= kDegree; ++i) power_[i][part] = sequence.Of(row.power + 4 * i, part);
      high_[part] = sequence.Of(row.high, part);
    }
  }

  HWY_INLINE void Evaluate(Vector x, std::size_t part, Half* low, Half* high) const {
    Vector sum = power_[kDegree][part];
    for (int i = kDegree - 1; i > 0; --i) sum = hn::MulAdd(sum, x, power_[i][part]);
    *low = hn::DemoteTo(kHalves, hn::MulAdd(sum, x, power_[0][part]));
    *high = hn::DemoteTo(kHalves, hn::MulAdd(sum, x, high_[part]));
  }

 private:
  Vector power_[kDegree + 1][Values::kPeriod], high_[Values::kPeriod];
};

constexpr hn::RebindToUnsigned<decltype(kHalves)> kBits;
HWY_INLINE bool IsZero(Half value) {
  return hn::AllTrue(kBits, hn::Eq(hn::BitCast(kBits, value), hn::Zero(kBits)));
}

template <int kComponents, int kDegree>
void CentredRows(const PreparedMap& map, const MeshRange& range, const Destination& to, const double* x) {
  constexpr std::size_t kColumns = 512, kRows = 16;  // what stays in the first cache
  static_assert(kColumns % kLanes == 0);
  using Values = Sequence<Doubles, kComponents>;
  constexpr std::size_t kPeriod = Values::kPeriod, kGroup = Values::kGroup;
  const Values sequence;
  HWY_ALIGN double places[kComponents * kColumns];
  HWY_ALIGN float values[kComponents * kColumns];
  CentredRow<kComponents, kDegree> row[kRows];
  for (std::size_t r0 = 0; r0 < range.rows; r0 += kRows) {
    const std::size_t rows = std::min(kRows, range.rows - r0);
    for (std::size_t r = 0; r < rows; ++r) row[r].Set(map, range.v_of(r0 + r));
    for (std::size_t c0 = 0; c0 < range.columns; c0 += kColumns) {
      const std::size_t columns = std::min(kColumns, range.columns - c0), count = columns * kComponents;
      sequence.Repeat(x + c0, columns, places);
      for (std::size_t r = 0; r < rows; ++r) {
        const CentredCurve<kComponents, kDegree> curve(row[r], sequence);
        std::byte* const data = to.data + (r0 + r) * to.row_stride + c0 * to.stride;
        float* const out = IsPacked<kComponents>(to) ? reinterpret_cast<float*>(data) : values;
        Half open = hn::Zero(kHalves);  // bits in which the ends differ
        const auto evaluate = [&](std::size_t begin, float* group) HWY_ATTR {
          for (std::size_t part = 0; part < kPeriod; ++part) {
            Half low, high;
            curve.Evaluate(hn::Load(kDoubles, places + begin + part * kLanes), part, &low, &high);
            open = hn::Or(open, hn::Xor(low, high));
            hn::StoreU(high, kHalves, group + part * kLanes);
          }
        };
        InGroups<kGroup>(count, out, evaluate);
        // Where rounding is not sure comes up once in some strips, so it is not looked for before.
        for (std::size_t begin = IsZero(open) ? count : 0; begin < count; begin += kLanes) {
          Half low, high;
          curve.Evaluate(hn::Load(kDoubles, places + begin), begin / kLanes % kPeriod, &low, &high);
          const Half bits = hn::Xor(low, high);
          if (HWY_LIKELY(IsZero(bits))) continue;
          std::uint32_t is_open[kLanes];
          hn::StoreU(hn::BitCast(kBits, bits), kBits, is_open);
          for (std::size_t i = begin; i < std::min(begin + kLanes, count); ++i) {
            if (is_open[i - begin] == 0) continue;
            const float result = Resolve(map, static_cast<int>(i % kComponents),
                                         range.u_of(c0 + i / kComponents), range.v_of(r0 + r));
            std::memcpy(out + i, &result, sizeof result);  // the caller's memory need not be aligned
          }
        }
        if (out == values) Scatter<kComponents>(values, columns, to, data);
      }
    }
  }
}

// False, and nothing done, for other maps and outside the domain.
template <int kComponents>
bool CentredMesh(const PreparedMap& map, const MeshRange& range, const Destination& to, double* x) {
  const auto [n, m] = map.surface.degree;
  if (n == 0 || map.centred == nullptr) return false;
  // The ends of intervals are compared as bits; those of NaN could agree. (Between columns that are sure all
  // are.)
  for (const double error : map.centred_test.error) {
    if (!std::isfinite(error)) return false;
  }
  const auto [domain_u, domain_v] = map.surface.domain;
  const std::int64_t i2 = range.i1 + static_cast<std::int64_t>(range.columns) - 1,
                     j2 = range.j1 + static_cast<std::int64_t>(range.rows) - 1;
  if (!IsInside(domain_u, range.u, range.i1) || !IsInside(domain_u, range.u, i2)) return false;
  if (m > 0 && !(IsInside(domain_v, range.v, range.j1) && IsInside(domain_v, range.v, j2))) return false;

  const std::size_t padded = (range.columns + kStep - 1) / kStep * kStep;
  double* const s = x + padded;
  PlaceColumns(domain_u, range, n, padded, x, s);
  for (std::size_t c = 0; c < padded; c += kLanes)
    hn::Store(hn::Sub(hn::Load(kDoubles, x + c), hn::Load(kDoubles, s + c)), kDoubles, x + c);
  constexpr decltype(&CentredRows<kComponents, 1>) kOf[kMaxCentredDegree] = {
      CentredRows<kComponents, 1>, CentredRows<kComponents, 2>, CentredRows<kComponents, 3>};
  kOf[n - 1](map, range, to, x);
  return true;
}

// ---- Fast meshes, in float

using Floats = hn::CappedTag<float, 16>;
constexpr Floats kFloats;
constexpr std::size_t kFloatLanes = hn::MaxLanes(kFloats);
constexpr std::size_t kFloatStep = kUnroll * kFloatLanes;

template <int kComponents>
HWY_INLINE void StoreFloats(const hn::Vec<Floats> (&values)[kComponents], float* to) {
  if constexpr (kComponents == 1) hn::StoreU(values[0], kFloats, to);
  if constexpr (kComponents == 2) hn::StoreInterleaved2(values[0], values[1], kFloats, to);
  if constexpr (kComponents == 3) hn::StoreInterleaved3(values[0], values[1], values[2], kFloats, to);
  if constexpr (kComponents == 4)
    hn::StoreInterleaved4(values[0], values[1], values[2], values[3], kFloats, to);
}

// The weights of a fast mesh along u, of each degree `padded` apart.
void FastWeights(const Domain& domain, const MeshRange& range, int degree, std::size_t padded, double* t,
                 double* s, float* weights) {
  PlaceColumns(domain, range, degree, padded, t, s);
  for (std::size_t c = 0; c < padded; c += kLanes) {
    Vector column[kMaxOrder];
    WeightsOf(degree, hn::Load(kDoubles, s + c), hn::Load(kDoubles, t + c), column);
    for (int i = 0; i <= degree; ++i) {
      const Vector binomial = hn::Set(kDoubles, static_cast<double>(Binomials(degree)[i]));
      const Vector weight = hn::Mul(column[i], binomial);
      // Subnormal floats would cost a hundred times as much, and this changes nothing that can be seen.
      const Vector seen = hn::IfThenElseZero(hn::Ge(weight, hn::Set(kDoubles, 0x1p-60)), weight);
      hn::StoreU(hn::DemoteTo(kHalves, seen), kHalves, weights + static_cast<std::size_t>(i) * padded + c);
    }
  }
}

// The points of a row of a fast mesh, four values each, times the binomials.
template <int kComponents>
HWY_INLINE void FastRow(const PreparedMap& map, const MeshRange& range, std::size_t r, double* row) {
  double weights[kMaxOrder];
  WeightsAt(map.surface.degree[1],
            Locate(map.surface.domain[1], GridArgument{range.v, range.j1 + static_cast<std::int64_t>(r)}),
            weights);
  RowOf<kComponents>(map.surface, weights, row);
}

// Fast meshes of low degree in u, by Horner's rule in x = t - s. The coefficients are at most 5 max|R|
// together, those of degree 3, and cost 5 units of 2^-24 max|R|, x 3, and the sums 7.5, twice that without
// fused operations; so the bound of GLEV_FAST, 6 n + 12, is kept. Ends of the domain, where neighbours meet,
// are taken from the control points.
constexpr int kMaxFastDegree = 3;

// x of the columns. `t` and `s` are room for them.
void FastPlaces(const Domain& domain, const MeshRange& range, std::size_t padded, double* t, double* s,
                float* x) {
  // Beyond that float has no room for each index.
  constexpr std::int64_t kMostSegments = 1 << 20;
  if (!Spans(range.u, domain) || range.u.segments > kMostSegments) {
    PlaceColumns(domain, range, 1, padded, t, s);
    for (std::size_t c = 0; c < padded; c += kLanes) {
      const Vector at = hn::Sub(hn::Load(kDoubles, t + c), hn::Load(kDoubles, s + c));
      hn::StoreU(hn::DemoteTo(kHalves, at), kHalves, x + c);
    }
    return;
  }
  const double step = 1 / static_cast<double>(range.u.segments);
  const auto high = static_cast<float>(step), low = static_cast<float>(step - static_cast<double>(high));
  const auto segments = hn::Set(kFloats, static_cast<float>(range.u.segments)),
             high_step = hn::Set(kFloats, high), low_step = hn::Set(kFloats, low);
  for (std::size_t c = 0; c < padded; c += kFloatLanes) {
    const auto index = hn::Iota(kFloats, static_cast<float>(range.i1 + static_cast<std::int64_t>(c))),
               place = hn::Sub(hn::Add(index, index), segments);
    hn::Store(
        HWY_NATIVE_FMA ? hn::MulAdd(place, high_step, hn::Mul(place, low_step)) : hn::Div(place, segments),
        kFloats, x + c);
  }
}

// A row: its coefficients, four floats for each power of x, after which vectors may read on, and its ends.
// The same, but for signs, from either side.
template <int kComponents, int kDegree>
struct FastRowOfPowers {
  float power[4 * (kDegree + 1) + kFloatLanes];
  float first[kComponents], last[kComponents];

  // The points are four values each, times the binomials.
  HWY_INLINE void Set(const double* points) {
    for (int k = 0; k < kComponents; ++k, ++points) {
      const double a = points[0], z = points[4 * kDegree], ends = a + z, slope = z - a;
      first[k] = static_cast<float>(a), last[k] = static_cast<float>(z);
      double of[kDegree + 1];
      if constexpr (kDegree == 1) {
        of[0] = ends / 2, of[1] = slope / 2;
      } else if constexpr (kDegree == 2) {
        of[0] = (ends + points[4]) / 4, of[1] = slope / 2, of[2] = (ends - points[4]) / 4;
      } else {
        const double middle = points[8] + points[4], tilt = points[8] - points[4];
        of[0] = (ends + middle) / 8, of[1] = (3 * slope + tilt) / 8;
        of[2] = (3 * ends - middle) / 8, of[3] = (slope - tilt) / 8;
      }
      for (int i = 0; i <= kDegree; ++i) power[4 * i + k] = static_cast<float>(of[i]);
    }
  }
};

template <int kComponents, int kDegree>
void FastPowers(const PreparedMap& map, const MeshRange& range, const Destination& to, const float* x) {
  constexpr std::size_t kColumns = 512, kRows = 64;  // what stays in the first cache
  static_assert(kColumns % kFloatLanes == 0);
  using Values = Sequence<Floats, kComponents>;
  constexpr std::size_t kPeriod = Values::kPeriod, kGroup = Values::kGroup;
  const Values sequence;
  HWY_ALIGN float places[kComponents * kColumns], values[kComponents * kColumns];
  FastRowOfPowers<kComponents, kDegree> row[kRows];
  for (std::size_t r0 = 0; r0 < range.rows; r0 += kRows) {
    const std::size_t rows = std::min(kRows, range.rows - r0);
    for (std::size_t r = 0; r < rows; ++r) {
      double points[4 * (kDegree + 1)];
      FastRow<kComponents>(map, range, r0 + r, points);
      row[r].Set(points);
    }
    for (std::size_t c0 = 0; c0 < range.columns; c0 += kColumns) {
      const float* const column = x + c0;
      const std::size_t columns = std::min(kColumns, range.columns - c0), count = columns * kComponents;
      sequence.Repeat(column, columns, places);
      const auto is_end = [&](std::size_t c) { return std::fabs(column[c]) == 1; };
      std::size_t head = 0, tail = columns;
      while (head < columns && is_end(head)) ++head;
      while (tail > head && is_end(tail - 1)) --tail;
      for (std::size_t r = 0; r < rows; ++r) {
        hn::Vec<Floats> power[kDegree + 1][kPeriod];
        for (int i = 0; i <= kDegree; ++i) {
          for (std::size_t part = 0; part < kPeriod; ++part)
            power[i][part] = sequence.Of(row[r].power + 4 * i, part);
        }
        const auto evaluate = [&](std::size_t begin, float* group) HWY_ATTR {
          for (std::size_t part = 0; part < kPeriod; ++part) {
            const auto at = hn::Load(kFloats, places + begin + part * kFloatLanes);
            auto value = power[kDegree][part];
            for (int i = kDegree - 1; i >= 0; --i) value = hn::MulAdd(value, at, power[i][part]);
            hn::StoreU(value, kFloats, group + part * kFloatLanes);
          }
        };
        std::byte* const data = to.data + (r0 + r) * to.row_stride + c0 * to.stride;
        float* const out = IsPacked<kComponents>(to) ? reinterpret_cast<float*>(data) : values;
        InGroups<kGroup>(count, out, evaluate);
        const auto take_end = [&](std::size_t end) {
          std::memcpy(out + end * kComponents, column[end] < 0 ? row[r].first : row[r].last,
                      kComponents * sizeof(float));
        };
        for (std::size_t end = 0; end < head; ++end) take_end(end);
        for (std::size_t end = tail; end < columns; ++end) take_end(end);
        if (out == values) Scatter<kComponents>(values, columns, to, data);
      }
    }
  }
}

// False, and nothing done, where the bound of GLEV_FAST is not kept: outside the domain and for extreme maps.
template <int kComponents>
bool FastMesh(const PreparedMap& map, const MeshRange& range, const Destination& to, double* scratch) {
  const auto [n, m] = map.surface.degree;
  for (int k = 0; k < kComponents; ++k) {
    const double largest = map.component[k].largest;
    if (largest != 0 && !(largest >= 0x1p-80 && largest <= 0x1p80)) return false;
    if (map.component[k].kind == PreparedComponent::Kind::kUnclaimed) return false;
  }
  const Domain &domain_u = map.surface.domain[0], &domain_v = map.surface.domain[1];
  const std::int64_t i2 = range.i1 + static_cast<std::int64_t>(range.columns) - 1,
                     j2 = range.j1 + static_cast<std::int64_t>(range.rows) - 1;
  if (n > 0 && !(IsInside(domain_u, range.u, range.i1) && IsInside(domain_u, range.u, i2))) return false;
  if (m > 0 && !(IsInside(domain_v, range.v, range.j1) && IsInside(domain_v, range.v, j2))) return false;

  const std::size_t padded = (range.columns + kFloatStep - 1) / kFloatStep * kFloatStep;
  double* const t = scratch;
  double* const s = t + padded;
  auto* const weights = reinterpret_cast<float*>(s + padded);
  if (n >= 1 && n <= kMaxFastDegree) {
    constexpr decltype(&FastPowers<kComponents, 1>) kOf[kMaxFastDegree] = {
        FastPowers<kComponents, 1>, FastPowers<kComponents, 2>, FastPowers<kComponents, 3>};
    FastPlaces(domain_u, range, padded, t, s, weights);
    kOf[n - 1](map, range, to, weights);
    return true;
  }
  FastWeights(domain_u, range, n, padded, t, s, weights);
  const bool is_packed = IsPacked<kComponents>(to);
  for (std::size_t r = 0; r < range.rows; ++r) {
    double row[4 * kMaxOrder];
    FastRow<kComponents>(map, range, r, row);
    float points[4 * kMaxOrder];
    for (int i = 0; i <= n; ++i) {
      const double inverse = 1 / static_cast<double>(Binomials(n)[i]);
      for (int k = 0; k < kComponents; ++k) points[4 * i + k] = static_cast<float>(row[4 * i + k] * inverse);
    }
    std::byte* const data = to.data + r * to.row_stride;
    for (std::size_t c = 0; c < range.columns; c += kFloatStep) {
      hn::Vec<Floats> value[kUnroll][kComponents];
      for (std::size_t part = 0; part < kUnroll; ++part) {
        for (int k = 0; k < kComponents; ++k)
          value[part][k] =
              hn::Mul(hn::Load(kFloats, weights + c + part * kFloatLanes), hn::Set(kFloats, points[k]));
      }
      const float* column = weights + c + padded;
      const float* point = points + 4;
      for (int i = 1; i <= n; ++i, column += padded, point += 4) {
        for (std::size_t part = 0; part < kUnroll; ++part) {
          const auto weight = hn::Load(kFloats, column + part * kFloatLanes);
          for (int k = 0; k < kComponents; ++k)
            value[part][k] = hn::MulAdd(weight, hn::Set(kFloats, point[k]), value[part][k]);
        }
      }
      if (HWY_LIKELY(is_packed && c + kFloatStep <= range.columns)) {
        for (std::size_t part = 0; part < kUnroll; ++part) {
          StoreFloats<kComponents>(
              value[part], reinterpret_cast<float*>(data + c * to.stride) + part * kFloatLanes * kComponents);
        }
        continue;
      }
      alignas(64) float values[kFloatStep * kComponents];
      for (std::size_t part = 0; part < kUnroll; ++part)
        StoreFloats<kComponents>(value[part], values + part * kFloatLanes * kComponents);
      Scatter<kComponents>(values, std::min(kFloatStep, range.columns - c), to, data + c * to.stride);
    }
  }
  return true;
}

template <int kComponents>
void MeshOf(const PreparedMap& map, const MeshRange& range, bool fast, const Destination& to,
            std::byte* scratch) {
  auto* const doubles = reinterpret_cast<double*>(scratch);
  if (fast && FastMesh<kComponents>(map, range, to, doubles)) return;
  if (CentredMesh<kComponents>(map, range, to, doubles)) return;
  RoundedMesh<kComponents>(map, range, to, doubles);
}

// ---- By number of components

void Curve(const PreparedMap& map, const Input& u, std::size_t count, const Destination& to) {
  constexpr decltype(&CurvesOf<1>) kOf[] = {CurvesOf<1>, CurvesOf<2>, CurvesOf<3>, CurvesOf<4>};
  kOf[map.surface.components - 1](map, u, count, to);
}

void SurfaceAt(const PreparedMap& map, const Input& u, const Input& v, std::size_t count,
               const Destination& to) {
  constexpr decltype(&Surfaces<1>) kOf[] = {Surfaces<1>, Surfaces<2>, Surfaces<3>, Surfaces<4>};
  kOf[map.surface.components - 1](map, u, v, count, to);
}

void Mesh(const PreparedMap& map, const MeshRange& range, bool fast, const Destination& to,
          std::byte* scratch) {
  constexpr decltype(&MeshOf<1>) kOf[] = {MeshOf<1>, MeshOf<2>, MeshOf<3>, MeshOf<4>};
  kOf[map.surface.components - 1](map, range, fast, to, scratch);
}

constexpr Kernels MakeKernels(const char* name) {
  return {name, Point, Direct, DirectCubic<false>, DirectCubic<true>, Curve, SurfaceAt, Mesh};
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glev {

double Input::operator[](std::size_t i) const {
  if (is_double) {
    double argument;
    std::memcpy(&argument, data + i * stride, sizeof argument);
    return argument;
  }
  float argument;
  std::memcpy(&argument, data + i * stride, sizeof argument);
  return argument;
}

std::size_t MeshScratch(int degree, std::size_t columns) {
  constexpr std::size_t kWidest = 64;  // the step of any instruction set divides it
  const std::size_t padded = (columns + kWidest - 1) / kWidest * kWidest;
  return padded * sizeof(double) * (static_cast<std::size_t>(degree) + 3);
}

namespace {

// Highway's own detection is in a library that needs the C++ run time.
#if HWY_ARCH_X86
// Not every compiler knows its name.
bool HasF16c() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_F16C) != 0;
}
bool HasSse4() {
  return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("pclmul") &&
         __builtin_cpu_supports("aes");
}
bool HasAvx2() {
  return HasSse4() && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") && HasF16c();
}
bool HasAvx3() {
  return HasAvx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
}
#endif
bool HasBaseline() { return true; }

struct Target {
  bool (*is_supported)();
  Kernels kernels;
};

constexpr Target kTargets[] = {
#if (HWY_TARGETS & HWY_AVX3) && HWY_STATIC_TARGET != HWY_AVX3
    {HasAvx3, N_AVX3::MakeKernels("AVX3")},
#endif
#if (HWY_TARGETS & HWY_AVX2) && HWY_STATIC_TARGET != HWY_AVX2
    {HasAvx2, N_AVX2::MakeKernels("AVX2")},
#endif
#if (HWY_TARGETS & HWY_SSE4) && HWY_STATIC_TARGET != HWY_SSE4
    {HasSse4, N_SSE4::MakeKernels("SSE4")},
#endif
    {HasBaseline, HWY_STATIC_DISPATCH(MakeKernels)("baseline")},
};

}  // namespace

const Kernels* KernelsOf(std::size_t index) {
  for (const auto& [is_supported, kernels] : kTargets) {
    if (is_supported() && index-- == 0) return &kernels;
  }
  return nullptr;
}

}  // namespace glev
#endif  // HWY_ONCE
