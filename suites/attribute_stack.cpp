// Section 21 of the requirements, the attribute stack: what PushAttrib saves of evaluators, and what it does
// not.
#include <fmt/format.h>

#include <evalcts/testkit/registration.h>

#include "maps.h"

namespace evalcts::suite_attribute_stack {
namespace {

// All that evaluators have in the groups of the attribute stack.
struct State {
  bool odd_maps = false;  // every second map enabled, this half or the other
  bool auto_normal = false;
  GLint segments = 1;  // of the grids, and other numbers derived from it for the ends
};
// Each differs from the next in everything.
constexpr State kBefore{false, true, 3}, kAfter{true, false, 7}, kLast{false, true, 12};

bool enabled(const State& state, std::size_t i) { return (i % 2 == 1) == state.odd_maps; }
std::vector<double> grid1(const State& state) { return {0.25 * state.segments, -1.0 * state.segments}; }
std::vector<double> grid2(const State& state) {
  return {-0.5 * state.segments, 2.0 * state.segments, 1.0 + state.segments, 0.125 * state.segments};
}

void set(gl::Case& c, const State& state) {
  const auto enable = [&](GLenum cap, bool on) {
    if (on)
      c.Enable(cap);
    else
      c.Disable(cap);
  };
  for (std::size_t i = 0; i < gl::kMap1Targets.size(); ++i) {
    enable(gl::kMap1Targets[i], enabled(state, i));
    enable(gl::kMap2Targets[i], enabled(state, i + 1));
  }
  enable(GL_AUTO_NORMAL, state.auto_normal);
  const std::vector<double> one = grid1(state), two = grid2(state);
  c.MapGrid1d(state.segments, one[0], one[1]);
  c.MapGrid2d(state.segments + 1, two[0], two[1], state.segments + 2, two[2], two[3]);
}

struct Queries {
  std::vector<gl::Ref> enables1, enables2;
  gl::Ref auto_normal, segments1, domain1, segments2, domain2;
};

Queries query(gl::Case& c) {
  Queries queries;
  for (std::size_t i = 0; i < gl::kMap1Targets.size(); ++i) {
    queries.enables1.push_back(c.IsEnabled(gl::kMap1Targets[i]));
    queries.enables2.push_back(c.IsEnabled(gl::kMap2Targets[i]));
  }
  queries.auto_normal = c.IsEnabled(GL_AUTO_NORMAL);
  queries.segments1 = c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
  queries.domain1 = c.GetDoublev(GL_MAP1_GRID_DOMAIN, gl::out<GLdouble>(2));
  queries.segments2 = c.GetIntegerv(GL_MAP2_GRID_SEGMENTS, gl::out<GLint>(2));
  queries.domain2 = c.GetDoublev(GL_MAP2_GRID_DOMAIN, gl::out<GLdouble>(4));
  return queries;
}

void expect_enables(Played& played, const Queries& queries, const State& state) {
  for (std::size_t i = 0; i < queries.enables1.size(); ++i) {
    played.expect_result(queries.enables1[i], enabled(state, i) ? GL_TRUE : GL_FALSE);
    played.expect_result(queries.enables2[i], enabled(state, i + 1) ? GL_TRUE : GL_FALSE);
  }
}
void expect_auto_normal(Played& played, const Queries& queries, const State& state) {
  played.expect_result(queries.auto_normal, state.auto_normal ? GL_TRUE : GL_FALSE);
}
void expect_grids(Played& played, const Queries& queries, const State& state) {
  played.expect_values(queries.segments1, std::vector<GLint>{state.segments});
  played.expect_values(queries.domain1, grid1(state));
  played.expect_values(queries.segments2, std::vector<GLint>{state.segments + 1, state.segments + 2});
  played.expect_values(queries.domain2, grid2(state));
}
void expect_all(Played& played, const Queries& queries, const State& state) {
  expect_enables(played, queries, state);
  expect_auto_normal(played, queries, state);
  expect_grids(played, queries, state);
}

// Sets, pushes, sets something else, pops. `pushed` is what was asked between push and setting.
Queries push_and_pop(gl::Case& c, GLbitfield mask, Queries* pushed = nullptr) {
  set(c, kBefore);
  c.PushAttrib(mask);
  if (pushed) *pushed = query(c);
  set(c, kAfter);
  c.PopAttrib();
  return query(c);
}

struct Mask {
  const char* name;
  GLbitfield bits;
};
// Everything in one group, alone and among others.
constexpr Mask kWithEval[] = {{"EVAL_BIT", GL_EVAL_BIT},
                              {"EVAL_AND_ENABLE_BIT", GL_EVAL_BIT | GL_ENABLE_BIT},
                              {"EVAL_AND_CURRENT_AND_LIST_BIT", GL_EVAL_BIT | GL_CURRENT_BIT | GL_LIST_BIT}};
constexpr Mask kWithAll[] = {{"ALL_ATTRIB_BITS", 0xFFFFFFFFu}, {"ALL_ATTRIB_BITS_1_0", 0x000FFFFFu}};
constexpr Mask kOthers[] = {
    {"CURRENT_BIT", GL_CURRENT_BIT},
    {"POINT_BIT", GL_POINT_BIT},
    {"LINE_BIT", GL_LINE_BIT},
    {"POLYGON_BIT", GL_POLYGON_BIT},
    {"POLYGON_STIPPLE_BIT", GL_POLYGON_STIPPLE_BIT},
    {"PIXEL_MODE_BIT", GL_PIXEL_MODE_BIT},
    {"LIGHTING_BIT", GL_LIGHTING_BIT},
    {"FOG_BIT", GL_FOG_BIT},
    {"DEPTH_BUFFER_BIT", GL_DEPTH_BUFFER_BIT},
    {"ACCUM_BUFFER_BIT", GL_ACCUM_BUFFER_BIT},
    {"STENCIL_BUFFER_BIT", GL_STENCIL_BUFFER_BIT},
    {"VIEWPORT_BIT", GL_VIEWPORT_BIT},
    {"TRANSFORM_BIT", GL_TRANSFORM_BIT},
    {"COLOR_BUFFER_BIT", GL_COLOR_BUFFER_BIT},
    {"HINT_BIT", GL_HINT_BIT},
    {"LIST_BIT", GL_LIST_BIT},
    {"TEXTURE_BIT", GL_TEXTURE_BIT},
    {"SCISSOR_BIT", GL_SCISSOR_BIT},
    {"NO_BIT", 0},
    {"ALL_OTHERS", 0x000FFFFFu & ~static_cast<GLbitfield>(GL_EVAL_BIT | GL_ENABLE_BIT)}};

// The version in which AUTO_NORMAL came into the enable group.
bool enable_bit_has_auto_normal(const Test& t) { return t.gl().at_least(1, 1); }

EVALCTS_TEST(AttributeStack, EvalBit, must, "EV-ATTRIB-EVALBIT", "EV-API-ENUM-OTHER",
             combine(kWithEval).by(in_lists()))
(Test& t, const Mask& mask) {
  gl::Case c("set, push, set otherwise, pop");
  Queries pushed;
  const Queries queries = push_and_pop(c, mask.bits, &pushed);
  const gl::Ref error = c.GetError();
  Played played = t.play(c);
  played.expect_no_error(error);
  expect_all(played, pushed, kBefore);
  expect_all(played, queries, kBefore);
};

EVALCTS_TEST(AttributeStack, AllBits, must, "EV-ATTRIB-ALL", combine(kWithAll).by(in_lists()))
(Test& t, const Mask& mask) {
  gl::Case c("set, push, set otherwise, pop");
  Queries pushed;
  const Queries queries = push_and_pop(c, mask.bits, &pushed);
  const gl::Ref error = c.GetError();
  Played played = t.play(c);
  played.expect_no_error(error);
  expect_all(played, pushed, kBefore);
  expect_all(played, queries, kBefore);
};

EVALCTS_TEST(AttributeStack, EnableBit, must, "EV-ATTRIB-ENABLEBIT", by(in_lists()))
(Test& t) {
  gl::Case c("set, push, set otherwise, pop");
  Queries pushed;
  const Queries queries = push_and_pop(c, GL_ENABLE_BIT, &pushed);
  const gl::Ref error = c.GetError();
  Played played = t.play(c);
  played.expect_no_error(error);
  expect_all(played, pushed, kBefore);
  expect_enables(played, queries, kBefore);
  if (enable_bit_has_auto_normal(t)) expect_auto_normal(played, queries, kBefore);
};

// Each enable by itself, both ways.
EVALCTS_TEST(AttributeStack, EachEnable, must, "EV-ATTRIB-ENABLEBIT", "EV-ATTRIB-EVALBIT")
(Test& t) {
  std::vector<GLenum> caps(gl::kMap1Targets.begin(), gl::kMap1Targets.end());
  caps.insert(caps.end(), gl::kMap2Targets.begin(), gl::kMap2Targets.end());
  if (enable_bit_has_auto_normal(t)) caps.push_back(GL_AUTO_NORMAL);
  for (const GLbitfield mask : {GL_ENABLE_BIT, GL_EVAL_BIT}) {
    gl::Case c(mask == GL_ENABLE_BIT ? "ENABLE_BIT" : "EVAL_BIT");
    std::vector<gl::Ref> off, on;
    for (const GLenum cap : caps) {
      c.PushAttrib(mask);
      c.Enable(cap);
      c.PopAttrib();
      off.push_back(c.IsEnabled(cap));
      c.Enable(cap);
      c.PushAttrib(mask);
      c.Disable(cap);
      c.PopAttrib();
      on.push_back(c.IsEnabled(cap));
      c.Disable(cap);
    }
    Played played = t.play(c);
    for (std::size_t i = 0; i < caps.size(); ++i) {
      played.expect_result(off[i], GL_FALSE);
      played.expect_result(on[i], GL_TRUE);
    }
  }
};

EVALCTS_TEST(AttributeStack, EnableBitHasNoGrids, must, "EV-ATTRIB-ENABLEBIT-NOGRID", by(in_lists()))
(Test& t) {
  gl::Case c("set, push ENABLE_BIT, set otherwise, pop");
  const Queries queries = push_and_pop(c, GL_ENABLE_BIT);
  Played played = t.play(c);
  expect_grids(played, queries, kAfter);
};

EVALCTS_TEST(AttributeStack, OtherBits, must, "EV-ATTRIB-OTHERBITS", combine(kOthers).by(in_lists()))
(Test& t, const Mask& mask) {
  gl::Case c("set, push, set otherwise, pop");
  Queries pushed;
  const Queries queries = push_and_pop(c, mask.bits, &pushed);
  Played played = t.play(c);
  expect_all(played, pushed, kBefore);
  expect_all(played, queries, kAfter);
};

// ORDER, DOMAIN and COEFF belong to no group.
EVALCTS_TEST(AttributeStack, MapsStay, must, "EV-ATTRIB-NOMAPS",
             combine((std::vector<Mask>{kWithEval[0], kWithAll[0], kWithAll[1]})).by(in_lists()))
(Test& t, const Mask& mask) {
  for (const bool anew : {true, false}) {
    gl::Case c(anew ? "maps defined, pushed, defined anew, popped" : "maps defined, pushed, popped");
    std::vector<Map> maps1;
    std::vector<Map> maps2;
    const auto define_all = [&](int order) {
      maps1.clear(), maps2.clear();
      for (const GLenum target : gl::kMap1Targets) {
        maps1.push_back(random_map(t, target, order));
        maps1.back().u1 = -order;
        define(c, maps1.back());
      }
      for (const GLenum target : gl::kMap2Targets) {
        maps2.push_back(random_map(t, target, {order, order + 1}));
        maps2.back().v2 = 2.0 + order;
        define(c, maps2.back());
      }
    };
    define_all(3);
    c.PushAttrib(mask.bits);
    if (anew) define_all(4);
    c.PopAttrib();
    std::vector<MapQuery> queries1, queries2;
    for (const GLenum target : gl::kMap1Targets) queries1.push_back(query_map(c, target, t.max_order()));
    for (const GLenum target : gl::kMap2Targets) queries2.push_back(query_map(c, target, t.max_order()));
    Played played = t.play(c);
    for (std::size_t i = 0; i < maps1.size(); ++i) expect_map(played, queries1[i], maps1[i]);
    for (std::size_t i = 0; i < maps2.size(); ++i) expect_map(played, queries2[i], maps2[i]);
  }
};

// What is evaluated afterwards goes by the enables and grids that came back, and by the new points.
EVALCTS_TEST(AttributeStack, EvaluatesAsRestored, must, "EV-ATTRIB-EVALBIT", "EV-ATTRIB-NOMAPS",
             by(gl::list_deliveries()))
(Test& t) {
  gl::Case c("points of a grid before the push, after other settings, and after the pop");
  const auto draw = [&] {
    c.EvalMesh1(GL_POINT, 0, 3);
    c.EvalMesh2(GL_POINT, 0, 2, 0, 1);
  };
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4}) {
    define(c, random_map(t, target, 3));
    c.Enable(target);
  }
  for (const GLenum target : {GL_MAP2_VERTEX_3, GL_MAP2_NORMAL}) {
    define(c, random_map(t, target, {3, 2}));
    c.Enable(target);
  }
  c.MapGrid1f(3, 0.0f, 0.75f);
  c.MapGrid2f(2, 0.25f, 1.0f, 1, 0.5f, 0.0f);
  draw();
  c.PushAttrib(GL_EVAL_BIT);
  c.Disable(GL_MAP1_COLOR_4);
  c.Disable(GL_MAP2_NORMAL);
  c.Enable(GL_MAP1_TEXTURE_COORD_2);
  c.Enable(GL_AUTO_NORMAL);
  c.MapGrid1f(5, 1.0f, 0.5f);
  c.MapGrid2f(3, 0.0f, 0.5f, 2, 1.0f, 0.25f);
  define(c, random_map(t, GL_MAP1_VERTEX_3, 4));
  define(c, random_map(t, GL_MAP2_VERTEX_3, {2, 4}));
  draw();
  c.PopAttrib();
  draw();
  t.expect_emission(c, kPosition | kColor | kNormal | kTextureCoordinate0);
};

