// Converts the JSON of a case to maps and arguments of the oracle.
#include "value_case.h"

#include <functional>

#include <evalcts/gl/tokens.h>
#include "lint/numbers.h"

namespace evalcts::vectors {

using nlohmann::json;
using reference::Argument;

Map read_map(const json& data) {
  const std::string name = data["target"];
  Map map{};
  for (const auto& targets : {gl::kMap1Targets, gl::kMap2Targets})
    for (const GLenum target : targets)
      if (gl::token_name(target) == name) map.target = target;
  const json &domain = data["domain"], &points = data["points"];
  map.u = {static_cast<int>(points.size()), number(domain[0]), number(domain[1])};
  if (domain.size() > 2) map.v = {static_cast<int>(points[0].size()), number(domain[2]), number(domain[3])};
  const std::function<void(const json&)> read = [&](const json& list) {
    if (list.is_array())
      for (const json& item : list) read(item);
    else
      map.points.push_back(number(list));
  };
  read(points);
  return map;
}

Argument read_argument(const json& data) {
  if (!data.is_object()) return Argument::coordinate(number(data));
  return Argument::grid(data["index"], data["segments"], number(data["first"]), number(data["last"]));
}

Type type_of(const json& entry) { return as_text(entry["map"]["type"]) == "f" ? Type::kSingle : Type::kReal; }

ValueCase::ValueCase(const json& data) : entry(data), type(type_of(data)), map(read_map(data["map"])) {
  const auto add = [&](const Direction& domain, const json& argument) {
    const Argument u = read_argument(argument);
    const Rational width = Rational(domain.last) - Rational(domain.first);
    directions.push_back({domain, u, (u.value() - Rational(domain.first)) / width});
  };
  add(map.u, entry["u"]);
  if (entry.contains("v")) add(map.v, entry["v"]);
  if (!entry.contains("components")) return;
  for (const json& component : entry["components"]) {
    values.push_back(rational(component["exact"]));
    magnitudes.push_back(rational(component["magnitude"]));
  }
}

}  // namespace evalcts::vectors
