// Defines the verdicts and levels, with the words that stand for them in files, and their meanings.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace evalcts {

// Outcome of a test. Verdicts are ordered from worst to best; an internal error is the worst because it casts
// doubt on the other verdicts.
enum class Verdict {
  kInternalError,   // evalcts itself failed
  kCrash,           // the process ended during the test
  kTimeout,         // the test did not end within its time limit
  kFail,            // an observation contradicts a requirement
  kQualityWarning,  // less accurate than good implementations; says nothing about conformance
  kNotObservable,   // the implementation offers no trustworthy way to observe the effect
  kNotSupported,    // the version or extension that the requirement belongs to is not supported
  kSkipped,         // excluded on purpose
  kPass
};
inline constexpr std::size_t kVerdicts = 9;
inline constexpr std::size_t kBadVerdicts = 4;  // number of verdicts from the worst to kFail

// The word for a verdict in files ("not-observable"), the label in texts for persons ("not observed"), a
// symbol, and the meaning in a sentence.
struct VerdictText {
  std::string_view word, label, symbol, meaning;
};
const VerdictText& text_of(Verdict verdict);

// Returns the verdict with this word in files, if there is one.
std::optional<Verdict> verdict_named(std::string_view word);

// True if the process died or was killed, so that the test has no record of its own.
constexpr bool is_death(Verdict verdict) {
  return verdict == Verdict::kCrash || verdict == Verdict::kTimeout;
}
// True for a fail, crash or timeout, the verdicts that a baseline can expect.
constexpr bool is_failure(Verdict verdict) { return verdict == Verdict::kFail || is_death(verdict); }
// True for a failure or an internal error.
constexpr bool is_bad(Verdict verdict) { return verdict <= Verdict::kFail; }

// The kind of rule that a test checks, in ascending order of weight. kMust: values lie in the acceptance
// interval, otherwise the test fails. kInterpretation: judged like kMust, by tests that select a reading.
// kQuality: values have the accuracy of good single precision, or commands that the specification calls
// equivalent give equal bits; otherwise the test gives a warning.
enum class Level { kQuality, kInterpretation, kMust };
const char* name_of(Level level);
std::optional<Level> level_named(std::string_view word);

}  // namespace evalcts
