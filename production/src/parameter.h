// Domains, grids, and arguments in one direction of a map.
#pragma once

#include <cmath>
#include <cstdint>

#include <glevaluator.h>

#include "double_double.h"

namespace glev {

// The interval [u1, u2] of a map; u1 > u2 is legal.
struct Domain {
  double u1 = 0, u2 = 1;
};

// The state that MapGrid sets for one direction.
struct Grid {
  double u1 = 0, u2 = 1;
  glev_int segments = 1;
  bool operator==(const Grid&) const = default;
};

// Return true if the grid goes from the first end of the domain to the last one, or back.
inline bool spans(const Grid& grid, const Domain& domain) {
  return grid.u1 == domain.u1 && grid.u2 == domain.u2;
}
inline bool spans_backwards(const Grid& grid, const Domain& domain) {
  return grid.u1 == domain.u2 && grid.u2 == domain.u1;
}

// Point `index` of a grid, exactly u1 + index * (u2 - u1) / segments. Points of meshes are passed by index,
// because a rounded argument would be another number.
struct GridArgument {
  Grid grid;
  std::int64_t index;
};

// Returns a real argument as a GridArgument.
inline GridArgument argument_at(double u) { return {{u, u, 1}, 0}; }

// Barycentric coordinates of an argument: t = (u - u1) / (u2 - u1) and s = 1 - t. Both have a relative error
// of three roundings; s is not computed as 1 - t, whose relative error could be larger.
struct Parameter {
  enum class End { kNeither, kFirst, kLast };
  double s, t;
  End end;              // tells if the argument is an end of the domain
  bool is_sure = true;  // false if cancellation made the relative errors larger
};

// Locates a real argument.
inline Parameter locate(const Domain& domain, double u) {
  if (u == domain.u1) return {1, 0, Parameter::End::kFirst};
  if (u == domain.u2) return {0, 1, Parameter::End::kLast};
  const double width = domain.u2 - domain.u1;
  return {(domain.u2 - u) / width, (u - domain.u1) / width, Parameter::End::kNeither};
}

// Locates a grid argument. The indices 0 and `segments` are exactly the ends of the grid (GL §21.1); if the
// ends are equal, so is every point.
inline Parameter locate(const Domain& domain, const GridArgument& argument) {
  const Grid& grid = argument.grid;
  const double i = static_cast<double>(argument.index), n = grid.segments;
  if (i == 0 || grid.u1 == grid.u2) return locate(domain, grid.u1);
  if (i == n) return locate(domain, grid.u2);
  if (spans(grid, domain)) return {(n - i) / n, i / n, Parameter::End::kNeither};
  if (spans_backwards(grid, domain)) return {i / n, (n - i) / n, Parameter::End::kNeither};
  // Computes n * (u - u1) and n * (u2 - u) for u = grid.u1 + i * (grid.u2 - grid.u1) / n. The differences of
  // ends are exact.
  const DoubleDouble run = two_sum(grid.u2, -grid.u1) * i;
  const DoubleDouble start = two_sum(grid.u1, -domain.u1) * n, rest = two_sum(domain.u2, -grid.u1) * n;
  const DoubleDouble a = start + run, b = rest - run, width = two_sum(domain.u2, -domain.u1) * n;
  const auto is_sure = [&](const DoubleDouble& part, const DoubleDouble& sum) {
    return std::fabs(sum.high) >= 0x1p-40 * (std::fabs(part.high) + std::fabs(run.high));
  };
  return {b.high / width.high, a.high / width.high, Parameter::End::kNeither,
          is_sure(start, a) && is_sure(rest, b)};
}

// Returns x = t - s of a point of a grid that spans the domain, with one rounding.
inline double place_on(const GridArgument& argument) {
  const double n = argument.grid.segments;
  return static_cast<double>(2 * argument.index - argument.grid.segments) / n;
}

}  // namespace glev
