// Tests Begin, Vertex, End, the forms of commands, and the sink.
#include <functional>

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

// Vertices of evaluations and of Vertex have all attributes that no map supplies. INDEX maps supply none.
TEST_F(PrimitiveTest, AVertexCarriesEverythingCurrent) {
  for (const glev_enum cap : {GLEV_MAP1_VERTEX_3, GLEV_MAP1_INDEX, GLEV_MAP2_VERTEX_3, GLEV_MAP2_INDEX})
    glevEnable(gl, cap);
  const std::function<void()> emits[] = {[&] { glevVertex3f(gl, 0, 0, 0); },
                                         [&] { glevEvalCoord1f(gl, 0.5f); },
                                         [&] { glevEvalCoord2f(gl, 0.5f, 0.5f); },
                                         [&] { glevEvalPoint1(gl, 1); }, [&] { glevEvalPoint2(gl, 1, 1); }};
  glevBegin(gl, GLEV_POINTS);
  for (std::size_t i = 0; i < std::size(emits); ++i) {
    const auto value = static_cast<float>(i);
    glevColor4f(gl, 0.1f, 0.2f, 0.3f, value);
    glevNormal3f(gl, 1, 2, value);
    glevIndexf(gl, value);
    glevEdgeFlag(gl, i % 2 == 0);
    for (int unit = 0; unit < 8; ++unit)
      glevMultiTexCoord4f(gl, GLEV_TEXTURE0 + unit, static_cast<float>(unit), value, 6, 7);
    emits[i]();
  }
  glevEnd(gl);
  expect_error(GLEV_NO_ERROR);
  ASSERT_EQ(recording.vertices.size(), std::size(emits));
  for (std::size_t i = 0; i < std::size(emits); ++i) {
    SCOPED_TRACE(i);
    const auto value = static_cast<float>(i);
    const glev_vertex& vertex = recording.vertices[i];
    EXPECT_EQ(vertex.size, sizeof(glev_vertex));
    EXPECT_EQ(values_of(vertex.position), (Floats{0, 0, 0, 1}));
    EXPECT_EQ(values_of(vertex.color), (Floats{0.1f, 0.2f, 0.3f, value}));
    EXPECT_EQ(values_of(vertex.normal), (Floats{1, 2, value}));
    EXPECT_EQ(vertex.index, value);
    EXPECT_EQ(vertex.edge_flag, i % 2 == 0 ? GLEV_TRUE : GLEV_FALSE);
    for (int unit = 0; unit < 8; ++unit)
      EXPECT_EQ(values_of(vertex.texcoord[unit]), (Floats{static_cast<float>(unit), value, 6, 7}));
  }
}

TEST_F(PrimitiveTest, OutsideBeginAndEndNothingIsEmitted) {
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  glevEnable(gl, GLEV_MAP2_VERTEX_3);
  glevVertex3f(gl, 1, 2, 3);
  glevEvalCoord1f(gl, 0.5f);
  glevEvalCoord2f(gl, 0.5f, 0.5f);
  glevEvalPoint1(gl, 1);
  glevEvalPoint2(gl, 1, 1);
  EXPECT_TRUE(recording.vertices.empty());
  expect_error(GLEV_NO_ERROR);
}

// ---- Forms

