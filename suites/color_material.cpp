// Section 12 of the requirements: evaluated colours in the lighting equation.
#include <fmt/format.h>

#include <evalcts/judge/prediction.h>
#include <evalcts/testkit/registration.h>
#include "drawings.h"

namespace evalcts::suite_color_material {
namespace {

// Deliveries of all evaluation commands without display lists, for tests with few parameters; not sparing().
std::vector<gl::Delivery> every_command() {
  return gl::without(gl::kLists | gl::kArrays, gl::curve_deliveries());
}
std::vector<gl::Delivery> in_primitives() {
  return gl::sparing(gl::without(gl::kLists | gl::kMeshes, gl::curve_deliveries()));
}

constexpr std::array<float, 4> kCurrent = {0.75f, 0.25f, 0.5f, 1.0f};

constexpr GLenum kTracked[] = {GL_EMISSION, GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_AMBIENT_AND_DIFFUSE};
constexpr GLenum kSomeTracked[] = {GL_EMISSION, GL_DIFFUSE, GL_AMBIENT_AND_DIFFUSE};

// Enables a light from the direction of the eye and sets dark materials, so that tracking any property
// changes the colour visibly.
void light(gl::Case& c) {
  enable_light(c, {0, 0, 1, 0});
  c.Lightfv(GL_LIGHT0, GL_AMBIENT, std::vector<float>{0.25f, 0.25f, 0.25f, 1});
  c.Lightfv(GL_LIGHT0, GL_DIFFUSE, std::vector<float>{0.5f, 0.5f, 0.5f, 1});
  c.Lightfv(GL_LIGHT0, GL_SPECULAR, std::vector<float>{0.5f, 0.5f, 0.5f, 1});
  c.LightModelfv(GL_LIGHT_MODEL_AMBIENT, std::vector<float>{0.5f, 0.5f, 0.5f, 1});
  for (const GLenum property : {GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION})
    c.Materialfv(GL_FRONT_AND_BACK, property, std::vector<float>{0.125f, 0.125f, 0.125f, 1});
  c.Normal3f(0, 0, 1);
}

void track(gl::Case& c, GLenum property, GLenum face = GL_FRONT_AND_BACK) {
  c.Color4f(kCurrent[0], kCurrent[1], kCurrent[2], kCurrent[3]);
  c.ColorMaterial(face, property);
  c.Enable(GL_COLOR_MATERIAL);
}

// Returns the state of lighting without and with tracking of the property by the current colour.
std::pair<gl::Case, gl::Case> lit(GLenum property, GLenum face = GL_FRONT_AND_BACK, bool two_sided = false) {
  gl::Case untracked;
  light(untracked);
  if (two_sided) untracked.LightModelfv(GL_LIGHT_MODEL_TWO_SIDE, std::vector<float>{1, 0, 0, 0});
  gl::Case tracked = untracked;
  track(tracked, property, face);
  return {untracked, tracked};
}

// Defines and enables maps of positions and colours.
void define_maps(gl::Case& c) {
  define(c, make_map1(GL_MAP1_VERTEX_3, {-0.5, -0.25, -0.5, 0.25, 0.75, 0.25, 0.75, -0.5, 0.5}));
  define(c, make_map1(GL_MAP1_COLOR_4, {0, 1, 0.25, 1, 1, 0.25, 0, 1, 0.5, 0, 1, 1}));
  c.Enable(GL_MAP1_VERTEX_3);
  c.Enable(GL_MAP1_COLOR_4);
}

void draw_points(gl::Case& c, bool evaluated = true) {
  c.Begin(GL_POINTS);
  for (const float u : {0.0f, 0.25f, 0.625f, 1.0f}) evaluated ? c.EvalCoord1f(u) : c.Vertex3f(u, 0, 0);
  c.End();
}

// Expects the picture of evaluated vertices under `state` to be like that of explicit ones. Throws
// NotObservable if the explicit ones look the same under `without`. `name` identifies the control.
void expect_lit_like_explicit(Test& t, const std::string& name, const gl::Case& state,
                              const gl::Case& without, const gl::Case& drawing) {
  const Part& control = drawn_once("ColorMaterial: " + name, [&] {
    const gl::Case vertices = explicit_commands(t, drawing);
    const Picture picture = feedback(t, gl::control("explicit vertices"), state, vertices);
    require_an_effect(picture,
                      feedback(t, gl::control("explicit vertices, in another state"), without, vertices));
    return picture.parts.at(0);
  });
  Picture picture = feedback(t, "evaluated", state, drawing);
  expect_like_explicit(picture.checked, picture.parts.at(0), control);
}

constexpr GLenum kProperties[] = {GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION};

// Appends queries of all materials, then of the current colour.
std::vector<gl::Ref> query_materials(gl::Case& c) {
  std::vector<gl::Ref> refs;
  for (const GLenum face : {GL_FRONT, GL_BACK})
    for (const GLenum property : kProperties)
      refs.push_back(c.GetMaterialfv(face, property, gl::out<GLfloat>(4)));
  refs.push_back(c.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4)));
  return refs;
}

