// Section 24 of the requirements: NV_vertex_program and the maps of its 16 vertex attributes. The executable
// specification does not have them, so that these tests state what they expect.
#include <fmt/format.h>

#include <evalcts/testkit/registration.h>

#include "grid_cases.h"
#include "pictures.h"

namespace evalcts::suite_nv_vertex_program {
namespace {

constexpr GLenum kAttributeMaps1 = 0x8660, kAttributeMaps2 = 0x8670;  // the first of 16 targets each

void require_nv(Test& t) { require_extension(t, "GL_NV_vertex_program"); }

// Returns the targets of both dimensions, without 0x8677 if ARB_vertex_program uses it for
// PROGRAM_BINDING_ARB.
std::vector<GLenum> attribute_maps(Test& t) {
  std::vector<GLenum> all;
  for (GLenum i = 0; i < 16; ++i) all.push_back(kAttributeMaps1 + i);
  for (GLenum i = 0; i < 16; ++i)
    if (kAttributeMaps2 + i != 0x8677 || !t.gl().extensions.contains("GL_ARB_vertex_program"))
      all.push_back(kAttributeMaps2 + i);
  return all;
}

bool is_curve(GLenum target) { return target < kAttributeMaps2; }

std::vector<GLint> orders_of(GLenum target, GLint order) {
  return std::vector<GLint>(is_curve(target) ? 1 : 2, order);
}

// Defines a map of order 2, or 2 by 2. `stride`: distance of points in v, or in u of a curve.
void define_attribute_map(gl::Case& c, GLenum target, GLint stride, const std::vector<float>& points) {
  is_curve(target) ? c.Map1f(target, 0.0f, 1.0f, stride, 2, points)
                   : c.Map2f(target, 0.0f, 1.0f, 2 * stride, 2, 0.0f, 1.0f, stride, 2, points);
}

EVALCTS_TEST(NvVertexProgram, Tokens, kMust, "EV-EXT-NVVP-TOKENS")
(Test& t) {
  require_nv(t);
  for (const GLenum target : attribute_maps(t)) {
    gl::Case c(fmt::format("map 0x{:04X}", target));
    const std::vector<float> points = converted<float>(random_values(t.random(), is_curve(target) ? 8 : 16));
    define_attribute_map(c, target, 4, points);
    const gl::Ref coefficients = c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(points.size() + 4));
    const gl::Ref orders = c.GetMapiv(target, GL_ORDER, gl::out<GLint>(2));
    c.Enable(target);
    const gl::Ref on = c.IsEnabled(target), on_as_integer = c.GetIntegerv(target, gl::out<GLint>(2));
    c.Disable(target);
    const gl::Ref off = c.IsEnabled(target), error = c.GetError();
    CheckedTrace checked = t.play(c);
    checked.expect_values(coefficients, points);
    checked.expect_values(orders, orders_of(target, 2));
    checked.expect_result(on, GL_TRUE);
    checked.expect_values(on_as_integer, std::vector<GLint>{GL_TRUE});
    checked.expect_result(off, GL_FALSE);
    checked.expect_no_error(error);
  }
};

EVALCTS_TEST(NvVertexProgram, FourComponents, kMust, "EV-EXT-NVVP-K")
(Test& t) {
  require_nv(t);
  gl::Case c("stride 3");
  std::vector<gl::Ref> errors, before, after;
  for (const GLenum target : attribute_maps(t)) {
    const auto ask = [&] { return c.GetMapiv(target, GL_ORDER, gl::out<GLint>(2)); };
    before.push_back(ask());
    define_attribute_map(c, target, 3, std::vector<float>(32, 1));
    errors.push_back(c.GetError());
    after.push_back(ask());
  }
  CheckedTrace checked = t.play(c);
  for (const gl::Ref error : errors) checked.expect_error(error, {GL_INVALID_VALUE});
  expect_unchanged(checked, before, after);
};

EVALCTS_TEST(NvVertexProgram, Initial, kMust, "EV-EXT-NVVP-INIT")
(Test& t) {
  require_nv(t);
  for (const GLenum target : attribute_maps(t)) {
    gl::Case c(fmt::format("map 0x{:04X}", target));
    const gl::Ref enabled = c.IsEnabled(target), orders = c.GetMapiv(target, GL_ORDER, gl::out<GLint>(3)),
                  coefficients = c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(8));
    CheckedTrace checked = t.play(c);
    checked.expect_result(enabled, GL_FALSE);
    checked.expect_values(orders, orders_of(target, 1));
    checked.expect_values(coefficients, std::vector<GLfloat>{0, 0, 0, 1});
  }
};

