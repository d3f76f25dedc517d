// Evaluates meshes: the weights of the columns are computed once, then each row is evaluated as a curve.
#if defined(GLEVALUATOR_MESH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_MESH_INL_H_
#undef GLEVALUATOR_MESH_INL_H_
#else
#define GLEVALUATOR_MESH_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "mutation_point.h"
#include "point-inl.h"
#include "resolve.h"
#include "weights-inl.h"
#include "writer-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

// The largest growth for which values in double are used.
constexpr double kLargestGrowth = 0x1p40;

// Writes t and s of the columns. t is NaN, which is never decided, in columns whose growth is unknown or not
// below `limit`. Returns the largest growth of the other columns.
HWY_NOINLINE inline double place_columns(const Domain& domain, const MeshRange& range, int degree,
                                         double limit, std::size_t padded, double* t, double* s) {
  const Grid& grid = range.u;
  const double n = grid.segments;
  double growth = 1;
  if (spans(grid, domain) && range.i1 >= 0 && range.last_column() <= grid.segments) {
    const Vector segments = hn::Set(kDoubles, n);
    for (std::size_t c = 0; c < padded; c += kLanes) {
      const Vector index = hn::Iota(kDoubles, static_cast<double>(range.i1) + static_cast<double>(c));
      hn::Store(hn::Div(index, segments), kDoubles, t + c);
      hn::Store(hn::Div(hn::Sub(segments, index), segments), kDoubles, s + c);
    }
    return growth;
  }
  for (std::size_t c = 0; c < padded; ++c) {
    const Parameter at = locate(domain, range.u_of(std::min(c, range.columns - 1)));
    const double own = at.is_sure ? growth_of(at, degree) : HUGE_VAL;
    t[c] = own < limit ? at.t : std::numeric_limits<double>::quiet_NaN();
    s[c] = at.s;
    if (own < limit) growth = std::max(growth, own);
  }
  return growth;
}

inline bool is_inside(const Domain& domain, const Grid& grid, std::int64_t index) {
  if (spans(grid, domain)) return index >= 0 && index <= grid.segments;
  const Parameter at = locate(domain, GridArgument{grid, index});
  return at.is_sure && at.t >= 0 && at.s >= 0;
}
// Returns true if all points are inside the domain, in the direction of v only if `in_v`.
inline bool is_inside(const Surface& surface, const MeshRange& range, bool in_v) {
  const auto& [domain_u, domain_v] = surface.domain;
  return is_inside(domain_u, range.u, range.i1) && is_inside(domain_u, range.u, range.last_column()) &&
         (!in_v ||
          (is_inside(domain_v, range.v, range.j1) && is_inside(domain_v, range.v, range.last_row())));
}
inline bool is_end(const Domain& domain, const GridArgument& argument) {
  const auto& [grid, index] = argument;
  if (spans(grid, domain)) return index == 0 || index == grid.segments;
  return locate(domain, argument).end != Parameter::End::kNeither;
}

// Returns true if the bound of GLEV_FAST holds inside the mesh: not outside the domain and not for extreme
// maps. In grids whose ends are equal, all columns or rows may be on the boundary.
inline bool has_fast_inside(const PreparedMap& map, const MeshRange& range) {
  return has_fast_bound(map) && range.u.u1 != range.u.u2 && range.v.u1 != range.v.u2 &&
         is_inside(map.surface, range, true);
}

template <int kComponents>
HWY_INLINE void row_of(const Surface& surface, const double* weights_v, double* row) {
  const auto [n, m] = surface.degree;
  const double* points = surface.scaled;
  for (int i = 0; i <= n; ++i, points += (m + 1) * kComponents, row += 4) {
    FourVector sum[kParts];
    add_points(points, kComponents, weights_v, m, sum);
    for (std::size_t part = 0; part < kParts; ++part) hn::StoreU(sum[part], kFour, row + part * kFourLanes);
  }
}

