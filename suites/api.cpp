// Section 1 of the requirements: entry points, tokens by value, and the forms of a command.
#include <fmt/format.h>

#include <cstring>
#include <functional>
#include <span>

#include <evalcts/gl/hexadecimal.h>
#include <evalcts/gl/lift.h>
#include <evalcts/testkit/registration.h>
#include "dimensions.h"
#include "maps.h"

namespace evalcts::suite_api {
namespace {

// A legal call of a command, with Begin and End around it if it needs them.
struct LegalCall {
  const char* name;
  void (*call)(gl::Case&);
};

const std::vector<float> kPoints = {0, 0, 0, 1, 1, 1};
const std::vector<double> kRealPoints = {0, 0, 0, 1, 1, 1};

void in_begin_end(gl::Case& c, bool two, const std::function<void()>& call) {
  if (two) {
    c.Map2f(GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 1, kPoints);
  } else {
    c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, kPoints);
  }
  c.Enable(target_in(two, GL_MAP1_VERTEX_3));
  c.Begin(GL_POINTS);
  call();
  c.End();
}

constexpr LegalCall kLegalCalls[] = {
    {"Map1f", [](gl::Case& c) { c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, kPoints); }},
    {"Map1d", [](gl::Case& c) { c.Map1d(GL_MAP1_VERTEX_3, 0, 1, 3, 2, kRealPoints); }},
    {"EvalCoord1f", [](gl::Case& c) { in_begin_end(c, kCurves, [&] { c.EvalCoord1f(0.5); }); }},
    {"EvalCoord1d", [](gl::Case& c) { in_begin_end(c, kCurves, [&] { c.EvalCoord1d(0.5); }); }},
    {"EvalCoord1fv",
     [](gl::Case& c) { in_begin_end(c, kCurves, [&] { c.EvalCoord1fv(std::vector<float>{0.5f}); }); }},
    {"EvalCoord1dv",
     [](gl::Case& c) { in_begin_end(c, kCurves, [&] { c.EvalCoord1dv(std::vector<double>{0.5}); }); }},
    {"GetMapfv", [](gl::Case& c) { c.GetMapfv(GL_MAP1_VERTEX_3, GL_DOMAIN, gl::out<GLfloat>(2)); }},
    {"GetMapdv", [](gl::Case& c) { c.GetMapdv(GL_MAP1_VERTEX_3, GL_DOMAIN, gl::out<GLdouble>(2)); }},
    {"GetMapiv", [](gl::Case& c) { c.GetMapiv(GL_MAP1_VERTEX_3, GL_DOMAIN, gl::out<GLint>(2)); }}};

// Two-dimensional commands, and those of grids of both dimensions.
constexpr LegalCall kLegalCalls2[] = {
    {"Map2f", [](gl::Case& c) { c.Map2f(GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 1, kPoints); }},
    {"Map2d", [](gl::Case& c) { c.Map2d(GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 1, kRealPoints); }},
    {"MapGrid1f", [](gl::Case& c) { c.MapGrid1f(3, 0, 1); }},
    {"MapGrid1d", [](gl::Case& c) { c.MapGrid1d(3, 0, 1); }},
    {"MapGrid2f", [](gl::Case& c) { c.MapGrid2f(3, 0, 1, 2, 0, 1); }},
    {"MapGrid2d", [](gl::Case& c) { c.MapGrid2d(3, 0, 1, 2, 0, 1); }},
    {"EvalCoord2f", [](gl::Case& c) { in_begin_end(c, kSurfaces, [&] { c.EvalCoord2f(0.5, 0.25); }); }},
    {"EvalCoord2d", [](gl::Case& c) { in_begin_end(c, kSurfaces, [&] { c.EvalCoord2d(0.5, 0.25); }); }},
    {"EvalCoord2fv",
     [](gl::Case& c) {
       in_begin_end(c, kSurfaces, [&] { c.EvalCoord2fv(std::vector<float>{0.5f, 0.25f}); });
     }},
    {"EvalCoord2dv",
     [](gl::Case& c) {
       in_begin_end(c, kSurfaces, [&] { c.EvalCoord2dv(std::vector<double>{0.5, 0.25}); });
     }},
    {"EvalPoint1", [](gl::Case& c) { in_begin_end(c, kCurves, [&] { c.EvalPoint1(1); }); }},
    {"EvalPoint2", [](gl::Case& c) { in_begin_end(c, kSurfaces, [&] { c.EvalPoint2(1, 0); }); }},
    {"EvalMesh1", [](gl::Case& c) { c.EvalMesh1(GL_LINE, 0, 1); }},
    {"EvalMesh2", [](gl::Case& c) { c.EvalMesh2(GL_FILL, 0, 1, 0, 1); }}};

