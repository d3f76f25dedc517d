// Programs as they were written for evaluators in the 1990s: curves, surfaces, a teapot, NURBS of GLU, and a
// mesh in a display list. For each program one test judges the vertices that it emits, and one compares its
// picture with that of explicit vertices under the same state.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <evalcts/gl/case_json.h>
#include <evalcts/judge/prediction.h>
#include <evalcts/testkit/registration.h>
#include "drawings.h"
#include "pictures.h"
#include "real_programs_data.h"  // kNurbsCurve, kTrimmedSurface

namespace evalcts::suite_real_programs {
namespace {

// --- View, light, texture --------------------------------------------------------------------------------

using Matrix = std::vector<float>;  // in column-major order

// Returns a matrix that rotates by `turn` degrees about the y axis, then by `tilt` degrees about the x axis,
// scales by `scale` and translates by (x, y, 0).
Matrix view(double turn, double tilt, double scale, double x = 0, double y = 0) {
  const double a = turn * std::numbers::pi / 180, b = tilt * std::numbers::pi / 180;
  const double rows[3][3] = {{std::cos(a), 0, std::sin(a)},
                             {std::sin(b) * std::sin(a), std::cos(b), -std::sin(b) * std::cos(a)},
                             {-std::cos(b) * std::sin(a), std::sin(b), std::cos(b) * std::cos(a)}};
  Matrix matrix(16, 0.0f);
  for (std::size_t column = 0; column < 3; ++column)
    for (std::size_t row = 0; row < 3; ++row)
      matrix[4 * column + row] = static_cast<float>(scale * rows[row][column]);
  matrix[12] = static_cast<float>(x);
  matrix[13] = static_cast<float>(y);
  matrix[15] = 1;
  return matrix;
}

// Sets the model-view matrix and an orthographic projection of [-1,1] x [-1,1] x [-2,2], seen along -z, and
// enables the depth test.
void look_at(gl::Case& c, const Matrix& model_view) {
  c.MatrixMode(GL_PROJECTION);
  c.LoadMatrixf(Matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -0.5f, 0, 0, 0, 0, 1});
  c.MatrixMode(GL_MODELVIEW);
  c.LoadMatrixf(model_view);
  c.Enable(GL_DEPTH_TEST);
}

// Enables a directional light from behind the viewer, in eye space, and NORMALIZE.
void light(gl::Case& c) {
  c.MatrixMode(GL_MODELVIEW);
  c.LoadIdentity();
  c.Materialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, std::vector<float>{0.9f, 0.6f, 0.3f, 1});
  enable_light(c, {0.5f, 0.6f, 1.0f, 0.0f});
  c.Enable(GL_NORMALIZE);
}

