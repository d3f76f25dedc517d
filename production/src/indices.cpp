// Generates the indices of primitives of meshes, and finds vertices with equal bits.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <utility>

#include "mutation_point.h"
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

// Returns the largest number of an index type, which TRIANGLE_STRIP uses to restart primitives.
std::size_t largest_index(glev_enum type) { return (std::uint64_t{1} << (8 * index_bytes(type))) - 1; }

// Returns the number of vertices on the boundary of a patch of GLEV_GRID_EDGES; 0 for other grids.
std::size_t boundary_of(const glev_indices& indices) {
  std::size_t sum = 0;
  for (const glev_int segments : indices.edge_segments) sum += static_cast<std::size_t>(segments);
  return sum;
}

// Counts the vertices of a patch. Returns false if columns, rows or edge_segments are invalid.
bool count_vertices(const glev_indices& indices, std::size_t* own) {
  const auto& edges = indices.edge_segments;
  if (std::all_of(std::begin(edges), std::end(edges), [](glev_int segments) { return segments == 0; }))
    return multiply(indices.columns, indices.rows, own);
  if (indices.mode != GLEV_FILL || indices.columns < 3 || indices.rows < 3) return false;
  if (std::any_of(std::begin(edges), std::end(edges), [](glev_int segments) { return segments < 1; }))
    return false;
  return multiply(indices.columns - 2, indices.rows - 2, own) &&
         !__builtin_add_overflow(*own, boundary_of(indices), own);
}

// The strips of a patch: along u, or along v for GLEV_CCW, because strips along u with the triangles of FILL
// are clockwise.
struct Strips {
  explicit Strips(const glev_indices& indices)
      : are_along_v(indices.winding == GLEV_CCW),
        steps(are_along_v ? indices.rows : indices.columns),
        count(steps < 2 ? 0 : (are_along_v ? indices.columns : indices.rows) - 1) {}

  bool are_along_v;
  std::size_t steps, count;
};

