// Section 6 of the requirements: the 18 map enables and AUTO_NORMAL.
#include <fmt/format.h>

#include <evalcts/gl/lift.h>
#include <evalcts/testkit/registration.h>
#include "dimensions.h"
#include "maps.h"

namespace evalcts::suite_enables {
namespace {

EVALCTS_TEST(Enables, Accepted, kMust, "EV-EN-CAPS", combine(all_caps()).by(gl::list_deliveries()))
(Test& t, GLenum cap) {
  gl::Case c("off, on, on again, off");
  const auto ask = [&] {
    c.GetError();
    c.IsEnabled(cap);
    c.GetError();
  };
  ask();
  c.Enable(cap);
  ask();
  c.Enable(cap);
  ask();
  c.Disable(cap);
  ask();
  t.judge(c);
};

void ask_for_all(gl::Case& c) {
  for (const GLenum cap : all_caps()) c.IsEnabled(cap);
}

EVALCTS_TEST(Enables, Independent, kMust, "EV-EN-INDEP", combine(all_caps()).by(gl::list_deliveries()))
(Test& t, GLenum cap) {
  // The capability is the only enabled one, then the only disabled one; a map is defined as well.
  for (const bool alone_on : {true, false}) {
    gl::Case c(alone_on ? "alone on" : "alone off");
    for (const GLenum other : all_caps())
      if (!alone_on) c.Enable(other);
    define(c, make_map1(GL_MAP1_VERTEX_3, {1, 2, 3, 4, 5, 6}));
    alone_on ? c.Enable(cap) : c.Disable(cap);
    ask_for_all(c);
    t.judge(c);
  }
};

// The same with all two-dimensional maps and the grids defined after the enables.
EVALCTS_TEST(Enables, IndependentOfDefinitions, kMust, "EV-EN-INDEP",
             combine(all_caps()).by(gl::list_deliveries()))
(Test& t, GLenum cap) {
  for (const bool alone_on : {true, false}) {
    gl::Case c(alone_on ? "alone on" : "alone off");
    for (const GLenum other : all_caps())
      if ((other == cap) == alone_on) c.Enable(other);
    for (const GLenum target : gl::kMap2Targets) define(c, random_map(t, target, {3, 2}));
    c.MapGrid1f(5, 2, 3);
    c.MapGrid2f(6, 4, 5, 7, 8, 9);
    ask_for_all(c);
    t.judge(c);
  }
};

EVALCTS_TEST(Enables, EveryGet, kMust, "EV-EN-GETS", combine(all_caps()).by(gl::list_deliveries()))
(Test& t, GLenum cap) {
  struct Stage {
    const char* name;
    bool enabled, disabled;
  };
  for (const Stage& stage : {Stage{"off", false, false}, {"on", true, false}, {"off again", true, true}}) {
    gl::Case c(stage.name);
    if (stage.enabled) c.Enable(cap);
    if (stage.disabled) c.Disable(cap);
    c.GetBooleanv(cap, gl::out<GLboolean>(1));
    c.GetIntegerv(cap, gl::out<GLint>(1));
    c.GetFloatv(cap, gl::out<GLfloat>(1));
    if (t.can_call(gl::EntryPoint::GetDoublev)) c.GetDoublev(cap, gl::out<GLdouble>(1));
    t.judge(c);
  }
};

EVALCTS_TEST(Enables, AllTogether, kMust, "EV-EN-MULTI", by(gl::list_deliveries()))
(Test& t) {
  gl::Case c("all 19, enabled from the last to the first");
  const std::vector<GLenum>& caps = all_caps();
  for (std::size_t i = caps.size(); i-- > 0;) c.Enable(caps[i]);
  c.GetError();
  ask_for_all(c);
  t.judge(c);
};

EVALCTS_TEST(Enables, BetweenBeginAndEnd, kMust, "EV-EN-BEGINEND",
             combine(all_caps()).by(gl::list_deliveries()))
(Test& t, GLenum cap) {
  struct Attempt {
    const char* name;
    bool on_before;
    gl::Ref (*call)(gl::Case&, GLenum);
  };
  for (const Attempt& attempt :
       {Attempt{"Enable", false, [](gl::Case&c, GLenum which) { return c.Enable(which); }},
        Attempt{"Disable", true, [](gl::Case&c, GLenum which) { return c.Disable(which); }},
        Attempt{"IsEnabled", true, [](gl::Case&c, GLenum which) { return c.IsEnabled(which); }}}) {
    gl::Case c(attempt.name);
    if (attempt.on_before) c.Enable(cap);
    c.Begin(GL_TRIANGLES);
    attempt.call(c, cap);
    c.End();
    c.GetError();
    c.IsEnabled(cap);
    t.judge(c);
  }
};

// Enable, Disable and IsEnabled are errors in all primitives, before and after a vertex.
EVALCTS_TEST(Enables, InEveryPrimitive, kMust, "EV-EN-BEGINEND", combine(all_caps()))
(Test& t, GLenum cap) {
  for (const bool is_query : {false, true}) {
    gl::Case c(is_query ? "IsEnabled" : "Enable and Disable");
    for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode)
      for (const bool after_vertex : {false, true})
        for (const bool on : {false, true}) {
          on ? c.Enable(cap) : c.Disable(cap);
          c.Begin(mode);
          if (after_vertex) c.Vertex3f(1, 2, 3);
          if (is_query)
            c.IsEnabled(cap);
          else
            on ? c.Disable(cap) : c.Enable(cap);
          c.End();
          c.GetError();
          c.IsEnabled(cap);
        }
    t.judge_answers(c);
  }
};

EVALCTS_TEST(Enables, NotPerTextureUnit, kMust, "EV-EN-NOTUNIT",
             combine(all_caps()).by(gl::list_deliveries()))
(Test& t, GLenum cap) {
  require_texture_units(t);
  for (const GLenum unit : {static_cast<GLenum>(GL_TEXTURE1), last_unit(t)}) {
    gl::Case c(fmt::format("enabled on {}, seen on TEXTURE0, disabled on TEXTURE0, seen on the other",
                           unit == GL_TEXTURE1 ? "TEXTURE1" : "the last unit"));
    c.ActiveTexture(unit);
    c.Enable(cap);
    c.GetError();
    c.ActiveTexture(GL_TEXTURE0);
    c.IsEnabled(cap);
    c.Disable(cap);
    c.ActiveTexture(unit);
    c.IsEnabled(cap);
    t.judge(c);
  }
};

// Enabled maps of the other dimension, which have their initial values, must not affect evaluation.
EVALCTS_TEST_PAIR(Enables.OtherDimensionHasNoEffect, Enables.OtherDimensionHasNoEffect2, kMust,
                  decide("EV-EN-DIM/1-D", "EV-EN-DIM/2-D"), decide("EV-COORD-DIM1", "EV-COORD-DIM2"),
                  by(gl::list_deliveries()))
(Test& t, bool two) {
  gl::Case c = with_current_values("all MAP2 maps and MAP1_VERTEX_3 enabled", {.normal = {0.6f, 0.0f, 0.8f}});
  const std::vector<double> us = {0, 0.4, 1};
  for (const GLenum cap : gl::kMap2Targets) c.Enable(cap);
  // The vertex map alone, then with a texture map over which maps of the other dimension would have
  // precedence.
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_TEXTURE_COORD_2}) {
    define_and_enable(c, random_map(t, target, 4));
    evaluate_all(c, us);
  }
  // The same with these maps disabled and further maps enabled.
  for (const GLenum cap : gl::kMap2Targets) c.Disable(cap);
  for (const GLenum target : {GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_4})
    define_and_enable(c, random_map(t, target, 3));
  evaluate_all(c, us);
  t.judge_vertices(two ? gl::lift(c, true) : c, kUnit0);
};

}  // namespace
}  // namespace evalcts::suite_enables
