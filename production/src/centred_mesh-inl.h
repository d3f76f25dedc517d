// Meshes of low degree inside their domain, in powers of x = t - s and y, correctly rounded or with
// GLEV_FAST.
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

#include "centred-inl.h"
#include "mesh-inl.h"

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

  HWY_INLINE void choose(const double* places, std::size_t count) {
    x = places;
    columns = count;
    lines.count = 0;
    if (has_lines_u && is_short != 0) lines.find(x, columns);
  }

  HWY_INLINE void compute(bool has_ends, Strip<double>* strip) const {
    compute_powers(map.centred, map.surface.degree[1], strip);
    if (has_ends) set_ends(test, is_short, map.surface.degree[1], strip);
  }

  HWY_INLINE void compute_row(double y, Strip<double>* strip) const {
    constexpr std::size_t kWidth = hn::MaxLanes(kFour);
    const auto [n, m] = map.surface.degree;
    const auto values = static_cast<std::size_t>(4 * (n + 1));
    HWY_ALIGN double row[4 * (kMaxCentredDegree + 1)];
    for (std::size_t first = 0; first < values; first += kWidth) {
      const double* from = map.centred + first + static_cast<std::size_t>(m) * values;
      FourVector sum = hn::LoadU(kFour, from);
      for (int j = m - 1; j >= 0; --j) {
        from -= values;
        sum = hn::MulAdd(sum, hn::Set(kFour, y), hn::LoadU(kFour, from));
      }
      hn::Store(sum, kFour, row + first);
    }
    PreparedMap::Test own = test;
    const unsigned is_short_here = has_lines_v && is_line(y) ? is_short : 0;
    for (int k = 0; k < map.surface.components; ++k) {
      bool is_constant = (is_short_here >> k & 1) != 0;
      for (int i = 1; i <= n; ++i) is_constant = is_constant && row[4 * i + k] == 0;
      if (is_constant) own.error[static_cast<std::size_t>(k)] = 0;
    }
    compute_powers(row, 0, strip);
    set_ends(own, is_short_here, 0, strip);
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
        hn::StoreU(hn::Add(value, error), kFour, strip->high + p);
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

// Stores rows, and resolves their values.
template <int kComponents>
struct MeshSink {
  static constexpr std::size_t kUnit = kComponents;
  const PreparedMap& map;
  const MeshRange& range;
  const Destination& to;
  MeshSink(const PreparedMap& its_map, const MeshRange& its_range, const Destination& its_to)
      : map(its_map), range(its_range), to(its_to) {}

  std::size_t first_row = 0, first_column = 0, columns = 0;
  bool is_direct = false;
  HWY_ALIGN float values[2][Strip<float>::kSize];

  std::byte* data_of(std::size_t r) const {
    return to.data + (first_row + r) * to.row_stride + first_column * to.stride;
  }
  void begin(std::size_t r, std::size_t rows, float** row) {
    for (std::size_t i = 0; i < rows; ++i)
      row[i] = is_direct ? reinterpret_cast<float*>(data_of(r + i)) : values[i];
  }
  void end(std::size_t r, const float* row) const {
    if (!is_direct) scatter<kComponents>(row, columns, to, data_of(r));
  }
  float resolve(std::size_t r, std::size_t p) const {
    return glev::resolve(map, static_cast<int>(p % kComponents), range.u_of(first_column + p / kComponents),
                         range.v_of(first_row + r));
  }
};

// Evaluates meshes of maps of low degree inside the domain, with `fast` in float. Returns false, and does
// nothing, for other meshes. `x`: scratch memory.
//
// In units of 2^-24 max|R|, the errors with `fast` are 2.5 of coefficients, whose magnitudes have a sum of at
// most 2.5 max|R|, 3 of y, and 7.5 of the sums, or twice that without fused operations. So the bound of
// GLEV_FAST, 6 (n + m) + 12, holds.
template <int kComponents>
bool evaluate_centred_mesh(const PreparedMap& map, const MeshRange& range, bool fast, const Destination& to,
                           double* x) {
  const auto [n, m] = map.surface.degree;
  if (n == 0 || map.centred == nullptr) return false;
  // The ends of intervals are compared as bits, and NaNs could be equal. (If the first and last column are
  // sure, all columns are.)
  for (const double error : map.centred_test.error) {
    if (!std::isfinite(error)) return false;
  }
  if (!is_inside(map.surface, range, m > 0)) return false;
  const auto [domain_u, domain_v] = map.surface.domain;
  place_points(domain_u, range.u, range.i1, range.columns, x);
  MeshCurves curves = {map, map.centred_test, 0, spans(range.u, domain_u), m > 0 && spans(range.v, domain_v)};
  // Without roundings an interval is one number.
  bool is_exact = true;
  const int bits_of_arguments =
      n * bits_of_places(domain_u, range.u) + (m == 0 ? 0 : m * bits_of_places(domain_v, range.v));
  for (int k = 0; k < kComponents; ++k) {
    double& error = curves.test.error[static_cast<std::size_t>(k)];
    if (map.centred_bits[k] + bits_of_arguments <= kExactBits) error = 0;
    is_exact = is_exact && error == 0;
    if (map.centred_bits[k] + bits_along_lines(n, m) <= kExactBits) curves.is_short |= 1U << k;
  }
  const bool is_fast = fast && !has_few_segments(map.surface, range) && has_fast_inside(map, range);
  const Method method = is_fast ? Method::kFast : is_exact ? Method::kExact : Method::kIntervals;
  const std::size_t last = range.columns - 1;
  const bool has_first = is_fast && is_end(domain_u, range.u_of(0)),
             has_last = is_fast && is_end(domain_u, range.u_of(last));
  // The boundary of a curve consists of its ends.
  const bool has_ends_v = is_fast && to.row_stride != 0;

  constexpr std::size_t kColumns = kMostPositions / kComponents;
  MeshSink<kComponents> sink(map, range, to);
  Rows rows;
  for (std::size_t r0 = 0; r0 < range.rows; r0 += Rows::kMost) {
    rows.count = std::min(Rows::kMost, range.rows - r0);
    std::fill_n(rows.y, rows.count, 0.0);
    if (m > 0) place_points(domain_v, range.v, range.v_of(r0).index, rows.count, rows.y);
    rows.set(!is_exact && curves.has_lines_v && curves.is_short != 0, method,
             has_ends_v && is_end(domain_v, range.v_of(r0)),
             has_ends_v && is_end(domain_v, range.v_of(r0 + rows.count - 1)));
    // Few rows take less time without the curves of all columns.
    if (range.rows <= 2 && m > 0 && !is_fast) std::fill_n(rows.has_own_test, rows.count, true);
    sink.first_row = r0;
    for (std::size_t c0 = 0; c0 < range.columns; c0 += kColumns) {
      sink.columns = std::min(kColumns, range.columns - c0);
      curves.choose(x + c0, sink.columns);
      sink.first_column = c0;
      const std::size_t count = sink.columns * kComponents;
      sink.is_direct = is_packed<kComponents>(to) && count >= kFewestPositions;
      const bool is_first = has_first && c0 == 0, is_last = has_last && c0 + sink.columns == range.columns;
      const double ends[2] = {is_first ? x[0] : x[last], x[last]};
      MeshCurves edges = curves;
      edges.choose(ends, is_first && is_last && last != 0 ? 2 : is_first || is_last ? 1 : 0);
      evaluate_strip(curves, edges, is_first, method, m, rows, count, sink);
    }
  }
  return true;
}

}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_CENTRED_MESH_INL_H_
