// Pictures of a drawing at the end of the pipeline: the contents of the feedback buffer, or pixels for stages
// that feedback does not show. Tests compare the picture of evaluated vertices with that of explicit vertices
// under the same state. If the explicit ones do not show the effect that a test is about, the test is
// not-observable (pipeline).
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/testkit/test.h>

namespace evalcts {

// Largest difference of window coordinates, colours and texture coordinates from those of explicit vertices,
// relative to values above 1: the error that an evaluation of a well-conditioned map of low order may have
// (1e-5 for each of some ten operations) times the gain of the stages after it, at most 64. The effect of a
// stage is at least ten times as large, see require_an_effect().
inline constexpr double kTolerance = 0.02;
inline constexpr double kEffect = 10 * kTolerance;

// Commands whose drawing is one part of a picture, or one for each area. The scenes of a picture run one
// after the other in one context, because making a context is expensive: a scene begins with the state in
// which the previous one ended.
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

// The values that one command of a scene wrote.
struct Part {
  std::string name;
  gl::Ref shown;
  std::vector<double> values;
  std::size_t scene = 0;
  std::optional<Area> area = {};  // the pixels that the command read
};

struct Picture {
  CheckedTrace checked;
  std::vector<Part> parts;

  const std::vector<double>& values() const { return parts.at(0).values; }
};

// Draws the scenes in feedback mode with type 4D_COLOR_TEXTURE; each scene is a part, which holds the
// contents of the feedback buffer. Throws NotObservable if a buffer overflows.
Picture feedback(Test& t, const gl::Identity& identity, const std::vector<Scene>& scenes);
// The same for one drawing under the state.
Picture feedback(Test& t, const gl::Identity& identity, const gl::Case& state, const gl::Case& drawing);

// A primitive in the feedback buffer. Each vertex is (x, y, z, w) in window coordinates, RGBA, (s, t, r, q).
// The token distinguishes LINE_RESET_TOKEN and LINE_TOKEN.
struct FeedbackPrimitive {
  GLenum token;
  std::vector<std::array<double, 12>> vertices;
};
std::vector<FeedbackPrimitive> primitives_of(const Part& feedback);
// Replaces each LINE_RESET_TOKEN by a LINE_TOKEN, for tests that are not about restarts of the stipple.
void forget_stipple_starts(Picture& feedback);

// Width and height of pictures in pixels: the position (x, y) in normalized device coordinates lies at
// (32 + 32 x, 32 + 32 y) in the window. at_pixel() returns the x or y of a window coordinate.
inline constexpr int kSide = 64;
inline float at_pixel(double window) { return static_cast<float>((window - kSide / 2.0) / (kSide / 2.0)); }

// Clears colours to 0 and depths to 1, draws a scene and reads the areas of the framebuffer, for each scene.
// The parts are the areas of the first scene, then those of the second one, and so on. format: GL_RGBA,
// GL_RED or GL_DEPTH_COMPONENT.
Picture pixels(Test& t, const gl::Identity& identity, const std::vector<Scene>& scenes,
               const std::vector<Area>& areas, GLenum format = GL_RGBA);
// The same for one drawing under the state.
Picture pixels(Test& t, const gl::Identity& identity, const gl::Case& state, const gl::Case& drawing,
               const std::vector<Area>& areas, GLenum format = GL_RGBA);

// If a check on the picture fails after this call, the report shows the pixels of the scene next to those of
// the control, which has the same areas. Both arguments must outlive the checks.
void show_pixels(Picture& picture, const std::vector<Part>& control, std::size_t scene = 0);

bool alike(const std::vector<double>& a, const std::vector<double>& b, double tolerance = kTolerance);

// Throws NotObservable if the pictures of explicit vertices with and without a stage are alike, or `with` is
// empty: then the stage cannot be tested.
void require_an_effect(const std::vector<double>& with, const std::vector<double>& without);
void require_an_effect(const Picture& with, const Picture& without);

// Expects the part to be alike to that of the control.
void expect_like_explicit(CheckedTrace& checked, const Part& seen, const Part& control);
// The same for all parts.
void expect_like_explicit(Picture picture, const Picture& control);

// Returns the part that `draw` returned at the first call with this name in this process: the control of
// explicit vertices is the same for all deliveries of a test.
const Part& drawn_once(const std::string& name, const std::function<Part()>& draw);

// Binds and enables a complete white texture, because some implementations skip texture coordinates and their
// generation without one.
void set_up_texture(gl::Case& c);

}  // namespace evalcts
