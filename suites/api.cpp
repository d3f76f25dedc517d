// Section 1 of the requirements: entry points, tokens by value, and the forms of a command.
#include <fmt/format.h>

#include <cstring>
#include <functional>

#include <evalcts/gl/lift.h>
#include <evalcts/testkit/registration.h>
#include "maps.h"

namespace evalcts::suite_api {
namespace {

// A legal call of a command, where it may stand.
struct LegalCall {
  const char* name;
  void (*call)(gl::Case&);
};

const std::vector<float> kPoints = {0, 0, 0, 1, 1, 1};
const std::vector<double> kRealPoints = {0, 0, 0, 1, 1, 1};

void in_begin_end(gl::Case& c, const std::function<void()>& call) {
  c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, kPoints);
  c.Enable(GL_MAP1_VERTEX_3);
  c.Begin(GL_POINTS);
  call();
  c.End();
}

void in_begin_end2(gl::Case& c, const std::function<void()>& call) {
  c.Map2f(GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 1, kPoints);
  c.Enable(GL_MAP2_VERTEX_3);
  c.Begin(GL_POINTS);
  call();
  c.End();
}

constexpr LegalCall kLegalCalls[] = {
    {"Map1f", [](gl::Case& c) { c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, kPoints); }},
    {"Map1d", [](gl::Case& c) { c.Map1d(GL_MAP1_VERTEX_3, 0, 1, 3, 2, kRealPoints); }},
    {"EvalCoord1f", [](gl::Case& c) { in_begin_end(c, [&] { c.EvalCoord1f(0.5); }); }},
    {"EvalCoord1d", [](gl::Case& c) { in_begin_end(c, [&] { c.EvalCoord1d(0.5); }); }},
    {"EvalCoord1fv", [](gl::Case& c) { in_begin_end(c, [&] { c.EvalCoord1fv(std::vector<float>{0.5f}); }); }},
    {"EvalCoord1dv", [](gl::Case& c) { in_begin_end(c, [&] { c.EvalCoord1dv(std::vector<double>{0.5}); }); }},
    {"GetMapfv", [](gl::Case& c) { c.GetMapfv(GL_MAP1_VERTEX_3, GL_DOMAIN, gl::out<GLfloat>(2)); }},
    {"GetMapdv", [](gl::Case& c) { c.GetMapdv(GL_MAP1_VERTEX_3, GL_DOMAIN, gl::out<GLdouble>(2)); }},
    {"GetMapiv", [](gl::Case& c) { c.GetMapiv(GL_MAP1_VERTEX_3, GL_DOMAIN, gl::out<GLint>(2)); }}};

// The commands of two dimensions, and of grids of either.
constexpr LegalCall kLegalCalls2[] = {
    {"Map2f", [](gl::Case& c) { c.Map2f(GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 1, kPoints); }},
    {"Map2d", [](gl::Case& c) { c.Map2d(GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 1, kRealPoints); }},
    {"MapGrid1f", [](gl::Case& c) { c.MapGrid1f(3, 0, 1); }},
    {"MapGrid1d", [](gl::Case& c) { c.MapGrid1d(3, 0, 1); }},
    {"MapGrid2f", [](gl::Case& c) { c.MapGrid2f(3, 0, 1, 2, 0, 1); }},
    {"MapGrid2d", [](gl::Case& c) { c.MapGrid2d(3, 0, 1, 2, 0, 1); }},
    {"EvalCoord2f", [](gl::Case& c) { in_begin_end2(c, [&] { c.EvalCoord2f(0.5, 0.25); }); }},
    {"EvalCoord2d", [](gl::Case& c) { in_begin_end2(c, [&] { c.EvalCoord2d(0.5, 0.25); }); }},
    {"EvalCoord2fv",
     [](gl::Case& c) { in_begin_end2(c, [&] {
                         c.EvalCoord2fv(std::vector<float>{0.5f, 0.25f});
                       }); }},
    {"EvalCoord2dv",
     [](gl::Case& c) { in_begin_end2(c, [&] {
                         c.EvalCoord2dv(std::vector<double>{0.5, 0.25});
                       }); }},
    {"EvalPoint1", [](gl::Case& c) { in_begin_end(c, [&] { c.EvalPoint1(1); }); }},
    {"EvalPoint2", [](gl::Case& c) { in_begin_end2(c, [&] { c.EvalPoint2(1, 0); }); }},
    {"EvalMesh1", [](gl::Case& c) { c.EvalMesh1(GL_LINE, 0, 1); }},
    {"EvalMesh2", [](gl::Case& c) { c.EvalMesh2(GL_FILL, 0, 1, 0, 1); }}};

