// The contexts and entry points of OSMesa, for test providers that replace some of its entry points.
#pragma once

#define GL_GLEXT_PROTOTYPES 1
#include <GL/gl.h>
#include <dlfcn.h>
#include <evalcts_provider.h>

#include <cstring>
#include <span>

namespace osmesa_provider {

// Returns the address in OSMesa, or null if OSMesa is not installed or has no such function.
inline void* address_of(const char* name) {
  static void* const kLibrary = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
  return kLibrary ? dlsym(kLibrary, name) : nullptr;
}

// Returns the function of OSMesa with the given type.
template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(address_of(name));
}
// The function of OSMesa with this name, which must be declared.
#define REAL(name) osmesa_provider::real<decltype(::name)>(#name)

// A function of the provider that replaces the one of OSMesa.
struct Replacement {
  const char* name;
  void* address;
};
#define REPLACEMENT(name, function) \
  osmesa_provider::Replacement { #name, reinterpret_cast < void*>(&function) }

// Returns the address of the replacement for `command`, or of OSMesa's function if it is not replaced.
inline void* find(std::span<const Replacement> own, const char* command) {
  for (const Replacement& replacement : own)
    if (std::strcmp(replacement.name, command) == 0) return replacement.address;
  return address_of(command);
}

// Functions of evalcts_provider (evalcts_provider.h).
using MakeCurrent = GLboolean(void*, void*, GLenum, GLsizei, GLsizei);

inline int make_current(void* context) {
  static unsigned char pixels[64 * 64 * 4];
  return real<MakeCurrent>("OSMesaMakeCurrent")(context, pixels, GL_UNSIGNED_BYTE, 64, 64);
}

inline void* create() {
  const auto make = real<void*(GLenum, GLint, GLint, GLint, void*)>("OSMesaCreateContextExt");
  void* const context = make ? make(GL_RGBA, 24, 8, 0, nullptr) : nullptr;
  return context && make_current(context) ? context : nullptr;
}

// Mesa crashes if a context is destroyed that is current and has drawn.
inline void destroy(void* context) {
  real<MakeCurrent>("OSMesaMakeCurrent")(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
  real<void(void*)>("OSMesaDestroyContext")(context);
}

inline const char* error() { return "OSMesa creates no context"; }

}  // namespace osmesa_provider
