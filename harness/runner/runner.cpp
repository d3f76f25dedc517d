// Runs the tests of one implementation in workers, repeats unexpected failures alone, and makes the
// record of the run.
#include <evalcts/runner/runner.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <set>

#include <evalcts/runner/worker.h>
#include "death_confirmation.h"
#include "failure_repetition.h"
#include "history_search.h"
#include "request.h"
#include "run_records.h"
#include "suite_processes.h"

namespace evalcts {

namespace {

namespace fs = std::filesystem;

constexpr double kSecondsToStart = 60;  // for the description of the implementation, and each proof
constexpr int kMostFruitless = 2;       // rounds that may end without a result before the run gives up

class Run {
 public:
  Run(const RunRequest& request, const std::function<void(const Progress&)>& progress)
      : request_(request), progress_(progress), result_(header_of(request)) {}

  RunResult run() {
    remove_stale_files();
    progress_({"starting", 0, request_.tests.size(), ""});
    try {
      if (!start()) return finish(interrupted ? RunStatus::kInterrupted : RunStatus::kNotStarted);
      if (!run_tests()) return finish(RunStatus::kInterrupted);
      if (request_.is_second_pass())
        explain_by_history();
      else
        result_.confirmed_by_group =
            repeat_failures(request_, baseline_, processes_, records_, histories_, progress_);
    } catch (const CannotWrite& error) {
      result_.reason =
          error.what() + std::string("; free some space, or choose another folder with --output");
      return finish(RunStatus::kInterrupted);
    } catch (const CannotSpawn& error) {
      result_.reason = error.what();
      return finish(records_.size() == 0 ? RunStatus::kNotStarted : RunStatus::kInterrupted);
    }
    return finish(interrupted ? RunStatus::kInterrupted : RunStatus::kComplete);
  }

 private:
  fs::path file(const std::string& kind, const std::string& extension) const {
    return request_.output / fmt::format("{}-{}.{}", kind, result_.file_label(), extension);
  }

  void remove_stale_files() const {
    for (const auto& [kind, extension] :
         {std::pair{"results", "json"}, {"records", "jsonl"}, {"junit", "xml"}, {"log", "txt"}})
      fs::remove(file(kind, extension));
  }

  // Describes the implementation and proves its captures. Returns false, with the reason in the result, if it
  // does not start.
  bool start() {
    const std::optional<Description> description = ask<Description>(
        suite_command(request_), {"describe", "describe"}, result_.reason, log_, limits_of_start_);
    if (!description) return false;
    if (!request_.implementation.worker.empty()) {
      const std::vector<ListedTest> own =
          request_.recording.empty() ? list_tests(request_.suite_program) : request_.tests;
      result_.reason = why_other_suite(own, *description);
    }
    if (!result_.reason.empty()) return false;
    ImplementationRecord& implementation = result_.implementation;
    const ImplementationRecord header = implementation;
    implementation = description->implementation;
    // The suite program calls itself by its kind; the name of the result is the user's label.
    implementation.kind = implementation.name;
    implementation.name = header.name;
    implementation.machine = header.machine;
    baseline_ = Baseline(request_.baseline, implementation, result_.pass);
    implementation.captures = prove_captures(description->captures);
    processes_.set_captures(captures_option(implementation));
    if (interrupted) result_.reason = "interrupted";
    return !interrupted;
  }

  // Proves the captures in parallel.
  std::vector<CaptureRecord> prove_captures(const std::vector<std::string>& names) const {
    std::map<std::string, CaptureRecord> proofs;
    std::deque<std::string> waiting(names.begin(), names.end());
    std::set<std::string> lost;
    Pool{.command = [this] { return suite_command(request_); },
         .log = log_,
         .limits = limits_of_start_,
         .workers = std::min<std::size_t>(names.size(), request_.jobs),
         .each =
             [&](const Event& event) {
               if (const auto* proof = std::get_if<CaptureRecord>(&event)) proofs[proof->name] = *proof;
             },
         .ended =
             [&](const WorkerRun& run) {
               if (run.may_be_lost() && lost.insert(run.in_flight).second)
                 waiting.push_back(run.in_flight);
               else if (run.died_in_job())
                 proofs[run.in_flight] = {run.in_flight, false, why_no_answer(run, log_), ""};
             }}
        .run([&]() -> std::optional<Job> {
          if (waiting.empty()) return std::nullopt;
          Job job{.kind = "prove", .name = waiting.front()};
          waiting.pop_front();
          return job;
        });
    std::vector<CaptureRecord> captures;
    for (const std::string& name : names) {
      const auto proof = proofs.find(name);
      captures.push_back(proof != proofs.end() ? proof->second
                                               : CaptureRecord{name, false, "it does not start", ""});
    }
    return captures;
  }

