// Tests that glevEvaluate, glevEvaluateMesh and glevGetMeshScratchSize reject each invalid member with the
// right result, without writing anything.
#include <climits>
#include <functional>

#include "misuse.h"

namespace glev_tests {
namespace {

constexpr std::size_t kRoom = 4096;

// Valid calls of both dimensions, which tests make invalid.
class Misuse : public ContextTest {
 protected:
  static constexpr std::size_t kPoints = 5;

  Misuse() {
    Chance chance;
    define_maps(gl, chance, 4);
    for (glev_enum target : {GLEV_MAP1_VERTEX_3, GLEV_MAP1_TEXTURE_COORD_2, GLEV_MAP2_VERTEX_3,
                             GLEV_MAP2_TEXTURE_COORD_2, GLEV_MAP2_NORMAL}) {
      glevEnable(gl, target);
    }
  }

  // A batch and a mesh that tests change; both have the same outputs.
  struct Call {
    glev_batch batch;
    glev_mesh mesh;
    glev_output vertex, texcoord, tangent;
    std::vector<glev_attribute_output> outputs = {};

    void set_outputs(std::vector<glev_attribute_output> others) {
      outputs = std::move(others);
      batch.outputs = mesh.outputs = outputs.data();
      batch.output_count = mesh.output_count = outputs.size();
    }
  };
  using Change = std::function<void(Call&)>;
  enum class Kind { kBatch, kMesh };

  // Changes a valid call and expects its result.
  void expect(glev_result expected, Kind kind, std::size_t dimension, const char* what,
              const Change& change) {
    SCOPED_TRACE(testing::Message() << what << (kind == Kind::kBatch ? ", batch" : ", mesh")
                                    << " of dimension " << dimension);
    Memory memory(kRoom), scratch(kRoom);
    const Plan plan(gl, dimension);
    const glev_input input = input_of(arguments_);
    Call call = {{sizeof(glev_batch), kPoints, GLEV_FLOAT, GLEV_CORRECTLY_ROUNDED, input,
                  dimension == 2 ? input : glev_input{}, nullptr, 0},
                 mesh_of({0, 4, 0, dimension == 1 ? 0 : 2}),
                 memory.make_output(0, 24, 3),
                 memory.make_output(12, 24, 2),
                 memory.make_output(1000, 12, 3)};
    call.mesh.scratch = scratch.data();
    call.mesh.scratch_size = scratch.size();
    call.set_outputs({{GLEV_ATTRIBUTE_VERTEX, &call.vertex}, {GLEV_ATTRIBUTE_TEXCOORD, &call.texcoord}});
    if (dimension == 2) {
      call.set_outputs({{GLEV_ATTRIBUTE_VERTEX, &call.vertex},
                        {GLEV_ATTRIBUTE_TEXCOORD, &call.texcoord},
                        {GLEV_ATTRIBUTE_TANGENT_U, &call.tangent}});
    }
    change(call);
    EXPECT_EQ(kind == Kind::kBatch ? glevEvaluate(plan, &call.batch) : glevEvaluateMesh(plan, &call.mesh),
              expected);
    EXPECT_EQ(memory.is_untouched(), expected != GLEV_SUCCESS);
    EXPECT_TRUE(expected == GLEV_SUCCESS || scratch.is_untouched());
  }
  void expect_both(glev_result expected, std::size_t dimension, const char* what, const Change& change) {
    for (Kind kind : {Kind::kBatch, Kind::kMesh}) expect(expected, kind, dimension, what, change);
  }
  void expect_all(glev_result expected, const char* what, const Change& change) {
    for (std::size_t dimension : {1, 2}) expect_both(expected, dimension, what, change);
  }
  void expect_batch(glev_result expected, std::size_t dimension, const char* what,
                    const std::function<void(glev_batch&)>& change) {
    expect(expected, Kind::kBatch, dimension, what, [&](Call& call) { change(call.batch); });
  }
  void expect_mesh(glev_result expected, std::size_t dimension, const char* what,
                   const std::function<void(glev_mesh&)>& change) {
    expect(expected, Kind::kMesh, dimension, what, [&](Call& call) { change(call.mesh); });
  }

