// Section 10 of the requirements, the pipeline after evaluation: generated normals are transformed, rescaled
// and lit like those of Normal3, and reach a vertex program without being normalised.
#include <fmt/format.h>

#include <evalcts/judge/prediction.h>
#include <evalcts/testkit/registration.h>
#include "drawings.h"
#include "programs.h"

namespace evalcts::suite_normals_pipeline {
namespace {

const std::vector<float> kTwice = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};
// Scales by two and rotates about the axis (1,1,1).
const std::vector<float> kTurnedTwice = {0, 2, 0, 0, 0, 0, 2, 0, 2, 0, 0, 0, 0, 0, 0, 1};
// A shear with unequal scales, which transforms normals differently from tangents.
const std::vector<float> kSheared = {1, 0, 0, 0, 0.75f, 2, 0, 0, -0.5f, 0, 0.5f, 0, 0, 0, 0, 1};

// Returns a bicubic patch, curved in both directions, whose control points lie within [-0.25,0.31], scaled by
// `size`.
Map patch(double size) {
  std::vector<double> points;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (const double value : {(i - 1.5) / 6 + 0.02 * j, (j - 1.5) / 6, 0.12 * ((i * j) % 3) - 0.05 * i})
        points.push_back(size * value);
  return make_map2(GL_MAP2_VERTEX_3, 4, 4, points);
}

gl::Case points_of(const Map& map, bool automatic = true) {
  gl::Case c;
  define(c, map);
  c.Enable(map.target);
  if (automatic) c.Enable(GL_AUTO_NORMAL);
  c.Begin(GL_POINTS);
  for (const float u : {0.0f, 0.25f, 0.625f, 1.0f})
    for (const float v : {0.125f, 0.5f, 1.0f}) c.EvalCoord2f(u, v);
  c.End();
  return c;
}

// Makes texture coordinates of the normals in eye space.
void show_normals(gl::Case& c) {
  set_up_texture(c);
  for (const auto& [coordinate, enable] :
       {std::pair{GL_S, GL_TEXTURE_GEN_S}, {GL_T, GL_TEXTURE_GEN_T}, {GL_R, GL_TEXTURE_GEN_R}}) {
    c.TexGeni(coordinate, GL_TEXTURE_GEN_MODE, GL_NORMAL_MAP);
    c.Enable(enable);
  }
}

const std::vector<float> kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

struct Stage {
  const char* name;
  GLenum capability;  // the stage's capability, or 0: the stage is the matrix
  std::vector<std::vector<float>> matrices;
};
const Stage kStages[] = {{"MODEL_VIEW", 0, {kTwice, kSheared}},
                         {"NORMALIZE", GL_NORMALIZE, {kTurnedTwice, kSheared}},
                         {"RESCALE", GL_RESCALE_NORMAL, {kTurnedTwice}}};

EVALCTS_TEST(AutomaticNormals, Transformed, kMust, "EV-AUTON-FFTRANSFORM", combine(kStages))
(Test& t, const Stage& stage) {
  t.require(1, 3);
  const gl::Case evaluated = points_of(patch(1));
  const auto add = [&](std::vector<Scene>& to, bool staged, const gl::Case& drawing) {
    for (const std::vector<float>& matrix : stage.matrices) {
      gl::Case state;
      state.LoadMatrixf(staged || stage.capability ? matrix : kIdentity);
      if (staged && stage.capability) state.Enable(stage.capability);
      show_normals(state);
      to.emplace_back(matrix == kSheared ? "sheared" : "twice as large", state, drawing);
    }
  };
  const gl::Case explicit_points = explicit_commands(t, evaluated);
  std::vector<Scene> controls, evaluations;
  add(controls, false, explicit_points);
  add(controls, true, explicit_points);
  add(evaluations, true, evaluated);
  Picture control = feedback(t, gl::control("explicit vertices"), controls);
  const std::size_t count = stage.matrices.size();
  for (std::size_t i = 0; i < count; ++i)
    require_an_effect(control.parts[count + i].values, control.parts[i].values);
  control.parts.erase(control.parts.begin(), control.parts.begin() + static_cast<std::ptrdiff_t>(count));
  expect_like_explicit(feedback(t, "evaluated", evaluations), control);
};

// Without NORMALIZE, the patch is lit with unit normals whatever its size.
EVALCTS_TEST(AutomaticNormals, LitAsUnits, kMust, "EV-AUTON-UNIT")
(Test& t) {
  gl::Case state;
  enable_light(state, {0.36f, 0.48f, 0.8f, 0});
  // So small that nothing is clipped.
  state.MatrixMode(GL_PROJECTION);
  state.LoadMatrixf(std::vector<float>{1e-3f, 0, 0, 0, 0, 1e-3f, 0, 0, 0, 0, 1e-3f, 0, 0, 0, 0, 1});
  std::vector<Scene> evaluated, controls;
  for (const double size : {0.01, 1.0, 1000.0}) {
    const gl::Case drawing = points_of(patch(size));
    const std::string name = fmt::format("a patch of size {}", size / 2);
    evaluated.emplace_back(name, state, drawing);
    controls.emplace_back(name, state, explicit_commands(t, drawing));
  }
  controls.emplace_back("shorter normals", gl::Case());
  for (gl::Command command : controls.front().commands.commands()) {
    if (command.entry == gl::EntryPoint::Normal3f)
      for (gl::Value& value : command.arguments) value = std::get<float>(value) / 2;
    controls.back().commands.add(command);
  }
  const Picture control = feedback(t, gl::control("explicit vertices"), controls);
  require_an_effect(control.parts.front().values, control.parts.back().values);
  expect_like_explicit(feedback(t, "evaluated", evaluated), control);
};

// AUTO_NORMAL is disabled in a fresh context, so that all vertices are lit with the current normal.
EVALCTS_TEST(AutomaticNormals, InitiallyOff, kMust, "EV-INIT-AUTON-OFF")
(Test& t) {
  gl::Case state;
  enable_light(state, {0.36f, 0.48f, 0.8f, 0});
  gl::Case evaluated;
  evaluated.Normal3f(0.8f, -0.36f, 0.48f);
  evaluated.append(points_of(patch(1), false));
  gl::Case automatic;
  automatic.Enable(GL_AUTO_NORMAL);
  automatic.append(evaluated);
  const Picture control = feedback(t, gl::control("explicit vertices"),
                                   {{"the current normal", state, explicit_commands(t, evaluated)},
                                    {"generated normals", state, explicit_commands(t, automatic)}});
  require_an_effect(control.parts[0].values, control.parts[1].values);
  expect_like_explicit(feedback(t, "evaluated", state, evaluated), control);
};

// A vertex program that passes on the normal as texture coordinates, and the colour; positions are those of
// the fixed-function pipeline.
constexpr char kNormalProgram[] =
    "!!ARBvp1.0\n"
    "OPTION ARB_position_invariant;\n"
    "MOV result.color, vertex.color;\n"
    "MOV result.texcoord[0], vertex.normal;\n"
    "END\n";

// A plane over the unit domain with the constant derivatives du and dv.
struct Plane {
  const char* name;
  std::array<double, 3> du, dv;
  int uorder, vorder;
};
constexpr Plane kPlanes[] = {{"10 by 10", {10, 0, 0}, {0, 10, 0}, 2, 2},
                             {"a quarter by a quarter", {0.25, 0, 0}, {0, 0.25, 0}, 2, 2},
                             {"tilted, order 4 by 3", {6, 3, -1.5}, {-1, 4, 2}, 4, 3}};

// The normal is du x dv, not normalised.
EVALCTS_TEST(AutomaticNormals, NotNormalisedForVertexProgram, kMust, "EV-AUTON-VP")
(Test& t) {
  require_extension(t, "GL_ARB_vertex_program");
  gl::Case state;
  set_up_texture(state);
  state.MatrixMode(GL_PROJECTION);
  state.LoadMatrixf(std::vector<float>{0.0625f, 0, 0, 0, 0, 0.0625f, 0, 0, 0, 0, 0.0625f, 0, 0, 0, 0, 1});
  load_assembly(state, GL_VERTEX_PROGRAM_ARB, 1, kNormalProgram);
  state.Enable(GL_VERTEX_PROGRAM_ARB);
  std::vector<Scene> evaluated, with_normals;
  std::vector<std::vector<double>> normals;
  for (const Plane& plane : kPlanes) {
    std::vector<double> points, normal;
    for (int i = 0; i < plane.uorder; ++i)
      for (int j = 0; j < plane.vorder; ++j)
        for (std::size_t k = 0; k < 3; ++k)
          points.push_back(plane.du[k] * i / (plane.uorder - 1) + plane.dv[k] * j / (plane.vorder - 1));
    for (std::size_t k = 0; k < 3; ++k)
      normal.push_back(plane.du[(k + 1) % 3] * plane.dv[(k + 2) % 3] -
                       plane.du[(k + 2) % 3] * plane.dv[(k + 1) % 3]);
    normals.push_back(normal);
    const gl::Case drawing = points_of(make_map2(GL_MAP2_VERTEX_3, plane.uorder, plane.vorder, points));
    evaluated.emplace_back(plane.name, state, drawing);
    // explicit_commands() has normals of unit length, so they are replaced.
    const gl::Case units = explicit_commands(t, drawing);
    with_normals.emplace_back(plane.name, state);
    for (const gl::Command& command : units.commands()) {
      if (command.entry == gl::EntryPoint::Normal3f) {
        with_normals.back().commands.Normal3f(normal[0], normal[1], normal[2]);
      } else {
        with_normals.back().commands.add(command);
      }
    }
  }
  const Picture control = feedback(t, gl::control("explicit vertices"), with_normals);
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (const FeedbackPrimitive& point : primitives_of(control.parts[i]))
      if (!alike(std::vector<double>(&point.vertices[0][8], &point.vertices[0][11]), normals[i]))
        throw NotObservable("pipeline: the program does not see explicit normals as they are");
  expect_like_explicit(feedback(t, "evaluated", evaluated), control);
};

}  // namespace
}  // namespace evalcts::suite_normals_pipeline
