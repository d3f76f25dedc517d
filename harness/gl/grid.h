// Finds grids that contain given arguments.
#pragma once

#include <optional>
#include <vector>

namespace evalcts::gl {

// A grid of `segments` equal steps from `first` to `last`, and the index of each argument: index * (last -
// first) / segments + first equals the argument exactly.
struct GridThrough {
  int segments = 1;
  double first = 0, last = 1;
  std::vector<int> indices;
};

// Returns the coarsest grid from the smallest to the largest argument that contains all of them, or nothing
// if it has 2^16 segments or more, or an argument is not finite.
std::optional<GridThrough> grid_through(const std::vector<double>& arguments);

}  // namespace evalcts::gl