EVALCTS_TEST(ColorMaterial, Effect, kMust, "EV-CMAT-EFFECT/1-D", combine(kTracked).by(without_lists()))
(Test& t, GLenum tracked) {
  t.require(1, 1);
  const auto& [untracked, state] = lit(tracked);
  gl::Case drawing;
  define_maps(drawing);
  draw_points(drawing);
  expect_lit_like_explicit(t, "effect " + label(tracked), state, untracked, drawing);
};

// Evaluated colours change neither materials nor the current colour, queried immediately and after a Flush.
EVALCTS_TEST(ColorMaterial, MaterialUntouched, kMust, "EV-CMAT-NOSTATE/1-D", "EV-CMAT-NOCURRENT/1-D",
             combine(kSomeTracked).by(gl::curve_deliveries()))
(Test& t, GLenum tracked) {
  t.require(1, 1);
  struct Queried {
    gl::Case script;
    std::vector<gl::Ref> before, after;
  };
  const auto write = [&](bool evaluated, bool flush) {
    const std::string identity = flush ? "queried after Flush" : "queried at once";
    Queried queried{gl::Case(evaluated ? identity : gl::control("explicit vertices, " + identity)), {}, {}};
    gl::Case& c = queried.script;
    light(c);
    track(c, tracked);
    define_maps(c);
    queried.before = query_materials(c);
    draw_points(c, evaluated);
    if (flush) c.Flush();
    queried.after = query_materials(c);
    return queried;
  };
  bool observed = false;
  for (const bool flush : {false, true}) {
    const Queried control = write(false, flush), evaluated = write(true, flush);
    const CheckedTrace of_vertices = t.play(control.script);
    bool kept = true;
    for (std::size_t i = 0; i < control.before.size(); ++i)
      kept = kept && of_vertices.trace().same(control.before[i], of_vertices.trace(), control.after[i]);
    if (!kept) continue;
    observed = true;
    CheckedTrace checked = t.play(evaluated.script);
    // t.requirement() chooses the dimension of the delivery.
    const auto decide = [&](const char* id) { t.decide({t.requirement(id)}); };
    for (std::size_t i = 0; i < evaluated.before.size(); ++i) {
      decide(i + 1 < evaluated.before.size() ? "EV-CMAT-NOSTATE" : "EV-CMAT-NOCURRENT");
      checked.expect_same(evaluated.before[i], evaluated.after[i]);
    }
  }
  if (!observed) throw NotObservable("pipeline: explicit vertices change materials or the current colour");
};

gl::Case one_vertex() {
  gl::Case c;
  c.Begin(GL_POINTS);
  c.Vertex3f(0.25f, 0.5f, 0.125f);
  c.End();
  return c;
}

// Returns the picture of an explicit vertex after the commands. Throws NotObservable if its colour is not
// tracked, as in Mesa 22.3 if no Color changes the current colour between Enable(COLOR_MATERIAL) and the
// vertex.
const Part& tracked_vertex(Test& t, GLenum tracked, gl::Case commands = {}) {
  const std::string what = commands.empty() ? "a vertex" : "a Color and a vertex";
  return drawn_once(fmt::format("ColorMaterial: {} {}", what, label(tracked)), [&] {
    const auto& [untracked, state] = lit(tracked);
    commands.append(one_vertex());
    const Picture picture = feedback(t, gl::control(what), state, commands);
    require_an_effect(picture, feedback(t, gl::control(what + ", not tracked"), untracked, commands));
    return picture.parts.at(0);
  });
}

