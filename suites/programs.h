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

// A program of a case, linked and not in use.
struct Program {
  gl::Ref name;
  gl::Ref linked;  // the query of its LINK_STATUS
};
Program link_program(gl::Case& c, const std::vector<Shader>& shaders,
                     const std::vector<std::string>& recorded = {});
// Throws NotObservable.
void require_linked(const Played& played, const Program& program);

// Makes vertex (or fragment) program `number` of ARB_vertex_program current, disabled.
void load_assembly(gl::Case& c, GLenum target, GLuint number, const std::string& text);

// A buffer of so many floats that transform feedback writes to.
gl::ResultOf bind_recording_buffer(gl::Case& c, std::size_t floats);

// A query object.
gl::ResultOf make_query(gl::Case& c);

}  // namespace evalcts
