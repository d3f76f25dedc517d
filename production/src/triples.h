// Elements of three floats from a packed array that was just written by vectors.
#pragma once

#include <cstddef>
#include <cstring>

namespace glev {

// `count` of them, a multiple of 4, `stride` bytes apart at `to`. Each is read in two parts neither of which
// lies in two blocks of 16 bytes: what two stores have written cannot be forwarded to one load.
inline void CopyTriples(const float* from, std::size_t count, std::size_t stride, std::byte* to) {
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
