// Section 20 of the requirements: the state at the time of the call counts, and queries are not compiled.
#include <fmt/format.h>

#include <evalcts/testkit/registration.h>

#include "display_lists.h"

namespace evalcts::suite_display_lists {

// Points, enables and what wins are those of the call.
EVALCTS_TEST(DisplayLists, MapsOfTheCall, must, "EV-DL-EXECSTATE-MAP", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  gl::Case c("compiled with some maps, called with others, with one of them off, and with none");
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two);
  compile(c, kList, [&](gl::Case& list) {
    evaluate_and_eval_points(list, dimension.two);
    mesh_of_points(list, dimension.two);
  });
  c.CallList(kList);
  define_vertices(t, c, dimension.two);
  c.Color4f(0.125f, 0.25f, 0.5f, 0.75f);
  c.CallList(kList);
  c.Disable(dimension.two ? GL_MAP2_COLOR_4 : GL_MAP1_COLOR_4);
  c.CallList(kList);
  c.Disable(dimension.two ? GL_MAP2_VERTEX_4 : GL_MAP1_VERTEX_4);
  c.CallList(kList);
  c.Disable(dimension.two ? GL_MAP2_VERTEX_3 : GL_MAP1_VERTEX_3);
  c.CallList(kList);
  t.expect_emission(c, kUnit0);
};

// Positions alone: the map that is drawn defined anew, then outranked by another, then off.
EVALCTS_TEST(DisplayLists, VertexMapsOfTheCall, must, "EV-DL-EXECSTATE-MAP", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  const GLenum three = dimension.two ? GL_MAP2_VERTEX_3 : GL_MAP1_VERTEX_3;
  const GLenum four = dimension.two ? GL_MAP2_VERTEX_4 : GL_MAP1_VERTEX_4;
  const auto define_anew = [&](gl::Case& c, GLenum target) {
    dimension.two ? define(c, random_map(t, target, {2, 3})) : define(c, random_map(t, target, 3));
  };
  gl::Case c("compiled with a map of VERTEX_3, called after it was defined anew, with VERTEX_4, and without");
  define_anew(c, three);
  c.Enable(three);
  set_grid(c, dimension.two);
  compile(c, kList, [&](gl::Case& list) {
    evaluate_and_eval_points(list, dimension.two);
    mesh_of_points(list, dimension.two);
  });
  define_anew(c, three);
  c.CallList(kList);
  define_anew(c, four);
  c.Enable(four);
  c.CallList(kList);
  define_anew(c, four);
  c.CallList(kList);
  c.Disable(four);
  c.CallList(kList);
  c.Disable(three);
  c.CallList(kList);
  t.expect_emission(c, kPosition);
};

// Compiled while no map was enabled at all.
EVALCTS_TEST(DisplayLists, MapsEnabledAfterwards, must, "EV-DL-EXECSTATE-MAP", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  gl::Case c("compiled with no map enabled");
  compile(c, kList, [&](gl::Case& list) {
    evaluate_and_eval_points(list, dimension.two);
    mesh_of_points(list, dimension.two);
  });
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two);
  c.CallList(kList);
  t.expect_emission(c, kUnit0);
};

EVALCTS_TEST(DisplayLists, GridOfTheCall, must, "EV-DL-EXECSTATE-GRID", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  gl::Case c("compiled under one grid, called under two others");
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two, {7, 0.0f, 1.0f});
  compile(c, kList, [&](gl::Case& list) {
    evaluate_and_eval_points(list, dimension.two);
    mesh_of_points(list, dimension.two);
  });
  for (const Grid& grid : {Grid{4, 3.0f, -0.5f}, Grid{9, 0.75f, 1.5f}}) {
    set_grid(c, dimension.two, grid);
    c.CallList(kList);
  }
  t.expect_emission(c, kUnit0);
};

