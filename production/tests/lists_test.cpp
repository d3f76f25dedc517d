// Display lists: what is compiled, when it is executed, and what happens in between.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>

#include "production/tests/fixture.h"
#include "production/tests/ledger.h"

namespace glev_tests {
namespace {

using Command = std::function<void(glev_context*)>;

class Lists : public ContextTest {
 protected:
  void Compile(glev_uint name, const std::function<void()>& commands, glev_enum mode = GLEV_COMPILE) {
    glevNewList(gl, name, mode);
    commands();
    glevEndList(gl);
  }

  float Index() {
    float index;
    glevGetFloatv(gl, GLEV_CURRENT_INDEX, &index);
    return index;
  }

  std::vector<float> Indices() {
    std::vector<float> indices;
    for (const glev_vertex& vertex : recording.vertices) indices.push_back(vertex.index);
    return indices;
  }

  int Integer(glev_enum name) {
    int value = -77;
    glevGetIntegerv(gl, name, &value);
    return value;
  }

  void Fresh() {
    glevDestroyContext(gl);
    ASSERT_EQ(glevCreateContext(nullptr, &gl), GLEV_SUCCESS);
    recording = {};
    const glev_sink sink = recording.Sink();
    glevSetSink(gl, &sink);
  }
};

// ---- Every command in every form

// Everything that an array argument is read from: 0.25, 0.5, 0.75, ...
template <class Real>
const Real* Numbers() {
  static const std::vector<Real> numbers = [] {
    std::vector<Real> made(200);
    for (std::size_t i = 0; i < made.size(); ++i) made[i] = static_cast<Real>(i + 1) / 4;
    return made;
  }();
  return numbers.data();
}

// One call of each function whose command belongs into lists.
std::vector<std::pair<const char*, Command>> CompiledCommands() {
  static constexpr glev_enum kUnit = GLEV_TEXTURE0 + 3;
  const float* f = Numbers<float>();
  const double* d = Numbers<double>();
  static const glev_boolean no = GLEV_FALSE;
  static const unsigned char names[] = {90, 91};
#define COMMAND(name, ...)                                         \
  {                                                                \
#name, [=](glev_context * gl) { glev##name(gl, __VA_ARGS__); } \
  }
#define VECTOR_FORMS(name)                                          \
  {#name "fv", [=](glev_context* gl) { glev##name##fv(gl, f); }}, { \
#name "dv", [=](glev_context * gl) { glev##name##dv(gl, d); }   \
  }
#define FORMS(name, ...) COMMAND(name##f, __VA_ARGS__), COMMAND(name##d, __VA_ARGS__), VECTOR_FORMS(name)
#define UNIT_FORMS(name, ...)                                                                              \
  COMMAND(name##f, kUnit, __VA_ARGS__), COMMAND(name##d, kUnit, __VA_ARGS__), COMMAND(name##fv, kUnit, f), \
      COMMAND(name##dv, kUnit, d)
  return {COMMAND(Map1f, GLEV_MAP1_VERTEX_4, 0, 2, 5, 3, f),
          COMMAND(Map1d, GLEV_MAP1_NORMAL, 0, 2, 3, 3, d),
          COMMAND(Map2f, GLEV_MAP2_VERTEX_4, 0, 2, 20, 3, 0, 1, 5, 3, f),
          COMMAND(Map2d, GLEV_MAP2_COLOR_4, 0, 2, 4, 3, 0, 1, 12, 3, d),
          COMMAND(Enable, GLEV_MAP1_COLOR_4),
          COMMAND(Disable, GLEV_MAP1_VERTEX_3),
          COMMAND(MapGrid1f, 3, 0, 1),
          COMMAND(MapGrid1d, 4, 0, 1),
          COMMAND(MapGrid2f, 3, 0, 1, 5, 0, 1),
          COMMAND(MapGrid2d, 4, 0, 1, 6, 0, 1),
          FORMS(EvalCoord1, 0.25f),
          FORMS(EvalCoord2, 0.25f, 0.75f),
          COMMAND(EvalPoint1, 1),
          COMMAND(EvalPoint2, 1, 2),
          COMMAND(EvalMesh1, GLEV_LINE, 0, 2),
          COMMAND(EvalMesh2, GLEV_FILL, 0, 2, 1, 3),
          COMMAND(Begin, GLEV_LINES),
          {"End", [](glev_context* gl) { glevEnd(gl); }},
          FORMS(Vertex2, 1, 2),
          FORMS(Vertex3, 1, 2, 3),
          FORMS(Vertex4, 1, 2, 3, 4),
          FORMS(Color3, 0.5f, 2, 3),
          FORMS(Color4, 0.5f, 2, 3, 4),
          FORMS(Normal3, 0.5f, 2, 3),
          FORMS(Index, 7.5f),
          COMMAND(EdgeFlag, no),
          COMMAND(EdgeFlagv, &no),
          FORMS(TexCoord1, 1.5f),
          FORMS(TexCoord2, 1.5f, 2),
          FORMS(TexCoord3, 1.5f, 2, 3),
          FORMS(TexCoord4, 1.5f, 2, 3, 4),
          UNIT_FORMS(MultiTexCoord1, 1.5f),
          UNIT_FORMS(MultiTexCoord2, 1.5f, 2),
          UNIT_FORMS(MultiTexCoord3, 1.5f, 2, 3),
          UNIT_FORMS(MultiTexCoord4, 1.5f, 2, 3, 4),
          COMMAND(ActiveTexture, GLEV_TEXTURE0 + 5),
          COMMAND(PushAttrib, GLEV_EVAL_BIT),
          {"PopAttrib", [](glev_context* gl) { glevPopAttrib(gl); }},
          COMMAND(CallList, 90),
          COMMAND(CallLists, 2, GLEV_UNSIGNED_BYTE, names),
          COMMAND(ListBase, 17)};
#undef UNIT_FORMS
#undef FORMS
#undef VECTOR_FORMS
#undef COMMAND
}

class EveryCommand : public Lists {
 protected:
  // What a command can be seen by.
  struct Effect {
    glev_enum error;
    std::vector<double> state;
    std::vector<double> drawn;
    bool operator==(const Effect&) const = default;
  };

  // A context where every command has an effect.
  void Prepare() {
    Fresh();
    Compile(90, [&] { glevColor3f(gl, 9, 0, 0); });
    Compile(91, [&] { glevNormal3f(gl, 9, 1, 0); });
    glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 3, Numbers<float>() + 2);
    glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 3, 3, 0, 1, 9, 2, Numbers<float>() + 4);
    glevEnable(gl, GLEV_MAP1_VERTEX_3);
    glevEnable(gl, GLEV_MAP2_VERTEX_3);
    glevPushAttrib(gl, GLEV_ALL_ATTRIB_BITS);
    glevMapGrid2f(gl, 2, 0, 1, 2, 0, 1);
    recording = {};
  }

  Effect Observe() {
    Effect effect{glevGetError(gl), State(), {}};
    for (glev_enum mode : recording.begun) effect.drawn.push_back(mode);
    effect.drawn.push_back(recording.ended);
    for (const glev_vertex& v : recording.vertices) {
      const auto add = [&](const float* values, int count) {
        effect.drawn.insert(effect.drawn.end(), values, values + count);
      };
      add(v.position, 4);
      add(v.color, 4);
      add(v.normal, 3);
      add(&v.texcoord[0][0], 4 * GLEV_TEXTURE_UNITS);
      add(&v.index, 1);
      effect.drawn.push_back(v.edge_flag);
    }
    return effect;
  }

  // Runs the commands at once; in a list that is called; in a list while it is compiled; in that list again.
  void Check(const Command& commands) {
    Prepare();
    const Effect nothing = Observe();
    commands(gl);
    const Effect once = Observe();
    EXPECT_NE(once, nothing) << "the test sees nothing of it";
    recording = {};
    commands(gl);
    const Effect twice = Observe();

    Prepare();
    glevNewList(gl, 1, GLEV_COMPILE);
    commands(gl);
    glevEndList(gl);
    EXPECT_EQ(Observe(), nothing) << "executed while compiled";
    glevCallList(gl, 1);
    EXPECT_EQ(Observe(), once) << "list";
    recording = {};
    glevCallList(gl, 1);
    EXPECT_EQ(Observe(), twice) << "list, again";

    Prepare();
    glevNewList(gl, 1, GLEV_COMPILE_AND_EXECUTE);
    commands(gl);
    glevEndList(gl);
    EXPECT_EQ(Observe(), once) << "compile and execute";
    recording = {};
    glevCallList(gl, 1);
    EXPECT_EQ(Observe(), twice) << "executed, then list";
  }
};

TEST_F(EveryCommand, HasTheEffectOfItsCallWhenTheListIsCalledAndNotBefore) {
  for (const auto& [name, command] : CompiledCommands()) {
    SCOPED_TRACE(name);
    const std::string_view text = name;
    if (text == "Begin") {
      Check([&](glev_context* context) {
        command(context);
        glevVertex2f(context, 1, 1);
        glevEnd(context);
      });
      continue;
    }
    const bool draws =
        text.starts_with("Vertex") || text.starts_with("EvalCoord") || text.starts_with("EvalPoint");
    if (!draws) Check(command);
    // between Begin and End, where some are errors
    Check([&](glev_context* context) {
      glevBegin(context, GLEV_POINTS);
      command(context);
      glevVertex2f(context, 1, 1);
      if (text != "End") glevEnd(context);
    });
  }
}

TEST_F(EveryCommand, NullPointersAreErrorsOfTheList) {
  const std::pair<const char*, Command> commands[] = {
      {"Map1f", [](glev_context* c) { glevMap1f(c, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, nullptr); }},
      {"Map2d", [](glev_context* c) { glevMap2d(c, GLEV_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 2, nullptr); }},
      {"EvalCoord1fv", [](glev_context* c) { glevEvalCoord1fv(c, nullptr); }},
      {"EvalCoord2dv", [](glev_context* c) { glevEvalCoord2dv(c, nullptr); }},
      {"Vertex3fv", [](glev_context* c) { glevVertex3fv(c, nullptr); }},
      {"Color4dv", [](glev_context* c) { glevColor4dv(c, nullptr); }},
      {"Normal3fv", [](glev_context* c) { glevNormal3fv(c, nullptr); }},
      {"Indexfv", [](glev_context* c) { glevIndexfv(c, nullptr); }},
      {"EdgeFlagv", [](glev_context* c) { glevEdgeFlagv(c, nullptr); }},
      {"TexCoord2fv", [](glev_context* c) { glevTexCoord2fv(c, nullptr); }},
      {"CallLists", [](glev_context* c) { glevCallLists(c, 1, GLEV_INT, nullptr); }}};
  for (const auto& [name, command] : commands) {
    SCOPED_TRACE(name);
    Check(command);
    Compile(1, [&, &run = command] { run(gl); });
    ExpectError(GLEV_NO_ERROR);
    ExpectRefused(GLEV_INVALID_VALUE, [&] { glevCallList(gl, 1); });
  }
  Compile(1, [&] { glevCallLists(gl, 0, GLEV_INT, nullptr); });
  ExpectAccepted([&] { glevCallList(gl, 1); });
}

// ---- Errors

TEST_F(EveryCommand, ErrorsComeWhenTheListIsCalledAndDoNotEndIt) {
  const float* f = Numbers<float>();
  const double* d = Numbers<double>();
  const unsigned char names[] = {90};
  const std::pair<glev_enum, Command> rows[] = {
      {GLEV_INVALID_ENUM, [=](glev_context* c) { glevMap1f(c, GLEV_MAP2_VERTEX_3, 0, 1, 3, 2, f); }},
      {GLEV_INVALID_ENUM, [=](glev_context* c) { glevMap1d(c, GLEV_AUTO_NORMAL, 0, 1, 3, 2, d); }},
      {GLEV_INVALID_VALUE, [=](glev_context* c) { glevMap1f(c, GLEV_MAP1_VERTEX_3, 0, 1, 2, 2, f); }},
      {GLEV_INVALID_VALUE, [=](glev_context* c) { glevMap1f(c, GLEV_MAP1_VERTEX_3, 0, 1, -3, 2, f); }},
      {GLEV_INVALID_VALUE, [=](glev_context* c) { glevMap1f(c, GLEV_MAP1_VERTEX_3, 0, 1, 3, 0, f); }},
      {GLEV_INVALID_VALUE, [=](glev_context* c) { glevMap1d(c, GLEV_MAP1_INDEX, 0, 1, 1, 65, d); }},
      {GLEV_INVALID_VALUE, [=](glev_context* c) { glevMap1f(c, GLEV_MAP1_VERTEX_3, 2, 2, 3, 2, f); }},
      {GLEV_INVALID_ENUM,
       [=](glev_context* c) { glevMap2f(c, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 2, f); }},
      {GLEV_INVALID_VALUE,
       [=](glev_context* c) { glevMap2f(c, GLEV_MAP2_VERTEX_3, 0, 1, 2, 2, 0, 1, 6, 2, f); }},
      {GLEV_INVALID_VALUE,
       [=](glev_context* c) { glevMap2f(c, GLEV_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 2, 2, f); }},
      {GLEV_INVALID_VALUE,
       [=](glev_context* c) { glevMap2d(c, GLEV_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 65, d); }},
      {GLEV_INVALID_VALUE,
       [=](glev_context* c) { glevMap2f(c, GLEV_MAP2_VERTEX_3, 0, 1, 3, 2, 1, 1, 6, 2, f); }},
      {GLEV_INVALID_ENUM, [](glev_context* c) { glevEnable(c, 0); }},
      {GLEV_INVALID_ENUM, [](glev_context* c) { glevDisable(c, 0); }},
      {GLEV_INVALID_VALUE, [](glev_context* c) { glevMapGrid1f(c, 0, 0, 1); }},
      {GLEV_INVALID_VALUE, [](glev_context* c) { glevMapGrid2d(c, 1, 0, 1, -1, 0, 1); }},
      {GLEV_INVALID_ENUM, [](glev_context* c) { glevEvalMesh1(c, GLEV_FILL, 0, 1); }},
      {GLEV_INVALID_ENUM, [](glev_context* c) { glevEvalMesh2(c, 0, 0, 1, 0, 1); }},
      {GLEV_INVALID_ENUM, [](glev_context* c) { glevBegin(c, 99); }},
      {GLEV_INVALID_OPERATION, [](glev_context* c) { glevEnd(c); }},
      {GLEV_INVALID_ENUM, [](glev_context* c) { glevMultiTexCoord1f(c, GLEV_TEXTURE0 + 8, 0); }},
      {GLEV_INVALID_ENUM, [](glev_context* c) { glevActiveTexture(c, GLEV_TEXTURE0 + 8); }},
      {GLEV_INVALID_VALUE, [=](glev_context* c) { glevCallLists(c, -1, GLEV_BYTE, names); }},
      {GLEV_INVALID_ENUM, [=](glev_context* c) { glevCallLists(c, 1, GLEV_DOUBLE, names); }},
  };
  for (std::size_t i = 0; i < std::size(rows); ++i) {
    SCOPED_TRACE(i);
    const auto& [error, command] = rows[i];
    Check(command);
    Prepare();
    Compile(1, [&, &run = command] {
      run(gl);
      ExpectError(GLEV_NO_ERROR);
      glevIndexf(gl, 5);
    });
    ExpectError(GLEV_NO_ERROR);
    glevCallList(gl, 1);
    ExpectError(error);
    EXPECT_EQ(Index(), 5) << "the list goes on";
  }
}

TEST_F(Lists, StateIsJudgedWhenTheListIsCalled) {
  const float point[] = {1, 2, 3};
  const auto map = [&] { glevMap1f(gl, GLEV_MAP1_VERTEX_3, 5, 6, 3, 1, point); };
  glevActiveTexture(gl, GLEV_TEXTURE0 + 1);
  Compile(1, map);
  glevActiveTexture(gl, GLEV_TEXTURE0);
  ExpectAccepted([&] { glevCallList(gl, 1); });
  Compile(2, map);
  glevActiveTexture(gl, GLEV_TEXTURE0 + 1);
  ExpectRefused(GLEV_INVALID_OPERATION, [&] { glevCallList(gl, 2); });
  glevActiveTexture(gl, GLEV_TEXTURE0);
  Compile(3, [&] {
    glevActiveTexture(gl, GLEV_TEXTURE0 + 1);
    map();
  });
  glevCallList(gl, 3);
  ExpectError(GLEV_INVALID_OPERATION);
}

TEST_F(Lists, InsideBeginAndEndTheCommandsOfAListHaveTheirErrors) {
  const float points[] = {1, 2, 3, 4, 5, 6};
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, points);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  for (const std::function<void()>& forbidden : std::initializer_list<std::function<void()>>{
           [&] { glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 1, points); },
           [&] { glevMapGrid1f(gl, 7, 0, 1); }, [&] { glevEvalMesh1(gl, GLEV_POINT, 0, 1); },
           [&] { glevEnable(gl, GLEV_MAP1_INDEX); }, [&] { glevBegin(gl, GLEV_LINES); },
           [&] { glevActiveTexture(gl, GLEV_TEXTURE0 + 1); }, [&] { glevPushAttrib(gl, GLEV_EVAL_BIT); },
           [&] { glevPopAttrib(gl); }, [&] { glevListBase(gl, 1); }}) {
    Compile(1, [&] {
      glevEvalCoord1f(gl, 0);
      forbidden();
      glevEvalPoint1(gl, 1);
    });
    const std::vector<double> before = State();
    recording = {};
    glevBegin(gl, GLEV_POINTS);
    glevCallList(gl, 1);
    glevEnd(gl);
    ExpectError(GLEV_INVALID_OPERATION);
    EXPECT_EQ(State(), before);
    EXPECT_EQ(recording.vertices.size(), 2u);
    EXPECT_EQ(recording.begun, std::vector<glev_enum>{GLEV_POINTS});
  }
}