EVALCTS_TEST(NvVertexProgram, AttributeStack, kMust, "EV-EXT-NVVP-STACK")
(Test& t) {
  require_nv(t);
  for (const GLbitfield bit : {GL_ENABLE_BIT, GL_EVAL_BIT}) {
    gl::Case c(bit == GL_ENABLE_BIT ? "ENABLE_BIT" : "EVAL_BIT");
    const std::vector<GLenum> maps = attribute_maps(t);
    const auto set = [&](bool even) {
      for (std::size_t i = 0; i < maps.size(); ++i)
        (i % 2 == 0) == even ? c.Enable(maps[i]) : c.Disable(maps[i]);
    };
    set(true);
    c.PushAttrib(bit);
    set(false);
    c.PopAttrib();
    std::vector<gl::Ref> enables;
    for (const GLenum map : maps) enables.push_back(c.IsEnabled(map));
    CheckedTrace checked = t.play(c);
    for (std::size_t i = 0; i < maps.size(); ++i) checked.expect_result(enables[i], i % 2 == 0);
  }
};

// --- Programs that output an attribute as the colour -------------------------------------------------------

// Numbers of attributes that alias conventional ones (table X.1 of the extension).
constexpr GLenum kPositionAttribute = 0, kColorAttribute = 3;

using Color = std::array<double, 4>;

// Loads and enables a program that passes on the position and outputs `color`, the name of an input register.
void use_nv_program(gl::Case& c, const std::string& color) {
  const std::string text = "!!VP1.0\nMOV o[HPOS], v[OPOS];\nMOV o[COL0], " + color + ";\nEND";
  c.LoadProgramNV(GL_VERTEX_PROGRAM_NV, 1, static_cast<GLsizei>(text.size()), gl::text(text));
  c.BindProgramNV(GL_VERTEX_PROGRAM_NV, 1);
  c.Enable(GL_VERTEX_PROGRAM_NV);
}

GLenum attribute_map(const Dimension& dimension, GLenum attribute) {
  return (dimension.two ? kAttributeMaps2 : kAttributeMaps1) + attribute;
}
// Defines and enables a map of order 2 in u, constant in v, with the first `components` components of both
// values.
void define_ramp(gl::Case& c, const Dimension& dimension, GLenum target, const Color& from, const Color& to,
                 int components = 4) {
  std::vector<float> points;
  for (const Color* end : {&from, &to})
    for (int i = 0; i < components; ++i)
      points.push_back(static_cast<float>((*end)[static_cast<std::size_t>(i)]));
  dimension.two ? c.Map2f(target, 0.0f, 1.0f, components, 2, 0.0f, 1.0f, components, 1, points)
                : c.Map1f(target, 0.0f, 1.0f, components, 2, points);
  c.Enable(target);
}

constexpr Color kFromPosition{-0.5, -0.25, 0, 1}, kToPosition{0.75, 0.5, 0, 1};
constexpr Color kFromColor{0.125, 0.875, 0.25, 1}, kToColor{0.75, 0.25, 1, 0.5};
constexpr Color kFromOther{1, 0, 0.5, 0.25}, kToOther{0, 1, 0.25, 0.75};
constexpr Color kCurrent{0.0625, 0.5, 0.9375, 0.375};
constexpr double kAt[] = {0, 0.25, 0.75, 1};

void set_current_color(gl::Case& c) {
  c.Color4f(static_cast<float>(kCurrent[0]), static_cast<float>(kCurrent[1]), static_cast<float>(kCurrent[2]),
            static_cast<float>(kCurrent[3]));
}

// Draws four evaluated points.
void draw(gl::Case& c, const Dimension& dimension) {
  c.Begin(GL_POINTS);
  for (const double u : kAt) eval_coord(c, dimension.two, u, 0.5);
  c.End();
}

