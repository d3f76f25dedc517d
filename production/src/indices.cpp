// Generates the indices of primitives of meshes, and finds vertices with equal bits.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "structures.h"

namespace {

std::size_t index_bytes(glev_enum type) {
  switch (type) {
    case GLEV_UNSIGNED_BYTE:
      return 1;
    case GLEV_UNSIGNED_SHORT:
      return 2;
    case GLEV_UNSIGNED_INT:
      return 4;
  }
  return 0;
}

// Computes a * b. Returns false if the product overflows.
bool multiply(std::size_t a, std::size_t b, std::size_t* product) {
  return !__builtin_mul_overflow(a, b, product);
}

// Copies the structure and counts vertices and indices. Returns false if it is invalid, apart from the sizes
// and pointers of memory.
bool read_indices(const glev_indices* given, glev_indices* indices, std::size_t* vertices,
                  std::size_t* count) {
  if (!glev::read_struct(given, indices) || index_bytes(indices->type) == 0) return false;
  const glev_enum mode = indices->mode, winding = indices->winding;
  if (mode != GLEV_POINT && mode != GLEV_LINE && mode != GLEV_FILL) return false;
  if (winding != 0 && winding != GLEV_CW && winding != GLEV_CCW) return false;
  if (indices->patches == 0) indices->patches = 1;
  const std::size_t columns = indices->columns, rows = indices->rows, first = indices->first;
  std::size_t own;
  if (!multiply(columns, rows, &own) || !multiply(own, indices->patches, vertices)) return false;
  const bool shares = indices->vertices != nullptr;
  if (shares && (indices->vertex_bytes == 0 || indices->vertex_bytes > indices->vertex_stride)) return false;
  *count = 0;
  if (*vertices == 0) return true;
  const std::size_t largest = (std::uint64_t{1} << (8 * index_bytes(indices->type))) - 1;
  if (*vertices - 1 > largest || first > largest - (*vertices - 1)) return false;
  if (shares && *vertices >= std::uint64_t{1} << 32) return false;
  // With fewer than 2^32 vertices, nothing overflows below.
  if (mode == GLEV_POINT) *count = own;
  if (mode == GLEV_LINE) *count = 2 * (own - rows) + (rows > 1 ? 2 * (own - columns) : 0);
  if (mode == GLEV_FILL) *count = 6 * (own - rows - columns + 1);
  *count *= indices->patches;
  return true;
}

// ---- Vertices of equal bits

// Returns the number of entries of the hash table, of which at least half remain empty.
std::size_t entries_for(std::size_t vertices) { return std::bit_ceil(2 * vertices); }

std::size_t scratch_for(std::size_t vertices) {
  return alignof(std::uint32_t) - 1 + sizeof(std::uint32_t) * (vertices + entries_for(vertices));
}

std::uint64_t hash_of(const std::byte* bytes, std::size_t count) {
  std::uint64_t hash = count;
  while (count != 0) {
    std::uint64_t word = 0;
    const std::size_t step = std::min(count, sizeof word);
    std::memcpy(&word, bytes, step);
    hash = (hash ^ word) * 0x9E3779B97F4A7C15;
    hash ^= hash >> 32;
    bytes += step;
    count -= step;
  }
  return hash;
}

// Finds the number of the first equal vertex of each vertex, by a hash table with linear probing. Returns the
// numbers, which are in the scratch memory.
const std::uint32_t* find_equal_vertices(const glev_indices& indices, std::size_t vertices) {
  constexpr std::uint32_t kEmpty = 0xFFFFFFFF;
  const auto* const from = static_cast<const std::byte*>(indices.vertices);
  const auto vertex = [&](std::size_t number) { return from + number * indices.vertex_stride; };
  const std::size_t unaligned = reinterpret_cast<std::uintptr_t>(indices.scratch) % alignof(std::uint32_t);
  auto* const first = reinterpret_cast<std::uint32_t*>(
      static_cast<std::byte*>(indices.scratch) + (unaligned == 0 ? 0 : alignof(std::uint32_t) - unaligned));
  std::uint32_t* const table = first + vertices;
  const std::size_t entries = entries_for(vertices);
  std::fill_n(table, entries, kEmpty);
  for (std::size_t number = 0; number < vertices; ++number) {
    std::size_t entry = hash_of(vertex(number), indices.vertex_bytes) & (entries - 1);
    while (table[entry] != kEmpty &&
           std::memcmp(vertex(table[entry]), vertex(number), indices.vertex_bytes) != 0)
      entry = (entry + 1) & (entries - 1);
    if (table[entry] == kEmpty) table[entry] = static_cast<std::uint32_t>(number);
    first[number] = table[entry];
  }
  return first;
}

// ---- Indices

class IndexWriter {
 public:
  // `equal`: for each vertex the number to write; null if vertices are not shared.
  IndexWriter(const glev_indices& indices, const std::uint32_t* equal)
      : indices_(indices),
        equal_(equal),
        bytes_(index_bytes(indices.type)),
        to_(static_cast<std::byte*>(indices.data)) {}

