// Tests the initial state, enables, queries and current values.
#include <climits>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "fixture.h"

namespace glev_tests {
namespace {

class States : public ContextTest {};

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

// ---- Initial state

TEST_F(States, InitiallyEveryMapIsOffConstantAndOverTheUnitInterval) {
  for (const TargetRow& row : target_rows()) {
    for (int dimension : {1, 2}) {
      const glev_enum target = (dimension == 1 ? GLEV_MAP1_COLOR_4 : GLEV_MAP2_COLOR_4) + row.offset;
      EXPECT_EQ(glevIsEnabled(gl, target), GLEV_FALSE);
      std::vector<double> values(5, -77);
      glevGetMapdv(gl, target, GLEV_ORDER, values.data());
      EXPECT_EQ(values, (dimension == 1 ? std::vector<double>{1, -77, -77, -77, -77}
                                        : std::vector<double>{1, 1, -77, -77, -77}));
      values.assign(5, -77);
      glevGetMapdv(gl, target, GLEV_DOMAIN, values.data());
      EXPECT_EQ(values, (dimension == 1 ? std::vector<double>{0, 1, -77, -77, -77}
                                        : std::vector<double>{0, 1, 0, 1, -77}));
      values.assign(row.components + 1, -77);
      glevGetMapdv(gl, target, GLEV_COEFF, values.data());
      std::vector<double> expected = row.initial;
      expected.push_back(-77);
      EXPECT_EQ(values, expected);
    }
  }
  EXPECT_EQ(glevIsEnabled(gl, GLEV_AUTO_NORMAL), GLEV_FALSE);
  expect_error(GLEV_NO_ERROR);
}

TEST_F(States, InitialGridsLimitsAndCurrentValues) {
  expect_answers(gl, GLEV_MAP1_GRID_DOMAIN, {0, 1});
  expect_answers(gl, GLEV_MAP1_GRID_SEGMENTS, {1});
  expect_answers(gl, GLEV_MAP2_GRID_DOMAIN, {0, 1, 0, 1});
  expect_answers(gl, GLEV_MAP2_GRID_SEGMENTS, {1, 1});
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

TEST_F(States, ContextsAreIndependent) {
  const std::vector<double> before = query_state();
  glev_context* other;
  ASSERT_EQ(glevCreateContext(nullptr, &other), GLEV_SUCCESS);
  const float points[] = {1, 2, 3};
  glevMap1f(other, GLEV_MAP1_VERTEX_3, 2, 3, 3, 1, points);
  glevEnable(other, GLEV_MAP1_VERTEX_3);
  glevColor3f(other, 0, 0, 0);
  glevBegin(other, 99);
  EXPECT_EQ(query_state(), before);
  expect_error(GLEV_NO_ERROR);
  EXPECT_EQ(glevGetError(other), static_cast<glev_enum>(GLEV_INVALID_ENUM));
  glevDestroyContext(other);
}

// ---- Enables

TEST_F(States, TheNineteenFlagsAreIndependent) {
  const std::vector<glev_enum> caps = capabilities();
  for (bool rest : {false, true}) {
    for (glev_enum cap : caps) (rest ? glevEnable : glevDisable)(gl, cap);
    for (glev_enum one : caps) {
      (rest ? glevDisable : glevEnable)(gl, one);
      for (glev_enum cap : caps) {
        EXPECT_EQ(glevIsEnabled(gl, cap) == GLEV_TRUE, rest != (cap == one));
        expect_answers(gl, cap, {static_cast<double>(rest != (cap == one))});
      }
      (rest ? glevEnable : glevDisable)(gl, one);
    }
  }
}

TEST_F(States, EnablesDoNotChangeMaps) {
  const float points[] = {1, 2, 3, 4, 5, 6};
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 2, 3, 2, points);
  const std::vector<double> before = query_state();
  for (glev_enum cap : capabilities()) glevEnable(gl, cap);
  EXPECT_NE(query_state(), before);
  for (glev_enum cap : capabilities()) glevDisable(gl, cap);
  EXPECT_EQ(query_state(), before);
}

TEST_F(States, UnknownCapabilitiesAreRefused) {
  for (glev_enum cap : {0, 0x0D8F, 0x0D99, 0x0DAF, 0x0DB9, 0x0D7F, 0x0D81, 0x8660, GLEV_MAP1_GRID_DOMAIN}) {
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevEnable(gl, cap); });
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevDisable(gl, cap); });
    expect_rejected(GLEV_INVALID_ENUM, [&] { EXPECT_EQ(glevIsEnabled(gl, cap), GLEV_FALSE); });
  }
}

