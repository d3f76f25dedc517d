// Meshes of low degree inside their domain, in powers of x = t - s and y, correctly rounded or with
// GLEV_FAST.
#if defined(GLEVALUATOR_CENTRED_MESH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_CENTRED_MESH_INL_H_
#undef GLEVALUATOR_CENTRED_MESH_INL_H_
#else
#define GLEVALUATOR_CENTRED_MESH_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>

#include "centred-inl.h"
#include "mesh-inl.h"
#include "mutation_point.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {

// Computes the curves of columns from the coefficients of x^i y^j, in the layout of PreparedMap::centred.
template <int kDegree>
void compute_curves(const double* centred, int m, int components, const double* x, std::size_t columns,
                    Strip<double>* strip) {
  constexpr std::size_t kWidth = hn::MaxLanes(kFour);
  const std::size_t parts = (static_cast<std::size_t>(components) + kWidth - 1) / kWidth;
  for (int j = 0; j <= m; ++j, centred += 4 * (kDegree + 1)) {
    double* to = strip->power[j];
    for (std::size_t c = 0; c < columns; ++c, to += components) {
      const FourVector place = hn::Set(kFour, x[c]);
      for (std::size_t part = 0; part < parts; ++part) {
        const double* const own = centred + part * kWidth;
        FourVector sum = hn::LoadU(kFour, own + 4 * kDegree);
        for (int i = kDegree - 1; i >= 0; --i) sum = hn::MulAdd(sum, place, hn::LoadU(kFour, own + 4 * i));
        // The values behind the last component are overwritten by the next column.
        hn::StoreU(sum, kFour, to + part * kWidth);
      }
    }
  }
}

// The curves of some columns of a map.
struct MeshCurves {
  const PreparedMap& map;
  PreparedMap::Test test;
  unsigned is_short;              // components that Horner's rule does not round along lines, as bits
  bool has_lines_u, has_lines_v;  // the grid spans the domain, so x or y is exact on lines
  const double* x = nullptr;
  std::size_t columns = 0;
  Lines lines = {};

  // Chooses columns, from number `first` of the grid on.
  HWY_INLINE void choose(const double* places, const Grid& grid, std::int64_t first, std::size_t count) {
    x = places;
    columns = count;
    lines.count = 0;
    if (has_lines_u && is_short != 0) lines.find(grid, first, columns);
  }
  // Chooses columns that are lines if there are any.
  HWY_INLINE void choose_lines(const double* places, std::size_t count) {
    x = places;
    columns = count;
    lines.count = has_lines_u && is_short != 0 ? count : 0;
    for (std::size_t i = 0; i < lines.count; ++i) lines.at[i] = i;
  }

  HWY_INLINE void compute(bool has_ends, Strip<double>* strip) const {
    compute_powers(map.centred, map.surface.degree[1], strip);
    if (has_ends) set_ends(test, is_short, map.surface.degree[1], strip);
  }

  HWY_INLINE void compute_row(double y, Strip<double>* strip) const {
    const Row row = row_at(y);
    compute_powers(row.power, 0, strip);
    set_ends(row.test, row.is_short, 0, strip);
  }

  // A row as a map of degree 0 in v, in the layout of PreparedMap::centred. Components that are exact
  // constants have no error.
  struct Row {
    HWY_ALIGN double power[4 * (kMaxCentredDegree + 1)];
    PreparedMap::Test test;
    unsigned is_short;
  };
  HWY_INLINE Row row_at(double y) const {
    constexpr std::size_t kWidth = hn::MaxLanes(kFour);
    const auto [n, m] = map.surface.degree;
    const auto values = static_cast<std::size_t>(4 * (n + 1));
    Row row;
    for (std::size_t first = 0; first < values; first += kWidth) {
      const double* from = map.centred + first + static_cast<std::size_t>(m) * values;
      FourVector sum = hn::LoadU(kFour, from);
      for (int j = m - 1; j >= 0; --j) {
        from -= values;
        sum = hn::MulAdd(sum, hn::Set(kFour, y), hn::LoadU(kFour, from));
      }
      hn::Store(sum, kFour, row.power + first);
    }
    row.test = test;
    row.is_short = has_lines_v && is_line(y) ? is_short : 0;
    for (int k = 0; k < map.surface.components && row.is_short != 0; ++k) {
      bool is_constant = (row.is_short >> k & 1) != 0;
      for (int i = 1; i <= n; ++i) is_constant = is_constant && row.power[4 * i + k] == 0;
      if (is_constant) row.test.error[static_cast<std::size_t>(k)] = 0;
    }
    return row;
  }

