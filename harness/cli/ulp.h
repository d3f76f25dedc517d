// The parts of `evalcts ulp`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/backends/implementation.h>
#include "command.h"

namespace evalcts::cli {

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
  std::vector<double> domain;  // of the maps, or of that input: u1, u2 and v1, v2; empty: that of the class
  int segments = 0;            // of the grid whose point the input's argument is; 0: a coordinate
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

// The one implementation of the options.
ImplementationOptions implementation_of(const UlpOptions& options);
// Why the orders and control points that were given are none; empty where they are good: floats, as many as
// the orders say.
std::string wrong_points(const UlpOptions& options);
// Every float of an interval.
int sweep(const UlpOptions& options);
// The shards of a sweep together.
int merge(const UlpOptions& options);
// One line for many results.
int digest(const UlpOptions& options);

}  // namespace evalcts::cli