// Binds and enables a linearly filtered texture of 4 by 4 colours.
void texture(gl::Case& c) {
  set_up_texture(c);
  std::vector<GLubyte> texels;
  for (int t = 0; t < 4; ++t)
    for (int s = 0; s < 4; ++s)
      for (const int value : {64 + 48 * s, 64 + 48 * t, 240 - 24 * (s + t), 255})
        texels.push_back(static_cast<GLubyte>(value));
  c.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
  c.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  c.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

// --- Programs --------------------------------------------------------------------------------------------

// A step of a program: state, under which the explicit vertices are drawn as well, and the commands that
// draw.
struct Step {
  gl::Case state, drawing;
};

struct RealProgram {
  const char* name;
  std::vector<RequirementId> requirements;
  Attributes attributes;  // attributes that the picture depends on
  std::vector<Step> (*steps)();
};

const std::vector<float> kCurve = {-0.8f, -0.7f, 0, -0.4f, 0.9f, 0, 0.4f, -0.9f, 0, 0.8f, 0.7f, 0};

// Draws a cubic curve of 30 segments, and its control points.
std::vector<Step> curve() {
  Step step;
  step.state.ShadeModel(GL_FLAT);
  step.state.PointSize(5.0f);
  gl::Case& c = step.drawing;
  c.Map1f(GL_MAP1_VERTEX_3, 0.0f, 1.0f, 3, 4, kCurve);
  c.Enable(GL_MAP1_VERTEX_3);
  c.Color3f(1, 1, 1);
  c.Begin(GL_LINE_STRIP);
  for (int i = 0; i <= 30; ++i) c.EvalCoord1f(static_cast<float>(i) / 30.0f);
  c.End();
  c.Color3f(1, 1, 0);
  c.Begin(GL_POINTS);
  for (std::size_t i = 0; i < kCurve.size(); i += 3)
    c.Vertex3fv(std::vector<float>(&kCurve[i], &kCurve[i] + 3));
  c.End();
  return {step};
}

// Draws the same curve by EvalMesh1, with a colour map from red to blue.
std::vector<Step> curve_mesh() {
  Step step;
  gl::Case& c = step.drawing;
  c.Map1f(GL_MAP1_VERTEX_3, 0.0f, 100.0f, 3, 4, kCurve);
  c.Map1f(GL_MAP1_COLOR_4, 0.0f, 100.0f, 4, 2, std::vector<float>{1, 0.2f, 0.2f, 1, 0.2f, 0.2f, 1, 1});
  c.Enable(GL_MAP1_VERTEX_3);
  c.Enable(GL_MAP1_COLOR_4);
  c.MapGrid1f(30, 0.0f, 100.0f);
  c.EvalMesh1(GL_LINE, 0, 30);
  return {step};
}

// Defines and enables a wavy bicubic surface.
void define_surface(gl::Case& c) {
  constexpr float kHeights[4][4] = {
      {0.8f, 0.4f, -0.2f, 0.5f}, {-0.2f, 0.6f, 0.6f, -0.2f}, {0.8f, 0, 0, 0.8f}, {-0.4f, -0.3f, 0.2f, -0.4f}};
  std::vector<float> points;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (const float value :
           {-0.9f + 0.6f * static_cast<float>(j), -0.9f + 0.6f * static_cast<float>(i), kHeights[i][j]})
        points.push_back(value);
  c.Map2f(GL_MAP2_VERTEX_3, 0.0f, 1.0f, 3, 4, 0.0f, 1.0f, 12, 4, points);
  c.Enable(GL_MAP2_VERTEX_3);
}

// Draws the surface as lines along both directions.
std::vector<Step> net() {
  Step step;
  look_at(step.state, view(30, 50, 0.7));
  gl::Case& c = step.drawing;
  define_surface(c);
  c.MapGrid2f(20, 0.0f, 1.0f, 20, 0.0f, 1.0f);
  c.Color3f(1, 1, 1);
  for (int j = 0; j <= 8; j += 2) {
    for (const bool along_u : {true, false}) {
      c.Begin(GL_LINE_STRIP);
      for (int i = 0; i <= 20; ++i) {
        const float here = static_cast<float>(i) / 20.0f, across = static_cast<float>(j) / 8.0f;
        along_u ? c.EvalCoord2f(here, across) : c.EvalCoord2f(across, here);
      }
      c.End();
    }
  }
  return {step};
}

std::vector<Step> lit_surface() {
  Step step;
  light(step.state);
  look_at(step.state, view(30, 40, 0.7));
  gl::Case& c = step.drawing;
  define_surface(c);
  c.Enable(GL_AUTO_NORMAL);
  c.MapGrid2f(20, 0.0f, 1.0f, 20, 0.0f, 1.0f);
  c.EvalMesh2(GL_FILL, 0, 20, 0, 20);
  return {step};
}

// Draws strips of a lit surface with a colour map, then a floor of explicit vertices, which takes its colour
// and normal from the current values that were set at the beginning.
std::vector<Step> surface_on_floor() {
  Step step;
  light(step.state);
  step.state.ColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
  step.state.Enable(GL_COLOR_MATERIAL);
  look_at(step.state, view(30, -40, 0.7));
  gl::Case& c = step.drawing;
  c.Color3f(0.3f, 0.5f, 1);
  c.Normal3f(0, 0, 1);
  define_surface(c);
  c.Enable(GL_AUTO_NORMAL);
  c.Map2f(GL_MAP2_COLOR_4, 0.0f, 1.0f, 4, 2, 0.0f, 1.0f, 8, 2,
          std::vector<float>{1, 0.2f, 0.2f, 1, 1, 1, 0.2f, 1, 0.2f, 1, 0.2f, 1, 1, 1, 1, 1});
  c.Enable(GL_MAP2_COLOR_4);
  constexpr int kStrips = 8;
  for (int j = 0; j < kStrips; ++j) {
    c.Begin(GL_QUAD_STRIP);
    for (int i = 0; i <= kStrips; ++i)
      for (const int side : {1, 0})
        c.EvalCoord2f(static_cast<float>(i) / kStrips, static_cast<float>(j + side) / kStrips);
    c.End();
  }
  c.Begin(GL_QUADS);
  for (const auto& [x, y] : {std::pair{-1.1f, -1.1f}, {1.1f, -1.1f}, {1.1f, 1.1f}, {-1.1f, 1.1f}})
    c.Vertex3f(x, y, -0.5f);
  c.End();
  return {step};
}

std::vector<Step> textured_surface() {
  Step step;
  look_at(step.state, view(20, 30, 0.7));
  texture(step.state);
  gl::Case& c = step.drawing;
  define_surface(c);
  c.Map2f(GL_MAP2_TEXTURE_COORD_2, 0.0f, 1.0f, 2, 2, 0.0f, 1.0f, 4, 2,
          std::vector<float>{0, 0, 0, 1, 1, 0, 1, 1});
  c.Enable(GL_MAP2_TEXTURE_COORD_2);
  c.MapGrid2f(20, 0.0f, 1.0f, 20, 0.0f, 1.0f);
  c.Color3f(1, 1, 1);
  c.EvalMesh2(GL_FILL, 0, 20, 0, 20);
  return {step};
}

// --- The teapot ------------------------------------------------------------------------------------------

using Net = std::array<std::array<std::array<float, 3>, 4>, 4>;

// Radius and height of the control points of a quarter of a circle.
struct Ring {
  float radius, height;
};
constexpr Ring kRings[][4] = {{{1.4f, 2.4f}, {1.3375f, 2.53125f}, {1.4375f, 2.53125f}, {1.5f, 2.4f}},
                              {{1.5f, 2.4f}, {1.75f, 1.875f}, {2, 1.35f}, {2, 0.9f}},
                              {{2, 0.9f}, {2, 0.45f}, {1.5f, 0.225f}, {1.5f, 0.15f}},
                              {{1.5f, 0.15f}, {1.5f, 0.075f}, {1.425f, 0}, {0, 0}},
                              {{0, 3.15f}, {0.8f, 3.15f}, {0, 2.85f}, {0.2f, 2.7f}},
                              {{0.2f, 2.7f}, {0.4f, 2.55f}, {1.3f, 2.55f}, {1.3f, 2.4f}}};

// One half of a cross section of the handle or the spout: its inner and outer point, and its width.
struct Section {
  float inner_x, inner_z, width, outer_x, outer_z;
};
constexpr Section kSections[][4] = {{{-1.6f, 2.025f, 0.3f, -1.5f, 2.25f},
                                     {-2.3f, 2.025f, 0.3f, -2.5f, 2.25f},
                                     {-2.7f, 2.025f, 0.3f, -3, 2.25f},
                                     {-2.7f, 1.8f, 0.3f, -3, 1.8f}},
                                    {{-2.7f, 1.8f, 0.3f, -3, 1.8f},
                                     {-2.7f, 1.575f, 0.3f, -3, 1.35f},
                                     {-2.5f, 1.125f, 0.3f, -2.65f, 0.9375f},
                                     {-2, 0.9f, 0.3f, -1.9f, 0.6f}},
                                    {{1.7f, 1.425f, 0.66f, 1.7f, 0.6f},
                                     {2.6f, 1.425f, 0.66f, 3.1f, 0.825f},
                                     {2.3f, 2.1f, 0.25f, 2.4f, 2.025f},
                                     {2.7f, 2.4f, 0.25f, 3.3f, 2.4f}},
                                    {{2.7f, 2.4f, 0.25f, 3.3f, 2.4f},
                                     {2.8f, 2.475f, 0.25f, 3.525f, 2.49375f},
                                     {2.9f, 2.475f, 0.15f, 3.45f, 2.5125f},
                                     {2.8f, 2.4f, 0.15f, 3.2f, 2.4f}}};

Net net_of(const Ring (&rings)[4]) {
  constexpr float kOfCircle = 0.56f;
  Net net;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto [r, z] = rings[i];
    net[i] = {{{r, 0, z}, {r, -kOfCircle * r, z}, {kOfCircle * r, -r, z}, {0, -r, z}}};
  }
  return net;
}

