// The control of a case that goes through display lists: the same case with explicit vertices.
#include <evalcts/testkit/list_control.h>

#include <gtest/gtest.h>

#include <algorithm>

#include <evalcts/gl/display_lists.h>
#include <evalcts/testkit/reproduction.h>
#include "synthetic_capture.h"

namespace evalcts {
namespace {

gl::Case evaluated(GLenum mode = GL_POINTS) {
  gl::Case c("a curve");
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, std::vector<float>{1, 2, 3, 4, 5, 6});
  c.Enable(GL_MAP1_VERTEX_3);
  c.Color4f(0.5f, 0.25f, 0, 1);
  c.Begin(mode);
  c.EvalCoord1f(0.5f);
  c.EvalCoord1f(1);
  c.End();
  return c;
}
gl::Case in_lists(GLenum mode = GL_POINTS) {
  return gl::through_lists(evaluated(mode), gl::Lists::compiled).script;
}

void lose_positions(Observation& seen, const gl::Case&) { seen.primitives[0].vertices[1].position[0] = 99; }
void lose_colors(Observation& seen, const gl::Case&) { seen.primitives[0].vertices[1].color = {}; }

class ListControlTest : public testing::Test {
 protected:
  // The number of controls that are played when the case, which was judged by these attributes, has failed
  // twice.
  int controls(const gl::Case& script, const SyntheticCapture& capture, Attributes judged = kAllAttributes) {
    lists_.set_observed(script, capture, judged);
    lists_.require_explicit_vertices();
    lists_.require_explicit_vertices();
    return capture.observations;
  }

  static CaptureTraits traits() { return {.attributes = kPosition | kColor}; }

  WithoutContexts implementation_;
  Subject subject_{.implementation = &implementation_};
  ListControl lists_{subject_};
};

TEST_F(ListControlTest, ListsThatKeepExplicitVerticesAreNotTheCause) {
  EXPECT_EQ(controls(in_lists(), SyntheticCapture(traits())), 1);
}

TEST_F(ListControlTest, ListsThatLoseExplicitVerticesAre) {
  const SyntheticCapture capture(traits(), lose_positions);
  try {
    controls(in_lists(), capture);
    FAIL();
  } catch (const NotObservable& reason) {
    EXPECT_TRUE(std::string(reason.what())
                    .starts_with("pipeline: in display lists explicit vertices go wrong, too: position.x of "
                                 "vertex 1 "))
        << reason.what();
  }
  // Known now: what fails next is not asked about again.
  EXPECT_NO_THROW(lists_.require_explicit_vertices());
}

TEST_F(ListControlTest, AttributesThatAreNotJudgedDoNotMatterButPositionsAlwaysDo) {
  const SyntheticCapture without_color(traits(), lose_colors), out_of_place(traits(), lose_positions);
  EXPECT_EQ(controls(in_lists(), without_color, kPosition), 1);
  EXPECT_THROW(controls(in_lists(), without_color, kColor), NotObservable);
  EXPECT_THROW(controls(in_lists(), out_of_place, kColor), NotObservable);
}

TEST_F(ListControlTest, CasesWithoutListsHaveNoControl) {
  EXPECT_EQ(controls(evaluated(), SyntheticCapture(traits(), lose_positions)), 0);
}

TEST_F(ListControlTest, ReproductionsHaveNoControl) {
  Reproduction reproduction(implementation_, "");
  subject_.reproduction = &reproduction;
  EXPECT_EQ(controls(in_lists(), SyntheticCapture(traits(), lose_positions)), 0);
}

TEST_F(ListControlTest, ANewCaseForgetsTheOneBefore) {
  const SyntheticCapture capture(traits(), lose_positions);
  lists_.set_observed(in_lists(), capture, kPosition);
  lists_.clear();
  EXPECT_NO_THROW(lists_.require_explicit_vertices());
  EXPECT_EQ(capture.observations, 0);
}

TEST_F(ListControlTest, PrimitivesThatTheCaptureDoesNotTakeHaveNoControl) {
  CaptureTraits points_only = traits();
  points_only.takes = kPoints;
  const SyntheticCapture capture(points_only, lose_positions);
  EXPECT_EQ(controls(in_lists(GL_LINES), capture), 0);
  EXPECT_EQ(lists_.lost_attributes(evaluated(GL_LINES), capture), 0u);
}

TEST_F(ListControlTest, LinesAreTakenApartAsTheCaptureDoesIt) {
  const SyntheticCapture backwards(traits(), [](Observation& seen, const gl::Case&) {
    for (ObservedPrimitive& primitive : seen.primitives) std::ranges::reverse(primitive.vertices);
  });
  EXPECT_EQ(controls(in_lists(GL_LINES), backwards), 2);  // with the explicit primitives
}

TEST_F(ListControlTest, LostAttributesAreThoseOfExplicitVertices) {
  EXPECT_EQ(lists_.lost_attributes(evaluated(), SyntheticCapture(traits())), 0u);
  EXPECT_EQ(lists_.lost_attributes(evaluated(), SyntheticCapture(traits(), lose_colors)),
            static_cast<Attributes>(kColor));
  EXPECT_EQ(lists_.lost_attributes(evaluated(), SyntheticCapture({}, lose_colors)), 0u);  // not shown
}

}  // namespace
}  // namespace evalcts
