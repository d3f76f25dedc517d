// The suite program as a child that plays a list of tests: what it reports while it runs, and how it ends.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/runner/child_process.h"

namespace evalcts {

// What one child made of its tests.
struct ChildRun {
  std::map<std::string, nlohmann::json> records;
  std::vector<std::string> finished;                      // in the order in which they ran
  std::string in_flight;                                  // the test that the child died in
  nlohmann::json last_case;                               // of that test, where cases were traced
  std::map<std::string, std::vector<std::string>> cases;  // the identities of each test's, where traced
  bool hung = false;
  bool cut_short = false;  // by the end of the time for a search
  bool complete = false;
  Ending ending;
};

class SuiteChild {
 public:
  using Deadline = std::optional<std::chrono::steady_clock::time_point>;

  // `command` writes its events to the file `events`, which grows from nothing, and all else to `log`.
  // Without an event for `seconds_per_test` it counts as hung and is killed. Throws std::runtime_error.
  SuiteChild(const std::vector<std::string>& command, const std::filesystem::path& events,
             const std::filesystem::path& log, double seconds_per_test);

  // Waits up to `seconds` and takes in what was reported since; `each` is called with each event,
  // once it is in run(). The child is killed when a signal has interrupted the run, and at the deadline. True
  // once it has ended, all events taken in.
  bool look(double seconds, const Deadline& deadline = {},
            const std::function<void(const nlohmann::json& event)>& each = {});

  const ChildRun& run() const { return run_; }

 private:
  void take(const nlohmann::json& event);

  std::filesystem::path events_;
  std::streamoff read_ = 0;
  double seconds_per_test_;
  std::chrono::steady_clock::time_point latest_event_ = std::chrono::steady_clock::now();
  ChildRun run_;
  ChildProcess process_;
};

}  // namespace evalcts
