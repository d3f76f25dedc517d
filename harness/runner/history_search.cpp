// Implements HistorySearch. history.h has the algorithm, which decides after which tests the failing test
// runs again.
#include "history_search.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>

namespace evalcts {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kMostSeconds = 30;  // for the search for the history of one failure

std::string message_with_history(const History& history, std::size_t predecessors,
                                 const std::string& message) {
  switch (history.quality) {
    case History::Quality::kNotReproduced:
      return fmt::format(
          "{}; not reproduced, neither alone nor after the same {} tests: it does not always happen", message,
          predecessors);
    case History::Quality::kOutOfTime:
      return message + kHistoryOutOfTime;
    case History::Quality::kShortest:
    case History::Quality::kShortened:
      break;
  }
  std::string after = "its own earlier cases";
  if (history.tests.size() > 3) {
    after =
        fmt::format("{} tests, {} to {}", history.tests.size(), history.tests.front(), history.tests.back());
  } else if (!history.tests.empty()) {
    after = fmt::format("{}", fmt::join(history.tests, ", "));
  }
  if (!history.only_case.empty()) after += fmt::format(" up to its case '{}'", history.only_case);
  if (history.quality == History::Quality::kShortened) after += " (perhaps fewer: time ran out)";
  return fmt::format("after {}: {}", after, message);
}

}  // namespace

void add_history(TestRecord& record, const History& history, std::size_t predecessors) {
  record.message = message_with_history(history, predecessors, record.message);
  record.history_case = history.only_case;
  if (history.is_found()) record.history = history.tests;
}

std::vector<std::string> HistorySearch::predecessors_of(const std::string& test) const {
  for (const std::vector<std::string>& sequence : sequences_) {
    const auto position = std::ranges::find(sequence, test);
    if (position != sequence.end()) return {sequence.begin(), position};
  }
  return {};
}

bool HistorySearch::fails_in_first_pass(const TestRecord& record) const {
  if (!request_.is_second_pass()) return false;
  const auto fresh = std::ranges::find(request_.first_pass->tests, record.name, &TestRecord::name);
  return fresh != request_.first_pass->tests.end() && fresh->verdict == record.verdict &&
         (fresh->signature() == record.signature() ||
          std::ranges::includes(fresh->mismatches, record.mismatches));
}

// Returns true if the test fails again when it runs after these jobs; empty if time runs out first.
std::optional<bool> HistorySearch::happens_again(const TestRecord& record, std::vector<Job> jobs) const {
  jobs.push_back({.kind = "test", .name = record.name});
  const WorkerRun run = processes_.run_in_turn(jobs, SuiteProcesses::Like::kInParallel, deadline_);
  if (run.cut_short || interrupted) return std::nullopt;
  if (is_death(record.verdict)) return run.in_flight == record.name;
  const auto again = run.records.find(record.name);
  return again != run.records.end() && is_failure(again->second.verdict) &&
         !fails_in_first_pass(again->second);
}

History HistorySearch::find_history(const TestRecord& record, const std::vector<std::string>& predecessors) {
  const auto begin = Clock::now();
  searched_.insert(record.name);
  double seconds = std::min(kMostSeconds, seconds_left_);
  if (record.verdict == Verdict::kTimeout)
    seconds += 4 * processes_.patience();  // each repetition takes as long
  deadline_ = begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  const std::optional<bool> without_predecessors = happens_again(record, {});
  History history;
  if (without_predecessors && *without_predecessors) {
    history.quality = History::Quality::kShortest;
  } else if (without_predecessors) {
    const bool guess_applies = std::ranges::all_of(
        guess_, [&](const std::string& test) { return std::ranges::count(predecessors, test) > 0; });
    history = shortest_history(predecessors, guess_applies ? guess_ : std::vector<std::string>(),
                               [&](const std::vector<std::string>& tests) {
                                 std::vector<Job> jobs;
                                 for (const std::string& test : tests)
                                   jobs.push_back({.kind = "test", .name = test});
                                 return happens_again(record, std::move(jobs));
                               });
  }
  // The search for the case would wait for each hang.
  if (history.tests.size() == 1 && record.verdict != Verdict::kTimeout)
    history.only_case = case_of_history(record, history.tests[0]);
  seconds_left_ = std::max(seconds_left_ - std::chrono::duration<double>(Clock::now() - begin).count(), 0.0);
  if (!history.tests.empty()) guess_ = history.tests;
  return history;
}

// For a history of one test, returns the last of the cases of this test that the failure depends on; empty
// if it was not found.
std::string HistorySearch::case_of_history(const TestRecord& record, const std::string& test) const {
  const WorkerRun traced = processes_.run_in_turn(
      {{.kind = "test", .name = test, .traces_cases = true}, {.kind = "test", .name = record.name}},
      SuiteProcesses::Like::kAlone, deadline_);
  const auto cases = traced.cases.find(test);
  if (traced.cut_short || interrupted || cases == traced.cases.end()) return {};
  const auto enough = least(cases->second.size(), [&](std::size_t count) {
    return happens_again(record, {{.kind = "test", .name = test, .cases = count}});
  });
  return enough ? cases->second[*enough - 1] : std::string();
}

}  // namespace evalcts
