// Section 7 of the requirements, the pipeline after evaluation: evaluated vertices go through it like
// explicit ones, whatever the state and the commands between them. The tests draw both under the same state;
// they may differ by the error that the accuracy rule allows to evaluation.

#include <evalcts/judge/prediction.h>
#include <evalcts/testkit/registration.h>
#include "stages.h"

namespace evalcts::suite_pipeline {
namespace {

Picture draw(Test& t, const gl::Identity& identity, const gl::Case& state, const gl::Case& drawing) {
  Picture picture = feedback(t, identity, state, drawing);
  forget_stipple_starts(picture);
  return picture;
}

void expect_like_explicit(Test& t, const gl::Identity& identity, const gl::Case& state,
                          const gl::Case& evaluated, const Part& control) {
  Picture picture = draw(t, identity, state, evaluated);
  evalcts::expect_like_explicit(picture.checked, picture.parts.at(0), control);
}

// --- Stages ----------------------------------------------------------------------------------------------

const std::vector<float> kRotation = {0.48f, 0.36f, 0.0f, 0.0f, -0.36f, 0.48f, 0.0f,  0.0f,
                                      0.0f,  0.0f,  0.5f, 0.0f, 0.1f,   -0.2f, 0.15f, 1.0f};
const std::vector<float> kPerspective = {0.8f, 0.0f, 0.0f, 0.0f,  0.0f, 0.7f, 0.0f, 0.0f,
                                         0.0f, 0.0f, 0.5f, 0.25f, 0.0f, 0.0f, 0.1f, 1.0f};

void light(gl::Case& c) { enable_light(c, {0.3f, 0.4f, 1.0f, 0.0f}); }

// A stage, and the primitive in which it shows. In pixels: one vertex in the middle of the window, for stages
// that feedback does not show.
struct StageOfPrimitive {
  const char* name;
  GLenum primitive;
  bool in_pixels;
  void (*set)(gl::Case&);
};
constexpr StageOfPrimitive kStages[] = {
    {"MODEL_VIEW", GL_POINTS, false, [](gl::Case& c) { c.LoadMatrixf(kRotation); }},
    {"PROJECTION", GL_POINTS, false,
     [](gl::Case& c) {
       c.MatrixMode(GL_PROJECTION);
       c.LoadMatrixf(kPerspective);
     }},
    {"TEXTURE_MATRIX", GL_POINTS, false,
     [](gl::Case& c) {
       c.MatrixMode(GL_TEXTURE);
       c.LoadMatrixf(kRotation);
     }},
    {"TEXTURE_GENERATION", GL_POINTS, false,
     [](gl::Case& c) {
       c.TexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
       c.TexGenfv(GL_S, GL_OBJECT_PLANE, std::vector<float>{2, 1, -1, 0.5f});
       c.Enable(GL_TEXTURE_GEN_S);
       c.TexGeni(GL_T, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP);
       c.Enable(GL_TEXTURE_GEN_T);
     }},
    {"LIGHTING", GL_POINTS, false, light},
    {"FOG", GL_POINTS, true,
     [](gl::Case& c) {
       c.Enable(GL_FOG);
       c.Fogi(GL_FOG_MODE, GL_LINEAR);
       c.Fogf(GL_FOG_START, -2.0f);
       c.Fogf(GL_FOG_END, 2.0f);
       c.Fogfv(GL_FOG_COLOR, std::vector<float>{0, 1, 1, 0});
     }},
    {"CLIPPING", GL_LINE_STRIP, false,
     [](gl::Case& c) {
       c.LoadMatrixf(std::vector<float>{3, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
     }},
    {"CLIP_PLANE", GL_LINE_STRIP, false, [](gl::Case& c) {
       c.ClipPlane(GL_CLIP_PLANE0, std::vector<double>{1, 0.25, 0, 0.0625});
       c.Enable(GL_CLIP_PLANE0);
     }}};

// Defines and enables maps of position, colour, normal and texture coordinates, well inside the view volume.
void define_maps(gl::Case& c) {
  define(c, make_map1(GL_MAP1_VERTEX_4, {-0.5, -0.25, -0.5, 1, 0.25, 0.875, 0.25, 1.25, 0.75, -0.5, 0.5, 1}));
  define(c, make_map1(GL_MAP1_COLOR_4, {0.125, 0.875, 0.25, 1, 0.75, 0.25, 1, 0.5}));
  define(c, make_map1(GL_MAP1_NORMAL, {0.6, 0, 0.8, -0.28, 0.96, 0}));
  define(c, make_map1(GL_MAP1_TEXTURE_COORD_4, {0, 1, 0.5, 1, 1, 0.25, -0.5, 2}));
  for (const GLenum target : {GL_MAP1_VERTEX_4, GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_4})
    c.Enable(target);
}

EVALCTS_TEST(Pipeline, Stage, kMust, "EV-COORD-TRANSFORM/1-D", combine(kStages).by(without_lists()))
(Test& t, const StageOfPrimitive& stage) {
  gl::Case plain, evaluated;
  if (stage.in_pixels) {
    // A texture would hide the colour.
    plain.PointSize(16.0f);
    define_and_enable(evaluated, make_map1(GL_MAP1_VERTEX_3, {-0.5, -0.5, 0.5, 0.5, 0.5, 0.5}));
    define_and_enable(evaluated, make_map1(GL_MAP1_COLOR_4, {1, 0.5, 0, 1, 1, 0, 0.5, 1}));
  } else {
    set_up_texture(plain);
    define_maps(evaluated);
  }
  evaluated.Begin(stage.primitive);
  for (int i = 0; i <= 8; ++i)
    if (!stage.in_pixels || i == 4) evaluated.EvalCoord1f(static_cast<float>(i) / 8);
  evaluated.End();
  std::vector<Stage> stages = {{"without the stage", plain}, {stage.name, plain}};
  stage.set(stages.back().state);
  View view;
  if (stage.in_pixels) view.areas = {{kSide / 2, kSide / 2}};
  expect_stages(t, stages, {drawing(t, "EvalCoord1f", false, stage.primitive, evaluated)}, view);
};

// A command that is legal between Begin and End and changes the vertices after it.
struct Between {
  const char* name;
  bool lit;
  void (*command)(gl::Case&);
};
constexpr GLuint kList = 7;
constexpr Between kBetween[] = {
    {"MATERIAL", true,
     [](gl::Case& c) {
       c.Materialfv(GL_FRONT_AND_BACK, GL_EMISSION, std::vector<float>{0.9f, 0, 0.4f, 1});
     }},
    {"NORMAL", true, [](gl::Case& c) { c.Normal3f(0.9f, 0.1f, -0.4f); }},
    {"COLOR", false, [](gl::Case& c) { c.Color4f(0.1f, 0.9f, 0.3f, 0.25f); }},
    {"TEX_COORD", false, [](gl::Case& c) { c.TexCoord4f(3, 2, -1, 1); }},
    {"INDEX_AND_EDGE_FLAG", false,
     [](gl::Case& c) {
       c.Indexf(5.0f);
       c.EdgeFlag(GL_FALSE);
       c.Color4f(0.75f, 0.5f, 0.25f, 0.5f);
     }},
    {"CALL_LIST", false, [](gl::Case& c) { c.CallList(kList); }}};

EVALCTS_TEST(Pipeline, BetweenEvaluations, kMust, "EV-COORD-MATERIAL/1-D",
             combine(kBetween).by(without_lists()))
(Test& t, const Between& between) {
  gl::Case state;
  set_up_texture(state);
  if (between.lit) light(state);
  state.NewList(kList, GL_COMPILE);
  state.Color4f(0.9f, 0.2f, 0.6f, 1.0f);
  state.TexCoord2f(4, -2);
  state.EndList();

  gl::Case map;
  define_and_enable(map, make_map1(GL_MAP1_VERTEX_3, {-0.5, -0.25, -0.5, 0.25, 0.75, 0.25, 0.75, -0.5, 0.5}));
  const float us[] = {0.0f, 0.25f, 0.75f, 1.0f};
  gl::Case positions = map;
  positions.Begin(GL_POINTS);
  for (const float u : us) positions.EvalCoord1f(u);
  positions.End();
  const Prediction prediction = predict(positions, t.max_order());

  const auto add_points = [&](gl::Case& c, bool evaluated, bool with_command) {
    c.Begin(GL_POINTS);
    for (std::size_t i = 0; i < std::size(us); ++i) {
      if (i == 2 && with_command) between.command(c);
      if (evaluated) {
        c.EvalCoord1f(us[i]);
      } else {
        const auto& position = prediction.primitives.at(0).vertices.at(i).position;
        c.Vertex3f(reference::rounded(position[0]), reference::rounded(position[1]),
                   reference::rounded(position[2]));
      }
    }
    c.End();
  };
  // Draws the points without the command, then with it, each in one half of the feedback.
  const auto draw_both = [&](bool evaluated) {
    gl::Case c = map;
    for (const bool with_command : {false, true}) add_points(c, evaluated, with_command);
    return c;
  };
  const Part& control = drawn_once(std::string("between ") + between.name, [&] {
    const Picture picture = draw(t, gl::control("explicit vertices"), state, draw_both(false));
    const std::vector<double>& values = picture.values();
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    require_an_effect(std::vector<double>(half, values.end()), std::vector<double>(values.begin(), half));
    return picture.parts.at(0);
  });
  expect_like_explicit(t, "evaluated", state, draw_both(true), control);
};

// There is no map of edge flags: evaluated vertices have the current edge flag.
EVALCTS_TEST(Pipeline, CurrentEdgeFlag, kMust, "EV-ATTR-NOMAPS/1-D",
             by(gl::without(gl::kMeshes, without_lists())))
(Test& t) {
  gl::Case state;
  state.PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  const auto flag = [](std::size_t vertex) { return static_cast<GLboolean>(vertex % 3 != 1); };

  gl::Case evaluated;
  define_and_enable(evaluated, make_map1(GL_MAP1_VERTEX_3, {-0.5, -0.5, 0, 0.75, -0.25, 0, 0.5, 0.75, 0}));
  evaluated.Begin(GL_TRIANGLES);
  for (std::size_t i = 0; i < 6; ++i) {
    evaluated.EdgeFlag(flag(i));
    evaluated.EvalCoord1f(static_cast<float>(i % 3) / 2);
  }
  evaluated.End();
  const Prediction prediction = predict(evaluated, t.max_order());
  gl::Case flags = as_explicit_commands(prediction);
  gl::Case all_edges = without_edge_flags(flags);

  const Picture control = draw(t, gl::control("explicit vertices"), state, flags);
  require_an_effect(control, draw(t, gl::control("all edges"), state, all_edges));
  // Mesa's flags of explicit vertices are undefined in feedback, and rarely show.
  const Picture again = draw(t, gl::control("explicit vertices again"), state, flags);
  if (!alike(again.values(), control.values(), 0))
    throw NotObservable("pipeline: explicit vertices have other edges when they are drawn again");
  expect_like_explicit(t, "evaluated", state, evaluated, control.parts.at(0));
};

// Evaluation takes attributes without a map from the current values, even if client arrays are enabled.
EVALCTS_TEST(Pipeline, ArraysHaveNoInfluence, kMust, "EV-COORD-NOARRAYS/1-D", by(without_lists()))
(Test& t) {
  gl::Case c("vertex, colour, normal and texture coordinate arrays enabled");
  const std::vector<float> wrong(64, 0.625f);
  c.VertexPointer(4, GL_FLOAT, 0, wrong);
  c.ColorPointer(4, GL_FLOAT, 0, wrong);
  c.NormalPointer(GL_FLOAT, 0, wrong);
  c.TexCoordPointer(4, GL_FLOAT, 0, wrong);
  for (const GLenum array : {GL_VERTEX_ARRAY, GL_COLOR_ARRAY, GL_NORMAL_ARRAY, GL_TEXTURE_COORD_ARRAY})
    c.EnableClientState(array);
  set_current_values(c);
  define_and_enable(c, random_map(t, GL_MAP1_VERTEX_3, 4));
  evaluate_some(c);
  for (const GLenum target : {GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_2})
    define_and_enable(c, random_map(t, target, 3));
  evaluate_some(c);
  t.judge_vertices(c, kUnit0);
};

}  // namespace
}  // namespace evalcts::suite_pipeline
