// Sections 7 to 9 of the requirements: the vertices that evaluation commands emit. Most cases are
// one-dimensional and become two-dimensional ones by their deliveries; the executable specification predicts
// the vertices.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>

#include <evalcts/gl/contexts.h>
#include <evalcts/gl/hexadecimal.h>
#include <evalcts/gl/lift.h>
#include <evalcts/judge/prediction.h>
#include <evalcts/testkit/registration.h>
#include <reference/acceptance.h>
#include <reference/component.h>
#include <reference/map.h>
#include "checked_case.h"
#include "dimensions.h"
#include "grid_cases.h"

namespace evalcts::suite_evaluation {
namespace {

// Returns the count + 1 multiples of 1/count in [0,1].
std::vector<double> steps(int count) {
  std::vector<double> us;
  for (int i = 0; i <= count; ++i) us.push_back(static_cast<double>(i) / count);
  return us;
}

std::vector<gl::Ref> query_current_values(gl::Case& c) {
  return {
      c.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4)), c.GetFloatv(GL_CURRENT_NORMAL, gl::out<GLfloat>(3)),
      c.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4)),
      c.GetFloatv(GL_CURRENT_INDEX, gl::out<GLfloat>(1)), c.GetBooleanv(GL_EDGE_FLAG, gl::out<GLboolean>(1))};
}

constexpr GLenum kAttributeTargets[] = {
    GL_MAP1_COLOR_4,         GL_MAP1_INDEX,           GL_MAP1_NORMAL,         GL_MAP1_TEXTURE_COORD_1,
    GL_MAP1_TEXTURE_COORD_2, GL_MAP1_TEXTURE_COORD_3, GL_MAP1_TEXTURE_COORD_4};

constexpr GLenum kTextureTargets[] = {GL_MAP1_TEXTURE_COORD_1, GL_MAP1_TEXTURE_COORD_2,
                                      GL_MAP1_TEXTURE_COORD_3, GL_MAP1_TEXTURE_COORD_4};

// --- Section 7: evaluation commands ----------------------------------------------------------------------

EVALCTS_TEST(Evaluation, AllKindsTogether, kMust, "EV-COORD-ASIF/1-D", "EV-COORD-VERTEXLAST/1-D",
             "EV-PREC-PERKIND/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c = with_current_values(
      "colour, index, normal, texture coordinate and vertex maps, each different at every u");
  for (const GLenum target :
       {GL_MAP1_VERTEX_4, GL_MAP1_COLOR_4, GL_MAP1_INDEX, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_3})
    define_and_enable(c, random_map(t, target, 4));
  evaluate_all(c, steps(20));
  t.expect_emission(c, kUnit0);
};

EVALCTS_TEST(Evaluation, VertexCarriesItsOwnAttributes, kMust, "EV-COORD-VERTEXLAST/1-D",
             combine(visible_targets(kCurves)).by(gl::curve_deliveries()))
(Test& t, GLenum target) {
  gl::Case c = with_current_values("first vertex of a primitive, then far jumps of u");
  define_and_enable(c, random_map(t, GL_MAP1_VERTEX_3, 2));
  define_and_enable(c, random_map(t, target, 2));
  for (int primitive = 0; primitive < 2; ++primitive) evaluate_all(c, {1.0, 0.0, 1.0, 0.5});
  t.expect_emission(c, kPosition | attribute_of(target));
};

EVALCTS_TEST(Evaluation, CurrentValuesOfTheMoment, kMust, "EV-COORD-CURRENT/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c("Color, Normal and TexCoord between the evaluations of one primitive");
  define_and_enable(c, random_map(t, GL_MAP1_VERTEX_3, 4));
  c.Begin(GL_POINTS);
  for (int i = 0; i < 12; ++i) {
    const float x = static_cast<float>(i) / 16;
    if (i % 3 != 1) c.Color4f(x, 1 - x, 0.5f, 0.25f);
    if (i % 2) c.Normal3f(x, -x, 1);
    if (i % 3 == 0) c.TexCoord2f(x, 2 * x);  // r, q become 0, 1
    if (i % 5 == 4) c.TexCoord4f(1, 2, 3, x);
    c.EvalCoord1f(x);
  }
  c.End();
  t.expect_emission(c, kUnit0);
};

// After a map is disabled, vertices have the current value, whatever was evaluated before.
EVALCTS_TEST(Evaluation, MapSwitchedOff, kMust, "EV-COORD-CURRENT/1-D",
             combine((std::vector<GLenum>{GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_1,
                                          GL_MAP1_TEXTURE_COORD_4}))
                 .by(gl::curve_deliveries()))
(Test& t, GLenum target) {
  const std::vector<GLenum> others = {GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_2};
  for (unsigned subset = 0; subset < 8; ++subset) {
    std::string with = "with MAP1_VERTEX_3";
    gl::Case c;
    set_current_values(c);
    for (const GLenum map : {static_cast<GLenum>(GL_MAP1_VERTEX_3), target})
      define_and_enable(c, random_map(t, map, 3));
    bool skipped = false;
    for (std::size_t i = 0; i < others.size(); ++i) {
      if (!(subset >> i & 1u)) continue;
      skipped = skipped || others[i] == target;
      with += " and " + label(others[i]);
      define_and_enable(c, random_map(t, others[i], 3));
    }
    if (skipped) continue;
    c.set_identity(with);
    evaluate_some(c);
    c.Disable(target);
    evaluate_some(c);
    t.expect_emission(c, kUnit0);
  }
};

