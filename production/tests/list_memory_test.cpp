// Tests the memory of display lists: it comes from the allocator, and its exhaustion is handled.
#include <utility>
#include <vector>

#include "ledger.h"
#include "lists_fixture.h"

namespace glev_tests {
namespace {

using ListMemory = WithLedger<Lists>;

TEST_F(ListMemory, ComesFromTheAllocatorAndGoesBack) {
  const glev_uint first = glevGenLists(gl, 100);
  for (glev_uint i = 0; i < 100; i += 3) {
    compile(first + i, [&] {
      for (glev_uint k = 0; k < i * 10; ++k) glevEvalCoord2f(gl, 0, 1);
    });
  }
  const std::size_t before = ledger_.out.size();
  EXPECT_GT(before, 30u);
  glevDeleteLists(gl, first + 10, 20);
  EXPECT_EQ(ledger_.out.size(), before - 6) << "at once: of 12, 15, ..., 27";
  compile(first, [] {});
  glevNewList(gl, first + 3, GLEV_COMPILE);
  glevIndexf(gl, 1);
}

TEST_F(ListMemory, ExecutionDoesNotAllocate) {
  glevEnable(gl, GLEV_MAP1_VERTEX_3);
  const unsigned char names[] = {2, 2};
  compile(2, [&] { glevEvalCoord1f(gl, 0.5f); });
  compile(1, [&] {
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

// Lets the first, second, ... request fail until all requests succeed.
TEST_F(ListMemory, AListThatFindsNoMemoryLeavesTheOldOne) {
  int refused = 0;
  for (;; ++refused) {
    replace_context();
    compile(7, [&] { glevIndexf(gl, 7); });
    ledger_.refuse_from = ledger_.requests + refused;
    bool recorded = false;
    glevNewList(gl, 7, GLEV_COMPILE_AND_EXECUTE);
    for (int i = 0; i < 40; ++i) {
      glevEdgeFlag(gl, i % 2 == 0);
      const glev_enum error = glevGetError(gl);
      EXPECT_TRUE(error == GLEV_NO_ERROR || (error == GLEV_OUT_OF_MEMORY && !recorded));
      recorded |= error == GLEV_OUT_OF_MEMORY;
      EXPECT_EQ(get_integer(GLEV_EDGE_FLAG), i % 2 == 0) << "executed all the same";
    }
    glevIndexf(gl, 8);
    recorded |= glevGetError(gl) == GLEV_OUT_OF_MEMORY;
    glevEndList(gl);
    EXPECT_EQ(get_integer(GLEV_LIST_INDEX), 0);
    expect_error(recorded ? GLEV_OUT_OF_MEMORY : GLEV_NO_ERROR);
    glevCallList(gl, 7);
    EXPECT_EQ(current_index(), recorded ? 7 : 8);
    ledger_.refuse_from = -1;
    compile(7, [&] { glevIndexf(gl, 9); });
    expect_error(GLEV_NO_ERROR);
    glevCallList(gl, 7);
    EXPECT_EQ(current_index(), 9);
    if (!recorded) break;
  }
  EXPECT_GE(refused, 2) << "the list has to grow";
}

TEST_F(ListMemory, CommandsWithArraysAndNamesFindNoMemory) {
  std::vector<double> points(64 * 64, 0.5);
  const std::vector<int> names(5000, 7);
  const Row commands[] = {
      {"Map1d", [&](glev_context* c) { glevMap1d(c, GLEV_MAP1_VERTEX_4, 0, 1, 4, 64, points.data()); }},
      {"Map2d",
       [&](glev_context* c) { glevMap2d(c, GLEV_MAP2_INDEX, 0, 1, 64, 64, 0, 1, 1, 64, points.data()); }},
      {"CallLists", [&](glev_context* c) { glevCallLists(c, 5000, GLEV_INT, names.data()); }}};
  for (const auto& [name, command] : commands) {
    SCOPED_TRACE(name);
    replace_context();
    ledger_.refuse_from = 0;
    glevNewList(gl, 1, GLEV_COMPILE);
    command(gl);
    expect_error(GLEV_OUT_OF_MEMORY);
    command(gl);
    expect_error(GLEV_NO_ERROR);
    glevEndList(gl);
    expect_error(GLEV_OUT_OF_MEMORY);
    EXPECT_EQ(glevIsList(gl, 1), GLEV_FALSE);
    ledger_.refuse_from = -1;
  }
  replace_context();
  ledger_.refuse_from = 0;
  expect_rejected(GLEV_OUT_OF_MEMORY, [&] { EXPECT_EQ(glevGenLists(gl, 3), 0u); });
  glevNewList(gl, 1, GLEV_COMPILE);
  expect_error(GLEV_NO_ERROR);
  glevEndList(gl);
  expect_error(GLEV_OUT_OF_MEMORY);
  EXPECT_EQ(get_integer(GLEV_LIST_INDEX), 0);
  EXPECT_EQ(glevIsList(gl, 1), GLEV_FALSE);
  ledger_.refuse_from = -1;
}

TEST_F(ListMemory, DeleteListsWithoutMemoryDeletesNothing) {
  // Fills the table until it would have to grow.
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
  // Deleting names at the ends of ranges needs no memory.
  expect_accepted([&] { glevDeleteLists(gl, first, 1000); });
  for (glev_uint k = 0; k < 1000; ++k) EXPECT_EQ(glevIsList(gl, first + k), GLEV_FALSE);
  ledger_.refuse_from = -1;
}

}  // namespace
}  // namespace glev_tests
