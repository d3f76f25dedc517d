// Compiled once for each instruction set. The operations of NormalRow in the same order, a lane a column; the
// lanes where double does not do are left to it.
#include "production/src/normal_kernels.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "production/src/normal.h"
#include "production/src/triples.h"

// As in kernels.cpp.
#define HWY_IS_DEBUG_BUILD 0
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "production/src/normal_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {
namespace normals {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Doubles>;
constexpr Doubles kDoubles;
constexpr std::size_t kLanes = hn::MaxLanes(kDoubles);
constexpr hn::Rebind<float, Doubles> kHalves;
constexpr std::size_t kUnroll = 2;
constexpr std::size_t kStep = kUnroll * kLanes;

// t and s of the columns, NaN where they are outside the domain or not sure.
void PlaceColumns(const Domain& domain, const MeshRange& range, int degree, std::size_t padded, double* t,
                  double* s) {
  const Grid& grid = range.u;
  const std::int64_t i2 = range.i1 + static_cast<std::int64_t>(range.columns) - 1;
  if (grid.u1 == domain.u1 && grid.u2 == domain.u2 && range.i1 >= 0 && i2 <= grid.segments) {
    const Vector segments = hn::Set(kDoubles, grid.segments);
    for (std::size_t c = 0; c < padded; c += kLanes) {
      const Vector index = hn::Iota(kDoubles, static_cast<double>(range.i1) + static_cast<double>(c));
      hn::Store(hn::Div(index, segments), kDoubles, t + c);
      hn::Store(hn::Div(hn::Sub(segments, index), segments), kDoubles, s + c);
    }
    return;
  }
  for (std::size_t c = 0; c < padded; ++c) {
    const std::size_t column = std::min(c, range.columns - 1);
    const Parameter at = Locate(domain, GridArgument{grid, range.i1 + static_cast<std::int64_t>(column)});
    const bool is_inside = at.is_sure && Growth(at, degree) == 1;
    t[c] = is_inside ? at.t : std::numeric_limits<double>::quiet_NaN();
    s[c] = at.s;
  }
}

// NormalWeights
HWY_INLINE void StoreWeights(int degree, Vector s, Vector t, std::size_t padded, double* weights) {
  Vector column[kMaxOrder];
  column[0] = hn::Set(kDoubles, 1);
  for (int i = 1; i <= degree; ++i) column[i] = hn::Mul(column[i - 1], t);
  Vector power = s;
  for (int i = degree - 1; i >= 0; --i, power = hn::Mul(power, s)) column[i] = hn::Mul(column[i], power);
  for (int i = 0; i <= degree; ++i) hn::Store(column[i], kDoubles, weights + i * padded);
}

template <std::size_t kCount>
struct Block {
  Vector value[kCount][kUnroll];
};

// A curve of a row, at columns whose weights begin at `weights`; with fused operations where bits do not
// matter.
template <int kComponents, bool kFused = false>
HWY_INLINE Block<kComponents> Sum(const double* point, int degree, const double* weights,
                                  std::size_t padded) {
  Block<kComponents> sum;
  for (std::size_t part = 0; part < kUnroll; ++part) {
    const Vector weight = hn::Load(kDoubles, weights + part * kLanes);
    for (int k = 0; k < kComponents; ++k) sum.value[k][part] = hn::Mul(weight, hn::Set(kDoubles, point[k]));
  }
  for (int i = 1; i <= degree; ++i) {
    point += 4;
    weights += padded;
    Vector weight[kUnroll];
    for (std::size_t part = 0; part < kUnroll; ++part)
      weight[part] = hn::Load(kDoubles, weights + part * kLanes);
    for (int k = 0; k < kComponents; ++k) {
      const Vector value = hn::Set(kDoubles, point[k]);
      for (std::size_t part = 0; part < kUnroll; ++part)
        sum.value[k][part] = kFused ? hn::MulAdd(weight[part], value, sum.value[k][part])
                                    : hn::Add(sum.value[k][part], hn::Mul(weight[part], value));
    }
  }
  return sum;
}

// x y - z w
HWY_INLINE Vector Difference(Vector x, Vector y, Vector z, Vector w) {
  return hn::Sub(hn::Mul(x, y), hn::Mul(z, w));
}

HWY_INLINE Block<3> OfQuotient(const Block<4>& p, const Block<4>& derivative) {
  Block<3> result;
  for (int k = 0; k < 3; ++k) {
    for (std::size_t part = 0; part < kUnroll; ++part)
      result.value[k][part] = Difference(p.value[3][part], derivative.value[k][part],
                                         derivative.value[3][part], p.value[k][part]);
  }
  return result;
}

using Half = hn::Vec<decltype(kHalves)>;

#if HWY_MAX_BYTES >= 32
constexpr bool kHasRecords = true;

// Vertices and normals: x, y, z, nx, ny, nz of each column after the other.
HWY_INLINE void StoreRecords(const Half (&position)[3], const Half (&normal)[3], float* to) {
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
  } else {  // these worked in blocks of 128 bits
    store(hn::ConcatLowerLower(kHalves, high[0], low[0]), hn::ConcatLowerLower(kHalves, high[1], low[1]),
          hn::ConcatLowerLower(kHalves, high[2], low[2]));
    store(hn::ConcatUpperUpper(kHalves, high[0], low[0]), hn::ConcatUpperUpper(kHalves, high[1], low[1]),
          hn::ConcatUpperUpper(kHalves, high[2], low[2]));
  }
}
#else
constexpr bool kHasRecords = false;
inline void StoreRecords(const Half (&)[3], const Half (&)[3], float*) {}
#endif

