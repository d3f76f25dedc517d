// Reads the results of runs from the files and folders that the user names.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <evalcts/results/run_result.h>

namespace evalcts::cli {

// Thrown if the named results cannot be read. The message states the file, the reason and what to do.
struct CannotReadResults : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Returns the files results-*.json of a folder, sorted. Sets `error` if the folder cannot be read.
std::vector<std::filesystem::path> result_files_in(const std::filesystem::path& folder,
                                                   std::error_code& error);

// Returns the results in the files and folders, each file once. Shards of a run are merged. If `with_origin`,
// sets RunResult::origin. Throws CannotReadResults, also if shards do not belong together.
std::vector<RunResult> read_results(const std::vector<std::string>& arguments, bool with_origin);

}  // namespace evalcts::cli
