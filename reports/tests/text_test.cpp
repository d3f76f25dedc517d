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
  EXPECT_EQ(plain_error(0.5), "0.5");
  EXPECT_EQ(plain_error(123.44), "123.4");
  EXPECT_EQ(plain_error(12345), "12,350");
  EXPECT_EQ(plain_error(1676045), "1,676,000");
  EXPECT_EQ(plain_error(1.061e43), "more than 2^24");
  EXPECT_EQ(plain_error(std::numeric_limits<double>::infinity()), "more than 2^24");
  EXPECT_EQ(distance(2.5, 1.0), "2.5 ULP, condition-aware 1");
  EXPECT_EQ(distance(2.5, std::nullopt), "2.5 ULP");
  EXPECT_EQ(distance(std::nullopt, 1.0), "condition-aware 1");
  EXPECT_EQ(distance(std::nullopt, std::nullopt), "");
  EXPECT_EQ(count(0, "test"), "0 tests");
  EXPECT_EQ(count(1, "test"), "1 test");
}

TEST(Text, PlainNumbers) {
  EXPECT_EQ(in_plain_numbers("[-3.01718326e-37, 3.01718326e-37]"), "0");
  EXPECT_EQ(in_plain_numbers("[0.49998, 0.50002]"), "0.5 +- 2e-05");
  EXPECT_EQ(in_plain_numbers("[-0.001, 0.001]"), "0 +- 0.001");
  EXPECT_EQ(in_plain_numbers("[0.25, 0.25]"), "0.25");
  EXPECT_EQ(in_plain_numbers("[0.123456788, 0.123456790]"), "0.123456789 +- 1e-09");
  EXPECT_EQ(in_plain_numbers("[0.25, 0.2501] exact 0.25005 (0x1.000d1cp-2)"),
            "0.25005 +- 5e-05 exact 0.25005");
  EXPECT_EQ(in_plain_numbers("[-inf, 1]"), "[-inf, 1]");
  EXPECT_EQ(in_plain_numbers("[1, 2"), "[1, 2");
  EXPECT_EQ(in_plain_numbers("u is -0x1.8p+0 (0x1p-1) of 0x0B20"), "u is -1.5 of 0x0B20");
  EXPECT_EQ(in_plain_numbers("order=4 u=0x1.99999ap-4"), "order=4 u=0.1");
  EXPECT_EQ(in_plain_numbers("GL_INVALID_VALUE"), "GL_INVALID_VALUE");
}

TEST(Text, TimeOfARun) {
  EXPECT_EQ(duration(46.6), "47 s");
  EXPECT_EQ(duration(167), "2 min 47 s");
  EXPECT_EQ(duration(3900), "1 h 5 min");
  RunResult run;
  EXPECT_EQ(time_of(run), "");
  run.started = "2026-11-28T11:27:22Z";
  run.seconds = 61;
  EXPECT_EQ(time_of(run), "2026-11-28 11:27 UTC, 1 min 1 s");
}

}  // namespace
}  // namespace evalcts::reports