// The lanes below `count` that are not in the mask.
template <class D, class Function>
HWY_NOINLINE void ForOthers(D d, hn::Mask<D> mask, std::size_t count, const Function& function) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  for (std::size_t lane = 0; lane < kLanes && lane < count; ++lane) {
    if ((bits[0] >> lane & 1) == 0) function(lane);
  }
}

// The degree in u, if known when this is compiled.
template <bool kRational, bool kVertices, int kDegree>
void Rows(const glev_plan& plan, const MeshRange& range, const Destination& to, double* weights) {
  const Surface& surface = plan.surface(Attribute::kVertex);
  const int n = kDegree < 0 ? surface.degree[0] : kDegree;
  const std::size_t padded = (range.columns + kStep - 1) / kStep * kStep;
  double *const weights_of_tangent = weights + (n + 1) * padded, *const t = weights_of_tangent + n * padded,
                *const s = t + padded;
  PlaceColumns(surface.domain[0], range, n, padded, t, s);
  for (std::size_t c = 0; c < padded; c += kLanes) {
    const Vector at_s = hn::Load(kDoubles, s + c), at_t = hn::Load(kDoubles, t + c);
    StoreWeights(n, at_s, at_t, padded, weights + c);
    StoreWeights(n - 1, at_s, at_t, padded, weights_of_tangent + c);
  }

  const NormalBounds& bounds = plan.normal_bounds();
  const Vector least_square = hn::Set(kDoubles, bounds.least_square), one = hn::Set(kDoubles, 1);
  Vector error[3];
  for (std::size_t k = 0; k < 3; ++k) error[k] = hn::Set(kDoubles, bounds.error[k]);
  const PreparedMap& map = plan.map(Attribute::kVertex);
  Vector vertex_error[3];
  for (std::size_t k = 0; k < 3; ++k) vertex_error[k] = hn::Set(kDoubles, map.test.error[k]);
  constexpr std::size_t kValues = kVertices ? 6 : 3;
  const std::size_t before = (kValues - 3) * sizeof(float);
  NormalRow row(plan);
  for (std::size_t r = 0; r < range.rows; ++r) {
    const GridArgument v = {range.v, range.j1 + static_cast<std::int64_t>(r)};
    row.MoveTo(v, kVertices);
    std::byte* const data = to.data + r * to.row_stride - before;
    const auto put_normal = [&](std::size_t column) {
      const std::array<float, 3> normal = row.At({range.u, range.i1 + static_cast<std::int64_t>(column)});
      std::memcpy(data + column * to.stride + before, normal.data(), sizeof normal);
    };
    const auto put_vertex = [&](std::size_t column) {
      const GridArgument u = {range.u, range.i1 + static_cast<std::int64_t>(column)};
      float vertex[4];
      ValuesAt(plan, Attribute::kVertex, u, v, vertex);
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
        const Block<4> at = Sum<4>(p, n, weights + c, padded);
        a = OfQuotient(at, Sum<4>(p_u, n - 1, weights_of_tangent + c, padded));
        b = OfQuotient(at, Sum<4>(p_v, n, weights + c, padded));
      } else {
        a = Sum<3>(p_u, n - 1, weights_of_tangent + c, padded);
        b = Sum<3>(p_v, n, weights + c, padded);
      }
      hn::Mask<Doubles> sure[kUnroll];
      Half normal[kUnroll][3];
      for (std::size_t part = 0; part < kUnroll; ++part) {
        Vector m[3];
        for (int k = 0; k < 3; ++k) {
          const int i = (k + 1) % 3, j = (k + 2) % 3;
          m[k] = Difference(a.value[i][part], b.value[j][part], a.value[j][part], b.value[i][part]);
        }
        const Vector square = hn::Add(hn::Add(hn::Mul(m[0], m[0]), hn::Mul(m[1], m[1])), hn::Mul(m[2], m[2]));
        sure[part] = hn::Ge(square, least_square);
        const Vector inverse = hn::Div(one, hn::Sqrt(square));
        for (int k = 0; k < 3; ++k) {
          const Vector unit = hn::IfThenElseZero(hn::Gt(hn::Abs(m[k]), error[k]), hn::Mul(m[k], inverse));
          normal[part][k] = hn::DemoteTo(kHalves, unit);
        }
      }
      Half position[kUnroll][3];
      hn::Mask<decltype(kHalves)> settled[kUnroll];
      if constexpr (kVertices) {
        const Block<3> at = Sum<3, true>(p, n, weights + c, padded);
        for (std::size_t part = 0; part < kUnroll; ++part) {
          settled[part] = hn::Eq(hn::Zero(kHalves), hn::Zero(kHalves));
          for (int k = 0; k < 3; ++k) {
            const Vector value = at.value[k][part];
            const Half least = hn::DemoteTo(kHalves, hn::Sub(value, vertex_error[k]));
            position[part][k] = hn::DemoteTo(kHalves, hn::Add(value, vertex_error[k]));
            settled[part] = hn::And(settled[part], hn::Eq(least, position[part][k]));
          }
        }
      }
      for (std::size_t part = 0; part < kUnroll; ++part) {
        float* const here = results + part * kLanes * kValues;
        if constexpr (kVertices) {
          StoreRecords(position[part], normal[part], here);
        } else {
#if HWY_TARGET == HWY_SCALAR
          for (int k = 0; k < 3; ++k) here[k] = hn::GetLane(normal[part][k]);
#else
          hn::StoreInterleaved3(normal[part][0], normal[part][1], normal[part][2], kHalves, here);
#endif
        }
      }
      if (!in_place) {
        if (!kVertices && kStep % 4 == 0 && count == kStep) {
          CopyTriples(room, kStep, to.stride, element);
        } else {
          for (std::size_t i = 0; i < count; ++i)
            std::memcpy(element + i * to.stride, room + kValues * i, kValues * sizeof(float));
        }
      }
      for (std::size_t part = 0; part < kUnroll; ++part) {
        const std::size_t begin = c + part * kLanes, end = c + count;
        const std::size_t left = end > begin ? end - begin : 0;
        if (HWY_UNLIKELY(!hn::AllTrue(kDoubles, sure[part])))
          ForOthers(kDoubles, sure[part], left, [&](std::size_t lane) { put_normal(begin + lane); });
        if constexpr (kVertices) {
          if (HWY_UNLIKELY(!hn::AllTrue(kHalves, settled[part])))
            ForOthers(kHalves, settled[part], left, [&](std::size_t lane) { put_vertex(begin + lane); });
        }
      }
    }
  }
}