// Without a vertex map an evaluation has no effect.
EVALCTS_TEST(Evaluation, NothingWithoutVertexMap, kMust, "EV-COORD-NOVERTEX/1-D",
             combine(kAttributeTargets).by(gl::curve_deliveries()))
(Test& t, GLenum target) {
  CheckedCase c(t, "no vertex map enabled");
  set_current_values(c);
  c.Indexf(9);
  c.EdgeFlag(GL_FALSE);
  define(c, random_map(t, target, 3));
  define(c, random_map(t, GL_MAP1_VERTEX_3, 3));  // defined, not enabled
  c.Enable(target);
  const std::vector<gl::Ref> before = query_current_values(c);
  evaluate_some(c);
  c.expect_no_error();
  c.expect_same(before, query_current_values(c));
  c.check();

  gl::Case drawing = with_current_values("nothing is drawn, and the Vertex between has the current values");
  define_and_enable(drawing, random_map(t, target, 3));
  drawing.Begin(GL_POINTS);
  drawing.EvalCoord1f(0.5f);
  drawing.Vertex3f(1, 2, 3);
  drawing.EvalCoord1f(0.25f);
  drawing.End();
  t.expect_emission(drawing, kUnit0);

  gl::Case empty("nothing is drawn");
  define_and_enable(empty, random_map(t, target, 3));
  evaluate_some(empty);
  t.expect_emission(empty, kPosition);
};

EVALCTS_TEST(Evaluation, NothingWithVertexMapOfOtherDimension, kMust, "EV-COORD-NOVERTEX-OTHERDIM/1-D",
             by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c = with_current_values("MAP2_VERTEX_3 and MAP2_VERTEX_4 enabled, MAP1 colour enabled");
  c.Enable(GL_MAP2_VERTEX_3);
  c.Enable(GL_MAP2_VERTEX_4);
  define_and_enable(c, random_map(t, GL_MAP1_COLOR_4, 3));
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.5f);
  c.Vertex2f(3, 4);
  c.EvalCoord1d(0.25);
  c.End();
  t.expect_emission(c, kUnit0);
};

// Evaluations of a dimension without a vertex map do not affect the vertices before and after them, nor later
// primitives, whether or not current values were set.
EVALCTS_TEST_PAIR(Evaluation.NothingFromTheOtherDimension, Evaluation.NothingFromTheOtherDimension2, kMust,
                  decide("EV-COORD-NOVERTEX-OTHERDIM/1-D", "EV-COORD-NOVERTEX-OTHERDIM/2-D"), [](bool two) {
                    std::vector<GLenum> caps = {GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_1,
                                                GL_MAP1_TEXTURE_COORD_2, GL_MAP1_TEXTURE_COORD_4};
                    for (GLenum& cap : caps) cap = target_in(!two, cap);
                    if (!two) caps.push_back(GL_AUTO_NORMAL);
                    return combine(caps).by(gl::list_deliveries());
                  })
(Test& t, bool two, GLenum cap) {
  for (const bool is_set : {false, true}) {
    gl::Case c(is_set ? "with current values" : "with the initial current values");
    if (is_set) set_current_values(c);
    define_and_enable(c, random_map(t, target_in(two, GL_MAP1_VERTEX_3), two ? Orders{3, 2} : Orders{3}));
    if (cap != GL_AUTO_NORMAL) define(c, random_map(t, cap, two ? Orders{3} : Orders{2, 3}));
    c.Enable(cap);
    two ? c.MapGrid2f(1, 0, 1, 1, 0, 1) : c.MapGrid1f(1, 0, 1);
    const auto emits = [&](double u) { eval_coord(c, two, u, 0.5); };
    const auto does_nothing = [&] { eval_coord(c, !two, 0.25, 0.75); };
    const auto primitive = [&](const std::function<void()>& commands) {
      c.Begin(GL_POINTS);
      commands();
      c.End();
    };
    primitive([&] { emits(0.125), does_nothing(); });
    primitive([&] { emits(0.25), emits(0.375); });
    primitive([&] { does_nothing(), emits(0.5), does_nothing(), c.Vertex3f(1, 2, 3); });
    primitive([&] { does_nothing(); });
    primitive([&] { c.Vertex3f(4, 5, 6), emits(0.625); });
    primitive([&] { emits(0.75), does_nothing(); });
    eval_mesh(c, two, GL_POINT, 0, 1, 0, 1);
    primitive([&] { c.Vertex3f(7, 8, 9); });
    t.expect_emission(c, kUnit0);
  }
};

// After a map is disabled, by Disable or PopAttrib, vertices have the current values, which are the initial
// ones.
EVALCTS_TEST(Evaluation, InitialValuesAfterMap, kMust, "EV-COORD-CURRENT/1-D",
             combine(std::array<GLenum, 4>{GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_1,
                                           GL_MAP1_TEXTURE_COORD_4})
                 .by(gl::curve_deliveries()))
(Test& t, GLenum target) {
  for (const bool is_popped : {false, true}) {
    gl::Case c(is_popped ? "popped" : "switched off");
    define_and_enable(c, random_map(t, GL_MAP1_VERTEX_3, 3));
    define(c, random_map(t, target, 3));
    if (is_popped) c.PushAttrib(GL_EVAL_BIT);
    c.Enable(target);
    evaluate_some(c);
    is_popped ? c.PopAttrib() : c.Disable(target);
    evaluate_some(c);
    t.expect_emission(c, kUnit0);
  }
};