EVALCTS_TEST(DisplayLists, ActiveTextureOfTheCall, must, "EV-DL-ACTIVETEX", combine(kForms))
(Test& t, const Form& form) {
  t.require(1, 3, "GL_ARB_multitexture");
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_COLOR_4}) {
    const Map map = random_map(t, target, 3);
    gl::Case c(label(target) + ": compiled under TEXTURE1, called under TEXTURE0, then under TEXTURE1");
    c.ActiveTexture(GL_TEXTURE1);
    compile(c, kList, [&](gl::Case& list) { define(list, map, form.doubles); });
    c.ActiveTexture(GL_TEXTURE0);
    c.CallList(kList);
    const gl::Ref fine = c.GetError();
    const MapQuery query = query_map(c, target, t.max_order(), form.doubles);
    define(c, random_map(t, target, 2), form.doubles);
    const std::vector<gl::Ref> before = query_everything(c, t.max_order());
    c.ActiveTexture(GL_TEXTURE1);
    c.CallList(kList);
    const gl::Ref refused = c.GetError();
    c.ActiveTexture(GL_TEXTURE0);
    const std::vector<gl::Ref> after = query_everything(c, t.max_order());
    Played played = t.play(c);
    played.expect_no_error(fine);
    expect_map(played, query, map, form.doubles);
    played.expect_error(refused, {GL_INVALID_OPERATION});
    expect_unchanged(played, before, after);
  }
  for (const GLenum target : {GL_MAP2_VERTEX_4, GL_MAP2_NORMAL}) {
    const Map map = random_map(t, target, {3, 2});
    gl::Case c(label(target) + ": compiled under TEXTURE0, called under TEXTURE1, then under TEXTURE0");
    compile(c, kList, [&](gl::Case& list) { define(list, map, form.doubles); });
    c.ActiveTexture(GL_TEXTURE1);
    c.CallList(kList);
    const gl::Ref refused = c.GetError();
    c.ActiveTexture(GL_TEXTURE0);
    c.CallList(kList);
    const gl::Ref fine = c.GetError();
    const MapQuery query = query_map(c, target, t.max_order(), form.doubles);
    Played played = t.play(c);
    played.expect_error(refused, {GL_INVALID_OPERATION});
    played.expect_no_error(fine);
    expect_map(played, query, map, form.doubles);
  }
};

// ActiveTexture itself may be in the list.
EVALCTS_TEST(DisplayLists, ActiveTextureInTheList, must, "EV-DL-ACTIVETEX")
(Test& t) {
  t.require(1, 3, "GL_ARB_multitexture");
  const Map good = random_map(t, GL_MAP1_VERTEX_3, 3);
  gl::Case c("Map1 after ActiveTexture(TEXTURE1), and after ActiveTexture(TEXTURE0)");
  compile(c, kList, [&](gl::Case& list) {
    list.ActiveTexture(GL_TEXTURE1);
    define(list, random_map(t, GL_MAP1_NORMAL, 3));
    list.ActiveTexture(GL_TEXTURE0);
    define(list, good);
  });
  c.CallList(kList);
  const gl::Ref error = c.GetError(), no_more = c.GetError();
  const gl::Ref order = c.GetMapiv(GL_MAP1_NORMAL, GL_ORDER, gl::out<GLint>(1));
  const MapQuery query = query_map(c, GL_MAP1_VERTEX_3, t.max_order());
  Played played = t.play(c);
  played.expect_error(error, {GL_INVALID_OPERATION});
  played.expect_no_error(no_more);
  played.expect_values(order, std::vector<GLint>{1});
  expect_map(played, query, good);
};

// GetMap and GetnMap write when they are issued, never when the list is called.
EVALCTS_TEST(DisplayLists, QueriesAreNotCompiled, must, "EV-DL-GETMAP", combine(kForms))
(Test& t, const Form& form) {
  gl::Case c("GetMap and IsEnabled between compiled commands");
  const Map old = random_map(t, GL_MAP1_COLOR_4, 2), changed = random_map(t, GL_MAP1_COLOR_4, 3);
  define(c, old, form.doubles);
  c.NewList(kList, GL_COMPILE);
  define(c, changed, form.doubles);
  c.Enable(GL_MAP1_COLOR_4);
  const MapQuery inside = query_map(c, GL_MAP1_COLOR_4, t.max_order(), form.doubles);
  const gl::Ref off = c.IsEnabled(GL_MAP1_COLOR_4);
  c.EndList();
  c.CallList(kList);
  const MapQuery called = query_map(c, GL_MAP1_COLOR_4, t.max_order(), form.doubles);
  const gl::Ref on = c.IsEnabled(GL_MAP1_COLOR_4);
  Played played = t.play(c);
  expect_map(played, inside, old, form.doubles);
  played.expect_result(off, GL_FALSE);
  expect_map(played, called, changed, form.doubles);
  played.expect_result(on, GL_TRUE);
};

