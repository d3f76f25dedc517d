// `evalcts report`: writes pages from existing results, which may come from different runs and machines.
#include <evalcts/reports.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include <evalcts/cli/command.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/results/files.h>
#include <evalcts/results/text.h>
#include "history.h"
#include "pages.h"
#include "result_files.h"
#include "run_folders.h"

namespace evalcts::cli {
namespace {

struct ReportOptions {
  std::vector<std::string> results;  // files and folders; empty: the run
  std::string run;                   // value of --run
  std::vector<std::string> before;   // files and folders of earlier results; empty: nothing is compared
  std::string output;                // empty: the folder of the run, or the default folder with `results`
  bool history = false;
};

namespace fs = std::filesystem;

struct Shown {
  std::vector<RunResult> results, before;
  std::vector<reports::PastRun> history;
  fs::path output;
};

// Returns what the page shows. Throws CannotReadResults.
Shown shown_of(const ReportOptions& options) {
  Shown shown;
  const fs::path usual = places().output;
  if (options.history) {
    const History history =
        read_history(options.results.empty() ? std::vector{usual.string()} : options.results);
    for (const std::string& note : history.left_out)
      std::cerr << "evalcts: left out: " << clean(note) << "\n";
    shown.history = history.runs;
    shown.output = options.results.empty() ? run_folder(options.run) : history.last;
    shown.results = read_results({shown.output.string()}, false);
  } else if (options.results.empty()) {
    shown.output = run_folder(options.run);
    shown.results = read_results({shown.output.string()}, false);
  } else {
    shown.output = usual;
    shown.results = read_results(options.results, true);
  }
  shown.before = read_results(options.before, true);
  if (!options.output.empty()) shown.output = options.output;
  return shown;
}

int report(const ReportOptions& options) {
  const std::size_t columns = screen_of(STDOUT_FILENO).columns;
  const Shown shown = shown_of(options);
  reports::Changes changes;
  if (!shown.before.empty()) changes = reports::changes(shown.results, shown.before, columns);
  const FolderLock lock = claim(shown.output, "evalcts report");
  for (const RunResult& result : shown.results)
    std::cout << reports::terminal_summary(result, catalogue(), shows_colour(), false, 0, columns) << "\n";
  if (!shown.before.empty()) std::cout << changes.text << "\n";
  if (options.history) std::cout << reports::history_text(shown.history, columns) << "\n";
  try {
    write_pages(shown.output, shown.results, shown.before, shown.history);
    write_atomically(shown.output / "requirements.md",
                     reports::requirements_table(shown.results, catalogue()));
  } catch (const std::runtime_error& failure) {
    return wrong_use(failure.what() + std::string("; choose another folder with --output"));
  }
  std::cout << fmt::format("Report: {}\n", (shown.output / "index.html").string());
  return changes.regressions ? kUnexpected : kNothingUnexpected;
}

std::function<int()> define_report(CLI::App& app, const Call&) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::Option* const results =
      app.add_option("results", options->results,
                     "result files, or folders that contain them (default: the last run); shards are joined");
  add_run(app, options->run)->excludes(results);
  add_repeatable(app, "--before", options->before,
                 "earlier results to compare with, a file or a folder; may be repeated. Exit code 1 if a "
                 "result is worse than before");
  app.add_flag("--history", options->history,
               "add the history of bugs and verdicts, by date and by version, from all runs in the folder of "
               "results, or in the folders that are given");
  app.add_option("--output", options->output,
                 "folder for index.html and summary.md (default: that of the run, or with results the one "
                 "above the runs)");
  return [options] { return report(*options); };
}

}  // namespace

const Command kReportCommand = {
    "report", "write a page of one or more results side by side, and compare with earlier results",
    R"(  $ evalcts report results-osmesa.json
  $ evalcts report --history)",
    define_report};

}  // namespace evalcts::cli
