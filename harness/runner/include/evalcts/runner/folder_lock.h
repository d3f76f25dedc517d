// Locks an output folder, so that only one run at a time writes into it.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace evalcts {

// Thrown if another process has locked the folder. The message contains the owner of the lock.
struct FolderInUse : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A kernel lock (flock) on the file `.lock`, which contains `owner` for messages of other processes.
// The kernel releases the lock when the process ends in any way, so a file left behind by a killed run
// does not lock.
class FolderLock {
 public:
  // Locks the folder. If the file system does not support locks, does not lock. Throws
  // FolderInUse and CannotWrite.
  FolderLock(const std::filesystem::path& folder, const std::string& owner);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace evalcts
