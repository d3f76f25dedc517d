// Section 16 of the requirements, the pipeline after evaluation: meshes with polygon modes, culling, polygon
// offset, flat shading and two-sided lighting. The same strips of explicit vertices are the control. See
// mesh_stippling.cpp for line stippling.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include <evalcts/judge/prediction.h>
#include <evalcts/testkit/registration.h>
#include "drawings.h"
#include "grid_cases.h"
#include "stages.h"

namespace evalcts::suite_mesh_pipeline {
namespace {

// --- The patch -------------------------------------------------------------------------------------------

// The patch has 3 by 2 quads of 16 by 24 pixels in the plane z = 0. Vertex (i, j) has the window coordinates
// (8 + 16 i, 8 + 24 j), with u along +x and v along +y. In the mirrored patch u is along +y and v along +x.
constexpr int kColumns = 3, kRows = 2;
constexpr int kLeft = 8, kBottom = 8, kWidth = 16, kHeight = 24;

// Returns the colour of vertex (i, j). No colour is black, and neighbours differ clearly.
std::array<double, 4> color_at(int i, int j) {
  return {0.1 + 0.9 * i / kColumns, 0.2 + 0.8 * j / kRows, 0.5, 1};
}

void define_patch(gl::Case& c, bool mirrored = false) {
  const double left = at_pixel(kLeft), right = at_pixel(kLeft + kWidth * kColumns);
  const double bottom = at_pixel(kBottom), top = at_pixel(kBottom + kHeight * kRows);
  // The order of points is R_00, R_01, R_10, R_11.
  define(c, mirrored ? make_map2(GL_MAP2_VERTEX_3, 2, 2,
                                 {left, bottom, 0, right, bottom, 0, left, top, 0, right, top, 0})
                     : make_map2(GL_MAP2_VERTEX_3, 2, 2,
                                 {left, bottom, 0, left, top, 0, right, bottom, 0, right, top, 0}));
  std::vector<double> colors;
  for (const int i : {0, kColumns})
    for (const int j : {0, kRows})
      for (const double value : color_at(i, j)) colors.push_back(value);
  define(c, make_map2(GL_MAP2_COLOR_4, 2, 2, colors));
  c.Enable(GL_MAP2_VERTEX_3);
  c.Enable(GL_MAP2_COLOR_4);
  if (mirrored) {
    map_grid(c, {kRows, 0, 1}, {kColumns, 0, 1});
  } else {
    map_grid(c, {kColumns, 0, 1}, {kRows, 0, 1});
  }
}

gl::Case mesh(GLenum mode, bool mirrored = false) {
  gl::Case c;
  define_patch(c, mirrored);
  c.EvalMesh2(mode, 0, mirrored ? kRows : kColumns, 0, mirrored ? kColumns : kRows);
  return c;
}

gl::Case explicit_strips(Test& t, const gl::Case& evaluated) {
  return without_edge_flags(explicit_commands(t, evaluated));
}

// --- Where to look ---------------------------------------------------------------------------------------

template <class Action>
void for_each_quad(Action action) {
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kColumns; ++i) action(i, j);
}

constexpr std::size_t kSamples = 4;
// Returns four pixels in each quad, two in each half, whichever diagonal splits it.
std::vector<Area> samples_in_halves() {
  std::vector<Area> areas;
  for_each_quad([&](int i, int j) {
    const int x = kLeft + kWidth * i, y = kBottom + kHeight * j;
    for (const auto& [dx, dy] : {std::pair{8, 4}, {13, 12}, {8, 19}, {3, 12}})
      areas.push_back({x + dx, y + dy});
  });
  return areas;
}

// --- What feedback shows ---------------------------------------------------------------------------------

// Window coordinates, rounded to integers: all vertices of the patch have integer coordinates.
using Point = std::pair<long, long>;
using Edge = std::pair<Point, Point>;  // the smaller point first

Point point_of(const std::array<double, 12>& vertex) {
  const auto whole = [](double value) { return std::lround(std::clamp(value, -1e6, 1e6)); };
  return {whole(vertex[0]), whole(vertex[1])};
}

Edge edge_of(const Point& a, const Point& b) { return {std::min(a, b), std::max(a, b)}; }

// The primitives in the feedback of filled quads: lines, points and polygons, depending on the polygon mode.
struct Outlines {
  std::multiset<Edge> edges;
  std::multiset<Point> points;
  std::set<Point> corners;  // corners of polygons
  std::size_t polygons = 0;

