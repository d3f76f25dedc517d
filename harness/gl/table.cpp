#include "harness/gl/table.h"

#include <array>

namespace evalcts::gl {
namespace {

struct Description {
  std::string_view name;
  std::string_view kinds;
};

constexpr std::array<Description, kEntryPointCount> kDescriptions = {{
#define GL_ENTRY(name, kinds) {"gl" #name, kinds},
#include "harness/gl/entry_points.def"
#undef GL_ENTRY
}};

}  // namespace

std::string_view name_of(EntryPoint entry) { return kDescriptions[static_cast<std::size_t>(entry)].name; }

std::string_view parameter_kinds(EntryPoint entry) {
  return kDescriptions[static_cast<std::size_t>(entry)].kinds;
}

bool has(const Table& table, EntryPoint entry) {
  switch (entry) {
#define GL_ENTRY(name, kinds) \
  case EntryPoint::name:      \
    return table.name != nullptr;
#include "harness/gl/entry_points.def"
#undef GL_ENTRY
  }
  return false;
}

Table load_table(const std::function<void*(const char*)>& address_of) {
  Table table;
#define GL_ENTRY(name, kinds) table.name = reinterpret_cast<decltype(table.name)>(address_of("gl" #name));
#include "harness/gl/entry_points.def"
#undef GL_ENTRY
  return table;
}

}  // namespace evalcts::gl
