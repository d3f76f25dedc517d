// Section 20 of the requirements: a list is executed with the state at the time of its call, and queries are
// not compiled.

#include <evalcts/testkit/registration.h>

#include "checked_case.h"
#include "display_lists.h"

namespace evalcts::suite_display_lists {

// Control points and enables, and so the precedence of maps, are those at the time of the call.
EVALCTS_TEST(DisplayLists, MapsOfTheCall, kMust, "EV-DL-EXECSTATE-MAP", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  t.leave_current_values_to_their_rules();
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
  t.expect_emission(c, kUnit0);
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
  t.expect_emission(c, kPosition);
};

// No map is enabled while the list is compiled.
EVALCTS_TEST(DisplayLists, MapsEnabledAfterwards, kMust, "EV-DL-EXECSTATE-MAP", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  gl::Case c("compiled with no map enabled");
  compile_points(c, kList, dimension.two);
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two);
  c.CallList(kList);
  t.expect_emission(c, kUnit0);
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
  t.expect_emission(c, kUnit0);
};

EVALCTS_TEST(DisplayLists, ActiveTextureOfTheCall, kMust, "EV-DL-ACTIVETEX", combine(kForms))
(Test& t, const Form& form) {
  t.require(1, 3, "GL_ARB_multitexture");
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_COLOR_4}) {
    const Map map = random_map(t, target, 3);
    CheckedCase c(t, label(target) + ": compiled under TEXTURE1, called under TEXTURE0, then under TEXTURE1");
    c.ActiveTexture(GL_TEXTURE1);
    compile(c, kList, [&](gl::Case& list) { define(list, map, form.doubles); });
    c.ActiveTexture(GL_TEXTURE0);
    c.CallList(kList);
    c.expect_no_error();
    c.expect_map(map, form.doubles);
    define(c, random_map(t, target, 2), form.doubles);
    const std::vector<gl::Ref> before = c.query_everything();
    c.ActiveTexture(GL_TEXTURE1);
    c.CallList(kList);
    c.expect_error(GL_INVALID_OPERATION);
    c.ActiveTexture(GL_TEXTURE0);
    c.expect_unchanged(before);
    c.check();
  }
  for (const GLenum target : {GL_MAP2_VERTEX_4, GL_MAP2_NORMAL}) {
    const Map map = random_map(t, target, {3, 2});
    CheckedCase c(t, label(target) + ": compiled under TEXTURE0, called under TEXTURE1, then under TEXTURE0");
    compile(c, kList, [&](gl::Case& list) { define(list, map, form.doubles); });
    c.ActiveTexture(GL_TEXTURE1);
    c.CallList(kList);
    c.expect_error(GL_INVALID_OPERATION);
    c.ActiveTexture(GL_TEXTURE0);
    c.CallList(kList);
    c.expect_no_error();
    c.expect_map(map, form.doubles);
    c.check();
  }
};

// ActiveTexture in the list acts on the definitions after it.
EVALCTS_TEST(DisplayLists, ActiveTextureInTheList, kMust, "EV-DL-ACTIVETEX")
(Test& t) {
  t.require(1, 3, "GL_ARB_multitexture");
  const Map good = random_map(t, GL_MAP1_VERTEX_3, 3);
  CheckedCase c(t, "Map1 after ActiveTexture(TEXTURE1), and after ActiveTexture(TEXTURE0)");
  compile(c, kList, [&](gl::Case& list) {
    list.ActiveTexture(GL_TEXTURE1);
    define(list, random_map(t, GL_MAP1_NORMAL, 3));
    list.ActiveTexture(GL_TEXTURE0);
    define(list, good);
  });
  c.CallList(kList);
  c.expect_error(GL_INVALID_OPERATION);
  c.expect_no_error();
  c.expect_orders(GL_MAP1_NORMAL, {1});
  c.expect_map(good);
  c.check();
};

