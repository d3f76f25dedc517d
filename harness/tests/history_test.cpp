// Tests the search for the tests that a failure depends on.
#include "runner/history.h"

#include <gtest/gtest.h>

namespace evalcts {
namespace {

using Tests = std::vector<std::string>;

Tests numbered(int count) {
  Tests tests;
  for (int i = 0; i < count; ++i) tests.push_back("t" + std::to_string(i));
  return tests;
}

// A failure that happens if the history contains all of `needed` in this order.
struct Needs {
  Tests needed;
  int asked = 0;
  int most = 1000;

  std::optional<bool> operator()(const Tests& tests) {
    if (++asked > most) return std::nullopt;
    auto next = needed.begin();
    for (const std::string& test : tests)
      if (next != needed.end() && test == *next) ++next;
    return next == needed.end();
  }
};

TEST(ShortestHistory, IsWhatIsNeeded) {
  for (const Tests& needed :
       {Tests{"t99"}, Tests{"t0"}, Tests{"t42"}, Tests{"t3", "t97"}, Tests{"t98", "t99"},
        Tests{"t0", "t50", "t99"}, Tests{"t0", "t1", "t2", "t3"}}) {
    Needs needs{needed};
    const History history = shortest_history(numbered(100), {}, std::ref(needs));
    EXPECT_EQ(history.quality, History::Quality::kShortest);
    EXPECT_EQ(history.tests, needed);
    EXPECT_LT(needs.asked, 70);
  }
  Needs all{numbered(5)};
  EXPECT_EQ(shortest_history(numbered(5), {}, std::ref(all)).tests, numbered(5));
}

TEST(ShortestHistory, TakesAGoodGuess) {
  Needs needs{{"t3"}};
  EXPECT_EQ(shortest_history(numbered(1000), {"t3"}, std::ref(needs)).tests, Tests{"t3"});
  EXPECT_EQ(needs.asked, 1);
  EXPECT_EQ(shortest_history(numbered(1000), {"t4"}, std::ref(needs)).tests, Tests{"t3"});
}

TEST(ShortestHistory, SaysWhatItDoesNotKnow) {
  EXPECT_EQ(shortest_history(numbered(9), {}, Needs{{"x"}}).quality, History::Quality::kNotReproduced);
  EXPECT_EQ(shortest_history({}, {}, Needs{{"x"}}).quality, History::Quality::kNotReproduced);
  EXPECT_EQ(shortest_history(numbered(9), {}, Needs{{"t0"}, 0, 2}).quality, History::Quality::kOutOfTime);
  const History shortened = shortest_history(numbered(64), {}, Needs{{"t1", "t60"}, 0, 9});
  EXPECT_EQ(shortened.quality, History::Quality::kShortened);
  Needs both{{"t1", "t60"}};
  EXPECT_EQ(both(shortened.tests), true);
}

TEST(Least, IsTheFirstThatHolds) {
  for (std::size_t first = 1; first <= 20; ++first)
    EXPECT_EQ(least(20, [&](std::size_t n) { return n >= first; }), first);
  EXPECT_EQ(least(2, [](std::size_t) { return std::optional<bool>(); }), std::nullopt);
}

}  // namespace
}  // namespace evalcts
