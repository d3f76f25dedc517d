// Double results of maps: Horner's rule in powers of x = t - s and y in double-double, one argument in each
// lane.
#if defined(GLEVALUATOR_DOUBLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLEVALUATOR_DOUBLES_INL_H_
#undef GLEVALUATOR_DOUBLES_INL_H_
#else
#define GLEVALUATOR_DOUBLES_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "arguments-inl.h"
#include "enclosure-inl.h"
#include "mesh-inl.h"
#include "resolve.h"

HWY_BEFORE_NAMESPACE();
namespace glev::HWY_NAMESPACE {
namespace doubles {

using enclosure::Pairs, enclosure::add_pairs, enclosure::multiply_pairs, enclosure::two_sums;
using VectorPairs = Pairs<Vector>;

// The least magnitudes of results that are accepted. Let S be the sum of the magnitudes of the coefficients,
// which are exact; x and y have errors of 4 units of 2^-106. A step adds at most 13 units of S for its
// product and 4 for its sum. Results are accepted if the total error is at most 2^-54 of their magnitude, so
// they are within one ULP.
struct Bounds {
  explicit Bounds(const PreparedMap& map) {
    const auto [n, m] = map.surface.degree;
    for (int k = 0; k < map.surface.components; ++k) {
      const PreparedComponent& component = map.component[k];
      const bool is_claimed = map.centred_bits[k] != kManyBits && component.largest >= 0x1p-300;
      least[k] = is_claimed ? 0x1p54 * (20 * (n + m) + 8) * 0x1p-106 * map.centred_sum[k] : HUGE_VAL;
    }
  }
  std::array<double, 4> least{};  // for each component
};

// The coefficients of a row, four values for each power of x.
struct Row {
  static constexpr std::size_t kValues = 4 * (kMaxCentredDegree + 1);
  double high[kValues + kLanes], low[kValues + kLanes];

