// Tests the C text of constants and commands.
#include <evalcts/gl/call_log.h>
#include <evalcts/gl/hexadecimal.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "contains.h"

namespace evalcts::gl {
namespace {

TEST(Hexadecimal, HasTheSameBytesOnEveryMachine) {
  EXPECT_EQ(hexadecimal(0), "0x0p+0");
  EXPECT_EQ(hexadecimal(-0.0), "-0x0p+0");
  EXPECT_EQ(hexadecimal(1.5), "0x1.8p+0");
  EXPECT_EQ(hexadecimal(0x1p-149f), "0x1p-149");
  EXPECT_EQ(hexadecimal(-0x1.8p-1073), "-0x1.8p-1073");
  EXPECT_EQ(hexadecimal(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(hexadecimal(-0x1.fffffffffffffp+1023), "-0x1.fffffffffffffp+1023");
}

TEST(CallLog, ConstantsReadBackExactly) {
  for (const float value : {0.0f, 1.0f, -2.5f, 0.1f, 1e-40f, 3.4e38f, 1234567.0f, -1.0f / 3}) {
    const std::string text = c_constant(value);
    EXPECT_EQ(text.back(), 'f') << text;
    EXPECT_EQ(std::strtof(text.c_str(), nullptr), value) << text;
    const double wide = value * 1.00000000001;
    EXPECT_EQ(std::strtod(c_constant(wide).c_str(), nullptr), wide);
  }
  EXPECT_EQ(c_constant(0.1f), "0.1f");
  EXPECT_EQ(c_constant(1e-40), "1e-40");
  EXPECT_EQ(c_constant(-0.0f), "-0.0f");
  EXPECT_EQ(c_constant(0.0), "0.0");
  EXPECT_EQ(c_constant(std::nanf("")), "NAN");
  EXPECT_EQ(c_constant(-std::numeric_limits<double>::infinity()), "-INFINITY");
}

TEST(CallLog, CommandsAreC) {
  Case c;
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 1, std::vector<float>{1, 2, 3});
  c.Begin(GL_LINES);
  c.GetMapdv(GL_MAP2_INDEX, GL_COEFF, out<GLdouble>(2));
  c.EdgeFlag(GL_TRUE);
  const std::vector<std::string> lines = to_c(c, 0, 3);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "glMap1f(GL_MAP1_VERTEX_3, 0.0f, 1.0f, 3, 1, (GLfloat[]){1.0f, 2.0f, 3.0f});");
  EXPECT_EQ(lines[1], "glBegin(GL_LINES);");
  EXPECT_EQ(lines[2], "glGetMapdv(GL_MAP2_INDEX, GL_COEFF, (GLdouble[2]){0});");
  EXPECT_EQ(lines[3], "glEdgeFlag(GL_TRUE);");
}

TEST(CallLog, ProgramsHaveLoops) {
  using Lines = std::vector<std::string>;
  Case many;
  many.Begin(GL_LINES);
  for (int i = 0; i < 10000; ++i) {
    many.EvalCoord1d(0.25);
    many.Vertex2f(1, 2);
  }
  many.End();
  EXPECT_EQ(program_of(many),
            (Lines{"glBegin(GL_LINES);", "for (int i = 0; i < 10000; ++i) {", "  glEvalCoord1d(0.25);",
                   "  glVertex2f(1.0f, 2.0f);", "}", "glEnd();"}));
  Case different;
  for (int i = 0; i < 100; ++i) different.EvalCoord1f(i);
  const Lines cut = program_of(different, 24);
  EXPECT_EQ(cut.size(), 25u);
  EXPECT_EQ(cut[12], "/* 76 more lines */");
  EXPECT_EQ(with_loops({"a", "a", "a"}), (Lines{"a", "a", "a"}));
}

TEST(CallLog, LongListsAreCutInTheMiddleAndCounted) {
  Case c;
  for (int i = 0; i < 100; ++i) c.EvalCoord1f(i);
  const std::vector<std::string> lines = to_c(c, 0, 99, 10);
  EXPECT_EQ(lines.size(), 11u);
  EXPECT_EQ(lines.front(), "glEvalCoord1f(0.0f);");
  EXPECT_EQ(lines.back(), "glEvalCoord1f(99.0f);");
  EXPECT_TRUE(contains(lines[5], "90 more"));
}

}  // namespace
}  // namespace evalcts::gl
