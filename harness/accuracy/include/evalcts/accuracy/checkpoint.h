// A sweep as a file: what has been found out so far, from which it goes on after it was ended in whatever
// way, and its result once all blocks are done (reports/schema/sweep-1.schema.json).
#pragma once

#include <filesystem>
#include <stdexcept>

#include <evalcts/accuracy/sweep.h>
#include <evalcts/results/json.h>

namespace evalcts::accuracy {

// The file is not what it should be; the message says how, and what to do. Nothing has been overwritten.
struct BadCheckpoint : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// All that two sweeps must have in common for one to go on where the other ended: versions, implementation,
// polynomial, interval, shard, size of blocks.
nlohmann::json identity_of(const SweepTask& task, const ImplementationInfo& info);

// `seconds`: the time that all runs together have taken.
nlohmann::json checkpoint_of(const SweepTask& task, const nlohmann::json& identity, const SweepState& state,
                             double seconds);

// Atomically: a file that is there is whole. Throws std::runtime_error.
void write_checkpoint(const std::filesystem::path& file, nlohmann::json checkpoint);

struct Resumed {
  SweepState state;
  double seconds;
};
// Throws BadCheckpoint where the file is damaged, cannot be read, or is of another sweep.
Resumed read_checkpoint(const std::filesystem::path& file, const SweepTask& task,
                        const nlohmann::json& identity);

// One complete checkpoint of those of all shards, as one process would have it but for the seconds, which are
// the sum. Throws BadCheckpoint where a file is damaged, unfinished, of another sweep than the first or of a
// shard that is there already, or where a shard is missing.
nlohmann::json merged(const std::vector<std::filesystem::path>& files);

}  // namespace evalcts::accuracy
