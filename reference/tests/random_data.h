// Seeded random data for the tests.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <vector>

namespace evalcts::reference {

// Returns a generator and prints its seed. EVALCTS_SEED sets the seed.
inline std::mt19937_64 make_generator() {
  const char* text = std::getenv("EVALCTS_SEED");
  const std::uint64_t seed = text != nullptr ? std::strtoull(text, nullptr, 0) : 20240229;
  std::cout << "seed " << seed << " (EVALCTS_SEED)\n";
  return std::mt19937_64(seed);
}

inline double uniform(std::mt19937_64& generator, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(generator);
}

inline int pick(std::mt19937_64& generator, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(generator);
}

// Returns a finite float, with all bit patterns equally likely: subnormals, both zeros, huge values.
inline float any_float(std::mt19937_64& generator) {
  for (;;) {
    const float value = std::bit_cast<float>(static_cast<std::uint32_t>(generator()));
    if (std::isfinite(value)) return value;
  }
}

inline double any_double(std::mt19937_64& generator) {
  for (;;) {
    const double value = std::bit_cast<double>(static_cast<std::uint64_t>(generator()));
    if (std::isfinite(value)) return value;
  }
}

// Kinds of control values.
enum class Data {
  kFloats,
  kDoubles,
  kIntegers,
  kCancelling,
  kSparse,
  kWide,
  kSubnormal,
  kAnyFloat,
  kAnyDouble
};

inline std::vector<double> control_values(std::mt19937_64& generator, Data kind, std::size_t count) {
  std::vector<double> values(count);
  double sign = 1;
  for (double& value : values) {
    sign = -sign;
    switch (kind) {
      case Data::kFloats:
        value = static_cast<float>(uniform(generator, -1, 1));
        break;
      case Data::kDoubles:
        value = uniform(generator, -1, 1);
        break;
      case Data::kIntegers:
        value = pick(generator, -9, 9);
        break;
      case Data::kCancelling:
        value = sign * static_cast<float>(uniform(generator, 0.99, 1.01));
        break;
      case Data::kSparse:
        value =
            pick(generator, 0, 3) == 0 ? pick(generator, -4, 4) * 0.25 : (pick(generator, 0, 1) ? 0.0 : -0.0);
        break;
      case Data::kWide:
        value = std::ldexp(static_cast<float>(uniform(generator, -1, 1)), pick(generator, -60, 30));
        break;
      case Data::kSubnormal:
        value = pick(generator, 0, 1) ? std::ldexp(pick(generator, -100, 100), -149)
                                      : std::ldexp(pick(generator, -100, 100), -1074);
        break;
      case Data::kAnyFloat:
        value = any_float(generator);
        break;
      case Data::kAnyDouble:
        value = any_double(generator);
        break;
    }
  }
  return values;
}

}  // namespace evalcts::reference