// Where no enable changes between push and pop, the grid comes back all the same, for meshes as for queries.
EVALCTS_TEST(AttributeStack, EvaluatesWithRestoredGrid, must, "EV-ATTRIB-EVALBIT", by(gl::list_deliveries()))
(Test& t) {
  gl::Case c("points of a grid before the push, of another grid, and after the pop");
  const auto draw = [&] {
    c.EvalMesh1(GL_POINT, 0, 3);
    c.EvalMesh2(GL_POINT, 0, 2, 0, 1);
  };
  define(c, random_map(t, GL_MAP1_VERTEX_3, 3));
  c.Enable(GL_MAP1_VERTEX_3);
  define(c, random_map(t, GL_MAP2_VERTEX_3, {3, 2}));
  c.Enable(GL_MAP2_VERTEX_3);
  c.MapGrid1f(3, 0.0f, 0.75f);
  c.MapGrid2f(2, 0.25f, 1.0f, 1, 0.5f, 0.0f);
  draw();
  for (const GLbitfield mask : {static_cast<GLbitfield>(GL_EVAL_BIT), 0xFFFFFFFFu}) {
    c.PushAttrib(mask);
    c.MapGrid1f(5, 1.0f, 0.5f);
    c.MapGrid2f(3, 0.0f, 0.5f, 2, 1.0f, 0.25f);
    draw();
    c.PopAttrib();
    draw();
  }
  t.expect_emission(c, kPosition);
};

