// Reduces the failing cases of tests to minimal programs that differ from the executable specification.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>

#include <evalcts/fuzz/finding.h>

namespace evalcts::fuzz {

// The first failing case of a test, or a known bug that has to be proven.
struct FailingCase {
  std::string test;  // the name of the test; the ID of the bug
  Difference difference;
  std::string commands;  // JSON text (gl/case_json.h); may be empty
  double seconds = 0;    // time limit; 0: none
  bool is_known_bug = false;
};

// The outcome of one reduction. For a known bug: its finding, if one of its programs fails here as the
// register describes.
struct Reduction {
  std::string test;                // as in the FailingCase
  std::optional<Finding> minimal;  // none if the case could not be reduced
  std::string why_not;             // the reason in this case
  bool is_known_bug = false;
};

struct StillReducing {};  // reported every half second, which distinguishes a slow case from a hang
using ReductionEvent = std::variant<StillReducing, Reduction>;
// Returns a function that reduces cases. If a case has the same plain form (one dimension, EvalCoord1f,
// points) as an earlier case, the result is shared. `subject` must outlive the function.
std::function<Reduction(const FailingCase&)> case_reducer(
    const Subject& subject, const std::function<void(const StillReducing&)>& report);

// Convert to text and back. parse_failing_case() throws std::invalid_argument. parse_reduction() returns none
// if the line is not a Reduction.
std::string to_text(const FailingCase& failing);
FailingCase parse_failing_case(const std::string& text);
std::string to_line(const ReductionEvent& event);
std::optional<Reduction> parse_reduction(const std::string& line);

inline constexpr char kOutOfTime[] = "the time for reduction was over";
inline constexpr char kSamePlace[] = "the library dies at the same place as in other tests";
inline constexpr char kDiedOnTheWay[] = "the library died while its failing case was reduced";

}  // namespace evalcts::fuzz
