// Runs a list of tests in a child process, which is the suite program, and collects its events and its end.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/results/serialization.h>
#include <evalcts/runner/child_process.h>

namespace evalcts {

// The results of one child process so far.
struct ChildRun {
  std::map<std::string, TestRecord> records;
  std::vector<std::string> finished;     // in the order in which they ran
  std::string in_flight;                 // the test that runs, or that the child died in
  std::optional<CaseStarted> last_case;  // latest case of that test, if cases are traced
  std::optional<Crash> crash;  // place of the crash or hang of that test, if the child could report it
  std::map<std::string, std::vector<std::string>> cases;  // identities of cases by test, if they are traced
  bool hung = false;
  bool over_memory = false;  // the process was killed because it exceeded Limits::memory
  bool cut_short = false;    // the process was killed at the deadline
  bool complete = false;     // all tests have ended
  std::string cannot_write;  // the reason if the child could not write its events, otherwise empty
  Ending ending;
};

// Time and memory beyond which a library is assumed never to stop. They are far more than any GL needs
// for a test.
struct Limits {
  double seconds_per_test = 60;
  std::uint64_t memory = std::uint64_t{4096} << 20;  // resident memory of a process, in bytes
};

// Returns a description of the end of the child: "no answer within 60 seconds in glEnd(), after 12 commands",
// "it used more than 4096 MiB of memory", "the process ended with ... in glEnd(), after 12 commands, at
// libGL.so.1 glEnd+0x2c".
std::string describe(const ChildRun& run, const Limits& limits);

class SuiteChild {
 public:
  using Deadline = std::optional<std::chrono::steady_clock::time_point>;

  // Starts `command`, which writes its events to the file `events`, which must not exist, and all
  // other output to `log`, which keeps kMostPrinted bytes of each test. The process is killed if it
  // reports no event for limits.seconds_per_test (it then counts as hung), or exceeds
  // limits.memory. Throws std::runtime_error.
  SuiteChild(const std::vector<std::string>& command, const std::filesystem::path& events,
             const std::filesystem::path& log, const Limits& limits);

  // Waits up to `seconds` for the end of the child, then adds the new events to run() and calls `each` with
  // each of them. Kills the child if a signal has interrupted the run, or the deadline has passed. Returns
  // true once the child has ended and all events have been read.
  bool look(double seconds, const Deadline& deadline = {},
            const std::function<void(const Event& event)>& each = {});

  const ChildRun& run() const { return run_; }

 private:
  void take(const Event& event);

  std::filesystem::path events_;
  std::streamoff read_ = 0;
  Limits limits_;
  std::chrono::steady_clock::time_point latest_event_ = std::chrono::steady_clock::now();
  Deadline report_deadline_;  // time at which a process that hangs is killed; none before it hangs
  ChildRun run_;
  ChildProcess process_;
};

}  // namespace evalcts
