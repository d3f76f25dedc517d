// A drop-in library (production/dropin) with a mistake: Map1f of VERTEX_3 accepts strides below 3. All other
// commands are those of the library that GLEVALUATOR_GL names.
//
// EVALCTS_DRILL=plain: OSMesaCreateContextExt creates no context, as if that library did not have it.
#define GL_GLEXT_PROTOTYPES 1
#include <GL/gl.h>
#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>

#include "drill.h"

#define EXPORT extern "C" __attribute__((visibility("default")))

namespace {

// Returns a function of the library below; null if there is none, or if GLEVALUATOR_GL is not set.
template <class Function>
Function* find_below(Function*, const char* name) {
  static void* const kLibrary = dlopen(std::getenv("GLEVALUATOR_GL"), RTLD_NOW | RTLD_LOCAL);
  return reinterpret_cast<Function*>(dlsym(kLibrary, name));
}
#define BELOW(name) find_below(&(name), #name)

}  // namespace

EXPORT void* OSMesaGetProcAddress(const char* name) {
  const auto get = BELOW(OSMesaGetProcAddress);
  return get ? get(name) : nullptr;
}
EXPORT void* eglGetProcAddress(const char* name) {
  const auto get = BELOW(eglGetProcAddress);
  return get ? get(name) : nullptr;
}
EXPORT void* OSMesaCreateContext(GLenum format, void* shared) {
  const auto create = BELOW(OSMesaCreateContext);
  return create ? create(format, shared) : nullptr;
}
EXPORT void* OSMesaCreateContextExt(GLenum format, GLint depth, GLint stencil, GLint accumulation,
                                    void* shared) {
  const auto create = BELOW(OSMesaCreateContextExt);
  return create && !is_drill("plain") ? create(format, depth, stencil, accumulation, shared) : nullptr;
}
EXPORT void glMap1f(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
  auto map = BELOW(glMap1f);
  if (!map) map = reinterpret_cast<decltype(map)>(eglGetProcAddress("glMap1f"));
  map(target, u1, u2, target == GL_MAP1_VERTEX_3 ? std::max(stride, 3) : stride, order, points);
}