TEST_F(States, NoEnablesBetweenBeginAndEnd) {
  for (glev_enum cap : capabilities()) {
    expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevEnable(gl, cap); });
    glevEnable(gl, cap);
    expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevDisable(gl, cap); });
    expect_rejected_in_primitive(GLEV_INVALID_OPERATION,
                                 [&] { EXPECT_EQ(glevIsEnabled(gl, cap), GLEV_FALSE); });
  }
}

TEST_F(States, EnablesIgnoreTheActiveTexture) {
  glevActiveTexture(gl, GLEV_TEXTURE0 + 1);
  expect_accepted([&] { glevEnable(gl, GLEV_MAP1_TEXTURE_COORD_2); });
  glevActiveTexture(gl, GLEV_TEXTURE0);
  EXPECT_EQ(glevIsEnabled(gl, GLEV_MAP1_TEXTURE_COORD_2), GLEV_TRUE);
}

// ---- Errors

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

// ---- Flush and Finish

TEST_F(States, FlushAndFinishDoNothingButMindBeginAndEnd) {
  const std::vector<double> before = query_state();
  expect_accepted([&] { glevFlush(gl); });
  expect_accepted([&] { glevFinish(gl); });
  EXPECT_EQ(query_state(), before);
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevFlush(gl); });
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevFinish(gl); });
}

// ---- Queries

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
  for (glev_enum name : {0, 0x0D2F, 0x0DCF, 0x0DD4, 0x84C0, 0x0A00, 0x8660}) {
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevGetIntegerv(gl, name, &i); });
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevGetDoublev(gl, name, &d); });
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevGetFloatv(gl, name, &f); });
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevGetBooleanv(gl, name, &b); });
  }
  std::vector<glev_enum> names = capabilities();
  names.insert(names.end(),
               {GLEV_MAX_EVAL_ORDER, GLEV_MAP1_GRID_DOMAIN, GLEV_MAP1_GRID_SEGMENTS, GLEV_MAP2_GRID_DOMAIN,
                GLEV_MAP2_GRID_SEGMENTS, GLEV_CURRENT_COLOR, GLEV_EDGE_FLAG, GLEV_ACTIVE_TEXTURE,
                GLEV_LIST_BASE, GLEV_LIST_INDEX, GLEV_LIST_MODE, GLEV_MAX_LIST_NESTING,
                GLEV_ATTRIB_STACK_DEPTH, GLEV_MAX_ATTRIB_STACK_DEPTH});
  for (glev_enum name : names) {
    expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevGetIntegerv(gl, name, &i); });
    expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevGetDoublev(gl, name, &d); });
    expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevGetFloatv(gl, name, &f); });
    expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevGetBooleanv(gl, name, &b); });
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

// ---- Current values

