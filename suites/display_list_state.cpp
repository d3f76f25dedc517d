// Section 20 of the requirements: a list is executed with the state at the time of its call, and queries are
// not compiled.

#include <evalcts/testkit/registration.h>

#include "display_lists.h"

namespace evalcts::suite_display_lists {

// Control points and enables, and so the precedence of maps, are those at the time of the call.
EVALCTS_TEST(DisplayLists, MapsOfTheCall, kMust, "EV-DL-EXECSTATE-MAP", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  gl::Case c = with_maps(
      t, "compiled with some maps, called with others, with one of them off, and with none", dimension.two);
  compile_points(c, kList, dimension.two);
  c.CallList(kList);
  define_vertices(t, c, dimension.two);
  c.Color4f(0.125f, 0.25f, 0.5f, 0.75f);
  c.CallList(kList);
  c.Disable(target_in(dimension.two, GL_MAP1_COLOR_4));
  c.CallList(kList);
  c.Disable(target_in(dimension.two, GL_MAP1_VERTEX_4));
  c.CallList(kList);
  c.Disable(target_in(dimension.two, GL_MAP1_VERTEX_3));
  c.CallList(kList);
  t.judge_vertices(c, kUnit0);
};

// The same for positions alone: the map is redefined, then another one takes precedence, then all are
// disabled.
EVALCTS_TEST(DisplayLists, VertexMapsOfTheCall, kMust, "EV-DL-EXECSTATE-MAP", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  const GLenum three = target_in(dimension.two, GL_MAP1_VERTEX_3);
  const GLenum four = target_in(dimension.two, GL_MAP1_VERTEX_4);
  const auto define_again = [&](gl::Case& c, GLenum target) {
    define(c, random_map(t, target, dimension.two ? Orders{2, 3} : Orders{3}));
  };
  gl::Case c(
      "compiled with a map of VERTEX_3, called after it was defined again, with VERTEX_4, and without");
  define_again(c, three);
  c.Enable(three);
  set_grid(c, dimension.two);
  compile_points(c, kList, dimension.two);
  define_again(c, three);
  c.CallList(kList);
  define_again(c, four);
  c.Enable(four);
  c.CallList(kList);
  define_again(c, four);
  c.CallList(kList);
  c.Disable(four);
  c.CallList(kList);
  c.Disable(three);
  c.CallList(kList);
  t.judge_vertices(c, kPosition);
};

// No map is enabled while the list is compiled.
EVALCTS_TEST(DisplayLists, MapsEnabledAfterwards, kMust, "EV-DL-EXECSTATE-MAP", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  gl::Case c("compiled with no map enabled");
  compile_points(c, kList, dimension.two);
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two);
  c.CallList(kList);
  t.judge_vertices(c, kUnit0);
};

EVALCTS_TEST(DisplayLists, GridOfTheCall, kMust, "EV-DL-EXECSTATE-GRID", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  gl::Case c =
      with_maps(t, "compiled under one grid, called under two others", dimension.two, {7, 0.0f, 1.0f});
  compile_points(c, kList, dimension.two);
  for (const Grid& grid : {Grid{4, 3.0f, -0.5f}, Grid{9, 0.75f, 1.5f}}) {
    set_grid(c, dimension.two, grid);
    c.CallList(kList);
  }
  t.judge_vertices(c, kUnit0);
};

EVALCTS_TEST(DisplayLists, ActiveTextureOfTheCall, kMust, "EV-DL-ACTIVETEX", combine(kForms))
(Test& t, const Form& form) {
  t.require(1, 3, "GL_ARB_multitexture");
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_COLOR_4}) {
    const Map map = random_map(t, target, 3);
    gl::Case c(label(target) + ": compiled under TEXTURE1, called under TEXTURE0, then under TEXTURE1");
    c.ActiveTexture(GL_TEXTURE1);
    compile(c, kList, [&](gl::Case& list) { define(list, map, form.doubles); });
    c.ActiveTexture(GL_TEXTURE0);
    c.CallList(kList);
    c.GetError();
    query_map(t, c, target, form.doubles);
    define(c, random_map(t, target, 2), form.doubles);
    take_snapshot(t, c);
    c.ActiveTexture(GL_TEXTURE1);
    c.CallList(kList);
    c.GetError();
    c.ActiveTexture(GL_TEXTURE0);
    take_snapshot(t, c);
    t.judge(c);
  }
  for (const GLenum target : {GL_MAP2_VERTEX_4, GL_MAP2_NORMAL}) {
    gl::Case c(label(target) + ": compiled under TEXTURE0, called under TEXTURE1, then under TEXTURE0");
    compile(c, kList, [&](gl::Case& list) { define(list, random_map(t, target, {3, 2}), form.doubles); });
    for (const GLenum unit : {GL_TEXTURE1, GL_TEXTURE0}) {
      c.ActiveTexture(unit);
      c.CallList(kList);
      c.GetError();
    }
    query_map(t, c, target, form.doubles);
    t.judge(c);
  }
};

// ActiveTexture in the list acts on the definitions after it.
EVALCTS_TEST(DisplayLists, ActiveTextureInTheList, kMust, "EV-DL-ACTIVETEX")
(Test& t) {
  t.require(1, 3, "GL_ARB_multitexture");
  gl::Case c("Map1 after ActiveTexture(TEXTURE1), and after ActiveTexture(TEXTURE0)");
  compile(c, kList, [&](gl::Case& list) {
    list.ActiveTexture(GL_TEXTURE1);
    define(list, random_map(t, GL_MAP1_NORMAL, 3));
    list.ActiveTexture(GL_TEXTURE0);
    define(list, random_map(t, GL_MAP1_VERTEX_3, 3));
  });
  c.CallList(kList);
  c.GetError();
  c.GetError();
  c.GetMapiv(GL_MAP1_NORMAL, GL_ORDER, gl::out<GLint>(1));
  query_map(t, c, GL_MAP1_VERTEX_3);
  t.judge(c);
};

