// Tests plans: snapshots, references, memory. batch_threads_test.cpp tests threads.
#include <cmath>

#include "batches.h"
#include "ledger.h"

namespace glev_tests {
namespace {

constexpr glev_plan_info kOneDimension = {sizeof(glev_plan_info), 1};

Floats vertices_of(const glev_plan* plan, const Floats& u) {
  return evaluate_scattered(plan, GLEV_ATTRIBUTE_VERTEX, u);
}

class PlanTest : public ContextTest {
 protected:
  PlanTest() {
    for (int i = 0; i < 64 * 3; ++i) points_[i] = static_cast<float>(std::sin(i * 1.5));
    glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 8, points_);
    glevEnable(gl, GLEV_MAP1_VERTEX_3);
  }
  glev_plan* create() {
    glev_plan* plan = nullptr;
    EXPECT_EQ(glevCreatePlan(gl, &kOneDimension, &plan), GLEV_SUCCESS);
    return plan;
  }

  float points_[64 * 3];
  const std::vector<float> u_ = {-0.5f, 0, 0.125f, 0.3f, 0.77f, 1, 1.5f};
};

TEST_F(PlanTest, KnowsWhatItEvaluates) {
  // The components of vertices, colours, normals and texture coordinates; then no such attribute.
  const auto components = [&] {
    const Plan plan(gl, 1);
    std::vector<std::size_t> all;
    for (glev_attribute attribute : kEveryAttribute) all.push_back(glevGetPlanComponents(plan, attribute));
    EXPECT_EQ(glevGetPlanComponents(plan, static_cast<glev_attribute>(6)), 0u);
    return all;
  };
  EXPECT_EQ(components(), (std::vector<std::size_t>{3, 0, 0, 0}));
  for (const TargetRow& row : kTargetRows) glevEnable(gl, GLEV_MAP1_COLOR_4 + row.offset);
  glevDisable(gl, GLEV_MAP1_TEXTURE_COORD_4);
  EXPECT_EQ(components(), (std::vector<std::size_t>{4, 4, 3, 3}));
}

TEST_F(PlanTest, IsASnapshotThatOutlivesItsContext) {
  glev_plan* plan = create();
  const Floats before = vertices_of(plan, u_);
  const float other[] = {9, 9, 9};
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 3, 4, 3, 1, other);
  EXPECT_EQ(vertices_of(plan, u_), before);
  glevDisable(gl, GLEV_MAP1_VERTEX_3);
  glevEnable(gl, GLEV_MAP1_VERTEX_4);
  EXPECT_EQ(vertices_of(plan, u_), before);
  glevRetainPlan(plan);
  glevReleasePlan(plan);
  glevDestroyContext(gl);
  gl = nullptr;
  EXPECT_EQ(vertices_of(plan, u_), before);
  glevReleasePlan(plan);
}

TEST_F(PlanTest, IsSharedUntilTheStateChanges) {
  glev_plan* first = create();
  glev_plan* second = create();
  EXPECT_EQ(first, second);
  glevColor3f(gl, 0, 0, 0);            // plans do not depend on current values
  glevEnable(gl, GLEV_MAP1_VERTEX_3);  // no change
  glev_plan* third = create();
  EXPECT_EQ(first, third);
  glevEnable(gl, GLEV_MAP1_COLOR_4);
  glev_plan* fourth = create();
  EXPECT_NE(first, fourth);
  glevMapGrid2f(gl, 3, 0, 1, 3, 0, 1);  // the grid of the other dimension
  glevEnable(gl, GLEV_MAP2_VERTEX_3);
  glevEnable(gl, GLEV_AUTO_NORMAL);
  glev_plan* fifth = create();
  EXPECT_EQ(fourth, fifth);
  glevMapGrid1f(gl, 3, 0, 1);
  glev_plan* sixth = create();
  EXPECT_NE(fourth, sixth);
  for (glev_plan* plan : {first, second, third, fourth, fifth, sixth}) glevReleasePlan(plan);
  glevReleasePlan(nullptr);
}

