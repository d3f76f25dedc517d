// `evalcts fuzz`: compares implementations with the executable specification on random programs.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include <evalcts/backends/implementation.h>
#include <evalcts/cli/command.h>
#include <evalcts/cli/default_implementations.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/fuzz/search.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/interruption.h>

namespace evalcts::cli {
namespace {

struct FuzzOptions {
  ImplementationOptions implementation;
  std::uint32_t seed = 1;
  std::optional<std::uint32_t> programs;
  double seconds = 0;  // 0: no limit
  int length = 120;    // approximate number of commands of a program
  bool fresh_contexts = false;
  bool allow_unobserved = false;
  std::optional<int> jobs;
  std::string output;  // empty: the default folder
};

namespace fs = std::filesystem;

int fuzz(const FuzzOptions& options) {
  const ImplementationOptions implementation = completed(options.implementation);
  if (implementation.name.empty() && implementation.library.empty() && implementation.context.empty())
    return wrong_use("fuzz needs --implementation, --library, --context or --mesa-build");
  if (!implementation.name.empty() &&
      std::ranges::count(implementation_kinds(), implementation.name, &ImplementationKind::name) == 0)
    return wrong_use(
        fmt::format("unknown implementation '{}'; see 'evalcts list implementations'", implementation.name));
  require_own_sources(implementation);
  const fs::path output = options.output.empty() ? places().output : fs::path(options.output);
  const FolderLock lock = claim(output, "evalcts fuzz");
  stop_when_asked();
  ProgressLine line;
  fuzz::SearchRequest request = {.suite_program = places().suite_program,
                                 .implementation = implementation,
                                 .name = implementation.label(),
                                 .seed = options.seed,
                                 .programs = options.programs,
                                 .seconds = options.seconds > 0 || options.programs ? options.seconds : 60,
                                 .length = options.length,
                                 .jobs = options.jobs.value_or(usual_jobs()),
                                 .fresh_contexts = options.fresh_contexts,
                                 .output = output};
  const fuzz::SearchResult found = fuzz::search(request, [&](const fuzz::SearchResult& now) {
    line.show("fuzz",
              fmt::format("{} programs, {} commands ({:.0f} a second), {} causes", now.programs, now.commands,
                          now.seconds > 0 ? static_cast<double>(now.commands) / now.seconds : 0.0,
                          now.causes.size()));
  });
  std::string text;
  std::size_t unexpected = 0;
  for (const fuzz::Cause& cause : found.causes) {
    const bool known = !cause.known_as.empty();
    unexpected += !known;
    text += fmt::format("{} ({} of {} programs, {} first): {}\n  {}\n  {}\n",
                        known ? "known as " + cause.known_as : "new", cause.times, found.programs,
                        cause.program, cause.finding.title, cause.finding.failure.message, cause.file);
  }
  text += fmt::format(
      "{}: seed {}: {} programs ({} judged, {} of them in full), {} commands in {:.1f} s; {} causes, {} of "
      "them new; {:.0f} % of the time for known causes\n",
      request.name, request.seed, found.programs, found.judged, found.in_full, found.commands, found.seconds,
      found.causes.size(), unexpected,
      found.seconds > 0 ? 100 * found.seconds_of_known / (found.seconds * request.jobs) : 0.0);
  if (found.not_repeated)
    text +=
        fmt::format("{} programs differed in a shared context only, not behind the programs before them\n",
                    found.not_repeated);
  if (found.slow)
    text += fmt::format("{} programs exceeded the time limit, but not when run again alone\n", found.slow);
  line.print(clean(text));
  if (!found.cannot_start.empty())
    return wrong_use(fmt::format("{}: {}", request.name, clean(found.cannot_start)));
  if (interrupted) std::cerr << "evalcts: interrupted; what was found is in the output folder\n";
  if (unexpected > 0) return kUnexpected;
  if (!options.allow_unobserved &&
      warn_if_mostly_unobserved(request.name, found.judged, found.programs, "programs"))
    return kWrongUse;
  return interrupted ? kWrongUse : kNothingUnexpected;
}

std::function<int()> define_fuzz(CLI::App& app, const Call&) {
  const auto options = std::make_shared<FuzzOptions>();
  add_implementation(app, options->implementation);
  app.add_option("--seed", options->seed,
                 "seed of the programs; a seed gives the same programs on every machine (default: 1)")
      ->check(number_from_zero);
  app.add_option("--programs", options->programs, "number of programs (default: no limit)")
      ->check(positive_number);
  app.add_option("--seconds", options->seconds,
                 "time limit, in seconds (default: 60, without a limit if --programs is given)")
      ->check(positive_number);
  app.add_option("--length", options->length, "approximate number of commands per program (default: 120)")
      ->check(CLI::Range(1, 100000));
  app.add_flag(
      "--fresh-contexts", options->fresh_contexts,
      "run each program in a context of its own; by default most programs share one if that is faster");
  app.add_option("--jobs", options->jobs, "number of parallel processes (default: one per core)")
      ->check(CLI::Range(1, 256));
  app.add_option("--output", options->output, "folder for the findings");
  add_allow_unobserved(app, options->allow_unobserved);
  return [options] { return fuzz(*options); };
}

}  // namespace

const Command kFuzzCommand = {
    "fuzz", "run random programs, compare them with the executable specification, and minimise differences",
    R"(  $ evalcts fuzz --implementation osmesa --seconds 60
  $ evalcts fuzz --library ./libOSMesa.so.8 --programs 1000 --seed 7)",
    define_fuzz};

}  // namespace evalcts::cli
