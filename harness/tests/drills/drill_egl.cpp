// Wraps the real EGL and does not support a feature that EVALCTS_DRILL names:
//   surfaceless: EGL_KHR_surfaceless_context
//   platforms: client extensions
//   opengl: desktop OpenGL
//   drivers: eglInitialize fails
//   profile: contexts are created only if a profile is requested
//   compatibility: all contexts have the core profile
//   commands: EGL 1.4, without addresses of commands of GL 1.x
//   pbuffers: pbuffers
//   framebuffers: neither pbuffers nor glGenFramebuffers
//   configurations: there is no configuration
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <cstring>
#include <string>

#include "drill.h"

#define EXPORT extern "C" __attribute__((visibility("default")))

namespace {

template <class Function>
Function real(Function, const char* name) {
  static void* const kLibrary = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  return reinterpret_cast<Function>(dlsym(kLibrary, name));
}
#define REAL(name) real(&::name, #name)

EGLint error = EGL_SUCCESS;

EGLContext no_context(EGLint why) {
  error = why;
  return EGL_NO_CONTEXT;
}

std::string without(std::string words, const std::string& word) {
  const std::size_t at = words.find(word);
  return at == std::string::npos ? words : words.erase(at, word.size());
}

}  // namespace

EXPORT EGLint eglGetError() {
  const EGLint own = error;
  error = EGL_SUCCESS;
  return own != EGL_SUCCESS ? own : REAL(eglGetError)();
}

EXPORT const char* eglQueryString(EGLDisplay display, EGLint name) {
  static std::string edited;
  if (display == EGL_NO_DISPLAY && is_drill("platforms")) return nullptr;
  if (name == EGL_CLIENT_APIS && is_drill("opengl")) return "OpenGL_ES";
  const char* words = REAL(eglQueryString)(display, name);
  edited = words ? words : "";
  if (name == EGL_EXTENSIONS && is_drill("surfaceless"))
    edited = without(edited, "EGL_KHR_surfaceless_context");
  if (name == EGL_EXTENSIONS && is_drill("commands")) {
    edited = without(edited, "EGL_KHR_client_get_all_proc_addresses");
    edited = without(edited, "EGL_KHR_get_all_proc_addresses");
  }
  return words ? edited.c_str() : nullptr;
}

EXPORT EGLDisplay eglGetDisplay(EGLNativeDisplayType native) { return REAL(eglGetDisplay)(native); }

EXPORT EGLBoolean eglInitialize(EGLDisplay display, EGLint* major, EGLint* minor) {
  if (is_drill("drivers")) {
    error = EGL_NOT_INITIALIZED;
    return EGL_FALSE;
  }
  const EGLBoolean done = REAL(eglInitialize)(display, major, minor);
  if (is_drill("commands")) *minor = 4;
  return done;
}

EXPORT EGLBoolean eglTerminate(EGLDisplay display) { return REAL(eglTerminate)(display); }
EXPORT EGLBoolean eglBindAPI(EGLenum api) { return REAL(eglBindAPI)(api); }

EXPORT EGLBoolean eglChooseConfig(EGLDisplay display, const EGLint* wanted, EGLConfig* configs, EGLint size,
                                  EGLint* count) {
  *count = 0;
  if (is_drill("configurations")) return EGL_TRUE;
  if (is_drill("pbuffers") || is_drill("framebuffers"))
    for (const EGLint* pair = wanted; *pair != EGL_NONE; pair += 2)
      if (pair[0] == EGL_SURFACE_TYPE && (pair[1] & EGL_PBUFFER_BIT)) return EGL_TRUE;
  return REAL(eglChooseConfig)(display, wanted, configs, size, count);
}

EXPORT EGLContext eglCreateContext(EGLDisplay display, EGLConfig config, EGLContext share,
                                   const EGLint* attributes) {
  const EGLint core[] = {EGL_CONTEXT_MAJOR_VERSION,
                         3,
                         EGL_CONTEXT_MINOR_VERSION,
                         3,
                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                         EGL_NONE};
  if (is_drill("profile") && attributes[0] == EGL_NONE) return no_context(EGL_BAD_MATCH);
  return REAL(eglCreateContext)(display, config, share, is_drill("compatibility") ? core : attributes);
}

EXPORT EGLBoolean eglDestroyContext(EGLDisplay display, EGLContext context) {
  return REAL(eglDestroyContext)(display, context);
}

EXPORT EGLBoolean eglMakeCurrent(EGLDisplay display, EGLSurface draw, EGLSurface read, EGLContext context) {
  if (is_drill("surfaceless") && context != EGL_NO_CONTEXT && draw == EGL_NO_SURFACE) {
    error = EGL_BAD_MATCH;
    return EGL_FALSE;
  }
  return REAL(eglMakeCurrent)(display, draw, read, context);
}

EXPORT EGLSurface eglCreatePbufferSurface(EGLDisplay display, EGLConfig config, const EGLint* attributes) {
  return REAL(eglCreatePbufferSurface)(display, config, attributes);
}

EXPORT EGLBoolean eglDestroySurface(EGLDisplay display, EGLSurface surface) {
  return REAL(eglDestroySurface)(display, surface);
}

EXPORT __eglMustCastToProperFunctionPointerType eglGetProcAddress(const char* name) {
  if (is_drill("framebuffers") && std::strcmp(name, "glGenFramebuffers") == 0) return nullptr;
  if (is_drill("commands") && (std::strstr(name, "Map1") || std::strstr(name, "EvalCoord"))) return nullptr;
  return REAL(eglGetProcAddress)(name);
}
