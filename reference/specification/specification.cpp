// Implements the state of the executable specification: errors, maps, primitives, current values, enables and
// queries. Section numbers are those of the GL 2.1 specification; EV-, C- and U- names are rows of the
// requirements.

#include <reference/specification.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "conversion.h"

namespace evalcts::reference {
namespace {

bool is_map_target(GLenum target) { return is_map1_target(target) || is_map2_target(target); }

bool holds_colors_or_normals(GLenum target) {
  return target == GL_MAP1_COLOR_4 || target == GL_MAP2_COLOR_4 || target == GL_MAP1_NORMAL ||
         target == GL_MAP2_NORMAL;
}

bool is_texture_target(GLenum target) {
  return (target >= GL_MAP1_TEXTURE_COORD_1 && target <= GL_MAP1_TEXTURE_COORD_4) ||
         (target >= GL_MAP2_TEXTURE_COORD_1 && target <= GL_MAP2_TEXTURE_COORD_4);
}

// Returns the least stride of a target. A stride that is too small for every target may be reported even if
// the target is invalid (EV-MAP-ERR-ANY).
int least_stride(GLenum target) { return std::max(values_per_point(target), 1); }

// A size that is sufficient for every answer.
constexpr GLsizei kAnySize = std::numeric_limits<GLsizei>::max();

// Returns the answer to a query of a map; empty if `query` does not name one.
std::vector<double> answer_of_map(const Map& map, GLenum query) {
  using Values = std::vector<double>;
  const Map::Direction &u = map.u, &v = map.v;
  const bool two = map.is_two_dimensional();
  switch (query) {
    case GL_COEFF:
      return map.points;
    case GL_ORDER:
      return two ? Values{double(u.order), double(v.order)} : Values{double(u.order)};
    case GL_DOMAIN:
      return two ? Values{u.first, u.last, v.first, v.last} : Values{u.first, u.last};
    default:
      return {};
  }
}

// The conversions to integers that the documents permit for a value.
enum class ToInteger { kRounded, kNormalized, kEither };

// Returns the permitted answers of a query of type T for a state value.
template <typename T>
std::vector<double> permitted(double value, ToInteger conversion);
template <>
std::vector<double> permitted<GLboolean>(double value, ToInteger) {
  return {static_cast<double>(to_boolean(value))};
}
template <>
std::vector<double> permitted<GLint>(double value, ToInteger conversion) {
  std::vector<double> answers;
  const auto permit = [&](const std::vector<GLint>& integers) {
    for (const GLint integer : integers)
      if (std::ranges::count(answers, integer) == 0) answers.push_back(integer);
  };
  if (conversion != ToInteger::kNormalized) permit(permitted_integers(value));
  if (conversion != ToInteger::kRounded) permit(permitted_normalized_integers(value));
  return answers;
}
template <>
std::vector<double> permitted<GLfloat>(double value, ToInteger) {
  return {to_float(value)};
}
template <>
std::vector<double> permitted<GLdouble>(double value, ToInteger) {
  return {value};
}

template <typename T>
std::vector<PermittedValue> permitted(const std::vector<double>& values, ToInteger conversion) {
  std::vector<PermittedValue> all;
  for (const double value : values) all.push_back({value, permitted<T>(value, conversion)});
  return all;
}

}  // namespace

std::size_t Specification::slot(GLenum target) {
  return is_map1_target(target) ? target - GL_MAP1_COLOR_4 : kMapKinds + target - GL_MAP2_COLOR_4;
}

Specification::Specification() : Specification(Options{}) {}

Specification::Specification(const Options& options)
    : max_eval_order_(std::clamp(options.max_eval_order, 8, kMaxOrder)),
      texture_units_(std::clamp(options.texture_units, 1, kTextureUnits)),
      active_units_(std::clamp(options.active_units, texture_units_, kTextureUnits)),
      keeps_vertices_(options.keeps_vertices) {
  for (GLenum i = 0; i < kMapKinds; ++i) {
    maps_[slot(GL_MAP1_COLOR_4 + i)] = std::make_shared<const Map>(initial_map(GL_MAP1_COLOR_4 + i));
    maps_[slot(GL_MAP2_COLOR_4 + i)] = std::make_shared<const Map>(initial_map(GL_MAP2_COLOR_4 + i));
  }
}

// ---- Errors (section 2.5) ----

bool Specification::reject_if(const Objections& objections) {
  permitted_errors_.clear();
  permitted_answer_.clear();
  for (const Objection& objection : objections) {
    if (objection.applies && std::ranges::count(permitted_errors_, objection.error) == 0) {
      permitted_errors_.push_back(objection.error);
    }
  }
  raised_errors_ = permitted_errors_.empty() ? 0 : 1;
  if (permitted_errors_.empty()) return false;
  if (error_ == GL_NO_ERROR) error_ = permitted_errors_.front();  // a recorded error stays until it is read
  return true;
}

GLenum Specification::GetError() {
  if (reject_if({{inside(), GL_INVALID_OPERATION}})) return GL_NO_ERROR;
  return std::exchange(error_, GL_NO_ERROR);
}

// ---- Flush and Finish (section 5.5) ----

void Specification::Flush() { reject_if({{inside(), GL_INVALID_OPERATION}}); }
void Specification::Finish() { reject_if({{inside(), GL_INVALID_OPERATION}}); }

// ---- Maps (section 5.1) ----

template <typename T>
void Specification::map(bool is_target, GLenum target, const MapDirection<T>& u, const MapDirection<T>& v,
                        const T* points) {
  Objections objections{{!is_target, GL_INVALID_ENUM}};  // EV-MAP1-ERR-TARGET, EV-MAP2-ERR-TARGET
  for (const MapDirection<T>& d : {u, v}) {
    // EV-MAP1-ERR-ORDER-*, EV-MAP2-ERR-UORDER, -VORDER
    objections.push_back({d.order < 1 || d.order > max_eval_order_, GL_INVALID_VALUE});
    // EV-MAP1-ERR-STRIDE, EV-MAP2-ERR-USTRIDE, -VSTRIDE
    objections.push_back({d.stride < least_stride(target), GL_INVALID_VALUE});
    // EV-MAP1-ERR-DOMAIN, EV-MAP2-ERR-UDOMAIN, -VDOMAIN
    objections.push_back({d.first == d.last, GL_INVALID_VALUE});
  }
  if (points == nullptr || std::ranges::any_of(objections, &Objection::applies))
    return define(objections, nullptr);
  Map map{target, {u.order, u.first, u.last}, {v.order, v.first, v.last}, {}};
  for (std::ptrdiff_t i = 0; i < u.order; ++i) {
    for (std::ptrdiff_t j = 0; j < v.order; ++j) {
      const T* const point = points + (i * u.stride + j * v.stride);  // EV-MAP2-ADDRESS
      map.points.insert(map.points.end(), point, point + map.components());
    }
  }
  define({}, std::make_shared<const Map>(std::move(map)));
}

void Specification::define(Objections objections, std::shared_ptr<const Map> map) {
  if (compiled(&Specification::define, objections, map)) return;
  objections.insert(objections.begin(), {inside(), GL_INVALID_OPERATION});        // EV-MAP*-ERR-BEGINEND
  objections.push_back({attributes_.active_texture != 0, GL_INVALID_OPERATION});  // EV-MAP*-ERR-ACTIVETEX
  if (reject_if(objections) || map == nullptr) return;
  maps_[slot(map->target)] = map;
}

void Specification::Map1f(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order,
                          const GLfloat* points) {
  map<GLfloat>(is_map1_target(target), target, {u1, u2, stride, order}, {0, 1, stride, 1}, points);
}

void Specification::Map1d(GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                          const GLdouble* points) {
  map<GLdouble>(is_map1_target(target), target, {u1, u2, stride, order}, {0, 1, stride, 1}, points);
}

void Specification::Map2f(GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1,
                          GLfloat v2, GLint vstride, GLint vorder, const GLfloat* points) {
  map<GLfloat>(is_map2_target(target), target, {u1, u2, ustride, uorder}, {v1, v2, vstride, vorder}, points);
}

void Specification::Map2d(GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                          GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
  map<GLdouble>(is_map2_target(target), target, {u1, u2, ustride, uorder}, {v1, v2, vstride, vorder}, points);
}

// ---- Begin and End (section 2.6) ----

void Specification::Begin(GLenum mode) {
  if (compiled(&Specification::Begin, mode)) return;
  if (reject_if({{inside(), GL_INVALID_OPERATION}, {mode > GL_POLYGON, GL_INVALID_ENUM}})) return;
  open_ = Primitive{mode, {}};
}

void Specification::End() {
  if (compiled(&Specification::End)) return;
  if (reject_if({{!inside(), GL_INVALID_OPERATION}})) return;
  completed_.push_back(*std::exchange(open_, std::nullopt));
}

std::vector<Primitive> Specification::take_primitives() { return std::exchange(completed_, {}); }

// ---- Vertices and current values (section 2.7) ----

Vertex Specification::current_vertex() const {
  Vertex vertex;
  vertex.position = {0.0f, 0.0f, 0.0f, 1.0f};
  const auto& [color, normal, texture_coordinate, index, edge_flag] = attributes_.current;
  std::ranges::copy(color, vertex.color.begin());
  vertex.normal = std::array<Component, 3>{normal[0], normal[1], normal[2]};
  std::ranges::copy(texture_coordinate[0], vertex.texture_coordinate.of_unit_0.begin());
  std::copy(texture_coordinate.begin() + 1, texture_coordinate.end(),
            vertex.texture_coordinate.of_others.begin());
  vertex.index = index;
  vertex.edge_flag = edge_flag;
  return vertex;
}

void Specification::vertex(double x, double y, double z, double w) {
  if (compiled(&Specification::vertex, x, y, z, w)) return;
  reject_if({});
  if (!inside() || !keeps_vertices_) return;
  Vertex vertex = current_vertex();
  vertex.position = {to_single(x), to_single(y), to_single(z), to_single(w)};
  open_->vertices.push_back(std::move(vertex));
}

void Specification::color(double red, double green, double blue, double alpha) {
  if (compiled(&Specification::color, red, green, blue, alpha)) return;
  reject_if({});
  attributes_.current.color = {to_single(red), to_single(green), to_single(blue), to_single(alpha)};
}

void Specification::normal(double x, double y, double z) {
  if (compiled(&Specification::normal, x, y, z)) return;
  reject_if({});
  attributes_.current.normal = {to_single(x), to_single(y), to_single(z)};
}

void Specification::texture_coordinate(GLenum texture, double s, double t, double r, double q) {
  if (compiled(&Specification::texture_coordinate, texture, s, t, r, q)) return;
  if (reject_if({{!is_unit(texture, texture_units_), GL_INVALID_ENUM}})) return;
  attributes_.current.texture_coordinate[texture - GL_TEXTURE0] = {to_single(s), to_single(t), to_single(r),
                                                                   to_single(q)};
}

void Specification::index(double c) {
  if (compiled(&Specification::index, c)) return;
  reject_if({});
  attributes_.current.index = to_single(c);
}

void Specification::EdgeFlag(GLboolean flag) {
  if (compiled(&Specification::EdgeFlag, flag)) return;
  reject_if({});
  attributes_.current.edge_flag = flag != GL_FALSE;
}

bool Specification::is_unit(GLenum texture, int units) {
  return texture >= GL_TEXTURE0 && std::cmp_less(texture - GL_TEXTURE0, units);
}

void Specification::ActiveTexture(GLenum texture) {
  if (compiled(&Specification::ActiveTexture, texture)) return;
  if (reject_if({{inside(), GL_INVALID_OPERATION}, {!is_unit(texture, active_units_), GL_INVALID_ENUM}}))
    return;
  attributes_.active_texture = static_cast<int>(texture - GL_TEXTURE0);
}

// ---- Enables (section 5.1) ----

std::optional<bool> Specification::enabled(GLenum cap) const {
  if (cap == GL_AUTO_NORMAL) return attributes_.enables.auto_normal;
  if (is_map_target(cap)) return attributes_.enables.maps[slot(cap)];
  return std::nullopt;
}

void Specification::set_enabled(GLenum cap, bool value) {
  if (compiled(&Specification::set_enabled, cap, value)) return;
  if (reject_if({{inside(), GL_INVALID_OPERATION}, {!enabled(cap), GL_INVALID_ENUM}})) return;
  (cap == GL_AUTO_NORMAL ? attributes_.enables.auto_normal : attributes_.enables.maps[slot(cap)]) = value;
}

void Specification::Enable(GLenum cap) { set_enabled(cap, true); }
void Specification::Disable(GLenum cap) { set_enabled(cap, false); }

GLboolean Specification::IsEnabled(GLenum cap) {
  if (reject_if({{inside(), GL_INVALID_OPERATION}, {!enabled(cap), GL_INVALID_ENUM}})) return GL_FALSE;
  return *enabled(cap) ? GL_TRUE : GL_FALSE;
}

// ---- Queries (section 6.1) ----

template <typename T>
void Specification::get_map(GLenum target, GLenum query, GLsizei size, T* v) {
  const std::vector<double> values =
      is_map_target(target) ? answer_of_map(*maps_[slot(target)], query) : std::vector<double>{};
  if (reject_if({{inside(), GL_INVALID_OPERATION},
                 {values.empty(), GL_INVALID_ENUM},  // unknown target or query
                 {size < 0, GL_INVALID_VALUE},       // EV-GETN-NEGATIVE
                 {std::cmp_less(size, values.size() * sizeof(T)), GL_INVALID_OPERATION}}) ||  // EV-GETN-SMALL
      v == nullptr) {
    return;
  }
  // Documents disagree whether GetMapiv rounds colours and normals or maps [-1,1] to the whole range of
  // integers (C-GETMAPIV-NORM).
  const bool may_be_normalized = query == GL_COEFF && holds_colors_or_normals(target);
  std::vector<PermittedValue> answer =
      permitted<T>(values, may_be_normalized ? ToInteger::kEither : ToInteger::kRounded);
  for (PermittedValue& value : answer) {
    const bool is_ambiguous = may_be_normalized && std::is_same_v<T, GLint> && std::abs(value.state) > 1;
    value.is_advisory = is_ambiguous || (query == GL_DOMAIN && maps_[slot(target)]->is_initial);
    if (query == GL_COEFF && maps_[slot(target)]->is_initial && is_texture_target(target)) value.since = 11;
  }
  write(std::move(answer), v);
}

template <typename T>
void Specification::write(std::vector<PermittedValue> values, T* params) {
  std::ranges::transform(values, params,
                         [](const PermittedValue& value) { return static_cast<T>(value.answers.front()); });
  permitted_answer_ = std::move(values);
}

void Specification::GetMapfv(GLenum target, GLenum query, GLfloat* v) { get_map(target, query, kAnySize, v); }
void Specification::GetMapdv(GLenum target, GLenum query, GLdouble* v) {
  get_map(target, query, kAnySize, v);
}
void Specification::GetMapiv(GLenum target, GLenum query, GLint* v) { get_map(target, query, kAnySize, v); }
void Specification::GetnMapfv(GLenum target, GLenum query, GLsizei size, GLfloat* v) {
  get_map(target, query, size, v);
}
void Specification::GetnMapdv(GLenum target, GLenum query, GLsizei size, GLdouble* v) {
  get_map(target, query, size, v);
}
void Specification::GetnMapiv(GLenum target, GLenum query, GLsizei size, GLint* v) {
  get_map(target, query, size, v);
}

std::optional<Specification::Answer> Specification::answer(GLenum pname) const {
  using Kind = Answer::Kind;
  if (const auto flag = enabled(pname)) return Answer{Kind::kBoolean, {double(*flag)}};
  const GridDirection &grid1 = attributes_.grids.map1_u, &grid2u = attributes_.grids.map2_u,
                      &grid2v = attributes_.grids.map2_v;
  const auto list = [](const auto& values) { return std::vector<double>(values.begin(), values.end()); };
  switch (pname) {
    case GL_MAX_EVAL_ORDER:
      return Answer{Kind::kInteger, {double(max_eval_order_)}, true};
    case GL_MAP1_GRID_DOMAIN:
      return Answer{Kind::kFloatingPoint, {grid1.first, grid1.last}};
    case GL_MAP1_GRID_SEGMENTS:
      return Answer{Kind::kInteger, {double(grid1.segments)}};
    case GL_MAP2_GRID_DOMAIN:
      return Answer{Kind::kFloatingPoint, {grid2u.first, grid2u.last, grid2v.first, grid2v.last}};
    case GL_MAP2_GRID_SEGMENTS:
      return Answer{Kind::kInteger, {double(grid2u.segments), double(grid2v.segments)}};
    case GL_CURRENT_COLOR:
      return Answer{Kind::kNormalized, list(attributes_.current.color)};
    case GL_CURRENT_NORMAL:
      return Answer{Kind::kNormalized, list(attributes_.current.normal)};
    case GL_CURRENT_TEXTURE_COORDS:  // coordinates of the active unit
      return Answer{Kind::kFloatingPoint,
                    list(attributes_.current.texture_coordinate[attributes_.active_texture])};
    case GL_CURRENT_INDEX:
      return Answer{Kind::kFloatingPoint, {attributes_.current.index}};
    case GL_EDGE_FLAG:
      return Answer{Kind::kBoolean, {double(attributes_.current.edge_flag)}};
    case GL_ACTIVE_TEXTURE:
      return Answer{Kind::kInteger, {double(GL_TEXTURE0 + attributes_.active_texture)}};
    case GL_MAX_TEXTURE_UNITS:
    case GL_MAX_TEXTURE_COORDS:
      return Answer{Kind::kInteger, {double(texture_units_)}, true};
    case GL_LIST_BASE:
      return Answer{Kind::kInteger, {double(attributes_.list_base)}};
    case GL_LIST_INDEX:
      return Answer{Kind::kInteger, {construction_ ? double(construction_->name) : 0}};
    case GL_LIST_MODE:
      return Answer{Kind::kInteger, {construction_ ? double(construction_->mode) : 0}};
    case GL_MAX_LIST_NESTING:
      return Answer{Kind::kInteger, {double(kMaxListNesting)}, true};
    case GL_ATTRIB_STACK_DEPTH:
      return Answer{Kind::kInteger, {double(attribute_stack_.size())}};
    case GL_MAX_ATTRIB_STACK_DEPTH:
      return Answer{Kind::kInteger, {double(kMaxAttribStackDepth)}, true};
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
  if (reject_if({{inside(), GL_INVALID_OPERATION}, {!found, GL_INVALID_ENUM}}) || params == nullptr) return;
  std::vector<PermittedValue> values = permitted<T>(
      found->values, found->kind == Answer::Kind::kNormalized ? ToInteger::kNormalized : ToInteger::kRounded);
  for (PermittedValue& value : values) {
    value.is_exact = found->kind == Answer::Kind::kFloatingPoint && to_single(value.state) == value.state;
    value.is_least = found->is_limit && !std::is_same_v<T, GLboolean>;
  }
  write(std::move(values), params);
}

void Specification::GetBooleanv(GLenum pname, GLboolean* params) { get(pname, params); }
void Specification::GetIntegerv(GLenum pname, GLint* params) { get(pname, params); }
void Specification::GetFloatv(GLenum pname, GLfloat* params) { get(pname, params); }
void Specification::GetDoublev(GLenum pname, GLdouble* params) { get(pname, params); }

const GLubyte* Specification::GetString(GLenum name) {
  const auto text = [](const char* characters) { return reinterpret_cast<const GLubyte*>(characters); };
  const bool is_name =
      name == GL_VENDOR || name == GL_RENDERER || name == GL_VERSION || name == GL_EXTENSIONS;
  if (reject_if({{inside(), GL_INVALID_OPERATION}, {!is_name, GL_INVALID_ENUM}})) return nullptr;
  switch (name) {
    case GL_VENDOR:
      return text("evalcts");
    case GL_RENDERER:
      return text("executable specification");
    case GL_VERSION:
      return text("2.1 evalcts");
    default:
      return text("GL_ARB_robustness");  // for GetnMap
  }
}

}  // namespace evalcts::reference