// Where no grid changes, the enables come back all the same: which vertex map wins, and what gives the
// normals.
EVALCTS_TEST(AttributeStack, EvaluatesWithRestoredEnables, must, "EV-ATTRIB-EVALBIT", "EV-ATTRIB-ENABLEBIT",
             by(gl::list_deliveries()))
(Test& t) {
  struct Change {
    const char* name;
    GLenum cap;
  };
  for (const auto& [name, cap] : {Change{"a curve", GL_MAP1_VERTEX_4},
                                  {"a surface", GL_MAP2_VERTEX_4},
                                  {"automatic normals", GL_AUTO_NORMAL}})
    for (const GLbitfield mask : {GL_EVAL_BIT, GL_ENABLE_BIT}) {
      if (cap == GL_AUTO_NORMAL && mask == GL_ENABLE_BIT && !enable_bit_has_auto_normal(t)) continue;
      gl::Case c(fmt::format("{}, {}", name, mask == GL_EVAL_BIT ? "EVAL_BIT" : "ENABLE_BIT"));
      for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_VERTEX_4, GL_MAP1_NORMAL}) {
        define(c, random_map(t, target, 3));
        if (target != GL_MAP1_VERTEX_4) c.Enable(target);
      }
      for (const GLenum target : {GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4, GL_MAP2_NORMAL}) {
        define(c, random_map(t, target, {3, 2}));
        if (target != GL_MAP2_VERTEX_4) c.Enable(target);
      }
      c.MapGrid1f(3, 0.0f, 0.75f);
      c.MapGrid2f(2, 0.25f, 1.0f, 1, 0.5f, 0.0f);
      const auto draw = [&] {
        c.EvalMesh1(GL_POINT, 0, 1);
        c.EvalMesh2(GL_POINT, 0, 1, 0, 1);
      };
      draw();
      c.PushAttrib(mask);
      c.Enable(cap);
      draw();
      c.PushAttrib(mask);
      c.Disable(cap);
      draw();
      c.PopAttrib();
      draw();
      c.PopAttrib();
      draw();
      t.expect_emission(c, kPosition | kNormal);
    }
};

