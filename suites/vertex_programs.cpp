// Section 22 of the requirements: vertex shaders and vertex programs run for each evaluated vertex, with
// evaluated values in the built-in attributes that have maps and current values in the others.
#include <fmt/format.h>

#include <algorithm>

#include <evalcts/testkit/registration.h>

#include "drawings.h"
#include "programs.h"

namespace evalcts::suite_vertex_programs {
namespace {

// A shader and a vertex program whose outputs depend on all conventional attributes. Positions stay within
// the view volume.
constexpr char kShader[] = R"(void main() {
  gl_Position = vec4(0.75 * gl_Vertex.xy + 0.125 * gl_Normal.yx, 0.5 * gl_Vertex.z, gl_Vertex.w);
  gl_FrontColor = 0.5 * gl_Color.bgra + vec4(0.25 * gl_Normal, 0.25) + 0.25 * vec4(gl_SecondaryColor.rgb, 0.0);
  gl_BackColor = gl_FrontColor;
  gl_TexCoord[0] = 2.0 * gl_MultiTexCoord0 - gl_MultiTexCoord1.wzyx + gl_Vertex.zxyw + vec4(gl_FogCoord);
}
)";
constexpr char kAssembly[] = R"(!!ARBvp1.0
PARAM k = { 0.75, 0.125, 0.5, 0.25 };
TEMP t;
MUL t, vertex.position, k.xxzw;
MOV t.w, vertex.position.w;
MAD t.xy, vertex.normal.yxzw, k.yyyy, t;
MOV result.position, t;
MUL t, vertex.color.zyxw, k.z;
MAD t.xyz, vertex.normal, k.w, t;
ADD t.w, t.w, k.w;
MAD t.xyz, vertex.color.secondary, k.w, t;
MOV result.color, t;
ADD t, vertex.texcoord[0], vertex.texcoord[0];
SUB t, t, vertex.texcoord[1].wzyx;
ADD t, t, vertex.position.zxyw;
ADD result.texcoord[0], t, vertex.fogcoord.x;
END
)";

// Sets current values of attributes without maps.
void set_values_without_maps(gl::Case& c) {
  c.SecondaryColor3f(0.25f, 0.75f, 0.5f);
  c.FogCoordf(0.625f);
  c.MultiTexCoord4f(GL_TEXTURE1, 0.5f, -0.25f, 0.125f, 1.5f);
}

constexpr NamedValue<bool> kKinds[] = {{"SHADER", false}, {"ASSEMBLY", true}};

Picture look(Test& t, const NamedValue<bool>& kind, const gl::Identity& identity,
             const std::vector<Drawing>& drawings, bool evaluated, bool with_program = true) {
  gl::Case state;
  set_up_texture(state);
  set_values_without_maps(state);
  Program program;
  if (with_program && kind.value) {
    load_assembly(state, GL_VERTEX_PROGRAM_ARB, 1, kAssembly);
    state.Enable(GL_VERTEX_PROGRAM_ARB);
  } else if (with_program) {
    program = link_program(state, {{GL_VERTEX_SHADER, kShader}});
    state.UseProgram(program.name);
  }
  std::vector<Scene> scenes = {{"the program alone", state}};
  for (Scene& scene : scenes_of(drawings, evaluated)) scenes.push_back(std::move(scene));
  Picture picture = feedback(t, identity, scenes);
  picture.parts.erase(picture.parts.begin());
  return picture;
}

EVALCTS_TEST(Pipeline, VertexPrograms, kMust, "EV-PIPE-VS", combine(kKinds))
(Test& t, const NamedValue<bool>& kind) {
  kind.value ? require_extension(t, "GL_ARB_vertex_program") : t.require(2, 0);
  const std::vector<Drawing> drawings = all_drawings(t);
  const Picture control = look(t, kind, gl::control("explicit vertices"), drawings, false);
  const Picture without = look(t, kind, gl::control("explicit vertices, no program"), drawings, false, false);
  for (std::size_t i = 0; i < drawings.size(); ++i)
    require_an_effect(control.parts[i].values, without.parts[i].values);
  Picture picture = look(t, kind, "evaluated", drawings, true);
  expect_drawn_like_explicit(picture, drawings, control);
};

constexpr std::size_t kFloats = 4 * 4 + 3 + 3 + 1;
const VaryingShader kEachAttribute = {
    "varying vec4 twice_position;\nvarying vec4 swapped_color;\nvarying vec4 texture_sum;\nvarying vec4 "
    "unit_one;\nvarying vec3 turned_normal;\nvarying vec3 secondary;\nvarying float fog;\nvoid main() {\n  "
    "twice_position = 2.0 * gl_Vertex;\n  swapped_color = gl_Color.bgra;\n  texture_sum = gl_MultiTexCoord0 "
    "+ vec4(1.0, 2.0, 3.0, 4.0);\n  unit_one = -gl_MultiTexCoord1;\n  turned_normal = gl_Normal.yzx;\n  "
    "secondary = gl_SecondaryColor.rgb;\n  fog = gl_FogCoord;\n  gl_Position = gl_Vertex;\n}\n",
    {"twice_position", "swapped_color", "texture_sum", "unit_one", "turned_normal", "secondary", "fog"},
    kFloats};

