// Section 21 of the requirements, the attribute stack: the evaluator state that PushAttrib saves, and that
// which it does not save.
#include <fmt/format.h>

#include <evalcts/testkit/registration.h>

#include "maps.h"

namespace evalcts::suite_attribute_stack {
namespace {

// A setting of all evaluator state that belongs to attribute groups.
struct State {
  bool odd_maps = false;  // selects which maps are enabled: every second one
  bool auto_normal = false;
  GLint segments = 1;  // segments of the one-dimensional grid; all other grid values follow from this one
};
// Each state differs from the next one in all values.
constexpr State kBefore{false, true, 3}, kAfter{true, false, 7}, kLast{false, true, 12};

bool enabled(const State& state, std::size_t i) { return (i % 2 == 1) == state.odd_maps; }
std::vector<double> grid1(const State& state) { return {0.25 * state.segments, -1.0 * state.segments}; }
std::vector<double> grid2(const State& state) {
  return {-0.5 * state.segments, 2.0 * state.segments, 1.0 + state.segments, 0.125 * state.segments};
}

void set(gl::Case& c, const State& state) {
  const auto enable = [&](GLenum cap, bool on) { on ? c.Enable(cap) : c.Disable(cap); };
  for (std::size_t i = 0; i < gl::kMap1Targets.size(); ++i) {
    enable(gl::kMap1Targets[i], enabled(state, i));
    enable(gl::kMap2Targets[i], enabled(state, i + 1));
  }
  enable(GL_AUTO_NORMAL, state.auto_normal);
  const std::vector<float> one = converted<float>(grid1(state)), two = converted<float>(grid2(state));
  c.MapGrid1f(state.segments, one[0], one[1]);
  c.MapGrid2f(state.segments + 1, two[0], two[1], state.segments + 2, two[2], two[3]);
}

void ask_for_enables(gl::Case& c) {
  for (std::size_t i = 0; i < gl::kMap1Targets.size(); ++i) {
    c.IsEnabled(gl::kMap1Targets[i]);
    c.IsEnabled(gl::kMap2Targets[i]);
  }
}
bool can_query_grids(Test& t) {
  return t.can_query_grid(GL_MAP1_GRID_SEGMENTS) && t.can_query_grid(GL_MAP1_GRID_DOMAIN) &&
         t.can_query_grid(GL_MAP2_GRID_SEGMENTS) && t.can_query_grid(GL_MAP2_GRID_DOMAIN);
}
void ask_for_grids(Test& t, gl::Case& c) {
  if (!can_query_grids(t)) return;
  c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
  c.GetFloatv(GL_MAP1_GRID_DOMAIN, gl::out<GLfloat>(2));
  c.GetIntegerv(GL_MAP2_GRID_SEGMENTS, gl::out<GLint>(2));
  c.GetFloatv(GL_MAP2_GRID_DOMAIN, gl::out<GLfloat>(4));
}
void ask_for_all(Test& t, gl::Case& c) {
  ask_for_enables(c);
  c.IsEnabled(GL_AUTO_NORMAL);
  ask_for_grids(t, c);
}

// Returns a case that sets kBefore, pushes the groups of the mask, sets kAfter and pops, with queries after
// the push.
gl::Case pushed_and_popped(Test& t, GLbitfield mask) {
  gl::Case c("set, push, set otherwise, pop");
  set(c, kBefore);
  c.PushAttrib(mask);
  ask_for_all(t, c);
  set(c, kAfter);
  c.PopAttrib();
  return c;
}

// Masks with the group that contains all evaluator state, alone and with others.
constexpr NamedValue<GLbitfield> kWithEval[] = {
    {"EVAL_BIT", GL_EVAL_BIT},
    {"EVAL_AND_ENABLE_BIT", GL_EVAL_BIT | GL_ENABLE_BIT},
    {"EVAL_AND_CURRENT_AND_LIST_BIT", GL_EVAL_BIT | GL_CURRENT_BIT | GL_LIST_BIT}};
constexpr NamedValue<GLbitfield> kWithAll[] = {{"ALL_ATTRIB_BITS", 0xFFFFFFFFu},
                                               {"ALL_ATTRIB_BITS_1_0", 0x000FFFFFu}};
constexpr NamedValue<GLbitfield> kOthers[] = {
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

// Returns true if the version has AUTO_NORMAL in the enable group.
bool enable_bit_has_auto_normal(const Test& t) { return t.gl().at_least(1, 1); }

void judge_all(Test& t, const NamedValue<GLbitfield>& mask) {
  gl::Case c = pushed_and_popped(t, mask.value);
  ask_for_all(t, c);
  c.GetError();
  t.judge(c);
}

EVALCTS_TEST(AttributeStack, EvalBit, kMust, "EV-ATTRIB-EVALBIT", "EV-API-ENUM-OTHER",
             combine(kWithEval).by(in_lists()))
(Test& t, const NamedValue<GLbitfield>& mask) { judge_all(t, mask); };

EVALCTS_TEST(AttributeStack, AllBits, kMust, "EV-ATTRIB-ALL", combine(kWithAll).by(in_lists()))
(Test& t, const NamedValue<GLbitfield>& mask) { judge_all(t, mask); };

EVALCTS_TEST(AttributeStack, EnableBit, kMust, "EV-ATTRIB-ENABLEBIT", by(in_lists()))
(Test& t) {
  gl::Case c = pushed_and_popped(t, GL_ENABLE_BIT);
  ask_for_enables(c);
  if (enable_bit_has_auto_normal(t)) c.IsEnabled(GL_AUTO_NORMAL);
  c.GetError();
  t.judge(c);
};

// Each enable alone is restored, both to disabled and to enabled.
EVALCTS_TEST(AttributeStack, EachEnable, kMust, "EV-ATTRIB-ENABLEBIT", "EV-ATTRIB-EVALBIT")
(Test& t) {
  for (const GLbitfield mask : {GL_ENABLE_BIT, GL_EVAL_BIT}) {
    gl::Case c(mask == GL_ENABLE_BIT ? "ENABLE_BIT" : "EVAL_BIT");
    for (const GLenum cap : all_caps()) {
      if (cap == GL_AUTO_NORMAL && !enable_bit_has_auto_normal(t)) continue;
      c.PushAttrib(mask);
      c.Enable(cap);
      c.PopAttrib();
      c.IsEnabled(cap);
      c.Enable(cap);
      c.PushAttrib(mask);
      c.Disable(cap);
      c.PopAttrib();
      c.IsEnabled(cap);
      c.Disable(cap);
    }
    t.judge(c);
  }
};

EVALCTS_TEST(AttributeStack, EnableBitHasNoGrids, kMust, "EV-ATTRIB-ENABLEBIT-NOGRID", by(in_lists()))
(Test& t) {
  if (!can_query_grids(t)) throw NotObservable("queries of grids are rejected");
  gl::Case c("set, push ENABLE_BIT, set otherwise, pop");
  set(c, kBefore);
  c.PushAttrib(GL_ENABLE_BIT);
  set(c, kAfter);
  c.PopAttrib();
  ask_for_grids(t, c);
  t.judge(c);
};

EVALCTS_TEST(AttributeStack, OtherBits, kMust, "EV-ATTRIB-OTHERBITS", combine(kOthers).by(in_lists()))
(Test& t, const NamedValue<GLbitfield>& mask) { judge_all(t, mask); };

// Maps belong to no attribute group: PopAttrib does not change their ORDER, DOMAIN and COEFF.
EVALCTS_TEST(
    AttributeStack, MapsStay, kMust, "EV-ATTRIB-NOMAPS",
    combine((std::vector<NamedValue<GLbitfield>>{kWithEval[0], kWithAll[0], kWithAll[1]})).by(in_lists()))
(Test& t, const NamedValue<GLbitfield>& mask) {
  for (const bool again : {true, false}) {
    gl::Case c(again ? "maps defined, pushed, defined again, popped" : "maps defined, pushed, popped");
    const auto define_all = [&](int order) {
      for (const GLenum target : all_targets()) {
        const Map map = random_map(t, target, {order, order + 1});
        define(c, map.two ? over(map, {0, 1}, {0, 2.0 + order}) : over(map, {-1.0 * order, 1}));
      }
    };
    define_all(3);
    c.PushAttrib(mask.value);
    if (again) define_all(4);
    c.PopAttrib();
    for (const GLenum target : all_targets()) query_map(t, c, target);
    t.judge(c);
  }
};

void set_grids(gl::Case& c) {
  c.MapGrid1f(3, 0.0f, 0.75f);
  c.MapGrid2f(2, 0.25f, 1.0f, 1, 0.5f, 0.0f);
}
void set_other_grids(gl::Case& c) {
  c.MapGrid1f(5, 1.0f, 0.5f);
  c.MapGrid2f(3, 0.0f, 0.5f, 2, 1.0f, 0.25f);
}
void draw_meshes(gl::Case& c) {
  c.EvalMesh1(GL_POINT, 0, 3);
  c.EvalMesh2(GL_POINT, 0, 2, 0, 1);
}

// After PopAttrib, meshes use the restored enables and grids, and the new control points.
EVALCTS_TEST(AttributeStack, EvaluatesAsRestored, kMust, "EV-ATTRIB-EVALBIT", "EV-ATTRIB-NOMAPS",
             by(gl::list_deliveries()))
(Test& t) {
  gl::Case c("points of a grid before the push, after other settings, and after the pop");
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP2_VERTEX_3, GL_MAP2_NORMAL})
    define_and_enable(c, random_map(t, target, {3, 2}));
  set_grids(c);
  draw_meshes(c);
  c.PushAttrib(GL_EVAL_BIT);
  c.Disable(GL_MAP1_COLOR_4);
  c.Disable(GL_MAP2_NORMAL);
  c.Enable(GL_MAP1_TEXTURE_COORD_2);
  c.Enable(GL_AUTO_NORMAL);
  set_other_grids(c);
  define(c, random_map(t, GL_MAP1_VERTEX_3, 4));
  define(c, random_map(t, GL_MAP2_VERTEX_3, {2, 4}));
  draw_meshes(c);
  c.PopAttrib();
  draw_meshes(c);
  t.judge_vertices(c, kPosition | kColor | kNormal | kTextureCoordinate0);
};

// PopAttrib restores the grid for meshes even if no enable has changed since PushAttrib.
EVALCTS_TEST(AttributeStack, EvaluatesWithRestoredGrid, kMust, "EV-ATTRIB-EVALBIT", by(gl::list_deliveries()))
(Test& t) {
  gl::Case c("points of a grid before the push, of another grid, and after the pop");
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP2_VERTEX_3})
    define_and_enable(c, random_map(t, target, {3, 2}));
  set_grids(c);
  draw_meshes(c);
  for (const GLbitfield mask : {static_cast<GLbitfield>(GL_EVAL_BIT), 0xFFFFFFFFu}) {
    c.PushAttrib(mask);
    set_other_grids(c);
    draw_meshes(c);
    c.PopAttrib();
    draw_meshes(c);
  }
  t.judge_vertices(c, kPosition);
};

