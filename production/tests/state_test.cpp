// Tests queries, their conversions, and the errors of commands that are not the evaluators'. The conformance
// suite tests the state of evaluators (suites/initial_state.cpp, suites/enables.cpp, suites/get_map.cpp).
#include <climits>
#include <string>

#include "fixture.h"

namespace glev_tests {
namespace {

using States = ContextTest;

// The answers of each form of Get, followed by guard values.
struct Answers {
  std::vector<int> integers;
  std::vector<double> doubles;
  std::vector<float> floats;
  std::vector<int> booleans;
};

Answers get(glev_context* gl, glev_enum name, std::size_t count) {
  int i[6];
  double d[6];
  float f[6];
  glev_boolean b[6];
  std::fill(i, i + 6, -77);
  std::fill(d, d + 6, -77);
  std::fill(f, f + 6, -77);
  std::fill(b, b + 6, 77);
  glevGetIntegerv(gl, name, i);
  glevGetDoublev(gl, name, d);
  glevGetFloatv(gl, name, f);
  glevGetBooleanv(gl, name, b);
  for (std::size_t k = count; k < 6; ++k) {
    EXPECT_TRUE(i[k] == -77 && d[k] == -77 && f[k] == -77 && b[k] == 77) << "written past the end";
  }
  return {{i, i + count}, {d, d + count}, {f, f + count}, {b, b + count}};
}

void expect_answers(glev_context* gl, glev_enum name, const std::vector<double>& values) {
  SCOPED_TRACE(name);
  const Answers got = get(gl, name, values.size());
  EXPECT_EQ(got.doubles, values);
  EXPECT_EQ(got.floats, std::vector<float>(values.begin(), values.end()));
  EXPECT_EQ(got.integers, std::vector<int>(values.begin(), values.end()));
  std::vector<int> booleans;
  for (double value : values) booleans.push_back(value != 0);
  EXPECT_EQ(got.booleans, booleans);
  EXPECT_EQ(glevGetError(gl), static_cast<glev_enum>(GLEV_NO_ERROR));
}

TEST_F(States, InitialLimitsAndCurrentValues) {
  expect_answers(gl, GLEV_MAX_EVAL_ORDER, {64});
  expect_answers(gl, GLEV_MAX_TEXTURE_COORDS, {8});
  expect_answers(gl, GLEV_MAX_TEXTURE_UNITS, {8});
  expect_answers(gl, GLEV_ACTIVE_TEXTURE, {GLEV_TEXTURE0});
  expect_answers(gl, GLEV_LIST_BASE, {0});
  expect_answers(gl, GLEV_LIST_INDEX, {0});
  expect_answers(gl, GLEV_LIST_MODE, {0});
  expect_answers(gl, GLEV_MAX_LIST_NESTING, {64});
  expect_answers(gl, GLEV_ATTRIB_STACK_DEPTH, {0});
  expect_answers(gl, GLEV_MAX_ATTRIB_STACK_DEPTH, {16});
  expect_answers(gl, GLEV_CURRENT_INDEX, {1});
  expect_answers(gl, GLEV_EDGE_FLAG, {1});
  for (glev_enum unit = 0; unit < 8; ++unit) {
    glevActiveTexture(gl, GLEV_TEXTURE0 + unit);
    expect_answers(gl, GLEV_CURRENT_TEXTURE_COORDS, {0, 0, 0, 1});
  }
  EXPECT_EQ(get(gl, GLEV_CURRENT_COLOR, 4).floats, (Floats{1, 1, 1, 1}));
  EXPECT_EQ(get(gl, GLEV_CURRENT_NORMAL, 3).floats, (Floats{0, 0, 1}));
}

TEST_F(States, UnknownCapabilitiesAreRefused) {
  for (glev_enum cap : {0, 0x0D8F, 0x0D99, 0x0DAF, 0x0DB9, 0x0D7F, 0x0D81, 0x8660, GLEV_MAP1_GRID_DOMAIN}) {
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevEnable(gl, cap); });
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevDisable(gl, cap); });
    expect_rejected(GLEV_INVALID_ENUM, [&] { EXPECT_EQ(glevIsEnabled(gl, cap), GLEV_FALSE); });
  }
}

