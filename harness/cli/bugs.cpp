// `evalcts bugs`: prints the distinct bugs of a run, each with its minimal program.
#include <evalcts/reports.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include <evalcts/cli/command.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/fuzz/bugs.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/results/known_bugs.h>
#include <evalcts/results/requirements.h>
#include "result_files.h"

namespace evalcts::cli {
namespace {

struct BugsOptions {
  std::vector<std::string> results;  // files and folders; empty: the default folder
  bool verbose = false;
  bool known = false;
};

// Returns the text of docs/known-bugs.md.
std::string known_bugs_page() {
  std::vector<std::string> programs;
  for (const KnownBug& bug : known_bugs())
    programs.push_back(
        bug.programs.empty()
            ? ""
            : fmt::format("{}", fmt::join(fuzz::readable_calls(gl::parse_case(bug.programs.front().commands)),
                                          "\n")));
  return known_bugs_as_markdown(known_bugs(), programs);
}

int bugs(const BugsOptions& options) {
  if (options.known) {
    std::cout << known_bugs_page();
    return kNothingUnexpected;
  }
  try {
    const std::vector<std::string> wanted =
        options.results.empty() ? std::vector{places().output.string()} : options.results;
    for (const RunResult& result : read_results(wanted, false))
      std::cout << reports::bug_list(result, catalogue(), shows_colour(), options.verbose) << "\n";
  } catch (const CannotReadResults& error) {
    std::cerr << "evalcts: " << error.what() << "\n";
    return kWrongUse;
  } catch (const FormatError& error) {
    std::cerr << "evalcts: " << error.what() << "\n";
    return kWrongUse;
  }
  return kNothingUnexpected;
}

std::function<int()> define_bugs(CLI::App& app, const Call&) {
  const auto options = std::make_shared<BugsOptions>();
  app.add_option("results", options->results,
                 "result files, or folders that contain them (default: the last run)");
  app.add_flag("--verbose", options->verbose, "list every test that a bug explains");
  app.add_flag("--known", options->known,
               "print the known bugs of all implementations as Markdown, instead of the bugs of a run");
  return [options] { return bugs(*options); };
}

}  // namespace

const Command kBugsCommand = {
    "bugs", "list the distinct bugs behind the failing tests of a run, most important first",
    R"(  $ evalcts bugs
  $ evalcts bugs results-osmesa.json --verbose)",
    define_bugs};

}  // namespace evalcts::cli
