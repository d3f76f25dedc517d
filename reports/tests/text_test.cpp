// Tests that untrusted text is made safe, and the format of numbers.
#include "text.h"

#include <gtest/gtest.h>

#include <limits>

namespace evalcts::reports {
namespace {

TEST(Text, CleanKeepsWhatIsSafe) {
  const std::string text = "plain \"quoted\" <tag> & é € 𝄞\n\ttabbed \\ \\u0041";
  EXPECT_EQ(clean(text), text);
  EXPECT_EQ(clean(""), "");
}

TEST(Text, CleanShowsControlCharactersAsPictures) {
  EXPECT_EQ(clean(std::string("a\0b", 3)), "a␀b");
  EXPECT_EQ(clean("\x1b[2J\r\x1f\x7f"), "␛[2J␍␟␡");
}

TEST(Text, CleanReplacesWhatXmlOrUtf8Forbids) {
  EXPECT_EQ(clean("\xEF\xBF\xBE|\xEF\xBF\xBF"), "\uFFFD|\uFFFD");          // noncharacters
  EXPECT_EQ(clean("\xC2\x80|\xC2\x9B|\xC2\x9F"), "\uFFFD|\uFFFD|\uFFFD");  // C1 controls, for terminals
  EXPECT_EQ(clean("\xC2\xA0"), "\xC2\xA0");                                // the first one above C1
  EXPECT_EQ(clean("a\xFFz"), "a\uFFFDz");
  EXPECT_EQ(clean("cut \xE2\x82"), "cut \uFFFD");
  EXPECT_EQ(clean("\xC0\xAF").find('/'), std::string::npos);  // overlong
  EXPECT_EQ(clean("\xED\xA0\x80").find("\xED\xA0\x80"), std::string::npos);
}

TEST(Text, OneLine) { EXPECT_EQ(one_line("a\nb\tc"), "a b c"); }

TEST(Text, CutCountsCodePointsAndKeepsThemWhole) {
  EXPECT_EQ(cut("12345678", 8), "12345678");
  EXPECT_EQ(cut("123456789", 8), "12345...");
  EXPECT_EQ(cut("éééé", 4), "éééé");
  EXPECT_EQ(cut("ééééé", 4), "é...");
  EXPECT_EQ(cut("", 3), "");
  EXPECT_EQ(cut("1234", 3), "...");
}

TEST(Text, Numbers) {
  EXPECT_EQ(number(0.5), "0.5");
  EXPECT_EQ(number(123.4), "123.4");
  EXPECT_EQ(number(1676000), "1.676e+06");
  EXPECT_EQ(number(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(number(std::nullopt), "unknown");
  EXPECT_EQ(distance(2.5, 1.0), "2.5 ULP, condition-aware 1");
  EXPECT_EQ(distance(2.5, std::nullopt), "2.5 ULP");
  EXPECT_EQ(distance(std::nullopt, 1.0), "condition-aware 1");
  EXPECT_EQ(distance(std::nullopt, std::nullopt), "");
  EXPECT_EQ(count(0, "test"), "0 tests");
  EXPECT_EQ(count(1, "test"), "1 test");
}

}  // namespace
}  // namespace evalcts::reports
