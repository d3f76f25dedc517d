// A library for the runner's tests: it exports OSMesa's functions, evaluates with libglevaluator, and
// misbehaves on command. It has no rasterizer, so no capture works on it, but tests of state and errors run.
//
// With DRILL_OWN_CONTEXT, the library creates its only context when it is loaded. With DRILL_LAYER, it does
// so only if a context of OpenGL ES is then current, as a layer over OpenGL ES may require. With
// DRILL_PLAIN_OSMESA, it exports OSMesaCreateContext in place of OSMesaCreateContextExt.
//
// EVALCTS_DRILL names the misbehaviour. "The trigger" is a call of Map1f for INDEX with order 5, which few
// tests make.
//   a name in misbehaviours.h: happens at the trigger
//   "second": crashes at the trigger if a map of order 7 was defined before in this process
//   "second-hang": as "second", but hangs
//   "both": crashes at the trigger, and hangs at the same call of Map1d
//   "now-and-then": after the trigger, GetMapiv returns an order of INDEX that is too large by one, but only
//     in the first process, which creates EVALCTS_DRILL_FILE
//   "varying": as "now-and-then", but in other processes only the first order after the trigger
//   "beside": crashes when a context is made beside another one
//   "crash-now-and-then": crashes at the trigger, but only in the first process
//   "history": after the trigger, GetMapiv returns an order of VERTEX_3 that is too large by one in the same
//     context
//   "start": crashes when a context is created
//   "leak": each context loses 4 MB
//   "lenient": Map1f of VERTEX_3 accepts strides below 3
//   "fragile": as "lenient", but crashes in such calls if nothing was enabled before in the context
//   "control": each Vertex3f crashes, and each EvalCoord1f changes the current colour
//   "control-error": each Vertex3f raises an error, and each EvalCoord1f changes the current colour
//   "worn": after 45 primitives in a context, more than in one random program, IsEnabled returns the opposite
//   "worn-out": as "worn", but after 400 primitives
//   "query": GetMapiv of NORMAL reads from an invalid address
//   "end": each End crashes
//   "evaluation": each EvalCoord1f crashes
//   "terminate": DRILL_LAYER terminates the EGL display when it is loaded
#ifdef DRILL_LAYER
#define EGL_NO_X11
#include <EGL/egl.h>
#include <dlfcn.h>
#endif
#include <fcntl.h>
#include <glevaluator.h>
#include <unistd.h>

#include <cstdlib>
#include <map>

#include <evalcts/gl/table.h>
#include "drill.h"
#include "misbehaviours.h"

#define EXPORT extern "C" __attribute__((visibility("default")))

namespace {

glev_context* current = nullptr;
[[maybe_unused]] bool seven_was_seen = false;
[[maybe_unused]] bool odd_context = false, odd_answers = false, enabled_something = false;
[[maybe_unused]] std::map<glev_context*, int> primitives;  // number of primitives, by context

// Returns true in the first call of all processes, which creates the file EVALCTS_DRILL_FILE.
[[maybe_unused]] bool is_first_time() {
  const char* const file = std::getenv("EVALCTS_DRILL_FILE");
  const int descriptor = file ? open(file, O_WRONLY | O_CREAT | O_EXCL, 0644) : -1;
  if (descriptor >= 0) close(descriptor);
  return descriptor >= 0;
}

using misbehaviours::crash;

[[maybe_unused]] void read_from_nowhere() {
  volatile std::uintptr_t nowhere = 64;
  [[maybe_unused]] const int value =
      *reinterpret_cast<volatile int*>(nowhere);  // NOLINT(performance-no-int-to-ptr): nowhere on purpose
}

[[maybe_unused]] void misbehave() {
  if (is_drill("both") || (is_drill("second") && seven_was_seen)) crash();
  if (is_drill("second-hang") && seven_was_seen) misbehaviours::hang();
  if ((is_drill("now-and-then") || is_drill("varying")) && is_first_time()) odd_answers = true;
  if (is_drill("crash-now-and-then") && is_first_time()) crash();
  if (is_drill("hang-now-and-then") && is_first_time()) misbehaviours::hang();
  if (const char* const wanted = std::getenv("EVALCTS_DRILL")) misbehaviours::misbehave(wanted);
}

}  // namespace

