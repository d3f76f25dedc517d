// Automatic normals of meshes: the operations of NormalRow in the same order, one column in each lane.
// NormalRow computes the normals for which double is not accurate enough.
#if defined(GLEVALUATOR_NORMALS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_NORMALS_INL_H_
#undef GLEVALUATOR_NORMALS_INL_H_
#else
#define GLEVALUATOR_NORMALS_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "mesh-inl.h"
#include "mutation_point.h"
#include "plan.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {
namespace normals {

template <int kCount>
struct Block {
  Vector value[kUnroll][kCount];
};

// Evaluates a curve of a row at the columns whose weights begin at `weights`.
template <int kComponents, bool kFused = false>
HWY_INLINE Block<kComponents> combine(const double* points, int degree, const double* weights,
                                      std::size_t padded) {
  Block<kComponents> sum;
  sum_of<kComponents, kFused>(kDoubles, degree, weights, padded, points, sum.value);
  return sum;
}

// Returns x y - z w.
HWY_INLINE Vector difference_of_products(Vector x, Vector y, Vector z, Vector w) {
  return hn::Sub(hn::Mul(x, y), hn::Mul(z, w));
}

HWY_INLINE Block<3> derive_quotient(const Block<4>& p, const Block<4>& derivative) {
  Block<3> result;
  for (std::size_t part = 0; part < kUnroll; ++part) {
    const Vector(&at)[4] = p.value[part], (&slope)[4] = derivative.value[part];
    for (int k = 0; k < 3; ++k)
      result.value[part][k] = difference_of_products(at[3], slope[k], slope[3], at[k]);
  }
  return result;
}

#if HWY_MAX_BYTES >= 32
constexpr bool kHasRecords = true;

// Stores vertices and normals: x, y, z, nx, ny, nz for each column.
HWY_INLINE void store_records(const Half (&position)[3], const Half (&normal)[3], float* to) {
  constexpr hn::RepartitionToWide<decltype(kHalves)> kPairs;
  const auto store = [&](auto xy, auto z_nx, auto ny_nz) {
    hn::StoreInterleaved3(hn::BitCast(kPairs, xy), hn::BitCast(kPairs, z_nx), hn::BitCast(kPairs, ny_nz),
                          kPairs, reinterpret_cast<double*>(to));
    to += kLanes / 2 * 6;
  };
  const Half low[3] = {hn::InterleaveLower(kHalves, position[0], position[1]),
                       hn::InterleaveLower(kHalves, position[2], normal[0]),
                       hn::InterleaveLower(kHalves, normal[1], normal[2])},
             high[3] = {hn::InterleaveUpper(kHalves, position[0], position[1]),
                        hn::InterleaveUpper(kHalves, position[2], normal[0]),
                        hn::InterleaveUpper(kHalves, normal[1], normal[2])};
  static_assert(kLanes == 4 || kLanes == 8);
  if constexpr (kLanes == 4) {
    store(low[0], low[1], low[2]);
    store(high[0], high[1], high[2]);
  } else {  // the interleaving above works in blocks of 128 bits
    store(hn::ConcatLowerLower(kHalves, high[0], low[0]), hn::ConcatLowerLower(kHalves, high[1], low[1]),
          hn::ConcatLowerLower(kHalves, high[2], low[2]));
    store(hn::ConcatUpperUpper(kHalves, high[0], low[0]), hn::ConcatUpperUpper(kHalves, high[1], low[1]),
          hn::ConcatUpperUpper(kHalves, high[2], low[2]));
  }
}
#else
constexpr bool kHasRecords = false;
inline void store_records(const Half (&)[3], const Half (&)[3], float*) {}
#endif

// Calls function(lane) for lanes below `count` that are not in the mask.
template <class D, class Function>
HWY_NOINLINE void for_others(D d, hn::Mask<D> mask, std::size_t count, const Function& function) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  for (std::size_t lane = 0; lane < kLanes && lane < count; ++lane) {
    if ((bits[0] >> GLEV_AT(open_lane, lane) & 1) == 0) function(lane);
  }
}

