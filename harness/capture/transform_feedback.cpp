// Captures vertices by transform feedback: a vertex shader copies the built-in attributes to varyings, which
// are recorded. A vertex shader changes the effect of AUTO_NORMAL (EV-AUTON-SHADER) and nothing else of
// evaluation.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include <evalcts/capture/varyings.h>
#include "control.h"

namespace evalcts {
namespace {

// Returns a shader that copies these attributes, with the texture coordinates of `units` units.
VaryingShader copying_shader(Attributes attributes, std::size_t units) {
  VaryingShader shader;
  std::string declarations = "#version 120\n", body;
  const auto copy = [&](const std::string& name, const std::string& of, std::size_t components) {
    declarations += fmt::format("varying vec{} seen_{};\n", components, name);
    body += fmt::format("  seen_{} = gl_{};\n", name, of);
    shader.varyings.push_back("seen_" + name);
    shader.floats += components;
  };
  if (attributes & kPosition) copy("position", "Vertex", 4);
  if (attributes & kColor) copy("color", "Color", 4);
  if (attributes & (kNormal | kShaderNormal)) copy("normal", "Normal", 3);
  if (attributes & (kTextureCoordinate0 | kTextureCoordinatesOther))
    for (std::size_t unit = 0; unit < units; ++unit)
      copy(fmt::format("texture{}", unit), fmt::format("MultiTexCoord{}", unit), 4);
  shader.source = declarations + "void main() {\n" + body + "  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);\n}\n";
  return shader;
}

// Returns the shortest shader that copies one attribute of four or less components; none if there are more.
std::optional<VaryingShader> shortest_shader(Attributes attributes, std::size_t units) {
  const char* const of = attributes == kPosition ? "gl_Vertex"
                         : attributes == kColor  ? "gl_Color"
                         : attributes != 0 && (attributes & ~Attributes{kNormal | kShaderNormal}) == 0
                             ? "vec4(gl_Normal, 0.0)"
                         : attributes == kTextureCoordinate0 && units == 1 ? "gl_MultiTexCoord0"
                                                                           : nullptr;
  if (!of) return std::nullopt;
  return VaryingShader{.source = fmt::format("void main() {{ gl_Position = {}; }}", of),
                       .varyings = {"gl_Position"},
                       .floats = 4};
}

class TransformFeedback final : public Capture {
 public:
  std::string name() const override { return "TransformFeedback"; }

  void prove(Implementation& implementation, const ImplementationInfo& info) override {
    if (!info.at_least(3, 0)) throw NotObservable("needs GL 3.0, this is GL " + info.version);
    units_ =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::max(info.texture_units, 1)), 1, kTextureUnits);
    const std::set<Attributes> requests = {attributes(),
                                           attributes() & ~Attributes{kTextureCoordinatesOther}};
    for (const Attributes wanted : requests) {
      std::string wrong;
      try {
        wrong = try_control(*this, implementation, {true, true}, wanted);
      } catch (const gl::MissingEntryPoint& missing) {
        wrong = missing.what();
      }
      if (!wrong.empty()) throw NotObservable(wrong);
    }
    stay_warm(implementation);
  }

  Attributes attributes() const override {
    return kPosition | kColor | kNormal | kShaderNormal | kTextureCoordinate0 |
           (units_ > 1 ? kTextureCoordinatesOther : 0u);
  }

  bool takes(PrimitiveKinds kinds) const override { return can_record(kinds); }

  Observation observe(Implementation& implementation, const gl::Case& script,
                      const CaptureRequest& request) const override {
    const auto kind = static_cast<PrimitiveKind>(request.kinds);
    // Most of the time of a large case goes into the buffer.
    const bool all_units = (request.attributes & kTextureCoordinatesOther) != 0;
    Observation observation;
    observation.attributes = attributes();
    if (!all_units) observation.attributes &= ~Attributes{kTextureCoordinatesOther};
    if (request.nothing_more) observation.attributes &= request.attributes;
    observation.units = all_units ? units_ : 1;
    std::optional<VaryingShader> shader;
    if (request.nothing_more) shader = shortest_shader(observation.attributes, observation.units);
    if (!shader) shader = copying_shader(observation.attributes, observation.units);
    const RecordedVaryings recorded =
        record_varyings(implementation, *shader, script, kind, request.most_vertices);
    observation.error = recorded.error;
    observation.overflow = recorded.overflow;
    decode(recorded, shader->floats, kind, observation);
    return observation;
  }

 private:
  // Keeps one idle context with a compiled shader. Mesa frees the built-in functions of GLSL with the last
  // context that has compiled a shader, and making them again takes a third of the time of a case.
  void stay_warm(Implementation& implementation) {
    idle_ = implementation.create_beside();
    if (!idle_) return;
    gl::Case c;
    const gl::Ref shader = c.CreateShader(GL_VERTEX_SHADER);
    c.ShaderSource(shader, 1, gl::Strings{{"void main() { gl_Position = gl_Vertex; }"}}, nullptr);
    c.CompileShader(shader);
    idle_->play(c);
  }

  // `floats`: number of recorded values of a vertex.
  static void decode(const RecordedVaryings& recorded, std::size_t floats, PrimitiveKind kind,
                     Observation& observation) {
    auto next = recorded.values.begin();
    const auto take = [&next](auto& values) {
      std::copy_n(next, values.size(), values.begin());
      next += static_cast<std::ptrdiff_t>(values.size());
    };
    const std::size_t size = vertices_of_recorded(kind);
    const GLenum mode = kind == kPoints ? GL_POINTS : kind == kLines ? GL_LINES : GL_TRIANGLES;
    for (std::size_t i = 0; i < recorded.vertices; ++i) {
      next = recorded.values.begin() + static_cast<std::ptrdiff_t>(i * floats);
      if (kind == kPoints ? i == 0 : i % size == 0) observation.primitives.emplace_back().mode = mode;
      ObservedVertex& vertex = observation.primitives.back().vertices.emplace_back();
      if (observation.attributes & kPosition) take(vertex.position);
      if (observation.attributes & kColor) take(vertex.color);
      if (observation.attributes & (kNormal | kShaderNormal)) take(vertex.normal);
      if (observation.attributes & (kTextureCoordinate0 | kTextureCoordinatesOther))
        for (std::size_t unit = 0; unit < observation.units; ++unit) take(vertex.texture_coordinate[unit]);
    }
  }

  std::size_t units_ = 1;
  std::unique_ptr<Context> idle_;
};

}  // namespace

std::unique_ptr<Capture> make_transform_feedback() { return std::make_unique<TransformFeedback>(); }

}  // namespace evalcts
