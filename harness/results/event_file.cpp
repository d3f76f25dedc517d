// Implements EventFile. Before each line, it checks that the descriptor still refers to the file or pipe.
#include <evalcts/results/event_file.h>

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include <evalcts/results/files.h>
#include "posix.h"

namespace evalcts {

EventFile::EventFile(const std::filesystem::path& path) : process_(getpid()) {
  if (path.empty()) return;
  path_ = std::filesystem::absolute(path).string();
  open();
}

EventFile::EventFile(int descriptor) : descriptor_(descriptor), process_(getpid()) { identify(); }

EventFile::~EventFile() {
  if (is_open()) close(descriptor_);
}

void EventFile::open() {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  identify();
}

void EventFile::identify() {
  struct stat file {};
  if (descriptor_ < 0 || fstat(descriptor_, &file) != 0)
    throw CannotWrite(fmt::format("cannot write '{}': {}", path_, std::strerror(errno)));
  device_ = file.st_dev;
  inode_ = file.st_ino;
}

// True if the descriptor still refers to this file. A library may have closed it, and another file may have
// been opened under the same number.
bool EventFile::is_open() const {
  struct stat file {};
  return descriptor_ >= 0 && fstat(descriptor_, &file) == 0 && file.st_dev == device_ &&
         file.st_ino == inode_;
}

void EventFile::write_in_handler(std::string_view line) const noexcept {
  if (descriptor_ < 0 || getpid() != process_) return;
  if (path_.empty() && !is_open()) return;
  const int descriptor = is_open() ? descriptor_ : ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor < 0) return;
  [[maybe_unused]] const ssize_t written = ::write(descriptor, line.data(), line.size());
}

void EventFile::write(const std::string& line) {
  if (path_.empty() && descriptor_ < 0) return;
  if (getpid() != process_) _exit(0);
  ++lines_;
  if (!is_open()) {
    if (path_.empty()) _exit(kExitCannotWrite);
    was_closed_ = true;
    open();
  }
  std::string_view rest = line;
  ssize_t written = 0;
  while (!rest.empty()) {
    written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  if (rest.empty()) return;
  const std::string words =
      kCannotWriteEvent + std::string(std::strerror(written < 0 ? errno : ENOSPC)) + "\n";
  [[maybe_unused]] const ssize_t said = ::write(STDERR_FILENO, words.data(), words.size());
  _exit(kExitCannotWrite);
}

}  // namespace evalcts
