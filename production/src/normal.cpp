// Automatic normals in double and, if that is not accurate enough, in double-double arithmetic.
#include "normal.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "enclosure.h"
#include "mutation_point.h"
#include "plan.h"

namespace glev {
namespace {

// ---- In double, without bounds

// Scales the components by a power of two if their products could leave the range of double. The largest
// magnitude becomes a number in [1/2, 1), or near it for subnormal numbers, without rounding. Zero and
// non-finite vectors do not change.
template <std::size_t kCount>
void scale_to_unit(std::array<double, kCount>& v) {
  double largest = 0;
  for (const double x : v) largest = std::max(largest, std::fabs(x));
  const bool harmless = largest > 0x1p-100 && largest < 0x1p100;
  if (harmless || largest == 0 || !std::isfinite(largest)) return;
  int exponent = 0;
  std::frexp(largest, &exponent);
  const double factor = std::ldexp(1.0, std::min(-exponent, 1023));
  for (double& x : v) x *= factor;
}

using Vector = std::array<double, 3>;

// ---- In double-double, with computed error bounds

// Rounds an error bound outward. The factor covers the roundings of its computation, and the summand covers
// underflow, because magnitudes are near 1.
double round_outward(double error) { return error * (1 + 0x1p-40) + 0x1p-900; }

Enclosure operator*(const Enclosure& x, const Enclosure& y) {
  const double size_x = std::fabs(x.value.high), size_y = std::fabs(y.value.high);
  const double error =
      size_x * y.error + size_y * x.error + x.error * y.error + 9 * 0x1p-106 * size_x * size_y;
  return {x.value * y.value, error == 0 ? 0 : round_outward(error)};
}

Enclosure operator-(const Enclosure& x, const Enclosure& y) {
  const double size = std::fabs(x.value.high) + std::fabs(y.value.high);
  const double error = x.error + y.error + 4 * 0x1p-106 * size;
  return {x.value - y.value, error == 0 ? 0 : round_outward(error)};
}

// Returns the cross product of numbers or of enclosures.
template <class Number>
std::array<Number, 3> cross_product(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], GLEV_AT(cross_product, a[2] * b[0] - a[0] * b[2]),
          a[0] * b[1] - a[1] * b[0]};
}

// Returns w^2 times the derivative of (x, y, z) / w.
template <class Number>
std::array<Number, 3> derive_quotient(const std::array<Number, 4>& p,
                                      const std::array<Number, 4>& derivative) {
  std::array<Number, 3> result;
  for (std::size_t k = 0; k < 3; ++k)
    result[k] = GLEV_AT(quotient_rule, p[3] * derivative[k] - derivative[3] * p[k]);
  return result;
}

// Scales enclosures by a power of two to magnitudes near 1. Returns false if one is not finite.
template <std::size_t kCount>
bool scale_to_unit(std::array<Enclosure, kCount>& v) {
  double largest = 0;
  for (const Enclosure& x : v) {
    if (!(x.error < HUGE_VAL) || !std::isfinite(x.value.high)) return false;
    largest = std::max(largest, std::fabs(x.value.high));
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (Enclosure& x : v) {
    x.value = {std::ldexp(x.value.high, -exponent), std::ldexp(x.value.low, -exponent)};
    x.error = x.error == 0 ? 0 : round_outward(std::ldexp(x.error, -exponent));
  }
  return true;
}

// Computes the normal from enclosures. Returns false if there is no bound.
bool from_enclosures(const PreparedMap& map, const GridArgument& u, const GridArgument& v,
                     std::array<float, 3>* result) {
  const int components = map.surface.components;
  std::array<Enclosure, 4> p{}, p_u{}, p_v{};
  for (int k = 0; k < components; ++k) {
    const PreparedComponent& component = map.component[k];
    if (component.kind == PreparedComponent::Kind::kUnclaimed) return false;
    p_u[k] = enclose_derivative(component.lowest, {1, 0}, u, v);
    p_v[k] = enclose_derivative(component.lowest, {0, 1}, u, v);
    if (components == 4) p[k] = enclose(component.lowest, component.lowest_largest, u, v);
  }
  if (!scale_to_unit(p) || !scale_to_unit(p_u) || !scale_to_unit(p_v)) return false;
  std::array<Enclosure, 3> a = {p_u[0], p_u[1], p_u[2]}, b = {p_v[0], p_v[1], p_v[2]};
  if (components == 4) a = derive_quotient(p, p_u), b = derive_quotient(p, p_v);
  if (!scale_to_unit(a) || !scale_to_unit(b)) return false;
  std::array<Enclosure, 3> m = cross_product(a, b);
  if (!scale_to_unit(m)) return false;
  double square = 0;
  for (const Enclosure& x : m) square += x.value.high * x.value.high;
  const double inverse = 1 / std::sqrt(square);
  for (std::size_t k = 0; k < 3; ++k) {
    const bool is_zero = std::fabs(m[k].value.high) <= m[k].error * (1 + 0x1p-40);
    (*result)[k] = is_zero ? 0.0f : static_cast<float>(m[k].value.high * inverse);
  }
  return true;
}

// ---- A row

const PreparedMap& vertices_of(const glev_plan& plan) {
  return plan.map(GLEV_AT(map_of_normals, Attribute::kVertex));
}

// Computes `count` sums of degree + 1 points times the weights of one direction, and scales them.
void combine_points(const double* points, int components, int count, int degree, const double* weights,
                    double scale, double* result) {
  for (int i = 0; i < count; ++i, result += 4) {
    std::array<double, 4> sum{};
    for (int k = 0; k < components; ++k) sum[k] = weights[0] * *points++;
    for (int j = 1; j <= degree; ++j) {
      for (int k = 0; k < components; ++k) sum[k] += weights[j] * *points++;
    }
    for (std::size_t k = 0; k < 4; ++k) result[k] = sum[k] * scale;
  }
}

}  // namespace

