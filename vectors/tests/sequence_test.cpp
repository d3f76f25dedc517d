// Tests the JSON of sequences.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "write/problem.h"
#include "write/sequences.h"

namespace evalcts::vectors {
namespace {

constexpr std::size_t kLong = 1'000'000;

Json sequence_of(const gl::Case& c) { return sequence(cut_off(c, kLong)); }
Json steps(const gl::Case& c) { return sequence_of(c)["steps"]; }

TEST(Sequence, NamesCommandsAndArguments) {
  gl::Case c;
  c.Map1f(GL_MAP1_INDEX, 0, 0.5f, 1, 2, std::vector<GLfloat>{-0.0f, 3});
  c.PushAttrib(GL_EVAL_BIT | GL_CURRENT_BIT);
  c.PopAttrib();
  c.Begin(GL_POINTS);
  c.End();
  const Json all = steps(c);
  EXPECT_EQ(
      all[0].dump(),
      R"({"call":["Map1f","GL_MAP1_INDEX","0x0p+0","0x1p-1",1,2,{"f32":["-0x0p+0","0x1.8p+1"]}],"errors":[]})");
  EXPECT_EQ(all[1].dump(), R"({"call":["PushAttrib","GL_CURRENT_BIT|GL_EVAL_BIT"],"errors":[]})");
  EXPECT_EQ(all[3].dump(), R"({"call":["Begin","GL_POINTS"]})");
  EXPECT_EQ(all[4].dump(), R"({"call":["End"],"errors":[],"emits":[]})");
}

TEST(Sequence, GivesErrorsBetweenBeginAndEndToTheEnd) {
  gl::Case c;
  c.Begin(GL_POINTS);
  c.MapGrid1f(0, 0, 1);
  c.EvalMesh1(GL_FILL, 0, 1);
  c.End();
  c.MapGrid1f(0, 0, 1);
  c.GetError();  // a reader asks for errors after each step
  const Json all = steps(c);
  ASSERT_EQ(all.size(), 5u);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(all[i].contains("errors"));
  EXPECT_EQ(all[3]["errors"], Json({"GL_INVALID_OPERATION", "GL_INVALID_VALUE", "GL_INVALID_ENUM"}));
  EXPECT_EQ(all[4]["errors"], Json::array({"GL_INVALID_VALUE"}));
}

Json answer(const Values& points, int form) {
  gl::Case c;
  c.Map1d(GL_MAP1_INDEX, 0, 1, 1, static_cast<int>(points.size()), points);
  if (form == 0) c.GetMapfv(GL_MAP1_INDEX, GL_COEFF, gl::out<GLfloat>(9));
  if (form == 1) c.GetMapdv(GL_MAP1_INDEX, GL_COEFF, gl::out<GLdouble>(9));
  if (form == 2) c.GetMapiv(GL_MAP1_INDEX, GL_COEFF, gl::out<GLint>(9));
  return steps(c)[1]["answers"];
}

TEST(Sequence, AcceptsEitherIntegerForAHalf) {
  EXPECT_EQ(answer({0.5, -0.5, 2.5, 1.25, -7.75}, 2).dump(), "[[0,1],[-1,0],[2,3],[1],[-8]]");
  EXPECT_EQ(answer({1e20, -1e20, 0x1p31 - 0.5, 2147483647}, 2).dump(),
            "[[2147483647],[-2147483648],[2147483647],[2147483647]]");
}

TEST(Sequence, AcceptsBothFloatsBesideADouble) {
  EXPECT_EQ(answer({0.5, -0.0, 0.1}, 0).dump(),
            R"([["0x1p-1"],["-0x0p+0"],["0x1.999998p-4","0x1.99999ap-4"]])");
  EXPECT_EQ(answer({0.5, 0.1}, 1).dump(),
            R"([["0x1p-1"],["0x1.999998p-4","0x1.999999999999ap-4","0x1.99999ap-4"]])");
  EXPECT_THROW(answer({1e300}, 0), HasNoForm);
}

TEST(Sequence, AnswersNothingWhereTheQueryIsRefused) {
  gl::Case c;
  c.GetMapfv(GL_TEXTURE_2D, GL_COEFF, gl::out<GLfloat>(4));
  c.IsEnabled(GL_MAP1_INDEX);
  const Json all = steps(c);
  EXPECT_EQ(all[0]["answers"], Json::array());
  EXPECT_EQ(all[1]["answers"], Json::array({Json::array({0})}));
  gl::Case d;
  d.Begin(GL_POINTS);
  d.IsEnabled(GL_MAP1_INDEX);
  d.End();
  EXPECT_EQ(steps(d)[1]["answers"], Json::array());
}

// Returns {level, since, names of the commands whose step has a level}.
Json standing(const gl::Case& c) {
  const Json found = sequence_of(c);
  Json list = Json::array({found["level"], found["since"]});
  for (const Json& step : found["steps"])
    if (step.contains("level")) list.push_back(step["call"][0]);
  return list;
}

void define_texture(gl::Case& c, double u2, GLfloat size) {
  c.Map1f(GL_MAP1_TEXTURE_COORD_1, 0, static_cast<GLfloat>(u2), 1, 2, std::vector<GLfloat>{size, size});
}

TEST(Sequence, SaysWhatIsAdvisoryAndSinceWhen) {
  const Json plain = {"must", "1.0"};
  gl::Case c;
  define_texture(c, 1, 5000);
  c.GetMapfv(GL_MAP1_TEXTURE_COORD_1, GL_COEFF, gl::out<GLfloat>(2));
  c.GetMapfv(GL_MAP1_TEXTURE_COORD_1, GL_DOMAIN, gl::out<GLfloat>(2));
  EXPECT_EQ(standing(c), plain);
  c.Enable(GL_MAP1_TEXTURE_COORD_1);
  c.Enable(GL_MAP1_VERTEX_3);
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.5f);
  c.End();
  EXPECT_EQ(standing(c), Json({"must", "2.0"}));

