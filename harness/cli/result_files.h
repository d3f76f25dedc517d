// Results of runs, from the files and folders that the user names.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/results/run_result.h>

namespace evalcts::cli {

// The results that the user named cannot be read; the message says what to do.
struct CannotReadResults : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The results in the files, and in the folders; shards are put together. `with_origin`: each remembers where
// it was read from. Throws CannotReadResults, and FormatError if shards do not belong together.
std::vector<RunResult> read_results(const std::vector<std::string>& arguments, bool with_origin);

}  // namespace evalcts::cli
