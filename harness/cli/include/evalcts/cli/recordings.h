// Helpers of the commands about recordings. Implemented in record.cpp.
#pragma once

#include <filesystem>
#include <string>

#include <evalcts/record/recording.h>

namespace evalcts::cli {

// Returns true for commands of maps, grids and evaluations, and their queries.
bool is_of_evaluators(const record::Counted& command);

// Returns the path of the file, its size, frames, contexts, and most frequent commands, in a few lines.
std::string summary_of(const std::filesystem::path& file, const record::Recording& recording);

// Checks the value of --frames. Returns an error message; empty if there is none.
std::string check_frames(const std::string& text);

}  // namespace evalcts::cli
