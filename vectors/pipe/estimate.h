// Values and normals in extended precision with bounds on their errors. They decide nearly all answers, at a
// thousandth of the cost of exact arithmetic.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "write/problem.h"

namespace evalcts::vectors {

// A value whose exact value lies within `error` of `value`. `magnitude`: the sum of the magnitudes of its
// terms; `reach`: (|t| + |s|)^n (for surfaces the product of both directions) times the largest control
// value, which the accuracy rule limits.
struct Estimate {
  long double value, magnitude, error, reach = 0;
};

// Returns an estimate for each component, or nothing if rounding may change the relative distance of the
// argument from an end of the domain too much.
std::optional<std::vector<Estimate>> estimate(const Problem& problem);

// A unit normal, each component of which is accurate to `error`.
struct NormalEstimate {
  std::array<double, 3> normal;
  double error;
};

// Returns the unit normal with an error of at most 2^-18, or nothing if this accuracy is not certain.
std::optional<NormalEstimate> estimate_normal(const Problem& problem);

}  // namespace evalcts::vectors
