// A provider for the tests of INDEX maps. Its contexts are RGBA contexts of OSMesa, but behave like
// colour-index contexts as far as these tests observe. The colour index is stored as the red component, in
// units of 1/1024, in current values, maps and feedback.
//
// EVALCTS_DRILL: "coarse" (legal: indices in feedback have 4 fractional bits), "rgba" (RGBA_MODE stays true),
// "sticky" (the evaluated index becomes the current index), "few" (feedback does not contain the last
// vertex).
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "drill.h"
#include "osmesa_provider.h"

namespace {

constexpr GLfloat kUnit = 1.0f / 1024;

std::set<void*> indexed_contexts;
bool is_indexed = false;  // true if the current context is a colour-index context
GLfloat* feedback = nullptr;
std::vector<GLfloat> real_feedback;

bool is_index_map(GLenum target) { return target == GL_MAP1_INDEX || target == GL_MAP2_INDEX; }
GLenum color_map(GLenum target) { return target == GL_MAP1_INDEX ? GL_MAP1_COLOR_4 : GL_MAP2_COLOR_4; }

bool curves = false, surfaces = false;  // true if MAP1_INDEX or MAP2_INDEX is enabled
GLfloat current = 1;

// Sets the current colour again. It is called before each vertex, because Mesa changes the current
// colour in evaluations.
void give_color() {
  if (is_indexed) REAL(glColor4f)(current * kUnit, 0, 0, 1);
}

void index(GLfloat value) {
  REAL(glIndexf)(value);
  current = value;
  give_color();
}

void vertex3f(GLfloat x, GLfloat y, GLfloat z) {
  give_color();
  REAL(glVertex3f)(x, y, z);
}

void enable(GLenum cap) {
  REAL(glEnable)(cap);
  if (!is_index_map(cap)) return;
  (cap == GL_MAP1_INDEX ? curves : surfaces) = true;
  if (is_indexed) REAL(glEnable)(color_map(cap));
}

void disable(GLenum cap) {
  REAL(glDisable)(cap);
  if (!is_index_map(cap)) return;
  (cap == GL_MAP1_INDEX ? curves : surfaces) = false;
  if (is_indexed) REAL(glDisable)(color_map(cap));
}

void map1f(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
  REAL(glMap1f)(target, u1, u2, stride, order, points);
  if (!is_indexed || target != GL_MAP1_INDEX) return;
  std::vector<GLfloat> colors;
  for (GLint i = 0; i < order; ++i) colors.insert(colors.end(), {points[i * stride] * kUnit, 0, 0, 1});
  REAL(glMap1f)(GL_MAP1_COLOR_4, u1, u2, 4, order, colors.data());
}

void map2f(GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
           GLint vstride, GLint vorder, const GLfloat* points) {
  REAL(glMap2f)(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  if (!is_indexed || target != GL_MAP2_INDEX) return;
  std::vector<GLfloat> colors;
  for (GLint i = 0; i < uorder; ++i)
    for (GLint j = 0; j < vorder; ++j)
      colors.insert(colors.end(), {points[i * ustride + j * vstride] * kUnit, 0, 0, 1});
  REAL(glMap2f)(GL_MAP2_COLOR_4, u1, u2, 4 * vorder, uorder, v1, v2, 4, vorder, colors.data());
}

void eval_coord1f(GLfloat u) {
  give_color();
  REAL(glEvalCoord1f)(u);
  if (is_indexed && curves && is_drill("sticky")) index(77);
}
void eval_coord2f(GLfloat u, GLfloat v) {
  give_color();
  REAL(glEvalCoord2f)(u, v);
  if (is_indexed && surfaces && is_drill("sticky")) index(77);
}

void get_booleanv(GLenum name, GLboolean* values) {
  REAL(glGetBooleanv)(name, values);
  if (is_indexed && name == GL_RGBA_MODE) *values = is_drill("rgba");
  if (is_indexed && name == GL_INDEX_MODE) *values = !is_drill("rgba");
}

void feedback_buffer(GLsizei size, GLenum type, GLfloat* buffer) {
  feedback = is_indexed && type == GL_3D_COLOR ? buffer : nullptr;
  if (!feedback) return REAL(glFeedbackBuffer)(size, type, buffer);
  real_feedback.assign(static_cast<std::size_t>(size) * 2, 0);
  REAL(glFeedbackBuffer)(size * 2, type, real_feedback.data());
}

// Converts feedback of points, in which R G B A (after the token, x, y, z) replaces the index.
GLint render_mode(GLenum mode) {
  constexpr GLint kReal = 8;
  const GLint size = REAL(glRenderMode)(mode);
  if (!feedback || size <= 0 || mode != GL_RENDER) return size;
  const GLint points = size / kReal - is_drill("few");
  GLfloat* out = feedback;
  for (GLint i = 0; i < points; ++i) {
    const GLfloat* const point = &real_feedback[static_cast<std::size_t>(i * kReal)];
    out = std::copy_n(point, 4, out);
    const GLfloat index = point[4] / kUnit;
    *out++ = is_drill("coarse") ? std::floor(index * 16) / 16 : index;
  }
  return static_cast<GLint>(out - feedback);
}

// --- The provider ------------------------------------------------------------------------------------------

int make_current(void* context) {
  is_indexed = indexed_contexts.contains(context);
  return osmesa_provider::make_current(context);
}

void* create() {
  feedback = nullptr;
  curves = surfaces = is_indexed = false;
  return osmesa_provider::create();
}

void* create_color_index() {
  void* const context = create();
  if (!context) return nullptr;
  indexed_contexts.insert(context);
  is_indexed = true;
  index(1);
  return context;
}

void destroy(void* context) {
  indexed_contexts.erase(context);
  is_indexed = false;
  osmesa_provider::destroy(context);
}

void* get_address(const char* command) {
  static const osmesa_provider::Replacement kOwn[] = {
      REPLACEMENT(glIndexf, index),
      REPLACEMENT(glVertex3f, vertex3f),
      REPLACEMENT(glEnable, enable),
      REPLACEMENT(glDisable, disable),
      REPLACEMENT(glMap1f, map1f),
      REPLACEMENT(glMap2f, map2f),
      REPLACEMENT(glEvalCoord1f, eval_coord1f),
      REPLACEMENT(glEvalCoord2f, eval_coord2f),
      REPLACEMENT(glGetBooleanv, get_booleanv),
      REPLACEMENT(glFeedbackBuffer, feedback_buffer),
      REPLACEMENT(glRenderMode, render_mode),
  };
  return osmesa_provider::find(kOwn, command);
}

}  // namespace

const evalcts_provider* evalcts_provider_open() {
  static const evalcts_provider kProvider = {
      EVALCTS_PROVIDER_VERSION, create, destroy, get_address, osmesa_provider::error, make_current,
      create_color_index,       nullptr};
  return &kProvider;
}
