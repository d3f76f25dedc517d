// A provider over OSMesa that makes it an extremely bad library. EVALCTS_DRILL names the mistake:
//   half: about half of the commands are missing
//   low, high: limits are -1, or the largest integer
//   silent: GetError never returns an error
//   noisy: GetError always returns an error
//   crashes: every second call of an evaluator crashes
//   lists: explicit and evaluated vertices in display lists are in wrong places
//   evaluated: only evaluated vertices in display lists are in wrong places
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

// Returns wrong answers to GetIntegerv for limits, and correct answers for other names.
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

// The offset of vertices in display lists, which differs from vertex to vertex.
bool in_list = false;
GLfloat astray(bool is_evaluated) {
  static int vertices = 0;
  return in_list && (is_evaluated || drill("lists")) ? 0x1p-10f * static_cast<GLfloat>(++vertices % 64) : 0;
}
void new_list(GLuint list, GLenum mode) {
  real<decltype(::glNewList)>("glNewList")(list, mode);
  in_list = true;
}
void end_list() {
  in_list = false;
  real<decltype(::glEndList)>("glEndList")();
}
void vertex3f(GLfloat x, GLfloat y, GLfloat z) {
  real<decltype(::glVertex3f)>("glVertex3f")(x + astray(false), y, z);
}
void vertex4f(GLfloat x, GLfloat y, GLfloat z, GLfloat w) {
  real<decltype(::glVertex4f)>("glVertex4f")(x + astray(false), y, z, w);
}
void eval_coord1f_astray(GLfloat u) { real<decltype(::glEvalCoord1f)>("glEvalCoord1f")(u + astray(true)); }
void eval_coord2f_astray(GLfloat u, GLfloat v) {
  real<decltype(::glEvalCoord2f)>("glEvalCoord2f")(u + astray(true), v);
}
void eval_mesh1_astray(GLenum mode, GLint first, GLint last) {
  real<decltype(::glEvalMesh1)>("glEvalMesh1")(mode, first, last + (in_list ? 1 : 0));
}
void eval_mesh2_astray(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
  real<decltype(::glEvalMesh2)>("glEvalMesh2")(mode, i1, i2 + (in_list ? 1 : 0), j1, j2);
}
template <class Function>
void* address_of(Function* function) {
  return reinterpret_cast<void*>(function);
}
void* get_address_astray(std::string_view name) {
  if (name == "glNewList") return address_of(&new_list);
  if (name == "glEndList") return address_of(&end_list);
  if (name == "glVertex3f") return address_of(&vertex3f);
  if (name == "glVertex4f") return address_of(&vertex4f);
  if (name == "glEvalCoord1f") return address_of(&eval_coord1f_astray);
  if (name == "glEvalCoord2f") return address_of(&eval_coord2f_astray);
  if (name == "glEvalMesh1") return address_of(&eval_mesh1_astray);
  if (name == "glEvalMesh2") return address_of(&eval_mesh2_astray);
  return nullptr;
}

// True for commands without which the implementation would not start.
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
  if (drill("lists") || drill("evaluated"))
    if (void* const address = get_address_astray(name)) return address;
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
  static const evalcts_provider provider = {
      EVALCTS_PROVIDER_VERSION, create, destroy, get_address, error, nullptr, nullptr};
  return &provider;
}
