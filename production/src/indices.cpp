// Primitives of the vertices of a mesh.
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "allocator.h"
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

// a * b, or false if size_t has no room for it.
bool multiply(std::size_t a, std::size_t b, std::size_t* product) {
  return !__builtin_mul_overflow(a, b, product);
}

// False for what is not well formed, apart from data.
bool read_indices(const glev_indices* given, glev_indices* indices, std::size_t* count) {
  if (!glev::read_struct(given, indices) || index_bytes(indices->type) == 0) return false;
  const std::size_t columns = indices->columns, rows = indices->rows, first = indices->first;
  const glev_enum mode = indices->mode;
  std::size_t vertices;
  if (!multiply(columns, rows, &vertices)) return false;
  *count = 0;
  if (vertices == 0) return mode == GLEV_POINT || mode == GLEV_LINE || mode == GLEV_FILL;
  const std::size_t largest = (std::uint64_t{1} << (8 * index_bytes(indices->type))) - 1;
  if (vertices - 1 > largest || first > largest - (vertices - 1)) return false;
  // Below 2^32 vertices nothing overflows from here on.
  switch (mode) {
    case GLEV_POINT:
      *count = vertices;
      return true;
    case GLEV_LINE:
      *count = 2 * (vertices - rows) + (rows > 1 ? 2 * (vertices - columns) : 0);
      return true;
    case GLEV_FILL:
      *count = 6 * (vertices - rows - columns + 1);
      return true;
  }
  return false;
}

class IndexWriter {
 public:
  explicit IndexWriter(const glev_indices& indices)
      : indices_(indices), bytes_(index_bytes(indices.type)), to_(static_cast<std::byte*>(indices.data)) {}

  void add(std::size_t i, std::size_t j) {
    const auto number = static_cast<std::uint32_t>(indices_.first + j * indices_.columns + i);
    const auto byte = static_cast<std::uint8_t>(number);
    const auto two = static_cast<std::uint16_t>(number);
    std::memcpy(to_,
                bytes_ == 1   ? static_cast<const void*>(&byte)
                : bytes_ == 2 ? &two
                              : static_cast<const void*>(&number),
                bytes_);
    to_ += bytes_;
  }

 private:
  const glev_indices& indices_;
  std::size_t bytes_;
  std::byte* to_;
};

}  // namespace

size_t glevGetIndexCount(const glev_indices* given) {
  glev_indices indices;
  std::size_t count;
  return read_indices(given, &indices, &count) ? count : 0;
}

glev_result glevGetIndices(const glev_indices* given) {
  glev_indices indices;
  std::size_t count;
  if (!read_indices(given, &indices, &count)) return GLEV_ERROR_INVALID_ARGUMENT;
  if (count == 0) return GLEV_SUCCESS;
  if (indices.data == nullptr) return GLEV_ERROR_INVALID_ARGUMENT;
  if (count > indices.data_size / index_bytes(indices.type)) return GLEV_ERROR_BUFFER_TOO_SMALL;
  IndexWriter writer(indices);
  const std::size_t columns = indices.columns, rows = indices.rows;
  switch (indices.mode) {
    case GLEV_POINT:
      for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 0; i < columns; ++i) writer.add(i, j);
      }
      break;
    case GLEV_LINE:
      for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 0; i + 1 < columns; ++i) {
          writer.add(i, j);
          writer.add(i + 1, j);
        }
      }
      for (std::size_t i = 0; i < columns; ++i) {
        for (std::size_t j = 0; j + 1 < rows; ++j) {
          writer.add(i, j);
          writer.add(i, j + 1);
        }
      }
      break;
    case GLEV_FILL:
      for (std::size_t j = 0; j + 1 < rows; ++j) {
        for (std::size_t i = 0; i + 1 < columns; ++i) {
          writer.add(i, j);
          writer.add(i, j + 1);
          writer.add(i + 1, j);
          writer.add(i + 1, j);
          writer.add(i, j + 1);
          writer.add(i + 1, j + 1);
        }
      }
      break;
  }
  return GLEV_SUCCESS;
}
