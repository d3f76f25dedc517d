// evalcts report: pages from results that are there, of this run or another, of this machine or others.
#include <evalcts/reports.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <set>

#include <evalcts/results/files.h>
#include <evalcts/results/serialization.h>
#include <evalcts/results/text.h>
#include "command.h"
#include "pages.h"
#include "places.h"
#include "terminal.h"

namespace evalcts::cli {
namespace {

struct ReportOptions {
  std::vector<std::string> results;  // files and folders; empty: the usual folder
  std::vector<std::string> before;   // of the earlier results; empty: nothing is compared
  std::string output;                // empty: the usual folder
};

namespace fs = std::filesystem;

// What is wrong with what the user named; the message says what to do.
struct CannotReport : std::runtime_error {
  using std::runtime_error::runtime_error;
};

bool is_result_name(const fs::path& path) {
  return path.filename().string().starts_with("results-") && path.extension() == ".json";
}

// The result files that an argument names, sorted.
std::vector<fs::path> files_of(const fs::path& argument) {
  std::error_code error;
  const fs::file_status status = fs::status(argument, error);
  if (!fs::exists(status)) throw CannotReport(fmt::format("there is no '{}'", argument.string()));
  if (!fs::is_directory(status)) return {argument};
  std::vector<fs::path> files;
  fs::directory_iterator entry(argument, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (is_result_name(entry->path())) files.push_back(entry->path());
  if (error)
    throw CannotReport(fmt::format("cannot read the folder '{}': {}", argument.string(), error.message()));
  if (files.empty())
    throw CannotReport(fmt::format("there are no results in '{}': 'evalcts run' writes results-NAME.json",
                                   argument.string()));
  std::sort(files.begin(), files.end());
  return files;
}

RunResult read_result(const fs::path& file) {
  std::error_code unknown;
  if (!fs::is_regular_file(file, unknown)) throw CannotReport(fmt::format("'{}' is no file", file.string()));
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw CannotReport(fmt::format("cannot read '{}': {}", file.string(), std::strerror(errno)));
  try {
    return parse_run_result(text);
  } catch (const FormatError& error) {
    throw CannotReport(fmt::format("'{}': {}; leave it out, or run again", file.string(), error.what()));
  }
}

// What tells results of one name apart: the folder that the user named.
std::string origin_of(const fs::path& argument) {
  const fs::path path = argument.has_filename() ? argument : argument.parent_path();
  return is_result_name(path) && path.has_parent_path() ? path.parent_path().string() : path.string();
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
  return reports::merge_shards(results);
}

int report(const ReportOptions& options) {
  const fs::path usual = places().output;
  const fs::path output = options.output.empty() ? usual : fs::path(options.output);
  std::vector<RunResult> results, before;
  reports::Changes changes;
  try {
    results =
        options.results.empty() ? read_results({usual.string()}, false) : read_results(options.results, true);
    before = read_results(options.before, true);
    if (!before.empty()) changes = reports::changes(results, before);
  } catch (const CannotReport& error) {
    return wrong_use(error.what());
  } catch (const FormatError& error) {
    return wrong_use(error.what());
  }
  const FolderLock lock = claim(output, "evalcts report");
  for (const RunResult& result : results)
    std::cout << reports::terminal_summary(result, catalogue(), shows_colour(), false) << "\n";
  if (!before.empty()) std::cout << changes.text << "\n";
  try {
    write_pages(output, results, before);
    write_atomically(output / "requirements.md", reports::requirements_table(results, catalogue()));
  } catch (const std::runtime_error& failure) {
    return wrong_use(failure.what() + std::string("; choose another folder with --output"));
  }
  std::cout << fmt::format("Report: {}\n", (output / "index.html").string());
  return changes.regressions ? kUnexpected : kNothingUnexpected;
}

std::function<int()> define_report(CLI::App& app, const Call&) {
  const auto options = std::make_shared<ReportOptions>();
  app.add_option(
      "results", options->results,
      "result files, and folders with results (default: those of the last run); shards are put together");
  add_repeatable(app, "--before", options->before,
                 "earlier results to compare with, a file or folder; may be repeated. Exit code 1 where "
                 "something has become worse");
  app.add_option("--output", options->output, "folder for index.html and summary.md");
  return [options] { return report(*options); };
}

}  // namespace

const Command kReportCommand = {
    "report", "pages from one or more results, side by side, and compared with earlier ones",
    R"(  $ evalcts report results-osmesa.json)", define_report};

}  // namespace evalcts::cli
