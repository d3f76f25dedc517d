// Tests deliveries, which replace evaluation commands of a case by others and keep the other commands.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/delivery.h>
#include <evalcts/gl/lift.h>
#include "gl/grid.h"

namespace evalcts::gl {
namespace {

std::vector<std::string> delivered(const Case& script, std::size_t which) {
  return to_c(curve_deliveries().at(which).apply(script).script, 0, 99);
}

TEST(Delivery, ReplacesMapsAndEvaluations) {
  Case c("one");
  c.Map1f(GL_MAP1_INDEX, 0.5f, 2.0f, 1, 2, std::vector<float>{3, 0.25f});
  c.EvalCoord1f(0.1f);
  c.Color3f(1, 0, 0);
  const std::vector<std::string> expected[] = {
      {"glMap1f(GL_MAP1_INDEX, 0.5f, 2.0f, 1, 2, (GLfloat[]){3.0f, 0.25f});", "glEvalCoord1f(0.1f);",
       "glColor3f(1.0f, 0.0f, 0.0f);"},
      {"glMap1f(GL_MAP1_INDEX, 0.5f, 2.0f, 1, 2, (GLfloat[]){3.0f, 0.25f});",
       "glEvalCoord1fv((GLfloat[]){0.1f});", "glColor3f(1.0f, 0.0f, 0.0f);"},
      {"glMap1d(GL_MAP1_INDEX, 0.5, 2.0, 1, 2, (GLdouble[]){3.0, 0.25});",
       "glEvalCoord1d(0.10000000149011612);", "glColor3f(1.0f, 0.0f, 0.0f);"},
      {"glMap1d(GL_MAP1_INDEX, 0.5, 2.0, 1, 2, (GLdouble[]){3.0, 0.25});",
       "glEvalCoord1dv((GLdouble[]){0.10000000149011612});", "glColor3f(1.0f, 0.0f, 0.0f);"}};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(delivered(c, i), expected[i]) << curve_deliveries()[i].name;
}

// Deliveries also convert commands that are not in the f form, and keep the treatment of arrays
// after the call.
TEST(Delivery, WorksFromEveryForm) {
  Case c;
  c.Map1d(GL_MAP1_INDEX, 0.0, 1.0, 1, 1, array({1.0 / 3}, AfterCall::kProtect));
  c.EvalCoord1dv(std::vector<double>{0.5});
  c.EvalCoord1fv(std::vector<float>{0.5f});
  const std::vector<std::string> single = delivered(c, 0);
  EXPECT_EQ(single[0],
            "glMap1f(GL_MAP1_INDEX, 0.0f, 1.0f, 1, 1, (GLfloat[]){0.33333334f} "
            "/* protected after the call */);");
  EXPECT_EQ(single[1], "glEvalCoord1f(0.5f);");
  EXPECT_EQ(single[2], "glEvalCoord1f(0.5f);");
  EXPECT_EQ(delivered(c, 3)[1], "glEvalCoord1dv((GLdouble[]){0.5});");
}

TEST(Delivery, NullPointsStayNull) {
  Case c;
  c.Map1f(GL_MAP1_INDEX, 0.0f, 1.0f, 1, 1, nullptr);
  EXPECT_EQ(delivered(c, 2)[0], "glMap1d(GL_MAP1_INDEX, 0.0, 1.0, 1, 1, NULL);");
}

// --- Grids -----------------------------------------------------------------------------------------------

const Delivery& by(const std::string& name) {
  for (const Delivery& delivery : curve_deliveries())
    if (delivery.name == name) return delivery;
  throw std::logic_error(name);
}

std::vector<std::string> calls(const DeliveredCase& delivered) { return to_c(delivered.script, 0, 99); }

TEST(GridThrough, IsTheCoarsestThatHasAll) {
  const auto grid = grid_through({0.25, 1, 0.5});
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->segments, 3);
  EXPECT_EQ(grid->first, 0.25);
  EXPECT_EQ(grid->last, 1);
  EXPECT_EQ(grid->indices, (std::vector<int>{0, 3, 1}));
  EXPECT_EQ(grid_through({-3, 0, 4.5})->segments, 5);
  EXPECT_EQ(grid_through({7, 7})->indices, (std::vector<int>{0, 0}));
  EXPECT_NE(grid_through({0, 0})->last, 0);
  EXPECT_FALSE(grid_through({}));
  EXPECT_FALSE(grid_through({0, 1, 0x1p-40}));
  EXPECT_FALSE(grid_through({0, 1, 0.1f}));  // 0.1f is a fraction with a large denominator
  EXPECT_FALSE(grid_through({0, HUGE_VAL}));
}

TEST(Delivery, EvalPointOnOneGridOrOnEndsOfMany) {
  Case c;
  c.Begin(GL_LINES);
  c.EvalCoord1f(0.5f);
  const Ref color = c.Color3f(1, 0, 0);
  c.EvalCoord1f(0.25f);
  c.End();
  const DeliveredCase lines = by("EvalPoint1").apply(c);
  EXPECT_EQ(calls(lines), (std::vector<std::string>{"glMapGrid1f(1, 0.25f, 0.5f);", "glBegin(GL_LINES);",
                                                    "glEvalPoint1(1);", "glColor3f(1.0f, 0.0f, 0.0f);",
                                                    "glEvalPoint1(0);", "glEnd();"}));
  EXPECT_EQ(lines.positions, (std::vector<int>{1, 2, 3, 4, 5}));
  EXPECT_EQ(color.index, 2);

  Case points;
  points.Begin(GL_POINTS);
  points.EvalCoord1f(0.1f);
  points.EvalCoord1f(1);
  points.EvalCoord1f(0);
  points.End();
  const DeliveredCase ends = by("EvalPoint1").apply(points);
  const std::vector<std::string> expected = {
      "glBegin(GL_POINTS);", "glEnd();", "glMapGrid1f(1, 0.1f, 1.05f);", "glBegin(GL_POINTS);",
      "glEvalPoint1(0);",    "glEnd();", "glMapGrid1f(3, 1.0f, 1.5f);",  "glBegin(GL_POINTS);",
      "glEvalPoint1(0);",    "glEnd();", "glMapGrid1f(1, 0.0f, 1.0f);",  "glBegin(GL_POINTS);",
      "glEvalPoint1(0);",    "glEnd();"};
  EXPECT_EQ(calls(ends), expected);
  EXPECT_EQ(ends.positions, (std::vector<int>{0, 4, 8, 12, 13}));
}

TEST(Delivery, EvalMeshForWholePrimitives) {
  Case c;
  c.Begin(GL_LINE_STRIP);
  for (const float u : {0.0f, 0.5f, 1.0f}) c.EvalCoord1f(u);
  c.End();
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.25f);
  c.EvalCoord1f(0.5f);
  c.Vertex2f(3, 4);
  c.EvalCoord1f(2);
  c.End();
  const std::vector<std::string> expected = {"glMapGrid1f(2, 0.0f, 1.0f);",
                                             "glEvalMesh1(GL_LINE, 0, 2);",
                                             "glMapGrid1f(1, 0.25f, 0.5f);",
                                             "glEvalMesh1(GL_POINT, 0, 1);",
                                             "glBegin(GL_POINTS);",
                                             "glVertex2f(3.0f, 4.0f);",
                                             "glEnd();",
                                             "glMapGrid1f(1, 2.0f, 3.0f);",
                                             "glEvalMesh1(GL_POINT, 0, 0);"};
  EXPECT_EQ(calls(by("EvalMesh1").apply(c)), expected);

