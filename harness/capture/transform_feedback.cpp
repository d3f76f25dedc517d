// A vertex shader copies the built-in attributes to varyings, transform feedback records them (GL 3.0 §2.15):
// exact, bit for bit. A vertex shader changes AUTO_NORMAL (EV-AUTON-SHADER), nothing else of evaluation.
#include <fmt/format.h>

#include <algorithm>

#include "harness/capture/control.h"

namespace evalcts {
namespace {

struct Layout {
  std::size_t units;
  std::size_t floats() const { return 4 + 4 + 3 + 4 * units; }
};

std::string shader_source(const Layout& layout) {
  std::string declarations =
      "#version 120\nvarying vec4 seen_position;\nvarying vec4 seen_color;\nvarying vec3 seen_normal;\n";
  std::string body = "  seen_position = gl_Vertex;\n  seen_color = gl_Color;\n  seen_normal = gl_Normal;\n";
  for (std::size_t unit = 0; unit < layout.units; ++unit) {
    declarations += fmt::format("varying vec4 seen_texture{};\n", unit);
    body += fmt::format("  seen_texture{0} = gl_MultiTexCoord{0};\n", unit);
  }
  return declarations + "void main() {\n" + body + "  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);\n}\n";
}

gl::Strings varyings(const Layout& layout) {
  gl::Strings names{{"seen_position", "seen_color", "seen_normal"}};
  for (std::size_t unit = 0; unit < layout.units; ++unit)
    names.values.push_back(fmt::format("seen_texture{}", unit));
  return names;
}

class TransformFeedback final : public Capture {
 public:
  std::string name() const override { return "TransformFeedback"; }

  void prove(Implementation& implementation, const ImplementationInfo& info) override {
    if (!info.at_least(3, 0)) throw NotObservable("needs GL 3.0, this is GL " + info.version);
    layout_.units =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::max(info.texture_units, 1)), 1, kTextureUnits);
    std::string wrong;
    try {
      wrong = try_control(*this, implementation, {true, true}, attributes());
    } catch (const gl::MissingEntryPoint& missing) {
      wrong = missing.what();
    }
    if (!wrong.empty()) throw NotObservable(wrong);
  }

  Attributes attributes() const override {
    return kPosition | kColor | kNormal | kTextureCoordinate0 |
           (layout_.units > 1 ? kTextureCoordinatesOther : 0u);
  }

  Observation observe(Implementation& implementation, const gl::Case& script, Attributes,
                      std::size_t most_vertices) const override {
    const std::size_t room = most_vertices + 1;  // one more, to see that more came
    const std::size_t bytes = room * layout_.floats() * sizeof(GLfloat);

    gl::Case prologue;
    const gl::Ref shader = prologue.CreateShader(GL_VERTEX_SHADER);
    prologue.ShaderSource(shader, 1, gl::Strings{{shader_source(layout_)}}, nullptr);
    prologue.CompileShader(shader);
    const gl::Ref program = prologue.CreateProgram();
    prologue.AttachShader(program, shader);
    const gl::Strings names = varyings(layout_);
    prologue.TransformFeedbackVaryings(program, names.values.size(), names, GL_INTERLEAVED_ATTRIBS);
    prologue.LinkProgram(program);
    const gl::Ref linked = prologue.GetProgramiv(program, GL_LINK_STATUS, gl::out<GLint>(1));
    prologue.UseProgram(program);
    const gl::ResultOf buffer{prologue.GenBuffers(1, gl::out<GLuint>(1)).index, 0};
    prologue.BindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, buffer);
    prologue.BufferData(GL_TRANSFORM_FEEDBACK_BUFFER, bytes, nullptr, GL_STATIC_READ);
    prologue.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    prologue.Enable(GL_RASTERIZER_DISCARD);
    const gl::ResultOf query{prologue.GenQueries(1, gl::out<GLuint>(1)).index, 0};
    prologue.BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, query);
    prologue.BeginTransformFeedback(GL_POINTS);

    WrappedCase wrapped = begin_wrapping(std::move(prologue), script);
    gl::Case& c = wrapped.commands;
    c.EndTransformFeedback();
    c.EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    const gl::Ref written = c.GetQueryObjectuiv(query, GL_QUERY_RESULT, gl::out<GLuint>(1));
    const gl::Ref data =
        c.GetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, bytes, gl::out<GLfloat>(room * layout_.floats()));

    const std::unique_ptr<Context> context = implementation.create_context();
    const gl::Trace trace = context->play(c);
    if (trace.values<GLint>(linked)[0] != GL_TRUE) throw NotObservable("the capturing shader does not link");
    if (trace.error(wrapped.error_before) != GL_NO_ERROR)
      throw NotObservable("transform feedback cannot be set up");

    Observation observation;
    observation.attributes = attributes();
    observation.units = layout_.units;
    observation.error = trace.error(wrapped.error_after);
    const std::size_t count = std::min<std::size_t>(trace.values<GLuint>(written)[0], room);
    observation.overflow = count > most_vertices;
    decode(trace.values<GLfloat>(data), count, observation);
    return observation;
  }

 private:
  void decode(const std::vector<GLfloat>& data, std::size_t count, Observation& observation) const {
    ObservedPrimitive& points = observation.primitives.emplace_back();
    auto next = data.begin();
    const auto take = [&next](auto& values) {
      std::copy_n(next, values.size(), values.begin());
      next += static_cast<std::ptrdiff_t>(values.size());
    };
    for (std::size_t i = 0; i < count; ++i) {
      ObservedVertex& vertex = points.vertices.emplace_back();
      take(vertex.position);
      take(vertex.color);
      take(vertex.normal);
      for (std::size_t unit = 0; unit < layout_.units; ++unit) take(vertex.texture_coordinate[unit]);
    }
  }

  Layout layout_{1};
};

}  // namespace

std::unique_ptr<Capture> make_transform_feedback() { return std::make_unique<TransformFeedback>(); }

}  // namespace evalcts