  friend bool operator==(const Outlines&, const Outlines&) = default;
};

Outlines outlines_of(const Part& part) {
  Outlines outlines;
  for (const FeedbackPrimitive& primitive : primitives_of(part)) {
    if (primitive.token == GL_POINT_TOKEN) {
      outlines.points.insert(point_of(primitive.vertices[0]));
    } else if (primitive.token == GL_POLYGON_TOKEN) {
      ++outlines.polygons;
      for (const auto& vertex : primitive.vertices) outlines.corners.insert(point_of(vertex));
    } else {
      outlines.edges.insert(edge_of(point_of(primitive.vertices[0]), point_of(primitive.vertices[1])));
    }
  }
  return outlines;
}

// Returns the outlines of all quads of the patch in the polygon mode: the four edges of each quad, or, in
// POINT, a point for each edge that begins there.
Outlines outlines_of_quads(GLenum polygon_mode) {
  Outlines outlines;
  for_each_quad([&](int i, int j) {
    const long left = kLeft + kWidth * i, right = left + kWidth;
    const long bottom = kBottom + kHeight * j, top = bottom + kHeight;
    const Point corners[] = {{left, bottom}, {left, top}, {right, top}, {right, bottom}};
    for (std::size_t k = 0; k < 4; ++k) {
      if (polygon_mode == GL_POINT) {
        outlines.points.insert(corners[k]);
      } else {
        outlines.edges.insert(edge_of(corners[k], corners[(k + 1) % 4]));
      }
    }
  });
  return outlines;
}

std::string describe(const Outlines& outlines) {
  const auto diagonals = std::ranges::count_if(outlines.edges, [](const Edge& edge) {
    return edge.first.first != edge.second.first && edge.first.second != edge.second.second;
  });
  std::string text = fmt::format("{} edges", outlines.edges.size());
  if (diagonals) text += fmt::format(" ({} of them diagonals)", diagonals);
  return text + fmt::format(", {} points, {} polygons", outlines.points.size(), outlines.polygons);
}

void expect_outlines(Picture& picture, const Part& part, bool holds, const Outlines& expected) {
  const std::string seen = describe(outlines_of(part));
  picture.checked.expect(holds, part.shown,
                         fmt::format("a FILL mesh comes out as {}, explicit quad strips as {} ({})", seen,
                                     describe(expected), part.name),
                         describe(expected), seen);
}

constexpr GLenum kOutlined[] = {GL_POINT, GL_LINE};

gl::Case polygon_mode(GLenum mode) {
  gl::Case state;
  state.PolygonMode(GL_FRONT_AND_BACK, mode);
  return state;
}

// Adds scenes of the drawing in polygon modes POINT and LINE, with the edge flag.
void add_outlined(std::vector<Scene>& scenes, bool flag, const gl::Case& drawing) {
  for (const GLenum outlined : kOutlined) {
    gl::Case state = polygon_mode(outlined);
    state.EdgeFlag(static_cast<GLboolean>(flag));
    scenes.emplace_back(
        fmt::format("polygon mode {}, edge flag {}", label(outlined), flag ? "TRUE" : "FALSE"), state,
        drawing);
  }
}

// Throws NotObservable unless explicit quad strips are outlined as quads.
void require_quads(const Picture& control) {
  for (std::size_t i = 0; i < control.parts.size(); ++i)
    if (outlines_of(control.parts[i]) != outlines_of_quads(kOutlined[i % 2]))
      throw NotObservable("pipeline: explicit quad strips are not drawn as the edges or corners of quads");
}

// Returns the feedback of a mesh in polygon modes POINT and LINE, with each of the edge flags. Throws
// NotObservable.
Picture outlined_meshes(Test& t, std::initializer_list<bool> flags) {
  std::vector<Scene> strips, evaluated;
  for (const bool flag : flags) {
    add_outlined(strips, flag, explicit_strips(t, mesh(GL_FILL)));
    add_outlined(evaluated, flag, mesh(GL_FILL));
  }
  require_quads(feedback(t, gl::control("explicit quad strips"), strips));
  return feedback(t, "evaluated", evaluated);
}

// --- Quads -----------------------------------------------------------------------------------------------

// Each quad of a mesh has its four edges and no diagonal; in POINT, it has a point where each edge begins.
EVALCTS_TEST(Mesh2, FillIsQuads, kMust, "EV-MESH2-ISQUADS")
(Test& t) {
  Picture picture = outlined_meshes(t, {true});
  for (std::size_t i = 0; i < picture.parts.size(); ++i) {
    const Outlines quads = outlines_of_quads(kOutlined[i]);
    expect_outlines(picture, picture.parts[i], outlines_of(picture.parts[i]) == quads, quads);
  }
};

// All edges of quad strips are boundary edges, whatever the edge flag. FillIsQuads judges additional edges.
EVALCTS_TEST(Mesh2, EdgeFlagHasNoInfluence, kMust, "EV-MESH2-EDGEFLAG")
(Test& t) {
  Picture picture = outlined_meshes(t, {true, false});
  for (std::size_t i = 0; i < picture.parts.size(); ++i) {
    const Part& part = picture.parts[i];
    const Outlines seen = outlines_of(part), with = outlines_of(picture.parts[i % 2]);
    const Outlines quads = outlines_of_quads(kOutlined[i % 2]);
    const bool has_all =
        std::ranges::includes(seen.edges, quads.edges) && std::ranges::includes(seen.points, quads.points);
    expect_outlines(picture, part, has_all, quads);
    picture.checked.expect(seen == with, part.shown,
                           fmt::format("a FILL mesh comes out as {} with edge flag FALSE, as {} with TRUE",
                                       describe(seen), describe(with)),
                           describe(with), describe(seen));
  }
};

EVALCTS_TEST(Mesh2, NoDiagonals, kMust, "EV-MESH2-ISQUADS")
(Test& t) {
  const gl::Case state = polygon_mode(GL_LINE);
  // Both diagonals of a quad cross its centre.
  std::vector<Area> areas;
  for_each_quad([&](int i, int j) {
    const int x = kLeft + kWidth * i, y = kBottom + kHeight * j;
    areas.push_back({x + kWidth / 2 - 2, y + kHeight / 2 - 2, 4, 4});
    areas.push_back({x - 1, y + kHeight / 2, 3, 3});
    areas.push_back({x + kWidth / 2, y - 1, 3, 3});
  });
  const auto is_edge = [](std::size_t part) { return part % 3 != 0; };
  const Picture control =
      pixels(t, gl::control("explicit quad strips"), state, explicit_strips(t, mesh(GL_FILL)), areas, GL_RED);
  for (std::size_t i = 0; i < areas.size(); ++i)
    if (lit(control.parts[i]) != is_edge(i))
      throw NotObservable("pipeline: explicit quad strips do not show their edges and nothing else");
  Picture picture = pixels(t, "evaluated", state, mesh(GL_FILL), areas, GL_RED);
  show_pixels(picture, control.parts);
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const Part& part = picture.parts[i];
    const char* const where = is_edge(i) ? "on an edge of a quad" : "in the middle of a quad";
    picture.checked.expect(lit(part) == is_edge(i), part.shown,
                           fmt::format("{}, {}, is {}", part.name, where, lit(part) ? "drawn" : "not drawn"),
                           is_edge(i) ? "drawn" : "not drawn", lit(part) ? "drawn" : "not drawn");
  }
};

