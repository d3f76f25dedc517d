// Names of GL tokens, for people and for C programs.
#pragma once

#include <array>
#include <string>

#include <evalcts/gl/table.h>

namespace evalcts::gl {

// Returns a name such as "GL_MAP1_VERTEX_3", or "0x1234" for a token without a known name.
std::string token_name(GLenum token);
// Returns "GL_POINTS" ... "GL_POLYGON", or "0x1234" for other values.
std::string primitive_name(GLenum mode);
// Return the same names, but null for a value without a name. After their first call, these functions
// allocate no memory.
const char* known_token(GLenum token);
const char* known_primitive(GLenum mode);
// Returns "GL_NO_ERROR", "GL_INVALID_ENUM", ...
std::string error_name(GLenum error);

inline constexpr std::array<GLenum, 9> kMap1Targets = {
    GL_MAP1_COLOR_4,         GL_MAP1_INDEX,           GL_MAP1_NORMAL,
    GL_MAP1_TEXTURE_COORD_1, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_TEXTURE_COORD_3,
    GL_MAP1_TEXTURE_COORD_4, GL_MAP1_VERTEX_3,        GL_MAP1_VERTEX_4};
inline constexpr std::array<GLenum, 9> kMap2Targets = {
    GL_MAP2_COLOR_4,         GL_MAP2_INDEX,           GL_MAP2_NORMAL,
    GL_MAP2_TEXTURE_COORD_1, GL_MAP2_TEXTURE_COORD_2, GL_MAP2_TEXTURE_COORD_3,
    GL_MAP2_TEXTURE_COORD_4, GL_MAP2_VERTEX_3,        GL_MAP2_VERTEX_4};

// Returns k, the number of values of one control point of a map target of either dimension (GL 4.6c
// table 21.1); 0 for other tokens.
int components_of(GLenum target);

}  // namespace evalcts::gl