EVALCTS_TEST_PAIR(Api.EntryPoint, Api.EntryPoint2, kMust, decide("EV-API-ENTRY/1-D", "EV-API-ENTRY/2-D"),
                  [](bool two) { return two ? combine(kLegalCalls2) : combine(kLegalCalls); })
(Test& t, bool, const LegalCall& legal) {
  gl::Case c("a legal call");
  legal.call(c);
  const gl::Ref error = c.GetError();
  try {
    CheckedTrace checked = t.play(c);
    checked.expect_no_error(error);
  } catch (const gl::MissingEntryPoint& missing) {
    if (t.gl().declaration || std::string("gl") + legal.name != gl::name_of(missing.entry)) throw;
    const std::string name = std::string("gl") + legal.name;
    t.fail(failure_of(c, name, name + " does not exist", "an entry point", "none"));
  }
};

// Defines and queries nine maps, which differ in order, domain and k, by the values of the tokens.
EVALCTS_TEST_PAIR(Api.Map1TokensByValue, Api.Map2TokensByValue, kMust,
                  decide("EV-API-ENUM-MAP1", "EV-API-ENUM-MAP2"))
(Test& t, bool two) {
  constexpr int kValues[] = {4, 1, 3, 1, 2, 3, 4, 3, 4};  // values per point, COLOR_4 to VERTEX_4
  gl::Case c(two ? "0x0DB0 to 0x0DB8" : "0x0D90 to 0x0D98");
  const auto token = [=](int i) { return (two ? 0x0DB0 : 0x0D90) + static_cast<GLenum>(i); };
  for (int i = 0; two && i < 9; ++i) c.GetMapfv(token(i), 0x0A00, gl::out<GLfloat>(8));
  for (int i = 0; i < 9; ++i) {
    if (two) {
      c.Map2f(token(i), i, i + 1, kValues[i], 1 + i % 4, 2 * i, -1, kValues[i], 1 + i % 3,
              std::vector<float>(64, 0.25f));
    } else {
      c.Map1f(token(i), i, i + 1, kValues[i], 1 + i % 8, std::vector<float>(32, 0.25f));
    }
    c.GetError();
  }
  for (int i = 0; i < 9; ++i) {
    c.GetMapiv(token(i), 0x0A01, gl::out<GLint>(two ? 2 : 1));
    c.GetMapfv(token(i), 0x0A02, gl::out<GLfloat>(two ? 4 : 2));
    c.GetMapfv(token(i), 0x0A00, gl::out<GLfloat>(64));
  }
  t.judge(c);
};

// A map of each target changes the attribute that the target is named after.
EVALCTS_TEST_PAIR(Api.Map1TokenByEffect, Api.Map2TokenByEffect, kMust,
                  decide("EV-API-ENUM-MAP1", "EV-API-ENUM-MAP2"),
                  [](bool two) { return combine(visible_targets(two)); })
(Test& t, bool two, GLenum target) {
  gl::Case c("enabled and defined by number");
  define(c, random_map(t, target, {2, 3}));
  enable_visibly(c, target);
  c.Begin(GL_POINTS);
  eval_coord(c, two, 0.25, 0.625);
  c.End();
  t.judge_vertices(c, attribute_of(target));
};