EVALCTS_TEST_PAIR(
    Evaluation.LegalInEveryPrimitive, Evaluation.LegalInEveryPrimitive2, kMust,
    decide("EV-COORD-INBEGIN/1-D", "EV-COORD-INBEGIN/2-D"), [](bool two) {
      return combine(std::array{target_in(two, GL_MAP1_VERTEX_3), target_in(two, GL_MAP1_VERTEX_4)});
    })
(Test& t, bool two, GLenum target) {
  const bool adjacency = t.gl().at_least(3, 2);
  for (GLenum mode = GL_POINTS; mode <= (adjacency ? GL_TRIANGLE_STRIP_ADJACENCY : GL_POLYGON); ++mode) {
    gl::Case c(gl::primitive_name(mode));
    define_and_enable(c, random_map(t, two ? target - GL_MAP2_VERTEX_3 + GL_MAP1_VERTEX_3 : target, 3));
    c.Begin(mode);
    for (int i = 0; i < 8; ++i) c.EvalCoord1f(static_cast<float>(i) / 8);
    c.EvalCoord1d(0.5);
    c.EvalCoord1fv(std::vector<float>{0.5f});
    c.EvalCoord1dv(std::vector<double>{0.5});
    for (const GLint i : {0, 1, 2}) eval_point(c, two, i, 1);
    c.End();
    const gl::Ref error = c.GetError();
    Played played = t.play(two ? gl::lift(c, true) : c);
    played.expect_no_error(error);
  }
};

constexpr Named<GLenum> kModes[] = {{"POINTS", GL_POINTS},
                                    {"LINES", GL_LINES},
                                    {"LINE_LOOP", GL_LINE_LOOP},
                                    {"LINE_STRIP", GL_LINE_STRIP},
                                    {"TRIANGLES", GL_TRIANGLES},
                                    {"TRIANGLE_STRIP", GL_TRIANGLE_STRIP},
                                    {"TRIANGLE_FAN", GL_TRIANGLE_FAN},
                                    {"QUADS", GL_QUADS},
                                    {"QUAD_STRIP", GL_QUAD_STRIP},
                                    {"POLYGON", GL_POLYGON}};

// Primitives of 0 to 9 vertices, some of them incomplete.
EVALCTS_TEST(Evaluation, Primitives, kMust, "EV-COORD-PRIMS/1-D",
             combine(kModes).by(gl::without(gl::kMeshes, gl::curve_deliveries())))
(Test& t, const Named<GLenum>& mode) {
  gl::Case c("0 to 9 vertices");
  for (const GLenum target : {GL_MAP1_VERTEX_4, GL_MAP1_COLOR_4, GL_MAP1_TEXTURE_COORD_2}) {
    Map map = random_map(t, target, 4);
    if (target == GL_MAP1_VERTEX_4)
      for (std::size_t i = 3; i < map.points.size(); i += 4) map.points[i] = 1 + std::abs(map.points[i]);
    define_and_enable(c, map);
  }
  float u = 0;
  for (int vertices = 0; vertices < 10; ++vertices) {
    c.Begin(mode.value);
    for (int i = 0; i < vertices; ++i, u += 0.015625f) c.EvalCoord1f(u);
    c.End();
  }
  t.expect_emission(c, kPosition | kTextureCoordinate0);
};

// Draws primitives of 0 to 9 vertices, every third of which is explicit.
void draw_mixed_primitives(gl::Case& c, GLenum mode) {
  float u = 0;
  for (int vertices = 0; vertices < 10; ++vertices) {
    c.Begin(mode);
    for (int i = 0; i < vertices; ++i, u += 0.015625f)
      i % 3 == 1 ? c.Vertex3f(u, 1 - u, 0.5f) : c.EvalCoord1f(u);
    c.End();
  }
}

// Primitives that mix evaluated and explicit vertices. Only the vertex map is enabled, so that the test is
// about the primitives alone.
EVALCTS_TEST(Evaluation, MixedPrimitives, kMust, "EV-COORD-PRIMS/1-D", "EV-COORD-MIX/1-D",
             combine(kModes).by(gl::without(gl::kMeshes, gl::curve_deliveries())))
(Test& t, const Named<GLenum>& mode) {
  gl::Case c = with_current_values("0 to 9 vertices, every third explicit");
  define_and_enable(c, random_map(t, GL_MAP1_VERTEX_3, 4));
  draw_mixed_primitives(c, mode.value);
  t.expect_emission(c, kPosition | kTextureCoordinate0);
};

// The same with evaluated vertices of four components and explicit ones of three.
EVALCTS_TEST(Evaluation, MixedPrimitivesOfVertex4, kMust, "EV-COORD-PRIMS/1-D", "EV-COORD-MIX/1-D",
             combine(kModes).by(gl::without(gl::kMeshes, gl::curve_deliveries())))
(Test& t, const Named<GLenum>& mode) {
  gl::Case c = with_current_values("0 to 9 vertices, every third explicit");
  Map map = random_map(t, GL_MAP1_VERTEX_4, 4);
  for (std::size_t i = 3; i < map.points.size(); i += 4) map.points[i] = 1 + std::abs(map.points[i]);
  define_and_enable(c, map);
  draw_mixed_primitives(c, mode.value);
  t.expect_emission(c, kPosition | kTextureCoordinate0);
};

