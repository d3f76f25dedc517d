#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <set>

#include <evalcts/backends/implementation.h>
#include <evalcts/fuzz/campaign.h>
#include <evalcts/fuzz/events.h>
#include <evalcts/fuzz/hunt.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/interruption.h>
#include "command.h"
#include "places.h"
#include "terminal.h"

namespace evalcts::cli {
namespace {

struct FuzzOptions {
  std::string implementation, library, context;
  std::uint32_t seed = 1;
  std::optional<std::uint32_t> programs;
  double seconds = 0;  // 0: no limit
  int length = 120;    // commands of a program, about
  bool fresh_contexts = false;
  bool allow_unobserved = false;
  std::optional<int> jobs;
  std::string output;  // empty: the usual folder
};

namespace fs = std::filesystem;

// The causes of the findings that the suite replays in every run: those are known.
std::map<std::string, std::string> known_causes() {
  std::map<std::string, std::string> known;
  for (const fuzz::KnownFinding& finding : fuzz::known_findings())
    known[fuzz::cause_of(finding.program, finding.what)] = finding.name;
  return known;
}

int fuzz(const FuzzOptions& options) {
  if (options.implementation.empty() && options.library.empty() && options.context.empty())
    return wrong_use("fuzz needs --implementation, --library or --context");
  if (!options.implementation.empty() &&
      std::ranges::count(implementation_kinds(), options.implementation, &ImplementationKind::name) == 0)
    return wrong_use(fmt::format("there is no implementation '{}'; see 'evalcts list implementations'",
                                 options.implementation));
  const fs::path output = options.output.empty() ? places().output : fs::path(options.output);
  const FolderLock lock = claim(output, "evalcts fuzz");
  stop_when_asked();
  ProgressLine line;
  fuzz::HuntRequest request = {.suite_program = places().suite_program,
                               .implementation = {options.implementation, options.library, options.context},
                               .name = options.implementation.empty() ? "library" : options.implementation,
                               .seed = options.seed,
                               .programs = options.programs,
                               .seconds = options.seconds > 0 || options.programs ? options.seconds : 60,
                               .length = options.length,
                               .jobs = options.jobs.value_or(usual_jobs()),
                               .fresh_contexts = options.fresh_contexts,
                               .known = known_causes(),
                               .output = output};
  const fuzz::Hunt hunt = fuzz::hunt(request, [&](const fuzz::Hunt& now) {
    line.show("fuzz",
              fmt::format("{} programs, {} commands ({:.0f} a second), {} causes", now.programs, now.commands,
                          now.seconds > 0 ? static_cast<double>(now.commands) / now.seconds : 0.0,
                          now.causes.size()));
  });
  std::string text;
  std::size_t unexpected = 0;
  for (const fuzz::Cause& cause : hunt.causes) {
    const bool known = !cause.known_as.empty();
    unexpected += !known;
    text += fmt::format("{} ({} of {} programs, {} first): {}\n  {}\n  {}\n",
                        known ? "known as " + cause.known_as : "new", cause.times, hunt.programs,
                        cause.program, cause.cause, cause.finding.failure.message, cause.file);
  }
  text += fmt::format(
      "{}: seed {}: {} programs ({} judged, {} of them in full), {} commands in {:.1f} s; {} causes, {} of "
      "them new\n",
      request.name, request.seed, hunt.programs, hunt.judged, hunt.in_full, hunt.commands, hunt.seconds,
      hunt.causes.size(), unexpected);
  if (hunt.not_repeated)
    text +=
        fmt::format("{} programs differed in a shared context only, not behind the programs before them\n",
                    hunt.not_repeated);
  if (hunt.slow) text += fmt::format("{} took too long, but not once more by themselves\n", hunt.slow);
  line.print(clean(text));
  if (!hunt.cannot_start.empty())
    return wrong_use(fmt::format("{}: {}", request.name, clean(hunt.cannot_start)));
  if (interrupted) std::cerr << "evalcts: interrupted; what was found is in the output folder\n";
  if (unexpected > 0) return kUnexpected;
  if (!options.allow_unobserved &&
      warn_if_mostly_unobserved(request.name, hunt.judged, hunt.programs, "programs"))
    return kWrongUse;
  return interrupted ? kWrongUse : kNothingUnexpected;
}

std::function<int()> define_fuzz(CLI::App& app, const Call&) {
  const auto options = std::make_shared<FuzzOptions>();
  app.add_option("--implementation", options->implementation, "what to judge");
  app.add_option("--library", options->library, "shared library instead of the usual one");
  app.add_option("--context", options->context, "what makes the contexts, as for run");
  app.add_option("--seed", options->seed, "the same seed gives the same programs on every machine")
      ->check(number_from_zero);
  app.add_option("--programs", options->programs, "how many")->check(positive_number);
  app.add_option("--seconds", options->seconds, "for how long (default: 60, without --programs)")
      ->check(positive_number);
  app.add_option("--length", options->length, "commands of a program, about")->check(CLI::Range(1, 100000));
  app.add_flag("--fresh-contexts", options->fresh_contexts,
               "a context for each program; without, most share one where that is faster");
  app.add_option("--jobs", options->jobs, "processes side by side (default: one for each core)")
      ->check(CLI::Range(1, 256));
  app.add_option("--output", options->output, "folder for what is found");
  add_allow_unobserved(app, options->allow_unobserved);
  return [options] { return fuzz(*options); };
}

}  // namespace

const Command kFuzzCommand = {
    "fuzz", "random programs side by side with the executable specification; differences are made small",
    R"(  $ evalcts fuzz --implementation osmesa --seconds 60
  $ evalcts fuzz --library ./libOSMesa.so.8 --programs 1000 --seed 7)",
    define_fuzz};

}  // namespace evalcts::cli
