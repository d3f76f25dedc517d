// The levels of a verdict, and the errors that were measured on the way to it.
#pragma once

#include <cstdint>
#include <string>

namespace evalcts {

// must: the acceptance interval, a failure outside. quality: what good single precision does, a warning
// outside. interpretation: judged like must, by those tests that select a reading.
enum class Level { must, interpretation, quality };
const char* name_of(Level level);

// The largest error of something, and where it was.
struct Worst {
  double error = 0;
  std::string where;  // case and value
  float captured = 0;
  std::string exact;
};

// Errors over all values that were evaluated. Values whose terms are all zero are counted apart: they have no
// condition, and any evaluation gives them exactly.
struct Accuracy {
  std::uint64_t values = 0;
  std::uint64_t not_correctly_rounded = 0;
  std::uint64_t all_terms_zero = 0;
  std::uint64_t all_terms_zero_wrong = 0;
  std::uint64_t not_judged = 0;  // the rule makes no demand there
  Worst ulp;
  Worst condition_aware;

  void add(const Accuracy& other);
};

}  // namespace evalcts