// ---- Memory of the caller

TEST_F(Lists, PointsAreReadWhenTheCommandIsGivenAndNoFurtherThanTheyGo) {
  // Arrays that end with the last value of the last point: a memory checker sees whoever reads on.
  const auto fill = [](auto& values, std::size_t count) {
    values = std::make_unique<std::remove_reference_t<decltype(values[0])>[]>(count);
    std::iota(values.get(), values.get() + count, 1);
  };
  std::unique_ptr<float[]> f;
  std::unique_ptr<double[]> d;
  std::unique_ptr<float[]> color;
  std::unique_ptr<double[]> coord;
  std::unique_ptr<std::int16_t[]> names;
  fill(f, 7 * 3 + 3);           // order 4, stride 7
  fill(d, 11 * 1 + 4 * 2 + 3);  // orders 2 and 3, strides 11 and 4
  fill(color, 3);
  fill(coord, 1);
  fill(names, 2);
  Compile(1, [&] { glevNormal3f(gl, 1, 0, 0); });
  Compile(2, [&] { glevIndexf(gl, 2); });
  Compile(3, [&] {
    glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 7, 4, f.get());
    glevMap2d(gl, GLEV_MAP2_VERTEX_3, 0, 1, 11, 2, 0, 1, 4, 3, d.get());
    glevColor3fv(gl, color.get());
    glevCallLists(gl, 2, GLEV_SHORT, names.get());
    glevEnable(gl, GLEV_MAP1_VERTEX_3);
    glevBegin(gl, GLEV_POINTS);
    glevEvalCoord1dv(gl, coord.get());
    glevEnd(gl);
  });
  std::fill_n(f.get(), 24, -1.0f);
  f.reset();
  d.reset();
  color.reset();
  coord.reset();
  names.reset();
  glevCallList(gl, 3);
  ExpectError(GLEV_NO_ERROR);
  std::vector<double> got(12);
  glevGetMapdv(gl, GLEV_MAP1_VERTEX_3, GLEV_COEFF, got.data());
  EXPECT_EQ(got, (std::vector<double>{1, 2, 3, 8, 9, 10, 15, 16, 17, 22, 23, 24}));
  got.resize(18);
  glevGetMapdv(gl, GLEV_MAP2_VERTEX_3, GLEV_COEFF, got.data());
  EXPECT_EQ(got, (std::vector<double>{1, 2, 3, 5, 6, 7, 9, 10, 11, 12, 13, 14, 16, 17, 18, 20, 21, 22}));
  EXPECT_EQ(Index(), 2);
  ASSERT_EQ(recording.vertices.size(), 1u);
  EXPECT_EQ(Values(recording.vertices[0].position), (Floats{22, 23, 24, 1}));
  EXPECT_EQ(Values(recording.vertices[0].color), (Floats{1, 2, 3, 1}));
}

