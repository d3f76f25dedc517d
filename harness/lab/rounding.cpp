// `evalcts rounding`: checks that `production` rounds correctly (harness/rounding).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <stdexcept>

#include <evalcts/cli/places.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/results/filter.h>
#include <evalcts/rounding/check.h>
#include <evalcts/runner/interruption.h>
#include "lab.h"

namespace evalcts::cli {
namespace {

struct RoundingOptions {
  std::uint64_t samples = 100'000, exact = 2'000;  // numbers of values of each class
  bool sweep = false;
  std::string filter;  // selects classes; empty: all
  std::vector<std::string> targets;
  std::uint32_t seed = 1;
  std::optional<int> jobs;
};

int rounding(const RoundingOptions& options) {
  stop_when_asked();
  ProgressLine line;
  rounding::Outcome total;
  std::string first_wrong;
  bool any = false;
  const auto report = [&](const std::string& name, const rounding::Outcome& outcome) {
    line.print(fmt::format("{:<34} {:>11} values {:>10} decided exactly {:>6} wrong\n", name, outcome.samples,
                           outcome.exact, outcome.wrong));
    if (outcome.wrong != 0) line.print("  " + outcome.first_wrong + "\n");
    total.samples += outcome.samples;
    total.exact += outcome.exact;
    total.wrong += outcome.wrong;
    any = true;
  };
  try {
    for (const rounding::Class& what : rounding::classes()) {
      const std::string name = what.name();
      if (interrupted || !is_chosen(name, options.filter)) continue;
      rounding::Request request = {.what = what,
                                   .samples = options.samples,
                                   .seed = options.seed,
                                   .jobs = options.jobs.value_or(usual_jobs()),
                                   .targets = options.targets};
      if (options.sweep) {
        if (what.vorder != 0) continue;
        report(name + ", all floats", rounding::sweep(request, interrupted, [&](double done) {
                 line.show(name, fmt::format("{:.0f} %", 100 * done));
               }));
        continue;
      }
      if (options.samples != 0) report(name, rounding::check(request, interrupted));
      request.oracle = rounding::Oracle::kExact;
      request.samples = options.exact;
      request.seed = options.seed + 1;
      if (options.exact != 0) report(name + ", exact", rounding::check(request, interrupted));
    }
  } catch (const std::invalid_argument& problem) {
    return wrong_use(problem.what());
  }
  if (!any && !interrupted) {
    return wrong_use(
        fmt::format("no class of maps matches '{}'; without --filter all of them are tried", options.filter));
  }
  line.print(fmt::format("seed {}: {} values, {} wrong{}\n", options.seed, total.samples, total.wrong,
                         interrupted ? " (interrupted)" : ""));
  return total.wrong != 0 ? kUnexpected : interrupted ? kWrongUse : kNothingUnexpected;
}

std::function<int()> define_rounding(CLI::App& app, const Call&) {
  const auto options = std::make_shared<RoundingOptions>();
  const CLI::Range counts(0.0, 1e15);  // needed because the parser reads -1 as 2^64 - 1
  app.add_option("--samples", options->samples,
                 "number of values per class of maps that are checked through the filter and, if it does not "
                 "decide, the exact route")
      ->check(counts);
  app.add_option("--exact", options->exact,
                 "number of values per class that are checked through the exact route alone")
      ->check(counts);
  app.add_flag("--sweep", options->sweep,
               "check every float from 0 to 1 instead, for one map of each class of curves");
  app.add_option("--filter", options->filter,
                 "check only the classes that match GoogleTest patterns, such as 'curve/4/*'");
  add_repeatable(app, "--target", options->targets,
                 "instruction set; may be repeated (default: all that this machine supports; with --sweep "
                 "the best one)");
  app.add_option("--seed", options->seed, "seed of maps and arguments");
  app.add_option("--jobs", options->jobs, "number of threads (default: one per core)")
      ->check(CLI::Range(1, 256));
  return [options] { return rounding(*options); };
}

}  // namespace

const Command kRoundingCommand = {kRounding.name, kRounding.description,
                                  R"(  $ evalcts rounding
  $ evalcts rounding --filter 'curve/4/*' --samples 1000000)",
                                  define_rounding};

}  // namespace evalcts::cli