// GetMap returns its values when it is issued, and writes nothing when the list is called.
EVALCTS_TEST(DisplayLists, QueriesAreNotCompiled, kMust, "EV-DL-GETMAP", combine(kForms))
(Test& t, const Form& form) {
  CheckedCase c(t, "GetMap and IsEnabled between compiled commands");
  const Map old = random_map(t, GL_MAP1_COLOR_4, 2), changed = random_map(t, GL_MAP1_COLOR_4, 3);
  define(c, old, form.doubles);
  c.NewList(kList, GL_COMPILE);
  define(c, changed, form.doubles);
  c.Enable(GL_MAP1_COLOR_4);
  c.expect_map(old, form.doubles);
  c.expect_enabled(GL_MAP1_COLOR_4, false);
  c.EndList();
  c.CallList(kList);
  c.expect_map(changed, form.doubles);
  c.expect_enabled(GL_MAP1_COLOR_4, true);
  c.check();
};

EVALCTS_TEST(DisplayLists, GetnMapIsNotCompiled, kMust, "EV-DL-GETMAP")
(Test& t) {
  t.require(4, 5, "GL_ARB_robustness");
  CheckedCase c(t, "GetnMapfv between compiled commands");
  const Map old = make_map1(GL_MAP1_INDEX, {1, 2}), changed = make_map1(GL_MAP1_INDEX, {3, 4, 5});
  define(c, old);
  c.NewList(kList, GL_COMPILE);
  define(c, changed);
  c.expect_values(c.GetnMapfv(GL_MAP1_INDEX, GL_COEFF, 64, gl::out<GLfloat>(16)), {1, 2});
  c.EndList();
  c.CallList(kList);
  c.expect_values(c.GetnMapfv(GL_MAP1_INDEX, GL_COEFF, 64, gl::out<GLfloat>(16)), {3, 4, 5});
  c.check();
};

namespace {

constexpr GLenum kModes[] = {GL_COMPILE, GL_COMPILE_AND_EXECUTE};

// Appends all queries of evaluator state in all their forms; GetnMap only if `getn`.
std::vector<gl::Ref> ask_in_every_form(Test& t, gl::Case& c, bool getn) {
  std::vector<gl::Ref> answers;
  constexpr std::size_t kRoom = 64;
  constexpr GLsizei kBytes = kRoom * sizeof(GLint);
  for (const GLenum target : {GL_MAP1_COLOR_4, GL_MAP2_NORMAL})
    for (const GLenum query : {GL_ORDER, GL_DOMAIN, GL_COEFF}) {
      for (const Getter& form : existing_getters(t)) answers.push_back(form.get(c, target, query, kRoom));
      if (!getn) continue;
      answers.push_back(c.GetnMapfv(target, query, kBytes, gl::out<GLfloat>(kRoom)));
      answers.push_back(c.GetnMapdv(target, query, 2 * kBytes, gl::out<GLdouble>(kRoom)));
      answers.push_back(c.GetnMapiv(target, query, kBytes, gl::out<GLint>(kRoom)));
    }
  for (const GLenum state :
       {GL_MAP1_COLOR_4, GL_MAP2_NORMAL, GL_AUTO_NORMAL, GL_MAX_EVAL_ORDER, GL_MAP1_GRID_DOMAIN,
        GL_MAP1_GRID_SEGMENTS, GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS}) {
    answers.push_back(c.GetBooleanv(state, gl::out<GLboolean>(4)));
    answers.push_back(c.GetIntegerv(state, gl::out<GLint>(4)));
    answers.push_back(c.GetFloatv(state, gl::out<GLfloat>(4)));
    if (t.can_call(gl::EntryPoint::GetDoublev)) answers.push_back(c.GetDoublev(state, gl::out<GLdouble>(4)));
  }
  for (const GLenum cap : {GL_MAP1_COLOR_4, GL_MAP2_NORMAL, GL_AUTO_NORMAL})
    answers.push_back(c.IsEnabled(cap));
  return answers;
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
  CheckedCase c(t, "asked before the list, in it and after it");
  set(c, 2, false);
  const std::vector<gl::Ref> before = ask_in_every_form(t, c, getn);
  c.NewList(kList, mode);
  set(c, 4, true);
  const std::vector<gl::Ref> inside = ask_in_every_form(t, c, getn);
  c.EndList();
  const std::vector<gl::Ref> after = ask_in_every_form(t, c, getn);
  c.expect_same(mode == GL_COMPILE ? before : after, inside);
  c.expect_same(inside, after);
  c.expect_no_error();
  c.check();
};

}  // namespace
}  // namespace evalcts::suite_display_lists
