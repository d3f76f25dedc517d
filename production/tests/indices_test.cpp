// Tests glevGetIndices: the primitives of EvalMesh, with the numbering of vertices of glevEvaluateMesh.
#include <climits>
#include <set>

#include "batches.h"
#include "guarded.h"

namespace glev_tests {
namespace {

constexpr glev_enum kIndexTypes[] = {GLEV_UNSIGNED_BYTE, GLEV_UNSIGNED_SHORT, GLEV_UNSIGNED_INT};

std::size_t bytes_of_index(glev_enum type) {
  return type == GLEV_UNSIGNED_BYTE ? 1 : type == GLEV_UNSIGNED_SHORT ? 2 : 4;
}

glev_indices make_indices(glev_enum mode, std::size_t columns, std::size_t rows,
                          glev_enum type = GLEV_UNSIGNED_INT, std::size_t first = 0) {
  glev_indices indices{};
  indices.size = sizeof indices;
  indices.mode = mode;
  indices.columns = columns;
  indices.rows = rows;
  indices.first = first;
  indices.type = type;
  return indices;
}

// Returns the indices, which are written to exactly as many bytes as they need.
std::vector<std::uint32_t> get_indices(glev_indices indices) {
  const std::size_t count = glevGetIndexCount(&indices), each = bytes_of_index(indices.type);
  Memory memory(count * each + 8);
  indices.data = memory.data() + 1;
  indices.data_size = count * each;
  EXPECT_EQ(glevGetIndices(&indices), GLEV_SUCCESS);
  std::vector<std::uint32_t> numbers(count);
  for (std::size_t k = 0; k < count; ++k) std::memcpy(&numbers[k], memory.data() + 1 + k * each, each);
  memory.poison(1, count * each);
  EXPECT_TRUE(memory.is_untouched());
  return numbers;
}

// Changes legal indices and expects a result of glevGetIndices, which writes nothing unless it is SUCCESS.
// Returns the changed indices.
template <class Change>
glev_indices expect_result(glev_result expected, glev_indices indices, const Change& change) {
  Memory memory(1000);
  indices.data = memory.data();
  indices.data_size = memory.size();
  change(indices);
  SCOPED_TRACE(testing::PrintToString(indices));  // prints all bytes
  EXPECT_EQ(glevGetIndices(&indices), expected);
  EXPECT_EQ(memory.is_untouched(), expected != GLEV_SUCCESS);
  return indices;
}

constexpr glev_result kWrong = GLEV_ERROR_INVALID_ARGUMENT, kSmall = GLEV_ERROR_BUFFER_TOO_SMALL,
                      kSizeError = GLEV_ERROR_STRUCTURE_SIZE;

class IndicesOfMeshes : public ContextTest {
 protected:
  using Corner = std::vector<std::uint64_t>;  // a vertex by its bits

  IndicesOfMeshes() {
    Chance chance;
    define_maps(gl, chance, 4);
    glevEnable(gl, GLEV_MAP1_VERTEX_3);
    glevEnable(gl, GLEV_MAP2_VERTEX_3);
    glevMapGrid1f(gl, 7, 0.1F, 0.9F);
    glevMapGrid2f(gl, 7, 0.1F, 0.9F, 5, 1, -0.5F);
  }

  // Returns the corners to which indices of vertices of a mesh refer.
  std::vector<Corner> expected_corners(std::size_t dimension, const Range& range, std::size_t first,
                                       const std::vector<std::uint32_t>& numbers) {
    const Plan plan(gl, dimension);
    const Floats values = evaluate_grid(plan, GLEV_ATTRIBUTE_VERTEX, range);
    std::vector<Corner> corners;
    for (std::uint32_t number : numbers) {
      EXPECT_GE(number, first);
      const float* vertex = values.data() + 3 * (number - first);
      corners.push_back(bits_of(Floats{vertex, vertex + 3}));
    }
    return corners;
  }

