// Tests that glevEvaluate, glevEvaluateMesh and glevGetMeshScratchSize reject each invalid member with the
// right result, without writing anything.
#include <climits>
#include <functional>

#include "batches.h"

namespace glev_tests {
namespace {

constexpr std::size_t kNoRoom = 4096;

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

  // A call that tests change.
  struct Call {
    glev_batch batch;
    glev_mesh mesh;
    glev_output vertex, texcoord, tangent;
    std::vector<glev_attribute_output> outputs;
  };
  using Change = std::function<void(Call&)>;

  static void make_change(Call& call, bool has_tangent, const Change& change) {
    call.outputs = {{GLEV_ATTRIBUTE_VERTEX, &call.vertex}, {GLEV_ATTRIBUTE_TEXCOORD, &call.texcoord}};
    if (has_tangent) call.outputs.push_back({GLEV_ATTRIBUTE_TANGENT_U, &call.tangent});
    call.batch.outputs = call.mesh.outputs = call.outputs.data();
    call.batch.output_count = call.mesh.output_count = call.outputs.size();
    change(call);
  }
  // Replaces the outputs in a change.
  static void set_outputs(Call& call, std::vector<glev_attribute_output> outputs) {
    call.outputs = std::move(outputs);
    call.batch.outputs = call.mesh.outputs = call.outputs.data();
    call.batch.output_count = call.mesh.output_count = call.outputs.size();
  }

  glev_result evaluate(std::size_t dimension, const Change& change, Memory& memory) {
    const Plan plan(gl, dimension);
    const glev_input input = {arguments_, sizeof arguments_, sizeof(float)};
    Call call = {{sizeof(glev_batch), kPoints, GLEV_FLOAT, GLEV_CORRECTLY_ROUNDED, input, {}, nullptr, 0},
                 {},
                 memory.make_output(0, 24, 3),
                 memory.make_output(12, 24, 2),
                 memory.make_output(1000, 12, 3),
                 {}};
    if (dimension == 2) call.batch.v = input;
    make_change(call, dimension == 2, change);
    return glevEvaluate(plan, &call.batch);
  }

  glev_result evaluate_mesh(std::size_t dimension, const Change& change, Memory& memory, Memory& scratch) {
    const Plan plan(gl, dimension);
    Call call = {{},
                 {sizeof(glev_mesh), 0, 4, 0, dimension == 1 ? 0 : 2, GLEV_CORRECTLY_ROUNDED, nullptr, 0,
                  scratch.data(), scratch.size()},
                 memory.make_output(0, 24, 3),
                 memory.make_output(12, 24, 2),
                 memory.make_output(1000, 12, 3),
                 {}};
    make_change(call, dimension == 2, change);
    return glevEvaluateMesh(plan, &call.mesh);
  }

  void expect_batch(glev_result expected, std::size_t dimension, const char* what, const Change& change) {
    Memory memory(kNoRoom);
    EXPECT_EQ(evaluate(dimension, change, memory), expected) << what << ", dimension " << dimension;
    EXPECT_EQ(memory.is_untouched(), expected != GLEV_SUCCESS) << what << ", dimension " << dimension;
  }
  void expect_mesh(glev_result expected, std::size_t dimension, const char* what, const Change& change) {
    Memory memory(kNoRoom), scratch(kNoRoom);
    EXPECT_EQ(evaluate_mesh(dimension, change, memory, scratch), expected)
        << what << ", dimension " << dimension;
    EXPECT_EQ(memory.is_untouched(), expected != GLEV_SUCCESS) << what << ", dimension " << dimension;
    EXPECT_TRUE(expected == GLEV_SUCCESS || scratch.is_untouched()) << what;
  }
  void expect_both(glev_result expected, const char* what, const Change& change) {
    for (std::size_t dimension : {1, 2}) {
      expect_batch(expected, dimension, what, change);
      expect_mesh(expected, dimension, what, change);
    }
  }

