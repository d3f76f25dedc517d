// Defines the statistics of the errors that a test measures in evaluated values.
#pragma once

#include <cstdint>
#include <string>

namespace evalcts {

// The largest error of some values, and its place.
struct Worst {
  double error = 0;   // infinite if an infinity was captured in place of a finite value
  std::string where;  // case and value
  float captured = 0;
  std::string exact;
};

// Errors over all evaluated values. Values whose terms are all zero are counted separately: their condition
// is undefined, and any order of evaluation computes them exactly.
struct Accuracy {
  std::uint64_t values = 0;
  std::uint64_t not_correctly_rounded = 0;
  std::uint64_t all_terms_zero = 0;
  std::uint64_t all_terms_zero_wrong = 0;
  std::uint64_t not_judged = 0;  // values to which the accuracy rule does not apply
  Worst ulp;                     // error in ULP of binary32
  Worst condition_aware;         // error divided by 2^-24 * sum |B_i| |R_i|

  void add(const Accuracy& other);
};

}  // namespace evalcts
