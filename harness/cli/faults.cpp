// `evalcts faults`: injects one fault at a time and shows which test detects it.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <evalcts/cli/command.h>
#include <evalcts/cli/places.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/faults/trial.h>
#include <evalcts/results/coverage.h>
#include <evalcts/results/files.h>
#include <evalcts/results/filter.h>
#include <evalcts/runner/interruption.h>
#include <evalcts/runner/worker.h>

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

// Returns the text about a variation that was tried.
std::string text_of_variation(const faults::Tried& tried) {
  std::string text =
      fmt::format("{}: {} pass ({} of them in part), {} not observable, {} false alarms\n", tried.change.name,
                  tried.passed, tried.passed_in_part, tried.unobserved, tried.alarms.size());
  for (const faults::BadTest& alarm : tried.alarms)
    text += fmt::format("  false alarm: {} {}: {}\n", text_of(alarm.verdict).word, alarm.test, alarm.message);
  for (const faults::Detection& detection : tried.detections)
    if (detection.outcome == faults::Detection::Outcome::kSurvives)
      text += fmt::format("  survives: {}: it is visible, but no test detects it\n", detection.subject);
    else if (detection.outcome == faults::Detection::Outcome::kNotVisible)
      text += fmt::format("  not visible: {}: {}\n", detection.subject, detection.reason);
  return text;
}

// Returns the text about a fault; empty if it was detected.
std::string text_of_fault(const faults::Tried& tried) {
  std::string text;
  for (const faults::Detection& each : tried.detections)
    if (each.outcome == faults::Detection::Outcome::kNotVisible)
      text += fmt::format("not visible: {}: {}: {}\n", tried.change.name, each.subject, each.reason);
    else if (!each.is_detected())
      text += fmt::format("survives: {} ({}): no test of {} detects it\n", tried.change.name,
                          tried.change.what, each.subject);
  return text;
}

// Writes the table of the variations. Returns the text about it.
std::string write_variations(const fs::path& output, const std::vector<faults::Tried>& tried,
                             std::size_t good, std::size_t not_tried) {
  write_atomically(output / "variations.md", faults::as_markdown(tried));
  return fmt::format(
      "{} variations: {} without a false alarm and with all visible faults detected, {} not "
      "tried\nTable: {}\n",
      tried.size(), good, not_tried, (output / "variations.md").string());
}

// Writes the tables of the faults. Returns the text about them, and in `without` the requirements that tests
// decide and that no fault violates.
std::string write_faults(const fs::path& output, const std::vector<faults::Tried>& tried,
                         const std::vector<ListedTest>& tests, std::size_t good, std::size_t not_tried,
                         bool all, std::vector<std::string>& without) {
  std::vector<std::string> decided;
  for (const Coverage& coverage : coverage_of(catalogue(), tests))
    if (coverage.state == Coverage::State::kDecided) decided.push_back(coverage.id);
  faults::FaultTable table = faults::make_table(tried, decided);
  table.is_complete = !interrupted;
  write_atomically(output / "faults.json", faults::to_text(table));
  write_atomically(output / "faults.md", faults::as_markdown(table));
  for (const faults::FaultTable::Row& row : table.requirements)
    if (row.faults.empty()) without.push_back(row.requirement);
  std::string text;
  if (all && !without.empty()) text += fmt::format("without a fault: {}\n", fmt::join(without, " "));
  text += fmt::format("{} faults: {} detected, {} survive, {} not tried", tried.size(), good,
                      tried.size() - good - not_tried, not_tried);
  if (all)
    text += fmt::format("; {} of {} requirements that tests decide have one", decided.size() - without.size(),
                        decided.size());
  return text + fmt::format("\nTable: {}\n", (output / "faults.md").string());
}

int faults(const FaultsOptions& options) {
  const fs::path output = options.output.empty() ? places().output : fs::path(options.output);
  const fs::path& program = places().faulty_suite_program;
  std::vector<faults::ListedChange> chosen = matching(
      options.legal ? faults::list_variations(program) : faults::list_faults(program), options.filter);
  if (chosen.empty() && options.legal)
    return wrong_use(fmt::format("no variation matches '{}'", options.filter));
  if (chosen.empty())
    return wrong_use(fmt::format("no fault matches '{}'; see 'evalcts list faults'", options.filter));
  const bool all = options.filter.empty() && options.shard.empty();
  if (!options.shard.empty()) chosen = Shard::parse(options.shard, "/")->part_of(chosen);

  const std::vector<ListedTest> tests = list_tests(places().suite_program);
  const FolderLock lock = claim(output, "evalcts faults");
  const fs::path scratch = output / (options.legal ? "scratch-variations" : "scratch-faults");
  fs::remove_all(scratch);
  fs::create_directory(scratch);
  stop_when_asked();
  ProgressLine line;
  const std::vector<faults::Tried> tried = faults::try_all(
      {.suite_program = program,
       .changes = chosen,
       .behind = options.legal ? matching(faults::list_faults(program), kTypicalFaults)
                               : std::vector<faults::ListedChange>(),
       .tests = tests,
       .jobs = options.jobs.value_or(usual_jobs()),
       .seconds_per_test =
           options.seconds_per_test.value_or(options.legal ? kSecondsOfLegalTest : kSecondsOfTest),
       .scratch = scratch},
      [&](std::size_t done, const std::string& name) {
        line.show(options.legal ? "variations" : "faults",
                  fmt::format("{} of {}, {}", done, chosen.size(), name));
      });
  fs::remove_all(scratch);

  std::string text;
  std::size_t good = 0, not_tried = 0;
  for (const faults::Tried& each : tried) {
    good += each.is_good();
    not_tried += !each.not_tried.empty();
    text += !each.not_tried.empty() ? fmt::format("not tried: {}: {}\n", each.change.name, each.not_tried)
            : options.legal         ? text_of_variation(each)
                                    : text_of_fault(each);
  }
  std::vector<std::string> without;
  text += options.legal ? write_variations(output, tried, good, not_tried)
                        : write_faults(output, tried, tests, good, not_tried, all, without);
  line.print(text);
  if (interrupted) return wrong_use("interrupted; the results so far are in the output folder");
  if (options.legal && not_tried == tried.size()) return kWrongUse;
  return good + not_tried < tried.size() || (options.complete && !without.empty()) ? kUnexpected
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
