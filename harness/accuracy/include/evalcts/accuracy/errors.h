// The errors of many results: how they are counted, and the worst of them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <evalcts/accuracy/samples.h>
#include <reference/bernstein.h>

namespace evalcts::accuracy {

// One polynomial over a domain and an argument of it: what a result can be replayed from.
struct Input {
  int uorder = 1, vorder = 1;  // vorder 1: a curve, or a surface that is constant in v
  bool two_dimensional = false;
  std::vector<double> points;  // v fastest
  float u = 0, v = 0;
  Domain domain = kUnitDomain;
  int segments = 0;  // of the grid over the domain whose point the argument is; 0: a coordinate

  reference::Surface surface() const;  // of both; valid as long as this
  reference::Argument argument_u() const { return reference::Argument::coordinate(u); }
  reference::Argument argument_v() const { return reference::Argument::coordinate(v); }
};

struct Worst {
  double error = -1;  // below 0: there is none
  Input input;
  float got = 0;
  float right = 0;       // the exact value, correctly rounded
  std::string exact;     // as reference::describe() writes it
  bool climbed = false;  // found by climb(), not in the sample

  // This one instead, where its error is larger.
  void keep(double other_error, const Input& other, float result, const reference::Rational& value);
};

// ULP and condition-aware error are those of reference/rounding.h. Exact zeros have no ULP of their own, and
// values without a term (SUM |B_i| |R_i| = 0) no condition either: both are counted apart, and are in none of
// the other numbers.
struct Errors {
  // Errors up to 1/2 ULP, 1, 2, 4, ... 2^22, and above: powers of two from 2^-1 on.
  static constexpr int kBins = 25;
  static std::size_t bin_of(double ulp);

  std::uint64_t values = 0;
  std::uint64_t not_correctly_rounded = 0;
  std::uint64_t not_finite = 0;  // where the right result is; part of the former, not of the means and bins
  double sum_of_ulp = 0, sum_of_condition_aware = 0;
  std::array<std::uint64_t, kBins> histogram{};
  Worst ulp, condition_aware;

  std::uint64_t zeros = 0;
  std::uint64_t zeros_wrong = 0;  // the result is something else
  Worst zero;                     // by the condition-aware error
  std::uint64_t without_terms = 0;
  std::uint64_t without_terms_wrong = 0;

  double mean_ulp() const { return mean(sum_of_ulp); }
  double mean_condition_aware() const { return mean(sum_of_condition_aware); }

  // The result of a library for the input.
  void add(float got, const reference::Evaluation& exact, const Input& input);

 private:
  double mean(double sum) const {
    return values > not_finite ? sum / static_cast<double>(values - not_finite) : 0;
  }
};

}  // namespace evalcts::accuracy
