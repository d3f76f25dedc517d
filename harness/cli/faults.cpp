#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <fstream>
#include <iostream>

#include "harness/cli/catalogue.h"
#include "harness/cli/commands.h"
#include "harness/cli/terminal.h"
#include "harness/faults/fault_table.h"
#include "harness/runner/child_process.h"
#include "harness/runner/runner.h"

namespace evalcts::cli {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// The answer of the suite program with faults. Throws std::runtime_error.
json known_faults() {
  const fs::path program = places().faulty_suite_program;
  if (!fs::exists(program))
    throw CannotStart(fmt::format(
        "'{}' is missing. In a checkout ./evalcts faults builds it; what is installed has no faults",
        program.string()));
  const fs::path file = fs::temp_directory_path() / fmt::format("evalcts-faults-{}.json", getpid());
  ChildProcess child({program.string(), "--list-faults", file.string()}, "");
  const std::optional<Ending> ending = child.wait(60);
  std::ifstream stream(file);
  json answer = json::parse(stream, nullptr, false);
  fs::remove(file);
  if (!answer.is_object())
    throw std::runtime_error(fmt::format("'{}' does not say which faults there are ({})", program.string(),
                                         ending ? describe(*ending) : "it takes too long"));
  return answer;
}

}  // namespace

json list_faults() { return known_faults(); }

int faults(const FaultsOptions& options) {
  const fs::path output = options.output.empty() ? places().output : fs::path(options.output);
  const FolderLock lock = claim(output, "evalcts faults");

  json chosen = matching(json{{"tests", known_faults()["faults"]}}, options.filter);
  if (chosen.empty()) {
    std::cerr << fmt::format("evalcts: no fault matches '{}'; see 'evalcts list faults'\n", options.filter);
    return kWrongUse;
  }
  const bool all = options.filter.empty() && options.shard.empty();
  if (!options.shard.empty()) {
    const auto [number, count] = *shard_of(options.shard);
    json part = json::array();
    for (std::size_t i = number - 1; i < chosen.size(); i += count) part.push_back(chosen[i]);
    chosen = std::move(part);
  }

  const json tests = list_tests(places().suite_program);
  const fs::path scratch = output / "scratch-faults";
  fs::remove_all(scratch);
  fs::create_directory(scratch);
  stop_when_asked();
  ProgressLine line;
  const json results =
      faults::try_faults({.suite_program = places().faulty_suite_program,
                          .faults = chosen,
                          .tests = tests["tests"],
                          .jobs = options.jobs.value_or(usual_jobs()),
                          .seconds_per_test = options.seconds_per_test,
                          .scratch = scratch},
                         [&](std::size_t done, const std::string& fault) {
                           line.show("faults", fmt::format("{} of {}, {}", done, chosen.size(), fault));
                         });
  fs::remove_all(scratch);

  std::vector<std::string> decided;
  for (const Coverage& coverage : coverage_of(catalogue(), tests))
    if (coverage.state == "decided") decided.push_back(coverage.id);
  json table = {{"format", "evalcts-faults-1"},
                {"status", interrupted ? "interrupted" : "complete"},
                {"faults", results},
                {"requirements", faults::faults_by_requirement(results, decided)}};
  write_atomically(output / "faults.json", table.dump(1) + "\n");
  write_atomically(output / "faults.md", faults::as_markdown(table));

  std::size_t caught = 0, not_tried = 0;
  std::string text;
  for (const json& fault : results) {
    const std::string outcome = fault["outcome"], name = fault["name"];
    caught += outcome == "caught";
    not_tried += outcome == "not-tried";
    if (outcome == "not-tried")
      text += fmt::format("not tried: {}: {}\n", name, fault["reason"].get<std::string>());
    if (outcome != "survives") continue;
    for (const json& cell : fault["requirements"])
      if (!cell["caught"])
        text += fmt::format("survives: {} ({}): no test of {} betrays it\n", name,
                            fault["what"].get<std::string>(), cell["id"].get<std::string>());
  }
  std::vector<std::string> without;
  for (const json& row : table["requirements"])
    if (row["faults"].empty()) without.push_back(row["id"]);
  if (all && !without.empty()) text += fmt::format("without a fault: {}\n", fmt::join(without, " "));
  text += fmt::format("{} faults: {} caught, {} survive, {} not tried", results.size(), caught,
                      results.size() - caught - not_tried, not_tried);
  if (all)
    text += fmt::format("; {} of {} requirements that tests decide have one", decided.size() - without.size(),
                        decided.size());
  line.print(text + fmt::format("\nTable: {}\n", (output / "faults.md").string()));
  if (interrupted) {
    std::cerr << "evalcts: interrupted; what was obtained is in the output folder\n";
    return kWrongUse;
  }
  const bool survivor = caught + not_tried < results.size();
  return survivor || (options.complete && !without.empty()) ? kUnexpected : kNothingUnexpected;
}

}  // namespace evalcts::cli
