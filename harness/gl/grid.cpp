// Finds the coarsest grid through given arguments: its step is the greatest common divisor of their
// distances, as exact integers.
#include "grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace evalcts::gl {

std::optional<GridThrough> grid_through(const std::vector<double>& arguments) {
  if (arguments.empty() || !std::ranges::all_of(arguments, [](double x) { return std::isfinite(x); }))
    return {};
  const auto [low, high] = std::ranges::minmax(arguments);
  if (low == high) return GridThrough{1, low, low == 0 ? 1 : 2 * low, std::vector<int>(arguments.size(), 0)};

  // All arguments are converted to multiples of one power of two.
  constexpr std::int64_t kSegments = 1 << 16;
  constexpr double kExact = 0x1p53;
  int exponent = 0;
  std::vector<std::int64_t> multiples;
  for (std::size_t i = 0; i < arguments.size();) {
    const double multiple = std::ldexp(arguments[i], exponent);
    if (std::abs(multiple) > kExact) return {};
    if (multiple != std::trunc(multiple)) {
      exponent += 1;
      multiples.clear();
      i = 0;
      continue;
    }
    multiples.push_back(static_cast<std::int64_t>(multiple));
    ++i;
  }
  const auto [first, last] = std::ranges::minmax(multiples);
  std::int64_t step = 0;
  for (const std::int64_t multiple : multiples) step = std::gcd(step, multiple - first);
  if ((last - first) / step >= kSegments) return {};

  GridThrough grid{static_cast<int>((last - first) / step), low, high, {}};
  for (const std::int64_t multiple : multiples)
    grid.indices.push_back(static_cast<int>((multiple - first) / step));
  return grid;
}

}  // namespace evalcts::gl
