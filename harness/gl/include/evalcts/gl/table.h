// The table of GL entry points. Suites and captures call a GL only through a table; no program links to a GL.
#pragma once

// The build defines GL_GLEXT_PROTOTYPES. Only the types of the declarations are used, not their addresses.
#include <GL/gl.h>
#include <GL/glext.h>

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <set>
#include <string>
#include <string_view>

#include <evalcts/gl/contexts.h>
#include <evalcts/gl/requests.h>

namespace evalcts::gl {

enum class EntryPoint : int {
#define GL_ENTRY(name, kinds) name,
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
};

inline constexpr std::size_t kEntryPointCount = 0
#define GL_ENTRY(name, kinds) +1
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
    ;

// Function pointers with the types of the Khronos headers; null if the implementation does not
// provide the command.
struct Table {
#define GL_ENTRY(name, kinds) decltype(&::gl##name) name = nullptr;
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
};

// Returns the command's name with its "gl" prefix.
std::string_view name_of(EntryPoint entry);

// Returns one letter for each parameter, see entry_points.def.
std::string_view parameter_kinds(EntryPoint entry);

// Returns true if the table has an address for the command.
bool has(const Table& table, EntryPoint entry);

// Returns the address of a command, such as "glMap1f", or null.
using AddressOf = std::function<void*(const char* name)>;

// The version (10 * major + minor; 0: unknown) and the extensions that a GL advertises.
struct Advertised {
  int version = 0;
  std::set<std::string, std::less<>> extensions;
};
// Parses the answers to GetString(GL_VERSION) and GetString(GL_EXTENSIONS).
Advertised parse_advertised(const std::string& version, const std::string& extensions);

// Returns a table in which each address comes from the first source that provides the command, under its core
// name or its name in the extension that introduced it. If the version is too low for the command and the
// extension is advertised, the extension's name is tried first: a get-proc-address function may return an
// address for any name, so that the core name would yield a function without effect. For the same reason,
// sources that return only existing commands (symbols that a library exports) must come first, and callers
// probe implementations for effects afterwards.
Table load_table(std::initializer_list<AddressOf> sources, const Advertised& advertised = {});

}  // namespace evalcts::gl
