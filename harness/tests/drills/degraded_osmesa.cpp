// A provider over OSMesa that makes it an extremely bad library. EVALCTS_DRILL names the mistake:
//   half: about half of the commands are missing
//   low, high: limits are -1, or the largest integer
//   silent: GetError never returns an error
//   noisy: GetError always returns an error
//   crashes: every second call of an evaluator crashes
//   lists: explicit and evaluated vertices in display lists are in wrong places
//   evaluated: only evaluated vertices in display lists are in wrong places
//   begin: in display lists, Begin has no effect on the commands behind it
//   short-answers: GetMapfv does not return the last coefficient
//   short-meshes: EvalMesh2 drops its last row
//   older: glActiveTexture has only its name in GL_ARB_multitexture
//   the name of a command: this command is missing
#include <algorithm>
#include <climits>
#include <cmath>
#include <csignal>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "drill.h"
#include "osmesa_provider.h"

namespace {

GLenum silent_error() { return GL_NO_ERROR; }
GLenum noisy_error() { return GL_INVALID_OPERATION; }

// Returns wrong answers to GetIntegerv for limits, and correct answers for other names.
void wrong_limits(GLenum name, GLint* values) {
  const bool is_limit = name == GL_MAX_EVAL_ORDER || name == GL_MAX_LIST_NESTING || name == 0x84E2 ||
                        name == 0x8871 || name == GL_MAX_ATTRIB_STACK_DEPTH;  // texture units, coordinates
  REAL(glGetIntegerv)(name, values);
  if (is_limit) *values = is_drill("low") ? -1 : INT_MAX;
}

void every_second_time() {
  static int calls = 0;
  if (++calls % 2 == 0) raise(SIGSEGV);
}
void map1f(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
  every_second_time();
  REAL(glMap1f)(target, u1, u2, stride, order, points);
}
void eval_coord1f(GLfloat u) {
  every_second_time();
  REAL(glEvalCoord1f)(u);
}

// The offset of vertices in display lists, which differs from vertex to vertex.
bool in_list = false;
GLfloat astray(bool is_evaluated) {
  static int vertices = 0;
  return in_list && (is_evaluated || is_drill("lists")) ? 0x1p-10f * static_cast<GLfloat>(++vertices % 64)
                                                        : 0;
}
void new_list(GLuint list, GLenum mode) {
  REAL(glNewList)(list, mode);
  in_list = true;
}
void end_list() {
  in_list = false;
  REAL(glEndList)();
}
void begin(GLenum mode) {
  REAL(glBegin)(mode);
  if (in_list) REAL(glEnd)();
}
void vertex3f(GLfloat x, GLfloat y, GLfloat z) { REAL(glVertex3f)(x + astray(false), y, z); }
void vertex4f(GLfloat x, GLfloat y, GLfloat z, GLfloat w) { REAL(glVertex4f)(x + astray(false), y, z, w); }
void eval_coord1f_astray(GLfloat u) { REAL(glEvalCoord1f)(u + astray(true)); }
void eval_coord2f_astray(GLfloat u, GLfloat v) { REAL(glEvalCoord2f)(u + astray(true), v); }
void eval_mesh1_astray(GLenum mode, GLint first, GLint last) {
  REAL(glEvalMesh1)(mode, first, last + (in_list ? 1 : 0));
}
void eval_mesh2_astray(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
  REAL(glEvalMesh2)(mode, i1, i2 + (in_list ? 1 : 0), j1, j2);
}

// Writes all coefficients but the last. The number of coefficients that OSMesa writes ends the copy.
void get_mapfv_short(GLenum target, GLenum query, GLfloat* values) {
  if (query != GL_COEFF) return REAL(glGetMapfv)(target, query, values);
  GLint orders[2] = {1, 1};
  REAL(glGetMapiv)(target, GL_ORDER, orders);
  constexpr std::size_t kMostComponents = 4;
  std::vector<GLfloat> all(
      static_cast<std::size_t>(orders[0]) * static_cast<std::size_t>(orders[1]) * kMostComponents, NAN);
  REAL(glGetMapfv)(target, query, all.data());
  const auto end = std::ranges::find_if(all, [](GLfloat value) { return std::isnan(value); });
  if (end != all.begin()) std::copy(all.begin(), end - 1, values);
}
void eval_mesh2_short(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
  REAL(glEvalMesh2)(mode, i1, i2, j1, j2 - 1);
}

// True for commands without which the implementation would not start.
bool is_vital(std::string_view command) {
  static const std::set<std::string_view> kVital = {"glGetString", "glGetError", "glGetIntegerv",
                                                    "glMap1f",     "glGetMapfv", "glEvalCoord1f"};
  return kVital.contains(command);
}

void* get_address(const char* command) {
  const std::string_view name(command);
  if (is_drill(command)) return nullptr;
  if (is_drill("half") && !is_vital(name)) {
    unsigned sum = 0;
    for (const char c : name) sum = sum * 31 + static_cast<unsigned char>(c);
    if (sum / 7 % 2 == 0) return nullptr;
  }
  if (is_drill("older") && name == "glActiveTexture") return nullptr;
  static const osmesa_provider::Replacement kSilent[] = {REPLACEMENT(glGetError, silent_error)};
  static const osmesa_provider::Replacement kNoisy[] = {REPLACEMENT(glGetError, noisy_error)};
  static const osmesa_provider::Replacement kLimits[] = {REPLACEMENT(glGetIntegerv, wrong_limits)};
  static const osmesa_provider::Replacement kCrashes[] = {REPLACEMENT(glMap1f, map1f),
                                                          REPLACEMENT(glEvalCoord1f, eval_coord1f)};
  static const osmesa_provider::Replacement kAstray[] = {
      REPLACEMENT(glNewList, new_list),
      REPLACEMENT(glEndList, end_list),
      REPLACEMENT(glVertex3f, vertex3f),
      REPLACEMENT(glVertex4f, vertex4f),
      REPLACEMENT(glEvalCoord1f, eval_coord1f_astray),
      REPLACEMENT(glEvalCoord2f, eval_coord2f_astray),
      REPLACEMENT(glEvalMesh1, eval_mesh1_astray),
      REPLACEMENT(glEvalMesh2, eval_mesh2_astray),
  };
  static const osmesa_provider::Replacement kBegin[] = {
      REPLACEMENT(glNewList, new_list), REPLACEMENT(glEndList, end_list), REPLACEMENT(glBegin, begin)};
  static const osmesa_provider::Replacement kShortAnswers[] = {REPLACEMENT(glGetMapfv, get_mapfv_short)};
  static const osmesa_provider::Replacement kShortMeshes[] = {REPLACEMENT(glEvalMesh2, eval_mesh2_short)};
  const std::pair<const char*, std::span<const osmesa_provider::Replacement>> mistakes[] = {
      {"short-answers", kShortAnswers},
      {"short-meshes", kShortMeshes},
      {"silent", kSilent},
      {"noisy", kNoisy},
      {"low", kLimits},
      {"high", kLimits},
      {"crashes", kCrashes},
      {"lists", kAstray},
      {"evaluated", kAstray},
      {"begin", kBegin}};
  for (const auto& [mistake, own] : mistakes)
    if (is_drill(mistake)) return osmesa_provider::find(own, command);
  return osmesa_provider::address_of(command);
}

}  // namespace

const evalcts_provider* evalcts_provider_open() {
  static const evalcts_provider kProvider = {EVALCTS_PROVIDER_VERSION,
                                             osmesa_provider::create,
                                             osmesa_provider::destroy,
                                             get_address,
                                             osmesa_provider::error,
                                             nullptr,
                                             nullptr,
                                             nullptr};
  return &kProvider;
}