TEST_F(Lists, DoublesStayDoubles) {
  const double given[] = {0.1, 1.0 / 3.0, 1e300, -0x1p-1074};
  Compile(1, [&] {
    glevMap1d(gl, GLEV_MAP1_TEXTURE_COORD_1, 0.1, 0.1 + 0x1p-56, 1, 4, given);
    glevMapGrid1d(gl, 3, 0.1, 1.0 / 3.0);
  });
  glevCallList(gl, 1);
  double got[4];
  glevGetMapdv(gl, GLEV_MAP1_TEXTURE_COORD_1, GLEV_COEFF, got);
  EXPECT_EQ(std::memcmp(got, given, sizeof given), 0);
  glevGetMapdv(gl, GLEV_MAP1_TEXTURE_COORD_1, GLEV_DOMAIN, got);
  EXPECT_TRUE(got[0] == 0.1 && got[1] == 0.1 + 0x1p-56);
  glevGetDoublev(gl, GLEV_MAP1_GRID_DOMAIN, got);
  EXPECT_TRUE(got[0] == 0.1 && got[1] == 1.0 / 3.0);

  const double line[] = {0, 0, 0, 0x1p40, 0, 0};
  glevMap1d(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, line);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  Compile(2, [&] { glevEvalCoord1d(gl, 1.0 / 3.0); });
  const float immediate = OneVertex([&] { glevEvalCoord1d(gl, 1.0 / 3.0); }).position[0];
  EXPECT_EQ(OneVertex([&] { glevCallList(gl, 2); }).position[0], immediate);
}

