// Implements read_history().
#include "history.h"

#include <fmt/format.h>

#include <evalcts/results/run_result.h>
#include "result_files.h"
#include "run_folders.h"

namespace evalcts::cli {
namespace {

namespace fs = std::filesystem;

// Returns the folders in a folder, with the folder itself as a run if it is one. Throws CannotReadResults.
RunFolders folders_of(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw CannotReadResults(
        fmt::format("'{}' {}", folder.string(),
                    fs::exists(folder) ? "is not a folder"
                                       : "does not exist: 'evalcts run' writes runs, each with a folder"));
  RunFolders folders = folders_in(folder);
  std::error_code error;
  if (!result_files_in(folder, error).empty()) folders.runs.insert(folders.runs.begin(), folder);
  if (folders.runs.empty())
    throw CannotReadResults(fmt::format(
        "'{}' has no runs: neither it nor a folder in it contains results-NAME.json", folder.string()));
  return folders;
}

}  // namespace

History read_history(const std::vector<std::string>& folders) {
  History history;
  std::string last;  // date of the run that began last
  for (const std::string& given : folders) {
    const RunFolders folders_given = folders_of(given);
    for (const fs::path& folder : folders_given.runs) try {
        for (const RunResult& result : read_results({folder.string()}, false)) {
          history.runs.push_back(reports::past_run(result, folder.filename().string()));
          if (history.last.empty() || last <= result.started) {
            history.last = folder;
            last = result.started;
          }
        }
      } catch (const CannotReadResults& problem) {
        history.left_out.push_back(problem.what());
      }
    for (const fs::path& other : folders_given.others)
      history.left_out.push_back(fmt::format("'{}' contains no results", other.string()));
  }
  if (history.runs.empty())
    throw CannotReadResults(fmt::format("no results could be read: {}", history.left_out.front()));
  return history;
}

}  // namespace evalcts::cli