// Returns the outputs of kEachAttribute for a vertex.
std::vector<float> expected_of(const reference::Vertex& vertex) {
  const auto at = [](const reference::Component& component) { return reference::rounded(component); };
  const std::array<float, 3> normal = reference::rounded(vertex.normal);
  const auto& p = vertex.position;
  const auto& c = vertex.color;
  const auto& s = vertex.texture_coordinate[0];
  return {2 * at(p[0]), 2 * at(p[1]), 2 * at(p[2]), 2 * at(p[3]), at(c[2]), at(c[1]), at(c[0]), at(c[3]),
          at(s[0]) + 1, at(s[1]) + 2, at(s[2]) + 3, at(s[3]) + 4, -0.5f,    0.25f,    -0.125f,  -1.5f,
          normal[1],    normal[2],    normal[0],    0.25f,        0.75f,    0.5f,     0.625f};
}

// The values that transform feedback records, to within 1e-4, ten times the error of one operation.
EVALCTS_TEST(Pipeline, VertexShaderAttributes, kMust, "EV-PIPE-VS")
(Test& t) {
  t.require(3, 0);
  for (const Drawing& drawing : all_drawings(t)) {
    if (drawing.primitive != GL_POINTS) continue;
    const auto script = [&](const gl::Identity& identity, const gl::Case& commands) {
      gl::Case c(identity);
      set_values_without_maps(c);
      c.append(commands);
      return c;
    };
    std::vector<float> expected;
    for (const reference::Primitive& primitive : drawing.predicted.primitives)
      for (const reference::Vertex& vertex : primitive.vertices)
        for (const float value : expected_of(vertex)) expected.push_back(value);
    const auto close = [](float a, float b) { return std::abs(a - b) <= 1e-4f; };
    // Puts the vertices of EvalMesh2 into the order of the specification if all of them were recorded,
    // because other tests judge the order.
    const auto in_order = [&](RecordedVaryings recorded) {
      if (!drawing.two || !drawing.predicted.has_meshes() || recorded.values.size() != expected.size())
        return recorded;
      std::vector<float> left = recorded.values, ordered;
      for (auto vertex = expected.begin(); vertex != expected.end(); vertex += kFloats) {
        auto seen = left.begin();
        while (seen != left.end() && !std::equal(seen, seen + kFloats, vertex, close)) seen += kFloats;
        if (seen == left.end()) return recorded;
        ordered.insert(ordered.end(), seen, seen + kFloats);
        left.erase(seen, seen + kFloats);
      }
      recorded.values = ordered;
      return recorded;
    };
    // Returns the index of the first wrong value, or the number of values that were compared.
    const auto first_wrong = [&](const RecordedVaryings& recorded) {
      const auto size = std::min(recorded.values.size(), expected.size());
      std::size_t i = 0;
      while (i < size && close(recorded.values[i], expected[i])) ++i;
      return i;
    };
    const std::size_t vertices = drawing.predicted.vertex_count();
    const auto whole = [&](const RecordedVaryings& recorded) {
      return recorded.vertices == vertices && !recorded.overflow && first_wrong(recorded) == expected.size();
    };
    const RecordedVaryings control =
        t.record_varyings(script(gl::control(drawing.name), drawing.vertices), kEachAttribute, vertices);
    if (!whole(control))
      throw NotObservable("pipeline: the shader does not see all attributes of explicit vertices");
    const gl::Case evaluated = script(drawing.name, drawing.evaluated);
    const RecordedVaryings seen = in_order(t.record_varyings(evaluated, kEachAttribute, vertices));
    if (whole(seen)) continue;
    const std::size_t where = first_wrong(seen);
    std::string what = "number of vertices", expected_text = std::to_string(vertices),
                captured = std::to_string(seen.vertices),
                message =
                    fmt::format("the shader runs for {} vertices, expected {}", captured, expected_text);
    if (seen.vertices == vertices && !seen.overflow) {
      what = fmt::format("value {} of vertex {}", where % kFloats, where / kFloats);
      expected_text = fmt::format("{}", expected[where]);
      captured = fmt::format("{}", seen.values[where]);
      message = fmt::format("{} that the shader gives is {}, expected {}", what, captured, expected_text);
    }
    t.fail(failure_of(evaluated, what, message, expected_text, captured));
  }
};

}  // namespace
}  // namespace evalcts::suite_vertex_programs
