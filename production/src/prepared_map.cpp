// Prepares maps: coefficients, error bounds, and the lowest orders of each component.
#include "prepared_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "binomials.h"
#include "double_double.h"
#include "environment.h"
#include "mutation_point.h"
#include "reduction.h"

namespace glev {
namespace {

constexpr std::uint64_t kSign = std::uint64_t{1} << 63, kFraction = (std::uint64_t{1} << 52) - 1,
                        kInfinity = ~kSign & ~kFraction;

// Returns the exponent that frexp() gives, of a normal number; -1022 or 1025 for others.
int exponent_of(double x) {
  return static_cast<int>((std::bit_cast<std::uint64_t>(x) & ~kSign) >> 52) - 1022;
}
// Returns 2^exponent, which must be a normal number.
double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

bool is_finite(const Domain& domain) { return std::isfinite(domain.u1) && std::isfinite(domain.u2); }

double unit_of(std::array<int, 2> order, const std::array<Domain, 2>& domain, double largest) {
  if (!(largest <= kLargestOrdinary && largest >= kSmallestOrdinary)) return HUGE_VAL;
  for (int d : {0, 1}) {
    if (order[d] > 1 && !is_ordinary(domain[d])) return HUGE_VAL;
  }
  return 0x1p-53 * (1 + 0x1p-20) * largest;
}

// Returns 1 / (u2 - u1) if that and u1 + u2 are exact, otherwise 0.
double invert_width(const Domain& domain) {
  if (two_sum(domain.u1, domain.u2).low != 0) return 0;
  const DoubleDouble width = two_sum(domain.u2, -domain.u1);
  const bool is_power = (std::bit_cast<std::uint64_t>(width.high) & kFraction) == 0;
  return is_power && width.low == 0 && std::abs(exponent_of(width.high)) < 500 ? 1 / width.high : 0;
}

// Copies the values of component k to separated + k * count, and computes their largest magnitude. NaN counts
// as infinite.
template <int kComponents>
void separate(const double* points, std::ptrdiff_t count, double* separated, PreparedMap& map) {
  // Magnitudes are ordered as their bits are.
  std::array<std::uint64_t, kComponents> largest{}, second{};
  const auto take = [&](std::uint64_t& largest_of, std::ptrdiff_t i, std::size_t k) {
    const double value = separated[static_cast<std::ptrdiff_t>(k) * count + i] =
        points[i * kComponents + static_cast<std::ptrdiff_t>(k)];
    largest_of = std::max(largest_of, std::bit_cast<std::uint64_t>(value) & ~kSign);
  };
  for (std::ptrdiff_t i = 1; i < count; i += 2) {
    for (std::size_t k = 0; k < kComponents; ++k) take(largest[k], i - 1, k), take(second[k], i, k);
  }
  for (std::size_t k = 0; k < kComponents; ++k) {
    if (count % 2 != 0) take(largest[k], count - 1, k);
    map.component[k].largest = std::bit_cast<double>(std::min(std::max(largest[k], second[k]), kInfinity));
  }
}

bool is_direct(const PreparedMap& map) {
  for (const Domain& domain : map.surface.domain) {
    if (is_subnormal(domain.u1) || is_subnormal(domain.u2)) return false;
  }
  for (int k = 0; k < map.surface.components; ++k) {
    const PreparedComponent& component = map.component[k];
    // An interval around a smaller number has different ends, so the number is undecided. Components that are
    // zero are always decided.
    if (component.largest != 0 && !(map.test.error[k] >= 0x1p-125 && map.test.error[k] < HUGE_VAL))
      return false;
  }
  return true;
}

#include "centring-inl.h"

// The four values of a point, with the operations that centre_along() needs.
struct Point {
  std::array<double, 4> value;

  friend Point operator+(const Point& a, const Point& b) {
    return each([&](std::size_t k) { return a.value[k] + b.value[k]; });
  }
  friend Point operator-(const Point& a, const Point& b) {
    return each([&](std::size_t k) { return a.value[k] - b.value[k]; });
  }
  friend Point operator*(const Point& a, double factor) {
    return each([&](std::size_t k) { return a.value[k] * factor; });
  }

 private:
  template <class Function>
  static Point each(const Function& function) {
    return {{function(0), function(1), function(2), function(3)}};
  }
};

// Computes the coefficients of x^i y^j in the layout of PreparedMap::centred.
void centre(const double* points, std::array<int, 2> order, int components, double* values) {
  const auto [columns, rows] = order;
  std::array<Point, (kMaxCentredDegree + 1) * (kMaxCentredDegree + 1)> net;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j, points += components) {
      Point& point = net[static_cast<std::size_t>(j * columns + i)];
      point.value = {0, 0, 0, 1};
      // Adding 0.0 turns -0 into +0, so that no sum is -0.
      for (int k = 0; k < components; ++k) point.value[static_cast<std::size_t>(k)] = points[k] + 0.0;
    }
  }
  for (int i = 0; i < columns; ++i) centre_along(rows - 1, columns, &net[static_cast<std::size_t>(i)]);
  for (int j = 0; j < rows; ++j) centre_along(columns - 1, 1, &net[static_cast<std::size_t>(j * columns)]);
  const int count = columns * rows;
  std::memcpy(values, net.data(), static_cast<std::size_t>(count) * sizeof(Point));
  std::fill_n(values + 4 * count, centred_values(columns - 1, rows - 1) - 4 * count, 0.0);
}

