// Implements the watchdog: a thread that counts the lines of the event file.
#include "watchdog.h"

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include <evalcts/results/serialization.h>

namespace evalcts {
namespace {

constexpr std::chrono::milliseconds kInterval(100);
constexpr std::chrono::seconds kMostToReport(1);  // time for the handler of SIGABRT
constexpr int kHung = 124;                        // exit status if that handler does not end the process

std::atomic<bool> is_working_now = false;

}  // namespace

void set_working(bool is_working) { is_working_now = is_working; }

void end_if_hanging(const EventFile& events, double seconds) {
  std::thread([&events, seconds, worker = pthread_self()] {
    using Clock = std::chrono::steady_clock;
    Clock::time_point since = Clock::now();
    for (std::uint64_t lines = 0;; std::this_thread::sleep_for(kInterval)) {
      if (events.lines() != lines || !is_working_now) since = Clock::now();
      lines = events.lines();
      if (std::chrono::duration<double>(Clock::now() - since).count() < seconds) continue;
      events.write_in_handler(to_line(Hung{}));
      pthread_kill(worker, SIGABRT);  // the handler reports the command in flight
      std::this_thread::sleep_for(kMostToReport);
      _exit(kHung);
    }
  }).detach();
}

}  // namespace evalcts
