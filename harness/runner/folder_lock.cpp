// Implements FolderLock with flock().
#include <evalcts/runner/folder_lock.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include <evalcts/results/files.h>

namespace evalcts {
namespace {

// Returns true if the descriptor still refers to the file at `path`, which the previous owner
// may have removed.
bool is_file_of(int descriptor, const std::filesystem::path& path) {
  struct stat mine {};
  struct stat there {};
  return fstat(descriptor, &mine) == 0 && stat(path.c_str(), &there) == 0 && mine.st_ino == there.st_ino &&
         mine.st_dev == there.st_dev;
}

std::string content_of(int descriptor) {
  std::array<char, 512> text{};
  const ssize_t count = pread(descriptor, text.data(), text.size(), 0);
  return count > 0 ? std::string(text.data(), static_cast<std::size_t>(count)) : "unknown";
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, const std::string& owner)
    : file_(folder / ".lock") {
  while (!is_file_of(descriptor_, file_)) {
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (descriptor_ < 0)
      throw CannotWrite(fmt::format("cannot write '{}': {}", file_.string(), std::strerror(errno)));
    if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK)
      continue;  // locked, or the file system does not support locks
    const std::string other = content_of(descriptor_);
    close(descriptor_);
    throw FolderInUse(fmt::format("another command is writing into '{}' ({})", folder.string(), other));
  }
  [[maybe_unused]] const bool said =
      ftruncate(descriptor_, 0) == 0 && pwrite(descriptor_, owner.data(), owner.size(), 0) >= 0;
}

FolderLock::~FolderLock() {
  unlink(file_.c_str());
  close(descriptor_);
}

}  // namespace evalcts
