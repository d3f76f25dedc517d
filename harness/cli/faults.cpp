// `evalcts faults`: injects one fault at a time and shows which test detects it.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <evalcts/faults/fault_table.h>
#include <evalcts/results/coverage.h>
#include <evalcts/results/files.h>
#include <evalcts/results/filter.h>
#include <evalcts/runner/interruption.h>
#include <evalcts/runner/worker.h>
#include "command.h"
#include "places.h"
#include "terminal.h"

namespace evalcts::cli {
namespace {

// Time limits of a test. A fault may make a test hang, so its limit is short. A variation must not, so its
// limit is long, to avoid false alarms on a busy machine.
constexpr double kSecondsOfTest = 20, kSecondsOfLegalTest = 180;

struct FaultsOptions {
  std::string filter;  // empty: all
  std::string shard;   // "K/N"; empty: all
  bool complete = false;
  bool legal = false;
  std::optional<double> seconds_per_test;
  std::optional<int> jobs;
  std::string output;  // empty: the default folder
};

namespace fs = std::filesystem;

// Faults of different kinds that occur in real evaluators, and that tests of quick depth detect. `--legal`
// requires that they are detected behind each variation.
constexpr const char* kTypicalFaults =
    "OrderZeroTaken:OrdersExchangedInFloats:StrideInOneByte:SinglePointReadLate:ReversedDomainSorted:"
    "SymmetricDomainTakenForUnit:ReversedVSorted:WideNetsTransposed:ColorWaitsForEnd:"
    "CurveMeshAfterDisableOfItsMap";

// Carries out `--legal`: tries variations instead of faults.
int legal(const FaultsOptions& options, const fs::path& output) {
  std::vector<faults::ListedFault> chosen =
      matching(faults::list_faults(places().faulty_suite_program, "--list-variations"), options.filter);
  if (chosen.empty()) return wrong_use(fmt::format("no variation matches '{}'", options.filter));
  if (!options.shard.empty()) chosen = Shard::parse(options.shard, "/")->part_of(chosen);
  const FolderLock lock = claim(output, "evalcts faults");
  const fs::path scratch = output / "scratch-variations";
  fs::remove_all(scratch);
  fs::create_directory(scratch);
  stop_when_asked();
  ProgressLine line;
  const std::vector<faults::TriedVariation> tried = faults::try_variations(
      {.suite_program = places().faulty_suite_program,
       .faults = matching(faults::list_faults(places().faulty_suite_program), kTypicalFaults),
       .tests = list_tests(places().suite_program),
       .jobs = options.jobs.value_or(usual_jobs()),
       .seconds_per_test = options.seconds_per_test.value_or(kSecondsOfLegalTest),
       .scratch = scratch},
      chosen, [&](std::size_t done, const std::string& variation) {
        line.show("variations", fmt::format("{} of {}, {}", done, chosen.size(), variation));
      });
  fs::remove_all(scratch);
  write_atomically(output / "variations.md", faults::as_markdown(tried));

  std::string text;
  std::size_t good = 0, not_tried = 0;
  for (const faults::TriedVariation& each : tried) {
    const std::string& name = each.variation.name;
    if (!each.reason.empty()) {
      ++not_tried;
      text += fmt::format("not tried: {}: {}\n", name, each.reason);
      continue;
    }
    good += each.is_good();
    text += fmt::format("{}: {} pass ({} of them in part), {} not observable, {} false alarms\n", name,
                        each.passed, each.passed_in_part, each.unobserved, each.alarms.size());
    for (const faults::FalseAlarm& alarm : each.alarms)
      text +=
          fmt::format("  false alarm: {} {}: {}\n", text_of(alarm.verdict).word, alarm.test, alarm.message);
    for (const faults::DetectionBehind& detection : each.detections)
      if (detection.outcome == faults::DetectionBehind::Outcome::kSurvives)
        text += fmt::format("  survives: {}: it is visible, but no test detects it\n", detection.fault);
      else if (detection.outcome == faults::DetectionBehind::Outcome::kNotVisible)
        text += fmt::format("  not visible: {}: {}\n", detection.fault, detection.reason);
  }
  text += fmt::format(
      "{} variations: {} without a false alarm and with all visible faults detected, {} not "
      "tried\nTable: {}\n",
      tried.size(), good, not_tried, (output / "variations.md").string());
  line.print(text);
  if (interrupted || not_tried == tried.size()) return kWrongUse;
  return good + not_tried == tried.size() ? kNothingUnexpected : kUnexpected;
}

int faults(const FaultsOptions& options) {
  using faults::FaultOutcome;
  const fs::path output = options.output.empty() ? places().output : fs::path(options.output);
  if (options.legal) return legal(options, output);

  std::vector<faults::ListedFault> chosen =
      matching(faults::list_faults(places().faulty_suite_program), options.filter);
  if (chosen.empty()) {
    return wrong_use(fmt::format("no fault matches '{}'; see 'evalcts list faults'", options.filter));
  }
  const bool all = options.filter.empty() && options.shard.empty();
  if (!options.shard.empty()) chosen = Shard::parse(options.shard, "/")->part_of(chosen);

  const std::vector<ListedTest> tests = list_tests(places().suite_program);
  const FolderLock lock = claim(output, "evalcts faults");
  const fs::path scratch = output / "scratch-faults";
  fs::remove_all(scratch);
  fs::create_directory(scratch);
  stop_when_asked();
  ProgressLine line;
  std::vector<faults::TriedFault> results =
      faults::try_faults({.suite_program = places().faulty_suite_program,
                          .faults = chosen,
                          .tests = tests,
                          .jobs = options.jobs.value_or(usual_jobs()),
                          .seconds_per_test = options.seconds_per_test.value_or(kSecondsOfTest),
                          .scratch = scratch},
                         [&](std::size_t done, const std::string& fault) {
                           line.show("faults", fmt::format("{} of {}, {}", done, chosen.size(), fault));
                         });
  fs::remove_all(scratch);

  std::vector<std::string> decided;
  for (const Coverage& coverage : coverage_of(catalogue(), tests))
    if (coverage.state == Coverage::State::kDecided) decided.push_back(coverage.id);
  faults::FaultTable table = faults::make_table(std::move(results), decided);
  table.is_complete = !interrupted;
  write_atomically(output / "faults.json", faults::to_text(table));
  write_atomically(output / "faults.md", faults::as_markdown(table));

  std::map<FaultOutcome, std::size_t> counts;
  std::string text;
  for (const faults::TriedFault& tried : table.faults) {
    ++counts[tried.outcome];
    if (tried.outcome == FaultOutcome::kNotTried)
      text += fmt::format("not tried: {}: {}\n", tried.fault.name, tried.reason);
    if (tried.outcome != FaultOutcome::kSurvives) continue;
    for (const faults::Detection& each : tried.detections)
      if (!each.detected)
        text += fmt::format("survives: {} ({}): no test of {} detects it\n", tried.fault.name,
                            tried.fault.what, each.requirement);
  }
  std::vector<std::string> without;
  for (const faults::FaultTable::Row& row : table.requirements)
    if (row.faults.empty()) without.push_back(row.requirement);
  if (all && !without.empty()) text += fmt::format("without a fault: {}\n", fmt::join(without, " "));
  text += fmt::format("{} faults: {} detected, {} survive, {} not tried", table.faults.size(),
                      counts[FaultOutcome::kDetected], counts[FaultOutcome::kSurvives],
                      counts[FaultOutcome::kNotTried]);
  if (all)
    text += fmt::format("; {} of {} requirements that tests decide have one", decided.size() - without.size(),
                        decided.size());
  line.print(text + fmt::format("\nTable: {}\n", (output / "faults.md").string()));
  if (interrupted) {
    return wrong_use("interrupted; the results so far are in the output folder");
  }
  return counts[FaultOutcome::kSurvives] > 0 || (options.complete && !without.empty()) ? kUnexpected
                                                                                       : kNothingUnexpected;
}

std::function<int()> define_faults(CLI::App& app, const Call&) {
  const auto options = std::make_shared<FaultsOptions>();
  app.add_option("--filter", options->filter, "inject only the faults that match patterns, as for run");
  add_shard(app, options->shard, "K/N: run only every N-th fault, starting with the K-th");
  app.add_flag("--complete", options->complete,
               "exit code 1 also if no fault was injected for a requirement that tests decide")
      ->excludes("--filter")
      ->excludes("--shard");
  app.add_flag("--legal", options->legal,
               "run conforming variations instead of faults: no test may fail on one, and typical faults "
               "must still be detected behind it")
      ->excludes("--complete");
  app.add_option("--timeout", options->seconds_per_test, "time limit for each test, in seconds")
      ->check(positive_number);
  app.add_option("--jobs", options->jobs, "number of faults that run in parallel (default: one per core)")
      ->check(CLI::Range(1, 256));
  app.add_option("--output", options->output, "folder for faults.json and faults.md");
  return [options] { return faults(*options); };
}

}  // namespace

const Command kFaultsCommand = {"faults", "inject one fault at a time and show which test detects it",
                                R"(  $ evalcts faults
  $ evalcts faults --filter 'Grid*' --jobs 2
  $ evalcts faults --legal                        # conforming variations: no test may fail)",
                                define_faults};

}  // namespace evalcts::cli
