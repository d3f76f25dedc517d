// The results of one implementation in one run: the content of results-NAME.json.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/results/bug.h>
#include <evalcts/results/test_record.h>

namespace evalcts {

// A record or catalogue does not follow its format. what() names the place and what was expected there, as in
// "tests[3].ulp: expected a number, found a string".
struct FormatError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A capture, and the result of its proof.
struct CaptureRecord {
  std::string name;
  bool available = false;
  std::string reason;  // why it is not available
  std::string shows;   // the attributes that it can see; empty if that was not recorded
};

// The implementation under test, as it describes itself.
struct ImplementationRecord {
  std::string name;  // or the label given with --name
  std::string kind;  // its name for --implementation, whatever its label
  std::string library, vendor, renderer, version, machine;
  std::string note;  // what the reader has to know about it, such as a driver that was not asked for
  std::optional<std::int64_t> max_eval_order;  // as reported; a broken implementation may report anything
  std::vector<std::string> files;              // the libraries and drivers that were loaded
  std::vector<CaptureRecord> captures;
};

enum class RunStatus {
  kComplete,
  kInterrupted,  // the tests hold what was judged until then
  kNotStarted    // no context or library; there are no tests
};
const char* name_of(RunStatus status);
std::optional<RunStatus> status_named(const std::string& name);

// The first pass runs each case in a fresh context; the second runs all of them in one shared context.
enum class Pass { kFreshContexts, kReuseContext };
// "", "reuse-context": in records, baselines and file names.
const char* name_of(Pass pass);
std::optional<Pass> pass_named(const std::string& name);

// A part of the tests: every `count`-th, from the `number`-th on. 1 <= number <= count.
struct Shard {
  std::uint32_t number = 1, count = 1;
  std::string text() const;  // "2-of-4"
  // The inverse; none if the text is something else.
  static std::optional<Shard> parse(const std::string& text, const std::string& separator = "-of-");
  // The part of the list.
  template <class T>
  std::vector<T> part_of(const std::vector<T>& all) const {
    std::vector<T> part;
    for (std::size_t i = number - 1; i < all.size(); i += count) part.push_back(all[i]);
    return part;
  }
};

using Counts = std::array<std::uint64_t, kVerdicts>;

struct RunResult {
  std::string evalcts_version;
  std::optional<RunStatus> status;
  std::string reason;  // why it is not complete
  std::string command;
  std::vector<std::string> suite_command;  // starts the suite program for this implementation
  std::optional<double> timeout;           // seconds for each test
  std::optional<std::uint64_t> memory;     // MiB for each process
  std::optional<Depth> depth;
  std::optional<std::uint64_t> seed;
  Pass pass = Pass::kFreshContexts;
  std::optional<Shard> shard;
  std::string origin;    // the folder or file that the record was read from; tells records of one name apart
  std::string baseline;  // "mesa with mesa.softpipe"; empty: none
  std::vector<std::string> stale_baseline_entries;
  std::uint64_t confirmed_by_group = 0;  // unexpected failures that another of their group was run again for
  std::map<std::string, std::vector<std::string>> readings;  // of ambiguous texts, by their names
  ImplementationRecord implementation;
  Counts counts{};  // by verdict
  std::vector<TestRecord> tests;
  // The commands of the first failing case of a test, by its name, as JSON text (gl/case_json.h). Not part of
  // result files.
  std::map<std::string, std::string> failing_cases;
  std::vector<Bug> bugs;  // what explains the failing tests, most important first
  std::string bugs_note;  // why `bugs` is missing, or not all of it was reduced; empty if neither is so

  bool is_complete() const { return status == RunStatus::kComplete; }
  bool has_started() const { return status != RunStatus::kNotStarted; }
  std::uint64_t total() const;
  std::uint64_t unexpected_count() const;  // with counts only, no failure is known to be expected
  std::uint64_t expected_failure_count() const;
  // Sets `counts` and `readings` from the tests.
  void summarize();
  // The bug that explains the test; null if there is none.
  const Bug* bug_of(const std::string& test) const;
  // "osmesa", or "osmesa, one shared context" for the second pass; `unnamed` if the record has no name.
  std::string heading(const std::string& unnamed) const;
  // The part of the names of the output's files that stands for implementation, shard and pass: "NAME",
  // "NAME.1-of-4", "NAME.reuse-context", "NAME.1-of-4.reuse-context".
  std::string file_label() const;
};

// Tests that crash with the same innermost frames.
struct CrashGroup {
  std::string where;                 // see Crash::group()
  std::map<std::string, int> calls;  // the commands in flight, with the number of tests
  std::vector<const TestRecord*> tests;
  // The command in flight in most of the tests, and how many others there are: "glEnd() and 2 more".
  std::string call() const;
};
// The largest group first. Points into `result`.
std::vector<CrashGroup> crash_groups(const RunResult& result);

}  // namespace evalcts
