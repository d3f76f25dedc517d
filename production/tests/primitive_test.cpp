// Tests Begin, Vertex, End, and the sink.
#include <cstring>

#include "fixture.h"

namespace glev_tests {
namespace {

using PrimitiveTest = ContextTest;

TEST_F(PrimitiveTest, EveryModeReachesTheSink) {
  for (glev_enum mode = 0; mode <= 0xD; ++mode) {
    recording = {};
    glevBegin(gl, mode);
    glevVertex3f(gl, 1, 2, 3);
    EXPECT_EQ(recording.ended, 0);
    glevEnd(gl);
    expect_error(GLEV_NO_ERROR);
    EXPECT_EQ(recording.begun, std::vector<glev_enum>{mode});
    EXPECT_EQ(recording.vertices.size(), 1u);
    EXPECT_EQ(recording.ended, 1);
  }
}

TEST_F(PrimitiveTest, BadModesDoNotBegin) {
  expect_rejected(GLEV_INVALID_ENUM, [&] { glevBegin(gl, 0xF); });
  expect_rejected(GLEV_INVALID_ENUM, [&] { glevBegin(gl, 0xFFFFFFFF); });
  expect_rejected(GLEV_INVALID_OPERATION, [&] { glevBegin(gl, 0xE); });
  EXPECT_TRUE(recording.begun.empty());
  expect_rejected(GLEV_INVALID_OPERATION, [&] { glevEnd(gl); });
  EXPECT_EQ(recording.ended, 0);
}

TEST_F(PrimitiveTest, BeginDoesNotNestAndThePrimitiveGoesOn) {
  glevBegin(gl, GLEV_LINES);
  glevVertex2f(gl, 1, 1);
  glevBegin(gl, GLEV_POINTS);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  glevVertex2f(gl, 2, 2);
  glevEnd(gl);
  expect_error(GLEV_INVALID_OPERATION);
  EXPECT_EQ(recording.begun, std::vector<glev_enum>{GLEV_LINES});
  EXPECT_EQ(recording.vertices.size(), 2u);
  EXPECT_EQ(recording.ended, 1);
}

TEST_F(PrimitiveTest, VertexForms) {
  const float f[] = {0.1f, 2, -3, 0.5f};
  const double d[] = {0.1, 2, -3, 0.5};
  const Floats two = {0.1f, 2, 0, 1}, three = {0.1f, 2, -3, 1}, four = {0.1f, 2, -3, 0.5f};
  const std::pair<std::function<void()>, Floats> forms[] = {
      {[&] { glevVertex2f(gl, f[0], f[1]); }, two},
      {[&] { glevVertex2d(gl, d[0], d[1]); }, two},
      {[&] { glevVertex2fv(gl, f); }, two},
      {[&] { glevVertex2dv(gl, d); }, two},
      {[&] { glevVertex3f(gl, f[0], f[1], f[2]); }, three},
      {[&] { glevVertex3d(gl, d[0], d[1], d[2]); }, three},
      {[&] { glevVertex3fv(gl, f); }, three},
      {[&] { glevVertex3dv(gl, d); }, three},
      {[&] { glevVertex4f(gl, f[0], f[1], f[2], f[3]); }, four},
      {[&] { glevVertex4d(gl, d[0], d[1], d[2], d[3]); }, four},
      {[&] { glevVertex4fv(gl, f); }, four},
      {[&] { glevVertex4dv(gl, d); }, four}};
  for (const auto& [form, expected] : forms) EXPECT_EQ(values_of(one_vertex(form).position), expected);
  expect_error(GLEV_NO_ERROR);
  expect_rejected_in_primitive(GLEV_INVALID_VALUE, [&] { glevVertex2fv(gl, nullptr); });
  expect_rejected_in_primitive(GLEV_INVALID_VALUE, [&] { glevVertex3dv(gl, nullptr); });
}

TEST_F(PrimitiveTest, AVertexCarriesEverythingCurrent) {
  glevColor4f(gl, 0.1f, 0.2f, 0.3f, 0.4f);
  glevNormal3f(gl, 1, 2, 3);
  glevIndexf(gl, 17);
  glevEdgeFlag(gl, GLEV_FALSE);
  for (int unit = 0; unit < 8; ++unit) {
    glevMultiTexCoord4f(gl, GLEV_TEXTURE0 + unit, static_cast<float>(unit), 5, 6, 7);
  }
  const glev_vertex vertex = one_vertex([&] { glevVertex3f(gl, 7, 8, 9); });
  EXPECT_EQ(vertex.size, sizeof(glev_vertex));
  EXPECT_EQ(values_of(vertex.position), (Floats{7, 8, 9, 1}));
  EXPECT_EQ(values_of(vertex.color), (Floats{0.1f, 0.2f, 0.3f, 0.4f}));
  EXPECT_EQ(values_of(vertex.normal), (Floats{1, 2, 3}));
  EXPECT_EQ(vertex.index, 17);
  EXPECT_EQ(vertex.edge_flag, GLEV_FALSE);
  for (int unit = 0; unit < 8; ++unit) {
    EXPECT_EQ(values_of(vertex.texcoord[unit]), (Floats{static_cast<float>(unit), 5, 6, 7}));
  }
}

TEST_F(PrimitiveTest, CurrentValuesMayChangeBetweenVertices) {
  glevBegin(gl, GLEV_POINTS);
  glevColor3f(gl, 1, 0, 0);
  glevVertex2f(gl, 0, 0);
  glevColor3f(gl, 0, 1, 0);
  glevVertex2f(gl, 0, 0);
  glevEnd(gl);
  expect_error(GLEV_NO_ERROR);
  ASSERT_EQ(recording.vertices.size(), 2u);
  EXPECT_EQ(values_of(recording.vertices[0].color), (Floats{1, 0, 0, 1}));
  EXPECT_EQ(values_of(recording.vertices[1].color), (Floats{0, 1, 0, 1}));
}

TEST_F(PrimitiveTest, OutsideBeginAndEndNothingIsEmitted) {
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  glevVertex3f(gl, 1, 2, 3);
  glevEvalCoord1f(gl, 0.5f);
  EXPECT_TRUE(recording.vertices.empty());
  expect_error(GLEV_NO_ERROR);
}

// ---- Sink

TEST_F(PrimitiveTest, CallbacksAndTheSinkItselfMayBeMissing) {
  glev_sink empty = {sizeof(glev_sink), nullptr, nullptr, nullptr, nullptr};
  for (const glev_sink* sink : {&empty, static_cast<glev_sink*>(nullptr)}) {
    ASSERT_EQ(glevSetSink(gl, sink), GLEV_SUCCESS);
    glevBegin(gl, GLEV_POINTS);
    glevVertex3f(gl, 1, 2, 3);
    glevEnd(gl);
    expect_error(GLEV_NO_ERROR);
  }
  EXPECT_TRUE(recording.begun.empty());
  EXPECT_TRUE(recording.vertices.empty());
  EXPECT_EQ(recording.ended, 0);
}

TEST_F(PrimitiveTest, TheSinkIsNotChangedWithinAPrimitive) {
  glevBegin(gl, GLEV_POINTS);
  EXPECT_EQ(glevSetSink(gl, nullptr), GLEV_ERROR_IN_PRIMITIVE);
  glevVertex3f(gl, 1, 2, 3);
  glevEnd(gl);
  EXPECT_EQ(recording.vertices.size(), 1u);
  expect_error(GLEV_NO_ERROR);
}

TEST_F(PrimitiveTest, SizesOfStructures) {
  struct Larger {
    glev_sink sink;
    void* later = nullptr;
  } larger = {recording.make_sink()};
  larger.sink.size = sizeof(Larger);
  EXPECT_EQ(glevSetSink(gl, &larger.sink), GLEV_SUCCESS);
  larger.later = &larger;
  EXPECT_EQ(glevSetSink(gl, &larger.sink), GLEV_ERROR_INVALID_ARGUMENT);
  glev_sink smaller = recording.make_sink();
  smaller.size = sizeof(glev_sink) - 1;
  EXPECT_EQ(glevSetSink(gl, &smaller), GLEV_ERROR_INVALID_ARGUMENT);
  smaller.size = 0;
  EXPECT_EQ(glevSetSink(gl, &smaller), GLEV_ERROR_INVALID_ARGUMENT);
  one_vertex([&] { glevVertex3f(gl, 1, 2, 3); });  // the previous sink is still set
}

TEST_F(PrimitiveTest, CallbacksMayCallWhatIsLegalThere) {
  struct User {
    glev_context* gl;
    int calls;
  } user = {gl, 0};
  const glev_sink sink = {sizeof(glev_sink), &user,
                          [](void* u, glev_enum) { glevColor3f(static_cast<User*>(u)->gl, 0, 1, 0); },
                          [](void* u, const glev_vertex* v) {
                            static_cast<User*>(u)->calls += v->color[1] == 1 && v->color[0] == 0;
                            glevColor3f(static_cast<User*>(u)->gl, 9, 9, 9);
                            static_cast<User*>(u)->calls += v->color[1] == 1;  // not the current value itself
                          },
                          [](void* u) { glevEnable(static_cast<User*>(u)->gl, GLEV_MAP1_INDEX); }};
  ASSERT_EQ(glevSetSink(gl, &sink), GLEV_SUCCESS);
  glevBegin(gl, GLEV_POINTS);
  glevVertex3f(gl, 1, 2, 3);
  glevEnd(gl);
  EXPECT_EQ(user.calls, 2);
  expect_error(GLEV_INVALID_OPERATION);  // Enable, within the end callback
  EXPECT_EQ(glevIsEnabled(gl, GLEV_MAP1_INDEX), GLEV_FALSE);
}

}  // namespace
}  // namespace glev_tests
