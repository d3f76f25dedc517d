// Reads maps and arguments from the JSON of a case, and checks them.
#include "problem.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include <evalcts/gl/tokens.h>
#include "numbers.h"

namespace evalcts::vectors {
namespace {

using nlohmann::json;

GLenum target_of(const json& name) {
  for (const auto& targets : {gl::kMap1Targets, gl::kMap2Targets})
    for (const GLenum target : targets)
      if (gl::token_name(target) == as_text(name)) return target;
  throw std::invalid_argument(fmt::format("{} is not the target of a map", name.dump()));
}

Type type_of(const json& name) {
  if (as_text(name) == "f") return Type::kSingle;
  if (as_text(name) == "d") return Type::kReal;
  throw std::invalid_argument(fmt::format(R"(the type {} is neither "f" nor "d")", name.dump()));
}

double number_of(const json& text, Type type) {
  const double value = number(text);
  const bool is_of_type = type == Type::kReal || static_cast<double>(static_cast<float>(value)) == value;
  if (!std::isfinite(value) || !is_of_type)
    throw std::invalid_argument(
        fmt::format("{} is not a finite binary{}", text.dump(), type == Type::kSingle ? 32 : 64));
  return value;
}

Argument argument_of(const json& data, Type type) {
  if (!data.is_object()) return Argument::coordinate(number_of(data, type));
  return Argument::grid(data.at("index").get<std::int64_t>(), data.at("segments").get<std::int64_t>(),
                        number_of(data.at("first"), type), number_of(data.at("last"), type));
}

void expect_size(const json& list, std::size_t size, const char* items) {
  if (list.size() != size)
    throw std::invalid_argument(fmt::format("{} {}, expected {}", list.size(), items, size));
}

}  // namespace

Problem problem_of(const json& entry) {
  const json &map = entry.at("map"), &points = map.at("points"), &domain = map.at("domain");
  const Type type = type_of(map.at("type"));
  Problem problem{{target_of(map.at("target")), {}, {}, {}}, type, argument_of(entry.at("u"), type)};
  const bool is_surface = problem.map.is_two_dimensional();
  expect_size(domain, is_surface ? 4 : 2, "ends of the domain");
  const auto direction = [&](const json& list, std::size_t end) -> Direction {
    if (list.empty()) throw std::invalid_argument("no control points");
    const double first = number_of(domain[end], type), last = number_of(domain[end + 1], type);
    if (first == last) throw std::invalid_argument("the ends of the domain are equal");
    return {static_cast<int>(list.size()), first, last};
  };
  problem.map.u = direction(points, 0);
  if (is_surface) {
    problem.map.v = direction(points.at(0), 2);
    problem.v = argument_of(entry.at("v"), type);
  }
  const auto add = [&](const json& point) {
    expect_size(point, static_cast<std::size_t>(problem.map.components()), "values of a control point");
    for (const json& value : point) problem.map.points.push_back(number_of(value, type));
  };
  for (const json& row : points) {
    if (!is_surface) {
      add(row);
      continue;
    }
    expect_size(row, points[0].size(), "control points in a row");
    for (const json& point : row) add(point);
  }
  return problem;
}

}  // namespace evalcts::vectors
