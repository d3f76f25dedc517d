// The suite program as a child that runs a list of tests: what it reports while it runs, and how it ends.
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

// The tests of one child, and their records.
struct ChildRun {
  std::map<std::string, TestRecord> records;
  std::vector<std::string> finished;                      // in the order in which they ran
  std::string in_flight;                                  // the test that the child died in
  std::optional<CaseStarted> last_case;                   // of that test, where cases were traced
  std::optional<Crash> crash;                             // of that test, as the child could report it
  std::map<std::string, std::vector<std::string>> cases;  // the identities of each test's, where traced
  bool hung = false;
  bool over_memory = false;  // it took more memory than it may
  bool cut_short = false;    // by the end of the time for a search
  bool complete = false;
  std::string cannot_write;  // why it could not report what it had found; empty if it could
  Ending ending;
};

// Time and memory after which a library counts as one that never stops: far more than any GL needs for a
// test.
struct Limits {
  double seconds_per_test = 60;
  std::uint64_t memory = std::uint64_t{4096} << 20;  // bytes of a process
};

// Returns how the child ended: "no answer within 60 seconds", "it took more than 4096 MiB of memory", "the
// process ended with ... in glEnd(), after 12 commands, at libGL.so.1 glEnd+0x2c".
std::string describe(const ChildRun& run, const Limits& limits);

class SuiteChild {
 public:
  using Deadline = std::optional<std::chrono::steady_clock::time_point>;

  // `command` writes its events to the file `events`, which grows from nothing, and all else to `log`, which
  // keeps kMostPrinted of each test. Without an event for so many seconds it counts as hung; then, and beyond
  // its memory, it is killed. Throws std::runtime_error.
  SuiteChild(const std::vector<std::string>& command, const std::filesystem::path& events,
             const std::filesystem::path& log, const Limits& limits);

  // Waits up to `seconds` and takes in what was reported since; `each` is called with each event,
  // once it is in run(). The child is killed when a signal has interrupted the run, and at the deadline. True
  // once it has ended, all events taken in.
  bool look(double seconds, const Deadline& deadline = {},
            const std::function<void(const Event& event)>& each = {});

  const ChildRun& run() const { return run_; }

 private:
  void take(const Event& event);

  std::filesystem::path events_;
  std::streamoff read_ = 0;
  Limits limits_;
  std::chrono::steady_clock::time_point latest_event_ = std::chrono::steady_clock::now();
  ChildRun run_;
  ChildProcess process_;
};

}  // namespace evalcts
