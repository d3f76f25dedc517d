// Vertex shaders whose outputs are recorded by transform feedback (GL 3.0 section 2.15): exact, bit for bit.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <evalcts/capture/capture.h>

namespace evalcts {

// A vertex shader and what is recorded of it.
struct VaryingShader {
  std::string source;                                          // GLSL
  std::vector<std::string> varyings;                           // recorded in this order, interleaved
  std::size_t floats = 0;                                      // of one vertex, over all varyings
  std::vector<std::pair<GLuint, std::string>> locations = {};  // of generic attributes, bound before linking
};

struct RecordedVaryings {
  GLenum error = GL_NO_ERROR;  // what the case itself left behind
  bool overflow = false;       // more vertices came than there was room for
  std::size_t vertices = 0;
  std::vector<GLfloat> values;  // vertices * floats
};

// What a case may draw while it is recorded: one kind of primitive. Lines and polygons come out as separate
// lines and triangles.
bool can_record(PrimitiveKinds kinds);
std::size_t vertices_of_recorded(PrimitiveKinds kind);  // 1, 2 or 3

// Plays the case with the shader in use, in a fresh context. Throws NotObservable where the shader does not
// link or transform feedback cannot be set up, and whatever gl::play throws.
RecordedVaryings record_varyings(Implementation& implementation, const VaryingShader& shader,
                                 const gl::Case& script, PrimitiveKind kind, std::size_t most_vertices);

}  // namespace evalcts
