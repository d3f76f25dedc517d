// Tests glevEvaluate: values, layouts, and invalid arguments.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "batches.h"

namespace glev_tests {
namespace {

constexpr unsigned char kPoison = 0xCD;

class Batch : public ContextTest {
 protected:
  static constexpr std::size_t kCount = 9;

  Batch() {
    for (std::size_t i = 0; i < std::size(points_); ++i) points_[i] = static_cast<float>(std::cos(i * 1.7));
    int order = 3;
    for (glev_enum target :
         {GLEV_MAP1_VERTEX_3, GLEV_MAP1_COLOR_4, GLEV_MAP1_NORMAL, GLEV_MAP1_TEXTURE_COORD_2}) {
      glevMap1f(gl, target, 0.1f * static_cast<float>(order), 2, 4, order, points_);
      glevEnable(gl, target);
      ++order;
    }
    new_plan();
    for (std::size_t i = 0; i < kCount; ++i) u_[i] = static_cast<float>(i) * 0.37f - 0.5f;
    u_[3] = 2;
    buffer_.assign(4096, kPoison);
  }
  ~Batch() override { glevReleasePlan(plan_); }

  void new_plan() {
    const glev_plan_info info = {sizeof(glev_plan_info), 1};
    glevReleasePlan(plan_);
    ASSERT_EQ(glevCreatePlan(gl, &info, &plan_), GLEV_SUCCESS);
  }

  glev_batch valid_batch() const {
    glev_batch batch{};
    batch.size = sizeof batch;
    batch.count = kCount;
    batch.u.data = u_;
    batch.u.data_size = sizeof u_;
    batch.u.stride = sizeof(float);
    batch.type = GLEV_FLOAT;
    return batch;
  }
  glev_output make_output(std::size_t offset, std::size_t stride, std::size_t components) {
    return {
        sizeof(glev_output), buffer_.data() + offset, buffer_.size() - offset, stride, components, 0, 0, 0};
  }
  Floats element_at(std::size_t offset, std::size_t components) const {
    Floats values(components);
    std::memcpy(values.data(), buffer_.data() + offset, 4 * components);
    return values;
  }
  void expect_untouched() const {
    EXPECT_EQ(std::count(buffer_.begin(), buffer_.end(), kPoison), static_cast<long>(buffer_.size()));
  }
  void expect_misuse(glev_result expected, const glev_batch& batch) const {
    EXPECT_EQ(glevEvaluate(plan_, &batch), expected);
    expect_untouched();
  }

