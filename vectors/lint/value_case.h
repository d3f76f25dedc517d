// Reads a case that asks for a value or a normal from its JSON.
#pragma once

#include "write/problem.h"

namespace evalcts::vectors {

// Returns x rounded to the nearest number of the type.
double rounded(const Rational& x, Type type);

// One direction of a case: the domain and order of the map, the argument, and t = (argument - u1)/(u2 - u1).
struct ValueDirection {
  Direction domain;
  Argument argument;
  Rational t;
};

struct ValueCase : Problem {
  // Throws as problem_of() does.
  explicit ValueCase(const nlohmann::json& entry);

  const nlohmann::json& entry;
  std::vector<ValueDirection> directions;
  // The exact values of the components and the magnitudes of their terms; empty for normals.
  std::vector<Rational> values, magnitudes;
};

}  // namespace evalcts::vectors
