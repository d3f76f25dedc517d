// Starts a child process that runs another program and writes its output to a log.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/runner/output_log.h>

namespace evalcts {

// The exit status of a process, or the signal that ended it.
struct Ending {
  bool signalled = false;
  int value = 0;  // exit status or signal
};
// Returns "exit code 3", "signal 11 (SIGSEGV, segmentation fault)".
std::string describe(const Ending& ending);

// Returns a command as one line for a POSIX shell.
std::string shell_line(const std::vector<std::string>& command);

// Returns the resident memory of a process in bytes; 0 if it is not known.
std::uint64_t resident_memory(pid_t process);

// Makes this process adopt the orphans of its children, in any session. When a child ends, they get SIGTERM,
// and those that go on are killed after a few seconds.
void adopt_orphans();

struct CannotSpawn : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class ChildProcess {
 public:
  // Amount of output that the log keeps: everything, or at most kMostPrinted bytes per test (output_log.h).
  enum class Prints { kUnlimited, kLimited };

  // Starts the program command[0], a path. Standard input is `input`, a descriptor; negative: it is empty.
  // Standard output and error are appended to `log` (empty: discarded); only standard error, if standard
  // output is `output`, a descriptor. Throws CannotSpawn.
  ChildProcess(const std::vector<std::string>& command, const std::string& log,
               Prints prints = Prints::kUnlimited, int input = -1, int output = -1);
  // Kills the process if it is still running.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t id() const { return id_; }
  // Waits up to `seconds` for the end of the process; empty if it is still running then. When the process has
  // ended, the remaining processes of its group are killed.
  std::optional<Ending> wait(double seconds);
  // Returns the descriptors, for poll(), that become readable when the process prints or ends. Negative ones
  // stand for nothing.
  std::vector<int> readable_descriptors() const;
  void kill();
  // Sends SIGABRT to the process, which may report where it is before it ends.
  void abort();

  // Returns resident_memory() of the process.
  std::uint64_t memory() const { return resident_memory(id_); }
  // Returns the first lines of limited output, see OutputLog::first_lines.
  std::string printed() const { return output_ ? output_->first_lines() : std::string(); }

 private:
  bool has_ended() const;
  void wait_for_activity(double seconds) const;
  void reap();

  pid_t id_ = -1;
  int descriptor_ = -1;              // becomes readable when the process ends (pidfd_open)
  std::optional<OutputLog> output_;  // only if the output is limited
  std::optional<Ending> ending_;
};

}  // namespace evalcts