  float points_[64];
  float u_[kCount];
  glev_plan* plan_ = nullptr;
  std::vector<unsigned char> buffer_;
};

TEST_F(Batch, InterleavedAttributesAreThoseOfEvalCoordBitForBit) {
  // u itself, 4-component position, colour, padding, normal, 2-component texture coordinate: 60 + 3 bytes,
  // unaligned
  constexpr std::size_t kStride = 63, kStart = 5;
  for (std::size_t i = 0; i < kCount; ++i) std::memcpy(buffer_.data() + kStart + i * kStride, &u_[i], 4);
  const glev_output vertex = make_output(kStart + 4, kStride, 4),
                    color = make_output(kStart + 20, kStride, 4),
                    normal = make_output(kStart + 38, kStride, 3),
                    texcoord = make_output(kStart + 50, kStride, 2);
  glev_batch batch = valid_batch();
  batch.u.data = buffer_.data() + kStart;
  batch.u.data_size = buffer_.size() - kStart;
  batch.u.stride = kStride;
  const Outputs outputs(batch, {{GLEV_ATTRIBUTE_VERTEX, &vertex},
                                {GLEV_ATTRIBUTE_COLOR, &color},
                                {GLEV_ATTRIBUTE_NORMAL, &normal},
                                {GLEV_ATTRIBUTE_TEXCOORD, &texcoord}});
  ASSERT_EQ(glevEvaluate(plan_, &batch), GLEV_SUCCESS);
  for (std::size_t i = 0; i < kCount; ++i) {
    const glev_vertex expected = one_vertex([&] { glevEvalCoord1f(gl, u_[i]); });
    const std::size_t at = kStart + i * kStride;
    EXPECT_EQ(element_at(at, 1), Floats{u_[i]});
    EXPECT_EQ(element_at(at + 4, 4), values_of(expected.position));
    EXPECT_EQ(element_at(at + 20, 4), values_of(expected.color));
    EXPECT_EQ(buffer_[at + 36], kPoison);
    EXPECT_EQ(buffer_[at + 37], kPoison);
    EXPECT_EQ(element_at(at + 38, 3), values_of(expected.normal));
    EXPECT_EQ(element_at(at + 50, 2), (Floats{expected.texcoord[0][0], expected.texcoord[0][1]}));
    for (std::size_t byte = 58; byte < kStride; ++byte) EXPECT_EQ(buffer_[at + byte], kPoison);
  }
  EXPECT_EQ(buffer_[kStart - 1], kPoison);
  EXPECT_EQ(buffer_[kStart + kCount * kStride], kPoison);
}

TEST_F(Batch, MissingComponentsAreDefaults) {
  for (std::size_t components : {2, 3, 4}) {
    const glev_output texcoord = make_output(0, 16, components);
    glev_batch batch = valid_batch();
    const Outputs outputs(batch, {{GLEV_ATTRIBUTE_TEXCOORD, &texcoord}});
    ASSERT_EQ(glevEvaluate(plan_, &batch), GLEV_SUCCESS);
    for (std::size_t i = 0; i < kCount; ++i) {
      const glev_vertex expected = one_vertex([&] { glevEvalCoord1f(gl, u_[i]); });
      Floats values = {expected.texcoord[0][0], expected.texcoord[0][1], 0, 1};
      values.resize(components);
      EXPECT_EQ(element_at(16 * i, components), values);
    }
  }
}

TEST_F(Batch, DoubleArgumentsAreNotRoundedFirst) {
  const double points[] = {0, 1};
  glevMap1d(gl, GLEV_MAP1_TEXTURE_COORD_1, 1, 1 + 0x1p-40, 1, 2, points);
  glevEnable(gl, GLEV_MAP1_TEXTURE_COORD_1);
  glevDisable(gl, GLEV_MAP1_TEXTURE_COORD_2);
  new_plan();
  const double u[] = {1 + 0x1p-42, 0, 1 + 0x1p-41};
  const glev_output texcoord = make_output(0, 4, 1);
  glev_batch batch = valid_batch();
  batch.count = 2;
  batch.u.data = u;
  batch.u.data_size = sizeof u;
  batch.u.stride = 2 * sizeof(double);
  batch.type = GLEV_DOUBLE;
  const Outputs outputs(batch, {{GLEV_ATTRIBUTE_TEXCOORD, &texcoord}});
  ASSERT_EQ(glevEvaluate(plan_, &batch), GLEV_SUCCESS);
  EXPECT_EQ(element_at(0, 2), (Floats{0.25f, 0.5f}));
}

TEST_F(Batch, AStrideOfZeroRepeatsOneArgument) {
  const glev_output vertex = make_output(0, 12, 3);
  glev_batch batch = valid_batch();
  batch.u.data_size = 4;
  batch.u.stride = 0;
  const Outputs outputs(batch, {{GLEV_ATTRIBUTE_VERTEX, &vertex}});
  ASSERT_EQ(glevEvaluate(plan_, &batch), GLEV_SUCCESS);
  for (std::size_t i = 1; i < kCount; ++i) EXPECT_EQ(element_at(12 * i, 3), element_at(0, 3));
  EXPECT_EQ(buffer_[12 * kCount], kPoison);
}

TEST_F(Batch, NoVertexMapIsNeeded) {
  glevDisable(gl, GLEV_MAP1_VERTEX_3);
  new_plan();
  const glev_output color = make_output(0, 16, 4);
  glev_batch batch = valid_batch();
  const Outputs outputs(batch, {{GLEV_ATTRIBUTE_COLOR, &color}});
  EXPECT_EQ(glevEvaluate(plan_, &batch), GLEV_SUCCESS);
  EXPECT_NE(buffer_[0], kPoison);
}

TEST_F(Batch, TheExactNumberOfBytesIsEnoughAndOneLessIsNot) {
  glev_output vertex = make_output(0, 20, 3);
  glev_batch batch = valid_batch();
  const Outputs outputs(batch, {{GLEV_ATTRIBUTE_VERTEX, &vertex}});
  vertex.data_size = (kCount - 1) * 20 + 11;
  expect_misuse(GLEV_ERROR_BUFFER_TOO_SMALL, batch);
  batch.u.data_size = kCount * 4 - 1;
  vertex.data_size += 1;
  expect_misuse(GLEV_ERROR_BUFFER_TOO_SMALL, batch);
  batch.u.data_size += 1;
  EXPECT_EQ(glevEvaluate(plan_, &batch), GLEV_SUCCESS);
  EXPECT_EQ(buffer_[(kCount - 1) * 20 + 12], kPoison);
  // One element does not fit.
  vertex.data_size = 11;
  batch.count = 1;
  buffer_.assign(4096, kPoison);
  expect_misuse(GLEV_ERROR_BUFFER_TOO_SMALL, batch);
}

TEST_F(Batch, SizesThatOverflowAreTooLarge) {
  for (std::size_t count :
       {SIZE_MAX, SIZE_MAX / 4, SIZE_MAX / 12 - 1000, SIZE_MAX / 12 + 2, SIZE_MAX / 2 + 2}) {
    for (std::size_t stride : {std::size_t{12}, SIZE_MAX / 2 + 1, SIZE_MAX}) {
      for (std::size_t size : {buffer_.size(), SIZE_MAX}) {
        glev_output vertex = make_output(0, stride, 3);
        vertex.data_size = size;
        glev_batch batch = valid_batch();
        batch.count = count;
        batch.u.stride = 0;
        const Outputs outputs(batch, {{GLEV_ATTRIBUTE_VERTEX, &vertex}});
        expect_misuse(GLEV_ERROR_BUFFER_TOO_SMALL, batch);
      }
    }
    glev_output vertex = make_output(0, 12, 3);
    glev_batch batch = valid_batch();
    batch.count = count;
    const Outputs outputs(batch, {{GLEV_ATTRIBUTE_VERTEX, &vertex}});
    expect_misuse(GLEV_ERROR_BUFFER_TOO_SMALL, batch);
  }
}

TEST_F(Batch, CountZeroReadsAndWritesNothing) {
  glev_output vertex = {sizeof(glev_output), nullptr, 0, 12, 3, 0, 0, 0};
  glev_batch batch = valid_batch();
  batch.count = 0;
  batch.u.data = nullptr;
  batch.u.data_size = 0;
  const Outputs outputs(batch, {{GLEV_ATTRIBUTE_VERTEX, &vertex}});
  EXPECT_EQ(glevEvaluate(plan_, &batch), GLEV_SUCCESS);
  vertex.data = buffer_.data();
  EXPECT_EQ(glevEvaluate(plan_, &batch), GLEV_SUCCESS);
  expect_untouched();
  vertex.components = 2;  // also invalid
  expect_misuse(GLEV_ERROR_INVALID_ARGUMENT, batch);
}

TEST_F(Batch, MisuseIsRefusedAndNothingWritten) {
  glev_output good = make_output(0, 12, 3);
  glev_batch batch = valid_batch();
  const Outputs outputs(batch, {{GLEV_ATTRIBUTE_VERTEX, &good}});
  EXPECT_EQ(glevEvaluate(nullptr, &batch), GLEV_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(glevEvaluate(plan_, nullptr), GLEV_ERROR_INVALID_ARGUMENT);
  const auto with = [&](auto change, glev_result expected = GLEV_ERROR_INVALID_ARGUMENT) {
    glev_output vertex = good;
    glev_batch changed = batch;
    const Outputs changed_outputs(changed, {{GLEV_ATTRIBUTE_VERTEX, &vertex}});
    change(changed, vertex);
    expect_misuse(expected, changed);
  };
  with([](glev_batch& b, glev_output&) { b.size = sizeof b - 1; }, GLEV_ERROR_STRUCTURE_SIZE);
  with([](glev_batch& b, glev_output&) { b.u.data = nullptr; });
  with([](glev_batch& b, glev_output&) { b.type = 0x1404; });
  with([](glev_batch&, glev_output& v) { v.size = offsetof(glev_output, patch_stride) - 1; },
       GLEV_ERROR_STRUCTURE_SIZE);
  with([](glev_batch&, glev_output& v) { v.data = nullptr; });
  with([](glev_batch&, glev_output& v) { v.components = 0; });
  with([](glev_batch&, glev_output& v) { v.components = 2; });
  with([](glev_batch&, glev_output& v) { v.components = 5, v.stride = 20; });
  with([](glev_batch&, glev_output& v) { v.components = SIZE_MAX / 4 + 2; });
  with([](glev_batch&, glev_output& v) { v.stride = 11; });
  with([](glev_batch&, glev_output& v) { v.stride = 0; });
  glev_output normal = make_output(0, 16, 4);
  const Outputs normals(batch, {{GLEV_ATTRIBUTE_NORMAL, &normal}});
  expect_misuse(GLEV_ERROR_INVALID_ARGUMENT, batch);
}

TEST_F(Batch, AnAttributeWithoutAMapIsRefused) {
  const glev_output other = make_output(1000, 16, 3);
  for (glev_enum target :
       {GLEV_MAP1_COLOR_4, GLEV_MAP1_NORMAL, GLEV_MAP1_TEXTURE_COORD_2, GLEV_MAP1_VERTEX_3}) {
    glevDisable(gl, target);
  }
  new_plan();
  for (glev_attribute attribute : kEveryAttribute) {
    glev_batch batch = valid_batch();
    const Outputs outputs(batch, {{attribute, &other}});
    expect_misuse(GLEV_ERROR_NO_MAP, batch);
  }
}

TEST_F(Batch, OverlapsAreRefused) {
  const auto expect = [&](glev_result expected, std::size_t count, const glev_output& vertex,
                          const glev_output& color) {
    glev_batch batch = valid_batch();
    batch.count = count;
    const Outputs outputs(batch, {{GLEV_ATTRIBUTE_VERTEX, &vertex}, {GLEV_ATTRIBUTE_COLOR, &color}});
    if (expected == GLEV_SUCCESS) {
      EXPECT_EQ(glevEvaluate(plan_, &batch), GLEV_SUCCESS);
      buffer_.assign(4096, kPoison);
    } else {
      expect_misuse(expected, batch);
    }
  };
  // equal strides: offsets within one stride decide, in either order and across elements
  expect(GLEV_SUCCESS, kCount, make_output(0, 28, 3), make_output(12, 28, 4));
  expect(GLEV_SUCCESS, kCount, make_output(16, 28, 3), make_output(0, 28, 4));
  expect(GLEV_SUCCESS, kCount, make_output(0, 28, 3), make_output(12 + 28, 28, 4));
  expect(GLEV_ERROR_OVERLAP, kCount, make_output(0, 28, 3), make_output(11, 28, 4));
  expect(GLEV_ERROR_OVERLAP, kCount, make_output(0, 28, 3), make_output(13, 28, 4));
  expect(GLEV_ERROR_OVERLAP, kCount, make_output(15, 28, 3), make_output(0, 28, 4));
  expect(GLEV_ERROR_OVERLAP, kCount, make_output(0, 28, 3), make_output(0, 28, 4));
  expect(GLEV_ERROR_OVERLAP, kCount, make_output(0, 28, 3), make_output((kCount - 1) * 28 + 11, 28, 4));
  expect(GLEV_SUCCESS, kCount, make_output(0, 28, 3), make_output((kCount - 1) * 28 + 12, 28, 4));
  expect(GLEV_SUCCESS, 1, make_output(0, 28, 3), make_output(13, 28, 4));
  // different strides: the blocks must not overlap
  expect(GLEV_ERROR_OVERLAP, kCount, make_output(0, 12, 3), make_output(12 * kCount - 1, 16, 4));
  expect(GLEV_SUCCESS, kCount, make_output(0, 12, 3), make_output(12 * kCount, 16, 4));
  expect(GLEV_SUCCESS, kCount, make_output(16 * kCount, 12, 3), make_output(0, 16, 4));
  // the input
  const glev_output vertex = make_output(0, 12, 3);
  glev_batch batch = valid_batch();
  const Outputs outputs(batch, {{GLEV_ATTRIBUTE_VERTEX, &vertex}});
  batch.u.data = buffer_.data() + 12 * kCount - 1;
  batch.u.data_size = 1000;
  expect_misuse(GLEV_ERROR_OVERLAP, batch);
  batch.u.data = buffer_.data();
  batch.u.stride = 12;
  expect_misuse(GLEV_ERROR_OVERLAP, batch);
  batch.u.stride = 0;
  expect_misuse(GLEV_ERROR_OVERLAP, batch);
}

}  // namespace
}  // namespace glev_tests
