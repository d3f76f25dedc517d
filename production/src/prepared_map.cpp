#include "prepared_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "binomials.h"
#include "double_double.h"
#include "environment.h"
#include "reduction.h"

namespace glev {
namespace {

// Where evaluation in double neither overflows nor loses to underflow what counts.
constexpr double kLargest = 0x1p900, kSmallest = 0x1p-900;

bool is_ordinary(const Domain& domain) {
  const double width = std::fabs(domain.u2 - domain.u1);
  return std::fabs(domain.u1) <= kLargest && std::fabs(domain.u2) <= kLargest && width >= kSmallest;
}

bool is_finite(const Domain& domain) { return std::isfinite(domain.u1) && std::isfinite(domain.u2); }

double unit_of(std::array<int, 2> order, const std::array<Domain, 2>& domain, double largest) {
  if (!(largest <= kLargest && largest >= kSmallest)) return HUGE_VAL;
  for (int d : {0, 1}) {
    if (order[d] > 1 && !is_ordinary(domain[d])) return HUGE_VAL;
  }
  return 0x1p-53 * (1 + 0x1p-20) * largest;
}

// 1 / (u2 - u1) if that and u1 + u2 are exact, else 0.
double invert_width(const Domain& domain) {
  if (two_sum(domain.u1, domain.u2).low != 0) return 0;
  const DoubleDouble width = two_sum(domain.u2, -domain.u1);
  int exponent = 0;
  const double fraction = std::frexp(width.high, &exponent);
  return std::fabs(fraction) == 0.5 && width.low == 0 && std::abs(exponent) < 500 ? 1 / width.high : 0;
}

bool is_direct(const PreparedMap& map) {
  for (const Domain& domain : map.surface.domain) {
    if (is_subnormal(domain.u1) || is_subnormal(domain.u2)) return false;
  }
  for (int k = 0; k < map.surface.components; ++k) {
    const PreparedComponent& component = map.component[k];
    // An interval about a number below that has ends that differ. All zeros are settled whatever happens.
    if (component.largest != 0 && !(map.test.error[k] >= 0x1p-125 && map.test.error[k] < HUGE_VAL))
      return false;
  }
  return true;
}

// In one direction: `count` polynomials of degree n, neighbours `step` apart, from control points to the
// coefficients of powers of x: R_i C(n,i) (1-x)^(n-i) (1+x)^i / 2^n.
void centre_along(int n, int step, double* values) {
  double result[kMaxCentredDegree + 1] = {};
  for (int i = 0; i <= n; ++i) {
    double power[kMaxCentredDegree + 1] = {1};  // small integers
    for (int k = 1; k <= n; ++k) {
      const double sign = k <= i ? 1 : -1;
      for (int j = k; j > 0; --j) power[j] += sign * power[j - 1];
    }
    const double weight = std::ldexp(static_cast<double>(binomial_row(n)[i]), -n);
    for (int k = 0; k <= n; ++k) result[k] += weight * power[k] * values[i * step];
  }
  for (int k = 0; k <= n; ++k) values[k * step] = result[k];
}

// To the coefficients of x^i y^j, in the order of the control points.
void centre(std::array<int, 2> order, int components, double* values) {
  const auto [columns, rows] = order;
  for (int i = 0; i < columns; ++i) {
    for (int k = 0; k < components; ++k)
      centre_along(rows - 1, components, values + i * rows * components + k);
  }
  for (int j = 0; j < rows * components; ++j) centre_along(columns - 1, rows * components, values + j);
}

// Whether centre makes no rounding: the points, below 2^e, are multiples of 2^(e-45), and the coefficients
// have at most 6 bits behind the last of these, and 2 in front.
bool is_centred_exactly(const double* points, std::ptrdiff_t count, int components, double largest) {
  int exponent = 0;
  std::frexp(largest, &exponent);
  const double scale = std::ldexp(1, 45 - exponent);
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    constexpr double kWhole = 0x1.8p52;
    const double point = points[i * components] * scale, whole = point + kWhole;
    if (whole - kWhole != point) return false;
  }
  return true;
}

// The error of a test, for values in double.
double error_bound(const PreparedComponent& component, double units, double growth) {
  if (component.kind == PreparedComponent::Kind::kConstant && component.largest == 0) return 0;
  // Beyond that a Horner sum could overflow on the way, and Highway's conversions to float need not give
  // infinity.
  const bool is_safe = component.largest * growth <= 0x1p127;
  // The sums round by at most a unit of their magnitude, which is below twice max|R| * growth. Smaller
  // errors could make zeros of both signs, which compare equal.
  const double error = (units + 2) * component.unit * growth;
  return is_safe && error >= 0x1p-145 ? error : HUGE_VAL;
}

PreparedMap::Test make_centred_test(const PreparedMap& map, const double* points, std::ptrdiff_t count) {
  const auto [n, m] = map.surface.degree;
  const int components = map.surface.components;
  PreparedMap::Test test;
  for (int k = 0; k < components; ++k) {
    const PreparedComponent& component = map.component[k];
    double sum = 0, units = 0;
    if (std::isfinite(component.unit)) {
      for (std::ptrdiff_t i = 0; i < count; ++i) sum += std::fabs(map.centred[i * components + k]);
      const bool is_exact = is_centred_exactly(points + k, count, components, component.largest);
      units = centred_units(n, m, sum / component.largest, is_exact);
    }
    test.error[k] = error_bound(component, units, 1);
  }
  return test;
}

}  // namespace