// The forms f, d, fv and dv of a command, the last two also with null pointers.
struct Forms {
  const char* name;
  std::function<void()> forms[4], nulls[2];
};
#define ONE(x) x[0]
#define TWO(x) x[0], x[1]
#define THREE(x) x[0], x[1], x[2]
#define FOUR(x) x[0], x[1], x[2], x[3]
#define FORMS(name, arguments, ...)                                                                              \
  {                                                                                                              \
#name,                                                                                                         \
        {[&] { glev##name##f(__VA_ARGS__, arguments(f)); }, [&] { glev##name##d(__VA_ARGS__, arguments(d)); },     \
         [&] { glev##name##fv(__VA_ARGS__, f); }, [&] { glev##name##dv(__VA_ARGS__, d); }},                        \
        { \
      [&] { glev##name##fv(__VA_ARGS__, nullptr); }, [&] { glev##name##dv(__VA_ARGS__, nullptr); }               \
    }                                                                                                            \
  }

TEST_F(PrimitiveTest, FormsSetTheirAttribute) {
  const float f[] = {0.1f, 2, -3, 0.5f};
  const double d[] = {0.1, 2, -3, 0.5};
  const glev_enum unit = GLEV_TEXTURE0 + 3;
  const auto position = [](const glev_vertex& v) { return values_of(v.position); };
  const auto color = [](const glev_vertex& v) { return values_of(v.color); };
  const auto normal = [](const glev_vertex& v) { return values_of(v.normal); };
  const auto index = [](const glev_vertex& v) { return Floats{v.index}; };
  const auto texture0 = [](const glev_vertex& v) { return values_of(v.texcoord[0]); };
  const auto texture3 = [](const glev_vertex& v) { return values_of(v.texcoord[3]); };
  struct Row {
    Forms command;
    Floats (*read)(const glev_vertex&);
    Floats expected;
  };
  const Floats one = {0.1f, 0, 0, 1}, two = {0.1f, 2, 0, 1}, three = {0.1f, 2, -3, 1},
               four = {0.1f, 2, -3, 0.5f};
  const Row rows[] = {{FORMS(Vertex2, TWO, gl), position, two},
                      {FORMS(Vertex3, THREE, gl), position, three},
                      {FORMS(Vertex4, FOUR, gl), position, four},
                      {FORMS(Color3, THREE, gl), color, three},
                      {FORMS(Color4, FOUR, gl), color, four},
                      {FORMS(Normal3, THREE, gl), normal, {0.1f, 2, -3}},
                      {FORMS(Index, ONE, gl), index, {0.1f}},
                      {FORMS(TexCoord1, ONE, gl), texture0, one},
                      {FORMS(TexCoord2, TWO, gl), texture0, two},
                      {FORMS(TexCoord3, THREE, gl), texture0, three},
                      {FORMS(TexCoord4, FOUR, gl), texture0, four},
                      {FORMS(MultiTexCoord1, ONE, gl, unit), texture3, one},
                      {FORMS(MultiTexCoord2, TWO, gl, unit), texture3, two},
                      {FORMS(MultiTexCoord3, THREE, gl, unit), texture3, three},
                      {FORMS(MultiTexCoord4, FOUR, gl, unit), texture3, four}};
  glevActiveTexture(gl, GLEV_TEXTURE0 + 2);  // does not matter
  for (const auto& [command, read, expected] : rows) {
    SCOPED_TRACE(command.name);
    for (const auto& form : command.forms) {
      glevColor4f(gl, 9, 9, 9, 9);
      glevNormal3f(gl, 9, 9, 9);
      glevIndexf(gl, 9);
      for (const glev_enum other : {glev_enum{GLEV_TEXTURE0}, unit})
        glevMultiTexCoord4f(gl, other, 9, 9, 9, 9);
      const glev_vertex vertex = one_vertex([&, &call = form] {
        call();
        if (recording.vertices.empty()) glevVertex2f(gl, 9, 9);
      });
      EXPECT_EQ(read(vertex), expected);
      EXPECT_EQ(values_of(vertex.texcoord[2]), (Floats{0, 0, 0, 1}));
      expect_error(GLEV_NO_ERROR);
    }
    for (const auto& null : command.nulls) expect_rejected_in_primitive(GLEV_INVALID_VALUE, null);
  }
  for (const glev_boolean flag : {0, 1, 2, 255, 0}) {
    for (const bool is_vector : {false, true}) {
      glevEdgeFlag(gl, !flag);
      is_vector ? glevEdgeFlagv(gl, &flag) : glevEdgeFlag(gl, flag);
      EXPECT_EQ(one_vertex([&] { glevVertex2f(gl, 9, 9); }).edge_flag, flag != 0 ? GLEV_TRUE : GLEV_FALSE);
    }
  }
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevEdgeFlagv(gl, nullptr); });
}

TEST_F(PrimitiveTest, FormsOfEvalCoordAgreeBitForBit) {
  const float points[] = {0.1f, 0.7f, -0.3f, 0.9f};
  glevMap1f(gl, GLEV_MAP1_TEXTURE_COORD_1, 0.1f, 0.7f, 1, 4, points);
  glevMap2f(gl, GLEV_MAP2_TEXTURE_COORD_1, 0.1f, 0.7f, 2, 2, 0, 1, 1, 2, points);
  for (const glev_enum cap :
       {GLEV_MAP1_TEXTURE_COORD_1, GLEV_MAP1_VERTEX_3, GLEV_MAP2_TEXTURE_COORD_1, GLEV_MAP2_VERTEX_3})
    glevEnable(gl, cap);
  for (const float u : {0.1f, 0.3f, 0.7f, -4.0f}) {
    const float f[] = {u, 0.7f, static_cast<float>(kNaN)};
    const double d[] = {u, 0.7f, kNaN};
    for (const Forms& command : {Forms FORMS(EvalCoord1, ONE, gl), Forms FORMS(EvalCoord2, TWO, gl)}) {
      SCOPED_TRACE(command.name);
      const float expected = one_vertex(command.forms[0]).texcoord[0][0];
      for (const auto& form : command.forms) EXPECT_EQ(one_vertex(form).texcoord[0][0], expected);
      for (const auto& null : command.nulls) expect_rejected_in_primitive(GLEV_INVALID_VALUE, null);
    }
  }
}

#undef FORMS
#undef FOUR
#undef THREE
#undef TWO
#undef ONE

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
  EXPECT_EQ(glevSetSink(gl, &larger.sink), GLEV_ERROR_STRUCTURE_SIZE);
  glev_sink smaller = recording.make_sink();
  smaller.size = sizeof(glev_sink) - 1;
  EXPECT_EQ(glevSetSink(gl, &smaller), GLEV_ERROR_STRUCTURE_SIZE);
  smaller.size = 0;
  EXPECT_EQ(glevSetSink(gl, &smaller), GLEV_ERROR_STRUCTURE_SIZE);
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
