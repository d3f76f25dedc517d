// The results of `evalcts ulp` as types, their JSON (reports/schema/ulp-1.schema.json), and the lines in
// which a measuring process reports its results.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <evalcts/accuracy/errors.h>
#include <evalcts/accuracy/profile.h>
#include <evalcts/accuracy/table.h>
#include <evalcts/backends/implementation.h>

namespace evalcts::accuracy {

// A result with one of the largest errors, and the command that evaluates its input again.
struct WorstResult {
  Worst worst;
  std::vector<std::string> replay;
};

// Numbers of results that have no ULP error (exact zeros), or no condition-aware error either (no terms).
struct Apart {
  std::uint64_t values = 0, wrong = 0;
};

// One class of maps of one target, measured or not. Errors may be infinite.
struct Row {
  Class what;
  std::string target;  // empty if the implementation has no targets
  std::uint32_t seed = 1;
  std::string not_measured;  // reason if there are no numbers, otherwise empty

  std::string capture;  // empty if results are read without a capture
  std::uint64_t values = 0, not_correctly_rounded = 0, not_finite = 0;
  double max_ulp = 0, mean_ulp = 0, max_condition_aware = 0, mean_condition_aware = 0;
  std::uint64_t climbed = 0;
  double sample_max_ulp = 0, sample_max_condition_aware = 0;  // without climb()
  std::array<std::uint64_t, Errors::kBins> histogram{};
  Apart zeros, without_terms;
  std::optional<WorstResult> worst_ulp, worst_condition_aware, worst_zero;
};

// Returns the row of `errors`. `sample` are the errors before climb(), `climbed` the number of results of
// climb().
Row row_of(const RowRequest& request, const Subject& subject, const Errors& errors, const Errors& sample,
           std::uint64_t climbed);
Row not_measured(const RowRequest& request, const std::string& why);

struct MeasuredImplementation {
  enum class Status { kComplete, kInterrupted, kCrashed, kNotStarted };

  std::string name;                        // the implementation's name or label
  std::optional<ImplementationInfo> info;  // names, versions and the largest order; none if it did not start
  Status status = Status::kComplete;
  std::string reason;  // why the status is not complete
  std::vector<Row> rows;
  std::vector<Profile> profiles;
};

struct Report {
  std::string command;  // command line as the user typed it
  bool interrupted = false;
  std::uint32_t seed = 1;
  std::vector<std::string> targets;
  std::vector<MeasuredImplementation> implementations;
};

// Returns the report in the format evalcts-ulp-1.
nlohmann::json to_json(const Report& report);

// --- Events of a worker that measures one implementation

using Line = std::variant<ImplementationInfo, Row, Profile>;

std::string to_text(const Line& line);
// Returns nothing if the line is truncated.
std::optional<Line> parse_line(const std::string& text);

}  // namespace evalcts::accuracy
