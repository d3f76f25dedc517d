// Memory between inaccessible pages.
#pragma once

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <vector>

namespace glev_tests {

// A block of `size` bytes, filled with a poison value, that begins after a guard page or ends before one.
class Guarded {
 public:
  enum class Side { kBegin, kEnd };
  static constexpr unsigned char kPoisonByte = 0xCD;

  Guarded(std::size_t size, Side side) : size_(size) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    inner_ = (size + page - 1) / page * page;
    all_ = inner_ + 2 * page;
    void* const memory = mmap(nullptr, all_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    EXPECT_NE(memory, MAP_FAILED);
    base_ = static_cast<unsigned char*>(memory);
    begin_ = base_ + page;
    protect(PROT_READ | PROT_WRITE);
    std::memset(begin_, kPoisonByte, inner_);
    data_ = side == Side::kBegin ? begin_ : begin_ + inner_ - size;
  }
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;
  ~Guarded() { munmap(base_, all_); }

  unsigned char* data() { return data_; }
  std::size_t size() const { return size_; }
  void make_read_only() { protect(PROT_READ); }
  std::vector<unsigned char> bytes() const { return {data_, data_ + size_}; }

 private:
  void protect(int access) {
    if (inner_ == 0) return;
    EXPECT_EQ(mprotect(begin_, inner_, access), 0);
  }

  std::size_t size_, inner_ = 0, all_ = 0;
  unsigned char *base_ = nullptr, *begin_ = nullptr, *data_ = nullptr;
};

}  // namespace glev_tests