constexpr GLenum kFirstMap1 = 0x0D90, kFirstMap2 = 0x0DB0;

void expect_legal(Test& t, const LegalCall& legal) {
  gl::Case c("a legal call");
  legal.call(c);
  const gl::Ref error = c.GetError();
  try {
    Played played = t.play(c);
    played.expect_no_error(error);
  } catch (const gl::MissingEntryPoint& missing) {
    if (t.gl().declaration || std::string("gl") + legal.name != gl::name_of(missing.entry)) throw;
    Failure failure;
    failure.case_identity = c.identity();
    failure.what = std::string("gl") + legal.name;
    failure.message = fmt::format("gl{} does not exist", legal.name);
    failure.expected = "an entry point";
    failure.captured = "none";
    t.fail(failure);
  }
}

}  // namespace

EVALCTS_TEST(Api, EntryPoint, must, "EV-API-ENTRY/1-D", combine(kLegalCalls))
(Test& t, const LegalCall& legal) { expect_legal(t, legal); };

EVALCTS_TEST(Api, EntryPoint2, must, "EV-API-ENTRY/2-D", combine(kLegalCalls2))
(Test& t, const LegalCall& legal) { expect_legal(t, legal); };

// The tokens by number: nine maps that differ in order, domain and k, defined and queried by value.
EVALCTS_TEST(Api, Map1TokensByValue, must, "EV-API-ENUM-MAP1")
(Test& t) {
  constexpr int kValues[] = {4, 1, 3, 1, 2,
                             3, 4, 3, 4};  // COLOR_4, INDEX, NORMAL, TEXTURE_COORD_1..4, VERTEX_3, _4
  gl::Case c("0x0D90 to 0x0D98");
  std::vector<gl::Ref> errors, orders, domains, coefficients;
  for (int i = 0; i < 9; ++i) {
    c.Map1f(kFirstMap1 + static_cast<GLenum>(i), i, i + 1, kValues[i], 1 + i % 8,
            std::vector<float>(32, 0.25f));
    errors.push_back(c.GetError());
  }
  for (int i = 0; i < 9; ++i) {
    const GLenum token = kFirstMap1 + static_cast<GLenum>(i);
    orders.push_back(c.GetMapiv(token, 0x0A01, gl::out<GLint>(1)));
    domains.push_back(c.GetMapfv(token, 0x0A02, gl::out<GLfloat>(2)));
    coefficients.push_back(c.GetMapfv(token, 0x0A00, gl::out<GLfloat>(64)));
  }
  Played played = t.play(c);
  for (std::size_t i = 0; i < 9; ++i) {
    const int n = static_cast<int>(i);
    played.expect_no_error(errors[i]);
    played.expect_values(orders[i], std::vector<GLint>{1 + n % 8});
    played.expect_values(domains[i], std::vector<GLfloat>{static_cast<float>(n), static_cast<float>(n + 1)});
    played.expect_values(coefficients[i],
                         std::vector<GLfloat>(static_cast<std::size_t>((1 + n % 8) * kValues[i]), 0.25f));
  }
};

