// Reads the questions of the vectors: a map, and the arguments to evaluate it at.
#pragma once

#include <reference/component.h>

#include <optional>
#include <vector>

#include <evalcts/results/json.h>

namespace evalcts::vectors {

using reference::Argument;
using reference::Map;
using reference::Rational;
using Direction = reference::Map::Direction;
using Values = std::vector<double>;

// The type of a map, "f" or "d": all its numbers are binary32 or binary64.
enum class Type { kSingle, kReal };

// Returns the number of significant bits of the type.
constexpr int bits_of(Type type) { return type == Type::kSingle ? 24 : 53; }

// A map and its argument. Surfaces have `v`.
struct Problem {
  Map map;
  Type type;
  Argument u;
  std::optional<Argument> v = {};
};

// Returns the problem of a case about a value or a normal, from its members "map", "u" and "v". Throws
// std::exception if a member is missing or is not what INTERPRETING.md describes, except that numbers may
// also be decimal.
Problem problem_of(const nlohmann::json& entry);

}  // namespace evalcts::vectors
