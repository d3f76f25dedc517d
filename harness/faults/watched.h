// State of the context that faults ask for while a GL query is not possible: between Begin and End, or while
// a list is compiled. The injector notes the calls of the application before the fault sees them.
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
  std::vector<GLbitfield> masks;    // of the levels of the attribute stack
  std::map<GLenum, bool> enabled;   // the last Enable or Disable of each capability
  std::map<GLenum, GLuint> buffers;
};
inline Watched watched;

// Puts the notes in front of the commands of the table.
void watch(gl::Table& table);

inline GLenum open_mode() { return watched.primitive; }
inline bool is_inside() { return open_mode() != kNoPrimitive; }
inline bool is_noted_on(GLenum cap) { return watched.enabled[cap]; }
inline bool has_vertex_map(int dimension) {
  return dimension == 1 ? is_noted_on(GL_MAP1_VERTEX_3) || is_noted_on(GL_MAP1_VERTEX_4)
                        : is_noted_on(GL_MAP2_VERTEX_3) || is_noted_on(GL_MAP2_VERTEX_4);
}

}  // namespace evalcts::faults
