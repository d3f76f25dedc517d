// Section 7 of the requirements: the vertices that evaluation commands emit. Most cases are
// one-dimensional and become two-dimensional ones by their deliveries; the executable specification predicts
// the vertices.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>

#include <evalcts/gl/hexadecimal.h>
#include <evalcts/gl/lift.h>
#include <evalcts/testkit/registration.h>
#include "dimensions.h"
#include "maps.h"

namespace evalcts::suite_evaluation {
namespace {

std::vector<gl::Ref> query_current_values(gl::Case& c) {
  return {
      c.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4)), c.GetFloatv(GL_CURRENT_NORMAL, gl::out<GLfloat>(3)),
      c.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4)),
      c.GetFloatv(GL_CURRENT_INDEX, gl::out<GLfloat>(1)), c.GetBooleanv(GL_EDGE_FLAG, gl::out<GLboolean>(1))};
}

// --- Section 7: evaluation commands ----------------------------------------------------------------------

EVALCTS_TEST(Evaluation, AllKindsTogether, kMust, "EV-COORD-ASIF/1-D", "EV-COORD-VERTEXLAST/1-D",
             "EV-PREC-PERKIND/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c = with_current_values(
      "colour, index, normal, texture coordinate and vertex maps, each different at every u");
  for (const GLenum target :
       {GL_MAP1_VERTEX_4, GL_MAP1_COLOR_4, GL_MAP1_INDEX, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_3})
    define_and_enable(c, random_map(t, target, 4));
  evaluate_all(c, unit_steps(20));
  t.judge_vertices(c, kUnit0);
};

EVALCTS_TEST(Evaluation, VertexCarriesItsOwnAttributes, kMust, "EV-COORD-VERTEXLAST/1-D",
             combine(visible_targets(kCurves)).by(gl::curve_deliveries()))
(Test& t, GLenum target) {
  gl::Case c = with_current_values("first vertex of a primitive, then far jumps of u");
  define_and_enable(c, random_map(t, GL_MAP1_VERTEX_3, 2));
  define_and_enable(c, random_map(t, target, 2));
  for (int primitive = 0; primitive < 2; ++primitive) evaluate_all(c, {1.0, 0.0, 1.0, 0.5});
  t.judge_vertices(c, kPosition | attribute_of(target));
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
  t.judge_vertices(c, kUnit0);
};

// No float can hold the position, and the vertex is there nevertheless. Random search has found this case.
EVALCTS_TEST(Evaluation, PointBeyondFloat, kMust, "EV-COORD-ASIF/1-D")
(Test& t) {
  gl::Case c("argument 1000 on a line that ends at 3e38");
  c.Enable(GL_MAP1_VERTEX_3);
  c.Map1d(GL_MAP1_VERTEX_3, 0, 1, 3, 2, std::vector<GLdouble>{0, 0, 0, 3e38, 0, 0});
  c.Begin(GL_POINTS);
  c.EvalCoord1f(1000);
  c.End();
  t.judge(c);
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
    t.judge_vertices(c, kUnit0);
  }
};

// Without a vertex map an evaluation has no effect.
EVALCTS_TEST(Evaluation, NothingWithoutVertexMap, kMust, "EV-COORD-NOVERTEX/1-D",
             combine(kAttributeTargets).by(gl::curve_deliveries()))
(Test& t, GLenum target) {
  gl::Case c("no vertex map enabled");
  set_current_values(c);
  c.Indexf(9);
  c.EdgeFlag(GL_FALSE);
  define(c, random_map(t, target, 3));
  define(c, random_map(t, GL_MAP1_VERTEX_3, 3));  // defined, not enabled
  c.Enable(target);
  t.compare_only(query_current_values(c));
  evaluate_some(c);
  c.GetError();
  t.compare_only(query_current_values(c));
  t.judge(c);

  gl::Case drawing = with_current_values("nothing is drawn, and the Vertex between has the current values");
  define_and_enable(drawing, random_map(t, target, 3));
  drawing.Begin(GL_POINTS);
  drawing.EvalCoord1f(0.5f);
  drawing.Vertex3f(1, 2, 3);
  drawing.EvalCoord1f(0.25f);
  drawing.End();
  t.judge_vertices(drawing, kUnit0);

  gl::Case empty("nothing is drawn");
  define_and_enable(empty, random_map(t, target, 3));
  evaluate_some(empty);
  t.judge_vertices(empty, kPosition);
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
  t.judge_vertices(c, kUnit0);
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
    t.judge_vertices(c, kUnit0);
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
    t.judge_vertices(c, kUnit0);
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
    CheckedTrace checked = t.play(two ? gl::lift(c, true) : c);
    checked.expect_no_error(error);
  }
};

