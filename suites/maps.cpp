#include "maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace evalcts {
namespace {

std::size_t first_value(const Map2& map, int i, int j) {
  return static_cast<std::size_t>(map.ustride * i + map.vstride * j);
}

gl::Ref define_with(gl::Case& c, const Map1& map, bool doubles, const gl::Input& points) {
  if (doubles) return c.Map1d(map.target, map.u1, map.u2, map.stride, map.order, points);
  return c.Map1f(map.target, map.u1, map.u2, map.stride, map.order, points);
}

gl::Ref define_with(gl::Case& c, const Map2& map, bool doubles, const gl::Input& points) {
  if (doubles)
    return c.Map2d(map.target, map.u1, map.u2, map.ustride, map.uorder, map.v1, map.v2, map.vstride,
                   map.vorder, points);
  return c.Map2f(map.target, map.u1, map.u2, map.ustride, map.uorder, map.v1, map.v2, map.vstride, map.vorder,
                 points);
}

template <class Map>
gl::Input points_of(const Map& map, bool doubles, gl::AfterCall after = gl::AfterCall::keep) {
  return doubles ? gl::array(map.points, after) : gl::array(converted<float>(map.points), after);
}

template <class Map>
gl::Ref define_with_slot(gl::Case& c, const Map& map, bool doubles, int slot) {
  gl::Input points = points_of(map, doubles);
  points.slot = slot;
  return define_with(c, map, doubles, points);
}

double random_between(Test& t, const Interval& interval) {
  const double value = std::abs(random_values(t.random(), 1).front());
  return static_cast<float>(interval.first + (interval.last - interval.first) * value);
}

}  // namespace

std::vector<TargetForm> make_target_forms(std::span<const GLenum> targets) {
  std::vector<TargetForm> all;
  for (const GLenum target : targets)
    for (const Form& form : kForms) all.push_back({label(target) + "_" + form.name, target, form.doubles});
  return all;
}

std::vector<GLenum> without_index(std::span<const GLenum> targets) {
  std::vector<GLenum> others(targets.begin(), targets.end());
  std::erase(others, static_cast<GLenum>(GL_MAP1_INDEX));
  std::erase(others, static_cast<GLenum>(GL_MAP2_INDEX));
  return others;
}

std::vector<double> Map1::coefficients() const {
  std::vector<double> packed;
  for (int i = 0; i < order; ++i)
    for (int c = 0; c < components(); ++c) packed.push_back(points[static_cast<std::size_t>(i * stride + c)]);
  return packed;
}

Map1 make_map1(GLenum target, double u1, double u2, int stride, const std::vector<double>& coefficients) {
  Map1 map{target, u1, u2, stride, 0, {}};
  const std::size_t k = static_cast<std::size_t>(map.components());
  map.order = static_cast<int>(coefficients.size() / k);
  map.points.assign(static_cast<std::size_t>(map.order * stride), kPoison);
  for (std::size_t i = 0; i < coefficients.size(); ++i)
    map.points[i / k * static_cast<std::size_t>(stride) + i % k] = coefficients[i];
  return map;
}

Map1 make_map1(GLenum target, const std::vector<double>& coefficients) {
  return make_map1(target, 0, 1, gl::components_of(target), coefficients);
}

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

std::vector<double> random_values(std::mt19937& random, std::size_t count) {
  // 24 random bits and a sign, written out because the standard's distributions differ between libraries.
  std::vector<double> values(count);
  for (double& value : values) {
    const std::uint32_t bits = random();
    value = static_cast<double>(static_cast<std::int32_t>(bits >> 7) - (1 << 24)) * 0x1p-24;
  }
  return values;
}

Map1 random_map(Test& t, GLenum target, int order) {
  return random_map(t, target, order, gl::components_of(target));
}

