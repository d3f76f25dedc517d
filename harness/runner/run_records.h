// The records of a run while it is in progress: in memory, and in the file records-NAME.jsonl, which shows
// how far a run came that was cut off. Later changes of a record are only in results-NAME.json.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include <evalcts/runner/runner.h>

namespace evalcts {

// Returns the verdict of a test in which the process died.
Verdict verdict_of_death(const WorkerRun& run);

class RunRecords {
 public:
  // `file`: the file to append to. Writing throws CannotWrite. `request` must outlive the object.
  RunRecords(const RunRequest& request, std::filesystem::path file);

  // Takes over the records and failing cases of an event, and appends such events and JobStarted to the file.
  void add(const Event& event);
  // Adds the record of a test for which no process wrote one. `last_case`: the case that it died in.
  TestRecord& add(const std::string& test, Verdict verdict, const std::string& message,
                  const std::optional<CaseStarted>& last_case = {}, const std::optional<Crash>& crash = {});

  // Returns the record of the test; null if there is none.
  TestRecord* find(const std::string& test);
  std::size_t size() const { return records_.size(); }
  // Returns the commands of the first failing case of each test, see RunResult::failing_cases.
  const std::map<std::string, std::string>& failing_cases() const { return failing_cases_; }

 private:
  const RunRequest& request_;
  const std::filesystem::path file_;
  std::map<std::string, TestRecord> records_;
  std::map<std::string, std::string> failing_cases_;
};

}  // namespace evalcts
