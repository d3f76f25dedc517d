// Helpers for long-running commands: signals, number of processes, and a progress line.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace evalcts::cli {

// Makes SIGINT, SIGTERM and SIGHUP set `interrupted`, and ignores SIGPIPE and SIGXFSZ, so that results are
// not lost if nobody reads the output.
void stop_when_asked();

// Returns true if standard output is a terminal and NO_COLOR is not set.
bool shows_colour();

// Size of the terminal to which a descriptor refers; 0 and 0 if it does not refer to a terminal.
struct ScreenSize {
  std::size_t lines = 0, columns = 0;
};
ScreenSize screen_of(int descriptor);

// Returns "1:07" or "2:03:04".
std::string clock_time(double seconds);

// Progress with rate and estimated time remaining: "1234 of 5304, 61 a second, 1:07 left".
class Pace {
 public:
  std::string at(std::size_t done, std::size_t total);

 private:
  std::optional<std::chrono::steady_clock::time_point> begin_;
  std::size_t done_before_ = 0;
};

// Returns the default number of parallel processes: that of the cores that this process may use, but
// at most 8.
int usual_jobs();

// A line on standard error, only on terminals, that shows the progress of all parallel tasks
// and is overwritten.
class ProgressLine {
 public:
  // If `quiet`, no line is shown.
  explicit ProgressLine(bool quiet = false) : terminal_(!quiet && on_terminal()) {}
  // Sets the state of the task called `name`.
  void show(const std::string& name, const std::string& state);
  // Erases the progress line and prints complete lines to standard output.
  void print(const std::string& text);

 private:
  const bool terminal_;
  static bool on_terminal();
  std::mutex mutex_;
  std::map<std::string, std::string> state_;
};

}  // namespace evalcts::cli