#ifdef DRILL_LAYER
[[maybe_unused]] const bool kMadeOverEs = [] {
  void* const egl = dlopen("libEGL.so.1", RTLD_NOW | RTLD_NOLOAD);
  if (!egl) return false;
  const auto api = reinterpret_cast<decltype(&eglQueryAPI)>(dlsym(egl, "eglQueryAPI"));
  const auto context = reinterpret_cast<decltype(&eglGetCurrentContext)>(dlsym(egl, "eglGetCurrentContext"));
  const bool is_over_es = api() == EGL_OPENGL_ES_API && context();
  if (is_drill("terminate"))
    reinterpret_cast<decltype(&eglTerminate)>(dlsym(egl, "eglTerminate"))(
        reinterpret_cast<decltype(&eglGetCurrentDisplay)>(dlsym(egl, "eglGetCurrentDisplay"))());
  return is_over_es && glevCreateContext(nullptr, &current) == GLEV_SUCCESS;
}();
#elif defined(DRILL_OWN_CONTEXT)
[[maybe_unused]] const glev_result kMadeWhenLoaded = glevCreateContext(nullptr, &current);
#else
int live_contexts = 0;
#ifdef DRILL_PLAIN_OSMESA
EXPORT void* OSMesaCreateContext(GLenum, void*) {
#else
EXPORT void* OSMesaCreateContextExt(GLenum, GLint, GLint, GLint, void*) {
#endif
  if (is_drill("start")) crash();
  if (is_drill("leak")) misbehaviours::lose_memory();
  if (++live_contexts > 1 && is_drill("beside")) crash();
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
  --live_contexts;
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
      (is_drill("worn") && primitives[current] >= 45) || (is_drill("worn-out") && primitives[current] >= 400);
  return glevIsEnabled(current, cap) != worn;
}
EXPORT void glBegin(GLenum mode) {
  ++primitives[current];
  glevBegin(current, mode);
}
EXPORT void glEnd() {
  if (is_drill("end")) crash();
  glevEnd(current);
}
EXPORT void glActiveTexture(GLenum texture) { glevActiveTexture(current, texture); }
EXPORT void glMap1f(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
  if (order == 7) seven_was_seen = true;
  if (target == GL_MAP1_INDEX && order == 5) {
    misbehave();
    odd_context = true;
  }
  if ((is_drill("lenient") || is_drill("fragile")) && target == GL_MAP1_VERTEX_3 && stride < 3) {
    if (is_drill("fragile") && !enabled_something) crash();
    stride = 3;
  }
  glevMap1f(current, target, u1, u2, stride, order, points);
}
EXPORT void glMap1d(GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                    const GLdouble* points) {
  while (is_drill("both") && target == GL_MAP1_INDEX && order == 5) pause();
  glevMap1d(current, target, u1, u2, stride, order, points);
}
EXPORT void glColor4f(GLfloat red, GLfloat green, GLfloat blue, GLfloat alpha) {
  glevColor4f(current, red, green, blue, alpha);
}
EXPORT void glColor3f(GLfloat red, GLfloat green, GLfloat blue) { glevColor3f(current, red, green, blue); }
EXPORT void glVertex3f(GLfloat x, GLfloat y, GLfloat z) {
  if (is_drill("control")) crash();
  if (is_drill("control-error")) glevEnable(current, 0);  // rejected between Begin and End
  glevVertex3f(current, x, y, z);
}
EXPORT void glNormal3f(GLfloat x, GLfloat y, GLfloat z) { glevNormal3f(current, x, y, z); }
EXPORT void glTexCoord4f(GLfloat s, GLfloat t, GLfloat r, GLfloat q) { glevTexCoord4f(current, s, t, r, q); }
EXPORT void glGetDoublev(GLenum name, GLdouble* values) { glevGetDoublev(current, name, values); }
EXPORT void glEvalCoord1f(GLfloat u) {
  if (is_drill("evaluation")) crash();
  glevEvalCoord1f(current, u);
  if (is_drill("control") || is_drill("control-error")) glevColor4f(current, 9, 9, 9, 9);
}
EXPORT void glGetMapfv(GLenum target, GLenum query, GLfloat* values) {
  glevGetMapfv(current, target, query, values);
}
EXPORT void glGetMapdv(GLenum target, GLenum query, GLdouble* values) {
  glevGetMapdv(current, target, query, values);
}
EXPORT void glGetMapiv(GLenum target, GLenum query, GLint* values) {
  if (is_drill("query") && target == GL_MAP1_NORMAL) read_from_nowhere();
  glevGetMapiv(current, target, query, values);
  const bool is_odd = odd_answers || (is_drill("varying") && odd_context);
  if (is_odd && target == GL_MAP1_INDEX && query == GL_ORDER) {
    ++*values;
    if (is_drill("varying")) odd_context = false;
  }
  if (is_drill("history") && odd_context && target == GL_MAP1_VERTEX_3 && query == GL_ORDER) ++*values;
}
#endif