  float arguments_[kPoints] = {0, 0.25F, 0.5F, 0.75F, 1};
};

constexpr glev_result kInvalid = GLEV_ERROR_INVALID_ARGUMENT, kTooSmall = GLEV_ERROR_BUFFER_TOO_SMALL,
                      kWrongSize = GLEV_ERROR_STRUCTURE_SIZE;

TEST_F(Misuse, WhatWouldDoDoes) {
  expect_both(GLEV_SUCCESS, "nothing", [](Call&) {});
  expect_both(GLEV_SUCCESS, "no outputs but one",
              [](Call& call) { call.batch.output_count = call.mesh.output_count = 1; });
  expect_both(GLEV_SUCCESS, "another order", [](Call& call) {
    set_outputs(call, {{GLEV_ATTRIBUTE_TEXCOORD, &call.texcoord}, {GLEV_ATTRIBUTE_VERTEX, &call.vertex}});
  });
}

TEST_F(Misuse, OfListsOfOutputs) {
  expect_both(kInvalid, "null", [](Call& call) { call.batch.outputs = call.mesh.outputs = nullptr; });
  expect_both(kInvalid, "a null output", [](Call& call) { call.outputs[1].output = nullptr; });
  expect_both(kInvalid, "the same attribute twice", [](Call& call) {
    set_outputs(call, {{GLEV_ATTRIBUTE_TEXCOORD, &call.texcoord}, {GLEV_ATTRIBUTE_TEXCOORD, &call.vertex}});
  });
  for (int attribute : {9, 10, -1, INT_MAX, INT_MIN}) {
    expect_both(kInvalid, "no attribute",
                [&](Call& call) { std::memcpy(&call.outputs[1].attribute, &attribute, sizeof attribute); });
  }
}

TEST_F(Misuse, OfOutputs) {
  const auto change = [&](glev_result expected, const char* what, auto spoil) {
    expect_both(expected, what, [&](Call& call) { spoil(call.vertex); });
    expect_both(expected, what, [&](Call& call) {
      call.texcoord.components = 3;  // 12 bytes, too
      spoil(call.texcoord);
    });
    expect_batch(expected, 2, what, [&](Call& call) { spoil(call.tangent); });
    expect_mesh(expected, 2, what, [&](Call& call) { spoil(call.tangent); });
  };
  change(kWrongSize, "size 0", [](glev_output& output) { output.size = 0; });
  change(kWrongSize, "size below that of the first version",
         [](glev_output& output) { output.size = offsetof(glev_output, patch_stride) - 1; });
  change(kInvalid, "no data", [](glev_output& output) { output.data = nullptr; });
  change(kInvalid, "no components", [](glev_output& output) { output.components = 0; });
  change(kInvalid, "5 components", [](glev_output& output) { output.components = 5, output.stride = 100; });
  change(kInvalid, "all components", [](glev_output& output) { output.components = SIZE_MAX; });
  change(kInvalid, "2^62 components", [](glev_output& output) { output.components = SIZE_MAX / 4 + 1; });
  change(kInvalid, "no stride", [](glev_output& output) { output.stride = 0; });
  change(kInvalid, "short stride", [](glev_output& output) { output.stride = 11; });
  change(kInvalid, "short stride of doubles",
         [](glev_output& output) { output.type = GLEV_DOUBLE, output.stride = 23; });
  for (glev_enum type : {0x1404U, 0x1409U, 1U, 0x140BU, 0xFFFFFFFFU})
    change(kInvalid, "type", [&](glev_output& output) { output.type = type; });
  change(kTooSmall, "no bytes", [](glev_output& output) { output.data_size = 0; });
  change(kTooSmall, "few bytes", [](glev_output& output) { output.data_size = 4 * output.stride + 11; });
  change(kTooSmall, "large stride", [](glev_output& output) { output.stride = SIZE_MAX / 2; });
  change(kTooSmall, "large stride and size",
         [](glev_output& output) { output.stride = SIZE_MAX / 4, output.data_size = SIZE_MAX; });
}

TEST_F(Misuse, OfComponents) {
  expect_both(kInvalid, "vertex", [](Call& call) { call.vertex.components = 2; });
  expect_both(kInvalid, "texture coordinate", [](Call& call) { call.texcoord.components = 1; });
  const auto normal = [&](Call& call) {
    call.texcoord.components = 4;
    call.texcoord.stride = 16;
    set_outputs(call, {{GLEV_ATTRIBUTE_NORMAL, &call.texcoord}});
  };
  expect_mesh(kInvalid, 2, "normal of 4", normal);
  expect_batch(kInvalid, 2, "normal of 4", normal);
}

TEST_F(Misuse, OfAttributesWithoutAMap) {
  for (glev_attribute attribute :
       {GLEV_ATTRIBUTE_COLOR, GLEV_ATTRIBUTE_TANGENT_U, GLEV_ATTRIBUTE_TANGENT_V, GLEV_ATTRIBUTE_SECOND_UU,
        GLEV_ATTRIBUTE_SECOND_UV, GLEV_ATTRIBUTE_SECOND_VV}) {
    const bool is_color = attribute == GLEV_ATTRIBUTE_COLOR;
    const auto ask = [&](Call& call) {
      call.texcoord.components = 4;
      call.texcoord.stride = 16;
      call.texcoord.data_size = 0;  // checked later
      set_outputs(call, {{GLEV_ATTRIBUTE_VERTEX, &call.vertex}, {attribute, &call.texcoord}});
    };
    expect_batch(GLEV_ERROR_NO_MAP, 1, "1", ask);
    expect_mesh(GLEV_ERROR_NO_MAP, 1, "1", ask);
    if (!is_color) continue;
    expect_batch(GLEV_ERROR_NO_MAP, 2, "2", ask);
    expect_mesh(GLEV_ERROR_NO_MAP, 2, "2", ask);
  }
  glevDisable(gl, GLEV_MAP2_VERTEX_3);
  const auto no_vertex = [](Call& call) {
    ++call.batch.outputs, --call.batch.output_count, ++call.mesh.outputs, --call.mesh.output_count;
  };
  expect_batch(GLEV_ERROR_NO_MAP, 2, "tangents of no vertex", no_vertex);
  expect_mesh(GLEV_ERROR_NO_MAP, 2, "tangents of no vertex", no_vertex);
}

TEST_F(Misuse, OfBatches) {
  for (std::size_t dimension : {1, 2}) {
    const auto change = [&](glev_result expected, const char* what, auto spoil) {
      expect_batch(expected, dimension, what, [&](Call& call) { spoil(call.batch); });
    };
    change(kWrongSize, "size 0", [](glev_batch& batch) { batch.size = 0; });
    change(kWrongSize, "size - 1", [](glev_batch& batch) { --batch.size; });
    for (glev_enum type : {glev_enum{0}, glev_enum{GLEV_INT}, glev_enum{1}})
      change(kInvalid, "type", [&](glev_batch& batch) { batch.type = type; });
    for (int precision : {2, -1, INT_MAX}) {
      change(kInvalid, "precision",
             [&](glev_batch& batch) { std::memcpy(&batch.precision, &precision, sizeof precision); });
    }
    change(kInvalid, "u without data", [](glev_batch& batch) { batch.u.data = nullptr; });
    change(kTooSmall, "u without bytes", [](glev_batch& batch) { batch.u.data_size = 0; });
    change(kTooSmall, "u of one byte less", [](glev_batch& batch) { --batch.u.data_size; });
    change(kTooSmall, "u of floats", [](glev_batch& batch) { batch.type = GLEV_DOUBLE; });
    change(kTooSmall, "u farther apart", [](glev_batch& batch) { batch.u.stride = 5; });
    change(kTooSmall, "u far apart",
           [](glev_batch& batch) { batch.u.stride = SIZE_MAX, batch.u.data_size = SIZE_MAX; });
    change(kTooSmall, "one argument more", [](glev_batch& batch) { ++batch.count; });
    change(kTooSmall, "all arguments", [](glev_batch& batch) { batch.count = SIZE_MAX; });
  }
  const auto change_v = [&](glev_result expected, std::size_t dimension, const char* what, auto spoil) {
    expect_batch(expected, dimension, what, [&](Call& call) { spoil(call.batch.v); });
  };
  change_v(kInvalid, 2, "no v", [](glev_input& v) { v = {}; });
  change_v(kInvalid, 2, "v without data", [](glev_input& v) { v.data = nullptr; });
  change_v(kTooSmall, 2, "v of one byte less", [](glev_input& v) { --v.data_size; });
  change_v(kTooSmall, 2, "v farther apart", [](glev_input& v) { ++v.stride; });
  change_v(kInvalid, 1, "a v", [&](glev_input& v) { v = {arguments_, sizeof arguments_, 4}; });
  change_v(kInvalid, 1, "v's data", [&](glev_input& v) { v.data = arguments_; });
  change_v(kInvalid, 1, "v's bytes", [](glev_input& v) { v.data_size = 1; });
  change_v(kInvalid, 1, "v's stride", [](glev_input& v) { v.stride = 1; });
}

TEST_F(Misuse, OfMeshes) {
  for (std::size_t dimension : {1, 2}) {
    const auto change = [&](glev_result expected, const char* what, auto spoil) {
      expect_mesh(expected, dimension, what, [&](Call& call) { spoil(call.mesh); });
    };
    change(kWrongSize, "size 0", [](glev_mesh& mesh) { mesh.size = 0; });
    change(kWrongSize, "size - 1", [](glev_mesh& mesh) { --mesh.size; });
    change(kInvalid, "precision", [](glev_mesh& mesh) {
      const int other = 2;
      std::memcpy(&mesh.precision, &other, sizeof other);
    });
    change(kInvalid, "scratch without data", [](glev_mesh& mesh) { mesh.scratch = nullptr; });
    change(kTooSmall, "no scratch", [](glev_mesh& mesh) { mesh.scratch = nullptr, mesh.scratch_size = 0; });
    change(kTooSmall, "more columns", [](glev_mesh& mesh) { mesh.i2 = 1000; });
  }
  for (auto member : {&glev_mesh::j1, &glev_mesh::j2}) {
    for (int j : {1, -1}) {
      expect_mesh(kInvalid, 1, "rows of a curve", [&](Call& call) { call.mesh.*member = j; });
    }
  }
  const Plan curve(gl, 1);
  glev_mesh mesh = {sizeof mesh, 0, 3, 0, 1, GLEV_CORRECTLY_ROUNDED, nullptr, 0, nullptr, 0};
  EXPECT_EQ(glevGetMeshScratchSize(curve, &mesh), 0u);
  mesh.j2 = 0;
  EXPECT_NE(glevGetMeshScratchSize(curve, &mesh), 0u);
  mesh.size = 3;
  EXPECT_EQ(glevGetMeshScratchSize(curve, &mesh), 0u);
}

// The scratch size is 0 only for rejected meshes.
TEST_F(Misuse, ScratchOfAMeshWithoutPointsIsNotZero) {
  const Plan curve(gl, 1);
  glev_mesh mesh = {sizeof mesh, 3, 0, 0, 0, GLEV_FAST, nullptr, 0, nullptr, 0};
  EXPECT_NE(glevGetMeshScratchSize(curve, &mesh), 0u);
  EXPECT_EQ(glevEvaluateMesh(curve, &mesh), GLEV_SUCCESS);
  EXPECT_EQ(glevGetMeshScratchSize(nullptr, &mesh), 0u);
  EXPECT_EQ(glevEvaluateMesh(nullptr, &mesh), GLEV_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(glevGetMeshScratchSize(curve, nullptr), 0u);
}

// Without outputs a batch is checked like any other and writes nothing.
TEST_F(Misuse, BatchesWithoutOutputsAreLegal) {
  const Plan curve(gl, 1);
  const float u[] = {0, 1};
  glev_batch batch = {sizeof batch, 2,       GLEV_FLOAT, GLEV_CORRECTLY_ROUNDED, {u, sizeof u, sizeof *u},
                      {},           nullptr, 0};
  EXPECT_EQ(glevEvaluate(curve, &batch), GLEV_SUCCESS);
  batch.u.data_size = sizeof *u;
  EXPECT_EQ(glevEvaluate(curve, &batch), GLEV_ERROR_BUFFER_TOO_SMALL);
  batch.u.data = nullptr;
  EXPECT_EQ(glevEvaluate(curve, &batch), GLEV_ERROR_INVALID_ARGUMENT);
}

TEST_F(Misuse, OfRowStrides) {
  const auto ask = [&](std::size_t row_stride) {
    return [row_stride](Call& call) {
      std::vector<glev_attribute_output> outputs = call.outputs;
      outputs.erase(outputs.begin() + 1);
      set_outputs(call, outputs);
      call.vertex.row_stride = row_stride;
    };
  };
  // A row ends 12 bytes after the beginning of its last element.
  expect_mesh(GLEV_SUCCESS, 2, "as short as may be", ask(4 * 24 + 12));
  expect_mesh(kInvalid, 2, "shorter", ask(4 * 24 + 11));
  expect_mesh(kInvalid, 2, "1", ask(1));
  expect_mesh(kTooSmall, 2, "large", ask(SIZE_MAX));
  expect_mesh(kTooSmall, 2, "half", ask(SIZE_MAX / 2 + 1));
  expect_mesh(kInvalid, 1, "of a curve", ask(4 * 24 + 24));
  for (std::size_t dimension : {1, 2}) expect_batch(kInvalid, dimension, "of a batch", ask(4 * 24 + 24));
  // two more rows, or one byte less
  expect_mesh(GLEV_SUCCESS, 2, "exactly", [&](Call& call) {
    ask(200)(call);
    call.vertex.data_size = 2 * 200 + 4 * 24 + 12;
  });
  expect_mesh(kTooSmall, 2, "one byte less", [&](Call& call) {
    ask(200)(call);
    call.vertex.data_size = 2 * 200 + 4 * 24 + 11;
  });
}

TEST_F(Misuse, OfPatchStrides) {
  expect_both(kInvalid, "a patch stride", [](Call& call) { call.vertex.patch_stride = 1000; });
}

TEST_F(Misuse, LaterVersionsMayBeLargerIfTheRestIsZero) {
  const Plan plan(gl, 2);
  Memory memory(kNoRoom), scratch(kNoRoom);
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
  memory = Memory(kNoRoom);
  output.rest[4] = 1;
  EXPECT_EQ(glevEvaluateMesh(plan, &later.mesh), kWrongSize);
  output.rest[4] = 0;
  later.rest[0] = 1;
  EXPECT_EQ(glevEvaluateMesh(plan, &later.mesh), kWrongSize);
  EXPECT_TRUE(memory.is_untouched());
}

// ---- Overlaps, against sets of bytes

struct Block {
  std::size_t offset, columns, rows, stride, row_stride, element;

  std::vector<bool> bytes_of(std::size_t size) const {
    std::vector<bool> bytes(size);
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i < columns; ++i) {
        for (std::size_t k = 0; k < element; ++k) bytes[offset + j * row_stride + i * stride + k] = true;
      }
    }
    return bytes;
  }
  std::size_t end() const { return offset + (rows - 1) * row_stride + (columns - 1) * stride + element; }
};