// Unit vectors along a x b as floats, and the lanes in which double is accurate enough.
struct UnitNormals {
  HWY_INLINE UnitNormals(const Block<3>& a, const Block<3>& b, const NormalBounds& bounds) {
    for (std::size_t part = 0; part < kUnroll; ++part) {
      Vector m[3];
      for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        m[k] = difference_of_products(a.value[part][i], b.value[part][j], a.value[part][j], b.value[part][i]);
      }
      const Vector square = hn::Add(hn::Add(hn::Mul(m[0], m[0]), hn::Mul(m[1], m[1])), hn::Mul(m[2], m[2]));
      sure[part] = hn::Ge(square, GLEV_AT(least_square, hn::Set(kDoubles, bounds.least_square)));
      const Vector inverse = hn::Div(hn::Set(kDoubles, 1), hn::Sqrt(square));
      for (std::size_t k = 0; k < 3; ++k) {
        const auto is_known = hn::Gt(hn::Abs(m[k]), hn::Set(kDoubles, bounds.error[k]));
        value[part][k] = hn::DemoteTo(kHalves, hn::IfThenElseZero(is_known, hn::Mul(m[k], inverse)));
      }
    }
  }

  Half value[kUnroll][3];
  hn::Mask<Doubles> sure[kUnroll];
};

// Vertices as floats, and the lanes in which all components are correctly rounded.
struct Positions {
  HWY_INLINE Positions(const Block<3>& at, const PreparedMap::Test& test) {
    for (std::size_t part = 0; part < kUnroll; ++part) {
      settled[part] = hn::Eq(hn::Zero(kHalves), hn::Zero(kHalves));
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector error = hn::Set(kDoubles, test.error[k]);
        const Half least = hn::DemoteTo(kHalves, hn::Sub(at.value[part][k], error));
        value[part][k] = hn::DemoteTo(kHalves, hn::Add(at.value[part][k], error));
        settled[part] = hn::And(settled[part], hn::Eq(least, value[part][k]));
      }
    }
  }

  Half value[kUnroll][3];
  hn::Mask<decltype(kHalves)> settled[kUnroll];
};

HWY_INLINE void store_normals(const Half (&normal)[3], float* to) {
#if HWY_TARGET == HWY_SCALAR
  for (int k = 0; k < 3; ++k) {
    const float component = hn::GetLane(normal[k]);
    std::memcpy(to + k, &component, sizeof component);  // the caller's memory need not be aligned
  }
#else
  hn::StoreInterleaved3(normal[0], normal[1], normal[2], kHalves, to);
#endif
}

