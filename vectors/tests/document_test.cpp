// Tests Document, Theme and Dice.
#include "write/document.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "write/text.h"

namespace evalcts::vectors {
namespace {

TEST(Document, HasOneCaseALine) {
  Document document("grid", "Words.");
  Theme first(document, "first", "one thing", {"EV-A"});
  Theme second(document, "second", "another", {"EV-B"});
  first.add({{"x", 1}});
  second.add({{"x", 2}}, {"EV-C", "EV-B"});
  first.add({{"level", "advisory"}, {"since", "2.0"}, {"x", "\xC3\xA9"}}, {}, {"second"});
  EXPECT_EQ(document.text(), R"({
 "format": "evalcts-vectors-1",
 "schemaVersion": "1.1",
 "generatorVersion": "3",
 "kind": "grid",
 "description": "Words.",
 "numberOfTests": 3,
 "notes": {
  "first": "one thing",
  "second": "another"
 },
 "cases": [
{"id":"grid.first.1","requirements":["EV-A"],"flags":["first"],"level":"must","since":"1.0","x":1},
{"id":"grid.second.1","requirements":["EV-B","EV-C"],"flags":["second"],"level":"must","since":"1.0","x":2},
{"id":"grid.first.2","requirements":["EV-A"],"flags":["first","second"],"level":"advisory","since":"2.0","x":"\u00e9"}
]}
)");
}

TEST(Document, RefusesWhatDoesNotHoldTogether) {
  Document document("grid", "Words.");
  Theme theme(document, "theme", "meaning", {"EV-A"});
  EXPECT_THROW(theme.add({}, {}, {"unexplained"}), std::logic_error);
  EXPECT_THROW(document.explain("theme", "another meaning"), std::logic_error);
  document.explain("theme", "meaning");
  document.add("grid.theme.1", {"EV-A"}, {"theme"}, {{"x", 1}});
  document.add("grid.theme.1", {"EV-A"}, {"theme"}, {{"x", 1}});
  EXPECT_THROW(document.text(), std::logic_error);
}

// A theme draws the same data whatever other themes a file has.
TEST(Theme, HasDiceOfItsOwn) {
  Document one("grid", "Words."), two("grid", "Words.");
  Theme other(two, "other", "meaning", {"EV-A"});
  other.dice().below(1000);
  Theme a(one, "theme", "meaning", {"EV-A"}), b(two, "theme", "meaning", {"EV-A"});
  for (int i = 0; i < 10; ++i) EXPECT_EQ(a.dice().below(1 << 30), b.dice().below(1 << 30));
  EXPECT_NE(Dice("grid.theme").below(1 << 30), Dice("grid.other").below(1 << 30));
}

// The C++ standard defines the sequence of std::mt19937_64; this test fixes the numbers that Dice derives
// from it.
TEST(Dice, AreTheSameEverywhere) {
  Dice dice("vectors");
  EXPECT_EQ(dice.below(1000000), 510225);
  EXPECT_EQ(dice.between(-8, 8), -7);
  EXPECT_EQ(dice.real(10), -343.0 / 1024);
  EXPECT_EQ(hexadecimal(dice.significand(24)), "0x1.c78a02p+0");
}

TEST(Dice, KeepTheirPromises) {
  Dice dice("promises");
  for (int i = 0; i < 2000; ++i) {
    const double real = dice.real(53);
    ASSERT_TRUE(real >= -1 && real < 1);
    const double single = dice.significand(24);
    ASSERT_EQ(single, static_cast<float>(single));
    ASSERT_TRUE(std::abs(single) >= 1 && std::abs(single) < 2);
    const double scaled = std::abs(dice.scaled(10, -3, 4));
    ASSERT_TRUE(scaled >= 0x1p-3 && scaled < 0x1p5);
    const int number = dice.between(-2, 2);
    ASSERT_TRUE(number >= -2 && number <= 2);
  }
}

}  // namespace
}  // namespace evalcts::vectors
