// The requirement-by-fault table: the suite is run against each injected fault, and has to detect it.
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
  std::string implementation;             // that it is injected into
  std::vector<std::string> arguments;     // make the suite program open that implementation; may be empty
  Level level = Level::kMust;             // at which a test has to detect it
  std::vector<std::string> requirements;  // that it breaks: IDs, or halves ("ID/2-D")
  std::string what;                       // the mistake, in words
  std::string kind;                       // "wrapper", "switch"
};

// Tells whether a test of one requirement detects a fault.
struct Detection {
  std::string requirement;
  bool detected = false;
  std::string test;  // the first that detected it
  Level test_level = Level::kMust;
  Depth depth = Depth::kQuick;
  Verdict verdict = Verdict::kFail;
  std::string message;
};

enum class FaultOutcome { kDetected, kSurvives, kNotTried };

struct TriedFault {
  ListedFault fault;
  FaultOutcome outcome = FaultOutcome::kDetected;  // by a test of each of its requirements
  std::string reason;                              // why it was not tried
  std::vector<Detection> detections;               // one for each requirement
};

struct FaultTable {
  struct Row {
    std::string requirement;
    std::vector<std::string> faults;  // names
  };
  bool is_complete = true;
  std::vector<TriedFault> faults;
  std::vector<Row> requirements;  // those that tests decide
};

struct TableRequest {
  std::filesystem::path suite_program;  // the one with faults
  std::vector<ListedFault> faults;      // to try
  std::vector<ListedTest> tests;        // all
  int jobs = 1;                         // faults side by side
  double seconds_per_test = 20;
  std::filesystem::path scratch;  // an existing folder for lists and logs
};

// Tries each fault and returns the outcomes in the same order. For each requirement that the fault breaks,
// the tests that name it are run at quick depth, then, if none detects it, at full depth. A test detects a
// fault if it passes on the implementation without the fault and fails (or, for a fault of quality level,
// warns) with it, at the fault's level or above. A fault whose implementation cannot be started here is not
// tried. Stops early, with what is known, when `interrupted` is set.
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
  std::string test;    // the first that detected it
  std::string reason;  // why it is not visible
};

struct TriedVariation {
  ListedFault variation;
  std::string reason;                                            // why it was not tried; empty: it was
  std::uint64_t passed = 0, passed_in_part = 0, unobserved = 0;  // tests; in part: also counted as passed
  std::vector<FalseAlarm> alarms;
  std::vector<DetectionBehind> detections;

  bool is_good() const;  // no alarm, and no fault that is visible survives
};

// Runs all tests against each variation, at quick depth, and the tests of each fault with that fault behind
// the variation. A test that does not pass on the implementation without variation says nothing. A fault is
// visible behind a variation if some test of its requirements, that fails with the fault alone, passes in
// full with the variation alone, and is not not-observable with both.
std::vector<TriedVariation> try_variations(
    const TableRequest& request, const std::vector<ListedFault>& variations,
    const std::function<void(std::size_t done, const std::string& variation)>& progress);

// The variations for people.
std::string as_markdown(const std::vector<TriedVariation>& variations);

// The table for these faults. `decided`: the requirements that tests decide, in order.
FaultTable make_table(std::vector<TriedFault> faults, const std::vector<std::string>& decided);

// The table for people: requirements, their faults, and which test detects each.
std::string as_markdown(const FaultTable& table);
// The same as JSON, format "evalcts-faults-2".
std::string to_text(const FaultTable& table);

// {"faults": [{"name", "implementation", "arguments", "level", "requirements", "what", "kind"}]}, and back;
// none if the text is not such a list.
std::string to_text(const std::vector<ListedFault>& faults);
std::optional<std::vector<ListedFault>> parse_faults(const std::string& text);

// The answer of the suite program with faults, to "--list-faults" or "--list-variations". Throws CannotStart
// if there is no such program, else std::runtime_error.
std::vector<ListedFault> list_faults(const std::filesystem::path& suite_program,
                                     const std::string& question = "--list-faults");

}  // namespace evalcts::faults
