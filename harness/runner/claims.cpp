// Implements Claims as a shared file mapping with one atomic byte for each test.
#include <evalcts/runner/claims.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

#include <evalcts/results/files.h>

namespace evalcts {

static_assert(sizeof(std::atomic<unsigned char>) == 1 && std::atomic<unsigned char>::is_always_lock_free);

void Claims::create(const std::filesystem::path& path, std::size_t count) {
  std::ofstream file(path, std::ios::binary);
  file << std::string(count, '\0');
  if (!file.flush()) throw CannotWrite(fmt::format("cannot write '{}'", path.string()));
}

Claims::Claims(const std::filesystem::path& path) : count_(std::filesystem::file_size(path)) {
  if (count_ == 0) return;
  const int descriptor = open(path.c_str(), O_RDWR | O_CLOEXEC);
  void* memory = MAP_FAILED;
  if (descriptor >= 0) memory = mmap(nullptr, count_, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  const int error = errno;
  if (descriptor >= 0) close(descriptor);
  if (memory == MAP_FAILED)
    throw std::runtime_error(fmt::format("cannot open '{}': {}", path.string(), std::strerror(error)));
  taken_ = static_cast<std::atomic<unsigned char>*>(memory);
}

Claims::~Claims() {
  if (taken_) munmap(taken_, count_);
}

bool Claims::take(std::size_t test) {
  if (test >= count_) throw std::out_of_range("the list of claims is shorter than the list of tests");
  return taken_[test].exchange(1) == 0;
}

bool Claims::all_taken() const {
  return std::all_of(taken_, taken_ + count_, [](const auto& test) { return test.load() != 0; });
}

}  // namespace evalcts
