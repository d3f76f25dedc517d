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

// Copies a point. The memory of the caller need not be aligned.
HWY_INLINE void copy_point(const float* from, std::size_t components, float* to) {
  switch (components) {
    case 1:
      std::memcpy(to, from, sizeof(float));
      break;
    case 2:
      std::memcpy(to, from, 2 * sizeof(float));
      break;
    case 3:
      std::memcpy(to, from, 3 * sizeof(float));
      break;
    default:
      std::memcpy(to, from, 4 * sizeof(float));
  }
}

// Computes the curves of columns from the coefficients of x^i y^j, in the layout of PreparedMap::centred.
template <int kDegree>
void compute_curves(const double* centred, int m, int components, const double* x, std::size_t columns,
                    Strip<double>* strip) {
  const std::size_t parts = (static_cast<std::size_t>(components) + kFourLanes - 1) / kFourLanes;
  for (int j = 0; j <= m; ++j, centred += 4 * (kDegree + 1)) {
    FourVector power[kDegree + 1][kParts];
    for (int i = 0; i <= kDegree; ++i) {
      for (std::size_t part = 0; part < kParts; ++part)
        power[i][part] = hn::LoadU(kFour, centred + 4 * i + part * kFourLanes);
    }
    double* to = strip->power[j];
    for (std::size_t c = 0; c < columns; ++c, to += components) {
      const FourVector place = hn::Set(kFour, x[c]);
      for (std::size_t part = 0; part < parts; ++part) {
        FourVector sum = power[kDegree][part];
        for (int i = kDegree - 1; i >= 0; --i) sum = hn::MulAdd(sum, place, power[i][part]);
        // The values behind the last component are overwritten by the next column.
        hn::StoreU(sum, kFour, to + part * kFourLanes);
      }
    }
  }
}

// The curves of some columns of a map.
struct MeshCurves {
  const PreparedMap& map;
  bool has_lines_u, has_lines_v;  // the grid spans the domain, so x or y is exact on lines
  bool has_short = false;         // Horner's rule does not round a component along lines
  // The bounds on the errors of components, and those of components that are constant along a line, which are
  // 0 if Horner's rule does not round.
  HWY_ALIGN double error[4] = {}, line_error[4] = {};
  const double* x = nullptr;
  std::size_t columns = 0;
  Lines lines = {};

  // Chooses columns, from number `first` of the grid on.
  HWY_INLINE void choose(const double* places, const Grid& grid, std::int64_t first, std::size_t count) {
    x = places;
    columns = count;
    lines.count = 0;
    if (has_lines_u && has_short) lines.find(grid, first, columns);
  }
  // Computes the curves, with the ends of their intervals if `has_ends`.
  HWY_INLINE void compute(bool has_ends, Strip<double>* strip) const {
    static constexpr decltype(&compute_curves<1>) kOf[kMaxCentredDegree] = {
        compute_curves<1>, compute_curves<2>, compute_curves<3>};
    const auto [n, m] = map.surface.degree;
    kOf[n - 1](map.centred, m, map.surface.components, x, columns, strip);
    if (has_ends) set_ends(m, strip);
  }

  // A row as a curve in x, or a column as a curve in y: the coefficients of all powers, those that it does
  // not have as zeros, and the bounds on the errors.
  struct Curve {
    FourVector power[kMaxCentredDegree + 1][kParts], error[kParts];
    bool is_on_line;
  };
  // Returns the row at a y (kAlong = 0) or the column at an x (kAlong = 1).
  template <int kAlong>
  HWY_INLINE Curve curve_at(double place) const {
    const auto& degree = map.surface.degree;
    const int n = degree[kAlong], m = degree[1 - kAlong];
    const int values = 4 * (degree[0] + 1), along = kAlong == 0 ? 4 : values,
              across = kAlong == 0 ? values : 4;
    Curve curve;
    curve.is_on_line = (kAlong == 0 ? has_lines_v : has_lines_u) && is_line(place);
    for (std::size_t part = 0; part < kParts; ++part) {
      const double* const first = map.centred + part * kFourLanes;
      auto is_constant = hn::Eq(hn::Zero(kFour), hn::Zero(kFour));
      for (int i = 0; i <= kMaxCentredDegree; ++i) {
        FourVector sum = hn::Zero(kFour);
        if (i <= n) {
          sum = hn::LoadU(kFour, first + i * along + m * across);
          for (int j = m - 1; j >= 0; --j)
            sum = hn::MulAdd(sum, hn::Set(kFour, place), hn::LoadU(kFour, first + i * along + j * across));
        }
        curve.power[i][part] = sum;
        if (i > 0) is_constant = hn::And(is_constant, hn::Eq(sum, hn::Zero(kFour)));
      }
      curve.error[part] = hn::Load(kFour, error + part * kFourLanes);
      if (curve.is_on_line)
        curve.error[part] =
            hn::IfThenElse(is_constant, hn::Load(kFour, line_error + part * kFourLanes), curve.error[part]);
    }
    return curve;
  }

