// Verdicts and levels, each with its word in files and its meaning. This is the only place that lists them.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace evalcts {

// Outcome of a test, worst first. An internal error is worst because it casts doubt on the other verdicts.
enum class Verdict {
  kInternalError,   // evalcts itself failed
  kCrash,           // the process ended during the test
  kTimeout,         // the test did not end within its time limit
  kFail,            // something observed contradicts the requirement
  kQualityWarning,  // falls short of good implementations; says nothing about conformance
  kNotObservable,   // the implementation offers no trustworthy way to see the effect
  kNotSupported,    // the version or extension that the rule belongs to is missing
  kSkipped,         // excluded on purpose
  kPass
};
inline constexpr std::size_t kVerdicts = 9;
inline constexpr std::size_t kBadVerdicts = 4;  // the first ones, up to kFail

// The word of the format ("not-observable"), a symbol, and the meaning in a sentence.
struct VerdictText {
  std::string_view word, symbol, meaning;
};
const VerdictText& text_of(Verdict verdict);

// Returns the verdict whose word this is, if there is one.
std::optional<Verdict> verdict_named(std::string_view word);

// True if the process died or was killed, so that the test has no record of its own.
constexpr bool is_death(Verdict verdict) {
  return verdict == Verdict::kCrash || verdict == Verdict::kTimeout;
}
// True for a fail, crash or timeout: what a baseline can expect.
constexpr bool is_failure(Verdict verdict) { return verdict == Verdict::kFail || is_death(verdict); }
// True for a failure or an internal error.
constexpr bool is_bad(Verdict verdict) { return verdict <= Verdict::kFail; }

// must: the acceptance interval; a failure outside of it. quality: the accuracy of good single precision, or
// equal bits from commands that the specification calls equivalent; otherwise a warning. interpretation:
// judged like must, by tests that select a reading. Ordered by weight.
enum class Level { kQuality, kInterpretation, kMust };
const char* name_of(Level level);
std::optional<Level> level_named(std::string_view word);

}  // namespace evalcts