TEST_F(States, ColorForms) {
  const float f[] = {0.1f, 2, -3, 0.5f};
  const double d[] = {0.1, 2, -3, 0.5};
  const Floats three = {0.1f, 2, -3, 1}, four = {0.1f, 2, -3, 0.5f};
  const std::pair<std::function<void()>, Floats> forms[] = {
      {[&] { glevColor3f(gl, f[0], f[1], f[2]); }, three},
      {[&] { glevColor3d(gl, d[0], d[1], d[2]); }, three},
      {[&] { glevColor3fv(gl, f); }, three},
      {[&] { glevColor3dv(gl, d); }, three},
      {[&] { glevColor4f(gl, f[0], f[1], f[2], f[3]); }, four},
      {[&] { glevColor4d(gl, d[0], d[1], d[2], d[3]); }, four},
      {[&] { glevColor4fv(gl, f); }, four},
      {[&] { glevColor4dv(gl, d); }, four}};
  for (const auto& [form, expected] : forms) {
    glevColor4f(gl, 9, 9, 9, 9);
    expect_accepted(form);
    EXPECT_EQ(get(gl, GLEV_CURRENT_COLOR, 4).floats, expected);
  }
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevColor3fv(gl, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevColor3dv(gl, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevColor4fv(gl, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevColor4dv(gl, nullptr); });
}

TEST_F(States, NormalIndexAndEdgeFlagForms) {
  const float f[] = {0.1f, 2, -3};
  const double d[] = {0.1, 2, -3};
  for (const std::function<void()>& form :
       {std::function<void()>([&] { glevNormal3f(gl, f[0], f[1], f[2]); }),
        {[&] { glevNormal3d(gl, d[0], d[1], d[2]); }},
        {[&] { glevNormal3fv(gl, f); }},
        {[&] { glevNormal3dv(gl, d); }}}) {
    glevNormal3f(gl, 9, 9, 9);
    expect_accepted(form);
    EXPECT_EQ(get(gl, GLEV_CURRENT_NORMAL, 3).floats, (Floats{0.1f, 2, -3}));
  }
  for (const std::function<void()>& form : {std::function<void()>([&] { glevIndexf(gl, f[0]); }),
                                            {[&] { glevIndexd(gl, d[0]); }},
                                            {[&] { glevIndexfv(gl, f); }},
                                            {[&] { glevIndexdv(gl, d); }}}) {
    glevIndexf(gl, 9);
    expect_accepted(form);
    EXPECT_EQ(get(gl, GLEV_CURRENT_INDEX, 1).floats, (Floats{0.1f}));
  }
  for (glev_boolean flag : {0, 1, 2, 255, 0}) {
    glevEdgeFlag(gl, flag);
    expect_answers(gl, GLEV_EDGE_FLAG, {flag != 0 ? 1.0 : 0.0});
    glevEdgeFlag(gl, !flag);
    glevEdgeFlagv(gl, &flag);
    expect_answers(gl, GLEV_EDGE_FLAG, {flag != 0 ? 1.0 : 0.0});
  }
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevNormal3fv(gl, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevNormal3dv(gl, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevIndexfv(gl, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevIndexdv(gl, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevEdgeFlagv(gl, nullptr); });
}

class TexCoordForms : public ContextTest {
 protected:
  Floats texture_unit(glev_enum unit) {
    glevActiveTexture(gl, GLEV_TEXTURE0 + unit);
    Floats values = get(gl, GLEV_CURRENT_TEXTURE_COORDS, 4).floats;
    glevActiveTexture(gl, GLEV_TEXTURE0);
    return values;
  }

  const float f[4] = {0.1f, 2, -3, 0.5f};
  const double d[4] = {0.1, 2, -3, 0.5};
  const Floats expected[4] = {{0.1f, 0, 0, 1}, {0.1f, 2, 0, 1}, {0.1f, 2, -3, 1}, {0.1f, 2, -3, 0.5f}};
};

TEST_F(TexCoordForms, SetUnitZeroWhateverIsActive) {
  const std::array<std::array<std::function<void()>, 4>, 4> forms = {{
      {[&] { glevTexCoord1f(gl, f[0]); }, [&] { glevTexCoord1d(gl, d[0]); }, [&] { glevTexCoord1fv(gl, f); },
       [&] { glevTexCoord1dv(gl, d); }},
      {[&] { glevTexCoord2f(gl, f[0], f[1]); }, [&] { glevTexCoord2d(gl, d[0], d[1]); },
       [&] { glevTexCoord2fv(gl, f); }, [&] { glevTexCoord2dv(gl, d); }},
      {[&] { glevTexCoord3f(gl, f[0], f[1], f[2]); }, [&] { glevTexCoord3d(gl, d[0], d[1], d[2]); },
       [&] { glevTexCoord3fv(gl, f); }, [&] { glevTexCoord3dv(gl, d); }},
      {[&] { glevTexCoord4f(gl, f[0], f[1], f[2], f[3]); },
       [&] { glevTexCoord4d(gl, d[0], d[1], d[2], d[3]); }, [&] { glevTexCoord4fv(gl, f); },
       [&] { glevTexCoord4dv(gl, d); }},
  }};
  for (std::size_t n = 0; n < 4; ++n) {
    for (const auto& form : forms[n]) {
      glevTexCoord4f(gl, 9, 9, 9, 9);
      glevActiveTexture(gl, GLEV_TEXTURE0 + 2);
      expect_accepted(form);
      EXPECT_EQ(texture_unit(0), expected[n]);
      EXPECT_EQ(texture_unit(2), (Floats{0, 0, 0, 1}));
    }
  }
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevTexCoord1fv(gl, nullptr); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevTexCoord4dv(gl, nullptr); });
}

TEST_F(TexCoordForms, MultiSetsTheUnitThatIsNamed) {
  for (glev_enum unit = 0; unit < 8; ++unit) {
    const glev_enum t = GLEV_TEXTURE0 + unit;
    const std::array<std::array<std::function<void()>, 4>, 4> forms = {{
        {[&] { glevMultiTexCoord1f(gl, t, f[0]); }, [&] { glevMultiTexCoord1d(gl, t, d[0]); },
         [&] { glevMultiTexCoord1fv(gl, t, f); }, [&] { glevMultiTexCoord1dv(gl, t, d); }},
        {[&] { glevMultiTexCoord2f(gl, t, f[0], f[1]); }, [&] { glevMultiTexCoord2d(gl, t, d[0], d[1]); },
         [&] { glevMultiTexCoord2fv(gl, t, f); }, [&] { glevMultiTexCoord2dv(gl, t, d); }},
        {[&] { glevMultiTexCoord3f(gl, t, f[0], f[1], f[2]); },
         [&] { glevMultiTexCoord3d(gl, t, d[0], d[1], d[2]); }, [&] { glevMultiTexCoord3fv(gl, t, f); },
         [&] { glevMultiTexCoord3dv(gl, t, d); }},
        {[&] { glevMultiTexCoord4f(gl, t, f[0], f[1], f[2], f[3]); },
         [&] { glevMultiTexCoord4d(gl, t, d[0], d[1], d[2], d[3]); }, [&] { glevMultiTexCoord4fv(gl, t, f); },
         [&] { glevMultiTexCoord4dv(gl, t, d); }},
    }};
    for (std::size_t n = 0; n < 4; ++n) {
      for (const auto& form : forms[n]) {
        for (glev_enum other = 0; other < 8; ++other)
          glevMultiTexCoord4f(gl, GLEV_TEXTURE0 + other, 9, 9, 9, 9);
        expect_accepted(form);
        for (glev_enum other = 0; other < 8; ++other) {
          EXPECT_EQ(texture_unit(other), other == unit ? expected[n] : (Floats{9, 9, 9, 9}));
        }
      }
    }
  }
}

TEST_F(TexCoordForms, UnitsThatDoNotExistAreRefused) {
  for (glev_enum texture : {0, GLEV_TEXTURE0 - 1, GLEV_TEXTURE0 + 8, 0x7FFFFFFF}) {
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevMultiTexCoord4f(gl, texture, 9, 9, 9, 9); });
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevMultiTexCoord1dv(gl, texture, d); });
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevActiveTexture(gl, texture); });
  }
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevMultiTexCoord2fv(gl, GLEV_TEXTURE0, nullptr); });
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevActiveTexture(gl, GLEV_TEXTURE0 + 1); });
}

}  // namespace
}  // namespace glev_tests