// ---- Execution

TEST_F(Lists, EvaluationUsesTheStateOfTheCall) {
  const float first[] = {0, 0, 0, 1, 0, 0}, second[] = {0, 0, 0, 8, 0, 0};
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, first);
  Compile(1, [&] {
    glevBegin(gl, GLEV_POINTS);
    glevEvalCoord1f(gl, 0.5f);
    glevEvalPoint1(gl, 1);
    glevEnd(gl);
    glevEvalMesh1(gl, GLEV_POINT, 1, 1);
  });
  glevCallList(gl, 1);
  EXPECT_TRUE(recording.vertices.empty());
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, second);
  glevMapGrid1f(gl, 4, 0, 1);
  recording = {};
  glevCallList(gl, 1);
  ASSERT_EQ(recording.vertices.size(), 3u);
  EXPECT_EQ(recording.vertices[0].position[0], 4);
  EXPECT_EQ(recording.vertices[1].position[0], 2);
  EXPECT_EQ(recording.vertices[2].position[0], 2);

  // maps from one list count in the rest of the list that calls it
  Compile(2, [&] { glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, first); });
  Compile(3, [&] {
    glevEvalMesh1(gl, GLEV_POINT, 4, 4);
    glevCallList(gl, 2);
    glevEvalMesh1(gl, GLEV_POINT, 4, 4);
  });
  recording = {};
  glevCallList(gl, 3);
  EXPECT_EQ(recording.vertices.at(0).position[0], 8);
  EXPECT_EQ(recording.vertices.at(1).position[0], 1);
  ExpectError(GLEV_NO_ERROR);
}

TEST_F(Lists, CurrentValuesAreUntouchedByCompiledEvaluation) {
  const float s = 3;
  glevMap1f(gl, GLEV_MAP1_TEXTURE_COORD_1, 0, 1, 1, 1, &s);
  glevEnable(gl, GLEV_MAP1_TEXTURE_COORD_1);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  Compile(1, [&] {
    glevTexCoord4f(gl, 5, 6, 7, 8);
    glevEvalCoord1f(gl, 0.5f);
    glevVertex2f(gl, 0, 0);
  });
  glevBegin(gl, GLEV_POINTS);
  glevCallList(gl, 1);
  glevEnd(gl);
  ASSERT_EQ(recording.vertices.size(), 2u);
  EXPECT_EQ(Values(recording.vertices[0].texcoord[0]), (Floats{3, 0, 0, 1}));
  EXPECT_EQ(Values(recording.vertices[1].texcoord[0]), (Floats{5, 6, 7, 8}));
}

TEST_F(Lists, APrimitiveMayBeSpreadOverLists) {
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  Compile(1, [&] { glevBegin(gl, GLEV_LINE_STRIP); });
  Compile(2, [&] { glevEvalCoord1f(gl, 0); });
  Compile(3, [&] { glevEnd(gl); });
  ExpectError(GLEV_NO_ERROR);
  glevCallList(gl, 1);
  glevCallList(gl, 2);
  glevEvalCoord1f(gl, 1);
  glevCallList(gl, 2);
  glevEnd(gl);
  glevBegin(gl, GLEV_POINTS);
  glevCallList(gl, 2);
  glevCallList(gl, 3);
  ExpectError(GLEV_NO_ERROR);
  EXPECT_EQ(recording.begun, (std::vector<glev_enum>{GLEV_LINE_STRIP, GLEV_POINTS}));
  EXPECT_EQ(recording.vertices.size(), 4u);
  EXPECT_EQ(recording.ended, 2);
}

TEST_F(Lists, NamesWithoutAListAreIgnored) {
  ExpectAccepted([&] { glevCallList(gl, 0); });
  ExpectAccepted([&] { glevCallList(gl, 77); });
  const int names[] = {0, 77, -1};
  ExpectAccepted([&] { glevCallLists(gl, 3, GLEV_INT, names); });
}

TEST_F(Lists, NestSixtyFourDeepAndIgnoreWhatIsDeeper) {
  for (glev_uint name = 1; name <= 70; ++name) {
    Compile(name, [&] {
      glevIndexf(gl, static_cast<float>(name));
      glevVertex2f(gl, 0, 0);
      const glev_uint next = name + 1;
      if (name % 2 == 0) {
        glevCallList(gl, next);
      } else {
        glevCallLists(gl, 1, GLEV_UNSIGNED_INT, &next);
      }
      glevVertex2f(gl, 1, 1);
    });
  }
  for (int round = 0; round < 2; ++round) {
    recording = {};
    glevBegin(gl, GLEV_POINTS);
    glevCallList(gl, 1);
    glevEnd(gl);
    EXPECT_EQ(recording.vertices.size(), 128u);
    EXPECT_EQ(Index(), 64);
  }
  ExpectError(GLEV_NO_ERROR);
}

TEST_F(Lists, AListMayCallItself) {
  Compile(5, [&] { glevIndexf(gl, 1); });
  Compile(
      5,
      [&] {
        glevBegin(gl, GLEV_POINTS);
        glevVertex2f(gl, 0, 0);
        glevEnd(gl);
        glevCallList(gl, 5);
      },
      GLEV_COMPILE_AND_EXECUTE);
  EXPECT_EQ(recording.vertices.size(), 1u);
  EXPECT_EQ(Index(), 1) << "the name stood for the old list until EndList";
  recording = {};
  glevCallList(gl, 5);
  EXPECT_EQ(recording.vertices.size(), 64u);
  ExpectError(GLEV_NO_ERROR);
}

