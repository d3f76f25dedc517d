// Results as JSON text, and back: the one place that knows the formats "evalcts-results-1"
// (reports/schema/results-1.schema.json describes it field by field), of the events of the suite program, and
// of its answers. All text that was read is clean (see text.h), so that writers only have to escape for their
// own syntax.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <evalcts/results/run_result.h>

namespace evalcts {

// --- result files

// Reads a result file that anybody may have written. Throws FormatError if the text is not JSON or was cut
// off, is nested as no result is, has another format, or does not follow it.
RunResult parse_run_result(const std::string& text);

// The same for JSON that was parsed. A field that is missing or null is tolerated; a field of the wrong type,
// an unknown format, verdict, level or status, or the same test twice throws FormatError. Counts come from
// "tests"; "summary" is used only for a record without tests.
RunResult read_run_result(const nlohmann::json& json);

// The text of results-NAME.json.
std::string to_text(const RunResult& result);

// --- events of the suite program, one line each

struct TestStarted {
  std::string name;
};
// Only if cases are traced, before each case.
struct CaseStarted {
  std::string identity;
  bool is_control;                 // explicit vertices in the place of evaluation
  std::vector<std::string> calls;  // as C
  std::string commands;            // to replay: JSON text (gl/case_json.h); empty if there is no such form
};
// The first failing case of a test, before TestFinished.
struct CaseFailed {
  std::string test;
  std::string commands;  // as of CaseStarted
};
struct TestFinished {
  TestRecord record;
};
// The last event of a process that a signal ends.
struct Crashed {
  Crash crash;
};
struct RunEnded {};
// An event of another kind, for a reader that knows it.
struct OtherEvent {
  std::string line;
};
using Event = std::variant<TestStarted, CaseStarted, CaseFailed, TestFinished, Crashed, RunEnded, OtherEvent>;

std::string to_line(const Event& event);
// None if the line is not an event, such as a line that was cut off.
std::optional<Event> parse_event(const std::string& line);

// --- answers of the suite program

// Properties of the implementation that the suite program knows before a test runs.
struct Description {
  ImplementationRecord implementation;
  std::vector<std::string> captures;  // names of all that can be tried
};
std::string to_text(const Description& description);
std::string to_text(const CaptureRecord& capture);
std::string to_text(const std::vector<ListedTest>& tests);
// The answer to any question if the implementation does not start.
std::string cannot_start_text(const std::string& reason);

// None if the text is not such an answer.
std::optional<Description> parse_description(const std::string& text);
std::optional<CaptureRecord> parse_capture(const std::string& text);
std::optional<std::vector<ListedTest>> parse_tests(const std::string& text);
std::optional<std::string> parse_cannot_start(const std::string& text);

}  // namespace evalcts
