// Runs the tests of one implementation in workers, repeats unexpected failures alone, and makes the
// record of the run.
#include <evalcts/runner/runner.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <deque>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include <evalcts/runner/worker.h>
#include "history.h"
#include "request.h"

namespace evalcts {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kMostBetweenTests = std::uint64_t{250} << 20;  // bytes of memory of a process
constexpr double kSecondsToStart = 60;   // for the description of the implementation, and each proof
constexpr double kSearchBudget = 30;     // seconds for the search for the history of one failure
constexpr double kSearchesBudget = 120;  // seconds for all these searches
constexpr int kMostFruitless = 2;        // rounds that may end without a result before the run gives up
constexpr char kOutOfTime[] = "; the search for the tests that it depends on ran out of time";
constexpr double kPatienceAfterHang = 5;  // seconds for a test once another one has hung
constexpr std::size_t kSameCrashes = 3;   // tests with one crash, after which others need no confirmation

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Run {
 public:
  Run(const RunRequest& request, const std::function<void(const Progress&)>& progress)
      : request_(request), progress_(progress), result_(header_of(request)) {}

  RunResult run() {
    remove_stale_files();
    progress_({"starting", 0, request_.tests.size(), ""});
    try {
      if (!start()) return finish(interrupted ? RunStatus::kInterrupted : RunStatus::kNotStarted);
      run_tests();
      if (second_pass())
        explain_by_history();
      else
        rerun_failures();
    } catch (const CannotWrite& error) {
      result_.reason =
          error.what() + std::string("; free some space, or choose another folder with --output");
      return finish(RunStatus::kInterrupted);
    } catch (const CannotSpawn& error) {
      result_.reason = error.what();
      return finish(records_.empty() ? RunStatus::kNotStarted : RunStatus::kInterrupted);
    }
    return finish(interrupted ? RunStatus::kInterrupted : RunStatus::kComplete);
  }

 private:
  bool second_pass() const { return request_.first_pass != nullptr; }
  fs::path file(const std::string& kind, const std::string& extension) const {
    return request_.output / fmt::format("{}-{}.{}", kind, result_.file_label(), extension);
  }

  void remove_stale_files() const {
    for (const auto& [kind, extension] :
         {std::pair{"results", "json"}, {"records", "jsonl"}, {"junit", "xml"}, {"log", "txt"}})
      fs::remove(file(kind, extension));
  }

  bool start() {
    std::string& reason = result_.reason;
    const Limits limits = {kSecondsToStart, request_.limits.memory};
    const fs::path log = file("log", "txt");
    const std::optional<Description> description =
        ask<Description>(suite_command_alone(), {"describe", "describe"}, reason, log, limits);
    if (!description) return false;
    ImplementationRecord& implementation = result_.implementation;
    const ImplementationRecord named = implementation;
    implementation = description->implementation;
    implementation.kind = std::exchange(implementation.name, named.name);
    implementation.machine = named.machine;
    baseline_ = Baseline(request_.baseline, implementation, result_.pass);
    std::map<std::string, CaptureRecord> proofs;
    std::size_t next = 0;
    Pool{.command = [this] { return suite_command_alone(); },
         .log = log,
         .limits = limits,
         .workers = description->captures.size(),
         .is_each_alone = true,
         .each =
             [&](const Event& event) {
               if (const auto* proof = std::get_if<CaptureRecord>(&event)) proofs[proof->name] = *proof;
             },
         .ended =
             [&](const WorkerRun& run) {
               if (!run.in_flight.empty())
                 proofs[run.in_flight] = {run.in_flight, false, why_no_answer(run, log), ""};
             }}
        .run([&]() -> std::optional<Job> {
          if (next == description->captures.size()) return std::nullopt;
          return Job{.kind = "prove", .name = description->captures[next++]};
        });
    for (const std::string& name : description->captures) {
      const auto proof = proofs.find(name);
      const CaptureRecord capture =
          proof != proofs.end() ? proof->second : CaptureRecord{name, false, "it does not start", ""};
      if (capture.available) captures_.push_back(capture.name);
      implementation.captures.push_back(capture);
    }
    if (interrupted) reason = "interrupted";
    return !interrupted;
  }

  // --- running tests -------------------------------------------------------------------------------------

  std::vector<std::string> suite_command_alone() const {
    std::vector<std::string> command = suite_command(request_);
    command.push_back("--die-with-parent");
    return command;
  }

  // Returns the command of a worker that runs tests.
  std::vector<std::string> command_for_tests() const {
    std::vector<std::string> command = suite_command_alone();
    command.insert(command.end(),
                   {"--captures", captures_.empty() ? "none" : fmt::format("{}", fmt::join(captures_, ","))});
    if (second_pass()) command.push_back("--reuse-context");
    for (const std::string& call : crashing_calls_) command.insert(command.end(), {"--leave-out", call});
    return command;
  }

  // True if tests run in a warm context first. Those of run_alone() use fresh contexts only.
  bool uses_warm_context() const {
    return !second_pass() && !request_.only_fresh_contexts && !dies_with_second_context_;
  }

  // Runs some tests again in one process, without adding to the results.
  WorkerRun run_scratch(const std::vector<Job>& tests, bool in_warm_context = false) const {
    std::vector<std::string> command = command_for_tests();
    if (in_warm_context) command.push_back("--warm");
    Worker worker(command, file("log", "txt"), request_.limits);
    for (const Job& test : tests) worker.give(test);
    worker.finish();
    const WorkerRun& run = worker.wait(deadline_);
    return run;
  }

  // Runs each of the tests again in its own process, in parallel, without adding to the results.
  std::vector<WorkerRun> run_alone(const std::vector<std::string>& tests, bool traces_cases) const {
    std::map<std::string, WorkerRun> runs;
    std::size_t next = 0;
    Pool{.command = [this] { return command_for_tests(); },
         .log = file("log", "txt"),
         .limits = request_.limits,
         .workers = tests.size(),
         .is_each_alone = true,
         .ended =
             [&](const WorkerRun& run) {
               if (!run.in_flight.empty()) runs[run.in_flight] = run;
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

  void run_tests() {
    records_file_ = file("records", "jsonl");
    for (const ListedTest& test : request_.tests)
      if (const std::optional<std::string> why = baseline_.skip(test.name))
        add_record(test.name, Verdict::kSkipped, *why).baseline_reason = *why;
    int fruitless = 0;
    while (!interrupted) {
      std::deque<std::string> remaining;
      for (const ListedTest& test : request_.tests)
        if (!records_.contains(test.name)) remaining.push_back(test.name);
      if (remaining.empty()) return;
      const std::size_t before = records_.size(), calls_before = crashing_calls_.size();
      const std::vector<WorkerRun> ended = run_side_by_side(remaining);
      record_deaths(ended);
      if (interrupted || records_.size() > before || crashing_calls_.size() > calls_before ||
          ++fruitless < kMostFruitless)
        continue;
      const WorkerRun& last = ended.back();
      for (const std::string& name : remaining)
        if (!records_.contains(name))
          add_record(name, verdict_of_death(last), describe(last) + " before its first test");
    }
  }

  // Runs the tests in parallel processes, each of which takes the next free test. A process that dies is
  // replaced. Results are added to records_. Returns the processes that have ended. `in_flight` is
  // cleared if an interruption killed the process, or if the test is to be run again without the command
  // in which it crashed.
  std::vector<WorkerRun> run_side_by_side(std::deque<std::string> tests) {
    std::vector<WorkerRun> ended;
    const Pool pool{
        .command =
            [this] {
              std::vector<std::string> command = command_for_tests();
              // A process that has grown is replaced between tests, because a library may lose memory in each
              // context, and a test of thorough depth may need more than half of the limit.
              const std::uint64_t most = std::min(request_.limits.memory / 4, kMostBetweenTests);
              command.insert(command.end(), {"--renew-above", std::to_string(most >> 20)});
              if (uses_warm_context()) command.push_back("--warm");
              return command;
            },
        .log = file("log", "txt"),
        .limits = request_.limits,
        .patience = [this] { return patience_; },
        .workers = std::min(static_cast<std::size_t>(second_pass() ? 1 : request_.jobs), tests.size()),
        .each = [this](const Event& event) { note(event); },
        .ended =
            [&](const WorkerRun& run) {
              // A library that cannot have two contexts may die when the warm context is made.
              if (!run.complete && run.finished.empty() && run.in_flight.empty())
                dies_with_second_context_ = true;
              // Tests that hang often do so at one place, and each would take until the time limit.
              if (run.hung) patience_ = std::min(patience_, kPatienceAfterHang);
              sequences_.push_back(run.finished);
              count_crash(run);
              ended.push_back(run);
              if (interrupted) ended.back().in_flight.clear();
            }};
    pool.run([&]() -> std::optional<Job> {
      if (tests.empty()) return std::nullopt;
      Job job{.kind = "test", .name = tests.front()};
      tests.pop_front();
      return job;
    });
    for (WorkerRun& run : ended)
      if (may_survive_now(run)) run.in_flight.clear();
    return ended;
  }

  // Counts the crash or hang of a test. Once kSameCrashes tests have crashed in the same command, processes
  // that start later omit this command from tests in which it is optional.
  void count_crash(const WorkerRun& run) {
    if (run.in_flight.empty() || !run.crash || run.crash->call.empty()) return;
    std::set<std::string>& tests = tests_that_crash_in_[run.crash->call];
    tests.insert(run.in_flight);
    if (tests.size() == kSameCrashes && std::ranges::count(crashing_calls_, run.crash->call) == 0)
      crashing_calls_.push_back(run.crash->call);
  }

  // True if the test crashed in a command that new processes omit, but its process did not.
  bool may_survive_now(const WorkerRun& run) const {
    return !run.in_flight.empty() && run.crash && std::ranges::count(crashing_calls_, run.crash->call) > 0 &&
           std::ranges::count(run.command, run.crash->call) == 0;
  }

  // Handles an event of a process of run_side_by_side().
  void note(const Event& event) {
    if (const auto* start = std::get_if<JobStarted>(&event)) {
      progress_({"test", records_.size(), request_.tests.size(), start->name});
    } else if (const auto* result = std::get_if<TestFinished>(&event)) {
      records_[result->record.name] = result->record;
    } else if (const auto* failed = std::get_if<CaseFailed>(&event)) {
      result_.failing_cases[failed->test] = failed->commands;
    }
    if (!std::holds_alternative<RunEnded>(event) && !std::holds_alternative<JobEnded>(event) &&
        !std::holds_alternative<Crashed>(event))
      append_to_records(event);
  }

  void append_to_records(const Event& event) const {
    std::ofstream file(records_file_, std::ios::app);
    file << to_line(event);
    if (!file.flush())
      throw CannotWrite(fmt::format("cannot write '{}': {}", records_file_.string(), std::strerror(errno)));
  }

  // Adds the record of a test for which the suite program did not write one.
  TestRecord& add_record(const std::string& name, Verdict verdict, const std::string& message,
                         const std::optional<CaseStarted>& last_case = {},
                         const std::optional<Crash>& crash = {}) {
    const auto test = std::ranges::find(request_.tests, name, &ListedTest::name);
    if (test == request_.tests.end()) throw std::logic_error("unknown test " + name);
    TestRecord record;
    record.name = name;
    record.requirements = test->requirements;
    record.level = test->level;
    record.verdict = verdict;
    record.message = message;
    record.crash = crash;
    if (last_case) {
      Failure failure;
      failure.case_identity = last_case->identity;
      failure.message = message;
      failure.calls = last_case->calls;
      if (!last_case->commands.empty()) result_.failing_cases[name] = last_case->commands;
      record.failures.push_back(failure);
    }
    // The file of records must be complete without the result file, so it gets the records of
    // dead tests, too.
    append_to_records(TestFinished{record});
    return records_[name] = std::move(record);
  }

  static Verdict verdict_of_death(const WorkerRun& run) {
    return run.hung ? Verdict::kTimeout : Verdict::kCrash;
  }

  // Statistics of crashes in one command with the same innermost frames.
  struct SameCrashes {
    std::size_t confirmed = 0;  // tests that crashed in the same way when they ran alone
    std::size_t others = 0;     // tests with another outcome when they ran alone
  };

  // True for a crash in a command that defines or queries a map. No control is needed to blame evaluators for
  // it, because a control has no such commands.
  static bool is_in_map_command(const WorkerRun& run) {
    if (!run.crash || run.hung || run.over_memory) return false;
    return std::ranges::any_of(std::array{"glMap", "glGetMap", "glGetnMap"},
                               [&](const char* name) { return run.crash->call.starts_with(name); });
  }

  static std::string place_of(const WorkerRun& run) { return run.crash->call + "\n" + run.crash->group(); }
  SameCrashes& crashes_like(const WorkerRun& run) { return same_crashes_[place_of(run)]; }

  // Records the tests that processes died in. Each test is run again alone, unless it crashed in a map
  // command and kSameCrashes tests with the same crash have been confirmed and none had another outcome, or
  // it hangs at a place where another test hangs alone.
  void record_deaths(const std::vector<WorkerRun>& ended) {
    std::vector<const WorkerRun*> first, like_others, rest, hung_like_others;
    std::map<const SameCrashes*, std::size_t> chosen;
    for (const WorkerRun& child : ended) {
      if (child.in_flight.empty()) continue;
      if (child.hung && child.crash && !child.crash->call.empty() && !second_pass() &&
          !hangs_.try_emplace(place_of(child), child.in_flight).second) {
        hung_like_others.push_back(&child);
        continue;
      }
      const bool has_like = !second_pass() && is_in_map_command(child);
      const SameCrashes* const same = has_like ? &crashes_like(child) : nullptr;
      (same && same->confirmed + chosen[same]++ >= kSameCrashes ? like_others : first).push_back(&child);
    }
    confirm_deaths(first);
    for (const WorkerRun* child : like_others) {
      const SameCrashes& same = crashes_like(*child);
      if (interrupted || same.others > 0 || same.confirmed < kSameCrashes) {
        rest.push_back(child);
        continue;
      }
      add_record(
          child->in_flight, Verdict::kCrash,
          fmt::format("{}; as in {} tests that were run again alone", describe(*child), same.confirmed), {},
          child->crash);
    }
    for (const WorkerRun* child : hung_like_others) {
      const TestRecord& representative = records_.at(hangs_.at(place_of(*child)));
      if (interrupted || !hung_alone_.contains(representative.name))
        rest.push_back(child);
      else
        add_record(child->in_flight, representative.verdict,
                   fmt::format("{}{}; as in {}, which was run again alone",
                               representative.verdict == Verdict::kNotObservable ? "pipeline: " : "",
                               describe(*child), representative.name),
                   {}, child->crash);
    }
    confirm_deaths(rest);
  }

  // Runs each of these tests alone in a new process, with its cases traced to get the calls, and records it.
  // If a test passes alone, its history is searched for.
  void confirm_deaths(const std::vector<const WorkerRun*>& dead) {
    const auto jobs = static_cast<std::size_t>(request_.jobs);
    for (std::size_t begin = 0; begin < dead.size(); begin += jobs) {
      const std::size_t end = std::min(begin + jobs, dead.size());
      std::vector<std::string> names;
      for (std::size_t i = begin; i < end; ++i) names.push_back(dead[i]->in_flight);
      progress_({"confirming", records_.size(), request_.tests.size(), names.front()});
      const std::vector<WorkerRun> alone =
          interrupted ? std::vector<WorkerRun>(names.size()) : run_alone(names, true);
      for (std::size_t i = begin; i < end; ++i) record_death(*dead[i], alone[i - begin]);
    }
  }

  // True if the control of the case in which the test died alone, without evaluators, also ends the process.
  bool dies_with_explicit_vertices(const std::string& name, const WorkerRun& alone) const {
    const auto cases = alone.cases.find(name);
    if (is_in_map_command(alone) || cases == alone.cases.end() || cases->second.empty()) return false;
    const WorkerRun control =
        run_scratch({{.kind = "test", .name = name, .cases = cases->second.size(), .runs_control = true}});
    return !interrupted && !control.in_flight.empty();
  }

  void record_death(const WorkerRun& child, const WorkerRun& alone) {
    const std::string name = child.in_flight;
    const Verdict verdict = verdict_of_death(child);
    const std::string how = describe(child);
    if (interrupted) {
      add_record(name, verdict, how + "; not confirmed, the run was interrupted", {}, child.crash);
      return;
    }
    if (alone.in_flight.empty() && alone.finished.empty()) {
      add_record(name, verdict, how + "; not confirmed, because no test began in a new process", {},
                 child.crash);
      return;
    }
    const auto result = alone.records.find(name);
    const bool has_record = result != alone.records.end();
    if (child.hung && child.limits.seconds_per_test < request_.limits.seconds_per_test && has_record) {
      records_[name] = result->second;  // it was only slow
      append_to_records(TestFinished{result->second});
      return;
    }
    if (alone.hung) hung_alone_.insert(name);
    if (is_in_map_command(child)) {
      SameCrashes& same = crashes_like(child);
      const bool is_same = is_in_map_command(alone) && &crashes_like(alone) == &same;
      ++(is_same ? same.confirmed : same.others);
    }
    const std::string last_case = alone.last_case ? alone.last_case->identity : "";
    if (!alone.in_flight.empty() && alone.last_case && alone.last_case->is_control) {
      add_record(name, Verdict::kNotObservable, fmt::format("pipeline: {} in '{}'", how, last_case));
      return;
    }
    if (!alone.in_flight.empty() && dies_with_explicit_vertices(name, alone)) {
      add_record(name, Verdict::kNotObservable,
                 fmt::format("pipeline: {} in '{}', also with explicit vertices instead of evaluations", how,
                             last_case));
      return;
    }
    if (!alone.in_flight.empty()) {
      add_record(name, verdict, how + "; confirmed alone in a new process", alone.last_case, child.crash);
      return;
    }
    const bool fails_alone = has_record && result->second.verdict == Verdict::kFail;
    TestRecord& record =
        add_record(name, verdict, how + (fails_alone ? "; fails alone" : "; passes alone"), {}, child.crash);
    add_history(record, child.finished);
    if (record.flake && has_record) {
      record.again = {result->second.verdict, result->second.message};
      record.flake = !fails_alone;
    }
  }

  // --- repetition of failures ------------------------------------------------------------------------------

  // Returns the outcome of the test when it ran alone, if there is one and it differs from the outcome in the
  // record.
  std::optional<Repetition> other_outcome(const TestRecord& record, const WorkerRun& again) const {
    if (again.in_flight == record.name) return Repetition{verdict_of_death(again), describe(again)};
    const auto found = again.records.find(record.name);
    if (found == again.records.end()) return std::nullopt;
    const TestRecord& other = found->second;
    if (other.verdict == record.verdict && other.signature() == record.signature()) return std::nullopt;
    return Repetition{other.verdict, other.message};
  }

  // Repeats fails that the baseline does not list. (Crashes and timeouts have already been repeated.)
  void rerun_failures() {
    std::vector<std::string> names;
    for (const ListedTest& test : request_.tests) {
      const auto found = records_.find(test.name);
      if (found != records_.end() && found->second.verdict == Verdict::kFail &&
          !baseline_.knows(found->second, request_.depth, request_.seed))
        names.push_back(test.name);
    }
    if (request_.retries == 0) return;
    std::map<std::string, std::vector<std::string>> rest_of_group;  // by the test that represents the group
    if (names.size() > kMostRerun) rest_of_group = keep_one_of_each_group(names);
    for (int round = 0; round < request_.retries; ++round) {
      std::vector<std::string> same;
      const auto jobs = static_cast<std::size_t>(request_.jobs);
      for (std::size_t begin = 0; begin < names.size() && !interrupted; begin += jobs) {
        const std::vector<std::string> some(
            names.begin() + static_cast<std::ptrdiff_t>(begin),
            names.begin() + static_cast<std::ptrdiff_t>(std::min(begin + jobs, names.size())));
        progress_({"running again", begin, names.size(), some.front()});
        const std::vector<WorkerRun> runs = run_alone(some, false);
        for (std::size_t i = 0; i < some.size() && !interrupted; ++i) {
          if (runs[i].in_flight.empty() && !runs[i].records.contains(some[i])) {
            records_[some[i]].message += "; not confirmed, because it did not begin in a new process";
            continue;
          }
          const std::optional<Repetition> other = other_outcome(records_[some[i]], runs[i]);
          if (!other) {
            same.push_back(some[i]);
            continue;
          }
          explain_difference(records_[some[i]], *other);
          // A flake does not represent its group, so the others are repeated, too.
          const auto rest = rest_of_group.extract(some[i]);
          if (!rest.empty()) names.insert(names.end(), rest.mapped().begin(), rest.mapped().end());
        }
      }
      names = std::move(same);
    }
    for (const std::string& name : names)  // the representatives that failed in the same way each time
      if (const auto rest = rest_of_group.find(name); rest != rest_of_group.end())
        result_.confirmed_by_group += rest->second.size();
  }

  // Keeps the first failure of each group, and returns the others by this first one. Failures with the same
  // test function and the same compared value, apart from numbers, form a group.
  std::map<std::string, std::vector<std::string>> keep_one_of_each_group(std::vector<std::string>& names) {
    std::map<std::string, std::string> first_of_group;
    std::map<std::string, std::vector<std::string>> rest;
    std::vector<std::string> kept;
    for (const std::string& name : names) {
      const TestRecord& record = records_.at(name);
      std::string group = name.substr(0, name.find('/')) + ": ";
      if (!record.failures.empty()) group += record.failures.front().what;
      std::erase_if(group, [](unsigned char c) { return std::isdigit(c) != 0; });
      const auto [found, is_new] = first_of_group.try_emplace(group, name);
      (is_new ? kept : rest[found->second]).push_back(name);
    }
    names = std::move(kept);
    return rest;
  }

  // Explains a failure with another outcome when it ran alone: it depends on earlier tests, it is a flake,
  // which decides nothing, or it fails each time, but not in the same way.
  void explain_difference(TestRecord& record, const Repetition& again) {
    const TestRecord before = record;
    progress_({"searching a history", records_.size(), request_.tests.size(), record.name});
    const History::Quality found = add_history(record, predecessors_of(record.name));
    if (record.history && !record.history->empty()) return;
    record = before;
    record.again = again;
    if (is_failure(again.verdict)) {
      record.message +=
          "; when it runs again alone in a new process, it fails in another way: " + again.message;
      return;
    }
    record.flake = found != History::Quality::kOutOfTime;
    record.message += fmt::format("; when it runs again alone in a new process, its verdict is {}",
                                  text_of(again.verdict).word);
    if (!record.flake) {
      record.message += kOutOfTime;
    } else {
      record.verdict = Verdict::kNotObservable;
      record.message = "unstable: " + record.message;
    }
  }

  // --- histories of failures -----------------------------------------------------------------------------

  // True if the test failed in the first pass with the same verdict and at least the same mismatches.
  bool is_no_news(const TestRecord& record) const {
    if (!second_pass()) return false;
    const auto fresh = std::ranges::find(request_.first_pass->tests, record.name, &TestRecord::name);
    return fresh != request_.first_pass->tests.end() && fresh->verdict == record.verdict &&
           (fresh->signature() == record.signature() ||
            std::ranges::includes(fresh->mismatches, record.mismatches));
  }

  // In the second pass, marks tests that also fail in fresh contexts, and searches for the histories of the
  // other failures.
  void explain_by_history() {
    for (const ListedTest& test : request_.tests) {
      const auto found = records_.find(test.name);
      if (interrupted || found == records_.end()) continue;
      TestRecord& record = found->second;
      if (!is_failure(record.verdict) || searched_.contains(record.name)) continue;
      if (is_no_news(record)) {
        record.also_in_fresh_context = true;
        record.expected_by_baseline = true;
        record.baseline_reason = "fails in a fresh context as well";
        continue;
      }
      if (baseline_.knows(record, request_.depth, request_.seed)) continue;
      progress_({"searching a history", records_.size(), request_.tests.size(), record.name});
      add_history(record, predecessors_of(record.name));
    }
  }

  // Returns the tests that ran before the test in the same process.
  std::vector<std::string> predecessors_of(const std::string& name) const {
    for (const std::vector<std::string>& sequence : sequences_) {
      const auto position = std::find(sequence.begin(), sequence.end(), name);
      if (position != sequence.end()) return {sequence.begin(), position};
    }
    return {};
  }

  static std::vector<Job> jobs_of(const std::vector<std::string>& tests) {
    std::vector<Job> jobs;
    for (const std::string& test : tests) jobs.push_back({.kind = "test", .name = test});
    return jobs;
  }

  // Returns true if the test fails again when it runs after these tests; empty if time runs out first.
  std::optional<bool> happens_again(const TestRecord& record, std::vector<Job> tests) {
    const std::string& name = record.name;
    tests.push_back({.kind = "test", .name = name});
    const WorkerRun child = run_scratch(tests, uses_warm_context());
    if (child.cut_short || interrupted) return std::nullopt;
    if (is_death(record.verdict)) return child.in_flight == name;
    const auto again = child.records.find(name);
    return again != child.records.end() && is_failure(again->second.verdict) && !is_no_news(again->second);
  }

  // Searches for the shortest history by running tests in new processes, and adds it to the record.
  History::Quality add_history(TestRecord& record, const std::vector<std::string>& predecessors) {
    const auto begin = Clock::now();
    searched_.insert(record.name);
    double seconds = std::min(kSearchBudget, searches_left_);
    if (record.verdict == Verdict::kTimeout)
      seconds += 4 * request_.limits.seconds_per_test;  // each repetition takes until the time limit
    deadline_ = begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    const std::optional<bool> alone = happens_again(record, {});
    History history;
    if (alone && *alone) {
      history.quality = History::Quality::kShortest;
    } else if (alone) {
      const bool guess_applies = std::all_of(guess_.begin(), guess_.end(), [&](const std::string& test) {
        return std::find(predecessors.begin(), predecessors.end(), test) != predecessors.end();
      });
      history = shortest_history(
          predecessors, guess_applies ? guess_ : std::vector<std::string>(),
          [&](const std::vector<std::string>& tests) { return happens_again(record, jobs_of(tests)); });
    }
    std::string only_case;
    if (history.tests.size() == 1) only_case = case_of_history(record, history.tests[0]);
    deadline_.reset();
    searches_left_ = std::max(searches_left_ - seconds_since(begin), 0.0);
    if (!history.tests.empty()) guess_ = history.tests;
    record.message = words_for(history, only_case, predecessors.size(), record.message);
    if (history.quality == History::Quality::kShortest || history.quality == History::Quality::kShortened)
      record.history = history.tests;
    else
      record.flake = history.quality == History::Quality::kNotReproduced;
    record.history_case = only_case;
    return history.quality;
  }

  // For a history of one test, returns the last of the cases of this test that the failure depends on; empty
  // if it was not found.
  std::string case_of_history(const TestRecord& record, const std::string& test) {
    const WorkerRun traced = run_scratch(
        {{.kind = "test", .name = test, .traces_cases = true}, {.kind = "test", .name = record.name}});
    const auto cases = traced.cases.find(test);
    if (traced.cut_short || interrupted || cases == traced.cases.end()) return {};
    const auto enough = least(cases->second.size(), [&](std::size_t count) {
      return happens_again(record, {{.kind = "test", .name = test, .cases = count}});
    });
    return enough ? cases->second[*enough - 1] : std::string();
  }

  static std::string words_for(const History& history, const std::string& only_case, std::size_t predecessors,
                               const std::string& message) {
    switch (history.quality) {
      case History::Quality::kNotReproduced:
        return fmt::format(
            "{}; not reproduced, neither alone nor after the same {} tests: it does not always happen",
            message, predecessors);
      case History::Quality::kOutOfTime:
        return message + kOutOfTime;
      case History::Quality::kShortest:
      case History::Quality::kShortened:
        break;
    }
    std::string after = "its own earlier cases";
    if (history.tests.size() > 3) {
      after = fmt::format("{} tests, {} to {}", history.tests.size(), history.tests.front(),
                          history.tests.back());
    } else if (!history.tests.empty()) {
      after = fmt::format("{}", fmt::join(history.tests, ", "));
    }
    if (!only_case.empty()) after += fmt::format(" up to its case '{}'", only_case);
    if (history.quality == History::Quality::kShortened) after += " (perhaps fewer: time ran out)";
    return fmt::format("after {}: {}", after, message);
  }

  // --- the end -------------------------------------------------------------------------------------------

  RunResult finish(RunStatus status) {
    result_.status = status;
    for (const ListedTest& test : request_.tests) {
      const auto found = records_.find(test.name);
      if (found == records_.end()) continue;
      if (is_failure(found->second.verdict)) add_commands(request_, found->second);
      result_.tests.push_back(found->second);
    }
    result_.summarize();
    try {
      write_atomically(file("results", "json"), to_text(result_));
    } catch (const CannotWrite& error) {
      if (records_.empty()) throw;
      throw CannotWrite(fmt::format("{}; what {} has shown until then is in {}", error.what(), request_.name,
                                    file("records", "jsonl").filename().string()));
    }
    return result_;
  }

  const RunRequest& request_;
  const std::function<void(const Progress&)>& progress_;
  RunResult result_;
  std::vector<std::string> captures_;
  std::map<std::string, TestRecord> records_;
  fs::path records_file_;
  bool dies_with_second_context_ = false;  // set if a process died before its first test
  Baseline baseline_;
  std::vector<std::vector<std::string>> sequences_;  // the tests that each process finished, in order
  Deadline deadline_;                                // the end of the search in progress
  double searches_left_ = kSearchesBudget;
  std::set<std::string> searched_;                                    // tests whose history was searched for
  std::map<std::string, std::set<std::string>> tests_that_crash_in_;  // by command
  std::vector<std::string> crashing_calls_;  // commands that new processes omit, see count_crash()
  std::map<std::string, SameCrashes> same_crashes_;
  double patience_ = request_.limits.seconds_per_test;  // of tests in processes that start now
  std::map<std::string, std::string> hangs_;            // by place: the first test that hung there
  std::set<std::string> hung_alone_;                    // tests that hung again when they ran alone
  std::vector<std::string> guess_;  // the latest history, which often explains the next failure, too
};

}  // namespace

RunResult run_implementation(const RunRequest& request,
                             const std::function<void(const Progress&)>& progress) {
  return Run(request, progress).run();
}

}  // namespace evalcts
