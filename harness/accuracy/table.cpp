// The classes of the accuracy table, and the measurement of a row.
#include <evalcts/accuracy/table.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include <reference/bernstein_form.h>

#include <evalcts/gl/tokens.h>

namespace evalcts::accuracy {
namespace {

constexpr std::size_t kArguments = 256, kArgumentsOfLarge = 64;
constexpr int kLarge = 200;  // control points

// Returns a multiple of 2^-24 in [0,1], or with probability 1/16 a multiple of 1/16, where exact zeros and
// ties occur. If there is a grid, returns one of its points.
double random_part(Random& random, int segments) {
  if (segments > 0)
    return static_cast<double>(random.below(static_cast<std::uint64_t>(segments) + 1)) / segments;
  if (random.once_in(16)) return static_cast<double>(random.below(17)) / 16;
  return std::ldexp(static_cast<double>(random.below((1u << 24) + 1)), -24);
}

}  // namespace

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

Map map_of(const RowRequest& request) {
  const Class& what = request.what;
  const int components = gl::components_of(target_of(request.target, what.vorder > 0));
  return {what.uorder,
          std::max(what.vorder, 1),
          components,
          true,
          request.domain.value_or(what.domain()),
          {},
          request.segments.value_or(what.segments())};
}

std::size_t arguments_of_a_map(const Class& what) {
  return what.uorder * std::max(what.vorder, 1) > kLarge ? kArgumentsOfLarge : kArguments;
}

Errors measure(Subject& subject, const RowRequest& request, const std::atomic<bool>& stop) {
  const Class& what = request.what;
  const bool two_dimensional = what.vorder > 0;
  const GLenum target = target_of(request.target, two_dimensional);
  const std::size_t count = arguments_of_a_map(what);
  Map map = map_of(request);
  const auto& [u1, u2, v1, v2] = map.domain;
  const std::uint64_t maps = (request.values + count * map.components - 1) / (count * map.components);
  std::vector<float> u(count), v(two_dimensional ? count : 0), results(count * map.components);
  Errors errors;
  for (std::uint64_t item = 0; item < maps && !stop; ++item) {
    Random random(request.seed, item);
    draw_points(map, what, random);
    for (float& x : u) x = argument_at(random_part(random, map.segments), u1, u2);
    for (float& x : v) x = argument_at(random_part(random, map.segments), v1, v2);
    subject.evaluate(target, map, u, v, results);
    for (int k = 0; k < map.components; ++k) {
      Input input{map.uorder, map.vorder, two_dimensional, {}, 0, 0, map.domain, map.segments};
      for (std::size_t i = k; i < map.points.size(); i += map.components)
        input.points.push_back(map.points[i]);
      const reference::BernsteinForm exact(input.surface());
      for (std::size_t a = 0; a < count; ++a) {
        input.u = u[a];
        if (two_dimensional) input.v = v[a];
        errors.add(results[a * map.components + k],
                   exact.evaluate_with_magnitude(input.argument_u(), input.argument_v()), input);
      }
    }
  }
  return errors;
}

float replay(Subject& subject, const std::string& target_name, const Input& input) {
  const GLenum target = target_of(target_name, input.two_dimensional);
  Map map{input.uorder, input.vorder, gl::components_of(target), true, input.domain, {}, input.segments};
  for (const double point : input.points) map.points.insert(map.points.end(), map.components, point);
  std::vector<float> results(map.components);
  const std::vector<float> v(input.two_dimensional ? 1 : 0, input.v);
  subject.evaluate(target, map, std::span(&input.u, 1), v, results);
  return results[0];
}

std::string bits(float value) { return fmt::format("0x{:08x}", std::bit_cast<std::uint32_t>(value)); }

}  // namespace evalcts::accuracy
