// Writes the pages of results into an output folder.
#pragma once

#include <evalcts/history.h>

#include <filesystem>
#include <vector>

#include <evalcts/results/run_result.h>

namespace evalcts::cli {

// Writes index.html and summary.md, which show `results` and compare them with the earlier results `before`,
// into an existing folder. The page has the runs of `history`. Throws CannotWrite, after which the old file
// is unchanged, or FormatError.
void write_pages(const std::filesystem::path& output, const std::vector<RunResult>& results,
                 const std::vector<RunResult>& before, const std::vector<reports::PastRun>& history = {});

}  // namespace evalcts::cli
