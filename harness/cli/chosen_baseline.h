// The value of --baseline as commands read it.
#pragma once

#include <filesystem>
#include <string>

#include <evalcts/results/baseline.h>

namespace evalcts::cli {

// The folder that a value of --baseline names, and the files in it; an empty name stands for those that fit.
struct ChosenFiles {
  std::filesystem::path folder;
  std::string name;
};

// Parses a value of --baseline: "DIR" or "DIR/NAME".
ChosenFiles chosen_files(const std::string& given);

// Returns the choice for a value of --baseline other than 'none'; empty: the known bugs only. If
// `must_exist`, throws BadBaseline if the folder does not exist.
BaselineChoice choice_of(const std::string& given, bool must_exist);

// Writes the renewed files of a baseline and returns a line that names the file and counts what changed:
// "Baseline: mine/library-fails.txt: 3 entries (2 new, 1 removed)". `before`: null if the files are new.
std::string write_baseline(const std::filesystem::path& folder, const BaselineFiles* before,
                           const BaselineFiles& after);

}  // namespace evalcts::cli
