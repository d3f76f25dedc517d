#include "gl_below.h"

#include <dlfcn.h>
#include <pthread.h>

#include <cstdio>
#include <cstdlib>
#include <initializer_list>

namespace glev::dropin {
namespace {

GlBelow commands;
bool loaded = false;
pthread_once_t once = PTHREAD_ONCE_INIT;
pthread_once_t named_once = PTHREAD_ONCE_INIT;
void* named_library = nullptr;

[[noreturn]] void GiveUp(const char* what, const char* why) {
  std::fprintf(stderr, "libglevaluator_dropin: %s%s%s\n", what, why != nullptr ? ": " : "",
               why != nullptr ? why : "");
  std::abort();
}

void OpenNamedLibrary() {
  const char* const name = std::getenv("GLEVALUATOR_GL");
  if (name == nullptr || *name == '\0') return;
  named_library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
  if (named_library == nullptr) GiveUp("GLEVALUATOR_GL names a library that cannot be loaded", dlerror());
}

using GetProcAddress = void* (*)(const char*);

// The commands of a program that is linked to its window system only.
void* AskWindowSystem(const char* command) {
  for (const char* const name :
       {"eglGetProcAddress", "glXGetProcAddressARB", "glXGetProcAddress", "OSMesaGetProcAddress"})
    if (const auto get = reinterpret_cast<GetProcAddress>(FindBelow(name)))
      if (void* const address = get(command)) return address;
  return nullptr;
}

void* FindCommand(const char* name) {
  if (void* const address = FindBelow(name)) return address;
  if (void* const address = AskWindowSystem(name)) return address;
  if (named_library != nullptr) return nullptr;
  static void* const usual = dlopen("libGL.so.1", RTLD_LAZY | RTLD_LOCAL);
  return usual != nullptr ? dlsym(usual, name) : nullptr;
}

// Commands that were extensions before they became part of the GL have a second name.
template <class Command>
void Find(const char* name, const char* name_of_extension, Command* command) {
  void* address = FindCommand(name);
  if (address == nullptr) address = FindCommand(name_of_extension);
  *command = reinterpret_cast<Command>(address);
}

void Load() {
#define X(name) Find("gl" #name, "gl" #name "ARB", &commands.name);
  DROPIN_EVALUATORS(X)
  DROPIN_COMMANDS(X)
#undef X
#define X(attribute, command, n, most, letter, type) \
  Find("gl" #command #n #letter "v", "gl" #command #n #letter "vARB", &commands.command##n##letter##v);
  DROPIN_SETTERS(X)
  DROPIN_UNIT_SETTERS(X)
#undef X
#define X(attribute, command) Find("gl" #command, "gl" #command "ARB", &commands.command);
  DROPIN_PACKED_SETTERS(X)
#undef X
#define X(command) Find("gl" #command, "gl" #command "ARB", &commands.command);
  DROPIN_PACKED_UNIT_SETTERS(X)
#undef X
  if (commands.Begin == nullptr || commands.GetIntegerv == nullptr)
    GiveUp("there is no OpenGL below: link or load one, or name it with GLEVALUATOR_GL", nullptr);
  __atomic_store_n(&loaded, true, __ATOMIC_RELEASE);
}

}  // namespace

const GlBelow& Gl() {
  if (!__atomic_load_n(&loaded, __ATOMIC_ACQUIRE)) pthread_once(&once, Load);
  return commands;
}

void* FindBelow(const char* symbol) {
  pthread_once(&named_once, OpenNamedLibrary);
  if (named_library != nullptr) return dlsym(named_library, symbol);
  return dlsym(RTLD_NEXT, symbol);
}

}  // namespace glev::dropin
