// Installs the signal handlers that write the crash event. They allocate no memory.
#include "crash_report.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <pthread.h>
#include <sys/types.h>
#include <ucontext.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "crash_line.h"

namespace evalcts {
namespace {

constexpr std::array kSignals = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr std::size_t kMostFrames = 8;      // number of reported frames
constexpr std::size_t kMostUnwound = 64;    // number of unwound frames, including those of the handler
constexpr std::size_t kStack = 128 * 1024;  // bytes of the handler's own stack, for stack overflows
constexpr std::string_view kLibraryOfRaise = "libc.so";

const EventFile* events_of_process = nullptr;
pthread_t worker;  // the thread that runs jobs
std::array<struct sigaction, kSignals.size()> earlier_actions;
alignas(16) std::array<std::byte, kStack> handler_stack;

std::string_view file_name(const char* path) {
  const std::string_view whole = path ? path : "";
  return whole.substr(whole.rfind('/') + 1);
}

std::uintptr_t interrupted_address(const ucontext_t& context) {
#if defined(__x86_64__)
  return static_cast<std::uintptr_t>(context.uc_mcontext.gregs[REG_RIP]);
#elif defined(__aarch64__)
  return context.uc_mcontext.pc;
#else
  return 0;
#endif
}

// Returns the return address of a call that has just been executed.
std::uintptr_t return_address(const ucontext_t& context) {
#if defined(__x86_64__)
  // NOLINTNEXTLINE(performance-no-int-to-ptr)
  return *reinterpret_cast<const std::uintptr_t*>(context.uc_mcontext.gregs[REG_RSP]);
#elif defined(__aarch64__)
  return context.uc_mcontext.regs[30];
#else
  return 0;
#endif
}

// Adds "libGL.so.1 glGetMapiv+0x2c", or "libGL.so.1+0x5d2c" in a function that is not exported.
void add_frame(CrashLine& line, std::uintptr_t address, const Dl_info& info) {
  line.add_frame(
      file_name(info.dli_fname), info.dli_sname ? info.dli_sname : "",
      address - reinterpret_cast<std::uintptr_t>(info.dli_sname ? info.dli_saddr : info.dli_fbase));
}

void add_frames(CrashLine& line, const siginfo_t& signal, const ucontext_t& context) {
  std::array<void*, kMostUnwound> unwound{};
  auto count = static_cast<std::size_t>(backtrace(unwound.data(), static_cast<int>(unwound.size())));
  const std::uintptr_t interrupted = interrupted_address(context);
  std::size_t at = 0;
  while (at < count && reinterpret_cast<std::uintptr_t>(unwound[at]) != interrupted) ++at;
  Dl_info info{};
  if (at == count || dladdr(unwound[at], &info) == 0) {
    // The library called an address without code, so the caller is the innermost meaningful frame.
    unwound[0] = reinterpret_cast<void*>(return_address(context));  // NOLINT(performance-no-int-to-ptr)
    at = 0;
    count = 1;
  }
  Dl_info own{};
  dladdr(reinterpret_cast<void*>(&report_crashes), &own);
  const bool was_raised = signal.si_code <= 0;
  std::size_t written = 0;
  bool left_library = false;
  for (const std::size_t innermost = at; at < count && written < kMostFrames && !left_library; ++at) {
    // If a call is the last instruction of a function, the return address lies after the function.
    const auto address = reinterpret_cast<std::uintptr_t>(unwound[at]) - (at == innermost ? 0 : 1);
    info = {};
    dladdr(reinterpret_cast<void*>(address), &info);  // NOLINT(performance-no-int-to-ptr)
    if (was_raised && written == 0 && at + 1 < count &&
        file_name(info.dli_fname).starts_with(kLibraryOfRaise))
      continue;  // frames of raise() and abort() do not show the root cause
    left_library = written > 0 && info.dli_fbase == own.dli_fbase;
    if (left_library) break;
    add_frame(line, address, info);
    ++written;
  }
}

void handle(int signal, siginfo_t* details, void* context) {
  CrashLine line;
  add_frames(line, *details, *static_cast<const ucontext_t*>(context));
  events_of_process->write_in_handler(line.finish());
  // The earlier action runs when the handler returns: the faulting instruction is executed again, or raise()
  // sends the signal again.
  for (std::size_t i = 0; i < kSignals.size(); ++i)
    if (kSignals[i] == signal) sigaction(signal, &earlier_actions[i], nullptr);
  if (details->si_code <= 0) raise(signal);
}

}  // namespace

void report_crashes(const EventFile& events) {
  events_of_process = &events;
  // The first call of this function loads a library, which is not allowed in a signal handler.
  void* unused = nullptr;
  backtrace(&unused, 1);
  CrashLine::prepare();
  stack_t stack{};
  stack.ss_sp = handler_stack.data();
  stack.ss_size = handler_stack.size();
  sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_sigaction = handle;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &action, &earlier_actions[i]);
  worker = pthread_self();
}

void end_hanging_job() {
  constexpr int kHung = 124, kMostSecondsToReport = 1;
  pthread_kill(worker, SIGABRT);
  sleep(kMostSecondsToReport);
  _exit(kHung);
}

}  // namespace evalcts