EVALCTS_TEST(Evaluation, MixedWithVertex, kMust, "EV-COORD-MIX/1-D", "EV-CUR-NEXTVERTEX/1-D",
             by(gl::curve_deliveries()))
(Test& t) {
  for (const GLenum target : kAttributeTargets) {
    gl::Case c = with_current_values(label(target) + ": EvalCoord, Vertex, EvalCoord, Vertex");
    define_and_enable(c, random_map(t, GL_MAP1_VERTEX_4, 3));
    define_and_enable(c, random_map(t, target, 3));
    c.Begin(GL_POINTS);
    c.EvalCoord1f(0.25f);
    c.Vertex3f(1, 2, 3);
    c.EvalCoord1d(0.75);
    c.Vertex2f(4, 5);
    c.Vertex4f(6, 7, 8, 2);
    c.EvalCoord1f(0.5f);
    c.Vertex3f(9, 9, 9);
    c.End();
    t.expect_emission(c, kUnit0);
  }
};

// The first argument is u and the second v: the patch differs along u and along v.
EVALCTS_TEST(Evaluation, FirstArgumentIsU, kMust, "EV-COORD-ARGORDER", by(gl::surface_deliveries()))
(Test& t) {
  gl::Case c("x is u, y is 10 v, z is 100 u v");
  define_and_enable(c, make_map2(GL_MAP2_VERTEX_3, 2, 2, {0, 0, 0, 0, 10, 0, 1, 0, 0, 1, 10, 100}));
  c.Begin(GL_POINTS);
  for (const float u : {0.0f, 0.25f, 1.0f})
    for (const float v : {0.0f, 0.75f, 1.0f}) c.EvalCoord2f(u, v);
  c.End();
  t.expect_emission(c, kPosition);
};

// Evaluates both dimensions alternately in one primitive, with a vertex map and one other map of each.
void expect_dimensions_in_turn(Test& t, GLenum target1, GLenum target2) {
  for (const GLenum mode : {GL_POINTS, GL_LINE_STRIP}) {
    gl::Case c(fmt::format("{}, {} and {}", gl::primitive_name(mode), label(target1), label(target2)));
    for (const GLenum target : {static_cast<GLenum>(GL_MAP1_VERTEX_3), target1})
      define_and_enable(c, random_map(t, target, 4));
    for (const GLenum target : {static_cast<GLenum>(GL_MAP2_VERTEX_4), target2})
      define_and_enable(c, random_map(t, target, {2, 3}));
    c.MapGrid1f(4, 0, 1);
    c.MapGrid2f(2, 1, 0, 3, 0, 1);
    c.Begin(mode);
    for (const float u : {0.0f, 0.375f, 1.0f}) {
      c.EvalCoord1f(u);
      c.EvalCoord2f(0.875f - 0.75f * u, 0.25f);
    }
    for (const GLint i : {0, 1}) {
      c.EvalPoint2(i, 2);
      c.EvalPoint1(i);
    }
    c.End();
    t.expect_emission(c, kUnit0);
  }
}

EVALCTS_TEST(Evaluation, DimensionsInTurn, kMust, "EV-COORD-MIXDIM", by(gl::list_deliveries()))
(Test& t) { expect_dimensions_in_turn(t, GL_MAP1_COLOR_4, GL_MAP2_COLOR_4); };

// Attributes without a map of the dimension come from the current values, not from maps of the other
// dimension.
EVALCTS_TEST(Evaluation, DimensionsInTurnWithOtherMaps, kMust, "EV-COORD-MIXDIM", "EV-COORD-CURRENT",
             by(gl::list_deliveries()))
(Test& t) {
  t.leave_current_values_to_their_rules();
  expect_dimensions_in_turn(t, GL_MAP1_COLOR_4, GL_MAP2_NORMAL);
};

EVALCTS_TEST_PAIR(Evaluation.NoArgumentIsAnError, Evaluation.NoArgumentIsAnError2, kMust,
                  decide("EV-COORD-NOERR/1-D", "EV-COORD-NOERR/2-D"), combine(kForms))
(Test& t, bool two, const Form& form) {
  gl::Case c("arguments over the whole range");
  define_and_enable(c, random_map(t, GL_MAP1_VERTEX_3, 4));
  c.Begin(GL_POINTS);
  for (int exponent = -149; exponent <= 127; exponent += 4)
    for (const double sign : {1.0, -1.0}) evaluate(c, sign * std::ldexp(1.0, exponent), form.doubles);
  if (form.doubles)
    for (const double u : {1e300, -1e300, 1e-300, -0.0}) evaluate(c, u, true);
  c.End();
  const gl::Ref error = c.GetError();
  for (const bool along_v : {true, false}) {
    if (!two && along_v) continue;
    Played played = t.play(two ? gl::lift(c, along_v) : c);
    played.expect_no_error(error);
  }
};

// The same call with the same state gives the same bits: repeated at once, in the next primitive, and after
// other calls.
EVALCTS_TEST(
    Evaluation, RepeatedCallSameBits, kMust, "EV-COORD-REPEAT/1-D",
    combine(visible_targets(kCurves)).by(gl::without(gl::kGrids | gl::kRepetition, gl::curve_deliveries())))