EVALCTS_TEST(Api, OtherTokensByValue, kMust, "EV-API-ENUM-OTHER/1-D")
(Test& t) {
  gl::Case c("0x0D80, 0x0DD0 to 0x0DD3, 0x0D30, 0x0A00 to 0x0A02");
  c.Enable(0x0D80);
  c.IsEnabled(GL_AUTO_NORMAL);
  c.GetFloatv(0x0DD0, gl::out<GLfloat>(4));
  c.GetIntegerv(0x0DD1, gl::out<GLint>(2));
  c.GetFloatv(0x0DD2, gl::out<GLfloat>(4));
  c.GetIntegerv(0x0DD3, gl::out<GLint>(2));
  c.GetIntegerv(0x0D30, gl::out<GLint>(1));
  c.Map1f(GL_MAP1_TEXTURE_COORD_2, 7, 8, 2, 3, std::vector<GLfloat>{1, 2, 3, 4, 5, 6});
  for (const GLenum query : {0x0A00u, 0x0A01u, 0x0A02u})
    c.GetMapfv(GL_MAP1_TEXTURE_COORD_2, query, gl::out<GLfloat>(8));
  t.judge(c);
};

EVALCTS_TEST(Api, MeshModesByValue, kMust, "EV-API-ENUM-OTHER/2-D")
(Test& t) {
  gl::Case c("0x1B00 to 0x1B02 and their neighbours");
  for (const GLenum mode : {0x1B00u, 0x1B01u, 0x1B02u, 0x1AFFu, 0x1B03u})
    for (const bool two : {true, false}) {
      eval_mesh(c, two, mode, 0, 1, 0, 1);
      c.GetError();
    }
  t.judge(c);
};

// The values of POINT, LINE and FILL.
constexpr GLenum kModesByValue[] = {0x1B00, 0x1B01, 0x1B02};

EVALCTS_TEST_PAIR(Api.MeshModeByEffect, Api.MeshModeByEffect2, kMust,
                  decide("EV-API-ENUM-OTHER/1-D", "EV-API-ENUM-OTHER/2-D"),
                  [](bool two) { return combine(std::span(kModesByValue, two ? 3 : 2)); })
(Test& t, bool two, GLenum mode) {
  gl::Case c(two ? "a mesh of 3x2 segments" : "a mesh of three segments");
  define_and_enable(c, random_map(t, target_in(two, GL_MAP1_VERTEX_3), {3, 2}));
  two ? c.MapGrid2f(3, 0, 1, 2, 0, 1) : c.MapGrid1f(3, 0, 1);
  eval_mesh(c, two, mode, 0, 3, 0, 2);
  t.judge_vertices(c, kPosition);
};

// The float and the double form share state: queries of one form return maps that the other one defined.
EVALCTS_TEST_PAIR(Api.FormsShareState, Api.FormsShareState2, kMust, decide("EV-API-FD/1-D", "EV-API-FD/2-D"),
                  [](bool two) { return combine(target_forms(two)); })
(Test& t, bool two, const TargetForm& form) {
  const Map map = over(two ? random_map(t, form.target, {3, 4}, 21, 5) : random_map(t, form.target, 3, 4),
                       {-1, 3}, {8, 4.5});
  gl::Case c("given in one form and queried in the other");
  if (two)
    for (const Orders& orders : {Orders{4, 2}, {3, 4}})
      define(c, random_map(t, form.target, orders), !form.doubles);
  define(c, map, form.doubles);
  query_map(t, c, form.target, !form.doubles);
  t.judge(c);
};

// Evaluation in one form uses maps that the other one defined.
EVALCTS_TEST_PAIR(Api.FormsShareValues, Api.FormsShareValues2, kMust,
                  decide("EV-API-FD/1-D", "EV-API-FD/2-D"), decide("EV-COORD-FD/1-D", "EV-COORD-FD/2-D"),
                  combine(visible_target_forms(kCurves)))
(Test& t, bool two, const TargetForm& form) {
  gl::Case c("defined in one form, evaluated in the other");
  define(c, random_map(t, form.target, 4), form.doubles);
  enable_visibly(c, form.target);
  c.Begin(GL_POINTS);
  for (const double u : {0.0, 0.125, 0.3125, 0.9375, 1.0}) evaluate(c, u, !form.doubles);
  for (const double u : random_values(t.random(), 3)) evaluate(c, u, !form.doubles);  // 24 significant bits
  c.End();
  for (const bool along_v : {true, false})
    if (two || !along_v) t.judge_vertices(two ? gl::lift(c, along_v) : c, attribute_of(form.target));
};

