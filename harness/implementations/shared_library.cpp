#include "harness/implementations/shared_library.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include "harness/implementations/implementation.h"

namespace evalcts {

SharedLibrary::SharedLibrary(const std::string& name)
    : name_(name), handle_(dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (handle_) return;
  const char* why = dlerror();
  throw CannotStart(fmt::format("cannot load '{}': {}", name, why ? why : "no reason given"));
}

void* SharedLibrary::find(const char* symbol) const { return dlsym(handle_, symbol); }

std::string SharedLibrary::path() const {
  const link_map* map = nullptr;
  if (dlinfo(handle_, RTLD_DI_LINKMAP, &map) == 0 && map && map->l_name && *map->l_name) return map->l_name;
  return name_;
}

}  // namespace evalcts