EVALCTS_TEST(Api, Map2TokensByValue, must, "EV-API-ENUM-MAP2")
(Test& t) {
  constexpr int kValues[] = {4, 1, 3, 1, 2, 3, 4, 3, 4};
  // Before it is defined each map holds what its name says.
  const std::vector<std::vector<GLfloat>> initial = {
      {1, 1, 1, 1}, {1}, {0, 0, 1}, {0}, {0, 0}, {0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0}, {0, 0, 0, 1}};
  gl::Case c("0x0DB0 to 0x0DB8");
  std::vector<gl::Ref> first, errors, orders, domains, coefficients;
  const auto token = [](int i) { return kFirstMap2 + static_cast<GLenum>(i); };
  for (int i = 0; i < 9; ++i) first.push_back(c.GetMapfv(token(i), 0x0A00, gl::out<GLfloat>(8)));
  for (int i = 0; i < 9; ++i) {
    c.Map2f(token(i), i, i + 1, kValues[i], 1 + i % 4, 2 * i, -1, kValues[i], 1 + i % 3,
            std::vector<float>(64, 0.25f));
    errors.push_back(c.GetError());
  }
  for (int i = 0; i < 9; ++i) {
    orders.push_back(c.GetMapiv(token(i), 0x0A01, gl::out<GLint>(2)));
    domains.push_back(c.GetMapfv(token(i), 0x0A02, gl::out<GLfloat>(4)));
    coefficients.push_back(c.GetMapfv(token(i), 0x0A00, gl::out<GLfloat>(64)));
  }
  Played played = t.play(c);
  for (std::size_t i = 0; i < 9; ++i) {
    const int n = static_cast<int>(i), uorder = 1 + n % 4, vorder = 1 + n % 3;
    const auto real = static_cast<float>(n);
    played.expect_values(first[i], initial[i]);
    played.expect_no_error(errors[i]);
    played.expect_values(orders[i], std::vector<GLint>{uorder, vorder});
    played.expect_values(domains[i], std::vector<GLfloat>{real, real + 1, 2 * real, -1});
    played.expect_values(coefficients[i],
                         std::vector<GLfloat>(static_cast<std::size_t>(uorder * vorder * kValues[i]), 0.25f));
  }
};

// ... and each does what its name says: evaluated through its number, seen in its attribute.
EVALCTS_TEST(Api, Map1TokenByEffect, must, "EV-API-ENUM-MAP1", combine(visible_targets()))
(Test& t, GLenum target) {
  gl::Case c("enabled and defined by number");
  const std::vector<double> points =
      random_values(t.random(), static_cast<std::size_t>(2 * gl::components_of(target)));
  define(c, make_map1(target, points));
  enable_visibly(c, target);
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.25f);
  c.End();
  t.expect_emission(c, attribute_of(target));
};

EVALCTS_TEST(Api, Map2TokenByEffect, must, "EV-API-ENUM-MAP2", combine(visible_targets2()))
(Test& t, GLenum target) {
  gl::Case c("enabled and defined by number");
  define(c, random_map2(t, target, 2, 3));
  enable_visibly(c, target);
  c.Begin(GL_POINTS);
  evaluate2(c, 0.25, 0.625);
  c.End();
  t.expect_emission(c, attribute_of(target));
};

