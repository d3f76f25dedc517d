// The contents of a display list: consecutive commands in one block of memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glevaluator.h>

#include "allocator.h"

namespace glev {

// The alignment of every part of a list.
inline constexpr std::size_t kListUnit = 8;

constexpr std::uint64_t round_up_to_list_unit(std::uint64_t bytes) {
  return (bytes + kListUnit - 1) / kListUnit * kListUnit;
}

// Executes a command of a list.
using RunsCommand = void (*)(glev_context& gl, const std::byte* payload);

// The header of each command.
struct Record {
  RunsCommand run;
  std::size_t bytes;  // size of the payload that follows: the command and its arrays
};
static_assert(alignof(Record) <= kListUnit && sizeof(Record) % kListUnit == 0);

// A handle of a list. Copies share the memory, which is valid until free(). An empty list has no memory.
class DisplayList {
 public:
  const std::byte* begin() const { return data_; }
  const std::byte* end() const { return data_ + size_; }
  bool empty() const { return size_ == 0; }

  // Appends a record and returns its payload for the caller to fill. Returns null, and changes nothing, if
  // there is no memory.
  std::byte* append(const Allocator& allocator, RunsCommand run, std::uint64_t payload_bytes);
  void free(const Allocator& allocator);

 private:
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace glev
