// Makes maps with given or random points, in several memory layouts, and defines and queries them.
#include "maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace evalcts {
namespace {

std::size_t first_value(const Map& map, int i, int j) {
  return static_cast<std::size_t>(map.ustride * i + map.vstride * j);
}

gl::Ref define_with(gl::Case& c, const Map& m, bool doubles, const gl::Input& points) {
  if (!m.two && doubles) return c.Map1d(m.target, m.u1, m.u2, m.ustride, m.uorder, points);
  if (!m.two) return c.Map1f(m.target, m.u1, m.u2, m.ustride, m.uorder, points);
  if (doubles)
    return c.Map2d(m.target, m.u1, m.u2, m.ustride, m.uorder, m.v1, m.v2, m.vstride, m.vorder, points);
  return c.Map2f(m.target, m.u1, m.u2, m.ustride, m.uorder, m.v1, m.v2, m.vstride, m.vorder, points);
}

gl::Input points_of(const Map& map, bool doubles, gl::AfterCall after = gl::AfterCall::kKeep) {
  return doubles ? gl::array(map.points, after) : gl::array(converted<float>(map.points), after);
}

double random_between(Test& t, const Interval& interval) {
  const double value = std::abs(random_values(t.random(), 1).front());
  return static_cast<float>(interval.first + (interval.last - interval.first) * value);
}

}  // namespace

std::optional<gl::EntryPoint> missing_command(Test& t, const gl::Case& commands) {
  std::optional<gl::EntryPoint> missing;
  for (const gl::Command& command : commands.commands())
    if (!t.can_call(command.entry)) missing = command.entry;
  return missing;
}

std::vector<Form> existing_forms(Test& t, std::initializer_list<bool> dimensions) {
  return existing(t, kForms, [&](gl::Case& c, const Form& form) {
    for (const bool two : dimensions)
      define(c, two ? make_map2(GL_MAP2_INDEX, 1, 1, {1}) : make_map1(GL_MAP1_INDEX, {1}), form.doubles);
  });
}

std::vector<TargetForm> existing_target_forms(Test& t, bool two) {
  const std::vector<Form> forms = existing_forms(t, {two});
  std::vector<TargetForm> all = target_forms(two);
  std::erase_if(all, [&](const TargetForm& each) {
    return std::ranges::none_of(forms, [&](const Form& form) { return form.doubles == each.doubles; });
  });
  return all;
}

std::vector<Getter> existing_getters(Test& t) {
  return existing(t, kGetters,
                  [](gl::Case& c, const Getter& getter) { getter.get(c, GL_MAP1_VERTEX_3, GL_ORDER, 1); });
}

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

std::vector<double> Map::coefficients() const {
  std::vector<double> packed;
  for (int i = 0; i < uorder; ++i)
    for (int j = 0; j < vorder; ++j) {
      const auto point = points.begin() + static_cast<std::ptrdiff_t>(first_value(*this, i, j));
      packed.insert(packed.end(), point, point + components());
    }
  return packed;
}

std::vector<GLint> Map::orders() const {
  return two ? std::vector<GLint>{uorder, vorder} : std::vector<GLint>{uorder};
}

std::vector<double> Map::domain() const {
  return two ? std::vector<double>{u1, u2, v1, v2} : std::vector<double>{u1, u2};
}

Map make_map1(GLenum target, double u1, double u2, int stride, const std::vector<double>& coefficients) {
  const auto k = static_cast<std::size_t>(gl::components_of(target));
  const auto order = static_cast<int>(coefficients.size() / k);
  return over(make_map2(target, order, 1, stride, stride, coefficients), {u1, u2});
}

Map make_map1(GLenum target, const std::vector<double>& coefficients) {
  return make_map1(target, 0, 1, gl::components_of(target), coefficients);
}

