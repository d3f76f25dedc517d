#include "harness/runner/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string_view>

extern char** environ;

namespace evalcts {

std::string describe(const Ending& ending) {
  if (!ending.signalled) return fmt::format("exit code {}", ending.value);
  const char* const name = sigabbrev_np(ending.value);
  const char* const what = sigdescr_np(ending.value);
  return fmt::format("signal {} (SIG{}, {})", ending.value, name ? name : "?", what ? what : "unknown");
}

std::string shell_line(const std::vector<std::string>& command) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./:=,+-@%";
  std::string line;
  for (const std::string& word : command) {
    if (!line.empty()) line += ' ';
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::string& log) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.empty() ? "/dev/null" : log.c_str(),
                                   O_WRONLY | O_CREAT | O_APPEND, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);

  // A group of its own: Ctrl-C reaches the runner, which decides what becomes of the child.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);

  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const int error =
      posix_spawn(&id_, command.front().c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0)
    throw std::runtime_error(fmt::format("cannot start '{}': {}", command.front(), std::strerror(error)));
  descriptor_ = static_cast<int>(syscall(SYS_pidfd_open, id_, 0));
}

ChildProcess::~ChildProcess() {
  if (!ending_) {
    kill();
    wait(5);
  }
  if (descriptor_ >= 0) close(descriptor_);
}

std::optional<Ending> ChildProcess::wait(double seconds) {
  if (ending_) return ending_;
  const int milliseconds = static_cast<int>(seconds * 1000);
  if (descriptor_ >= 0) {
    pollfd events{descriptor_, POLLIN, 0};
    poll(&events, 1, milliseconds);
  } else {
    poll(nullptr, 0, milliseconds);  // a kernel before 5.3: look now and then
  }
  int status = 0;
  if (waitpid(id_, &status, WNOHANG) != id_) return std::nullopt;
  ending_ = WIFSIGNALED(status) ? Ending{true, WTERMSIG(status)} : Ending{false, WEXITSTATUS(status)};
  return ending_;
}

void ChildProcess::kill() {
  if (!ending_) ::kill(-id_, SIGKILL);
}

}  // namespace evalcts
