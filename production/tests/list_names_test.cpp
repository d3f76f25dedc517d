// Tests the names of display lists: GenLists, IsList, DeleteLists, and the list of a name.
#include <map>
#include <random>

#include "fixture.h"

namespace glev_tests {
namespace {

class ListNames : public ContextTest {
 protected:
  void define(glev_uint name, float index) {
    glevNewList(gl, name, GLEV_COMPILE);
    glevIndexf(gl, index);
    glevEndList(gl);
  }

  // Returns the colour index that the list sets; -1 if none.
  float index_of(glev_uint name) {
    glevIndexf(gl, -1);
    glevCallList(gl, name);
    float index;
    glevGetFloatv(gl, GLEV_CURRENT_INDEX, &index);
    return index;
  }

  bool is_list(glev_uint name) { return glevIsList(gl, name) == GLEV_TRUE; }
};

constexpr glev_uint kLast = 0xFFFFFFFF;

TEST_F(ListNames, GenListsMakesEmptyListsWithSuccessiveNames) {
  const glev_uint first = glevGenLists(gl, 5);
  EXPECT_NE(first, 0u);
  for (glev_uint i = 0; i < 5; ++i) EXPECT_TRUE(is_list(first + i));
  EXPECT_FALSE(is_list(first - 1));
  EXPECT_FALSE(is_list(first + 5));
  EXPECT_FALSE(is_list(0));
  EXPECT_EQ(index_of(first), -1);
  const glev_uint second = glevGenLists(gl, 3);
  EXPECT_TRUE(second > first + 4 || second + 2 < first);
  EXPECT_EQ(glevGenLists(gl, 0), 0u);
  expect_error(GLEV_NO_ERROR);
}

TEST_F(ListNames, GenListsGoesRoundNamesInUse) {
  define(2, 2);
  define(5, 5);
  define(kLast, 9);
  const glev_uint one = glevGenLists(gl, 1), two = glevGenLists(gl, 2), many = glevGenLists(gl, 1000);
  EXPECT_EQ(one, 1u);
  EXPECT_EQ(two, 3u);
  EXPECT_EQ(many, 6u);
  EXPECT_EQ(index_of(2), 2);
  EXPECT_EQ(index_of(5), 5);
  EXPECT_EQ(index_of(kLast), 9);
  expect_error(GLEV_NO_ERROR);
}

TEST_F(ListNames, AllNamesCanBeUsedAndThenThereAreNone) {
  const glev_uint a = glevGenLists(gl, 0x7FFFFFFF), b = glevGenLists(gl, 0x7FFFFFFF);
  EXPECT_NE(a, 0u);
  EXPECT_NE(b, 0u);
  EXPECT_EQ(glevGenLists(gl, 2), 0u);
  EXPECT_EQ(glevGenLists(gl, 1), kLast);
  EXPECT_EQ(glevGenLists(gl, 1), 0u);
  expect_error(GLEV_NO_ERROR);
  define(kLast, 3);
  define(1, 4);
  EXPECT_EQ(index_of(kLast), 3);
  EXPECT_EQ(index_of(1), 4);
  glevDeleteLists(gl, 0x10000, 7);
  EXPECT_EQ(glevGenLists(gl, 8), 0u);
  EXPECT_EQ(glevGenLists(gl, 7), 0x10000u);
  glevDeleteLists(gl, 0x80000000, 0x7FFFFFFF);
  EXPECT_TRUE(is_list(0x7FFFFFFF));
  EXPECT_FALSE(is_list(0x80000000));
  EXPECT_FALSE(is_list(kLast - 1));
  EXPECT_TRUE(is_list(kLast));
  glevDeleteLists(gl, kLast, 0x7FFFFFFF);
  EXPECT_FALSE(is_list(kLast)) << "a range that goes past the last name";
  glevDeleteLists(gl, 0, 3);
  EXPECT_FALSE(is_list(1));
  EXPECT_FALSE(is_list(2));
  EXPECT_TRUE(is_list(3));
  expect_error(GLEV_NO_ERROR);
}

TEST_F(ListNames, TheNameOfTheOpenListIsNotGivenAway) {
  for (const glev_uint open : {1u, 2u, 3u}) {
    glevNewList(gl, open, GLEV_COMPILE);
    const glev_uint first = glevGenLists(gl, 2);
    EXPECT_TRUE(first > open || first + 1 < open) << first;
    EXPECT_FALSE(is_list(open));
    glevEndList(gl);
    EXPECT_TRUE(is_list(open));
    glevDeleteLists(gl, 0, 100);
  }
}

TEST_F(ListNames, NegativeRangesAreRefused) {
  define(1, 1);
  expect_rejected(GLEV_INVALID_VALUE, [&] { EXPECT_EQ(glevGenLists(gl, -1), 0u); });
  expect_rejected(GLEV_INVALID_VALUE, [&] { glevDeleteLists(gl, 1, -1); });
  EXPECT_TRUE(is_list(1));
}

TEST_F(ListNames, NotBetweenBeginAndEnd) {
  define(1, 1);
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { EXPECT_EQ(glevGenLists(gl, 1), 0u); });
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { glevDeleteLists(gl, 1, 1); });
  expect_rejected_in_primitive(GLEV_INVALID_OPERATION, [&] { EXPECT_EQ(glevIsList(gl, 1), GLEV_FALSE); });
  EXPECT_TRUE(is_list(1));
  EXPECT_FALSE(is_list(2));
}

TEST_F(ListNames, ContextsDoNotShareLists) {
  define(1, 1);
  glev_context* other;
  ASSERT_EQ(glevCreateContext(nullptr, &other), GLEV_SUCCESS);
  EXPECT_EQ(glevIsList(other, 1), GLEV_FALSE);
  glevNewList(other, 1, GLEV_COMPILE);
  glevEndList(other);
  EXPECT_EQ(index_of(1), 1);
  glevDeleteLists(other, 1, 1);
  EXPECT_EQ(index_of(1), 1);
  glevDestroyContext(other);
}

// Compares random operations with a std::map from names to the effects of lists.
TEST_F(ListNames, ManyRandomOperations) {
  std::mt19937 random(20);
  const auto below = [&](glev_uint n) { return static_cast<glev_uint>(random() % n); };
  std::map<glev_uint, float> model;
  for (int step = 0; step < 30000; ++step) {
    const glev_uint name = 1 + below(120);
    switch (below(8)) {
      case 0:
      case 1: {
        const auto count = static_cast<int>(below(step % 2 == 0 ? 3 : 30));
        const glev_uint first = glevGenLists(gl, count);
        EXPECT_EQ(first == 0, count == 0);
        for (int i = 0; i < count; ++i) EXPECT_TRUE(model.emplace(first + i, -1).second) << "in use";
        break;
      }
      case 2:
      case 3:
      case 4:
        model[name] = static_cast<float>(step);
        define(name, static_cast<float>(step));
        break;
      default: {
        const glev_uint count = below(12) == 0 ? 3000 : below(10);
        model.erase(model.lower_bound(name), model.lower_bound(name + count));
        glevDeleteLists(gl, name, static_cast<int>(count));
      }
    }
    const glev_uint probe = below(130);
    const auto found = model.find(probe);
    ASSERT_EQ(is_list(probe), found != model.end()) << step;
    ASSERT_EQ(index_of(probe), found == model.end() ? -1 : found->second) << step;
  }
  for (glev_uint name = 0; name < 4000; ++name) EXPECT_EQ(is_list(name), model.contains(name));
  expect_error(GLEV_NO_ERROR);
}

}  // namespace
}  // namespace glev_tests
