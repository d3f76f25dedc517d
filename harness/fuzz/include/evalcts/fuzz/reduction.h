// Reduces the failing cases of tests to minimal programs that differ from the executable specification.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <evalcts/fuzz/finding.h>

namespace evalcts::fuzz {

// The first failing case of a test.
struct FailingCase {
  std::string test;
  Difference difference;
  std::string commands;  // JSON text (gl/case_json.h); may be empty
  double seconds = 0;    // time limit; 0: none
};

// The outcome of one reduction, or of the proof of a known bug.
struct Reduction {
  std::string test;                // as in the FailingCase, or the ID of the bug
  std::optional<Finding> minimal;  // none if the case could not be reduced, or the bug not be proven
  std::string why_not;             // the reason why a case could not be reduced
};

// Returns a function that reduces cases. If a case has the same plain form (one dimension, EvalCoord1f,
// points) as an earlier case, the result is shared. `subject` must outlive the function.
std::function<Reduction(const FailingCase&)> case_reducer(const Subject& subject);

// Returns a function that proves a known bug by its ID, within so many seconds (the data of the job): it
// returns the finding of the first program of the bug that fails here as the register describes, or none.
// `subject` must outlive the function.
std::function<std::optional<Finding>(const std::string&, double)> bug_prover(const Subject& subject);

// Convert to text and back. parse_failing_case() throws std::invalid_argument. parse_reduction() returns none
// if the line is not a Reduction.
std::string to_text(const FailingCase& failing);
FailingCase parse_failing_case(const std::string& text);
std::string to_line(const Reduction& reduction);
std::optional<Reduction> parse_reduction(const std::string& line);

inline constexpr char kOutOfTime[] = "the time for reduction was over";
inline constexpr char kSamePlace[] = "the library dies at the same place as in other tests";
inline constexpr char kDiedOnTheWay[] = "the library died while its failing case was reduced";

}  // namespace evalcts::fuzz
