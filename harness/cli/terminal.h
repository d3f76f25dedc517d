// What the subcommands that run things share: signals, cores, a line of progress.
#pragma once

#include <map>
#include <mutex>
#include <string>

namespace evalcts::cli {

// From now on SIGINT, SIGTERM and SIGHUP set `interrupted`.
void stop_when_asked();

// As many processes as there are cores for this one, within reason.
int usual_jobs();

// One line that is written over, on terminals only, with the progress of all that run side by side.
class ProgressLine {
 public:
  void show(const std::string& name, const std::string& state);
  // Prints whole lines without the progress line getting in between.
  void print(const std::string& text);

 private:
  bool terminal_ = on_terminal();
  static bool on_terminal();
  std::mutex mutex_;
  std::map<std::string, std::string> state_;
};

}  // namespace evalcts::cli