(Test& t, GLenum target) {
  gl::Case c("each argument four times");
  define(c, random_map(t, target, 7));
  enable_visibly(c, target);
  const std::vector<double> us = random_values(t.random(), 16);
  for (int round = 0; round < 2; ++round) {
    c.Begin(GL_POINTS);
    for (const double u : us) {
      c.EvalCoord1f(u);
      c.EvalCoord1f(u);
    }
    c.End();
  }
  const std::size_t count = 4 * us.size();
  const Observation seen = t.observe(c, attribute_of(target), count);
  const std::vector<ObservedVertex> vertices = vertices_of(seen);
  const auto fail = [&](const std::string& message, const std::string& expected,
                        const std::string& captured) {
    const std::string what = attribute_of(target) == kPosition ? "position" : label(target);
    t.fail(failure_of(c, what, message, expected, captured));
  };
  if (vertices.size() != count) {
    fail("wrong number of vertices", std::to_string(count), std::to_string(vertices.size()));
    return;
  }
  const auto same = [&](const ObservedVertex& a, const ObservedVertex& b) {
    return std::memcmp(&a.position, &b.position, sizeof a.position) == 0 &&
           std::memcmp(&a.color, &b.color, sizeof a.color) == 0 &&
           std::memcmp(&a.normal, &b.normal, sizeof a.normal) == 0 &&
           std::memcmp(&a.texture_coordinate[0], &b.texture_coordinate[0], sizeof a.texture_coordinate[0]) ==
               0;
  };
  for (std::size_t i = 0; i < us.size(); ++i)
    for (const std::size_t other : {2 * i + 1, 2 * us.size() + 2 * i, 2 * us.size() + 2 * i + 1})
      if (!same(vertices[2 * i], vertices[other]))
        fail(fmt::format("EvalCoord1f({}) gives different values when it is repeated (vertices {} and {})",
                         hexadecimal(us[i]), 2 * i, other),
             "the same bits", "other bits");
};

// --- Section 8: attributes produced ----------------------------------------------------------------------

EVALCTS_TEST(Attributes, Vertex3HasW1, kMust, "EV-ATTR-VERTEX3/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c("after vertices with other w and coordinates with other q");
  define_and_enable(c, random_map(t, GL_MAP1_VERTEX_3, 4));
  c.Begin(GL_POINTS);
  c.Vertex4f(1, 2, 3, 5);
  c.EvalCoord1f(0.25f);
  c.Vertex4f(1, 2, 3, 0.5f);
  c.EvalCoord1f(0.75f);
  c.End();
  define_and_enable(c, random_map(t, GL_MAP1_TEXTURE_COORD_4, 3));
  evaluate_some(c);
  t.expect_emission(c, kPosition);
};

// A quarter circle with varying w, by which evaluation must not divide.
EVALCTS_TEST(Attributes, Vertex4IsHomogeneous, kMust, "EV-ATTR-VERTEX4/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c("quarter circle, weights 1, 1, 2");
  define_and_enable(c, make_map1(GL_MAP1_VERTEX_4, {1, 0, 0, 1, 1, 1, 0, 1, 0, 2, 0, 2}));
  evaluate_all(c, steps(64));
  t.expect_emission(c, kPosition);
};

EVALCTS_TEST(Attributes, NegativeWStays, kMust, "EV-ATTR-VERTEX4/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c("w from 2 to -2");
  define_and_enable(c, make_map1(GL_MAP1_VERTEX_4, {1, 2, 3, 2, 4, 5, 6, -2}));
  evaluate_all(c, steps(8));
  t.expect_emission(c, kPosition);
};

EVALCTS_TEST(Attributes, OnlyVertexIsRational, kMust, "EV-ATTR-RATIONAL-ONLYVTX/1-D",
             combine(kAttributeTargets).by(gl::curve_deliveries()))
(Test& t, GLenum target) {
  gl::Case c("w from 1 to 4");
  define_and_enable(c, make_map1(GL_MAP1_VERTEX_4, {0, 0, 0, 1, 4, 0, 0, 4}));
  if (target == GL_MAP1_INDEX) throw NotObservable("INDEX maps show in colour-index contexts only");
  define_and_enable(c, random_map(t, target, 2));
  evaluate_some(c);
  t.expect_emission(c, kPosition | attribute_of(target));
};

EVALCTS_TEST(Attributes, ColorHasAlpha, kMust, "EV-ATTR-COLOR/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c = with_current_values("alpha from 0.25 to 0.75, current alpha 0.4");
  define(c, make_map1(GL_MAP1_COLOR_4, {0.125, 0.25, 0.5, 0.25, 0.875, 0.75, 0.625, 0.75}));
  enable_visibly(c, GL_MAP1_COLOR_4);
  evaluate_some(c);
  t.expect_emission(c, kColor);
};

EVALCTS_TEST(Attributes, ColorIsNotClamped, kMust, "EV-ATTR-COLOR-CLAMP/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c("components from -1 to 2");
  define(c, make_map1(GL_MAP1_COLOR_4, {-1, 2, 0.5, 3, 2, -1, 0.25, -2}));
  enable_visibly(c, GL_MAP1_COLOR_4);
  evaluate_some(c);
  const Observation probe = t.observe(c, kColor, 8);
  if (probe.clamped_colors) throw NotObservable("this implementation shows colours after their clamp only");
  t.expect_emission(c, kColor);
};

