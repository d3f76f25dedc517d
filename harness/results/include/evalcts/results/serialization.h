// Reads and writes JSON: result files ("evalcts-results-1", described field by field in
// reports/schema/results-1.schema.json), the events of the suite program, and its answers. All text that was
// read is clean (see text.h), so that writers only have to escape for their own syntax.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <evalcts/results/run_result.h>

namespace evalcts {

// --- result files

// Reads a result file of unknown origin. Throws FormatError if the text is not complete JSON, is nested too
// deeply, has another format, or does not follow the format.
RunResult parse_run_result(const std::string& text);

// Reads a parsed result file. A field that is missing or null is tolerated. Throws FormatError for a field of
// the wrong type, an unknown format, verdict, level or status, or a duplicate test. Counts come from "tests";
// "summary" is used only for a record without tests.
RunResult read_run_result(const nlohmann::json& json);

// Returns the text of results-NAME.json.
std::string to_text(const RunResult& result);

// --- events of the suite program, one line each

struct TestStarted {
  std::string name;
};
// Written before each case, only if cases are traced.
struct CaseStarted {
  std::string identity;
  bool is_control;                 // explicit vertices are drawn instead of evaluating
  std::vector<std::string> calls;  // C statements
  std::string commands;            // for a replay: JSON text (gl/case_json.h); empty if there is none
};
// The first failing case of a test, written before TestFinished.
struct CaseFailed {
  std::string test;
  std::string commands;  // see CaseStarted
};
struct TestFinished {
  TestRecord record;
};
// The last event of a process that a signal ends.
struct Crashed {
  Crash crash;
};
struct RunEnded {};
// An event of a kind that parse_event() does not know, such as those of fuzzing; `line` is its JSON.
struct OtherEvent {
  std::string line;
};
using Event = std::variant<TestStarted, CaseStarted, CaseFailed, TestFinished, Crashed, RunEnded, OtherEvent>;

std::string to_line(const Event& event);
// Returns none if the line is not an event, for example because it was cut off.
std::optional<Event> parse_event(const std::string& line);

// --- answers of the suite program

// Properties of the implementation that the suite program knows before a test runs.
struct Description {
  ImplementationRecord implementation;
  std::vector<std::string> captures;  // names of all captures that can be tried
};
std::string to_text(const Description& description);
std::string to_text(const CaptureRecord& capture);
std::string to_text(const std::vector<ListedTest>& tests);
// Returns the answer to any question if the implementation does not start.
std::string cannot_start_text(const std::string& reason);

// Return none if the text is not an answer of this kind.
std::optional<Description> parse_description(const std::string& text);
std::optional<CaptureRecord> parse_capture(const std::string& text);
std::optional<std::vector<ListedTest>> parse_tests(const std::string& text);
std::optional<std::string> parse_cannot_start(const std::string& text);

}  // namespace evalcts