 private:
  HWY_INLINE void compute_powers(const double* centred, int m, Strip<double>* strip) const {
    constexpr decltype(&compute_curves<1>) kOf[kMaxCentredDegree] = {compute_curves<1>, compute_curves<2>,
                                                                     compute_curves<3>};
    kOf[map.surface.degree[0] - 1](centred, m, map.surface.components, x, columns, strip);
  }

  // Computes the ends of intervals around the coefficients of y^0. Curves that are exact constants have none.
  HWY_INLINE void set_ends(const PreparedMap::Test& own, unsigned is_short_here, int m,
                           Strip<double>* strip) const {
    const auto components = static_cast<std::size_t>(map.surface.components);
    for (std::size_t c = 0; c < columns; ++c) {
      for (std::size_t part = 0; part < 4; part += hn::MaxLanes(kFour)) {
        const std::size_t p = c * components + part;
        const FourVector value = hn::LoadU(kFour, strip->power[0] + p),
                         error = hn::LoadU(kFour, &own.error[part]);
        hn::StoreU(hn::Sub(value, error), kFour, strip->low + p);
        hn::StoreU(GLEV_AT(upper_ends, hn::Add(value, error)), kFour, strip->high + p);
      }
    }
    for (std::size_t line = 0; line < lines.count && is_short_here != 0; ++line) {
      for (std::size_t k = 0; k < components; ++k) {
        const std::size_t p = lines.at[line] * components + k;
        bool is_constant = (is_short_here >> k & 1) != 0;
        for (int j = 1; j <= m; ++j) is_constant = is_constant && strip->power[j][p] == 0;
        if (is_constant) strip->low[p] = strip->high[p] = strip->power[0][p];
      }
    }
  }
};

// Columns of a strip of a large mesh, of which only x is in memory.
constexpr std::size_t kMostWideColumns = 512, kMostWideValues = 4 * kMostWideColumns;

// Stores rows, and resolves their values.
struct MeshSink {
  const PreparedMap& map;
  const MeshRange& range;
  const Destination& to;
  std::size_t components;
  MeshSink(const PreparedMap& its_map, const MeshRange& its_range, const Destination& its_to)
      : map(its_map),
        range(its_range),
        to(its_to),
        components(static_cast<std::size_t>(map.surface.components)) {}

  std::size_t first_row = 0, first_column = 0, columns = 0;
  bool is_direct = false;
  HWY_ALIGN float values[2][kMostWideValues + kFewestPositions];

  std::size_t unit() const { return components; }
  std::byte* data_of(std::size_t r) const {
    return to.data + (first_row + r) * to.row_stride + first_column * to.stride;
  }
  void begin(std::size_t r, std::size_t rows, float** row) {
    for (std::size_t i = 0; i < rows; ++i)
      row[i] = is_direct ? reinterpret_cast<float*>(data_of(r + i)) : values[i];
  }
  void end(std::size_t r, const float* row) const {
    if (!is_direct) scatter(components, row, columns, to, data_of(r));
  }
  float resolve(std::size_t r, std::size_t p) const {
    return glev::resolve(map, static_cast<int>(p % components), range.u_of(first_column + p / components),
                         range.v_of(first_row + r));
  }
};

template <class Real>
constexpr std::size_t kWideLanes = hn::MaxLanes(hn::CappedTag<Real, kMostLanes<Real>>());
// The number of vectors after which the order of components repeats.
template <class Real>
constexpr std::size_t wide_period(std::size_t components) {
  return components / std::gcd(components, kWideLanes<Real>);
}