Net net_of(const Section (&sections)[4]) {
  Net net;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto [inner_x, inner_z, width, outer_x, outer_z] = sections[i];
    net[i] = {{{inner_x, 0, inner_z},
               {inner_x, -width, inner_z},
               {outer_x, -width, outer_z},
               {outer_x, 0, outer_z}}};
  }
  return net;
}

// Returns the net, mirrored at the plane x = 0 (at_x) and at y = 0 (at_y), with unchanged orientation.
Net mirrored(const Net& net, bool at_x, bool at_y) {
  Net mirrored;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      auto [x, y, z] = net[i][at_x != at_y ? 3 - j : j];
      mirrored[i][j] = {at_x ? -x : x, at_y ? -y : y, z};
    }
  return mirrored;
}

void draw_patch(gl::Case& c, const Net& net, GLenum mode, int grid) {
  std::vector<float> points;
  for (const auto& row : net)
    for (const auto& point : row) points.insert(points.end(), point.begin(), point.end());
  c.Map2f(GL_MAP2_VERTEX_3, 0.0f, 1.0f, 3, 4, 0.0f, 1.0f, 12, 4, points);
  c.MapGrid2f(grid, 0.0f, 1.0f, grid, 0.0f, 1.0f);
  c.EvalMesh2(mode, 0, grid, 0, grid);
}