TEST_F(Lists, ALaterDefinitionIsWhatACompiledCallFinds) {
  Compile(1, [&] { glevCallList(gl, 2); });
  glevCallList(gl, 1);
  EXPECT_EQ(Index(), 1);
  Compile(2, [&] { glevIndexf(gl, 22); });
  glevCallList(gl, 1);
  EXPECT_EQ(Index(), 22);
  glevDeleteLists(gl, 2, 1);
  glevIndexf(gl, 0);
  glevCallList(gl, 1);
  EXPECT_EQ(Index(), 0);
}

TEST_F(Lists, WhatACalledListDoesIsNotCompiledAgain) {
  Compile(1, [&] { glevIndexf(gl, 5); });
  Compile(
      2, [&] { glevCallList(gl, 1); }, GLEV_COMPILE_AND_EXECUTE);
  EXPECT_EQ(Index(), 5);
  Compile(1, [&] {});
  glevIndexf(gl, 0);
  glevCallList(gl, 2);
  EXPECT_EQ(Index(), 0);
}

// ---- CallLists and ListBase

class ListCalls : public Lists {
 protected:
  // The lists that these offsets call from this base, by name; each of `names` is a list.
  template <class Value>
  std::vector<float> Called(glev_enum type, glev_uint base, const std::vector<glev_uint>& names,
                            const std::vector<Value>& offsets, int n) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      Compile(names[i], [&] {
        glevIndexf(gl, static_cast<float>(i));
        glevVertex2f(gl, 0, 0);
      });
    }
    glevListBase(gl, base);
    std::vector<float> called;
    for (const bool compiled : {false, true}) {
      // unaligned, exactly as long as it has to be
      const std::size_t bytes = offsets.size() * sizeof(Value);
      const auto memory = std::make_unique<unsigned char[]>(bytes + 1);
      std::memcpy(memory.get() + 1, offsets.data(), bytes);
      if (compiled) {
        Compile(500, [&] { glevCallLists(gl, n, type, memory.get() + 1); });
        std::fill_n(memory.get(), bytes + 1, 0xEE);
      }
      recording = {};
      glevBegin(gl, GLEV_POINTS);
      if (compiled) {
        glevCallList(gl, 500);
      } else {
        glevCallLists(gl, n, type, memory.get() + 1);
      }
      glevEnd(gl);
      if (compiled) {
        EXPECT_EQ(Indices(), called);
      }
      called = Indices();
    }
    ExpectError(GLEV_NO_ERROR);
    return called;
  }
};

TEST_F(ListCalls, EveryType) {
  const Floats all = {0, 1, 2};
  using Bytes = std::vector<unsigned char>;
  EXPECT_EQ(Called<signed char>(GLEV_BYTE, 200, {205, 199, 72}, {5, -1, -128}, 3), all);
  EXPECT_EQ(Called<unsigned char>(GLEV_UNSIGNED_BYTE, 0, {5, 255, 128}, {5, 255, 128}, 3), all);
  EXPECT_EQ(Called<std::int16_t>(GLEV_SHORT, 40000, {40300, 39999, 7232}, {300, -1, -32768}, 3), all);
  EXPECT_EQ(Called<std::uint16_t>(GLEV_UNSIGNED_SHORT, 1, {301, 65536, 32769}, {300, 65535, 32768}, 3), all);
  EXPECT_EQ(Called<int>(GLEV_INT, 10, {70010, 9, 0x8000000A}, {70000, -1, -2147483647 - 1}, 3), all);
  EXPECT_EQ(
      Called<glev_uint>(GLEV_UNSIGNED_INT, 10, {70010, 9, 0x8000000A}, {70000, 0xFFFFFFFF, 0x80000000}, 3),
      all);
  EXPECT_EQ(Called<float>(GLEV_FLOAT, 10, {13, 9, 0x8000000A}, {3.75f, -0.5f, 0x1p31f}, 3), all);
  EXPECT_EQ(
      Called<unsigned char>(GLEV_2_BYTES, 1, {0x1235, 0xFF81, 3}, Bytes{0x12, 0x34, 0xFF, 0x80, 0, 2}, 3),
      all);
  EXPECT_EQ(Called<unsigned char>(GLEV_3_BYTES, 1, {0x123457, 0xFF8002, 3},
                                  Bytes{0x12, 0x34, 0x56, 0xFF, 0x80, 1, 0, 0, 2}, 3),
            all);
  EXPECT_EQ(Called<unsigned char>(GLEV_4_BYTES, 1, {0x12345679, 0xFF800204, 3},
                                  Bytes{0x12, 0x34, 0x56, 0x78, 0xFF, 0x80, 2, 3, 0, 0, 0, 2}, 3),
            all);
}

TEST_F(ListCalls, NumbersThatAreNoNamesAreHarmless) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::vector<float> offsets = {NAN, kInfinity, -kInfinity, 1e30f, -1e30f, 1};
  EXPECT_EQ(Called<float>(GLEV_FLOAT, 10, {11}, offsets, 6), Floats{0});
}

TEST_F(ListCalls, OnlyNOfThem) {
  EXPECT_EQ(Called<int>(GLEV_INT, 0, {1, 2, 3}, {3, 2, 1}, 2), (Floats{2, 1}));
  EXPECT_EQ(Called<int>(GLEV_INT, 0, {1, 2, 3}, {3, 2, 1}, 0), Floats{});
}

TEST_F(ListCalls, CallListDoesNotUseTheBase) {
  Compile(1, [&] { glevIndexf(gl, 1); });
  Compile(11, [&] { glevIndexf(gl, 11); });
  glevListBase(gl, 10);
  glevCallList(gl, 1);
  EXPECT_EQ(Index(), 1);
}

TEST_F(ListCalls, TheBaseIsTheOneInForceWhenTheListIsCalled) {
  Compile(1, [&] { glevIndexf(gl, 1); });
  Compile(11, [&] { glevListBase(gl, 20); });
  Compile(21, [&] { glevIndexf(gl, 21); });
  const unsigned char one[] = {1, 1};
  Compile(2, [&] { glevCallLists(gl, 1, GLEV_UNSIGNED_BYTE, one); });
  glevCallList(gl, 2);
  EXPECT_EQ(Index(), 1);
  glevListBase(gl, 10);
  glevCallLists(gl, 2, GLEV_UNSIGNED_BYTE, one);
  EXPECT_EQ(Index(), 21) << "a list changes it for the next one";
}

TEST_F(ListCalls, BadArgumentsAreRefused) {
  Compile(1, [&] { glevIndexf(gl, 9); });
  const int names[] = {1};
  ExpectRefused(GLEV_INVALID_VALUE, [&] { glevCallLists(gl, -1, GLEV_INT, names); });
  for (const glev_enum type : {0, 0x13FF, 0x140A, 0x140B}) {
    ExpectRefused(GLEV_INVALID_ENUM, [&] { glevCallLists(gl, 1, type, names); });
    ExpectRefused(GLEV_INVALID_ENUM, [&] { glevCallLists(gl, 0, type, names); });
  }
  ExpectRefused(GLEV_INVALID_VALUE, [&] { glevCallLists(gl, 1, GLEV_INT, nullptr); });
  ExpectRefusedInPrimitive(GLEV_INVALID_OPERATION, [&] { glevListBase(gl, 3); });
}

