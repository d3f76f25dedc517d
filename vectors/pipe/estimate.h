// Values and normals in extended precision with bounds on their errors: they decide nearly all answers at a
// thousandth of the cost of exact arithmetic.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "write/values.h"

namespace evalcts::vectors {

// The exact value lies within `error` of `value`. `magnitude` is the sum of the magnitudes of its terms,
// `reach` is (|t| + |s|)^n times the largest control value (surfaces: both factors), up to which the accuracy
// rule applies.
struct Estimate {
  long double value, magnitude, error, reach = 0;
};

// One for each component; nothing if the argument is too near to an end of the domain to be told from it.
std::optional<std::vector<Estimate>> estimate(const Problem& problem);

// The unit normal within 2^-18, in each component; nothing if it cannot be had to that.
std::optional<std::array<double, 3>> estimate_normal(const Problem& problem);

}  // namespace evalcts::vectors