TEST_F(States, TheFirstErrorIsKept) {
  glevBegin(gl, 99);                     // INVALID_ENUM
  glevEnd(gl);                           // INVALID_OPERATION
  glevGetIntegerv(gl, 0x0D30, nullptr);  // INVALID_VALUE
  expect_error(GLEV_INVALID_ENUM);
}

TEST_F(States, GetErrorBetweenBeginAndEndAnswersZeroAndIsItselfAnError) {
  glevBegin(gl, GLEV_POINTS);
  EXPECT_EQ(glevGetError(gl), 0u);
  glevEnd(gl);
  expect_error(GLEV_INVALID_OPERATION);
  // An earlier error is returned first.
  glevEnable(gl, 0);
  glevBegin(gl, GLEV_POINTS);
  EXPECT_EQ(glevGetError(gl), 0u);
  glevEnd(gl);
  expect_error(GLEV_INVALID_ENUM);
}

TEST_F(States, ListsAndTheAttributeStackCanBeQueriedInEveryForm) {
  glevListBase(gl, 123456);
  expect_answers(gl, GLEV_LIST_BASE, {123456});
  glevPushAttrib(gl, 0);
  glevPushAttrib(gl, 0);
  expect_answers(gl, GLEV_ATTRIB_STACK_DEPTH, {2});
  glevNewList(gl, 77, GLEV_COMPILE_AND_EXECUTE);
  expect_answers(gl, GLEV_LIST_INDEX, {77});
  expect_answers(gl, GLEV_LIST_MODE, {GLEV_COMPILE_AND_EXECUTE});
  glevEndList(gl);
  glevNewList(gl, 0xFFFFFFFF, GLEV_COMPILE);
  expect_answers(gl, GLEV_LIST_MODE, {GLEV_COMPILE});
  EXPECT_EQ(get(gl, GLEV_LIST_INDEX, 1).doubles, (std::vector<double>{4294967295.0}));
  EXPECT_EQ(get(gl, GLEV_LIST_INDEX, 1).integers, (std::vector<int>{INT_MAX})) << "the nearest int";
  glevEndList(gl);
  expect_answers(gl, GLEV_LIST_INDEX, {0});
  expect_answers(gl, GLEV_LIST_MODE, {0});
}

TEST_F(States, FlushAndFinishDoNothingButMindBeginAndEnd) {
  const std::vector<double> before = query_state();
  expect_accepted([&] { glevFlush(gl); });
  expect_accepted([&] { glevFinish(gl); });
  EXPECT_EQ(query_state(), before);
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevFlush(gl); });
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevFinish(gl); });
}

TEST_F(States, ColoursAndNormalsBecomeIntegersByTheFullRange) {
  glevColor4f(gl, 1, -1, 0.25f, 0);
  EXPECT_EQ(get(gl, GLEV_CURRENT_COLOR, 4).integers, (std::vector<int>{INT_MAX, -INT_MAX, 536870912, 0}));
  EXPECT_EQ(get(gl, GLEV_CURRENT_COLOR, 4).booleans, (std::vector<int>{1, 1, 1, 0}));
  glevColor4d(gl, 7, -7, kNaN, -0.5);
  EXPECT_EQ(get(gl, GLEV_CURRENT_COLOR, 4).integers, (std::vector<int>{INT_MAX, -INT_MAX, 0, -1073741824}));
  glevNormal3f(gl, -1, 0.5f, 1);
  EXPECT_EQ(get(gl, GLEV_CURRENT_NORMAL, 3).integers, (std::vector<int>{-INT_MAX, 1073741824, INT_MAX}));
}