// Evaluates a row by Horner's rule in x. `row` has the coefficients of x^i of kPeriod vectors, and `x` that
// of each position. The results are ends of intervals; floats have none. Returns true if both ends of all
// intervals round to the same float.
template <class Real, int kDegree, std::size_t kPeriod>
bool evaluate_wide_row(const Strip<Real>& row, const Real* x, std::size_t count, float* to) {
  constexpr bool kIntervals = sizeof(Real) == sizeof(double);
  constexpr hn::CappedTag<Real, kMostLanes<Real>> kTag;
  constexpr hn::Rebind<float, decltype(kTag)> kResults;
  constexpr std::size_t kWidth = kWideLanes<Real>;
  using Values = hn::Vec<decltype(kTag)>;
  using Results = hn::Vec<decltype(kResults)>;
  Values power[kDegree + 1][kPeriod], first[2][kPeriod];
  for (std::size_t part = 0; part < kPeriod; ++part) {
    for (int i = 0; i <= kDegree; ++i) power[i][part] = hn::Load(kTag, row.power[i] + part * kWidth);
    first[0][part] = kIntervals ? hn::Load(kTag, row.low + part * kWidth) : power[0][part];
    first[1][part] = kIntervals ? hn::Load(kTag, row.high + part * kWidth) : power[0][part];
  }
  // Returns the bits in which the ends differ.
  const auto evaluate = [&](std::size_t p, std::size_t part, Results* value) HWY_ATTR {
    const Values place = hn::Load(kTag, x + p);
    Values sum = power[kDegree][part];
    for (int i = kDegree - 1; i > 0; --i) sum = hn::MulAdd(sum, place, power[i][part]);
    const Values high = hn::MulAdd(sum, place, first[1][part]);
    if constexpr (kIntervals) {
      *value = hn::DemoteTo(kResults, high);
      return hn::Xor(*value, hn::DemoteTo(kResults, hn::MulAdd(sum, place, first[0][part])));
    } else {
      *value = high;
      return hn::Zero(kResults);
    }
  };
  Results open = hn::Zero(kResults), value;
  std::size_t p = 0;
  while (p + kPeriod * kWidth <= count) {
    for (std::size_t part = 0; part < kPeriod; ++part, p += kWidth) {
      open = hn::Or(open, evaluate(p, part, &value));
      hn::StoreU(value, kResults, to + p);
    }
  }
  for (std::size_t part = 0; p < count; ++part, p += kWidth) {
    float last[kWidth];
    open = hn::Or(open, evaluate(p, part, &value));
    hn::StoreU(value, kResults, last);
    std::memcpy(to + p, last, std::min(kWidth, count - p) * sizeof(float));
  }
  return !kIntervals || are_zero(open);
}

template <class Real>
using EvaluatesWideRow = bool (*)(const Strip<Real>& row, const Real* x, std::size_t count, float* to);
template <class Real, std::size_t kComponents>
constexpr std::array<EvaluatesWideRow<Real>, kMaxCentredDegree> wide_row_functions() {
  constexpr std::size_t kPeriod = wide_period<Real>(kComponents);
  return {evaluate_wide_row<Real, 1, kPeriod>, evaluate_wide_row<Real, 2, kPeriod>,
          evaluate_wide_row<Real, 3, kPeriod>};
}
// Returns the function for rows of curves of degree n.
template <class Real>
EvaluatesWideRow<Real> wide_row_function(int n, std::size_t components) {
  constexpr std::array<EvaluatesWideRow<Real>, kMaxCentredDegree> kOf[] = {
      wide_row_functions<Real, 1>(), wide_row_functions<Real, 2>(), wide_row_functions<Real, 3>(),
      wide_row_functions<Real, 4>()};
  return kOf[components - 1][static_cast<std::size_t>(n) - 1];
}

// Computes the coefficients of a row of curves of degree n for evaluate_wide_row().
template <class Real>
HWY_INLINE void repeat_row(const MeshCurves::Row& row, int n, std::size_t components, Strip<Real>* strip) {
  const auto repeat = [&](FourVector value, std::size_t part, Real* to) HWY_ATTR {
    for (std::size_t c = 0; c < kWideLanes<Real>; ++c) {
      // The values behind the last component are overwritten by the next column.
      if constexpr (sizeof(Real) == sizeof(double)) {
        hn::StoreU(value, kFour, to + c * components + part);
      } else {
        hn::StoreU(hn::DemoteTo(kFourFloats, value), kFourFloats, to + c * components + part);
      }
    }
  };
  for (std::size_t part = 4; part-- > 0;) {
    if (part % hn::MaxLanes(kFour) != 0) continue;
    for (int i = 0; i <= n; ++i) repeat(hn::Load(kFour, row.power + 4 * i + part), part, strip->power[i]);
    if constexpr (sizeof(Real) == sizeof(double)) {
      const FourVector value = hn::Load(kFour, row.power + part),
                       error = hn::LoadU(kFour, &row.test.error[part]);
      repeat(hn::Sub(value, error), part, strip->low);
      repeat(hn::Add(value, error), part, strip->high);
    }
  }
}

// Repeats the x of each column for each component.
template <class Real>
HWY_INLINE void repeat_places(const double* x, std::size_t columns, std::size_t components, Real* to) {
  constexpr hn::CappedTag<Real, 4> kTag;
  for (std::size_t c = 0; c < columns; ++c, to += components) {
    for (std::size_t k = 0; k < components; k += hn::MaxLanes(kTag))
      hn::StoreU(hn::Set(kTag, static_cast<Real>(x[c])), kTag, to + k);
  }
}