gl::Case draw_teapot(GLenum mode, int grid) {
  gl::Case c;
  c.PushAttrib(GL_ENABLE_BIT | GL_EVAL_BIT);
  c.Enable(GL_AUTO_NORMAL);
  c.Enable(GL_MAP2_VERTEX_3);
  c.Enable(GL_MAP2_TEXTURE_COORD_2);
  c.Map2f(GL_MAP2_TEXTURE_COORD_2, 0.0f, 1.0f, 2, 2, 0.0f, 1.0f, 4, 2,
          std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1});
  for (const auto& rings : kRings)
    for (const bool at_x : {false, true})
      for (const bool at_y : {false, true}) draw_patch(c, mirrored(net_of(rings), at_x, at_y), mode, grid);
  for (const auto& sections : kSections)
    for (const bool at_y : {false, true}) draw_patch(c, mirrored(net_of(sections), false, at_y), mode, grid);
  c.PopAttrib();
  return c;
}

// Sets the view of the teapot: upright, a little from above.
void look_at_teapot(gl::Case& c) { look_at(c, view(0, -70, 0.27, -0.06, -0.4)); }

std::vector<Step> solid_teapot() {
  Step step;
  light(step.state);
  look_at_teapot(step.state);
  step.drawing = draw_teapot(GL_FILL, 4);
  return {step};
}

std::vector<Step> wire_teapot() {
  Step step;
  look_at_teapot(step.state);
  step.drawing.Color3f(1, 1, 1);
  step.drawing.append(draw_teapot(GL_LINE, 2));
  return {step};
}

// --- GLU -------------------------------------------------------------------------------------------------

// The programs of this section contain the commands of GLU's NURBS renderer, see programs/README.md.
std::vector<Step> nurbs_curve() {
  Step step;
  step.drawing.Color3f(1, 1, 0);
  step.drawing.append(gl::parse_case(kNurbsCurve));
  return {step};
}

std::vector<Step> trimmed_surface() {
  Step step;
  light(step.state);
  look_at(step.state, view(20, -40, 0.9));
  step.drawing.Enable(GL_AUTO_NORMAL);
  step.drawing.append(gl::parse_case(kTrimmedSurface));
  return {step};
}

// --- Display list ----------------------------------------------------------------------------------------

