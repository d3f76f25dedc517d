// The functions of GLX, EGL and OSMesa that make contexts current, destroy them, swap buffers, and look up
// commands.
//
// Parameters have equivalent basic types, so that no header of a window system is needed.
#include <cstdint>

#include "real_commands.h"
#include "recorder.h"

using namespace evalcts::record;  // NOLINT(google-build-using-namespace): what follows is C

namespace {

// Returns the real function with the type of this one.
template <class Function>
Function* real_of(int number, Function*) {
  return real<Function>(number);
}
#define REAL(name) real_of(k##name, &name)

// A function of a window system may call another one.
constinit thread_local int depth = 0;
struct Nested {
  Nested() { ++depth; }
  ~Nested() { --depth; }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;
  static bool is_outermost() { return depth == 1; }
};

template <class Function, class... Arguments>
auto make_current(Function* function, const void* context, bool is_osmesa, Arguments... arguments) {
  const Nested nested;
  const auto is_made = function(arguments...);
  if (is_made && Nested::is_outermost()) note_current(context, is_osmesa);
  return is_made;
}

template <class Function, class... Arguments>
auto swap(Function* function, Arguments... arguments) {
  const Nested nested;
  if (Nested::is_outermost()) note_frame();
  return function(arguments...);
}

template <class Function, class Name>
auto look_up(Function* function, Name* name) {
  auto const found = function(name);
  return reinterpret_cast<decltype(function(name))>(
      wrapped(reinterpret_cast<const char*>(name), reinterpret_cast<void*>(found)));
}

}  // namespace

#define EXPORT extern "C" __attribute__((visibility("default")))

// --- GLX

EXPORT int glXMakeCurrent(void* display, unsigned long drawable, void* context) {
  return make_current(REAL(glXMakeCurrent), context, false, display, drawable, context);
}
EXPORT int glXMakeContextCurrent(void* display, unsigned long draw, unsigned long read, void* context) {
  return make_current(REAL(glXMakeContextCurrent), context, false, display, draw, read, context);
}
EXPORT int glXMakeCurrentReadSGI(void* display, unsigned long draw, unsigned long read, void* context) {
  return make_current(REAL(glXMakeCurrentReadSGI), context, false, display, draw, read, context);
}
EXPORT void glXDestroyContext(void* display, void* context) {
  note_destroyed(context);
  REAL(glXDestroyContext)(display, context);
}
EXPORT void glXSwapBuffers(void* display, unsigned long drawable) {
  swap(REAL(glXSwapBuffers), display, drawable);
}
EXPORT std::int64_t glXSwapBuffersMscOML(void* display, unsigned long drawable, std::int64_t target,
                                         std::int64_t divisor, std::int64_t remainder) {
  return swap(REAL(glXSwapBuffersMscOML), display, drawable, target, divisor, remainder);
}
EXPORT void* glXGetProcAddress(const unsigned char* name) { return look_up(REAL(glXGetProcAddress), name); }
EXPORT void* glXGetProcAddressARB(const unsigned char* name) {
  return look_up(REAL(glXGetProcAddressARB), name);
}

// --- EGL

EXPORT unsigned eglMakeCurrent(void* display, void* draw, void* read, void* context) {
  return make_current(REAL(eglMakeCurrent), context, false, display, draw, read, context);
}
EXPORT unsigned eglReleaseThread() { return make_current(REAL(eglReleaseThread), nullptr, false); }
EXPORT unsigned eglDestroyContext(void* display, void* context) {
  note_destroyed(context);
  return REAL(eglDestroyContext)(display, context);
}
EXPORT unsigned eglSwapBuffers(void* display, void* surface) {
  return swap(REAL(eglSwapBuffers), display, surface);
}
EXPORT unsigned eglSwapBuffersWithDamageKHR(void* display, void* surface, const int* rectangles, int count) {
  return swap(REAL(eglSwapBuffersWithDamageKHR), display, surface, rectangles, count);
}
EXPORT unsigned eglSwapBuffersWithDamageEXT(void* display, void* surface, const int* rectangles, int count) {
  return swap(REAL(eglSwapBuffersWithDamageEXT), display, surface, rectangles, count);
}
EXPORT void* eglGetProcAddress(const char* name) { return look_up(REAL(eglGetProcAddress), name); }

// --- OSMesa

EXPORT unsigned char OSMesaMakeCurrent(void* context, void* buffer, unsigned type, int width, int height) {
  return make_current(REAL(OSMesaMakeCurrent), context, true, context, buffer, type, width, height);
}
EXPORT void OSMesaDestroyContext(void* context) {
  note_destroyed(context);
  if (writer != nullptr && writer->context == reinterpret_cast<std::uintptr_t>(context))
    note_current(nullptr, true);
  REAL(OSMesaDestroyContext)(context);
}
EXPORT void* OSMesaGetProcAddress(const char* name) { return look_up(REAL(OSMesaGetProcAddress), name); }