EVALCTS_TEST(Attributes, IndexDoesNothingInRGBA, kMust, "EV-ATTR-INDEX-RGBA/1-D", "EV-CUR-INDEX/1-D",
             by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c = with_current_values("INDEX map enabled");
  c.Indexf(9);
  define(c, make_map1(GL_MAP1_INDEX, {3, 4, 5}));
  enable_visibly(c, GL_MAP1_COLOR_4);
  c.Disable(GL_MAP1_COLOR_4);
  c.Enable(GL_MAP1_INDEX);
  evaluate_some(c);
  t.expect_emission(c, kPosition | kColor);
  CheckedCase queried(t, c);
  queried.expect_values(queried.GetFloatv(GL_CURRENT_INDEX, gl::out<GLfloat>(1)), {9});
  queried.check();
};

// Commands that draw points with maps over [0.5,2], in v over [-1,0.25], and a grid of 4 by 2 segments.
constexpr Named<void (*)(gl::Case&, bool two)> kIndexedPoints[] = {
    {"EvalCoord",
     [](gl::Case& c, bool two) {
       c.Begin(GL_POINTS);
       for (const double u : {0.5, 0.8125, 1.0, 2.0}) eval_coord(c, two, u, -0.125);
       c.End();
     }},
    {"EvalPoint",
     [](gl::Case& c, bool two) {
       c.Begin(GL_POINTS);
       for (int i = 0; i <= 4; ++i) eval_point(c, two, i, 1);
       c.End();
     }},
    {"EvalMesh", [](gl::Case& c, bool two) { eval_mesh(c, two, GL_POINT, 0, 4, 0, 2); }}};

// Returns the colour indices of the `count` points in the feedback buffer, or none if its contents differ
// from `count` points. Throws NotObservable if the context is not a colour-index context. `answers`: the
// queries of RGBA_MODE and of the buffer, and RenderMode.
std::vector<float> drawn_indices(const Played& played, const std::array<gl::Ref, 3>& answers,
                                 std::size_t count) {
  constexpr std::size_t kOfAPoint = 5;  // the token, x, y, z, and the index
  const auto& [is_rgba, buffer, size] = answers;
  if (played.trace().values<GLboolean>(is_rgba)[0])
    throw NotObservable("the context that was asked for is no colour-index context");
  const std::vector<GLfloat> values = played.trace().values<GLfloat>(buffer);
  std::vector<float> indices;
  if (played.trace().result(size) != static_cast<std::int64_t>(kOfAPoint * count)) return {};
  for (std::size_t i = 0; i < count; ++i) {
    if (values[kOfAPoint * i] != GL_POINT_TOKEN) return {};
    indices.push_back(values[kOfAPoint * i + 4]);
  }
  return indices;
}

// INDEX maps in a colour-index context: the index of an evaluated vertex is the value of the map, or the
// current index if the map is disabled. Explicit vertices after it have the current index.
EVALCTS_TEST_PAIR(Attributes.IndexInColorIndexMode1, Attributes.IndexInColorIndexMode2, kMust,
                  decide("EV-ATTR-INDEX/1-D", "EV-ATTR-INDEX/2-D"), combine(kIndexedPoints))