  // Returns the corners of the points, lines or triangles that the sink has received.
  std::vector<Corner> drawn_corners() const {
    std::vector<Corner> corners;
    std::size_t at = 0;
    for (std::size_t primitive = 0; primitive < recording.begun.size(); ++primitive) {
      const std::size_t size = sizes_[primitive];
      const auto corner = [&](std::size_t k) {
        const float* position = recording.vertices[at + k].position;
        return bits_of(Floats{position, position + 3});
      };
      switch (recording.begun[primitive]) {
        case GLEV_POINTS:
          for (std::size_t k = 0; k < size; ++k) corners.push_back(corner(k));
          break;
        case GLEV_LINE_STRIP:
          for (std::size_t k = 1; k < size; ++k) {
            corners.push_back(corner(k - 1));
            corners.push_back(corner(k));
          }
          break;
        case GLEV_QUAD_STRIP:
          // Quadrilateral k is 2k, 2k+1, 2k+3, 2k+2.
          for (std::size_t k = 0; k + 3 < size; k += 2) {
            for (std::size_t c : {k, k + 1, k + 2, k + 2, k + 1, k + 3}) corners.push_back(corner(c));
          }
          break;
      }
      at += size;
    }
    return corners;
  }

  void draw2(glev_enum mode, const Range& range) {
    recording = {};
    sizes_.clear();
    const auto strips = [&](std::size_t count, std::size_t size) {
      sizes_.insert(sizes_.end(), count, size);
    };
    glevEvalMesh2(gl, mode, range.i1, range.i2, range.j1, range.j2);
    const std::size_t columns = range.columns(), rows = range.rows();
    if (mode == GLEV_POINT) strips(1, columns * rows);
    if (mode == GLEV_LINE) strips(rows, columns), strips(columns, rows);
    if (mode == GLEV_FILL) strips(rows - 1, 2 * columns);
    ASSERT_EQ(recording.begun.size(), sizes_.size());
  }

