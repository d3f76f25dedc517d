// Declares the options and the modes of `evalcts ulp`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/cli/command.h>

namespace evalcts::cli {

inline constexpr std::uint64_t kValuesOfRow = 20'000, kValuesOfDigest = 10'000'000;

struct UlpOptions {
  std::vector<std::string> implementations;  // empty: the default implementations
  std::string library, context, label;
  std::vector<std::string> targets;     // empty: vertex_3
  std::string filter;                   // selects classes of maps; empty: all
  std::optional<std::uint64_t> values;  // number of values of each row of the table, or of the digest
  std::optional<std::uint64_t> climb;   // evaluations of the search for worse inputs; none: as `values`
  std::uint32_t seed = 1;
  std::optional<int> jobs;
  std::string output;  // empty: the default folder
  bool verbose = false;
  // Mode that evaluates one input: its orders, control points and arguments.
  std::vector<int> orders;
  std::vector<double> points, at;
  std::vector<double> domain;  // u1, u2 or u1, u2, v1, v2 of the maps or of the one input; empty: the default
  int segments = 0;            // segments of the grid if the argument is a grid point; 0: it is a coordinate
  // Mode that evaluates at every float of an interval.
  bool sweep = false;
  float from = 0, to = 1;
  std::optional<float> fixed_u, fixed_v;  // the fixed argument of a surface, which is not swept
  bool digest = false;                    // mode that prints one line for many results
  std::vector<std::string> merge;         // mode that merges a sweep: files of its shards
  std::string page;                       // mode that writes the page of this ulp.json again
  std::string shard;                      // "K/N"; empty: all
  std::string checkpoint;                 // file; empty: one in the output folder
  std::string worker;   // mode of a worker, which measures one implementation: the file of its events
  std::string command;  // the typed command
  std::string program;  // evalcts as the user typed it
};

// Returns the implementation that the options name; they must not name several.
ImplementationOptions implementation_of(const UlpOptions& options);
// Returns the error in the orders and control points; empty if the points are floats in the number that the
// orders require.
std::string wrong_points(const UlpOptions& options);
// Measures the errors at every float of an interval. Returns an exit code, as the next two functions do.
int sweep(const UlpOptions& options);
// Merges the shards of a sweep.
int merge(const UlpOptions& options);
// Prints one line with a digest of many results.
int digest(const UlpOptions& options);

}  // namespace evalcts::cli