  const Floats arguments_ = {0, 0.25F, 0.5F, 0.75F, 1};
};

TEST_F(Misuse, WhatWouldDoDoes) {
  expect_all(GLEV_SUCCESS, "nothing", [](Call&) {});
  expect_all(GLEV_SUCCESS, "no outputs but one",
             [](Call& call) { call.batch.output_count = call.mesh.output_count = 1; });
  expect_all(GLEV_SUCCESS, "another order", [](Call& call) {
    call.set_outputs({{GLEV_ATTRIBUTE_TEXCOORD, &call.texcoord}, {GLEV_ATTRIBUTE_VERTEX, &call.vertex}});
  });
}

TEST_F(Misuse, OfListsOfOutputs) {
  expect_all(kInvalid, "null", [](Call& call) { call.batch.outputs = call.mesh.outputs = nullptr; });
  expect_all(kInvalid, "a null output", [](Call& call) { call.outputs[1].output = nullptr; });
  expect_all(kInvalid, "the same attribute twice", [](Call& call) {
    call.set_outputs({{GLEV_ATTRIBUTE_TEXCOORD, &call.texcoord}, {GLEV_ATTRIBUTE_TEXCOORD, &call.vertex}});
  });
  for (int attribute : {9, 10, -1, INT_MAX, INT_MIN})
    expect_all(kInvalid, "no attribute",
               [&](Call& call) { set_number(call.outputs[1].attribute, attribute); });
  expect_all(kOverlap, "one byte",
             [](Call& call) { call.texcoord.data = static_cast<std::byte*>(call.vertex.data) + 11; });
}

TEST_F(Misuse, OfOutputs) {
  const auto expect_each = [&](glev_result expected, const char* what, const auto& change) {
    expect_all(expected, what, [&](Call& call) { change(call.vertex); });
    expect_all(expected, what, [&](Call& call) {
      call.texcoord.components = 3;  // 12 bytes, too
      change(call.texcoord);
    });
    expect_both(expected, 2, what, [&](Call& call) { change(call.tangent); });
  };
  for (const OutputMisuse& misuse : kOutputMisuses) expect_each(misuse.result, misuse.what, misuse.change);
  expect_each(kTooSmall, "one byte less",
              [](glev_output& output) { output.data_size = 4 * output.stride + 11; });
  expect_each(kInvalid, "a patch stride", [](glev_output& output) { output.patch_stride = 1000; });
}

TEST_F(Misuse, OfComponents) {
  expect_all(kInvalid, "vertex", [](Call& call) { call.vertex.components = 2; });
  expect_all(kInvalid, "texture coordinate", [](Call& call) { call.texcoord.components = 1; });
  expect_both(kInvalid, 2, "normal of 4", [](Call& call) {
    call.texcoord.components = 4;
    call.texcoord.stride = 16;
    call.set_outputs({{GLEV_ATTRIBUTE_NORMAL, &call.texcoord}});
  });
}

TEST_F(Misuse, OfAttributesWithoutAMap) {
  const auto expect_none = [&](std::size_t dimension, glev_attribute attribute) {
    expect_both(GLEV_ERROR_NO_MAP, dimension, "no map", [&](Call& call) {
      call.texcoord.components = attribute == GLEV_ATTRIBUTE_NORMAL ? 3 : 4;
      call.texcoord.stride = 16;
      call.texcoord.data_size = 0;  // checked later
      call.set_outputs({{attribute, &call.texcoord}});
    });
  };
  constexpr glev_attribute kDerivatives[] = {GLEV_ATTRIBUTE_TANGENT_U, GLEV_ATTRIBUTE_TANGENT_V,
                                             GLEV_ATTRIBUTE_SECOND_UU, GLEV_ATTRIBUTE_SECOND_UV,
                                             GLEV_ATTRIBUTE_SECOND_VV};
  for (std::size_t dimension : {1, 2}) expect_none(dimension, GLEV_ATTRIBUTE_COLOR);
  for (glev_attribute attribute : kDerivatives) expect_none(1, attribute);
  glevDisable(gl, GLEV_MAP2_VERTEX_3);
  for (glev_attribute attribute : kDerivatives) expect_none(2, attribute);
  for (const TargetRow& row : kTargetRows) {
    glevDisable(gl, GLEV_MAP1_COLOR_4 + row.offset);
    glevDisable(gl, GLEV_MAP2_COLOR_4 + row.offset);
  }
  for (std::size_t dimension : {1, 2}) {
    for (glev_attribute attribute : kEveryAttribute) expect_none(dimension, attribute);
  }
}

TEST_F(Misuse, OfBatches) {
  for (std::size_t dimension : {1, 2}) {
    const auto expect = [&](glev_result expected, const char* what, const auto& change) {
      expect_batch(expected, dimension, what, change);
    };
    expect(kWrongSize, "size 0", [](glev_batch& batch) { batch.size = 0; });
    expect(kWrongSize, "size - 1", [](glev_batch& batch) { --batch.size; });
    for (glev_enum type : {glev_enum{0}, glev_enum{GLEV_INT}, glev_enum{1}})
      expect(kInvalid, "type", [&](glev_batch& batch) { batch.type = type; });
    for (int precision : {2, -1, INT_MAX})
      expect(kInvalid, "precision", [&](glev_batch& batch) { set_number(batch.precision, precision); });
    expect(kInvalid, "u without data", [](glev_batch& batch) { batch.u.data = nullptr; });
    expect(kTooSmall, "u without bytes", [](glev_batch& batch) { batch.u.data_size = 0; });
    expect(kTooSmall, "u of one byte less", [](glev_batch& batch) { --batch.u.data_size; });
    expect(kTooSmall, "u of floats", [](glev_batch& batch) { batch.type = GLEV_DOUBLE; });
    expect(kTooSmall, "u farther apart", [](glev_batch& batch) { batch.u.stride = 5; });
    expect(kTooSmall, "u far apart",
           [](glev_batch& batch) { batch.u.stride = SIZE_MAX, batch.u.data_size = SIZE_MAX; });
    expect(kTooSmall, "one argument more", [](glev_batch& batch) { ++batch.count; });
    expect(kTooSmall, "all arguments", [](glev_batch& batch) { batch.count = SIZE_MAX; });
  }
  expect_batch(kInvalid, 2, "no v", [](glev_batch& batch) { batch.v = {}; });
  expect_batch(kInvalid, 2, "v without data", [](glev_batch& batch) { batch.v.data = nullptr; });
  expect_batch(kTooSmall, 2, "v of one byte less", [](glev_batch& batch) { --batch.v.data_size; });
  expect_batch(kTooSmall, 2, "v farther apart", [](glev_batch& batch) { ++batch.v.stride; });
  expect_batch(kInvalid, 1, "a v", [](glev_batch& batch) { batch.v = batch.u; });
  expect_batch(kInvalid, 1, "v's data", [](glev_batch& batch) { batch.v.data = batch.u.data; });
  expect_batch(kInvalid, 1, "v's bytes", [](glev_batch& batch) { batch.v.data_size = 1; });
  expect_batch(kInvalid, 1, "v's stride", [](glev_batch& batch) { batch.v.stride = 1; });
  const Plan curve(gl, 1);
  glev_batch batch{};
  batch.size = sizeof batch;
  EXPECT_EQ(glevEvaluate(nullptr, &batch), kInvalid);
  EXPECT_EQ(glevEvaluate(curve, nullptr), kInvalid);
}

TEST_F(Misuse, OfCountsThatOverflow) {
  for (std::size_t count :
       {SIZE_MAX, SIZE_MAX / 4, SIZE_MAX / 12 - 1000, SIZE_MAX / 12 + 2, SIZE_MAX / 2 + 2}) {
    for (std::size_t stride : {std::size_t{12}, SIZE_MAX / 2 + 1, SIZE_MAX}) {
      for (std::size_t size : {kRoom, SIZE_MAX}) {
        for (std::size_t u_stride : {std::size_t{0}, sizeof(float)}) {
          SCOPED_TRACE(testing::Message() << count << " of stride " << stride << " in " << size);
          expect(kTooSmall, Kind::kBatch, 1, "count", [&](Call& call) {
            call.set_outputs({{GLEV_ATTRIBUTE_VERTEX, &call.vertex}});
            call.vertex.stride = stride;
            call.vertex.data_size = size;
            call.batch.count = count;
            call.batch.u.stride = u_stride;
          });
        }
      }
    }
  }
}

TEST_F(Misuse, OfMeshes) {
  for (std::size_t dimension : {1, 2}) {
    const auto expect = [&](glev_result expected, const char* what, const auto& change) {
      expect_mesh(expected, dimension, what, change);
    };
    expect(kWrongSize, "size 0", [](glev_mesh& mesh) { mesh.size = 0; });
    expect(kWrongSize, "size - 1", [](glev_mesh& mesh) { --mesh.size; });
    expect(kInvalid, "precision", [](glev_mesh& mesh) { set_number(mesh.precision, 2); });
    expect(kInvalid, "scratch without data", [](glev_mesh& mesh) { mesh.scratch = nullptr; });
    expect(kTooSmall, "no scratch", [](glev_mesh& mesh) { mesh.scratch = nullptr, mesh.scratch_size = 0; });
    expect(kTooSmall, "more columns", [](glev_mesh& mesh) { mesh.i2 = 1000; });
  }
  for (auto member : {&glev_mesh::j1, &glev_mesh::j2}) {
    for (int j : {1, -1})
      expect_mesh(kInvalid, 1, "rows of a curve", [&](glev_mesh& mesh) { mesh.*member = j; });
  }
  const Plan curve(gl, 1);
  glev_mesh mesh = mesh_of({0, 3, 0, 1});
  EXPECT_EQ(glevGetMeshScratchSize(curve, &mesh), 0u);
  mesh.j2 = 0;
  EXPECT_NE(glevGetMeshScratchSize(curve, &mesh), 0u);
  mesh.size = 3;
  EXPECT_EQ(glevGetMeshScratchSize(curve, &mesh), 0u);
}

// The scratch size is 0 only for rejected meshes.
TEST_F(Misuse, ScratchOfAMeshWithoutPointsIsNotZero) {
  const Plan curve(gl, 1);
  const glev_mesh mesh = mesh_of({3, 0}, GLEV_FAST);
  EXPECT_NE(glevGetMeshScratchSize(curve, &mesh), 0u);
  EXPECT_EQ(glevEvaluateMesh(curve, &mesh), GLEV_SUCCESS);
  EXPECT_EQ(glevGetMeshScratchSize(nullptr, &mesh), 0u);
  EXPECT_EQ(glevEvaluateMesh(nullptr, &mesh), kInvalid);
  EXPECT_EQ(glevGetMeshScratchSize(curve, nullptr), 0u);
}

// Batches without outputs or points are checked like any other, and neither read nor write.
TEST_F(Misuse, BatchesWithoutOutputsOrPointsAreLegal) {
  const Plan curve(gl, 1);
  const Floats u = {0, 1};
  glev_batch batch = {sizeof batch, 2, GLEV_FLOAT, GLEV_CORRECTLY_ROUNDED, input_of(u), {}, nullptr, 0};
  EXPECT_EQ(glevEvaluate(curve, &batch), GLEV_SUCCESS);
  batch.u.data_size = sizeof(float);
  EXPECT_EQ(glevEvaluate(curve, &batch), kTooSmall);
  batch.u.data = nullptr;
  EXPECT_EQ(glevEvaluate(curve, &batch), kInvalid);
  batch.count = batch.u.data_size = 0;
  Memory memory(kRoom);
  for (void* data : {static_cast<void*>(nullptr), static_cast<void*>(memory.data())}) {
    glev_output vertex = {sizeof vertex, data, 0, 12, 3, 0, 0, 0};
    const Outputs outputs(batch, {{GLEV_ATTRIBUTE_VERTEX, &vertex}});
    EXPECT_EQ(glevEvaluate(curve, &batch), GLEV_SUCCESS);
    vertex.components = 2;  // also invalid
    EXPECT_EQ(glevEvaluate(curve, &batch), kInvalid);
  }
  EXPECT_TRUE(memory.is_untouched());
}

TEST_F(Misuse, OfRowStrides) {
  const auto expect_stride = [&](glev_result expected, Kind kind, std::size_t dimension,
                                 std::size_t row_stride, std::size_t bytes = kRoom) {
    SCOPED_TRACE(testing::Message() << row_stride << " in " << bytes << " bytes");
    expect(expected, kind, dimension, "row stride", [&](Call& call) {
      call.set_outputs({{GLEV_ATTRIBUTE_VERTEX, &call.vertex}});
      call.vertex.row_stride = row_stride;
      call.vertex.data_size = bytes;
    });
  };
  // A row ends 12 bytes after the beginning of its last element.
  constexpr std::size_t kRow = 4 * 24 + 12;
  expect_stride(GLEV_SUCCESS, Kind::kMesh, 2, kRow);
  expect_stride(kInvalid, Kind::kMesh, 2, kRow - 1);
  expect_stride(kInvalid, Kind::kMesh, 2, 1);
  expect_stride(kTooSmall, Kind::kMesh, 2, SIZE_MAX);
  expect_stride(kTooSmall, Kind::kMesh, 2, SIZE_MAX / 2 + 1);
  expect_stride(kInvalid, Kind::kMesh, 1, 4 * 24 + 24);
  for (std::size_t dimension : {1, 2}) expect_stride(kInvalid, Kind::kBatch, dimension, 4 * 24 + 24);
  // two more rows, or one byte less
  expect_stride(GLEV_SUCCESS, Kind::kMesh, 2, 200, 2 * 200 + kRow);
  expect_stride(kTooSmall, Kind::kMesh, 2, 200, 2 * 200 + kRow - 1);
}

TEST_F(Misuse, LaterVersionsMayBeLargerIfTheRestIsZero) {
  const Plan plan(gl, 2);
  Memory memory(kRoom), scratch(kRoom);
  struct {
    glev_mesh mesh;
    unsigned char rest[16];  // without padding, which would have to be zero, too
  } later = {{sizeof later, 0, 4, 0, 2, GLEV_CORRECTLY_ROUNDED, nullptr, 0, scratch.data(), scratch.size()},
             {}};
  struct {
    glev_output output;
    unsigned char rest[8];
  } output = {memory.make_output(0, 12, 3), {}};
  output.output.size = sizeof output;
  const Outputs outputs(later.mesh, {{GLEV_ATTRIBUTE_VERTEX, &output.output}});
  EXPECT_EQ(glevEvaluateMesh(plan, &later.mesh), GLEV_SUCCESS);
  memory = Memory(kRoom);
  for (unsigned char* byte : {&output.rest[4], &later.rest[0]}) {
    *byte = 1;
    EXPECT_EQ(glevEvaluateMesh(plan, &later.mesh), kWrongSize);
    *byte = 0;
  }
  EXPECT_TRUE(memory.is_untouched());
}

// ---- Overlaps, against sets of bytes

struct Block {
  std::size_t offset, columns, rows, stride, row_stride, element;

