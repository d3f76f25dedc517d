// The table of GL entry points. Suites and captures reach a GL only through it; nothing links to one.
#pragma once

// The build defines GL_GLEXT_PROTOTYPES: only the types of the declarations are used, never their addresses.
#include <GL/gl.h>
#include <GL/glext.h>

#include <cstddef>
#include <functional>
#include <string_view>

namespace evalcts::gl {

enum class EntryPoint : int {
#define GL_ENTRY(name, kinds) name,
#include "harness/gl/entry_points.def"
#undef GL_ENTRY
};

inline constexpr std::size_t kEntryPointCount = 0
#define GL_ENTRY(name, kinds) +1
#include "harness/gl/entry_points.def"
#undef GL_ENTRY
    ;

// Function pointers with the types of the Khronos headers; null where the implementation has no such command.
struct Table {
#define GL_ENTRY(name, kinds) decltype(&::gl##name) name = nullptr;
#include "harness/gl/entry_points.def"
#undef GL_ENTRY
};

// The command's name with its "gl" prefix.
std::string_view name_of(EntryPoint entry);

// One letter for each parameter, see entry_points.def.
std::string_view parameter_kinds(EntryPoint entry);

// True where the table has an address for the command.
bool has(const Table& table, EntryPoint entry);

// Fills a table by name ("glMap1f" -> address or null). A non-null address proves nothing: GL libraries hand
// out addresses for any name, so implementations are probed for effect afterwards.
Table load_table(const std::function<void*(const char*)>& address_of);

}  // namespace evalcts::gl
