// Implements read_history().
#include "history.h"

#include <fmt/format.h>

#include <algorithm>

#include <evalcts/results/run_result.h>
#include "result_files.h"
#include "run_folders.h"

namespace evalcts::cli {
namespace {

namespace fs = std::filesystem;

// Returns the folders of runs: the folder itself, and those in it.
std::vector<fs::path> folders_of_runs(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw CannotReadResults(
        fmt::format("'{}' {}", folder.string(),
                    fs::exists(folder) ? "is not a folder"
                                       : "does not exist: 'evalcts run' writes runs, each with a folder"));
  std::vector<fs::path> folders = runs_in(folder);
  std::error_code error;
  if (!result_files_in(folder, error).empty()) folders.insert(folders.begin(), folder);
  if (folders.empty())
    throw CannotReadResults(fmt::format(
        "'{}' has no runs: neither it nor a folder in it contains results-NAME.json", folder.string()));
  return folders;
}

// Returns the folders in a folder that are no runs.
std::vector<std::string> foreign_folders(const fs::path& folder) {
  std::vector<std::string> foreign;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    std::error_code unreadable;
    if (!entry->is_symlink() && entry->is_directory() && result_files_in(entry->path(), unreadable).empty())
      foreign.push_back(fmt::format("'{}' contains no results", entry->path().string()));
  }
  std::ranges::sort(foreign);
  return foreign;
}

}  // namespace

History read_history(const std::vector<std::string>& folders) {
  History history;
  std::string last;  // date of the run that began last
  for (const std::string& given : folders) {
    for (const fs::path& folder : folders_of_runs(given)) try {
        for (const RunResult& result : read_results({folder.string()}, false)) {
          history.runs.push_back(reports::past_run(result, folder.filename().string()));
          if (history.last.empty() || last <= result.started) {
            history.last = folder;
            last = result.started;
          }
        }
      } catch (const CannotReadResults& problem) {
        history.left_out.push_back(problem.what());
      } catch (const FormatError& problem) {
        history.left_out.push_back(fmt::format("'{}': {}", folder.string(), problem.what()));
      }
    for (const std::string& foreign : foreign_folders(given)) history.left_out.push_back(foreign);
  }
  if (history.runs.empty())
    throw CannotReadResults(fmt::format("no results could be read: {}", history.left_out.front()));
  return history;
}

}  // namespace evalcts::cli
