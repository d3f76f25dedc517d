// Sections 8 and 9 of the requirements: the attributes that evaluation produces, and the precedence of maps.
// Most cases are one-dimensional and become two-dimensional ones by their deliveries.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <evalcts/gl/contexts.h>
#include <evalcts/gl/hexadecimal.h>
#include <evalcts/judge/prediction.h>
#include <evalcts/testkit/registration.h>
#include <reference/acceptance.h>
#include <reference/component.h>
#include <reference/map.h>
#include "dimensions.h"
#include "grid_cases.h"

namespace evalcts::suite_attributes {
namespace {

constexpr GLenum kTextureTargets[] = {GL_MAP1_TEXTURE_COORD_1, GL_MAP1_TEXTURE_COORD_2,
                                      GL_MAP1_TEXTURE_COORD_3, GL_MAP1_TEXTURE_COORD_4};

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
  t.judge_vertices(c, kPosition);
};

// A quarter circle with varying w, by which evaluation must not divide.
EVALCTS_TEST(Attributes, Vertex4IsHomogeneous, kMust, "EV-ATTR-VERTEX4/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c("quarter circle, weights 1, 1, 2");
  define_and_enable(c, make_map1(GL_MAP1_VERTEX_4, {1, 0, 0, 1, 1, 1, 0, 1, 0, 2, 0, 2}));
  evaluate_all(c, unit_steps(64));
  t.judge_vertices(c, kPosition);
};

EVALCTS_TEST(Attributes, NegativeWStays, kMust, "EV-ATTR-VERTEX4/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c("w from 2 to -2");
  define_and_enable(c, make_map1(GL_MAP1_VERTEX_4, {1, 2, 3, 2, 4, 5, 6, -2}));
  evaluate_all(c, unit_steps(8));
  t.judge_vertices(c, kPosition);
};

EVALCTS_TEST(Attributes, OnlyVertexIsRational, kMust, "EV-ATTR-RATIONAL-ONLYVTX/1-D",
             combine(kAttributeTargets).by(gl::curve_deliveries()))
(Test& t, GLenum target) {
  gl::Case c("w from 1 to 4");
  define_and_enable(c, make_map1(GL_MAP1_VERTEX_4, {0, 0, 0, 1, 4, 0, 0, 4}));
  if (target == GL_MAP1_INDEX) throw NotObservable("INDEX maps show in colour-index contexts only");
  define_and_enable(c, random_map(t, target, 2));
  evaluate_some(c);
  t.judge_vertices(c, kPosition | attribute_of(target));
};

EVALCTS_TEST(Attributes, ColorHasAlpha, kMust, "EV-ATTR-COLOR/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c = with_current_values("alpha from 0.25 to 0.75, current alpha 0.4");
  define(c, make_map1(GL_MAP1_COLOR_4, {0.125, 0.25, 0.5, 0.25, 0.875, 0.75, 0.625, 0.75}));
  enable_visibly(c, GL_MAP1_COLOR_4);
  evaluate_some(c);
  t.judge_vertices(c, kColor);
};

EVALCTS_TEST(Attributes, ColorIsNotClamped, kMust, "EV-ATTR-COLOR-CLAMP/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c("components from -1 to 2");
  define(c, make_map1(GL_MAP1_COLOR_4, {-1, 2, 0.5, 3, 2, -1, 0.25, -2}));
  enable_visibly(c, GL_MAP1_COLOR_4);
  evaluate_some(c);
  const Observation probe = t.observe(c, kColor, 8);
  if (probe.clamped_colors) throw NotObservable("this implementation shows colours after their clamp only");
  t.judge_vertices(c, kColor);
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
  t.judge_vertices(c, kPosition | kColor);
  c.GetFloatv(GL_CURRENT_INDEX, gl::out<GLfloat>(1));
  t.judge_answers(c);
};

// Commands that draw points with maps over [0.5,2], in v over [-1,0.25], and a grid of 4 by 2 segments.
constexpr NamedValue<void (*)(gl::Case&, bool two)> kIndexedPoints[] = {
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
std::vector<float> drawn_indices(const CheckedTrace& checked, const std::array<gl::Ref, 3>& answers,
                                 std::size_t count) {
  constexpr std::size_t kOfAPoint = 5;  // the token, x, y, z, and the index
  const auto& [is_rgba, buffer, size] = answers;
  if (checked.trace().values<GLboolean>(is_rgba)[0])
    throw NotObservable("the context that was asked for is no colour-index context");
  const std::vector<GLfloat> values = checked.trace().values<GLfloat>(buffer);
  std::vector<float> indices;
  if (checked.trace().result(size) != static_cast<std::int64_t>(kOfAPoint * count)) return {};
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
(Test& t, bool two, const NamedValue<void (*)(gl::Case&, bool)>& points) {
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
    CheckedTrace checked = t.play(c);
    const std::vector<float> seen = drawn_indices(checked, answers, expected.size());
    checked.expect(!seen.empty(), answers[1], "other points are drawn",
                   fmt::format("{} points", expected.size()), "others");
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const reference::Component& index = expected[i].index;
      const reference::Rational exact = reference::exact(index);
      const reference::Rational bound = reference::acceptance_bound(index) + reference::Rational(2 * error);
      if (reference::must_applies(index, reference::guaranteed_range(target, 46)))
        checked.expect(reference::is_within(seen[i], exact, bound), answers[1],
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
  t.judge_vertices(c, kNormal);
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
  t.judge_vertices(c, kTextureCoordinate0);
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
  for (int unit = 0; unit < t.texture_units(); ++unit)
    c.MultiTexCoord4f(GL_TEXTURE0 + static_cast<GLenum>(unit), 10.0f + static_cast<float>(unit), 0.5f, 0.25f,
                      2.0f);
  c.ActiveTexture(GL_TEXTURE1);
  evaluate_some(c);
  c.ActiveTexture(GL_TEXTURE0);  // a list that is called twice defines the maps again
  t.judge_vertices(c, kTextureCoordinate0 | kTextureCoordinatesOther);
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
    t.judge_vertices(c, kPosition);
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
    for (const unsigned subset : {3u, 6u, 12u, 5u, 10u, 9u, 7u, 11u, 13u, 14u, 15u, 1u, 2u, 4u, 8u}) {
      for (unsigned i = 0; i < 4; ++i) c.Disable(kTextureTargets[i]);
      for (unsigned i = 0; i < 4; ++i) {
        const unsigned which = upwards ? i : 3 - i;
        if (subset >> which & 1u) c.Enable(kTextureTargets[which]);
      }
      evaluate_some(c);
    }
    t.judge_vertices(c, kTextureCoordinate0);
  }
};

// Subsets of the nine enables that contain a vertex map, in the order of the Gray code, so that one enable
// changes at a time. INDEX is among them although its values are not visible. Quick depth draws every 13th
// subset only, because with some captures a library compiles a program for each; 13 has no common factor with
// 512, so that all enables vary.
EVALCTS_TEST(Precedence, AllSubsets, kMust, "EV-PREC-VERTEX/1-D", "EV-PREC-TEX/1-D", "EV-PREC-PERKIND/1-D",
             "EV-EN-MULTI", by(gl::curve_deliveries()))
(Test& t) {
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
  t.judge_vertices(c, kUnit0);
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
  t.judge_vertices(c, kPosition | kTextureCoordinate0);
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
  t.judge_vertices(c, kPosition | kTextureCoordinate0);
};

}  // namespace
}  // namespace evalcts::suite_attributes
