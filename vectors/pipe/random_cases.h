// Random cases for a pipe of any length.
#pragma once

#include <cstdint>
#include <string>

#include "dice.h"
#include "write/problem.h"

namespace evalcts::vectors {

// A generator of cases that are the same on every machine for a kind ("map1_eval", "map2_eval", "grid" or
// "auto_normal") and a seed. Maps have orders up to 30 (surfaces 12), domains of various positions,
// directions and widths, and control values with few or all bits, of very different magnitudes, or with
// alternating signs. Arguments lie inside the domain, at its ends, and outside.
class RandomCases {
 public:
  RandomCases(const std::string& kind, std::uint64_t seed);

  // Draws the next case.
  void draw();
  const std::string& id() const { return id_; }
  const Problem& problem() const { return problem_; }
  bool is_normal() const { return is_normal_; }

 private:
  Direction direction(int low_orders, int high_orders);
  double coordinate(const Direction& u);
  Argument argument(const Direction& u);
  double control_value(int style, int place);
  void fill_surface();

  std::string prefix_, id_;
  bool is_normal_, is_grid_, is_curve_;
  std::uint64_t number_ = 0;
  Dice dice_;
  Problem problem_;
};

}  // namespace evalcts::vectors
