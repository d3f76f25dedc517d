// Evaluates meshes with GLEV_FAST, in float.
#if defined(GLEVALUATOR_FAST_MESH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_FAST_MESH_INL_H_
#undef GLEVALUATOR_FAST_MESH_INL_H_
#else
#define GLEVALUATOR_FAST_MESH_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "binomials.h"
#include "centred_mesh-inl.h"
#include "mesh-inl.h"
#include "sequence-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

using Floats = hn::CappedTag<float, 16>;
constexpr Floats kFloats;
constexpr std::size_t kFloatLanes = hn::MaxLanes(kFloats);
static_assert(kFloatLanes == kStep);
constexpr std::size_t kFloatStep = kUnroll * kFloatLanes;

// Computes the weights of a fast mesh along u. Those of each i are `padded` floats apart.
HWY_NOINLINE inline void compute_fast_weights(const Domain& domain, const MeshRange& range, int degree,
                                              std::size_t padded, double* t, double* s, float* weights) {
  place_columns(domain, range, degree, kLargestGrowth, padded, t, s);
  for (std::size_t c = 0; c < padded; c += kLanes) {
    Vector column[kMaxOrder];
    weights_of(degree, hn::Load(kDoubles, s + c), hn::Load(kDoubles, t + c), column);
    for (int i = 0; i <= degree; ++i) {
      const Vector binomial = hn::Set(kDoubles, static_cast<double>(binomial_row(degree)[i]));
      const Vector weight = hn::Mul(column[i], binomial);
      // Tiny weights become zero, because subnormal floats are a hundred times slower; results do not change.
      const Vector seen = hn::IfThenElseZero(hn::Ge(weight, hn::Set(kDoubles, 0x1p-60)), weight);
      hn::StoreU(hn::DemoteTo(kHalves, seen), kHalves, weights + static_cast<std::size_t>(i) * padded + c);
    }
  }
}

// Computes the control points of a row of a fast mesh, four values each, times the binomial coefficients.
template <int kComponents>
HWY_INLINE void compute_fast_row(const PreparedMap& map, const MeshRange& range, std::size_t r, double* row) {
  double weights[kMaxOrder];
  weights_at(map.surface.degree[1],
             locate(map.surface.domain[1], GridArgument{range.v, range.j1 + static_cast<std::int64_t>(r)}),
             weights);
  row_of<kComponents>(map.surface, weights, row);
}

// Fast meshes up to this degree in u use Horner's rule in x = t - s. The coefficients have a sum of
// magnitudes of at most 5 max|R| (degree 3). In units of 2^-24 max|R|, their errors are 5, that of x is 3,
// and those of the sums are 7.5, or twice that without fused operations. So the bound of GLEV_FAST, 6 n + 12,
// holds.
constexpr int kMaxFastDegree = 3;

