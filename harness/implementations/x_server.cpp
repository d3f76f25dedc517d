#include "harness/implementations/x_server.h"

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
#include <cstring>
#include <string_view>
#include <vector>

#include "harness/implementations/implementation.h"

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

// A line of it, empty where nothing comes in time.
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

// In the child, between fork and exec: only what is safe there.
[[noreturn]] void become(char* const* command, char* const* environment, pid_t parent, int input, int log) {
  // A group of its own: neither Ctrl-C nor the killing of a hung suite hits the server itself, which then
  // removes its lock and socket.
  setsid();
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  dup2(input, STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  execvpe(command[0], command, environment);
  _exit(kNoProgram);
}

}  // namespace

XServer::XServer(const std::string& preload) {
  int answer[2] = {-1, -1};
  const int input = open("/dev/null", O_RDONLY | O_CLOEXEC);
  log_ = memfd_create("xvfb", MFD_CLOEXEC);
  if (log_ < 0 || input < 0 || pipe2(answer, 0) != 0)
    throw CannotStart(fmt::format("no Xvfb can be started: {}", std::strerror(errno)));
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
  process_ = fork();
  if (process_ == 0)
    become(const_cast<char* const*>(command.data()), environment.data(), parent, input, log_);
  close(input);
  close(answer[1]);
  const std::string number = process_ > 0 ? line_from(answer[0]) : "";
  close(answer[0]);
  if (number.empty()) throw CannotStart(end());
  display_ = ":" + number;
}

XServer::~XServer() { end(); }

// Says why it did not start, where it did not.
std::string XServer::end() {
  std::string reason = "no process can be started for Xvfb";
  if (process_ > 0) {
    int status = 0;
    bool ended = false;
    const auto wait = [&](std::chrono::milliseconds time) {
      for (const auto deadline = steady_clock::now() + time; !ended && steady_clock::now() < deadline;) {
        ended = waitpid(process_, &status, WNOHANG) == process_;
        if (!ended) poll(nullptr, 0, 5);
      }
    };
    if (display_.empty()) wait(kOwnEnd);
    reason = ended && WIFEXITED(status) && WEXITSTATUS(status) == kNoProgram
                 ? "Xvfb is not installed (package xvfb)"
                 : fmt::format("Xvfb does not start: {}", text_of(log_));
    if (!ended) kill(process_, SIGTERM);
    wait(kEnd);
    if (!ended) {
      kill(process_, SIGKILL);
      waitpid(process_, &status, 0);
    }
  }
  process_ = -1;
  if (log_ >= 0) close(log_);
  log_ = -1;
  return reason;
}

}  // namespace evalcts