Vector unit_normal(std::array<double, 4> p, std::array<double, 4> p_u, std::array<double, 4> p_v) {
  scale_to_unit(p);
  scale_to_unit(p_u);
  scale_to_unit(p_v);
  Vector a = derive_quotient(p, p_u), b = derive_quotient(p, p_v);
  scale_to_unit(a);
  scale_to_unit(b);
  Vector m = cross_product(a, b);
  scale_to_unit(m);
  const double length = std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
  if (GLEV_AT(has_no_length, !(length > 0) || !std::isfinite(length))) return {0, 0, 0};
  for (double& x : m) x /= length;
  return m;
}

NormalBounds bound_normals(const Surface& vertex, const NormalMajorants& largest) {
  constexpr double kUnit = 0x1p-53, kLargest = 0x1p400, kSmallest = 0x1p-400;
  NormalBounds bounds;
  const bool is_rational = vertex.components == 4;
  NormalMajorants scaled = largest;
  for (int net = is_rational ? kPoint : kTangentU; net < kNets; ++net) {
    double most = 0;
    for (const double x : largest[net]) {
      if (x != 0 && !(x >= kSmallest && x <= kLargest)) return bounds;
      most = std::max(most, x);
    }
    int exponent = 0;
    std::frexp(most, &exponent);
    bounds.scale[net] = std::ldexp(1.0, -exponent);
    for (double& x : scaled[net]) x *= bounds.scale[net];
  }
  for (const int d : {0, 1}) {
    // In such a domain, t and s do not underflow or overflow.
    if (!is_ordinary(vertex.domain[d])) return bounds;
  }
  const auto& [p, u, v] = scaled;
  std::array<double, 3> a = {u[0], u[1], u[2]}, b = {v[0], v[1], v[2]}, majorant;
  const int degrees = vertex.degree[0] + vertex.degree[1];
  double c = (5 * (degrees - 1) + 7) * kUnit;
  if (is_rational) {
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = p[3] * u[k] + u[3] * p[k];
      b[k] = p[3] * v[k] + v[3] * p[k];
    }
    c += (5 * degrees + 6) * kUnit + 2 * kUnit;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    majorant[k] = a[i] * b[j] + a[j] * b[i];
    const bool vanishes = (a[i] == 0 || b[j] == 0) && (a[j] == 0 || b[i] == 0);
    // The factor covers terms of second order, and the summand covers underflow.
    bounds.error[k] =
        vanishes ? 0 : GLEV_AT(error_of_normal, (2 * c + 2 * kUnit)) * (1 + 0x1p-20) * majorant[k] + 0x1p-900;
  }
  const auto& e = bounds.error;
  const double least = 0x1p31 * (1 + 0x1p-20) * std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
  bounds.least_square = std::max(least * least, 0x1p-800);
  return bounds;
}