(Test& t, bool two, const Named<void (*)(gl::Case&, bool)>& points) {
  const auto in_context = [&](gl::Case& c, const gl::Case& drawn) {
    c.ContextOfKindEVALCTS(1, EVALCTS_COLOR_INDEX);
    constexpr std::size_t kRoom = 1024;
    const gl::Ref is_rgba = c.GetBooleanv(GL_RGBA_MODE, gl::out<GLboolean>(1));
    const gl::Ref buffer = c.FeedbackBuffer(kRoom, GL_3D_COLOR, gl::out<GLfloat>(kRoom));
    c.RenderMode(GL_FEEDBACK);
    c.append(drawn);
    return std::array{is_rgba, buffer, c.RenderMode(GL_RENDER)};
  };
  const auto with_domain = [&](Map map) {
    return two ? over(std::move(map), {0.5, 2}, {-1, 0.25}) : over(std::move(map), {0.5, 2});
  };
  const GLenum target = target_in(two, GL_MAP1_INDEX), vertices = target_in(two, GL_MAP1_VERTEX_3);
  for (const int order : {1, 2, 3, 5}) {
    gl::Case drawn;
    const std::vector<double> positions = {0.25, 0.5, -0.5, 0.5, -0.25, 0};
    define_and_enable(
        drawn, with_domain(two ? make_map2(vertices, 2, 1, positions) : make_map1(vertices, positions)));
    map_grid(drawn, two, {4, 0.5, 2}, {2, -1, 0.25});
    std::vector<double> indices =
        random_values(t.random(), static_cast<std::size_t>(two ? 2 * order : order));
    for (double& index : indices) index = 100 + 100 * index;
    define(drawn, with_domain(two ? make_map2(target, order, 2, indices) : make_map1(target, indices)));
    drawn.Indexf(9);
    points.value(drawn, two);  // not enabled yet
    drawn.Enable(target);
    points.value(drawn, two);
    drawn.Begin(GL_POINTS);
    eval_coord(drawn, two, 1, -0.5);
    drawn.Vertex3f(0.25f, 0.5f, 0);
    drawn.End();

    const Prediction prediction = predict(drawn, t.max_order());
    std::vector<reference::Vertex> expected;
    for (const reference::Primitive& primitive : prediction.primitives)
      expected.insert(expected.end(), primitive.vertices.begin(), primitive.vertices.end());

    gl::Case control("explicit vertices and indices");
    gl::Case explicit_points;
    explicit_points.Begin(GL_POINTS);
    for (const reference::Vertex& vertex : expected) {
      explicit_points.Indexf(reference::rounded(vertex.index));
      explicit_points.Vertex3f(reference::rounded(vertex.position[0]), reference::rounded(vertex.position[1]),
                               0);
    }
    explicit_points.End();
    const auto explicit_answers = in_context(control, explicit_points);
    const std::vector<float> given = drawn_indices(t.play(control), explicit_answers, expected.size());
    if (given.empty()) throw NotObservable("pipeline: explicit vertices do not come back in feedback mode");
    // GL may convert indices to fixed point (GL 2.1 2.14.6).
    double error = 0;
    for (std::size_t i = 0; i < given.size(); ++i)
      error =
          std::max(error, std::abs(static_cast<double>(given[i] - reference::rounded(expected[i].index))));
    if (error > 0.5)
      throw NotObservable("pipeline: explicit colour indices do not come back in feedback mode");

    gl::Case c(fmt::format("order {}", order));
    const auto answers = in_context(c, drawn);
    Played played = t.play(c);
    const std::vector<float> seen = drawn_indices(played, answers, expected.size());
    played.expect(!seen.empty(), answers[1], "other points are drawn",
                  fmt::format("{} points", expected.size()), "others");
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const reference::Component& index = expected[i].index;
      const reference::Rational exact = reference::exact(index);
      const reference::Rational bound = reference::acceptance_bound(index) + reference::Rational(2 * error);
      if (reference::must_applies(index, reference::guaranteed_range(target, 46)))
        played.expect(reference::is_within(seen[i], exact, bound), answers[1],
                      fmt::format("the colour index of vertex {}", i), reference::describe(exact),
                      hexadecimal(static_cast<double>(seen[i])));
    }
  }
};

EVALCTS_TEST(Attributes, NormalIsNotNormalised, kMust, "EV-ATTR-NORMAL/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c("lengths from 0.1 to 300");
  define(c, make_map1(GL_MAP1_NORMAL, {3, 0, 0, 0, 300, 0, 0, -200, -0.1f}));
  enable_visibly(c, GL_MAP1_NORMAL);
  evaluate_some(c);
  t.expect_emission(c, kNormal);
};

// Components that the map does not supply are 0, 0 and 1, not those of TexCoord4(5,6,7,8).
void expect_texture_defaults(Test& t, GLenum target) {
  gl::Case c("after TexCoord4(5,6,7,8) and a vertex with them");
  define(c, random_map(t, target, 3));
  enable_visibly(c, target);
  c.TexCoord4f(5, 6, 7, 8);
  c.Begin(GL_POINTS);
  c.Vertex2f(1, 1);
  c.EvalCoord1f(0.125f);
  c.EvalCoord1f(0.75f);
  c.End();
  t.expect_emission(c, kTextureCoordinate0);
}

EVALCTS_TEST(Attributes, TextureCoord1, kMust, "EV-ATTR-TEX1/1-D", by(gl::curve_deliveries()))
(Test& t) { expect_texture_defaults(t, GL_MAP1_TEXTURE_COORD_1); };
EVALCTS_TEST(Attributes, TextureCoord2, kMust, "EV-ATTR-TEX2/1-D", by(gl::curve_deliveries()))
(Test& t) { expect_texture_defaults(t, GL_MAP1_TEXTURE_COORD_2); };
EVALCTS_TEST(Attributes, TextureCoord3, kMust, "EV-ATTR-TEX3/1-D", by(gl::curve_deliveries()))
(Test& t) { expect_texture_defaults(t, GL_MAP1_TEXTURE_COORD_3); };
EVALCTS_TEST(Attributes, TextureCoord4, kMust, "EV-ATTR-TEX4/1-D", by(gl::curve_deliveries()))
(Test& t) { expect_texture_defaults(t, GL_MAP1_TEXTURE_COORD_4); };

EVALCTS_TEST(Attributes, TextureMapsFeedUnit0, kMust, "EV-ATTR-UNIT0/1-D", "EV-ATTR-OTHERUNITS/1-D",
             combine(kTextureTargets).by(gl::curve_deliveries()))
(Test& t, GLenum target) {
  require_texture_units(t);
  gl::Case c("evaluated with TEXTURE1 active; units 1 and up hold current values");
  define(c, random_map(t, target, 3));
  enable_visibly(c, target);
  for (int unit = 0; unit < t.gl().texture_units && unit < 8; ++unit)
    c.MultiTexCoord4f(GL_TEXTURE0 + static_cast<GLenum>(unit), 10.0f + static_cast<float>(unit), 0.5f, 0.25f,
                      2.0f);
  c.ActiveTexture(GL_TEXTURE1);
  evaluate_some(c);
  t.expect_emission(c, kTextureCoordinate0 | kTextureCoordinatesOther);
};

// --- Section 9: precedence -------------------------------------------------------------------------------

