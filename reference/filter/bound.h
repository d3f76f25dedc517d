// The constants of PROOF.md: errors in units of u^2 = 2^-106.
#pragma once

namespace evalcts::reference {

inline constexpr double kUnitSquared = 0x1p-106;
inline constexpr int kCoefficientError = 2;  // relative error of a coefficient
inline constexpr int kProductError = 9;      // relative error of a product
inline constexpr int kSumError = 4;          // error of a sum, relative to the sum of the magnitudes
inline constexpr int kGridError = 17;        // error of a and b at a grid point, see "Grids" in PROOF.md
inline constexpr double kTiny = 0x1p-700;    // all errors by underflow together

// Returns THETA for the degrees n and m.
constexpr int polynomial_error(int n, int m) {
  return kCoefficientError + kProductError * (n + m + 2) + kSumError * (n + m);
}

// Limits beyond which the filter gives an infinite error.
inline constexpr double kLargestGrowth = 0x1p300;  // limit of the powers in E, without M
inline constexpr double kLargestTau = 0x1p-60;
inline constexpr double kLargestArgument = 0x1p600;
inline constexpr int kLargestDomainExponent = 500;  // limit of the exponents of |D| and 1/|D|
inline constexpr int kLargestScale = 900;           // limit of |q|

// Relative increments that exceed the rounding errors of a computed number, to move it outward.
inline constexpr double kBoundRoundings = 0x1p-30;   // error of the computed bound
inline constexpr double kGrowthRoundings = 0x1p-48;  // error of (|a| + |b|)/c
inline constexpr double kSumRoundings = 0x1p-51;     // error of one sum

}  // namespace evalcts::reference
