// Tracks state of the context that faults need when it cannot be queried: between Begin and End, or
// while a list is compiled. The state is derived from the calls of the application, by wrappers in front
// of the fault.
#pragma once

#include <map>
#include <vector>

#include <evalcts/gl/table.h>

namespace evalcts::faults {

inline constexpr GLenum kNoPrimitive = 0xFFFFFFFFu;

struct Watched {
  GLenum primitive = kNoPrimitive;  // mode of the open primitive
  GLenum unit = GL_TEXTURE0;        // argument of the last ActiveTexture
  GLenum list_mode = 0;             // mode of the open list, 0 without one
  GLuint kind = 0;                  // the argument of the last ContextOfKindEVALCTS
  std::vector<GLbitfield> masks;    // the masks of PushAttrib on the attribute stack
  std::map<GLenum, bool> enabled;   // the last Enable or Disable of each capability
  std::map<GLenum, GLuint> buffers;
};
inline Watched watched;

// Wraps the commands of the table so that they update `watched`, which is reset to the initial state.
void watch(gl::Table& table);

inline GLenum open_mode() { return watched.primitive; }
inline bool is_inside() { return open_mode() != kNoPrimitive; }
inline bool is_noted_on(GLenum cap) { return watched.enabled[cap]; }
inline bool has_vertex_map(int dimension) {
  return dimension == 1 ? is_noted_on(GL_MAP1_VERTEX_3) || is_noted_on(GL_MAP1_VERTEX_4)
                        : is_noted_on(GL_MAP2_VERTEX_3) || is_noted_on(GL_MAP2_VERTEX_4);
}

}  // namespace evalcts::faults
