// Tests display lists: compilation, execution, and the commands that are executed at once.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numeric>
#include <utility>

#include "lists_fixture.h"

namespace glev_tests {
namespace {

TEST_F(Lists, StateIsJudgedWhenTheListIsCalled) {
  const float point[] = {1, 2, 3};
  const auto map = [&] { glevMap1f(gl, GLEV_MAP1_VERTEX_3, 5, 6, 3, 1, point); };
  glevActiveTexture(gl, GLEV_TEXTURE0 + 1);
  compile(1, map);
  glevActiveTexture(gl, GLEV_TEXTURE0);
  expect_accepted([&] { glevCallList(gl, 1); });
  compile(2, map);
  glevActiveTexture(gl, GLEV_TEXTURE0 + 1);
  expect_rejected(GLEV_INVALID_OPERATION, [&] { glevCallList(gl, 2); });
  glevActiveTexture(gl, GLEV_TEXTURE0);
  compile(3, [&] {
    glevActiveTexture(gl, GLEV_TEXTURE0 + 1);
    map();
  });
  glevCallList(gl, 3);
  expect_error(GLEV_INVALID_OPERATION);
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
    compile(1, [&] {
      glevEvalCoord1f(gl, 0);
      forbidden();
      glevEvalPoint1(gl, 1);
    });
    const std::vector<double> before = query_state();
    recording = {};
    glevBegin(gl, GLEV_POINTS);
    glevCallList(gl, 1);
    glevEnd(gl);
    expect_error(GLEV_INVALID_OPERATION);
    EXPECT_EQ(query_state(), before);
    EXPECT_EQ(recording.vertices.size(), 2u);
    EXPECT_EQ(recording.begun, std::vector<glev_enum>{GLEV_POINTS});
  }
}

// ---- Memory of the caller

TEST_F(Lists, PointsAreReadWhenTheCommandIsGivenAndNoFurtherThanTheyGo) {
  // The arrays end with the last value of the last point, so that memory checkers detect reads beyond it.
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
  compile(1, [&] { glevNormal3f(gl, 1, 0, 0); });
  compile(2, [&] { glevIndexf(gl, 2); });
  compile(3, [&] {
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
  expect_error(GLEV_NO_ERROR);
  std::vector<double> got(12);
  glevGetMapdv(gl, GLEV_MAP1_VERTEX_3, GLEV_COEFF, got.data());
  EXPECT_EQ(got, (std::vector<double>{1, 2, 3, 8, 9, 10, 15, 16, 17, 22, 23, 24}));
  got.resize(18);
  glevGetMapdv(gl, GLEV_MAP2_VERTEX_3, GLEV_COEFF, got.data());
  EXPECT_EQ(got, (std::vector<double>{1, 2, 3, 5, 6, 7, 9, 10, 11, 12, 13, 14, 16, 17, 18, 20, 21, 22}));
  EXPECT_EQ(current_index(), 2);
  ASSERT_EQ(recording.vertices.size(), 1u);
  EXPECT_EQ(values_of(recording.vertices[0].position), (Floats{22, 23, 24, 1}));
  EXPECT_EQ(values_of(recording.vertices[0].color), (Floats{1, 2, 3, 1}));
}

TEST_F(Lists, DoublesStayDoubles) {
  const double given[] = {0.1, 1.0 / 3.0, 1e300, -0x1p-1074};
  compile(1, [&] {
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
  compile(2, [&] { glevEvalCoord1d(gl, 1.0 / 3.0); });
  const float immediate = one_vertex([&] { glevEvalCoord1d(gl, 1.0 / 3.0); }).position[0];
  EXPECT_EQ(one_vertex([&] { glevCallList(gl, 2); }).position[0], immediate);
}

// ---- Execution

TEST_F(Lists, EvaluationUsesTheStateOfTheCall) {
  const float first[] = {0, 0, 0, 1, 0, 0}, second[] = {0, 0, 0, 8, 0, 0};
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, first);
  compile(1, [&] {
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

  // Maps that a called list defines are used in the rest of the calling list.
  compile(2, [&] { glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, first); });
  compile(3, [&] {
    glevEvalMesh1(gl, GLEV_POINT, 4, 4);
    glevCallList(gl, 2);
    glevEvalMesh1(gl, GLEV_POINT, 4, 4);
  });
  recording = {};
  glevCallList(gl, 3);
  EXPECT_EQ(recording.vertices.at(0).position[0], 8);
  EXPECT_EQ(recording.vertices.at(1).position[0], 1);
  expect_error(GLEV_NO_ERROR);
}

TEST_F(Lists, CurrentValuesAreUntouchedByCompiledEvaluation) {
  const float s = 3;
  glevMap1f(gl, GLEV_MAP1_TEXTURE_COORD_1, 0, 1, 1, 1, &s);
  glevEnable(gl, GLEV_MAP1_TEXTURE_COORD_1);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  compile(1, [&] {
    glevTexCoord4f(gl, 5, 6, 7, 8);
    glevEvalCoord1f(gl, 0.5f);
    glevVertex2f(gl, 0, 0);
  });
  glevBegin(gl, GLEV_POINTS);
  glevCallList(gl, 1);
  glevEnd(gl);
  ASSERT_EQ(recording.vertices.size(), 2u);
  EXPECT_EQ(values_of(recording.vertices[0].texcoord[0]), (Floats{3, 0, 0, 1}));
  EXPECT_EQ(values_of(recording.vertices[1].texcoord[0]), (Floats{5, 6, 7, 8}));
}

TEST_F(Lists, APrimitiveMayBeSpreadOverLists) {
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  compile(1, [&] { glevBegin(gl, GLEV_LINE_STRIP); });
  compile(2, [&] { glevEvalCoord1f(gl, 0); });
  compile(3, [&] { glevEnd(gl); });
  expect_error(GLEV_NO_ERROR);
  glevCallList(gl, 1);
  glevCallList(gl, 2);
  glevEvalCoord1f(gl, 1);
  glevCallList(gl, 2);
  glevEnd(gl);
  glevBegin(gl, GLEV_POINTS);
  glevCallList(gl, 2);
  glevCallList(gl, 3);
  expect_error(GLEV_NO_ERROR);
  EXPECT_EQ(recording.begun, (std::vector<glev_enum>{GLEV_LINE_STRIP, GLEV_POINTS}));
  EXPECT_EQ(recording.vertices.size(), 4u);
  EXPECT_EQ(recording.ended, 2);
}

TEST_F(Lists, NamesWithoutAListAreIgnored) {
  expect_accepted([&] { glevCallList(gl, 0); });
  expect_accepted([&] { glevCallList(gl, 77); });
  const int names[] = {0, 77, -1};
  expect_accepted([&] { glevCallLists(gl, 3, GLEV_INT, names); });
}

TEST_F(Lists, NestSixtyFourDeepAndIgnoreWhatIsDeeper) {
  for (glev_uint name = 1; name <= 70; ++name) {
    compile(name, [&] {
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
    EXPECT_EQ(current_index(), 64);
  }
  expect_error(GLEV_NO_ERROR);
}

TEST_F(Lists, AListMayCallItself) {
  compile(5, [&] { glevIndexf(gl, 1); });
  compile(
      5,
      [&] {
        glevBegin(gl, GLEV_POINTS);
        glevVertex2f(gl, 0, 0);
        glevEnd(gl);
        glevCallList(gl, 5);
      },
      GLEV_COMPILE_AND_EXECUTE);
  EXPECT_EQ(recording.vertices.size(), 1u);
  EXPECT_EQ(current_index(), 1) << "the name stood for the old list until EndList";
  recording = {};
  glevCallList(gl, 5);
  EXPECT_EQ(recording.vertices.size(), 64u);
  expect_error(GLEV_NO_ERROR);
}

TEST_F(Lists, ALaterDefinitionIsWhatACompiledCallFinds) {
  compile(1, [&] { glevCallList(gl, 2); });
  glevCallList(gl, 1);
  EXPECT_EQ(current_index(), 1);
  compile(2, [&] { glevIndexf(gl, 22); });
  glevCallList(gl, 1);
  EXPECT_EQ(current_index(), 22);
  glevDeleteLists(gl, 2, 1);
  glevIndexf(gl, 0);
  glevCallList(gl, 1);
  EXPECT_EQ(current_index(), 0);
}

TEST_F(Lists, WhatACalledListDoesIsNotCompiledAgain) {
  compile(1, [&] { glevIndexf(gl, 5); });
  compile(
      2, [&] { glevCallList(gl, 1); }, GLEV_COMPILE_AND_EXECUTE);
  EXPECT_EQ(current_index(), 5);
  compile(1, [&] {});
  glevIndexf(gl, 0);
  glevCallList(gl, 2);
  EXPECT_EQ(current_index(), 0);
}

// ---- NewList and EndList

TEST_F(Lists, NewListAndEndListAreRefused) {
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevNewList(gl, 0, GLEV_COMPILE); });
  for (const glev_enum mode : {0, 0x12FF, 0x1302}) {
    expect_rejected(GLEV_INVALID_ENUM, [&] { glevNewList(gl, 1, mode); });
  }
  expect_rejected(GLEV_INVALID_OPERATION, [&] { glevEndList(gl); });
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevNewList(gl, 1, GLEV_COMPILE); });
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevEndList(gl); });
  EXPECT_EQ(glevIsList(gl, 1), GLEV_FALSE);
  glevNewList(gl, 1, GLEV_COMPILE);
  glevIndexf(gl, 5);
  glevNewList(gl, 2, GLEV_COMPILE_AND_EXECUTE);
  expect_error(GLEV_INVALID_OPERATION);
  EXPECT_EQ(get_integer(GLEV_LIST_INDEX), 1);
  EXPECT_EQ(get_integer(GLEV_LIST_MODE), GLEV_COMPILE);
  glevEdgeFlag(gl, GLEV_FALSE);
  glevEndList(gl);
  EXPECT_EQ(glevIsList(gl, 2), GLEV_FALSE);
  expect_accepted([&] { glevCallList(gl, 1); });
  EXPECT_EQ(current_index(), 5);
  EXPECT_EQ(get_integer(GLEV_EDGE_FLAG), 0) << "the list went on";
}

TEST_F(Lists, EndListBetweenAnExecutedBeginAndItsEndLeavesTheListOpen) {
  glevNewList(gl, 1, GLEV_COMPILE_AND_EXECUTE);
  glevBegin(gl, GLEV_POINTS);
  glevEndList(gl);
  glevEnd(gl);
  EXPECT_EQ(get_integer(GLEV_LIST_INDEX), 1);
  expect_error(GLEV_INVALID_OPERATION);
  glevEndList(gl);
  expect_error(GLEV_NO_ERROR);
  recording = {};
  glevCallList(gl, 1);
  EXPECT_EQ(recording.begun.size(), 1u);
  EXPECT_EQ(recording.ended, 1);
}

TEST_F(Lists, TheOldListStandsUntilEndList) {
  compile(1, [&] { glevIndexf(gl, 5); });
  glevNewList(gl, 1, GLEV_COMPILE_AND_EXECUTE);
  EXPECT_EQ(glevIsList(gl, 1), GLEV_TRUE);
  glevCallList(gl, 1);
  EXPECT_EQ(current_index(), 5);
  glevDeleteLists(gl, 1, 1);
  EXPECT_EQ(glevIsList(gl, 1), GLEV_FALSE);
  glevIndexf(gl, 6);
  EXPECT_EQ(glevIsList(gl, 1), GLEV_FALSE);
  glevEndList(gl);
  EXPECT_EQ(glevIsList(gl, 1), GLEV_TRUE);
  glevIndexf(gl, 0);
  compile(2, [&] { glevCallList(gl, 1); });
  glevCallList(gl, 2);
  EXPECT_EQ(current_index(), 6);
  compile(1, [&] {});
  glevIndexf(gl, 0);
  glevCallList(gl, 1);
  EXPECT_EQ(current_index(), 0) << "an empty list";
  EXPECT_EQ(glevIsList(gl, 1), GLEV_TRUE);
}

TEST_F(Lists, QueriesAndListsOfNamesAreExecutedAtOnce) {
  const float points[] = {1, 2, 3};
  const std::vector<double> state = query_state();
  compile(40, [] {});
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
    // Their errors are recorded at once, too.
    glevGetMapdv(gl, 0, GLEV_COEFF, d);
    expect_error(GLEV_INVALID_ENUM);
    glevGenLists(gl, -1);
    expect_error(GLEV_INVALID_VALUE);
    glevEndList(gl);
    EXPECT_EQ(query_state(), state);

    compile(40, [] {});
    const glev_uint next = glevGenLists(gl, 1);
    if (mode == GLEV_COMPILE_AND_EXECUTE) {
      EXPECT_EQ(query_state(), state);
    }
    glevCallList(gl, 1);
    expect_error(GLEV_NO_ERROR);
    EXPECT_EQ(glevIsList(gl, 40), GLEV_TRUE) << "DeleteLists was in the list";
    EXPECT_EQ(glevIsList(gl, next + 1), GLEV_FALSE) << "GenLists was in the list";
    fresh();
    compile(40, [] {});
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
  fresh();  // memory checkers detect leaks
  EXPECT_EQ(get_integer(GLEV_LIST_INDEX), 0);
}

// ---- Callbacks of the sink

class ListCallbacks : public Lists {
 protected:
  // Calls `act` in the first vertex callback.
  void on_vertex(std::function<void()> act) {
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
  compile(2, [&] {
    glevIndexf(gl, 5);
    glevEnable(gl, GLEV_MAP1_VERTEX_3);
    glevVertex2f(gl, 0, 0);
  });
  const unsigned char two[] = {2};
  on_vertex([&] { glevCallLists(gl, 1, GLEV_UNSIGNED_BYTE, two); });
  glevBegin(gl, GLEV_POINTS);
  glevVertex2f(gl, 0, 0);
  glevEnd(gl);
  EXPECT_EQ(vertices_, 2);
  EXPECT_EQ(current_index(), 5);
  expect_error(GLEV_INVALID_OPERATION);

  // The same in a mesh, whose primitive End must not end.
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  compile(3, [&] { glevEnd(gl); });
  on_vertex([&] { glevCallList(gl, 3); });
  glevEvalMesh1(gl, GLEV_POINT, 0, 3);
  EXPECT_EQ(vertices_, 4);
  expect_error(GLEV_INVALID_OPERATION);
}

TEST_F(ListCallbacks, CannotChangeListsWhileOneIsExecuting) {
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  // After End, the callback is not between Begin and End.
  for (const bool end : {false, true}) {
    for (const std::function<void()>& change : std::initializer_list<std::function<void()>>{
             [&] { glevDeleteLists(gl, 1, 1); }, [&] { glevNewList(gl, 1, GLEV_COMPILE); },
             [&] { glevEndList(gl); }, [&] { EXPECT_EQ(glevGenLists(gl, 1), 0u); }}) {
      compile(1, [&] {
        glevBegin(gl, GLEV_POINTS);
        glevVertex2f(gl, 0, 0);
        for (int i = 0; i < 50; ++i) glevIndexf(gl, static_cast<float>(i));
      });
      on_vertex([&] {
        if (end) glevEnd(gl);
        change();
      });
      glevCallList(gl, 1);
      if (!end) glevEnd(gl);
      expect_error(GLEV_INVALID_OPERATION);
      EXPECT_EQ(current_index(), 49);
      EXPECT_EQ(glevIsList(gl, 1), GLEV_TRUE);
      EXPECT_EQ(glevIsList(gl, 2), GLEV_FALSE);
      EXPECT_EQ(get_integer(GLEV_LIST_INDEX), 0);
    }
  }
  compile(1, [&] { glevEvalMesh1(gl, GLEV_POINT, 0, 1); });
  on_vertex([&] { glevDeleteLists(gl, 1, 1); });
  glevCallList(gl, 1);
  EXPECT_EQ(vertices_, 2);
  expect_error(GLEV_INVALID_OPERATION);
  EXPECT_EQ(glevIsList(gl, 1), GLEV_TRUE);
  // Afterwards, the commands are accepted.
  expect_accepted([&] { glevDeleteLists(gl, 1, 1); });
  EXPECT_EQ(glevIsList(gl, 1), GLEV_FALSE);
}

TEST_F(ListCallbacks, WhatTheyIssueIsExecutedOnceAndNotCompiled) {
  on_vertex([&] { glevIndexf(gl, 5); });
  compile(
      1,
      [&] {
        glevBegin(gl, GLEV_POINTS);
        glevVertex2f(gl, 0, 0);
        glevEnd(gl);
        glevEdgeFlag(gl, GLEV_FALSE);
      },
      GLEV_COMPILE_AND_EXECUTE);
  EXPECT_EQ(current_index(), 5);
  glevIndexf(gl, 0);
  glevEdgeFlag(gl, GLEV_TRUE);
  glevCallList(gl, 1);  // the callback has no effect any more
  EXPECT_EQ(current_index(), 0);
  EXPECT_EQ(get_integer(GLEV_EDGE_FLAG), 0);
}

TEST_F(ListCallbacks, EndlessRecursionEndsAtTheLimit) {
  compile(1, [&] { glevVertex2f(gl, 0, 0); });
  std::function<void()> again = [&] {
    act_ = again;
    glevCallList(gl, 1);
  };
  on_vertex(again);
  glevBegin(gl, GLEV_POINTS);
  glevCallList(gl, 1);
  glevEnd(gl);
  EXPECT_EQ(vertices_, 64);
}

}  // namespace
}  // namespace glev_tests
