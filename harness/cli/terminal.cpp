// Implements the signal handlers, the number of parallel processes and the progress line of long-running
// commands.
#include <evalcts/cli/terminal.h>

#include <fmt/format.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <iostream>

#include <evalcts/runner/interruption.h>

namespace evalcts::cli {

namespace {
constexpr int kMostUsualJobs = 8;
constexpr std::size_t kUsualColumns = 80;
constexpr double kFirstEstimate = 2;  // seconds until the first estimate
}  // namespace

void stop_when_asked() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = true; };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

bool shows_colour() {
  const char* const no_colour = std::getenv("NO_COLOR");
  return isatty(STDOUT_FILENO) && !(no_colour && *no_colour);
}

ScreenSize screen_of(int descriptor) {
  winsize size{};
  if (!isatty(descriptor) || ioctl(descriptor, TIOCGWINSZ, &size) != 0) return {};
  return {size.ws_row, size.ws_col};
}

std::string clock_time(double seconds) {
  const auto whole = static_cast<std::uint64_t>(std::llround(std::max(seconds, 0.0)));
  const std::uint64_t hours = whole / 3600, minutes = whole / 60 % 60;
  return hours ? fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60)
               : fmt::format("{}:{:02}", minutes, whole % 60);
}

std::string Pace::at(std::size_t done, std::size_t total) {
  const auto now = std::chrono::steady_clock::now();
  if (!begin_) {
    begin_ = now;
    done_before_ = done;
  }
  std::string text = fmt::format("{} of {}", done, total);
  const double seconds = std::chrono::duration<double>(now - *begin_).count();
  if (seconds < kFirstEstimate || done <= done_before_) return text;
  const double rate = static_cast<double>(done - done_before_) / seconds;
  return text + fmt::format(", {:.{}f} a second, {} left", rate, rate < 10 ? 1 : 0,
                            clock_time(static_cast<double>(total - std::min(done, total)) / rate));
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
  const std::size_t columns = screen_of(STDERR_FILENO).columns;
  line.resize(std::min(line.size(), (columns > 1 ? columns : kUsualColumns) - 1));
  std::cerr << "\r\033[K" << line << std::flush;
}

void ProgressLine::print(const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (terminal_) std::cerr << "\r\033[K" << std::flush;
  std::cout << text << std::flush;
}

}  // namespace evalcts::cli
