// Defines the classes of the accuracy table, and draws and varies maps and arguments.
#include <evalcts/accuracy/samples.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace evalcts::accuracy {
namespace {

constexpr std::uint64_t kSteps = 1u << 24;  // arguments are multiples of 2^-24 of the domain

// Returns the kind of the control points.
std::string data_of(const Class& what) {
  return what.domain() != kUnitDomain || what.segments() > 0 ? "ordinary" : what.data;
}

std::vector<double> random_component(const Class& what, Random& random) {
  return random_component(data_of(what), what.uorder, std::max(what.vorder, 1), random);
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
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) ^ 1u << random.below(23));
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

std::vector<Class> table_classes() {
  std::vector<Class> all;
  const std::vector<std::string> data = {"ordinary", "integers", "lines", "cancelling", "wide", "extreme"};
  for (const int order : {2, 3, 4, 6, 10, 20, 30})
    for (const std::string& kind : data) all.push_back({order, 0, kind});
  for (const auto& [u, v] : {std::pair{2, 2}, {4, 4}, {3, 8}, {30, 30}})
    for (const std::string& kind : data) all.push_back({u, v, kind});
  for (const int vorder : {0, 4})
    for (const char* kind : {"shifted", "reversed", "narrow", "huge", "grid"})
      all.push_back({4, vorder, kind});
  return all;
}

Map map_of(const Class& what, int components) {
  return {what.uorder, std::max(what.vorder, 1), components, what.domain(), what.segments()};
}

void draw_points(Map& map, const Class& what, Random& random) {
  map.points = random_points(data_of(what), map.uorder, map.vorder, map.components, random);
}

void vary_points(std::vector<double>& points, const Class& what, Random& random) {
  // The properties of lines and cancelling maps depend on all of their points, so the points are drawn again.
  const std::string data = data_of(what);
  if (data == "lines" || data == "cancelling" || random.once_in(64)) {
    points = random_component(what, random);
    return;
  }
  const std::uint64_t changes = 1 + random.below(3);
  for (std::uint64_t i = 0; i < changes; ++i) {
    double& point = points[random.below(points.size())];
    const auto x = static_cast<float>(point);
    const bool large = std::abs(points[0]) > 1;  // the end of the range of extreme data
    point = data == "integers"   ? static_cast<double>(random.below(19)) - 9
            : data == "ordinary" ? varied(x, -19, 20, random)
            : data == "wide"     ? varied(x, -59, 120, random)
                                 : varied(x, large ? 126 : -148, large ? 3 : 24, random);
  }
}

float argument_at(double part, double first, double last) {
  return static_cast<float>(std::fma(part, last - first, first));
}
double part_of(float argument, double first, double last) { return (argument - first) / (last - first); }
int grid_index(float argument, double first, double last, int segments) {
  return static_cast<int>(std::lround(part_of(argument, first, last) * segments));
}

float random_argument(double first, double last, int segments, Random& random) {
  const auto part = [&](std::uint64_t steps) {
    return static_cast<double>(random.below(steps + 1)) / static_cast<double>(steps);
  };
  if (segments > 0) return argument_at(part(static_cast<std::uint64_t>(segments)), first, last);
  return argument_at(random.once_in(16) ? part(16) : part(kSteps), first, last);
}

float varied_argument(float u, double first, double last, int segments, Random& random) {
  auto step = static_cast<std::uint64_t>(std::lround(part_of(u, first, last) * kSteps));
  switch (random.below(8)) {
    case 0:
      step = random.below(kSteps + 1);
      break;
    case 1:
    case 2:
      step += random.below(2001);
      step -= std::min<std::uint64_t>(step, 1000);
      break;
    case 3:
      break;
    default:
      step ^= std::uint64_t{1} << random.below(24);
  }
  step = std::min(step, kSteps);
  if (segments > 0) step -= step % (kSteps / static_cast<std::uint64_t>(segments));
  return argument_at(static_cast<double>(step) / kSteps, first, last);
}

}  // namespace evalcts::accuracy