TEST_F(States, OtherNumbersBecomeIntegersByRounding) {
  glevTexCoord4f(gl, 1.4f, -1.6f, 1e20f, -1e20f);
  EXPECT_EQ(get(gl, GLEV_CURRENT_TEXTURE_COORDS, 4).integers, (std::vector<int>{1, -2, INT_MAX, INT_MIN}));
  EXPECT_EQ(get(gl, GLEV_CURRENT_TEXTURE_COORDS, 4).booleans, (std::vector<int>{1, 1, 1, 1}));
  glevIndexf(gl, 2.51f);
  EXPECT_EQ(get(gl, GLEV_CURRENT_INDEX, 1).integers, (std::vector<int>{3}));
  EXPECT_EQ(get(gl, GLEV_CURRENT_INDEX, 1).floats, (Floats{2.51f}));
}

TEST_F(States, QueriesAreRefusedWithoutWriting) {
  int i = -7;
  double d = -7;
  float f = -7;
  glev_boolean b = 77;
  const std::function<void(glev_enum)> forms[] = {[&](glev_enum name) { glevGetIntegerv(gl, name, &i); },
                                                  [&](glev_enum name) { glevGetDoublev(gl, name, &d); },
                                                  [&](glev_enum name) { glevGetFloatv(gl, name, &f); },
                                                  [&](glev_enum name) { glevGetBooleanv(gl, name, &b); }};
  for (const auto& form : forms) {
    for (const glev_enum name : {0, 0x0D2F, 0x0DCF, 0x0DD4, 0x84C0, 0x0A00, 0x8660})
      expect_rejected(GLEV_INVALID_ENUM, [&] { form(name); });
    for (const glev_enum name :
         {GLEV_CURRENT_COLOR, GLEV_EDGE_FLAG, GLEV_ACTIVE_TEXTURE, GLEV_LIST_BASE, GLEV_LIST_INDEX,
          GLEV_LIST_MODE, GLEV_MAX_LIST_NESTING, GLEV_ATTRIB_STACK_DEPTH, GLEV_MAX_ATTRIB_STACK_DEPTH})
      expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { form(name); });
  }
  EXPECT_TRUE(i == -7 && d == -7 && f == -7 && b == 77);
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevGetIntegerv(gl, GLEV_EDGE_FLAG, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevGetDoublev(gl, GLEV_EDGE_FLAG, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevGetFloatv(gl, GLEV_EDGE_FLAG, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevGetBooleanv(gl, GLEV_EDGE_FLAG, nullptr); });
}

TEST_F(States, Strings) {
  const auto text = [&](glev_enum name) {
    return std::string(reinterpret_cast<const char*>(glevGetString(gl, name)));
  };
  EXPECT_EQ(text(GLEV_VERSION).substr(0, 4), "4.6 ");
  EXPECT_FALSE(text(GLEV_VENDOR).empty());
  EXPECT_NE(text(GLEV_RENDERER).find("glevaluator"), std::string::npos);
  expect_error(GLEV_NO_ERROR);
  for (glev_enum name : {0, 0x1EFF, 0x1F04}) {
    expect_rejected(GLEV_INVALID_ENUM, [&] { EXPECT_EQ(glevGetString(gl, name), nullptr); });
  }
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION,
                               [&] { EXPECT_EQ(glevGetString(gl, GLEV_VERSION), nullptr); });
}

TEST_F(States, UnitsThatDoNotExistAreRefused) {
  const double d[] = {1};
  for (glev_enum texture : {0, GLEV_TEXTURE0 - 1, GLEV_TEXTURE0 + 8, 0x7FFFFFFF}) {
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevMultiTexCoord4f(gl, texture, 9, 9, 9, 9); });
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevMultiTexCoord1dv(gl, texture, d); });
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevActiveTexture(gl, texture); });
  }
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevActiveTexture(gl, GLEV_TEXTURE0 + 1); });
}

}  // namespace
}  // namespace glev_tests
