// The judge: captured values against exact ones, by the accuracy rule of section 0.5 of the requirements.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/capture/observation.h"
#include "harness/judge/prediction.h"

namespace evalcts {

// must: the acceptance interval, a failure outside. quality: what good single precision does, a warning
// outside. interpretation: judged like must, by those tests that select a reading.
enum class Level { must, interpretation, quality };
const char* name_of(Level level);

// One value that is not what it has to be.
struct Mismatch {
  std::string what;      // "position.x of vertex 3"
  std::string message;   // one line
  std::string expected;  // the interval, or the value
  std::string captured;
  std::string exact;     // decimal and hex float
  double ulp = 0;
  double condition_aware = 0;
};

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

struct Judgement {
  std::vector<Mismatch> mismatches;
  Accuracy accuracy;
};

struct JudgeOptions {
  Level level = Level::must;
  Attributes attributes = kAllAttributes;  // judged are those of them that were observed
  int version = 46;                        // 10 * major + minor: ranges that the GL promises depend on it
  std::string where;                       // the case's identity, for Accuracy
};

// Compares vertex by vertex, in order. A value that was given (not evaluated) has to come back bit for bit, -0
// counting as +0.
Judgement judge(const Prediction& prediction, const Observation& observation, const JudgeOptions& options);

// Whether two observations of the same case are the same in the attributes that both have: bit for bit, but -0
// and subnormals as real numbers to 2^-126. Empty, or what differs.
std::string disagreement(const Observation& a, const Observation& b);

}  // namespace evalcts