  // Returns false, with the reason in the result, if a worker elsewhere can no longer be reached.
  bool run_tests() {
    for (const ListedTest& test : request_.tests)
      if (const std::optional<std::string> why = baseline_.skip(test.name))
        records_.add(test.name, Verdict::kSkipped, *why).baseline_reason = *why;
    int fruitless = 0;
    while (!interrupted) {
      std::vector<std::string> remaining;
      for (const ListedTest& test : request_.tests)
        if (!records_.find(test.name)) remaining.push_back(test.name);
      if (remaining.empty()) return true;
      const std::size_t before = records_.size(), omitted_before = processes_.omitted_calls().size();
      WorkerRun last;
      deaths_.confirm_and_record(run_in_parallel(remaining, last));
      if (interrupted || records_.size() > before || processes_.omitted_calls().size() > omitted_before ||
          ++fruitless < kMostFruitless)
        continue;
      if (last.is_elsewhere() && !last.began_a_job() && !last.crash) {
        result_.reason = why_no_answer(last, log_);
        return false;
      }
      for (const std::string& name : remaining)
        if (!records_.find(name))
          records_.add(name, verdict_of_death(last), describe(last) + " before its first test");
    }
    return true;
  }

  // Runs the tests in parallel processes and adds their records. Returns the processes that died in a test,
  // except those that an interruption killed, and those whose test is run again. `last`: set to the process
  // that ended last.
  std::vector<WorkerRun> run_in_parallel(const std::vector<std::string>& tests, WorkerRun& last) {
    std::vector<WorkerRun> deaths;
    processes_.run_in_parallel(
        tests,
        [&](const Event& event) {
          if (const auto* start = std::get_if<JobStarted>(&event))
            progress_({"test", records_.size(), request_.tests.size(), start->name});
          records_.add(event);
        },
        [&](const WorkerRun& run) {
          histories_.add_sequence(run.finished);
          last = run;
          if (run.died_in_job() && !interrupted) deaths.push_back(run);
        });
    std::erase_if(deaths, [this](const WorkerRun& run) { return processes_.runs_again(run); });
    return deaths;
  }

  // In the second pass, marks tests that also fail in fresh contexts, and searches for the histories of the
  // other failures.
  void explain_by_history() {
    for (const ListedTest& test : request_.tests) {
      TestRecord* const record = records_.find(test.name);
      if (interrupted || !record || !is_failure(record->verdict) || histories_.has_searched(test.name))
        continue;
      if (histories_.fails_in_first_pass(*record)) {
        record->also_in_fresh_context = true;
        record->expected_by_baseline = true;
        record->baseline_reason = "fails in a fresh context as well";
        continue;
      }
      if (baseline_.knows(*record, request_.depth, request_.seed)) continue;
      progress_({"searching a history", records_.size(), request_.tests.size(), test.name});
      const std::vector<std::string> predecessors = histories_.predecessors_of(test.name);
      const History history = histories_.find_history(*record, predecessors);
      add_history(*record, history, predecessors.size());
      record->flake = history.quality == History::Quality::kNotReproduced;
    }
  }

  RunResult finish(RunStatus status) {
    result_.status = status;
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    result_.failing_cases = records_.failing_cases();
    for (const ListedTest& test : request_.tests) {
      TestRecord* const record = records_.find(test.name);
      if (!record) continue;
      record->source = test.source;
      if (is_failure(record->verdict)) add_commands(request_, *record);
      result_.tests.push_back(*record);
    }
    result_.summarize();
    try {
      write_atomically(file("results", "json"), to_text(result_));
    } catch (const CannotWrite& error) {
      if (records_.size() == 0) throw;
      throw CannotWrite(fmt::format("{}; what {} has shown until then is in {}", error.what(), request_.name,
                                    file("records", "jsonl").filename().string()));
    }
    return result_;
  }

  const RunRequest& request_;
  const std::function<void(const Progress&)>& progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  RunResult result_;
  const fs::path log_ = file("log", "txt");
  const Limits limits_of_start_ = {kSecondsToStart, request_.limits.memory};
  Baseline baseline_;
  SuiteProcesses processes_{request_, log_};
  RunRecords records_{request_, file("records", "jsonl")};
  HistorySearch histories_{request_, processes_};
  DeathConfirmation deaths_{request_, processes_, records_, histories_, progress_};
};

}  // namespace

RunResult run_implementation(const RunRequest& request,
                             const std::function<void(const Progress&)>& progress) {
  return Run(request, progress).run();
}

}  // namespace evalcts
