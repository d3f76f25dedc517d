// Section 6 of the requirements: the 18 map enables and AUTO_NORMAL.
#include <fmt/format.h>

#include <evalcts/gl/lift.h>
#include <evalcts/testkit/registration.h>
#include "maps.h"

namespace evalcts::suite_enables {
namespace {

std::vector<GLenum> all_caps() {
  std::vector<GLenum> caps(gl::kMap1Targets.begin(), gl::kMap1Targets.end());
  caps.insert(caps.end(), gl::kMap2Targets.begin(), gl::kMap2Targets.end());
  caps.push_back(GL_AUTO_NORMAL);
  return caps;
}

// What IsEnabled says of all 19.
std::vector<gl::Ref> query_enables(gl::Case& c) {
  std::vector<gl::Ref> refs;
  for (const GLenum cap : all_caps()) refs.push_back(c.IsEnabled(cap));
  return refs;
}

}  // namespace

EVALCTS_TEST(Enables, Accepted, must, "EV-EN-CAPS", combine(all_caps()).by(gl::list_deliveries()))
(Test& t, GLenum cap) {
  gl::Case c("off, on, on again, off");
  std::vector<std::pair<gl::Ref, GLboolean>> answers;
  std::vector<gl::Ref> errors;
  const auto ask = [&](GLboolean expected) {
    errors.push_back(c.GetError());
    answers.emplace_back(c.IsEnabled(cap), expected);
    errors.push_back(c.GetError());
  };
  ask(GL_FALSE);
  c.Enable(cap);
  ask(GL_TRUE);
  c.Enable(cap);
  ask(GL_TRUE);
  c.Disable(cap);
  ask(GL_FALSE);
  Played played = t.play(c);
  for (const gl::Ref error : errors) played.expect_no_error(error);
  for (const auto& [query, expected] : answers) played.expect_result(query, expected);
};

EVALCTS_TEST(Enables, Independent, must, "EV-EN-INDEP", combine(all_caps()).by(gl::list_deliveries()))
(Test& t, GLenum cap) {
  // Alone on among eighteen off, then alone off among eighteen on; map contents make no difference.
  for (const bool alone_on : {true, false}) {
    gl::Case c(alone_on ? "alone on" : "alone off");
    for (const GLenum other : all_caps()) {
      if (!alone_on) c.Enable(other);
    }
    define(c, make_map1(GL_MAP1_VERTEX_3, {1, 2, 3, 4, 5, 6}));
    if (alone_on) {
      c.Enable(cap);
    } else {
      c.Disable(cap);
    }
    const std::vector<gl::Ref> refs = query_enables(c);
    Played played = t.play(c);
    const std::vector<GLenum> caps = all_caps();
    for (std::size_t i = 0; i < caps.size(); ++i) played.expect_result(refs[i], (caps[i] == cap) == alone_on);
  }
};

// ... whatever maps of two dimensions and grids hold.
EVALCTS_TEST(Enables, IndependentOfDefinitions, must, "EV-EN-INDEP",
             combine(all_caps()).by(gl::list_deliveries()))
(Test& t, GLenum cap) {
  for (const bool alone_on : {true, false}) {
    gl::Case c(alone_on ? "alone on" : "alone off");
    for (const GLenum other : all_caps())
      if ((other == cap) == alone_on) c.Enable(other);
    for (const GLenum target : gl::kMap2Targets) define(c, random_map2(t, target, 3, 2));
    c.MapGrid1f(5, 2, 3);
    c.MapGrid2f(6, 4, 5, 7, 8, 9);
    const std::vector<gl::Ref> refs = query_enables(c);
    Played played = t.play(c);
    const std::vector<GLenum> caps = all_caps();
    for (std::size_t i = 0; i < caps.size(); ++i) played.expect_result(refs[i], (caps[i] == cap) == alone_on);
  }
};

EVALCTS_TEST(Enables, EveryGet, must, "EV-EN-GETS", combine(all_caps()).by(gl::list_deliveries()))
(Test& t, GLenum cap) {
  struct Stage {
    const char* name;
    bool enabled, disabled;
  };
  for (const Stage& stage : {Stage{"off", false, false}, {"on", true, false}, {"off again", true, true}}) {
    gl::Case c(stage.name);
    if (stage.enabled) c.Enable(cap);
    if (stage.disabled) c.Disable(cap);
    const gl::Ref boolean = c.GetBooleanv(cap, gl::out<GLboolean>(1));
    const gl::Ref integer = c.GetIntegerv(cap, gl::out<GLint>(1));
    const gl::Ref single = c.GetFloatv(cap, gl::out<GLfloat>(1));
    const gl::Ref real = c.GetDoublev(cap, gl::out<GLdouble>(1));
    const bool on = stage.enabled && !stage.disabled;
    Played played = t.play(c);
    for (const gl::Ref query : {boolean, integer, single, real})
      played.expect_values(query, std::vector<double>{on ? 1.0 : 0.0});
  }
};

EVALCTS_TEST(Enables, AllTogether, must, "EV-EN-MULTI", by(gl::list_deliveries()))
(Test& t) {
  gl::Case c("all 18, enabled from the last to the first");
  const std::vector<GLenum> caps = all_caps();
  for (std::size_t i = caps.size(); i-- > 0;) c.Enable(caps[i]);
  const gl::Ref error = c.GetError();
  const std::vector<gl::Ref> refs = query_enables(c);
  Played played = t.play(c);
  played.expect_no_error(error);
  for (const gl::Ref ref : refs) played.expect_result(ref, GL_TRUE);
};

EVALCTS_TEST(Enables, BetweenBeginAndEnd, must, "EV-EN-BEGINEND",
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
    const gl::Ref inside = attempt.call(c, cap);
    c.End();
    const gl::Ref error = c.GetError();
    const gl::Ref after = c.IsEnabled(cap);
    Played played = t.play(c);
    played.expect_result(inside, 0);
    played.expect_error(error, {GL_INVALID_OPERATION});
    played.expect_result(after, attempt.on_before);
  }
};

