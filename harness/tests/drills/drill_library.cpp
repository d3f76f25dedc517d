// A library for the runner's tests: looks like OSMesa, evaluates with libglevaluator, and misbehaves on
// command. It has no rasterizer, so no capture works on it; state and error tests run.
//
// With DRILL_OWN_CONTEXT it has one context from when it is loaded, and nothing that makes any. With
// DRILL_LAYER it has it only if it is loaded where a context of OpenGL ES is current, as a layer over that
// may need it.
//
// EVALCTS_DRILL names what happens when Map1f is called for INDEX with order 5 (most tests never do that):
//   one of misbehaviours.h; "second": crash only if a map of order 7 was defined before in this
//   process; "both": crash, and hang where Map1d is called so; "start": crash when a context is made;
//   "lenient": strides below k are taken for k; "fragile": the same, and a crash where nothing was enabled
//   before; "now-and-then": orders of INDEX are one too many, in the first process of all (EVALCTS_DRILL_FILE
//   is then there); "crash-now-and-then": it crashes; "control": every explicit vertex crashes,
//   "control-error": it leaves an error behind, and every evaluated one loses the current colour; "history":
//   in a context where that happened, GetMapiv says that maps of VERTEX_3 have one point more; "worn": in a
//   context with 45 primitives, which one random program has not, IsEnabled says the opposite; "worn-out":
//   with 400; "query": GetMapiv of NORMAL reads from nowhere; "end": every primitive crashes at its end;
//   "evaluation": every EvalCoord1f crashes; "terminate": DRILL_LAYER terminates the EGL display when it is
//   loaded.
#ifdef DRILL_LAYER
#define EGL_NO_X11
#include <EGL/egl.h>
#include <dlfcn.h>
#endif
#include <fcntl.h>
#include <glevaluator.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <map>

#include <evalcts/gl/table.h>
#include "misbehaviours.h"

#define EXPORT extern "C" __attribute__((visibility("default")))

namespace {

glev_context* current = nullptr;
[[maybe_unused]] bool seven_was_seen = false;
[[maybe_unused]] bool odd_context = false, odd_answers = false, enabled_something = false;
[[maybe_unused]] std::map<glev_context*, int> primitives;  // of each context

// Returns true if no process has come here before: the file EVALCTS_DRILL_FILE is not there yet.
[[maybe_unused]] bool is_first_time() {
  const char* const file = std::getenv("EVALCTS_DRILL_FILE");
  const int descriptor = file ? open(file, O_WRONLY | O_CREAT | O_EXCL, 0644) : -1;
  if (descriptor >= 0) close(descriptor);
  return descriptor >= 0;
}

bool drill(const char* name) {
  const char* wanted = std::getenv("EVALCTS_DRILL");
  return wanted && std::strcmp(wanted, name) == 0;
}

using misbehaviours::crash;

[[maybe_unused]] void read_from_nowhere() {
  volatile std::uintptr_t nowhere = 64;
  [[maybe_unused]] const int value =
      *reinterpret_cast<volatile int*>(nowhere);  // NOLINT(performance-no-int-to-ptr): nowhere on purpose
}

[[maybe_unused]] void misbehave() {
  if (drill("both") || (drill("second") && seven_was_seen)) crash();
  if (drill("now-and-then") && is_first_time()) odd_answers = true;
  if (drill("crash-now-and-then") && is_first_time()) crash();
  if (const char* const wanted = std::getenv("EVALCTS_DRILL")) misbehaviours::misbehave(wanted);
}

}  // namespace

#ifdef DRILL_LAYER
[[maybe_unused]] const bool made_over_es = [] {
  void* const egl = dlopen("libEGL.so.1", RTLD_NOW | RTLD_NOLOAD);
  if (!egl) return false;
  const auto api = reinterpret_cast<decltype(&eglQueryAPI)>(dlsym(egl, "eglQueryAPI"));
  const auto context = reinterpret_cast<decltype(&eglGetCurrentContext)>(dlsym(egl, "eglGetCurrentContext"));
  const bool is_over_es = api() == EGL_OPENGL_ES_API && context();
  if (drill("terminate"))
    reinterpret_cast<decltype(&eglTerminate)>(dlsym(egl, "eglTerminate"))(
        reinterpret_cast<decltype(&eglGetCurrentDisplay)>(dlsym(egl, "eglGetCurrentDisplay"))());
  return is_over_es && glevCreateContext(nullptr, &current) == GLEV_SUCCESS;
}();
#elif defined(DRILL_OWN_CONTEXT)
[[maybe_unused]] const glev_result made_when_loaded = glevCreateContext(nullptr, &current);
#else
EXPORT void* OSMesaCreateContextExt(GLenum, GLint, GLint, GLint, void*) {
  if (drill("start")) crash();
  odd_context = enabled_something = false;
  glev_context* context = nullptr;
  glevCreateContext(nullptr, &context);
  return context;
}
EXPORT GLboolean OSMesaMakeCurrent(void* context, void*, GLenum, GLsizei, GLsizei) {
  current = static_cast<glev_context*>(context);
  return GL_TRUE;
}
EXPORT void OSMesaDestroyContext(void* context) {
  primitives.erase(static_cast<glev_context*>(context));
  glevDestroyContext(static_cast<glev_context*>(context));
}
#endif

