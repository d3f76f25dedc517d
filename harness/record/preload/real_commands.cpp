// Finds the functions behind those of the recorder, and answers lookups of the program.
#include "real_commands.h"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <initializer_list>
#include <string_view>

namespace evalcts::record {

std::atomic<void*> real_functions[kFunctions];

namespace {

using Lookup = void*(void* handle, const char* name);

// Returns dlsym of the C library, because this library has another one.
Lookup* system_lookup() {
  static std::atomic<Lookup*> found;
  Lookup* lookup = found.load(std::memory_order_relaxed);
  if (lookup != nullptr) return lookup;
  // The oldest version of the function on each architecture.
  for (const char* const version : {"GLIBC_2.2.5", "GLIBC_2.17", "GLIBC_2.27", "GLIBC_2.0", "GLIBC_2.34"}) {
    lookup = reinterpret_cast<Lookup*>(dlvsym(RTLD_NEXT, "dlsym", version));
    if (lookup != nullptr) break;
  }
  found.store(lookup, std::memory_order_relaxed);
  return lookup;
}

// Keeps errno as it is for the program.
struct KeepErrno {
  int before = errno;
  ~KeepErrno() { errno = before; }
};

// Returns the number of a function of the recorder, or -1.
int number_of(const char* name) {
  if (name == nullptr) return -1;
  if (std::strncmp(name, "gl", 2) != 0 && std::strncmp(name, "egl", 3) != 0 &&
      std::strncmp(name, "OSMesa", 6) != 0)
    return -1;
  for (int i = 0; i < kFunctions; ++i)
    if (std::strcmp(kNames[i], name) == 0) return i;
  return -1;
}

// Returns the file name of the library that contains the function.
std::string_view library_of(void* function) {
  Dl_info info;
  if (dladdr(function, &info) == 0) return {};
  std::string_view path = info.dli_fname;
  path.remove_prefix(path.rfind('/') + 1);
  return path;
}

// Returns true if both functions, which have the same name, are one command: libraries export entry points,
// and lookups return those of the library that dispatches commands, or others in the same library.
bool are_equivalent(void* one, void* other) {
  if (one == other) return true;
  const std::string_view libraries[] = {library_of(one), library_of(other)};
  if (!libraries[0].empty() && libraries[0] == libraries[1]) return true;
  const auto dispatches = [&](int i, const char* dispatcher, std::initializer_list<const char*> exporters) {
    return libraries[i].starts_with(dispatcher) &&
           std::any_of(exporters.begin(), exporters.end(),
                       [&](const char* exporter) { return libraries[1 - i].starts_with(exporter); });
  };
  for (const int i : {0, 1})
    if (dispatches(i, "libGLdispatch.so", {"libGL.so", "libOpenGL.so"}) ||
        dispatches(i, "libglapi.so", {"libOSMesa.so"}))
      return true;
  return false;
}

// Keeps the library of a function loaded, even if the program closes it.
void pin(void* function) {
  Dl_info info;
  if (dladdr(function, &info) == 0) return;
  static std::atomic<void*> latest;
  if (latest.exchange(info.dli_fbase, std::memory_order_relaxed) == info.dli_fbase) return;
  dlopen(info.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
}

// Returns the function that is known already, or the one in the libraries that were not opened with dlopen,
// or null.
void* find_linked(int number) {
  void* address = real_functions[number].load(std::memory_order_relaxed);
  if (address != nullptr) return address;
  address = system_lookup()(RTLD_NEXT, kNames[number]);
  if (address != nullptr) real_functions[number].store(address, std::memory_order_relaxed);
  return address;
}

}  // namespace

void* find_loaded(int number) {
  const KeepErrno keep;
  if (void* const linked = find_linked(number)) return linked;
  for (const char* const library :
       {"libGL.so.1", "libOpenGL.so.0", "libGLX.so.0", "libEGL.so.1", "libOSMesa.so.8", "libOSMesa.so.6",
        "libGLESv2.so.2", "libGLESv1_CM.so.1"})
    if (void* const handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD)) {
      void* const address = system_lookup()(handle, kNames[number]);
      if (address != nullptr) {
        pin(address);
        real_functions[number].store(address, std::memory_order_relaxed);
      }
      dlclose(handle);
      if (address != nullptr) return address;
    }
  return nullptr;
}

void* find_real(int number) {
  if (void* const address = find_loaded(number)) return address;
  std::fprintf(stderr, "%s: symbol lookup error: undefined symbol: %s\n", program_invocation_name,
               kNames[number]);
  _exit(127);
}

void* wrapped(const char* name, void* result) {
  const int number = number_of(name);
  if (number < 0 || result == nullptr) return result;
  const KeepErrno keep;
  if (result == kForwarders[number]) return find_loaded(number) != nullptr ? result : nullptr;
  if (void* const known = find_linked(number))
    return are_equivalent(known, result) ? kForwarders[number] : result;
  pin(result);
  real_functions[number].store(result, std::memory_order_relaxed);
  return kForwarders[number];
}

}  // namespace evalcts::record

namespace {
[[gnu::noinline]] void* look_up(void* handle, const char* name) {
  using namespace evalcts::record;
  // In the global scope, this library is before the library that the program means.
  return wrapped(name, handle == RTLD_DEFAULT ? kForwarders[number_of(name)] : system_lookup()(handle, name));
}
}  // namespace

// The C library finds out from where it is called, so that a lookup that does not concern the recorder must
// be a tail call. A library that looks for what is behind itself gets it.
extern "C" __attribute__((visibility("default"))) void* dlsym(void* handle, const char* name) noexcept {
  using namespace evalcts::record;
  if (handle == RTLD_NEXT || number_of(name) < 0) return system_lookup()(handle, name);
  return look_up(handle, name);
}
