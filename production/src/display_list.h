// The contents of a display list: consecutive commands in one block of memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include "allocator.h"

namespace glev {

enum class Opcode : std::uint32_t {
  kError,
  kDefineMap,
  kSetEnabled,
  kSetGrid,
  kEvalCoord,
  kEvalPoint,
  kEvalMesh1,
  kEvalMesh2,
  kBegin,
  kEnd,
  kVertex,
  kColor,
  kNormal,
  kIndex,
  kEdgeFlag,
  kMultiTexCoord,
  kActiveTexture,
  kPushAttrib,
  kPopAttrib,
  kCallList,
  kCallLists,
  kListBase
};

// The alignment of every part of a list.
inline constexpr std::size_t kListUnit = 8;

constexpr std::uint64_t round_up_to_list_unit(std::uint64_t bytes) {
  return (bytes + kListUnit - 1) / kListUnit * kListUnit;
}

// The header of each command.
struct alignas(kListUnit) Record {
  Opcode opcode;
  std::uint32_t units;  // size of the payload that follows: the command and the memory behind its pointers
};

// A handle of a list. Copies share the memory, which is valid until free(). An empty list has no memory.
class DisplayList {
 public:
  const std::byte* begin() const { return data_; }
  const std::byte* end() const { return data_ + size_; }
  bool empty() const { return size_ == 0; }

  // Appends a record and returns its payload for the caller to fill. Returns null, and changes nothing, if
  // there is no memory.
  std::byte* append(const Allocator& allocator, Opcode opcode, std::uint64_t payload_bytes);
  void free(const Allocator& allocator);

 private:
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace glev