// Computes x of the columns. `t` and `s` are scratch memory.
HWY_NOINLINE inline void compute_fast_places(const Domain& domain, const MeshRange& range, std::size_t padded,
                                             double* t, double* s, float* x) {
  // Beyond this number, a float cannot represent every index.
  constexpr std::int64_t kMostSegments = 1 << 20;
  if (!spans(range.u, domain) || range.u.segments > kMostSegments) {
    place_columns(domain, range, 1, kLargestGrowth, padded, t, s);
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

// The coefficients of a row: four floats for each power of x, with padding that vectors may read.
template <int kComponents, int kDegree>
struct FastRowOfPowers {
  float power[4 * (kDegree + 1) + kFloatLanes];

  // `points`: the control points, four values each, times the binomial coefficients.
  HWY_INLINE void set(const double* points) {
    for (int k = 0; k < kComponents; ++k, ++points) {
      const double a = points[0], z = points[4 * kDegree], ends = a + z, slope = z - a;
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
void evaluate_fast_powers(const PreparedMap& map, const MeshRange& range, const Destination& to,
                          const float* x) {
  constexpr std::size_t kColumns = 512, kRows = 64;  // fits into the L1 cache
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
      compute_fast_row<kComponents>(map, range, r0 + r, points);
      row[r].set(points);
    }
    for (std::size_t c0 = 0; c0 < range.columns; c0 += kColumns) {
      const std::size_t columns = std::min(kColumns, range.columns - c0), count = columns * kComponents;
      sequence.repeat(x + c0, columns, places);
      for (std::size_t r = 0; r < rows; ++r) {
        hn::Vec<Floats> power[kDegree + 1][kPeriod];
        for (int i = 0; i <= kDegree; ++i) {
          for (std::size_t part = 0; part < kPeriod; ++part)
            power[i][part] = sequence.values_of(row[r].power + 4 * i, part);
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
        float* const out = is_packed<kComponents>(to) ? reinterpret_cast<float*>(data) : values;
        in_groups<kGroup>(count, out, evaluate);
        if (out == values) scatter<kComponents>(values, columns, to, data);
      }
    }
  }
}

// Evaluates a fast mesh, except for its boundary. Returns false, and does nothing, if the bound of GLEV_FAST
// would not hold (outside the domain, extreme maps) or the exact method is faster.
template <int kComponents>
bool evaluate_fast_inside(const PreparedMap& map, const MeshRange& range, const Destination& to,
                          double* scratch) {
  const auto [n, m] = map.surface.degree;
  if (!has_fast_bound(map)) return false;
  if (map.centred != nullptr && has_few_segments(range, m)) return false;
  const Domain &domain_u = map.surface.domain[0], &domain_v = map.surface.domain[1];
  const std::int64_t i2 = range.last_column(), j2 = range.last_row();
  // In such a grid all columns or rows have the same argument, which may be on the boundary.
  if (range.u.u1 == range.u.u2 || range.v.u1 == range.v.u2) return false;
  if (!is_inside(domain_u, range.u, range.i1) || !is_inside(domain_u, range.u, i2)) return false;
  if (!is_inside(domain_v, range.v, range.j1) || !is_inside(domain_v, range.v, j2)) return false;

  const std::size_t padded = (range.columns + kFloatStep - 1) / kFloatStep * kFloatStep;
  double* const t = scratch;
  double* const s = t + padded;
  auto* const weights = reinterpret_cast<float*>(s + padded);
  if (n >= 1 && n <= kMaxFastDegree) {
    constexpr decltype(&evaluate_fast_powers<kComponents, 1>) kOf[kMaxFastDegree] = {
        evaluate_fast_powers<kComponents, 1>, evaluate_fast_powers<kComponents, 2>,
        evaluate_fast_powers<kComponents, 3>};
    compute_fast_places(domain_u, range, padded, t, s, weights);
    kOf[n - 1](map, range, to, weights);
    return true;
  }
  compute_fast_weights(domain_u, range, n, padded, t, s, weights);
  const bool packed = is_packed<kComponents>(to);
  for (std::size_t r = 0; r < range.rows; ++r) {
    double row[4 * kMaxOrder];
    compute_fast_row<kComponents>(map, range, r, row);
    float points[4 * kMaxOrder];
    for (int i = 0; i <= n; ++i) {
      const double inverse = 1 / static_cast<double>(binomial_row(n)[i]);
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
      if (HWY_LIKELY(packed && c + kFloatStep <= range.columns)) {
        for (std::size_t part = 0; part < kUnroll; ++part) {
          interleave<kComponents>(
              value[part], reinterpret_cast<float*>(data + c * to.stride) + part * kFloatLanes * kComponents);
        }
        continue;
      }
      alignas(64) float values[kFloatStep * kComponents];
      for (std::size_t part = 0; part < kUnroll; ++part)
        interleave<kComponents>(value[part], values + part * kFloatLanes * kComponents);
      scatter<kComponents>(values, std::min(kFloatStep, range.columns - c), to, data + c * to.stride);
    }
  }
  return true;
}

// Returns the curve of a map at the first or last end of the domain of u, as a map in u.
inline PreparedMap edge_of(const PreparedMap& map, bool is_last, double* centred) {
  const auto [n, m] = map.surface.degree;
  const int values = (m + 1) * map.surface.components, row = 4 * (n + 1);
  PreparedMap edge = map;
  edge.surface.degree = {m, 0};
  edge.surface.domain = {map.surface.domain[1], Domain{}};
  edge.surface.scaled += is_last ? n * values : 0;
  for (int k = 0; k < map.surface.components; ++k) {
    PreparedComponent& component = edge.component[k];
    const auto [columns, rows] = component.lowest.order;
    component.lowest.points += is_last ? (columns - 1) * rows : 0;
    component.lowest.order = {rows, 1};
    component.lowest.domain = edge.surface.domain;
    if (component.kind == PreparedComponent::Kind::kLine) component.kind = PreparedComponent::Kind::kGeneral;
  }
  if (map.centred == nullptr) return edge;
  // Computes the row at x = -1 or 1. The error of the test, which is that of the whole map, covers these
  // roundings.
  for (int j = 0; j <= m; ++j) {
    for (int k = 0; k < 4; ++k) {
      double sum = map.centred[row * j + 4 * n + k];
      for (int i = n - 1; i >= 0; --i) sum = (is_last ? sum : 0.0 - sum) + map.centred[row * j + 4 * i + k];
      centred[4 * j + k] = sum;
    }
  }
  edge.centred = centred;
  return edge;
}

// Rounds the points on the boundary of the domain correctly. Adjacent patches then meet without a crack,
// because these points depend only on the exact value.
template <int kComponents>
HWY_NOINLINE void round_boundary(const PreparedMap& map, const MeshRange& range, const Destination& to,
                                 double* scratch) {
  const auto end_at = [&](int direction, const GridArgument& argument) {
    return locate(map.surface.domain[direction], argument).end;
  };
  const bool is_curve = to.row_stride == 0;  // the boundary of a curve consists of its ends
  for (const std::size_t row : {std::size_t{0}, range.rows - 1}) {
    if (is_curve || end_at(1, range.v_of(row)) == Parameter::End::kNeither) continue;
    MeshRange one = range;
    one.j1 += static_cast<std::int64_t>(row);
    one.rows = 1;
    evaluate_exact_mesh<kComponents>(map, one, {to.data + row * to.row_stride, to.stride, 0, to.components},
                                     scratch);
  }
  for (const std::size_t column : {std::size_t{0}, range.columns - 1}) {
    const Parameter::End end = end_at(0, range.u_of(column));
    if (end == Parameter::End::kNeither) continue;
    constexpr std::size_t kRows = 2 * kStep;
    HWY_ALIGN double own_scratch[kRows * (kMaxOrder + 2)];
    double centred[centred_values(kMaxCentredDegree, 0)] = {};
    const PreparedMap edge = edge_of(map, end == Parameter::End::kLast, centred);
    MeshRange part = {range.v, {}, range.j1, 0, 0, 1};
    for (std::size_t row = 0; row < range.rows; row += kRows, part.i1 += kRows) {
      part.columns = std::min(kRows, range.rows - row);
      std::byte* const data = to.data + column * to.stride + row * to.row_stride;
      evaluate_exact_mesh<kComponents>(edge, part, {data, to.row_stride, 0, to.components}, own_scratch);
    }
  }
}

// Evaluates a mesh with GLEV_FAST. Returns false, and does nothing, if all points must be correctly rounded.
template <int kComponents>
bool evaluate_fast_mesh(const PreparedMap& map, const MeshRange& range, const Destination& to,
                        double* scratch) {
  if (!evaluate_fast_inside<kComponents>(map, range, to, scratch)) return false;
  round_boundary<kComponents>(map, range, to, scratch);
  return true;
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_FAST_MESH_INL_H_