constexpr NamedValue<GLenum> kModes[] = {{"POINTS", GL_POINTS},
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
(Test& t, const NamedValue<GLenum>& mode) {
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
  t.judge_vertices(c, kPosition | kTextureCoordinate0);
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
(Test& t, const NamedValue<GLenum>& mode) {
  gl::Case c = with_current_values("0 to 9 vertices, every third explicit");
  define_and_enable(c, random_map(t, GL_MAP1_VERTEX_3, 4));
  draw_mixed_primitives(c, mode.value);
  t.judge_vertices(c, kPosition | kTextureCoordinate0);
};

// The same with evaluated vertices of four components and explicit ones of three.
EVALCTS_TEST(Evaluation, MixedPrimitivesOfVertex4, kMust, "EV-COORD-PRIMS/1-D", "EV-COORD-MIX/1-D",
             combine(kModes).by(gl::without(gl::kMeshes, gl::curve_deliveries())))
(Test& t, const NamedValue<GLenum>& mode) {
  gl::Case c = with_current_values("0 to 9 vertices, every third explicit");
  Map map = random_map(t, GL_MAP1_VERTEX_4, 4);
  for (std::size_t i = 3; i < map.points.size(); i += 4) map.points[i] = 1 + std::abs(map.points[i]);
  define_and_enable(c, map);
  draw_mixed_primitives(c, mode.value);
  t.judge_vertices(c, kPosition | kTextureCoordinate0);
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
    t.judge_vertices(c, kUnit0);
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
  t.judge_vertices(c, kPosition);
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
    t.judge_vertices(c, kUnit0);
  }
}

EVALCTS_TEST(Evaluation, DimensionsInTurn, kMust, "EV-COORD-MIXDIM", by(gl::list_deliveries()))
(Test& t) { expect_dimensions_in_turn(t, GL_MAP1_COLOR_4, GL_MAP2_COLOR_4); };

// Attributes without a map of the dimension come from the current values, not from maps of the other
// dimension.
EVALCTS_TEST(Evaluation, DimensionsInTurnWithOtherMaps, kMust, "EV-COORD-MIXDIM", "EV-COORD-CURRENT",
             by(gl::list_deliveries()))
(Test& t) { expect_dimensions_in_turn(t, GL_MAP1_COLOR_4, GL_MAP2_NORMAL); };

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
    CheckedTrace checked = t.play(two ? gl::lift(c, along_v) : c);
    checked.expect_no_error(error);
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
    t.fail(failure_of(c, "number of vertices",
                      fmt::format("number of vertices: {} instead of {}", vertices.size(), count),
                      std::to_string(count), std::to_string(vertices.size())));
    return;
  }
  const Attributes compared = attribute_of(target) & seen.attributes;
  const auto same = [&](const ObservedVertex& a, const ObservedVertex& b) {
    const auto agree = [&](Attribute attribute, const auto& x, const auto& y) {
      return !(compared & attribute) || std::memcmp(&x, &y, sizeof x) == 0;
    };
    return agree(kPosition, a.position, b.position) && agree(kColor, a.color, b.color) &&
           agree(kNormal, a.normal, b.normal) &&
           agree(kTextureCoordinate0, a.texture_coordinate[0], b.texture_coordinate[0]);
  };
  for (std::size_t i = 0; i < us.size(); ++i)
    for (const std::size_t other : {2 * i + 1, 2 * us.size() + 2 * i, 2 * us.size() + 2 * i + 1})
      if (!same(vertices[2 * i], vertices[other]))
        fail(fmt::format("EvalCoord1f({}) gives different values when it is repeated (vertices {} and {})",
                         hexadecimal(us[i]), 2 * i, other),
             "the same bits", "other bits");
};

}  // namespace
}  // namespace evalcts::suite_evaluation
