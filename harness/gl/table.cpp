#include <evalcts/gl/table.h>

#include <array>

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

const char* other_name(std::string_view name) {
  if (name == "glGetnMapfv") return "glGetnMapfvARB";
  if (name == "glGetnMapdv") return "glGetnMapdvARB";
  if (name == "glGetnMapiv") return "glGetnMapivARB";
  return nullptr;
}

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
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
  }
  return false;
}

Table load_table(std::initializer_list<AddressOf> sources) {
  // Names of the same command; the second one before it became part of the GL.
  const auto address = [&](const char* name, const char* other) -> void* {
    for (const AddressOf& source : sources)
      for (const char* const candidate : {name, other})
        if (candidate)
          if (void* const found = source(candidate)) return found;
    return nullptr;
  };
  Table table;
  // No library has the commands of contexts.h, whatever a get-proc-address function says.
  const auto is_ours = [](std::string_view name) { return name.ends_with("EVALCTS"); };
#define GL_ENTRY(name, kinds) \
  if (!is_ours(#name))        \
    table.name = reinterpret_cast<decltype(table.name)>(address("gl" #name, other_name("gl" #name)));
#include <evalcts/gl/entry_points.def>
#undef GL_ENTRY
  return table;
}

}  // namespace evalcts::gl