EVALCTS_TEST(DisplayLists, GetnMapIsNotCompiled, must, "EV-DL-GETMAP")
(Test& t) {
  t.require(4, 5, "GL_ARB_robustness");
  gl::Case c("GetnMapfv between compiled commands");
  const Map old = make_map1(GL_MAP1_INDEX, {1, 2}), changed = make_map1(GL_MAP1_INDEX, {3, 4, 5});
  define(c, old);
  c.NewList(kList, GL_COMPILE);
  define(c, changed);
  const gl::Ref inside = c.GetnMapfv(GL_MAP1_INDEX, GL_COEFF, 64, gl::out<GLfloat>(16));
  c.EndList();
  c.CallList(kList);
  const gl::Ref called = c.GetnMapfv(GL_MAP1_INDEX, GL_COEFF, 64, gl::out<GLfloat>(16));
  Played played = t.play(c);
  played.expect_values(inside, std::vector<GLfloat>{1, 2});
  played.expect_values(called, std::vector<GLfloat>{3, 4, 5});
};

namespace {

struct Mode {
  const char* name;
  GLenum mode;
};
constexpr Mode kModes[] = {{"COMPILE", GL_COMPILE}, {"COMPILE_AND_EXECUTE", GL_COMPILE_AND_EXECUTE}};

// Each query that there is, in each of its forms.
std::vector<gl::Ref> ask_in_every_form(gl::Case& c, bool getn) {
  std::vector<gl::Ref> answers;
  constexpr std::size_t kRoom = 64;
  constexpr GLsizei kBytes = kRoom * sizeof(GLint);
  for (const GLenum target : {GL_MAP1_COLOR_4, GL_MAP2_NORMAL})
    for (const GLenum query : {GL_ORDER, GL_DOMAIN, GL_COEFF}) {
      for (const Getter& form : kGetters) answers.push_back(form.get(c, target, query, kRoom));
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
    answers.push_back(c.GetDoublev(state, gl::out<GLdouble>(4)));
  }
  for (const GLenum cap : {GL_MAP1_COLOR_4, GL_MAP2_NORMAL, GL_AUTO_NORMAL})
    answers.push_back(c.IsEnabled(cap));
  return answers;
}

// What is asked while the list is open is answered as outside of it: before it, or after it where its
// commands are executed.
EVALCTS_TEST(DisplayLists, EveryQueryInAnOpenList, must, "EV-DL-GETMAP", combine(kModes))
(Test& t, const Mode& mode) {
  const bool getn = t.gl().at_least(4, 5) || t.gl().extensions.contains("GL_ARB_robustness");
  const auto set = [&](gl::Case& c, int order, bool on) {
    define(c, random_map(t, GL_MAP1_COLOR_4, order));
    Map net = random_map(t, GL_MAP2_NORMAL, {order, 2});
    net.u2 = order, net.v1 = -order;
    define(c, net);
    c.MapGrid1f(order, 0.5f * static_cast<float>(order), -2);
    c.MapGrid2f(order, 3, static_cast<float>(order), order + 1, 7, -static_cast<float>(order));
    for (const GLenum cap : {GL_MAP1_COLOR_4, GL_MAP2_NORMAL, GL_AUTO_NORMAL})
      on ? c.Enable(cap) : c.Disable(cap);
  };
  gl::Case c("asked before the list, in it and after it");
  set(c, 2, false);
  const std::vector<gl::Ref> before = ask_in_every_form(c, getn);
  c.NewList(kList, mode.mode);
  set(c, 4, true);
  const std::vector<gl::Ref> inside = ask_in_every_form(c, getn);
  c.EndList();
  const std::vector<gl::Ref> after = ask_in_every_form(c, getn);
  const gl::Ref error = c.GetError();
  Played played = t.play(c);
  expect_unchanged(played, mode.mode == GL_COMPILE ? before : after, inside);
  expect_unchanged(played, inside, after);
  played.expect_no_error(error);
};

}  // namespace
}  // namespace evalcts::suite_display_lists
