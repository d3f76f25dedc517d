// Copies elements of three floats from a packed array that was just written by vectors.
#pragma once

#include <cstddef>
#include <cstring>

namespace glev {

// Copies `count` elements, a multiple of 4, to `to`, where they are `stride` bytes apart. Each element is
// read in two parts, neither of which crosses a block of 16 bytes, because processors cannot forward two
// stores to one load.
inline void copy_triples(const float* from, std::size_t count, std::size_t stride, std::byte* to) {
  constexpr std::size_t kOne = sizeof(float), kTwo = 2 * sizeof(float);
  for (std::size_t i = 0; i < count; i += 4, from += 12, to += 4 * stride) {
    std::memcpy(to, from, kTwo);
    std::memcpy(to + kTwo, from + 2, kOne);
    std::memcpy(to + stride, from + 3, kOne);
    std::memcpy(to + stride + kOne, from + 4, kTwo);
    std::memcpy(to + 2 * stride, from + 6, kTwo);
    std::memcpy(to + 2 * stride + kTwo, from + 8, kOne);
    std::memcpy(to + 3 * stride, from + 9, kOne);
    std::memcpy(to + 3 * stride + kOne, from + 10, kTwo);
  }
}

}  // namespace glev
