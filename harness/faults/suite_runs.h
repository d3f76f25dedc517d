// Runs the suite program with faults or variations.
#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/faults/fault_table.h>
#include <evalcts/runner/interruption.h>
#include <evalcts/runner/worker.h>

namespace evalcts::faults {

// Returns the arguments that make the suite program open the implementation of the fault.
std::vector<std::string> arguments_of(const ListedFault& fault);

// Runs the tests in this order in one child process with these arguments. The run ends early if a test kills
// the process. The names of files in the scratch folder begin with `label`.
WorkerRun run_in_child(const TableRequest& request, const std::string& label,
                       const std::vector<std::string>& arguments, Depth depth,
                       const std::vector<std::string>& tests);

// Calls try_one() for each of the faults on `jobs` threads, and before each call progress() with the number
// of completed calls and the name of the fault. Returns the results in the order of the faults, without those
// that are missing because of an interruption. After an exception of try_one() no further fault is tried, and
// the exception is thrown again.
template <class Result>
std::vector<Result> try_each(const std::vector<ListedFault>& faults, int jobs,
                             const std::function<void(std::size_t done, const std::string& name)>& progress,
                             const std::function<std::optional<Result>(const ListedFault&)>& try_one) {
  std::vector<std::optional<Result>> results(faults.size());
  std::atomic<std::size_t> next = 0, done = 0;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < faults.size() && !interrupted;) {
      progress(done, faults[i].name);
      try {
        results[i] = try_one(faults[i]);
      } catch (...) {
        next = faults.size();
        throw;
      }
      ++done;
    }
  };
  std::vector<std::future<void>> workers;
  for (int i = 0; i < jobs; ++i) workers.push_back(std::async(std::launch::async, work));
  for (std::future<void>& worker : workers) worker.get();
  std::vector<Result> all;
  for (std::optional<Result>& result : results)
    if (result) all.push_back(*std::move(result));
  return all;
}

}  // namespace evalcts::faults
