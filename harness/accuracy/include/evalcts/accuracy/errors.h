// Statistics of the errors of many results, and the inputs with the largest errors.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <evalcts/accuracy/samples.h>
#include <reference/bernstein.h>

namespace evalcts::accuracy {

// The input of one result, with which replay() evaluates it again: one polynomial, its domain and an
// argument.
struct Input {
  int uorder = 1, vorder = 1;  // vorder 1: a curve, or a surface that is constant in v
  bool two_dimensional = false;
  std::vector<double> points;  // v fastest
  float u = 0, v = 0;          // with a grid, its points closest to u and v are the argument
  Domain domain = kUnitDomain;
  int segments = 0;  // segments of the grid over the domain; 0: no grid

  reference::Surface surface() const;  // curves too; valid as long as this Input
  reference::Argument argument_u() const { return argument(u, domain[0], domain[1]); }
  reference::Argument argument_v() const { return argument(v, domain[2], domain[3]); }

 private:
  reference::Argument argument(float x, double first, double last) const {
    return segments > 0
               ? reference::Argument::grid(grid_index(x, first, last, segments), segments, first, last)
               : reference::Argument::coordinate(x);
  }
};

struct Worst {
  double error = -1;  // negative if there is no result
  Input input;
  float got = 0;
  float right = 0;       // the exact value, correctly rounded
  std::string exact;     // text of reference::describe()
  bool climbed = false;  // found by climb(), not in the sample

  // Replaces this result by another one if the error of the other one is larger.
  void keep(double other_error, const Input& other, float result, const reference::Rational& value);
};

// Statistics of ULP and condition-aware errors (reference/rounding.h). Exact zeros have no ULP of their own,
// and values without terms (SUM |B_i| |R_i| = 0) have no condition-aware error either. Both are counted
// separately and do not contribute to the other members.
struct Errors {
  // The bins hold errors up to 1/2, 1, 2, 4, ..., 2^22 ULP, and larger errors.
  static constexpr int kBins = 25;
  static std::size_t bin_of(double ulp);

  std::uint64_t values = 0;
  std::uint64_t not_correctly_rounded = 0;
  std::uint64_t not_finite = 0;  // although the exact result rounds to a finite float; not in means and bins
  double sum_of_ulp = 0, sum_of_condition_aware = 0;
  std::array<std::uint64_t, kBins> histogram{};
  Worst ulp, condition_aware;

  std::uint64_t zeros = 0;
  std::uint64_t zeros_wrong = 0;  // the result is not zero
  Worst zero;                     // the worst by condition-aware error
  std::uint64_t without_terms = 0;
  std::uint64_t without_terms_wrong = 0;

  double mean_ulp() const { return mean(sum_of_ulp); }
  double mean_condition_aware() const { return mean(sum_of_condition_aware); }

  // Adds the result `got` of an implementation for the input, whose exact value is given.
  void add(float got, const reference::Evaluation& exact, const Input& input);

 private:
  double mean(double sum) const {
    return values > not_finite ? sum / static_cast<double>(values - not_finite) : 0;
  }
};

}  // namespace evalcts::accuracy
