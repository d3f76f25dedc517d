// Tests the choice of parameters and deliveries by depth and test name.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "testkit/schedule.h"

namespace evalcts {
namespace {

constexpr int kTests = 3000;
std::string test(int number) { return "Suite.Test" + std::to_string(number); }

std::size_t count_of(Depth depth, const std::vector<Depth>& depths) {
  return static_cast<std::size_t>(std::ranges::count(depths, depth));
}

gl::Delivery delivery(gl::Delivery::Evaluation evaluation, gl::Lists lists = gl::Lists::kNone) {
  gl::Delivery delivery;
  delivery.evaluation = evaluation;
  delivery.lists = lists;
  return delivery;
}
std::vector<gl::Delivery> some_deliveries() {
  using enum gl::Delivery::Evaluation;
  return {delivery(kCoordinates), delivery(kArray), delivery(kMesh),
          delivery(kCoordinates, gl::Lists::kCompiled), delivery(kCoordinates, gl::Lists::kNested)};
}

const std::vector<std::string> kNames = {"A", "B", "C", "D", "E", "F", "G"};

TEST(Schedule, OneOfTheParametersIsQuickAndEachInSomeTest) {
  std::set<std::size_t> quick;
  for (int i = 0; i < kTests; ++i) {
    const std::vector<Depth> depths = Schedule(test(i)).of_parameters(kNames);
    ASSERT_EQ(depths.size(), kNames.size());
    EXPECT_EQ(count_of(Depth::kQuick, depths), 1u);
    EXPECT_EQ(count_of(Depth::kFull, depths), kNames.size() - 1);
    quick.insert(static_cast<std::size_t>(std::ranges::find(depths, Depth::kQuick) - depths.begin()));
  }
  EXPECT_EQ(quick.size(), kNames.size());
}

TEST(Schedule, EachDimensionIsQuick) {
  for (int i = 0; i < kTests; ++i) {
    const std::vector<Depth> depths = Schedule(test(i)).of_parameters({"1-D_U", "2-D_U", "2-D_V"});
    EXPECT_EQ(depths[0], Depth::kQuick);
    EXPECT_EQ(count_of(Depth::kQuick, depths), 2u);
  }
}

TEST(Schedule, TheNameAloneChooses) {
  EXPECT_EQ(Schedule("A.B").of_parameters(kNames), Schedule("A.B").of_parameters(kNames));
  EXPECT_NE(Schedule("A.B").of_parameters(kNames), Schedule("A.C").of_parameters(kNames));
}

std::vector<Scheduled> all_of(const std::vector<std::string_view>& values) {
  std::vector<Scheduled> tests;
  for (const std::string_view target : values)
    for (const std::string_view mode : {"POINT", "LINE"})
      tests.push_back({target, Depth::kFull, {target, mode}, {}});
  return tests;
}

TEST(MissingPairs, EveryPairIsQuickOnce) {
  std::vector<Scheduled> tests = all_of({"A", "B", "C"});
  // Another test has pairs of the first, which need not be quick in both.
  for (const std::string_view target : {"A", "B"})
    tests.push_back({"other", Depth::kFull, {target, "POINT"}, {}});
  add_missing_pairs(tests);
  std::multiset<std::vector<std::string_view>> quick;
  for (const Scheduled& each : tests)
    if (each.from == Depth::kQuick) quick.insert(each.values);
  EXPECT_EQ(
      quick,
      (std::multiset<std::vector<std::string_view>>{
          {"A", "POINT"}, {"A", "LINE"}, {"B", "POINT"}, {"B", "LINE"}, {"C", "POINT"}, {"C", "LINE"}}));
}

TEST(MissingPairs, QuickTestsCountAndThoroughOnesAreLeftAlone) {
  std::vector<Scheduled> tests = {{"a", Depth::kQuick, {"A"}, {"EvalCoord1f"}},
                                  {"b", Depth::kFull, {"A"}, {"EvalCoord1d"}},
                                  {"c", Depth::kFull, {"A"}, {"EvalCoord1f"}},
                                  {"d", Depth::kThorough, {"B"}, {"EvalCoord1f", "Nested"}}};
  add_missing_pairs(tests);
  std::vector<Depth> depths;
  for (const Scheduled& each : tests) depths.push_back(each.from);
  EXPECT_EQ(depths, (std::vector{Depth::kQuick, Depth::kQuick, Depth::kFull, Depth::kThorough}));
}

TEST(MissingPairs, TestsThroughListsCoverNoValuesThatOthersHave) {
  std::vector<Scheduled> tests = {{"a", Depth::kQuick, {"A"}, {"Nested"}, true},
                                  {"b", Depth::kFull, {"A"}, {}},
                                  {"c", Depth::kFull, {"B"}, {"Nested"}, true}};
  add_missing_pairs(tests);
  for (const Scheduled& each : tests) EXPECT_EQ(each.from, Depth::kQuick) << each.name;
}

TEST(Schedule, TheDeliveryAsWrittenIsNeverLeftOut) {
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(
        Schedule(test(i)).of_deliveries(Depth::kQuick, {delivery(gl::Delivery::Evaluation::kCoordinates)}),
        std::vector{Depth::kQuick});
}

TEST(Schedule, OneOfTheOtherDeliveriesIsTakenInEachTest) {
  std::array<int, 2> taken = {};
  for (int i = 0; i < kTests; ++i) {
    const std::vector<Depth> depths = Schedule(test(i)).of_deliveries(Depth::kQuick, some_deliveries());
    EXPECT_NE(depths[1] == Depth::kQuick, depths[2] == Depth::kQuick);
    ++taken.at(depths[1] == Depth::kQuick ? 0 : 1);
    EXPECT_EQ(std::max(depths[1], depths[2]), Depth::kFull);
    EXPECT_EQ(
        std::ranges::max(Schedule(test(i)).of_deliveries(Depth::kQuick, gl::sparing(some_deliveries()))),
        Depth::kThorough);
  }
  EXPECT_NEAR(taken[0], kTests / 2.0, kTests / 10.0);
}

TEST(Schedule, CombinationsOfFullDepthHaveOneOtherDeliveryAsWell) {
  for (int i = 0; i < kTests; ++i) {
    const std::vector<Depth> depths = Schedule(test(i)).of_deliveries(Depth::kFull, some_deliveries());
    EXPECT_EQ(depths[0], Depth::kFull);
    EXPECT_EQ(std::min(depths[1], depths[2]), Depth::kFull);
    EXPECT_EQ(std::max(depths[1], depths[2]), Depth::kThorough);
  }
}

TEST(Schedule, OneWayThroughListsIsTakenInOneTestOfNineAndAtFullDepthOfThree) {
  std::map<Depth, int> of_least;
  std::array<int, 2> taken = {};
  for (int i = 0; i < kTests; ++i) {
    const std::vector<Depth> depths = Schedule(test(i)).of_deliveries(Depth::kQuick, some_deliveries());
    EXPECT_EQ(std::max(depths[3], depths[4]), Depth::kThorough);
    ++of_least[std::min(depths[3], depths[4])];
    if (depths[3] == Depth::kQuick) ++taken[0];
    if (depths[4] == Depth::kQuick) ++taken[1];
  }
  EXPECT_NEAR(of_least[Depth::kQuick], kTests / 9.0, kTests / 30.0);
  EXPECT_NEAR(of_least[Depth::kFull], kTests * 2 / 9.0, kTests / 30.0);
  EXPECT_NEAR(taken[0], taken[1], kTests / 30.0);
}

TEST(Schedule, TheDepthOfTheTestIsTheLeast) {
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(count_of(Depth::kQuick, Schedule(test(i)).of_deliveries(Depth::kFull, some_deliveries())), 0u);
}

TEST(Schedule, OneTestOf32WithFewPrimitivesIsCrossChecked) {
  int checked = 0;
  for (int i = 0; i < kTests; ++i) {
    const Schedule schedule(test(i));
    EXPECT_TRUE(schedule.is_cross_checked(Depth::kThorough, 1000));
    EXPECT_FALSE(schedule.is_cross_checked(Depth::kFull, 65));
    EXPECT_EQ(schedule.is_cross_checked(Depth::kQuick, 1), schedule.is_cross_checked(Depth::kFull, 64));
    checked += schedule.is_cross_checked(Depth::kFull, 64);
  }
  EXPECT_NEAR(checked, kTests / 32.0, kTests / 100.0);
}

}  // namespace
}  // namespace evalcts
