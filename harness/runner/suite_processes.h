// Starts the processes of the suite program that describe an implementation and run its tests. Their options
// and time limits adapt to how earlier processes ended.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <evalcts/runner/runner.h>

namespace evalcts {

class SuiteProcesses {
 public:
  // `log`: the file for the output of all processes. `request` must outlive the object.
  SuiteProcesses(const RunRequest& request, std::filesystem::path log);

  // Makes tests observe vertices by these captures: captures_option(). Must be called before the first test.
  void set_captures(std::vector<std::string> option) { captures_ = std::move(option); }

  // Runs the tests in parallel processes, each of which takes the next free test; in the second pass, in one
  // process. A process that ends or has grown is replaced. `each` and `ended`: see Pool.
  void run_in_parallel(const std::vector<std::string>& tests, const EachEvent& each,
                       const std::function<void(const WorkerRun&)>& ended);
  // Runs each test alone in a process of its own, in fresh contexts, all at the same time.
  std::vector<WorkerRun> run_alone(const std::vector<std::string>& tests, bool traces_cases) const;
  // Runs the jobs one after the other in one process, until `deadline`: in fresh contexts with all of the
  // time limit, or with the options and the patience of processes that run tests in parallel.
  enum class Like { kAlone, kInParallel };
  WorkerRun run_in_turn(const std::vector<Job>& jobs, Like like, const Deadline& deadline = {}) const;

  // Returns the calls that tests omit if they are optional, because several tests crashed in them.
  const std::vector<std::string>& omitted_calls() const { return omitted_calls_; }
  // Returns the seconds after which a test that runs in parallel from now on counts as hung.
  double patience() const { return patience_; }
  // True if the test in which the process died runs again without a verdict: because new processes omit the
  // call, but this one did not, or because a worker elsewhere was lost in it for the first time.
  bool runs_again(const WorkerRun& run);

 private:
  std::vector<std::string> command_for_tests() const;
  // True if tests run in a warm context first. Those of run_alone() use fresh contexts only.
  bool uses_warm_context() const;
  void learn_from(const WorkerRun& run);

  const RunRequest& request_;
  const std::filesystem::path log_;
  std::vector<std::string> captures_;      // the option
  bool dies_with_second_context_ = false;  // set if a process died before its first test
  double patience_;
  std::map<std::string, std::set<std::string>> tests_that_crash_in_;  // by call
  std::vector<std::string> omitted_calls_;
  std::set<std::string> lost_;  // tests in which a worker elsewhere was lost
};

}  // namespace evalcts
