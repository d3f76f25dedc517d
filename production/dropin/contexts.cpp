// Which context is current, and what there is to know of it.
#include <pthread.h>

#include <cstdio>

#include "context.h"
#include "window_systems.h"

namespace glev::dropin {

namespace {

// A context by the handle of its window system.
struct Known {
  const void* handle;
  Context* context;
  int bound;  // threads that it is current in
  bool destroyed;
};

pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

// Never destroyed: threads may outlive the end of main.
Array<Known*>& All() {
  static Array<Known*>* all = nullptr;
  if (all == nullptr) all = new (std::malloc(sizeof *all)) Array<Known*>();
  return *all;
}

// What the window system was last told in this thread; where it was not told through this library, it is
// asked each time.
struct ThisThread {
  bool told;
  Known* bound;
};
thread_local ThisThread this_thread = {false, nullptr};

class Lock {
 public:
  Lock() { pthread_mutex_lock(&mutex); }
  ~Lock() { pthread_mutex_unlock(&mutex); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;
};

std::size_t PlaceOf(const void* handle) {
  std::size_t i = 0;
  while (i < All().size() && All()[i]->handle != handle) ++i;
  return i;
}

void Free(Known* known) {
  known->context->Destroy();
  std::free(known);
}

void Forget(std::size_t place) {
  Known* const known = All()[place];
  All().Erase(place);
  known->destroyed = true;
  if (known->bound == 0) Free(known);
}

Known* Add(const void* handle, Group* shared) {
  Group* const group = shared != nullptr ? shared : Group::Create();
  if (shared != nullptr) shared->Retain();
  auto* const known = static_cast<Known*>(std::malloc(sizeof(Known)));
  Context* const context = group != nullptr ? Context::Create(group) : nullptr;
  if (known == nullptr || context == nullptr || !All().Insert(All().size(), known)) {
    std::fputs("libglevaluator_dropin: no memory for a context\n", stderr);
    std::abort();
  }
  *known = {handle, context, 0, false};
  return known;
}

Known* FindOrAdd(const void* handle) {
  const std::size_t place = PlaceOf(handle);
  return place < All().size() ? All()[place] : Add(handle, nullptr);
}

}  // namespace

void NoteCreated(const void* handle, const void* shared) {
  if (handle == nullptr) return;
  const Lock lock;
  // Another one's, which was destroyed without a word.
  if (const std::size_t place = PlaceOf(handle); place < All().size()) Forget(place);
  Add(handle, shared != nullptr ? FindOrAdd(shared)->context->group : nullptr);
}

void NoteDestroyed(const void* handle) {
  const Lock lock;
  if (const std::size_t place = PlaceOf(handle); place < All().size()) Forget(place);
}

void NoteCurrent(const void* handle) {
  const Lock lock;
  Known* const before = this_thread.bound;
  Known* const now = handle != nullptr ? FindOrAdd(handle) : nullptr;
  this_thread = {true, now};
  if (now != nullptr) ++now->bound;
  if (before != nullptr && --before->bound == 0 && before->destroyed) Free(before);
}

Context* ContextOf(const void* handle) {
  if (handle == nullptr) return nullptr;
  const Lock lock;
  return FindOrAdd(handle)->context;
}

Context* CurrentOfAnyKind() {
  Gl();
  const ThisThread& thread = this_thread;
  if (thread.told) return thread.bound != nullptr ? thread.bound->context : nullptr;
  return ContextOf(AskForCurrent());
}

Context* Current() {
  Context* const context = CurrentOfAnyKind();
  if (context == nullptr) return nullptr;
  if (context->kind == Context::Kind::kUnknown) context->Identify();
  return context->kind == Context::Kind::kEvaluators ? context : nullptr;
}

namespace {

bool HasExtension(int version, const char* name) {
  if (version >= 30 && Gl().GetStringi != nullptr) {
    GLint count = 0;
    Gl().GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
      const GLubyte* const extension = Gl().GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
      if (extension != nullptr && std::strcmp(reinterpret_cast<const char*>(extension), name) == 0)
        return true;
    }
    return false;
  }
  const GLubyte* const extensions = Gl().GetString(GL_EXTENSIONS);
  const std::size_t length = std::strlen(name);
  for (const char* at = reinterpret_cast<const char*>(extensions); at != nullptr;
       at = std::strchr(at, ' ') != nullptr ? std::strchr(at, ' ') + 1 : nullptr)
    if (std::strncmp(at, name, length) == 0 && (at[length] == ' ' || at[length] == '\0')) return true;
  return false;
}

}  // namespace

// Asks for nothing that the version does not have: errors would be the program's.
void Context::Identify() {
  const auto* const text = reinterpret_cast<const char*>(Gl().GetString(GL_VERSION));
  if (text == nullptr) return;  // not yet current
  if (std::strncmp(text, "OpenGL ES", 9) == 0) {
    kind = Kind::kForeign;
    return;
  }
  int major = 0, minor = 0;
  std::sscanf(text, "%d.%d", &major, &minor);
  version = 10 * major + minor;
  const GLint flags = version >= 30 ? Integer(GL_CONTEXT_FLAGS, 0) : 0;
  const GLint profile = version >= 32 ? Integer(GL_CONTEXT_PROFILE_MASK, 0) : 0;
  no_error = (flags & GL_CONTEXT_FLAG_NO_ERROR_BIT) != 0;
  const bool removed = (flags & GL_CONTEXT_FLAG_FORWARD_COMPATIBLE_BIT) != 0 ||
                       (profile & GL_CONTEXT_CORE_PROFILE_BIT) != 0 ||
                       (version == 31 && !HasExtension(version, "GL_ARB_compatibility"));
  multitexture = version >= 13 || (!removed && HasExtension(version, "GL_ARB_multitexture"));
  vertex_programs = !removed && HasExtension(version, "GL_ARB_vertex_program");
  kind = removed ? Kind::kRemoved : Kind::kEvaluators;
}

Context* Context::Create(Group* group) {
  void* const memory = std::malloc(sizeof(Context));
  if (memory == nullptr) return nullptr;
  auto* const context = new (memory) Context();
  context->group = group;
  const glev_sink sink = {sizeof sink, context, OnBegin, OnVertex, OnEnd};
  if (glevCreateContext(nullptr, &context->evaluators) != GLEV_SUCCESS ||
      glevSetSink(context->evaluators, &sink) != GLEV_SUCCESS) {
    context->Destroy();
    return nullptr;
  }
  return context;
}

void Context::Destroy() {
  glevDestroyContext(evaluators);
  group->Release();
  this->~Context();
  std::free(this);
}

GLint Context::Integer(GLenum pname, GLint otherwise) {
  GLint value = otherwise;
  Gl().GetIntegerv(pname, &value);
  return value;
}

bool Context::IsOutside() {
  if (list.deferring) {
    RaiseError(GL_INVALID_OPERATION);
    return false;
  }
  if (!maybe_inside) return true;
  // A Begin may have failed. Between Begin and End the GL answers nothing, and records the error that is due.
  if (Integer(GL_MAX_TEXTURE_SIZE, -1) == -1) return false;
  maybe_inside = tracking = false;
  return true;
}

// With commands that do nothing else, and that no list takes.
void Context::RaiseError(GLenum error) {
  if (no_error) return;
  if (error == GL_INVALID_ENUM) {
    Gl().IsEnabled(0);
  } else if (error == GL_INVALID_VALUE) {
    Gl().GenLists(-1);
  } else if (error == GL_INVALID_OPERATION) {
    if (list.driver_is_open)
      Gl().NewList(1, GL_COMPILE);
    else
      Gl().EndList();
  } else if (error != GL_NO_ERROR) {
    out_of_memory = true;
  }
}

void Context::Report() { RaiseError(glevGetError(evaluators)); }

}  // namespace glev::dropin
