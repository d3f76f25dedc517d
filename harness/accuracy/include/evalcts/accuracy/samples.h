// The classes of maps of the accuracy table, and random maps, arguments and variations of them.
#pragma once

#include <evalcts/accuracy/random_map.h>
#include <array>
#include <string>
#include <vector>

namespace evalcts::accuracy {

using Domain = std::array<double, 4>;  // u1, u2, v1, v2
inline constexpr Domain kUnitDomain = {0, 1, 0, 1};

// A class of maps: one pair of orders (vorder 0: one-dimensional) and one kind of data. Kinds over [0,1] are
// those of random_component(). Shifted, reversed, narrow and huge are ordinary data over another domain; grid
// is ordinary data at the points of a grid of 2^10 segments.
struct Class {
  int uorder, vorder;
  std::string data;

  std::string name() const;  // "curve/4/ordinary", "surface/4x4/integers"
  Domain domain() const;
  int segments() const;  // segments of the grid whose points are the arguments; 0: coordinates
};
std::vector<Class> table_classes();

struct Map {
  int uorder, vorder;  // vorder 1: one-dimensional, or constant in v
  int components;
  Domain domain = kUnitDomain;
  int segments = 0;                 // of the grid over the domain whose points are evaluated; 0: coordinates
  std::vector<double> points = {};  // floats; v fastest, components innermost
};

// Returns a map of the class without control points.
Map map_of(const Class& what, int components);
// Sets random control points of the class, independently for each component.
void draw_points(Map& map, const Class& what, Random& random);
// Changes a few control points of one component (v varies fastest) within the class.
void vary_points(std::vector<double>& points, const Class& what, Random& random);

// Return the argument at a fraction of the domain, and the fraction of an argument.
float argument_at(double part, double first, double last);
double part_of(float argument, double first, double last);
// Returns the index of the point of the grid over the domain that is closest to the argument.
int grid_index(float argument, double first, double last, int segments);

// Return a random argument: a multiple of 2^-24 of the domain, with probability 1/16 a multiple of 1/16,
// where exact zeros and ties occur; and one near u. With segments, both return points of the grid.
float random_argument(double first, double last, int segments, Random& random);
float varied_argument(float u, double first, double last, int segments, Random& random);

}  // namespace evalcts::accuracy