EVALCTS_TEST(AttributeStack, Nested, must, "EV-ATTRIB-NEST", by(in_lists()))
(Test& t) {
  gl::Case c("two levels, popped one after the other");
  set(c, kBefore);
  c.PushAttrib(GL_EVAL_BIT);
  set(c, kAfter);
  c.PushAttrib(GL_EVAL_BIT);
  set(c, kLast);
  const Queries third = query(c);
  c.PopAttrib();
  const Queries second = query(c);
  c.PopAttrib();
  const Queries first = query(c);
  Played played = t.play(c);
  expect_all(played, third, kLast);
  expect_all(played, second, kAfter);
  expect_all(played, first, kBefore);
};

// The same with other groups that have enables.
EVALCTS_TEST(AttributeStack, NestedEnables, must, "EV-ATTRIB-NEST",
             combine((std::vector<Mask>{{"ENABLE_BIT", GL_ENABLE_BIT}, kWithAll[0]})).by(in_lists()))
(Test& t, const Mask& mask) {
  gl::Case c("three levels, popped one after the other");
  const State states[] = {kBefore, kAfter, kLast, kAfter};
  for (const State& state : states) {
    set(c, state);
    if (&state != &states[3]) c.PushAttrib(mask.bits);
  }
  std::vector<Queries> popped;
  for (int level = 0; level < 3; ++level) {
    c.PopAttrib();
    popped.push_back(query(c));
  }
  Played played = t.play(c);
  for (std::size_t level = 0; level < popped.size(); ++level) {
    expect_enables(played, popped[level], states[2 - level]);
    if (enable_bit_has_auto_normal(t)) expect_auto_normal(played, popped[level], states[2 - level]);
  }
};

