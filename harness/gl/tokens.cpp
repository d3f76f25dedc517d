// The table of tokens that cases use, with their names.
#include <evalcts/gl/tokens.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_map>

#include <evalcts/gl/targets.h>

namespace evalcts::gl {
namespace {

// One name for each value. GL_ZERO, GL_NO_ERROR and GL_POINTS share the value 0, so the caller has to choose
// a function by the meaning of the value.
#define TOKENS(...)                           \
  constexpr GLenum kValues[] = {__VA_ARGS__}; \
  constexpr std::string_view kSpelled = #__VA_ARGS__;
TOKENS(GL_MAP1_COLOR_4, GL_MAP1_INDEX, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_1, GL_MAP1_TEXTURE_COORD_2,
       GL_MAP1_TEXTURE_COORD_3, GL_MAP1_TEXTURE_COORD_4, GL_MAP1_VERTEX_3, GL_MAP1_VERTEX_4, GL_MAP2_COLOR_4,
       GL_MAP2_INDEX, GL_MAP2_NORMAL, GL_MAP2_TEXTURE_COORD_1, GL_MAP2_TEXTURE_COORD_2,
       GL_MAP2_TEXTURE_COORD_3, GL_MAP2_TEXTURE_COORD_4, GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4, GL_AUTO_NORMAL,
       GL_MAP1_GRID_DOMAIN, GL_MAP1_GRID_SEGMENTS, GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS,
       GL_MAX_EVAL_ORDER, GL_COEFF, GL_ORDER, GL_DOMAIN, GL_POINT, GL_LINE, GL_FILL, GL_CURRENT_COLOR,
       GL_CURRENT_INDEX, GL_CURRENT_NORMAL, GL_CURRENT_TEXTURE_COORDS, GL_EDGE_FLAG,
       GL_CURRENT_SECONDARY_COLOR, GL_CURRENT_FOG_COORD, GL_CURRENT_VERTEX_ATTRIB, GL_CURRENT_RASTER_POSITION,
       GL_CURRENT_RASTER_COLOR, GL_CURRENT_RASTER_TEXTURE_COORDS, GL_CURRENT_RASTER_POSITION_VALID,
       GL_CURRENT_RASTER_DISTANCE, GL_COMPILE, GL_COMPILE_AND_EXECUTE, GL_AMBIENT_AND_DIFFUSE,
       GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_TEXTURE_COORD_ARRAY, GL_LIGHT0, GL_POSITION, GL_AMBIENT,
       GL_DIFFUSE, GL_SPECULAR, GL_EMISSION, GL_LIGHT_MODEL_AMBIENT, GL_FRONT, GL_BACK, GL_FRONT_AND_BACK,
       GL_FOG, GL_INDEX_LOGIC_OP, GL_COLOR_LOGIC_OP, GL_FOG_MODE, GL_FOG_START, GL_FOG_END, GL_FOG_COLOR,
       GL_FOG_DENSITY, GL_LINEAR, GL_CLIP_PLANE0, GL_COLOR_BUFFER_BIT, GL_DEPTH_TEST, GL_ACTIVE_TEXTURE,
       GL_MAX_TEXTURE_COORDS, GL_MAX_TEXTURE_UNITS, GL_VENDOR, GL_RENDERER, GL_VERSION, GL_EXTENSIONS,
       GL_NUM_EXTENSIONS, GL_TEXTURE0, GL_TEXTURE1, GL_TEXTURE2, GL_TEXTURE3, GL_TEXTURE4, GL_TEXTURE5,
       GL_TEXTURE6, GL_TEXTURE7, GL_TEXTURE_1D, GL_TEXTURE_2D, GL_MODELVIEW, GL_PROJECTION, GL_TEXTURE, GL_2D,
       GL_3D, GL_3D_COLOR, GL_3D_COLOR_TEXTURE, GL_4D_COLOR_TEXTURE, GL_RENDER, GL_FEEDBACK, GL_SELECT,
       GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_TEXTURE_GEN_R, GL_TEXTURE_GEN_Q, GL_S, GL_T, GL_R, GL_Q,
       GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR, GL_OBJECT_PLANE, GL_NORMAL_MAP, GL_RGBA, GL_UNSIGNED_BYTE,
       GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER, GL_NEAREST, GL_CLAMP_VERTEX_COLOR,
       GL_CLAMP_FRAGMENT_COLOR, GL_VERTEX_SHADER, GL_COMPILE_STATUS, GL_LINK_STATUS, GL_INTERLEAVED_ATTRIBS,
       GL_TRANSFORM_FEEDBACK_BUFFER, GL_STATIC_READ, GL_STATIC_DRAW, GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN,
       GL_QUERY_RESULT, GL_RASTERIZER_DISCARD, GL_PRIMITIVES_GENERATED, GL_ARRAY_BUFFER,
       GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_PACK_BUFFER, GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST,
       GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_ALIGNMENT, GL_POINTS,
       GL_LINES, GL_LINE_LOOP, GL_LINE_STRIP, GL_TRIANGLES, GL_COLOR_ARRAY, GL_LIGHTING, GL_COLOR_MATERIAL,
       GL_LIGHT_MODEL_TWO_SIDE, GL_CULL_FACE, GL_CW, GL_CCW, GL_FLAT, GL_SMOOTH, GL_FIRST_VERTEX_CONVENTION,
       GL_LAST_VERTEX_CONVENTION, GL_QUADS_FOLLOW_PROVOKING_VERTEX_CONVENTION, GL_LINE_STIPPLE,
       GL_POLYGON_OFFSET_POINT, GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_FILL, GL_NORMALIZE,
       GL_RESCALE_NORMAL, GL_DEPTH_COMPONENT, GL_RED, GL_FLOAT, GL_VERTEX_PROGRAM_ARB,
       GL_PROGRAM_FORMAT_ASCII_ARB, GL_CONTEXT_FLAGS, GL_CONTEXT_PROFILE_MASK, GL_SPHERE_MAP, GL_EYE_LINEAR)
#undef TOKENS

const std::unordered_map<GLenum, std::string>& names() {
  static const std::unordered_map<GLenum, std::string> kTable = [] {
    std::unordered_map<GLenum, std::string> all;
    std::size_t begin = 0;
    for (const GLenum value : kValues) {
      const std::size_t end = std::min(kSpelled.find(',', begin), kSpelled.size());
      all.emplace(value, kSpelled.substr(begin, end - begin));
      begin = end + 2;
    }
    return all;
  }();
  return kTable;
}

}  // namespace

const char* known_token(GLenum token) {
  const auto found = names().find(token);
  return found == names().end() ? nullptr : found->second.c_str();
}

std::string token_name(GLenum token) {
  if (token == 0) return "0";
  const char* const name = known_token(token);
  return name ? name : fmt::format("0x{:04X}", token);
}

const char* known_primitive(GLenum mode) {
  constexpr std::array<const char*, 10> kModes = {
      "GL_POINTS",         "GL_LINES",        "GL_LINE_LOOP", "GL_LINE_STRIP", "GL_TRIANGLES",
      "GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN", "GL_QUADS",     "GL_QUAD_STRIP", "GL_POLYGON"};
  return mode < kModes.size() ? kModes[mode] : nullptr;
}

std::string primitive_name(GLenum mode) {
  const char* const name = known_primitive(mode);
  return name ? name : fmt::format("0x{:04X}", mode);
}

std::string error_name(GLenum error) {
#define NAMED(name) std::pair(GLenum{name}, #name)
  for (const auto& [code, name] :
       {NAMED(GL_NO_ERROR), NAMED(GL_INVALID_ENUM), NAMED(GL_INVALID_VALUE), NAMED(GL_INVALID_OPERATION),
        NAMED(GL_STACK_OVERFLOW), NAMED(GL_STACK_UNDERFLOW), NAMED(GL_OUT_OF_MEMORY),
        NAMED(GL_INVALID_FRAMEBUFFER_OPERATION)})
    if (code == error) return name;
#undef NAMED
  return fmt::format("0x{:04X}", error);
}

const std::vector<GLenum>& all_targets() {
  static const std::vector<GLenum> kAll = [] {
    std::vector<GLenum> both(kMap1Targets.begin(), kMap1Targets.end());
    both.insert(both.end(), kMap2Targets.begin(), kMap2Targets.end());
    return both;
  }();
  return kAll;
}

const std::vector<GLenum>& all_caps() {
  static const std::vector<GLenum> kAll = [] {
    std::vector<GLenum> caps = all_targets();
    caps.push_back(GL_AUTO_NORMAL);
    return caps;
  }();
  return kAll;
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
