// Makes the requirement-by-fault table: the suite runs against each injected fault and must detect it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/results/test_record.h>

namespace evalcts::faults {

// A fault as the suite program with faults lists it.
struct ListedFault {
  std::string name;
  std::string implementation;             // the implementation that gets the fault
  std::vector<std::string> arguments;     // with them, the suite program opens it; empty: --implementation
  Level level = Level::kMust;             // minimum level of the tests that must detect the fault
  std::vector<std::string> requirements;  // violated requirements: IDs, or halves ("ID/2-D")
  std::string what;                       // the mistake, in words
  std::string kind;                       // "wrapper", "switch" (mutation) or "variation"
};

// The result of the search for a test of one requirement that detects a fault.
struct Detection {
  std::string requirement;
  bool detected = false;
  std::string test;  // the first test that detected the fault
  Level test_level = Level::kMust;
  Depth depth = Depth::kQuick;
  Verdict verdict = Verdict::kFail;
  std::string message;
};

enum class FaultOutcome { kDetected, kSurvives, kNotTried };

struct TriedFault {
  ListedFault fault;
  FaultOutcome outcome = FaultOutcome::kDetected;  // kDetected: by a test of each of its requirements
  std::string reason;                              // the reason if the fault was not tried
  std::vector<Detection> detections;               // one for each requirement
};

struct FaultTable {
  struct Row {
    std::string requirement;
    std::vector<std::string> faults;  // names of the faults that violate it
  };
  bool is_complete = true;
  std::vector<TriedFault> faults;
  std::vector<Row> requirements;  // the requirements that tests decide
};

struct TableRequest {
  std::filesystem::path suite_program;  // the suite program with faults
  std::vector<ListedFault> faults;      // the faults to try
  std::vector<ListedTest> tests;        // all tests
  int jobs = 1;                         // number of faults that are tried in parallel
  double seconds_per_test = 20;
  std::filesystem::path scratch;  // an existing folder for lists and logs
};

// Tries each fault and returns the outcomes in the same order. For each requirement that the fault violates,
// the tests that name it run at quick depth and, if none detects the fault, at full depth. A test of the
// fault's level or above detects the fault if it passes on the implementation without the fault, and fails
// (or, for a fault of quality level, warns) with it. A fault is not tried if its implementation does not
// start on this machine. If `interrupted` is set, returns early with the outcomes so far.
std::vector<TriedFault> try_faults(
    const TableRequest& request,
    const std::function<void(std::size_t done, const std::string& fault)>& progress);

// One test that fails on a conforming implementation.
struct FalseAlarm {
  std::string test;
  Verdict verdict = Verdict::kFail;
  std::string message;
};

// The outcome of a typical fault behind a variation.
struct DetectionBehind {
  std::string fault;
  enum class Outcome { kDetected, kSurvives, kNotVisible } outcome = Outcome::kNotVisible;
  std::string test;    // the first test that detected the fault
  std::string reason;  // the reason if the fault is not visible
};

struct TriedVariation {
  ListedFault variation;
  std::string reason;  // the reason if it was not tried
  // Numbers of tests; `passed` includes `passed_in_part`.
  std::uint64_t passed = 0, passed_in_part = 0, unobserved = 0;
  std::vector<FalseAlarm> alarms;
  std::vector<DetectionBehind> detections;

  bool is_good() const;  // true if there is no alarm, and no visible fault survives
};

// Runs all tests at quick depth against each variation, and the tests of each fault with this fault behind
// the variation. A test that fails on the implementation without variation is ignored. A fault is visible
// behind a variation if a test of its requirements fails with the fault alone, passes in full with the
// variation alone, and is not `not-observable` with both.
std::vector<TriedVariation> try_variations(
    const TableRequest& request, const std::vector<ListedFault>& variations,
    const std::function<void(std::size_t done, const std::string& variation)>& progress);

// Returns a table of the variations and their results.
std::string as_markdown(const std::vector<TriedVariation>& variations);

// Returns the table for these faults. `decided`: the requirements that tests decide, in the order
// of the table.
FaultTable make_table(std::vector<TriedFault> faults, const std::vector<std::string>& decided);

// Returns a table of the requirements, their faults, and the tests that detect them.
std::string as_markdown(const FaultTable& table);
// Returns the table as JSON, format "evalcts-faults-2".
std::string to_text(const FaultTable& table);

// Write and read {"faults": [{"name", "implementation", "arguments", "level", "requirements", "what",
// "kind"}]}. parse_faults() returns none if the text is not such a list.
std::string to_text(const std::vector<ListedFault>& faults);
std::optional<std::vector<ListedFault>> parse_faults(const std::string& text);

// Returns the faults or variations that the suite program with faults lists; `question` is
// "--list-faults" or "--list-variations". Throws CannotStart if the program does not exist,
// std::runtime_error if it does not answer.
std::vector<ListedFault> list_faults(const std::filesystem::path& suite_program,
                                     const std::string& question = "--list-faults");

}  // namespace evalcts::faults
