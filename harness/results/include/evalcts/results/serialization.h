// Reads and writes JSON: result files ("evalcts-results-1", described field by field in
// reports/schema/results-1.schema.json), and the jobs and events of workers. All text that was
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

// Returns the tests as JSON: {"tests": [{"name", "requirements", "level", "from", "source"}]}.
std::string to_text(const std::vector<ListedTest>& tests);

// Returns the version of the tests: "0.2.0, 4425 tests, digest 1f3a...". It distinguishes suite programs that
// were built from different sources, as far as their tests tell.
std::string suite_id(const std::vector<ListedTest>& tests);

// --- the first line that a worker elsewhere reads

struct WorkerOptions {
  std::vector<std::string> options;  // of the suite program
  std::string programs;              // content of the file that --programs names; empty: there is none
};
std::string to_line(const WorkerOptions& options);
// Returns none if the line has another form.
std::optional<WorkerOptions> parse_worker_options(const std::string& line);

// --- jobs of a worker, one line each

struct Job {
  // "list": list all tests. "describe": describe the implementation. "prove": prove the capture `name`.
  // "test": run the test `name`. "case": judge the program `data`. "observe": see observed_values.h.
  // "reduce", "prove-bug" (`name`: its ID) and "fuzz": see reduction.h and campaign.h.
  std::string kind;
  std::string name;
  std::optional<std::uint64_t> cases = {};  // of a test: run only so many (it then decides nothing)
  bool traces_cases = false;                // report CaseStarted before each case
  // Run the last of `cases` with explicit vertices instead of evaluations, and stop the test.
  bool runs_control = false;
  std::string data = {};  // JSON text (a case: gl/case_json.h)
};
std::string to_line(const Job& job);
// Returns none if the line is not a job.
std::optional<Job> parse_job(const std::string& line);

// --- events of a worker, one line each

// A worker opens all that the job needs before it reports this. If it ends earlier, no job is to blame: Pool
// gives the job to the next worker, and gives up after several such ends. If it ends later, but before
// JobEnded, it has died in the job (WorkerRun::died_in_job()).
struct JobStarted {
  std::string name;
};
struct JobEnded {};
// Reported now and then by jobs that run many programs, so that a slow one is no hang.
struct StillRunning {};
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
struct TestsListed {
  std::vector<ListedTest> tests;
};
// The running case as a C program, written before it runs and again with the check of its failure; or "#error
// REASON" if there is none in this style. Written only if a program was asked for.
struct ProgramWritten {
  std::string text;
};
// The answer to "observe".
struct ValuesObserved {
  std::string capture;
  std::vector<float> values;
  std::string why_not;  // the reason if there are no values, otherwise empty
};
// Properties of the implementation that are known before a test runs.
struct Description {
  std::string suite;  // suite_id() of the worker
  ImplementationRecord implementation;
  std::vector<std::string> captures;  // names of all captures that can be tried
};
// The implementation does not start; the process ends.
struct CannotOpen {
  std::string reason;
};
// A worker elsewhere has found that its job hangs, and ends.
struct Hung {};
// The last event of a process that a signal ends.
struct Crashed {
  Crash crash;
};
// All jobs have ended.
struct RunEnded {};
// An event of a kind that parse_event() does not know, such as those of fuzzing; `line` is its JSON.
struct OtherEvent {
  std::string line;
};
using Event = std::variant<JobStarted, JobEnded, StillRunning, CaseStarted, CaseFailed, TestFinished,
                           TestsListed, ProgramWritten, ValuesObserved, Description, CaptureRecord,
                           CannotOpen, Hung, Crashed, RunEnded, OtherEvent>;

std::string to_line(const Event& event);
// Returns none if the line is not an event, for example because it was cut off.
std::optional<Event> parse_event(const std::string& line);

}  // namespace evalcts
