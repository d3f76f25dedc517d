// Section 24 of the requirements: extensions that affect evaluators, if they are advertised, and rejection of
// their tokens if they are not.
#include <fmt/format.h>

#include <evalcts/judge/prediction.h>
#include <evalcts/testkit/registration.h>
#include "pictures.h"
#include "programs.h"
#include "rejection.h"

namespace evalcts::suite_extensions {
namespace {

bool has(Test& t, const char* extension) { return t.gl().extensions.contains(extension); }

// A target of an extension.
struct Foreign {
  const char* name;
  GLenum target;
  const char* extension;
};
constexpr Foreign kForeign[] = {{"VERTEX_ATTRIB0_4_NV_1", 0x8660, "GL_NV_vertex_program"},
                                {"VERTEX_ATTRIB15_4_NV_1", 0x866F, "GL_NV_vertex_program"},
                                {"VERTEX_ATTRIB0_4_NV_2", 0x8670, "GL_NV_vertex_program"},
                                {"TANGENT_1", 0x8444, "GL_EXT_coordinate_frame"},
                                {"NURBS", 0x81CB, "GL_SGIX_nurbs_eval"}};

EVALCTS_TEST(Extensions, UnknownTarget, kMust, "EV-EXT-UNKNOWN-TARGET", combine(kForeign))
(Test& t, const Foreign& foreign) {
  if (has(t, foreign.extension)) throw NotSupported(fmt::format("{} gives it a meaning", foreign.extension));
  const GLenum target = foreign.target;
  const std::vector<float> points(64, 0.5f);
  judge_rejected(t, "a token of an unsupported extension",
                 {[&](gl::Case& c) { c.Map1f(target, 0.0f, 1.0f, 4, 2, points); },
                  [&](gl::Case& c) { c.Map2f(target, 0.0f, 1.0f, 4, 2, 0.0f, 1.0f, 8, 2, points); },
                  [&](gl::Case& c) { c.GetMapfv(target, GL_ORDER, gl::out<GLfloat>(4)); },
                  [&](gl::Case& c) { c.Enable(target); }, [&](gl::Case& c) { c.Disable(target); },
                  [&](gl::Case& c) { c.IsEnabled(target); }});
};

// --- ARB_vertex_program ------------------------------------------------------------------------------------

void use_program(gl::Case& c, const std::string& body) {
  load_assembly(c, GL_VERTEX_PROGRAM_ARB, 1,
                "!!ARBvp1.0\nMOV result.position, vertex.position;\n" + body + "END\n");
  c.Enable(GL_VERTEX_PROGRAM_ARB);
}

using Color = std::array<float, 4>;

// Draws points of a curve with maps of position, colour, normal and texture coordinates in feedback mode,
// calls `before` before each vertex, and expects these colours. Throws NotObservable if explicit vertices
// have others.
void expect_colors(Test& t, const gl::Case& state, const std::vector<Color>& colors,
                   const std::function<void(gl::Case&, std::size_t)>& before) {
  gl::Case maps;
  define(maps,
         make_map1(GL_MAP1_VERTEX_4, {-0.5, -0.25, -0.5, 1, 0.25, 0.75, 0.25, 1.25, 0.75, -0.5, 0.5, 1}));
  define(maps, make_map1(GL_MAP1_COLOR_4, {0.125, 0.875, 0.25, 1, 0.75, 0.25, 1, 0.5}));
  define(maps, make_map1(GL_MAP1_NORMAL, {0.6, 0, 0.8, -0.28, 0.96, 0}));
  define(maps, make_map1(GL_MAP1_TEXTURE_COORD_4, {0, 1, 0.5, 1, 1, 0.25, -0.5, 2}));
  for (const GLenum target : kKinds1[1].targets) maps.Enable(target);
  const auto draw = [&](bool evaluated) {
    gl::Case c = maps;
    c.Begin(GL_POINTS);
    for (std::size_t i = 0; i < colors.size(); ++i) {
      before(c, i);
      if (evaluated) {
        c.EvalCoord1f(static_cast<float>(i) / 4);
      } else {
        c.Color4f(0.25f, 0.5f, 0.75f, 1);
        c.Vertex4f(0.25f, 0.125f * static_cast<float>(i), 0, 1);
      }
    }
    c.End();
    return c;
  };
  const auto wrong = [&](const Part& part) -> std::string {
    const std::vector<FeedbackPrimitive> points = primitives_of(part);
    if (points.size() != colors.size())
      return fmt::format("{} points instead of {}", points.size(), colors.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t k = 0; k < 4; ++k) {
        const double seen = points[i].vertices.at(0)[4 + k];
        if (std::abs(seen - colors[i][k]) > kTolerance)
          return fmt::format("component {} of the colour of point {} is {}", k, i, seen);
      }
    return {};
  };
  const Picture control = feedback(t, gl::control("explicit vertices"), state, draw(false));
  if (const std::string why = wrong(control.parts.at(0)); !why.empty())
    throw NotObservable("pipeline: with explicit vertices " + why);
  Picture picture = feedback(t, "evaluated", state, draw(true));
  const std::string why = wrong(picture.parts.at(0));
  picture.checked.expect(why.empty(), picture.parts.at(0).shown, why, "the output of the program", why);
}

EVALCTS_TEST(VertexPrograms, Run, kMust, "EV-EXT-ARBVP-RUN")
(Test& t) {
  require_extension(t, "GL_ARB_vertex_program");
  gl::Case state;
  use_program(state, "MOV result.color, {0.75, 0.25, 0.5, 0.125};\n");
  expect_colors(t, state, std::vector<Color>(5, Color{0.75f, 0.25f, 0.5f, 0.125f}),
                [](gl::Case&, std::size_t) {});
};

// Generic attribute 6, which aliases no conventional attribute, has its current value at each evaluated
// vertex.
EVALCTS_TEST(VertexPrograms, NoGenericMaps, kMust, "EV-EXT-ARBVP-NOGENERIC")
(Test& t) {
  require_extension(t, "GL_ARB_vertex_program");
  gl::Case state;
  use_program(state, "MOV result.color, vertex.attrib[6];\n");
  std::vector<Color> colors;
  for (int i = 0; i < 5; ++i)
    colors.push_back({0.125f * static_cast<float>(i), 0.75f, 1 - 0.125f * static_cast<float>(i), 0.5f});
  expect_colors(t, state, colors, [&](gl::Case& c, std::size_t i) {
    c.VertexAttrib4f(6, colors[i][0], colors[i][1], colors[i][2], colors[i][3]);
  });
};

}  // namespace
}  // namespace evalcts::suite_extensions
