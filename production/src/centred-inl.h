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
  constexpr EvaluatesRows<Real> kOf[2][kMaxCentredDegree + 1] = {
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
// rule does not round the values of most maps.
inline bool is_line(double x) {
  const double twice = 2 * std::fabs(x);
  return twice == 0 || twice == 1 || twice == 2;
}
// The numbers of the columns of a strip that are on lines.
struct Lines {
  std::size_t count = 0, at[5];

  // Finds the lines among the columns from `first` on of a grid that spans the domain.
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
  const Vector segments = hn::Set(kDoubles, grid.segments);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Vector index = hn::Iota(kDoubles, static_cast<double>(first) + static_cast<double>(i));
    hn::StoreU(hn::Div(hn::Sub(hn::Add(index, index), segments), segments), kDoubles, x + i);
  }
}

// The arithmetic of the rows of a mesh: intervals, doubles that no operation rounds, or floats.
enum class Method { kIntervals, kExact, kFast };
// The number of positions that evaluate_strip() writes at least.
constexpr std::size_t kFewestPositions = hn::MaxLanes(hn::CappedTag<float, 16>());

// The rows of a part of a mesh.
struct Rows {
  // Each part computes the curves of the columns again, so a part has room for the 129 rows of 128 segments.
  // place_points() writes whole vectors, so this is a multiple of kLanes.
  static constexpr std::size_t kMost = 136;
  std::size_t count;
  HWY_ALIGN double y[kMost];
  bool has_own_test[kMost];       // correctly rounded, with a rounding test of their own
  bool has_own_edge_test[kMost];  // same for the edges of rows in float

  // Chooses the tests: rows along lines have tighter intervals of their own, unless nothing is rounded. With
  // GLEV_FAST, rows on the boundary are correctly rounded; `has_first` and `has_last`: the first and last row
  // are.
  void set(bool has_lines, Method method, bool has_first, bool has_last) {
    for (std::size_t r = 0; r < count; ++r) {
      const bool is_on_line = has_lines && is_line(y[r]), is_fast = method == Method::kFast;
      has_own_test[r] = is_fast ? (has_first && r == 0) || (has_last && r + 1 == count) : is_on_line;
      has_own_edge_test[r] = is_on_line;
    }
  }
};

// Evaluates the rows of a strip with `count` values per row. Source computes curves of degree m: compute()
// those of the strip, and compute_row() those of degree 0 of a row that has its own rounding test. Sink
// stores rows: begin() returns their memory, and end() is called after each row; resolve() returns a value
// that its interval does not decide; the values of a column are a multiple of unit(). With GLEV_FAST, `edges`
// are the first and last column if these are on the boundary. They are correctly rounded: adjacent patches
// then meet without a crack, because points on the boundary depend only on the exact value.
template <class Source, class Sink>
HWY_NOINLINE void evaluate_strip(const Source& source, const Source& edges, bool has_first, Method method,
                                 int m, const Rows& rows, std::size_t count, Sink& sink) {
  Strip<double> strip, own, edge;
  Strip<float> fast;
  HWY_ALIGN float edge_values[2][2 * 4 * kPatchLanes + kFewestPositions];
  const std::size_t padded = std::max(count, kFewestPositions), width = count / source.columns,
                    edge_count = edges.columns * width, padded_edge = std::max(edge_count, kLanes);
  if (count < padded) strip.clear(count), own.clear(count);
  source.compute(method == Method::kIntervals, &strip);
  if (method == Method::kFast) narrow(strip, m, padded, &fast);
  if (edge_count != 0) {
    if (edge_count < padded_edge) edge.clear(edge_count), own.clear(edge_count);
    edges.compute(true, &edge);
  }
  // Evaluates one or two rows, correctly rounded.
  const auto round = [&](const Source& from, const Strip<double>& curves, bool is_single, std::size_t r,
                         std::size_t next, std::size_t values, std::size_t padded_values, float* const* to,
                         const auto& position) HWY_ATTR {
    bool is_settled;
    if (is_single) {
      from.compute_row(rows.y[r], &own);
      is_settled = evaluate_rows<double, true, 0, 1>(own, padded_values, rows.y + r, to);
    } else {
      is_settled = rows_function<double, true>(m, next)(curves, padded_values, rows.y + r, to);
    }
    for (std::size_t i = 0; i < next && HWY_UNLIKELY(!is_settled); ++i) {
      resolve_row(is_single ? own : curves, is_single ? 0 : m, values, rows.y[r + i], to[i],
                  [&](std::size_t p) { return sink.resolve(r + i, position(p)); });
    }
  };
  for (std::size_t r = 0, next = 0; r < rows.count; r += next) {
    const auto is_single = [&](std::size_t i) { return rows.has_own_test[i] || rows.has_own_edge_test[i]; };
    next = is_single(r) || r + 1 == rows.count || is_single(r + 1) ? 1 : 2;
    float* to[2];
    sink.begin(r, next, to);
    if (rows.has_own_test[r] || method == Method::kIntervals) {
      round(source, strip, rows.has_own_test[r], r, next, count, padded, to, [](std::size_t p) { return p; });
    } else if (method == Method::kExact) {
      rows_function<double, false>(m, next)(strip, padded, rows.y + r, to);
    } else {
      rows_function<float, false>(m, next)(fast, padded, rows.y + r, to);
      if (edge_count != 0) {
        float* const ends[2] = {edge_values[0], edge_values[1]};
        const auto position = [&](std::size_t p) {
          return has_first && p < width ? p : count - width + p % width;
        };
        round(edges, edge, rows.has_own_edge_test[r], r, next, edge_count, padded_edge, ends, position);
        for (std::size_t i = 0; i < next; ++i) {
          for (std::size_t p = 0; p < edge_count; p += sink.unit())
            std::memcpy(to[i] + position(p), ends[i] + p, sink.unit() * sizeof(float));
        }
      }
    }
    for (std::size_t i = 0; i < next; ++i) sink.end(r + i, to[i]);
  }
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_CENTRED_INL_H_
