// Limits of automatic normals on edges that are a single point.
#include "limit_normals.h"

#include <algorithm>

#include "mutation_point.h"
#include "normal.h"

namespace glev {

LimitNormals::LimitNormals(const double* points, int components, std::array<int, 2> order,
                           const std::array<Domain, 2>& domain)
    : domain_(domain) {
  for (const int direction : {0, 1}) {
    if (order[0] < 2 || order[1] < 2) return;
    for (const bool is_last : {false, true})
      set(edges_[direction][is_last ? 1 : 0], points, components, order, direction, is_last);
  }
}

void LimitNormals::set(Edge& edge, const double* points, int components, std::array<int, 2> order,
                       int direction, bool is_last) {
  const int row = order[1] * components, count = order[1 - direction];
  // Steps from one control point to the next: along the edge, and across it in the direction of the argument.
  const int along = direction == 0 ? components : row, across = direction == 0 ? row : components;
  const double* const first = points + (is_last ? (order[direction] - 1) * across : 0);
  for (int i = 1; i < count; ++i) {
    if (!std::equal(first, first + components, first + i * along)) return;
  }
  edge.is_point = has_edges_ = true;
  edge.point = {0, 0, 0, 1};
  std::copy_n(first, components, edge.point.begin());
  for (int i = 0; i < count; ++i) {
    const double* const lower = first + i * along - (is_last ? across : 0);
    for (int k = 0; k < components; ++k) edge.across[i * components + k] = lower[across + k] - lower[k];
  }
  for (int i = 0; i < (count - 1) * components; ++i)
    edge.slope[i] = edge.across[i + components] - edge.across[i];
  scale_by_binomials(edge.across.data(), {count, 1}, components, edge.across.data());
  scale_by_binomials(edge.slope.data(), {count - 1, 1}, components, edge.slope.data());
  const Domain& domain = domain_[1 - direction];
  edge.across_curve = {count - 1, components, domain, edge.across.data()};
  edge.slope_curve = {count - 2, components, domain, edge.slope.data()};
}

std::array<float, 3> LimitNormals::normal_at(const GridArgument& u, const GridArgument& v) const {
  const std::array<Parameter, 2> at = {locate(domain_[0], u), locate(domain_[1], v)};
  for (const int direction : {1, 0}) {
    if (at[direction].end == Parameter::End::kNeither) continue;
    const bool is_last = at[direction].end == Parameter::End::kLast;
    const Edge& edge = edges_[direction][is_last ? 1 : 0];
    if (!edge.is_point) continue;
    std::array<double, 4> across{}, slope{};
    evaluate(edge.across_curve, at[1 - direction], across.data());
    evaluate(edge.slope_curve, at[1 - direction], slope.data());
    const bool slope_first = (direction == 1) != is_last;
    const std::array<double, 3> normal =
        slope_first ? unit_normal(edge.point, slope, across) : unit_normal(edge.point, across, slope);
    if (normal == std::array<double, 3>{}) continue;
    // Adding 0.0 turns -0 into +0.
    return {static_cast<float>(normal[0] + 0.0), static_cast<float>(normal[1] + 0.0),
            static_cast<float>(GLEV_AT(last_of_limit, normal[2]) + 0.0)};
  }
  return {};
}

}  // namespace glev
