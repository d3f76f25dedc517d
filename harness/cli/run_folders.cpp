// Creates and finds the folders of runs.
#include "run_folders.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <ctime>
#include <iostream>

#include <evalcts/backends/implementation.h>
#include <evalcts/cli/places.h>
#include <evalcts/results/text.h>
#include "result_files.h"

namespace evalcts::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLatest = "latest";
constexpr int kMostInASecond = 100;

// Returns the time in UTC: "2026-11-28-112722".
std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&time, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d-%H%M%S", &utc);
  return text.data();
}

// Returns an advice that names the last runs of the default output folder.
std::string advice() {
  std::vector<std::string> names;
  for (const fs::path& folder : folders_in(places().output).runs) names.push_back(folder.filename().string());
  return names.empty() ? "'evalcts run' first, or name the folder of a run with --run"
                       : fmt::format("--run NAME chooses one of these: {}", first_of(names));
}

}  // namespace

fs::path create_run_folder(const std::string& label) {
  const fs::path output = places().output;
  const std::string name = fmt::format("{}-{}", label, now());
  std::error_code error;
  fs::create_directories(output, error);
  // create_directory() returns true for one of the runs that begin in the same second.
  for (int number = 1; !error && number <= kMostInASecond; ++number) {
    const fs::path folder = output / (number == 1 ? name : fmt::format("{}-{}", name, number));
    if (fs::create_directory(folder, error)) return folder;
  }
  throw CannotStart(fmt::format("cannot create a folder in '{}'{}; choose a folder with --output",
                                output.string(), error ? ": " + error.message() : ""));
}

void set_latest(const fs::path& folder) {
  const fs::path link = folder.parent_path() / kLatest;
  const fs::path fresh = folder.parent_path() / fmt::format(".{}-{}", kLatest, getpid());
  std::error_code error, ignored;
  fs::remove(fresh, ignored);
  fs::create_directory_symlink(folder.filename(), fresh, error);
  if (!error) fs::rename(fresh, link, error);
  if (!error) return;
  fs::remove(fresh, ignored);
  std::cerr << fmt::format("evalcts: '{}' was not set ({}); name this run with --run {}\n", link.string(),
                           error.message(), folder.filename().string());
}

fs::path run_folder(const std::string& run) {
  const fs::path output = places().output;
  if (run.empty()) {
    const fs::path link = output / kLatest;
    if (fs::is_directory(link)) return fs::is_symlink(link) ? output / fs::read_symlink(link) : link;
    throw CannotReadResults(fmt::format(
        "there is no last run: '{}' {}; {}", link.string(),
        fs::is_symlink(link) ? "leads to a folder that does not exist" : "does not exist", advice()));
  }
  const bool is_name = run.find('/') == std::string::npos;
  if (is_name && fs::is_directory(output / run)) return output / run;
  if (fs::is_directory(run)) return run;
  throw CannotReadResults(
      fmt::format("--run '{}': not a run in '{}', and not a folder; {}", run, output.string(), advice()));
}

RunFolders folders_in(const fs::path& folder) {
  RunFolders folders;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    std::error_code unreadable;
    if (entry->is_symlink() || !entry->is_directory()) continue;
    const bool is_run = !result_files_in(entry->path(), unreadable).empty();
    (is_run ? folders.runs : folders.others).push_back(entry->path());
  }
  std::ranges::sort(folders.runs);
  std::ranges::sort(folders.others);
  return folders;
}

CLI::Option* add_run(CLI::App& app, std::string& run) {
  return app.add_option(
      "--run", run, "run to use: its name in the folder of results, or any folder (default: the last run)");
}

}  // namespace evalcts::cli