// Calls a list that defines and draws a mesh twice, with different matrices and colours.
std::vector<Step> list_called_twice() {
  Step first;
  look_at(first.state, view(30, 40, 0.45, -0.5));
  gl::Case& c = first.drawing;
  c.NewList(1, GL_COMPILE);
  define_surface(c);
  c.MapGrid2f(8, 0.0f, 1.0f, 6, 0.0f, 1.0f);
  c.EvalMesh2(GL_FILL, 0, 8, 0, 6);
  c.EndList();
  c.Color3f(1, 0.4f, 0.2f);
  c.CallList(1);
  Step second;
  look_at(second.state, view(-30, 40, 0.45, 0.5));
  second.drawing.Color3f(0.2f, 1, 0.4f);
  second.drawing.CallList(1);
  return {first, second};
}
const std::vector<RealProgram> kPrograms = {
    {"CURVE", {{"EV-COORD-ASIF"}}, kPosition | kColor, curve},
    {"CURVE_MESH", {{"EV-COORD-ASIF"}}, kPosition | kColor, curve_mesh},
    {"NET", {{"EV-COORD-ASIF"}}, kPosition | kColor, net},
    {"LIT_SURFACE", {{"EV-COORD-ASIF"}}, kPosition | kNormal, lit_surface},
    {"SURFACE_ON_FLOOR",
     {{"EV-CUR-COLOR"}, {"EV-AUTON-CURRENT"}},
     kPosition | kColor | kNormal,
     surface_on_floor},
    {"TEXTURED_SURFACE", {{"EV-COORD-ASIF"}}, kPosition | kColor | kTextureCoordinate0, textured_surface},
    {"SOLID_TEAPOT", {{"EV-COORD-ASIF"}}, kPosition | kNormal | kTextureCoordinate0, solid_teapot},
    {"WIRE_TEAPOT", {{"EV-COORD-ASIF"}}, kPosition | kColor, wire_teapot},
    {"NURBS_CURVE", {{"EV-COORD-ASIF"}}, kPosition | kColor, nurbs_curve},
    {"TRIMMED_SURFACE", {{"EV-COORD-ASIF"}}, kPosition | kNormal, trimmed_surface},
    {"LIST_CALLED_TWICE", {{"EV-DL-REPEAT"}}, kPosition | kColor, list_called_twice}};

// --- Judgement -------------------------------------------------------------------------------------------

void expect_vertices(Test& t, const RealProgram& program) {
  gl::Case c("what the program draws");
  for (const Step& step : program.steps()) c.append(step.drawing);
  t.judge_vertices(c, program.attributes);
}

// Returns the commands with `normal` in place of each undefined (NaN) normal, where the surface has no
// tangent plane.
gl::Case with_normals(const gl::Case& commands, const std::array<float, 3>& normal) {
  gl::Case c;
  for (const gl::Command& command : commands.commands()) {
    if (command.entry == gl::EntryPoint::Normal3f && std::isnan(std::get<float>(command.arguments[0]))) {
      c.Normal3f(normal[0], normal[1], normal[2]);
    } else {
      c.add(command);
    }
  }
  return c;
}

// Returns the program with explicit vertices in place of evaluations, with `normal` for undefined normals.
gl::Case explicit_program(Test& t, const std::vector<Step>& steps, const std::array<float, 3>& normal) {
  gl::Case c, drawings;
  std::size_t drawn = 0;
  for (const Step& step : steps) {
    drawings.append(step.drawing);
    Prediction predicted = predict(drawings, t.max_order());
    const std::size_t count = predicted.primitives.size();
    predicted.primitives.erase(predicted.primitives.begin(),
                               predicted.primitives.begin() + static_cast<std::ptrdiff_t>(drawn));
    drawn = count;
    c.append(step.state);
    c.append(with_normals(without_edge_flags(as_explicit_commands(predicted)), normal));
  }
  return c;
}

// The RGBA pixels of a picture.
struct Pixels {
  const std::vector<double>& values;

  std::size_t count() const { return values.size() / 4; }
  bool is_lit(std::size_t i) const {
    return std::any_of(&values[4 * i], &values[4 * i] + 3, [](double value) { return value > 0.05; });
  }
  bool differs(std::size_t i, const Pixels& other, double tolerance) const {
    for (std::size_t k = 4 * i; k < 4 * i + 3; ++k)
      if (!(std::abs(values[k] - other.values[k]) <= tolerance)) return true;
    return false;
  }
  std::string text(std::size_t i) const {
    return fmt::format("({:.2f}, {:.2f}, {:.2f})", values[4 * i], values[4 * i + 1], values[4 * i + 2]);
  }
};

