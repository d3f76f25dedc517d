// Section 22 of the requirements, feedback mode: the tokens, vertices, texture coordinates and colours of
// evaluated primitives.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <evalcts/testkit/registration.h>

#include "drawings.h"

namespace evalcts::suite_feedback_mode {
namespace {

// Returns a state that moves the drawing to the right by this distance. Some implementations compute no
// texture coordinates where a primitive is clipped, unless a texture is enabled.
gl::Case moved_by(float distance) {
  gl::Case state;
  set_up_texture(state);
  state.LoadMatrixf(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, distance, 0, 0, 1});
  return state;
}

// Returns scenes in which the drawings are inside the view volume, and scenes in which their right half is
// outside, with no vertex near its border.
std::vector<Scene> inside_and_half_outside(const std::vector<Drawing>& drawings, bool evaluated) {
  std::vector<Scene> scenes = scenes_of(drawings, evaluated, "inside", moved_by(0));
  for (Scene& scene : scenes_of(drawings, evaluated, "half of it clipped", moved_by(1.1f)))
    scenes.push_back(std::move(scene));
  return scenes;
}

bool are_all(const std::vector<FeedbackPrimitive>& primitives, std::initializer_list<GLenum> tokens) {
  return std::ranges::all_of(primitives, [&](const FeedbackPrimitive& primitive) {
    return std::ranges::find(tokens, primitive.token) != tokens.end();
  });
}

std::size_t count_vertices(const Drawing& drawing) { return drawing.predicted.vertex_count(); }

std::size_t count_segments(const Drawing& drawing) {
  return count_vertices(drawing) - drawing.predicted.primitives.size();
}

// A mesh of POINT returns a POINT_TOKEN for each unclipped vertex. Other tests judge their order.
EVALCTS_TEST(Feedback, PointMesh, kMust, "EV-FB-POINT")
(Test& t) {
  const std::vector<Drawing> drawings = meshes(t, GL_POINTS);
  const Picture control =
      feedback(t, gl::control("explicit points"), inside_and_half_outside(drawings, false));
  for (std::size_t i = 0; i < control.parts.size(); ++i) {
    const std::vector<FeedbackPrimitive> points = primitives_of(control.parts[i]);
    const std::size_t all = count_vertices(drawings[i % drawings.size()]);
    const bool whole = i < drawings.size();
    if (!are_all(points, {GL_POINT_TOKEN}) || points.empty() || (points.size() == all) != whole)
      throw NotObservable("pipeline: explicit points do not come back one by one");
  }
  Picture picture = feedback(t, "evaluated", inside_and_half_outside(drawings, true));
  expect_meshes_like_explicit(picture, control);
};

// A mesh of LINE returns a LINE_TOKEN or LINE_RESET_TOKEN for each segment.
EVALCTS_TEST(Feedback, LineMesh, kMust, "EV-FB-LINE")
(Test& t) {
  const std::vector<Drawing> drawings = meshes(t, GL_LINE_STRIP);
  const Picture control =
      feedback(t, gl::control("explicit strips"), inside_and_half_outside(drawings, false));
  for (std::size_t i = 0; i < control.parts.size(); ++i) {
    const std::vector<FeedbackPrimitive> lines = primitives_of(control.parts[i]);
    const bool whole = i < drawings.size();
    if (!are_all(lines, {GL_LINE_TOKEN, GL_LINE_RESET_TOKEN}) || lines.empty() ||
        (lines.size() == count_segments(drawings[i % drawings.size()])) != whole)
      throw NotObservable("pipeline: explicit line strips do not come back segment by segment");
  }
  Picture picture = feedback(t, "evaluated", inside_and_half_outside(drawings, true));
  expect_meshes_like_explicit(picture, control);
};

// Returns true if a segment that is not the first of its strip has LINE_RESET_TOKEN.
bool starts_elsewhere(const Drawing& drawing, const Part& part) {
  std::set<std::size_t> first;
  std::size_t segment = 0;
  for (const reference::Primitive& strip : drawing.predicted.primitives) {
    first.insert(segment);
    segment += strip.vertices.size() - 1;
  }
  const std::vector<FeedbackPrimitive> lines = primitives_of(part);
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].token == GL_LINE_RESET_TOKEN && !first.count(i)) return true;
  return false;
}

