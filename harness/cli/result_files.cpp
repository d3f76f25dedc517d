// Finds and reads result files, and merges the shards of a run.
#include "result_files.h"

#include <evalcts/reports.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include <evalcts/results/serialization.h>
#include <evalcts/results/text.h>

namespace evalcts::cli {
namespace {

namespace fs = std::filesystem;

bool is_result_name(const fs::path& path) {
  return path.filename().string().starts_with("results-") && path.extension() == ".json";
}

// Returns the result files that an argument names, sorted.
std::vector<fs::path> files_of(const fs::path& argument) {
  std::error_code error;
  const fs::file_status status = fs::status(argument, error);
  if (!fs::exists(status)) throw CannotReadResults(fmt::format("'{}' does not exist", argument.string()));
  if (!fs::is_directory(status)) return {argument};
  const std::vector<fs::path> files = result_files_in(argument, error);
  if (error)
    throw CannotReadResults(
        fmt::format("cannot read the folder '{}': {}", argument.string(), error.message()));
  if (files.empty())
    throw CannotReadResults(
        fmt::format("'{}' contains no results: 'evalcts run' writes results-NAME.json", argument.string()));
  return files;
}

RunResult read_result(const fs::path& file) {
  std::error_code unknown;
  if (!fs::is_regular_file(file, unknown))
    throw CannotReadResults(fmt::format("'{}' is not a file", file.string()));
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream)
    throw CannotReadResults(fmt::format("cannot read '{}': {}", file.string(), std::strerror(errno)));
  try {
    return parse_run_result(text);
  } catch (const FormatError& error) {
    throw CannotReadResults(fmt::format("'{}': {}; leave it out, or run again", file.string(), error.what()));
  }
}

// Returns the folder that the user named, which distinguishes results with the same name.
std::string origin_of(const fs::path& argument) {
  const fs::path path = argument.has_filename() ? argument : argument.parent_path();
  return is_result_name(path) && path.has_parent_path() ? path.parent_path().string() : path.string();
}

}  // namespace

std::vector<fs::path> result_files_in(const fs::path& folder, std::error_code& error) {
  std::vector<fs::path> files;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (is_result_name(entry->path())) files.push_back(entry->path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<RunResult> read_results(const std::vector<std::string>& arguments, bool with_origin) {
  std::vector<RunResult> results;
  std::set<fs::path> seen;
  for (const std::string& argument : arguments)
    for (const fs::path& file : files_of(argument)) {
      std::error_code unknown;
      if (!seen.insert(fs::weakly_canonical(file, unknown)).second) continue;
      RunResult result = read_result(file);
      result.origin = with_origin ? clean(origin_of(argument)) : std::string();
      results.push_back(std::move(result));
    }
  try {
    return reports::merge_shards(results);
  } catch (const FormatError& error) {
    throw CannotReadResults(error.what());
  }
}

}  // namespace evalcts::cli