// Each form replaces the map that the other one defined, also if the order is the same.
EVALCTS_TEST_PAIR(Api.FormsReplaceEachOther, Api.FormsReplaceEachOther2, kMust,
                  decide("EV-API-FD/1-D", "EV-API-FD/2-D"),
                  [](bool two) { return combine(visible_targets(two)); })
(Test& t, bool two, GLenum target) {
  gl::Case c("defined by f, d, f, ..., evaluated after each");
  enable_visibly(c, target);
  double round = 0;
  bool doubles = false;
  for (const Orders& orders : two ? std::vector<Orders>{{2, 3}, {3, 2}, {3, 2}, {2, 4}, {4, 2}, {4, 2}}
                                  : std::vector<Orders>{{2}, {3}, {3}, {5}, {4}, {4}}) {
    const Map map = over(two ? random_map(t, target, orders) : random_map(t, target, orders.u, 4),
                         {round, round + 2}, {3 - round, 7 - round});
    define(c, map, doubles);
    c.Begin(GL_POINTS);
    for (const double at : {0.25, 1.75}) eval_coord(c, two, round + at, 4 - round + at, !doubles);
    c.End();
    ++round;
    doubles = !doubles;
  }
  t.judge_vertices(c, attribute_of(target));
  if (two) return;
  query_map(t, c, target);
  t.judge_answers(c);
};

// The array of arguments ends before an inaccessible page, so that reading more than the arguments crashes.
EVALCTS_TEST_PAIR(Api.VectorForm, Api.VectorForm2, kMust, decide("EV-API-V/1-D", "EV-API-V/2-D"),
                  combine(visible_target_forms(kCurves)))
(Test& t, bool two, const TargetForm& form) {
  gl::Case c("scalar and vector form in turn");
  define(c, random_map(t, form.target, 5));
  enable_visibly(c, form.target);
  c.Begin(GL_POINTS);
  for (const double u : {0.0, 0.125, 0.3, 0.77, 1.0}) {
    evaluate(c, u, form.doubles);
    eval_coord_vector(c, kCurves, u, 0, form.doubles);
  }
  c.End();
  t.judge_vertices(two ? gl::lift(c, true) : c, attribute_of(form.target));
};

EVALCTS_TEST_PAIR(Api.VectorFormSameBits, Api.VectorFormSameBits2, kQuality,
                  decide("EV-API-V/1-D", "EV-API-V/2-D"), combine(kForms))
(Test& t, bool two, const Form& form) {
  gl::Case c("vertices 2i and 2i+1: scalar and vector form");
  define_and_enable(c, random_map(t, target_in(two, GL_MAP1_VERTEX_4), {4, 3}));
  const std::vector<double> us = random_values(t.random(), 64), vs = random_values(t.random(), us.size());
  c.Begin(GL_POINTS);
  for (std::size_t i = 0; i < us.size(); ++i) {
    eval_coord(c, two, us[i], vs[i], form.doubles);
    eval_coord_vector(c, two, us[i], vs[i], form.doubles);
  }
  c.End();
  const Observation seen = t.observe(c, kPosition, 2 * us.size());
  const auto& vertices = seen.primitives.front().vertices;
  for (std::size_t i = 0; i + 1 < vertices.size() && seen.primitives.size() == 1; i += 2)
    if (std::memcmp(&vertices[i].position, &vertices[i + 1].position, sizeof vertices[i].position) != 0)
      t.fail(failure_of(
          c, fmt::format("position of vertex {}", i + 1),
          fmt::format("EvalCoord{0}{1}v and EvalCoord{0}{1} differ at u = {2}{3}", two ? 2 : 1, form.name,
                      hexadecimal(us[i / 2]), two ? ", v = " + hexadecimal(vs[i / 2]) : ""),
          hexadecimal(vertices[i].position[0]), hexadecimal(vertices[i + 1].position[0])));
};

}  // namespace
}  // namespace evalcts::suite_api
