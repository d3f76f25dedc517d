// Opens shared libraries with LoadLibrary().
#include <fmt/format.h>
#include <windows.h>
// After windows.h.
#include <psapi.h>

#include <array>

#include <evalcts/backends/implementation.h>
#include "shared_library.h"

namespace evalcts {
namespace {

std::string file_of(HMODULE module) {
  std::array<char, 1024> path{};
  return {path.data(), GetModuleFileNameA(module, path.data(), path.size())};
}

std::string reason(DWORD error) {
  if (error == ERROR_MOD_NOT_FOUND)
    return "the system finds no file of this name, or not one that it depends on; give the whole path, "
           "and put libraries that it depends on next to it";
  if (error == ERROR_BAD_EXE_FORMAT) return "it is not a library for 64-bit Windows on x86-64";
  return fmt::format("Windows error {}", error);
}

HMODULE open(const std::string& name) {
  // A whole path also makes the system look for dependencies next to the library.
  const bool is_path = name.find_first_of("/\\") != std::string::npos;
  std::string path = name;
  for (char& c : path)
    if (c == '/') c = '\\';
  if (HMODULE const library =
          LoadLibraryExA(path.c_str(), nullptr, is_path ? LOAD_WITH_ALTERED_SEARCH_PATH : 0))
    return library;
  throw CannotStart(fmt::format("cannot load '{}': {}", name, reason(GetLastError())));
}

}  // namespace

SharedLibrary::SharedLibrary(const std::string& name, const std::string& in_front)
    : name_(name), handle_(open(name)), front_(in_front.empty() ? nullptr : open(in_front)) {}

void* SharedLibrary::find(const char* symbol) const { return exported(symbol); }

void* SharedLibrary::exported(const char* symbol) const {
  for (void* const library : {front_, handle_})
    if (library)
      if (const FARPROC address = GetProcAddress(static_cast<HMODULE>(library), symbol))
        return reinterpret_cast<void*>(address);
  return nullptr;
}

std::string SharedLibrary::path() const { return file_of(static_cast<HMODULE>(front_ ? front_ : handle_)); }

std::vector<std::string> loaded_libraries() {
  std::array<HMODULE, 1024> modules{};
  DWORD bytes = 0;
  std::vector<std::string> files;
  if (!EnumProcessModules(GetCurrentProcess(), modules.data(), sizeof modules, &bytes)) return files;
  for (std::size_t i = 0; i < std::min<std::size_t>(bytes / sizeof(HMODULE), modules.size()); ++i)
    files.push_back(file_of(modules[i]));
  return files;
}

}  // namespace evalcts
