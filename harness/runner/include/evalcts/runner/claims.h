// Claims to the tests of a list: processes that work through it side by side take each test once.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>

namespace evalcts {

// A file of one byte for each test of the list, mapped by all who share it.
class Claims {
 public:
  // Writes the file for a list of `count` tests, none of them taken. Throws CannotWrite.
  static void create(const std::filesystem::path& path, std::size_t count);

  // Opens it. Throws std::runtime_error.
  explicit Claims(const std::filesystem::path& path);
  ~Claims();
  Claims(const Claims&) = delete;
  Claims& operator=(const Claims&) = delete;

  // Takes the test; false if somebody has. Nobody gives one back, not even by dying.
  bool take(std::size_t test);
  bool all_taken() const;

 private:
  std::size_t count_ = 0;
  std::atomic<unsigned char>* taken_ = nullptr;
};

}  // namespace evalcts