template <bool kRational, bool kVertices>
void RowsOf(const glev_plan& plan, const MeshRange& range, const Destination& to, double* weights) {
  switch (plan.surface(Attribute::kVertex).degree[0]) {
    case 2:
      return Rows<kRational, kVertices, 2>(plan, range, to, weights);
    case 3:
      return Rows<kRational, kVertices, 3>(plan, range, to, weights);
    default:
      return Rows<kRational, kVertices, -1>(plan, range, to, weights);
  }
}

void Mesh(const glev_plan& plan, const MeshRange& range, const Destination& to, bool with_vertices,
          std::byte* scratch) {
  const Surface& surface = plan.surface(Attribute::kVertex);
  auto* const weights = reinterpret_cast<double*>(scratch);
  const auto vertices_apart = [&] {
    constexpr std::size_t kBytes = 3 * sizeof(float);
    plan.kernels().mesh(plan.map(Attribute::kVertex), range, false,
                        {to.data - kBytes, to.stride, to.row_stride, 3}, scratch);
  };
  if (surface.degree[0] == 0 || surface.degree[1] == 0) {
    // A tangent is zero.
    for (std::size_t r = 0; r < range.rows; ++r) {
      for (std::size_t c = 0; c < range.columns; ++c)
        std::memset(to.data + r * to.row_stride + c * to.stride, 0, 3 * sizeof(float));
    }
    if (with_vertices) vertices_apart();
    return;
  }
  if (surface.components == 4) return RowsOf<true, false>(plan, range, to, weights);
  if constexpr (kHasRecords) {
    if (with_vertices) return RowsOf<false, true>(plan, range, to, weights);
  }
  RowsOf<false, false>(plan, range, to, weights);
  if (with_vertices) vertices_apart();
}

