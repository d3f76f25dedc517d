// Runs a case with a vertex shader and reads the recorded outputs from the transform feedback buffer.
#include <evalcts/capture/varyings.h>

#include <algorithm>

#include "program.h"

namespace evalcts {
namespace {

GLenum recorded_mode(PrimitiveKind kind) {
  return kind == kPoints ? GL_POINTS : kind == kLines ? GL_LINES : GL_TRIANGLES;
}

}  // namespace

bool can_record(PrimitiveKinds kinds) { return kinds == kPoints || kinds == kLines || kinds == kPolygons; }

std::size_t vertices_of_recorded(PrimitiveKinds kind) { return kind == kPoints ? 1 : kind == kLines ? 2 : 3; }

RecordedVaryings record_varyings(Implementation& implementation, const VaryingShader& shader,
                                 const gl::Case& script, PrimitiveKind kind, std::size_t most_vertices) {
  // There is room for one primitive more than expected, which shows an overflow.
  const std::size_t room = most_vertices + vertices_of_recorded(kind);
  const std::size_t bytes = room * shader.floats * sizeof(GLfloat);

  const std::unique_ptr<Context> context = implementation.create_context();
  gl::Case prologue;
  const UsedProgram program(
      prologue, *context,
      {.vertex = shader.source, .varyings = shader.varyings, .locations = shader.locations});
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
  program.require_linked(trace);
  if (trace.error(wrapped.error_before) != GL_NO_ERROR)
    throw NotObservable("transform feedback cannot be set up");

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
