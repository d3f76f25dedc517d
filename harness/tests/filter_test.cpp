// Tests filters of names, and the tests that they select at a depth.
#include <evalcts/results/filter.h>

#include <gtest/gtest.h>

namespace evalcts {
namespace {

TEST(Filter, HasPatternsOfGoogleTest) {
  EXPECT_TRUE(is_chosen("Map1.A", ""));
  EXPECT_TRUE(is_chosen("Map1.A", "Map2.*:Map?.A"));
  EXPECT_FALSE(is_chosen("Map1.A", "Map2.*"));
  EXPECT_FALSE(is_chosen("Map1.A", "Map*:-*.A"));
  EXPECT_FALSE(is_chosen("Map1.A", "-*.A"));
  EXPECT_TRUE(is_chosen("Map1.B-2", "Map1.B-2"));
}

TEST(Filter, KeepsTheDepthExceptForExactNames) {
  const ListedTest quick{"A.B/1", {}, Level::kMust, Depth::kQuick};
  const ListedTest thorough{"A.B/2", {}, Level::kMust, Depth::kThorough};
  EXPECT_TRUE(is_selected(quick, Depth::kQuick, ""));
  EXPECT_FALSE(is_selected(thorough, Depth::kFull, ""));
  EXPECT_FALSE(is_selected(thorough, Depth::kFull, "A.B/*"));
  EXPECT_TRUE(is_selected(thorough, Depth::kThorough, "A.B/*"));
  EXPECT_TRUE(is_selected(thorough, Depth::kQuick, "A.C:A.B/2"));
}

}  // namespace
}  // namespace evalcts
