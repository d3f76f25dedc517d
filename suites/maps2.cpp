#include "maps2.h"

#include <algorithm>

namespace evalcts {
namespace {

std::size_t first_value(const Map2& map, int i, int j) {
  return static_cast<std::size_t>(map.ustride * i + map.vstride * j);
}

gl::Ref define(gl::Case& c, const Map2& map, bool doubles, const gl::Input& points) {
  if (doubles)
    return c.Map2d(map.target, map.u1, map.u2, map.ustride, map.uorder, map.v1, map.v2, map.vstride,
                   map.vorder, points);
  return c.Map2f(map.target, map.u1, map.u2, map.ustride, map.uorder, map.v1, map.v2, map.vstride, map.vorder,
                 points);
}

gl::Input points_of(const Map2& map, bool doubles, gl::AfterCall after = gl::AfterCall::keep) {
  return doubles ? gl::array(map.points, after) : gl::array(converted<float>(map.points), after);
}

}  // namespace

std::vector<double> Map2::coefficients() const {
  std::vector<double> packed;
  for (int i = 0; i < uorder; ++i)
    for (int j = 0; j < vorder; ++j) {
      const auto point = points.begin() + static_cast<std::ptrdiff_t>(first_value(*this, i, j));
      packed.insert(packed.end(), point, point + components());
    }
  return packed;
}

Map2 make_map2(GLenum target, int uorder, int vorder, int ustride, int vstride,
               const std::vector<double>& coefficients) {
  Map2 map{target, 0, 1, 0, 1, ustride, vstride, uorder, vorder, {}};
  const std::size_t last_block = static_cast<std::size_t>(std::min(ustride, vstride));
  map.points.assign(first_value(map, uorder - 1, vorder - 1) + last_block, kPoison);
  auto next = coefficients.begin();
  for (int i = 0; i < uorder; ++i)
    for (int j = 0; j < vorder; ++j) {
      std::copy_n(next, map.components(),
                  map.points.begin() + static_cast<std::ptrdiff_t>(first_value(map, i, j)));
      next += map.components();
    }
  return map;
}

Map2 make_map2(GLenum target, int uorder, int vorder, const std::vector<double>& coefficients) {
  const int k = gl::components_of(target);
  return make_map2(target, uorder, vorder, k * vorder, k, coefficients);
}

Map2 random_map2(Test& t, GLenum target, int uorder, int vorder) {
  return random_map2(t, target, uorder, vorder, kLayouts[0]);
}

Map2 random_map2(Test& t, GLenum target, int uorder, int vorder, int ustride, int vstride) {
  const auto count = static_cast<std::size_t>(uorder * vorder * gl::components_of(target));
  return make_map2(target, uorder, vorder, ustride, vstride, random_values(t.random(), count));
}

Map2 random_map2(Test& t, GLenum target, int uorder, int vorder, const Layout& layout) {
  const int k = gl::components_of(target);
  return random_map2(t, target, uorder, vorder, layout.ustride(k, uorder, vorder),
                     layout.vstride(k, uorder, vorder));
}

const std::vector<TargetForm>& target_forms2() {
  static const std::vector<TargetForm> all = make_target_forms(gl::kMap2Targets);
  return all;
}

const std::vector<TargetForm>& visible_target_forms2() {
  static const std::vector<TargetForm> all = make_target_forms(visible_targets2());
  return all;
}

const std::vector<GLenum>& visible_targets2() {
  static const std::vector<GLenum> all = without_index(gl::kMap2Targets);
  return all;
}

gl::Ref define(gl::Case& c, const Map2& map, bool doubles, gl::AfterCall after) {
  return define(c, map, doubles, points_of(map, doubles, after));
}

gl::Ref define_in_slot(gl::Case& c, const Map2& map, bool doubles, int slot) {
  gl::Input points = points_of(map, doubles);
  points.slot = slot;
  return define(c, map, doubles, points);
}

gl::Ref evaluate2(gl::Case& c, double u, double v, bool doubles) {
  return doubles ? c.EvalCoord2d(u, v) : c.EvalCoord2f(u, v);
}

gl::Ref evaluate2_vector(gl::Case& c, double u, double v, bool doubles) {
  if (doubles) return c.EvalCoord2dv(std::vector<double>{u, v});
  return c.EvalCoord2fv(converted<float>({u, v}));
}

MapQuery query_map2(gl::Case& c, GLenum target, int max_order, bool doubles) {
  const auto room = static_cast<std::size_t>(max_order * max_order * gl::components_of(target));
  MapQuery query;
  query.order = c.GetMapiv(target, GL_ORDER, gl::out<GLint>(2));
  if (doubles) {
    query.domain = c.GetMapdv(target, GL_DOMAIN, gl::out<GLdouble>(4));
    query.coefficients = c.GetMapdv(target, GL_COEFF, gl::out<GLdouble>(room));
  } else {
    query.domain = c.GetMapfv(target, GL_DOMAIN, gl::out<GLfloat>(4));
    query.coefficients = c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(room));
  }
  return query;
}

void expect_map2(Played& played, const MapQuery& query, const Map2& map, bool doubles) {
  expect_answers(played, query, {map.uorder, map.vorder}, {map.u1, map.u2, map.v1, map.v2},
                 map.coefficients(), doubles);
}

}  // namespace evalcts