EVALCTS_TEST(Precedence, Vertex4BeforeVertex3, kMust, "EV-PREC-VERTEX/1-D", "EV-PREC-ORDERFREE/1-D",
             by(gl::curve_deliveries()))
(Test& t) {
  for (const bool four_first : {false, true}) {
    gl::Case c(four_first ? "VERTEX_4 defined and enabled first" : "VERTEX_3 defined and enabled first");
    Map three = random_map(t, GL_MAP1_VERTEX_3, 3);
    const Map four = random_map(t, GL_MAP1_VERTEX_4, 4);
    three.u1 = 2;
    for (const Map* map : {four_first ? &four : &three, four_first ? &three : &four})
      define_and_enable(c, *map);
    evaluate_some(c);
    t.expect_emission(c, kPosition);
  }
};

// All 15 nonempty subsets of the texture maps, enabled in ascending and in descending order.
EVALCTS_TEST(Precedence, MostTextureCoordinates, kMust, "EV-PREC-TEX/1-D", "EV-PREC-LOSER-IGNORED/1-D",
             "EV-PREC-ORDERFREE/1-D", by(gl::curve_deliveries()))
(Test& t) {
  for (const bool upwards : {true, false}) {
    gl::Case c(upwards ? "all subsets, enabled upwards" : "all subsets, enabled downwards");
    c.TexCoord4f(5, 6, 7, 8);
    define_and_enable(c, random_map(t, GL_MAP1_VERTEX_3, 2));
    // All maps differ in order and domain.
    int order = 2;
    for (const GLenum target : kTextureTargets) {
      const Map map = random_map(t, target, order++);
      define(c, over(map, {-0.25 * order, 1.0 * order}));
    }
    for (unsigned subset = 1; subset < 16; ++subset) {
      for (unsigned i = 0; i < 4; ++i) c.Disable(kTextureTargets[i]);
      for (unsigned i = 0; i < 4; ++i) {
        const unsigned which = upwards ? i : 3 - i;
        if (subset >> which & 1u) c.Enable(kTextureTargets[which]);
      }
      evaluate_some(c);
    }
    t.expect_emission(c, kTextureCoordinate0);
  }
};

// Subsets of the nine enables that contain a vertex map, in the order of the Gray code, so that one enable
// changes at a time. INDEX is among them although its values are not visible. Quick depth draws every 13th
// subset only, because with some captures a library compiles a program for each; 13 has no common factor with
// 512, so that all enables vary.
EVALCTS_TEST(Precedence, AllSubsets, kMust, "EV-PREC-VERTEX/1-D", "EV-PREC-TEX/1-D", "EV-PREC-PERKIND/1-D",
             "EV-EN-MULTI", by(gl::curve_deliveries()))
(Test& t) {
  t.leave_current_values_to_their_rules();
  const unsigned step = t.depth() == Depth::kQuick ? 13 : 1;
  gl::Case c = with_current_values("subsets of the nine enables");
  for (const GLenum target : gl::kMap1Targets) define(c, random_map(t, target, 3));
  static_assert(gl::kMap1Targets[7] == GL_MAP1_VERTEX_3 && gl::kMap1Targets[8] == GL_MAP1_VERTEX_4);
  constexpr unsigned kVertexMaps = 1u << 7 | 1u << 8;
  unsigned enabled = 0;
  for (unsigned i = 1; i <= 512; ++i) {
    const unsigned code = (i & 511u) ^ (i & 511u) >> 1;
    const unsigned changed = code ^ enabled;
    for (std::size_t bit = 0; bit < 9; ++bit) {
      const GLenum target = gl::kMap1Targets[bit];
      if (changed >> bit & 1u) code >> bit & 1u ? c.Enable(target) : c.Disable(target);
    }
    enabled = code;
    if (!(enabled & kVertexMaps) || i % step) continue;
    c.Begin(GL_POINTS);
    c.EvalCoord1f(static_cast<float>(i) / 512);
    c.End();
  }
  t.expect_emission(c, kUnit0);
};

EVALCTS_TEST(Precedence, DisabledWinnerGivesWay, kMust, "EV-PREC-FALLBACK/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c("texture maps 4 to 1, then VERTEX_4, disabled one after the other");
  for (const GLenum target : visible_targets(kCurves)) define_and_enable(c, random_map(t, target, 3));
  evaluate_some(c);
  for (const GLenum target : {GL_MAP1_TEXTURE_COORD_4, GL_MAP1_TEXTURE_COORD_3, GL_MAP1_TEXTURE_COORD_2,
                              GL_MAP1_TEXTURE_COORD_1, GL_MAP1_VERTEX_4}) {
    c.Disable(target);
    evaluate_some(c);
  }
  t.expect_emission(c, kPosition | kTextureCoordinate0);
};

EVALCTS_TEST(Precedence, UndefinedWinnerStillWins, kMust, "EV-PREC-NOVALIDITY/1-D",
             by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c("VERTEX_3 and TEXTURE_COORD_1 defined, VERTEX_4 and TEXTURE_COORD_4 only enabled");
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_TEXTURE_COORD_1})
    define_and_enable(c, random_map(t, target, 3));
  c.Enable(GL_MAP1_VERTEX_4);
  c.Enable(GL_MAP1_TEXTURE_COORD_4);
  evaluate_some(c);
  t.expect_emission(c, kPosition | kTextureCoordinate0);
};

}  // namespace
}  // namespace evalcts::suite_evaluation
