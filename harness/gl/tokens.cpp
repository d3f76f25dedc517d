#include "harness/gl/tokens.h"

#include <fmt/format.h>

#include <unordered_map>

namespace evalcts::gl {
namespace {

// One name for each value; GL_ZERO, GL_NO_ERROR and GL_POINTS share 0 and are told apart by the caller.
const std::unordered_map<GLenum, const char*>& names() {
#define TOKEN(name) \
  { name, #name }
  static const std::unordered_map<GLenum, const char*> table = {
      TOKEN(GL_MAP1_COLOR_4),
      TOKEN(GL_MAP1_INDEX),
      TOKEN(GL_MAP1_NORMAL),
      TOKEN(GL_MAP1_TEXTURE_COORD_1),
      TOKEN(GL_MAP1_TEXTURE_COORD_2),
      TOKEN(GL_MAP1_TEXTURE_COORD_3),
      TOKEN(GL_MAP1_TEXTURE_COORD_4),
      TOKEN(GL_MAP1_VERTEX_3),
      TOKEN(GL_MAP1_VERTEX_4),
      TOKEN(GL_MAP2_COLOR_4),
      TOKEN(GL_MAP2_INDEX),
      TOKEN(GL_MAP2_NORMAL),
      TOKEN(GL_MAP2_TEXTURE_COORD_1),
      TOKEN(GL_MAP2_TEXTURE_COORD_2),
      TOKEN(GL_MAP2_TEXTURE_COORD_3),
      TOKEN(GL_MAP2_TEXTURE_COORD_4),
      TOKEN(GL_MAP2_VERTEX_3),
      TOKEN(GL_MAP2_VERTEX_4),
      TOKEN(GL_AUTO_NORMAL),
      TOKEN(GL_MAP1_GRID_DOMAIN),
      TOKEN(GL_MAP1_GRID_SEGMENTS),
      TOKEN(GL_MAP2_GRID_DOMAIN),
      TOKEN(GL_MAP2_GRID_SEGMENTS),
      TOKEN(GL_MAX_EVAL_ORDER),
      TOKEN(GL_COEFF),
      TOKEN(GL_ORDER),
      TOKEN(GL_DOMAIN),
      TOKEN(GL_POINT),
      TOKEN(GL_LINE),
      TOKEN(GL_FILL),
      TOKEN(GL_CURRENT_COLOR),
      TOKEN(GL_CURRENT_INDEX),
      TOKEN(GL_CURRENT_NORMAL),
      TOKEN(GL_CURRENT_TEXTURE_COORDS),
      TOKEN(GL_EDGE_FLAG),
      TOKEN(GL_CURRENT_SECONDARY_COLOR),
      TOKEN(GL_CURRENT_FOG_COORD),
      TOKEN(GL_CURRENT_VERTEX_ATTRIB),
      TOKEN(GL_CURRENT_RASTER_POSITION),
      TOKEN(GL_CURRENT_RASTER_COLOR),
      TOKEN(GL_CURRENT_RASTER_TEXTURE_COORDS),
      TOKEN(GL_CURRENT_RASTER_POSITION_VALID),
      TOKEN(GL_CURRENT_RASTER_DISTANCE),
      TOKEN(GL_COMPILE),
      TOKEN(GL_VERTEX_ARRAY),
      TOKEN(GL_NORMAL_ARRAY),
      TOKEN(GL_TEXTURE_COORD_ARRAY),
      TOKEN(GL_LIGHT0),
      TOKEN(GL_POSITION),
      TOKEN(GL_AMBIENT),
      TOKEN(GL_DIFFUSE),
      TOKEN(GL_SPECULAR),
      TOKEN(GL_EMISSION),
      TOKEN(GL_LIGHT_MODEL_AMBIENT),
      TOKEN(GL_FRONT),
      TOKEN(GL_BACK),
      TOKEN(GL_FRONT_AND_BACK),
      TOKEN(GL_FOG),
      TOKEN(GL_FOG_MODE),
      TOKEN(GL_FOG_START),
      TOKEN(GL_FOG_END),
      TOKEN(GL_FOG_COLOR),
      TOKEN(GL_FOG_DENSITY),
      TOKEN(GL_LINEAR),
      TOKEN(GL_CLIP_PLANE0),
      TOKEN(GL_COLOR_BUFFER_BIT),
      TOKEN(GL_DEPTH_TEST),
      TOKEN(GL_ACTIVE_TEXTURE),
      TOKEN(GL_MAX_TEXTURE_COORDS),
      TOKEN(GL_MAX_TEXTURE_UNITS),
      TOKEN(GL_VENDOR),
      TOKEN(GL_RENDERER),
      TOKEN(GL_VERSION),
      TOKEN(GL_EXTENSIONS),
      TOKEN(GL_NUM_EXTENSIONS),
      TOKEN(GL_TEXTURE0),
      TOKEN(GL_TEXTURE1),
      TOKEN(GL_TEXTURE2),
      TOKEN(GL_TEXTURE3),
      TOKEN(GL_TEXTURE_1D),
      TOKEN(GL_TEXTURE_2D),
      TOKEN(GL_MODELVIEW),
      TOKEN(GL_PROJECTION),
      TOKEN(GL_TEXTURE),
      TOKEN(GL_2D),
      TOKEN(GL_3D),
      TOKEN(GL_3D_COLOR),
      TOKEN(GL_3D_COLOR_TEXTURE),
      TOKEN(GL_4D_COLOR_TEXTURE),
      TOKEN(GL_RENDER),
      TOKEN(GL_FEEDBACK),
      TOKEN(GL_SELECT),
      TOKEN(GL_TEXTURE_GEN_S),
      TOKEN(GL_TEXTURE_GEN_T),
      TOKEN(GL_TEXTURE_GEN_R),
      TOKEN(GL_TEXTURE_GEN_Q),
      TOKEN(GL_S),
      TOKEN(GL_T),
      TOKEN(GL_R),
      TOKEN(GL_Q),
      TOKEN(GL_TEXTURE_GEN_MODE),
      TOKEN(GL_OBJECT_LINEAR),
      TOKEN(GL_OBJECT_PLANE),
      TOKEN(GL_NORMAL_MAP),
      TOKEN(GL_RGBA),
      TOKEN(GL_UNSIGNED_BYTE),
      TOKEN(GL_TEXTURE_MIN_FILTER),
      TOKEN(GL_TEXTURE_MAG_FILTER),
      TOKEN(GL_NEAREST),
      TOKEN(GL_CLAMP_VERTEX_COLOR),
      TOKEN(GL_CLAMP_FRAGMENT_COLOR),
      TOKEN(GL_VERTEX_SHADER),
      TOKEN(GL_COMPILE_STATUS),
      TOKEN(GL_LINK_STATUS),
      TOKEN(GL_INTERLEAVED_ATTRIBS),
      TOKEN(GL_TRANSFORM_FEEDBACK_BUFFER),
      TOKEN(GL_STATIC_READ),
      TOKEN(GL_STATIC_DRAW),
      TOKEN(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN),
      TOKEN(GL_QUERY_RESULT),
      TOKEN(GL_RASTERIZER_DISCARD),
      TOKEN(GL_PRIMITIVES_GENERATED),
      TOKEN(GL_ARRAY_BUFFER),
      TOKEN(GL_PIXEL_UNPACK_BUFFER),
      TOKEN(GL_PIXEL_PACK_BUFFER),
      TOKEN(GL_UNPACK_SWAP_BYTES),
      TOKEN(GL_UNPACK_LSB_FIRST),
      TOKEN(GL_UNPACK_ROW_LENGTH),
      TOKEN(GL_UNPACK_SKIP_ROWS),
      TOKEN(GL_UNPACK_SKIP_PIXELS),
      TOKEN(GL_UNPACK_ALIGNMENT),
      TOKEN(GL_POINTS),
      TOKEN(GL_LINES),
      TOKEN(GL_LINE_LOOP),
      TOKEN(GL_LINE_STRIP),
      TOKEN(GL_TRIANGLES),
      TOKEN(GL_COLOR_ARRAY),
      TOKEN(GL_LIGHTING),
      TOKEN(GL_COLOR_MATERIAL)};
#undef TOKEN
  return table;
}

}  // namespace

std::string token_name(GLenum token) {
  if (token == 0) return "0";
  const auto found = names().find(token);
  return found == names().end() ? fmt::format("0x{:04X}", token) : found->second;
}

std::string primitive_name(GLenum mode) {
  constexpr std::array<const char*, 10> kModes = {
      "GL_POINTS",         "GL_LINES",        "GL_LINE_LOOP", "GL_LINE_STRIP", "GL_TRIANGLES",
      "GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN", "GL_QUADS",     "GL_QUAD_STRIP", "GL_POLYGON"};
  return mode < kModes.size() ? kModes[mode] : fmt::format("0x{:04X}", mode);
}

std::string error_name(GLenum error) {
  switch (error) {
    case GL_NO_ERROR:
      return "GL_NO_ERROR";
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_STACK_OVERFLOW:
      return "GL_STACK_OVERFLOW";
    case GL_STACK_UNDERFLOW:
      return "GL_STACK_UNDERFLOW";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    default:
      return fmt::format("0x{:04X}", error);
  }
}

int components_of(GLenum target) {
  switch (target) {
    case GL_MAP1_INDEX:
    case GL_MAP2_INDEX:
    case GL_MAP1_TEXTURE_COORD_1:
    case GL_MAP2_TEXTURE_COORD_1:
      return 1;
    case GL_MAP1_TEXTURE_COORD_2:
    case GL_MAP2_TEXTURE_COORD_2:
      return 2;
    case GL_MAP1_NORMAL:
    case GL_MAP2_NORMAL:
    case GL_MAP1_TEXTURE_COORD_3:
    case GL_MAP2_TEXTURE_COORD_3:
    case GL_MAP1_VERTEX_3:
    case GL_MAP2_VERTEX_3:
      return 3;
    case GL_MAP1_COLOR_4:
    case GL_MAP2_COLOR_4:
    case GL_MAP1_TEXTURE_COORD_4:
    case GL_MAP2_TEXTURE_COORD_4:
    case GL_MAP1_VERTEX_4:
    case GL_MAP2_VERTEX_4:
      return 4;
    default:
      return 0;
  }
}

}  // namespace evalcts::gl