  std::vector<std::size_t> sizes_;  // number of vertices of each primitive
};

TEST_F(IndicesOfMeshes, MakeThePrimitivesOfEvalMesh2) {
  for (int columns = 1; columns <= 5; ++columns) {
    for (int rows = 1; rows <= 5; ++rows) {
      const Range range = {1, columns, -1, rows - 2};
      for (glev_enum mode : {GLEV_POINT, GLEV_LINE, GLEV_FILL}) {
        draw2(mode, range);
        const std::vector<Corner> drawn = drawn_corners();
        for (glev_enum type : kIndexTypes) {
          for (std::size_t first : {0, 200}) {
            const auto numbers = get_indices(make_indices(mode, range.columns(), range.rows(), type, first));
            EXPECT_EQ(expected_corners(2, range, first, numbers), drawn)
                << std::hex << mode << std::dec << ", " << columns << " x " << rows << ", from " << first;
          }
        }
      }
    }
  }
}

TEST_F(IndicesOfMeshes, MakeThePrimitivesOfEvalMesh1) {
  for (int columns = 1; columns <= 5; ++columns) {
    const Range range = {-2, columns - 3};
    for (glev_enum mode : {GLEV_POINT, GLEV_LINE}) {
      recording = {};
      glevEvalMesh1(gl, mode, range.i1, range.i2);
      sizes_ = {range.columns()};
      EXPECT_EQ(expected_corners(1, range, 7,
                                 get_indices(make_indices(mode, range.columns(), 1, GLEV_UNSIGNED_BYTE, 7))),
                drawn_corners());
    }
    EXPECT_TRUE(get_indices(make_indices(GLEV_FILL, range.columns(), 1)).empty());
  }
}

// In the plane of the indices, both triangles of a cell have the orientation of the strip, and every cell is
// covered once.
TEST(IndexBuffers, TrianglesTurnOneWayAndCoverEveryCell) {
  constexpr int kColumns = 5, kRows = 4;
  const std::vector<std::uint32_t> numbers = get_indices(make_indices(GLEV_FILL, kColumns, kRows));
  ASSERT_EQ(numbers.size(), 6u * (kColumns - 1) * (kRows - 1));
  std::multiset<int> cells;
  for (std::size_t k = 0; k < numbers.size(); k += 3) {
    int x[3], y[3];
    for (std::size_t c = 0; c < 3; ++c) {
      x[c] = static_cast<int>(numbers[k + c]) % kColumns;
      y[c] = static_cast<int>(numbers[k + c]) / kColumns;
    }
    // This is twice the area; a quadrilateral (0,0) (0,1) (1,1) (1,0) is clockwise.
    EXPECT_EQ((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]), -1);
    cells.insert(*std::min_element(x, x + 3) + kColumns * *std::min_element(y, y + 3));
  }
  for (int j = 0; j + 1 < kRows; ++j) {
    for (int i = 0; i + 1 < kColumns; ++i) EXPECT_EQ(cells.count(i + kColumns * j), 2u);
  }
}

TEST(IndexBuffers, HoldTheNumbersOfTheirType) {
  for (glev_enum type : kIndexTypes) {
    const std::size_t largest = (std::size_t{1} << (8 * bytes_of_index(type))) - 1;
    const auto count = [&](std::size_t columns, std::size_t rows, std::size_t first) {
      const glev_indices indices = make_indices(GLEV_POINT, columns, rows, type, first);
      return glevGetIndexCount(&indices);
    };
    EXPECT_EQ(count(1, 1, largest), 1u);
    EXPECT_EQ(count(1, 1, largest + 1), 0u);
    EXPECT_EQ(count(2, 3, largest - 5), 6u);
    EXPECT_EQ(count(2, 3, largest - 4), 0u);
    EXPECT_EQ(count(largest + 1, 1, 0), largest + 1);
    EXPECT_EQ(count(largest + 1, 1, 1), 0u);
    EXPECT_EQ(count(1, largest + 2, 0), 0u);
    EXPECT_EQ(count(2, 1, SIZE_MAX), 0u);
    EXPECT_EQ(count(SIZE_MAX, 1, 0), 0u);
    EXPECT_EQ(count(SIZE_MAX, SIZE_MAX, 0), 0u);
    EXPECT_EQ(count(std::size_t{1} << 32, std::size_t{1} << 32, 0), 0u);
    const std::vector<std::uint32_t> numbers = get_indices(make_indices(GLEV_FILL, 2, 2, type, largest - 3));
    EXPECT_EQ(numbers.back(), static_cast<std::uint32_t>(largest));
    EXPECT_EQ(numbers.front(), static_cast<std::uint32_t>(largest - 3));
  }
  // The number of indices can be computed, but they are too many to write.
  const glev_indices most = make_indices(GLEV_FILL, 1 << 16, 1 << 16);
  EXPECT_EQ(glevGetIndexCount(&most), 6 * std::size_t{65535} * 65535);
}

TEST(IndexBuffers, OfNoVerticesAreEmpty) {
  for (glev_enum mode : {GLEV_POINT, GLEV_LINE, GLEV_FILL, GLEV_TRIANGLE_STRIP}) {
    for (auto [columns, rows] : {std::pair<std::size_t, std::size_t>{0, 0}, {0, 5}, {5, 0}, {SIZE_MAX, 0}}) {
      const glev_indices indices = make_indices(mode, columns, rows);
      EXPECT_EQ(glevGetIndexCount(&indices), 0u);
      EXPECT_EQ(glevGetIndices(&indices), GLEV_SUCCESS);
    }
  }
}

TEST(IndexBuffers, MisuseIsRefusedAndNothingWritten) {
  const auto count = [](glev_result expected, const auto& change) {
    const auto changed = expect_result(expected, make_indices(GLEV_LINE, 4, 3, GLEV_UNSIGNED_SHORT), change);
    return glevGetIndexCount(&changed);
  };
  EXPECT_EQ(glevGetIndices(nullptr), kWrong);
  EXPECT_EQ(glevGetIndexCount(nullptr), 0u);
  for (std::size_t size : {std::size_t{0}, offsetof(glev_indices, patches) - 1})
    EXPECT_EQ(count(kSizeError, [&](glev_indices& indices) { indices.size = size; }), 0u);
  for (glev_enum mode : {GLEV_POINTS, GLEV_LINES, 0x1AFF, 0x1B03})
    EXPECT_EQ(count(kWrong, [&](glev_indices& indices) { indices.mode = mode; }), 0u);
  EXPECT_EQ(count(kWrong, [&](glev_indices& indices) { indices.mode = 0, indices.rows = 0; }), 0u);
  for (glev_enum type : {0, GLEV_BYTE, GLEV_SHORT, GLEV_INT, GLEV_FLOAT})
    EXPECT_EQ(count(kWrong, [&](glev_indices& indices) { indices.type = type; }), 0u);
  EXPECT_EQ(count(kWrong, [](glev_indices& indices) { indices.columns = 30000; }), 0u);
  EXPECT_EQ(count(kWrong, [](glev_indices& indices) { indices.rows = SIZE_MAX; }), 0u);
  for (std::size_t first : {std::size_t{65530}, SIZE_MAX})
    EXPECT_EQ(count(kWrong, [&](glev_indices& indices) { indices.first = first; }), 0u);
  // 9 lines along u, 8 along v
  EXPECT_EQ(count(kWrong, [](glev_indices& indices) { indices.data = nullptr; }), 34u);
  for (std::size_t size : {0, 1, 67})
    EXPECT_EQ(count(kSmall, [&](glev_indices& indices) { indices.data_size = size; }), 34u);
}

TEST(IndexBuffers, MisuseOfEdgesIsRefusedAndNothingWritten) {
  const auto count = [](glev_result expected, const auto& change) {
    glev_indices indices = make_indices(GLEV_FILL, 3, 3, GLEV_UNSIGNED_BYTE);
    std::fill_n(indices.edge_segments, 4, 3);
    const glev_indices changed = expect_result(expected, indices, change);
    return glevGetIndexCount(&changed);
  };
  EXPECT_EQ(count(GLEV_SUCCESS, [](glev_indices&) {}), 36u);
  EXPECT_EQ(count(GLEV_SUCCESS, [](glev_indices& indices) { indices.data_size = 36; }), 36u);
  EXPECT_EQ(count(kSmall, [](glev_indices& indices) { indices.data_size = 35; }), 36u);
  for (glev_enum mode : {GLEV_POINT, GLEV_LINE, GLEV_TRIANGLE_STRIP})
    EXPECT_EQ(count(kWrong, [&](glev_indices& indices) { indices.mode = mode; }), 0u);
  for (int edge = 0; edge < 4; ++edge) {
    for (int segments : {0, -1, INT_MIN, 253, INT_MAX})
      EXPECT_EQ(count(kWrong, [&](glev_indices& indices) { indices.edge_segments[edge] = segments; }), 0u);
  }
  for (std::size_t side : {std::size_t{0}, std::size_t{1}, std::size_t{2}, SIZE_MAX}) {
    EXPECT_EQ(count(kWrong, [&](glev_indices& indices) { indices.columns = side; }), 0u);
    EXPECT_EQ(count(kWrong, [&](glev_indices& indices) { indices.rows = side; }), 0u);
  }
  // 13 vertices of each patch
  EXPECT_EQ(count(GLEV_SUCCESS, [](glev_indices& indices) { indices.first = 243; }), 36u);
  EXPECT_EQ(count(kWrong, [](glev_indices& indices) { indices.first = 244; }), 0u);
  EXPECT_EQ(count(kWrong, [](glev_indices& indices) { indices.patches = 20; }), 0u);
  EXPECT_EQ(count(GLEV_SUCCESS, [](glev_indices& indices) { indices.patches = 19; }), 684u);
  // Programs of an earlier version have no edges, whatever follows their structure.
  constexpr std::size_t kEarlier = offsetof(glev_indices, edge_segments);
  EXPECT_EQ(count(GLEV_SUCCESS, [](glev_indices& indices) { indices.size = kEarlier; }), 24u);
}

// Each mesh has the indices that it would have alone.
TEST(IndexBuffers, OfPatchesFollowOneAnother) {
  for (glev_enum mode : {GLEV_POINT, GLEV_LINE, GLEV_FILL}) {
    for (auto [columns, rows] : {std::pair<std::size_t, std::size_t>{1, 1}, {4, 3}, {2, 5}, {1, 3}}) {
      glev_indices patches = make_indices(mode, columns, rows, GLEV_UNSIGNED_SHORT, 9);
      patches.patches = 5;
      std::vector<std::uint32_t> expected;
      for (std::size_t p = 0; p < 5; ++p) {
        const auto own =
            get_indices(make_indices(mode, columns, rows, GLEV_UNSIGNED_SHORT, 9 + p * columns * rows));
        expected.insert(expected.end(), own.begin(), own.end());
      }
      EXPECT_EQ(get_indices(patches), expected);
    }
  }
}

TEST(IndexBuffers, WindingSwapsTheLastTwoOfEachTriangle) {
  for (glev_enum mode : {GLEV_POINT, GLEV_LINE, GLEV_FILL}) {
    glev_indices indices = make_indices(mode, 4, 3);
    const std::vector<std::uint32_t> clockwise = get_indices(indices);
    indices.winding = GLEV_CW;
    EXPECT_EQ(get_indices(indices), clockwise);
    indices.winding = GLEV_CCW;
    std::vector<std::uint32_t> other = get_indices(indices);
    for (std::size_t k = 0; mode == GLEV_FILL && k < other.size(); k += 3)
      std::swap(other[k + 1], other[k + 2]);
    EXPECT_EQ(other, clockwise);
  }
}

using Triangle = std::array<std::uint32_t, 3>;

// Returns a triangle in its order and from its smallest vertex on.
Triangle from_smallest(Triangle own) {
  std::rotate(own.begin(), std::min_element(own.begin(), own.end()), own.end());
  return own;
}

std::multiset<Triangle> triangles_of_strips(const std::vector<std::uint32_t>& numbers,
                                            std::uint32_t restart) {
  std::multiset<Triangle> triangles;
  for (std::size_t k = 0, first = 0; k < numbers.size(); ++k) {
    if (numbers[k] == restart) first = k + 1;
    if (k < first + 2) continue;
    Triangle own = {numbers[k - 2], numbers[k - 1], numbers[k]};
    if ((k - first) % 2 == 1) std::swap(own[0], own[1]);
    triangles.insert(from_smallest(own));
  }
  return triangles;
}

TEST(IndexBuffers, StripsHaveTheTrianglesOfFill) {
  for (std::size_t columns = 1; columns <= 5; ++columns) {
    for (std::size_t rows = 1; rows <= 5; ++rows) {
      for (glev_enum winding : {0, GLEV_CW, GLEV_CCW}) {
        for (glev_enum type : kIndexTypes) {
          glev_indices indices = make_indices(GLEV_TRIANGLE_STRIP, columns, rows, type, 60);
          indices.winding = winding;
          indices.patches = columns % 2 == 0 ? 3 : 1;
          const auto restart =
              static_cast<std::uint32_t>((std::uint64_t{1} << (8 * bytes_of_index(type))) - 1);
          const std::vector<std::uint32_t> strips = get_indices(indices);
          indices.mode = GLEV_FILL;
          const std::vector<std::uint32_t> fill = get_indices(indices);
          std::multiset<Triangle> expected;
          for (std::size_t k = 0; k < fill.size(); k += 3)
            expected.insert(from_smallest({fill[k], fill[k + 1], fill[k + 2]}));
          EXPECT_EQ(triangles_of_strips(strips, restart), expected)
              << columns << " x " << rows << ", winding " << winding;
          // One restart between two strips, and none at the ends.
          const std::size_t count = winding == GLEV_CCW ? columns - 1 : rows - 1;
          EXPECT_EQ(static_cast<std::size_t>(std::count(strips.begin(), strips.end(), restart)),
                    fill.empty() ? 0 : indices.patches * count - 1);
          EXPECT_TRUE(strips.empty() || strips.back() != restart);
        }
      }
    }
  }
}

TEST(IndexBuffers, StripsKeepTheLargestNumberForRestarts) {
  for (glev_enum type : kIndexTypes) {
    const std::size_t largest = (std::size_t{1} << (8 * bytes_of_index(type))) - 1;
    for (std::size_t first : {largest - 3, largest - 4}) {
      const glev_indices indices = make_indices(GLEV_TRIANGLE_STRIP, 2, 2, type, first);
      EXPECT_EQ(glevGetIndexCount(&indices), first == largest - 4 ? 4u : 0u);
    }
  }
}

// Vertices of a few bytes with few different values, between bytes that are not compared.
class SharedVertices : public ::testing::Test {
 protected:
  static constexpr std::size_t kColumns = 7, kRows = 5, kPatches = 6, kVertices = kColumns * kRows * kPatches;

