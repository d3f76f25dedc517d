// Tests delta debugging on lists of numbers.
#include <evalcts/runner/delta_debugging.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace evalcts {
namespace {

std::vector<int> first_numbers(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

TEST(Reduce, LeavesWhatIsNeededInItsOrder) {
  for (const Direction direction : {Direction::kForwards, Direction::kBackwards})
    for (const std::vector<int>& needed : {std::vector<int>{}, {0}, {63}, {3, 4, 40}, {0, 31, 32, 63}}) {
      std::vector<int> numbers = first_numbers(64);
      int asked = 0;
      const auto still_fails = [&](const std::vector<int>& left) {
        ++asked;
        return std::ranges::includes(left, needed);
      };
      reduce(numbers, direction, still_fails);
      EXPECT_EQ(numbers, needed);
      EXPECT_LT(asked, 64);
    }
}

TEST(Reduce, SaysIfAnotherRoundMayRemoveMore) {
  // An item can be removed only after the item that follows it.
  const auto is_prefix = [](const std::vector<int>& left) {
    return left == first_numbers(static_cast<int>(left.size())) && left.size() != 2;
  };
  std::vector<int> numbers = first_numbers(5);
  EXPECT_TRUE(reduce(numbers, Direction::kForwards, is_prefix));
  EXPECT_EQ(numbers, first_numbers(3));
  EXPECT_FALSE(reduce(numbers, Direction::kForwards, is_prefix));
}

TEST(RemoveRuns, TriesEachRunOnce) {
  for (const Direction direction : {Direction::kForwards, Direction::kBackwards}) {
    std::vector<int> numbers = first_numbers(5);
    std::vector<std::vector<int>> tried;
    EXPECT_FALSE(remove_runs(numbers, 2, direction, [&](const std::vector<int>& left) {
      tried.push_back(left);
      return false;
    }));
    EXPECT_EQ(numbers, first_numbers(5));
    const std::vector<std::vector<int>> expected =
        direction == Direction::kForwards ? std::vector<std::vector<int>>{{2, 3, 4}, {0, 1, 4}, {0, 1, 2, 3}}
                                          : std::vector<std::vector<int>>{{0, 1, 2}, {0, 3, 4}, {1, 2, 3, 4}};
    EXPECT_EQ(tried, expected);
  }
}

}  // namespace
}  // namespace evalcts