// PopAttrib restores the enables for meshes even if no grid has changed since PushAttrib. The enables decide
// which vertex map is used, and where normals come from.
EVALCTS_TEST(AttributeStack, EvaluatesWithRestoredEnables, kMust, "EV-ATTRIB-EVALBIT", "EV-ATTRIB-ENABLEBIT",
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
      for (const bool two : {false, true})
        for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_VERTEX_4, GL_MAP1_NORMAL}) {
          define(c, random_map(t, target_in(two, target), {3, 2}));
          if (target != GL_MAP1_VERTEX_4) c.Enable(target_in(two, target));
        }
      set_grids(c);
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
      t.judge_vertices(c, kPosition | kNormal);
    }
};

EVALCTS_TEST(AttributeStack, Nested, kMust, "EV-ATTRIB-NEST", by(in_lists()))
(Test& t) {
  gl::Case c("two levels, popped one after the other");
  set(c, kBefore);
  c.PushAttrib(GL_EVAL_BIT);
  set(c, kAfter);
  c.PushAttrib(GL_EVAL_BIT);
  set(c, kLast);
  ask_for_all(t, c);
  c.PopAttrib();
  ask_for_all(t, c);
  c.PopAttrib();
  ask_for_all(t, c);
  t.judge(c);
};

// The same with other masks that contain the enables, and three levels.
EVALCTS_TEST(
    AttributeStack, NestedEnables, kMust, "EV-ATTRIB-NEST",
    combine((std::vector<NamedValue<GLbitfield>>{{"ENABLE_BIT", GL_ENABLE_BIT}, kWithAll[0]})).by(in_lists()))