// Non-planar quads may be split in any way, but their corners are the vertices of the mesh and their centres
// are covered.
EVALCTS_TEST(Mesh2, NonPlanarQuads, kQuality, "EV-MESH2-PLANAR")
(Test& t) {
  // The same x and y as the patch, with values of z that twist the quads.
  const double left = at_pixel(kLeft), right = at_pixel(kLeft + kWidth * kColumns);
  const double bottom = at_pixel(kBottom), top = at_pixel(kBottom + kHeight * kRows);
  gl::Case twisted;
  define_patch(twisted);
  define(twisted, make_map2(GL_MAP2_VERTEX_3, 2, 2,
                            {left, bottom, -0.75, left, top, 0.75, right, bottom, 0.75, right, top, -0.75}));
  twisted.EvalMesh2(GL_FILL, 0, kColumns, 0, kRows);
  const gl::Case strips = explicit_strips(t, twisted);

  const Outlines expected = outlines_of(feedback(t, gl::control("vertices"), {}, strips).parts[0]);
  if (expected.corners.size() != (kColumns + 1) * (kRows + 1))
    throw NotObservable("pipeline: explicit quad strips are not drawn completely");
  Picture polygons = feedback(t, "vertices", {}, twisted);
  expect_outlines(polygons, polygons.parts[0], outlines_of(polygons.parts[0]).corners == expected.corners,
                  expected);

  std::vector<Area> middles;
  for_each_quad([&](int i, int j) {
    middles.push_back({kLeft + kWidth * i + kWidth / 2, kBottom + kHeight * j + kHeight / 2});
  });
  const Picture control = pixels(t, gl::control("middles of the quads"), {}, strips, middles);
  Picture picture = pixels(t, "middles of the quads", {}, twisted, middles);
  show_pixels(picture, control.parts);
  for (std::size_t i = 0; i < middles.size(); ++i) {
    if (!lit(control.parts[i]))
      throw NotObservable("pipeline: explicit quad strips are not drawn completely");
    const Part& part = picture.parts[i];
    picture.checked.expect(lit(part), part.shown,
                           fmt::format("{}, in the middle of a quad, is not drawn", part.name), "drawn",
                           "not drawn");
  }
};