// Computes the sums of weights times control points at kUnroll vectors of columns. The weights of each i are
// `padded` apart, and control points have four values. kFused allows fused operations.
template <int kComponents, bool kFused, class D>
HWY_INLINE void sum_of(D d, int degree, const hn::TFromD<D>* weights, std::size_t padded,
                       const hn::TFromD<D>* points, hn::Vec<D> (&value)[kUnroll][kComponents]) {
  constexpr std::size_t kWidth = hn::MaxLanes(D());
  for (int k = 0; k < kComponents; ++k) {
    for (std::size_t part = 0; part < kUnroll; ++part)
      value[part][k] = hn::Mul(hn::Load(d, weights + part * kWidth), hn::Set(d, points[k]));
  }
  for (int i = 1; i <= degree; ++i) {
    weights += padded;
    points += 4;
    hn::Vec<D> weight[kUnroll];
    for (std::size_t part = 0; part < kUnroll; ++part) weight[part] = hn::Load(d, weights + part * kWidth);
    for (int k = 0; k < kComponents; ++k) {
      const hn::Vec<D> next = hn::Set(d, points[k]);
      for (std::size_t part = 0; part < kUnroll; ++part)
        value[part][k] = kFused ? hn::MulAdd(weight[part], next, value[part][k])
                                : hn::Add(value[part][k], hn::Mul(weight[part], next));
    }
  }
}

template <int kComponents>
void evaluate_rounded_mesh(const PreparedMap& map, const MeshRange& range, const Destination& to,
                           double* weights) {
  const auto [n, m] = map.surface.degree;
  const std::size_t padded = (range.columns + kStep - 1) / kStep * kStep;
  double* const t = weights + (n + 1) * padded;
  double* const s = t + padded;
  const double growth_u = place_columns(map.surface.domain[0], range, n, kLargestGrowth, padded, t, s);
  for (std::size_t c = 0; c < padded; c += kLanes) {
    store_weights(n, hn::Load(kDoubles, s + c), hn::Load(kDoubles, t + c), padded, weights + c);
  }
  const auto [domain_u, domain_v] = map.surface.domain;
  const int roundings = spans(range.u, domain_u) && (m == 0 || spans(range.v, domain_v)) ? 1 : kRoundings;
  const double units = weight_units(n, m, roundings);
  const PreparedMap::Test test = make_test(map, units, 1);
  // The weights of a block of columns stay in the L1 cache for a group of rows.
  constexpr std::size_t kRows = 8, kBlock = 2048;
  const std::size_t block = std::max(kBlock / (n + 1) / kStep, std::size_t{1}) * kStep;
  for (std::size_t first = 0; first < range.rows; first += kRows) {
    const std::size_t rows = std::min(kRows, range.rows - first);
    PreparedMap::Test tests[kRows];
    double row[kRows][4 * kMaxOrder];
    for (std::size_t r = 0; r < rows; ++r) {
      const Parameter at_v = locate(map.surface.domain[1], range.v_of(first + r));
      double weights_v[kMaxOrder];
      weights_at(m, at_v, weights_v);
      row_of<kComponents>(map.surface, weights_v, row[r]);
      const double growth = at_v.is_sure ? growth_u * growth_of(at_v, m) : HUGE_VAL;
      tests[r] = growth == 1 ? test : make_test(map, units, growth);
    }
    for (std::size_t begin = 0; begin < range.columns; begin += block) {
      const std::size_t end = std::min(begin + block, range.columns);
      for (std::size_t r = 0; r < rows; ++r) {
        const Writer<kComponents> writer(tests[r], to, to.data + (first + r) * to.row_stride);
        for (std::size_t c = begin; c < end; c += kStep) {
          Vector value[kUnroll][kComponents];
          sum_of<kComponents, true>(kDoubles, n, weights + c, padded, row[r], value);
          writer.write(value, c, std::min(kStep, end - c), [&](std::size_t i, int k) {
            return resolve(map, k, range.u_of(i), range.v_of(GLEV_AT(open_row, first + r)));
          });
        }
      }
    }
  }
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_MESH_INL_H_