TEST_F(PlanTest, MayBeTakenBetweenBeginAndEnd) {
  glevBegin(gl, GLEV_POINTS);
  glev_plan* plan = create();
  glevEnd(gl);
  expect_error(GLEV_NO_ERROR);
  glevReleasePlan(plan);
}

TEST_F(PlanTest, MisuseOfCreate) {
  EXPECT_EQ(glevCreatePlan(gl, &kOneDimension, nullptr), GLEV_ERROR_INVALID_ARGUMENT);
  glev_plan* plan = reinterpret_cast<glev_plan*>(this);
  EXPECT_EQ(glevCreatePlan(gl, nullptr, &plan), GLEV_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(plan, nullptr);
  for (std::size_t dimension : {0, 3}) {
    const glev_plan_info info = {sizeof(glev_plan_info), dimension};
    plan = reinterpret_cast<glev_plan*>(this);
    EXPECT_EQ(glevCreatePlan(gl, &info, &plan), GLEV_ERROR_UNSUPPORTED);
    EXPECT_EQ(plan, nullptr);
  }
  const glev_plan_info small = {sizeof(glev_plan_info) - 1, 1};
  EXPECT_EQ(glevCreatePlan(gl, &small, &plan), GLEV_ERROR_STRUCTURE_SIZE);
}

// ---- Memory

using MemoryTest = WithLedger<PlanTest>;

TEST_F(MemoryTest, EverythingComesFromTheAllocatorAndGoesBack) {
  for (const TargetRow& row : kTargetRows) {
    for (int order : {1, 9, 3, 48}) glevMap1f(gl, GLEV_MAP1_COLOR_4 + row.offset, 0, 1, 4, order, points_);
    glevEnable(gl, GLEV_MAP1_COLOR_4 + row.offset);
    one_vertex([&] { glevVertex3f(gl, 0, 0, 0); });
  }
  glevEnable(gl, GLEV_AUTO_NORMAL);
  for (const TargetRow& row : kTargetRows) {
    for (auto [n, m] : {std::pair{1, 1}, {3, 4}, {2, 2}, {1, 16}, {16, 1}}) {
      glevMap2f(gl, GLEV_MAP2_COLOR_4 + row.offset, 0, 1, 4 * m, n, 0, 1, 4, m, points_);
      glevEnable(gl, GLEV_MAP2_COLOR_4 + row.offset);
      glevEvalMesh2(gl, GLEV_FILL, 0, 2, 0, 2);
    }
  }
  glev_plan* plan = create();
  one_vertex([&] { glevEvalCoord1f(gl, 0.5f); });
  glevReleasePlan(plan);
  expect_error(GLEV_NO_ERROR);
  EXPECT_GT(ledger_.requests, 10);
}

TEST_F(MemoryTest, PlansGoBackWithTheirLastReference) {
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 4, points_);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  glev_plan* plan = create();
  glevRetainPlan(plan);
  glevDisable(gl, GLEV_MAP1_VERTEX_3);
  glev_plan* other = create();  // the context drops its reference to the first plan
  const std::size_t blocks = ledger_.out.size();
  glevReleasePlan(plan);
  EXPECT_EQ(ledger_.out.size(), blocks);
  glevReleasePlan(plan);
  EXPECT_LT(ledger_.out.size(), blocks);
  glevReleasePlan(other);
}

TEST_F(MemoryTest, EvaluationDoesNotAllocate) {
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 8, points_);
  glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 24, 8, 0, 1, 3, 8, points_);
  for (glev_enum cap : {GLEV_MAP1_VERTEX_3, GLEV_MAP2_VERTEX_3, GLEV_AUTO_NORMAL}) glevEnable(gl, cap);
  // Make the plans.
  glevEvalMesh1(gl, GLEV_LINE, 0, 0);
  glevEvalMesh2(gl, GLEV_POINT, 0, 0, 0, 0);
  const int before = ledger_.requests;
  for (float u : u_) one_vertex([&] { glevEvalCoord1f(gl, u); });
  glevEvalMesh1(gl, GLEV_LINE, 0, 100);
  for (glev_enum mode : {GLEV_POINT, GLEV_LINE, GLEV_FILL}) glevEvalMesh2(gl, mode, 0, 9, 0, 9);
  EXPECT_EQ(ledger_.requests, before);
}

