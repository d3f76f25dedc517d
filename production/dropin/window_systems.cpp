// The functions of GLX, EGL and OSMesa that create contexts, destroy them and make them current, and those
// that look up commands.
#include "window_systems.h"

#include <dlfcn.h>

#include <cstring>

#include "context.h"

namespace glev::dropin {
namespace {

// Returns the function of this name in the library below, with the type of the first argument.
template <class Function>
Function* find_function_below(Function*, const char* name) {
  return reinterpret_cast<Function*>(find_below(name));
}
#define BELOW(name)                                             \
  static auto* const below = find_function_below(&name, #name); \
  if (below == nullptr) return {                                \
    }

}  // namespace

const void* ask_for_current() {
  using GetCurrent = const void* (*)();
  struct Getters {
    GetCurrent of[3];
  };
  static const Getters kGetters = {{reinterpret_cast<GetCurrent>(find_below("glXGetCurrentContext")),
                                    reinterpret_cast<GetCurrent>(find_below("eglGetCurrentContext")),
                                    reinterpret_cast<GetCurrent>(find_below("OSMesaGetCurrentContext"))}};
  for (const GetCurrent get : kGetters.of)
    if (const void* const handle = get != nullptr ? get() : nullptr) return handle;
  return nullptr;
}

namespace {

// Notes a new context, and returns its handle.
void* created(void* context, const void* shared) {
  note_created(context, shared);
  return context;
}

// Notes the current context if the call below was successful. Returns the result of this call.
template <class Result>
Result made_current(Result made, const void* context) {
  if (made != 0) note_current(context);
  return made;
}

// Returns a function of this library, and null for functions of the library below.
void* find_own(const char* name) {
  static const struct Self {
    void* handle = nullptr;
    const void* base = nullptr;
  } kSelf = [] {
    Self found;
    Dl_info info;
    if (dladdr(reinterpret_cast<const void*>(&find_own), &info) != 0) {
      found.handle = dlopen(info.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
      found.base = info.dli_fbase;
    }
    return found;
  }();
  if (kSelf.handle == nullptr || name == nullptr) return nullptr;
  void* const address = dlsym(kSelf.handle, name);
  Dl_info info;
  if (address == nullptr || dladdr(address, &info) == 0 || info.dli_fbase != kSelf.base) return nullptr;
  return address;
}

// Looks up a command. Commands that the GL below does not have are not found, except those of evaluators.
template <class Get, class Name>
void* look_up(Get* below, Name* name) {
  void* const address = reinterpret_cast<void*>(below(name));
  const auto* const text = reinterpret_cast<const char*>(name);
  if (address == nullptr && std::strncmp(text, "glMap", 5) != 0 && std::strncmp(text, "glEval", 6) != 0 &&
      std::strncmp(text, "glGetMap", 8) != 0)
    return nullptr;
  void* const own = find_own(text);
  return own != nullptr ? own : address;
}

}  // namespace
}  // namespace glev::dropin

using namespace glev::dropin;  // NOLINT(google-build-using-namespace): what follows is C

// Parameters have equivalent basic types, so that no header of a window system is needed.

// --- OSMesa

DROPIN_EXPORT void* OSMesaCreateContext(GLenum format, void* shared) {
  BELOW(OSMesaCreateContext);
  return created(below(format, shared), shared);
}
DROPIN_EXPORT void* OSMesaCreateContextExt(GLenum format, GLint depth, GLint stencil, GLint accumulation,
                                           void* shared) {
  BELOW(OSMesaCreateContextExt);
  return created(below(format, depth, stencil, accumulation, shared), shared);
}
DROPIN_EXPORT void* OSMesaCreateContextAttribs(const int* attributes, void* shared) {
  BELOW(OSMesaCreateContextAttribs);
  return created(below(attributes, shared), shared);
}
DROPIN_EXPORT GLboolean OSMesaMakeCurrent(void* context, void* buffer, GLenum type, GLsizei width,
                                          GLsizei height) {
  BELOW(OSMesaMakeCurrent);
  return made_current(below(context, buffer, type, width, height), context);
}
DROPIN_EXPORT int OSMesaDestroyContext(void* context) {
  BELOW(OSMesaDestroyContext);
  below(context);
  note_destroyed(context);
  return 0;
}
DROPIN_EXPORT void* OSMesaGetProcAddress(const char* name) {
  BELOW(OSMesaGetProcAddress);
  return look_up(below, name);
}

// --- EGL

DROPIN_EXPORT void* eglCreateContext(void* display, void* config, void* shared, const int* attributes) {
  BELOW(eglCreateContext);
  return created(below(display, config, shared, attributes), shared);
}
DROPIN_EXPORT unsigned eglDestroyContext(void* display, void* context) {
  BELOW(eglDestroyContext);
  const unsigned destroyed = below(display, context);
  if (destroyed != 0) note_destroyed(context);
  return destroyed;
}
DROPIN_EXPORT unsigned eglMakeCurrent(void* display, void* draw, void* read, void* context) {
  BELOW(eglMakeCurrent);
  return made_current(below(display, draw, read, context), context);
}
DROPIN_EXPORT unsigned eglReleaseThread() {
  BELOW(eglReleaseThread);
  note_current(nullptr);
  return below();
}
DROPIN_EXPORT void* eglGetProcAddress(const char* name) {
  BELOW(eglGetProcAddress);
  return look_up(below, name);
}

// --- GLX

DROPIN_EXPORT void* glXCreateContext(void* display, void* visual, void* shared, int direct) {
  BELOW(glXCreateContext);
  return created(below(display, visual, shared, direct), shared);
}
DROPIN_EXPORT void* glXCreateNewContext(void* display, void* config, int type, void* shared, int direct) {
  BELOW(glXCreateNewContext);
  return created(below(display, config, type, shared, direct), shared);
}
DROPIN_EXPORT void* glXCreateContextAttribsARB(void* display, void* config, void* shared, int direct,
                                               const int* attributes) {
  static auto* below = find_function_below(&glXCreateContextAttribsARB, "glXCreateContextAttribsARB");
  if (below == nullptr)
    if (auto* const get =
            find_function_below(static_cast<void* (*)(const char*)>(nullptr), "glXGetProcAddressARB"))
      below = reinterpret_cast<decltype(below)>(get("glXCreateContextAttribsARB"));
  if (below == nullptr) return nullptr;
  return created(below(display, config, shared, direct, attributes), shared);
}
DROPIN_EXPORT int glXMakeCurrent(void* display, unsigned long drawable, void* context) {
  BELOW(glXMakeCurrent);
  return made_current(below(display, drawable, context), context);
}
DROPIN_EXPORT int glXMakeContextCurrent(void* display, unsigned long draw, unsigned long read,
                                        void* context) {
  BELOW(glXMakeContextCurrent);
  return made_current(below(display, draw, read, context), context);
}
DROPIN_EXPORT int glXDestroyContext(void* display, void* context) {
  BELOW(glXDestroyContext);
  below(display, context);
  note_destroyed(context);
  return 0;
}
DROPIN_EXPORT int glXCopyContext(void* display, void* from, void* to, unsigned long mask) {
  BELOW(glXCopyContext);
  below(display, from, to, mask);
  Context* const source = context_of(from);
  Context* const target = context_of(to);
  if (source == nullptr || target == nullptr) return 0;
  if ((mask & (GL_EVAL_BIT | GL_ENABLE_BIT)) != 0)
    target->copy_eval_attributes(*source, (mask & GL_EVAL_BIT) != 0);
  return 0;
}
DROPIN_EXPORT void* glXGetProcAddress(const GLubyte* name) {
  BELOW(glXGetProcAddress);
  return look_up(below, name);
}
DROPIN_EXPORT void* glXGetProcAddressARB(const GLubyte* name) {
  BELOW(glXGetProcAddressARB);
  return look_up(below, name);
}