// Returns a description of the first wrong point of a part, or an empty string if the `count` points have the
// colours and positions that these functions of u return.
std::string wrong_points(const Part& part, std::size_t count, const std::function<Color(double)>& color,
                         const std::function<Color(double)>& position) {
  const std::vector<FeedbackPrimitive> points = primitives_of(part);
  if (points.size() != count) return fmt::format("{} points instead of {}", points.size(), count);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& values = points[i].vertices.at(0);
    for (std::size_t k = 0; k < 4; ++k)
      if (std::abs(values[4 + k] - color(kAt[i])[k]) > kTolerance)
        return fmt::format("component {} of the colour at u = {} is {}, not {}", k, kAt[i], values[4 + k],
                           color(kAt[i])[k]);
    for (std::size_t k = 0; k < 2; ++k)
      if (const double pixel = 32 + 32 * position(kAt[i])[k]; std::abs(values[k] - pixel) > 1)
        return fmt::format("component {} of the position at u = {} is {}, not {}", k, kAt[i], values[k],
                           pixel);
  }
  return {};
}

std::function<Color(double)> ramp(const Color& from, const Color& to) {
  return [=](double u) {
    Color c;
    for (std::size_t k = 0; k < 4; ++k) c[k] = from[k] + u * (to[k] - from[k]);
    return c;
  };
}
const auto kPositionAt = ramp(kFromPosition, kToPosition);

// Throws NotObservable unless a program that outputs `color_source` gives explicit vertices the colour
// `shown` after `set_source`.
void require_programs(Test& t, const std::string& color_source,
                      const std::function<void(gl::Case&)>& set_source, const Color& shown) {
  gl::Case state, drawing;
  use_nv_program(state, color_source);
  drawing.Begin(GL_POINTS);
  for (const double u : kAt) {
    set_source(drawing);
    const Color p = kPositionAt(u);
    drawing.Vertex4f(static_cast<float>(p[0]), static_cast<float>(p[1]), 0, 1);
  }
  drawing.End();
  const Picture control = feedback(t, gl::control("explicit vertices"), state, drawing);
  const std::string why = wrong_points(
      control.parts.at(0), std::size(kAt), [&](double) { return shown; }, kPositionAt);
  if (!why.empty()) throw NotObservable("pipeline: with explicit vertices " + why);
}

void expect_points(Test& t, const gl::Identity& identity, const gl::Case& state, const gl::Case& drawing,
                   std::size_t count, const std::function<Color(double)>& color) {
  Picture picture = feedback(t, identity, state, drawing);
  const std::string why = wrong_points(picture.parts.at(0), count, color, kPositionAt);
  picture.checked.expect(why.empty(), picture.parts.at(0).shown, why, "what the maps of attributes say", why);
}

EVALCTS_TEST(NvVertexProgram, IgnoredWithoutProgram, kMust, "EV-EXT-NVVP-MODE", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  require_nv(t);
  const GLenum vertex = target_in(dimension.two, GL_MAP1_VERTEX_4);
  gl::Case drawing;
  set_current_color(drawing);
  define_ramp(drawing, dimension, attribute_map(dimension, kColorAttribute), kFromOther, kToOther);
  define_ramp(drawing, dimension, vertex, kFromPosition, kToPosition);
  draw(drawing, dimension);
  expect_points(t, "a map of attribute 3, no program", {}, drawing, std::size(kAt), ramp(kCurrent, kCurrent));

  gl::Case no_vertices;
  define_ramp(no_vertices, dimension, attribute_map(dimension, kPositionAttribute), kFromPosition,
              kToPosition);
  draw(no_vertices, dimension);
  expect_points(t, "a map of attribute 0, no program, no map of vertices", {}, no_vertices, 0, ramp({}, {}));
};

EVALCTS_TEST(NvVertexProgram, BeatConventionalMaps, kMust, "EV-EXT-NVVP-PRIORITY", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  require_nv(t);
  require_programs(t, "v[COL0]", set_current_color, kCurrent);
  gl::Case state;
  use_nv_program(state, "v[COL0]");
  for (const bool on : {true, false}) {
    gl::Case drawing;
    set_current_color(drawing);
    define_ramp(drawing, dimension, target_in(dimension.two, GL_MAP1_VERTEX_4), kFromPosition, kToPosition);
    define_ramp(drawing, dimension, target_in(dimension.two, GL_MAP1_COLOR_4), kFromColor, kToColor);
    define_ramp(drawing, dimension, attribute_map(dimension, kColorAttribute), kFromOther, kToOther);
    if (!on) drawing.Disable(attribute_map(dimension, kColorAttribute));
    draw(drawing, dimension);
    expect_points(t, on ? "both enabled" : "only COLOR_4 enabled", state, drawing, std::size(kAt),
                  on ? ramp(kFromOther, kToOther) : ramp(kFromColor, kToColor));
  }
};