// LINE_RESET_TOKEN appears at the first segment of a strip only. A violation is a warning (U-FEEDBACK-RESET).
EVALCTS_TEST(Feedback, LineStarts, kQuality, "EV-FB-LINE")
(Test& t) {
  const std::vector<Drawing> drawings = meshes(t, GL_LINE_STRIP);
  const Picture control = feedback(t, gl::control("explicit strips"), scenes_of(drawings, false));
  for (std::size_t i = 0; i < drawings.size(); ++i)
    if (starts_elsewhere(drawings[i], control.parts[i]))
      throw NotObservable("pipeline: LINE_RESET_TOKEN stands within explicit strips");
  Picture picture = feedback(t, "evaluated", scenes_of(drawings, true));
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    const Part& part = picture.parts[i];
    picture.checked.expect(
        !starts_elsewhere(drawings[i], part), part.shown,
        fmt::format("LINE_RESET_TOKEN at a segment that is not the first of its strip ({})", part.name),
        "LINE_TOKEN", "LINE_RESET_TOKEN");
  }
};

double area_of(const FeedbackPrimitive& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const auto& a = polygon.vertices[i];
    const auto& b = polygon.vertices[(i + 1) % polygon.vertices.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

// Returns the number of the quad that contains the centre of a polygon.
std::size_t quad_of(const FeedbackPrimitive& polygon) {
  double x = 0, y = 0;
  for (const auto& vertex : polygon.vertices) {
    x += vertex[0] / static_cast<double>(polygon.vertices.size());
    y += vertex[1] / static_cast<double>(polygon.vertices.size());
  }
  const auto step = [](double value, int first, int size, int count) {
    return static_cast<std::size_t>(std::clamp(std::floor((value - first - kOff) / size), 0.0, count - 1.0));
  };
  return step(y, kBottom, kHeight, kRows) * kColumns + step(x, kLeft, kWidth, kColumns);
}

constexpr std::size_t kQuads = kColumns * kRows;

// Returns the sum of the areas of the polygons in each quad.
Part areas_of(const Part& part) {
  Part areas = {part.name + ", areas of the quads", part.shown, std::vector<double>(kQuads)};
  for (const FeedbackPrimitive& polygon : primitives_of(part))
    areas.values[quad_of(polygon)] += area_of(polygon);
  return areas;
}

EVALCTS_TEST(Feedback, FillMesh, kMust, "EV-FB-FILL")
(Test& t) {
  const std::vector<Drawing> drawings = meshes(t, GL_QUAD_STRIP);
  const Picture control =
      feedback(t, gl::control("explicit quad strips"), scenes_of(drawings, false, "inside", moved_by(0)));
  const Part& expected = control.parts[0];
  const std::vector<double> whole(kQuads, -double{kWidth} * kHeight);  // clockwise
  if (!are_all(primitives_of(expected), {GL_POLYGON_TOKEN}) || !alike(areas_of(expected).values, whole))
    throw NotObservable("pipeline: explicit quad strips do not come back as polygons that cover the quads");

  Picture picture = feedback(t, "evaluated", scenes_of(drawings, true, "inside", moved_by(0)));
  const Part& seen = picture.parts[0];
  const std::vector<FeedbackPrimitive> polygons = primitives_of(seen);
  picture.checked.expect(are_all(polygons, {GL_POLYGON_TOKEN}), seen.shown,
                         "not all that comes back of a FILL mesh are polygons", "POLYGON_TOKEN", "others");
  picture.checked.expect(
      polygons.size() >= kQuads && polygons.size() <= 2 * kQuads, seen.shown,
      fmt::format("{} polygons come back of a FILL mesh of {} quads", polygons.size(), kQuads),
      fmt::format("{} to {}", kQuads, 2 * kQuads), std::to_string(polygons.size()));
  expect_like_explicit(picture.checked, areas_of(seen), areas_of(expected));
  expect_drawn_like_explicit(picture, drawings, control);
};

constexpr GLenum kTextures[] = {GL_MAP1_TEXTURE_COORD_1, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_TEXTURE_COORD_3,
                                GL_MAP1_TEXTURE_COORD_4};

// Enables the texture map with this number of components only, or none if it is 0.
gl::Case choose_texture_map(bool two, int components) {
  gl::Case c;
  for (int k = 1; k <= 4; ++k) {
    const GLenum target = target_in(two, GL_MAP1_TEXTURE_COORD_1 + static_cast<GLenum>(k - 1));
    if (k != components) {
      c.Disable(target);
      continue;
    }
    std::vector<double> ends = {0, -1, 2.5, 1.5, 1, 0.5, -0.5, 2};
    if (k < 4) ends = {ends.begin(), ends.begin() + 2 * k};
    define_and_enable(c, make_map2(target, 2, 1, ends));
  }
  return c;
}

// Evaluated texture coordinates do not depend on the current ones, nor on those of unit 1.
EVALCTS_TEST(Feedback, TextureCoordinates, kMust, "EV-FB-TEX")
(Test& t) {
  std::vector<Drawing> drawings;
  gl::Case state;
  set_up_texture(state);
  state.TexCoord4f(0.25f, 4, -2, 0.5f);
  if (t.gl().at_least(1, 3)) state.MultiTexCoord4f(GL_TEXTURE1, 7, -3, 5, 2);
  for (const bool two : {false, true})
    for (int components = 0; components <= 4; ++components) {
      gl::Case c;
      c.TexCoord4f(0.25f, 4, -2, 0.5f);
      two ? define_patch(c) : define_curve(c);
      c.append(choose_texture_map(two, components));
      eval_mesh(c, two, GL_POINT, 0, kColumns, 0, kRows);
      drawings.push_back(drawing(t,
                                 components ? fmt::format("MAP{}_TEXTURE_COORD_{}", two ? 2 : 1, components)
                                            : fmt::format("no map of {} dimensions", two ? 2 : 1),
                                 two, GL_POINTS, std::move(c)));
    }
  constexpr std::size_t kEach = 1 + std::size(kTextures);
  const std::size_t points = drawings.size();
  for (Drawing& drawing : all_drawings(t))
    if (drawing.primitive != GL_POINTS) drawings.push_back(std::move(drawing));
  const Picture control =
      feedback(t, gl::control("explicit texture coordinates"), scenes_of(drawings, false, "", state));
  for (std::size_t i = 0; i < points; ++i)
    if (i % kEach) require_an_effect(control.parts[i].values, control.parts[i - i % kEach].values);
  Picture picture = feedback(t, "evaluated", scenes_of(drawings, true, "", state));
  expect_drawn_like_explicit(picture, drawings, control);
};

// Stages that change the colours of vertices.
struct ColorStage {
  const char* name;
  void (*set)(gl::Case&);
};
constexpr ColorStage kColorStages[] = {
    {"LIGHTING",
     [](gl::Case& c) {
       c.Enable(GL_LIGHTING);
       c.Enable(GL_LIGHT0);
       c.Lightfv(GL_LIGHT0, GL_POSITION, std::vector<float>{0.36f, 0.48f, 0.8f, 0});
     }},
    // Colours are clamped in every state; the drawings of this test need clamping.
    {"CLAMPING", [](gl::Case&) {}}};

std::vector<Drawing> meshes_of_colors_beyond_1(Test& t) {
  std::vector<Drawing> drawings;
  gl::Case too_bright;
  define(too_bright, make_map1(GL_MAP1_COLOR_4, {-0.5, 0.5, 1.75, 2, 1.5, -2, 0.25, 0.5}));
  define(too_bright, make_map2(GL_MAP2_COLOR_4, 2, 2,
                               {-0.5, 0.5, 1.75, 2, 1.5, -2, 0.25, 0.5, 0, 1, 3, 1, 0.75, 0.25, -1, 1.5}));
  return meshes(t, too_bright);
}

bool is_clamped(const Part& part) {
  for (const FeedbackPrimitive& primitive : primitives_of(part))
    for (const auto& vertex : primitive.vertices)
      for (std::size_t k = 4; k < 8; ++k)
        if (!(vertex[k] >= 0 && vertex[k] <= 1)) return false;
  return true;
}

EVALCTS_TEST(Feedback, Colors, kMust, "EV-FB-COLOR", combine(kColorStages))
(Test& t, const ColorStage& stage) {
  const bool lighting = std::string_view(stage.name) == "LIGHTING";
  const std::vector<Drawing> drawings = lighting ? meshes(t) : meshes_of_colors_beyond_1(t);
  gl::Case state;
  stage.set(state);
  const Picture control =
      feedback(t, gl::control("explicit vertices"), scenes_of(drawings, false, "", state));
  if (lighting) {
    require_an_effect(control,
                      feedback(t, gl::control("explicit vertices, not lit"), scenes_of(drawings, false)));
  } else if (!std::ranges::all_of(control.parts, is_clamped)) {
    throw NotObservable("pipeline: the colours of explicit vertices are not clamped");
  }
  Picture picture = feedback(t, "evaluated", scenes_of(drawings, true, "", state));
  expect_drawn_like_explicit(picture, drawings, control);
};

// For each segment or quad, the colour of one vertex and the largest difference of a component of its other
// vertices from it.
using FlatColors = std::map<std::size_t, std::array<double, 5>>;
FlatColors flat_colors_of(const Drawing& drawing, const Part& part) {
  std::map<std::size_t, std::vector<std::array<double, 12>>> vertices;
  std::size_t segment = 0;
  for (const FeedbackPrimitive& primitive : primitives_of(part)) {
    auto& all = vertices[drawing.primitive == GL_QUAD_STRIP ? quad_of(primitive) : segment++];
    all.insert(all.end(), primitive.vertices.begin(), primitive.vertices.end());
  }
  FlatColors colors;
  for (const auto& [place, of_one] : vertices) {
    std::array<double, 5>& color = colors[place];
    std::copy_n(&of_one[0][4], 4, color.begin());
    for (const auto& vertex : of_one)
      for (std::size_t k = 0; k < 4; ++k) color[4] = std::max(color[4], std::abs(vertex[4 + k] - color[k]));
  }
  return colors;
}

// Segments and quads are flat if explicit ones are; others are not judged. Segments of curves have the same
// colours, too; in a mesh of EvalMesh2 other tests judge which vertex gives the colour.
EVALCTS_TEST(Feedback, FlatColors, kMust, "EV-FB-COLOR")
(Test& t) {
  const std::vector<Drawing> lines = meshes(t, GL_LINE_STRIP), quads = meshes(t, GL_QUAD_STRIP);
  gl::Case flat;
  flat.ShadeModel(GL_FLAT);
  const auto scenes = [&](bool evaluated) {
    std::vector<Scene> all = {Scene("the state alone", flat)};
    for (Scene& scene : inside_and_half_outside(lines, evaluated)) all.push_back(std::move(scene));
    for (Scene& scene : scenes_of(quads, evaluated, "inside", moved_by(0))) all.push_back(std::move(scene));
    return all;
  };
  const Picture control = feedback(t, gl::control("explicit vertices"), scenes(false));
  Picture picture = feedback(t, "evaluated", scenes(true));
  bool observed = false;
  for (std::size_t i = 1; i < picture.parts.size(); ++i) {
    const Drawing& drawing = i <= 2 * lines.size() ? lines[(i - 1) % lines.size()] : quads[0];
    const FlatColors all_expected = flat_colors_of(drawing, control.parts[i]),
                     all_seen = flat_colors_of(drawing, picture.parts[i]);
    const std::string name = picture.parts[i].name + ", colours and the differences within them";
    Part expected = {name, control.parts[i].shown, {}}, seen = {name, picture.parts[i].shown, {}};
    for (const auto& [place, color] : all_expected) {
      if (color[4] > kTolerance) continue;
      const auto begin = drawing.two ? 4 : 0;
      expected.values.insert(expected.values.end(), color.begin() + begin, color.end());
      const auto found = all_seen.find(place);
      if (found != all_seen.end())
        seen.values.insert(seen.values.end(), found->second.begin() + begin, found->second.end());
    }
    if (expected.values.empty()) continue;
    observed = true;
    expect_like_explicit(picture.checked, seen, expected);
  }
  if (!observed) throw NotObservable("pipeline: explicit primitives are not flat in feedback mode");
};

}  // namespace
}  // namespace evalcts::suite_feedback_mode