EVALCTS_TEST(Api, OtherTokensByValue, must, "EV-API-ENUM-OTHER/1-D")
(Test& t) {
  gl::Case c("0x0D80, 0x0DD0 to 0x0DD3, 0x0D30, 0x0A00 to 0x0A02");
  c.Enable(0x0D80);
  const gl::Ref enabled = c.IsEnabled(GL_AUTO_NORMAL);
  const gl::Ref domain1 = c.GetFloatv(0x0DD0, gl::out<GLfloat>(4));
  const gl::Ref segments1 = c.GetIntegerv(0x0DD1, gl::out<GLint>(2));
  const gl::Ref domain2 = c.GetFloatv(0x0DD2, gl::out<GLfloat>(4));
  const gl::Ref segments2 = c.GetIntegerv(0x0DD3, gl::out<GLint>(2));
  const gl::Ref order = c.GetIntegerv(0x0D30, gl::out<GLint>(1));
  const std::vector<GLfloat> points = {1, 2, 3, 4, 5, 6};
  c.Map1f(GL_MAP1_TEXTURE_COORD_2, 7, 8, 2, 3, points);
  const gl::Ref map_points = c.GetMapfv(GL_MAP1_TEXTURE_COORD_2, 0x0A00, gl::out<GLfloat>(8));
  const gl::Ref map_order = c.GetMapfv(GL_MAP1_TEXTURE_COORD_2, 0x0A01, gl::out<GLfloat>(8));
  const gl::Ref map_domain = c.GetMapfv(GL_MAP1_TEXTURE_COORD_2, 0x0A02, gl::out<GLfloat>(8));
  Played played = t.play(c);
  played.expect_values(map_points, points);
  played.expect_values(map_order, std::vector<GLfloat>{3});
  played.expect_values(map_domain, std::vector<GLfloat>{7, 8});
  played.expect_result(enabled, GL_TRUE);
  played.expect_values(domain1, std::vector<GLfloat>{0, 1});
  played.expect_values(segments1, std::vector<GLint>{1});
  played.expect_values(domain2, std::vector<GLfloat>{0, 1, 0, 1});
  played.expect_values(segments2, std::vector<GLint>{1, 1});
  played.expect_values(order, std::vector<GLint>{t.gl().max_eval_order});
};

EVALCTS_TEST(Api, MeshModesByValue, must, "EV-API-ENUM-OTHER/2-D")
(Test& t) {
  gl::Case c("0x1B00 to 0x1B02 and their neighbours");
  std::vector<gl::Ref> good, bad;
  for (const GLenum mode : {0x1B00u, 0x1B01u, 0x1B02u}) {
    c.EvalMesh2(mode, 0, 1, 0, 1);
    good.push_back(c.GetError());
  }
  for (const GLenum mode : {0x1B00u, 0x1B01u}) {
    c.EvalMesh1(mode, 0, 1);
    good.push_back(c.GetError());
  }
  for (const GLenum mode : {0x1AFFu, 0x1B03u}) {
    c.EvalMesh1(mode, 0, 1);
    bad.push_back(c.GetError());
    c.EvalMesh2(mode, 0, 1, 0, 1);
    bad.push_back(c.GetError());
  }
  c.EvalMesh1(0x1B02, 0, 1);
  bad.push_back(c.GetError());
  Played played = t.play(c);
  for (const gl::Ref error : good) played.expect_no_error(error);
  for (const gl::Ref error : bad) played.expect_error(error, {GL_INVALID_ENUM});
};

// What each mode draws.
namespace {

struct ModeByValue {
  const char* name;
  GLenum value;
};
constexpr ModeByValue kModesByValue1[] = {{"POINT", 0x1B00}, {"LINE", 0x1B01}};
constexpr ModeByValue kModesByValue2[] = {{"POINT", 0x1B00}, {"LINE", 0x1B01}, {"FILL", 0x1B02}};

}  // namespace

EVALCTS_TEST(Api, MeshModeByEffect, must, "EV-API-ENUM-OTHER/1-D", combine(kModesByValue1))
(Test& t, const ModeByValue& mode) {
  gl::Case c("a mesh of three segments");
  define(c, random_map(t, GL_MAP1_VERTEX_3, 3));
  c.Enable(GL_MAP1_VERTEX_3);
  c.MapGrid1f(3, 0, 1);
  c.EvalMesh1(mode.value, 0, 3);
  t.expect_emission(c, kPosition);
};

EVALCTS_TEST(Api, MeshModeByEffect2, must, "EV-API-ENUM-OTHER/2-D", combine(kModesByValue2))
(Test& t, const ModeByValue& mode) {
  gl::Case c("a mesh of 3x2 segments");
  define(c, random_map2(t, GL_MAP2_VERTEX_3, 3, 2));
  c.Enable(GL_MAP2_VERTEX_3);
  c.MapGrid2f(3, 0, 1, 2, 0, 1);
  c.EvalMesh2(mode.value, 0, 3, 0, 2);
  t.expect_emission(c, kPosition);
};