// ---- NewList and EndList

TEST_F(Lists, NewListAndEndListAreRefused) {
  ExpectRefused(GLEV_INVALID_VALUE, [&] { glevNewList(gl, 0, GLEV_COMPILE); });
  for (const glev_enum mode : {0, 0x12FF, 0x1302}) {
    ExpectRefused(GLEV_INVALID_ENUM, [&] { glevNewList(gl, 1, mode); });
  }
  ExpectRefused(GLEV_INVALID_OPERATION, [&] { glevEndList(gl); });
  ExpectRefusedInPrimitive(GLEV_INVALID_OPERATION, [&] { glevNewList(gl, 1, GLEV_COMPILE); });
  ExpectRefusedInPrimitive(GLEV_INVALID_OPERATION, [&] { glevEndList(gl); });
  EXPECT_EQ(glevIsList(gl, 1), GLEV_FALSE);
  glevNewList(gl, 1, GLEV_COMPILE);
  glevIndexf(gl, 5);
  glevNewList(gl, 2, GLEV_COMPILE_AND_EXECUTE);
  ExpectError(GLEV_INVALID_OPERATION);
  EXPECT_EQ(Integer(GLEV_LIST_INDEX), 1);
  EXPECT_EQ(Integer(GLEV_LIST_MODE), GLEV_COMPILE);
  glevEdgeFlag(gl, GLEV_FALSE);
  glevEndList(gl);
  EXPECT_EQ(glevIsList(gl, 2), GLEV_FALSE);
  ExpectAccepted([&] { glevCallList(gl, 1); });
  EXPECT_EQ(Index(), 5);
  EXPECT_EQ(Integer(GLEV_EDGE_FLAG), 0) << "the list went on";
}

TEST_F(Lists, EndListBetweenAnExecutedBeginAndItsEndLeavesTheListOpen) {
  glevNewList(gl, 1, GLEV_COMPILE_AND_EXECUTE);
  glevBegin(gl, GLEV_POINTS);
  glevEndList(gl);
  glevEnd(gl);
  EXPECT_EQ(Integer(GLEV_LIST_INDEX), 1);
  ExpectError(GLEV_INVALID_OPERATION);
  glevEndList(gl);
  ExpectError(GLEV_NO_ERROR);
  recording = {};
  glevCallList(gl, 1);
  EXPECT_EQ(recording.begun.size(), 1u);
  EXPECT_EQ(recording.ended, 1);
}

TEST_F(Lists, TheOldListStandsUntilEndList) {
  Compile(1, [&] { glevIndexf(gl, 5); });
  glevNewList(gl, 1, GLEV_COMPILE_AND_EXECUTE);
  EXPECT_EQ(glevIsList(gl, 1), GLEV_TRUE);
  glevCallList(gl, 1);
  EXPECT_EQ(Index(), 5);
  glevDeleteLists(gl, 1, 1);
  EXPECT_EQ(glevIsList(gl, 1), GLEV_FALSE);
  glevIndexf(gl, 6);
  EXPECT_EQ(glevIsList(gl, 1), GLEV_FALSE);
  glevEndList(gl);
  EXPECT_EQ(glevIsList(gl, 1), GLEV_TRUE);
  glevIndexf(gl, 0);
  Compile(2, [&] { glevCallList(gl, 1); });
  glevCallList(gl, 2);
  EXPECT_EQ(Index(), 6);
  Compile(1, [&] {});
  glevIndexf(gl, 0);
  glevCallList(gl, 1);
  EXPECT_EQ(Index(), 0) << "an empty list";
  EXPECT_EQ(glevIsList(gl, 1), GLEV_TRUE);
}

TEST_F(Lists, QueriesAndListsOfNamesAreExecutedAtOnce) {
  const float points[] = {1, 2, 3};
  const std::vector<double> state = State();
  Compile(40, [] {});
  for (const glev_enum mode : {GLEV_COMPILE, GLEV_COMPILE_AND_EXECUTE}) {
    glevEnable(gl, 0);
    glevNewList(gl, 1, mode);
    EXPECT_EQ(glevGetError(gl), static_cast<glev_enum>(GLEV_INVALID_ENUM));
    if (mode == GLEV_COMPILE) {
      glevMap1f(gl, GLEV_MAP1_VERTEX_3, 5, 6, 3, 1, points);
      glevEnable(gl, GLEV_MAP1_VERTEX_3);
      glevMapGrid1f(gl, 9, 5, 6);
    }
    double d[3] = {-7, -7, -7};
    float f[3] = {-7, -7, -7};
    int i[3] = {-7, -7, -7};
    glev_boolean b = 77;
    glevGetMapdv(gl, GLEV_MAP1_VERTEX_3, GLEV_COEFF, d);
    glevGetMapfv(gl, GLEV_MAP1_VERTEX_3, GLEV_COEFF, f);
    glevGetMapiv(gl, GLEV_MAP1_VERTEX_3, GLEV_COEFF, i);
    EXPECT_TRUE(d[2] == 0 && f[2] == 0 && i[2] == 0);
    d[2] = f[2] = -7;
    i[2] = -7;
    glevGetnMapdv(gl, GLEV_MAP1_VERTEX_3, GLEV_COEFF, sizeof d, d);
    glevGetnMapfv(gl, GLEV_MAP1_VERTEX_3, GLEV_COEFF, sizeof f, f);
    glevGetnMapiv(gl, GLEV_MAP1_VERTEX_3, GLEV_COEFF, sizeof i, i);
    EXPECT_TRUE(d[2] == 0 && f[2] == 0 && i[2] == 0);
    glevGetDoublev(gl, GLEV_MAP1_GRID_SEGMENTS, d);
    glevGetFloatv(gl, GLEV_MAP1_GRID_SEGMENTS, f);
    glevGetIntegerv(gl, GLEV_MAP1_GRID_SEGMENTS, i);
    glevGetBooleanv(gl, GLEV_MAP1_VERTEX_3, &b);
    EXPECT_TRUE(d[0] == 1 && f[0] == 1 && i[0] == 1 && b == GLEV_FALSE);
    EXPECT_EQ(glevIsEnabled(gl, GLEV_MAP1_VERTEX_3), GLEV_FALSE);
    EXPECT_NE(glevGetString(gl, GLEV_VERSION), nullptr);
    glevFlush(gl);
    glevFinish(gl);
    EXPECT_EQ(glevIsList(gl, 40), GLEV_TRUE);
    glevDeleteLists(gl, 40, 1);
    EXPECT_EQ(glevIsList(gl, 40), GLEV_FALSE);
    const glev_uint made = glevGenLists(gl, 1);
    EXPECT_NE(made, 0u);
    // their errors, too
    glevGetMapdv(gl, 0, GLEV_COEFF, d);
    ExpectError(GLEV_INVALID_ENUM);
    glevGenLists(gl, -1);
    ExpectError(GLEV_INVALID_VALUE);
    glevEndList(gl);
    EXPECT_EQ(State(), state);

    Compile(40, [] {});
    const glev_uint next = glevGenLists(gl, 1);
    if (mode == GLEV_COMPILE_AND_EXECUTE) {
      EXPECT_EQ(State(), state);
    }
    glevCallList(gl, 1);
    ExpectError(GLEV_NO_ERROR);
    EXPECT_EQ(glevIsList(gl, 40), GLEV_TRUE) << "DeleteLists was in the list";
    EXPECT_EQ(glevIsList(gl, next + 1), GLEV_FALSE) << "GenLists was in the list";
    Fresh();
    Compile(40, [] {});
  }
}

