// Rows of maps of low degree inside their domain, in powers of x = t - s along u and y along v. The values of
// a column are a curve in y, so each row is evaluated by Horner's rule in y, with one value in each lane.
// Used for meshes and for arrays of patches, correctly rounded or with GLEV_FAST.
#if defined(GLEVALUATOR_CENTRED_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_CENTRED_INL_H_
#undef GLEVALUATOR_CENTRED_INL_H_
#else
#define GLEVALUATOR_CENTRED_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "kernels.h"
#include "mutation_point.h"
#include "prepared_map.h"
#include "vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

// The values of a strip of columns in one row. Five arrays of doubles fit into the L1 cache.
constexpr std::size_t kMostPositions = 512;

// Curves in y, one at each position of a strip, with padding that vectors may read and write. If `Real` is
// double, the coefficient of y^0 also has both ends of the interval of the rounding test. The error of the
// test covers the roundings of these ends and one more, as it does for the sums of other tests.
template <class Real>
struct Strip {
  static constexpr std::size_t kPadding = 16;
  static constexpr std::size_t kSize = kMostPositions + kPadding;
  HWY_ALIGN Real power[kMaxCentredDegree + 1][kSize];
  HWY_ALIGN Real low[kSize], high[kSize];

  // Clears the padding behind `count` positions.
  HWY_INLINE void clear(std::size_t count) {
    constexpr hn::CappedTag<Real, 16> kTag;
    for (Real* const values : {power[0], power[1], power[2], power[3], low, high}) {
      for (std::size_t p = count; p < count + kPadding; p += hn::MaxLanes(kTag))
        hn::StoreU(hn::Zero(kTag), kTag, values + p);
    }
  }
};

// The number of lanes of the vectors of results.
template <class Real>
constexpr std::size_t kMostLanes = 64 / sizeof(Real);

// Returns true if the ends of intervals that differ in these bits are equal.
template <class Results>
HWY_INLINE bool are_zero(Results bits) {
  constexpr hn::RebindToUnsigned<hn::DFromV<Results>> kBits;
  return hn::AllTrue(kBits, hn::Eq(hn::BitCast(kBits, bits), hn::Zero(kBits)));
}
// Calls resolve(position) for the lanes with bits, from position `begin` on, and stores the results at `to`.
template <class Results, class Resolver>
HWY_INLINE void resolve_lanes(Results bits, std::size_t begin, std::size_t count, float* to,
                              const Resolver& resolve) {
  constexpr hn::RebindToUnsigned<hn::DFromV<Results>> kBits;
  std::uint32_t is_open[hn::MaxLanes(kBits)];
  hn::StoreU(hn::BitCast(kBits, bits), kBits, is_open);
  for (std::size_t i = begin; i < std::min(begin + hn::MaxLanes(kBits), count); ++i) {
    if (is_open[i - begin] == 0) continue;
    const float result = resolve(i);
    std::memcpy(to + i, &result, sizeof result);  // the caller's memory need not be aligned
  }
}

// Evaluates kRows rows of at least one vector of positions, as floats. The results are ends of intervals or,
// without kIntervals, sums. Returns true if both ends of all intervals round to the same float.
template <class Real, bool kIntervals, int kDegree, int kRows>
bool evaluate_rows(const Strip<Real>& strip, std::size_t count, const double* y, float* const* to) {
  constexpr hn::CappedTag<Real, kMostLanes<Real>> kTag;
  constexpr hn::Rebind<float, decltype(kTag)> kResults;
  constexpr std::size_t kWidth = hn::MaxLanes(kTag);
  using Values = hn::Vec<decltype(kTag)>;
  using Results = hn::Vec<decltype(kResults)>;
  Values place[kRows];
  for (int r = 0; r < kRows; ++r) place[r] = hn::Set(kTag, static_cast<Real>(y[r]));
  Results open = hn::Zero(kResults);  // bits in which the ends differ
  const auto evaluate = [&](std::size_t p) HWY_ATTR {
    for (int r = 0; r < kRows; ++r) {
      Values sum = hn::LoadU(kTag, strip.power[kDegree] + p);
      for (int j = kDegree - 1; j > 0; --j)
        sum = hn::MulAdd(sum, place[r], hn::LoadU(kTag, strip.power[j] + p));
      const auto end = [&](const Real* first) HWY_ATTR {
        Values value = hn::LoadU(kTag, first + p);
        if constexpr (kDegree > 0) value = hn::MulAdd(sum, place[r], value);
        if constexpr (sizeof(Real) == sizeof(double)) {
          return hn::DemoteTo(kResults, value);
        } else {
          return value;
        }
      };
      const Results value = end(kIntervals ? strip.high : strip.power[0]);
      if constexpr (kIntervals) open = hn::Or(open, hn::Xor(value, end(strip.low)));
      hn::StoreU(value, kResults, to[r] + p);
    }
  };
  std::size_t p = 0;
  for (; p + kWidth <= count; p += kWidth) evaluate(p);
  if (GLEV_AT(has_rest, p < count)) evaluate(count - kWidth);
  return !kIntervals || are_zero(open);
}