  // Evaluates the row at y as a curve in x, correctly rounded. resolve(position) returns a value that its
  // interval does not decide.
  template <class Resolver>
  HWY_NOINLINE void round_row(double y, float* to, const Resolver& resolve) const {
    const Curve row = curve_at<0>(y);
    const auto components = static_cast<std::size_t>(map.surface.components);
    FourVector errors[2][kParts];  // second: on lines
    for (std::size_t part = 0; part < kParts; ++part) {
      errors[0][part] = row.error[part];
      errors[1][part] = row.is_on_line ? hn::Load(kFour, line_error + part * kFourLanes) : row.error[part];
    }
    auto open = hn::Zero(kFourFloats);  // bits in which the ends differ
    for (const bool resolves : {false, true}) {
      if (GLEV_AT(row_is_settled, resolves && HWY_LIKELY(are_zero(open)))) break;
      for (std::size_t c = 0, line = 0; c < columns; ++c) {
        const bool is_on_line = line < lines.count && lines.at[line] == c;
        if (is_on_line) ++line;
        const FourVector place = hn::Set(kFour, x[c]);
        float last[4];
        // The values behind the last component are overwritten by the next column, except at the end.
        float* const point = (columns - c) * components >= 4 ? to + c * components : last;
        for (std::size_t part = 0; part < kParts; ++part) {
          FourVector sum = row.power[kMaxCentredDegree][part];
          for (int i = kMaxCentredDegree - 1; i >= 0; --i) sum = hn::MulAdd(sum, place, row.power[i][part]);
          const auto low = hn::DemoteTo(kFourFloats, hn::Sub(sum, errors[is_on_line][part])),
                     high = hn::DemoteTo(kFourFloats, hn::Add(sum, errors[is_on_line][part]));
          hn::StoreU(high, kFourFloats, point + part * kFourLanes);
          const auto bits = hn::Xor(low, high);
          open = hn::Or(open, bits);
          if (resolves)
            resolve_lanes(bits, part * kFourLanes, components, point,
                          [&](std::size_t k) { return resolve(c * components + k); });
        }
        if (point == last) copy_point(last, components, to + c * components);
      }
    }
  }

 private:
  // Computes the ends of intervals around the coefficients of y^0.
  HWY_INLINE void set_ends(int m, Strip<double>* strip) const {
    const auto components = static_cast<std::size_t>(map.surface.components);
    FourVector errors[2][kParts];  // second: of curves that are constant along a line
    for (std::size_t part = 0; part < kParts; ++part) {
      errors[0][part] = hn::Load(kFour, error + part * kFourLanes);
      errors[1][part] = hn::Load(kFour, line_error + part * kFourLanes);
    }
    for (std::size_t c = 0, line = 0; c < columns; ++c) {
      const bool is_on_line = line < lines.count && lines.at[line] == c;
      if (is_on_line) ++line;
      for (std::size_t part = 0; part < kParts; ++part) {
        const std::size_t p = c * components + part * kFourLanes;
        FourVector own = errors[0][part];
        if (is_on_line) {
          auto is_constant = hn::Eq(hn::Zero(kFour), hn::Zero(kFour));
          for (int j = 1; j <= m; ++j)
            is_constant =
                hn::And(is_constant, hn::Eq(hn::LoadU(kFour, strip->power[j] + p), hn::Zero(kFour)));
          own = hn::IfThenElse(is_constant, errors[1][part], own);
        }
        const FourVector value = hn::LoadU(kFour, strip->power[0] + p);
        hn::StoreU(hn::Sub(value, own), kFour, strip->low + p);
        hn::StoreU(GLEV_AT(upper_ends, hn::Add(value, own)), kFour, strip->high + p);
      }
    }
  }
};