  gl::Case zeros;
  define_texture(zeros, -0.0, 1);
  zeros.IsEnabled(GL_MAP1_INDEX);
  EXPECT_EQ(standing(zeros), Json({"advisory", "1.0"}));

  gl::Case initial;
  initial.GetMapiv(GL_MAP1_VERTEX_3, GL_DOMAIN, gl::out<GLint>(2));
  EXPECT_EQ(standing(initial), Json({"must", "1.0", "GetMapiv"}));
  initial.GetMapfv(GL_MAP2_TEXTURE_COORD_1, GL_COEFF, gl::out<GLfloat>(1));
  EXPECT_EQ(standing(initial), Json({"must", "1.1", "GetMapiv"}));

  // A display list defines its map when it is called.
  gl::Case list;
  list.NewList(1, GL_COMPILE);
  define_texture(list, 1, 1);
  list.EndList();
  list.GetMapfv(GL_MAP1_TEXTURE_COORD_1, GL_DOMAIN, gl::out<GLfloat>(2));
  list.CallList(1);
  EXPECT_EQ(standing(list), Json({"must", "1.0", "GetMapfv"}));
  list.GetMapdv(GL_MAP1_TEXTURE_COORD_1, GL_DOMAIN, gl::out<GLdouble>(2));
  EXPECT_EQ(standing(list), Json({"must", "1.0", "GetMapfv"}));

  gl::Case push;
  push.IsEnabled(GL_MAP1_INDEX);
  push.PushAttrib(GL_ENABLE_BIT);
  push.PopAttrib();
  EXPECT_EQ(standing(push), plain);
  push.IsEnabled(GL_AUTO_NORMAL);
  EXPECT_EQ(standing(push), Json({"must", "1.1"}));
  push.ActiveTexture(GL_TEXTURE0);
  EXPECT_EQ(standing(push), Json({"must", "1.3"}));
  push.GetnMapfv(GL_MAP1_INDEX, GL_ORDER, 4, gl::out<GLfloat>(1));
  EXPECT_EQ(standing(push), Json({"must", "4.5"}));
}

TEST(Sequence, KnowsThatDoublesHoldGridCounts) {
  gl::Case c;
  c.MapGrid1f(2147483647, 0, 1);
  c.GetFloatv(GL_MAP1_GRID_SEGMENTS, gl::out<GLfloat>(1));
  c.GetDoublev(GL_MAP1_GRID_SEGMENTS, gl::out<GLdouble>(1));
  const Json all = steps(c);
  EXPECT_EQ(all[1]["answers"].dump(), R"([["0x1.fffffep+30","0x1p+31"]])");
  EXPECT_EQ(all[2]["answers"].dump(), R"([["0x1.fffffffcp+30"]])");
}

TEST(Sequence, EmitsWhatIsCompleted) {
  gl::Case c;
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, std::vector<GLfloat>{0, 0, 0, 1, 2, 3});
  c.Enable(GL_MAP1_VERTEX_3);
  c.Begin(GL_LINES);
  c.EvalCoord1f(0.5f);
  c.Vertex2f(4, 5);
  c.End();
  c.EvalMesh1(GL_POINT, 1, 0);
  c.Color3f(1, 1, 1);  // so that vertices have a colour
  const Json all = steps(c);
  const Json vertices = all[5]["emits"][0]["vertices"];
  EXPECT_EQ(as_text(all[5]["emits"][0]["mode"]), "GL_LINES");
  EXPECT_EQ(as_text(vertices[0]["position"][1]["exact"]), "1/1");
  EXPECT_EQ(as_text(vertices[0]["position"][3]), "0x1p+0");
  EXPECT_EQ(vertices[1]["position"], Json({"0x1p+2", "0x1.4p+2", "0x0p+0", "0x1p+0"}));
  EXPECT_EQ(vertices[1]["color"], Json({"0x1p+0", "0x1p+0", "0x1p+0", "0x1p+0"}));
  EXPECT_FALSE(vertices[0].contains("normal"));
  EXPECT_EQ(all[6]["emits"], Json::array());
}