  HWY_INLINE void set(const PreparedMap& map, const DoubleDouble& at) {
    const auto [n, m] = map.surface.degree;
    const std::size_t values = 4 * (static_cast<std::size_t>(n) + 1);
    const VectorPairs y = {hn::Set(kDoubles, at.high), hn::Set(kDoubles, at.low)};
    for (std::size_t first = 0; first < values; first += kLanes) {
      const double* row = map.centred + first + static_cast<std::size_t>(m) * values;
      VectorPairs sum = {hn::LoadU(kDoubles, row), hn::Zero(kDoubles)};
      for (int j = m - 1; j >= 0; --j) {
        row -= values;
        sum = add_pairs(multiply_pairs(sum, y), VectorPairs{hn::LoadU(kDoubles, row), hn::Zero(kDoubles)});
      }
      hn::StoreU(sum.high, kDoubles, high + first);
      hn::StoreU(sum.low, kDoubles, low + first);
    }
  }
};

// Writes `count` points to `data`, at the arguments x. Calls resolve(i, k) for results that are not accurate
// enough or outside the domain.
template <class Resolver>
HWY_INLINE void put_points(const PreparedMap& map, const Bounds& bounds, const Row& row, const VectorPairs& x,
                           std::size_t count, const Destination& to, std::byte* data,
                           const Resolver& resolve) {
  const int n = map.surface.degree[0], components = map.surface.components;
  const auto is_inside = hn::Le(hn::Abs(x.high), hn::Set(kDoubles, 1));
  HWY_ALIGN double values[4][kLanes];
  std::uint8_t is_sure[4][8] = {};
  for (int k = 0; k < components; ++k) {
    const auto coefficient = [&](int i) HWY_ATTR -> VectorPairs {
      return {hn::Set(kDoubles, row.high[4 * i + k]), hn::Set(kDoubles, row.low[4 * i + k])};
    };
    VectorPairs sum = coefficient(n);
    for (int i = n - 1; i >= 0; --i) sum = add_pairs(multiply_pairs(sum, x), coefficient(i));
    hn::Store(sum.high, kDoubles, values[k]);
    const auto is_large = hn::Ge(hn::Abs(sum.high), hn::Set(kDoubles, bounds.least[k]));
    hn::StoreMaskBits(kDoubles, hn::And(is_inside, is_large), is_sure[k]);
  }
  for (std::size_t i = 0; i < count; ++i, data += to.stride) {
    std::array<double, 4> point = {0, 0, 0, 1};
    for (int k = 0; k < components; ++k) {
      const bool sure = (is_sure[k][0] >> i & 1) != 0;
      point[static_cast<std::size_t>(k)] = HWY_LIKELY(sure) ? values[k][i] : resolve(i, k);
    }
    std::memcpy(data, point.data(), static_cast<std::size_t>(to.components) * sizeof(double));
  }
}

// Returns x = (2 i - n) / n of grid point i.
inline DoubleDouble place_on(const Grid& grid, std::int64_t index) {
  const double n = grid.segments, part = static_cast<double>(2 * index) - n, quotient = part / n;
  const DoubleDouble product = two_product(quotient, n);
  return fast_two_sum(quotient, ((part - product.high) - product.low) / n);
}

// Evaluates maps of low degree whose grids span the domain. Returns false, and does nothing, for others.
inline bool evaluate_mesh(const PreparedMap& map, const MeshRange& range, const Destination& to,
                          double* scratch) {
  const auto [n, m] = map.surface.degree;
  const auto& [domain_u, domain_v] = map.surface.domain;
  if (n == 0 || map.centred == nullptr || !spans(range.u, domain_u)) return false;
  if (m > 0 && (!spans(range.v, domain_v) || range.j1 < 0 || range.last_row() > range.v.segments))
    return false;
  const Bounds bounds(map);
  const std::size_t padded = (range.columns + kLanes - 1) / kLanes * kLanes;
  double *const high = scratch, *const low = scratch + padded;
  for (std::size_t c = 0; c < padded; ++c) {
    const DoubleDouble x = place_on(range.u, range.u_of(std::min(c, range.columns - 1)).index);
    high[c] = x.high, low[c] = x.low;
  }
  Row row;
  for (std::size_t r = 0; r < range.rows; ++r) {
    row.set(map, m == 0 ? DoubleDouble{} : place_on(range.v, range.v_of(r).index));
    std::byte* const data = to.data + r * to.row_stride;
    for (std::size_t c = 0; c < range.columns; c += kLanes) {
      const VectorPairs x = {hn::Load(kDoubles, high + c), hn::Load(kDoubles, low + c)};
      put_points(
          map, bounds, row, x, std::min(kLanes, range.columns - c), to, data + c * to.stride,
          [&](std::size_t i, int k) { return resolve_in_double(map, k, range.u_of(c + i), range.v_of(r)); });
    }
  }
  return true;
}

// Evaluates curves of low degree at scattered arguments if the inverse of the width of the domain is exact,
// so that x is a sum of two doubles. Returns false, and does nothing, for others.
inline bool evaluate_curve(const PreparedMap& map, const Input& input, std::size_t count,
                           const Destination& to) {
  const double inverse = map.inverse_width[0];
  // The limits of `inverse` prevent underflow of x.
  if (map.surface.degree[0] == 0 || map.centred == nullptr ||
      !(inverse != 0 && std::fabs(inverse) < 0x1p40 && std::fabs(inverse) > 0x1p-40))
    return false;
  const Bounds bounds(map);
  const Vector scale = hn::Set(kDoubles, map.place[0].scale), middle = hn::Set(kDoubles, map.place[0].middle);
  Row row;
  row.set(map, {});
  for (std::size_t begin = 0; begin < count; begin += kLanes) {
    const std::size_t part_count = std::min(kLanes, count - begin);
    HWY_ALIGN double arguments[kLanes];
    for (std::size_t i = 0; i < kLanes; ++i) arguments[i] = input[begin + std::min(i, part_count - 1)];
    const VectorPairs x = two_sums(hn::Mul(hn::Load(kDoubles, arguments), scale), hn::Neg(middle));
    put_points(map, bounds, row, x, part_count, to, to.data + begin * to.stride, [&](std::size_t i, int k) {
      return resolve_in_double(map, k, argument_at(input[begin + i]), argument_at(0));
    });
  }
  return true;
}

}  // namespace doubles
}  // namespace glev::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // GLEVALUATOR_DOUBLES_INL_H_
