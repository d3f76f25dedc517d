// Pictures of a drawing at the end of the pipeline: in the feedback buffer, and in pixels for stages that
// only pixels show. Evaluated vertices are compared with explicit ones under the same state. If the explicit
// ones do not show the effect that a test is about, the test is not-observable (pipeline).
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/testkit/test.h>

namespace evalcts {

// Window coordinates, colours and texture coordinates of well-conditioned maps of low order: what the
// accuracy rule leaves to an evaluation (1e-5 a step, some ten steps) times the gain of the stages below, at
// most 64. A stage that is left out shows by far more: see require_an_effect().
inline constexpr double kTolerance = 0.02;
inline constexpr double kEffect = 10 * kTolerance;

// Part of what a case does: commands, and a look at what they draw. Scenes of one case follow each other in
// one context (a context costs more than all it draws): the state of one is there in the next.
struct Scene {
  std::string name;
  gl::Case commands;

  Scene(std::string scene_name, gl::Case drawing)
      : name(std::move(scene_name)), commands(std::move(drawing)) {}
  Scene(std::string scene_name, const gl::Case& state, const gl::Case& drawing)
      : name(std::move(scene_name)), commands(state) {
    commands.append(drawing);
  }
};

struct Area {
  int x, y, width = 1, height = 1;
};

// One thing looked at: what a command wrote.
struct Part {
  std::string name;
  gl::Ref shown;
  std::vector<double> values;
  std::size_t scene = 0;
  std::optional<Area> area = {};  // of pixels
};

struct Picture {
  Played played;
  std::vector<Part> parts;

  const std::vector<double>& values() const { return parts.at(0).values; }
};

// The scenes in feedback mode, a part each: tokens, each vertex as (x, y, z, w) of the window, colour and
// texture coordinates. Throws NotObservable where there is more than the buffer holds.
Picture feedback(Test& t, const gl::Identity& identity, const std::vector<Scene>& scenes);
// One drawing under the state.
Picture feedback(Test& t, const gl::Identity& identity, const gl::Case& state, const gl::Case& drawing);

// A primitive of such a picture. A LINE_RESET_TOKEN is a token of its own.
struct FeedbackPrimitive {
  GLenum token;
  std::vector<std::array<double, 12>> vertices;
};
std::vector<FeedbackPrimitive> primitives_of(const Part& feedback);
// Makes every LINE_RESET_TOKEN a LINE_TOKEN: whether a stipple starts anew is for few tests only.
void forget_stipple_starts(Picture& feedback);

// All pictures in pixels have the window of 64x64 pixels; a position (x, y) of the clip volume is at pixel
// 32 + 32 x, 32 + 32 y.
inline constexpr int kSide = 64;
inline float at_pixel(double window) { return static_cast<float>((window - kSide / 2.0) / (kSide / 2.0)); }

// The areas of the frame buffer, a part each, after each scene; before it the frame buffer is cleared to 0
// (its depth to 1). format: GL_RGBA, GL_RED or GL_DEPTH_COMPONENT.
Picture pixels(Test& t, const gl::Identity& identity, const std::vector<Scene>& scenes,
               const std::vector<Area>& areas, GLenum format = GL_RGBA);
// One drawing under the state.
Picture pixels(Test& t, const gl::Identity& identity, const gl::Case& state, const gl::Case& drawing,
               const std::vector<Area>& areas, GLenum format = GL_RGBA);

// If a check on the picture fails after this, the report shows the pixels of the scene beside those of the control, which has
// the same areas. Both pictures have to outlive the checks.
void show_pixels(Picture& picture, const std::vector<Part>& control, std::size_t scene = 0);

bool alike(const std::vector<double>& a, const std::vector<double>& b, double tolerance = kTolerance);

// The explicit commands have to show the stage, or nothing can be said of it. Throws NotObservable.
void require_an_effect(const std::vector<double>& with, const std::vector<double>& without);
void require_an_effect(const Picture& with, const Picture& without);

// The part is like that of the control.
void expect_like_explicit(Played& played, const Part& seen, const Part& control);
// All of its parts are.
void expect_like_explicit(Picture picture, const Picture& control);

// The picture of explicit vertices is the same in all deliveries of a test: drawn once in a process, under
// this name.
const Part& drawn_once(const std::string& name, const std::function<Part()>& draw);

// A complete texture: some implementations skip texture coordinates and their generation without one.
void set_up_texture(gl::Case& c);

}  // namespace evalcts
