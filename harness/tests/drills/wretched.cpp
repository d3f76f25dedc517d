// A provider over OSMesa with which a library is as bad as libraries get. EVALCTS_DRILL says how:
//   half: every second command is missing; low, high: limits are -1, or the largest integer; silent: GetError
//   knows no error; noisy: it never ends to know one; crashes: every second call of an evaluator crashes.
#include <GL/gl.h>
#include <dlfcn.h>
#include <evalcts_provider.h>

#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <set>
#include <string_view>

namespace {

constexpr int kSide = 64;

void* library = nullptr;
unsigned char pixels[kSide * kSide * 4];

bool drill(const char* name) {
  const char* wanted = std::getenv("EVALCTS_DRILL");
  return wanted && std::strcmp(wanted, name) == 0;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(library, name));
}

GLenum silent_error() { return GL_NO_ERROR; }
GLenum noisy_error() { return GL_INVALID_OPERATION; }

// All that GetIntegerv says of limits; the tokens of maps and grids are elsewhere.
void wrong_limits(GLenum name, GLint* values) {
  const bool is_limit = name == GL_MAX_EVAL_ORDER || name == GL_MAX_LIST_NESTING || name == 0x84E2 ||
                        name == 0x8871 || name == GL_MAX_ATTRIB_STACK_DEPTH;  // texture units, coordinates
  real<decltype(::glGetIntegerv)>("glGetIntegerv")(name, values);
  if (is_limit) *values = drill("low") ? -1 : INT_MAX;
}

void every_second_time() {
  static int calls = 0;
  if (++calls % 2 == 0) raise(SIGSEGV);
}
void map1f(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
  every_second_time();
  real<decltype(::glMap1f)>("glMap1f")(target, u1, u2, stride, order, points);
}
void eval_coord1f(GLfloat u) {
  every_second_time();
  real<decltype(::glEvalCoord1f)>("glEvalCoord1f")(u);
}

// Without these nothing starts.
bool is_vital(std::string_view command) {
  static const std::set<std::string_view> kVital = {"glGetString", "glGetError", "glGetIntegerv",
                                                    "glMap1f",     "glGetMapfv", "glEvalCoord1f"};
  return kVital.contains(command);
}

void* get_address(const char* command) {
  const std::string_view name(command);
  if (drill("half") && !is_vital(name)) {
    unsigned sum = 0;
    for (const char c : name) sum = sum * 31 + static_cast<unsigned char>(c);
    if (sum / 7 % 2 == 0) return nullptr;
  }
  if (name == "glGetError" && drill("silent")) return reinterpret_cast<void*>(&silent_error);
  if (name == "glGetError" && drill("noisy")) return reinterpret_cast<void*>(&noisy_error);
  if (name == "glGetIntegerv" && (drill("low") || drill("high")))
    return reinterpret_cast<void*>(&wrong_limits);
  if (name == "glMap1f" && drill("crashes")) return reinterpret_cast<void*>(&map1f);
  if (name == "glEvalCoord1f" && drill("crashes")) return reinterpret_cast<void*>(&eval_coord1f);
  return dlsym(library, command);
}

void* create() {
  if (!library) library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
  if (!library) return nullptr;
  void* const context =
      real<void*(GLenum, GLint, GLint, GLint, void*)>("OSMesaCreateContextExt")(GL_RGBA, 24, 8, 0, nullptr);
  real<GLboolean(void*, void*, GLenum, GLsizei, GLsizei)>("OSMesaMakeCurrent")(
      context, pixels, GL_UNSIGNED_BYTE, kSide, kSide);
  return context;
}

void destroy(void* context) { real<void(void*)>("OSMesaDestroyContext")(context); }

const char* error() { return "no OSMesa"; }

}  // namespace

const evalcts_provider* evalcts_provider_open() {
  static const evalcts_provider provider = {EVALCTS_PROVIDER_VERSION, create, destroy, get_address, error};
  return &provider;
}
