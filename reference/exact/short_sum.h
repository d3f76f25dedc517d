// Bernstein sums over short numbers, as in ordinary data: the sums of homogeneous.h in natural numbers on the
// stack.
#pragma once

#include <reference/bernstein.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "natural.h"

namespace evalcts::reference {

// t = a/c, 1 - t = b/c with c > 0 and |a|, |b|, c < 2^62.
struct ShortHomogeneous {
  std::int64_t a, b, c;
};

// Same as homogenise(), but returns nothing if the numbers are longer, and any t for a direction of order 1.
std::optional<ShortHomogeneous> homogenise_short(const Argument& u, const Direction& direction);

// The terms C(m,j) * R_ij of rows of m + 1 control values, row by row. A single column has the terms C(n,i) *
// R_i.
struct ShortTerms {
  std::vector<__int128> values;
  int rows, columns;
  int exponent;  // a term is its value times 2^exponent
  bool pairs;    // all |values| < 2^94, so two values, each times 32 bits, can be added
};

// Returns the terms for R_ij = points[i * columns + j], or nothing if the R_ij, as integers times a power of
// two, are longer than 63 bits. All values must be finite.
std::optional<ShortTerms> short_terms(std::span<const double> points, int rows, int columns);

// A sum with separate positive and negative terms.
struct ShortSum {
  Natural positive, negative;
};

// Computes SUM C(n,i) * C(m,j) * a_u^i * b_u^(n-i) * a_v^j * b_v^(m-j) * R_ij. With `kMagnitude`, positive +
// negative is the sum of the magnitudes; without it, only their difference has a meaning.
template <bool kMagnitude>
void short_sum(const ShortTerms& terms, const ShortHomogeneous& u, const ShortHomogeneous& v, ShortSum& sum);

}  // namespace evalcts::reference
