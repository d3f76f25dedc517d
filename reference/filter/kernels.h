// Double-double evaluation of many arguments at a time, with the best instruction set of the machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace evalcts::reference {

struct DoubleDouble {
  double high, low;
};

// The quantities of PROOF.md for one direction of a map.
struct DirectionPlan {
  int degree;
  bool applies;  // domain and grid are within the limits of the filter
  // The domain ends and sign(D) * 2^-k, used for coordinates.
  double first, last, scale;
  bool is_grid;
  DoubleDouble delta, alpha, beta;
  double inverse_width;  // 1/c, rounded upward
};

struct KernelPlan {
  DirectionPlan u, v;
  std::vector<DoubleDouble> coefficients;  // G_ij at i * (v.degree + 1) + j
  double largest;                          // M, rounded upward
  double scale;                            // 2^q
};

// The arrays of the kernels have room for a multiple of kLanes values, all of which are computed.
inline constexpr std::size_t kLanes = 8;
inline constexpr std::size_t round_up_to_lanes(std::size_t count) {
  return (count + kLanes - 1) / kLanes * kLanes;
}

// The sums of the plan, without the factor 2^q, and their bounds.
struct EnclosureArrays {
  double *high, *low, *error;
};
void enclose_kernel(const KernelPlan& plan, const double* u, const double* v, std::size_t count,
                    const EnclosureArrays& results);

// Round the enclosures times 2^q to binary32 and binary64. `decided`: 1.0 or 0.0.
void to_float_kernel(const EnclosureArrays& enclosures, double scale, std::size_t count, float* results,
                     double* decided);
void to_double_kernel(const EnclosureArrays& enclosures, double scale, std::size_t count, double* results,
                      double* decided);

}  // namespace evalcts::reference
