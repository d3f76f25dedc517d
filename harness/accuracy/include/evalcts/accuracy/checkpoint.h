// Checkpoints: files from which an interrupted sweep resumes, and which hold its result once all blocks are
// finished (reports/schema/sweep-1.schema.json).
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/accuracy/sweep.h>
#include <evalcts/backends/implementation.h>

namespace evalcts::accuracy {

// A file is not a valid checkpoint of this sweep. The message names the problem and a remedy. No file has
// been overwritten.
struct BadCheckpoint : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The properties in which two sweeps must agree, besides the block size, so that one can resume the other.
struct SweepIdentity {
  std::string evalcts_version;
  std::string kind, library, vendor, renderer, gl_version;  // describe the implementation
  SweepTask task;
};
SweepIdentity identity_of(const SweepTask& task, const ImplementationInfo& info);
// Returns a text that is equal for equal identities.
std::string to_text(const SweepIdentity& identity);

// One of the largest errors of a sweep, with its argument `at`, the result and the exact value.
struct LargestError {
  double error;
  float at, got;
  float right;        // the exact value, correctly rounded
  std::string exact;  // text of reference::describe()
};
// Returns nothing if all results are correctly rounded.
std::optional<LargestError> largest_error(const SweepTask& task, const SweepResult::Largest& found);

struct Checkpoint {
  SweepIdentity identity;
  SweepState state;
  double seconds = 0;  // total time of all runs

  bool is_complete() const;
  const char* status() const { return is_complete() ? "complete" : "unfinished"; }
  // True if every float of the interval was tried.
  bool is_proven() const { return is_complete() && identity.task.shards == 1; }
};

// Writes the file atomically. Throws std::runtime_error.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

// Reads the checkpoint of a sweep. Throws BadCheckpoint if the file is damaged, cannot be read, or belongs to
// another sweep.
Checkpoint read_checkpoint(const std::filesystem::path& file, const SweepIdentity& identity);

// Merges the complete checkpoints of all shards into the checkpoint that a single process would have written;
// `seconds` is their sum. Throws BadCheckpoint if a file is damaged, unfinished, or belongs to another sweep
// than the first file, or if a shard is missing or occurs twice.
Checkpoint merged(const std::vector<std::filesystem::path>& files);

}  // namespace evalcts::accuracy