  Case triangles;
  triangles.Begin(GL_TRIANGLES);
  triangles.EvalCoord1f(0.1f);
  triangles.EvalCoord1f(0.3f);
  triangles.EvalCoord1f(0.9f);
  triangles.End();
  EXPECT_THROW(by("EvalMesh1").apply(triangles), std::logic_error);
  EXPECT_THROW(by("EvalPoint1").apply(triangles), std::logic_error);
}

// A command that uses the result of an earlier command still uses the result of the same command.
TEST(Delivery, ResultsKeepTheirCommands) {
  Case c;
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.1f);
  c.EvalCoord1f(1);
  c.End();
  const Ref shader = c.CreateShader(GL_VERTEX_SHADER);
  c.CompileShader(shader);
  const DeliveredCase delivered = by("EvalPoint1").apply(c);
  const auto& taken = std::get<ResultOf>(delivered.script.commands().back().arguments[0]);
  EXPECT_EQ(delivered.script.commands()[static_cast<std::size_t>(taken.command)].entry,
            EntryPoint::CreateShader);
}

// --- Two dimensions --------------------------------------------------------------------------------------

TEST(Lift, MakesNetsThatAreConstantAcross) {
  Case c;
  for (int i = 0; i < 3; ++i) c.Map1f(GL_MAP1_INDEX, 2.0f, 5.0f, 1, 2, std::vector<float>{3, 4});
  c.Enable(GL_MAP1_INDEX);
  c.Disable(GL_MAP2_VERTEX_3);
  c.EvalCoord1f(0.5f);
  EXPECT_EQ(
      to_c(lift(c, false), 0, 99),
      (std::vector<std::string>{
          "glMap2f(GL_MAP2_INDEX, 2.0f, 5.0f, 1, 2, 0.0f, 1.0f, 1, 1, (GLfloat[]){3.0f, 4.0f});",
          "glMap2f(GL_MAP2_INDEX, 2.0f, 5.0f, 1, 2, 0.0f, 1.0f, 2, 2, (GLfloat[]){3.0f, 4.0f, 3.0f, 4.0f});",
          std::string("glMap2f(GL_MAP2_INDEX, 2.0f, 5.0f, 1, 2, 0.0f, 1.0f, 2, 3, ") +
              "(GLfloat[]){3.0f, 4.0f, 3.0f, 4.0f, 3.0f, 4.0f});",
          "glEnable(GL_MAP2_INDEX);", "glDisable(GL_MAP1_VERTEX_3);", "glEvalCoord2f(0.5f, 0.375f);"}));
  EXPECT_EQ(to_c(lift(c, true), 0, 0)[0],
            "glMap2f(GL_MAP2_INDEX, 0.0f, 1.0f, 1, 1, 2.0f, 5.0f, 1, 2, (GLfloat[]){3.0f, 4.0f});");
  EXPECT_EQ(to_c(lift(c, true), 5, 5)[0], "glEvalCoord2f(0.375f, 0.5f);");
}

TEST(Delivery, TwoDimensionsOfACurve) {
  Case c;
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.5f);
  c.EvalCoord1f(1);
  c.End();
  EXPECT_EQ(calls(by("EvalMesh2").apply(c)),
            (std::vector<std::string>{"glMapGrid2f(1, 0.5f, 1.0f, 1, 0.375f, 0.75f);",
                                      "glEvalMesh2(GL_POINT, 0, 1, 0, 0);"}));
  EXPECT_EQ(calls(by("EvalCoord2dv").apply(c))[1], "glEvalCoord2dv((GLdouble[]){0.5, 0.375});");
  EXPECT_EQ(calls(by("EvalCoord2d").apply(c))[1], "glEvalCoord2d(0.375, 0.5);");
  EXPECT_EQ(without(kLists, surface_deliveries()).size(), 6u);
  for (const Delivery& delivery : surface_deliveries()) EXPECT_FALSE(delivery.lifted) << delivery.name;
}

}  // namespace
}  // namespace evalcts::gl
