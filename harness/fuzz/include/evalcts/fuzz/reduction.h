// The failing cases of tests, reduced to minimal programs that differ from the executable specification.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <evalcts/fuzz/campaign.h>
#include <evalcts/results/serialization.h>
#include <evalcts/runner/claims.h>

namespace evalcts::fuzz {

// The first failing case of a test.
struct FailingCase {
  std::string test;
  std::string what;      // as of Failure: "color.R of vertex 1"
  std::string commands;  // JSON text (gl/case_json.h); may be empty
};

// The outcome of one reduction.
struct Reduction {
  std::string test;
  std::optional<Finding> minimal;  // none if it could not be reduced
  std::string why_not;             // the reason, in words
};

struct StillReducing {};  // now and then, so that a slow case is told from a library that hangs
using ReductionEvent = std::variant<TestStarted, StillReducing, Reduction>;
// Reduces the cases that no other process with the same list has taken, and reports each, TestStarted before
// it. A case whose plain form (one dimension, EvalCoord1f, points) was reduced before has the same result.
// Programs that are left after `seconds` are reported as not reduced.
void reduce(const Subject& subject, const std::vector<FailingCase>& cases, Claims& claims, double seconds,
            const std::function<void(const ReductionEvent&)>& report);

// Conversion to text and back: a list, throws std::invalid_argument; one line, none if it is no reduction.
std::string to_text(const std::vector<FailingCase>& cases);
std::vector<FailingCase> parse_failing_cases(const std::string& text);
std::string to_line(const ReductionEvent& event);
std::optional<Reduction> parse_reduction(const std::string& line);

inline constexpr char kOutOfTime[] = "the time for reduction was over";
inline constexpr char kDiedOnTheWay[] = "the library died while its failing case was reduced";

}  // namespace evalcts::fuzz