EXPORT const GLubyte* glGetString(GLenum name) { return current ? glevGetString(current, name) : nullptr; }
EXPORT GLenum glGetError() { return glevGetError(current); }
EXPORT void glGetIntegerv(GLenum name, GLint* values) { glevGetIntegerv(current, name, values); }
EXPORT void glGetFloatv(GLenum name, GLfloat* values) { glevGetFloatv(current, name, values); }
EXPORT void glGetBooleanv(GLenum name, GLboolean* values) { glevGetBooleanv(current, name, values); }

#ifndef DRILL_WITHOUT_EVALUATORS
EXPORT void glEnable(GLenum cap) {
  enabled_something = true;
  glevEnable(current, cap);
}
EXPORT void glDisable(GLenum cap) { glevDisable(current, cap); }
EXPORT GLboolean glIsEnabled(GLenum cap) {
  const bool worn =
      (drill("worn") && primitives[current] >= 45) || (drill("worn-out") && primitives[current] >= 400);
  return glevIsEnabled(current, cap) != worn;
}
EXPORT void glBegin(GLenum mode) {
  ++primitives[current];
  glevBegin(current, mode);
}
EXPORT void glEnd() {
  if (drill("end")) crash();
  glevEnd(current);
}
EXPORT void glActiveTexture(GLenum texture) { glevActiveTexture(current, texture); }
EXPORT void glMap1f(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
  if (order == 7) seven_was_seen = true;
  if (target == GL_MAP1_INDEX && order == 5) {
    misbehave();
    odd_context = true;
  }
  if ((drill("lenient") || drill("fragile")) && target == GL_MAP1_VERTEX_3 && stride < 3) {
    if (drill("fragile") && !enabled_something) crash();
    stride = 3;
  }
  glevMap1f(current, target, u1, u2, stride, order, points);
}
EXPORT void glMap1d(GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                    const GLdouble* points) {
  while (drill("both") && target == GL_MAP1_INDEX && order == 5) pause();
  glevMap1d(current, target, u1, u2, stride, order, points);
}
EXPORT void glColor4f(GLfloat red, GLfloat green, GLfloat blue, GLfloat alpha) {
  glevColor4f(current, red, green, blue, alpha);
}
EXPORT void glColor3f(GLfloat red, GLfloat green, GLfloat blue) { glevColor3f(current, red, green, blue); }
EXPORT void glVertex3f(GLfloat x, GLfloat y, GLfloat z) {
  if (drill("control")) crash();
  if (drill("control-error")) glevEnable(current, 0);  // rejected between Begin and End
  glevVertex3f(current, x, y, z);
}
EXPORT void glNormal3f(GLfloat x, GLfloat y, GLfloat z) { glevNormal3f(current, x, y, z); }
EXPORT void glTexCoord4f(GLfloat s, GLfloat t, GLfloat r, GLfloat q) { glevTexCoord4f(current, s, t, r, q); }
EXPORT void glGetDoublev(GLenum name, GLdouble* values) { glevGetDoublev(current, name, values); }
EXPORT void glEvalCoord1f(GLfloat u) {
  if (drill("evaluation")) crash();
  glevEvalCoord1f(current, u);
  if (drill("control") || drill("control-error")) glevColor4f(current, 9, 9, 9, 9);
}
EXPORT void glGetMapfv(GLenum target, GLenum query, GLfloat* values) {
  glevGetMapfv(current, target, query, values);
}
EXPORT void glGetMapdv(GLenum target, GLenum query, GLdouble* values) {
  glevGetMapdv(current, target, query, values);
}
EXPORT void glGetMapiv(GLenum target, GLenum query, GLint* values) {
  if (drill("query") && target == GL_MAP1_NORMAL) read_from_nowhere();
  glevGetMapiv(current, target, query, values);
  if (odd_answers && target == GL_MAP1_INDEX && query == GL_ORDER) ++*values;
  if (drill("history") && odd_context && target == GL_MAP1_VERTEX_3 && query == GL_ORDER) ++*values;
}
#endif
