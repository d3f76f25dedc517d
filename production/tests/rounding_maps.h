// The classes of maps of the program glevaluator_rounding, and random maps and arguments of them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <evalcts/accuracy/random_map.h>

namespace rounding {

using evalcts::accuracy::Random;

// A class of maps: orders (vorder 0: curves) and kind of data.
struct Class {
  int uorder, vorder;
  std::string data;

  std::string name() const;  // "curve/4/ordinary", "surface/4x4/integers"
  // Data of typical models, for which ties and zeros are frequent: multiples of a power of two, short
  // decimals, and short decimals in symmetric or antisymmetric nets.
  bool is_tie_rich() const { return data == "dyadic" || data == "decimal" || data == "symmetric"; }
};

std::vector<Class> classes();

using Interval = std::array<double, 2>;

struct Map {
  int uorder, vorder;  // vorder 1: one-dimensional, or constant in v
  int components;
  bool two_dimensional, is_float;
  std::array<Interval, 2> domain = {{{0, 1}, {0, 1}}};
  std::vector<double> points = {};  // v fastest, components innermost
};

// Returns the control points of a map of the class. The orders and the components are those of the map.
std::vector<double> draw_points(const Map& map, const Class& what, Random& random);

Map random_map(const Class& what, Random& random);

// Returns a number, mostly inside the interval: uniform, dyadic, near an end, or slightly outside.
double random_argument(const Interval& interval, Random& random);

}  // namespace rounding
