// Compiled once for each instruction set. The operations of NormalRow in the same order, a lane a column; the
// lanes where double does not do are left to it.
#include "production/src/normal_kernels.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "production/src/fault.h"
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

// A curve of a row, at columns whose weights begin at `weights`.
template <int kComponents>
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
        sum.value[k][part] = hn::Add(sum.value[k][part], hn::Mul(weight[part], value));
    }
  }
  return sum;
}

// InverseRoot
HWY_INLINE Vector InverseRootOf(Vector x) {
  constexpr hn::RebindToUnsigned<Doubles> kBits;
  const Vector half = hn::Mul(hn::Set(kDoubles, 0.5), x), three_halves = hn::Set(kDoubles, 1.5);
  Vector y = hn::BitCast(kDoubles,
                         hn::Sub(hn::Set(kBits, kInverseRootBits), hn::ShiftRight<1>(hn::BitCast(kBits, x))));
  for (int i = 0; i < 3; ++i) y = hn::Mul(y, hn::Sub(three_halves, hn::Mul(half, hn::Mul(y, y))));
  return y;
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

// The degree in u, if known when this is compiled.
template <bool kRational, int kDegree>
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
  NormalRow row(plan);
  for (std::size_t r = 0; r < range.rows; ++r) {
    row.MoveTo({range.v, range.j1 + static_cast<std::int64_t>(r)});
    std::byte* const data = to.data + r * to.row_stride;
    const auto put_exactly = [&](std::size_t column) {
      const std::array<float, 3> normal = row.At({range.u, range.i1 + static_cast<std::int64_t>(column)});
      std::memcpy(data + column * to.stride, normal.data(), sizeof normal);
    };
    if (row.growth() != 1) {
      for (std::size_t c = 0; c < range.columns; ++c) put_exactly(c);
      continue;
    }
    const double *const p = row.points(kPoint), *const p_u = row.points(kTangentU),
                        *const p_v = row.points(kTangentV);
    for (std::size_t c = 0; c < range.columns; c += kStep) {
      Block<3> a, b;
      if constexpr (kRational) {
        const Block<4> at = Sum<4>(p, n, weights + c, padded);
        a = OfQuotient(at, Sum<4>(p_u, n - 1, weights_of_tangent + c, padded));
        b = OfQuotient(at, Sum<4>(p_v, n, weights + c, padded));
      } else {
        a = Sum<3>(p_u, n - 1, weights_of_tangent + c, padded);
        b = Sum<3>(p_v, n, weights + c, padded);
      }
      alignas(64) float normals[kStep * 3];
      hn::Mask<Doubles> sure[kUnroll];
      for (std::size_t part = 0; part < kUnroll; ++part) {
        Vector m[3];
        for (int k = 0; k < 3; ++k) {
          const int i = (k + 1) % 3, j = (k + 2) % 3;
          m[k] = Difference(a.value[i][part], b.value[j][part], a.value[j][part], b.value[i][part]);
        }
        const Vector square = hn::Add(hn::Add(hn::Mul(m[0], m[0]), hn::Mul(m[1], m[1])), hn::Mul(m[2], m[2]));
        sure[part] = hn::Ge(square, least_square);
        const Vector inverse = InverseRootOf(square);
        hn::Vec<decltype(kHalves)> rounded[3];
        for (int k = 0; k < 3; ++k) {
          const Vector unit = hn::IfThenElseZero(hn::Gt(hn::Abs(m[k]), error[k]), hn::Mul(m[k], inverse));
          rounded[k] = hn::DemoteTo(kHalves, unit);
        }
        hn::StoreInterleaved3(rounded[0], rounded[1], rounded[2], kHalves, normals + part * kLanes * 3);
      }
      const std::size_t count = std::min(kStep, range.columns - c);
      std::byte* element = data + c * to.stride;
      if (to.stride == sizeof(float) * 3 && count == kStep) {
        std::memcpy(element, normals, sizeof normals);
      } else if (HWY_LIKELY(count == kStep && kStep % 4 == 0)) {
        CopyTriples(normals, kStep, to.stride, element);
      } else {
        for (std::size_t i = 0; i < count; ++i, element += to.stride)
          std::memcpy(element, normals + 3 * i, 3 * sizeof(float));
      }
      for (std::size_t part = 0; part < kUnroll; ++part) {
        if (HWY_LIKELY(hn::AllTrue(kDoubles, sure[part]))) continue;
        alignas(64) double is_sure[kLanes];
        hn::Store(hn::IfThenElseZero(sure[part], one), kDoubles, is_sure);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          const std::size_t i = part * kLanes + lane;
          if (i < count && is_sure[lane] == 0) put_exactly(c + i);
        }
      }
    }
  }
}

template <bool kRational>
void RowsOf(const glev_plan& plan, const MeshRange& range, const Destination& to, double* weights) {
  switch (plan.surface(Attribute::kVertex).degree[0]) {
    case 2:
      return Rows<kRational, 2>(plan, range, to, weights);
    case 3:
      return Rows<kRational, 3>(plan, range, to, weights);
    default:
      return Rows<kRational, -1>(plan, range, to, weights);
  }
}

void Mesh(const glev_plan& plan, const MeshRange& range, const Destination& to, std::byte* scratch) {
  const Surface& surface = plan.surface(Attribute::kVertex);
  auto* const weights = reinterpret_cast<double*>(scratch);
  if (surface.degree[0] == 0 || surface.degree[1] == 0) {
    // A tangent is zero.
    for (std::size_t r = 0; r < range.rows; ++r) {
      for (std::size_t c = 0; c < range.columns; ++c)
        std::memset(to.data + r * to.row_stride + c * to.stride, 0, 3 * sizeof(float));
    }
    return;
  }
  surface.components == 4 ? RowsOf<true>(plan, range, to, weights) : RowsOf<false>(plan, range, to, weights);
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
#ifdef GLEV_FAULTS
  if (active_fault != Fault::kNone) return nullptr;  // those sit in Row
#endif
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
