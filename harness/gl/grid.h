// Grids through given arguments.
#pragma once

#include <optional>
#include <vector>

namespace evalcts::gl {

// A grid of `segments` equal steps from `first` to `last`, and for each argument its index: index * (last -
// first) / segments + first is the argument, as real numbers.
struct GridThrough {
  int segments = 1;
  double first = 0, last = 1;
  std::vector<int> indices;
};

// The coarsest grid from the smallest argument to the largest that has them all; none if it would have 2^16
// segments or more, or an argument is not finite.
std::optional<GridThrough> grid_through(const std::vector<double>& arguments);

}  // namespace evalcts::gl