(Test& t, const NamedValue<GLbitfield>& mask) {
  gl::Case c("three levels, popped one after the other");
  const State states[] = {kBefore, kAfter, kLast, kAfter};
  for (const State& state : states) {
    set(c, state);
    if (&state != &states[3]) c.PushAttrib(mask.value);
  }
  for (int level = 2; level >= 0; --level) {
    c.PopAttrib();
    ask_for_enables(c);
    if (enable_bit_has_auto_normal(t)) c.IsEnabled(GL_AUTO_NORMAL);
  }
  t.judge(c);
};

// PopAttrib restores only the groups that were pushed at its level.
EVALCTS_TEST(AttributeStack, NestedGroups, kMust, "EV-ATTRIB-NEST", "EV-ATTRIB-ENABLEBIT-NOGRID",
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
  ask_for_all(t, c);
  c.PopAttrib();
  ask_for_enables(c);
  ask_for_grids(t, c);
  c.PopAttrib();
  ask_for_all(t, c);
  t.judge(c);
};

// Throws NotObservable if PopAttrib does not undo such changes to the size of points either.
void require_undone_behind(Test& t, GLbitfield inner) {
  gl::Case c(gl::control("the size of points"));
  c.PointSize(2);
  c.PushAttrib(GL_POINT_BIT);
  c.PushAttrib(inner);
  c.PointSize(3);
  c.PopAttrib();
  c.PopAttrib();
  const gl::Ref size = c.GetFloatv(GL_POINT_SIZE, gl::out<GLfloat>(1));
  try {
    if (t.play(c).trace().values<GLfloat>(size).front() != 2)
      throw NotObservable(
          "pipeline: behind a nested PushAttrib of another group, changes to the size of "
          "points are not undone either");
  } catch (const gl::MissingEntryPoint&) {
    // A sink need not have other state.
  }
}

