// A child process: started by fork and exec (never fork alone once a context may exist), its output in a log.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/runner/output_log.h>

namespace evalcts {

// The end of a process, by exit or by signal.
struct Ending {
  bool signalled = false;
  int value = 0;  // exit status or signal
};
// "exit code 3", "signal 11 (SIGSEGV, segmentation fault)".
std::string describe(const Ending& ending);

// A command as one line for a POSIX shell.
std::string shell_line(const std::vector<std::string>& command);

// From now on this process is the parent of whatever its children leave behind, in whatever session: that is
// killed when the child ends.
void adopt_what_children_leave();

class ChildProcess {
 public:
  // Keeps all that the process prints, or no more than kMostPrinted.
  enum class Prints { kUnlimited, kLimited };

  // Standard input is empty; standard output and error are appended to `log` (empty: thrown away). Throws
  // std::runtime_error.
  ChildProcess(const std::vector<std::string>& command, const std::string& log,
               Prints prints = Prints::kUnlimited);
  // Kills it if it still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t id() const { return id_; }
  // Waits up to `seconds`; empty if it still runs then. Processes of its group that it leaves behind are
  // killed.
  std::optional<Ending> wait(double seconds);
  void kill();

  // Bytes of memory that are its own or shared, and in use; 0 where that is not known.
  std::uint64_t memory() const;
  // The latest line of a limited output that begins with "evalcts: ".
  std::string own_words() const { return output_ ? output_->own_words() : std::string(); }
  // The first lines of limited output, see OutputLog::beginning.
  std::string printed() const { return output_ ? output_->beginning() : std::string(); }

 private:
  bool has_ended() const;
  void wait_for_news(double seconds) const;
  void reap();

  pid_t id_ = -1;
  int descriptor_ = -1;              // readable once the process has ended
  std::optional<OutputLog> output_;  // where it is limited
  std::optional<Ending> ending_;
};

}  // namespace evalcts