TEST(Sequence, SummarisesManyVertices) {
  gl::Case c;
  c.Map1f(GL_MAP1_VERTEX_3, 0, 64, 3, 2, std::vector<GLfloat>{0, 0, 0, 64, 0, 0});
  c.Enable(GL_MAP1_VERTEX_3);
  c.MapGrid1f(64, 0, 64);
  c.EvalMesh1(GL_LINE, 1, 20);
  c.EvalMesh1(GL_LINE, 0, 64);
  c.EvalMesh1(GL_POINT, 2, 6);
  const Json all = steps(c);
  EXPECT_EQ(all[3]["emits"][0]["vertices"].size(), 20u);
  const auto numbers_of = [](const Json& emits) {
    std::vector<int> numbers;
    for (const Json& sample : emits["samples"]) {
      numbers.push_back(sample["number"]);
      EXPECT_EQ(as_text(sample["vertex"]["position"][0]["exact"]),
                fmt::format("{}/1", numbers.back() + (emits["primitives"][0][1] == 5 ? 2 : 0)));
    }
    return numbers;
  };
  const Json &many = all[4]["emits"], &few = all[5]["emits"];
  EXPECT_EQ(many["primitives"].dump(), R"([["GL_LINE_STRIP",65,1]])");
  EXPECT_EQ(numbers_of(many), (std::vector<int>{0, 17, 34, 48, 64}));
  EXPECT_EQ(few["primitives"].dump(), R"([["GL_POINTS",5,1]])");
  EXPECT_EQ(numbers_of(few), (std::vector<int>{0, 4}));
  // The digest depends on every vertex.
  c.Map1f(GL_MAP1_VERTEX_3, 0, 64, 3, 2, std::vector<GLfloat>{0, 0, 0, 64, 0x1p-149f, 0});
  c.EvalMesh1(GL_LINE, 0, 64);
  EXPECT_NE(as_text(steps(c)[7]["emits"]["digest"]), as_text(many["digest"]));
}

TEST(Sequence, HasTheCommandsOfEvaluatorsOnly) {
  gl::Case c;
  c.Enable(GL_LIGHTING);
  c.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  c.IsEnabled(GL_MAP1_INDEX);
  const Json all = steps(c);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(as_text(all[0]["call"][0]), "IsEnabled");
}

// A case ends outside of primitives and lists, and before what has no form.
TEST(Sequence, IsCutOffWhereItMayEnd) {
  const auto size_with = [](const std::function<void(gl::Case&)>& more, std::size_t most = kLong) {
    gl::Case c;
    c.IsEnabled(GL_MAP1_INDEX);
    more(c);
    return sequence(cut_off(c, most))["steps"].size();
  };
  const auto long_end = [](gl::Case& c) {
    for (int i = 0; i < 100; ++i) c.MapGrid1f(2, 0, 1);
  };
  EXPECT_EQ(size_with([](gl::Case& c) { c.MapGrid1f(2, 0, 1); }), 2u);
  EXPECT_EQ(size_with([](gl::Case& c) { c.Begin(GL_POINTS); }), 1u);
  EXPECT_EQ(size_with([](gl::Case& c) {
              c.NewList(1, GL_COMPILE);
              c.MapGrid1f(2, 0, 1);
            }),
            1u);
  EXPECT_EQ(size_with([](gl::Case& c) {
              c.NewList(1, GL_COMPILE);
              c.EndList();
            }),
            3u);
  EXPECT_EQ(size_with([](gl::Case& c) { c.ActiveTexture(GL_TEXTURE7); }), 2u);
  EXPECT_EQ(size_with([](gl::Case& c) { c.ActiveTexture(GL_TEXTURE7 + 1); }), 1u);
  EXPECT_EQ(size_with([](gl::Case& c) { c.OtherContextEVALCTS(1); }), 1u);
  EXPECT_EQ(size_with(long_end), 101u);
  EXPECT_LT(size_with(long_end, 10), 60u);
  gl::Case open;
  open.Begin(GL_POINTS);
  open.IsEnabled(GL_MAP1_INDEX);
  EXPECT_THROW(steps(open), HasNoForm);
}

// A case does not end before the first error, vertex and call of a list that it has.
TEST(Sequence, ShowsWhatTheCaseIsAbout) {
  const auto kept = [](const std::function<void(gl::Case&)>& last) {
    gl::Case c;
    c.Enable(GL_MAP1_VERTEX_3);
    c.IsEnabled(GL_MAP1_INDEX);
    for (int i = 0; i < 100; ++i) c.MapGrid1f(2, 0, 1);
    last(c);
    return sequence(cut_off(c, 10))["steps"].size();
  };
  EXPECT_EQ(kept([](gl::Case& c) { c.MapGrid1f(0, 0, 1); }), 103u);
  EXPECT_EQ(kept([](gl::Case& c) { c.EvalMesh1(GL_POINT, 0, 1); }), 103u);
  EXPECT_EQ(kept([](gl::Case& c) { c.CallList(7); }), 103u);
}

}  // namespace
}  // namespace evalcts::vectors
