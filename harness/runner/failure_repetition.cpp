// Implements the repetition of failures.
#include "failure_repetition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace evalcts {
namespace {

// Returns the outcome of the test when it ran alone, if there is one and it differs from the outcome in the
// record.
std::optional<Repetition> other_outcome(const TestRecord& record, const WorkerRun& alone) {
  if (alone.in_flight == record.name) return Repetition{verdict_of_death(alone), describe(alone)};
  const auto found = alone.records.find(record.name);
  if (found == alone.records.end()) return std::nullopt;
  const TestRecord& other = found->second;
  if (other.verdict == record.verdict && other.signature() == record.signature()) return std::nullopt;
  return Repetition{other.verdict, other.message};
}

// Keeps the first failure of each group, and returns the others by this first one. Failures with the same
// test function and the same compared value, apart from numbers, form a group.
std::map<std::string, std::vector<std::string>> keep_one_of_each_group(std::vector<std::string>& names,
                                                                       RunRecords& records) {
  std::map<std::string, std::string> first_of_group;
  std::map<std::string, std::vector<std::string>> rest;
  std::vector<std::string> kept;
  for (const std::string& name : names) {
    const std::vector<Failure>& failures = records.find(name)->failures;
    std::string group = name.substr(0, name.find('/')) + ": ";
    if (!failures.empty()) group += failures.front().what;
    std::erase_if(group, [](unsigned char c) { return std::isdigit(c) != 0; });
    const auto [found, is_new] = first_of_group.try_emplace(group, name);
    (is_new ? kept : rest[found->second]).push_back(name);
  }
  names = std::move(kept);
  return rest;
}

// Explains a failure with another outcome when it ran alone: it depends on earlier tests, it is a flake,
// which decides nothing, or it fails each time, but not in the same way.
void explain_difference(TestRecord& record, const Repetition& again, HistorySearch& histories) {
  const std::vector<std::string> predecessors = histories.predecessors_of(record.name);
  const History history = histories.find_history(record, predecessors);
  if (!history.tests.empty()) return add_history(record, history, predecessors.size());
  record.again = again;
  if (is_failure(again.verdict)) {
    record.message +=
        "; when it runs again alone in a new process, it fails in another way: " + again.message;
    return;
  }
  record.flake = history.quality != History::Quality::kOutOfTime;
  record.message += fmt::format("; when it runs again alone in a new process, its verdict is {}",
                                text_of(again.verdict).label);
  if (!record.flake) {
    record.message += kHistoryOutOfTime;
  } else {
    record.verdict = Verdict::kNotObservable;
    record.message = "unstable: " + record.message;
  }
}

}  // namespace

std::uint64_t repeat_failures(const RunRequest& request, const Baseline& baseline,
                              const SuiteProcesses& processes, RunRecords& records, HistorySearch& histories,
                              const std::function<void(const Progress&)>& progress) {
  if (request.retries == 0) return 0;
  std::vector<std::string> names;
  for (const ListedTest& test : request.tests) {
    const TestRecord* const record = records.find(test.name);
    if (record && record->verdict == Verdict::kFail && !baseline.knows(*record, request.depth, request.seed))
      names.push_back(test.name);
  }
  std::map<std::string, std::vector<std::string>> rest_of_group;  // by the test that represents the group
  if (names.size() > kMostRerun) rest_of_group = keep_one_of_each_group(names, records);
  // If a test does not represent its group, the others of the group are repeated, too. `names` grows, so that
  // the loop below reaches them.
  const auto repeat_group_of = [&](const std::string& name) {
    if (const auto rest = rest_of_group.extract(name); !rest.empty())
      names.insert(names.end(), rest.mapped().begin(), rest.mapped().end());
  };
  for (int round = 0; round < request.retries; ++round) {
    std::vector<std::string> same;
    const auto jobs = static_cast<std::size_t>(request.jobs);
    for (std::size_t begin = 0; begin < names.size() && !interrupted; begin += jobs) {
      const std::vector<std::string> some(
          names.begin() + static_cast<std::ptrdiff_t>(begin),
          names.begin() + static_cast<std::ptrdiff_t>(std::min(begin + jobs, names.size())));
      progress({"running again", begin, names.size(), some.front()});
      const std::vector<WorkerRun> runs = processes.run_alone(some, false);
      for (std::size_t i = 0; i < some.size() && !interrupted; ++i) {
        TestRecord& record = *records.find(some[i]);
        if (!runs[i].died_in_job() && !runs[i].records.contains(some[i])) {
          record.message += "; not confirmed, because it did not begin in a new process";
          repeat_group_of(some[i]);
          continue;
        }
        const std::optional<Repetition> other = other_outcome(record, runs[i]);
        if (!other) {
          same.push_back(some[i]);
          continue;
        }
        progress({"searching a history", records.size(), request.tests.size(), some[i]});
        explain_difference(record, *other, histories);
        repeat_group_of(some[i]);
      }
    }
    names = std::move(same);
  }
  std::uint64_t confirmed_by_group = 0;
  for (const std::string& name : names)  // the representatives that failed in the same way each time
    if (const auto rest = rest_of_group.find(name); rest != rest_of_group.end())
      confirmed_by_group += rest->second.size();
  return confirmed_by_group;
}

}  // namespace evalcts
