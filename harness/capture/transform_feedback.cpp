// Captures vertices by transform feedback: a vertex shader copies the built-in attributes to varyings, which
// are recorded. A vertex shader changes the effect of AUTO_NORMAL (EV-AUTON-SHADER) and nothing else of
// evaluation.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include <evalcts/capture/varyings.h>
#include "control.h"

namespace evalcts {
namespace {

VaryingShader copying_shader(std::size_t units) {
  VaryingShader shader;
  std::string declarations =
      "#version 120\nvarying vec4 seen_position;\nvarying vec4 seen_color;\nvarying vec3 seen_normal;\n";
  std::string body = "  seen_position = gl_Vertex;\n  seen_color = gl_Color;\n  seen_normal = gl_Normal;\n";
  shader.varyings = {"seen_position", "seen_color", "seen_normal"};
  for (std::size_t unit = 0; unit < units; ++unit) {
    declarations += fmt::format("varying vec4 seen_texture{};\n", unit);
    body += fmt::format("  seen_texture{0} = gl_MultiTexCoord{0};\n", unit);
    shader.varyings.push_back(fmt::format("seen_texture{}", unit));
  }
  shader.source = declarations + "void main() {\n" + body + "  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);\n}\n";
  shader.floats = 4 + 4 + 3 + 4 * units;
  return shader;
}

class TransformFeedback final : public Capture {
 public:
  std::string name() const override { return "TransformFeedback"; }

  void prove(Implementation& implementation, const ImplementationInfo& info) override {
    if (!info.at_least(3, 0)) throw NotObservable("needs GL 3.0, this is GL " + info.version);
    units_ =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::max(info.texture_units, 1)), 1, kTextureUnits);
    shader_ = copying_shader(units_);
    shader_of_unit_0_ = copying_shader(1);
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
    const RecordedVaryings recorded = record_varyings(implementation, all_units ? shader_ : shader_of_unit_0_,
                                                      script, kind, request.most_vertices);
    Observation observation;
    observation.attributes = all_units ? attributes() : attributes() & ~Attributes{kTextureCoordinatesOther};
    observation.units = all_units ? units_ : 1;
    observation.error = recorded.error;
    observation.overflow = recorded.overflow;
    decode(recorded, kind, observation);
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

  static void decode(const RecordedVaryings& recorded, PrimitiveKind kind, Observation& observation) {
    auto next = recorded.values.begin();
    const auto take = [&next](auto& values) {
      std::copy_n(next, values.size(), values.begin());
      next += static_cast<std::ptrdiff_t>(values.size());
    };
    const std::size_t size = vertices_of_recorded(kind);
    const GLenum mode = kind == kPoints ? GL_POINTS : kind == kLines ? GL_LINES : GL_TRIANGLES;
    for (std::size_t i = 0; i < recorded.vertices; ++i) {
      if (kind == kPoints ? i == 0 : i % size == 0) observation.primitives.emplace_back().mode = mode;
      ObservedVertex& vertex = observation.primitives.back().vertices.emplace_back();
      take(vertex.position);
      take(vertex.color);
      take(vertex.normal);
      for (std::size_t unit = 0; unit < observation.units; ++unit) take(vertex.texture_coordinate[unit]);
    }
  }

  std::size_t units_ = 1;
  VaryingShader shader_, shader_of_unit_0_;
  std::unique_ptr<Context> idle_;
};

}  // namespace

std::unique_ptr<Capture> make_transform_feedback() { return std::make_unique<TransformFeedback>(); }

}  // namespace evalcts