  // Returns the indices. The scratch memory and the vertices are next to guard pages.
  std::vector<std::uint32_t> share(std::size_t bytes, std::size_t stride, Guarded::Side side,
                                   std::size_t shift = 0) {
    Guarded vertices((kVertices - 1) * stride + bytes, side);
    for (std::size_t i = 0; i < kVertices; ++i) {
      for (std::size_t b = 0; b < bytes; ++b) vertices.data()[i * stride + b] = 0;
      // Vertices may differ only in the first or only in the last byte.
      vertices.data()[i * stride] = static_cast<unsigned char>(chance_.whole(0, 9));
      vertices.data()[i * stride + bytes - 1] ^= static_cast<unsigned char>(chance_.whole(0, 3));
      for (std::size_t b = bytes; b < stride && i + 1 < kVertices; ++b)
        vertices.data()[i * stride + b] = static_cast<unsigned char>(chance_.whole(0, 255));
    }
    glev_indices indices = make_indices(GLEV_FILL, kColumns, kRows, GLEV_UNSIGNED_SHORT, 100);
    indices.patches = kPatches;
    const std::vector<std::uint32_t> all = get_indices(indices);
    indices.vertices = vertices.data();
    indices.vertices_size = vertices.size();
    indices.vertex_stride = stride;
    indices.vertex_bytes = bytes;
    vertices.make_read_only();
    Guarded scratch(glevGetIndexScratchSize(&indices) + shift, side);
    indices.scratch = scratch.data() + shift;
    indices.scratch_size = scratch.size() - shift;
    std::vector<std::uint32_t> shared = get_indices(indices);
    EXPECT_EQ(shared.size(), all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto vertex = [&](std::size_t number) { return vertices.data() + number * stride; };
      std::size_t first = 0;
      while (std::memcmp(vertex(first), vertex(all[k] - 100), bytes) != 0) ++first;
      EXPECT_EQ(shared[k], first + 100) << "index " << k;
    }
    EXPECT_NE(shared, all);
    return shared;
  }

