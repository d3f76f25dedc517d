// Statistics of the errors of many results, and the inputs with the largest errors.
#pragma once

#include <reference/bernstein_form.h>
#include <cstdint>
#include <string>
#include <vector>

#include <evalcts/accuracy/samples.h>

namespace evalcts::accuracy {

// The input of one result: one polynomial, its domain and an argument.
struct Input {
  int uorder = 1, vorder = 1;  // vorder 1: a curve, or a surface that is constant in v
  bool two_dimensional = false;
  std::vector<double> points = {};  // v fastest
  float u = 0, v = 0;               // with a grid, its points closest to u and v are the argument
  Domain domain = kUnitDomain;
  int segments = 0;  // segments of the grid over the domain; 0: no grid

  reference::Surface surface() const;  // curves too; valid as long as this Input
  // Returns the exact value; `form` is that of surface().
  reference::Evaluation evaluate(const reference::BernsteinForm& form) const;
};

struct Worst {
  double error = -1;  // negative if there is no result
  Input input = {};
  float got = 0;
  float right = 0;       // the exact value, correctly rounded
  std::string exact;     // text of reference::describe()
  bool climbed = false;  // found by the search, not in the sample

  // Replaces this result by another one if the error of the other one is larger.
  void keep(double other_error, const Input& other, float result, const reference::Rational& value);
};

// Statistics of ULP and condition-aware errors (reference/rounding.h). Exact zeros have no ULP of their own.
// They are counted separately and do not contribute to the other members.
struct Errors {
  std::uint64_t values = 0;
  std::uint64_t not_correctly_rounded = 0;
  std::uint64_t not_finite = 0;  // although the exact result rounds to a finite float; not in the means
  double sum_of_ulp = 0, sum_of_condition_aware = 0;
  Worst ulp, condition_aware;
  std::uint64_t zeros = 0;
  std::uint64_t zeros_wrong = 0;  // the result is not zero

  double mean(double sum) const {
    return values > not_finite ? sum / static_cast<double>(values - not_finite) : 0;
  }
  // Adds the result `got` of an implementation for the input, whose exact value is given.
  void add(float got, const reference::Evaluation& exact, const Input& input);
};

}  // namespace evalcts::accuracy
