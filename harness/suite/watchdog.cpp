// Implements the watchdog: a thread that counts the lines of the event file.
#include "watchdog.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <evalcts/results/serialization.h>
#include "crash_report.h"

namespace evalcts {
namespace {

constexpr std::chrono::milliseconds kInterval(100);

std::atomic<bool> is_working_now = false;

}  // namespace

void set_working(bool is_working) { is_working_now = is_working; }

void end_if_hanging(const EventFile& events, double seconds) {
  std::thread([&events, seconds] {
    using Clock = std::chrono::steady_clock;
    Clock::time_point since = Clock::now();
    for (std::uint64_t lines = 0;; std::this_thread::sleep_for(kInterval)) {
      if (events.lines() != lines || !is_working_now) since = Clock::now();
      lines = events.lines();
      if (std::chrono::duration<double>(Clock::now() - since).count() < seconds) continue;
      events.write_in_handler(to_line(Hung{}));
      end_hanging_job();
    }
  }).detach();
}

}  // namespace evalcts
