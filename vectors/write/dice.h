// Random data that is the same on every machine. Distributions are made by hand: those of the standard
// library differ. One draw a statement: in which order the arguments of a function are evaluated is up to the
// compiler.
#pragma once

#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>
#include <string_view>

#include <evalcts/results/hash.h>

namespace evalcts::vectors {

class Dice {
 public:
  // Seeded by a name (FNV-1a), so that what is drawn under one name never depends on others.
  explicit Dice(std::string_view name) : random_(fnv1a<std::uint64_t>(name)) {}

  // Returns a number from 0 to count - 1.
  std::int64_t below(std::int64_t count) {
    return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(count));
  }
  // From low to high, both included.
  int between(int low, int high) { return static_cast<int>(low + below(std::int64_t{high} - low + 1)); }
  bool one_in(int count) { return below(count) == 0; }
  template <class Range>
  auto pick(const Range& range) {
    return std::begin(range)[below(static_cast<std::int64_t>(std::size(range)))];
  }

  // In [-1, 1), a multiple of 2^-bits, 1 <= bits <= 53.
  double real(int bits) {
    return std::ldexp(static_cast<double>(below(std::int64_t{2} << bits) - (std::int64_t{1} << bits)), -bits);
  }
  // A magnitude in [1, 2) of either sign with so many significant bits, 2 <= bits <= 53.
  double significand(int bits) {
    const std::int64_t half = std::int64_t{1} << (bits - 1);
    const double magnitude = std::ldexp(static_cast<double>(half + below(half)), 1 - bits);
    return sign() * magnitude;
  }
  // 1 or -1.
  double sign() { return one_in(2) ? 1 : -1; }
  // A magnitude from 2^least to 2^(most + 1) of either sign with so many significant bits.
  double scaled(int bits, int least, int most) {
    const double value = significand(bits);
    return std::ldexp(value, between(least, most));
  }
  // Plus or minus 2^least to 2^most.
  double power(int least, int most) {
    const double value = sign();
    return std::ldexp(value, between(least, most));
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace evalcts::vectors
