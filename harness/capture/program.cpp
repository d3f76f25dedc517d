// Appends the commands that compile, link and use the shader program of a capture.
#include "program.h"

#include <map>

#include <evalcts/gl/observation.h>

namespace evalcts {
namespace {

void attach(gl::Case& c, gl::Ref program, GLenum stage, const std::string& source) {
  if (source.empty()) return;
  const gl::Ref shader = c.CreateShader(stage);
  c.ShaderSource(shader, 1, gl::Strings{{source}}, nullptr);
  c.CompileShader(shader);
  c.AttachShader(program, shader);
}

}  // namespace

UsedProgram::UsedProgram(gl::Case& prologue, Context& context, const ProgramSource& source)
    : context_(context), key_(source.vertex + source.fragment) {
  std::map<std::string, GLuint>* const kept = context.kept_programs();
  if (kept && kept->contains(key_)) {
    prologue.UseProgram(kept->at(key_));
    return;
  }
  made_ = prologue.CreateProgram();
  attach(prologue, *made_, GL_VERTEX_SHADER, source.vertex);
  attach(prologue, *made_, GL_FRAGMENT_SHADER, source.fragment);
  for (const auto& [location, name] : source.locations)
    prologue.BindAttribLocation(*made_, location, gl::text(name));
  if (!source.varyings.empty())
    prologue.TransformFeedbackVaryings(*made_, source.varyings.size(), gl::Strings{source.varyings},
                                       GL_INTERLEAVED_ATTRIBS);
  prologue.LinkProgram(*made_);
  linked_ = prologue.GetProgramiv(*made_, GL_LINK_STATUS, gl::out<GLint>(1));
  prologue.UseProgram(*made_);
}

void UsedProgram::require_linked(const gl::Trace& trace) const {
  if (!made_) return;
  if (trace.values<GLint>(*linked_)[0] != GL_TRUE) throw NotObservable("the capturing shader does not link");
  if (std::map<std::string, GLuint>* const kept = context_.kept_programs())
    kept->emplace(key_, static_cast<GLuint>(trace.result(*made_)));
}

}  // namespace evalcts
