// Tests plots of failing cases: both sides have the same coordinates, and their size is limited.
#include "testkit/plot.h"

#include <gtest/gtest.h>

#include <evalcts/gl/case.h>

namespace evalcts {
namespace {

ObservedPrimitive plotted_primitive(GLenum mode, std::size_t vertices) {
  ObservedPrimitive primitive{mode, std::vector<ObservedVertex>(vertices)};
  for (std::size_t i = 0; i < vertices; ++i)
    primitive.vertices[i].position = {static_cast<float>(i), 1, 0, 2};
  return primitive;
}

TEST(Plot, HasBothSidesDividedByW) {
  gl::Case c;
  c.Begin(GL_LINE_STRIP);
  c.Vertex4f(1, 2, 3, 4);
  c.Vertex4f(0, 1, 0, 1);
  c.End();
  Observation observation;
  observation.primitives = {plotted_primitive(GL_LINES, 2)};
  const Plot plot = plot_of(predict(c, 8), observation);
  EXPECT_FALSE(plot.is_cut);
  EXPECT_EQ(plot.expected,
            (std::vector<PlottedPrimitive>{{"GL_LINE_STRIP", {{0.25f, 0.5f, 0.75f}, {0, 1, 0}}}}));
  EXPECT_EQ(plot.captured, (std::vector<PlottedPrimitive>{{"GL_LINES", {{0, 0.5f, 0}, {0.5f, 0.5f, 0}}}}));
}

TEST(Plot, HasOneSideIfNothingIsPredicted) {
  Observation observation;
  observation.primitives = {plotted_primitive(GL_POINTS, 1)};
  const Plot plot = plot_of(observation);
  EXPECT_FALSE(plot.expected);
  EXPECT_EQ(plot.captured, (std::vector<PlottedPrimitive>{{"GL_POINTS", {{0, 0.5f, 0}}}}));
}

TEST(Plot, IsCut) {
  Observation observation;
  observation.primitives = {plotted_primitive(GL_POINTS, 60), plotted_primitive(GL_POINTS, 60),
                            plotted_primitive(GL_POINTS, 60)};
  const Plot plot = plot_of({}, observation);
  EXPECT_TRUE(plot.is_cut);
  ASSERT_EQ(plot.captured.size(), 2u);
  EXPECT_EQ(plot.captured[1].positions.size(), Plot::kMostVertices - 60);
}

}  // namespace
}  // namespace evalcts