// Returns true if centre() does not round: the points are below 2^e and multiples of 2^(e-45), and the
// coefficients have at most 6 more low bits and 2 more high bits.
bool is_centred_exactly(const double* points, std::ptrdiff_t count, double largest) {
  const double scale = power_of_two(45 - exponent_of(largest));
  bool rounds = false;  // without an early exit, which would prevent vectors
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    constexpr double kWhole = 0x1.8p52;
    const double point = points[i] * scale, whole = point + kWhole;
    rounds |= GLEV_AT(coefficient_is_not_whole, whole - kWhole != point);
  }
  return !rounds;
}

// Returns the error of a test, for values in double.
double error_bound(const PreparedComponent& component, double units, double growth) {
  if (component.kind != PreparedComponent::Kind::kUnclaimed && component.largest == 0) return 0;
  // For larger values, a Horner sum could overflow, and conversions of Highway to float need not give
  // infinity.
  const bool is_safe = component.largest * growth <= 0x1p127;
  // Adding the error rounds by at most one unit of the sum, whose magnitude is below 2 max|R| * growth. With
  // smaller errors, the ends could be zeros of both signs, which compare equal.
  const double error = GLEV_AT(error_of_component, (units + 2) * component.unit * growth);
  return is_safe && error >= 0x1p-145 ? error : HUGE_VAL;
}

// Computes the test and the bits of one component with the control points `points`. `sum`: the sum of the
// magnitudes of its coefficients.
void bound_centred(PreparedMap& map, const double* points, std::ptrdiff_t count, double sum, int k) {
  const auto [n, m] = map.surface.degree;
  const PreparedComponent& component = map.component[k];
  double units = 0;
  map.centred_bits[k] = kManyBits;
  if (std::isfinite(component.unit)) {
    const bool is_exact = is_centred_exactly(points, count, component.largest);
    units = centred_units(n, m, sum / component.largest, is_exact);
    if (is_exact && component.largest <= 0x1p120 && component.largest >= 0x1p-600) {
      const int exponent = exponent_of(component.largest);
      map.centred_sum[k] = sum * (1 + 0x1p-40);  // the sum may be rounded
      const double scale = power_of_two(51 - exponent);
      std::int64_t all = 0;
      for (std::ptrdiff_t i = 0; i < count; ++i)
        all |= static_cast<std::int64_t>(map.centred[4 * i + k] * scale);
      const int low = exponent - 51 + (all == 0 ? 0 : std::countr_zero(static_cast<std::uint64_t>(all)));
      map.centred_bits[k] = exponent_of(map.centred_sum[k]) - low;
    }
  }
  map.centred_test.error[k] = error_bound(component, units, 1);
}

// Computes control points of a lower degree from those of degree n, which are `step` apart. The polynomial
// must have the lower degree. Exact if the coefficients of centre_along() are.
void lower_degree(int n, int lower, const double* points, std::ptrdiff_t step, double* to,
                  std::ptrdiff_t to_step) {
  const double first = points[0], last = points[n * step];
  double c0 = (first + last) / 2, c1 = 0, c2 = 0;
  if (n == 2) c0 = (first + last + 2 * points[step]) / 4, c1 = (last - first) / 2;
  if (n == 3) {
    const double second = points[step], third = points[2 * step];
    c0 = (first + last + 3 * (second + third)) / 8;
    c1 = 3 * ((last - first) + (third - second)) / 8;
    c2 = 3 * ((first + last) - (second + third)) / 8;
  }
  if (lower == 0) to[0] = c0 + 0.0;
  if (lower == 1) to[0] = c0 - c1 + 0.0, to[to_step] = c0 + c1 + 0.0;
  if (lower == 2) {
    to[0] = c0 - c1 + c2 + 0.0, to[to_step] = c0 - c2 + 0.0, to[2 * to_step] = c0 + c1 + c2 + 0.0;
  }
}

