// Tests display lists: memory, nesting, NewList and EndList, commands that are executed at once, and
// callbacks. The conformance suite tests evaluators in lists (suites/display_list*.cpp).
#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>
#include <utility>

#include "lists_fixture.h"

namespace glev_tests {
namespace {

// ---- Memory of the caller

TEST_F(Lists, VectorsAreReadWhenTheCommandIsGivenAndNoFurtherThanTheyGo) {
  // Memory checkers detect reads beyond the last value.
  auto color = std::make_unique<float[]>(3);
  auto coordinate = std::make_unique<double[]>(1);
  std::iota(color.get(), color.get() + 3, 1.0f);
  coordinate[0] = 2;
  const float points[] = {0, 0, 0, 4, 8, 12};
  glevMap1f(gl, GLEV_MAP1_VERTEX_3, 0, 1, 3, 2, points);
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  compile(1, [&] {
    glevColor3fv(gl, color.get());
    glevEvalCoord1dv(gl, coordinate.get());
  });
  std::fill_n(color.get(), 3, -1.0f);
  coordinate[0] = -1;
  color.reset();
  coordinate.reset();
  const glev_vertex vertex = one_vertex([&] { glevCallList(gl, 1); });
  EXPECT_EQ(values_of(vertex.position), (Floats{8, 16, 24, 1}));
  EXPECT_EQ(values_of(vertex.color), (Floats{1, 2, 3, 1}));
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

TEST_F(Lists, CommandsThatAreNotCompiledAreExecutedAtOnce) {
  for (const glev_enum mode : {GLEV_COMPILE, GLEV_COMPILE_AND_EXECUTE}) {
    fresh();
    compile(40, [] {});
    glevEnable(gl, 0);
    glevNewList(gl, 1, mode);
    EXPECT_EQ(glevGetError(gl), static_cast<glev_enum>(GLEV_INVALID_ENUM));
    EXPECT_NE(glevGetString(gl, GLEV_VERSION), nullptr);
    glevFlush(gl);
    glevFinish(gl);
    EXPECT_EQ(glevIsList(gl, 40), GLEV_TRUE);
    glevDeleteLists(gl, 40, 1);
    EXPECT_EQ(glevIsList(gl, 40), GLEV_FALSE);
    EXPECT_NE(glevGenLists(gl, 1), 0u);
    // Their errors are recorded at once, too.
    double value;
    glevGetMapdv(gl, 0, GLEV_COEFF, &value);
    expect_error(GLEV_INVALID_ENUM);
    glevGenLists(gl, -1);
    expect_error(GLEV_INVALID_VALUE);
    glevEndList(gl);

    compile(40, [] {});
    const glev_uint next = glevGenLists(gl, 1);
    glevCallList(gl, 1);
    expect_error(GLEV_NO_ERROR);
    EXPECT_EQ(glevIsList(gl, 40), GLEV_TRUE) << "DeleteLists was in the list";
    EXPECT_EQ(glevIsList(gl, next + 1), GLEV_FALSE) << "GenLists was in the list";
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