Map1 random_map(Test& t, GLenum target, int order, int stride) {
  const auto count = static_cast<std::size_t>(order * gl::components_of(target));
  return make_map1(target, 0, 1, stride, random_values(t.random(), count));
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

std::vector<int> orders_too_high(const Test& t) {
  constexpr int kBeyond = 0x10001;
  const int limit = t.order_limit();
  if (limit >= kBeyond)
    throw NotObservable(fmt::format("MAX_EVAL_ORDER is {}: no order above it can be tried", limit));
  std::vector<int> orders;
  for (const int order : {limit + 1, limit + 2, limit + 100, 0x101, kBeyond})
    if (order > limit) orders.push_back(order);
  return orders;
}

std::string label(GLenum token) { return gl::token_name(token).substr(3); }

const std::vector<TargetForm>& target_forms() {
  static const std::vector<TargetForm> all = make_target_forms(gl::kMap1Targets);
  return all;
}

const std::vector<TargetForm>& visible_target_forms() {
  static const std::vector<TargetForm> all = make_target_forms(visible_targets());
  return all;
}

const std::vector<GLenum>& visible_targets() {
  static const std::vector<GLenum> all = without_index(gl::kMap1Targets);
  return all;
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

gl::Ref define(gl::Case& c, const Map1& map, bool doubles, gl::AfterCall after) {
  return define_with(c, map, doubles, points_of(map, doubles, after));
}

gl::Ref define(gl::Case& c, const Map2& map, bool doubles, gl::AfterCall after) {
  return define_with(c, map, doubles, points_of(map, doubles, after));
}

gl::Ref define_in_slot(gl::Case& c, const Map1& map, bool doubles, int slot) {
  return define_with_slot(c, map, doubles, slot);
}

gl::Ref define_in_slot(gl::Case& c, const Map2& map, bool doubles, int slot) {
  return define_with_slot(c, map, doubles, slot);
}

gl::Ref evaluate(gl::Case& c, double u, bool doubles) {
  return doubles ? c.EvalCoord1d(u) : c.EvalCoord1f(u);
}

gl::Ref evaluate_vector(gl::Case& c, double u, bool doubles) {
  if (doubles) return c.EvalCoord1dv(std::vector<double>{u});
  return c.EvalCoord1fv(std::vector<float>{static_cast<float>(u)});
}

gl::Ref evaluate2(gl::Case& c, double u, double v, bool doubles) {
  return doubles ? c.EvalCoord2d(u, v) : c.EvalCoord2f(u, v);
}

gl::Ref evaluate2_vector(gl::Case& c, double u, double v, bool doubles) {
  if (doubles) return c.EvalCoord2dv(std::vector<double>{u, v});
  return c.EvalCoord2fv(converted<float>({u, v}));
}

void enable_visibly(gl::Case& c, GLenum target) {
  if (attribute_of(target) != kPosition) {
    const std::vector<GLfloat> point = {0.25f, 0.5f, 0.75f};
    const bool two = is_two_dimensional(target);
    if (two) {
      c.Map2f(GL_MAP2_VERTEX_3, 0, 1, 3, 1, 0, 1, 3, 1, point);
    } else {
      c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 1, point);
    }
    c.Enable(two ? GL_MAP2_VERTEX_3 : GL_MAP1_VERTEX_3);
  }
  c.Enable(target);
}

Map1 over(Map1 map, const Interval& u) {
  map.u1 = u.first, map.u2 = u.last;
  return map;
}

Map2 over(Map2 map, const Interval& u, const Interval& v) {
  map.u1 = u.first, map.u2 = u.last, map.v1 = v.first, map.v2 = v.last;
  return map;
}

std::vector<double> arguments(Test& t, const Interval& domain, int count) {
  const auto u1 = static_cast<float>(domain.first), u2 = static_cast<float>(domain.last);
  std::vector<double> us = {u1, u2, std::nextafter(u1, u2), std::nextafter(u2, u1), (u1 + u2) / 2};
  for (const double value : random_values(t.random(), static_cast<std::size_t>(std::max(0, count - 5))))
    us.push_back(static_cast<float>(u1 + (u2 - u1) * std::abs(value)));
  return us;
}

std::vector<At> arguments(Test& t, const Interval& u, const Interval& v, int count) {
  std::vector<At> all;
  for (int i = 0; i < count; ++i) {
    At at = {random_between(t, u), random_between(t, v)};
    if (i % 5 == 1) at.u = i % 2 ? u.last : u.first;
    if (i % 5 == 3) at.v = i % 2 ? v.first : v.last;
    if (i % 5 == 4) at = {i % 4 ? u.first : u.last, i % 3 ? v.last : v.first};
    all.push_back(at);
  }
  return all;
}

void evaluate_all(gl::Case& c, const std::vector<double>& arguments) {
  c.Begin(GL_POINTS);
  for (const double u : arguments) evaluate(c, u);
  c.End();
}

void evaluate_all(gl::Case& c, const std::vector<At>& arguments) {
  c.Begin(GL_POINTS);
  for (const auto& [u, v] : arguments) evaluate2(c, u, v);
  c.End();
}

bool is_two_dimensional(GLenum target) {
  return std::ranges::find(gl::kMap2Targets, target) != gl::kMap2Targets.end();
}

std::vector<gl::Ref> query_everything(gl::Case& c, int max_order) {
  std::vector<gl::Ref> refs;
  const auto query_maps = [&](std::span<const GLenum> targets) {
    for (const GLenum target : targets) {
      refs.push_back(c.IsEnabled(target));
      const MapQuery query = query_map(c, target, max_order, true);
      refs.insert(refs.end(), {query.order, query.domain, query.coefficients});
    }
  };
  query_maps(gl::kMap1Targets);
  refs.push_back(c.IsEnabled(GL_AUTO_NORMAL));
  refs.push_back(c.GetDoublev(GL_MAP1_GRID_DOMAIN, gl::out<GLdouble>(2)));
  refs.push_back(c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1)));
  refs.push_back(c.GetDoublev(GL_MAP2_GRID_DOMAIN, gl::out<GLdouble>(4)));
  refs.push_back(c.GetIntegerv(GL_MAP2_GRID_SEGMENTS, gl::out<GLint>(2)));
  refs.push_back(c.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4)));
  refs.push_back(c.GetFloatv(GL_CURRENT_NORMAL, gl::out<GLfloat>(3)));
  refs.push_back(c.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4)));
  query_maps(gl::kMap2Targets);
  return refs;
}