// --- Flat shading ----------------------------------------------------------------------------------------

// Expects each quad to have one colour: that of the vertex (i, j) if `first_vertex`, otherwise of (i + 1, j +
// 1).
void expect_flat(Test& t, const gl::Case& state, bool first_vertex) {
  const std::vector<Area> areas = samples_in_halves();
  const Picture control =
      pixels(t, gl::control("explicit quad strips"), state, explicit_strips(t, mesh(GL_FILL)), areas);
  std::size_t sample = 0;
  for_each_quad([&](int i, int j) {
    const auto color = first_vertex ? color_at(i, j) : color_at(i + 1, j + 1);
    for (std::size_t k = 0; k < kSamples; ++k)
      if (!alike(control.parts[sample++].values, {color.begin(), color.end()}))
        throw NotObservable("pipeline: explicit quads do not have the colour of their provoking vertex");
  });
  expect_like_explicit(pixels(t, "evaluated", state, mesh(GL_FILL), areas), control);
}

EVALCTS_TEST(Mesh2, FlatShading, kMust, "EV-MESH2-FLAT")
(Test& t) {
  gl::Case state;
  state.ShadeModel(GL_FLAT);
  expect_flat(t, state, false);
};

EVALCTS_TEST(Mesh2, FlatShadingByTheFirstVertex, kMust, "EV-MESH2-FLAT-FIRST")
(Test& t) {
  t.require(3, 2, "GL_ARB_provoking_vertex");
  gl::Case question(gl::control("whether quads follow"));
  const gl::Ref follow = question.GetIntegerv(GL_QUADS_FOLLOW_PROVOKING_VERTEX_CONVENTION, gl::out<GLint>(1));
  const bool quads_follow = t.play(question).trace().values<GLint>(follow)[0] != 0;
  gl::Case state;
  state.ShadeModel(GL_FLAT);
  state.ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
  expect_flat(t, state, quads_follow);
};

// --- Facing ----------------------------------------------------------------------------------------------

// A state in which the patch is drawn, and the expected result: whether its pixels are drawn, and their
// colour.
struct Facing {
  std::string name;
  bool mirrored;
  gl::Case state;
  bool drawn;
  std::vector<double> color;  // empty if any colour is accepted
};

void expect_facings(Test& t, const std::vector<Facing>& facings, bool automatic_normals,
                    const char* not_observable) {
  const std::vector<Area> areas = samples_in_halves();
  std::vector<Scene> evaluated, strips;
  for (const Facing& facing : facings) {
    gl::Case drawing;
    if (automatic_normals) drawing.Enable(GL_AUTO_NORMAL);
    drawing.append(mesh(GL_FILL, facing.mirrored));
    evaluated.emplace_back(facing.name, facing.state, drawing);
    strips.emplace_back(facing.name, facing.state, explicit_strips(t, drawing));
  }
  const Picture control = pixels(t, gl::control("explicit quad strips"), strips, areas);
  for (std::size_t i = 0; i < control.parts.size(); ++i) {
    const Part& part = control.parts[i];
    const Facing& facing = facings[i / areas.size()];
    const bool right_color = facing.color.empty() || alike(part.values, facing.color);
    if (lit(part) != facing.drawn || !right_color) throw NotObservable(not_observable);
  }
  expect_like_explicit(pixels(t, "evaluated", evaluated, areas), control);
}

