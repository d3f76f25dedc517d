// Tests cases through display lists: the resulting commands, their positions, and that they emit the same.
#include <gtest/gtest.h>

#include <algorithm>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/delivery.h>
#include <evalcts/judge/prediction.h>

namespace evalcts::gl {
namespace {

using Lines = std::vector<std::string>;

Lines lines_of(const Case& script) { return all_calls(script); }
Lines through(const Case& script, Lists lists) { return lines_of(through_lists(script, lists).script); }

// Returns five commands that are compiled, one command that is not, and one that is.
Case mixed() {
  Case c("mixed");
  c.Enable(GL_MAP1_VERTEX_3);
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.5f);
  c.EvalCoord1f(1.0f);
  c.End();
  c.GetError();
  c.Disable(GL_MAP1_VERTEX_3);
  return c;
}

TEST(DisplayLists, WithoutListsIsTheCaseItself) {
  for (const Lists lists : {Lists::kCompiled, Lists::kExecuted, Lists::kNested, Lists::kSplit})
    EXPECT_EQ(lines_of(without_lists(through_lists(mixed(), lists).script)), lines_of(mixed()));
  Case twice;
  twice.NewList(1, GL_COMPILE_AND_EXECUTE);
  twice.EvalPoint1(3);
  twice.GetError();
  twice.EndList();
  twice.CallList(1);
  twice.CallList(2);  // does not exist
  EXPECT_EQ(lines_of(without_lists(twice)), (Lines{"glEvalPoint1(3);", "glGetError();", "glEvalPoint1(3);"}));
}

TEST(DisplayLists, Compiled) {
  EXPECT_EQ(through(mixed(), Lists::kCompiled),
            (Lines{"glNewList(19456, GL_COMPILE);", "glEnable(GL_MAP1_VERTEX_3);", "glBegin(GL_POINTS);",
                   "glEvalCoord1f(0.5f);", "glEvalCoord1f(1.0f);", "glEnd();", "glEndList();",
                   "glNewList(19457, GL_COMPILE);", "glDisable(GL_MAP1_VERTEX_3);", "glEndList();",
                   "glCallList(19456);", "glGetError();", "glCallList(19457);"}));
}

TEST(DisplayLists, Executed) {
  EXPECT_EQ(through(mixed(), Lists::kExecuted),
            (Lines{"glNewList(19456, GL_COMPILE_AND_EXECUTE);", "glEnable(GL_MAP1_VERTEX_3);",
                   "glBegin(GL_POINTS);", "glEvalCoord1f(0.5f);", "glEvalCoord1f(1.0f);", "glEnd();",
                   "glGetError();", "glDisable(GL_MAP1_VERTEX_3);", "glEndList();"}));
}

TEST(DisplayLists, Nested) {
  EXPECT_EQ(through(mixed(), Lists::kNested), (Lines{"glNewList(19456, GL_COMPILE);",
                                                     "glEnable(GL_MAP1_VERTEX_3);",
                                                     "glBegin(GL_POINTS);",
                                                     "glEvalCoord1f(0.5f);",
                                                     "glEndList();",
                                                     "glNewList(19457, GL_COMPILE);",
                                                     "glEvalCoord1f(1.0f);",
                                                     "glEnd();",
                                                     "glEndList();",
                                                     "glNewList(19458, GL_COMPILE);",
                                                     "glCallList(19456);",
                                                     "glCallList(19457);",
                                                     "glEndList();",
                                                     "glNewList(19459, GL_COMPILE);",
                                                     "glDisable(GL_MAP1_VERTEX_3);",
                                                     "glEndList();",
                                                     "glNewList(19460, GL_COMPILE);",
                                                     "glEndList();",
                                                     "glNewList(19461, GL_COMPILE);",
                                                     "glCallList(19459);",
                                                     "glCallList(19460);",
                                                     "glEndList();",
                                                     "glCallList(19458);",
                                                     "glGetError();",
                                                     "glCallList(19461);"}));
}

// A list is not called twice if it contains a Begin without its End.
TEST(DisplayLists, Repeated) {
  Case c = mixed();
  c.Begin(GL_POINTS);
  c.GetError();
  c.End();
  const Lines lines = through(c, Lists::kRepeated);
  EXPECT_EQ(Lines(lines.end() - 6, lines.end()),
            (Lines{"glCallList(19456);", "glCallList(19456);", "glGetError();", "glCallList(19457);",
                   "glGetError();", "glCallList(19458);"}));
}

TEST(DisplayLists, Split) {
  Case c;
  for (int i = 0; i < 8; ++i) c.Indexf(static_cast<float>(i));
  EXPECT_EQ(through(c, Lists::kSplit),
            (Lines{"glNewList(19456, GL_COMPILE);", "glIndexf(0.0f);", "glIndexf(1.0f);", "glIndexf(2.0f);",
                   "glEndList();", "glNewList(19457, GL_COMPILE);", "glIndexf(3.0f);", "glIndexf(4.0f);",
                   "glIndexf(5.0f);", "glEndList();", "glCallList(19456);", "glCallList(19457);",
                   "glIndexf(6.0f);", "glIndexf(7.0f);"}));
}

// A list that the case itself makes is not changed.
TEST(DisplayLists, ListsOfTheCase) {
  Case c;
  c.Indexf(1.0f);
  c.NewList(7, GL_COMPILE);
  c.Indexf(2.0f);
  c.EndList();
  c.CallList(7);
  EXPECT_EQ(through(c, Lists::kExecuted),
            (Lines{"glNewList(19456, GL_COMPILE_AND_EXECUTE);", "glIndexf(1.0f);", "glEndList();",
                   "glNewList(7, GL_COMPILE);", "glIndexf(2.0f);", "glEndList();", "glCallList(7);"}));
  EXPECT_EQ(through(c, Lists::kCompiled),
            (Lines{"glNewList(19456, GL_COMPILE);", "glIndexf(1.0f);", "glEndList();", "glCallList(19456);",
                   "glNewList(7, GL_COMPILE);", "glIndexf(2.0f);", "glEndList();", "glCallList(7);"}));
}

TEST(DisplayLists, PositionsLeadToTheCommands) {
  const Case c = mixed();
  for (const Lists lists :
       {Lists::kCompiled, Lists::kExecuted, Lists::kNested, Lists::kRepeated, Lists::kSplit}) {
    const DeliveredCase delivered = through_lists(c, lists);
    ASSERT_EQ(delivered.positions.size(), c.commands().size());
    for (std::size_t i = 0; i < c.commands().size(); ++i)
      EXPECT_EQ(to_c(delivered.script.commands()[static_cast<std::size_t>(delivered.positions[i])], 99),
                to_c(c.commands()[i], 99));
  }
}

// The executable specification emits the same for all forms of display lists.
TEST(DisplayLists, SameEmission) {
  Case c("maps, grids, primitives, meshes, queries and errors");
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, std::vector<float>{1, 2, 3, 4, 5, 6});
  c.Map1f(GL_MAP1_VERTEX_3, 0, 0, 3, 2, std::vector<float>{9, 9, 9, 9, 9, 9});
  c.Enable(GL_MAP1_VERTEX_3);
  c.GetError();
  c.Begin(GL_LINE_STRIP);
  c.EvalCoord1f(0.5f);
  c.Vertex2f(7, 8);
  c.End();
  c.MapGrid1f(2, 0, 1);
  c.EvalMesh1(GL_POINT, 0, 2);
  c.Color3f(1, 0, 0);
  c.Begin(GL_POINTS);
  c.EvalPoint1(1);
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 1, std::vector<float>{0, 0, 0});
  c.End();
  c.GetError();
  c.EvalMesh1(GL_LINE, 0, 1);
  const auto vertices = [](const Prediction& prediction) {
    std::vector<std::array<float, 2>> all;
    for (const reference::Primitive& primitive : prediction.primitives)
      for (const reference::Vertex& vertex : primitive.vertices)
        all.push_back({reference::rounded(vertex.position[0]), reference::rounded(vertex.color[1])});
    return all;
  };
  const auto expected = vertices(predict(c, 8));
  ASSERT_EQ(expected.size(), 8u);
  for (const Lists lists : {Lists::kCompiled, Lists::kExecuted, Lists::kNested, Lists::kSplit})
    EXPECT_EQ(vertices(predict(through_lists(c, lists).script, 8)), expected) << static_cast<int>(lists);
  EXPECT_EQ(vertices(predict(through_lists(c, Lists::kRepeated).script, 8)).size(), 16u);
}

TEST(DisplayLists, EveryWayIsADelivery) {
  for (const std::vector<Delivery>* deliveries :
       {&curve_deliveries(), &surface_deliveries(), &list_deliveries()})
    for (const Lists lists :
         {Lists::kNone, Lists::kCompiled, Lists::kExecuted, Lists::kNested, Lists::kRepeated, Lists::kSplit})
      EXPECT_TRUE(std::ranges::any_of(*deliveries,
                                      [&](const Delivery& delivery) { return delivery.lists == lists; }));
  for (const Delivery& delivery : without(kLists, curve_deliveries()))
    EXPECT_EQ(delivery.lists, Lists::kNone);
  for (const Delivery& delivery : without(kRepetition | kGrids, curve_deliveries())) {
    EXPECT_NE(delivery.lists, Lists::kRepeated);
    EXPECT_NE(delivery.evaluation, Delivery::Evaluation::kMesh);
    EXPECT_NE(delivery.evaluation, Delivery::Evaluation::kPoint);
  }
}

}  // namespace
}  // namespace evalcts::gl
