// Defines misbehaviours of a library towards its process, by name. The ids of processes that hang or were
// started are appended to EVALCTS_DRILL_FILE.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cfenv>
#include <clocale>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <thread>

namespace misbehaviours {

inline void crash() {
#ifdef __SANITIZE_ADDRESS__
  signal(SIGSEGV, SIG_DFL);  // otherwise sanitizers would turn the signal into an exit code
#endif
  raise(SIGSEGV);
}

[[noreturn]] inline void wait_for_ever() {
  for (;;) pause();
}

// Allocates and uses 4 MB.
inline void lose_memory() {
  constexpr std::size_t kSize = 4'000'000;
  auto* const memory = static_cast<volatile char*>(std::malloc(kSize));
  if (!memory) wait_for_ever();
  for (std::size_t i = 0; i < kSize; i += 1024) memory[i] = 1;
}

inline void eat_memory() {
  for (;;) lose_memory();
}

inline void print_megabytes(int count) {
  static const std::string kLine(1023, '.');
  for (int i = 0; i != count * 1024; ++i) std::puts(kLine.c_str());
  std::fflush(stdout);
}

// The pauses leave the processor to other tests.
[[noreturn]] inline void print_for_ever() {
  for (;;) {
    print_megabytes(1);
    usleep(10'000);
  }
}

inline void close_descriptors() {
  for (int descriptor = 0; descriptor < 1024; ++descriptor) close(descriptor);
}

// Closes all descriptors and reuses their numbers for another file.
inline void close_descriptors_and_open() {
  close_descriptors();
  for (int i = 0; i < 32; ++i) {
    [[maybe_unused]] const int taken = open("/dev/null", O_RDWR);
  }
}

inline void ignore_signals_and_hang() {
  for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_IGN);
  wait_for_ever();
}

// Installs a handler that returns to the failing instruction, so that the process never ends. The pauses
// leave the processor to other tests.
inline void handle_crash_and_go_on() {
  std::signal(SIGSEGV, [](int) { usleep(10'000); });
  volatile std::uintptr_t nowhere = 64;
  *reinterpret_cast<volatile int*>(nowhere) = 1;  // NOLINT(performance-no-int-to-ptr): nowhere on purpose
}

inline void crash_in_thread() {
  std::thread(crash).detach();
  wait_for_ever();
}

inline void leave_thread() {
  std::thread([] { wait_for_ever(); }).detach();
  static std::atomic<bool> enough = false;
  std::thread([] {
    while (!enough) continue;
  }).detach();
}

inline void corrupt_heap() {
  auto* const small = static_cast<volatile char*>(std::malloc(24));
  auto* const next = static_cast<char*>(std::malloc(24));
  for (int i = 24; i < 64; ++i) small[i] = 0x55;
  std::free(next);
  std::free(const_cast<char*>(small));
  std::free(std::malloc(5000));
  // The GNU C library does not notice every overflow at once, but it notices a double free.
  void* volatile freed = std::malloc(24);
  std::free(freed);
  std::free(freed);
}

inline void report(pid_t process) {
  if (const char* const file = std::getenv("EVALCTS_DRILL_FILE"))
    std::ofstream(file, std::ios::app) << process << "\n";
}

inline void hang() {
  report(getpid());
  wait_for_ever();
}

inline void leave_process(bool own_session) {
  const pid_t child = fork();
  if (child == 0) {
    if (own_session) setsid();
    wait_for_ever();
  }
  report(child);
}

inline void change_surroundings() {
  if (chdir("/") != 0) std::abort();
  std::setlocale(LC_ALL, "C.UTF-8");
  alarm(1);
}

inline void change_arithmetic() {
  std::fesetround(FE_UPWARD);
#ifdef __SSE__
  __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | 0x8040);  // subnormals are zero
#endif
}

inline bool misbehave(std::string_view name) {
  static const std::map<std::string_view, void (*)()> kAll = {
      {"crash", crash},
      {"abort", std::abort},
      {"exit", [] { _exit(7); }},
      {"exit-well", [] { std::exit(0); }},
      {"kill", [] { raise(SIGKILL); }},
      {"hang", hang},
      {"stop", [] { raise(SIGSTOP); }},
      {"memory", eat_memory},
      {"flood", [] { print_megabytes(20); }},
      {"endless-flood", print_for_ever},
      {"close", close_descriptors},
      {"close-and-open", close_descriptors_and_open},
      {"deaf", ignore_signals_and_hang},
      {"handler", handle_crash_and_go_on},
      {"thread", crash_in_thread},
      {"threads-stay", leave_thread},
      {"heap", corrupt_heap},
      {"process-stays", [] { leave_process(false); }},
      {"daemon", [] { leave_process(true); }},
      {"fork-goes-on", [] { [[maybe_unused]] const pid_t child = fork(); }},
      {"surroundings", change_surroundings},
      {"arithmetic", change_arithmetic},
      {"at-exit", [] { std::atexit([] { wait_for_ever(); }); }}};
  const auto found = kAll.find(name);
  if (found == kAll.end()) return false;
  found->second();
  return true;
}

}  // namespace misbehaviours