template <class Real>
using EvaluatesRows = bool (*)(const Strip<Real>& strip, std::size_t count, const double* y,
                               float* const* to);
// Returns the function for `rows` rows, 1 or 2, of curves of degree m.
template <class Real, bool kIntervals>
EvaluatesRows<Real> rows_function(int m, std::size_t rows) {
  static constexpr EvaluatesRows<Real> kOf[2][kMaxCentredDegree + 1] = {
      {evaluate_rows<Real, kIntervals, 0, 1>, evaluate_rows<Real, kIntervals, 1, 1>,
       evaluate_rows<Real, kIntervals, 2, 1>, evaluate_rows<Real, kIntervals, 3, 1>},
      {evaluate_rows<Real, kIntervals, 0, 2>, evaluate_rows<Real, kIntervals, 1, 2>,
       evaluate_rows<Real, kIntervals, 2, 2>, evaluate_rows<Real, kIntervals, 3, 2>}};
  return kOf[rows - 1][m];
}

// Calls resolve(position) for each undecided position of a row, and stores the results at `to`. place_at()
// returns the places of the curves at a position. Curves repeat after `period` positions.
template <class PlaceAt, class Resolver>
HWY_NOINLINE void resolve_row(const Strip<double>& strip, std::size_t period, int degree, std::size_t count,
                              const PlaceAt& place_at, float* to, const Resolver& resolve) {
  for (std::size_t p = 0, own = 0; p < count; p += kLanes, own = own + kLanes == period ? 0 : own + kLanes) {
    const Vector place = place_at(p);
    Vector sum = hn::LoadU(kDoubles, strip.power[degree] + own);
    for (int j = degree - 1; j > 0; --j)
      sum = hn::MulAdd(sum, place, hn::LoadU(kDoubles, strip.power[j] + own));
    const auto end = [&](const double* first) HWY_ATTR {
      const Vector value = hn::LoadU(kDoubles, first + own);
      return hn::DemoteTo(kHalves, degree == 0 ? value : hn::MulAdd(sum, place, value));
    };
    const Half bits = hn::Xor(end(strip.low), end(strip.high));
    if (HWY_UNLIKELY(!are_zero(bits))) resolve_lanes(bits, p, count, to, resolve);
  }
}
// Same for curves in y, which do not repeat.
template <class Resolver>
void resolve_row(const Strip<double>& strip, int m, std::size_t count, double y, float* to,
                 const Resolver& resolve) {
  const auto place_at = [&](std::size_t) HWY_ATTR { return hn::Set(kDoubles, y); };
  resolve_row(strip, Strip<double>::kSize, m, count, place_at, to, resolve);
}

inline void narrow(const Strip<double>& strip, int m, std::size_t count, Strip<float>* to) {
  for (int j = 0; j <= m; ++j) {
    for (std::size_t p = 0; p < count; p += kLanes)
      hn::StoreU(hn::DemoteTo(kHalves, hn::LoadU(kDoubles, strip.power[j] + p)), kHalves, to->power[j] + p);
  }
}

// Ties and zeros are frequent at the ends, in the middle and in the quarters of a direction, where Horner's
// rule does not round the values of most maps. Returns true there; x is in [-1,1].
inline bool is_line(double x) {
  constexpr double kMagic = 0x1.8p52;  // rounds 2x to an integer
  return 2 * x + kMagic - kMagic == 2 * x;
}
// The numbers of the columns or rows of a part that are on lines.
struct Lines {
  std::size_t count = 0, at[5];

  // Finds the lines among the columns or rows from `first` on of a grid that spans the domain.
  void find(const Grid& grid, std::int64_t first, std::size_t columns) {
    count = 0;
    for (std::int64_t quarter = 0; quarter <= 4; ++quarter) {
      const std::int64_t part = quarter * grid.segments, column = part / 4 - first;
      if (part % 4 == 0 && column >= 0 && column < static_cast<std::int64_t>(columns))
        at[count++] = static_cast<std::size_t>(column);
    }
  }
};
// Bits of the powers of x and y along lines.
constexpr int bits_along_lines(int n, int m) { return n + m; }