// Evaluates the rows of a strip of a large mesh, one by one, as curves in x: the curves of all columns would
// take too long if a range has few rows. `special`: the columns, with the numbers `at`, that have the tests
// of curves in y, because they are on lines or on the boundary.
HWY_NOINLINE inline void evaluate_wide_strip(const MeshCurves& curves, const MeshCurves& special,
                                             const std::size_t* at, bool is_fast, const Rows& rows,
                                             MeshSink& sink) {
  const auto [n, m] = curves.map.surface.degree;
  const std::size_t components = sink.components, count = curves.columns * components,
                    special_count = special.columns * components, padded = std::max(special_count, kLanes);
  const auto evaluate = wide_row_function<double>(n, components);
  const auto evaluate_fast = wide_row_function<float>(n, components);
  HWY_ALIGN double places[kMostWideValues + kFewestPositions];
  HWY_ALIGN float fast_places[kMostWideValues + kFewestPositions];
  Strip<double> strip, row, own;
  Strip<float> fast_row;
  const auto repeat = [&](auto* to) HWY_ATTR {
    repeat_places(curves.x, curves.columns, components, to);
    // The values of special columns are replaced. They must not be undecided.
    for (std::size_t i = 0; i < special.columns; ++i) std::fill_n(to + at[i] * components, components, 0.3F);
    std::fill_n(to + count, kFewestPositions, 0.3F);
  };
  if (is_fast) repeat(fast_places);
  if (!is_fast || rows.has_own_test[0] || rows.has_own_test[rows.count - 1]) repeat(places);
  if (special_count != 0) {
    special.compute(true, &strip);
    strip.clear(special_count), own.clear(special_count);
  }
  for (std::size_t r = 0; r < rows.count; ++r) {
    const auto resolve = [&](std::size_t p) { return sink.resolve(r, p); };
    const MeshCurves::Row values = curves.row_at(rows.y[r]);
    float* to;
    sink.begin(r, 1, &to);
    if (is_fast && !rows.has_own_test[r]) {
      repeat_row(values, n, components, &fast_row);
      evaluate_fast(fast_row, fast_places, count, to);
    } else {
      repeat_row(values, n, components, &row);
      if (HWY_UNLIKELY(!evaluate(row, places, count, to))) {
        const auto place_at = [&](std::size_t p) HWY_ATTR { return hn::Load(kDoubles, places + p); };
        resolve_row(row, wide_period<double>(components) * kLanes, n, count, place_at, to, resolve);
      }
    }
    if (special_count != 0) {
      float ends[8 * 4 + kFewestPositions];
      float* const to_ends[1] = {ends};
      const auto position = [&](std::size_t p) { return at[p / components] * components + p % components; };
      const bool is_on_line = rows.has_own_edge_test[r];
      if (is_on_line) special.compute_row(rows.y[r], &own);
      const bool is_settled = is_on_line
                                  ? evaluate_rows<double, true, 0, 1>(own, padded, rows.y + r, to_ends)
                                  : rows_function<double, true>(m, 1)(strip, padded, rows.y + r, to_ends);
      if (HWY_UNLIKELY(!is_settled))
        resolve_row(is_on_line ? own : strip, is_on_line ? 0 : m, special_count, rows.y[r], ends,
                    [&](std::size_t p) { return resolve(position(p)); });
      for (std::size_t p = 0; p < special_count; p += components)
        std::memcpy(to + position(p), ends + p, components * sizeof(float));
    }
    sink.end(r, to);
  }
}

