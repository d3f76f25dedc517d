// Random control points for programs that compare evaluators with the oracle, by kind of data. The numbers
// are the same on every machine, because published errors and digests depend on them.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace evalcts::accuracy {

// Random numbers that are the same on every machine. The distributions of the standard library differ between
// libraries. Those of Boost.Random do not, but they draw different numbers from the same engine, so they
// would change the published digests and the maps of published seeds. The random programs of harness/fuzz
// draw in the same way for the same reason.
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

// Returns the control points of one component, v fastest. `data` is ordinary, integers, lines, cancelling,
// wide or extreme, which give floats, or doubles.
inline std::vector<double> random_component(const std::string& data, int uorder, int vorder, Random& random) {
  std::vector<double> points;
  const auto each = [&](const auto& value) {
    for (int i = 0; i < uorder; ++i)
      for (int j = 0; j < vorder; ++j) points.push_back(value(i, j));
  };
  const auto as_float = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  if (data == "ordinary") {
    each([&](int, int) { return as_float(random.between(-1, 1)); });
  } else if (data == "integers") {
    each([&](int, int) { return static_cast<double>(random.below(19)) - 9; });
  } else if (data == "lines") {
    // The maps have degree 1 or less in each direction.
    const double first = static_cast<double>(random.below(200)) - 100,
                 a = static_cast<double>(random.below(9)) - 4, b = static_cast<double>(random.below(9)) - 4;
    each([&](int i, int j) { return first + a * i + b * j; });
  } else if (data == "cancelling") {
    // (1 - 2u)^n (1 - 2v)^m, scaled.
    const double scale = as_float(random.between(1, 2));
    each([&](int i, int j) { return (i + j) % 2 == 0 ? scale : -scale; });
  } else if (data == "wide") {
    each([&](int, int) { return as_float(random.scaled(-1, 1, static_cast<int>(random.below(120)) - 60)); });
  } else if (data == "extreme") {
    // The values are near the upper or the lower end of the range of float.
    const bool large = random.once_in(2);
    each([&](int, int) {
      return as_float(random.scaled(
          -1, 1,
          large ? 128 - static_cast<int>(random.below(3)) : -125 - static_cast<int>(random.below(25))));
    });
  } else {  // doubles
    each([&](int, int) { return random.scaled(-1, 1, static_cast<int>(random.below(60)) - 30); });
  }
  return points;
}

// Returns the control points of a map whose components are independent: v fastest, components innermost.
inline std::vector<double> random_points(const std::string& data, int uorder, int vorder, int components,
                                         Random& random) {
  std::vector<double> points(static_cast<std::size_t>(uorder) * vorder * components);
  for (int k = 0; k < components; ++k) {
    const std::vector<double> own = random_component(data, uorder, vorder, random);
    for (std::size_t i = 0; i < own.size(); ++i) points[i * components + k] = own[i];
  }
  return points;
}

}  // namespace evalcts::accuracy
