// Section 2 of the requirements: the evaluator state of a fresh context.
#include <evalcts/testkit/registration.h>

#include "dimensions.h"
#include "maps.h"

namespace evalcts::suite_initial_state {
namespace {

// Judges the initial control points of the targets in all forms of GetMap.
void judge_initial_points(Test& t, std::initializer_list<GLenum> targets) {
  gl::Case c("initial control points");
  for (const GLenum target : targets)
    for (const Getter& getter : existing_getters(t)) getter.get(c, target, GL_COEFF, 8);
  t.judge(c);
}

// Judges that the capabilities are disabled.
void judge_enables(Test& t, const std::vector<GLenum>& caps) {
  t.require_initial_state();
  gl::Case c("enables");
  for (const GLenum cap : caps) {
    c.IsEnabled(cap);
    c.GetBooleanv(cap, gl::out<GLboolean>(1));
  }
  t.judge(c);
}

EVALCTS_TEST(InitialState, MapsDisabled, kMust, "EV-INIT-MAPS-OFF")
(Test& t) { judge_enables(t, all_targets()); };

EVALCTS_TEST(InitialState, AutoNormalDisabled, kMust, "EV-INIT-AUTON-OFF")
(Test& t) { judge_enables(t, {GL_AUTO_NORMAL}); };

EVALCTS_TEST_PAIR(InitialState.OrderOf1D, InitialState.OrderOf2D, kMust,
                  decide("EV-INIT-ORDER1", "EV-INIT-ORDER2"))
(Test& t, bool two) {
  t.require_initial_state();
  gl::Case c("orders in all forms of GetMap");
  for (const GLenum target : targets(two))
    for (const Getter& getter : existing_getters(t)) getter.get(c, target, GL_ORDER, 4);
  t.judge(c);
};

EVALCTS_TEST(InitialState, VertexPoint, kMust, "EV-INIT-COEFF-VERTEX")
(Test& t) {
  t.require_initial_state();
  judge_initial_points(t, {GL_MAP1_VERTEX_3, GL_MAP1_VERTEX_4, GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4});
};

EVALCTS_TEST(InitialState, NormalPoint, kMust, "EV-INIT-COEFF-NORMAL")
(Test& t) { judge_initial_points(t, {GL_MAP1_NORMAL, GL_MAP2_NORMAL}); };

EVALCTS_TEST(InitialState, ColorPoint, kMust, "EV-INIT-COEFF-COLOR")
(Test& t) { judge_initial_points(t, {GL_MAP1_COLOR_4, GL_MAP2_COLOR_4}); };

EVALCTS_TEST(InitialState, IndexPoint, kMust, "EV-INIT-COEFF-INDEX")
(Test& t) { judge_initial_points(t, {GL_MAP1_INDEX, GL_MAP2_INDEX}); };

EVALCTS_TEST(InitialState, TexturePoint, kMust, "EV-INIT-COEFF-TEX")
(Test& t) {
  t.require_initial_state();
  t.require(1, 1);
  judge_initial_points(t, {GL_MAP1_TEXTURE_COORD_1, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_TEXTURE_COORD_3,
                           GL_MAP1_TEXTURE_COORD_4, GL_MAP2_TEXTURE_COORD_1, GL_MAP2_TEXTURE_COORD_2,
                           GL_MAP2_TEXTURE_COORD_3, GL_MAP2_TEXTURE_COORD_4});
};

EVALCTS_TEST(InitialState, Domain, kQuality, "EV-INIT-DOMAIN")
(Test& t) {
  t.require_initial_state();
  gl::Case c("domains of maps that were never defined");
  for (const GLenum target : all_targets()) {
    c.GetMapfv(target, GL_DOMAIN, gl::out<GLfloat>(4));
    if (t.can_call(gl::EntryPoint::GetMapdv)) c.GetMapdv(target, GL_DOMAIN, gl::out<GLdouble>(4));
  }
  t.judge(c);
};

EVALCTS_TEST_PAIR(InitialState.Grid1, InitialState.Grid2, kMust, decide("EV-INIT-GRID1", "EV-INIT-GRID2"))
(Test& t, bool two) {
  t.require_initial_state();
  const std::size_t directions = two ? 2 : 1;
  const GLenum domain = two ? GL_MAP2_GRID_DOMAIN : GL_MAP1_GRID_DOMAIN;
  gl::Case c(two ? "MAP2_GRID" : "MAP1_GRID");
  c.GetFloatv(domain, gl::out<GLfloat>(2 * directions));
  if (t.can_call(gl::EntryPoint::GetDoublev)) c.GetDoublev(domain, gl::out<GLdouble>(2 * directions));
  c.GetIntegerv(domain, gl::out<GLint>(2 * directions));
  c.GetIntegerv(two ? GL_MAP2_GRID_SEGMENTS : GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(directions));
  t.judge(c);
};

// Arguments inside and outside the domain.
const std::vector<double> kArguments = {-3, 0, 0.5, 7};

EVALCTS_TEST(InitialState, Evaluable, kMust, "EV-INIT-EVALUABLE")
(Test& t) {
  t.require_initial_state();
  for (const GLenum vertex : {GL_MAP1_VERTEX_3, GL_MAP1_VERTEX_4}) {
    gl::Case c(label(vertex));
    c.Enable(vertex);
    evaluate_all(c, kArguments);
    t.judge_vertices(c, kPosition);
  }
};

// Each target with its initial map, with a vertex map that was never defined either.
EVALCTS_TEST_PAIR(InitialState.EvaluableWith, InitialState.Evaluable2, kMust, "EV-INIT-EVALUABLE",
                  [](bool two) { return combine(visible_targets(two)); })
(Test& t, bool two, GLenum target) {
  t.require_initial_state();
  if (attribute_of(target) == kTextureCoordinate0) t.require(1, 1);
  gl::Case c = with_current_values(label(target), {.normal = {0.5f, 0.6f, 0.7f}});
  if (target != GL_MAP2_VERTEX_4) c.Enable(target_in(two, GL_MAP1_VERTEX_3));
  c.Enable(target);
  c.Begin(GL_POINTS);
  for (const double u : kArguments) eval_coord(c, two, u, 0.25 - u);
  c.End();
  t.judge_vertices(c, attribute_of(target));
};

// EvalPoint and EvalMesh on the initial grids, which have one segment over [0,1].
EVALCTS_TEST_PAIR(InitialState.MeshesOverGrid1, InitialState.MeshesOverGrid2, kMust,
                  decide("EV-INIT-GRID1", "EV-INIT-GRID2"))
(Test& t, bool two) {
  t.require_initial_state();
  for (const GLenum attribute : {GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_4}) {
    gl::Case c(label(target_in(two, attribute)));
    for (const GLenum target : {static_cast<GLenum>(GL_MAP1_VERTEX_3), attribute})
      define_and_enable(c, random_map(t, target_in(two, target), {3, 2}));
    eval_mesh(c, two, GL_POINT, 0, 1, 0, 1);
    eval_mesh(c, two, GL_POINT, -1, two ? 0 : 2, 0, 1);
    c.Begin(GL_POINTS);
    for (const GLint i : {0, 1, 2}) eval_point(c, two, i, 1 - i);
    c.End();
    t.judge_vertices(c, kUnit0);
  }
};

// The specification cannot judge this test, because the limit of the implementation decides which maps are
// defined.
EVALCTS_TEST(InitialState, MaxEvalOrder, kMust, "EV-INIT-MAXORDER/1-D")
(Test& t) {
  t.require_initial_state();
  gl::Case limit("MAX_EVAL_ORDER");
  const gl::Ref query = limit.GetIntegerv(GL_MAX_EVAL_ORDER, gl::out<GLint>(1));
  CheckedTrace checked = t.play(limit);
  const GLint order = checked.trace().values<GLint>(query)[0];
  checked.expect(checked.trace().written(query) == 1 && order >= 8, query,
                 "MAX_EVAL_ORDER is below 8 or no single value", "one value, at least 8",
                 std::to_string(order));
  if (order < 1 || order > 1 << 16) return;
  gl::Case c("maps of order MAX_EVAL_ORDER");
  std::vector<gl::Ref> errors, orders;
  for (const GLenum target : gl::kMap1Targets) {
    define(c, random_map(t, target, order));
    errors.push_back(c.GetError());
    orders.push_back(c.GetMapiv(target, GL_ORDER, gl::out<GLint>(1)));
  }
  CheckedTrace answers = t.play(c);
  for (const gl::Ref error : errors) answers.expect_no_error(error);
  for (const gl::Ref query_of_order : orders) answers.expect_values(query_of_order, std::vector{order});
};

// MAX_EVAL_ORDER applies to both directions of two-dimensional maps.
EVALCTS_TEST(InitialState, MaxEvalOrder2, kMust, "EV-INIT-MAXORDER/2-D", combine(gl::kMap2Targets))
(Test& t, GLenum target) {
  t.require_initial_state();
  const int max = t.max_order();
  const bool is_limit = t.order_limit() == max;
  gl::Case c("MAX x MAX, MAX x 2, 2 x MAX, and one more");
  for (const auto& [u, v] : {Orders{max, max}, {max, 2}, {2, max}}) {
    define(c, random_map(t, target, {u, v}));
    c.GetError();
    c.GetMapiv(target, GL_ORDER, gl::out<GLint>(2));
    if (!is_limit) continue;
    define(c, random_map(t, target, {u == max ? max + 1 : u, v == max ? max + 1 : v}));
    c.GetError();
  }
  t.judge(c);
};

}  // namespace
}  // namespace evalcts::suite_initial_state
