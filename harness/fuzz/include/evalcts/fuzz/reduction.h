// Reduces the failing cases of tests to minimal programs that differ from the executable specification.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <evalcts/fuzz/finding.h>
#include <evalcts/results/serialization.h>
#include <evalcts/runner/claims.h>

namespace evalcts::fuzz {

// The first failing case of a test, or a known bug that has to be proven.
struct FailingCase {
  std::string test;  // name of the test, or kProof and the ID of the bug
  Difference difference;
  std::string commands;  // JSON text (gl/case_json.h); may be empty
};
inline constexpr char kProof[] = "known bug ";

// The outcome of one reduction. For a known bug: its finding, if one of its programs fails here as the
// register describes.
struct Reduction {
  std::string test;
  std::optional<Finding> minimal;  // none if the case could not be reduced
  std::string why_not;             // the reason in this case
};

struct StillReducing {};  // reported every half second, which distinguishes a slow case from a hang
using ReductionEvent = std::variant<TestStarted, StillReducing, Reduction>;
// Reduces the cases that no other process with the same list has taken. Reports TestStarted before each case,
// and its Reduction. If a case has the same plain form (one dimension, EvalCoord1f, points) as an earlier
// case, the result is shared. Cases that remain after `seconds` are reported as not reduced.
void reduce(const Subject& subject, const std::vector<FailingCase>& cases, Claims& claims, double seconds,
            const std::function<void(const ReductionEvent&)>& report);

// Convert to text and back. parse_failing_cases() throws std::invalid_argument. parse_reduction() returns
// none if the line is not a Reduction.
std::string to_text(const std::vector<FailingCase>& cases);
std::vector<FailingCase> parse_failing_cases(const std::string& text);
std::string to_line(const ReductionEvent& event);
std::optional<Reduction> parse_reduction(const std::string& line);

inline constexpr char kOutOfTime[] = "the time for reduction was over";
inline constexpr char kSamePlace[] = "the library dies at the same place as in other tests";
inline constexpr char kDiedOnTheWay[] = "the library died while its failing case was reduced";

}  // namespace evalcts::fuzz