// The quads run (i,j), (i,j+1), (i+1,j+1), (i+1,j): clockwise, with u along +x and v along +y.
EVALCTS_TEST(Mesh2, Winding, kMust, "EV-MESH2-WINDING")
(Test& t) {
  std::vector<Facing> facings;
  for (const GLenum front : {GL_CCW, GL_CW})
    for (const GLenum culled : {GL_BACK, GL_FRONT})
      for (const bool mirrored : {false, true}) {
        const GLenum facing = (front == GL_CW) != mirrored ? GL_FRONT : GL_BACK;
        gl::Case state;
        state.Enable(GL_CULL_FACE);
        // The first scene is drawn with the initial values.
        if (!facings.empty()) {
          state.FrontFace(front);
          state.CullFace(culled);
        }
        facings.push_back(
            {fmt::format("{}, front faces {}, {} faces culled", mirrored ? "u along +y" : "u along +x",
                         front == GL_CCW ? "CCW" : "CW", culled == GL_BACK ? "back" : "front"),
             mirrored,
             state,
             facing != culled,
             {}});
      }
  expect_facings(t, facings, false, "pipeline: explicit quad strips are culled otherwise");
};

// The facets of the patch are back-facing although their generated normals point to the viewer, so they are
// lit with the back material and reversed normals. The mirrored patch is lit with the front material and its
// normals.
EVALCTS_TEST(Mesh2, TwoSidedLighting, kMust, "EV-MESH2-TWOSIDE")
(Test& t) {
  using Values = std::vector<float>;
  std::vector<Facing> facings;
  for (const bool mirrored : {false, true})
    for (const bool from_behind : {false, true}) {
      gl::Case state;
      state.Enable(GL_LIGHTING);
      state.Enable(GL_LIGHT0);
      state.Lightfv(GL_LIGHT0, GL_POSITION, Values{0, 0, from_behind ? -1.0f : 1.0f, 0});
      state.LightModelfv(GL_LIGHT_MODEL_AMBIENT, Values{0, 0, 0, 1});
      state.LightModelfv(GL_LIGHT_MODEL_TWO_SIDE, Values{1});
      state.Materialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, Values{0, 0.5f, 0, 1});
      state.Materialfv(GL_FRONT, GL_EMISSION, Values{0.75f, 0, 0, 1});
      state.Materialfv(GL_BACK, GL_EMISSION, Values{0, 0, 0.75f, 1});
      facings.push_back({fmt::format("{}, light from {}", mirrored ? "u along +y" : "u along +x",
                                     from_behind ? "behind" : "the viewer"),
                         mirrored,
                         state,
                         true,
                         {mirrored ? 0.75 : 0, from_behind ? 0.5 : 0, mirrored ? 0 : 0.75, 1}});
    }
  expect_facings(t, facings, true, "pipeline: explicit quad strips are not lit on two sides");
};

// --- Stages for polygons only ----------------------------------------------------------------------------

// A stage that affects polygons, but not points and lines.
struct OfPolygons {
  const char* name;
  void (*set)(gl::Case&);
};
constexpr OfPolygons kModesAndCulling[] = {
    {"polygon mode POINT", [](gl::Case& c) { c.PolygonMode(GL_FRONT_AND_BACK, GL_POINT); }},
    {"polygon mode LINE", [](gl::Case& c) { c.PolygonMode(GL_FRONT_AND_BACK, GL_LINE); }},
    // The patch is back-facing.
    {"polygon mode LINE of back faces", [](gl::Case& c) { c.PolygonMode(GL_BACK, GL_LINE); }},
    {"culling", [](gl::Case& c) {
       c.CullFace(GL_FRONT_AND_BACK);
       c.Enable(GL_CULL_FACE);
     }}};
constexpr OfPolygons kOffset[] = {
    {"polygon offset", [](gl::Case& c) {
       for (const GLenum offset : {GL_POLYGON_OFFSET_POINT, GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_FILL})
         c.Enable(offset);
       c.PolygonOffset(0.0f, -0x1p21f);  // with 24 bits, an eighth of the depth range or more
     }}};

// Stages, and whether their effect is visible in depth values or in feedback, which polygon offset does not
// affect.
struct Stages {
  const char* name;
  bool in_depth;
  std::span<const OfPolygons> stages;
};
constexpr Stages kStages[] = {{"MODE_AND_CULLING", false, kModesAndCulling}, {"OFFSET", true, kOffset}};

