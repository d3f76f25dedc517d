// Section 2 of the requirements: the state of a fresh context. Every case begins with its queries.
#include <evalcts/testkit/registration.h>

#include "maps.h"

namespace evalcts::suite_initial_state {
namespace {

std::vector<GLenum> both(const std::array<GLenum, 9>& first, const std::array<GLenum, 9>& second) {
  std::vector<GLenum> all(first.begin(), first.end());
  all.insert(all.end(), second.begin(), second.end());
  return all;
}

std::vector<GLenum> all_targets() { return both(gl::kMap1Targets, gl::kMap2Targets); }

// The single initial control point.
std::vector<double> initial_point(GLenum target) {
  switch (target) {
    case GL_MAP1_COLOR_4:
    case GL_MAP2_COLOR_4:
      return {1, 1, 1, 1};
    case GL_MAP1_INDEX:
    case GL_MAP2_INDEX:
      return {1};
    case GL_MAP1_NORMAL:
    case GL_MAP2_NORMAL:
      return {0, 0, 1};
    case GL_MAP1_TEXTURE_COORD_4:
    case GL_MAP2_TEXTURE_COORD_4:
    case GL_MAP1_VERTEX_4:
    case GL_MAP2_VERTEX_4:
      return {0, 0, 0, 1};
    default:
      return std::vector<double>(static_cast<std::size_t>(gl::components_of(target)), 0.0);
  }
}

bool is_texture_map(GLenum target) {
  return target >= GL_MAP2_TEXTURE_COORD_1 && target <= GL_MAP2_TEXTURE_COORD_4;
}

bool is_plain(GLenum target) {
  return target != GL_MAP1_COLOR_4 && target != GL_MAP2_COLOR_4 && target != GL_MAP1_NORMAL &&
         target != GL_MAP2_NORMAL;
}

void expect_initial_points(Test& t, std::initializer_list<GLenum> targets) {
  for (const GLenum target : targets) {
    gl::Case c(label(target));
    const gl::Ref single = c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(8));
    const gl::Ref real = c.GetMapdv(target, GL_COEFF, gl::out<GLdouble>(8));
    const gl::Ref integer = c.GetMapiv(target, GL_COEFF, gl::out<GLint>(8));
    Played played = t.play(c);
    // Colours and normals may come scaled (C-GETMAPIV-NORM).
    if (is_plain(target)) played.expect_values(integer, initial_point(target));
    played.expect_values(single, initial_point(target));
    played.expect_values(real, initial_point(target));
  }
}

void expect_initial_order(Test& t, GLenum target, const std::vector<double>& order) {
  gl::Case c(label(target));
  const gl::Ref integer = c.GetMapiv(target, GL_ORDER, gl::out<GLint>(4));
  const gl::Ref single = c.GetMapfv(target, GL_ORDER, gl::out<GLfloat>(4));
  const gl::Ref real = c.GetMapdv(target, GL_ORDER, gl::out<GLdouble>(4));
  Played played = t.play(c);
  for (const gl::Ref query : {integer, single, real}) played.expect_values(query, order);
}

EVALCTS_TEST(InitialState, MapsDisabled, must, "EV-INIT-MAPS-OFF")
(Test& t) {
  t.require_initial_state();
  gl::Case c("all 18 enables");
  std::vector<gl::Ref> is, get;
  for (const GLenum target : all_targets()) {
    is.push_back(c.IsEnabled(target));
    get.push_back(c.GetBooleanv(target, gl::out<GLboolean>(1)));
  }
  Played played = t.play(c);
  for (const gl::Ref ref : is) played.expect_result(ref, GL_FALSE);
  for (const gl::Ref ref : get) played.expect_values(ref, std::vector<GLboolean>{GL_FALSE});
};

EVALCTS_TEST(InitialState, AutoNormalDisabled, must, "EV-INIT-AUTON-OFF")
(Test& t) {
  t.require_initial_state();
  gl::Case c("AUTO_NORMAL");
  const gl::Ref is = c.IsEnabled(GL_AUTO_NORMAL);
  const gl::Ref get = c.GetBooleanv(GL_AUTO_NORMAL, gl::out<GLboolean>(1));
  Played played = t.play(c);
  played.expect_result(is, GL_FALSE);
  played.expect_values(get, std::vector<GLboolean>{GL_FALSE});
};

EVALCTS_TEST(InitialState, OrderOf1D, must, "EV-INIT-ORDER1")
(Test& t) {
  t.require_initial_state();
  for (const GLenum target : gl::kMap1Targets) expect_initial_order(t, target, {1});
};

EVALCTS_TEST(InitialState, OrderOf2D, must, "EV-INIT-ORDER2")
(Test& t) {
  t.require_initial_state();
  for (const GLenum target : gl::kMap2Targets) expect_initial_order(t, target, {1, 1});
};

EVALCTS_TEST(InitialState, VertexPoint, must, "EV-INIT-COEFF-VERTEX")
(Test& t) {
  t.require_initial_state();
  expect_initial_points(t, {GL_MAP1_VERTEX_3, GL_MAP1_VERTEX_4, GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4});
};

EVALCTS_TEST(InitialState, NormalPoint, must, "EV-INIT-COEFF-NORMAL")
(Test& t) { expect_initial_points(t, {GL_MAP1_NORMAL, GL_MAP2_NORMAL}); };

EVALCTS_TEST(InitialState, ColorPoint, must, "EV-INIT-COEFF-COLOR")
(Test& t) { expect_initial_points(t, {GL_MAP1_COLOR_4, GL_MAP2_COLOR_4}); };

EVALCTS_TEST(InitialState, IndexPoint, must, "EV-INIT-COEFF-INDEX")
(Test& t) { expect_initial_points(t, {GL_MAP1_INDEX, GL_MAP2_INDEX}); };

EVALCTS_TEST(InitialState, TexturePoint, must, "EV-INIT-COEFF-TEX")
(Test& t) {
  t.require_initial_state();
  t.require(1, 1);
  expect_initial_points(t, {GL_MAP1_TEXTURE_COORD_1, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_TEXTURE_COORD_3,
                            GL_MAP1_TEXTURE_COORD_4, GL_MAP2_TEXTURE_COORD_1, GL_MAP2_TEXTURE_COORD_2,
                            GL_MAP2_TEXTURE_COORD_3, GL_MAP2_TEXTURE_COORD_4});
};

EVALCTS_TEST(InitialState, Domain, quality, "EV-INIT-DOMAIN")
(Test& t) {
  t.require_initial_state();
  for (const GLenum target : all_targets()) {
    const bool two = gl::token_name(target).find("MAP2") != std::string::npos;
    gl::Case c(label(target));
    const gl::Ref single = c.GetMapfv(target, GL_DOMAIN, gl::out<GLfloat>(4));
    const gl::Ref real = c.GetMapdv(target, GL_DOMAIN, gl::out<GLdouble>(4));
    Played played = t.play(c);
    const std::vector<double> expected = two ? std::vector<double>{0, 1, 0, 1} : std::vector<double>{0, 1};
    played.expect_values(single, expected);
    played.expect_values(real, expected);
  }
};

EVALCTS_TEST(InitialState, Grid1, must, "EV-INIT-GRID1")
(Test& t) {
  t.require_initial_state();
  gl::Case c("MAP1_GRID");
  const gl::Ref domain = c.GetFloatv(GL_MAP1_GRID_DOMAIN, gl::out<GLfloat>(2));
  const gl::Ref real = c.GetDoublev(GL_MAP1_GRID_DOMAIN, gl::out<GLdouble>(2));
  const gl::Ref integer = c.GetIntegerv(GL_MAP1_GRID_DOMAIN, gl::out<GLint>(2));
  const gl::Ref segments = c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
  Played played = t.play(c);
  for (const gl::Ref other : {real, integer}) played.expect_values(other, std::vector<double>{0, 1});
  played.expect_values(domain, std::vector<GLfloat>{0, 1});
  played.expect_values(segments, std::vector<GLint>{1});
};

EVALCTS_TEST(InitialState, Grid2, must, "EV-INIT-GRID2")
(Test& t) {
  t.require_initial_state();
  gl::Case c("MAP2_GRID");
  const gl::Ref domain = c.GetFloatv(GL_MAP2_GRID_DOMAIN, gl::out<GLfloat>(4));
  const gl::Ref real = c.GetDoublev(GL_MAP2_GRID_DOMAIN, gl::out<GLdouble>(4));
  const gl::Ref integer = c.GetIntegerv(GL_MAP2_GRID_DOMAIN, gl::out<GLint>(4));
  const gl::Ref segments = c.GetIntegerv(GL_MAP2_GRID_SEGMENTS, gl::out<GLint>(2));
  Played played = t.play(c);
  for (const gl::Ref other : {real, integer}) played.expect_values(other, std::vector<double>{0, 1, 0, 1});
  played.expect_values(domain, std::vector<GLfloat>{0, 1, 0, 1});
  played.expect_values(segments, std::vector<GLint>{1, 1});
};

EVALCTS_TEST(InitialState, Evaluable, must, "EV-INIT-EVALUABLE")
(Test& t) {
  t.require_initial_state();
  for (const GLenum vertex : {GL_MAP1_VERTEX_3, GL_MAP1_VERTEX_4}) {
    gl::Case c(label(vertex));
    c.Enable(vertex);
    c.Begin(GL_POINTS);
    for (const float u : {-3.0f, 0.0f, 0.5f, 7.0f}) c.EvalCoord1f(u);
    c.End();
    t.expect_emission(c, kPosition);
  }
};

EVALCTS_TEST(InitialState, Evaluable2, must, "EV-INIT-EVALUABLE", combine(visible_targets(kSurfaces)))
(Test& t, GLenum target) {
  t.require_initial_state();
  if (is_texture_map(target)) t.require(1, 1);
  gl::Case c(label(target));
  set_current_values(c, {.normal = {0.5f, 0.6f, 0.7f}});
  if (target != GL_MAP2_VERTEX_4) c.Enable(GL_MAP2_VERTEX_3);
  c.Enable(target);
  c.Begin(GL_POINTS);
  for (const float u : {-3.0f, 0.0f, 0.5f, 7.0f}) c.EvalCoord2f(u, 0.25f - u);
  c.End();
  t.expect_emission(c, attribute_of(target));
};

// Every other map as well: its initial constant, on a vertex map that was never defined either.
EVALCTS_TEST(InitialState, EvaluableWith, must, "EV-INIT-EVALUABLE", combine(visible_targets(kCurves)))
(Test& t, GLenum target) {
  t.require_initial_state();
  if (target >= GL_MAP1_TEXTURE_COORD_1 && target <= GL_MAP1_TEXTURE_COORD_4) t.require(1, 1);
  gl::Case c(label(target));
  set_current_values(c, {.normal = {0.5f, 0.6f, 0.7f}});
  c.Enable(GL_MAP1_VERTEX_3);
  c.Enable(target);
  c.Begin(GL_POINTS);
  for (const float u : {-3.0f, 0.0f, 0.5f, 7.0f}) c.EvalCoord1f(u);
  c.End();
  t.expect_emission(c, attribute_of(target));
};

EVALCTS_TEST(InitialState, MaxEvalOrder, must, "EV-INIT-MAXORDER/1-D")
(Test& t) {
  t.require_initial_state();
  gl::Case limit("MAX_EVAL_ORDER");
  const gl::Ref query = limit.GetIntegerv(GL_MAX_EVAL_ORDER, gl::out<GLint>(1));
  Played played = t.play(limit);
  const GLint order = played.trace().values<GLint>(query)[0];
  played.expect(played.trace().written(query) == 1 && order >= 8, query,
                "MAX_EVAL_ORDER is below 8 or no single value", "one value, at least 8",
                std::to_string(order));
  if (order < 1 || order > 1 << 16) return;
  for (const GLenum target : gl::kMap1Targets) {
    const Map map = make_map1(
        target, random_values(t.random(), static_cast<std::size_t>(order * gl::components_of(target))));
    gl::Case c(label(target));
    define(c, map);
    const gl::Ref error = c.GetError();
    const gl::Ref defined = c.GetMapiv(target, GL_ORDER, gl::out<GLint>(1));
    Played defining = t.play(c);
    defining.expect_no_error(error);
    defining.expect_values(defined, std::vector<GLint>{order});
  }
};

// The same value serves two dimensions, and u as well as v.
EVALCTS_TEST(InitialState, MaxEvalOrder2, must, "EV-INIT-MAXORDER/2-D", combine(gl::kMap2Targets))
(Test& t, GLenum target) {
  t.require_initial_state();
  const int max = t.max_order();
  const bool is_limit = t.order_limit() == max;
  gl::Case c("MAX x MAX, MAX x 2, 2 x MAX, and one more");
  std::vector<gl::Ref> accepted, defined, refused;
  const std::pair<int, int> orders[] = {{max, max}, {max, 2}, {2, max}};
  for (const auto& [u, v] : orders) {
    define(c, random_map(t, target, {u, v}));
    accepted.push_back(c.GetError());
    defined.push_back(c.GetMapiv(target, GL_ORDER, gl::out<GLint>(2)));
    if (!is_limit) continue;
    define(c, random_map(t, target, {u == max ? max + 1 : u, v == max ? max + 1 : v}));
    refused.push_back(c.GetError());
  }
  Played played = t.play(c);
  for (const gl::Ref error : accepted) played.expect_no_error(error);
  for (const gl::Ref error : refused) played.expect_error(error, {GL_INVALID_VALUE});
  for (std::size_t i = 0; i < defined.size(); ++i)
    played.expect_values(defined[i], std::vector<GLint>{orders[i].first, orders[i].second});
};

}  // namespace
}  // namespace evalcts::suite_initial_state
