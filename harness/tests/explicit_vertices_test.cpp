// Tests the controls of a case: explicit commands replace evaluation, other commands of evaluators are left
// out, and everything else is unchanged.
#include <evalcts/gl/explicit_vertices.h>

#include <gtest/gtest.h>

#include <limits>

#include <evalcts/gl/call_log.h>

namespace evalcts::gl {
namespace {

using Lines = std::vector<std::string>;

Lines calls_of(const Case& script) { return all_calls(script); }

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

// Lists the commands without their vertices: "LINE_STRIP 3" is a primitive of three.
Lines primitives_of(const Case& script) {
  Lines primitives;
  int vertices = 0;
  for (const std::string& line : calls_of(script)) {
    if (line.starts_with("glBegin(GL_")) {
      primitives.push_back(line.substr(11, line.size() - 13));
      vertices = 0;
    } else if (line.starts_with("glVertex3f(")) {
      ++vertices;
    } else {
      EXPECT_EQ(line, "glEnd();");
      primitives.back() += " " + std::to_string(vertices);
    }
  }
  return primitives;
}

TEST(ExplicitVertices, MakeThePrimitivesOfAMesh) {
  const auto of = [](auto record) {
    Case c("mesh");
    record(c);
    return primitives_of(with_explicit_vertices(c));
  };
  EXPECT_EQ(of([](Case& c) { c.EvalMesh1(GL_LINE, -1, 9); }), (Lines{"LINE_STRIP 11"}));
  EXPECT_EQ(of([](Case& c) { c.EvalMesh1(GL_POINT, 2, 1); }), (Lines{"POINTS 0"}));
  EXPECT_EQ(of([](Case& c) { c.EvalMesh1(GL_FILL, 0, 1); }), Lines{});
  EXPECT_EQ(of([](Case& c) { c.EvalMesh2(GL_POINT, 0, 1, 0, 2); }), (Lines{"POINTS 6"}));
  EXPECT_EQ(of([](Case& c) { c.EvalMesh2(GL_LINE, 0, 1, 0, 2); }),
            (Lines{"LINE_STRIP 2", "LINE_STRIP 2", "LINE_STRIP 2", "LINE_STRIP 3", "LINE_STRIP 3"}));
  EXPECT_EQ(of([](Case& c) { c.EvalMesh2(GL_FILL, 1, 3, 0, 2); }), (Lines{"QUAD_STRIP 6", "QUAD_STRIP 6"}));
  EXPECT_EQ(of([](Case& c) { c.EvalMesh2(GL_FILL, 0, 1, 2, 2); }), Lines{});
  EXPECT_EQ(of([](Case& c) { c.EvalMesh2(GL_QUAD_STRIP, 0, 1, 0, 2); }), Lines{});
  EXPECT_EQ(of([](Case& c) { c.EvalMesh1(GL_LINE, 0, std::numeric_limits<GLint>::max()); }),
            (Lines{"LINE_STRIP 16"}));
}

// Between Begin and End, a mesh is an error, which must not end the primitive.
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

// References to results still refer to the same commands, whose positions have changed.
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

// Returns the names of the commands, without their arguments.
Lines names_of(const Case& script) {
  Lines names;
  for (const Command& command : script.commands()) names.emplace_back(name_of(command.entry).substr(2));
  return names;
}

// The control must not contain commands that define, enable or query maps and grids, because their bugs would
// make the control fail, too.
TEST(ExplicitVertices, StandWithoutCommandsOfEvaluators) {
  Case c("state");
  c.PushAttrib(GL_EVAL_BIT | GL_ENABLE_BIT);
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, std::vector<GLfloat>{0, 0, 0, 1, 1, 1});
  c.MapGrid1f(4, 0, 1);
  c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, out<GLint>(1));
  c.Enable(GL_LIGHTING);
  c.Enable(GL_MAP1_VERTEX_3);
  c.Enable(GL_AUTO_NORMAL);
  c.Enable(GL_MAP1_VERTEX_ATTRIB0_4_NV);
  c.Disable(GL_MAP2_VERTEX_ATTRIB15_4_NV);
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.5f);
  c.Disable(GL_MAP1_VERTEX_3);
  c.Disable(GL_FOG);
  c.EvalMesh1(GL_POINT, 0, 1);
  c.End();
  const Lines lines = calls_of(with_explicit_vertices(c));
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines[0], "glPushAttrib(GL_ENABLE_BIT);");
  EXPECT_EQ(lines[1], "glEnable(GL_LIGHTING);");
  EXPECT_EQ(lines[4], "glDisable(GL_FOG);");
  Lines with_changes = calls_of(with_explicit_vertices(c, GL_COLOR_LOGIC_OP));
  ASSERT_EQ(with_changes.size(), 15u);
  EXPECT_EQ(with_changes[1], "glEnable(GL_COLOR_LOGIC_OP);");
  EXPECT_EQ(with_changes[2], "glDisable(GL_COLOR_LOGIC_OP);");
  EXPECT_EQ(std::erase_if(with_changes,
                          [](const std::string& line) { return line.find("LOGIC_OP") != std::string::npos; }),
            9u);
  EXPECT_EQ(with_changes, lines);
}

