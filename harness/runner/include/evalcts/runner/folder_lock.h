// One run at a time writes into an output folder.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace evalcts {

// Another process is at work in the folder; the message says which.
struct FolderInUse : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A lock of the kernel on the file `.lock`, which holds `owner` for others to read. It ends with the process,
// in whatever way: a file that a killed run has left behind locks nothing.
class FolderLock {
 public:
  // Throws FolderInUse and CannotWrite.
  FolderLock(const std::filesystem::path& folder, const std::string& owner);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace evalcts