// Each level restores its own groups only.
EVALCTS_TEST(AttributeStack, NestedGroups, must, "EV-ATTRIB-NEST", "EV-ATTRIB-ENABLEBIT-NOGRID",
             by(in_lists()))
(Test& t) {
  gl::Case c("EVAL_BIT, in it ENABLE_BIT, in it CURRENT_BIT");
  set(c, kBefore);
  c.PushAttrib(GL_EVAL_BIT);
  set(c, kAfter);
  c.PushAttrib(GL_ENABLE_BIT);
  set(c, kLast);
  c.PushAttrib(GL_CURRENT_BIT);
  c.PopAttrib();
  const Queries third = query(c);
  c.PopAttrib();
  const Queries second = query(c);
  c.PopAttrib();
  const Queries first = query(c);
  Played played = t.play(c);
  expect_all(played, third, kLast);
  expect_enables(played, second, kAfter);
  expect_grids(played, second, kLast);
  expect_all(played, first, kBefore);
};

// Sixteen levels, the least depth of the stack.
EVALCTS_TEST(AttributeStack, NestedDeeply, must, "EV-ATTRIB-NEST")
(Test& t) {
  constexpr GLint kDepth = 16;
  gl::Case c("sixteen levels, each with settings of its own");
  for (GLint depth = 0; depth < kDepth; ++depth) {
    set(c, {depth % 2 == 0, depth % 3 == 0, 1 + depth});
    c.PushAttrib(GL_EVAL_BIT);
  }
  set(c, kLast);
  std::vector<Queries> queries;
  for (GLint depth = kDepth; depth-- > 0;) {
    c.PopAttrib();
    queries.push_back(query(c));
  }
  const gl::Ref error = c.GetError();
  Played played = t.play(c);
  played.expect_no_error(error);
  for (GLint depth = 0; depth < kDepth; ++depth) {
    const auto level = static_cast<std::size_t>(kDepth - 1 - depth);
    expect_all(played, queries[level], {depth % 2 == 0, depth % 3 == 0, 1 + depth});
  }
};

}  // namespace
}  // namespace evalcts::suite_attribute_stack
