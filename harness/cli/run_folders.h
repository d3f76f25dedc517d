// The folders of runs: each run without --output has one in the default output folder, called LABEL-DATE, and
// the link `latest` leads to the last of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace evalcts::cli {

// Creates a folder for a run in the default output folder: "LABEL-2026-11-28-112722", with the time in UTC,
// and a number behind it if another run began in the same second. Throws CannotStart.
std::filesystem::path create_run_folder(const std::string& label);

// Makes `latest` lead to a folder of create_run_folder(). If the file system has no links, prints a message.
void set_latest(const std::filesystem::path& folder);

// Returns the folder that a value of --run names: a run in the default output folder, or any folder. Empty:
// the last run. Throws CannotReadResults, with the names of the runs.
std::filesystem::path run_folder(const std::string& run);

// The folders in a folder, in the order of their names, without `latest`.
struct RunFolders {
  std::vector<std::filesystem::path> runs;
  std::vector<std::filesystem::path> others;  // contain no results
};
RunFolders folders_in(const std::filesystem::path& folder);

// Adds --run, which chooses a run other than the last one.
CLI::Option* add_run(CLI::App& app, std::string& run);

}  // namespace evalcts::cli
