// Draws the control points of random maps.
#include <evalcts/accuracy/samples.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
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
  if (what.data == "ordinary" || what.domain() != kUnitDomain || what.segments() > 0) {
    each([&](int, int) { return as_float(random.between(-1, 1)); });
  } else if (what.data == "integers") {
    each([&](int, int) { return static_cast<double>(random.below(19)) - 9; });
  } else if (what.data == "lines") {
    // The maps have degree 1 or less in each direction.
    const double first = static_cast<double>(random.below(200)) - 100,
                 a = static_cast<double>(random.below(9)) - 4, b = static_cast<double>(random.below(9)) - 4;
    each([&](int i, int j) { return first + a * i + b * j; });
  } else if (what.data == "cancelling") {
    // (1 - 2u)^n (1 - 2v)^m, scaled.
    const double scale = as_float(random.between(1, 2));
    each([&](int i, int j) { return (i + j) % 2 == 0 ? scale : -scale; });
  } else if (what.data == "wide") {
    each([&](int, int) { return as_float(random.scaled(-1, 1, static_cast<int>(random.below(120)) - 60)); });
  } else if (what.data == "extreme") {
    // The values are near the upper or the lower end of the range of float.
    const bool large = random.once_in(2);
    each([&](int, int) {
      return as_float(random.scaled(
          -1, 1,
          large ? 128 - static_cast<int>(random.below(3)) : -125 - static_cast<int>(random.below(25))));
    });
  } else {  // doubles
    each([&](int, int) { return random.scaled(-1, 1, static_cast<int>(random.below(60)) - 30); });
  }
  return points;
}

// Returns x with one changed significand bit, the opposite sign, or another exponent e from least_exponent to
// least_exponent + exponents - 1, where 2^(e-1) <= |x| < 2^e.
float varied(float x, int least_exponent, int exponents, Random& random) {
  int exponent = 0;
  const float significand = std::frexp(x, &exponent);
  if (x == 0 || random.once_in(4)) {
    const auto another = least_exponent + static_cast<int>(random.below(exponents));
    return std::ldexp(x == 0 ? static_cast<float>(random.between(0.5, 1)) : significand, another);
  }
  if (random.once_in(24)) return -x;
  const std::uint32_t flipped = std::bit_cast<std::uint32_t>(x) ^ 1u << random.below(23);
  return std::bit_cast<float>(flipped);
}

}  // namespace

std::string Class::name() const {
  return vorder == 0 ? fmt::format("curve/{}/{}", uorder, data)
                     : fmt::format("surface/{}x{}/{}", uorder, vorder, data);
}

Domain Class::domain() const {
  if (data == "shifted") return {100, 101, -51, -50};
  if (data == "reversed") return {5, -2, 3, -1};
  if (data == "narrow") return {1, 1 + 0x1p-12, 0, 0x1p-12};
  if (data == "huge") return {-0x1p40, 0x1.8p41, 0, 0x1.8p59};
  return kUnitDomain;
}

int Class::segments() const { return data == "grid" ? 1 << 10 : 0; }

float argument_at(double part, double first, double last) {
  return static_cast<float>(std::fma(part, last - first, first));
}
double part_of(float argument, double first, double last) { return (argument - first) / (last - first); }
int grid_index(float argument, double first, double last, int segments) {
  return static_cast<int>(std::lround(part_of(argument, first, last) * segments));
}

void draw_points(Map& map, const Class& what, Random& random) {
  map.points.resize(static_cast<std::size_t>(map.uorder) * map.vorder * map.components);
  for (int k = 0; k < map.components; ++k) {
    const std::vector<double> own = component_points(what, random);
    for (std::size_t i = 0; i < own.size(); ++i) map.points[i * map.components + k] = own[i];
  }
}

void vary_points(std::vector<double>& points, const Class& what, Random& random) {
  // The properties of lines and cancelling maps depend on all of their points, so the points are drawn again.
  if (what.data == "lines" || what.data == "cancelling" || random.once_in(64)) {
    points = component_points(what, random);
    return;
  }
  const std::uint64_t changes = 1 + random.below(3);
  for (std::uint64_t i = 0; i < changes; ++i) {
    double& point = points[random.below(points.size())];
    const auto x = static_cast<float>(point);
    if (what.data == "integers") {
      point = static_cast<double>(random.below(19)) - 9;
    } else if (what.data == "ordinary" || what.domain() != kUnitDomain || what.segments() > 0) {
      point = varied(x, -19, 20, random);
    } else if (what.data == "wide") {
      point = varied(x, -59, 120, random);
    } else if (what.data == "extreme") {
      const bool large = std::abs(points[0]) > 1;
      point = varied(x, large ? 126 : -148, large ? 3 : 24, random);
    } else {
      point = component_points(what, random)[0];
    }
  }
}

}  // namespace evalcts::accuracy
