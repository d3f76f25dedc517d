#include "harness/cli/terminal.h"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <iostream>

#include "harness/runner/runner.h"

namespace evalcts::cli {

namespace {
constexpr int kMostUsualJobs = 8;
constexpr std::size_t kMostColumns = 99;
}  // namespace

void stop_when_asked() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = true; };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

int usual_jobs() {
  cpu_set_t cores;
  if (sched_getaffinity(0, sizeof cores, &cores) != 0) return 1;
  return std::clamp(CPU_COUNT(&cores), 1, kMostUsualJobs);
}

bool ProgressLine::on_terminal() { return isatty(STDERR_FILENO) != 0; }

void ProgressLine::show(const std::string& name, const std::string& state) {
  if (!terminal_) return;
  const std::lock_guard lock(mutex_);
  state_[name] = state;
  std::string line;
  for (const auto& [of, is] : state_) line += fmt::format("{}{}: {}", line.empty() ? "" : "   ", of, is);
  if (line.size() > kMostColumns) line.resize(kMostColumns);
  std::cerr << "\r\033[K" << line << std::flush;
}

void ProgressLine::print(const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (terminal_) std::cerr << "\r\033[K" << std::flush;
  std::cout << text << std::flush;
}

}  // namespace evalcts::cli
