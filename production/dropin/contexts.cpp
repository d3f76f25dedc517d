// Tracks the contexts of the process and of each thread, and identifies their GL.
#include <pthread.h>

#include <cstdio>

#include "context.h"
#include "window_systems.h"

namespace glev::dropin {

namespace {

// A context and its handle in the window system.
struct ContextRecord {
  const void* handle;
  Context* context;
  int bound;  // number of threads in which it is current
  bool destroyed;
};

pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

// The array is never destroyed, because threads may outlive the end of main.
Array<ContextRecord*>& known_contexts() {
  static Array<ContextRecord*>* all = nullptr;
  if (all == nullptr) all = new (std::malloc(sizeof *all)) Array<ContextRecord*>();
  return *all;
}

// The current context of this thread. If `told` is false, no call of this thread has made a context current
// through this library, so the window system is queried each time.
struct ThisThread {
  bool told;
  ContextRecord* bound;
};
thread_local ThisThread this_thread = {false, nullptr};

class Lock {
 public:
  Lock() { pthread_mutex_lock(&mutex); }
  ~Lock() { pthread_mutex_unlock(&mutex); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;
};

std::size_t place_of(const void* handle) {
  std::size_t i = 0;
  while (i < known_contexts().size() && known_contexts()[i]->handle != handle) ++i;
  return i;
}

void release(ContextRecord* known) {
  known->context->destroy();
  std::free(known);
}

void forget(std::size_t place) {
  ContextRecord* const known = known_contexts()[place];
  known_contexts().erase(place);
  known->destroyed = true;
  if (known->bound == 0) release(known);
}

ContextRecord* add_context(const void* handle, Group* shared) {
  Group* const group = shared != nullptr ? shared : Group::create();
  if (shared != nullptr) shared->retain();
  auto* const known = static_cast<ContextRecord*>(std::malloc(sizeof(ContextRecord)));
  Context* const context = group != nullptr ? Context::create(group) : nullptr;
  if (known == nullptr || context == nullptr || !known_contexts().insert(known_contexts().size(), known)) {
    std::fputs("libglevaluator_dropin: no memory for a context\n", stderr);
    std::abort();
  }
  *known = {handle, context, 0, false};
  return known;
}

ContextRecord* find_or_add(const void* handle) {
  const std::size_t place = place_of(handle);
  return place < known_contexts().size() ? known_contexts()[place] : add_context(handle, nullptr);
}

}  // namespace

void note_created(const void* handle, const void* shared) {
  if (handle == nullptr) return;
  const Lock lock;
  // A known context with this handle was destroyed without notice.
  if (const std::size_t place = place_of(handle); place < known_contexts().size()) forget(place);
  add_context(handle, shared != nullptr ? find_or_add(shared)->context->group : nullptr);
}

void note_destroyed(const void* handle) {
  const Lock lock;
  if (const std::size_t place = place_of(handle); place < known_contexts().size()) forget(place);
}

void note_current(const void* handle) {
  const Lock lock;
  ContextRecord* const before = this_thread.bound;
  ContextRecord* const now = handle != nullptr ? find_or_add(handle) : nullptr;
  this_thread = {true, now};
  if (now != nullptr) ++now->bound;
  if (before != nullptr && --before->bound == 0 && before->destroyed) release(before);
}

Context* context_of(const void* handle) {
  if (handle == nullptr) return nullptr;
  const Lock lock;
  return find_or_add(handle)->context;
}

Context* current_context_of_any_kind() {
  gl_below();
  const ThisThread& thread = this_thread;
  if (thread.told) return thread.bound != nullptr ? thread.bound->context : nullptr;
  return context_of(ask_for_current());
}

Context* current_context() {
  Context* const context = current_context_of_any_kind();
  if (context == nullptr) return nullptr;
  if (context->kind == Context::Kind::kUnknown) context->identify();
  return context->kind == Context::Kind::kEvaluators ? context : nullptr;
}

namespace {

bool has_extension(int version, const char* name) {
  if (version >= 30 && gl_below().GetStringi != nullptr) {
    GLint count = 0;
    gl_below().GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
      const GLubyte* const extension = gl_below().GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
      if (extension != nullptr && std::strcmp(reinterpret_cast<const char*>(extension), name) == 0)
        return true;
    }
    return false;
  }
  const GLubyte* const extensions = gl_below().GetString(GL_EXTENSIONS);
  const std::size_t length = std::strlen(name);
  for (const char* at = reinterpret_cast<const char*>(extensions); at != nullptr;
       at = std::strchr(at, ' ') != nullptr ? std::strchr(at, ' ') + 1 : nullptr)
    if (std::strncmp(at, name, length) == 0 && (at[length] == ' ' || at[length] == '\0')) return true;
  return false;
}

}  // namespace

// Queries only state that the version has, because errors would become visible to the program.
void Context::identify() {
  const auto* const text = reinterpret_cast<const char*>(gl_below().GetString(GL_VERSION));
  if (text == nullptr) return;  // the context is not yet current
  if (std::strncmp(text, "OpenGL ES", 9) == 0) {
    kind = Kind::kForeign;
    return;
  }
  int major = 0, minor = 0;
  std::sscanf(text, "%d.%d", &major, &minor);
  version = 10 * major + minor;
  const GLint flags = version >= 30 ? get_integer(GL_CONTEXT_FLAGS, 0) : 0;
  const GLint profile = version >= 32 ? get_integer(GL_CONTEXT_PROFILE_MASK, 0) : 0;
  no_error = (flags & GL_CONTEXT_FLAG_NO_ERROR_BIT) != 0;
  const bool removed = (flags & GL_CONTEXT_FLAG_FORWARD_COMPATIBLE_BIT) != 0 ||
                       (profile & GL_CONTEXT_CORE_PROFILE_BIT) != 0 ||
                       (version == 31 && !has_extension(version, "GL_ARB_compatibility"));
  multitexture = version >= 13 || (!removed && has_extension(version, "GL_ARB_multitexture"));
  vertex_programs = !removed && has_extension(version, "GL_ARB_vertex_program");
  kind = removed ? Kind::kRemoved : Kind::kEvaluators;
}

Context* Context::create(Group* group) {
  void* const memory = std::malloc(sizeof(Context));
  if (memory == nullptr) return nullptr;
  auto* const context = new (memory) Context();
  context->group = group;
  const glev_sink sink = {sizeof sink, context, on_begin, on_vertex, on_end};
  if (glevCreateContext(nullptr, &context->evaluators) != GLEV_SUCCESS ||
      glevSetSink(context->evaluators, &sink) != GLEV_SUCCESS) {
    context->destroy();
    return nullptr;
  }
  return context;
}

void Context::destroy() {
  glevDestroyContext(evaluators);
  group->release();
  this->~Context();
  std::free(this);
}

GLint Context::get_integer(GLenum pname, GLint otherwise) {
  GLint value = otherwise;
  gl_below().GetIntegerv(pname, &value);
  return value;
}

bool Context::is_outside() {
  if (list.deferring) {
    raise_error(GL_INVALID_OPERATION);
    return false;
  }
  if (!maybe_inside) return true;
  // A Begin may have failed. Between Begin and End, the query fails and the GL records the error.
  if (get_integer(GL_MAX_TEXTURE_SIZE, -1) == -1) return false;
  maybe_inside = tracking = false;
  return true;
}

// Uses commands that have no other effect and are never compiled.
void Context::raise_error(GLenum error) {
  if (no_error) return;
  if (error == GL_INVALID_ENUM) {
    gl_below().IsEnabled(0);
  } else if (error == GL_INVALID_VALUE) {
    gl_below().GenLists(-1);
  } else if (error == GL_INVALID_OPERATION) {
    if (list.driver_is_open)
      gl_below().NewList(1, GL_COMPILE);
    else
      gl_below().EndList();
  } else if (error != GL_NO_ERROR) {
    out_of_memory = true;
  }
}

void Context::report() { raise_error(glevGetError(evaluators)); }

}  // namespace glev::dropin
