// Reads a case that asks for a value or a normal from its JSON.
#pragma once

#include <reference/component.h>

#include <optional>

#include <evalcts/results/json.h>
#include "write/maps.h"

namespace evalcts::vectors {

Map read_map(const nlohmann::json& data);
reference::Argument read_argument(const nlohmann::json& data);
Type type_of(const nlohmann::json& entry);

// One direction of a case: the domain and order of the map, the argument, and t = (argument - u1)/(u2 - u1).
struct ValueDirection {
  Direction domain;
  reference::Argument argument;
  Rational t;
};

struct ValueCase {
  explicit ValueCase(const nlohmann::json& entry);

  const nlohmann::json& entry;
  Type type;
  Map map;
  std::vector<ValueDirection> directions;
  // The exact values of the components and the magnitudes of their terms; empty for normals.
  std::vector<Rational> values, magnitudes;
};

}  // namespace evalcts::vectors