void NormalRow::move_to(const GridArgument& v, bool with_points) {
  v_ = v;
  if (GLEV_AT(needs_no_row, !plan_.automatic_normals())) return;
  const Surface& surface = vertices_of(plan_).surface;
  const auto [n, m] = surface.degree;
  if (n == 0 || m == 0) return;
  const Parameter at = locate(surface.domain[1], v);
  growth_ = at.is_sure ? growth_of(at, m) : HUGE_VAL;
  if (!(growth_ < 0x1p40)) return;
  std::array<double, kMaxOrder> weights, weights_of_tangent;
  scalar_weights(m, at.s, at.t, weights.data());
  scalar_weights(m - 1, at.s, at.t, weights_of_tangent.data());
  const auto& scale = plan_.normal_bounds().scale;
  const auto combine = [&](NormalNet net, const Surface& points, const auto& with) {
    combine_points(points.scaled, points.components, points.degree[0] + 1, points.degree[1], with.data(),
                   scale[net], points_[net].data());
  };
  if (surface.components == 4 || with_points) combine(kPoint, surface, weights);
  combine(kTangentU, plan_.tangent(0), weights);
  combine(kTangentV, plan_.tangent(1), weights_of_tangent);
}

std::array<float, 3> NormalRow::normal_at(const GridArgument& u) const {
  const Surface& surface = vertices_of(plan_).surface;
  const auto [n, m] = surface.degree;
  if (n == 0 || m == 0) return {0, 0, 0};
  const Parameter at = locate(surface.domain[0], u);
  const double growth = at.is_sure ? growth_ * growth_of(at, n) : HUGE_VAL;
  const bool is_rational = surface.components == 4;
  std::array<float, 3> result;
  if (growth < 0x1p40) {
    std::array<double, kMaxOrder> weights, weights_of_tangent;
    scalar_weights(n, at.s, at.t, weights.data());
    scalar_weights(n - 1, at.s, at.t, weights_of_tangent.data());
    std::array<std::array<double, 4>, kNets> value;
    // Rows have four values for each point, padding included.
    if (is_rational) combine_points(points(kPoint), 4, 1, n, weights.data(), 1, value[kPoint].data());
    combine_points(points(kTangentU), 4, 1, n - 1, weights_of_tangent.data(), 1, value[kTangentU].data());
    combine_points(points(kTangentV), 4, 1, n, weights.data(), 1, value[kTangentV].data());
    const auto& [p, p_u, p_v] = value;
    Vector a = {p_u[0], p_u[1], p_u[2]}, b = {p_v[0], p_v[1], p_v[2]};
    if (GLEV_AT(derives_quotient, is_rational)) {
      a = GLEV_AT(quotient_in_u, derive_quotient(p, p_u));
      b = GLEV_AT(quotient_in_v, derive_quotient(p, p_v));
    }
    const Vector product = cross_product(a, b);
    const double square = (product[0] * product[0] + product[1] * product[1]) + product[2] * product[2];
    double factor = growth * growth;
    if (is_rational) factor *= factor;
    const NormalBounds& bounds = plan_.normal_bounds();
    if (square >= bounds.least_square * (factor * factor)) {
      const double inverse = 1 / std::sqrt(square);
      for (std::size_t k = 0; k < 3; ++k) {
        const bool is_zero = GLEV_AT(is_unknown, std::fabs(product[k]) <= bounds.error[k] * factor);
        result[k] = is_zero ? 0.0f : static_cast<float>(GLEV_AT(unit_component, product[k] * inverse));
      }
      return result;
    }
  }
  if (from_enclosures(vertices_of(plan_), u, v_, &result)) return result;

  const auto plainly = [&](const Surface& net, std::array<double, 4> value) {
    std::array<double, kMaxOrder * 4> room;
    evaluate(curve_at(net, locate(net.domain[1], v_), room.data()), at, value.data());
    return value;
  };
  const Vector normal = unit_normal(plainly(surface, {0, 0, 0, 1}), plainly(plan_.tangent(0), {}),
                                    plainly(plan_.tangent(1), {}));
  for (std::size_t k = 0; k < 3; ++k) result[k] = static_cast<float>(normal[k]);
  return result;
}

}  // namespace glev