// Copies the structure and counts vertices and indices. Returns an error if it is invalid, apart from the
// sizes and pointers of memory.
glev_result read_indices(const glev_indices* given, glev_indices* indices, std::size_t* vertices,
                         std::size_t* count) {
  const glev_result result = glev::read_struct(given, indices);
  if (result != GLEV_SUCCESS) return result;
  if (index_bytes(indices->type) == 0) return GLEV_ERROR_INVALID_ARGUMENT;
  const glev_enum mode = indices->mode, winding = indices->winding;
  const bool has_strips = mode == GLEV_TRIANGLE_STRIP;
  if (mode != GLEV_POINT && mode != GLEV_LINE && mode != GLEV_FILL && !has_strips)
    return GLEV_ERROR_INVALID_ARGUMENT;
  if (winding != 0 && winding != GLEV_CW && winding != GLEV_CCW) return GLEV_ERROR_INVALID_ARGUMENT;
  if (indices->patches == 0) indices->patches = 1;
  const std::size_t columns = indices->columns, rows = indices->rows, first = indices->first;
  std::size_t own;
  if (!count_vertices(*indices, &own) || !multiply(own, indices->patches, vertices))
    return GLEV_ERROR_INVALID_ARGUMENT;
  const bool shares = indices->vertices != nullptr;
  if (shares && (indices->vertex_bytes == 0 || indices->vertex_bytes > indices->vertex_stride))
    return GLEV_ERROR_INVALID_ARGUMENT;
  *count = 0;
  if (*vertices == 0) return GLEV_SUCCESS;
  const std::size_t largest = largest_index(indices->type) - (has_strips ? 1 : 0);
  if (*vertices - 1 > largest || first > largest - (*vertices - 1)) return GLEV_ERROR_INVALID_ARGUMENT;
  if (shares && *vertices >= std::uint64_t{1} << 32) return GLEV_ERROR_INVALID_ARGUMENT;
  // With fewer than 2^32 vertices, nothing overflows below.
  if (mode == GLEV_POINT) *count = own;
  if (mode == GLEV_LINE) *count = 2 * (own - rows) + (rows > 1 ? 2 * (own - columns) : 0);
  if (mode == GLEV_FILL) *count = 6 * (own - rows - columns + 1);
  const std::size_t boundary = boundary_of(*indices);
  if (boundary != 0) *count = 6 * (own - boundary - 1) + 3 * boundary;
  const Strips strips(*indices);
  if (has_strips) *count = strips.count * (2 * strips.steps + 1);
  *count *= indices->patches;
  if (has_strips && *count != 0) --*count;  // no restart at the end
  return GLEV_SUCCESS;
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

  void add_patch(std::size_t patch, std::size_t vertices) {
    first_ = patch * vertices;
    const std::size_t columns = indices_.columns, rows = indices_.rows, boundary = boundary_of(indices_);
    switch (indices_.mode) {
      case GLEV_POINT:
        for (std::size_t own = 0; own < vertices; ++own) add(own);
        break;
      case GLEV_LINE:
        for (std::size_t j = 0; j < rows; ++j) {
          for (std::size_t i = 0; i + 1 < columns; ++i) {
            add(j * columns + i);
            add(j * columns + i + 1);
          }
        }
        for (std::size_t i = 0; i < columns; ++i) {
          for (std::size_t j = 0; j + 1 < rows; ++j) {
            add(j * columns + i);
            add((j + 1) * columns + i);
          }
        }
        break;
      case GLEV_FILL:
        if (boundary == 0) return add_quadrilaterals(columns, rows);
        add_quadrilaterals(columns - 2, rows - 2);
        add_boundary(vertices - boundary, boundary);
        break;
      case GLEV_TRIANGLE_STRIP:
        add_strips();
        break;
    }
  }

 private:
  void write(std::uint32_t number) {
    const auto byte = static_cast<std::uint8_t>(number);
    const auto two = static_cast<std::uint16_t>(number);
    std::memcpy(to_,
                bytes_ == 1   ? static_cast<const void*>(&byte)
                : bytes_ == 2 ? &two
                              : static_cast<const void*>(&number),
                bytes_);
    to_ += bytes_;
  }
  // Adds a vertex by its number in the patch.
  void add(std::size_t own) {
    own += first_;
    write(static_cast<std::uint32_t>(indices_.first + (equal_ == nullptr ? own : equal_[own])));
  }
  void add_triangle(std::size_t first, std::size_t second, std::size_t third) {
    if (indices_.winding == GLEV_CCW) std::swap(second, third);
    for (const std::size_t own : {first, second, third}) add(own);
  }

  void add_quadrilaterals(std::size_t columns, std::size_t rows) {
    for (std::size_t j = 0; j + 1 < rows; ++j) {
      for (std::size_t i = 0; i + 1 < columns; ++i) {
        const std::size_t corner = j * columns + i, above = corner + columns;
        add_triangle(corner, above, corner + 1);
        add_triangle(corner + 1, above, above + 1);
      }
    }
  }

  // Adds the triangles between the boundary, whose vertices begin with number `first`, and the inner grid.
  // The base of each triangle is the next segment of the edge or that of the inner grid: the one with the
  // earlier midpoint.
  void add_boundary(std::size_t first, std::size_t boundary) {
    const std::size_t columns = indices_.columns - 2, rows = indices_.rows - 2;
    const std::size_t right = columns - 1, top = (rows - 1) * columns;
    const struct {
      std::size_t corner, step, segments;  // vertices of the grid inside, along the edge
    } inner[4] = {{0, 1, columns - 1},
                  {right, columns, rows - 1},
                  {top + right, 0 - std::size_t{1}, columns - 1},
                  {top, 0 - columns, rows - 1}};
    std::size_t begin = 0;
    for (int edge = 0; edge < 4; ++edge) {
      const auto [corner, step, segments] = inner[edge];
      const auto outer = static_cast<std::size_t>(indices_.edge_segments[edge]);
      const auto vertex = [&, start = begin](std::size_t a) {
        return first + GLEV_AT(place_on_boundary, (start + a) % boundary);
      };
      for (std::size_t a = 0, b = 0; a < outer || b < segments;) {
        const std::size_t own = corner + b * step;
        const bool is_outer = b == segments || (a < outer && std::uint64_t{2 * a + 1} * (segments + 2) <=
                                                                 std::uint64_t{2 * b + 3} * outer);
        if (is_outer) {
          add_triangle(vertex(a), own, vertex(a + 1));
          ++a;
        } else {
          add_triangle(vertex(a), own, own + step);
          ++b;
        }
      }
      begin += outer;
    }
  }

  void add_strips() {
    const Strips strips(indices_);
    for (std::size_t strip = 0; strip < strips.count; ++strip) {
      if (to_ != indices_.data) write(static_cast<std::uint32_t>(largest_index(indices_.type)));
      for (std::size_t k = 0; k < strips.steps; ++k) {
        for (const std::size_t side : {strip, strip + 1})
          add(strips.are_along_v ? k * indices_.columns + side : side * indices_.columns + k);
      }
    }
  }

  const glev_indices& indices_;
  const std::uint32_t* equal_;
  std::size_t bytes_, first_ = 0;
  std::byte* to_;
};

}  // namespace

size_t glevGetIndexCount(const glev_indices* given) {
  glev_indices indices;
  std::size_t vertices, count;
  return read_indices(given, &indices, &vertices, &count) == GLEV_SUCCESS ? count : 0;
}

size_t glevGetIndexScratchSize(const glev_indices* given) {
  glev_indices indices;
  std::size_t vertices, count;
  if (read_indices(given, &indices, &vertices, &count) != GLEV_SUCCESS || count == 0 ||
      indices.vertices == nullptr)
    return 0;
  return scratch_for(vertices);
}

glev_result glevGetIndices(const glev_indices* given) {
  glev_indices indices;
  std::size_t vertices, count;
  const glev_result result = read_indices(given, &indices, &vertices, &count);
  if (result != GLEV_SUCCESS) return result;
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
  for (std::size_t patch = 0; patch < indices.patches; ++patch)
    writer.add_patch(patch, vertices / indices.patches);
  return GLEV_SUCCESS;
}