// GetMap returns its values when it is issued, and writes nothing when the list is called.
EVALCTS_TEST(DisplayLists, QueriesAreNotCompiled, kMust, "EV-DL-GETMAP", combine(kForms))
(Test& t, const Form& form) {
  gl::Case c("GetMap and IsEnabled between compiled commands");
  const auto ask = [&] {
    query_map(t, c, GL_MAP1_COLOR_4, form.doubles);
    c.IsEnabled(GL_MAP1_COLOR_4);
  };
  define(c, random_map(t, GL_MAP1_COLOR_4, 2), form.doubles);
  c.NewList(kList, GL_COMPILE);
  define(c, random_map(t, GL_MAP1_COLOR_4, 3), form.doubles);
  c.Enable(GL_MAP1_COLOR_4);
  ask();
  c.EndList();
  c.CallList(kList);
  ask();
  t.judge(c);
};

EVALCTS_TEST(DisplayLists, GetnMapIsNotCompiled, kMust, "EV-DL-GETMAP")
(Test& t) {
  t.require(4, 5, "GL_ARB_robustness");
  gl::Case c("GetnMapfv between compiled commands");
  define(c, make_map1(GL_MAP1_INDEX, {1, 2}));
  c.NewList(kList, GL_COMPILE);
  define(c, make_map1(GL_MAP1_INDEX, {3, 4, 5}));
  c.GetnMapfv(GL_MAP1_INDEX, GL_COEFF, 64, gl::out<GLfloat>(16));
  c.EndList();
  c.CallList(kList);
  c.GetnMapfv(GL_MAP1_INDEX, GL_COEFF, 64, gl::out<GLfloat>(16));
  t.judge(c);
};

namespace {

constexpr GLenum kModes[] = {GL_COMPILE, GL_COMPILE_AND_EXECUTE};

// Appends all queries of evaluator state in all their forms, to be compared; GetnMap only if `getn`.
void ask_in_every_form(Test& t, gl::Case& c, bool getn) {
  std::vector<gl::Ref> queries;
  constexpr std::size_t kRoom = 64;
  constexpr GLsizei kBytes = kRoom * sizeof(GLint);
  for (const GLenum target : {GL_MAP1_COLOR_4, GL_MAP2_NORMAL})
    for (const GLenum query : {GL_ORDER, GL_DOMAIN, GL_COEFF}) {
      for (const Getter& form : existing_getters(t)) queries.push_back(form.get(c, target, query, kRoom));
      if (!getn) continue;
      queries.push_back(c.GetnMapfv(target, query, kBytes, gl::out<GLfloat>(kRoom)));
      queries.push_back(c.GetnMapdv(target, query, 2 * kBytes, gl::out<GLdouble>(kRoom)));
      queries.push_back(c.GetnMapiv(target, query, kBytes, gl::out<GLint>(kRoom)));
    }
  for (const GLenum state :
       {GL_MAP1_COLOR_4, GL_MAP2_NORMAL, GL_AUTO_NORMAL, GL_MAX_EVAL_ORDER, GL_MAP1_GRID_DOMAIN,
        GL_MAP1_GRID_SEGMENTS, GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS}) {
    queries.push_back(c.GetBooleanv(state, gl::out<GLboolean>(4)));
    queries.push_back(c.GetIntegerv(state, gl::out<GLint>(4)));
    queries.push_back(c.GetFloatv(state, gl::out<GLfloat>(4)));
    if (t.can_call(gl::EntryPoint::GetDoublev)) queries.push_back(c.GetDoublev(state, gl::out<GLdouble>(4)));
  }
  for (const GLenum cap : {GL_MAP1_COLOR_4, GL_MAP2_NORMAL, GL_AUTO_NORMAL})
    queries.push_back(c.IsEnabled(cap));
  t.compare_only(queries);
}

// Queries between NewList and EndList return the state of the moment, which compiled commands change only if
// they are executed as well.
EVALCTS_TEST(DisplayLists, EveryQueryInAnOpenList, kMust, "EV-DL-GETMAP", combine(kModes))
(Test& t, GLenum mode) {
  const bool getn = t.gl().at_least(4, 5) || t.gl().extensions.contains("GL_ARB_robustness");
  const auto set = [&](gl::Case& c, int order, bool on) {
    define(c, random_map(t, GL_MAP1_COLOR_4, order));
    define(c, over(random_map(t, GL_MAP2_NORMAL, {order, 2}), {0, 1.0 * order}, {-1.0 * order, 1}));
    c.MapGrid1f(order, 0.5f * static_cast<float>(order), -2);
    c.MapGrid2f(order, 3, static_cast<float>(order), order + 1, 7, -static_cast<float>(order));
    for (const GLenum cap : {GL_MAP1_COLOR_4, GL_MAP2_NORMAL, GL_AUTO_NORMAL})
      on ? c.Enable(cap) : c.Disable(cap);
  };
  gl::Case c("asked before the list, in it and after it");
  set(c, 2, false);
  ask_in_every_form(t, c, getn);
  c.NewList(kList, mode);
  set(c, 4, true);
  ask_in_every_form(t, c, getn);
  c.EndList();
  ask_in_every_form(t, c, getn);
  c.GetError();
  t.judge(c);
};

}  // namespace
}  // namespace evalcts::suite_display_lists
