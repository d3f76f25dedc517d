// Binomial coefficients of the degrees that maps have.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "mutation_point.h"
#include "target.h"

namespace glev {

constexpr std::size_t pascals_row(int n) { return static_cast<std::size_t>(n) * (n + 1) / 2; }

constexpr auto pascals_triangle() {
  std::array<std::uint64_t, pascals_row(kMaxOrder)> triangle{};
  for (int n = 0; n < kMaxOrder; ++n) {
    for (int i = 0; i <= n; ++i) {
      const std::uint64_t* above = n == 0 ? nullptr : triangle.data() + pascals_row(n - 1);
      triangle[pascals_row(n) + i] = i == 0 || i == n ? 1 : above[i - 1] + above[i];
    }
  }
  return triangle;
}

// The rows of Pascal's triangle, contiguous. All entries up to C(63, 31) < 2^60 are exact.
inline constexpr auto kBinomials = pascals_triangle();

// Returns C(n, 0) ... C(n, n).
inline const std::uint64_t* binomial_row(int n) {
  return GLEV_AT(binomials, kBinomials.data()) + pascals_row(n);
}

}  // namespace glev
