// `evalcts bugs`: prints the distinct bugs of a run, each with its minimal program.
#include <evalcts/reports.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include <evalcts/cli/command.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/results/known_bugs.h>
#include <evalcts/results/requirements.h>
#include "issue.h"
#include "result_files.h"
#include "run_folders.h"

namespace evalcts::cli {
namespace {

struct BugsOptions {
  std::vector<std::string> results;  // files and folders; empty: the run
  std::string run;                   // value of --run
  bool verbose = false;
  bool known = false;
  std::string issue;  // ID of the bug for which an issue is written; empty: none
};

// Returns the text of docs/known-bugs.md.
std::string known_bugs_page() {
  std::vector<std::string> programs;
  for (const KnownBug& bug : known_bugs())
    programs.push_back(fmt::format("{}", fmt::join(program_of(bug), "\n")));
  return known_bugs_as_markdown(known_bugs(), programs);
}

// Prints an issue for a bug of the results, or of the register if they do not have it.
int print_issue(const std::string& id, const std::vector<RunResult>& results) {
  const KnownBug* known = find_known_bug(id);
  const RunResult* run = nullptr;
  const Bug* found = nullptr;
  for (const RunResult& result : results)
    for (const Bug& bug : result.bugs)
      if (!found && (bug.id == id || (known && bug.known == id))) {
        run = &result;
        found = &bug;
      }
  if (found && !known) known = find_known_bug(found->known);
  if (!found && !known)
    return wrong_use(
        fmt::format("no bug is called '{}'; 'evalcts bugs' lists those of the last run, and 'evalcts list "
                    "bugs' the known ones",
                    id));
  std::vector<std::string> calls = known ? program_of(*known) : std::vector<std::string>();
  if (calls.empty() && found && found->is_reduced()) calls = found->failure.calls;
  std::cout << issue_text(run, found, known, calls);
  return kNothingUnexpected;
}

int bugs(const BugsOptions& options) {
  if (options.known) {
    std::cout << known_bugs_page();
    return kNothingUnexpected;
  }
  const auto results_of_run = [&] {
    return read_results(
        options.results.empty() ? std::vector{run_folder(options.run).string()} : options.results, false);
  };
  if (!options.issue.empty()) {
    std::vector<RunResult> results;
    try {
      results = results_of_run();
    } catch (const CannotReadResults&) {
      if (!find_known_bug(options.issue)) throw;  // a known bug needs no run
    }
    return print_issue(options.issue, results);
  }
  for (const RunResult& result : results_of_run())
    std::cout << reports::bug_list(result, catalogue(), shows_colour(), options.verbose) << "\n";
  return kNothingUnexpected;
}

std::function<int()> define_bugs(CLI::App& app, const Call&) {
  const auto options = std::make_shared<BugsOptions>();
  CLI::Option* const results = app.add_option(
      "results", options->results, "result files, or folders that contain them (default: the last run)");
  add_run(app, options->run)->excludes(results);
  app.add_flag("--verbose", options->verbose, "list every test that a bug explains");
  app.add_flag("--known", options->known,
               "print the known bugs of all implementations as Markdown, instead of the bugs of a run");
  app.add_option(
      "--issue", options->issue,
      "print an issue in Markdown for this bug of the results or of the register, ready for a bug tracker");
  return [options] { return bugs(*options); };
}

}  // namespace

const Command kBugsCommand = {
    "bugs", "list the distinct bugs behind the failing tests of a run, most important first",
    R"(  $ evalcts bugs
  $ evalcts bugs results-osmesa.json --verbose
  $ evalcts bugs --issue mesa-point-end)",
    define_bugs};

}  // namespace evalcts::cli
