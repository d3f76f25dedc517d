// Starts child processes in process groups of their own, and kills them with all their descendants.
#include <evalcts/runner/child_process.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string_view>
#include <thread>

extern char** environ;

namespace evalcts {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPollSeconds = 0.02;  // interval of polling on kernels without pidfd_open (before 5.3)
constexpr std::chrono::seconds kMostToEndOrphans(3);  // after SIGTERM

// The children that a ChildProcess waits for.
std::mutex children_mutex;
std::set<pid_t> children_in_care;
bool adopting = false;

// Ends adopted orphans until no new ones appear. Asks them first, because the guardian of an X server
// (backends/x_server.cpp) has to end the server and to remove its socket. The caller must hold
// `children_mutex`.
void end_orphans() {
  const auto deadline = Clock::now() + kMostToEndOrphans;
  std::set<pid_t> asked;
  for (bool found = true; found;) {
    found = false;
    std::error_code error;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", error)) {
      std::ifstream file(task.path() / "children");
      for (pid_t child = 0; file >> child;) {
        if (children_in_care.contains(child)) continue;
        const bool is_over = Clock::now() > deadline;
        if (is_over || asked.insert(child).second) ::kill(child, is_over ? SIGKILL : SIGTERM);
        found = waitpid(child, nullptr, is_over ? 0 : WNOHANG) >= 0 || found;
      }
    }
    if (found) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

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

std::uint64_t resident_memory(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/statm");
  std::uint64_t size = 0, resident = 0;
  file >> size >> resident;
  return file ? resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

void adopt_orphans() {
  const std::lock_guard lock(children_mutex);
  adopting = prctl(PR_SET_CHILD_SUBREAPER, 1) == 0;
}

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::string& log, Prints prints,
                           int input, int output) {
  if (prints == Prints::kLimited && !log.empty()) output_.emplace(log);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (input >= 0)
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  else
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  if (output_) {
    posix_spawn_file_actions_adddup2(&actions, output_->writer(), STDOUT_FILENO);
  } else {
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.empty() ? "/dev/null" : log.c_str(),
                                     O_WRONLY | O_CREAT | O_APPEND, 0644);
  }
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  if (output >= 0) posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);

  // The child gets its own process group, so that Ctrl-C reaches only the runner, which decides when to kill
  // the child. Signals that the runner ignores get their default action back.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setpgroup(&attributes, 0);
  sigset_t signals;
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  for (const int signal : {SIGPIPE, SIGXFSZ}) sigaddset(&signals, signal);
  posix_spawnattr_setsigdefault(&attributes, &signals);

  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  int error = 0;
  {
    const std::lock_guard lock(children_mutex);
    error = posix_spawn(&id_, command.front().c_str(), &actions, &attributes, arguments.data(), environ);
    if (error == 0) children_in_care.insert(id_);
  }
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0)
    throw CannotSpawn(fmt::format("cannot start '{}': {}", command.front(), std::strerror(error)));
  if (output_) output_->close_writer();
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
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  for (double left = seconds; !has_ended();
       left = std::chrono::duration<double>(end - Clock::now()).count()) {
    if (output_) output_->take();
    if (left <= 0) return std::nullopt;
    wait_for_activity(left);
  }
  reap();
  if (output_) output_->finish();
  return ending_;
}

std::vector<int> ChildProcess::readable_descriptors() const {
  return {descriptor_, output_ ? output_->reader() : -1};
}

// Waits until the process prints or ends, for at most `seconds`.
void ChildProcess::wait_for_activity(double seconds) const {
  std::vector<pollfd> events;
  for (const int descriptor : readable_descriptors()) events.push_back({descriptor, POLLIN, 0});
  poll(events.data(), events.size(),
       static_cast<int>((descriptor_ < 0 ? std::min(seconds, kPollSeconds) : seconds) * 1000));
}

bool ChildProcess::has_ended() const {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == id_;
}

// Collects the exit status. The group is killed first, because its id may be reused after waitpid().
void ChildProcess::reap() {
  const std::lock_guard lock(children_mutex);
  ::kill(-id_, SIGKILL);
  int status = 0;
  waitpid(id_, &status, 0);
  children_in_care.erase(id_);
  ending_ = WIFSIGNALED(status) ? Ending{true, WTERMSIG(status)} : Ending{false, WEXITSTATUS(status)};
  if (adopting) end_orphans();
}

void ChildProcess::kill() {
  if (ending_) return;
  ::kill(-id_, SIGKILL);
  ::kill(id_, SIGKILL);  // the process may have moved to another group
}

void ChildProcess::abort() {
  if (!ending_) ::kill(id_, SIGABRT);
}

}  // namespace evalcts