// Same as reduce() of component k, in place, but faster for constants and for polynomials whose exact
// coefficients show their degrees.
std::array<int, 2> reduce_component(const PreparedMap& map, int k, double* reduced) {
  const auto [n, m] = map.surface.degree;
  const int count = (n + 1) * (m + 1);
  int same = 1;
  while (same < count && reduced[same] == reduced[0]) ++same;
  if (same == count) {
    reduced[0] += 0.0;
    return {1, 1};
  }
  if (map.centred_bits[k] < kManyBits) {
    int lowest_u = 0, lowest_v = 0;
    const double* own = map.centred + k;
    for (int j = 0; j <= m; ++j) {
      for (int i = 0; i <= n; ++i, own += 4) {
        if (*own != 0) lowest_u = std::max(lowest_u, i), lowest_v = j;
      }
    }
    if (lowest_v < m) {
      for (int i = 0; i <= n; ++i)
        lower_degree(m, lowest_v, reduced + i * (m + 1), 1, reduced + i * (lowest_v + 1), 1);
    }
    if (lowest_u < n) {
      for (int j = 0; j <= lowest_v; ++j)
        lower_degree(n, lowest_u, reduced + j, lowest_v + 1, reduced + j, lowest_v + 1);
    }
    return {lowest_u + 1, lowest_v + 1};
  }
  return reduce({reduced, 1, {n + 1, m + 1}, map.surface.domain}, reduced);
}

}  // namespace

PreparedMap prepare_map(const double* points, std::array<int, 2> order, int components,
                        const std::array<Domain, 2>& domain, double* scaled, double* lowest,
                        double* centred) {
  PreparedMap map;
  map.centred_bits.fill(kManyBits);
  map.surface = {{order[0] - 1, order[1] - 1}, components, domain, scaled};
  scale_by_binomials(points, order, components, scaled);
  const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(order[0]) * order[1];
  // Vectors read this padding beyond the last point.
  std::fill_n(scaled + count * components, 3, 0.0);
  std::array<double, 4> sums{};
  if (std::max(order[0], order[1]) <= kMaxCentredDegree + 1) {
    centre(points, order, components, centred);
    map.centred = centred;
    // All sums are computed together, because each addition of a sum waits for the one before it.
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < 4; ++k)
        sums[k] += std::fabs(centred[4 * i + static_cast<std::ptrdiff_t>(k)]);
    }
    for (int k = 0; k < components; ++k) map.centred_test.error[k] = HUGE_VAL;
  }
  static constexpr std::array kSeparate = {separate<1>, separate<2>, separate<3>, separate<4>};
  kSeparate[static_cast<std::size_t>(components - 1)](points, count, lowest, map);
  for (int k = 0; k < components; ++k) {
    PreparedComponent& component = map.component[k];
    component.unit = HUGE_VAL;
    bool all_finite = std::isfinite(component.largest);
    for (int d : {0, 1}) all_finite = all_finite && (order[d] == 1 || is_finite(domain[d]));
    if (!all_finite) continue;

    component.kind = PreparedComponent::Kind::kGeneral;
    component.unit = unit_of(order, domain, component.largest);
    double* const own = lowest + k * count;
    if (map.centred != nullptr) bound_centred(map, own, count, sums[static_cast<std::size_t>(k)], k);
    const std::array<int, 2> reduced = reduce_component(map, k, own);
    component.lowest = {own, 1, reduced, domain};
    component.lowest_largest = reduced == order ? component.largest : 0;
    for (int i = 0; i < reduced[0] * reduced[1] && reduced != order; ++i) {
      component.lowest_largest = std::max(component.lowest_largest, std::fabs(own[i]));
    }
    const int degree = reduced[0] + reduced[1] - 2;
    if (degree == 0) {
      component.kind = PreparedComponent::Kind::kConstant;
      component.constant = static_cast<float>(own[0] + 0.0);  // -0 is 0
    } else if (degree == 1) {
      const DoubleDouble slope = two_sum(own[1], -own[0]);
      const auto ordinary = [](double x) {
        return x == 0 || (std::fabs(x) > 0x1p-300 && std::fabs(x) < 0x1p300);
      };
      if (slope.low != 0 || !ordinary(slope.high) || !ordinary(own[0])) continue;
      component.kind = PreparedComponent::Kind::kLine;
      component.line_direction = reduced[0] == 2 ? 0 : 1;
      component.first = own[0];
      component.slope = slope.high;
    }
  }
  for (const std::size_t d : {0, 1}) {
    const double inverse = invert_width(domain[d]);
    map.inverse_width[d] = inverse;
    map.place[d] = {2 * inverse, (domain[d].u1 + domain[d].u2) * inverse};
  }
  map.test = make_test(map, weight_units(order[0] - 1, order[1] - 1, kRoundings), 1);
  map.is_direct = GLEV_AT(is_direct, is_direct(map));
  return map;
}

