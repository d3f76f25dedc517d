// Distributes a list of tests over parallel processes, so that each test is taken exactly once.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>

namespace evalcts {

// A file with one byte for each test of the list, which all these processes map into memory.
class Claims {
 public:
  // Writes the file for a list of `count` tests that nobody has taken. Throws CannotWrite.
  static void create(const std::filesystem::path& path, std::size_t count);

  // Opens the file. Throws std::runtime_error.
  explicit Claims(const std::filesystem::path& path);
  ~Claims();
  Claims(const Claims&) = delete;
  Claims& operator=(const Claims&) = delete;

  // Takes the test with this index; returns false if it is already taken. A test stays taken even if the
  // process dies. Throws std::out_of_range.
  bool take(std::size_t test);
  bool all_taken() const;

 private:
  std::size_t count_ = 0;
  std::atomic<unsigned char>* taken_ = nullptr;
};

}  // namespace evalcts
