// Implements SuiteProcesses: the options of the suite program, and pools of workers with these options.
#include "suite_processes.h"

#include <algorithm>

#include "request.h"

namespace evalcts {
namespace {

constexpr std::uint64_t kMostBetweenTests = std::uint64_t{250} << 20;  // bytes of memory of a process
constexpr double kPatienceAfterHang = 5;           // seconds for a test once another one has hung
constexpr std::size_t kCrashesBeforeOmission = 3;  // tests that crash in a command

// A test that exceeds this time runs again alone with the whole limit. With the default limit, a hang and its
// confirmation take a minute.
double first_patience(double limit) { return std::min(limit, std::max(limit / 3, kPatienceAfterHang)); }

}  // namespace

SuiteProcesses::SuiteProcesses(const RunRequest& request, std::filesystem::path log)
    : request_(request), log_(std::move(log)), patience_(first_patience(request.limits.seconds_per_test)) {}

std::vector<std::string> SuiteProcesses::command_for_tests() const {
  std::vector<std::string> command = suite_command(request_);
  command.insert(command.end(), captures_.begin(), captures_.end());
  if (request_.is_second_pass()) command.push_back("--reuse-context");
  for (const std::string& call : omitted_calls_) command.insert(command.end(), {"--leave-out", call});
  return command;
}

bool SuiteProcesses::uses_warm_context() const {
  return !request_.is_second_pass() && !request_.only_fresh_contexts && !dies_with_second_context_;
}

void SuiteProcesses::run_in_parallel(const std::vector<std::string>& tests, const EachEvent& each,
                                     const std::function<void(const WorkerRun&)>& ended) {
  const Pool pool{
      .command =
          [this] {
            std::vector<std::string> command = command_for_tests();
            // A process that has grown is replaced between tests, because a library may lose
            // memory in each context, and a test of thorough depth may need more than half of the
            // limit.
            const std::uint64_t most = std::min(request_.limits.memory / 4, kMostBetweenTests);
            command.insert(command.end(), {"--most-growth", std::to_string(most >> 20)});
            if (uses_warm_context()) command.push_back("--warm");
            return command;
          },
      .log = log_,
      .limits = request_.limits,
      .patience = [this] { return patience_; },
      .workers = std::min<std::size_t>(request_.is_second_pass() ? 1 : request_.jobs, tests.size()),
      .each = each,
      .ended =
          [&](const WorkerRun& run) {
            learn_from(run);
            ended(run);
          }};
  std::size_t next = 0;
  pool.run([&]() -> std::optional<Job> {
    if (next == tests.size()) return std::nullopt;
    return Job{.kind = "test", .name = tests[next++]};
  });
}

void SuiteProcesses::learn_from(const WorkerRun& run) {
  // A library that cannot have two contexts may die when the warm context is made.
  if (!run.complete && !run.began_a_job()) dies_with_second_context_ = true;
  // Tests that hang often do so at one place, and each would take until the time limit.
  if (run.hung) patience_ = std::min(patience_, kPatienceAfterHang);
  if (!run.died_in_job() || !run.crash || run.crash->call.empty()) return;
  std::set<std::string>& tests = tests_that_crash_in_[run.crash->call];
  tests.insert(run.in_flight);
  if (tests.size() == kCrashesBeforeOmission && std::ranges::count(omitted_calls_, run.crash->call) == 0)
    omitted_calls_.push_back(run.crash->call);
}

bool SuiteProcesses::runs_again(const WorkerRun& run) {
  if (run.may_be_lost()) return lost_.insert(run.in_flight).second;
  return run.died_in_job() && run.crash && std::ranges::count(omitted_calls_, run.crash->call) > 0 &&
         std::ranges::count(run.command, run.crash->call) == 0;
}

std::vector<WorkerRun> SuiteProcesses::run_alone(const std::vector<std::string>& tests,
                                                 bool traces_cases) const {
  std::map<std::string, WorkerRun> runs;
  std::size_t next = 0;
  Pool{.command = [this] { return command_for_tests(); },
       .log = log_,
       .limits = request_.limits,
       .workers = tests.size(),
       .is_each_alone = true,
       .ended =
           [&](const WorkerRun& run) {
             if (run.died_in_job()) runs[run.in_flight] = run;
             if (!run.finished.empty()) runs[run.finished.front()] = run;
           }}
      .run([&]() -> std::optional<Job> {
        if (next == tests.size()) return std::nullopt;
        return Job{.kind = "test", .name = tests[next++], .traces_cases = traces_cases};
      });
  std::vector<WorkerRun> all;
  for (const std::string& test : tests) all.push_back(runs[test]);
  return all;
}

WorkerRun SuiteProcesses::run_in_turn(const std::vector<Job>& jobs, Like like,
                                      const Deadline& deadline) const {
  std::vector<std::string> command = command_for_tests();
  Limits limits = request_.limits;
  if (like == Like::kInParallel) {
    limits.seconds_per_test = patience_;
    if (uses_warm_context()) command.push_back("--warm");
  }
  Worker worker(command, log_, limits);
  for (const Job& job : jobs) worker.give(job);
  worker.finish();
  return worker.wait(deadline);
}

}  // namespace evalcts
