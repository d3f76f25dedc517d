// Finds the commands of the GL below.
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

[[noreturn]] void give_up(const char* what, const char* why) {
  std::fprintf(stderr, "libglevaluator_dropin: %s%s%s\n", what, why != nullptr ? ": " : "",
               why != nullptr ? why : "");
  std::abort();
}

void open_named_library() {
  const char* const name = std::getenv("GLEVALUATOR_GL");
  if (name == nullptr || *name == '\0') return;
  named_library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
  if (named_library == nullptr) give_up("GLEVALUATOR_GL names a library that cannot be loaded", dlerror());
}

using GetProcAddress = void* (*)(const char*);

// Finds a command by the window system, for programs that are linked only to the window system.
void* ask_window_system(const char* command) {
  for (const char* const name :
       {"eglGetProcAddress", "glXGetProcAddressARB", "glXGetProcAddress", "OSMesaGetProcAddress"})
    if (const auto get = reinterpret_cast<GetProcAddress>(find_below(name)))
      if (void* const address = get(command)) return address;
  return nullptr;
}

void* find_command(const char* name) {
  if (void* const address = find_below(name)) return address;
  if (void* const address = ask_window_system(name)) return address;
  if (named_library != nullptr) return nullptr;
  static void* const kUsual = dlopen("libGL.so.1", RTLD_LAZY | RTLD_LOCAL);
  return kUsual != nullptr ? dlsym(kUsual, name) : nullptr;
}

// Finds a command by its name or, if it was an extension before, by the name of the extension.
template <class Command>
void find(const char* name, const char* name_of_extension, Command* command) {
  void* address = find_command(name);
  if (address == nullptr) address = find_command(name_of_extension);
  *command = reinterpret_cast<Command>(address);
}

void load() {
#define X(name) find("gl" #name, "gl" #name "ARB", &commands.name);
  DROPIN_EVALUATORS(X)
  DROPIN_COMMANDS(X)
#undef X
#define X(attribute, command, n, most, letter, type) \
  find("gl" #command #n #letter "v", "gl" #command #n #letter "vARB", &commands.command##n##letter##v);
  DROPIN_SETTERS(X)
  DROPIN_UNIT_SETTERS(X)
#undef X
#define X(attribute, command) find("gl" #command, "gl" #command "ARB", &commands.command);
  DROPIN_PACKED_SETTERS(X)
#undef X
#define X(command) find("gl" #command, "gl" #command "ARB", &commands.command);
  DROPIN_PACKED_UNIT_SETTERS(X)
#undef X
  if (commands.Begin == nullptr || commands.GetIntegerv == nullptr)
    give_up("there is no OpenGL below: link or load one, or name it with GLEVALUATOR_GL", nullptr);
  __atomic_store_n(&loaded, true, __ATOMIC_RELEASE);
}

}  // namespace

const GlBelow& gl_below() {
  if (!__atomic_load_n(&loaded, __ATOMIC_ACQUIRE)) pthread_once(&once, load);
  return commands;
}

void* find_below(const char* symbol) {
  pthread_once(&named_once, open_named_library);
  if (named_library != nullptr) return dlsym(named_library, symbol);
  return dlsym(RTLD_NEXT, symbol);
}

}  // namespace glev::dropin
