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
// zero. Copies nothing and returns INVALID_ARGUMENT if there is no structure, or STRUCTURE_SIZE if it is
// smaller than in the first version, or larger than in this version and the bytes beyond are not zero.
template <class Struct>
glev_result read_struct(const Struct* given, Struct* copy) {
  static_assert(kFirstSize<Struct> != 0);
  if (given == nullptr) return GLEV_ERROR_INVALID_ARGUMENT;
  if (given->size < kFirstSize<Struct>) return GLEV_ERROR_STRUCTURE_SIZE;
  if (given->size == sizeof(Struct)) {  // the usual case, with a size that is known to the compiler
    std::memcpy(copy, given, sizeof(Struct));
    return GLEV_SUCCESS;
  }
  const auto* bytes = reinterpret_cast<const unsigned char*>(given);
  for (std::size_t i = sizeof(Struct); i < given->size; ++i) {
    if (bytes[i] != 0) return GLEV_ERROR_STRUCTURE_SIZE;
  }
  *copy = {};
  std::memcpy(copy, given, std::min(given->size, sizeof(Struct)));
  return GLEV_SUCCESS;
}

// Points `view` to the structure itself if it has the size of this version, otherwise to what read_struct()
// copies, whose result it returns. A copy of members that the caller has just written would wait until they
// are in the cache.
template <class Struct>
glev_result view_struct(const Struct* given, Struct* copy, const Struct** view) {
  const bool is_current = given != nullptr && given->size == sizeof(Struct);
  *view = is_current ? given : copy;
  return is_current ? GLEV_SUCCESS : read_struct(given, copy);
}

// Reads an allocator; null selects the heap.
inline glev_result read_allocator(const glev_allocator* given, Allocator* allocator) {
  glev_allocator functions;
  if (given == nullptr) return GLEV_SUCCESS;
  const glev_result result = read_struct(given, &functions);
  if (result != GLEV_SUCCESS) return result;
  if (functions.allocate == nullptr || functions.release == nullptr) return GLEV_ERROR_INVALID_ARGUMENT;
  *allocator = Allocator(functions);
  return GLEV_SUCCESS;
}

}  // namespace glev
