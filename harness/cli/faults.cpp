#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <iostream>

#include "harness/cli/commands.h"
#include "harness/cli/terminal.h"
#include "harness/faults/fault_table.h"
#include "harness/results/coverage.h"
#include "harness/results/files.h"
#include "harness/runner/child_process.h"
#include "harness/runner/interruption.h"
#include "harness/runner/question.h"

namespace evalcts::cli {

namespace fs = std::filesystem;

std::vector<faults::ListedFault> list_faults() {
  const fs::path program = places().faulty_suite_program;
  if (!fs::exists(program))
    throw CannotStart(fmt::format(
        "'{}' is missing. In a checkout ./evalcts faults builds it; what is installed has no faults",
        program.string()));
  const fs::path file = fs::temp_directory_path() / fmt::format("evalcts-faults-{}.json", getpid());
  ChildProcess child({program.string(), "--list-faults", file.string()}, "");
  const std::optional<Ending> ending = child.wait(60);
  std::optional<std::vector<faults::ListedFault>> faults = faults::parse_faults(read_file(file));
  fs::remove(file);
  if (!faults)
    throw std::runtime_error(fmt::format("'{}' does not say which faults there are ({})", program.string(),
                                         ending ? describe(*ending) : "it takes too long"));
  return *std::move(faults);
}

int faults(const FaultsOptions& options) {
  using faults::FaultOutcome;
  const fs::path output = options.output.empty() ? places().output : fs::path(options.output);
  const FolderLock lock = claim(output, "evalcts faults");

  std::vector<faults::ListedFault> chosen = matching(list_faults(), options.filter);
  if (chosen.empty()) {
    std::cerr << fmt::format("evalcts: no fault matches '{}'; see 'evalcts list faults'\n", options.filter);
    return kWrongUse;
  }
  const bool all = options.filter.empty() && options.shard.empty();
  if (!options.shard.empty()) chosen = Shard::parse(options.shard, "/")->part_of(chosen);

  const std::vector<ListedTest> tests = list_tests(places().suite_program);
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
                          .seconds_per_test = options.seconds_per_test,
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
    std::cerr << "evalcts: interrupted; what was obtained is in the output folder\n";
    return kWrongUse;
  }
  return counts[FaultOutcome::kSurvives] > 0 || (options.complete && !without.empty()) ? kUnexpected
                                                                                       : kNothingUnexpected;
}

}  // namespace evalcts::cli
