// A result record as values of C++ types: the one place that knows the JSON format. All text in it is clean
// (see text.h), so the writers only have to escape for their own syntax.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/results/json.h"

namespace evalcts::reports {

// Worst first; an internal error is worst because it casts doubt on the other verdicts.
enum class Verdict {
  kInternalError,
  kCrash,
  kTimeout,
  kFail,
  kQualityWarning,
  kNotObservable,
  kNotSupported,
  kSkipped,
  kPass
};
inline constexpr std::size_t kVerdicts = 9;
inline constexpr std::size_t kBadVerdicts = 4;  // the first ones, up to kFail

// The word of the format ("not-observable"), a symbol beside it for the eye, and what it means in a sentence.
struct VerdictText {
  std::string_view word, symbol, meaning;
};
const VerdictText& text_of(Verdict verdict);

using Counts = std::array<std::uint64_t, kVerdicts>;

struct Capture {
  std::string name;
  bool available = false;
  std::string reason;
};

struct Implementation {
  std::string name, library, vendor, renderer, version, machine;
  std::string note;  // what the reader has to know about it, such as a driver that was not asked for
  std::optional<std::int64_t> max_eval_order;  // what it says; a broken one may say anything
  std::vector<std::string> files;              // the libraries and drivers that were loaded, beside `library`
  std::vector<Capture> captures;
};

// One case that went wrong: where, what should have come, what came, how far off.
struct Failure {
  std::string case_name, message, what, expected, captured, exact, capture;
  std::optional<double> ulp, condition_aware;
  std::vector<std::string> calls;
  bool operator==(const Failure&) const = default;
};

struct Accuracy {
  std::optional<std::uint64_t> values, incorrectly_rounded;
  std::optional<double> max_ulp, max_condition_aware;
  std::string worst;
};

struct TestResult {
  std::string name;
  std::vector<std::string> requirements;
  std::string level;  // "must", "interpretation", "quality", or empty if not recorded
  Verdict verdict = Verdict::kInternalError;
  bool expected_by_baseline = false;
  std::string baseline_reason, message;
  std::optional<std::uint64_t> cases, failed_cases, seed;
  std::vector<Failure>
      failures;  // where the record lists none: what it says at the level of the test, if anything
  std::optional<Accuracy> accuracy;
  std::string rerun, debug, reproducer;  // commands
  std::vector<std::string> history;      // the tests that have to come before, where the context is shared
  bool flake = false;                    // it did not come out the same when it was played again
  std::string again;                     // the verdict that it had then, where that is known
  std::vector<std::string> mismatches;   // sorted identities of what is wrong, "case: what"
  std::optional<double> seconds;

  bool bad() const { return verdict <= Verdict::kFail; }
  // An internal error is a defect of evalcts: no baseline can expect it.
  bool expected_bad() const { return bad() && expected_by_baseline && verdict != Verdict::kInternalError; }
  bool unexpected() const { return (bad() && !expected_bad()) || unexpected_pass(); }
  // Only a baseline entry has a reason, so a pass with a reason that was not expected contradicts its entry.
  bool unexpected_pass() const {
    return verdict == Verdict::kPass && !expected_by_baseline && !baseline_reason.empty();
  }
  // Order of telling, smallest first: unexpected failures by verdict, expected failures by verdict,
  // unexpected passes, the rest by verdict.
  int severity() const;
};

struct Record {
  std::string evalcts_version, status, reason, command, depth, pass;
  std::string shard;   // "1-of-4" where the tests are a part of all
  std::string origin;  // where the record comes from, see reports.h
  std::optional<std::uint64_t> seed;
  std::string baseline;  // "mesa with mesa.softpipe"; empty: none
  std::vector<std::string> stale_baseline_entries;
  std::uint64_t not_played_again = 0;  // unexpected fails, because there were too many
  // Of ambiguous texts, by their names: one where the implementation is consistent.
  std::map<std::string, std::vector<std::string>> readings;
  Implementation implementation;
  Counts counts{};
  std::vector<TestResult> tests;

  std::uint64_t total() const;
  std::uint64_t unexpected_count() const;  // with counts only, nothing is known to be expected
  std::uint64_t expected_bad_count() const;
  bool complete() const { return status == "complete"; }
  // "osmesa", or "osmesa, one shared context" for the second pass; `unnamed` where the record has no name.
  std::string heading(const std::string& unnamed) const;
};

struct Requirement {
  std::string id, section, text, source, since, observation, severity, level;
  std::size_t place = 0;  // in the catalogue
};
using Requirements = std::map<std::string, Requirement>;

// A text of the documents that has several readings, by name, and what they mean.
struct Ambiguity {
  std::string text, where;
  std::map<std::string, std::string> readings;
};
using Ambiguities = std::map<std::string, Ambiguity>;

// The requirement, or that which "ID/1-D" is one half of; null if there is none.
const Requirement* find_requirement(const Requirements& catalogue, const std::string& id);

// All throw FormatError; a null catalogue is an empty one.
Record read_record(const nlohmann::json& json);
Requirements read_requirements(const nlohmann::json& json);
Ambiguities read_ambiguities(const nlohmann::json& json);

}  // namespace evalcts::reports
