// Looks up the entry points of a library by their names in GL and in its extensions.
#include <evalcts/gl/table.h>

#include <array>
#include <sstream>
#include <utility>

#include "promotions.h"

namespace evalcts::gl {
namespace {

struct Description {
  std::string_view name;
  std::string_view kinds;
};

constexpr std::array<Description, kEntryPointCount> kDescriptions = {{
#define GL_ENTRY(name, kinds) {"gl" #name, kinds},
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
}};

// Commands of an extension that became part of a GL version.
struct Promotion {
  std::string_view beginning;  // common beginning of the names of the commands
  int since;                   // 10 * major + minor
  std::string_view extension;
  std::string_view suffix;
};

constexpr Promotion kPromotions[] = {
    {"glActiveTexture", 13, "GL_ARB_multitexture", "ARB"},
    {"glMultiTexCoord", 13, "GL_ARB_multitexture", "ARB"},
    {"glSecondaryColor", 14, "GL_EXT_secondary_color", "EXT"},
    {"glFogCoord", 14, "GL_EXT_fog_coord", "EXT"},
    {"glGenBuffers", 15, "GL_ARB_vertex_buffer_object", "ARB"},
    {"glBindBuffer", 15, "GL_ARB_vertex_buffer_object", "ARB"},
    {"glBufferData", 15, "GL_ARB_vertex_buffer_object", "ARB"},
    {"glGetBufferSubData", 15, "GL_ARB_vertex_buffer_object", "ARB"},
    {"glDeleteBuffers", 15, "GL_ARB_vertex_buffer_object", "ARB"},
    {"glGenQueries", 15, "GL_ARB_occlusion_query", "ARB"},
    {"glBeginQuery", 15, "GL_ARB_occlusion_query", "ARB"},
    {"glEndQuery", 15, "GL_ARB_occlusion_query", "ARB"},
    {"glGetQueryObjectuiv", 15, "GL_ARB_occlusion_query", "ARB"},
    {"glDeleteQueries", 15, "GL_ARB_occlusion_query", "ARB"},
    {"glVertexAttrib", 20, "GL_ARB_vertex_program", "ARB"},
    {"glGetVertexAttrib", 20, "GL_ARB_vertex_program", "ARB"},
    {"glClampColor", 30, "GL_ARB_color_buffer_float", "ARB"},
    {"glTransformFeedbackVaryings", 30, "GL_EXT_transform_feedback", "EXT"},
    {"glBindBufferBase", 30, "GL_EXT_transform_feedback", "EXT"},
    {"glBeginTransformFeedback", 30, "GL_EXT_transform_feedback", "EXT"},
    {"glEndTransformFeedback", 30, "GL_EXT_transform_feedback", "EXT"},
    {"glGenFramebuffers", 30, "GL_EXT_framebuffer_object", "EXT"},
    {"glBindFramebuffer", 30, "GL_EXT_framebuffer_object", "EXT"},
    {"glCheckFramebufferStatus", 30, "GL_EXT_framebuffer_object", "EXT"},
    {"glDeleteFramebuffers", 30, "GL_EXT_framebuffer_object", "EXT"},
    {"glBeginConditionalRender", 30, "GL_NV_conditional_render", "NV"},
    {"glEndConditionalRender", 30, "GL_NV_conditional_render", "NV"},
    {"glPrimitiveRestartIndex", 31, "GL_NV_primitive_restart", "NV"},
    {"glProvokingVertex", 32, "GL_EXT_provoking_vertex", "EXT"},
    {"glGetDebugMessageLog", 43, "GL_ARB_debug_output", "ARB"},
    // Mesa has these commands under the extension's names only, even in GL 4.5; libglvnd returns addresses
    // without effect for the core names.
    {"glGetnMap", 99, "GL_ARB_robustness", "ARB"},
};

// Returns the last matching row, because "glBindBufferBase" begins with "glBindBuffer" as well.
const Promotion* promotion_of(std::string_view name) {
  const Promotion* last = nullptr;
  for (const Promotion& promotion : kPromotions)
    if (name.starts_with(promotion.beginning)) last = &promotion;
  return last;
}

}  // namespace

std::string_view name_of(EntryPoint entry) { return kDescriptions[static_cast<std::size_t>(entry)].name; }

std::string name_in_extension(std::string_view name) {
  const Promotion* const promotion = promotion_of(name);
  return promotion ? std::string(name) + std::string(promotion->suffix) : std::string();
}

std::string_view parameter_kinds(EntryPoint entry) {
  return kDescriptions[static_cast<std::size_t>(entry)].kinds;
}

bool has(const Table& table, EntryPoint entry) {
  switch (entry) {
#define GL_ENTRY(name, kinds) \
  case EntryPoint::name:      \
    return table.name != nullptr;
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
  }
  return false;
}

Advertised parse_advertised(const std::string& version, const std::string& extensions) {
  Advertised advertised;
  // The format is "<major>.<minor>[.release] [vendor text]" (GL 2.1 §6.1.11).
  std::istringstream text(version);
  int major = 0, minor = 0;
  char dot = 0;
  if (text >> major >> dot >> minor && dot == '.') advertised.version = 10 * major + minor;
  std::istringstream words(extensions);
  for (std::string word; words >> word;) advertised.extensions.insert(word);
  return advertised;
}

Table load_table(std::initializer_list<AddressOf> sources, const Advertised& advertised) {
  const auto address = [&](const char* name) -> void* {
    std::string names[] = {name, name_in_extension(name)};
    if (const Promotion* const promotion = promotion_of(name)) {
      if (advertised.version < promotion->since && advertised.extensions.contains(promotion->extension))
        std::swap(names[0], names[1]);
    }
    for (const AddressOf& source : sources)
      for (const std::string& candidate : names)
        if (!candidate.empty())
          if (void* const found = source(candidate.c_str())) return found;
    return nullptr;
  };
  Table table;
  // Commands of the harness are not looked up, because a get-proc-address function may return addresses for
  // them.
#define GL_ENTRY(name, kinds) table.name = reinterpret_cast<decltype(table.name)>(address("gl" #name));
#define HARNESS_ENTRY(name, kinds)
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
  return table;
}

}  // namespace evalcts::gl
