// Memory from the allocator of the caller, without exceptions or global state.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <glevaluator.h>

namespace glev {

inline constexpr std::size_t kCacheLine = 64;

// Returns the next address that is aligned to a cache line.
inline std::byte* align(std::byte* memory) {
  const std::size_t unaligned = reinterpret_cast<std::uintptr_t>(memory) % kCacheLine;
  return memory + (unaligned == 0 ? 0 : kCacheLine - unaligned);
}

// Rounds up to whole cache lines.
constexpr std::size_t round_up(std::size_t bytes) {
  return (bytes + kCacheLine - 1) / kCacheLine * kCacheLine;
}

class Allocator {
 public:
  Allocator() : allocate_(heap_allocate), release_(heap_release) {}
  explicit Allocator(const glev_allocator& given)
      : user_(given.user), allocate_(given.allocate), release_(given.release) {}

  // Returns null if there is no memory.
  void* allocate(std::size_t bytes, std::size_t alignment) const {
    return allocate_(user_, bytes, alignment);
  }
  void release(void* memory, std::size_t bytes, std::size_t alignment) const {
    if (memory != nullptr) release_(user_, memory, bytes, alignment);
  }

 private:
  static void* heap_allocate(void*, std::size_t bytes, std::size_t alignment) {
#ifdef _WIN32
    return _aligned_malloc(bytes, alignment);
#else
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
#endif
  }
  static void heap_release(void*, void* memory, std::size_t, std::size_t) {
#ifdef _WIN32
    _aligned_free(memory);
#else
    std::free(memory);
#endif
  }

  void* user_ = nullptr;
  void* (*allocate_)(void*, std::size_t, std::size_t);
  void (*release_)(void*, void*, std::size_t, std::size_t);
};

// An array of doubles that only grows.
class DoubleBuffer {
 public:
  DoubleBuffer() = default;
  DoubleBuffer(const DoubleBuffer&) = delete;
  DoubleBuffer& operator=(const DoubleBuffer&) = delete;

  double* data() { return data_; }
  const double* data() const { return data_; }

  // Makes room for `count` doubles; the contents are lost if the array grows. Returns false, and changes
  // nothing, if there is no memory.
  bool reserve(const Allocator& allocator, std::size_t count) {
    if (count <= capacity_) return true;
    void* memory = allocator.allocate(count * sizeof(double), kCacheLine);
    if (memory == nullptr) return false;
    free(allocator);
    data_ = static_cast<double*>(memory);
    capacity_ = count;
    return true;
  }

  void free(const Allocator& allocator) {
    allocator.release(data_, capacity_ * sizeof(double), kCacheLine);
    data_ = nullptr;
    capacity_ = 0;
  }

 private:
  double* data_ = nullptr;
  std::size_t capacity_ = 0;
};

}  // namespace glev
