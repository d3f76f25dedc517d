// A sweep as a file: what has been found out so far, from which it goes on after it was ended in whatever
// way, and its result once all blocks are done (reports/schema/sweep-1.schema.json).
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/accuracy/sweep.h>
#include <evalcts/backends/implementation.h>

namespace evalcts::accuracy {

// The file is not what it should be; the message says how, and what to do. Nothing has been overwritten.
struct BadCheckpoint : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// All that two sweeps must have in common for one to go on where the other ended; the size of blocks besides.
struct SweepIdentity {
  std::string evalcts_version;
  std::string kind, library, vendor, renderer, gl_version;  // of the implementation
  SweepTask task;
};
SweepIdentity identity_of(const SweepTask& task, const ImplementationInfo& info);
// The same text for the same identity.
std::string to_text(const SweepIdentity& identity);

// One of the largest errors of a sweep, beside the exact value.
struct LargestError {
  double error;
  float at, got;
  float right;        // the exact value, correctly rounded
  std::string exact;  // as reference::describe() writes it
};
// None if all results are correctly rounded.
std::optional<LargestError> largest_error(const SweepTask& task, const SweepResult::Largest& found);

struct Checkpoint {
  SweepIdentity identity;
  SweepState state;
  double seconds = 0;  // that all runs together have taken

  bool is_complete() const;
  const char* status() const { return is_complete() ? "complete" : "unfinished"; }
  // True if every float of the interval was tried.
  bool is_proven() const { return is_complete() && identity.task.shards == 1; }
};

// Atomically: a file that is there is whole. Throws std::runtime_error.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

// Throws BadCheckpoint if the file is damaged, cannot be read, or is of another sweep.
Checkpoint read_checkpoint(const std::filesystem::path& file, const SweepIdentity& identity);

// One complete checkpoint of those of all shards, as one process would have it but for the seconds, which are
// the sum. Throws BadCheckpoint if a file is damaged, unfinished, of another sweep than the first or of a
// shard that is there already, or if a shard is missing.
Checkpoint merged(const std::vector<std::filesystem::path>& files);

}  // namespace evalcts::accuracy
