// Maps at random: classes of orders and data, and seeded numbers that are the same on every machine.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace evalcts::accuracy {

// Numbers that are the same on every machine. The distributions of the standard library differ from library
// to library. Those of Boost.Random do not, but draw other numbers from the same engine: of a million,
// uniform_real_distribution gives the same double 33 times of 100 and uniform_int_distribution the same
// integer as often as chance does. With them the published digests, and the maps of published seeds, would
// change. The random programs of harness/fuzz draw in the same way, for the same reason.
class Random {
 public:
  // `item`: numbers of their own for each part of a task, so that parts can be done in any order.
  Random(std::uint32_t seed, std::uint64_t item) {
    std::seed_seq sequence{seed, static_cast<std::uint32_t>(item), static_cast<std::uint32_t>(item >> 32)};
    engine_.seed(sequence);
  }
  std::uint64_t below(std::uint64_t limit) { return engine_() % limit; }
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  // [0,1)
  double between(double low, double high) { return low + (high - low) * uniform(); }
  // One of [low, high), times 2^exponent. Where the exponent is drawn, too, that comes first, with every
  // compiler.
  double scaled(double low, double high, int exponent) { return std::ldexp(between(low, high), exponent); }
  bool once_in(int n) { return below(n) == 0; }

 private:
  std::mt19937_64 engine_;
};

using Domain = std::array<double, 4>;  // u1, u2, v1, v2
inline constexpr Domain kUnitDomain = {0, 1, 0, 1};

// Maps of one pair of orders (vorder 0: of one dimension) and one kind of data: ordinary, integers, lines,
// cancelling, wide, extreme, doubles; or ordinary data over another domain: shifted, reversed, narrow, huge;
// or at the points of a grid of 2^10 segments: grid.
struct Class {
  int uorder, vorder;
  std::string data;

  std::string name() const;  // "curve/4/ordinary", "surface/4x4/integers"
  Domain domain() const;
  int segments() const;  // of the grid at whose points the maps are evaluated; 0: at coordinates
};

struct Map {
  int uorder, vorder;  // vorder 1: of one dimension
  int components;
  bool is_float;  // all control points are floats
  Domain domain;
  std::vector<double> points;  // v fastest, components innermost
  int segments = 0;            // of the grid over the domain whose points the arguments are; 0: coordinates
};

// Fills map.points with components that have nothing to do with each other. Orders and number of components
// are those of the map.
void draw_points(Map& map, const Class& what, Random& random);

// The argument at a fraction of the domain from first to last, and that fraction.
float argument_at(double part, double first, double last);
double part_of(float argument, double first, double last);

// Changes the control points of one component, v fastest, a little; they stay of their class.
void vary_points(std::vector<double>& points, const Class& what, Random& random);

}  // namespace evalcts::accuracy
