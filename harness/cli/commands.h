// The subcommands of evalcts. Each returns an exit code:
//   0 nothing unexpected; 1 an unexpected fail, crash or timeout; 2 wrong use, or something that was asked
//   for cannot be started, read or written; 3 a fault of evalcts itself.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/faults/fault_table.h"
#include "harness/results/run_result.h"
#include "harness/runner/folder_lock.h"

namespace evalcts::cli {

inline constexpr int kNothingUnexpected = 0;
inline constexpr int kUnexpected = 1;
inline constexpr int kWrongUse = 2;
inline constexpr int kOwnFault = 3;

struct RunOptions {
  std::vector<std::string> implementations;  // empty: the default ones
  std::string library;
  std::string context;
  std::string label;
  std::string filter;  // empty: all that the depth plays unasked
  std::string depth = "full";
  std::uint32_t seed = 1;
  double seconds_per_test = 60;
  std::uint64_t mebibytes = 4096;  // of memory, for each process
  int retries = 1;
  std::optional<int> jobs;  // processes for each implementation
  std::string output;       // empty: the usual folder
  std::string baseline;     // "DIR", "DIR/NAME", "NAME", "none", or empty for the shipped ones
  bool write_baseline = false;
  bool strict = false;
  bool reuse_context = false;
  std::vector<std::string> interpretations;  // NAME=READING
  std::string shard;                         // "K/N"; empty: all
  std::optional<std::uint32_t> shuffle;      // seed of the order in which the tests run
  bool quiet = false, verbose = false;
  std::string command;  // as typed
  std::string program;  // how it was called
};

struct ReproduceOptions {
  std::string failure;  // a test's name, NAME:test, or a part that only one failing test has
  std::string results;  // folder of the run; empty: the usual one
  std::string output;   // the file to write; empty: in the folder of the run
  std::string program;  // how evalcts was called
};

struct ReportOptions {
  std::vector<std::string> results;  // files and folders; empty: the usual folder
  std::vector<std::string> before;   // of the earlier results; empty: nothing is compared
  std::string output;                // empty: the usual folder
};

struct FaultsOptions {
  std::string filter;  // empty: all
  std::string shard;   // "K/N"; empty: all
  bool complete = false;
  double seconds_per_test = 20;
  std::optional<int> jobs;
  std::string output;  // empty: the usual folder
};

struct FuzzOptions {
  std::string implementation, library, context;
  std::uint32_t seed = 1;
  std::optional<std::uint32_t> programs;
  double seconds = 0;  // 0: no limit
  int length = 120;    // commands of a program, about
  bool fresh_contexts = false;
  std::optional<int> jobs;
  std::string output;  // empty: the usual folder
};

struct RoundingOptions {
  std::uint64_t samples = 100'000, exact = 2'000;  // values of each class
  bool sweep = false;
  std::string filter;  // of the classes; empty: all
  std::vector<std::string> targets;
  std::uint32_t seed = 1;
  std::optional<int> jobs;
};

inline constexpr std::uint64_t kValuesOfRow = 20'000, kValuesOfDigest = 10'000'000;

struct UlpOptions {
  std::vector<std::string> implementations;  // empty: the usual ones
  std::string library, context, label;
  std::vector<std::string> targets;     // empty: vertex_3
  std::string filter;                   // of the classes of maps; empty: all
  std::optional<std::uint64_t> values;  // of each row of the table, or of the digest
  std::optional<std::uint64_t> climb;  // results that the search for worse inputs may take; as many as values
  std::uint32_t seed = 1;
  std::optional<int> jobs;
  std::string output;  // empty: the usual folder
  bool verbose = false;
  // One input instead: its orders, control points and arguments.
  std::vector<int> orders;
  std::vector<double> points, at;
  // Every float of an interval instead.
  bool sweep = false;
  float from = 0, to = 1;
  std::optional<float> fixed_u, fixed_v;  // of a surface: where the argument stands that is not swept
  bool digest = false;                    // instead: one line for many results
  std::vector<std::string> merge;         // instead of that: files of its shards
  std::string page;                       // instead: the ulp.json whose page to write again
  std::string shard;                      // "K/N"; empty: all
  std::string checkpoint;                 // file; empty: one in the output folder
  std::string rows;     // for the process that measures one implementation: the file to fill
  std::string command;  // as typed
  std::string program;  // how it was called
};

struct VectorsOptions {
  std::string output;              // folder to write into; empty: the usual one
  std::vector<std::string> files;  // to look at; empty: those that are shipped
  std::vector<std::string> kinds;  // that are asked in a pipe; empty: all of them
};

int run(const RunOptions& options);
int list(const std::string& what, bool as_json);
// `complete`: a requirement, or a half of one, that is neither decided nor known to be undecidable is
// unexpected.
int coverage(bool as_json, bool complete);
int explain(const std::string& name);
int reproduce(const ReproduceOptions& options);
// Exit code 1 where --before names earlier results and something has become worse since.
int report(const ReportOptions& options);
// `complete`: a requirement that tests decide and no fault breaks is unexpected, too.
int faults(const FaultsOptions& options);
int fuzz(const FuzzOptions& options);
int rounding(const RoundingOptions& options);
int ulp(const UlpOptions& options);
int write_vectors(const VectorsOptions& options);
int lint_vectors(const VectorsOptions& options);
int emit_vectors(const VectorsOptions& options);
int check_vectors(const VectorsOptions& options);

// What `ulp` takes for --implementation beside the implementations, and for --target.
std::vector<std::string> own_subject_names();
std::vector<std::string> ulp_targets();

// Writes index.html and summary.md of these results, compared with the earlier ones, into an existing folder,
// each whole or not at all. Throws std::runtime_error.
void write_pages(const std::filesystem::path& output, const std::vector<RunResult>& results,
                 const std::vector<RunResult>& before);

// The answer of the suite program with faults. Throws std::runtime_error.
std::vector<faults::ListedFault> list_faults();

// Why an implementation does not start; empty where it does. Asked in a child: libraries do not share a
// process well.
std::string why_not(const std::string& implementation);

// The implementations that `run` and `ulp` use unless told otherwise. If OSMesa does not start, egl takes its
// place, and a line on standard output says so.
std::vector<std::string> default_implementations();

// Where this program, the suite programs and the usual output folder are.
struct Places {
  std::filesystem::path suite_program, faulty_suite_program;
  std::filesystem::path output;
  std::filesystem::path baselines;
  std::filesystem::path vectors;
  // libglevaluator for C programs; empty where it is not known.
  std::filesystem::path production_headers, production_library;
};
Places places();

// The output folder, for this command alone while the result lives; made where it is missing. Throws
// CannotStart where nothing can be written into it or another command writes there.
FolderLock claim(const std::filesystem::path& output, const std::string& command);

// True if the name matches a GoogleTest-like filter: patterns with * and ?, separated by ':', those after a
// '-' excluded. An empty filter matches every name.
bool is_chosen(const std::string& name, const std::string& filter);

// The items whose names match the filter.
template <class Named>
std::vector<Named> matching(std::vector<Named> items, const std::string& filter) {
  std::erase_if(items, [&](const Named& item) { return !is_chosen(item.name, filter); });
  return items;
}

}  // namespace evalcts::cli
