// `evalcts report`: writes pages from existing results, which may come from different runs and machines.
#include <evalcts/reports.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include <evalcts/cli/command.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/results/files.h>
#include "pages.h"
#include "result_files.h"

namespace evalcts::cli {
namespace {

struct ReportOptions {
  std::vector<std::string> results;  // files and folders; empty: the default folder
  std::vector<std::string> before;   // files and folders of earlier results; empty: nothing is compared
  std::string output;                // empty: the default folder
};

namespace fs = std::filesystem;

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
  } catch (const CannotReadResults& error) {
    return wrong_use(error.what());
  } catch (const FormatError& error) {
    return wrong_use(error.what());
  }
  const FolderLock lock = claim(output, "evalcts report");
  for (const RunResult& result : results)
    std::cout << reports::terminal_summary(result, catalogue(), shows_colour(), false, 0,
                                           screen_of(STDOUT_FILENO).columns)
              << "\n";
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
  app.add_option("results", options->results,
                 "result files, or folders that contain them (default: the last run); shards are joined");
  add_repeatable(app, "--before", options->before,
                 "earlier results to compare with, a file or a folder; may be repeated. Exit code 1 if a "
                 "result is worse than before");
  app.add_option("--output", options->output, "folder for index.html and summary.md");
  return [options] { return report(*options); };
}

}  // namespace

const Command kReportCommand = {
    "report", "write a page of one or more results side by side, and compare with earlier results",
    R"(  $ evalcts report results-osmesa.json)", define_report};

}  // namespace evalcts::cli
