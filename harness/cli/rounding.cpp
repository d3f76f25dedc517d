#include <fmt/format.h>

#include <iostream>
#include <stdexcept>

#include "harness/cli/commands.h"
#include "harness/cli/terminal.h"
#include "harness/rounding/check.h"
#include "harness/runner/interruption.h"

namespace evalcts::cli {

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
    std::cerr << fmt::format("evalcts: {}\n", problem.what());
    return kWrongUse;
  }
  if (!any && !interrupted) {
    std::cerr << fmt::format(
        "evalcts: no class of maps matches '{}'; without --filter all of them are tried\n", options.filter);
    return kWrongUse;
  }
  line.print(fmt::format("seed {}: {} values, {} wrong{}\n", options.seed, total.samples, total.wrong,
                         interrupted ? " (interrupted)" : ""));
  return total.wrong != 0 ? kUnexpected : interrupted ? kWrongUse : kNothingUnexpected;
}

}  // namespace evalcts::cli
