// Implements XServer: a guardian process starts Xvfb, and ends it when this process ends or no longer needs
// it.
#include "x_server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <string_view>
#include <vector>

#include <evalcts/backends/implementation.h>

namespace evalcts {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::milliseconds kStart{25000}, kOwnEnd{1000}, kEnd{5000};
constexpr int kNoProgram = 127;

std::string text_of(int file) {
  std::array<char, 4096> text{};
  const ssize_t length = pread(file, text.data(), text.size(), 0);
  return {text.data(), length > 0 ? static_cast<std::size_t>(length) : 0};
}

// Reads a line from the pipe. Returns an empty string if none arrives in time.
std::string line_from(int pipe) {
  std::string line;
  const auto deadline = steady_clock::now() + kStart;
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - steady_clock::now()).count();
    pollfd events{pipe, POLLIN, 0};
    const int ready = left > 0 ? poll(&events, 1, static_cast<int>(left)) : 0;
    if (ready < 0 && errno == EINTR) continue;
    char c = 0;
    if (ready <= 0 || read(pipe, &c, 1) != 1) return {};
    if (c == '\n') return line;
    line += c;
  }
}

// The functions below run between fork and exec, or without exec, and use only async-signal-safe calls.

[[noreturn]] void become_server(char* const* command, char* const* environment, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execvpe(command[0], command, environment);
  _exit(kNoProgram);
}

// Runs the guardian, a process between suite and server, which ends the server when the suite ends. A
// server in an endless loop, which clients can cause, ignores SIGTERM and does not remove its socket when
// it is killed.
[[noreturn]] void become_guardian(char* const* command, char* const* environment, pid_t parent, int input,
                                  int log, const int* number) {
  // The guardian has its own session, so that neither Ctrl-C nor the kill of a hung suite reaches it.
  setsid();
  sigset_t told;
  sigemptyset(&told);
  sigaddset(&told, SIGTERM);
  sigaddset(&told, SIGCHLD);
  sigprocmask(SIG_BLOCK, &told, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(0);
  dup2(input, STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  const pid_t own = getpid();
  const pid_t server = fork();
  if (server == 0) become_server(command, environment, own);
  close_range(STDERR_FILENO + 1, ~0u, 0);

  int status = 0;
  const timespec patience{1, 0};
  bool asked = server < 0;
  while (server > 0 && waitpid(server, &status, WNOHANG) != server) {
    const int signal = asked ? sigtimedwait(&told, nullptr, &patience) : sigwaitinfo(&told, nullptr);
    if (signal == SIGTERM) {
      kill(server, SIGTERM);
      asked = true;
    } else if (signal < 0 && errno == EAGAIN) {
      kill(server, SIGKILL);
      waitpid(server, &status, 0);
      char socket[64];
      snprintf(socket, sizeof socket, "/tmp/.X11-unix/X%d", *number);
      if (*number >= 0) unlink(socket);
      _exit(0);
    }
  }
  _exit(WIFEXITED(status) ? WEXITSTATUS(status) : 1);
}

}  // namespace

XServer::XServer(const std::string& preload) {
  int answer[2] = {-1, -1};
  const int input = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  log_ = memfd_create("xvfb", MFD_CLOEXEC);
  void* const shared =
      mmap(nullptr, sizeof *number_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (log_ < 0 || input < 0 || shared == MAP_FAILED || pipe2(answer, 0) != 0)
    throw CannotStart(fmt::format("cannot start Xvfb: {}", std::strerror(errno)));
  number_ = new (shared) int(-1);
  fcntl(answer[0], F_SETFD, FD_CLOEXEC);

  const std::string descriptor = std::to_string(answer[1]);
  std::vector<const char*> command = {
      "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "64x64x24", "-nolisten",
      "tcp",  "+iglx",      "-terminate",       nullptr};
  const std::string preloaded = "LD_PRELOAD=" + preload;
  std::vector<char*> environment;
  for (char** variable = environ; *variable; ++variable)
    if (preload.empty() || !std::string_view(*variable).starts_with("LD_PRELOAD="))
      environment.push_back(*variable);
  if (!preload.empty()) environment.push_back(const_cast<char*>(preloaded.c_str()));
  environment.push_back(nullptr);

  const pid_t parent = getpid();
  guardian_ = fork();
  if (guardian_ == 0)
    become_guardian(const_cast<char* const*>(command.data()), environment.data(), parent, input, log_,
                    number_);
  close(input);
  close(answer[1]);
  const std::string number = guardian_ > 0 ? line_from(answer[0]) : "";
  close(answer[0]);
  if (number.empty()) throw CannotStart(end());
  display_ = ":" + number;
  *number_ = std::stoi(number);
}

XServer::~XServer() { end(); }

// Ends the server. Returns the reason if it did not start.
std::string XServer::end() {
  std::string reason = "no process can be started for Xvfb";
  if (guardian_ > 0) {
    int status = 0;
    bool ended = false;
    const auto wait = [&](std::chrono::milliseconds time) {
      for (const auto deadline = steady_clock::now() + time; !ended && steady_clock::now() < deadline;) {
        ended = waitpid(guardian_, &status, WNOHANG) == guardian_;
        if (!ended) poll(nullptr, 0, 5);
      }
    };
    if (display_.empty()) wait(kOwnEnd);
    reason = ended && WIFEXITED(status) && WEXITSTATUS(status) == kNoProgram
                 ? "Xvfb is not installed (package xvfb)"
                 : fmt::format("Xvfb does not start: {}", text_of(log_));
    if (!ended) kill(guardian_, SIGTERM);
    wait(kEnd);
    if (!ended) {
      kill(guardian_, SIGKILL);
      waitpid(guardian_, &status, 0);
    }
  }
  guardian_ = -1;
  munmap(number_, sizeof *number_);
  if (log_ >= 0) close(log_);
  log_ = -1;
  return reason;
}

}  // namespace evalcts