Map make_map2(GLenum target, int uorder, int vorder, int ustride, int vstride,
              const std::vector<double>& coefficients) {
  Map map{target, 0, 1, 0, 1, ustride, vstride, uorder, vorder, {}};
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

Map make_map2(GLenum target, int uorder, int vorder, const std::vector<double>& coefficients) {
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

Map random_map(Test& t, GLenum target, int order) {
  return random_map(t, target, order, gl::components_of(target));
}

Map random_map(Test& t, GLenum target, int order, int stride) {
  return random_map(t, target, Orders{order}, stride, stride);
}

Map random_map(Test& t, GLenum target, const Orders& orders) {
  return random_map(t, target, orders, kLayouts[0]);
}

Map random_map(Test& t, GLenum target, const Orders& orders, int ustride, int vstride) {
  const int vorder = reference::is_map2_target(target) ? orders.v : 1;
  const auto count = static_cast<std::size_t>(orders.u * vorder * gl::components_of(target));
  return make_map2(target, orders.u, vorder, ustride, vstride, random_values(t.random(), count));
}

Map random_map(Test& t, GLenum target, const Orders& orders, const Layout& layout) {
  const int k = gl::components_of(target);
  if (!reference::is_map2_target(target)) return random_map(t, target, orders.u, k);
  return random_map(t, target, orders, layout.ustride(k, orders.u, orders.v),
                    layout.vstride(k, orders.u, orders.v));
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

std::span<const GLenum> targets(bool two) { return two ? gl::kMap2Targets : gl::kMap1Targets; }

const std::vector<TargetForm>& target_forms(bool two) {
  static const std::vector<TargetForm> kAll[] = {make_target_forms(targets(false)),
                                                 make_target_forms(targets(true))};
  return kAll[two];
}

const std::vector<TargetForm>& visible_target_forms(bool two) {
  static const std::vector<TargetForm> kAll[] = {make_target_forms(visible_targets(false)),
                                                 make_target_forms(visible_targets(true))};
  return kAll[two];
}

const std::vector<GLenum>& visible_targets(bool two) {
  static const std::vector<GLenum> kAll[] = {without_index(targets(false)), without_index(targets(true))};
  return kAll[two];
}

gl::Ref define(gl::Case& c, const Map& map, bool doubles, gl::AfterCall after) {
  return define_with(c, map, doubles, points_of(map, doubles, after));
}

gl::Ref define_in_slot(gl::Case& c, const Map& map, bool doubles, int slot) {
  gl::Input points = points_of(map, doubles);
  points.slot = slot;
  return define_with(c, map, doubles, points);
}

void define_and_enable(gl::Case& c, const Map& map, bool doubles) {
  define(c, map, doubles);
  c.Enable(map.target);
}

gl::Ref evaluate(gl::Case& c, double u, bool doubles) {
  return doubles ? c.EvalCoord1d(u) : c.EvalCoord1f(u);
}

gl::Ref evaluate2(gl::Case& c, double u, double v, bool doubles) {
  return doubles ? c.EvalCoord2d(u, v) : c.EvalCoord2f(u, v);
}

gl::Ref eval_coord(gl::Case& c, bool two, double u, double v, bool doubles) {
  return two ? evaluate2(c, u, v, doubles) : evaluate(c, u, doubles);
}

gl::Ref eval_coord_vector(gl::Case& c, bool two, double u, double v, bool doubles) {
  const std::vector<double> at = two ? std::vector{u, v} : std::vector{u};
  if (doubles) return two ? c.EvalCoord2dv(at) : c.EvalCoord1dv(at);
  return two ? c.EvalCoord2fv(converted<float>(at)) : c.EvalCoord1fv(converted<float>(at));
}

gl::Ref eval_point(gl::Case& c, bool two, int i, int j) { return two ? c.EvalPoint2(i, j) : c.EvalPoint1(i); }

gl::Ref eval_mesh(gl::Case& c, bool two, GLenum mode, int i1, int i2, int j1, int j2) {
  return two ? c.EvalMesh2(mode, i1, i2, j1, j2) : c.EvalMesh1(mode, i1, i2);
}

void enable_visibly(gl::Case& c, GLenum target) {
  if (attribute_of(target) != kPosition) {
    const std::vector<double> point = {0.25, 0.5, 0.75};
    const bool two = reference::is_map2_target(target);
    define_and_enable(c, make_map2(target_in(two, GL_MAP1_VERTEX_3), 1, 1, point));
  }
  c.Enable(target);
}

Map over(Map map, const Interval& u) {
  map.u1 = u.first, map.u2 = u.last;
  return map;
}

Map over(Map map, const Interval& u, const Interval& v) {
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

void evaluate_all(gl::Case& c, const std::vector<At>& arguments) { evaluate_all(c, kSurfaces, arguments); }

void evaluate_all(gl::Case& c, bool two, const std::vector<At>& arguments, bool doubles) {
  c.Begin(GL_POINTS);
  for (const auto& [u, v] : arguments) eval_coord(c, two, u, v, doubles);
  c.End();
}

GLenum target_in(bool two, GLenum map1_target) {
  return two ? map1_target - gl::kMap1Targets[0] + gl::kMap2Targets[0] : map1_target;
}

std::vector<gl::Ref> query_everything(Test& t, gl::Case& c) {
  gl::Case queries;
  const auto query_maps = [&](std::span<const GLenum> targets) {
    for (const GLenum target : targets) {
      queries.IsEnabled(target);
      query_map(queries, target, t.max_order(), t.gl().has(gl::EntryPoint::GetMapdv));
    }
  };
  query_maps(gl::kMap1Targets);
  queries.IsEnabled(GL_AUTO_NORMAL);
  const auto query_grid = [&](GLenum name, std::size_t count) {
    t.gl().has(gl::EntryPoint::GetDoublev) ? queries.GetDoublev(name, gl::out<GLdouble>(count))
                                           : queries.GetFloatv(name, gl::out<GLfloat>(count));
  };
  query_grid(GL_MAP1_GRID_DOMAIN, 2);
  queries.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
  query_grid(GL_MAP2_GRID_DOMAIN, 4);
  queries.GetIntegerv(GL_MAP2_GRID_SEGMENTS, gl::out<GLint>(2));
  queries.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4));
  queries.GetFloatv(GL_CURRENT_NORMAL, gl::out<GLfloat>(3));
  queries.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4));
  query_maps(gl::kMap2Targets);
  return t.append_optional(c, queries);
}