// In every primitive, before and after a vertex.
EVALCTS_TEST(Enables, InEveryPrimitive, must, "EV-EN-BEGINEND", combine(all_caps()))
(Test& t, GLenum cap) {
  gl::Case c("Enable, Disable and IsEnabled");
  std::vector<std::pair<gl::Ref, GLboolean>> answers;
  std::vector<gl::Ref> errors;
  for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode)
    for (const bool after_vertex : {false, true})
      for (const bool on : {false, true}) {
        on ? c.Enable(cap) : c.Disable(cap);
        c.Begin(mode);
        if (after_vertex) c.Vertex3f(1, 2, 3);
        on ? c.Disable(cap) : c.Enable(cap);
        c.End();
        errors.push_back(c.GetError());
        c.Begin(mode);
        if (after_vertex) c.Vertex3f(1, 2, 3);
        answers.emplace_back(c.IsEnabled(cap), GL_FALSE);
        c.End();
        errors.push_back(c.GetError());
        answers.emplace_back(c.IsEnabled(cap), on ? GL_TRUE : GL_FALSE);
      }
  Played played = t.play(c);
  for (const gl::Ref error : errors) played.expect_error(error, {GL_INVALID_OPERATION});
  for (const auto& [query, expected] : answers) played.expect_result(query, expected);
};

EVALCTS_TEST(Enables, NotPerTextureUnit, must, "EV-EN-NOTUNIT", combine(all_caps()).by(gl::list_deliveries()))
(Test& t, GLenum cap) {
  t.require(1, 3, "GL_ARB_multitexture");
  if (t.gl().texture_units < 2) throw NotSupported("has one texture unit only");
  for (const int unit : {1, t.gl().texture_units - 1}) {
    const GLenum other = GL_TEXTURE0 + static_cast<GLenum>(unit);
    gl::Case c(fmt::format("enabled on {}, seen on TEXTURE0, disabled on TEXTURE0, seen on the other",
                           unit == 1 ? "TEXTURE1" : "the last unit"));
    c.ActiveTexture(other);
    c.Enable(cap);
    const gl::Ref error = c.GetError();
    c.ActiveTexture(GL_TEXTURE0);
    const gl::Ref seen = c.IsEnabled(cap);
    c.Disable(cap);
    c.ActiveTexture(other);
    const gl::Ref gone = c.IsEnabled(cap);
    Played played = t.play(c);
    played.expect_no_error(error);
    played.expect_result(seen, GL_TRUE);
    played.expect_result(gone, GL_FALSE);
  }
};

// MAP2 maps that are enabled, each with its initial constant, must not show in one-dimensional evaluation.
namespace {

void other_dimension(Test& t, bool two) {
  gl::Case c("all MAP2 maps and MAP1_VERTEX_3 enabled");
  set_current_values(c, {.normal = {0.6f, 0.0f, 0.8f}});
  for (const GLenum cap : gl::kMap2Targets) c.Enable(cap);
  // The vertex map alone, then beside a texture map that maps of the other dimension would outrank.
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_TEXTURE_COORD_2}) {
    define(c, random_map(t, target, 4));
    c.Enable(target);
    c.Begin(GL_POINTS);
    for (const float u : {0.0f, 0.4f, 1.0f}) c.EvalCoord1f(u);
    c.End();
  }
  // Nor do those that are disabled.
  for (const GLenum cap : gl::kMap2Targets) c.Disable(cap);
  for (const GLenum cap : {GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_4}) {
    define(c, random_map(t, cap, 3));
    c.Enable(cap);
  }
  c.Begin(GL_POINTS);
  for (const float u : {0.0f, 0.4f, 1.0f}) c.EvalCoord1f(u);
  c.End();
  t.expect_emission(two ? gl::lift(c, true) : c, kPosition | kColor | kNormal | kTextureCoordinate0);
}

}  // namespace

EVALCTS_TEST(Enables, OtherDimensionHasNoEffect, must, "EV-EN-DIM/1-D", "EV-COORD-DIM1",
             by(gl::list_deliveries()))
(Test& t) { other_dimension(t, false); };
EVALCTS_TEST(Enables, OtherDimensionHasNoEffect2, must, "EV-EN-DIM/2-D", "EV-COORD-DIM2",
             by(gl::list_deliveries()))
(Test& t) { other_dimension(t, true); };

}  // namespace evalcts::suite_enables
