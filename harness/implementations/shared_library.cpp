#include "harness/implementations/shared_library.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <filesystem>

#include "harness/implementations/implementation.h"

namespace evalcts {
namespace {

const link_map* map_of(void* handle) {
  const link_map* map = nullptr;
  return dlinfo(handle, RTLD_DI_LINKMAP, &map) == 0 ? map : nullptr;
}

void* open(const std::string& name) {
  if (void* handle = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) return handle;
  const char* why = dlerror();
  const bool here = name.find('/') == std::string::npos && std::filesystem::exists(name);
  throw CannotStart(fmt::format("cannot load '{}': {}{}", name, why ? why : "no reason given",
                                here ? fmt::format(" (the file in this folder is './{}')", name) : ""));
}

void* own_symbol(void* handle, const char* symbol) {
  void* address = dlsym(handle, symbol);
  Dl_info info{};
  link_map* owner = nullptr;
  if (!address || !dladdr1(address, &info, reinterpret_cast<void**>(&owner), RTLD_DL_LINKMAP)) return nullptr;
  return owner == map_of(handle) ? address : nullptr;
}

}  // namespace

SharedLibrary::SharedLibrary(const std::string& name, const std::string& in_front)
    : name_(name), handle_(open(name)), front_(in_front.empty() ? nullptr : open(in_front)) {}

void* SharedLibrary::find(const char* symbol) const {
  if (void* address = front_ ? own_symbol(front_, symbol) : nullptr) return address;
  return dlsym(handle_, symbol);
}

void* SharedLibrary::exported(const char* symbol) const {
  if (void* address = front_ ? own_symbol(front_, symbol) : nullptr) return address;
  return own_symbol(handle_, symbol);
}

std::string SharedLibrary::path() const {
  const link_map* map = map_of(front_ ? front_ : handle_);
  return map && map->l_name && *map->l_name ? map->l_name : name_;
}

}  // namespace evalcts