void expect_unchanged(Played& played, const std::vector<gl::Ref>& before, const std::vector<gl::Ref>& after) {
  for (std::size_t i = 0; i < before.size(); ++i) played.expect_same(before[i], after[i]);
}

MapQuery query_map(gl::Case& c, GLenum target, int max_order, bool doubles) {
  const bool two = is_two_dimensional(target);
  const std::size_t directions = two ? 2 : 1;
  const auto room =
      static_cast<std::size_t>((two ? max_order * max_order : max_order) * gl::components_of(target));
  MapQuery query;
  query.order = c.GetMapiv(target, GL_ORDER, gl::out<GLint>(directions));
  if (doubles) {
    query.domain = c.GetMapdv(target, GL_DOMAIN, gl::out<GLdouble>(2 * directions));
    query.coefficients = c.GetMapdv(target, GL_COEFF, gl::out<GLdouble>(room));
  } else {
    query.domain = c.GetMapfv(target, GL_DOMAIN, gl::out<GLfloat>(2 * directions));
    query.coefficients = c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(room));
  }
  return query;
}

void expect_answers(Played& played, const MapQuery& query, const std::vector<GLint>& orders,
                    const std::vector<double>& domain, const std::vector<double>& coefficients,
                    bool doubles) {
  // Queries promise single precision, to one part in 10^5 (EV-GETMAP-FLOAT, EV-GETMAP-DOUBLE).
  constexpr double kRelative = 1e-5;
  played.expect_values(query.order, orders);
  if (doubles) {
    played.expect_values_near(query.domain, domain, kRelative);
    played.expect_values_near(query.coefficients, coefficients, kRelative);
  } else {
    played.expect_values_near(query.domain, converted<float>(domain), kRelative);
    played.expect_values_near(query.coefficients, converted<float>(coefficients), kRelative);
  }
}

}  // namespace evalcts