  std::vector<bool> bytes_of(std::size_t size) const {
    std::vector<bool> bytes(size);
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i < columns; ++i)
        std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(offset + j * row_stride + i * stride),
                    element, true);
    }
    return bytes;
  }
  std::size_t row() const { return (columns - 1) * stride + element; }
  std::size_t end() const { return offset + (rows - 1) * row_stride + row(); }
};

// Returns true if the blocks must be rejected. If strides differ, their extents decide.
bool is_rejected(const Block& a, const Block& b) {
  const bool extents_overlap = a.offset < b.end() && b.offset < a.end();
  if (a.stride != b.stride || a.row_stride != b.row_stride) return extents_overlap;
  const std::size_t size = std::max(a.end(), b.end());
  const std::vector<bool> in_a = a.bytes_of(size), in_b = b.bytes_of(size);
  for (std::size_t k = 0; k < size; ++k) {
    if (in_a[k] && in_b[k]) return true;
  }
  return false;
}

TEST_F(Misuse, OverlapsOfOutputsAreThoseOfTheirBytes) {
  const Plan plan(gl, 2);
  Chance chance;
  Memory memory(kRoom), scratch(kRoom);
  int refused = 0, interleaved = 0;
  for (int k = 0; k < 20000; ++k) {
    const auto columns = static_cast<std::size_t>(chance.whole(1, 4)),
               rows = static_cast<std::size_t>(chance.whole(1, 3));
    const auto stride = static_cast<std::size_t>(chance.whole(12, 40)),
               row_stride = static_cast<std::size_t>(chance.one_of({0, 100, 40, 160, 129, 300}));
    const auto choose = [&](std::size_t element) {
      const std::size_t least = element + (chance.whole(0, 3) != 0 ? 0 : 3);
      Block block = {static_cast<std::size_t>(chance.whole(0, 250)),
                     columns,
                     rows,
                     std::max(stride, least),
                     row_stride,
                     element};
      block.row_stride = std::max(row_stride, block.row());
      return block;
    };
    Block a = choose(12), b = choose(8);
    if (chance.whole(0, 3) != 0) {
      b.stride = a.stride;
      b.row_stride = a.row_stride = std::max(a.row_stride, b.row_stride);
    }
    if (a.row_stride < a.row() || b.row_stride < b.row()) continue;
    const glev_output vertex = memory.make_output(a.offset, a.stride, 3, 0, a.row_stride),
                      texcoord = memory.make_output(b.offset, b.stride, 2, 0, b.row_stride);
    glev_mesh mesh = mesh_of({0, static_cast<int>(columns) - 1, 0, static_cast<int>(rows) - 1});
    const Outputs outputs(mesh, {{GLEV_ATTRIBUTE_VERTEX, &vertex}, {GLEV_ATTRIBUTE_TEXCOORD, &texcoord}});
    mesh.scratch = scratch.data();
    mesh.scratch_size = scratch.size();
    const bool is_refused = is_rejected(a, b);
    ASSERT_EQ(glevEvaluateMesh(plan, &mesh), is_refused ? kOverlap : GLEV_SUCCESS)
        << columns << " x " << rows << ": " << a.offset << " " << a.stride << " " << a.row_stride << ", "
        << b.offset << " " << b.stride << " " << b.row_stride;
    refused += is_refused;
    interleaved += !is_refused && a.offset < b.end() && b.offset < a.end();
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(interleaved, 1000);
}

TEST_F(Misuse, OutputsMustNotShareBytesWithArguments) {
  for (auto [dimension, member] :
       {std::pair{std::size_t{1}, &glev_batch::u}, {2, &glev_batch::u}, {2, &glev_batch::v}}) {
    const auto expect_input = [&, dimension = dimension, member = member](
                                  glev_result expected, std::size_t offset, std::size_t stride) {
      SCOPED_TRACE(testing::Message() << "arguments at " << offset << ", stride " << stride);
      expect(expected, Kind::kBatch, dimension, "arguments", [&](Call& call) {
        call.batch.*member = {static_cast<std::byte*>(call.vertex.data) + offset, kRoom - offset, stride};
      });
    };
    // vertices at 0, texture coordinates at 12, of 24 bytes
    expect_input(GLEV_SUCCESS, 20, 24);
    expect_input(kOverlap, 19, 24);
    expect_input(kOverlap, 21, 24);
    expect_input(kOverlap, 20, 0);
    expect_input(kOverlap, 20, 23);
    expect_input(kOverlap, 4 * 24 + 16, 4);
    expect_input(GLEV_SUCCESS, 4 * 24 + 20, 4);
    if (dimension == 2) expect_input(kOverlap, 1000 - 4 * 4 - 3, 4);
    if (dimension == 2) expect_input(GLEV_SUCCESS, 1000 - 4 * 4 - 4, 4);
  }
}

TEST_F(Misuse, OutputsMustNotShareBytesWithScratchMemory) {
  const Plan plan(gl, 2);
  glev_mesh mesh = mesh_of({0, 4, 0, 2});
  const std::size_t needed = glevGetMeshScratchSize(plan, &mesh);
  Memory memory(2 * needed + 4096);
  const glev_output vertex = memory.make_output(needed, 24, 3);
  const std::size_t extent = 14 * 24 + 12;
  const Outputs outputs(mesh, {{GLEV_ATTRIBUTE_VERTEX, &vertex}});
  const auto expect = [&](glev_result expected, std::size_t offset, std::size_t size) {
    mesh.scratch = memory.data() + offset;
    mesh.scratch_size = size;
    EXPECT_EQ(glevEvaluateMesh(plan, &mesh), expected) << offset << " " << size;
  };
  // The second offset is between the elements.
  for (std::size_t offset : {std::size_t{1}, needed + 12, needed, needed + extent - 1})
    expect(kOverlap, offset, needed);
  for (std::size_t size : {needed + extent, SIZE_MAX / 2, SIZE_MAX}) expect(kOverlap, 1, size);
  expect(kTooSmall, 1, needed - 1);
  EXPECT_TRUE(memory.is_untouched());
  expect(GLEV_SUCCESS, 0, needed);
  expect(GLEV_SUCCESS, needed + extent, needed);
}

}  // namespace
}  // namespace glev_tests