// Changes behind a nested push of another group are undone when the outer level is popped.
EVALCTS_TEST(AttributeStack, NestedBehindOtherGroups, kMust, "EV-ATTRIB-NEST",
             combine((std::vector<NamedValue<GLbitfield>>{
                         {"CURRENT_BIT", GL_CURRENT_BIT}, {"LIGHTING_BIT", GL_LIGHTING_BIT}, {"NO_BIT", 0}}))
                 .by(in_lists()))
(Test& t, const NamedValue<GLbitfield>& inner) {
  require_undone_behind(t, inner.value);
  for (const GLbitfield outer : {GL_EVAL_BIT, GL_ENABLE_BIT}) {
    gl::Case c(outer == GL_EVAL_BIT ? "in EVAL_BIT" : "in ENABLE_BIT");
    set(c, kBefore);
    c.PushAttrib(outer);
    c.PushAttrib(inner.value);
    set(c, kAfter);
    c.PopAttrib();
    ask_for_all(t, c);
    c.PopAttrib();
    ask_for_enables(c);
    if (outer == GL_EVAL_BIT || enable_bit_has_auto_normal(t)) c.IsEnabled(GL_AUTO_NORMAL);
    ask_for_grids(t, c);
    t.judge(c);
  }
};

// Sixteen levels, the minimum depth of the stack.
EVALCTS_TEST(AttributeStack, NestedDeeply, kMust, "EV-ATTRIB-NEST")
(Test& t) {
  constexpr GLint kDepth = 16;
  gl::Case c("sixteen levels, each with settings of its own");
  const auto state = [](GLint depth) { return State{depth % 2 == 0, depth % 3 == 0, 1 + depth}; };
  for (GLint depth = 0; depth < kDepth; ++depth) {
    set(c, state(depth));
    c.PushAttrib(GL_EVAL_BIT);
  }
  set(c, kLast);
  for (GLint depth = kDepth; depth-- > 0;) {
    c.PopAttrib();
    ask_for_all(t, c);
  }
  c.GetError();
  t.judge(c);
};

}  // namespace
}  // namespace evalcts::suite_attribute_stack
