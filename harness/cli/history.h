// Reads the history of the runs in output folders.
#pragma once

#include <evalcts/history.h>

#include <filesystem>
#include <string>
#include <vector>

namespace evalcts::cli {

struct History {
  std::vector<reports::PastRun> runs;
  std::filesystem::path last;         // the folder of the run that began last
  std::vector<std::string> left_out;  // folders and files that are no runs, with the reason
};

// Returns the history of the runs that are in the folders or are the folders. Throws CannotReadResults if a
// folder has none.
History read_history(const std::vector<std::string>& folders);

}  // namespace evalcts::cli
