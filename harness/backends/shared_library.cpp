// Opens shared libraries with dlopen(). Explains why a file cannot be loaded, for example because it is built
// for another machine.
#include "shared_library.h"

#include <dlfcn.h>
#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <evalcts/backends/implementation.h>

namespace evalcts {
namespace {

const link_map* map_of(void* handle) {
  const link_map* map = nullptr;
  return dlinfo(handle, RTLD_DI_LINKMAP, &map) == 0 ? map : nullptr;
}

// The beginning of an ELF file. Libraries for this machine begin like the file of this program.
using ElfHead = std::array<unsigned char, 20>;

ElfHead head_of(const std::string& file) {
  ElfHead head{};
  std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(head.data()), head.size());
  return head;
}

int machine_of(const ElfHead& head) {
  return head[EI_DATA] == ELFDATA2MSB ? head[18] << 8 | head[19] : head[19] << 8 | head[18];
}

std::string machine_name(const ElfHead& head) {
  const int bits = head[EI_CLASS] == ELFCLASS64 ? 64 : 32;
  switch (machine_of(head)) {
    case EM_386:
      return "i386 (32-bit)";
    case EM_X86_64:
      return bits == 64 ? "x86-64" : "x32";
    case EM_ARM:
      return "Arm (32-bit)";
    case EM_AARCH64:
      return "AArch64";
    case EM_RISCV:
      return fmt::format("RISC-V ({}-bit)", bits);
    case EM_PPC64:
      return "POWER (64-bit)";
    default:
      return fmt::format("ELF machine {} ({}-bit)", machine_of(head), bits);
  }
}

// Returns the reason for which the file at a path cannot be a library for this process; empty if there is
// none.
std::string problem_of_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return "no such file; give the path of a shared library";
  if (std::filesystem::is_directory(status)) return "it is a directory; give the path of a shared library";
  if (!std::ifstream(path)) return fmt::format("it cannot be read: {}", std::strerror(errno));
  const ElfHead head = head_of(path), own = head_of("/proc/self/exe");
  if (std::memcmp(head.data(), ELFMAG, SELFMAG) != 0)
    return "it is not a shared library: it does not begin with an ELF header";
  if (machine_of(head) != machine_of(own) || head[EI_CLASS] != own[EI_CLASS])
    return fmt::format("it is built for {}, but this evalcts is built for {}; give a library for {}",
                       machine_name(head), machine_name(own), machine_name(own));
  return {};
}

// Returns a message with the problem and its solution for a name that dlopen rejects with the message
// `loader`.
std::string explain(const std::string& name, const std::string& loader) {
  const bool is_path = name.find('/') != std::string::npos;
  if (is_path)
    if (std::string problem = problem_of_file(name); !problem.empty()) return problem;
  // "FILE: cannot open shared object file: ...": of the library itself, or of one that it depends on.
  const std::string missing = loader.substr(0, loader.find(": cannot open shared object file"));
  if (missing == loader) return fmt::format("the dynamic loader says: {}", loader);
  if (missing != name)
    return fmt::format(
        "it depends on {0}, which the dynamic loader does not find; install that library, or name its "
        "directory "
        "in LD_LIBRARY_PATH ('ldd' lists all dependencies)",
        missing);
  return std::filesystem::exists(name)
             ? fmt::format(
                   "a name without '/' is looked for in the system's directories; the file in this "
                   "directory is './{}'",
                   name)
             : "the dynamic loader finds no library of this name; install it, give its path, or name its "
               "directory in LD_LIBRARY_PATH";
}

void* open(const std::string& name) {
  if (void* handle = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) return handle;
  const char* why = dlerror();
  throw CannotStart(fmt::format("cannot load '{}': {}", name, explain(name, why ? why : "no reason given")));
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

std::vector<std::string> loaded_libraries() {
  std::vector<std::string> files;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* all) {
        static_cast<std::vector<std::string>*>(all)->emplace_back(info->dlpi_name);
        return 0;
      },
      &files);
  return files;
}

}  // namespace evalcts
