// Deliveries replace commands one for one and leave everything else as it was written.
#include <gtest/gtest.h>

#include "harness/gl/call_log.h"
#include "harness/gl/delivery.h"

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
      {"glMap1f(GL_MAP1_INDEX, 0x1p-1f, 2.0f, 1, 2, (GLfloat[]){3.0f, 0x1p-2f});",
       "glEvalCoord1f(0x1.99999ap-4f);", "glColor3f(1.0f, 0.0f, 0.0f);"},
      {"glMap1f(GL_MAP1_INDEX, 0x1p-1f, 2.0f, 1, 2, (GLfloat[]){3.0f, 0x1p-2f});",
       "glEvalCoord1fv((GLfloat[]){0x1.99999ap-4f});", "glColor3f(1.0f, 0.0f, 0.0f);"},
      {"glMap1d(GL_MAP1_INDEX, 0x1p-1, 2.0, 1, 2, (GLdouble[]){3.0, 0x1p-2});",
       "glEvalCoord1d(0x1.99999ap-4);", "glColor3f(1.0f, 0.0f, 0.0f);"},
      {"glMap1d(GL_MAP1_INDEX, 0x1p-1, 2.0, 1, 2, (GLdouble[]){3.0, 0x1p-2});",
       "glEvalCoord1dv((GLdouble[]){0x1.99999ap-4});", "glColor3f(1.0f, 0.0f, 0.0f);"}};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(delivered(c, i), expected[i]) << curve_deliveries()[i].name;
}

// Also from what is not written in the f form, and with the fate of the points.
TEST(Delivery, WorksFromEveryForm) {
  Case c;
  c.Map1d(GL_MAP1_INDEX, 0.0, 1.0, 1, 1, array({1.0 / 3}, AfterCall::protect));
  c.EvalCoord1dv(std::vector<double>{0.5});
  c.EvalCoord1fv(std::vector<float>{0.5f});
  const std::vector<std::string> single = delivered(c, 0);
  EXPECT_EQ(single[0],
            "glMap1f(GL_MAP1_INDEX, 0.0f, 1.0f, 1, 1, (GLfloat[]){0x1.555556p-2f} "
            "/* protected after the call */);");
  EXPECT_EQ(single[1], "glEvalCoord1f(0x1p-1f);");
  EXPECT_EQ(single[2], "glEvalCoord1f(0x1p-1f);");
  EXPECT_EQ(delivered(c, 3)[1], "glEvalCoord1dv((GLdouble[]){0x1p-1});");
}

TEST(Delivery, NullPointsStayNull) {
  Case c;
  c.Map1f(GL_MAP1_INDEX, 0.0f, 1.0f, 1, 1, nullptr);
  EXPECT_EQ(delivered(c, 2)[0], "glMap1d(GL_MAP1_INDEX, 0.0, 1.0, 1, 1, NULL);");
}

}  // namespace
}  // namespace evalcts::gl
