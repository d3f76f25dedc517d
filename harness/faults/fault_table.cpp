// Runs the tests of each violated requirement, first at quick and then at full depth, until one detects the
// fault. Only tests that pass without the fault are run.
#include <evalcts/faults/fault_table.h>

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <mutex>

#include <evalcts/backends/implementation.h>
#include <evalcts/results/files.h>
#include <evalcts/runner/child_process.h>
#include <evalcts/runner/interruption.h>
#include <evalcts/runner/worker.h>
#include "suite_runs.h"

namespace evalcts::faults {
namespace {

namespace fs = std::filesystem;

constexpr int kMostDeaths = 20;  // children that may die while the tests run without a fault

struct CannotTry {
  std::string reason;
};

class Trial {
 public:
  explicit Trial(const TableRequest& request) : request_(request) {
    for (const ListedTest& test : request.tests) by_name_[test.name] = &test;
  }

  TriedFault try_fault(const ListedFault& fault) {
    TriedFault result;
    result.fault = fault;
    try {
      for (const std::string& requirement : fault.requirements) {
        result.detections.push_back(detect(fault, requirement));
        if (!result.detections.back().detected) result.outcome = FaultOutcome::kSurvives;
      }
    } catch (const CannotTry& cannot) {
      result.outcome = FaultOutcome::kNotTried;
      result.reason = cannot.reason;
    }
    return result;
  }

 private:
  // Looks for a test that names the requirement and detects the fault.
  Detection detect(const ListedFault& fault, const std::string& requirement) {
    Detection detection;
    for (const Depth depth : {Depth::kQuick, Depth::kFull}) {
      const std::vector<std::string> tests =
          passing_tests(fault, depth, tests_of(requirement, depth, fault.level));
      if (interrupted) throw CannotTry{"interrupted"};
      if (!tests.empty()) detection = run_until_detected(fault, depth, tests);
      if (detection.detected) break;
    }
    detection.requirement = requirement;
    return detection;
  }

  std::vector<std::string> tests_of(const std::string& requirement, Depth depth, Level level) const {
    std::vector<std::string> names;
    for (const ListedTest& test : request_.tests)
      if (test.from <= depth && test.level >= level &&
          std::ranges::any_of(test.requirements,
                              [&](const RequirementId& named) { return named.decides(requirement); }))
        names.push_back(test.name);
    return names;
  }

  // Returns those of the tests that pass on the unmodified implementation.
  std::vector<std::string> passing_tests(const ListedFault& fault, Depth depth,
                                         const std::vector<std::string>& tests) {
    const std::string& implementation = fault.implementation;
    const std::lock_guard lock(mutex_);
    std::map<std::string, bool>& passes = passes_[{implementation, depth}];
    std::vector<std::string> missing;
    for (const std::string& test : tests)
      if (!passes.contains(test)) missing.push_back(test);
    for (int deaths = 0; !missing.empty() && deaths < kMostDeaths && !interrupted; ++deaths) {
      const WorkerRun run = play(fault, "unmodified-" + implementation, depth, missing);
      if (run.records.empty() && run.in_flight.empty())
        throw CannotTry{fmt::format("{} does not start: {}", implementation, describe(run.ending))};
      for (const auto& [name, record] : run.records) passes[name] = record.verdict == Verdict::kPass;
      if (!run.in_flight.empty()) passes[run.in_flight] = false;
      std::erase_if(missing, [&](const std::string& name) { return passes.contains(name); });
    }
    std::vector<std::string> passing;
    for (const std::string& test : tests)
      if (passes[test]) passing.push_back(test);
    return passing;
  }

  // Runs the tests with the fault until one detects it.
  Detection run_until_detected(const ListedFault& fault, Depth depth, const std::vector<std::string>& tests) {
    const WorkerRun run = play(fault, fault.name, depth, tests);
    if (interrupted) throw CannotTry{"interrupted"};  // the interruption has killed the child
    const auto detected = [&](const std::string& test, Verdict verdict, const std::string& message) {
      return Detection{"", true, test, by_name_.at(test)->level, depth, verdict, message};
    };
    for (const std::string& name : run.finished) {
      const TestRecord& record = run.records.at(name);
      if (record.verdict == Verdict::kFail ||
          (fault.level == Level::kQuality && record.verdict == Verdict::kQualityWarning))
        return detected(name, record.verdict, record.message);
    }
    if (!run.in_flight.empty())
      return detected(run.in_flight, run.hung ? Verdict::kTimeout : Verdict::kCrash, describe(run.ending));
    if (run.records.empty() && !interrupted)
      throw CannotTry{fmt::format("with this fault nothing can be judged ({})", describe(run.ending))};
    return {};
  }

  // Runs the tests in one child. If the label is the name of the fault, the child has the fault and stops at
  // the first failure.
  WorkerRun play(const ListedFault& fault, const std::string& label, Depth depth,
                 const std::vector<std::string>& tests) const {
    std::vector<std::string> arguments = arguments_of(fault);
    if (label == fault.name) arguments.insert(arguments.end(), {"--fault", label, "--gtest_fail_fast"});
    return run_in_child(request_, label, arguments, depth, tests);
  }

  const TableRequest& request_;
  std::map<std::string, const ListedTest*> by_name_;
  std::mutex mutex_;  // protects passes_; held while tests run, so that no test runs twice
  std::map<std::pair<std::string, Depth>, std::map<std::string, bool>> passes_;
};

}  // namespace

std::vector<TriedFault> try_faults(
    const TableRequest& request,
    const std::function<void(std::size_t done, const std::string& fault)>& progress) {
  Trial trial(request);
  return try_each<TriedFault>(request.faults, request.jobs, progress,
                              [&](const ListedFault& fault) { return trial.try_fault(fault); });
}

std::vector<ListedFault> list_faults(const fs::path& program, const std::string& question) {
  if (!fs::exists(program))
    throw CannotStart(fmt::format(
        "'{}' is missing. In a checkout ./evalcts faults builds it; what is installed has no faults",
        program.string()));
  const fs::path file = fs::temp_directory_path() / fmt::format("evalcts-faults-{}.json", getpid());
  ChildProcess child({program.string(), question, file.string()}, "");
  const std::optional<Ending> ending = child.wait(60);
  std::optional<std::vector<ListedFault>> faults = parse_faults(read_file(file));
  fs::remove(file);
  if (!faults)
    throw std::runtime_error(fmt::format("'{}' does not list its faults ({})", program.string(),
                                         ending ? describe(*ending) : "it takes too long"));
  return *std::move(faults);
}

}  // namespace evalcts::faults
