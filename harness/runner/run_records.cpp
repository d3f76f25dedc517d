// Implements RunRecords.
#include "run_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include <evalcts/results/files.h>

namespace evalcts {

Verdict verdict_of_death(const WorkerRun& run) { return run.hung ? Verdict::kTimeout : Verdict::kCrash; }

RunRecords::RunRecords(const RunRequest& request, std::filesystem::path file)
    : request_(request), file_(std::move(file)) {}

void RunRecords::add(const Event& event) {
  if (const auto* result = std::get_if<TestFinished>(&event))
    records_[result->record.name] = result->record;
  else if (const auto* failed = std::get_if<CaseFailed>(&event))
    failing_cases_[failed->test] = failed->commands;
  else if (!std::holds_alternative<JobStarted>(event))
    return;
  std::ofstream file(file_, std::ios::app);
  file << to_line(event);
  if (!file.flush())
    throw CannotWrite(fmt::format("cannot write '{}': {}", file_.string(), std::strerror(errno)));
}

TestRecord& RunRecords::add(const std::string& test, Verdict verdict, const std::string& message,
                            const std::optional<CaseStarted>& last_case, const std::optional<Crash>& crash) {
  const auto listed = std::ranges::find(request_.tests, test, &ListedTest::name);
  if (listed == request_.tests.end()) throw std::logic_error("unknown test " + test);
  TestRecord record;
  record.name = test;
  record.requirements = listed->requirements;
  record.level = listed->level;
  record.verdict = verdict;
  record.message = message;
  record.crash = crash;
  if (last_case) {
    Failure failure;
    failure.case_identity = last_case->identity;
    failure.message = message;
    failure.calls = last_case->calls;
    if (!last_case->commands.empty()) failing_cases_[test] = last_case->commands;
    record.failures.push_back(failure);
  }
  add(TestFinished{record});
  return records_.at(test);
}

TestRecord* RunRecords::find(const std::string& test) {
  const auto found = records_.find(test);
  return found == records_.end() ? nullptr : &found->second;
}

}  // namespace evalcts