EVALCTS_TEST(NvVertexProgram, Attribute0IsTheVertex, kMust, "EV-EXT-NVVP-VERTEX", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  require_nv(t);
  require_programs(t, "v[COL0]", set_current_color, kCurrent);
  gl::Case state;
  use_nv_program(state, "v[COL0]");
  for (const bool colored : {false, true}) {
    gl::Case drawing;
    set_current_color(drawing);
    define_ramp(drawing, dimension, attribute_map(dimension, kPositionAttribute), kFromPosition, kToPosition);
    if (colored)
      define_ramp(drawing, dimension, target_in(dimension.two, GL_MAP1_COLOR_4), kFromColor, kToColor);
    draw(drawing, dimension);
    expect_points(t, colored ? "attribute 0 and COLOR_4" : "attribute 0 alone", state, drawing,
                  std::size(kAt), colored ? ramp(kFromColor, kToColor) : ramp(kCurrent, kCurrent));
  }
};

// The generated normal of q = (u/w - 1/2, v/(2 w) - 1/4, 0) with w = 1 + u/2 is not normalised: it is
// dq/du x dq/dv = (0, 0, 1/w^2 * 1/(2 w)), whose length is less than 1.
EVALCTS_TEST(NvVertexProgram, AutoNormal, kMust, "EV-EXT-NVVP-AUTON")
(Test& t) {
  require_nv(t);
  const Dimension& surface = kDimensions[1];
  const auto set_normal = [](gl::Case& c) { c.Normal3f(0, 0, 2); };
  require_programs(t, "v[NRML]", set_normal, {0, 0, 1, 1});  // colours are clamped
  gl::Case state, drawing;
  use_nv_program(state, "v[NRML]");
  const auto point = [](double u, double v) {
    const double w = 1 + u / 2;
    return std::array<float, 4>{static_cast<float>(u - w / 2), static_cast<float>(v / 2 - w / 4), 0,
                                static_cast<float>(w)};
  };
  std::vector<float> points;
  for (const double u : {0.0, 1.0})
    for (const double v : {0.0, 1.0})
      for (const float value : point(u, v)) points.push_back(value);
  const GLenum target = attribute_map(surface, kPositionAttribute);
  drawing.Map2f(target, 0.0f, 1.0f, 8, 2, 0.0f, 1.0f, 4, 2, points);
  drawing.Enable(target);
  drawing.Enable(GL_AUTO_NORMAL);
  draw(drawing, surface);
  Picture picture = feedback(t, "a rational patch of attribute 0", state, drawing);
  const std::string why = wrong_points(
      picture.parts.at(0), std::size(kAt),
      [](double u) {
        const double w = 1 + u / 2;
        return Color{0, 0, 0.5 / (w * w * w), 1};
      },
      [](double u) {
        const double w = 1 + u / 2;
        return Color{u / w - 0.5, 0.25 / w - 0.25, 0, 1};
      });
  picture.checked.expect(why.empty(), picture.parts.at(0).shown, why, "(mx, my, mz, 1), not normalized", why);
};

EVALCTS_TEST(NvVertexProgram, CurrentAttributesStay, kMust, "EV-EXT-NVVP-CURRENT", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  require_nv(t);
  gl::Case c("all 16 attributes have maps");
  use_nv_program(c, "v[COL0]");
  set_current_color(c);
  c.Normal3f(0.25f, -0.5f, 0.75f);
  c.MultiTexCoord4f(GL_TEXTURE0, 0.5f, -0.25f, 0.125f, 1.5f);
  for (const GLenum target : attribute_maps(t))
    if (is_curve(target) != dimension.two) define_ramp(c, dimension, target, kFromOther, kToOther);
  c.GetError();
  draw(c, dimension);
  const gl::Ref color = c.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4)),
                normal = c.GetFloatv(GL_CURRENT_NORMAL, gl::out<GLfloat>(3)),
                texture = c.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4));
  CheckedTrace checked = t.play(c);
  constexpr double kRelative = 1e-5;
  checked.expect_values_near(color, std::vector(kCurrent.begin(), kCurrent.end()), kRelative);
  checked.expect_values_near(normal, std::vector{0.25, -0.5, 0.75}, kRelative);
  checked.expect_values_near(texture, std::vector{0.5, -0.25, 0.125, 1.5}, kRelative);
};

}  // namespace
}  // namespace evalcts::suite_nv_vertex_program