TEST_F(Lists, APlanTakenWhileAListIsOpenHasWhatWasExecuted) {
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  glevNewList(gl, 1, GLEV_COMPILE);
  glevDisable(gl, GLEV_MAP1_VERTEX_3);
  const glev_plan_info info = {sizeof(glev_plan_info), 1};
  glev_plan* plan;
  ASSERT_EQ(glevCreatePlan(gl, &info, &plan), GLEV_SUCCESS);
  EXPECT_EQ(glevGetPlanComponents(plan, GLEV_ATTRIBUTE_VERTEX), 3u);
  glevReleasePlan(plan);
}

TEST_F(Lists, AnOpenListDoesNotOutliveTheContext) {
  glevNewList(gl, 1, GLEV_COMPILE);
  for (int i = 0; i < 100; ++i) glevIndexf(gl, 1);
  Fresh();  // a memory checker sees what is left
  EXPECT_EQ(Integer(GLEV_LIST_INDEX), 0);
}

// ---- Callbacks of the sink

class ListCallbacks : public Lists {
 protected:
  // In the first vertex callback `act` is called.
  void OnVertex(std::function<void()> act) {
    act_ = std::move(act);
    const glev_sink sink = {sizeof(glev_sink), this, nullptr,
                            [](void* user, const glev_vertex*) {
                              auto* self = static_cast<ListCallbacks*>(user);
                              ++self->vertices_;
                              if (const auto run = std::exchange(self->act_, nullptr)) run();
                            },
                            nullptr};
    ASSERT_EQ(glevSetSink(gl, &sink), GLEV_SUCCESS);
    vertices_ = 0;
  }

  std::function<void()> act_;
  int vertices_ = 0;
};

TEST_F(ListCallbacks, MayCallLists) {
  Compile(2, [&] {
    glevIndexf(gl, 5);
    glevEnable(gl, GLEV_MAP1_VERTEX_3);
    glevVertex2f(gl, 0, 0);
  });
  const unsigned char two[] = {2};
  OnVertex([&] { glevCallLists(gl, 1, GLEV_UNSIGNED_BYTE, two); });
  glevBegin(gl, GLEV_POINTS);
  glevVertex2f(gl, 0, 0);
  glevEnd(gl);
  EXPECT_EQ(vertices_, 2);
  EXPECT_EQ(Index(), 5);
  ExpectError(GLEV_INVALID_OPERATION);

  // and in a mesh, whose primitive End does not end
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  Compile(3, [&] { glevEnd(gl); });
  OnVertex([&] { glevCallList(gl, 3); });
  glevEvalMesh1(gl, GLEV_POINT, 0, 3);
  EXPECT_EQ(vertices_, 4);
  ExpectError(GLEV_INVALID_OPERATION);
}

TEST_F(ListCallbacks, CannotChangeListsWhileOneIsExecuting) {
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  // after End the callback is not between Begin and End any more
  for (const bool end : {false, true}) {
    for (const std::function<void()>& change : std::initializer_list<std::function<void()>>{
             [&] { glevDeleteLists(gl, 1, 1); }, [&] { glevNewList(gl, 1, GLEV_COMPILE); },
             [&] { glevEndList(gl); }, [&] { EXPECT_EQ(glevGenLists(gl, 1), 0u); }}) {
      Compile(1, [&] {
        glevBegin(gl, GLEV_POINTS);
        glevVertex2f(gl, 0, 0);
        for (int i = 0; i < 50; ++i) glevIndexf(gl, static_cast<float>(i));
      });
      OnVertex([&] {
        if (end) glevEnd(gl);
        change();
      });
      glevCallList(gl, 1);
      if (!end) glevEnd(gl);
      ExpectError(GLEV_INVALID_OPERATION);
      EXPECT_EQ(Index(), 49);
      EXPECT_EQ(glevIsList(gl, 1), GLEV_TRUE);
      EXPECT_EQ(glevIsList(gl, 2), GLEV_FALSE);
      EXPECT_EQ(Integer(GLEV_LIST_INDEX), 0);
    }
  }
  Compile(1, [&] { glevEvalMesh1(gl, GLEV_POINT, 0, 1); });
  OnVertex([&] { glevDeleteLists(gl, 1, 1); });
  glevCallList(gl, 1);
  EXPECT_EQ(vertices_, 2);
  ExpectError(GLEV_INVALID_OPERATION);
  EXPECT_EQ(glevIsList(gl, 1), GLEV_TRUE);
  // afterwards all is well
  ExpectAccepted([&] { glevDeleteLists(gl, 1, 1); });
  EXPECT_EQ(glevIsList(gl, 1), GLEV_FALSE);
}

TEST_F(ListCallbacks, WhatTheyIssueIsExecutedOnceAndNotCompiled) {
  OnVertex([&] { glevIndexf(gl, 5); });
  Compile(
      1,
      [&] {
        glevBegin(gl, GLEV_POINTS);
        glevVertex2f(gl, 0, 0);
        glevEnd(gl);
        glevEdgeFlag(gl, GLEV_FALSE);
      },
      GLEV_COMPILE_AND_EXECUTE);
  EXPECT_EQ(Index(), 5);
  glevIndexf(gl, 0);
  glevEdgeFlag(gl, GLEV_TRUE);
  glevCallList(gl, 1);  // the callback has nothing left to do
  EXPECT_EQ(Index(), 0);
  EXPECT_EQ(Integer(GLEV_EDGE_FLAG), 0);
}

TEST_F(ListCallbacks, EndlessRecursionEndsAtTheLimit) {
  Compile(1, [&] { glevVertex2f(gl, 0, 0); });
  std::function<void()> again = [&] {
    act_ = again;
    glevCallList(gl, 1);
  };
  OnVertex(again);
  glevBegin(gl, GLEV_POINTS);
  glevCallList(gl, 1);
  glevEnd(gl);
  EXPECT_EQ(vertices_, 64);
}

// ---- Memory

class ListMemory : public Lists {
 protected:
  ListMemory() { Create(); }
  ~ListMemory() override { Destroy(); }

