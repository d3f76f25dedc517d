// Meshes of low degree inside their domain, correctly rounded, in powers of x = t - s and y.
#if defined(GLEVALUATOR_CENTRED_MESH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_CENTRED_MESH_INL_H_
#undef GLEVALUATOR_CENTRED_MESH_INL_H_
#else
#define GLEVALUATOR_CENTRED_MESH_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "mesh-inl.h"
#include "sequence-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

// t - s
inline double centred_at(const Domain& domain, const GridArgument& argument) {
  const Parameter at = locate(domain, argument);
  return at.t - at.s;
}

// A row: its coefficients, four values for each power of x, after which vectors may read on; for x^0 both
// ends of the interval. The error of the test contains the roundings of these and one more, as it contains
// those of its own sums elsewhere.
template <int kComponents, int kDegree>
struct CentredRow {
  double power[4 * (kDegree + 1) + kLanes], high[4 + kLanes];

  void set(const PreparedMap& map, const GridArgument& v) {
    const int m = map.surface.degree[1];
    const double y = m == 0 ? 0 : centred_at(map.surface.domain[1], v);
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
      for (int i = 0; i <= kDegree; ++i) power_[i][part] = sequence.values_of(row.power + 4 * i, part);
      high_[part] = sequence.values_of(row.high, part);
    }
  }

  HWY_INLINE void evaluate(Vector x, std::size_t part, Half* low, Half* high) const {
    Vector sum = power_[kDegree][part];
    for (int i = kDegree - 1; i > 0; --i) sum = hn::MulAdd(sum, x, power_[i][part]);
    *low = hn::DemoteTo(kHalves, hn::MulAdd(sum, x, power_[0][part]));
    *high = hn::DemoteTo(kHalves, hn::MulAdd(sum, x, high_[part]));
  }

 private:
  Vector power_[kDegree + 1][Values::kPeriod], high_[Values::kPeriod];
};

constexpr hn::RebindToUnsigned<decltype(kHalves)> kBits;
HWY_INLINE bool is_zero(Half value) {
  return hn::AllTrue(kBits, hn::Eq(hn::BitCast(kBits, value), hn::Zero(kBits)));
}

template <int kComponents, int kDegree>
void evaluate_centred_rows(const PreparedMap& map, const MeshRange& range, const Destination& to,
                           const double* x) {
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
    for (std::size_t r = 0; r < rows; ++r) row[r].set(map, range.v_of(r0 + r));
    for (std::size_t c0 = 0; c0 < range.columns; c0 += kColumns) {
      const std::size_t columns = std::min(kColumns, range.columns - c0), count = columns * kComponents;
      sequence.repeat(x + c0, columns, places);
      for (std::size_t r = 0; r < rows; ++r) {
        const CentredCurve<kComponents, kDegree> curve(row[r], sequence);
        std::byte* const data = to.data + (r0 + r) * to.row_stride + c0 * to.stride;
        float* const out = is_packed<kComponents>(to) ? reinterpret_cast<float*>(data) : values;
        Half open = hn::Zero(kHalves);  // bits in which the ends differ
        const auto evaluate = [&](std::size_t begin, float* group) HWY_ATTR {
          for (std::size_t part = 0; part < kPeriod; ++part) {
            Half low, high;
            curve.evaluate(hn::Load(kDoubles, places + begin + part * kLanes), part, &low, &high);
            open = hn::Or(open, hn::Xor(low, high));
            hn::StoreU(high, kHalves, group + part * kLanes);
          }
        };
        in_groups<kGroup>(count, out, evaluate);
        // Undecided lanes are rare (one in some strips), so a strip is checked once, at its end.
        for (std::size_t begin = is_zero(open) ? count : 0; begin < count; begin += kLanes) {
          Half low, high;
          curve.evaluate(hn::Load(kDoubles, places + begin), begin / kLanes % kPeriod, &low, &high);
          const Half bits = hn::Xor(low, high);
          if (HWY_LIKELY(is_zero(bits))) continue;
          std::uint32_t is_open[kLanes];
          hn::StoreU(hn::BitCast(kBits, bits), kBits, is_open);
          for (std::size_t i = begin; i < std::min(begin + kLanes, count); ++i) {
            if (is_open[i - begin] == 0) continue;
            const float result = resolve(map, static_cast<int>(i % kComponents),
                                         range.u_of(c0 + i / kComponents), range.v_of(r0 + r));
            std::memcpy(out + i, &result, sizeof result);  // the caller's memory need not be aligned
          }
        }
        if (out == values) scatter<kComponents>(values, columns, to, data);
      }
    }
  }
}

// False, and nothing done, for other maps and outside the domain.
template <int kComponents>
bool evaluate_centred_mesh(const PreparedMap& map, const MeshRange& range, const Destination& to, double* x) {
  const auto [n, m] = map.surface.degree;
  if (n == 0 || map.centred == nullptr) return false;
  // The ends of intervals are compared as bits; those of NaN could agree. (Between columns that are sure all
  // are.)
  for (const double error : map.centred_test.error) {
    if (!std::isfinite(error)) return false;
  }
  const auto [domain_u, domain_v] = map.surface.domain;
  const std::int64_t i2 = range.last_column(), j2 = range.last_row();
  if (!is_inside(domain_u, range.u, range.i1) || !is_inside(domain_u, range.u, i2)) return false;
  if (m > 0 && !(is_inside(domain_v, range.v, range.j1) && is_inside(domain_v, range.v, j2))) return false;

  const std::size_t padded = (range.columns + kStep - 1) / kStep * kStep;
  double* const s = x + padded;
  place_columns(domain_u, range, n, kLargestGrowth, padded, x, s);
  for (std::size_t c = 0; c < padded; c += kLanes)
    hn::Store(hn::Sub(hn::Load(kDoubles, x + c), hn::Load(kDoubles, s + c)), kDoubles, x + c);
  constexpr decltype(&evaluate_centred_rows<kComponents, 1>) kOf[kMaxCentredDegree] = {
      evaluate_centred_rows<kComponents, 1>, evaluate_centred_rows<kComponents, 2>,
      evaluate_centred_rows<kComponents, 3>};
  kOf[n - 1](map, range, to, x);
  return true;
}

// Correctly rounded.
template <int kComponents>
void evaluate_exact_mesh(const PreparedMap& map, const MeshRange& range, const Destination& to,
                         double* scratch) {
  if (evaluate_centred_mesh<kComponents>(map, range, to, scratch)) return;
  evaluate_rounded_mesh<kComponents>(map, range, to, scratch);
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_CENTRED_MESH_INL_H_
