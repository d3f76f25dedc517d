// Computes the control points of derivatives, as maps where they are doubles.
#include "derivatives.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "double_double.h"
#include "mutation_point.h"
#include "plan.h"
#include "resolve.h"

namespace glev {
namespace {

const PreparedMap& vertex_map(const glev_plan& plan) { return plan.map(Attribute::kVertex); }

// The steps between control points whose differences are the control points of a derivative.
struct Steps {
  Steps(std::array<int, 2> order, int components, const Derivative& derivative)
      : row(static_cast<std::ptrdiff_t>(order[1]) * components),
        first(derivative[0] > 0 ? row : components),
        second(derivative[1] > 0 ? components : row) {}

  std::ptrdiff_t row;            // from point (i, j) to point (i + 1, j)
  std::ptrdiff_t first, second;  // the directions of the differences
};

// Computes the control points of a derivative if they are doubles.
bool compute_points(const PreparedMap& map, const double* points, const Derivative& derivative,
                    double* result) {
  const std::array<int, 2> degree = map.surface.degree;
  const int components = map.surface.components;
  double factor = 1;
  for (const std::size_t d : {0, 1}) {
    for (int k = 0; k < derivative[d]; ++k) factor *= (degree[d] - k) * map.inverse_width[d];
  }
  const auto is_ordinary = [](double x) { return std::fabs(x) >= 0x1p-300 && std::fabs(x) <= 0x1p300; };
  if (!is_ordinary(factor)) return false;
  const Steps at({degree[0] + 1, degree[1] + 1}, components, derivative);
  const bool is_second = derivative[0] + derivative[1] == 2;
  for (int i = 0; i <= degree[0] - derivative[0]; ++i) {
    const double* own = points + i * at.row;
    const double* const end = own + (degree[1] + 1 - derivative[1]) * components;
    for (; own != end; ++own) {
      DoubleDouble difference = two_sum(own[at.first], -own[0]);
      double lost = difference.low;
      if (is_second) {
        const DoubleDouble far = two_sum(own[at.first + at.second], -own[at.second]);
        difference = two_sum(far.high, -difference.high);
        lost = std::fabs(lost) + std::fabs(far.low) + std::fabs(difference.low);
      }
      const DoubleDouble point = two_product(difference.high, factor);
      const bool is_exact = GLEV_AT(exact_derivative, lost == 0 && point.low == 0);
      if (!is_exact || !(difference.high == 0 || is_ordinary(difference.high))) return false;
      *result++ = point.high;
    }
  }
  return true;
}

}  // namespace

std::array<double, 4> differences_of(const double* points, std::array<int, 2> order, int components,
                                     const Derivative& derivative, int first, int count, double* result) {
  const Steps at(order, components, derivative);
  const bool is_second = derivative[0] + derivative[1] == 2;
  std::array<double, 4> largest{}, poison{};
  for (int i = 0; i < order[0] - derivative[0]; ++i) {
    const double* own = points + i * at.row + first;
    for (int j = 0; j < order[1] - derivative[1]; ++j, own += components) {
      for (int k = 0; k < count; ++k) {
        const double near = own[k + at.first] - own[k];
        const double far = is_second ? own[k + at.first + at.second] - own[k + at.second] : 0;
        const double magnitude = std::fabs(near) + std::fabs(far);
        largest[k] = std::max(largest[k], magnitude);
        poison[k] += magnitude * 0;  // NaN if the magnitude is not finite
        *result++ = is_second ? far - near : near;
      }
    }
  }
  for (std::size_t k = 0; k < largest.size(); ++k) {
    if (poison[k] != 0) largest[k] = HUGE_VAL;
  }
  return largest;
}

DerivativeMap::DerivativeMap(const glev_plan& plan, const Derivative& derivative) {
  const PreparedMap& map = vertex_map(plan);
  const Surface& surface = map.surface;
  const std::array<int, 2> order = order_of(surface, derivative);
  std::array<double, kMostValues> points;
  if (is_zero(surface, derivative) || order[0] * order[1] * surface.components > kMostValues ||
      !compute_points(map, plan.points(), derivative, points.data()))
    return;
  map_ = prepare_map(points.data(), order, surface.components, surface.domain, scaled_.data(), lowest_.data(),
                     centred_.data());
  map_.encloses = map.encloses;
  is_there_ = true;
}

DerivativeNet::DerivativeNet(const glev_plan& plan, const Derivative& derivative)
    : plan_(plan), derivative_(derivative) {}

// The rounding errors, in units of 2^-53 times the largest sum of differences, are 13 (n + m) + 8 of the
// evaluation, 3 of the differences, 4 of the binomials, and 6 of the factor and its product; see bernstein.h.
int DerivativeNet::load(int first) {
  const Surface& map = vertex_map(plan_).surface;
  const std::array<int, 2> order = order_of(map, derivative_);
  const int count = std::min(map.components - first, kMostValues / (order[0] * order[1]));
  const std::array<double, 4> largest =
      differences_of(plan_.points(), {map.degree[0] + 1, map.degree[1] + 1}, map.components, derivative_,
                     first, count, points_.data());
  scale_by_binomials(points_.data(), order, count, points_.data());
  surface_ = {{order[0] - 1, order[1] - 1}, count, map.domain, points_.data()};
  first_ = first;
  factor_ = 1;
  bool is_ordinary = true;
  for (const std::size_t d : {0, 1}) {
    const Domain& domain = map.domain[d];
    double width = 1;
    int falling = 1;
    for (int k = 0; k < derivative_[d]; ++k) falling *= map.degree[d] - k, width *= domain.u2 - domain.u1;
    factor_ *= falling / width;
    is_ordinary = is_ordinary && (map.degree[d] == 0 || glev::is_ordinary(domain));
  }
  const double size = std::fabs(factor_);
  is_ordinary = is_ordinary && size >= 0x1p-300 && size <= 0x1p300;
  const auto [n, m] = surface_.degree;
  for (std::size_t k = 0; k < largest.size(); ++k) {
    const bool has_bound = is_ordinary && largest[k] >= 0x1p-300 && largest[k] <= 0x1p300;
    const double units = (13 * (n + m) + 24) * (1 + 0x1p-20);
    error_[k] = largest[k] == 0 ? 0 : has_bound ? units * 0x1p-53 * largest[k] * size : HUGE_VAL;
  }
  curve_ = {};
  return count;
}

void DerivativeNet::move_to(const GridArgument& v) {
  if (curve_.components != 0 && v_.index == v.index && v_.grid == v.grid) return;
  const Parameter at = locate(surface_.domain[1], v);
  curve_ = curve_at(surface_, at, room_.data());
  growth_ = at.is_sure ? growth_of(at, surface_.degree[1]) : HUGE_VAL;
  v_ = v;
}

template <class Real>
void DerivativeNet::evaluate_at(const GridArgument& u, Real* values) const {
  const Parameter at = locate(surface_.domain[0], u);
  std::array<double, 4> in_double;
  evaluate(curve_, at, in_double.data());
  const double growth = at.is_sure ? growth_ * growth_of(at, surface_.degree[0]) : HUGE_VAL;
  for (int k = 0; k < surface_.components; ++k) {
    const double error = error_[k] == 0 ? 0 : growth <= 0x1p300 ? error_[k] * growth : HUGE_VAL;
    values[k] = resolve_derivative<Real>(vertex_map(plan_), derivative_, first_ + k, u, v_,
                                         in_double[k] * factor_, error);
  }
}

template void DerivativeNet::evaluate_at(const GridArgument& u, float* values) const;
template void DerivativeNet::evaluate_at(const GridArgument& u, double* values) const;

}  // namespace glev
