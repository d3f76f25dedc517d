// Tries changes of implementations on the suite: tests must detect each injected fault, and no test may fail
// on a variation.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/results/test_record.h>

namespace evalcts::faults {

// A fault or variation as the suite program with faults lists it.
struct ListedChange {
  std::string name;
  std::string implementation;             // the implementation that is changed
  std::vector<std::string> arguments;     // with them, the suite program opens it; empty: --implementation
  Level level = Level::kMust;             // minimum level of the tests that must detect a fault
  std::vector<std::string> requirements;  // violated requirements: IDs, or halves ("ID/2-D")
  std::string what;                       // the mistake or the difference, in words
  std::string kind;                       // "wrapper", "switch" (mutation) or "variation"

  bool is_variation() const { return kind == "variation"; }
};

// A test that fails with a change, or a reason.
struct BadTest {
  std::string test;
  Level level = Level::kMust;
  Depth depth = Depth::kQuick;
  Verdict verdict = Verdict::kFail;
  std::string message;
};

// The result of the search for a test that detects a fault.
struct Detection {
  enum class Outcome { kDetected, kSurvives, kNotVisible };
  std::string subject;  // the violated requirement; for a variation, the fault behind it
  Outcome outcome = Outcome::kSurvives;
  BadTest first{};       // the first test that detected the fault
  std::string reason{};  // the reason if the fault is not visible

  bool is_detected() const { return outcome == Outcome::kDetected; }
};

// The outcome of a trial.
struct Tried {
  ListedChange change;
  std::string not_tried;  // the reason if it was not tried
  std::vector<Detection>
      detections;  // one for each requirement of a fault, or for each fault behind a variation
  // The tests that fail on a variation, and numbers of tests; `passed` includes `passed_in_part`.
  std::vector<BadTest> alarms{};
  std::uint64_t passed = 0, passed_in_part = 0, unobserved = 0;

  // True if there is no alarm, and every visible fault is detected.
  bool is_good() const;
};

struct TrialRequest {
  std::filesystem::path suite_program;  // the suite program with faults
  std::vector<ListedChange> changes;    // the faults or variations to try
  std::vector<ListedChange> behind{};   // the faults to try behind each variation
  std::vector<ListedTest> tests;        // all tests
  int jobs = 1;                         // number of changes that are tried in parallel
  double seconds_per_test = 20;
  std::filesystem::path scratch;  // an existing folder for lists and logs
};

// Tries each change and returns the outcomes in the same order; `progress` gets the number of completed
// trials. If `interrupted` is set, returns early with the outcomes so far.
//
// Fault: for each requirement that it violates, the tests that name the requirement run at quick depth and,
// if none detects the fault, at full depth. A test of the fault's level or above detects the fault if it
// passes on the implementation without the fault, and fails (or, for a fault of quality level, warns) with
// it.
//
// Variation: all tests run at quick depth as run_implementation() runs them, and the tests of each fault of
// `behind` with this fault behind the variation. A test that fails on the implementation without variation is
// ignored. A fault is visible behind a variation if a test of its requirements fails with the fault alone,
// passes in full with the variation alone, and is not `not-observable` with both.
//
// A change is not tried if its implementation does not start on this machine.
std::vector<Tried> try_all(const TrialRequest& request,
                           const std::function<void(std::size_t done, const std::string& name)>& progress);

// The requirements that tests decide, with the names of the faults that violate them.
struct FaultTable {
  struct Row {
    std::string requirement;
    std::vector<std::string> faults;
  };
  bool is_complete = true;
  std::vector<Tried> faults;
  std::vector<Row> requirements;
};
// Returns the table for these faults. `decided`: the requirements that tests decide, in the order
// of the table.
FaultTable make_table(std::vector<Tried> faults, const std::vector<std::string>& decided);

// Return a table of the requirements, their faults, and the tests that detect them, and a table of
// variations.
std::string as_markdown(const FaultTable& table);
std::string as_markdown(const std::vector<Tried>& variations);
// Returns the table as JSON, format "evalcts-faults-2".
std::string to_text(const FaultTable& table);

// Write and read {"faults": [{"name", "implementation", "arguments", "level", "requirements", "what",
// "kind"}]}. parse_changes() returns none if the text is not such a list.
std::string to_text(const std::vector<ListedChange>& changes);
std::optional<std::vector<ListedChange>> parse_changes(const std::string& text);

// Returns the faults or the variations that the suite program with faults lists. Throws CannotStart if the
// program does not exist, std::runtime_error if it does not answer.
std::vector<ListedChange> list_faults(const std::filesystem::path& suite_program);
std::vector<ListedChange> list_variations(const std::filesystem::path& suite_program);

}  // namespace evalcts::faults
