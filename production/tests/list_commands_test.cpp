// Tests every command that display lists can contain, in every form: the list and the direct call have the
// same effects and errors. The conformance suite tests the errors of evaluator commands in lists
// (suites/display_list_errors.cpp).
#include <algorithm>
#include <string_view>

#include "lists_fixture.h"

namespace glev_tests {
namespace {

// Returns the numbers of all array arguments: 0.25, 0.5, 0.75, ...
template <class Real>
const Real* numbers() {
  static const std::vector<Real> kNumbers = [] {
    std::vector<Real> made(200);
    for (std::size_t i = 0; i < made.size(); ++i) made[i] = static_cast<Real>(i + 1) / 4;
    return made;
  }();
  return kNumbers.data();
}

// Returns one call of each function whose command is compiled.
std::vector<Row> compiled_commands() {
  static constexpr glev_enum kUnit = GLEV_TEXTURE0 + 3;
  const float* f = numbers<float>();
  const double* d = numbers<double>();
  static const glev_boolean kNo = GLEV_FALSE;
  static const unsigned char kNames[] = {90, 91};
#define COMMAND(name, ...) Row(#name, [=](glev_context* gl) { glev##name(gl, __VA_ARGS__); })
#define VECTORS(name)                                                \
  Row(#name "fv", [=](glev_context* gl) { glev##name##fv(gl, f); }), \
      Row(#name "dv", [=](glev_context* gl) { glev##name##dv(gl, d); })
#define FORMS(name, ...) COMMAND(name##f, __VA_ARGS__), COMMAND(name##d, __VA_ARGS__), VECTORS(name)
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
          Row("End", [](glev_context* gl) { glevEnd(gl); }),
          FORMS(Vertex2, 1, 2),
          FORMS(Vertex3, 1, 2, 3),
          FORMS(Vertex4, 1, 2, 3, 4),
          FORMS(Color3, 0.5f, 2, 3),
          FORMS(Color4, 0.5f, 2, 3, 4),
          FORMS(Normal3, 0.5f, 2, 3),
          FORMS(Index, 7.5f),
          COMMAND(EdgeFlag, kNo),
          COMMAND(EdgeFlagv, &kNo),
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
          Row("PopAttrib", [](glev_context* gl) { glevPopAttrib(gl); }),
          COMMAND(CallList, 90),
          COMMAND(CallLists, 2, GLEV_UNSIGNED_BYTE, kNames),
          COMMAND(ListBase, 17)};
#undef UNIT_FORMS
#undef FORMS
#undef VECTORS
#undef COMMAND
}

class EveryCommand : public Lists {
 protected:
  // The visible effect of a command.
  struct Effect {
    glev_enum error;
    std::vector<double> state;
    std::vector<double> drawn;
    bool operator==(const Effect&) const = default;
  };

  // Prepares a context in which every command has an effect.
  void prepare() {
    fresh();
    compile(90, [&] { glevColor3f(gl, 9, 0, 0); });
    compile(91, [&] { glevNormal3f(gl, 9, 1, 0); });
    glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 3, numbers<float>() + 2);
    glevMap2f(gl, GLEV_MAP2_VERTEX_3, 0, 1, 3, 3, 0, 1, 9, 2, numbers<float>() + 4);
    glevEnable(gl, GLEV_MAP1_VERTEX_3);
    glevEnable(gl, GLEV_MAP2_VERTEX_3);
    glevPushAttrib(gl, GLEV_ALL_ATTRIB_BITS);
    glevMapGrid2f(gl, 2, 0, 1, 2, 0, 1);
    recording = {};
  }

  Effect observe() {
    Effect effect{glevGetError(gl), query_state(), {}};
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

  // Runs the commands directly, by calling a list, while a list is compiled and executed, and by calling that
  // list.
  void check(const Command& commands) {
    prepare();
    const Effect nothing = observe();
    commands(gl);
    const Effect once = observe();
    EXPECT_NE(once, nothing) << "the test sees nothing of it";
    recording = {};
    commands(gl);
    const Effect twice = observe();

    prepare();
    glevNewList(gl, 1, GLEV_COMPILE);
    commands(gl);
    glevEndList(gl);
    EXPECT_EQ(observe(), nothing) << "executed while compiled";
    glevCallList(gl, 1);
    EXPECT_EQ(observe(), once) << "list";
    recording = {};
    glevCallList(gl, 1);
    EXPECT_EQ(observe(), twice) << "list, again";

    prepare();
    glevNewList(gl, 1, GLEV_COMPILE_AND_EXECUTE);
    commands(gl);
    glevEndList(gl);
    EXPECT_EQ(observe(), once) << "compile and execute";
    recording = {};
    glevCallList(gl, 1);
    EXPECT_EQ(observe(), twice) << "executed, then list";
  }
};

TEST_F(EveryCommand, HasTheEffectOfItsCallWhenTheListIsCalledAndNotBefore) {
  for (const auto& compiled : compiled_commands()) {
    const auto& command = compiled.second;  // clang 14 cannot capture structured bindings
    const std::string_view text = compiled.first;
    SCOPED_TRACE(text);
    if (text == "Begin") {
      check([&](glev_context* context) {
        command(context);
        glevVertex2f(context, 1, 1);
        glevEnd(context);
      });
      continue;
    }
    const bool draws =
        text.starts_with("Vertex") || text.starts_with("EvalCoord") || text.starts_with("EvalPoint");
    if (!draws) check(command);
    // The same between Begin and End, where some commands are errors.
    check([&](glev_context* context) {
      glevBegin(context, GLEV_POINTS);
      command(context);
      glevVertex2f(context, 1, 1);
      if (text != "End") glevEnd(context);
    });
  }
}

TEST_F(EveryCommand, NullPointersAreErrorsOfTheList) {
  const Row commands[] = {
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
    check(command);
    compile(1, [&, &run = command] { run(gl); });
    expect_error(GLEV_NO_ERROR);
    expect_rejected(GLEV_INVALID_VALUE, [&] { glevCallList(gl, 1); });
  }
  compile(1, [&] { glevCallLists(gl, 0, GLEV_INT, nullptr); });
  expect_accepted([&] { glevCallList(gl, 1); });
}

TEST_F(EveryCommand, ErrorsComeWhenTheListIsCalledAndDoNotEndIt) {
  const unsigned char names[] = {90};
  const std::pair<glev_enum, Command> rows[] = {
      {GLEV_INVALID_ENUM, [](glev_context* c) { glevEnable(c, 0); }},
      {GLEV_INVALID_ENUM, [](glev_context* c) { glevDisable(c, 0); }},
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
    check(command);
    prepare();
    compile(1, [&, &run = command] {
      run(gl);
      expect_error(GLEV_NO_ERROR);
      glevIndexf(gl, 5);
    });
    expect_error(GLEV_NO_ERROR);
    glevCallList(gl, 1);
    expect_error(error);
    EXPECT_EQ(current_index(), 5) << "the list goes on";
  }
}

}  // namespace
}  // namespace glev_tests
