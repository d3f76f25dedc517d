#include <evalcts/capture/varyings.h>

#include <algorithm>
#include <map>
#include <optional>

namespace evalcts {
namespace {

GLenum recorded_mode(PrimitiveKind kind) {
  return kind == kPoints ? GL_POINTS : kind == kLines ? GL_LINES : GL_TRIANGLES;
}

gl::Ref make_program(gl::Case& c, const VaryingShader& shader) {
  const gl::Ref vertex_shader = c.CreateShader(GL_VERTEX_SHADER);
  c.ShaderSource(vertex_shader, 1, gl::Strings{{shader.source}}, nullptr);
  c.CompileShader(vertex_shader);
  const gl::Ref program = c.CreateProgram();
  c.AttachShader(program, vertex_shader);
  for (const auto& [location, name] : shader.locations)
    c.BindAttribLocation(program, location, gl::text(name));
  c.TransformFeedbackVaryings(program, shader.varyings.size(), gl::Strings{shader.varyings},
                              GL_INTERLEAVED_ATTRIBS);
  c.LinkProgram(program);
  return program;
}

}  // namespace

bool can_record(PrimitiveKinds kinds) { return kinds == kPoints || kinds == kLines || kinds == kPolygons; }

std::size_t vertices_of_recorded(PrimitiveKinds kind) { return kind == kPoints ? 1 : kind == kLines ? 2 : 3; }

RecordedVaryings record_varyings(Implementation& implementation, const VaryingShader& shader,
                                 const gl::Case& script, PrimitiveKind kind, std::size_t most_vertices) {
  // One primitive more than expected, to see that more came.
  const std::size_t room = most_vertices + vertices_of_recorded(kind);
  const std::size_t bytes = room * shader.floats * sizeof(GLfloat);

  const std::unique_ptr<Context> context = implementation.create_context();
  std::map<std::string, GLuint>* const kept = context->kept_programs();
  gl::Case prologue;
  std::optional<gl::Ref> made, linked;
  if (kept && kept->contains(shader.source)) {
    prologue.UseProgram(kept->at(shader.source));
  } else {
    made = make_program(prologue, shader);
    linked = prologue.GetProgramiv(*made, GL_LINK_STATUS, gl::out<GLint>(1));
    prologue.UseProgram(*made);
  }
  const gl::ResultOf buffer{prologue.GenBuffers(1, gl::out<GLuint>(1)).index, 0};
  prologue.BindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, buffer);
  prologue.BufferData(GL_TRANSFORM_FEEDBACK_BUFFER, bytes, nullptr, GL_STATIC_READ);
  prologue.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
  prologue.Enable(GL_RASTERIZER_DISCARD);
  const gl::ResultOf query{prologue.GenQueries(1, gl::out<GLuint>(1)).index, 0};
  prologue.BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, query);
  prologue.BeginTransformFeedback(recorded_mode(kind));

  WrappedCase wrapped = begin_wrapping(std::move(prologue), script);
  gl::Case& c = wrapped.commands;
  c.EndTransformFeedback();
  c.EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
  const gl::Ref written = c.GetQueryObjectuiv(query, GL_QUERY_RESULT, gl::out<GLuint>(1));
  const gl::Ref data =
      c.GetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, bytes, gl::out<GLfloat>(room * shader.floats));

  const gl::Trace trace = context->play(c);
  if (linked && trace.values<GLint>(*linked)[0] != GL_TRUE)
    throw NotObservable("the capturing shader does not link");
  if (trace.error(wrapped.error_before) != GL_NO_ERROR)
    throw NotObservable("transform feedback cannot be set up");
  if (kept && made) kept->emplace(shader.source, static_cast<GLuint>(trace.result(*made)));

  RecordedVaryings recorded;
  recorded.error = trace.error(wrapped.error_after);
  recorded.vertices =
      std::min<std::size_t>(trace.values<GLuint>(written)[0] * vertices_of_recorded(kind), room);
  recorded.overflow = recorded.vertices > most_vertices;
  recorded.values = trace.values<GLfloat>(data);
  recorded.values.resize(recorded.vertices * shader.floats);
  return recorded;
}

}  // namespace evalcts