// Evaluates the rows of a mesh. kDegree: the degree in u if it is a compile-time constant, otherwise
// negative.
template <bool kRational, bool kVertices, int kDegree>
void evaluate_rows(const glev_plan& plan, const MeshRange& range, const Destination& to, double* weights) {
  const Surface& surface = plan.surface(Attribute::kVertex);
  const int n = kDegree < 0 ? surface.degree[0] : kDegree;
  const std::size_t padded = (range.columns + kStep - 1) / kStep * kStep;
  double *const weights_of_tangent = weights + (n + 1) * padded, *const t = weights_of_tangent + n * padded,
                *const s = t + padded;
  // The growth is exactly 1 inside the domain, and larger than this limit outside.
  place_columns(surface.domain[0], range, n, 1 + 0x1p-20, padded, t, s);
  for (std::size_t c = 0; c < padded; c += kLanes) {
    const Vector at_s = hn::Load(kDoubles, s + c), at_t = hn::Load(kDoubles, t + c);
    store_weights(n, at_s, at_t, padded, weights + c);
    store_weights(n - 1, at_s, at_t, padded, weights_of_tangent + c);
  }

  constexpr std::size_t kValues = kVertices ? 6 : 3;
  const std::size_t before = (kValues - 3) * sizeof(float);
  NormalRow row(plan);
  for (std::size_t r = 0; r < range.rows; ++r) {
    row.move_to(range.v_of(r), kVertices);
    std::byte* const data = to.data + r * to.row_stride - before;
    const auto put_normal = [&](std::size_t column) {
      const std::array<float, 3> normal = row.normal_at(range.u_of(column));
      std::memcpy(data + column * to.stride + before, normal.data(), sizeof normal);
    };
    const auto put_vertex = [&](std::size_t column) {
      float vertex[4];
      values_at(plan, Attribute::kVertex, range.u_of(column), range.v_of(r), vertex);
      std::memcpy(data + column * to.stride, vertex, 3 * sizeof(float));
    };
    if (row.growth() != 1) {
      for (std::size_t c = 0; c < range.columns; ++c) {
        put_normal(c);
        if (kVertices) put_vertex(c);
      }
      continue;
    }
    const double *const p = row.points(kPoint), *const p_u = row.points(kTangentU),
                        *const p_v = row.points(kTangentV);
    for (std::size_t c = 0; c < range.columns; c += kStep) {
      const std::size_t count = std::min(kStep, range.columns - c);
      const bool in_place = to.stride == kValues * sizeof(float) && count == kStep;
      alignas(64) float room[kStep * kValues];
      std::byte* const element = data + c * to.stride;
      float* const results = in_place ? reinterpret_cast<float*>(element) : room;
      Block<3> a, b;
      if constexpr (kRational) {
        const Block<4> at = combine<4>(p, n, weights + c, padded);
        a = derive_quotient(at, combine<4>(p_u, n - 1, weights_of_tangent + c, padded));
        b = derive_quotient(at, combine<4>(p_v, n, weights + c, padded));
      } else {
        a = combine<3>(p_u, n - 1, weights_of_tangent + c, padded);
        b = combine<3>(p_v, n, weights + c, padded);
      }
      const UnitNormals normals(a, b, plan.normal_bounds());
      [[maybe_unused]] hn::Mask<decltype(kHalves)> settled[kUnroll];
      if constexpr (kVertices) {
        const Positions positions(combine<3, true>(p, n, weights + c, padded),
                                  plan.map(Attribute::kVertex).test);
        for (std::size_t part = 0; part < kUnroll; ++part) {
          settled[part] = positions.settled[part];
          store_records(positions.value[part], normals.value[part], results + part * kLanes * kValues);
        }
      } else {
        for (std::size_t part = 0; part < kUnroll; ++part)
          store_normals(normals.value[part], results + part * kLanes * kValues);
      }
      if (!in_place) {
        if (!kVertices && kStep % 4 == 0 && count == kStep) {
          copy_triples(room, kStep, to.stride, element);
        } else {
          for (std::size_t i = 0; i < count; ++i)
            std::memcpy(element + i * to.stride, room + kValues * i, kValues * sizeof(float));
        }
      }
      for (std::size_t part = 0; part < kUnroll; ++part) {
        const std::size_t begin = c + part * kLanes, end = c + count;
        const std::size_t left = end > begin ? end - begin : 0;
        if (HWY_UNLIKELY(!hn::AllTrue(kDoubles, normals.sure[part])))
          for_others(kDoubles, normals.sure[part], left, [&](std::size_t lane) { put_normal(begin + lane); });
        if constexpr (kVertices) {
          if (HWY_UNLIKELY(!hn::AllTrue(kHalves, settled[part])))
            for_others(kHalves, settled[part], left, [&](std::size_t lane) { put_vertex(begin + lane); });
        }
      }
    }
  }
}

template <bool kRational, bool kVertices>
void evaluate_rows_of(const glev_plan& plan, const MeshRange& range, const Destination& to, double* weights) {
  switch (plan.surface(Attribute::kVertex).degree[0]) {
    case 2:
      return evaluate_rows<kRational, kVertices, 2>(plan, range, to, weights);
    case 3:
      return evaluate_rows<kRational, kVertices, 3>(plan, range, to, weights);
    default:
      return evaluate_rows<kRational, kVertices, -1>(plan, range, to, weights);
  }
}

inline void evaluate_mesh(const glev_plan& plan, const MeshRange& range, const Destination& to,
                          bool with_vertices, std::byte* scratch) {
  const Surface& surface = plan.surface(Attribute::kVertex);
  auto* const weights = reinterpret_cast<double*>(scratch);
  const auto vertices_apart = [&] {
    constexpr std::size_t kBytes = 3 * sizeof(float);
    plan.kernels().mesh(plan.map(Attribute::kVertex), range, false,
                        {to.data - kBytes, to.stride, to.row_stride, 3}, scratch);
  };
  if (surface.degree[0] == 0 || surface.degree[1] == 0) {
    // A tangent is zero, so all normals are (0,0,0).
    for (std::size_t r = 0; r < range.rows; ++r) {
      for (std::size_t c = 0; c < range.columns; ++c)
        std::memset(to.data + r * to.row_stride + c * to.stride, 0, 3 * sizeof(float));
    }
    if (with_vertices) vertices_apart();
    return;
  }
  if (surface.components == 4) return evaluate_rows_of<true, false>(plan, range, to, weights);
  if constexpr (kHasRecords) {
    if (with_vertices) return evaluate_rows_of<false, true>(plan, range, to, weights);
  }
  evaluate_rows_of<false, false>(plan, range, to, weights);
  if (with_vertices) vertices_apart();
}

}  // namespace normals
}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_NORMALS_INL_H_
