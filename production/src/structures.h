// Reads structures of the C API, which later versions may extend.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>

#include <glevaluator.h>

#include "allocator.h"

namespace glev {

// Size of a structure in the first version of the library. It must not change if members are added.
template <class Struct>
inline constexpr std::size_t kFirstSize = 0;
#define GLEV_FIRST_SIZE(Struct, last_member)        \
  template <>                                       \
  inline constexpr std::size_t kFirstSize<Struct> = \
      offsetof(Struct, last_member) + sizeof(Struct::last_member)
GLEV_FIRST_SIZE(glev_allocator, release);
GLEV_FIRST_SIZE(glev_context_info, target);
GLEV_FIRST_SIZE(glev_sink, end);
GLEV_FIRST_SIZE(glev_plan_info, dimension);
GLEV_FIRST_SIZE(glev_output, row_stride);
GLEV_FIRST_SIZE(glev_batch, output_count);
GLEV_FIRST_SIZE(glev_mesh, scratch_size);
GLEV_FIRST_SIZE(glev_indices, data_size);
GLEV_FIRST_SIZE(glev_patches, v2);
GLEV_FIRST_SIZE(glev_patch_grid, target);
GLEV_FIRST_SIZE(glev_map_info, instruction_set);
#undef GLEV_FIRST_SIZE

// Copies a structure that begins with its size; members that the version of the caller does not have are
// zero. Returns false, and copies nothing, if the structure is smaller than in the first version, or if it is
// larger than in this version and the bytes beyond are not zero.
template <class Struct>
bool read_struct(const Struct* given, Struct* copy) {
  static_assert(kFirstSize<Struct> != 0);
  if (given == nullptr || given->size < kFirstSize<Struct>) return false;
  if (given->size == sizeof(Struct)) {  // the usual case, with a size that is known to the compiler
    std::memcpy(copy, given, sizeof(Struct));
    return true;
  }
  const auto* bytes = reinterpret_cast<const unsigned char*>(given);
  for (std::size_t i = sizeof(Struct); i < given->size; ++i) {
    if (bytes[i] != 0) return false;
  }
  *copy = {};
  std::memcpy(copy, given, std::min(given->size, sizeof(Struct)));
  return true;
}

// Returns the structure itself if it has the size of this version, otherwise what read_struct() copies; null
// if that fails. A copy of members that the caller has just written would wait until they are in the cache.
template <class Struct>
const Struct* view_struct(const Struct* given, Struct* copy) {
  if (given != nullptr && given->size == sizeof(Struct)) return given;
  return read_struct(given, copy) ? copy : nullptr;
}

// Reads an allocator; null selects the heap. Returns false if the structure is invalid.
inline bool read_allocator(const glev_allocator* given, Allocator* allocator) {
  glev_allocator functions;
  if (given == nullptr) return true;
  if (!read_struct(given, &functions) || functions.allocate == nullptr || functions.release == nullptr)
    return false;
  *allocator = Allocator(functions);
  return true;
}

}  // namespace glev
