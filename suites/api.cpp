// Section 1 of the requirements: entry points, tokens by value, and the forms of a command.
#include <fmt/format.h>

#include <cstring>
#include <functional>

#include "suites/maps.h"

namespace evalcts {
namespace {

// A legal call of a command of the one-dimensional side, where it may stand.
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

constexpr GLenum kFirstMap1 = 0x0D90;

}  // namespace

EVALCTS_TESTS(Api, EntryPoint, kLegalCalls, const LegalCall& legal, must, "EV-API-ENTRY/1-D") {
  gl::Case c("a legal call");
  legal.call(c);
  const gl::Ref error = c.GetError();
  try {
    Played played = t.play(c);
    played.expect_no_error(error);
  } catch (const gl::MissingEntryPoint& missing) {
    if (std::string("gl") + legal.name != gl::name_of(missing.entry)) throw;
    Failure failure;
    failure.case_identity = c.identity();
    failure.what = std::string("gl") + legal.name;
    failure.message = fmt::format("gl{} does not exist", legal.name);
    failure.expected = "an entry point";
    failure.captured = "none";
    t.fail(failure);
  }
}

// The tokens by number: nine maps that differ in order, domain and k, defined and queried by value.
EVALCTS_TEST(Api, Map1TokensByValue, must, "EV-API-ENUM-MAP1") {
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
}

// ... and each does what its name says: evaluated through its number, seen in its attribute.
EVALCTS_TESTS(Api, Map1TokenByEffect, visible_targets(), GLenum target, must, "EV-API-ENUM-MAP1") {
  gl::Case c("enabled and defined by number");
  const std::vector<double> points =
      random_values(t.random(), static_cast<std::size_t>(2 * gl::components_of(target)));
  define(c, make_map1(target, points));
  enable_visibly(c, target);
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.25f);
  c.End();
  t.expect_emission(c, attribute_of(target));
}

EVALCTS_TEST(Api, OtherTokensByValue, must, "EV-API-ENUM-OTHER/1-D") {
  gl::Case c("0x0D80, 0x0DD0 to 0x0DD3, 0x0D30");
  c.Enable(0x0D80);
  const gl::Ref enabled = c.IsEnabled(GL_AUTO_NORMAL);
  const gl::Ref domain1 = c.GetFloatv(0x0DD0, gl::out<GLfloat>(4));
  const gl::Ref segments1 = c.GetIntegerv(0x0DD1, gl::out<GLint>(2));
  const gl::Ref domain2 = c.GetFloatv(0x0DD2, gl::out<GLfloat>(4));
  const gl::Ref segments2 = c.GetIntegerv(0x0DD3, gl::out<GLint>(2));
  const gl::Ref order = c.GetIntegerv(0x0D30, gl::out<GLint>(1));
  Played played = t.play(c);
  played.expect_result(enabled, GL_TRUE);
  played.expect_values(domain1, std::vector<GLfloat>{0, 1});
  played.expect_values(segments1, std::vector<GLint>{1});
  played.expect_values(domain2, std::vector<GLfloat>{0, 1, 0, 1});
  played.expect_values(segments2, std::vector<GLint>{1, 1});
  played.expect_values(order, std::vector<GLint>{t.gl().max_eval_order});
}

// Data given in one form is seen by the other: state ...
EVALCTS_TESTS(Api, FormsShareState, target_forms(), const TargetForm& form, must, "EV-API-FD/1-D") {
  const Map1 map =
      make_map1(form.target, -1, 3, 4,
                random_values(t.random(), static_cast<std::size_t>(3 * gl::components_of(form.target))));
  gl::Case c("given in one form and queried in the other");
  define(c, map, form.doubles);
  const MapQuery query = query_map1(c, form.target, t.max_order(), !form.doubles);
  Played played = t.play(c);
  expect_map1(played, query, map, !form.doubles);
}

// ... and values.
EVALCTS_TESTS(Api, FormsShareValues, visible_target_forms(), const TargetForm& form, must, "EV-API-FD/1-D",
              "EV-COORD-FD/1-D") {
  gl::Case c("defined in one form, evaluated in the other");
  define(c,
         make_map1(form.target,
                   random_values(t.random(), static_cast<std::size_t>(4 * gl::components_of(form.target)))),
         form.doubles);
  enable_visibly(c, form.target);
  c.Begin(GL_POINTS);
  for (const double u : {0.0, 0.125, 0.3125, 0.9375, 1.0}) evaluate(c, u, !form.doubles);
  c.End();
  t.expect_emission(c, attribute_of(form.target));
}

// Each form replaces what the other defined.
EVALCTS_TESTS(Api, FormsReplaceEachOther, visible_targets(), GLenum target, must, "EV-API-FD/1-D") {
  gl::Case c("defined by f, d, f, d, evaluated after each");
  enable_visibly(c, target);
  Map1 last;
  for (int round = 0; round < 4; ++round) {
    last = make_map1(
        target, round, round + 2, 4,
        random_values(t.random(), static_cast<std::size_t>((2 + round) * gl::components_of(target))));
    define(c, last, round % 2 == 1);
    c.Begin(GL_POINTS);
    for (const double u : {0.25, 1.75}) evaluate(c, round + u, round % 2 == 0);
    c.End();
  }
  t.expect_emission(c, attribute_of(target));
  const MapQuery query = query_map1(c, target, t.max_order());
  Played played = t.play(c);
  expect_map1(played, query, last);
}

// The array ends before an inaccessible page: reading a second value crashes.
EVALCTS_TESTS(Api, VectorForm, visible_target_forms(), const TargetForm& form, must, "EV-API-V/1-D") {
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
  t.expect_emission(c, attribute_of(form.target));
}

EVALCTS_TESTS(Api, VectorFormSameBits, kForms, const Form& form, quality, "EV-API-V/1-D") {
  gl::Case c("vertices 2i and 2i+1: scalar and vector form");
  define(c, make_map1(GL_MAP1_VERTEX_4, random_values(t.random(), 16)));
  c.Enable(GL_MAP1_VERTEX_4);
  const std::vector<double> us = random_values(t.random(), 64);
  c.Begin(GL_POINTS);
  for (const double u : us) {
    evaluate(c, u, form.doubles);
    evaluate_vector(c, u, form.doubles);
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
          fmt::format("EvalCoord1{0}v and EvalCoord1{0} differ at u = {1:a}", form.name, us[i / 2]);
      failure.expected = fmt::format("{:a}", vertices[i].position[0]);
      failure.captured = fmt::format("{:a}", vertices[i + 1].position[0]);
      t.fail(failure);
    }
}

}  // namespace evalcts
