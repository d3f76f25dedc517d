// Result records: what is known of one test after it ran.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/gl/check.h"
#include "harness/judge/accuracy.h"

namespace evalcts {

enum class Verdict {
  pass,
  fail,
  quality_warning,
  not_supported,   // the version or extension that the rule belongs to is missing
  not_observable,  // nothing that this implementation offers can show it
  skipped,
  crash,
  timeout,
  internal_error,  // a fault of evalcts itself
};
const char* name_of(Verdict verdict);

// One failing case of a test.
struct Failure {
  std::string case_identity;
  std::string message;
  std::string what;
  std::string expected;
  std::string captured;
  std::string exact;  // empty where nothing was evaluated
  std::optional<double> ulp;
  std::optional<double> condition_aware;
  std::string capture;
  std::vector<std::string> calls;  // as C
  std::optional<gl::Check> check;  // for a stand-alone program
};

struct Record {
  std::string name;  // "Map1Errors.StrideBelowK/MAP1_VERTEX_3"
  std::vector<std::string> requirements;
  Level level = Level::must;
  Verdict verdict = Verdict::pass;
  std::string message;
  std::size_t cases = 0;
  std::size_t failed_cases = 0;
  std::vector<std::string> mismatches;  // sorted identities ("case: what"), the signature of a failing test
  std::vector<Failure> failures;        // the first few, in full
  std::vector<std::string> captures;
  std::optional<Accuracy> accuracy;
  std::map<std::string, std::string> readings;  // of ambiguous text that the implementation follows
  std::uint32_t seed = 0;
  double seconds = 0;
};

// The members of "tests" in results-NAME.json. Infinite distances become null: JSON has no infinity.
nlohmann::json to_json(const Record& record);

}  // namespace evalcts