  Chance chance_;
};

TEST_F(SharedVertices, AreTheFirstOnesOfEqualBits) {
  for (auto side : {Guarded::Side::kBegin, Guarded::Side::kEnd}) {
    for (std::size_t bytes : {1, 3, 4, 8, 12, 13, 24}) share(bytes, bytes, side);
    share(12, 24, side);
    share(12, 29, side);
    for (std::size_t shift : {1, 2, 3}) share(12, 12, side, shift);
  }
}

TEST_F(SharedVertices, MisuseIsRejectedAndNothingWritten) {
  const float vertices[12][3] = {};
  Memory scratch(1000);
  const auto size_of_scratch = [&](glev_result expected, const auto& change) {
    glev_indices indices = make_indices(GLEV_FILL, 3, 2);
    indices.patches = 2;
    indices.vertices = vertices;
    indices.vertices_size = sizeof vertices;
    indices.vertex_stride = indices.vertex_bytes = 12;
    indices.scratch = scratch.data();
    indices.scratch_size = glevGetIndexScratchSize(&indices);
    const glev_indices changed = expect_result(expected, indices, change);
    return glevGetIndexScratchSize(&changed);
  };
  const std::size_t size = size_of_scratch(GLEV_SUCCESS, [](glev_indices&) {});
  EXPECT_NE(size, 0u);
  EXPECT_EQ(size_of_scratch(kWrong, [](glev_indices& indices) { indices.winding = 1; }), 0u);
  for (std::size_t patches : {SIZE_MAX, std::size_t{1} << 62})
    EXPECT_EQ(size_of_scratch(kWrong, [&](glev_indices& indices) { indices.patches = patches; }), 0u);
  for (std::size_t bytes : {0, 13})
    EXPECT_EQ(size_of_scratch(kWrong, [&](glev_indices& indices) { indices.vertex_bytes = bytes; }), 0u);
  EXPECT_EQ(
      size_of_scratch(kWrong, [](glev_indices& indices) { indices.patches = 1 << 30, indices.columns = 2; }),
      0u);
  EXPECT_EQ(size_of_scratch(kWrong, [](glev_indices& indices) { indices.scratch = nullptr; }), size);
  EXPECT_EQ(size_of_scratch(kSmall, [](glev_indices& indices) { --indices.scratch_size; }), size);
  for (std::size_t bytes : {sizeof vertices - 1, std::size_t{11}})
    EXPECT_EQ(size_of_scratch(kSmall, [&](glev_indices& indices) { indices.vertices_size = bytes; }), size);
  EXPECT_EQ(size_of_scratch(kSmall, [](glev_indices& indices) { indices.vertex_stride = SIZE_MAX; }), size);
  EXPECT_EQ(size_of_scratch(kSmall, [](glev_indices& indices) { indices.data_size = 95; }), size);
  EXPECT_EQ(size_of_scratch(GLEV_SUCCESS, [](glev_indices& indices) { indices.vertices = nullptr; }), 0u);
  EXPECT_EQ(glevGetIndexScratchSize(nullptr), 0u);
}

}  // namespace
}  // namespace glev_tests
