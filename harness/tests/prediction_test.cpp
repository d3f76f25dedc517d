// Tests predictions of the output of a case, including saved state and called lists.
#include <gtest/gtest.h>

#include <algorithm>

#include <evalcts/judge/prediction.h>

namespace evalcts {
namespace {

std::vector<float> x_of(const Prediction& prediction) {
  std::vector<float> x;
  for (const reference::Primitive& primitive : prediction.primitives)
    for (const reference::Vertex& vertex : primitive.vertices)
      x.push_back(reference::rounded(vertex.position[0]));
  return x;
}

gl::Case with_a_line() {
  gl::Case c;
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, std::vector<float>{0, 0, 0, 8, 0, 0});
  c.Enable(GL_MAP1_VERTEX_3);
  return c;
}

TEST(Prediction, ExecutesListsWhenTheyAreCalled) {
  gl::Case c = with_a_line();
  c.NewList(1, GL_COMPILE);
  c.EvalCoord1f(0.5f);
  c.MatrixMode(GL_TEXTURE);  // the specification has no matrices
  c.EvalPoint1(1);
  c.EndList();
  c.MapGrid1f(4, 0, 1);
  c.Begin(GL_POINTS);
  c.CallList(1);
  c.CallLists(2, GL_UNSIGNED_BYTE, gl::array<GLubyte>({1, 9}));
  c.End();
  const Prediction prediction = predict(c, 8);
  EXPECT_EQ(x_of(prediction), (std::vector<float>{4, 2, 4, 2}));
  EXPECT_EQ(prediction.error, static_cast<GLenum>(GL_NO_ERROR));
}

TEST(Prediction, KnowsTheFirstErrorOfAList) {
  gl::Case c;
  c.NewList(1, GL_COMPILE);
  c.MapGrid1f(0, 0, 1);
  c.EvalMesh1(GL_FILL, 0, 1);
  c.EndList();
  EXPECT_EQ(predict(c, 8).error, static_cast<GLenum>(GL_NO_ERROR));
  c.CallList(1);
  EXPECT_EQ(predict(c, 8).error, static_cast<GLenum>(GL_INVALID_VALUE));
}

// Answers, errors and the number of primitives do not depend on the vertices.
TEST(Specified, IsTheSameWithoutVertices) {
  gl::Case c = with_a_line();
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.5f);
  c.Vertex3f(1, 2, 3);
  c.MapGrid1f(2, 0, 1);  // an error
  c.End();
  const gl::Ref error = c.GetError();
  c.EvalMesh1(GL_LINE, 0, 1);
  const gl::Ref grid = c.GetFloatv(GL_MAP1_GRID_DOMAIN, gl::out<GLfloat>(2));
  const Specified whole = specify(c, 8);
  const Specified without = specify(c, 8, {}, OtherState::kRejected, Emission::kLeftOut);
  EXPECT_EQ(whole.prediction.vertex_count(), 4u);
  EXPECT_EQ(without.prediction.vertex_count(), 0u);
  EXPECT_EQ(without.completed, whole.completed);
  EXPECT_EQ(without.inside, whole.inside);
  EXPECT_EQ(without.errors, whole.errors);
  EXPECT_EQ(without.error_answers, whole.error_answers);
  EXPECT_EQ(without.answers.error(error), static_cast<GLenum>(GL_INVALID_OPERATION));
  EXPECT_TRUE(without.answers.same(grid, whole.answers, grid));
}

TEST(Specified, SaysWhenPrimitivesAreOpenAndComplete) {
  gl::Case c = with_a_line();
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.5f);
  c.End();
  c.EvalMesh1(GL_POINT, 0, 1);
  const Specified specified = specify(c, 8);
  EXPECT_EQ(specified.inside, (std::vector<bool>{false, false, true, true, false, false}));
  EXPECT_EQ(specified.completed, (std::vector<std::size_t>{0, 0, 0, 0, 1, 2}));
  EXPECT_EQ(specified.prediction.primitives.size(), 2u);
}

TEST(Prediction, TakesNamesFromEarlierCommands) {
  gl::Case c = with_a_line();
  c.LoadIdentity();  // left out of the prediction, so that the positions of later commands change
  c.GenLists(3);
  const gl::Ref list = c.GenLists(1);
  c.LoadIdentity();
  c.NewList(list, GL_COMPILE);
  c.EvalMesh1(GL_POINT, 0, 1);
  c.EndList();
  c.CallList(1);
  EXPECT_EQ(predict(c, 8).primitives.size(), 0u);
  c.CallList(list);
  EXPECT_EQ(x_of(predict(c, 8)), (std::vector<float>{0, 8}));
}

TEST(Prediction, RestoresSavedState) {
  gl::Case c = with_a_line();
  c.PushAttrib(GL_EVAL_BIT);
  c.Disable(GL_MAP1_VERTEX_3);
  c.EvalMesh1(GL_POINT, 0, 1);
  c.PopAttrib();
  c.Flush();
  c.EvalMesh1(GL_POINT, 0, 1);
  c.Finish();
  const Prediction prediction = predict(c, 8);
  EXPECT_EQ(x_of(prediction), (std::vector<float>{0, 8}));
  EXPECT_EQ(prediction.error, static_cast<GLenum>(GL_NO_ERROR));
}

TEST(Prediction, KnowsThatFlushAndFinishAreNotForPrimitives) {
  for (const bool finish : {false, true}) {
    gl::Case c;
    c.Begin(GL_POINTS);
    finish ? c.Finish() : c.Flush();
    c.End();
    EXPECT_EQ(predict(c, 8).error, static_cast<GLenum>(GL_INVALID_OPERATION));
  }
}