// Rounding errors may move edges by a pixel, and quads may be split along either diagonal: these shares of
// the lit pixels may be at an adjacent place, or differ from the control by more than the tolerance in a
// colour component.
constexpr double kShareThatMayMove = 0.1, kShareThatMayDiffer = 0.02, kPixelTolerance = 0.1;

// Returns true if pixel `i` and an adjacent one have changed places.
bool has_moved(const Pixels& seen, const Pixels& wanted, std::size_t i) {
  const auto same = [](const Pixels& a, std::size_t of_a, const Pixels& b, std::size_t of_b) {
    for (std::size_t k = 0; k < 3; ++k)
      if (!(std::abs(a.values[4 * of_a + k] - b.values[4 * of_b + k]) <= kPixelTolerance)) return false;
    return true;
  };
  const auto x = static_cast<int>(i % kSide), y = static_cast<int>(i / kSide);
  for (int other_y = std::max(y - 1, 0); other_y <= std::min(y + 1, kSide - 1); ++other_y)
    for (int other_x = std::max(x - 1, 0); other_x <= std::min(x + 1, kSide - 1); ++other_x) {
      const auto other = static_cast<std::size_t>(other_y * kSide + other_x);
      if (same(seen, i, wanted, other) && same(seen, other, wanted, i)) return true;
    }
  return false;
}

void expect_picture(Test& t, const RealProgram& program) {
  const std::vector<Step> steps = program.steps();
  gl::Case evaluated;
  for (const Step& step : steps) {
    evaluated.append(step.state);
    evaluated.append(step.drawing);
  }
  const Picture control = pixels(t, gl::control("explicit vertices"),
                                 {{"towards the viewer", explicit_program(t, steps, {0, 0, 1})},
                                  {"sideways", explicit_program(t, steps, {-1, -1, 0})}},
                                 {kWindow});
  Picture picture = pixels(t, "picture", {{"evaluated", evaluated}}, {kWindow});
  show_pixels(picture, control.parts);

  const Pixels wanted{control.parts[0].values}, other{control.parts[1].values}, seen{picture.parts[0].values};
  std::size_t all_lit = 0, lit = 0, different = 0, moved = 0, first = 0;
  for (std::size_t i = 0; i < wanted.count(); ++i) {
    all_lit += wanted.is_lit(i);
    if (wanted.differs(i, other, kTolerance)) continue;  // depends on a normal that is undefined
    lit += wanted.is_lit(i);
    if (!seen.differs(i, wanted, kPixelTolerance)) continue;
    if (different++ == 0) first = i;
    moved += has_moved(seen, wanted, i);
  }
  constexpr std::size_t kLeast = 50;
  if (lit < kLeast || 2 * lit < all_lit)
    throw NotObservable("pipeline: explicit vertices do not draw the picture");
  const std::size_t x = first % kSide, y = first / kSide;
  picture.checked.expect(
      static_cast<double>(different - moved) <= kShareThatMayDiffer * static_cast<double>(lit) &&
          static_cast<double>(moved) <= kShareThatMayMove * static_cast<double>(lit),
      picture.parts[0].shown,
      fmt::format(
          "the program draws wrong: {} pixels of its picture differ, which has {}; the first is at ({}, {})",
          different, lit, x, y),
      "the picture of explicit vertices: " + wanted.text(first), seen.text(first));
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const RealProgram& program : kPrograms) {
    const auto add = [&](const std::string& test, void (*body)(Test&, const RealProgram&)) {
      TestInfo info = test_info("RealPrograms", test + "/" + program.name, Level::kMust, __FILE__, __LINE__);
      info.requirements = program.requirements;
      TestDeclaration(info, Parameters<>()) << [&program, body](Test& t) { body(t, program); };
    };
    add("Vertices", expect_vertices);
    add("Picture", expect_picture);
  }
  return true;
}();

}  // namespace
}  // namespace evalcts::suite_real_programs