TEST(ExplicitCommands, GiveTheAttributesOfTheEnabledMaps) {
  Case c("curve");
  c.Enable(GL_MAP1_VERTEX_3);
  c.Enable(GL_MAP1_COLOR_4);
  c.Enable(GL_MAP2_TEXTURE_COORD_2);
  c.Enable(GL_AUTO_NORMAL);
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.5f);
  c.EvalPoint2(1, 2);
  c.Enable(GL_MAP2_VERTEX_3);
  c.Enable(GL_MAP2_VERTEX_4);
  c.EvalPoint2(1, 2);
  c.End();
  EXPECT_EQ(names_of(with_explicit_commands(c)),
            (Lines{"Begin", "Color4f", "Vertex3f", "Normal3f", "TexCoord2f", "Normal3f", "TexCoord2f",
                   "Vertex4f", "End"}));
  EXPECT_EQ(names_of(with_explicit_commands(c, {}, Arguments::kArray)),
            (Lines{"Begin", "Color4fv", "Vertex3fv", "Normal3fv", "TexCoord2fv", "Vertex4fv", "End"}));
}

TEST(ExplicitCommands, ConsecutiveVerticesHaveDifferentAttributes) {
  Case c("curve");
  for (const GLenum target : {GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_2}) c.Enable(target);
  c.EvalCoord1f(0.5f);
  c.EvalCoord1f(1);
  const Lines calls = calls_of(with_explicit_commands(c));
  ASSERT_EQ(calls.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NE(calls[i], calls[i + 3]);
}

// The texture map with the most coordinates has precedence.
TEST(ExplicitCommands, FollowDisableAndTheAttributeStack) {
  Case c("stack");
  c.Enable(GL_MAP1_TEXTURE_COORD_4);
  c.Enable(GL_MAP1_TEXTURE_COORD_1);
  c.PushAttrib(GL_ENABLE_BIT);
  c.Disable(GL_MAP1_TEXTURE_COORD_4);
  c.EvalCoord1f(0);
  c.PopAttrib();
  c.EvalCoord1f(0);
  EXPECT_EQ(names_of(with_explicit_commands(c)),
            (Lines{"PushAttrib", "TexCoord1f", "PopAttrib", "TexCoord4f"}));
}

TEST(ExplicitCommands, DrawFilledMeshesAsTriangleStrips) {
  Case c("mesh");
  c.EvalMesh2(GL_FILL, 1, 3, 0, 2);
  EXPECT_EQ(primitives_of(with_explicit_commands(c)), (Lines{"TRIANGLE_STRIP 6", "TRIANGLE_STRIP 6"}));
}

}  // namespace
}  // namespace evalcts::gl
