// Appends the commands that link programs, load assembly programs and bind buffers for transform feedback.
#include "programs.h"

namespace evalcts {

Program link_program(gl::Case& c, const std::vector<Shader>& shaders,
                     const std::vector<std::string>& recorded) {
  const gl::Ref program = c.CreateProgram();
  for (const Shader& shader : shaders) {
    const gl::Ref name = c.CreateShader(shader.type);
    c.ShaderSource(name, 1, gl::Strings{{shader.source}}, nullptr);
    c.CompileShader(name);
    c.AttachShader(program, name);
  }
  if (!recorded.empty())
    c.TransformFeedbackVaryings(program, recorded.size(), gl::Strings{recorded}, GL_INTERLEAVED_ATTRIBS);
  c.LinkProgram(program);
  return {program, c.GetProgramiv(program, GL_LINK_STATUS, gl::out<GLint>(1))};
}

void require_linked(const CheckedTrace& checked, const Program& program) {
  if (checked.trace().values<GLint>(program.linked)[0] != GL_TRUE)
    throw NotObservable("pipeline: a program of this test does not link");
}

void load_assembly(gl::Case& c, GLenum target, GLuint number, const std::string& text) {
  c.BindProgramARB(target, number);
  c.ProgramStringARB(target, GL_PROGRAM_FORMAT_ASCII_ARB, text.size(), gl::text(text));
}

gl::ResultOf bind_recording_buffer(gl::Case& c, std::size_t floats) {
  const gl::ResultOf buffer{c.GenBuffers(1, gl::out<GLuint>(1)).index, 0};
  c.BindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, buffer);
  c.BufferData(GL_TRANSFORM_FEEDBACK_BUFFER, floats * sizeof(GLfloat), nullptr, GL_STATIC_READ);
  c.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
  return buffer;
}

gl::ResultOf make_query(gl::Case& c) { return {c.GenQueries(1, gl::out<GLuint>(1)).index, 0}; }

}  // namespace evalcts