bool share_a_byte(const Block& a, const Block& b) {
  const std::size_t size = std::max(a.end(), b.end());
  const std::vector<bool> in_a = a.bytes_of(size), in_b = b.bytes_of(size);
  for (std::size_t k = 0; k < size; ++k) {
    if (in_a[k] && in_b[k]) return true;
  }
  return false;
}

// Returns true if the blocks must be rejected. If strides differ, their extents decide.
bool is_rejected(const Block& a, const Block& b) {
  if (a.stride == b.stride && a.row_stride == b.row_stride) return share_a_byte(a, b);
  return a.offset < b.end() && b.offset < a.end();
}

TEST_F(Misuse, OverlapsOfOutputsAreThoseOfTheirBytes) {
  const Plan plan(gl, 2);
  Chance chance;
  Memory memory(kNoRoom), scratch(kNoRoom);
  int refused = 0, interleaved = 0;
  for (int k = 0; k < 20000; ++k) {
    const auto columns = static_cast<std::size_t>(chance.whole(1, 4)),
               rows = static_cast<std::size_t>(chance.whole(1, 3));
    const auto choose = [&](std::size_t components, std::size_t stride, std::size_t row_stride) {
      const std::size_t element = 4 * components, least = element + (chance.whole(0, 3) != 0 ? 0 : 3);
      stride = std::max(stride, least);
      const std::size_t row = (columns - 1) * stride + element;
      return Block{static_cast<std::size_t>(chance.whole(0, 250)),
                   columns,
                   rows,
                   stride,
                   std::max(row_stride, row),
                   element};
    };
    const auto stride = static_cast<std::size_t>(chance.whole(12, 40)),
               row_stride = static_cast<std::size_t>(chance.one_of({0, 100, 40, 160, 129, 300}));
    Block a = choose(3, stride, row_stride), b = choose(2, stride, row_stride);
    if (chance.whole(0, 3) != 0) {
      b.stride = a.stride;
      b.row_stride = a.row_stride = std::max(a.row_stride, b.row_stride);
    }
    if (a.row_stride < (columns - 1) * a.stride + a.element ||
        b.row_stride < (columns - 1) * b.stride + b.element)
      continue;
    const glev_output vertex = memory.make_output(a.offset, a.stride, 3, 0, a.row_stride),
                      texcoord = memory.make_output(b.offset, b.stride, 2, 0, b.row_stride);
    const glev_attribute_output outputs[] = {{GLEV_ATTRIBUTE_VERTEX, &vertex},
                                             {GLEV_ATTRIBUTE_TEXCOORD, &texcoord}};
    const glev_mesh mesh = {sizeof mesh,
                            0,
                            static_cast<int>(columns) - 1,
                            0,
                            static_cast<int>(rows) - 1,
                            GLEV_CORRECTLY_ROUNDED,
                            outputs,
                            std::size(outputs),
                            scratch.data(),
                            scratch.size()};
    const bool is_refused = is_rejected(a, b);
    ASSERT_EQ(glevEvaluateMesh(plan, &mesh), is_refused ? GLEV_ERROR_OVERLAP : GLEV_SUCCESS)
        << columns << " x " << rows << ": " << a.offset << " " << a.stride << " " << a.row_stride << ", "
        << b.offset << " " << b.stride << " " << b.row_stride;
    refused += is_refused;
    interleaved += !is_refused && a.offset < b.end() && b.offset < a.end();
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(interleaved, 1000);
}

TEST_F(Misuse, OutputsMustNotShareBytesWithArguments) {
  for (std::size_t dimension : {1, 2}) {
    for (bool is_u : {true, false}) {
      if (dimension == 1 && !is_u) continue;
      const auto expect = [&](glev_result expected, std::size_t offset, std::size_t stride) {
        Memory memory(kNoRoom);
        const auto change = [&](Call& call) {
          (is_u ? call.batch.u : call.batch.v) = glev_input{memory.data() + offset, kNoRoom - offset, stride};
        };
        EXPECT_EQ(evaluate(dimension, change, memory), expected) << offset << " " << stride;
      };
      // vertices at 0, texture coordinates at 12, of 24 bytes
      expect(GLEV_SUCCESS, 20, 24);
      expect(GLEV_ERROR_OVERLAP, 19, 24);
      expect(GLEV_ERROR_OVERLAP, 21, 24);
      expect(GLEV_ERROR_OVERLAP, 20, 0);
      expect(GLEV_ERROR_OVERLAP, 20, 23);
      expect(GLEV_ERROR_OVERLAP, 4 * 24 + 16, 4);
      expect(GLEV_SUCCESS, 4 * 24 + 20, 4);
      if (dimension == 2) expect(GLEV_ERROR_OVERLAP, 1000 - 4 * 4 - 3, 4);
      if (dimension == 2) expect(GLEV_SUCCESS, 1000 - 4 * 4 - 4, 4);
    }
  }
}

TEST_F(Misuse, OutputsMustNotShareBytesWithScratchMemory) {
  const Plan plan(gl, 2);
  glev_mesh mesh = {sizeof mesh, 0, 4, 0, 2, GLEV_CORRECTLY_ROUNDED, nullptr, 0, nullptr, 0};
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
  expect(GLEV_ERROR_OVERLAP, 1, needed);
  expect(GLEV_ERROR_OVERLAP, needed, needed);
  expect(GLEV_ERROR_OVERLAP, needed + 12, needed);  // between the elements
  expect(GLEV_ERROR_OVERLAP, needed + extent - 1, needed);
  for (std::size_t size : {needed + extent, SIZE_MAX / 2, SIZE_MAX}) expect(GLEV_ERROR_OVERLAP, 1, size);
  expect(GLEV_ERROR_BUFFER_TOO_SMALL, 1, needed - 1);
  EXPECT_TRUE(memory.is_untouched());
  expect(GLEV_SUCCESS, 0, needed);
  expect(GLEV_SUCCESS, needed + extent, needed);
}

}  // namespace
}  // namespace glev_tests