// Data given in one form is seen by the other: state ...
EVALCTS_TEST(Api, FormsShareState, must, "EV-API-FD/1-D", combine(target_forms()))
(Test& t, const TargetForm& form) {
  const Map1 map =
      make_map1(form.target, -1, 3, 4,
                random_values(t.random(), static_cast<std::size_t>(3 * gl::components_of(form.target))));
  gl::Case c("given in one form and queried in the other");
  define(c, map, form.doubles);
  const MapQuery query = query_map(c, form.target, t.max_order(), !form.doubles);
  Played played = t.play(c);
  expect_map(played, query, map, !form.doubles);
};

EVALCTS_TEST(Api, FormsShareState2, must, "EV-API-FD/2-D", combine(target_forms2()))
(Test& t, const TargetForm& form) {
  Map2 map = random_map2(t, form.target, 3, 4, 21, 5);
  map.u1 = -1, map.u2 = 3, map.v1 = 8, map.v2 = 4.5;
  gl::Case c("given in one form and queried in the other");
  define(c, random_map2(t, form.target, 4, 2), !form.doubles);
  define(c, random_map2(t, form.target, 3, 4), !form.doubles);
  define(c, map, form.doubles);
  const MapQuery query = query_map(c, form.target, t.max_order(), !form.doubles);
  Played played = t.play(c);
  expect_map(played, query, map, !form.doubles);
};

// ... and values.
namespace {

void forms_share_values(Test& t, const TargetForm& form, bool two) {
  gl::Case c("defined in one form, evaluated in the other");
  define(c,
         make_map1(form.target,
                   random_values(t.random(), static_cast<std::size_t>(4 * gl::components_of(form.target)))),
         form.doubles);
  enable_visibly(c, form.target);
  c.Begin(GL_POINTS);
  for (const double u : {0.0, 0.125, 0.3125, 0.9375, 1.0}) evaluate(c, u, !form.doubles);
  for (const double u : random_values(t.random(), 3)) evaluate(c, u, !form.doubles);  // all bits of a float
  c.End();
  for (const bool along_v : {true, false})
    if (two || !along_v) t.expect_emission(two ? gl::lift(c, along_v) : c, attribute_of(form.target));
}

}  // namespace

EVALCTS_TEST(Api, FormsShareValues, must, "EV-API-FD/1-D", "EV-COORD-FD/1-D", combine(visible_target_forms()))
(Test& t, const TargetForm& form) { forms_share_values(t, form, false); };
EVALCTS_TEST(Api, FormsShareValues2, must, "EV-API-FD/2-D", "EV-COORD-FD/2-D",
             combine(visible_target_forms()))
(Test& t, const TargetForm& form) { forms_share_values(t, form, true); };

// Each form replaces what the other defined, also where the order stays.
EVALCTS_TEST(Api, FormsReplaceEachOther, must, "EV-API-FD/1-D", combine(visible_targets()))
(Test& t, GLenum target) {
  gl::Case c("defined by f, d, f, ..., evaluated after each");
  enable_visibly(c, target);
  Map1 last;
  int round = 0;
  for (const int order : {2, 3, 3, 5, 4, 4}) {
    last = make_map1(target, round, round + 2, 4,
                     random_values(t.random(), static_cast<std::size_t>(order * gl::components_of(target))));
    define(c, last, round % 2 == 1);
    c.Begin(GL_POINTS);
    for (const double u : {0.25, 1.75}) evaluate(c, round + u, round % 2 == 0);
    c.End();
    ++round;
  }
  t.expect_emission(c, attribute_of(target));
  const MapQuery query = query_map(c, target, t.max_order());
  Played played = t.play(c);
  expect_map(played, query, last);
};