TEST_F(MemoryTest, WithoutMemoryNothingIsChangedOrDrawn) {
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 2, 3, 4, points_);
  glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 2, 12, 4, 0, 3, 3, 4, points_);
  for (glev_enum cap : {GLEV_MAP1_VERTEX_3, GLEV_MAP2_VERTEX_3, GLEV_AUTO_NORMAL}) glevEnable(gl, cap);
  ledger_.refuse_from = 0;
  expect_rejected(GLEV_OUT_OF_MEMORY, [&] { glevMap1f(gl, GLEV_MAP1_VERTEX_3, 5, 6, 3, 60, points_); });
  expect_rejected(GLEV_OUT_OF_MEMORY, [&] { glevMap1f(gl, GLEV_MAP1_COLOR_4, 5, 6, 4, 2, points_); });
  expect_rejected(GLEV_OUT_OF_MEMORY,
                  [&] { glevMap2f(gl, GLEV_MAP2_VERTEX_3, 5, 6, 3, 60, 5, 6, 3, 2, points_); });
  recording = {};
  expect_rejected(GLEV_OUT_OF_MEMORY, [&] { glevEvalMesh1(gl, GLEV_LINE, 0, 2); });
  expect_rejected(GLEV_OUT_OF_MEMORY, [&] { glevEvalMesh2(gl, GLEV_FILL, 0, 2, 0, 2); });
  EXPECT_TRUE(recording.begun.empty());
  expect_rejected_in_primitive(GLEV_OUT_OF_MEMORY, [&] { glevEvalCoord1f(gl, 0.5f); });
  expect_rejected_in_primitive(GLEV_OUT_OF_MEMORY, [&] { glevEvalCoord2f(gl, 0.5f, 0.5f); });
  glev_plan* plan = reinterpret_cast<glev_plan*>(this);
  EXPECT_EQ(glevCreatePlan(gl, &kOneDimension, &plan), GLEV_ERROR_OUT_OF_MEMORY);
  EXPECT_EQ(plan, nullptr);
  expect_error(GLEV_NO_ERROR);
  ledger_.refuse_from = -1;
  one_vertex([&] { glevEvalCoord1f(gl, 0.5f); });
  expect_accepted([&] { glevEvalMesh2(gl, GLEV_FILL, 0, 2, 0, 2); });
  EXPECT_EQ(recording.vertices.size(), 1u + 12);
  expect_accepted([&] { glevMap1f(gl, GLEV_MAP1_VERTEX_3, 5, 6, 3, 60, points_); });
}

TEST_F(MemoryTest, AContextWithoutMemoryIsNull) {
  ledger_.refuse_from = 0;
  glev_context* other = gl;
  EXPECT_EQ(glevCreateContext(&info_, &other), GLEV_ERROR_OUT_OF_MEMORY);
  EXPECT_EQ(other, nullptr);
}

TEST_F(MemoryTest, MisuseOfCreateContext) {
  EXPECT_EQ(glevCreateContext(nullptr, nullptr), GLEV_ERROR_INVALID_ARGUMENT);
  glev_context* other = gl;
  void (*const changes[])(glev_allocator&) = {[](glev_allocator& bad) { bad.allocate = nullptr; },
                                              [](glev_allocator& bad) { bad.release = nullptr; },
                                              [](glev_allocator& bad) { bad.size = 8; }};
  for (const auto& change : changes) {
    glev_allocator bad = allocator_;
    change(bad);
    const glev_context_info info = {sizeof(glev_context_info), &bad, nullptr};
    other = gl;
    EXPECT_EQ(glevCreateContext(&info, &other),
              bad.size == 8 ? GLEV_ERROR_STRUCTURE_SIZE : GLEV_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(other, nullptr);
  }
  const glev_context_info small = {sizeof(glev_context_info) - 1, nullptr, nullptr};
  EXPECT_EQ(glevCreateContext(&small, &other), GLEV_ERROR_STRUCTURE_SIZE);
  glevDestroyContext(nullptr);
}

}  // namespace
}  // namespace glev_tests
