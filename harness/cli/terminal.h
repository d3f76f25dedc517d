// Helpers of the commands that run things: signals, cores, a line of progress.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace evalcts::cli {

// From now on SIGINT, SIGTERM and SIGHUP set `interrupted`, and nothing is lost where nobody reads the
// output.
void stop_when_asked();

// Returns true if standard output is a terminal and NO_COLOR is not set.
bool shows_colour();

// Lines and columns of the terminal that the stream's descriptor is; 0 where it is none.
struct ScreenSize {
  std::size_t lines = 0, columns = 0;
};
ScreenSize screen_of(int descriptor);

// "1:07", "2:03:04".
std::string clock_time(double seconds);

// The pace of something: "1234 of 5304, 61 a second, 1:07 left".
class Pace {
 public:
  std::string at(std::size_t done, std::size_t total);

 private:
  std::optional<std::chrono::steady_clock::time_point> begin_;
  std::size_t done_before_ = 0;
};

// Returns the number of processes for the cores that this one may use, within reason.
int usual_jobs();

// One line that is written over, on terminals only, with the progress of all that run side by side.
class ProgressLine {
 public:
  // `quiet`: none.
  explicit ProgressLine(bool quiet = false) : terminal_(!quiet && on_terminal()) {}
  void show(const std::string& name, const std::string& state);
  // Prints whole lines without the progress line getting in between.
  void print(const std::string& text);

 private:
  const bool terminal_;
  static bool on_terminal();
  std::mutex mutex_;
  std::map<std::string, std::string> state_;
};

}  // namespace evalcts::cli
