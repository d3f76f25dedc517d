// Shader programs, assembly programs and transform feedback as commands of a case, for tests that see
// evaluated vertices through them.
#pragma once

#include <string>
#include <vector>

#include <evalcts/testkit/test.h>

namespace evalcts {

struct Shader {
  GLenum type;
  std::string source;  // GLSL
};

// A program that a case links and does not use yet.
struct Program {
  gl::Ref name;
  gl::Ref linked;  // the query of its LINK_STATUS
};
Program link_program(gl::Case& c, const std::vector<Shader>& shaders,
                     const std::vector<std::string>& recorded = {});
// Throws NotObservable unless the program is linked.
void require_linked(const CheckedTrace& checked, const Program& program);

// Binds program `number` of ARB_vertex_program or ARB_fragment_program and loads its text. Does not enable
// it.
void load_assembly(gl::Case& c, GLenum target, GLuint number, const std::string& text);

// Makes a buffer of `floats` floats and binds it to binding point 0 of transform feedback.
gl::ResultOf bind_recording_buffer(gl::Case& c, std::size_t floats);

// Makes a query object.
gl::ResultOf make_query(gl::Case& c);

}  // namespace evalcts
