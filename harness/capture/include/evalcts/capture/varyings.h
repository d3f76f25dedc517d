// Vertex shaders whose outputs are recorded by transform feedback (GL 3.0 section 2.15): exact, bit for bit.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <evalcts/capture/capture.h>

namespace evalcts {

// A vertex shader and its recorded outputs.
struct VaryingShader {
  std::string source;                 // GLSL
  std::vector<std::string> varyings;  // recorded in this order, interleaved
  std::size_t floats = 0;             // number of floats per vertex, over all varyings
  // Locations of generic attributes, bound before linking.
  std::vector<std::pair<GLuint, std::string>> locations = {};
};

struct RecordedVaryings {
  GLenum error = GL_NO_ERROR;  // error that the case itself raised
  bool overflow = false;       // more vertices were emitted than `most_vertices`
  std::size_t vertices = 0;
  std::vector<GLfloat> values;  // vertices * floats
};

// Returns true if cases that draw these kinds can be recorded: transform feedback records one kind of
// primitive. Lines and polygons are recorded as separate lines and triangles.
bool can_record(PrimitiveKinds kinds);
std::size_t vertices_of_recorded(PrimitiveKinds kind);  // 1, 2 or 3

// Runs the case with the shader in use, in a fresh context. Throws NotObservable if the shader does not link
// or transform feedback cannot be set up, and all exceptions of gl::play.
RecordedVaryings record_varyings(Implementation& implementation, const VaryingShader& shader,
                                 const gl::Case& script, PrimitiveKind kind, std::size_t most_vertices);

}  // namespace evalcts
