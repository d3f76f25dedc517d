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

// Returns x = t - s.
inline double centred_at(const Domain& domain, const GridArgument& argument) {
  const Parameter at = locate(domain, argument);
  return at.t - at.s;
}

// The coefficients of a row: four values for each power of x, with padding that vectors may read. x^0 has
// both ends of the interval. The error of the test covers the roundings of these ends and one more, as it
// does for the sums of other tests.
template <int kDegree>
struct CentredRow {
  double power[4 * (kDegree + 1) + kLanes], high[4 + kLanes];

  // `bits_of_columns`: the largest number of fractional bits of x^degree; kManyBits if x or y are not dyadic.
  HWY_INLINE void set(const PreparedMap& map, const PreparedMap::Test& test, const GridArgument& v,
                      int bits_of_columns) {
    constexpr int kValues = 4 * (kDegree + 1);
    const int m = map.surface.degree[1];
    // The y of a curve does not matter.
    const double y_of_row = m == 0 ? 0.5 : centred_at(map.surface.domain[1], v);
    const Vector y = hn::Set(kDoubles, y_of_row);
    for (std::size_t first = 0; first < kValues; first += kLanes) {
      const double* row = map.centred + first + static_cast<std::ptrdiff_t>(m) * kValues;
      Vector sum = hn::LoadU(kDoubles, row);
      for (int j = m - 1; j >= 0; --j) {
        row -= kValues;
        sum = hn::MulAdd(sum, y, hn::LoadU(kDoubles, row));
      }
      hn::StoreU(sum, kDoubles, power + first);
    }
    // At y = -1, 0 and 1 no coefficient is rounded. Ties and zeros are frequent there.
    const bool is_exact = y_of_row == 0 || std::fabs(y_of_row) == 1;
    for (int k = 0; k < 4; ++k) {
      double error = test.error[k];
      if (is_exact && error != 0 && map.centred_bits[k] + bits_of_columns <= kExactBits) {
        error = 0;
      } else if (is_exact && error != 0 && map.centred_bits[k] <= kExactBits) {
        bool vanishes = true;
        for (int i = 0; i <= kDegree; ++i) vanishes = vanishes && power[4 * i + k] == 0;
        if (vanishes) error = 0;
      }
      high[k] = power[k] + error;
      power[k] -= error;
    }
  }
};

// A row in vectors. Computes both ends of the intervals as floats. If no operation rounds (kExact), the ends
// are equal, and only one is computed.
template <int kComponents, int kDegree, bool kExact>
class CentredCurve {
 public:
  using Values = Sequence<Doubles, kComponents>;

  HWY_INLINE CentredCurve(const CentredRow<kDegree>& row, const Values& sequence) {
    for (std::size_t part = 0; part < Values::kPeriod; ++part) {
      for (int i = 0; i <= kDegree; ++i) power_[i][part] = sequence.values_of(row.power + 4 * i, part);
      if constexpr (!kExact) high_[part] = sequence.values_of(row.high, part);
    }
  }

  HWY_INLINE void evaluate(Vector x, std::size_t part, Half* low, Half* high) const {
    Vector sum = power_[kDegree][part];
    for (int i = kDegree - 1; i > 0; --i) sum = hn::MulAdd(sum, x, power_[i][part]);
    *low = hn::DemoteTo(kHalves, hn::MulAdd(sum, x, power_[0][part]));
    *high = kExact ? *low : hn::DemoteTo(kHalves, hn::MulAdd(sum, x, high_[part]));
  }

 private:
  Vector power_[kDegree + 1][Values::kPeriod], high_[Values::kPeriod];
};

constexpr hn::RebindToUnsigned<decltype(kHalves)> kBits;
HWY_INLINE bool is_zero(Half value) {
  return hn::AllTrue(kBits, hn::Eq(hn::BitCast(kBits, value), hn::Zero(kBits)));
}

