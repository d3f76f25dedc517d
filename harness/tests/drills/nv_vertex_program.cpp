// A provider for the tests of NV_vertex_program: OSMesa with the part of this extension that the tests use,
// which is implemented by ARB_vertex_program and conventional maps. While a primitive is drawn in program
// mode, conventional maps stand in for the maps of attributes that have a conventional map.
//
// EVALCTS_DRILL "homogeneous": automatic normals ignore w. Other mistakes are faults
// (harness/faults/wrappers/nv_vertex_program.cpp).
#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "drill.h"
#include "osmesa_provider.h"

namespace {

constexpr GLenum kFirst[] = {0x8660, 0x8670};  // the maps of attribute 0, 1-D and 2-D
constexpr int kAttributes = 16;

// Returns the conventional target of an attribute in one (0) or two (1) dimensions; 0 if there is none.
GLenum conventional(int attribute, int dimension) {
  const GLenum target = attribute == 0   ? GL_MAP1_VERTEX_4
                        : attribute == 2 ? GL_MAP1_NORMAL
                        : attribute == 3 ? GL_MAP1_COLOR_4
                        : attribute == 8 ? GL_MAP1_TEXTURE_COORD_4
                                         : 0;
  return target && dimension ? target + 0x20 : target;
}

struct Map {
  GLint order[2] = {1, 1};
  GLfloat domain[4] = {0, 1, 0, 1};
  std::vector<GLfloat> points = {0, 0, 0, 1};  // 4 components; v varies fastest
};

using Enables = std::array<std::array<bool, kAttributes>, 2>;

struct State {
  std::array<std::array<Map, kAttributes>, 2> maps;
  Enables enabled{};
  std::vector<std::pair<GLbitfield, Enables>> stack;
  bool program = false;
  GLenum error = GL_NO_ERROR;
  // State that is valid while a primitive is drawn.
  bool drawing = false, automatic = false;
  std::vector<std::pair<GLenum, bool>> replaced;
  std::vector<std::vector<GLfloat>> replaced_points;
  std::vector<std::array<GLint, 2>> replaced_orders;
  std::vector<std::array<GLfloat, 4>> replaced_domains;
  GLfloat color[4], normal[3], texture[4];
};
State state;

// Determines the map that a token names. Returns false if the token is not a map of an attribute.
bool find(GLenum token, int& dimension, int& attribute) {
  for (dimension = 0; dimension < 2; ++dimension)
    if (token >= kFirst[dimension] && token < kFirst[dimension] + kAttributes) {
      attribute = static_cast<int>(token - kFirst[dimension]);
      return true;
    }
  return false;
}

void raise(GLenum error) {
  if (state.error == GL_NO_ERROR) state.error = error;
}

GLenum get_error() {
  const GLenum own = std::exchange(state.error, static_cast<GLenum>(GL_NO_ERROR));
  return own != GL_NO_ERROR ? own : REAL(glGetError)();
}

const GLubyte* get_string(GLenum name) {
  static std::string extensions;
  const GLubyte* text = REAL(glGetString)(name);
  if (name != GL_EXTENSIONS || !text) return text;
  extensions = reinterpret_cast<const char*>(text) + std::string(" GL_NV_vertex_program");
  return reinterpret_cast<const GLubyte*>(extensions.c_str());
}

void set(GLenum token, bool on) {
  int dimension = 0, attribute = 0;
  if (token == GL_VERTEX_PROGRAM_NV) state.program = on;
  if (find(token, dimension, attribute)) {
    state.enabled[static_cast<std::size_t>(dimension)][static_cast<std::size_t>(attribute)] = on;
  } else if (on) {
    REAL(glEnable)(token);
  } else {
    REAL(glDisable)(token);
  }
}
void enable(GLenum token) { set(token, true); }
void disable(GLenum token) { set(token, false); }

bool is_on(int dimension, int attribute) {
  return state.enabled[static_cast<std::size_t>(dimension)][static_cast<std::size_t>(attribute)];
}

GLboolean is_enabled(GLenum token) {
  int dimension = 0, attribute = 0;
  return find(token, dimension, attribute) ? is_on(dimension, attribute) : REAL(glIsEnabled)(token);
}

void get_integerv(GLenum token, GLint* values) {
  int dimension = 0, attribute = 0;
  if (find(token, dimension, attribute)) {
    *values = is_on(dimension, attribute);
  } else {
    REAL(glGetIntegerv)(token, values);
  }
}

void push_attrib(GLbitfield bits) {
  state.stack.emplace_back(bits, state.enabled);
  REAL(glPushAttrib)(bits);
}
void pop_attrib() {
  if (!state.stack.empty()) {
    if (state.stack.back().first & (GL_ENABLE_BIT | GL_EVAL_BIT)) state.enabled = state.stack.back().second;
    state.stack.pop_back();
  }
  REAL(glPopAttrib)();
}

void define(Map& map, int dimension, const GLfloat* domain, const GLint* stride, const GLint* order,
            const GLfloat* points) {
  if (domain[0] == domain[1] || stride[0] < 4 || (dimension && stride[1] < 4) || order[0] < 1)
    return raise(GL_INVALID_VALUE);
  map.points.clear();
  std::copy_n(order, 1 + dimension, map.order);
  std::copy_n(domain, 2 + 2 * dimension, map.domain);
  for (int i = 0; i < order[0]; ++i)
    for (int j = 0; j < (dimension ? order[1] : 1); ++j)
      for (int k = 0; k < 4; ++k)
        map.points.push_back(points[i * stride[0] + j * (dimension ? stride[1] : 0) + k]);
}

void map1f(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
  int dimension = 0, attribute = 0;
  if (!find(target, dimension, attribute)) return REAL(glMap1f)(target, u1, u2, stride, order, points);
  const GLfloat domain[] = {u1, u2};
  define(state.maps[0][attribute], 0, domain, &stride, &order, points);
}
void map2f(GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
           GLint vstride, GLint vorder, const GLfloat* points) {
  int dimension = 0, attribute = 0;
  if (!find(target, dimension, attribute))
    return REAL(glMap2f)(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
  const GLfloat domain[] = {u1, u2, v1, v2};
  const GLint stride[] = {ustride, vstride}, order[] = {uorder, vorder};
  define(state.maps[1][attribute], 1, domain, stride, order, points);
}

template <class T>
bool query(GLenum target, GLenum what, T* values) {
  int dimension = 0, attribute = 0;
  if (!find(target, dimension, attribute)) return false;
  const Map& map = state.maps[dimension][attribute];
  if (what == GL_ORDER) {
    for (int i = 0; i <= dimension; ++i) values[i] = static_cast<T>(map.order[i]);
  } else {
    for (std::size_t i = 0; i < map.points.size(); ++i) values[i] = static_cast<T>(map.points[i]);
  }
  return true;
}
void get_mapfv(GLenum target, GLenum what, GLfloat* values) {
  if (!query(target, what, values)) REAL(glGetMapfv)(target, what, values);
}
void get_mapiv(GLenum target, GLenum what, GLint* values) {
  if (!query(target, what, values)) REAL(glGetMapiv)(target, what, values);
}

void load_program(GLenum target, GLuint number, GLsizei length, const GLubyte* program) {
  std::string text(reinterpret_cast<const char*>(program), static_cast<std::size_t>(length));
  constexpr const char* kWords[][2] = {{"!!VP1.0", "!!ARBvp1.0"},    {"o[HPOS]", "result.position"},
                                       {"o[COL0]", "result.color"},  {"v[OPOS]", "vertex.position"},
                                       {"v[NRML]", "vertex.normal"}, {"v[COL0]", "vertex.color"}};
  for (const auto& [nv, arb] : kWords)
    for (std::size_t at = 0; (at = text.find(nv)) != std::string::npos;)
      text.replace(at, std::strlen(nv), arb);
  REAL(glBindProgramARB)(target, number);
  REAL(glProgramStringARB)
  (target, GL_PROGRAM_FORMAT_ASCII_ARB, static_cast<GLsizei>(text.size()), text.data());
}
void bind_program(GLenum target, GLuint number) { REAL(glBindProgramARB)(target, number); }

void set_conventional(GLenum target, int dimension, const GLint* order, const GLfloat* domain,
                      const std::vector<GLfloat>& points) {
  const int k = static_cast<int>(points.size()) / (order[0] * (dimension ? order[1] : 1));
  if (dimension) {
    REAL(glMap2f)
    (target, domain[0], domain[1], k * order[1], order[0], domain[2], domain[3], k, order[1], points.data());
  } else {
    REAL(glMap1f)(target, domain[0], domain[1], k, order[0], points.data());
  }
}

void begin(GLenum mode) {
  state.drawing = state.program;
  if (state.program) {
    REAL(glGetFloatv)(GL_CURRENT_COLOR, state.color);
    REAL(glGetFloatv)(GL_CURRENT_NORMAL, state.normal);
    REAL(glGetFloatv)(GL_CURRENT_TEXTURE_COORDS, state.texture);
    state.automatic = REAL(glIsEnabled)(GL_AUTO_NORMAL);
    if (state.automatic) REAL(glDisable)(GL_AUTO_NORMAL);
    for (int dimension = 0; dimension < 2; ++dimension)
      for (const int attribute : {0, 2, 3, 8}) {
        const GLenum target = conventional(attribute, dimension);
        const bool was_on = REAL(glIsEnabled)(target);
        if (!is_on(dimension, attribute)) continue;
        std::array<GLint, 2> order{};
        std::array<GLfloat, 4> domain{};
        REAL(glGetMapiv)(target, GL_ORDER, order.data());
        REAL(glGetMapfv)(target, GL_DOMAIN, domain.data());
        const int k = attribute == 2 ? 3 : 4;
        std::vector<GLfloat> points(static_cast<std::size_t>(k * order[0] * (dimension ? order[1] : 1)));
        REAL(glGetMapfv)(target, GL_COEFF, points.data());
        state.replaced.emplace_back(target, was_on);
        state.replaced_points.push_back(points);
        state.replaced_orders.push_back(order);
        state.replaced_domains.push_back(domain);
        const Map& map = state.maps[dimension][attribute];
        std::vector<GLfloat> own;
        for (std::size_t i = 0; i < map.points.size(); ++i)
          if (k == 4 || i % 4 != 3) own.push_back(map.points[i]);
        set_conventional(target, dimension, map.order, map.domain, own);
        REAL(glEnable)(target);
      }
  }
  REAL(glBegin)(mode);
}

void end() {
  REAL(glEnd)();
  if (!state.drawing) return;
  state.drawing = false;
  for (std::size_t i = 0; i < state.replaced.size(); ++i) {
    const auto [target, was_on] = state.replaced[i];
    set_conventional(target, target >= GL_MAP2_COLOR_4, state.replaced_orders[i].data(),
                     state.replaced_domains[i].data(), state.replaced_points[i]);
    if (!was_on) REAL(glDisable)(target);
  }
  state.replaced.clear();
  state.replaced_points.clear();
  state.replaced_orders.clear();
  state.replaced_domains.clear();
  if (state.automatic) REAL(glEnable)(GL_AUTO_NORMAL);
  REAL(glNormal3fv)(state.normal);
  REAL(glColor4fv)(state.color);
  REAL(glTexCoord4fv)(state.texture);
}

// A point and its first derivatives, computed by de Casteljau's algorithm in v, then in u.
struct Derivatives {
  double value[4], u[4], v[4];
};
Derivatives evaluate(const Map& map, double u, double v) {
  const auto casteljau = [](std::vector<double> b, double t, double& derivative) {
    derivative = 0;
    for (std::size_t n = b.size() - 1; n > 0; --n) {
      if (n == 1) derivative = static_cast<double>(b.size() - 1) * (b[1] - b[0]);
      for (std::size_t i = 0; i < n; ++i) b[i] += t * (b[i + 1] - b[i]);
    }
    return b[0];
  };
  Derivatives out{};
  const auto m = static_cast<std::size_t>(map.order[0]), n = static_cast<std::size_t>(map.order[1]);
  for (std::size_t k = 0; k < 4; ++k) {
    std::vector<double> values(m), slopes(m);
    for (std::size_t i = 0; i < m; ++i) {
      std::vector<double> row(n);
      for (std::size_t j = 0; j < n; ++j) row[j] = map.points[(i * n + j) * 4 + k];
      values[i] = casteljau(row, v, slopes[i]);
    }
    double unused = 0;
    out.value[k] = casteljau(values, u, out.u[k]);
    out.v[k] = casteljau(slopes, u, unused);
  }
  return out;
}

void eval_coord1f(GLfloat u) { REAL(glEvalCoord1f)(u); }
void eval_coord2f(GLfloat u, GLfloat v) {
  if (state.drawing && state.automatic && is_on(1, 0)) {
    const Derivatives d = evaluate(state.maps[1][0], u, v);
    double a[3], b[3];
    for (int i = 0; i < 3; ++i) {
      const double w = d.value[3];
      a[i] = is_drill("homogeneous") ? d.u[i] : (d.u[i] * w - d.value[i] * d.u[3]) / (w * w);
      b[i] = is_drill("homogeneous") ? d.v[i] : (d.v[i] * w - d.value[i] * d.v[3]) / (w * w);
    }
    REAL(glNormal3f)
    (static_cast<GLfloat>(a[1] * b[2] - a[2] * b[1]), static_cast<GLfloat>(a[2] * b[0] - a[0] * b[2]),
     static_cast<GLfloat>(a[0] * b[1] - a[1] * b[0]));
  }
  REAL(glEvalCoord2f)(u, v);
}

// --- The provider ------------------------------------------------------------------------------------------

void* create() {
  state = {};
  return osmesa_provider::create();
}

void* get_address(const char* command) {
  static const osmesa_provider::Replacement kOwn[] = {REPLACEMENT(glGetError, get_error),
                                                      REPLACEMENT(glGetString, get_string),
                                                      REPLACEMENT(glEnable, enable),
                                                      REPLACEMENT(glDisable, disable),
                                                      REPLACEMENT(glIsEnabled, is_enabled),
                                                      REPLACEMENT(glGetIntegerv, get_integerv),
                                                      REPLACEMENT(glPushAttrib, push_attrib),
                                                      REPLACEMENT(glPopAttrib, pop_attrib),
                                                      REPLACEMENT(glMap1f, map1f),
                                                      REPLACEMENT(glMap2f, map2f),
                                                      REPLACEMENT(glGetMapfv, get_mapfv),
                                                      REPLACEMENT(glGetMapiv, get_mapiv),
                                                      REPLACEMENT(glLoadProgramNV, load_program),
                                                      REPLACEMENT(glBindProgramNV, bind_program),
                                                      REPLACEMENT(glBegin, begin),
                                                      REPLACEMENT(glEnd, end),
                                                      REPLACEMENT(glEvalCoord1f, eval_coord1f),
                                                      REPLACEMENT(glEvalCoord2f, eval_coord2f)};
  return osmesa_provider::find(kOwn, command);
}

}  // namespace

const evalcts_provider* evalcts_provider_open() {
  static const evalcts_provider kProvider = {EVALCTS_PROVIDER_VERSION,
                                             create,
                                             osmesa_provider::destroy,
                                             get_address,
                                             osmesa_provider::error,
                                             nullptr,
                                             nullptr,
                                             nullptr};
  return &kProvider;
}