PreparedMap prepare_map(const double* points, std::array<int, 2> order, int components,
                        const std::array<Domain, 2>& domain, double* scaled, double* lowest,
                        double* centred) {
  PreparedMap map;
  map.surface = {{order[0] - 1, order[1] - 1}, components, domain, scaled};
  scale_by_binomials(points, order, components, scaled);
  const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(order[0]) * order[1];
  // What vectors read beyond the last point.
  std::fill_n(scaled + count * components, 3, 0.0);
  for (int k = 0; k < components; ++k) {
    PreparedComponent& component = map.component[k];
    component.unit = HUGE_VAL;
    bool all_finite = true;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      const double point = points[i * components + k];
      all_finite = all_finite && std::isfinite(point);
      component.largest = std::max(component.largest, std::fabs(point));
    }
    for (int d : {0, 1}) all_finite = all_finite && (order[d] == 1 || is_finite(domain[d]));
    if (!all_finite) continue;

    component.kind = PreparedComponent::Kind::kGeneral;
    double* const own = lowest + k * count;
    const std::array<int, 2> reduced = reduce({points + k, components, order, domain}, own);
    component.lowest = {own, 1, reduced, domain};
    component.unit = unit_of(order, domain, component.largest);
    for (int i = 0; i < reduced[0] * reduced[1]; ++i) {
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
  map.inverse_width = {invert_width(domain[0]), invert_width(domain[1])};
  map.test = make_test(map, weight_units(order[0] - 1, order[1] - 1, kRoundings), 1);
  map.is_direct = is_direct(map);
  if (std::max(order[0], order[1]) <= kMaxCentredDegree + 1) {
    std::copy_n(points, count * components, centred);
    centre(order, components, centred);
    map.centred = centred;
    map.centred_test = make_centred_test(map, points, count);
  }
  return map;
}

bool has_direct_map(const PreparedMap& map) {
  const auto [n, m] = map.surface.degree;
  return map.is_direct && n == 3 && (m == 0 || m == 3) && map.inverse_width[0] != 0 &&
         (m == 0 || map.inverse_width[1] != 0);
}

DirectMap direct_map_of(const PreparedMap& map, double* centred) {
  DirectMap direct;
  for (std::size_t d : {0, 1}) {
    const auto [u1, u2] = map.surface.domain[d];
    const double inverse = map.inverse_width[d];
    direct.place[d] = {2 * inverse, (u1 + u2) * inverse};
  }
  const auto [n, m] = map.surface.degree;
  const int components = map.surface.components, points = (n + 1) * (m + 1);
  direct.test = map.centred_test;
  for (int i = 0; i < points; ++i) {
    std::copy_n(map.centred + i * components, components, centred + 4 * i);
    if (components == 3) centred[4 * i + 3] = i == 0 ? 1 : 0;
  }
  direct.centred = centred;
  return direct;
}

double growth_of(const Parameter& at, int degree) {
  if (degree == 0) return 1;
  const double base = std::fabs(at.s) + std::fabs(at.t);
  // Inside, s and t are off by 3 roundings each.
  return base <= 1 + 0x1p-49 ? 1 : std::pow(base * (1 + 0x1p-40), degree) * (1 + 0x1p-20);
}

PreparedMap::Test make_test(const PreparedMap& map, double units, double growth) {
  PreparedMap::Test test;
  for (int k = 0; k < map.surface.components; ++k)
    test.error[k] = error_bound(map.component[k], units, growth);
  return test;
}

}  // namespace glev
