// Evaluates meshes of any degree with GLEV_FAST, in float, as sums of products with weights.
#if defined(GLEVALUATOR_FAST_MESH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_FAST_MESH_INL_H_
#undef GLEVALUATOR_FAST_MESH_INL_H_
#else
#define GLEVALUATOR_FAST_MESH_INL_H_
#endif

#include <algorithm>
#include <cstddef>

#include "binomials.h"
#include "mesh-inl.h"
#include "mutation_point.h"

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
  weights_at(map.surface.degree[1], locate(map.surface.domain[1], range.v_of(r)), weights);
  row_of<kComponents>(map.surface, weights, row);
}

// Evaluates a fast mesh, except for its boundary. Returns false, and does nothing, if the bound of GLEV_FAST
// would not hold.
template <int kComponents>
bool evaluate_fast_inside(const PreparedMap& map, const MeshRange& range, const Destination& to,
                          double* scratch) {
  if (!has_fast_inside(map, range)) return false;
  const int n = map.surface.degree[0];
  const std::size_t padded = (range.columns + kFloatStep - 1) / kFloatStep * kFloatStep;
  double* const t = scratch;
  double* const s = t + padded;
  auto* const weights = reinterpret_cast<float*>(s + padded);
  compute_fast_weights(map.surface.domain[0], range, n, padded, t, s, weights);
  const bool packed = is_packed(kComponents, to);
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
      sum_of<kComponents, true>(kFloats, n, weights + c, padded, points, value);
      for (std::size_t part = 0, first = c; part < kUnroll && first < range.columns; ++part, first += kStep)
        store_points<kComponents>(value[part], std::min(kStep, range.columns - first), packed, to,
                                  data + first * to.stride);
    }
  }
  return true;
}

// Returns the curve of a map at the first or last end of the domain of u, as a map in u.
inline PreparedMap edge_of(const PreparedMap& map, bool is_last) {
  const auto [n, m] = map.surface.degree;
  const int values = (m + 1) * map.surface.components;
  PreparedMap edge = map;
  edge.surface.degree = {m, 0};
  edge.surface.domain = {map.surface.domain[1], Domain{}};
  edge.surface.scaled += is_last ? n * values : 0;
  edge.centred = nullptr;
  for (int k = 0; k < map.surface.components; ++k) {
    PreparedComponent& component = edge.component[k];
    const auto [columns, rows] = component.lowest.order;
    component.lowest.points += is_last ? (columns - 1) * rows : 0;
    component.lowest.order = {rows, 1};
    component.lowest.domain = edge.surface.domain;
    if (component.kind == PreparedComponent::Kind::kLine) component.kind = PreparedComponent::Kind::kGeneral;
  }
  return edge;
}

// Rounds the points on the boundary of the domain correctly. Adjacent patches then meet without a crack,
// because these points depend only on the exact value.
template <int kComponents>
HWY_NOINLINE void round_boundary(const PreparedMap& map, const MeshRange& range, const Destination& to,
                                 double* scratch) {
  const bool is_curve = to.row_stride == 0;  // the boundary of a curve consists of its ends
  for (const std::size_t row : {std::size_t{0}, range.rows - 1}) {
    if (is_curve || !is_end(map.surface.domain[1], range.v_of(row))) continue;
    MeshRange one = range;
    one.j1 += static_cast<std::int64_t>(row);
    one.rows = 1;
    evaluate_rounded_mesh<kComponents>(map, one, {to.data + row * to.row_stride, to.stride, 0, to.components},
                                       scratch);
  }
  for (const std::size_t column : {std::size_t{0}, range.columns - 1}) {
    const Parameter::End end = locate(map.surface.domain[0], range.u_of(column)).end;
    if (end == Parameter::End::kNeither) continue;
    constexpr std::size_t kRows = 2 * kStep;
    HWY_ALIGN double own_scratch[kRows * (kMaxOrder + 2)];
    const PreparedMap edge = edge_of(map, end == Parameter::End::kLast);
    MeshRange part = {range.v, {}, range.j1, 0, 0, 1};
    for (std::size_t row = 0; row < range.rows; row += kRows, part.i1 += kRows) {
      part.columns = std::min(kRows, range.rows - row);
      std::byte* const data = to.data + column * to.stride + row * to.row_stride;
      evaluate_rounded_mesh<kComponents>(edge, part, {data, to.row_stride, 0, to.components}, own_scratch);
    }
  }
}

// Evaluates a mesh with GLEV_FAST. Returns false, and does nothing, if all points must be correctly rounded.
template <int kComponents>
bool evaluate_fast_mesh(const PreparedMap& map, const MeshRange& range, const Destination& to,
                        double* scratch) {
  if (!evaluate_fast_inside<kComponents>(map, range, to, scratch)) return false;
  GLEV_AT(round_boundary, round_boundary<kComponents>(map, range, to, scratch));
  return true;
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_FAST_MESH_INL_H_