constexpr NormalMesh MakeNormalMesh() { return Mesh; }

}  // namespace normals
}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glev {
namespace {

struct NamedMesh {
  const char* name;  // of Kernels
  NormalMesh mesh;
};

constexpr NamedMesh kNormalMeshes[] = {
#if (HWY_TARGETS & HWY_AVX3) && HWY_STATIC_TARGET != HWY_AVX3
    {"AVX3", N_AVX3::normals::MakeNormalMesh()},
#endif
#if (HWY_TARGETS & HWY_AVX2) && HWY_STATIC_TARGET != HWY_AVX2
    {"AVX2", N_AVX2::normals::MakeNormalMesh()},
#endif
#if (HWY_TARGETS & HWY_SSE4) && HWY_STATIC_TARGET != HWY_SSE4
    {"SSE4", N_SSE4::normals::MakeNormalMesh()},
#endif
    {"baseline", HWY_STATIC_DISPATCH(normals::MakeNormalMesh)()},
};

}  // namespace

NormalMesh NormalMeshOf(const Kernels& kernels) {
  for (const auto& [name, mesh] : kNormalMeshes) {
    if (std::strcmp(name, kernels.name) == 0) return mesh;
  }
  return nullptr;
}

std::size_t NormalMeshScratch(int degree, std::size_t columns) {
  constexpr std::size_t kWidest = 64;  // the step of any instruction set divides it
  const std::size_t padded = (columns + kWidest - 1) / kWidest * kWidest;
  return padded * sizeof(double) * (2 * static_cast<std::size_t>(degree) + 3);
}

}  // namespace glev
#endif  // HWY_ONCE