// The components that are zero along the lines x = -1, 0 and 1, as bits.
struct ZeroLines {
  explicit ZeroLines(const PreparedMap& map) {
    const auto [n, m] = map.surface.degree;
    for (int k = 0; k < map.surface.components; ++k) {
      if (map.centred_bits[k] > kExactBits) continue;
      bool zero[3] = {true, true, true};
      for (int j = 0; j <= m; ++j) {
        const double* const own = map.centred + k + 4 * (n + 1) * j;
        double even = 0, odd = 0;
        for (int i = 0; i <= n; ++i) (i % 2 == 0 ? even : odd) += own[4 * i];
        zero[0] = zero[0] && even == odd;
        zero[1] = zero[1] && own[0] == 0;
        zero[2] = zero[2] && even == -odd;
      }
      for (int line = 0; line < 3; ++line) at[line] |= static_cast<unsigned>(zero[line]) << k;
    }
  }
  unsigned of(double x) const { return x == 0 ? at[1] : x == -1 ? at[0] : x == 1 ? at[2] : 0; }

  unsigned at[3] = {};
};

// The kinds of results: intervals; intervals with exact zeros in some columns; exact numbers.
enum class Kind { kIntervals, kZeroColumns, kExact };

template <int kComponents, int kDegree, Kind kKind>
void evaluate_centred_rows(const PreparedMap& map, const PreparedMap::Test& test, const MeshRange& range,
                           const Destination& to, const double* x) {
  constexpr bool kExact = kKind == Kind::kExact, kZeros = kKind == Kind::kZeroColumns;
  constexpr std::size_t kColumns = 512, kRows = 16;  // fits into the L1 cache
  static_assert(kColumns % kLanes == 0);
  using Values = Sequence<Doubles, kComponents>;
  const Values sequence;
  HWY_ALIGN double places[kComponents * kColumns];
  HWY_ALIGN float values[kComponents * kColumns];
  HWY_ALIGN std::uint32_t unknown[kZeros ? kComponents * kColumns : 1];  // 0 for zeros, else all bits
  CentredRow<kDegree> row[kRows];
  const bool has_rows = map.surface.degree[1] != 0;
  const bool is_dyadic = has_rows && bits_of_places(map.surface.domain[1], range.v) != kManyBits;
  const int bits_of_columns =
      is_dyadic ? kDegree * bits_of_places(map.surface.domain[0], range.u) : kManyBits;
  for (std::size_t r0 = 0; r0 < range.rows; r0 += kRows) {
    const std::size_t rows = std::min(kRows, range.rows - r0);
    for (std::size_t r = 0; r < rows; ++r) row[r].set(map, test, range.v_of(r0 + r), bits_of_columns);
    for (std::size_t c0 = 0; c0 < range.columns; c0 += kColumns) {
      const std::size_t columns = std::min(kColumns, range.columns - c0), count = columns * kComponents;
      sequence.repeat(x + c0, columns, places);
      std::size_t zero_at[3 * kComponents], zeros = 0;
      if constexpr (kZeros) {
        const ZeroLines lines(map);
        std::memset(unknown, 0xFF, sizeof unknown);
        for (std::size_t c = 0; c < columns; ++c) {
          const unsigned of = lines.of(x[c0 + c]);
          for (int k = 0; of != 0 && k < kComponents; ++k) {
            if ((of >> k & 1) != 0) zero_at[zeros++] = c * kComponents + static_cast<std::size_t>(k);
          }
        }
        for (std::size_t zero = 0; zero < zeros; ++zero) unknown[zero_at[zero]] = 0;
      }
      // Returns the bits in which the ends of intervals differ. Those around known zeros do not count.
      const auto difference_of = [&](Half low, Half high, std::size_t begin) HWY_ATTR {
        const Half bits = hn::Xor(low, high);
        if constexpr (!kZeros) return bits;
        return hn::And(bits, hn::BitCast(kHalves, hn::LoadU(kBits, unknown + begin)));
      };
      for (std::size_t r = 0; r < rows; ++r) {
        const CentredCurve<kComponents, kDegree, kExact> curve(row[r], sequence);
        std::byte* const data = to.data + (r0 + r) * to.row_stride + c0 * to.stride;
        float* const out = is_packed<kComponents>(to) ? reinterpret_cast<float*>(data) : values;
        Half open = hn::Zero(kHalves);  // bits in which the ends differ
        in_vectors<kLanes, Values::kPeriod>(
            count, out, [&](std::size_t begin, std::size_t part, float* vector) HWY_ATTR {
              Half low, high;
              curve.evaluate(hn::Load(kDoubles, places + begin), part, &low, &high);
              if constexpr (!kExact) open = hn::Or(open, difference_of(low, high, begin));
              hn::StoreU(high, kHalves, vector);
            });
        // Undecided lanes are rare (one in some strips), so a strip is checked once, at its end.
        for (std::size_t begin = is_zero(open) ? count : 0; begin < count; begin += kLanes) {
          Half low, high;
          curve.evaluate(hn::Load(kDoubles, places + begin), begin / kLanes % Values::kPeriod, &low, &high);
          const Half bits = difference_of(low, high, begin);
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
        for (std::size_t zero = 0; zero < zeros; ++zero) std::memset(out + zero_at[zero], 0, sizeof(float));
        if (out == values) scatter<kComponents>(values, columns, to, data);
      }
    }
  }
}

template <int kComponents, int kDegree>
void evaluate_centred_rows_of(const PreparedMap& map, const PreparedMap::Test& test, Kind kind,
                              const MeshRange& range, const Destination& to, const double* x) {
  switch (kind) {
    case Kind::kIntervals:
      return evaluate_centred_rows<kComponents, kDegree, Kind::kIntervals>(map, test, range, to, x);
    case Kind::kZeroColumns:
      return evaluate_centred_rows<kComponents, kDegree, Kind::kZeroColumns>(map, test, range, to, x);
    case Kind::kExact:
      return evaluate_centred_rows<kComponents, kDegree, Kind::kExact>(map, test, range, to, x);
  }
}

// Evaluates meshes of maps of low degree inside the domain. Returns false, and does nothing, for others.
template <int kComponents>
bool evaluate_centred_mesh(const PreparedMap& map, const MeshRange& range, const Destination& to, double* x) {
  const auto [n, m] = map.surface.degree;
  if (n == 0 || map.centred == nullptr) return false;
  // The ends of intervals are compared as bits, and NaNs could be equal. (If the first and last column are
  // sure, all columns are.)
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
  // Without roundings an interval is one number.
  PreparedMap::Test test = map.centred_test;
  bool is_exact = true;
  const int bits_of_arguments =
      n * bits_of_places(domain_u, range.u) + (m == 0 ? 0 : m * bits_of_places(domain_v, range.v));
  for (int k = 0; k < kComponents; ++k) {
    if (map.centred_bits[k] + bits_of_arguments <= kExactBits) test.error[k] = 0;
    is_exact = is_exact && test.error[k] == 0;
  }
  constexpr decltype(&evaluate_centred_rows_of<kComponents, 1>) kOf[kMaxCentredDegree] = {
      evaluate_centred_rows_of<kComponents, 1>, evaluate_centred_rows_of<kComponents, 2>,
      evaluate_centred_rows_of<kComponents, 3>};
  Kind kind = is_exact ? Kind::kExact : Kind::kIntervals;
  // In other grids, a column whose x is rounded to -1, 0 or 1 need not lie on that line.
  if (!is_exact && spans(range.u, domain_u)) {
    const auto [first, middle, last] = ZeroLines(map).at;
    if ((first | middle | last) != 0) kind = Kind::kZeroColumns;
  }
  kOf[n - 1](map, test, kind, range, to, x);
  return true;
}

// Evaluates a mesh with correctly rounded results.
template <int kComponents>
void evaluate_exact_mesh(const PreparedMap& map, const MeshRange& range, const Destination& to,
                         double* scratch) {
  if (evaluate_centred_mesh<kComponents>(map, range, to, scratch)) return;
  evaluate_rounded_mesh<kComponents>(map, range, to, scratch);
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_CENTRED_MESH_INL_H_
