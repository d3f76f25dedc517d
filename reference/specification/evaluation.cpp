// Evaluation, grids and meshes (GL 2.1 section 5.1); EV-, C- and U- names are rows of the requirements.

#include <reference/specification.h>

#include <algorithm>
#include <utility>

namespace evalcts::reference {
namespace {

// Replaces the first components of an attribute by those of the evaluated map.
template <std::size_t kSize>
void evaluate_into(std::array<Component, kSize>& attribute, const std::shared_ptr<const Map>& map,
                   const Argument& u, const std::optional<Argument>& v) {
  const auto evaluated = std::make_shared<const EvaluatedMap>(EvaluatedMap{map, u, v});
  for (int c = 0; c < map->components(); ++c) attribute[c] = Sample(evaluated, c);
}

}  // namespace

std::shared_ptr<const Map> Specification::effective_map(int dimension,
                                                        std::initializer_list<GLenum> targets) const {
  for (const GLenum target : targets) {
    const std::size_t place = slot(target) + (dimension == 2 ? kMapKinds : 0);
    if (attributes_.enables.maps[place]) return maps_[place];
  }
  return nullptr;
}

void Specification::eval_coord(const Argument& u, const std::optional<Argument>& v) {
  reject_if({});  // no argument is an error (EV-COORD-NOERR)
  const int dimension = v ? 2 : 1;
  // Without a vertex map nothing happens (EV-COORD-NOVERTEX). VERTEX_4 goes before VERTEX_3 (EV-PREC-VERTEX).
  const auto position = effective_map(dimension, {GL_MAP1_VERTEX_4, GL_MAP1_VERTEX_3});
  if (!position || !inside() || !keeps_vertices_) return;

  // The effect is that of the command that corresponds to each map, the vertex last, on a copy of the current
  // values that is used for this vertex only (EV-COORD-ASIF, EV-CUR-*). The initial position is (0,0,0,1), so
  // VERTEX_3 leaves w at 1.
  Vertex vertex = current_vertex();
  if (const auto color = effective_map(dimension, {GL_MAP1_COLOR_4})) {
    evaluate_into(vertex.color, color, u, v);
  }
  if (const auto index = effective_map(dimension, {GL_MAP1_INDEX})) vertex.index = Sample(index, 0, u, v);
  if (attributes_.enables.auto_normal && v) {  // before a NORMAL map, of the surface drawn (EV-AUTON-*)
    vertex.normal = AutomaticNormal{position, u, *v};
  } else if (const auto normal = effective_map(dimension, {GL_MAP1_NORMAL})) {
    evaluate_into(std::get<0>(vertex.normal), normal, u, v);
  }
  // The map with the most coordinates has precedence (EV-PREC-TEX), for unit 0 only (EV-ATTR-UNIT0). Missing
  // coordinates have the values that TexCoord sets.
  if (const auto texture = effective_map(dimension, {GL_MAP1_TEXTURE_COORD_4, GL_MAP1_TEXTURE_COORD_3,
                                                     GL_MAP1_TEXTURE_COORD_2, GL_MAP1_TEXTURE_COORD_1})) {
    vertex.texture_coordinate.of_unit_0 = {0.0f, 0.0f, 0.0f, 1.0f};
    evaluate_into(vertex.texture_coordinate.of_unit_0, texture, u, v);
  }
  evaluate_into(vertex.position, position, u, v);
  open_->vertices.push_back(std::move(vertex));
}

void Specification::EvalCoord1d(GLdouble u) {
  if (compiled(&Specification::EvalCoord1d, u)) return;
  eval_coord(Argument::coordinate(u), std::nullopt);
}
void Specification::EvalCoord1f(GLfloat u) { EvalCoord1d(u); }
void Specification::EvalCoord1fv(const GLfloat* u) {
  if (u != nullptr) EvalCoord1f(u[0]);
}
void Specification::EvalCoord1dv(const GLdouble* u) {
  if (u != nullptr) EvalCoord1d(u[0]);
}

void Specification::EvalCoord2d(GLdouble u, GLdouble v) {
  if (compiled(&Specification::EvalCoord2d, u, v)) return;
  eval_coord(Argument::coordinate(u), Argument::coordinate(v));
}
void Specification::EvalCoord2f(GLfloat u, GLfloat v) { EvalCoord2d(u, v); }
void Specification::EvalCoord2fv(const GLfloat* u) {
  if (u != nullptr) EvalCoord2f(u[0], u[1]);
}
void Specification::EvalCoord2dv(const GLdouble* u) {
  if (u != nullptr) EvalCoord2d(u[0], u[1]);
}

// ---- Grids ----

void Specification::map_grid(std::initializer_list<std::pair<GridDirection*, GridDirection>> directions) {
  const bool bad = std::ranges::any_of(directions, [](const auto& d) { return d.second.segments <= 0; });
  // EV-GRID-ERR-*. Equal ends are legal (EV-GRID-EQUAL), and so is any texture unit (EV-GRID-NOUNIT).
  if (reject_if({{inside(), GL_INVALID_OPERATION}, {bad, GL_INVALID_VALUE}})) return;
  for (const auto& [state, value] : directions) *state = value;
}

void Specification::MapGrid1d(GLint un, GLdouble u1, GLdouble u2) {
  if (compiled(&Specification::MapGrid1d, un, u1, u2)) return;
  map_grid({{&attributes_.grids.map1_u, {un, u1, u2}}});
}
void Specification::MapGrid1f(GLint un, GLfloat u1, GLfloat u2) { MapGrid1d(un, u1, u2); }
void Specification::MapGrid2d(GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2) {
  if (compiled(&Specification::MapGrid2d, un, u1, u2, vn, v1, v2)) return;
  map_grid({{&attributes_.grids.map2_u, {un, u1, u2}}, {&attributes_.grids.map2_v, {vn, v1, v2}}});
}
void Specification::MapGrid2f(GLint un, GLfloat u1, GLfloat u2, GLint vn, GLfloat v1, GLfloat v2) {
  MapGrid2d(un, u1, u2, vn, v1, v2);
}

Argument Specification::GridDirection::at(std::int64_t i) const {
  return Argument::grid(i, segments, first, last);
}

void Specification::eval_point(std::int64_t i) { eval_coord(attributes_.grids.map1_u.at(i), std::nullopt); }
void Specification::eval_point(std::int64_t i, std::int64_t j) {
  eval_coord(attributes_.grids.map2_u.at(i), attributes_.grids.map2_v.at(j));
}
void Specification::EvalPoint1(GLint i) {
  if (compiled(&Specification::EvalPoint1, i)) return;
  eval_point(i);
}
void Specification::EvalPoint2(GLint i, GLint j) {
  if (compiled(&Specification::EvalPoint2, i, j)) return;
  eval_point(i, j);
}

// ---- Meshes: the equivalent commands of the text ----

template <typename Vertices>
void Specification::draw(GLenum mode, std::size_t mesh, Vertices vertices) {
  open_ = Primitive{mode, {}, mesh};
  vertices();
  completed_.push_back(*std::exchange(open_, std::nullopt));
}

void Specification::EvalMesh1(GLenum mode, GLint p1, GLint p2) {
  if (compiled(&Specification::EvalMesh1, mode, p1, p2)) return;
  const bool is_mode = mode == GL_POINT || mode == GL_LINE;
  if (reject_if({{inside(), GL_INVALID_OPERATION}, {!is_mode, GL_INVALID_ENUM}})) return;
  const std::int64_t i1 = p1, i2 = p2;
  draw(mode == GL_POINT ? GL_POINTS : GL_LINE_STRIP, 0, [&] {  // C-MESH1-LINES
    for (std::int64_t i = i1; i <= i2; ++i) eval_point(i);
  });
}

void Specification::EvalMesh2(GLenum mode, GLint p1, GLint p2, GLint q1, GLint q2) {
  if (compiled(&Specification::EvalMesh2, mode, p1, p2, q1, q2)) return;
  const bool is_mode = mode == GL_POINT || mode == GL_LINE || mode == GL_FILL;
  if (reject_if({{inside(), GL_INVALID_OPERATION}, {!is_mode, GL_INVALID_ENUM}})) return;
  ++meshes_;
  const std::int64_t i1 = p1, i2 = p2, j1 = q1, j2 = q2;
  switch (mode) {
    case GL_POINT:
      draw(GL_POINTS, meshes_, [&] {
        for (std::int64_t j = j1; j <= j2; ++j)
          for (std::int64_t i = i1; i <= i2; ++i) eval_point(i, j);
      });
      break;
    case GL_LINE:
      for (std::int64_t j = j1; j <= j2; ++j)
        draw(GL_LINE_STRIP, meshes_, [&] {
          for (std::int64_t i = i1; i <= i2; ++i) eval_point(i, j);
        });
      for (std::int64_t i = i1; i <= i2; ++i)
        draw(GL_LINE_STRIP, meshes_, [&] {
          for (std::int64_t j = j1; j <= j2; ++j) eval_point(i, j);  // C-MESH2-LOOP
        });
      break;
    case GL_FILL:
      for (std::int64_t j = j1; j < j2; ++j)
        draw(GL_QUAD_STRIP, meshes_, [&] {
          for (std::int64_t i = i1; i <= i2; ++i) {
            eval_point(i, j);
            eval_point(i, j + 1);
          }
        });
      break;
  }
}

}  // namespace evalcts::reference