// Explicit vertices after an evaluation, and evaluations after the colour map is disabled, are lit with the
// current colour.
EVALCTS_TEST(ColorMaterial, NextVertex, kMust, "EV-CMAT-NEXT/1-D", combine(kSomeTracked).by(in_primitives()))
(Test& t, GLenum tracked) {
  t.require(1, 1);
  gl::Case drawing;
  drawing.Color4f(0.25f, 0.875f, 0.625f, 1);
  tracked_vertex(t, tracked, drawing);
  const auto& [untracked, state] = lit(tracked);
  define_maps(drawing);
  drawing.Begin(GL_POINTS);
  for (const float u : {0.0f, 0.5f, 1.0f}) {
    drawing.EvalCoord1f(u);
    drawing.Vertex3f(0.5f * u, 0.25f, 0.125f);
  }
  drawing.End();
  drawing.Disable(GL_MAP1_COLOR_4);
  draw_points(drawing);
  expect_lit_like_explicit(t, "next vertex " + label(tracked), state, untracked, drawing);
};

constexpr GLenum kFaces[] = {GL_FRONT, GL_BACK, GL_FRONT_AND_BACK};

// Two-sided lighting of a triangle that is seen from the front and one that is seen from the back.
EVALCTS_TEST(ColorMaterial, Faces, kMust, "EV-CMAT-FACES/1-D", combine(kFaces).by(in_primitives()))
(Test& t, GLenum face) {
  t.require(1, 1);
  const auto& [untracked, state] = lit(GL_EMISSION, face, true);
  gl::Case drawing;
  define(drawing, make_map1(GL_MAP1_VERTEX_3, {-0.75, -0.5, 0, 0.5, -0.75, 0, 0.75, 0.75, 0}));
  define(drawing, make_map1(GL_MAP1_COLOR_4, {0, 1, 0.25, 1, 1, 0.25, 0, 1, 0.5, 0, 1, 1}));
  drawing.Enable(GL_MAP1_VERTEX_3);
  drawing.Enable(GL_MAP1_COLOR_4);
  drawing.Begin(GL_TRIANGLES);
  for (const float u : {0.0f, 0.5f, 1.0f, 1.0f, 0.5f, 0.0f}) drawing.EvalCoord1f(u);
  drawing.End();
  expect_lit_like_explicit(t, "faces " + label(face), state, untracked, drawing);
};

// Without COLOR_MATERIAL, vertices are lit with the material, whatever the colour map.
EVALCTS_TEST(ColorMaterial, NotTracked, kMust, "EV-CMAT-OFF/1-D", by(every_command()))
(Test& t) {
  const auto& [state, tracking] = lit(GL_EMISSION);
  gl::Case drawing;
  define_maps(drawing);
  draw_points(drawing);
  expect_lit_like_explicit(t, "not tracked", state, tracking, drawing);
};

// Without lighting, vertices have the evaluated colour.
EVALCTS_TEST(ColorMaterial, Unlit, kMust, "EV-CMAT-UNLIT/1-D", by(every_command()))
(Test& t) {
  const auto& [untracked, tracked] = lit(GL_EMISSION);
  gl::Case state = tracked;
  state.Disable(GL_LIGHTING);
  gl::Case drawing;
  define_maps(drawing);
  draw_points(drawing);
  expect_lit_like_explicit(t, "unlit", state, tracked, drawing);
};

// Without a vertex map, evaluating a colour map changes neither a material nor the current colour
// (NoVertexMap), and a later vertex is lit with the current colour (NextVertexWithoutVertexMap).
EVALCTS_TEST(ColorMaterial, NoVertexMap, kMust, "EV-CMAT-NOVERTEX/1-D",
             combine(kSomeTracked).by(every_command()))
(Test& t, GLenum tracked) {
  t.require(1, 1);
  gl::Case c("queried before and after");
  light(c);
  track(c, tracked);
  define_maps(c);
  c.Disable(GL_MAP1_VERTEX_3);
  const std::vector<gl::Ref> before = query_materials(c);
  draw_points(c);
  const std::vector<gl::Ref> after = query_materials(c);
  CheckedTrace checked = t.play(c);
  expect_unchanged(checked, before, after);
};

EVALCTS_TEST(ColorMaterial, NextVertexWithoutVertexMap, kMust, "EV-CMAT-NOVERTEX/1-D",
             combine(kSomeTracked).by(every_command()))
(Test& t, GLenum tracked) {
  const Part& control = tracked_vertex(t, tracked);
  gl::Case drawing;
  define_maps(drawing);
  drawing.Disable(GL_MAP1_VERTEX_3);
  draw_points(drawing);
  drawing.append(one_vertex());
  Picture picture =
      feedback(t, "a vertex after evaluations without a vertex map", lit(tracked).second, drawing);
  expect_like_explicit(picture.checked, picture.parts.at(0), control);
};

}  // namespace
}  // namespace evalcts::suite_color_material
