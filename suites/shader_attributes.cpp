// Section 8 of the requirements, values that only a vertex shader shows: attributes without maps, and generic
// attribute 0.
#include <fmt/format.h>

#include <evalcts/testkit/registration.h>

#include "maps.h"

namespace evalcts::suite_shader_attributes {
namespace {

constexpr std::size_t kVertices = 9;

// Enables all maps, so that a map that supplies the wrong attribute is noticed.
void enable_all_maps(Test& t, gl::Case& c) {
  for (const GLenum target : gl::kMap1Targets) define_and_enable(c, random_map(t, target, 3));
}

float argument(std::size_t vertex) { return static_cast<float>(vertex) / (kVertices - 1); }

void expect_count(Test& t, const gl::Case& c, const RecordedVaryings& recorded) {
  if (recorded.vertices == kVertices && !recorded.overflow) return;
  const std::string captured = std::to_string(recorded.vertices), expected = std::to_string(kVertices);
  t.fail(failure_of(c, "number of vertices",
                    fmt::format("number of vertices: {} instead of {}", captured, expected), expected,
                    captured));
}

// Secondary colour, fog coordinate and generic attributes have their current values at each evaluated vertex.
// The generic attributes are 6 and 7, which alias no conventional attribute.
EVALCTS_TEST(ShaderAttributes, WithoutMaps, kMust, "EV-ATTR-NOMAPS/1-D", by(gl::curve_deliveries()))
(Test& t) {
  t.require(3, 0);
  const VaryingShader shader = {
      "#version 120\nattribute vec4 six;\nattribute vec4 seven;\nvarying vec3 secondary;\nvarying float "
      "fog;\nvarying vec4 seen_six;\nvarying vec4 seen_seven;\nvoid main() {\n  secondary = "
      "gl_SecondaryColor.rgb;\n  fog = gl_FogCoord;\n  seen_six = six;\n  seen_seven = seven;\n  gl_Position "
      "= gl_Vertex;\n}\n",
      {"secondary", "fog", "seen_six", "seen_seven"},
      12,
      {{6, "six"}, {7, "seven"}}};
  const auto given = [](std::size_t vertex) {
    const float x = static_cast<float>(vertex) / 16;
    return std::vector<float>{x, 0.5f - x / 2, 0.25f, 3 + x, x, -x, 7, 2, 1 - x, 4, x / 2, -3};
  };
  const auto draw = [&](const gl::Identity& identity, bool evaluated) {
    gl::Case c(identity);
    enable_all_maps(t, c);
    c.Begin(GL_POINTS);
    for (std::size_t i = 0; i < kVertices; ++i) {
      const std::vector<float> values = given(i);
      c.SecondaryColor3f(values[0], values[1], values[2]);
      c.FogCoordf(values[3]);
      c.VertexAttrib4f(6, values[4], values[5], values[6], values[7]);
      c.VertexAttrib4f(7, values[8], values[9], values[10], values[11]);
      evaluated ? c.EvalCoord1f(argument(i)) : c.Vertex3f(argument(i), 0, 0);
    }
    c.End();
    return c;
  };
  const auto mismatch = [&](const RecordedVaryings& recorded) {
    for (std::size_t i = 0; i < recorded.vertices; ++i) {
      const std::vector<float> values = given(i);
      for (std::size_t k = 0; k < values.size(); ++k)
        if (recorded.values[i * values.size() + k] != values[k]) return std::pair{i, k};
    }
    return std::pair{kVertices, std::size_t{0}};
  };
  const RecordedVaryings control =
      t.record_varyings(draw(gl::control("explicit vertices"), false), shader, kVertices);
  if (control.vertices != kVertices || mismatch(control).first != kVertices)
    throw NotObservable("pipeline: these attributes do not reach the shader with explicit vertices, either");

  const gl::Case c = draw("evaluated, every map on", true);
  const RecordedVaryings recorded = t.record_varyings(c, shader, kVertices);
  expect_count(t, c, recorded);
  const auto [vertex, component] = mismatch(recorded);
  if (vertex == kVertices) return;
  const char* const names[] = {"secondary colour", "fog coordinate", "generic attribute 6",
                               "generic attribute 7"};
  const char* const name = names[component < 3 ? 0 : component < 4 ? 1 : component < 8 ? 2 : 3];
  const std::string expected = fmt::format("{}", given(vertex)[component]);
  const std::string captured = fmt::format("{}", recorded.values[vertex * 12 + component]);
  t.fail(failure_of(
      c, name,
      fmt::format("the {} of vertex {} is {}, the current value is {}", name, vertex, captured, expected),
      expected, captured));
};

// Generic attribute 0 is the position: the shader sees the same bits as in gl_Vertex.
EVALCTS_TEST(ShaderAttributes, GenericZero, kMust, "EV-ATTR-GENERIC0/1-D",
             combine((std::vector<GLenum>{GL_MAP1_VERTEX_3, GL_MAP1_VERTEX_4})).by(gl::curve_deliveries()))
(Test& t, GLenum target) {
  t.require(3, 0);
  const auto shader_with = [](const char* declaration, const char* source) {
    return VaryingShader{fmt::format("#version 120\n{}varying vec4 seen;\nvoid main() {{\n  seen = {};\n  "
                                     "gl_Position = vec4(0.0, 0.0, 0.0, 1.0);\n}}\n",
                                     declaration, source),
                         {"seen"},
                         4,
                         {}};
  };
  const VaryingShader conventional = shader_with("", "gl_Vertex");
  VaryingShader generic = shader_with("attribute vec4 zero;\n", "zero");
  generic.locations = {{0, "zero"}};

  const auto draw = [&](const gl::Identity& identity, bool evaluated) {
    gl::Case c(identity);
    c.Begin(GL_POINTS);
    for (std::size_t i = 0; i < kVertices; ++i)
      evaluated ? c.EvalCoord1f(argument(i)) : c.Vertex4f(argument(i), 2, 3, 4);
    c.End();
    return c;
  };
  const auto both = [&](const gl::Case& c) {
    return std::pair{t.record_varyings(c, conventional, kVertices), t.record_varyings(c, generic, kVertices)};
  };
  const auto [control, generic_control] = both(draw(gl::control("explicit vertices"), false));
  if (control.vertices != kVertices || control.values != generic_control.values)
    throw NotObservable("pipeline: generic attribute 0 is not the vertex with explicit vertices, either");

  gl::Case c("evaluated");
  define_and_enable(c, random_map(t, target, 5));
  c.append(draw("", true));
  const auto [seen, generic_seen] = both(c);
  expect_count(t, c, seen);
  expect_count(t, c, generic_seen);
  if (seen.values == generic_seen.values) return;
  t.fail(failure_of(c, "generic attribute 0",
                    "generic attribute 0 of an evaluated vertex is not its position",
                    "gl_Vertex, bit for bit", "other values"));
};

}  // namespace
}  // namespace evalcts::suite_shader_attributes