  void Create() {
    glevDestroyContext(gl);
    allocator_ = ledger_.Allocator();
    const glev_context_info info = {sizeof(glev_context_info), &allocator_};
    EXPECT_EQ(glevCreateContext(&info, &gl), GLEV_SUCCESS);
    const glev_sink sink = recording.Sink();
    glevSetSink(gl, &sink);
  }
  void Destroy() {
    glevDestroyContext(gl);
    gl = nullptr;
    EXPECT_TRUE(ledger_.out.empty()) << ledger_.out.size() << " blocks leaked";
  }

  Ledger ledger_;
  glev_allocator allocator_;
};

TEST_F(ListMemory, ComesFromTheAllocatorAndGoesBack) {
  const glev_uint first = glevGenLists(gl, 100);
  for (glev_uint i = 0; i < 100; i += 3) {
    Compile(first + i, [&] {
      for (glev_uint k = 0; k < i * 10; ++k) glevEvalCoord2f(gl, 0, 1);
    });
  }
  EXPECT_GT(ledger_.out.size(), 30u);
  glevDeleteLists(gl, first + 10, 20);
  Compile(first, [] {});
  glevNewList(gl, first + 3, GLEV_COMPILE);
  glevIndexf(gl, 1);
}

TEST_F(ListMemory, ExecutionDoesNotAllocate) {
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  const unsigned char names[] = {2, 2};
  Compile(2, [&] { glevEvalCoord1f(gl, 0.5f); });
  Compile(1, [&] {
    glevPushAttrib(gl, GLEV_ALL_ATTRIB_BITS);
    glevBegin(gl, GLEV_POINTS);
    for (int i = 0; i < 100; ++i) glevEvalCoord1f(gl, 0.5f);
    glevCallLists(gl, 2, GLEV_BYTE, names);
    glevEnd(gl);
    glevPopAttrib(gl);
  });
  glevEvalMesh1(gl, GLEV_POINT, 0, 0);  // makes the plan
  const int before = ledger_.requests;
  recording = {};
  glevCallList(gl, 1);
  EXPECT_EQ(recording.vertices.size(), 102u);
  EXPECT_EQ(ledger_.requests, before);
}

// Refuses the first, second, ... request until everything has enough.
TEST_F(ListMemory, AListThatFindsNoMemoryLeavesTheOldOne) {
  int refused = 0;
  for (;; ++refused) {
    Create();
    Compile(7, [&] { glevIndexf(gl, 7); });
    ledger_.refuse_from = ledger_.requests + refused;
    bool recorded = false;
    glevNewList(gl, 7, GLEV_COMPILE_AND_EXECUTE);
    for (int i = 0; i < 40; ++i) {
      glevEdgeFlag(gl, i % 2 == 0);
      const glev_enum error = glevGetError(gl);
      EXPECT_TRUE(error == GLEV_NO_ERROR || (error == GLEV_OUT_OF_MEMORY && !recorded));
      recorded |= error == GLEV_OUT_OF_MEMORY;
      EXPECT_EQ(Integer(GLEV_EDGE_FLAG), i % 2 == 0) << "executed all the same";
    }
    glevIndexf(gl, 8);
    recorded |= glevGetError(gl) == GLEV_OUT_OF_MEMORY;
    glevEndList(gl);
    EXPECT_EQ(Integer(GLEV_LIST_INDEX), 0);
    ExpectError(recorded ? GLEV_OUT_OF_MEMORY : GLEV_NO_ERROR);
    glevCallList(gl, 7);
    EXPECT_EQ(Index(), recorded ? 7 : 8);
    ledger_.refuse_from = -1;
    Compile(7, [&] { glevIndexf(gl, 9); });
    ExpectError(GLEV_NO_ERROR);
    glevCallList(gl, 7);
    EXPECT_EQ(Index(), 9);
    if (!recorded) break;
  }
  EXPECT_GE(refused, 2) << "the list has to grow";
}

TEST_F(ListMemory, CommandsWithArraysAndNamesFindNoMemory) {
  std::vector<double> points(64 * 64, 0.5);
  const std::vector<int> names(5000, 7);
  const std::pair<const char*, Command> commands[] = {
      {"Map1d", [&](glev_context* c) { glevMap1d(c, GLEV_MAP1_VERTEX_4, 0, 1, 4, 64, points.data()); }},
      {"Map2d",
       [&](glev_context* c) { glevMap2d(c, GLEV_MAP2_INDEX, 0, 1, 64, 64, 0, 1, 1, 64, points.data()); }},
      {"CallLists", [&](glev_context* c) { glevCallLists(c, 5000, GLEV_INT, names.data()); }}};
  for (const auto& [name, command] : commands) {
    SCOPED_TRACE(name);
    Create();
    ledger_.refuse_from = 0;
    glevNewList(gl, 1, GLEV_COMPILE);
    command(gl);
    ExpectError(GLEV_OUT_OF_MEMORY);
    command(gl);
    ExpectError(GLEV_NO_ERROR);
    glevEndList(gl);
    ExpectError(GLEV_OUT_OF_MEMORY);
    EXPECT_EQ(glevIsList(gl, 1), GLEV_FALSE);
    ledger_.refuse_from = -1;
  }
  Create();
  ledger_.refuse_from = 0;
  ExpectRefused(GLEV_OUT_OF_MEMORY, [&] { EXPECT_EQ(glevGenLists(gl, 3), 0u); });
  glevNewList(gl, 1, GLEV_COMPILE);
  ExpectError(GLEV_NO_ERROR);
  glevEndList(gl);
  ExpectError(GLEV_OUT_OF_MEMORY);
  EXPECT_EQ(Integer(GLEV_LIST_INDEX), 0);
  EXPECT_EQ(glevIsList(gl, 1), GLEV_FALSE);
  ledger_.refuse_from = -1;
}

TEST_F(ListMemory, DeleteListsWithoutMemoryDeletesNothing) {
  // fill the table up to the point where it would have to grow
  const glev_uint first = glevGenLists(gl, 1000);
  ledger_.refuse_from = ledger_.requests;
  int deleted = 0;
  for (glev_uint i = 1; i < 1000; i += 2) {
    glevDeleteLists(gl, first + i, 1);
    const glev_enum error = glevGetError(gl);
    if (error == GLEV_NO_ERROR) {
      EXPECT_EQ(glevIsList(gl, first + i), GLEV_FALSE);
      ++deleted;
      continue;
    }
    EXPECT_EQ(error, static_cast<glev_enum>(GLEV_OUT_OF_MEMORY));
    for (glev_uint k = i - 1; k < 1000; ++k) EXPECT_EQ(glevIsList(gl, first + k), GLEV_TRUE);
    break;
  }
  EXPECT_LT(deleted, 500);
  EXPECT_GT(deleted, 1);
  // what lies at the ends of ranges goes without
  ExpectAccepted([&] { glevDeleteLists(gl, first, 1000); });
  for (glev_uint k = 0; k < 1000; ++k) EXPECT_EQ(glevIsList(gl, first + k), GLEV_FALSE);
  ledger_.refuse_from = -1;
}

}  // namespace
}  // namespace glev_tests
