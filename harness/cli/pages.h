// The pages of results that lie in an output folder.
#pragma once

#include <filesystem>
#include <vector>

#include <evalcts/results/run_result.h>

namespace evalcts::cli {

// Writes index.html and summary.md of these results, compared with the earlier ones, into an existing folder,
// each whole or not at all. Throws CannotWrite or FormatError.
void write_pages(const std::filesystem::path& output, const std::vector<RunResult>& results,
                 const std::vector<RunResult>& before);

}  // namespace evalcts::cli