// Computes x of the points of a grid from `first` on, inside the domain.
HWY_INLINE void place_points(const Domain& domain, const Grid& grid, std::int64_t first, std::size_t count,
                             double* x) {
  if (!spans(grid, domain)) {
    for (std::size_t i = 0; i < count; ++i) {
      const Parameter at = locate(domain, GridArgument{grid, first + static_cast<std::int64_t>(i)});
      x[i] = at.t - at.s;
    }
    return;
  }
  // The inverse of a power of two is exact, so the product has the bits of the quotient.
  const bool has_inverse = GLEV_AT(has_inverse, std::has_single_bit(static_cast<unsigned>(grid.segments)));
  const Vector segments = hn::Set(kDoubles, grid.segments), inverse = hn::Set(kDoubles, 1.0 / grid.segments);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Vector index = hn::Iota(kDoubles, static_cast<double>(first) + static_cast<double>(i)),
                 numerator = hn::Sub(hn::Add(index, index), segments);
    hn::StoreU(has_inverse ? hn::Mul(numerator, inverse) : hn::Div(numerator, segments), kDoubles, x + i);
  }
}

// The arithmetic of the rows of a mesh: intervals, doubles that no operation rounds, or floats.
enum class Method { kIntervals, kExact, kFast };
// The largest number of positions that evaluate_strip() writes at least, and that of a method.
constexpr std::size_t kFewestPositions = hn::MaxLanes(hn::CappedTag<float, kMostLanes<float>>());
constexpr std::size_t fewest_positions(Method method) {
  return method == Method::kFast ? kFewestPositions
                                 : hn::MaxLanes(hn::CappedTag<double, kMostLanes<double>>());
}

// The rows of a part of a mesh.
struct Rows {
  // Each part computes the curves of the columns again, so a part has room for the 129 rows of 128 segments.
  // place_points() writes whole vectors, so this is a multiple of kLanes.
  static constexpr std::size_t kMost = 136;
  std::size_t count;
  HWY_ALIGN double y[kMost];
  // Rows that are correctly rounded with a test of their own: those on lines, whose intervals are tighter,
  // or, with GLEV_FAST, those on the boundary.
  Lines own;

  // Chooses the first and the last row if they are on the boundary.
  void choose_ends(bool has_first, bool has_last) {
    own.count = 0;
    if (has_first) own.at[own.count++] = 0;
    if (has_last) own.at[own.count++] = count - 1;
  }
};

// Evaluates the rows of a strip with `count` values per row. Source computes curves of degree m: compute()
// those of the strip, and round_row() evaluates a row that has its own rounding test. Sink stores rows:
// begin() returns their memory, and end() is called after each row; resolve() returns a value that its
// interval does not decide; set_columns() replaces the values of a row in float that are on the boundary by
// those that are correctly rounded. Adjacent patches then meet without a crack, because points on the
// boundary depend only on the exact value.
template <class Source, class Sink>
HWY_NOINLINE void evaluate_strip(const Source& source, Method method, int m, const Rows& rows,
                                 std::size_t count, Sink& sink) {
  Strip<double> strip;
  Strip<float> fast;
  const std::size_t padded = std::max(count, fewest_positions(method));
  if (count < padded) strip.clear(count);
  source.compute(method == Method::kIntervals, &strip);
  if (method == Method::kFast) narrow(strip, m, padded, &fast);
  for (std::size_t r = 0, next = 0, own = 0; r < rows.count; r += next) {
    const std::size_t next_own = own < rows.own.count ? rows.own.at[own] : rows.count;
    next = r == next_own || r + 1 == next_own ? 1 : 2;
    float* to[2];
    sink.begin(r, next, to);
    if (r == next_own) {
      ++own;
      source.round_row(rows.y[r], to[0], [&](std::size_t p) { return sink.resolve(r, p); });
    } else if (method == Method::kIntervals) {
      const bool is_settled = rows_function<double, true>(m, next)(strip, padded, rows.y + r, to);
      for (std::size_t i = 0; i < next && HWY_UNLIKELY(!is_settled); ++i)
        resolve_row(strip, m, count, rows.y[r + i], to[i],
                    [&](std::size_t p) { return sink.resolve(r + i, p); });
    } else if (method == Method::kExact) {
      rows_function<double, false>(m, next)(strip, padded, rows.y + r, to);
    } else {
      rows_function<float, false>(m, next)(fast, padded, rows.y + r, to);
      for (std::size_t i = 0; i < next; ++i) sink.set_columns(r + i, to[i]);
    }
    for (std::size_t i = 0; i < next; ++i) sink.end(r + i, to[i]);
  }
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_CENTRED_INL_H_
