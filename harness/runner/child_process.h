// A child process: started by fork and exec (never fork alone once a context may exist), its output in a log.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace evalcts {

// How a process ended.
struct Ending {
  bool signalled = false;
  int value = 0;  // exit status or signal
};
// "exit code 3", "signal 11 (SIGSEGV, segmentation fault)".
std::string describe(const Ending& ending);

// A command as one line for a POSIX shell.
std::string shell_line(const std::vector<std::string>& command);

class ChildProcess {
 public:
  // Standard input is empty; standard output and error are appended to `log` (empty: thrown away). Throws
  // std::runtime_error.
  ChildProcess(const std::vector<std::string>& command, const std::string& log);
  // Kills it if it still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t id() const { return id_; }
  // Waits up to `seconds`; empty if it still runs then.
  std::optional<Ending> wait(double seconds);
  void kill();

 private:
  pid_t id_ = -1;
  int descriptor_ = -1;  // readable once the process has ended
  std::optional<Ending> ending_;
};

}  // namespace evalcts
