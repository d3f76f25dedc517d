// The record of one test: its verdict, and the observations that led to it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/results/accuracy.h>
#include <evalcts/results/depth.h>
#include <evalcts/results/difference.h>
#include <evalcts/results/requirement_id.h>
#include <evalcts/results/verdict.h>

namespace evalcts {

// A test as the suite program lists it, known without a run.
struct ListedTest {
  std::string name;  // "Map1Errors.StrideBelowK/MAP1_VERTEX_3"
  std::vector<RequirementId> requirements;
  Level level = Level::kMust;
  Depth from = Depth::kQuick;  // the least depth that runs the test, unless a filter has its exact name
  std::string source = {};     // see TestRecord
};

// Vertices of a primitive, for a plot.
struct PlottedPrimitive {
  std::string mode;  // "GL_LINE_STRIP"
  std::vector<std::array<float, 3>> positions;

  bool operator==(const PlottedPrimitive&) const = default;
};

// Pixels of a rectangle of the window, for a plot: "rrggbb" for each pixel, the lowest row first.
struct PlottedPixels {
  int x = 0, y = 0, width = 1, height = 1;
  std::string expected, captured;

  bool operator==(const PlottedPixels&) const = default;
};

// A failing case as it is expected and as it was captured, for a picture in the report: primitives or pixels.
struct Plot {
  static constexpr std::size_t kMostVertices = 96;  // limit for each side
  static constexpr std::size_t kMostPixels = 4096;

  // None if the test has a rule in place of expected vertices.
  std::optional<std::vector<PlottedPrimitive>> expected;
  std::vector<PlottedPrimitive> captured;
  std::vector<PlottedPixels> pixels;
  bool is_cut = false;  // there are more vertices or pixels

  bool operator==(const Plot&) const = default;
};

// One failing case of a test.
struct Failure {
  std::string case_identity;
  std::string message;
  std::string what;  // the compared value: "texcoord[0].s of vertex 3"
  Difference difference;
  std::string expected;
  std::string captured;
  std::string exact;                           // the exact value; empty if nothing was evaluated
  std::string capture;                         // the name of the capture that observed the value
  std::optional<double> ulp, condition_aware;  // infinite for an infinite error
  std::vector<std::string> calls;              // the GL commands of the case, as C
  std::optional<Plot> plot;  // only for a test's first failure in positions, vertices or pixels

  bool operator==(const Failure&) const = default;
};

// The place of a crash or hang in the library.
struct Crash {
  // The GL command in flight, "glGetMapiv(GL_MAP1_NORMAL, GL_ORDER, ...)"; empty if there was none.
  std::string call;
  std::uint64_t commands_before = 0;  // number of commands of the case before `call`
  std::vector<std::string> frames;    // the innermost first, "libGL.so.1 glGetMapiv+0x2c"; empty if unknown

  // Returns the name of the command in flight, "glGetMapiv"; empty if there was none.
  std::string command() const;
  // Returns a text that is equal for crashes with the same innermost frames: "frame < caller < its caller",
  // or command() if there are no frames.
  std::string group() const;
};

// Outcome of a test when it was repeated alone in a new process.
struct Repetition {
  Verdict verdict = Verdict::kInternalError;
  std::string message;
};

// A long primitive with a wrong colour has hundreds of thousands of mismatches.
inline constexpr std::size_t kMostMismatches = 500;

struct TestRecord {
  std::string name;
  std::vector<RequirementId> requirements;
  Level level = Level::kMust;
  Verdict verdict = Verdict::kInternalError;
  std::string message;  // the verdict in one line
  std::string source;   // file in the repository and line, "suites/map_errors.cpp:34"; may be empty
  // The requirements that a fail violates. They need not be requirements of the test: in any test, a
  // wrong value that no map supplies violates EV-COORD-CURRENT. Empty if the violated requirements
  // were not determined.
  std::vector<RequirementId> violated;
  std::optional<std::uint64_t> cases, failed_cases, seed;
  std::optional<double> seconds;
  // Sorted identities of the mismatches, "case: what": the first kMostMismatches. If there are more,
  // `signature_of_all` is the signature of all; otherwise it is empty.
  std::vector<std::string> mismatches;
  std::string signature_of_all;
  std::vector<Failure> failures;  // the first few, in full
  std::string capture;            // the first capture that was used; empty if none was
  // Parts that the test is about, but did not observe, because no capture shows these attributes or these
  // commands are missing: "colour, normal, glMap1d (missing)". The verdict does not cover them.
  std::string unobserved;
  std::vector<std::string>
      left_out;                // optional calls that the test omitted, because they crash or are rejected
  std::optional<Crash> crash;  // for a crash or timeout, if the process could report it
  std::optional<Accuracy> accuracy;
  std::map<std::string, std::string> readings;  // the implementation's reading of ambiguous passages, by ID

  bool expected_by_baseline = false;
  std::string baseline_reason;  // empty without an entry in the baseline
  // IDs of the known bugs that the baseline names for an expected failure, the most specific one first.
  std::vector<std::string> known_bugs;
  bool also_in_fresh_context = false;  // second pass: the test fails in the same way in fresh contexts
  // The tests that must run before this test in the same process to make it fail. Empty: the test's own
  // earlier cases suffice. Missing: not searched for, or not found.
  std::optional<std::vector<std::string>> history;
  std::string history_case;         // the case of the only test of the history that is needed; may be empty
  bool flake = false;               // a failure that did not occur again in a repetition
  std::optional<Repetition> again;  // the outcome of the repetition, if it was another one
  std::string rerun, debug, reproducer;  // shell commands; for failures

  bool is_bad() const { return evalcts::is_bad(verdict); }
  // Returns a text that is equal for tests in which the library crashes or hangs at the same place:
  // Crash::group() for a crash, Crash::command() for a hang, which may be stopped anywhere in its loop. Empty
  // for other tests, and if the place is unknown.
  std::string place_of_death() const;
  // Returns the requirements that a bad test contradicts: `violated`, or if that is empty, all requirements
  // of the test. Empty for a test that is not bad.
  std::vector<RequirementId> blamed() const;
  // Returns the requirements of a bad test that it leaves undecided, because it violates only others.
  std::vector<RequirementId> hidden() const;
  // An internal error is a bug of evalcts, so no baseline can expect it.
  bool is_expected_failure() const { return is_failure(verdict) && expected_by_baseline; }
  // Only a baseline entry has a reason, so a pass with a reason that was not expected contradicts its entry.
  bool is_unexpected_pass() const {
    return verdict == Verdict::kPass && !expected_by_baseline && !baseline_reason.empty();
  }
  bool is_unexpected() const { return (is_bad() && !is_expected_failure()) || is_unexpected_pass(); }
  // Order of reporting, smallest first: unexpected failures by verdict, expected failures by verdict,
  // unexpected passes, the rest by verdict.
  int severity() const;
  // Returns a short text that identifies all mismatches: their number and a hash.
  std::string signature() const;
  // Sorts the mismatches, and leaves out those beyond kMostMismatches.
  void shorten_mismatches();
};

}  // namespace evalcts