// Columns of a strip of a large mesh, of which only x is in memory: more than the 513 of 512 segments.
constexpr std::size_t kMostWideColumns = 520, kMostWideValues = 4 * kMostWideColumns;

// The place of values that are not used or are replaced later. If double left them open, they would be
// resolved in vain; at this place, ties and zeros are rare.
constexpr double kDecided = 0.3;

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
  // Columns that are evaluated as curves in y: those on the boundary with GLEV_FAST, and those on lines in
  // strips of large meshes.
  struct Column {
    std::size_t number;
    float values[4 * Rows::kMost + kFewestPositions];
  };
  std::size_t own_count = 0;
  Column own[5];
  HWY_ALIGN float values[2][kMostWideValues + kFewestPositions];

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
  HWY_INLINE void set_columns(std::size_t r, float* row) const {
    const std::size_t size = components, first = first_column, count = columns;
    for (const Column *column = own, *const end = own + GLEV_AT(own_columns, own_count); column != end;
         ++column) {
      const std::size_t c = column->number - first;
      if (c < count) copy_point(column->values + r * size, size, row + c * size);
    }
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

// Evaluates at least one vector of positions of a row by Horner's rule in x. `row` has the coefficients of
// x^i of kPeriod vectors, and `x` that of each position. The results are ends of intervals; floats have none.
// Returns true if both ends of all intervals round to the same float.
template <class Real, int kDegree, std::size_t kPeriod>
bool evaluate_wide_row(const Strip<Real>& row, std::size_t components, const Real* x, std::size_t count,
                       float* to) {
  constexpr bool kIntervals = sizeof(Real) == sizeof(double);
  constexpr hn::CappedTag<Real, kMostLanes<Real>> kTag;
  constexpr hn::Rebind<float, decltype(kTag)> kResults;
  constexpr std::size_t kWidth = kWideLanes<Real>;
  using Values = hn::Vec<decltype(kTag)>;
  using Results = hn::Vec<decltype(kResults)>;
  Values power[kDegree + 1][kPeriod], first[2][kPeriod];
  const auto load = [&](std::size_t begin, std::size_t parts) HWY_ATTR {
    for (std::size_t part = 0; part < parts; ++part, begin += kWidth) {
      for (int i = 0; i <= kDegree; ++i) power[i][part] = hn::LoadU(kTag, row.power[i] + begin);
      first[0][part] = kIntervals ? hn::LoadU(kTag, row.low + begin) : power[0][part];
      first[1][part] = kIntervals ? hn::LoadU(kTag, row.high + begin) : power[0][part];
    }
  };
  load(0, kPeriod);
  Results open = hn::Zero(kResults);  // bits in which the ends differ
  const auto evaluate = [&](std::size_t p, std::size_t part) HWY_ATTR {
    const Values place = hn::LoadU(kTag, x + p);
    Values sum = power[kDegree][part];
    for (int i = kDegree - 1; i > 0; --i) sum = hn::MulAdd(sum, place, power[i][part]);
    const Values high = hn::MulAdd(sum, place, first[1][part]);
    if constexpr (kIntervals) {
      const Results value = hn::DemoteTo(kResults, high);
      open = hn::Or(open, hn::Xor(value, hn::DemoteTo(kResults, hn::MulAdd(sum, place, first[0][part]))));
      hn::StoreU(value, kResults, to + p);
    } else {
      hn::StoreU(high, kResults, to + p);
    }
  };
  std::size_t p = 0;
  for (; p + kPeriod * kWidth <= count; p += kPeriod * kWidth) {
    for (std::size_t part = 0; part < kPeriod; ++part) evaluate(p + part * kWidth, part);
  }
  for (std::size_t part = 0; part + 1 < kPeriod && p + kWidth <= count; ++part, p += kWidth)
    evaluate(p, part);
  if (p < count) {
    // The last vector ends at the last position, so it can begin at another component.
    p = count - kWidth;
    load(GLEV_AT(last_component, p % components), 1);
    evaluate(p, 0);
  }
  return !kIntervals || are_zero(open);
}

template <class Real>
using EvaluatesWideRow = bool (*)(const Strip<Real>& row, std::size_t components, const Real* x,
                                  std::size_t count, float* to);
template <class Real, std::size_t kComponents>
constexpr std::array<EvaluatesWideRow<Real>, kMaxCentredDegree> wide_row_functions() {
  constexpr std::size_t kPeriod = wide_period<Real>(kComponents);
  return {evaluate_wide_row<Real, 1, kPeriod>, evaluate_wide_row<Real, 2, kPeriod>,
          evaluate_wide_row<Real, 3, kPeriod>};
}
// Returns the function for rows of curves of degree n.
template <class Real>
EvaluatesWideRow<Real> wide_row_function(int n, std::size_t components) {
  static constexpr std::array<EvaluatesWideRow<Real>, kMaxCentredDegree> kOf[] = {
      wide_row_functions<Real, 1>(), wide_row_functions<Real, 2>(), wide_row_functions<Real, 3>(),
      wide_row_functions<Real, 4>()};
  return kOf[components - 1][static_cast<std::size_t>(n) - 1];
}

// Computes the coefficients of a row of curves of degree n for evaluate_wide_row().
template <class Real>
HWY_INLINE void repeat_row(const MeshCurves::Curve& row, int n, std::size_t components, Strip<Real>* strip) {
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
  for (std::size_t part = kParts; part-- > 0;) {
    for (int i = 0; i <= n; ++i) repeat(row.power[i][part], part * kFourLanes, strip->power[i]);
    if constexpr (sizeof(Real) == sizeof(double)) {
      repeat(hn::Sub(row.power[0][part], row.error[part]), part * kFourLanes, strip->low);
      repeat(hn::Add(row.power[0][part], row.error[part]), part * kFourLanes, strip->high);
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

// Evaluates the points of the rows in the columns that the sink keeps, correctly rounded, as curves in y.
// `x`: that of all columns.
HWY_NOINLINE inline void evaluate_columns(const MeshCurves& curves, const double* x, const Rows& rows,
                                          MeshSink* sink) {
  const int degree = std::max(curves.map.surface.degree[1], 1);
  const std::size_t components = sink->components, count = rows.count * components,
                    period = wide_period<double>(components) * kLanes;
  const auto evaluate = wide_row_function<double>(degree, components);
  HWY_ALIGN double places[4 * Rows::kMost + kFewestPositions];
  Strip<double> strip;
  repeat_places(rows.y, rows.count, components, places);
  std::fill_n(places + count, kFewestPositions, kDecided);
  // Rows with a test of their own are evaluated as rows.
  for (std::size_t i = 0; i < rows.own.count; ++i)
    std::fill_n(places + rows.own.at[i] * components, components, kDecided);
  for (MeshSink::Column *column = sink->own, *const end = column + sink->own_count; column != end; ++column) {
    repeat_row(curves.curve_at<1>(x[column->number]), degree, components, &strip);
    if (HWY_LIKELY(evaluate(strip, components, places, std::max(count, kFewestPositions), column->values)))
      continue;
    const auto place_at = [&](std::size_t p) HWY_ATTR { return hn::Load(kDoubles, places + p); };
    resolve_row(strip, period, degree, count, place_at, column->values, [&](std::size_t p) {
      return resolve(curves.map, static_cast<int>(p % components), sink->range.u_of(column->number),
                     sink->range.v_of(sink->first_row + p / components));
    });
  }
}

// Evaluates the rows of a strip of a large mesh, one by one, as curves in x: the curves of all columns would
// take too long if a range has few rows.
HWY_NOINLINE inline void evaluate_wide_strip(const MeshCurves& curves, bool is_fast, const Rows& rows,
                                             MeshSink& sink) {
  const int n = curves.map.surface.degree[0];
  const std::size_t components = sink.components, count = curves.columns * components,
                    padded = std::max(count, kFewestPositions);
  const auto evaluate = wide_row_function<double>(n, components);
  const auto evaluate_fast = wide_row_function<float>(n, components);
  HWY_ALIGN double places[kMostWideValues + kFewestPositions];
  HWY_ALIGN float fast_places[kMostWideValues + kFewestPositions];
  Strip<double> row;
  Strip<float> fast_row;
  if (is_fast) {
    repeat_places(curves.x, curves.columns, components, fast_places);
    std::fill_n(fast_places + count, kFewestPositions, 0.0F);
  } else {
    repeat_places(curves.x, curves.columns, components, places);
    std::fill_n(places + count, kFewestPositions, kDecided);
    for (std::size_t i = 0; i < curves.lines.count; ++i)
      std::fill_n(places + curves.lines.at[i] * components, components, kDecided);
  }
  for (std::size_t r = 0, own = 0; r < rows.count; ++r) {
    const auto resolve = [&](std::size_t p) { return sink.resolve(r, p); };
    float* to;
    sink.begin(r, 1, &to);
    if (own < rows.own.count && rows.own.at[own] == r) {
      ++own;
      curves.round_row(rows.y[r], to, resolve);
    } else {
      const MeshCurves::Curve values = curves.curve_at<0>(rows.y[r]);
      if (is_fast) {
        repeat_row(values, n, components, &fast_row);
        evaluate_fast(fast_row, components, fast_places, padded, to);
      } else {
        repeat_row(values, n, components, &row);
        if (HWY_UNLIKELY(!evaluate(row, components, places, padded, to))) {
          const auto place_at = [&](std::size_t p) HWY_ATTR { return hn::Load(kDoubles, places + p); };
          resolve_row(row, wide_period<double>(components) * kLanes, n, count, place_at, to, resolve);
        }
      }
      sink.set_columns(r, to);
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
  MeshCurves curves = {map, spans(range.u, domain_u), m > 0 && spans(range.v, domain_v)};
  // Without roundings an interval is one number.
  bool is_exact = true;
  const int bits_of_arguments =
      n * bits_of_places(domain_u, range.u) + (m == 0 ? 0 : m * bits_of_places(domain_v, range.v));
  for (int k = 0; k < map.surface.components; ++k) {
    const double error = map.centred_test.error[static_cast<std::size_t>(k)];
    const bool is_short = map.centred_bits[k] + bits_along_lines(n, m) <= kExactBits;
    curves.has_short = curves.has_short || is_short;
    curves.error[k] = map.centred_bits[k] + bits_of_arguments <= kExactBits ? 0 : error;
    curves.line_error[k] = is_short ? 0 : curves.error[k];
    is_exact = is_exact && curves.error[k] == 0;
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
  // The boundary of a curve consists of its ends.
  const bool has_ends_v = is_fast && to.row_stride != 0;

  MeshSink sink(map, range, to);
  const auto add = [&](std::size_t column) { sink.own[sink.own_count++].number = column; };
  if (is_fast && is_end(domain_u, range.u_of(0))) add(0);
  if (is_fast && last != 0 && is_end(domain_u, range.u_of(last))) add(last);
  if (is_wide && !is_fast) {
    curves.choose(x, range.u, range.i1, range.columns);
    for (std::size_t line = 0; line < curves.lines.count; ++line) add(curves.lines.at[line]);
  }
  const std::size_t most_columns = is_wide ? kMostWideColumns : kMostPositions / sink.components;
  const bool packed = is_packed(sink.components, to);
  Rows rows;
  for (std::size_t r0 = 0; r0 < range.rows; r0 += Rows::kMost) {
    rows.count = std::min(Rows::kMost, range.rows - r0);
    if (m > 0) {
      place_points(domain_v, range.v, range.v_of(r0).index, rows.count, rows.y);
    } else {
      std::fill_n(rows.y, rows.count, 0.0);
    }
    rows.choose_ends(has_ends_v && is_end(domain_v, range.v_of(r0)),
                     has_ends_v && is_end(domain_v, range.v_of(r0 + rows.count - 1)));
    if (method == Method::kIntervals && curves.has_lines_v && curves.has_short)
      rows.own.find(range.v, range.v_of(r0).index, rows.count);
    sink.first_row = r0;
    if (sink.own_count != 0) evaluate_columns(curves, x, rows, &sink);
    for (std::size_t c0 = 0; c0 < range.columns; c0 += most_columns) {
      sink.columns = std::min(most_columns, range.columns - c0);
      curves.choose(x + c0, range.u, range.u_of(c0).index, sink.columns);
      sink.first_column = c0;
      const std::size_t count = sink.columns * sink.components;
      sink.is_direct = packed && count >= (is_wide ? kFewestPositions : fewest_positions(method));
      is_wide ? evaluate_wide_strip(curves, is_fast, rows, sink)
              : evaluate_strip(curves, method, m, rows, count, sink);
    }
  }
  return true;
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_CENTRED_MESH_INL_H_
