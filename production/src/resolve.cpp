// Decides the results that evaluation in double leaves open, from the fastest method to the exact one.
#include "resolve.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "double_double.h"
#include "enclosure.h"
#include "exact.h"
#include "mutation_point.h"
#include "target.h"

namespace glev {
namespace {

bool is_finite(const GridArgument& argument) {
  return std::isfinite(argument.grid.u1) && std::isfinite(argument.grid.u2);
}

// Returns true if an argument is a point of a grid over the domain with few segments.
bool is_short(const Domain& domain, const GridArgument& argument) {
  const Grid& grid = argument.grid;
  return (spans(grid, domain) || spans_backwards(grid, domain)) && grid.segments < 4096;
}

// Evaluates in double alone.
double resolve_plainly(const PreparedMap& map, int k, const GridArgument& u, const GridArgument& v) {
  std::array<double, kMaxOrder * 4> room;
  const Curve curve = curve_at(map.surface, locate(map.surface.domain[1], v), room.data());
  std::array<double, 4> result;
  evaluate(curve, locate(curve.domain, u), result.data());
  return result[k];
}

// Returns the sum of both parts of x, rounded to odd. The result is on the same side of every number with
// fewer bits.
double round_to_odd(const DoubleDouble& x) {
  auto bits = std::bit_cast<std::uint64_t>(x.high);
  if (x.low != 0 && (bits & 1) == 0) bits += (x.low > 0) == (x.high > 0) ? 1 : -1;
  return std::bit_cast<double>(bits);
}

// Computes first + t * slope, correctly rounded, if t is a double. The method is the emulated FMA of Boldo
// and Melquiond ("Emulation of a FMA and correctly rounded sums", 2008), except that the last rounding is to
// odd, too, followed by rounding to float. Returns false if t is not a double.
bool resolve_on_line(const PreparedComponent& line, const GridArgument& argument, float* result) {
  const Domain& domain = line.lowest.domain[line.line_direction];
  const Grid& grid = argument.grid;
  if (grid.u1 != grid.u2 && argument.index != 0) return false;
  const DoubleDouble a = two_sum(grid.u1, -domain.u1), width = two_sum(domain.u2, -domain.u1);
  int exponent = 0;
  const double fraction = std::frexp(width.high, &exponent);
  const bool is_power = std::fabs(fraction) == 0.5 && width.low == 0;
  const double t = a.high / width.high;
  if (!is_power || a.low != 0 || !(t == 0 || (std::fabs(t) > 0x1p-300 && std::fabs(t) < 0x1p300)))
    return false;
  const DoubleDouble product = two_product(t, line.slope), low = two_sum(line.first, product.low),
                     high = two_sum(product.high, low.high);
  const double odd = round_to_odd(two_sum(high.high, round_to_odd(two_sum(high.low, low.low))));
  *result = static_cast<float>(odd + 0.0);  // -0 + 0.0 = 0
  return true;
}

}  // namespace

float resolve(const PreparedMap& map, int k, const GridArgument& u, const GridArgument& v, double value,
              double error) {
  const bool is_claimed = map.component[k].kind != PreparedComponent::Kind::kUnclaimed;
  float result;
  return is_claimed && settle({value, 0}, error, &result) ? result : resolve(map, k, u, v);
}

float resolve(const PreparedMap& map, int k, const GridArgument& u, const GridArgument& v) {
  const PreparedComponent& component = map.component[k];
  if (component.kind == PreparedComponent::Kind::kConstant) return component.constant;
  if (component.kind == PreparedComponent::Kind::kUnclaimed || !is_finite(u) || !is_finite(v))
    return static_cast<float>(resolve_plainly(map, k, u, v) + 0.0);
  double exact;
  if (evaluate_exactly(map, k, u, v, &exact)) return static_cast<float>(exact);
  float result;
  if (component.kind == PreparedComponent::Kind::kLine &&
      resolve_on_line(component, component.line_direction == 0 ? u : v, &result))
    return result;
  // Values that double leaves open there are ties as a rule, and exact sums are short.
  const auto [domain_u, domain_v] = map.surface.domain;
  const bool has_short_sum = map.centred_bits[k] < kManyBits && is_short(domain_u, u) &&
                             (map.surface.degree[1] == 0 || is_short(domain_v, v));
  if (!has_short_sum) {
    const Enclosure enclosure = map.encloses(component.lowest, component.lowest_largest, u, v);
    if (settle(enclosure.value, enclosure.error, &result)) return result;
  }
  return round_exactly(component.lowest, u, v);
}

double resolve_in_double(const PreparedMap& map, int k, const GridArgument& u, const GridArgument& v) {
  const PreparedComponent& component = map.component[k];
  if (component.kind == PreparedComponent::Kind::kUnclaimed || !is_finite(u) || !is_finite(v))
    return resolve_plainly(map, k, u, v);
  if (component.kind == PreparedComponent::Kind::kConstant) return component.lowest.points[0] + 0.0;
  double exact;
  if (evaluate_exactly(map, k, u, v, &exact)) return exact;
  const Enclosure enclosure = map.encloses(component.lowest, component.lowest_largest, u, v);
  // This error and half an ULP of rounding are less than one ULP.
  if (!(enclosure.error <= 0x1p-54 * std::fabs(enclosure.value.high)))
    return round_exactly<double>(component.lowest, u, v);
  return enclosure.value.high;
}

template <class Real>
Real resolve_derivative(const PreparedMap& map, const Derivative& derivative, int k, const GridArgument& u,
                        const GridArgument& v, double value, double error) {
  constexpr bool kIsFloat = sizeof(Real) == sizeof(float);
  const PreparedComponent& component = map.component[k];
  if (component.kind == PreparedComponent::Kind::kUnclaimed || !is_finite(u) || !is_finite(v))
    return static_cast<Real>(value);
  float nearest;
  if (kIsFloat && settle({value, 0}, error, &nearest)) return static_cast<Real>(nearest);
  Enclosure enclosure = enclose_derivative(component.lowest, derivative, u, v);
  for (const std::size_t d : {0, 1}) {
    const auto [u1, u2] = map.surface.domain[d];
    const DoubleDouble width = two_sum(u2, -u1);
    const double size = std::fabs(width.high);
    for (int i = 0; i < derivative[d]; ++i) {
      enclosure.value = enclosure.value / width;
      enclosure.error = enclosure.error / size * (1 + 0x1p-40) + 0x1p-100 * std::fabs(enclosure.value.high);
      if (!(size >= 0x1p-150 && size <= 0x1p150)) enclosure.error = HUGE_VAL;
    }
  }
  if (kIsFloat && settle(enclosure.value, enclosure.error, &nearest)) return static_cast<Real>(nearest);
  if (!kIsFloat && GLEV_AT(derivative_is_sure, enclosure.error <= 0x1p-54 * std::fabs(enclosure.value.high)))
    return static_cast<Real>(enclosure.value.high + 0.0);  // +0 for -0
  return round_exactly<Real>(component.lowest, u, v, derivative);
}

template float resolve_derivative(const PreparedMap&, const Derivative&, int, const GridArgument&,
                                  const GridArgument&, double, double);
template double resolve_derivative(const PreparedMap&, const Derivative&, int, const GridArgument&,
                                   const GridArgument&, double, double);

}  // namespace glev
