// Tests that cases are recorded and run correctly, on a table of functions written for this test.
#include <gtest/gtest.h>

#include <cfenv>

#include <evalcts/gl/player.h>

namespace evalcts::gl {
namespace {

const GLfloat* seen_points = nullptr;
std::vector<GLfloat> read_points;
GLenum seen_target = 0;
int errors_left = 0;
GLuint seen_program = 0;

void fake_map1f(GLenum target, GLfloat, GLfloat, GLint stride, GLint order, const GLfloat* points) {
  seen_target = target;
  seen_points = points;
  read_points.assign(points, points + stride * order);
}
void fake_get_mapfv(GLenum, GLenum, GLfloat* values) {
  values[0] = 1;
  values[1] = 2;
}
GLenum fake_get_error() { return errors_left-- > 0 ? GL_INVALID_VALUE : GL_NO_ERROR; }
GLuint fake_create_program() { return 42; }
void fake_use_program(GLuint program) { seen_program = program; }
void fake_begin(GLenum) {}

Table table() {
  Table table;
  table.Map1f = fake_map1f;
  table.GetMapfv = fake_get_mapfv;
  table.GetError = fake_get_error;
  table.CreateProgram = fake_create_program;
  table.UseProgram = fake_use_program;
  table.Begin = fake_begin;
  errors_left = 0;
  return table;
}

const std::vector<GLfloat> kPoints = {1, 2, 3, 4};

TEST(Case, PassesArgumentsAndCopiesOfArrays) {
  Case c;
  std::vector<GLfloat> points = kPoints;
  c.Map1f(GL_MAP1_INDEX, 0, 1, 2, 2, points);
  points.assign(4, -1);  // the case has its own copy
  play(c, table());
  EXPECT_EQ(seen_target, static_cast<GLenum>(GL_MAP1_INDEX));
  EXPECT_EQ(read_points, kPoints);
}

// The judge must not be affected if a library changes the floating-point environment.
TEST(Case, LeavesTheUsualArithmetic) {
  Table disturbing = table();
  disturbing.Begin = [](GLenum) { std::fesetround(FE_UPWARD); };
  Case c;
  c.Begin(GL_POINTS);
  play(c, disturbing);
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

TEST(Case, ArraysEndBeforeAnInaccessiblePage) {
  Case c;
  c.Map1f(GL_MAP1_INDEX, 0, 1, 5, 1, kPoints);  // reads five of four values
  EXPECT_DEATH(play(c, table()), "");
}

using CaseDeathTest = testing::TestWithParam<AfterCall>;

// Reads the points of an earlier call, as a library does that keeps the pointer instead of copying.
void late_reader(GLfloat) { read_points.assign(seen_points, seen_points + 4); }

Case read_later(AfterCall after) {
  Case c;
  c.Map1f(GL_MAP1_INDEX, 0, 1, 2, 2, array(kPoints, after));
  c.EvalCoord1f(0);
  return c;
}

TEST_P(CaseDeathTest, ReadingAfterTheCallCrashes) {
  Table reader = table();
  reader.EvalCoord1f = late_reader;
  EXPECT_DEATH(play(read_later(GetParam()), reader), "");
}
INSTANTIATE_TEST_SUITE_P(AfterCalls, CaseDeathTest, testing::Values(AfterCall::kUnmap, AfterCall::kProtect),
                         [](const auto& after_call) {
                           return after_call.param == AfterCall::kUnmap ? "unmap" : "protect";
                         });

TEST(Case, OverwrittenArraysHoldOtherValuesAfterTheCall) {
  Table reader = table();
  reader.EvalCoord1f = late_reader;
  play(read_later(AfterCall::kOverwrite), reader);
  for (std::size_t i = 0; i < kPoints.size(); ++i) EXPECT_NE(read_points[i], kPoints[i]);
  play(read_later(AfterCall::kKeep), reader);
  EXPECT_EQ(read_points, kPoints);
}

TEST(Case, ArraysOfOneSlotAreTheSameMemoryWithNewContents) {
  Case c;
  for (const float value : {1.0f, 2.0f}) {
    Input input = array({value, value, value, value});
    input.slot = 0;
    c.Map1f(GL_MAP1_INDEX, 0, 1, 2, 2, input);
  }
  static std::vector<std::pair<const GLfloat*, GLfloat>> seen;
  seen.clear();
  Table noting = table();
  noting.Map1f = [](GLenum, GLfloat, GLfloat, GLint, GLint, const GLfloat* points) {
    seen.emplace_back(points, points[0]);
  };
  play(c, noting);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].first, seen[1].first);
  EXPECT_EQ(seen[0].second, 1.0f);
  EXPECT_EQ(seen[1].second, 2.0f);
}

TEST(Case, QueriesFillArraysAndShowHowMuchTheyWrote) {
  Case c;
  const Ref roomy = c.GetMapfv(GL_MAP1_INDEX, GL_DOMAIN, out<GLfloat>(4));
  const Ref narrow = c.GetMapfv(GL_MAP1_INDEX, GL_DOMAIN, out<GLfloat>(1));
  const Trace trace = play(c, table());
  EXPECT_EQ(trace.written(roomy), 2u);
  EXPECT_EQ(trace.values<GLfloat>(roomy)[1], 2.0f);
  EXPECT_EQ(trace.written(narrow), 2u);  // the write past the end of the array shows in the guard elements
  EXPECT_TRUE(trace.same(roomy, trace, roomy));
  EXPECT_FALSE(trace.same(roomy, trace, narrow));
}

TEST(Case, LaterCommandsUseEarlierResultsAlsoBehindAPrologue) {
  Case inner;
  const Ref program = inner.CreateProgram();
  inner.UseProgram(program);
  Case outer;
  outer.GetError();
  EXPECT_EQ(outer.append(inner), 1);
  seen_program = 0;
  play(outer, table());
  EXPECT_EQ(seen_program, 42u);
}

TEST(Case, LeftOverErrorsAreDrainedWithABound) {
  Table erring = table();
  errors_left = 2;
  EXPECT_EQ(play(Case(), erring).left_over_errors().size(), 2u);
  errors_left = 1000000;
  EXPECT_LE(play(Case(), erring).left_over_errors().size(), 16u);
}

TEST(Case, MissingEntryPointsAreSeenBeforeAnythingIsIssued) {
  Case c;
  c.Map1f(GL_MAP1_INDEX, 0, 1, 2, 2, kPoints);
  c.EvalMesh1(GL_LINE, 0, 1);
  seen_target = 0;
  EXPECT_THROW(play(c, table()), MissingEntryPoint);
  EXPECT_EQ(seen_target, 0u);
}

}  // namespace
}  // namespace evalcts::gl