EVALCTS_TEST(Api, FormsReplaceEachOther2, must, "EV-API-FD/2-D", combine(visible_targets2()))
(Test& t, GLenum target) {
  gl::Case c("defined by f, d, f, ..., evaluated after each");
  enable_visibly(c, target);
  int round = 0;
  for (const auto& [uorder, vorder] : {std::pair{2, 3}, {3, 2}, {3, 2}, {2, 4}, {4, 2}, {4, 2}}) {
    Map2 map = random_map2(t, target, uorder, vorder);
    map.u1 = round, map.u2 = round + 2, map.v1 = 3 - round, map.v2 = 7 - round;
    define(c, map, round % 2 == 1);
    c.Begin(GL_POINTS);
    for (const double at : {0.25, 1.75}) evaluate2(c, round + at, 4 - round + at, round % 2 == 0);
    c.End();
    ++round;
  }
  t.expect_emission(c, attribute_of(target));
};

// The array ends before an inaccessible page: reading a second value crashes.
namespace {

void vector_form(Test& t, const TargetForm& form, bool two) {
  gl::Case c("scalar and vector form in turn");
  define(c,
         make_map1(form.target,
                   random_values(t.random(), static_cast<std::size_t>(5 * gl::components_of(form.target)))));
  enable_visibly(c, form.target);
  c.Begin(GL_POINTS);
  for (const double u : {0.0, 0.125, 0.3, 0.77, 1.0}) {
    evaluate(c, u, form.doubles);
    evaluate_vector(c, u, form.doubles);
  }
  c.End();
  t.expect_emission(two ? gl::lift(c, true) : c, attribute_of(form.target));
}

}  // namespace

EVALCTS_TEST(Api, VectorForm, must, "EV-API-V/1-D", combine(visible_target_forms()))
(Test& t, const TargetForm& form) { vector_form(t, form, false); };
EVALCTS_TEST(Api, VectorForm2, must, "EV-API-V/2-D", combine(visible_target_forms()))
(Test& t, const TargetForm& form) { vector_form(t, form, true); };

namespace {

void vector_form_same_bits(Test& t, const Form& form, bool two) {
  gl::Case c("vertices 2i and 2i+1: scalar and vector form");
  if (two) {
    define(c, random_map2(t, GL_MAP2_VERTEX_4, 4, 3));
  } else {
    define(c, random_map(t, GL_MAP1_VERTEX_4, 4));
  }
  c.Enable(two ? GL_MAP2_VERTEX_4 : GL_MAP1_VERTEX_4);
  const std::vector<double> us = random_values(t.random(), 64), vs = random_values(t.random(), us.size());
  c.Begin(GL_POINTS);
  for (std::size_t i = 0; i < us.size(); ++i) {
    if (two) {
      evaluate2(c, us[i], vs[i], form.doubles);
      evaluate2_vector(c, us[i], vs[i], form.doubles);
    } else {
      evaluate(c, us[i], form.doubles);
      evaluate_vector(c, us[i], form.doubles);
    }
  }
  c.End();
  const Observation seen = t.observe(c, kPosition, 2 * us.size());
  const auto& vertices = seen.primitives.front().vertices;
  for (std::size_t i = 0; i + 1 < vertices.size() && seen.primitives.size() == 1; i += 2)
    if (std::memcmp(&vertices[i].position, &vertices[i + 1].position, sizeof vertices[i].position) != 0) {
      Failure failure;
      failure.case_identity = c.identity();
      failure.what = fmt::format("position of vertex {}", i + 1);
      failure.message =
          fmt::format("EvalCoord{0}{1}v and EvalCoord{0}{1} differ at u = {2:a}{3}", two ? 2 : 1, form.name,
                      us[i / 2], two ? fmt::format(", v = {:a}", vs[i / 2]) : "");
      failure.expected = fmt::format("{:a}", vertices[i].position[0]);
      failure.captured = fmt::format("{:a}", vertices[i + 1].position[0]);
      t.fail(failure);
    }
}

}  // namespace

EVALCTS_TEST(Api, VectorFormSameBits, quality, "EV-API-V/1-D", combine(kForms))
(Test& t, const Form& form) { vector_form_same_bits(t, form, false); };
EVALCTS_TEST(Api, VectorFormSameBits2, quality, "EV-API-V/2-D", combine(kForms))
(Test& t, const Form& form) { vector_form_same_bits(t, form, true); };

}  // namespace evalcts::suite_api