// Evaluates meshes of maps of low degree inside the domain, with `fast` in float. Returns false, and does
// nothing, for other meshes. `x`: scratch memory.
//
// In units of 2^-24 max|R|, the errors with `fast` are 2.5 of coefficients, whose magnitudes have a sum of at
// most 2.5 max|R|, 3 of y, and 7.5 of the sums, or twice that without fused operations. So the bound of
// GLEV_FAST, 6 (n + m) + 12, holds.
inline bool evaluate_centred_mesh(const PreparedMap& map, const MeshRange& range, bool fast,
                                  const Destination& to, double* x) {
  const auto [n, m] = map.surface.degree;
  if (n == 0 || map.centred == nullptr) return false;
  // The ends of intervals are compared as bits, and NaNs could be equal. (If the first and last column are
  // sure, all columns are.)
  for (const double error : map.centred_test.error) {
    if (!std::isfinite(error)) return false;
  }
  if (!is_inside(map.surface, range, GLEV_AT(rows_are_tested, m > 0))) return false;
  const auto [domain_u, domain_v] = map.surface.domain;
  place_points(domain_u, range.u, range.i1, range.columns, x);
  MeshCurves curves = {map, map.centred_test, 0, spans(range.u, domain_u), m > 0 && spans(range.v, domain_v)};
  // Without roundings an interval is one number.
  bool is_exact = true;
  const int bits_of_arguments =
      n * bits_of_places(domain_u, range.u) + (m == 0 ? 0 : m * bits_of_places(domain_v, range.v));
  for (int k = 0; k < map.surface.components; ++k) {
    double& error = curves.test.error[static_cast<std::size_t>(k)];
    if (map.centred_bits[k] + bits_of_arguments <= kExactBits) error = 0;
    is_exact = is_exact && error == 0;
    if (map.centred_bits[k] + bits_along_lines(n, m) <= kExactBits) curves.is_short |= 1U << k;
  }
  const bool is_fast = fast && !has_few_segments(map.surface, range) && has_fast_inside(map, range);
  const Method method = is_fast ? Method::kFast : is_exact ? Method::kExact : Method::kIntervals;
  // The order of operations depends on the grid and not on the range, so adjacent ranges have the same points
  // with GLEV_FAST, too. Smaller grids have the order of evaluate_patches().
  constexpr std::int64_t kFewestWide = 128;
  const std::int64_t grid_columns = std::int64_t{range.u.segments} + 1,
                     grid_rows = m == 0 ? 1 : std::int64_t{range.v.segments} + 1;
  const bool is_wide =
      grid_columns > kFewestWide && grid_columns * grid_rows > static_cast<std::int64_t>(kMostPatchPoints);
  const std::size_t last = range.columns - 1;
  const bool has_first = is_fast && is_end(domain_u, range.u_of(0)),
             has_last = is_fast && is_end(domain_u, range.u_of(last));
  // The boundary of a curve consists of its ends.
  const bool has_ends_v = is_fast && to.row_stride != 0;

  MeshSink sink(map, range, to);
  const std::size_t most_columns = is_wide ? kMostWideColumns : kMostPositions / sink.components;
  const bool packed = is_packed(sink.components, to);
  Rows rows;
  for (std::size_t r0 = 0; r0 < range.rows; r0 += Rows::kMost) {
    rows.count = std::min(Rows::kMost, range.rows - r0);
    std::fill_n(rows.y, rows.count, 0.0);
    if (m > 0) place_points(domain_v, range.v, range.v_of(r0).index, rows.count, rows.y);
    rows.set(!is_exact && curves.has_lines_v && curves.is_short != 0, method,
             has_ends_v && is_end(domain_v, range.v_of(r0)),
             has_ends_v && is_end(domain_v, range.v_of(r0 + rows.count - 1)));
    sink.first_row = r0;
    for (std::size_t c0 = 0; c0 < range.columns; c0 += most_columns) {
      sink.columns = std::min(most_columns, range.columns - c0);
      curves.choose(x + c0, range.u, range.u_of(c0).index, sink.columns);
      sink.first_column = c0;
      const std::size_t count = sink.columns * sink.components;
      sink.is_direct = packed && (is_wide || count >= kFewestPositions);
      const bool is_first = has_first && c0 == 0, is_last = has_last && c0 + sink.columns == range.columns;
      const double ends[2] = {is_first ? x[0] : x[last], x[last]};
      MeshCurves edges = curves;
      if (is_wide) {
        std::size_t at[5], special = 0;
        double places[5];
        const auto add = [&](std::size_t column) { at[special++] = column; };
        if (is_fast && is_first) add(0);
        if (is_fast && is_last && sink.columns > 1) add(sink.columns - 1);
        for (std::size_t line = 0; line < curves.lines.count && !is_fast; ++line) add(curves.lines.at[line]);
        for (std::size_t i = 0; i < special; ++i) places[i] = curves.x[at[i]];
        edges.choose_lines(places, special);
        evaluate_wide_strip(curves, edges, at, is_fast, rows, sink);
        continue;
      }
      edges.choose_lines(ends, is_first && is_last && last != 0 ? 2 : is_first || is_last ? 1 : 0);
      evaluate_strip(curves, edges, is_first, method, m, rows, count, sink);
    }
  }
  return true;
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_CENTRED_MESH_INL_H_
