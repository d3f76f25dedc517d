// Draws random maps and arguments.
#include "rounding_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rounding {

std::string Class::name() const {
  return vorder == 0 ? fmt::format("curve/{}/{}", uorder, data)
                     : fmt::format("surface/{}x{}/{}", uorder, vorder, data);
}

std::vector<Class> classes() {
  std::vector<Class> all;
  const auto add = [&](std::initializer_list<std::array<int, 2>> orders,
                       std::initializer_list<const char*> kinds) {
    for (const auto& [u, v] : orders)
      for (const char* kind : kinds) all.push_back({u, v, kind});
  };
  add({{2, 0}, {3, 0}, {4, 0}, {6, 0}, {10, 0}, {30, 0}, {64, 0}, {2, 2}, {4, 4}, {3, 8}, {1, 5}, {30, 30}},
      {"ordinary", "integers", "lines", "cancelling", "wide", "extreme", "doubles"});
  add({{2, 0}, {3, 0}, {4, 0}, {6, 0}, {2, 2}, {3, 3}, {4, 4}, {2, 4}, {6, 5}},
      {"dyadic", "decimal", "symmetric"});
  return all;
}

namespace {

std::vector<double> tie_rich_points(const Map& map, const std::string& data, Random& random) {
  const int n = map.uorder - 1, m = map.vorder - 1;
  std::vector<double> points(static_cast<std::size_t>(map.uorder) * map.vorder * map.components);
  const auto point = [&](int i, int j, int k) -> double& {
    return points[static_cast<std::size_t>(i * map.vorder + j) * map.components + k];
  };
  const double range = random.once_in(2) ? 1 : std::ldexp(1, static_cast<int>(random.below(8)));
  const double step = data == "dyadic" ? std::ldexp(range, -static_cast<int>(random.below(25)))
                                       : std::pow(10, -1 - static_cast<double>(random.below(4)));
  for (int k = 0; k < map.components; ++k) {
    const double sign_u = random.once_in(2) ? 1 : -1, sign_v = random.once_in(2) ? 1 : -1;
    const bool is_constant_along_u = random.once_in(6);
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= m; ++j) {
        double& own = point(i, j, k);
        own = static_cast<float>(std::round(random.between(-range, range) / step) * step);
        if (is_constant_along_u && i > 0) own = point(0, j, k);
        if (data != "symmetric") continue;
        if (2 * i > n) own = sign_u * point(n - i, j, k);
        if (2 * i == n && sign_u < 0) own = 0;
        if (2 * j > m && m > 0) own = sign_v * point(i, m - j, k);
        if (2 * j == m && m > 0 && sign_v < 0) own = 0;
      }
    }
  }
  return points;
}

Interval random_domain(Random& random) {
  switch (random.below(6)) {
    case 0:
      return {static_cast<double>(random.below(10)), 16};
    case 1:
      return {static_cast<float>(random.between(-3, 0)), static_cast<float>(random.between(0.5, 9))};
    case 2:
      return {1, 0};
    default:
      return {0, 1};
  }
}

}  // namespace

std::vector<double> draw_points(const Map& map, const Class& what, Random& random) {
  if (what.is_tie_rich()) return tie_rich_points(map, what.data, random);
  return evalcts::accuracy::random_points(what.data, map.uorder, map.vorder, map.components, random);
}

Map random_map(const Class& what, Random& random) {
  Map map{what.uorder, std::max(what.vorder, 1), 1 + static_cast<int>(random.below(4)), what.vorder > 0,
          what.data != "doubles"};
  for (Interval& domain : map.domain) domain = random_domain(random);
  if (what.is_tie_rich()) {
    const std::array<Interval, 4> domains = {{{0, 1}, {0, 1}, {1, 0}, {-1, 1}}};
    for (Interval& domain : map.domain) domain = domains[random.below(4)];
  }
  map.points = draw_points(map, what, random);
  return map;
}

double random_argument(const Interval& interval, Random& random) {
  const double u1 = interval[0], width = interval[1] - interval[0];
  const auto place = [&](double t) { return static_cast<double>(static_cast<float>(u1 + t * width)); };
  switch (random.below(8)) {
    case 0:
      return u1 + static_cast<double>(random.below(1025)) / 1024 * width;
    case 1:
      return static_cast<float>(u1 + random.scaled(0, 1, -static_cast<int>(random.below(60))) * width);
    case 2:
      return place(random.between(-0.5, 1.5));
    case 3:
      return place(1 - random.scaled(0, 1, -static_cast<int>(random.below(24))));
    default:
      return place(random.uniform());
  }
}

}  // namespace rounding
