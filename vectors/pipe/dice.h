// Random data that is the same on every machine. It does not use the distributions of the standard library,
// which differ between libraries. Callers draw once in a statement, because the compiler chooses the order in
// which the arguments of a function are evaluated.
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
  // The seed is the FNV-1a hash of a name, so that the data of one name do not depend on others.
  explicit Dice(std::string_view name) : random_(fnv1a<std::uint64_t>(name)) {}

  // Returns a number from 0 to count - 1.
  std::int64_t below(std::int64_t count) {
    return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(count));
  }
  // Returns a number from low to high, both included.
  int between(int low, int high) { return static_cast<int>(low + below(std::int64_t{high} - low + 1)); }
  bool one_in(int count) { return below(count) == 0; }
  template <class Range>
  auto pick(const Range& range) {
    return std::begin(range)[below(static_cast<std::int64_t>(std::size(range)))];
  }

  // Returns a multiple of 2^-bits in [-1, 1), 1 <= bits <= 53.
  double real(int bits) {
    return std::ldexp(static_cast<double>(below(std::int64_t{2} << bits) - (std::int64_t{1} << bits)), -bits);
  }
  // Returns a number of random sign with a magnitude in [1, 2) and `bits` significant bits, 2 <= bits <= 53.
  double significand(int bits) {
    const std::int64_t half = std::int64_t{1} << (bits - 1);
    const double magnitude = std::ldexp(static_cast<double>(half + below(half)), 1 - bits);
    return sign() * magnitude;
  }
  // Returns 1 or -1.
  double sign() { return one_in(2) ? 1 : -1; }
  // Returns a number of random sign with a magnitude in [2^least, 2^(most + 1)) and `bits` significant bits.
  double scaled(int bits, int least, int most) {
    const double value = significand(bits);
    return std::ldexp(value, between(least, most));
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace evalcts::vectors