// Cases that must not run in a no-error context, because they raise errors, which they query
// or leave pending.
TEST(Prediction, KnowsWhatMayRaiseAnError) {
  gl::Case legal("legal");
  legal.Enable(GL_MAP1_VERTEX_3);
  legal.PixelStorei(GL_PACK_ALIGNMENT, 1);  // ignored by the executable specification
  legal.Begin(GL_POINTS);
  legal.EvalCoord1f(0.5f);
  legal.End();
  legal.GetError();
  EXPECT_FALSE(may_raise_an_error(legal, 8));

  gl::Case asked = legal;
  asked.MapGrid1f(0, 0.0f, 1.0f);
  asked.GetError();
  EXPECT_TRUE(may_raise_an_error(asked, 8));

  gl::Case left = legal;
  left.EvalMesh1(GL_FILL, 0, 1);
  EXPECT_TRUE(may_raise_an_error(left, 8));

  gl::Case several = legal;
  several.OtherContextEVALCTS(1);
  EXPECT_TRUE(may_raise_an_error(several, 8));
}

// GL 2.1 section 2.5: an error is recorded until GetError returns it; a distributed implementation may record
// several. Section 2.6.3: between Begin and End, GetError is an error itself and returns 0.
TEST(Specified, SaysWhatGetErrorMayAnswer) {
  gl::Case c;
  c.GetError();  // 0
  c.EvalMesh1(GL_FILL, 0, 1);
  c.Enable(GL_MAP1_INDEX);
  c.GetError();  // 3
  c.GetError();
  c.EvalMesh1(GL_FILL, 0, 1);
  c.MapGrid1f(0, 0, 1);
  c.GetError();  // 7
  c.GetError();
  c.GetError();
  c.Begin(GL_POINTS);
  c.GetError();  // 11
  c.End();
  c.GetError();                                               // 13
  c.Map1f(GL_MAP2_INDEX, 0, 1, 1, 0, std::vector<float>{0});  // target and order
  c.GetError();                                               // 15
  const Specified specified = specify(c, 8);
  const auto answers = [&](std::size_t i) {
    std::vector<GLenum> sorted = specified.error_answers.at(i);
    std::ranges::sort(sorted);
    return sorted;
  };
  using Errors = std::vector<GLenum>;
  EXPECT_EQ(answers(0), Errors{GL_NO_ERROR});
  EXPECT_EQ(answers(1), Errors()) << "no GetError";
  EXPECT_EQ(answers(3), Errors{GL_INVALID_ENUM});
  EXPECT_EQ(answers(4), Errors{GL_NO_ERROR}) << "there was one error";
  EXPECT_EQ(answers(7), (Errors{GL_INVALID_ENUM, GL_INVALID_VALUE}));
  EXPECT_EQ(specified.error_answers[7].front(), static_cast<GLenum>(GL_INVALID_ENUM)) << "the first";
  EXPECT_EQ(answers(8), (Errors{GL_NO_ERROR, GL_INVALID_ENUM, GL_INVALID_VALUE})) << "may be recorded";
  EXPECT_EQ(answers(9), Errors{GL_NO_ERROR});
  EXPECT_EQ(answers(11), Errors{GL_NO_ERROR});
  EXPECT_EQ(answers(13), Errors{GL_INVALID_OPERATION});
  EXPECT_EQ(answers(15), (Errors{GL_INVALID_ENUM, GL_INVALID_VALUE})) << "either condition";
}

// A list that raises one error leaves one behind, one that raises two may leave two.
TEST(Specified, CountsTheErrorsOfLists) {
  for (const int times : {1, 2}) {
    gl::Case c;
    c.NewList(1, GL_COMPILE);
    for (int i = 0; i < times; ++i) c.MapGrid1f(0, 0, 1);
    c.EndList();
    c.CallList(1);
    c.GetError();
    const gl::Ref second = c.GetError();
    const std::vector<GLenum> answers =
        specify(c, 8).error_answers.at(static_cast<std::size_t>(second.index));
    EXPECT_EQ(answers.size(), static_cast<std::size_t>(times));
    EXPECT_EQ(answers.front(), static_cast<GLenum>(GL_NO_ERROR));
  }
}

TEST(Specified, PredictsNothingOfOtherCommands) {
  gl::Case c;
  c.Enable(GL_LIGHTING);
  const gl::ResultOf buffer{c.GenBuffers(1, gl::out<GLuint>(1)).index, 0};
  c.BindBuffer(GL_ARRAY_BUFFER, buffer);
  c.Map1f(GL_MAP1_VERTEX_ATTRIB0_4_NV, 0, 1, 4, 1, std::vector<float>(4));
  c.Enable(GL_MAP1_INDEX);
  const gl::Ref on = c.IsEnabled(GL_MAP1_INDEX), error = c.GetError();
  c.Map1f(GL_MAP1_VERTEX_ATTRIB0_4_NV, 0, 1, 4, 1, std::vector<float>(4));  // an unknown target
  const gl::Ref asked = c.GetError();
  const Specified specified = specify(c, 8, {}, OtherState::kSkipped);
  EXPECT_EQ(specified.known, (std::vector<bool>{false, false, false, false, true, true, true, true, true}));
  EXPECT_EQ(specified.answers.result(on), GL_TRUE);
  EXPECT_EQ(specified.error_answers.at(static_cast<std::size_t>(error.index)),
            std::vector<GLenum>{GL_NO_ERROR});
  EXPECT_EQ(specified.error_answers.at(static_cast<std::size_t>(asked.index)),
            std::vector<GLenum>{GL_INVALID_ENUM});
  EXPECT_EQ(only_specified(c).commands().size(), 5u);
  EXPECT_EQ(specify(c, 8).errors.front(), std::vector<GLenum>{GL_INVALID_ENUM}) << "other state is rejected";
}

}  // namespace
}  // namespace evalcts