  void begin_patch(std::size_t patch) { patch_ = patch * indices_.rows * indices_.columns; }

  void add(std::size_t i, std::size_t j) {
    const std::size_t own = patch_ + j * indices_.columns + i;
    const auto number = static_cast<std::uint32_t>(indices_.first + (equal_ == nullptr ? own : equal_[own]));
    const auto byte = static_cast<std::uint8_t>(number);
    const auto two = static_cast<std::uint16_t>(number);
    std::memcpy(to_,
                bytes_ == 1   ? static_cast<const void*>(&byte)
                : bytes_ == 2 ? &two
                              : static_cast<const void*>(&number),
                bytes_);
    to_ += bytes_;
  }

  void add_patch() {
    const std::size_t columns = indices_.columns, rows = indices_.rows;
    switch (indices_.mode) {
      case GLEV_POINT:
        for (std::size_t j = 0; j < rows; ++j) {
          for (std::size_t i = 0; i < columns; ++i) add(i, j);
        }
        break;
      case GLEV_LINE:
        for (std::size_t j = 0; j < rows; ++j) {
          for (std::size_t i = 0; i + 1 < columns; ++i) {
            add(i, j);
            add(i + 1, j);
          }
        }
        for (std::size_t i = 0; i < columns; ++i) {
          for (std::size_t j = 0; j + 1 < rows; ++j) {
            add(i, j);
            add(i, j + 1);
          }
        }
        break;
      case GLEV_FILL:
        for (std::size_t j = 0; j + 1 < rows; ++j) {
          for (std::size_t i = 0; i + 1 < columns; ++i) {
            add_triangle({i, j}, {i, j + 1}, {i + 1, j});
            add_triangle({i + 1, j}, {i, j + 1}, {i + 1, j + 1});
          }
        }
        break;
    }
  }

 private:
  struct Corner {
    std::size_t i, j;
  };
  void add_triangle(Corner first, Corner second, Corner third) {
    if (indices_.winding == GLEV_CCW) std::swap(second, third);
    for (const Corner& corner : {first, second, third}) add(corner.i, corner.j);
  }

  const glev_indices& indices_;
  const std::uint32_t* equal_;
  std::size_t bytes_, patch_ = 0;
  std::byte* to_;
};

}  // namespace

size_t glevGetIndexCount(const glev_indices* given) {
  glev_indices indices;
  std::size_t vertices, count;
  return read_indices(given, &indices, &vertices, &count) ? count : 0;
}

size_t glevGetIndexScratchSize(const glev_indices* given) {
  glev_indices indices;
  std::size_t vertices, count;
  if (!read_indices(given, &indices, &vertices, &count) || count == 0 || indices.vertices == nullptr)
    return 0;
  return scratch_for(vertices);
}

glev_result glevGetIndices(const glev_indices* given) {
  glev_indices indices;
  std::size_t vertices, count;
  if (!read_indices(given, &indices, &vertices, &count)) return GLEV_ERROR_INVALID_ARGUMENT;
  if (count == 0) return GLEV_SUCCESS;
  const bool shares = indices.vertices != nullptr;
  if (indices.data == nullptr || (shares && indices.scratch == nullptr)) return GLEV_ERROR_INVALID_ARGUMENT;
  if (count > indices.data_size / index_bytes(indices.type)) return GLEV_ERROR_BUFFER_TOO_SMALL;
  if (shares) {
    if (indices.vertices_size < indices.vertex_bytes ||
        vertices - 1 > (indices.vertices_size - indices.vertex_bytes) / indices.vertex_stride ||
        indices.scratch_size < scratch_for(vertices))
      return GLEV_ERROR_BUFFER_TOO_SMALL;
  }
  IndexWriter writer(indices, shares ? find_equal_vertices(indices, vertices) : nullptr);
  for (std::size_t patch = 0; patch < indices.patches; ++patch) {
    writer.begin_patch(patch);
    writer.add_patch();
  }
  return GLEV_SUCCESS;
}