namespace {

// Computes the exact x of an argument inside the domain, and its number of fractional bits. Returns false if
// x is not known to be dyadic.
bool place_exactly(const PreparedMap& map, int direction, const GridArgument& argument, double* x,
                   int* bits) {
  *x = *bits = 0;
  if (map.surface.degree[direction] == 0) return true;
  const Domain& domain = map.surface.domain[direction];
  const auto& [grid, index] = argument;
  if (index == 0 || grid.u1 == grid.u2) {
    const double u = grid.u1;
    const auto& [scale, middle] = map.place[direction];
    if (u == domain.u1 || u == domain.u2) {
      *x = u == domain.u1 ? -1 : 1;
      return true;
    }
    if (scale == 0) return false;
    const double twice = u * scale;
    const DoubleDouble place = two_sum(twice, -middle);
    if (twice / scale != u || place.low != 0 || !(std::fabs(place.high) < 1)) return false;
    constexpr double kMost = 0x1p40;
    const auto part = static_cast<std::int64_t>(place.high * kMost);
    if (static_cast<double>(part) != place.high * kMost) return false;
    *x = place.high;
    *bits = part == 0 ? 0 : std::max(0, 40 - std::countr_zero(static_cast<std::uint64_t>(part)));
    return true;
  }
  const bool is_reversed = spans_backwards(grid, domain);
  if ((!spans(grid, domain) && !is_reversed) || index < 0 || index > grid.segments) return false;
  // x = (2 i - n) / n
  const int twos = std::countr_zero(static_cast<unsigned>(grid.segments));
  const std::int64_t odd = grid.segments >> twos, part = 2 * index - grid.segments;
  if (part % odd != 0) return false;
  *x = static_cast<double>(is_reversed ? -part : part) / grid.segments;
  *bits = part == 0 ? 0 : std::max(0, twos - std::countr_zero(static_cast<std::uint64_t>(part / odd)));
  return true;
}

}  // namespace

bool evaluate_exactly(const PreparedMap& map, int k, const GridArgument& u, const GridArgument& v,
                      double* value) {
  if (map.centred == nullptr || map.centred_bits[k] == kManyBits) return false;
  const auto [n, m] = map.surface.degree;
  double x, y;
  int bits_u, bits_v;
  const bool has_x = place_exactly(map, 0, u, &x, &bits_u), has_y = place_exactly(map, 1, v, &y, &bits_v);
  const int bits = map.centred_bits[k], row = 4 * (n + 1);
  std::array<double, kMaxCentredDegree + 1> curve;
  // Computes the coefficients along v at x. If the curve is constant, y does not matter.
  bool is_constant = has_x && bits + n * bits_u <= kExactBits;
  const bool has_curve = is_constant;
  for (int j = 0; j <= m && has_curve; ++j) {
    const double* const own = map.centred + k + j * row;
    double sum = own[4 * n];
    for (int i = n - 1; i >= 0; --i) sum = sum * x + own[4 * i];
    curve[static_cast<std::size_t>(j)] = sum;
    is_constant = is_constant && (j == 0 || sum == 0);
  }
  if (!is_constant && has_curve && has_y && bits + n * bits_u + m * bits_v <= kExactBits) {
    double sum = curve[static_cast<std::size_t>(m)];
    for (int j = m - 1; j >= 0; --j) sum = sum * y + curve[static_cast<std::size_t>(j)];
    curve[0] = sum;
    is_constant = true;
  }
  // Computes the coefficients along u at y. If the curve is constant, x does not matter.
  if (!is_constant && has_y && bits + m * bits_v <= kExactBits) {
    is_constant = true;
    for (int i = 0; i <= n && is_constant; ++i) {
      const double* const own = map.centred + k + 4 * i;
      double sum = own[m * row];
      for (int j = m - 1; j >= 0; --j) sum = sum * y + own[j * row];
      is_constant = i == 0 || sum == 0;
      if (i == 0) curve[0] = sum;
    }
  }
  *value = curve[0] + 0.0;  // -0 is 0
  return is_constant;
}

int bits_of_places(const Domain& domain, const Grid& grid) {
  const auto segments = static_cast<unsigned>(grid.segments);
  const bool is_dyadic =
      std::has_single_bit(segments) && (spans(grid, domain) || spans_backwards(grid, domain));
  return is_dyadic ? std::max(0, std::countr_zero(segments) - 1) : kManyBits;
}

double growth_of(const Parameter& at, int degree) {
  if (degree == 0) return 1;
  const double base = std::fabs(at.s) + std::fabs(at.t);
  // Inside the domain, s and t have errors of 3 roundings each.
  return base <= 1 + 0x1p-49 ? 1 : std::pow(base * (1 + 0x1p-40), degree) * (1 + 0x1p-20);
}

PreparedMap::Test make_test(const PreparedMap& map, double units, double growth) {
  PreparedMap::Test test;
  for (int k = 0; k < map.surface.components; ++k)
    test.error[k] = error_bound(map.component[k], units, growth);
  return test;
}

}  // namespace glev
