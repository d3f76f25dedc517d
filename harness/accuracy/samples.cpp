#include "harness/accuracy/samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace evalcts::accuracy {
namespace {

std::vector<double> component_points(const Class& what, Random& random) {
  const int vorder = std::max(what.vorder, 1);
  const int n = what.uorder - 1, m = vorder - 1;
  std::vector<double> points(static_cast<std::size_t>(what.uorder) * vorder);
  const auto each = [&](const auto& value) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= m; ++j) points[i * vorder + j] = value(i, j);
    }
  };
  const auto as_float = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  if (what.data == "ordinary") {
    each([&](int, int) { return as_float(random.between(-1, 1)); });
  } else if (what.data == "integers") {
    each([&](int, int) { return static_cast<double>(random.below(19)) - 9; });
  } else if (what.data == "lines") {
    // Of degree 1 in one direction, or of 1 in both, and less.
    const double first = static_cast<double>(random.below(200)) - 100,
                 a = static_cast<double>(random.below(9)) - 4, b = static_cast<double>(random.below(9)) - 4;
    each([&](int i, int j) { return first + a * i + b * j; });
  } else if (what.data == "cancelling") {
    // (1 - 2u)^n (1 - 2v)^m, scaled.
    const double scale = as_float(random.between(1, 2));
    each([&](int i, int j) { return (i + j) % 2 == 0 ? scale : -scale; });
  } else if (what.data == "wide") {
    each([&](int, int) {
      return as_float(std::ldexp(random.between(-1, 1), static_cast<int>(random.below(120)) - 60));
    });
  } else if (what.data == "extreme") {
    // Around both ends of the range of float.
    const bool large = random.once_in(2);
    each([&](int, int) {
      return as_float(std::ldexp(random.between(-1, 1), large ? 128 - static_cast<int>(random.below(3))
                                                              : -125 - static_cast<int>(random.below(25))));
    });
  } else {  // doubles
    each(
        [&](int, int) { return std::ldexp(random.between(-1, 1), static_cast<int>(random.below(60)) - 30); });
  }
  return points;
}

}  // namespace

std::string Class::name() const {
  return vorder == 0 ? fmt::format("curve/{}/{}", uorder, data)
                     : fmt::format("surface/{}x{}/{}", uorder, vorder, data);
}

void draw_points(Map& map, const Class& what, Random& random) {
  map.points.resize(static_cast<std::size_t>(map.uorder) * map.vorder * map.components);
  for (int k = 0; k < map.components; ++k) {
    const std::vector<double> own = component_points(what, random);
    for (std::size_t i = 0; i < own.size(); ++i) map.points[i * map.components + k] = own[i];
  }
}

}  // namespace evalcts::accuracy
