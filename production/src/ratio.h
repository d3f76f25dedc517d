// The exact position of an argument in its domain, as a ratio of integers.
#pragma once

#include <array>

#include "parameter.h"
#include "wide_integer.h"

namespace glev {

// In units of the smallest double, 2^-1074, with domains and grids below 2^1024, less than 2^31 segments and
// indices of at most 33 bits, |a| + |b| is less than 2^kRatioBits.
inline constexpr int kRatioBits = 1074 + 1024 + 37;

// |a|, |b| or a + b, without leading zero limbs.
struct RatioPart {
  std::array<Limb, limbs_for(kRatioBits + 1)> limbs;
  int size;
  bool negative;
};

// t = a / (a + b) and 1 - t = b / (a + b), with a + b > 0 and a and b not both even.
struct Ratio {
  RatioPart a, b, whole;
};

// Locates the argument exactly. Sets the ratio unless the argument is at an end of the domain. All values
// must be finite and the ends of the domain different. Common factors of a and b are divided out if the
// numbers fit into a limb.
Parameter::End to_ratio(const Domain& domain, const GridArgument& argument, Ratio& ratio);

// Computes u2 - u1 = width * 2^exponent exactly. The ends of the domain must be finite and different. Returns
// the exponent.
int to_width(const Domain& domain, RatioPart& width);

}  // namespace glev
