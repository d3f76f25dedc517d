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

// Thrown if a record or catalogue does not follow its format. what() names the place and what was expected
// there, as in "tests[3].ulp: expected a number, found a string".
struct FormatError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A capture, and whether it passed the proof that it shows vertices correctly.
struct CaptureRecord {
  std::string name;
  bool available = false;
  std::string reason;  // the reason why it is not available
  std::string shows;   // the attributes that it shows; empty if they were not recorded
};

// The implementation under test, as it describes itself.
struct ImplementationRecord {
  std::string name;  // the label given with --name, otherwise the same as `kind`
  std::string kind;  // the name of the implementation in --implementation
  std::string library, vendor, renderer, version, machine;
  std::string context_library;  // the file that made the contexts; empty: `library`
  std::string note;  // a warning for the reader, for example that another driver than requested was loaded
  std::optional<std::int64_t> max_eval_order;  // the reported value, which may be anything
  std::vector<std::string> files;              // the libraries and drivers that were loaded
  std::vector<CaptureRecord> captures;
};

enum class RunStatus {
  kComplete,
  kInterrupted,  // the result contains the tests that had ended by then
  kNotStarted    // no context or library; the result contains no tests
};
const char* name_of(RunStatus status);
std::optional<RunStatus> status_named(const std::string& name);

// The first pass runs each case in a fresh context; the second runs all of them in one shared context.
enum class Pass { kFreshContexts, kReuseContext };
// Returns "" or "reuse-context", the name of the pass in records, baselines and file names.
const char* name_of(Pass pass);
std::optional<Pass> pass_named(const std::string& name);

// A part of the tests: every `count`-th test, from the `number`-th on. 1 <= number <= count.
struct Shard {
  std::uint32_t number = 1, count = 1;
  std::string text() const;  // "2-of-4"
  // Inverse of text(); none if the text is not a shard.
  static std::optional<Shard> parse(const std::string& text, const std::string& separator = "-of-");
  // Returns the part of the list that belongs to this shard.
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
  std::string reason;  // the reason why the run is not complete
  std::string command;
  std::string started;                     // "2026-11-28T11:27:22Z"
  std::optional<double> seconds;           // duration, with the reduction of failing tests
  std::string host;                        // name of the machine
  std::vector<std::string> suite_command;  // starts the suite program for this implementation
  std::optional<double> timeout;           // seconds for each test
  std::optional<std::uint64_t> memory;     // MiB for each process
  std::optional<Depth> depth;
  std::string filter;  // selected among the tests of the depth; empty: all of them were run
  std::optional<std::uint64_t> seed;
  Pass pass = Pass::kFreshContexts;
  std::optional<Shard> shard;
  std::string origin;    // the folder or file that the record was read from, because names may be equal
  std::string baseline;  // "mesa with mesa.softpipe"; empty: none
  std::vector<std::string> stale_baseline_entries;
  bool strict = false;                   // unexpected passes and stale baseline entries are problems
  std::uint64_t confirmed_by_group = 0;  // unexpected failures not repeated, because one of their group was
  std::map<std::string, std::vector<std::string>> readings;  // readings of each ambiguous passage, by its ID
  ImplementationRecord implementation;
  Counts counts{};  // by verdict
  std::vector<TestRecord> tests;
  // The commands of the first failing case of a test, by its name, as JSON text (gl/case_json.h). Not part of
  // result files.
  std::map<std::string, std::string> failing_cases;
  std::vector<Bug> bugs;  // the bugs that explain the failing tests, most important first
  std::string bugs_note;  // the reason why `bugs` is missing or not all of them were reduced; may be empty

  bool is_complete() const { return status == RunStatus::kComplete; }
  bool has_started() const { return status != RunStatus::kNotStarted; }
  std::uint64_t total() const;
  std::uint64_t unexpected_count() const;  // with counts only, no failure is known to be expected
  std::uint64_t expected_failure_count() const;
  // Sets `counts` and `readings` from the tests.
  void summarize();
  // Returns the bug that explains the test; null if there is none.
  const Bug* bug_of(const std::string& test) const;
  // Returns "osmesa", or "osmesa, one shared context" for the second pass. `unnamed` replaces a missing name.
  std::string heading(const std::string& unnamed) const;
  // Returns the part of the names of output files that identifies implementation, shard and pass: "NAME",
  // "NAME.1-of-4", "NAME.reuse-context", "NAME.1-of-4.reuse-context".
  std::string file_label() const;
};

}  // namespace evalcts
