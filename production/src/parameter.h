// Where in its domain a map is evaluated, one direction.
#pragma once

#include <cmath>
#include <cstdint>

#include <glevaluator.h>

#include "production/src/fault.h"

namespace glev {

// The interval [u1, u2] of a map; u1 > u2 is legal.
struct Domain {
  double u1 = 0, u2 = 1;
};

// The state MapGrid sets, one direction.
struct Grid {
  double u1 = 0, u2 = 1;
  glev_int segments = 1;
  bool operator==(const Grid&) const = default;
};

// Point i of a grid, which stands for exactly u1 + i * (u2 - u1) / segments: meshes are asked for by index,
// because a rounded argument would no longer be that number.
struct GridArgument {
  Grid grid;
  std::int64_t index;
};

// Barycentric coordinates of an argument: t = (u - u1) / (u2 - u1) and s = 1 - t, each with a small relative
// error of its own, which 1 - t would not have.
struct Parameter {
  enum class End { kNeither, kFirst, kLast };
  double s, t;
  End end;  // the argument is the first or last end of the domain
};

// A real argument.
inline Parameter Locate(const Domain& domain, double u) {
  if (u == domain.u1) return {1, 0, Parameter::End::kFirst};
  if (u == domain.u2) return {0, 1, Parameter::End::kLast};
  const double width =
      GLEV_FAULTY(WidthWithoutSign) ? std::fabs(domain.u2 - domain.u1) : domain.u2 - domain.u1;
  if (GLEV_FAULTY(QuotientsSubtracted)) {
    const float t = static_cast<float>(u / width) - static_cast<float>(domain.u1 / width);
    return {1 - t, t, Parameter::End::kNeither};
  }
  if (GLEV_FAULTY(SFromRoundedT)) {
    const float t = static_cast<float>((u - domain.u1) / width);
    return {1 - t, t, Parameter::End::kNeither};
  }
  if (GLEV_FAULTY(DivisionBeforeSubtraction)) {
    const double t = static_cast<float>(u / width) - static_cast<float>(domain.u1 / width);
    return {1 - t, t, Parameter::End::kNeither};
  }
  return {(domain.u2 - u) / width, (u - domain.u1) / width, Parameter::End::kNeither};
}

// A grid argument. Indices 0 and segments are the ends of the grid exactly (GL §21.1); where they coincide,
// every index is.
inline Parameter Locate(const Domain& domain, const GridArgument& argument) {
  const Grid& grid = argument.grid;
  const std::int64_t i = argument.index;
  if (i == 0 || grid.u1 == grid.u2) return Locate(domain, grid.u1);
  if (i == grid.segments) return Locate(domain, grid.u2);
  // Affine in i between the coordinates of the grid's ends. If the grid spans the domain these are 0 and 1,
  // and t is i/n correctly rounded.
  if (GLEV_FAULTY(GridSpansDomain))
    return {1 - double(i) / grid.segments, double(i) / grid.segments, Parameter::End::kNeither};
  const Parameter first = Locate(domain, grid.u1), last = Locate(domain, grid.u2);
  const double a = static_cast<double>(grid.segments - i), b = static_cast<double>(i);
  const auto between = [&](double from, double to) { return (a * from + b * to) / grid.segments; };
  return {between(first.s, last.s), between(first.t, last.t), Parameter::End::kNeither};
}

}  // namespace glev
