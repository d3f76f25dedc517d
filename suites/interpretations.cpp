// Sections 26 and 27 of the requirements: passages that have more than one reading. Each test records which
// one an implementation follows, and fails if it follows none of them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include <evalcts/testkit/registration.h>

#include "maps.h"

namespace evalcts::suite_interpretations {
namespace {

std::string shown(const std::vector<double>& values) {
  return fmt::format("{{{}}}", fmt::join(values, ", "));
}

// Returns the normal that a vertex shader receives, which is not normalised, at the centre of a square of
// side 2 in the plane z = 0, mapped over [u1,u2] x [0,1] with AUTO_NORMAL.
std::vector<double> normal_over(Test& t, double u1, double u2) {
  t.require(3, 0);
  Map plane = make_map2(GL_MAP2_VERTEX_3, 2, 2, {-1, -1, 0, -1, 1, 0, 1, -1, 0, 1, 1, 0});
  plane.u1 = u1;
  plane.u2 = u2;
  gl::Case c(fmt::format("a plane over [{}, {}] x [0, 1]", u1, u2));
  define(c, plane);
  c.Enable(GL_MAP2_VERTEX_3);
  c.Enable(GL_AUTO_NORMAL);
  c.Begin(GL_POINTS);
  c.EvalCoord2f(static_cast<float>((u1 + u2) / 2), 0.5f);
  c.End();
  const VaryingShader shader = {
      "#version 120\nvarying vec3 normal;\nvoid main() {\n  normal = gl_Normal;\n  gl_Position = "
      "gl_Vertex;\n}\n",
      {"normal"},
      3};
  const RecordedVaryings recorded = t.record_varyings(c, shader, 1);
  if (recorded.vertices != 1) throw NotObservable("the vertex shader does not see one vertex");
  return {recorded.values.begin(), recorded.values.end()};
}

// Records the reading whose values are those seen, to a relative error of `tolerance`; a failure if there is
// none.
void follow(Test& t, const std::string& text, const std::vector<double>& seen,
            const std::vector<std::pair<std::string, std::vector<double>>>& readings,
            double tolerance = 1e-3) {
  std::string expected;
  for (const auto& [reading, values] : readings) {
    bool alike = seen.size() == values.size();
    for (std::size_t i = 0; alike && i < values.size(); ++i)
      alike = std::abs(seen[i] - values[i]) <= tolerance * std::max(1.0, std::abs(values[i]));
    if (alike) return t.follows(text, reading);
    expected += (expected.empty() ? "" : " or ") + shown(values) + " (" + reading + ")";
  }
  Failure failure;
  failure.what = text;
  failure.expected = expected;
  failure.captured = shown(seen);
  failure.message = fmt::format("{}: {} matches no known reading", text, failure.captured);
  t.fail(std::move(failure));
}

// The same for readings that differ in the error that a command raises.
void follow_error(Test& t, const std::string& text, GLenum seen,
                  const std::vector<std::pair<std::string, GLenum>>& readings) {
  std::vector<std::pair<std::string, std::vector<double>>> values;
  for (const auto& [reading, error] : readings) values.push_back({reading, {static_cast<double>(error)}});
  follow(t, text, {static_cast<double>(seen)}, values, 0);
}

EVALCTS_TEST(Interpretations, IntegersOfColors, kInterpretation, "EV-GETMAP-ROUND/1-D")
(Test& t) {
  gl::Case c("GetMapiv of a colour");
  c.Map1f(GL_MAP1_COLOR_4, 0.0f, 1.0f, 4, 1, std::vector<float>{0.25f, 0.75f, -0.25f, 1});
  const gl::Ref query = c.GetMapiv(GL_MAP1_COLOR_4, GL_COEFF, gl::out<GLint>(4));
  const CheckedTrace checked = t.play(c);
  if (checked.trace().written(query) < 4) throw NotObservable("GetMapiv writes no colour");
  const std::vector<GLint> values = checked.trace().values<GLint>(query);
  constexpr double kMost = 2147483647.0;
  follow(t, "C-GETMAPIV-NORM", {values.begin(), values.begin() + 4},
         {{"rounded", {0, 1, 0, 1}}, {"scaled", {0.25 * kMost, 0.75 * kMost, -0.25 * kMost, kMost}}}, 1e-6);
};

EVALCTS_TEST(Interpretations, NegativeSize, kInterpretation, "EV-GETN-NEGATIVE")
(Test& t) {
  t.require(4, 5, "GL_ARB_robustness");
  gl::Case c("GetnMapfv of -1 bytes");
  c.GetnMapfv(GL_MAP1_VERTEX_3, GL_ORDER, -1, gl::out<GLfloat>(4));
  const gl::Ref error = c.GetError();
  follow_error(t, "C-V-GETN", t.play(c).trace().error(error),
               {{"INVALID_VALUE", GL_INVALID_VALUE}, {"INVALID_OPERATION", GL_INVALID_OPERATION}});
};

EVALCTS_TEST(Interpretations, NormalOverReversedDomain, kInterpretation, "EV-AUTON-CURVED")
(Test& t) {
  std::vector<double> normal = normal_over(t, 1, 0);
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  for (double& component : normal) component /= length;
  follow(t, "U-AUTON-REVSIGN", normal, {{"normalised", {0, 0, 1}}, {"domain", {0, 0, -1}}});
};

EVALCTS_TEST(Interpretations, LengthOfNormalOverLongDomain, kInterpretation, "EV-AUTON-SHADER")
(Test& t) {
  if (std::abs(normal_over(t, 0, 1)[2] - 4) > 1e-3)
    throw NotObservable("over [0,1] the length is not that of the cross product (EV-AUTON-SHADER)");
  const std::vector<double> normal = normal_over(t, 0, 2);
  follow(t, "U-AUTON-MAGN", normal, {{"normalised", {0, 0, 4}}, {"domain", {0, 0, 2}}});
};

EVALCTS_TEST(Interpretations, EndsThatDifferAsDoubles, kInterpretation, "EV-MAP1-ERR-DOMAIN")
(Test& t) {
  gl::Case c("Map1d over [1, 1 + 1e-12]");
  c.Map1d(GL_MAP1_VERTEX_3, 1.0, 1.0 + 1e-12, 3, 2, std::vector<double>{1, 2, 3, 4, 5, 6});
  const gl::Ref error = c.GetError();
  follow_error(t, "U-DOUBLE-CLOSE", t.play(c).trace().error(error),
               {{"error", GL_INVALID_VALUE}, {"accepted", GL_NO_ERROR}});
};

}  // namespace
}  // namespace evalcts::suite_interpretations
