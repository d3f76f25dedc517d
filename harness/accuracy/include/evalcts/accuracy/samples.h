// Random maps: classes of orders and data, and seeded random numbers that are the same on every machine.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace evalcts::accuracy {

// Random numbers that are the same on every machine. The distributions of the standard library differ between
// libraries. Those of Boost.Random do not, but they draw different numbers from the same engine (of a million
// doubles, a third are equal), so they would change the published digests and the maps of published seeds.
// The random programs of harness/fuzz draw in the same way for the same reason.
class Random {
 public:
  // Each `item` (a part of a task) has its own sequence, so that parts can be processed in any order.
  Random(std::uint32_t seed, std::uint64_t item) {
    std::seed_seq sequence{seed, static_cast<std::uint32_t>(item), static_cast<std::uint32_t>(item >> 32)};
    engine_.seed(sequence);
  }
  std::uint64_t below(std::uint64_t limit) { return engine_() % limit; }
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  // [0,1)
  double between(double low, double high) { return low + (high - low) * uniform(); }
  // Returns a number in [low, high) times 2^exponent. An exponent that is random, too, is drawn first,
  // because it is an argument: the order does not depend on the compiler.
  double scaled(double low, double high, int exponent) { return std::ldexp(between(low, high), exponent); }
  bool once_in(int n) { return below(n) == 0; }

 private:
  std::mt19937_64 engine_;
};

using Domain = std::array<double, 4>;  // u1, u2, v1, v2
inline constexpr Domain kUnitDomain = {0, 1, 0, 1};

// A class of maps: one pair of orders (vorder 0: one-dimensional) and one kind of data. Kinds over [0,1] are
// ordinary, integers, lines, cancelling, wide, extreme and doubles. Shifted, reversed, narrow and huge are
// ordinary data over another domain; grid is ordinary data at the points of a grid of 2^10 segments.
struct Class {
  int uorder, vorder;
  std::string data;

  std::string name() const;  // "curve/4/ordinary", "surface/4x4/integers"
  Domain domain() const;
  int segments() const;  // segments of the grid whose points are the arguments; 0: coordinates
};

struct Map {
  int uorder, vorder;  // vorder 1: one-dimensional, or constant in v
  int components;
  bool is_float;  // all control points are floats
  Domain domain;
  std::vector<double> points;  // v fastest, components innermost
  int segments =
      0;  // segments of the grid over the domain, at whose points the map is evaluated; 0: coordinates
};

// Fills map.points with random control points of the class, independently for each component. Orders and
// number of components are those of the map.
void draw_points(Map& map, const Class& what, Random& random);

// Return the argument at a fraction of the domain, and the fraction of an argument.
float argument_at(double part, double first, double last);
double part_of(float argument, double first, double last);

// Returns the index of the point of the grid over the domain that is closest to the argument.
int grid_index(float argument, double first, double last, int segments);

// Changes a few control points of one component (v varies fastest) within the class.
void vary_points(std::vector<double>& points, const Class& what, Random& random);

}  // namespace evalcts::accuracy
