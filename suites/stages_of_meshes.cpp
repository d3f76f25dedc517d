// Section 22 of the requirements, stages of the fixed-function pipeline: texture generation, the texture
// matrix, clip planes, fog and flat shading act on meshes as on explicit vertices.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

#include <evalcts/testkit/registration.h>

#include "stages.h"

namespace evalcts::suite_stages_of_meshes {
namespace {

using Values = std::vector<float>;

// Throws NotObservable unless the texture coordinates of explicit points and line strips are transformed by
// the texture matrix, once: NVIDIA's driver (580) does it twice for explicit lines in feedback mode.
void require_transformed_texture(const Values& texture_matrix, const Stage& stage, const Drawing& drawing,
                                 const Part& control) {
  if (drawing.primitive == GL_QUAD_STRIP) return;
  const auto transformed = [&](const reference::Vertex& vertex) {
    std::vector<double> coordinates(4);
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t column = 0; column < 4; ++column)
        coordinates[row] += static_cast<double>(texture_matrix[4 * column + row]) *
                            static_cast<double>(reference::rounded(vertex.texture_coordinate[0][column]));
    return coordinates;
  };
  // Each point has one vertex, and each segment of a strip has two.
  std::vector<std::vector<double>> known;
  const std::size_t size = drawing.primitive == GL_POINTS ? 1 : 2;
  for (const reference::Primitive& primitive : drawing.predicted.primitives)
    for (std::size_t i = 0; i + size <= primitive.vertices.size(); ++i)
      for (std::size_t j = 0; j < size; ++j) known.push_back(transformed(primitive.vertices[i + j]));
  std::vector<std::vector<double>> seen;
  for (const FeedbackPrimitive& primitive : primitives_of(control))
    for (const auto& vertex : primitive.vertices) seen.emplace_back(vertex.begin() + 8, vertex.end());
  if (seen.size() != known.size())
    throw NotObservable(
        fmt::format("pipeline: {} explicit vertices come back as {}", known.size(), seen.size()));
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (!alike(seen[i], known[i]))
      throw NotObservable(
          fmt::format("pipeline: with the texture matrix '{}' explicit vertex {} of {} has the texture "
                      "coordinates ({}), expected ({})",
                      stage.name, i, drawing.name, fmt::join(seen[i], ", "), fmt::join(known[i], ", ")));
}

// --- Texture coordinates ---------------------------------------------------------------------------------

struct Generation {
  const char* name;
  GLint mode;
  int coordinates;  // the number of generated ones among S, T, R, Q
};
constexpr Generation kGenerations[] = {{"OBJECT_LINEAR", GL_OBJECT_LINEAR, 4},
                                       {"EYE_LINEAR", GL_EYE_LINEAR, 4},
                                       {"SPHERE_MAP", GL_SPHERE_MAP, 2},
                                       {"NORMAL_MAP", GL_NORMAL_MAP, 3},
                                       {"REFLECTION_MAP", GL_REFLECTION_MAP, 3}};
constexpr std::pair<GLenum, GLenum> kGenerated[] = {
    {GL_S, GL_TEXTURE_GEN_S}, {GL_T, GL_TEXTURE_GEN_T}, {GL_R, GL_TEXTURE_GEN_R}, {GL_Q, GL_TEXTURE_GEN_Q}};

// Returns a state in which the eye is two units away, so that directions to it are well-conditioned.
gl::Case seen_from_a_distance() {
  gl::Case state;
  set_up_texture(state);
  state.MatrixMode(GL_PROJECTION);
  state.LoadMatrixf(Values{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 2, 1});
  state.MatrixMode(GL_MODELVIEW);
  state.LoadMatrixf(Values{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -2, 1});
  for (const auto& [coordinate, enable] : kGenerated) state.Disable(enable);
  return state;
}

constexpr NamedValue<bool> kNormals[] = {{"EVALUATED", false}, {"GENERATED", true}};

EVALCTS_TEST(Pipeline, TextureGeneration, kMust, "EV-PIPE-TEXGEN", combine(kNormals))
(Test& t, const NamedValue<bool>& normals) {
  std::vector<Stage> stages = {{"no generation", seen_from_a_distance()}};
  for (const Generation& generation : kGenerations) {
    const bool late = generation.mode == GL_NORMAL_MAP || generation.mode == GL_REFLECTION_MAP;
    if (late && !t.gl().at_least(1, 3)) continue;
    gl::Case state = seen_from_a_distance();
    for (int k = 0; k < generation.coordinates; ++k) {
      const auto& [coordinate, enable] = kGenerated[k];
      state.TexGeni(coordinate, GL_TEXTURE_GEN_MODE, generation.mode);
      const float way = static_cast<float>(k) / 2;
      for (const GLenum plane : {GL_OBJECT_PLANE, GL_EYE_PLANE})
        state.TexGenfv(
            coordinate, plane,
            coordinate == GL_Q ? Values{0.25f, -0.5f, 0.125f, 2} : Values{2, 1 - way, way - 1, 0.5f});
      state.Enable(enable);
    }
    stages.push_back({generation.name, std::move(state)});
  }
  gl::Case automatic;
  automatic.Enable(GL_AUTO_NORMAL);
  std::vector<Drawing> drawings = normals.value ? meshes(t, automatic) : meshes(t);
  if (normals.value) std::erase_if(drawings, [](const Drawing& drawing) { return !drawing.two; });
  expect_stages(t, stages, drawings);
};

EVALCTS_TEST(Pipeline, TextureMatrix, kMust, "EV-PIPE-TEXMATRIX")
(Test& t) {
  const std::map<std::string, Values> matrices = {
      {"identity", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
      {"scaled", {3, 0, 0, 0, 0, -2, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 1.5f}},
      {"turned and moved", {0, 2, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0.5f, -0.25f, 1, 1}}};
  std::vector<Stage> stages;
  for (const auto& [name, matrix] : matrices) {
    gl::Case state;
    set_up_texture(state);
    state.MatrixMode(GL_TEXTURE);
    state.LoadMatrixf(matrix);
    state.MatrixMode(GL_MODELVIEW);
    stages.push_back({name, std::move(state)});
  }
  expect_stages(t, stages, meshes(t), {}, {},
                [&](const Stage& stage, const Drawing& drawing, const Part& control) {
                  require_transformed_texture(matrices.at(stage.name), stage, drawing, control);
                });
};

// --- Clip planes -----------------------------------------------------------------------------------------

// The clip planes are at this x in the window, between two columns of vertices.
constexpr int kPlaneAt = 38;

std::vector<Stage> clip_stages() {
  gl::Case none, left, lower;
  // Some implementations compute no texture coordinates where a primitive is clipped, unless a texture is
  // enabled.
  for (gl::Case* state : {&none, &left, &lower}) set_up_texture(*state);
  for (const GLenum plane : {GL_CLIP_PLANE0, GL_CLIP_PLANE1})
    for (gl::Case* state : {&none, &left, &lower}) state->Disable(plane);
  const double middle = at_pixel(kPlaneAt);
  left.ClipPlane(GL_CLIP_PLANE0, std::vector<double>{-1, 0, 0, middle});
  left.Enable(GL_CLIP_PLANE0);
  lower.ClipPlane(GL_CLIP_PLANE1, std::vector<double>{0.25, -1, 0, 0.2});
  lower.Enable(GL_CLIP_PLANE1);
  return {{"no clip plane", none}, {"the right half clipped", left}, {"the upper part clipped", lower}};
}

constexpr GLenum kPlanes[] = {GL_CLIP_PLANE0, GL_CLIP_PLANE1, GL_CLIP_PLANE5};
// Returns a stage without clip planes, and stages in which one of the planes clips the right half.
std::vector<Stage> right_halves_clipped() {
  std::vector<Stage> stages(1);
  stages[0].name = "no clip plane";
  for (const GLenum plane : kPlanes) stages[0].state.Disable(plane);
  for (const GLenum plane : kPlanes) {
    Stage stage = {fmt::format("the right half clipped by plane {}", plane - GL_CLIP_PLANE0),
                   stages[0].state};
    stage.state.ClipPlane(plane, std::vector<double>{-1, 0, 0, at_pixel(kPlaneAt)});
    stage.state.Enable(plane);
    stages.push_back(std::move(stage));
  }
  return stages;
}

EVALCTS_TEST(Pipeline, ClippedPointsAndLines, kMust, "EV-PIPE-CLIPPLANE")
(Test& t) {
  std::vector<Drawing> drawings = meshes(t, GL_POINTS);
  for (Drawing& drawing : meshes(t, GL_LINE_STRIP)) drawings.push_back(std::move(drawing));
  // The second plane does not clip the curve.
  expect_stages(t, clip_stages(), drawings, {},
                [](std::size_t stage, const Drawing& drawing) { return stage == 1 || drawing.two; });
};

// Compares pixels on both sides of the plane, because the vertices of clipped quads depend on how they are
// split.
EVALCTS_TEST(Pipeline, ClippedQuads, kMust, "EV-PIPE-CLIPPLANE")
(Test& t) {
  const std::vector<Drawing> drawings = meshes(t, GL_QUAD_STRIP);
  const std::vector<Stage> stages = right_halves_clipped();
  std::vector<Area> areas;
  for (int y = kBottom + 4; y < kBottom + kHeight * kRows; y += 4)
    for (const int x : {kLeft + 4, kPlaneAt - 3, kPlaneAt + 2, kLeft + kWidth * kColumns - 4})
      areas.push_back({x, y});
  const Picture control = StagedPicture(t, gl::control("explicit quad strips"), stages, drawings,
                                        Vertices::kExplicit, {areas, GL_RED})
                              .picture();
  for (std::size_t i = 0; i < control.parts.size(); ++i) {
    const bool clipped = i >= areas.size() && areas[i % areas.size()].x > kPlaneAt;
    if (lit(control.parts[i]) == clipped) throw NotObservable("pipeline: explicit quads are not clipped");
  }
  // Only whether a pixel is drawn is compared, because colours depend on how the quads are split.
  Picture picture =
      StagedPicture(t, "evaluated", stages, drawings, Vertices::kEvaluated, {areas, GL_RED}).picture();
  for (std::size_t i = 0; i < picture.parts.size(); ++i) {
    const Part& seen = picture.parts[i];
    show_pixels(picture, control.parts, seen.scene);
    const char* const is = lit(seen) ? "drawn" : "not drawn";
    const char* const expected = lit(control.parts[i]) ? "drawn" : "not drawn";
    picture.checked.expect(lit(seen) == lit(control.parts[i]), seen.shown,
                           fmt::format("{} is {}, expected {}", seen.name, is, expected), expected, is);
  }
};

// --- Fog -------------------------------------------------------------------------------------------------

// Returns a state of fog with the mode, or without fog if the mode is 0. The drawings are at z from -2 to -1
// in eye coordinates.
gl::Case fog(GLint mode) {
  gl::Case state;
  state.PointSize(6);
  state.MatrixMode(GL_PROJECTION);
  state.LoadMatrixf(Values{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1.5f, 1});
  state.MatrixMode(GL_MODELVIEW);
  state.LoadMatrixf(Values{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1.5f, 1});
  state.Disable(GL_FOG);
  if (!mode) return state;
  state.Enable(GL_FOG);
  state.Fogi(GL_FOG_MODE, mode);
  state.Fogf(GL_FOG_DENSITY, 0.7f);
  state.Fogf(GL_FOG_START, 0.9f);
  state.Fogf(GL_FOG_END, 2.5f);
  state.Fogfv(GL_FOG_COLOR, Values{0, 1, 1, 0});
  return state;
}

// Returns pixels of the points of the curve or of the patch, or pixels of their rows of lines beside these
// points: the last pixel of a line is not drawn, and which one that is depends on the direction, which other
// tests judge.
std::vector<Area> fogged_pixels(const Drawing& drawing) {
  const bool lines = drawing.primitive == GL_LINE_STRIP;
  std::vector<Area> areas;
  for (int i = 0; i <= kColumns; ++i) {
    const int x = kLeft + kWidth * i + (!lines ? 0 : i < kColumns ? 1 : -1);
    if (!drawing.two) areas.push_back({x, kCurveRow});
    for (int j = 0; drawing.two && j <= kRows; ++j) areas.push_back({x, kBottom + kHeight * j});
  }
  return areas;
}

// Returns true for a pixel at a corner of the patch. Whether a mesh of lines draws it depends on the
// directions of the lines, which other tests judge (EV-MESH2-LINE).
bool is_corner(const Area& area) {
  return (area.x == kLeft || area.x == kLeft + kWidth * kColumns) &&
         (area.y == kBottom || area.y == kBottom + kHeight * kRows);
}

// Expects meshes of POINT and LINE to be like explicit vertices in all stages. Throws NotObservable if two
// stages look the same.
void expect_fog(Test& t, const std::vector<Stage>& stages) {
  std::vector<Drawing> drawings = meshes(t, GL_POINTS);
  for (Drawing& drawing : meshes(t, GL_LINE_STRIP)) drawings.push_back(std::move(drawing));
  for (const Drawing& drawing : drawings) {
    const View view = {fogged_pixels(drawing)};
    const StagedPicture control(t, gl::control("explicit vertices, " + drawing.name), stages, {drawing},
                                Vertices::kExplicit, view);
    const auto values = [&](std::size_t stage) {
      std::vector<double> all;
      for (const Part& part : control.parts(stage, 0))
        all.insert(all.end(), part.values.begin(), part.values.end());
      return all;
    };
    for (std::size_t i = 1; i < stages.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (alike(values(i), values(j), 2 * kTolerance))
          throw NotObservable("pipeline: fog does not show with explicit vertices");
    Picture picture =
        StagedPicture(t, "evaluated, " + drawing.name, stages, {drawing}, Vertices::kEvaluated, view)
            .picture();
    for (std::size_t i = 0; drawing.primitive == GL_LINE_STRIP && i < picture.parts.size(); ++i)
      if (is_corner(view.areas[i % view.areas.size()]))
        picture.parts[i].values = control.picture().parts[i].values;
    expect_like_explicit(std::move(picture), control.picture());
  }
}

EVALCTS_TEST(Pipeline, FogByDistance, kMust, "EV-PIPE-FOG")
(Test& t) {
  expect_fog(t,
             {{"no fog", fog(0)}, {"LINEAR", fog(GL_LINEAR)}, {"EXP", fog(GL_EXP)}, {"EXP2", fog(GL_EXP2)}});
};

EVALCTS_TEST(Pipeline, FogByCoordinate, kMust, "EV-PIPE-FOG")
(Test& t) {
  t.require(1, 4, "GL_EXT_fog_coord");
  std::vector<Stage> stages = {{"no fog", fog(0)}, {"LINEAR, by distance", fog(GL_LINEAR)}};
  for (const float coordinate : {1.0f, 1.75f, 3.0f}) {
    gl::Case state = fog(GL_LINEAR);
    state.Fogi(GL_FOG_COORD_SRC, GL_FOG_COORD);
    state.FogCoordf(coordinate);
    stages.push_back({fmt::format("LINEAR, fog coordinate {}", coordinate), std::move(state)});
  }
  expect_fog(t, stages);
};

// --- Flat shading ----------------------------------------------------------------------------------------

// Returns true if each segment of the mesh runs in the direction of an explicit one, or if feedback does not
// show it.
bool lines_run_as_specified(Test& t, const Drawing& drawing) {
  try {
    const Picture control = feedback(t, gl::control("directions of explicit lines"), {}, drawing.vertices);
    const Picture seen = feedback(t, "directions of evaluated lines", {}, drawing.evaluated);
    const std::vector<FeedbackPrimitive> known = primitives_of(control.parts[0]);
    return std::ranges::all_of(primitives_of(seen.parts[0]), [&](const FeedbackPrimitive& line) {
      return std::ranges::any_of(known, [&](const FeedbackPrimitive& other) {
        const auto same = [](const auto& a, const auto& b) { return alike({a[0], a[1]}, {b[0], b[1]}); };
        return std::ranges::equal(line.vertices, other.vertices, same);
      });
    });
  } catch (const NotObservable&) {
    return true;
  }
}

// Flat-shaded segments have the colour of their second vertex near both ends. A mesh whose lines run in
// other directions is not judged: its segments have other second vertices, and other tests judge that.
EVALCTS_TEST(Pipeline, FlatLines, kMust, "EV-PIPE-FLATLINE")
(Test& t) {
  gl::Case state;
  state.ShadeModel(GL_FLAT);
  constexpr int kOffEnds = 3;  // pixels
  for (const Drawing& drawing : meshes(t, GL_LINE_STRIP)) {
    std::vector<Area> areas;
    std::vector<std::array<double, 4>> colors;
    const auto add = [&](int x, int y, const std::array<double, 4>& color) {
      areas.push_back({x, y});
      colors.push_back(color);
    };
    for (int j = 0; j <= (drawing.two ? kRows : 0); ++j)
      for (int i = 0; i < kColumns; ++i)
        for (const int off : {kOffEnds, kWidth - kOffEnds})
          add(kLeft + kWidth * i + off, drawing.two ? kBottom + kHeight * j : kCurveRow,
              drawing.two ? patch_color_at(i + 1, j) : curve_color_at(i + 1));
    for (int i = 0; drawing.two && i <= kColumns; ++i)
      for (int j = 0; j < kRows; ++j)
        for (const int off : {kOffEnds, kHeight - kOffEnds})
          add(kLeft + kWidth * i, kBottom + kHeight * j + off, patch_color_at(i, j + 1));
    const Picture control =
        pixels(t, gl::control("explicit line strips, " + drawing.name), state, drawing.vertices, areas);
    for (std::size_t i = 0; i < colors.size(); ++i)
      if (!alike(control.parts[i].values, {colors[i].begin(), colors[i].end()}))
        throw NotObservable("pipeline: explicit segments do not have the colour of their second vertices");
    Picture picture = pixels(t, "evaluated, " + drawing.name, state, drawing.evaluated, areas);
    const bool same = std::ranges::equal(
        picture.parts, control.parts, [](const Part& a, const Part& b) { return alike(a.values, b.values); });
    if (!same && drawing.two && !lines_run_as_specified(t, drawing))
      throw NotObservable("the lines of EvalMesh2 run in other directions and have other second vertices");
    expect_like_explicit(std::move(picture), control);
  }
};

// --- Primitive restart -----------------------------------------------------------------------------------

// Primitive restart applies to elements of arrays and must not affect evaluated primitives, whatever its
// index.
EVALCTS_TEST(Pipeline, NoPrimitiveRestart, kMust, "EV-PIPE-NORESTART")
(Test& t) {
  t.require(3, 1);
  std::vector<Stage> stages(1);
  stages[0].name = "no restart";
  stages[0].state.Disable(GL_PRIMITIVE_RESTART);
  for (const GLuint index : {0u, 1u, 2u, 3u, 0xFFFFFFFFu}) {
    Stage& stage = stages.emplace_back();
    stage.name = fmt::format("restart index {}", index);
    stage.state.Enable(GL_PRIMITIVE_RESTART);
    stage.state.PrimitiveRestartIndex(index);
  }
  if (t.gl().at_least(4, 3)) {
    Stage& stage = stages.emplace_back();
    stage.name = "fixed restart index";
    stage.state.Enable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
  }
  const std::vector<Drawing> drawings = all_drawings(t);
  const auto is_as_without = [](const StagedPicture& picture, std::size_t stage, std::size_t drawing) {
    return !picture.has_effect(stage, drawing, kTolerance);
  };
  const StagedPicture control(t, gl::control("explicit vertices"), stages, drawings, Vertices::kExplicit);
  StagedPicture seen(t, "evaluated", stages, drawings, Vertices::kEvaluated);
  for (std::size_t stage = 0; stage < stages.size(); ++stage)
    for (std::size_t i = 0; i < drawings.size(); ++i) {
      const Part &part = seen.parts(stage, i)[0], &expected = control.parts(stage, i)[0];
      if (expected.values.empty() || !is_as_without(control, stage, i))
        throw NotObservable("pipeline: explicit vertices differ with primitive restart");
      if (stage == 0)
        expect_drawn_like_explicit(seen.picture().checked, drawings[i], part, expected);
      else
        seen.picture().checked.expect(
            is_as_without(seen, stage, i), part.shown,
            fmt::format("{}: the primitives differ from those without restart", part.name),
            fmt::format("the same {} values", seen.parts(0, i)[0].values.size()),
            fmt::format("{} different values", part.values.size()));
    }
};

}  // namespace
}  // namespace evalcts::suite_stages_of_meshes
