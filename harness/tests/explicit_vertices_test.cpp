// The control of a case through display lists: vertices in the place of evaluation, everything else as it
// was.
#include "harness/gl/explicit_vertices.h"

#include <gtest/gtest.h>

#include "harness/gl/call_log.h"

namespace evalcts::gl {
namespace {

using Lines = std::vector<std::string>;

Lines calls_of(const Case& script) { return to_c(script, 0, static_cast<int>(script.commands().size()) - 1); }

TEST(ExplicitVertices, StandInThePlaceOfEveryEvaluation) {
  Case c("curve");
  c.Begin(GL_LINE_STRIP);
  c.Color4f(1, 0, 0, 1);
  c.EvalCoord1f(0.5f);
  c.EvalCoord2d(0.5, 0.25);
  c.EvalPoint1(2);
  c.End();
  const Case control = with_explicit_vertices(c);
  EXPECT_EQ(control.identity(), "curve");
  const Lines lines = calls_of(control);
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines[0], "glBegin(GL_LINE_STRIP);");
  EXPECT_EQ(lines[1], calls_of(c)[1]);
  EXPECT_EQ(lines[5], "glEnd();");
  for (const std::size_t i : {2, 3, 4}) EXPECT_TRUE(lines[i].starts_with("glVertex3f(")) << lines[i];
  EXPECT_NE(lines[2], lines[3]);
  EXPECT_NE(lines[3], lines[4]);
}

TEST(ExplicitVertices, MakeAPrimitiveOfAMesh) {
  Case c("meshes");
  c.EvalMesh1(GL_LINE, 0, 9);
  c.EvalMesh2(GL_POINT, 0, 1, 0, 1);
  const Lines lines = calls_of(with_explicit_vertices(c));
  ASSERT_EQ(lines.size(), 8u);
  EXPECT_EQ(lines[0], "glBegin(GL_LINE_STRIP);");
  EXPECT_EQ(lines[3], "glEnd();");
  EXPECT_EQ(lines[4], "glBegin(GL_POINTS);");
  EXPECT_EQ(lines[7], "glEnd();");
}

// There a mesh is an error, which must not end the primitive.
TEST(ExplicitVertices, LeaveOutAMeshBetweenBeginAndEnd) {
  Case c("mesh in a primitive");
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.5f);
  c.EvalMesh1(GL_POINT, 0, 9);
  c.EvalCoord1f(1);
  c.End();
  const Lines lines = calls_of(with_explicit_vertices(c));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "glBegin(GL_POINTS);");
  EXPECT_EQ(lines[3], "glEnd();");
}

// What commands take from the results of earlier ones moves with these.
TEST(ExplicitVertices, KeepReferencesToEarlierCommands) {
  Case c("buffer");
  c.EvalMesh1(GL_POINT, 0, 1);
  const ResultOf buffer{c.GenBuffers(1, out<GLuint>(1)).index, 0};
  c.BindBuffer(GL_ARRAY_BUFFER, buffer);
  const Case control = with_explicit_vertices(c);
  ASSERT_EQ(control.commands().size(), 6u);
  const Command& bind = control.commands().back();
  ASSERT_EQ(bind.entry, EntryPoint::BindBuffer);
  const int from = std::get<ResultOf>(bind.arguments[1]).command;
  EXPECT_EQ(control.commands().at(static_cast<std::size_t>(from)).entry, EntryPoint::GenBuffers);
}

}  // namespace
}  // namespace evalcts::gl
