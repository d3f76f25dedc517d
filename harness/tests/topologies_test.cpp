// Tests that the topologies of captures, by which they split primitives, are learned from explicit vertices
// and kept.
#include <evalcts/testkit/topologies.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>

#include "synthetic_capture.h"

namespace evalcts {
namespace {

Prediction predicted(std::initializer_list<std::pair<GLenum, int>> primitives) {
  gl::Case c;
  for (const auto& [mode, vertices] : primitives) {
    c.Begin(mode);
    for (int i = 0; i < vertices; ++i) c.Vertex2f(static_cast<float>(i), 0.5f);
    c.End();
  }
  return predict(c, 8);
}

class TopologiesTest : public testing::Test {
 protected:
  Topology find(const Prediction& prediction, const Capture& capture) {
    return topologies_.find(prediction, capture, implementation_);
  }

 private:
  WithoutContexts implementation_;
  Topologies topologies_;
};

// Reverses the vertices of each primitive, as a library does that draws backwards.
void reverse(Observation& observation, const gl::Case&) {
  for (ObservedPrimitive& primitive : observation.primitives) std::ranges::reverse(primitive.vertices);
}

TEST_F(TopologiesTest, PointsNeedNoObservation) {
  const SyntheticCapture capture({});
  EXPECT_EQ(find(predicted({{GL_POINTS, 3}}), capture).vertices, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(capture.observations, 0);
}

TEST_F(TopologiesTest, TheOrderOfExplicitVerticesIsLearned) {
  const SyntheticCapture capture({.attributes = kPosition | kColor | kTextureCoordinate0}, reverse);
  const Topology topology = find(predicted({{GL_LINES, 2}, {GL_LINE_STRIP, 3}}), capture);
  EXPECT_EQ(topology.vertices, (std::vector<std::size_t>{1, 0, 4, 3, 2}));
  EXPECT_EQ(topology.shape, (Shape{{GL_LINES, 2}, {GL_LINE_STRIP, 3}}));
  EXPECT_EQ(capture.last_request.attributes, kPosition);
  EXPECT_EQ(capture.last_request.kinds, kLines);
  EXPECT_EQ(capture.last_request.most_vertices, 10u);
}

TEST_F(TopologiesTest, TextureCoordinatesNumberTheVerticesWherePositionsDoNotShow) {
  const SyntheticCapture capture({.attributes = kTextureCoordinate0}, reverse);
  EXPECT_EQ(find(predicted({{GL_LINE_STRIP, 3}}), capture).vertices, (std::vector<std::size_t>{2, 1, 0}));
}

TEST_F(TopologiesTest, EachCaptureAndShapeIsObservedOnce) {
  const SyntheticCapture whole({.name = "whole"}), backwards({.name = "backwards"}, reverse);
  const Prediction strip = predicted({{GL_LINE_STRIP, 3}}), loop = predicted({{GL_LINE_LOOP, 3}}),
                   longer = predicted({{GL_LINE_STRIP, 4}});
  const std::vector<std::size_t> forth = {0, 1, 2}, back = {2, 1, 0};
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(find(strip, whole).vertices, forth);
    EXPECT_EQ(find(loop, whole).vertices, forth);
    EXPECT_EQ(find(longer, whole).vertices.size(), 4u);
    EXPECT_EQ(find(strip, backwards).vertices, back);
  }
  EXPECT_EQ(whole.observations, 3);
  EXPECT_EQ(backwards.observations, 1);
}

TEST_F(TopologiesTest, ExplicitVerticesThatAreLostMakeTheCaseNotObservable) {
  const SyntheticCapture losing({}, [](Observation& seen, const gl::Case&) { seen.primitives.clear(); });
  const SyntheticCapture failing({},
                                 [](Observation& seen, const gl::Case&) { seen.error = GL_INVALID_ENUM; });
  for (int i = 0; i < 2; ++i) {
    EXPECT_THROW(find(predicted({{GL_LINES, 2}}), losing), NotObservable);
    EXPECT_THROW(find(predicted({{GL_LINES, 2}}), failing), NotObservable);
  }
  EXPECT_EQ(losing.observations, 2);  // the failed attempt was not kept
  EXPECT_EQ(failing.observations, 2);
}

}  // namespace
}  // namespace evalcts
