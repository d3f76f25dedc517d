// Adds to the question of a case what the claims about it need.
#include "value_case.h"

#include <reference/rounding.h>

#include "write/numbers.h"

namespace evalcts::vectors {

double rounded(const Rational& x, Type type) {
  return type == Type::kSingle ? reference::round_to_float(x) : reference::round_to_double(x);
}

ValueCase::ValueCase(const nlohmann::json& data) : Problem(problem_of(data)), entry(data) {
  const auto add = [&](const Direction& domain, const Argument& argument) {
    const Rational width = Rational(domain.last) - Rational(domain.first);
    directions.push_back({domain, argument, (argument.value() - Rational(domain.first)) / width});
  };
  add(map.u, u);
  if (v) add(map.v, *v);
  if (!entry.contains("components")) return;
  for (const nlohmann::json& component : entry["components"]) {
    values.push_back(rational(component["exact"]));
    magnitudes.push_back(rational(component["magnitude"]));
  }
}

}  // namespace evalcts::vectors