std::vector<Stage> stages_of(const Stages& kind) {
  gl::Case plain;
  plain.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  plain.Disable(GL_CULL_FACE);
  if (kind.in_depth) {
    plain.Enable(GL_DEPTH_TEST);
    plain.PointSize(4.0f);
  }
  std::vector<Stage> stages = {{"no stage", plain}};
  for (const OfPolygons& of_polygons : kind.stages) {
    stages.push_back({of_polygons.name, plain});
    of_polygons.set(stages.back().state);
  }
  return stages;
}

// Returns feedback, or depths at the vertices, on the edges and in the centres of quads.
View view_of(const Stages& kind) {
  View view{.format = GL_DEPTH_COMPONENT};
  for_each_quad([&](int i, int j) {
    for (const int dx : {-1, kWidth / 2})
      for (const int dy : {-1, kHeight / 2})
        if (kind.in_depth) view.areas.push_back({kLeft + kWidth * i + dx, kBottom + kHeight * j + dy, 2, 2});
  });
  return view;
}

EVALCTS_TEST(Mesh2, LinesAndPointsAreNoPolygons, kMust, "EV-MESH2-NOPOLYMODE", combine(kStages))
(Test& t, const Stages& kind) {
  const std::vector<Stage> stages = stages_of(kind);
  const View view = view_of(kind);
  std::vector<Drawing> drawings = {drawing(t, "POINT", true, GL_POINTS, mesh(GL_POINT)),
                                   drawing(t, "LINE", true, GL_LINE_STRIP, mesh(GL_LINE)),
                                   drawing(t, "FILL", true, GL_QUAD_STRIP, mesh(GL_FILL))};
  const StagedPicture control(t, gl::control("explicit vertices"), stages, drawings, Vertices::kExplicit,
                              view);
  for (std::size_t stage = 1; stage < stages.size(); ++stage) {
    if (!control.has_effect(stage, 2, kEffect))
      throw NotObservable("pipeline: the stage does not show with explicit polygons");
    if (control.has_effect(stage, 0, kTolerance) || control.has_effect(stage, 1, kTolerance))
      throw NotObservable("pipeline: explicit points and lines change like polygons");
  }
  drawings.pop_back();
  StagedPicture seen(t, "evaluated", stages, drawings, Vertices::kEvaluated, view);
  for (std::size_t stage = 0; stage < stages.size(); ++stage)
    for (const std::size_t i : {0u, 1u})
      for (std::size_t k = 0; k < seen.parts(stage, i).size(); ++k) {
        const Part &part = seen.parts(stage, i)[k], &expected = control.parts(stage, i)[k];
        if (kind.in_depth)
          expect_like_explicit(seen.picture().checked, part, expected);
        else
          expect_mesh_like_explicit(seen.picture().checked, part, expected);
      }
};

// Expects primitives of the same kinds at the same places as explicit quads in feedback; FillIsQuads judges
// their number.
EVALCTS_TEST(Mesh2, FillsArePolygons, kMust, "EV-MESH2-NOPOLYMODE", combine(kStages))
(Test& t, const Stages& kind) {
  const std::vector<Stage> stages = stages_of(kind);
  const View view = view_of(kind);
  const std::vector<Drawing> drawings = {drawing(t, "FILL", true, GL_QUAD_STRIP, mesh(GL_FILL))};
  const StagedPicture control(t, gl::control("explicit quad strips"), stages, drawings, Vertices::kExplicit,
                              view);
  for (std::size_t stage = 1; stage < stages.size(); ++stage)
    if (!control.has_effect(stage, 0, kEffect))  // culling leaves nothing
      throw NotObservable("pipeline: the stage does not show with explicit polygons");
  StagedPicture seen(t, "evaluated", stages, drawings, Vertices::kEvaluated, view);
  const auto places = [](const std::multiset<Point>& points) {
    return std::set<Point>(points.begin(), points.end());
  };
  for (std::size_t i = 0; i < seen.picture().parts.size(); ++i) {
    const Part &part = seen.picture().parts[i], &of_control = control.picture().parts[i];
    if (kind.in_depth) {
      expect_like_explicit(seen.picture().checked, part, of_control);
      continue;
    }
    const Outlines outlines = outlines_of(part), expected = outlines_of(of_control);
    const bool holds = places(outlines.points) == places(expected.points) &&
                       std::ranges::includes(outlines.edges, expected.edges) &&
                       outlines.edges.empty() == expected.edges.empty() &&
                       outlines.corners == expected.corners;
    expect_outlines(seen.picture(), part, holds, expected);
  }
};

}  // namespace
}  // namespace evalcts::suite_mesh_pipeline
