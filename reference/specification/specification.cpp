// Section numbers are those of the GL 2.1 specification; EV-, C- and U- names are rows of the requirements.

#include <reference/specification.h>

#include <algorithm>
#include <utility>

#include "reference/specification/conversion.h"

namespace evalcts::reference {
namespace {

bool is_map_target(GLenum target) { return is_map1_target(target) || is_map2_target(target); }

bool is_texture_unit(GLenum texture) {
  return texture >= GL_TEXTURE0 && texture < GL_TEXTURE0 + kTextureUnits;
}

// A value of the state as the answer to a query of type T; `normalized` for colours and normals.
template <typename T>
T convert(double value, bool normalized);
template <>
GLboolean convert<GLboolean>(double value, bool) {
  return to_boolean(value);
}
template <>
GLint convert<GLint>(double value, bool normalized) {
  return normalized ? normalized_to_integer(value) : to_integer(value);
}
template <>
GLfloat convert<GLfloat>(double value, bool) {
  return to_float(value);
}
template <>
GLdouble convert<GLdouble>(double value, bool) {
  return value;
}

}  // namespace

std::size_t Specification::slot(GLenum target) {
  return is_map1_target(target) ? target - GL_MAP1_COLOR_4 : kMapKinds + target - GL_MAP2_COLOR_4;
}

Specification::Specification() : Specification(Options{}) {}

Specification::Specification(const Options& options)
    : max_eval_order_(std::clamp(options.max_eval_order, 8, kMaxOrder)) {
  for (GLenum i = 0; i < kMapKinds; ++i) {
    maps_[slot(GL_MAP1_COLOR_4 + i)] = std::make_shared<const Map>(initial_map(GL_MAP1_COLOR_4 + i));
    maps_[slot(GL_MAP2_COLOR_4 + i)] = std::make_shared<const Map>(initial_map(GL_MAP2_COLOR_4 + i));
  }
}

// ---- Errors (section 2.5) ----

bool Specification::refused(std::initializer_list<Objection> objections) {
  permitted_errors_.clear();
  for (const Objection& objection : objections) {
    if (objection.applies && std::ranges::count(permitted_errors_, objection.error) == 0) {
      permitted_errors_.push_back(objection.error);
    }
  }
  if (permitted_errors_.empty()) return false;
  if (error_ == GL_NO_ERROR) error_ = permitted_errors_.front();  // a recorded error stays until it is read
  return true;
}

GLenum Specification::GetError() {
  if (refused({{inside(), GL_INVALID_OPERATION}})) return GL_NO_ERROR;
  return std::exchange(error_, GL_NO_ERROR);
}

// ---- Maps (section 5.1) ----

template <typename T>
void Specification::map1(GLenum target, T u1, T u2, GLint stride, GLint order, const T* points) {
  const int k = is_map1_target(target) ? values_per_point(target) : 0;
  if (refused({{inside(), GL_INVALID_OPERATION},                          // EV-MAP1-ERR-BEGINEND
               {!is_map1_target(target), GL_INVALID_ENUM},                // EV-MAP1-ERR-TARGET
               {order < 1 || order > max_eval_order_, GL_INVALID_VALUE},  // EV-MAP1-ERR-ORDER-*
               {stride < k, GL_INVALID_VALUE},                            // EV-MAP1-ERR-STRIDE
               {u1 == u2, GL_INVALID_VALUE},                              // EV-MAP1-ERR-DOMAIN
               {active_texture_ != 0, GL_INVALID_OPERATION}})) {          // EV-MAP1-ERR-ACTIVETEX
    return;
  }
  if (points == nullptr) return;
  Map map{target, {order, u1, u2}, {}, {}};
  for (std::ptrdiff_t i = 0; i < order; ++i) {
    map.points.insert(map.points.end(), points + i * stride, points + i * stride + k);
  }
  maps_[slot(target)] = std::make_shared<const Map>(std::move(map));
}

template <typename T>
void Specification::map2(GLenum target, T u1, T u2, GLint ustride, GLint uorder, T v1, T v2, GLint vstride,
                         GLint vorder, const T* points) {
  const int k = is_map2_target(target) ? values_per_point(target) : 0;
  const auto is_order = [this](GLint order) { return order >= 1 && order <= max_eval_order_; };
  if (refused({{inside(), GL_INVALID_OPERATION},                  // EV-MAP2-ERR-BEGINEND
               {!is_map2_target(target), GL_INVALID_ENUM},        // EV-MAP2-ERR-TARGET
               {!is_order(uorder), GL_INVALID_VALUE},             // EV-MAP2-ERR-UORDER
               {!is_order(vorder), GL_INVALID_VALUE},             // EV-MAP2-ERR-VORDER
               {ustride < k, GL_INVALID_VALUE},                   // EV-MAP2-ERR-USTRIDE
               {vstride < k, GL_INVALID_VALUE},                   // EV-MAP2-ERR-VSTRIDE
               {u1 == u2, GL_INVALID_VALUE},                      // EV-MAP2-ERR-UDOMAIN
               {v1 == v2, GL_INVALID_VALUE},                      // EV-MAP2-ERR-VDOMAIN
               {active_texture_ != 0, GL_INVALID_OPERATION}})) {  // EV-MAP2-ERR-ACTIVETEX
    return;
  }
  if (points == nullptr) return;
  Map map{target, {uorder, u1, u2}, {vorder, v1, v2}, {}};
  for (std::ptrdiff_t i = 0; i < uorder; ++i) {
    for (std::ptrdiff_t j = 0; j < vorder; ++j) {
      const T* const point = points + (i * ustride + j * vstride);  // EV-MAP2-ADDRESS
      map.points.insert(map.points.end(), point, point + k);
    }
  }
  maps_[slot(target)] = std::make_shared<const Map>(std::move(map));
}

void Specification::Map1f(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order,
                          const GLfloat* points) {
  map1(target, u1, u2, stride, order, points);
}

void Specification::Map1d(GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                          const GLdouble* points) {
  map1(target, u1, u2, stride, order, points);
}

void Specification::Map2f(GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1,
                          GLfloat v2, GLint vstride, GLint vorder, const GLfloat* points) {
  map2(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
}

void Specification::Map2d(GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                          GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
  map2(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
}

// ---- Begin and End (section 2.6) ----

void Specification::Begin(GLenum mode) {
  if (refused({{inside(), GL_INVALID_OPERATION}, {mode > GL_POLYGON, GL_INVALID_ENUM}})) return;
  open_ = Primitive{mode, {}};
}

void Specification::End() {
  if (refused({{!inside(), GL_INVALID_OPERATION}})) return;
  completed_.push_back(*std::exchange(open_, std::nullopt));
}

std::vector<Primitive> Specification::take_primitives() { return std::exchange(completed_, {}); }

// ---- Vertices and current values (section 2.7) ----

Vertex Specification::current_vertex() const {
  Vertex vertex;
  vertex.position = {0.0f, 0.0f, 0.0f, 1.0f};
  std::ranges::copy(current_.color, vertex.color.begin());
  vertex.normal = std::array<Component, 3>{current_.normal[0], current_.normal[1], current_.normal[2]};
  for (int unit = 0; unit < kTextureUnits; ++unit) {
    std::ranges::copy(current_.texture_coordinate[unit], vertex.texture_coordinate[unit].begin());
  }
  vertex.index = current_.index;
  vertex.edge_flag = current_.edge_flag;
  return vertex;
}

void Specification::vertex(double x, double y, double z, double w) {
  refused({});
  if (!inside()) return;
  Vertex vertex = current_vertex();
  vertex.position = {to_single(x), to_single(y), to_single(z), to_single(w)};
  open_->vertices.push_back(std::move(vertex));
}

void Specification::color(double red, double green, double blue, double alpha) {
  refused({});
  current_.color = {to_single(red), to_single(green), to_single(blue), to_single(alpha)};
}

void Specification::normal(double x, double y, double z) {
  refused({});
  current_.normal = {to_single(x), to_single(y), to_single(z)};
}

void Specification::texture_coordinate(GLenum texture, double s, double t, double r, double q) {
  if (refused({{!is_texture_unit(texture), GL_INVALID_ENUM}})) return;
  current_.texture_coordinate[texture - GL_TEXTURE0] = {to_single(s), to_single(t), to_single(r),
                                                        to_single(q)};
}

void Specification::index(double c) {
  refused({});
  current_.index = to_single(c);
}

void Specification::EdgeFlag(GLboolean flag) {
  refused({});
  current_.edge_flag = flag != GL_FALSE;
}

void Specification::ActiveTexture(GLenum texture) {
  if (refused({{inside(), GL_INVALID_OPERATION}, {!is_texture_unit(texture), GL_INVALID_ENUM}})) return;
  active_texture_ = static_cast<int>(texture - GL_TEXTURE0);
}

// ---- Enables (section 5.1) ----

std::optional<bool> Specification::enabled(GLenum cap) const {
  if (cap == GL_AUTO_NORMAL) return evaluators_.auto_normal;
  if (is_map_target(cap)) return evaluators_.map_enabled[slot(cap)];
  return std::nullopt;
}

void Specification::set_enabled(GLenum cap, bool value) {
  if (refused({{inside(), GL_INVALID_OPERATION}, {!enabled(cap), GL_INVALID_ENUM}})) return;
  (cap == GL_AUTO_NORMAL ? evaluators_.auto_normal : evaluators_.map_enabled[slot(cap)]) = value;
}

void Specification::Enable(GLenum cap) { set_enabled(cap, true); }
void Specification::Disable(GLenum cap) { set_enabled(cap, false); }

GLboolean Specification::IsEnabled(GLenum cap) {
  if (refused({{inside(), GL_INVALID_OPERATION}, {!enabled(cap), GL_INVALID_ENUM}})) return GL_FALSE;
  return *enabled(cap) ? GL_TRUE : GL_FALSE;
}

// ---- Queries (section 6.1) ----

template <typename T>
void Specification::get_map(GLenum target, GLenum query, T* v) {
  const bool is_query = query == GL_COEFF || query == GL_ORDER || query == GL_DOMAIN;
  if (refused({{inside(), GL_INVALID_OPERATION},
               {!is_map_target(target), GL_INVALID_ENUM},
               {!is_query, GL_INVALID_ENUM}})) {
    return;
  }
  const Map& map = *maps_[slot(target)];
  const bool two = map.is_two_dimensional();
  std::vector<double> values;
  if (query == GL_COEFF) {
    values = map.points;
  } else if (query == GL_ORDER) {
    values = {double(map.u.order)};
    if (two) values.push_back(map.v.order);
  } else {
    values = {map.u.first, map.u.last};
    if (two) values.insert(values.end(), {map.v.first, map.v.last});
  }
  if (v == nullptr) return;
  // GetMapiv rounds colours and normals like everything else (C-GETMAPIV-NORM).
  std::ranges::transform(values, v, [](double value) { return convert<T>(value, false); });
}

void Specification::GetMapfv(GLenum target, GLenum query, GLfloat* v) { get_map(target, query, v); }
void Specification::GetMapdv(GLenum target, GLenum query, GLdouble* v) { get_map(target, query, v); }
void Specification::GetMapiv(GLenum target, GLenum query, GLint* v) { get_map(target, query, v); }

std::optional<Specification::Answer> Specification::answer(GLenum pname) const {
  using Kind = Answer::Kind;
  if (const auto flag = enabled(pname)) return Answer{Kind::kBoolean, {double(*flag)}};
  const GridDirection &grid1 = evaluators_.map1_grid_u, &grid2u = evaluators_.map2_grid_u,
                      &grid2v = evaluators_.map2_grid_v;
  const auto list = [](const auto& values) { return std::vector<double>(values.begin(), values.end()); };
  switch (pname) {
    case GL_MAX_EVAL_ORDER:
      return Answer{Kind::kInteger, {double(max_eval_order_)}};
    case GL_MAP1_GRID_DOMAIN:
      return Answer{Kind::kFloatingPoint, {grid1.first, grid1.last}};
    case GL_MAP1_GRID_SEGMENTS:
      return Answer{Kind::kInteger, {double(grid1.segments)}};
    case GL_MAP2_GRID_DOMAIN:
      return Answer{Kind::kFloatingPoint, {grid2u.first, grid2u.last, grid2v.first, grid2v.last}};
    case GL_MAP2_GRID_SEGMENTS:
      return Answer{Kind::kInteger, {double(grid2u.segments), double(grid2v.segments)}};
    case GL_CURRENT_COLOR:
      return Answer{Kind::kNormalized, list(current_.color)};
    case GL_CURRENT_NORMAL:
      return Answer{Kind::kNormalized, list(current_.normal)};
    case GL_CURRENT_TEXTURE_COORDS:  // of the active unit
      return Answer{Kind::kFloatingPoint, list(current_.texture_coordinate[active_texture_])};
    case GL_CURRENT_INDEX:
      return Answer{Kind::kFloatingPoint, {current_.index}};
    case GL_EDGE_FLAG:
      return Answer{Kind::kBoolean, {double(current_.edge_flag)}};
    case GL_ACTIVE_TEXTURE:
      return Answer{Kind::kInteger, {double(GL_TEXTURE0 + active_texture_)}};
    case GL_MAX_TEXTURE_UNITS:
    case GL_MAX_TEXTURE_COORDS:
      return Answer{Kind::kInteger, {double(kTextureUnits)}};
    case GL_RGBA_MODE:
      return Answer{Kind::kBoolean, {1}};
    case GL_INDEX_MODE:
      return Answer{Kind::kBoolean, {0}};
    default:
      return std::nullopt;
  }
}

template <typename T>
void Specification::get(GLenum pname, T* params) {
  const std::optional<Answer> found = answer(pname);
  if (refused({{inside(), GL_INVALID_OPERATION}, {!found, GL_INVALID_ENUM}}) || params == nullptr) return;
  const bool normalized = found->kind == Answer::Kind::kNormalized;
  std::ranges::transform(found->values, params, [=](double value) { return convert<T>(value, normalized); });
}

void Specification::GetBooleanv(GLenum pname, GLboolean* params) { get(pname, params); }
void Specification::GetIntegerv(GLenum pname, GLint* params) { get(pname, params); }
void Specification::GetFloatv(GLenum pname, GLfloat* params) { get(pname, params); }
void Specification::GetDoublev(GLenum pname, GLdouble* params) { get(pname, params); }

const GLubyte* Specification::GetString(GLenum name) {
  const auto text = [](const char* characters) { return reinterpret_cast<const GLubyte*>(characters); };
  const bool is_name =
      name == GL_VENDOR || name == GL_RENDERER || name == GL_VERSION || name == GL_EXTENSIONS;
  if (refused({{inside(), GL_INVALID_OPERATION}, {!is_name, GL_INVALID_ENUM}})) return nullptr;
  switch (name) {
    case GL_VENDOR:
      return text("evalcts");
    case GL_RENDERER:
      return text("executable specification");
    case GL_VERSION:
      return text("2.1 evalcts");
    default:
      return text("");
  }
}

}  // namespace evalcts::reference