void take_snapshot(Test& t, gl::Case& c) { t.compare_only(query_everything(t, c)); }

void expect_unchanged(CheckedTrace& checked, const std::vector<gl::Ref>& before,
                      const std::vector<gl::Ref>& after) {
  for (std::size_t i = 0; i < before.size(); ++i) checked.expect_same(before[i], after[i]);
}

MapQuery query_map(gl::Case& c, GLenum target, int max_order, bool doubles) {
  const bool two = reference::is_map2_target(target);
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

MapQuery query_map(Test& t, gl::Case& c, GLenum target, bool doubles) {
  return query_map(c, target, t.max_order(), doubles && t.can_call(gl::EntryPoint::GetMapdv));
}

void expect_map(CheckedTrace& checked, const MapQuery& query, const Map& map, bool doubles) {
  // Queries promise single precision, to one part in 10^5 (EV-GETMAP-FLOAT, EV-GETMAP-DOUBLE).
  constexpr double kRelative = 1e-5;
  checked.expect_values(query.order, map.orders());
  if (doubles) {
    checked.expect_values_near(query.domain, map.domain(), kRelative);
    checked.expect_values_near(query.coefficients, map.coefficients(), kRelative);
  } else {
    checked.expect_values_near(query.domain, converted<float>(map.domain()), kRelative);
    checked.expect_values_near(query.coefficients, converted<float>(map.coefficients()), kRelative);
  }
}

}  // namespace evalcts
