// Section 18 of the requirements: GetMap in its three forms, and Get.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <evalcts/testkit/registration.h>

#include "checked_case.h"
#include "dimensions.h"
#include "rejection.h"

namespace evalcts::suite_get_map {
namespace {

const auto kEachTarget = [](bool two) { return combine(targets(two)); };

// The targets for which all interpretations round integer queries of COEFF in the usual way
// (C-GETMAPIV-NORM).
const auto kEachPlainTarget = [](bool two) {
  return combine(targets(two)).filter([&](GLenum target) {
    return target != target_in(two, GL_MAP1_COLOR_4) && target != target_in(two, GL_MAP1_NORMAL);
  });
};

void expect_count(CheckedCase& c, gl::Ref query, std::size_t count) {
  c.expect([=](CheckedTrace& checked) {
    const std::size_t written = checked.trace().written(query);
    checked.expect(written == count, query, "another number of values is answered",
                   fmt::format("{} values", count), fmt::format("{} values", written));
  });
}

// Expects a query to return the floats unchanged. Throws NotObservable if an answer is so wrong that the
// tests OrderDomainAndPoints fail, because this test is about quality.
void expect_unchanged_values(CheckedCase& c, gl::Ref query, const std::vector<double>& expected) {
  // Single precision (EV-GETMAP-FLOAT) relative to the largest value, because a library may compute an end of
  // a domain as a small difference of large numbers.
  double tolerance = 0;
  for (const double value : expected) tolerance = std::max(tolerance, 1e-5 * std::abs(value));
  c.expect([=](CheckedTrace& checked) {
    const gl::Trace& trace = checked.trace();
    std::vector<double> values;
    if (trace.type(query) == gl::Scalar::kF64) {
      values = trace.values<GLdouble>(query);
    } else {
      const std::vector<GLfloat> floats = trace.values<GLfloat>(query);
      values.assign(floats.begin(), floats.end());
    }
    for (std::size_t i = 0; i < expected.size(); ++i)
      if (!(std::abs(values[i] - expected[i]) <= tolerance))
        throw NotObservable("the answer is wrong, which the tests OrderDomainAndPoints judge");
    checked.expect_values(query, expected);
  });
}

// --- Rules of both dimensions ----------------------------------------------------------------------------

// Floats are returned unchanged, which is more than the specification requires of a conversion.
EVALCTS_TEST_PAIR(GetMap.FloatDataUnchanged, GetMap2.FloatDataUnchanged, kQuality,
                  decide("EV-GETMAP-FLOAT/1-D", "EV-GETMAP-FLOAT/2-D"), kEachTarget)
(Test& t, bool, GLenum target) {
  const Map map = over(random_map(t, target, {6, 4}), {-1000.1f, 0.3f}, {1.1f, 0x1.555556p-2});
  CheckedCase c(t, "random data of 24 bits");
  define(c, map);
  const std::size_t ends = map.domain().size(), count = map.coefficients().size();
  expect_unchanged_values(c, c.GetMapfv(target, GL_DOMAIN, gl::out<GLfloat>(ends)), map.domain());
  expect_unchanged_values(c, c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(count)), map.coefficients());
  if (c.can_call(gl::EntryPoint::GetMapdv)) {
    expect_unchanged_values(c, c.GetMapdv(target, GL_DOMAIN, gl::out<GLdouble>(ends)), map.domain());
    expect_unchanged_values(c, c.GetMapdv(target, GL_COEFF, gl::out<GLdouble>(count)), map.coefficients());
  }
  c.check();
};

EVALCTS_TEST_PAIR(GetMap.DoubleData, GetMap2.DoubleData, kMust,
                  decide("EV-GETMAP-DOUBLE/1-D", "EV-GETMAP-DOUBLE/2-D"), kEachTarget)
(Test& t, bool two, GLenum target) {
  std::vector<double> fractions;
  for (int i = 0; i < (two ? 6 : 2) * gl::components_of(target); ++i) fractions.push_back(1.0 / (i + 3));
  const Map map = two ? make_map2(target, 2, 3, fractions) : make_map1(target, fractions);
  CheckedCase c(t, "thirds, quarters, fifths");
  const Map over_fractions = over(map, {1.0 / 3, 2.0 / 3}, {-1.0 / 7, 10.0 / 3});
  define(c, over_fractions, true);
  c.expect_map(over_fractions, true);
  c.check();
};

// No point and no end is near n + 1/2.
EVALCTS_TEST_PAIR(GetMap.IntegersAreRounded, GetMap2.IntegersAreRounded, kMust,
                  decide("EV-GETMAP-ROUND/1-D", "EV-GETMAP-ROUND/2-D"), kEachPlainTarget)
(Test& t, bool two, GLenum target) {
  constexpr double kValues[] = {1.4, -1.6, 2.51, -0.3, 7.0, -100.75, 1000.499, 0.0};
  constexpr int kRounded[] = {1, -2, 3, 0, 7, -101, 1000, 0};
  Map map = over(random_map(t, target, two ? Orders{2, 4} : Orders{8}), {-1.6, 2.4}, {7.75, -0.25});
  const std::vector<GLint> domain = two ? std::vector<GLint>{-2, 2, 8, 0} : std::vector<GLint>{-2, 2};
  std::vector<GLint> points;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    map.points[i] = kValues[i % 8];
    points.push_back(kRounded[i % 8]);
  }
  for (const Form& form : existing_forms(t, {two})) {
    CheckedCase c(t, fmt::format("values away from halves, form {}", form.name));
    define(c, map, form.doubles);
    c.expect_values(c.GetMapiv(target, GL_DOMAIN, gl::out<GLint>(domain.size())), domain);
    c.expect_values(c.GetMapiv(target, GL_COEFF, gl::out<GLint>(points.size())), points);
    c.check();
  }
};

// Values far outside the range of int, and values that an unsigned int can hold.
EVALCTS_TEST_PAIR(GetMap.IntegersSaturate, GetMap2.IntegersSaturate, kMust,
                  decide("EV-GETMAP-SATURATE/1-D", "EV-GETMAP-SATURATE/2-D"), kEachPlainTarget)
(Test& t, bool two, GLenum target) {
  constexpr double kValues[] = {1e20, -1e20, 3e9, -3e9};
  Map map = over(random_map(t, target, two ? Orders{2, 2} : Orders{4}), {-3e9, 4e9}, {2.5e9, -2.5e9});
  std::vector<GLint> domain = {kLowest, kHighest}, points;
  if (two) domain.insert(domain.end(), {kHighest, kLowest});
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    map.points[i] = kValues[i % 4];
    points.push_back(i % 2 ? kLowest : kHighest);
  }
  CheckedCase c(t, "1e20, -1e20, 3e9 and -3e9");
  define(c, map);
  c.expect_values(c.GetMapiv(target, GL_COEFF, gl::out<GLint>(points.size())), points);
  c.expect_values(c.GetMapiv(target, GL_DOMAIN, gl::out<GLint>(domain.size())), domain);
  c.check();
};

EVALCTS_TEST_PAIR(GetMap.DisabledAndUndefined, GetMap2.DisabledAndUndefined, kMust,
                  decide("EV-GETMAP-DISABLED/1-D", "EV-GETMAP-DISABLED/2-D"), kEachTarget)
(Test& t, bool two, GLenum target) {
  CheckedCase c(t, "never defined; defined and never enabled; enabled and disabled again");
  const auto ask = [&](const Orders& orders) {
    c.expect_orders(target, two ? std::vector<GLint>{orders.u, orders.v} : std::vector<GLint>{orders.u});
    c.expect_no_error();
    expect_count(c, c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(two ? 32 : 16)),
                 static_cast<std::size_t>(orders.u * (two ? orders.v : 1) * gl::components_of(target)));
    c.expect_no_error();
    if (c.can_call(gl::EntryPoint::GetMapdv)) {
      expect_count(c, c.GetMapdv(target, GL_DOMAIN, gl::out<GLdouble>(two ? 4 : 2)), two ? 4 : 2);
      c.expect_no_error();
    }
  };
  ask({1, 1});
  define(c, two ? random_map(t, target, {2, 3}) : random_map(t, target, 2, 4));
  ask({2, 3});
  c.Enable(target);
  c.Disable(target);
  ask({2, 3});
  c.check();
};

EVALCTS_TEST_PAIR(GetMap.AnyTextureUnit, GetMap2.AnyTextureUnit, kMust,
                  decide("EV-GETMAP-NOUNIT/1-D", "EV-GETMAP-NOUNIT/2-D"), kEachTarget)
(Test& t, bool two, GLenum target) {
  const Map map = two ? random_map(t, target, {3, 4}) : random_map(t, target, 3, 4);
  require_texture_units(t);
  for (const int unit : {1, t.gl().texture_units - 1}) {
    CheckedCase c(t, unit == 1 ? "TEXTURE1 active" : "the last unit active");
    define(c, map);
    c.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    c.expect_map(map);
    c.expect_map(map, true);
    c.expect_no_error();
    c.check();
  }
};

EVALCTS_TEST_PAIR(GetMap.PackBufferIgnored, GetMap2.PackBufferIgnored, kMust,
                  decide("EV-GETMAP-NOPBO/1-D", "EV-GETMAP-NOPBO/2-D"), kEachTarget)
(Test& t, bool two, GLenum target) {
  const Map map = two ? random_map(t, target, {3, 4}) : random_map(t, target, 3, 4);
  t.require(2, 1, "GL_ARB_pixel_buffer_object");
  CheckedCase c(t, "a buffer bound to PIXEL_PACK_BUFFER");
  define(c, map);
  const gl::ResultOf buffer{c.GenBuffers(1, gl::out<GLuint>(1)).index, 0};
  c.BindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
  c.BufferData(GL_PIXEL_PACK_BUFFER, 4096, std::vector<GLubyte>(4096, 0x5A), GL_STREAM_READ);
  c.expect_no_error();
  c.expect_map(map);
  c.expect_map(map, true);
  c.expect_no_error();
  c.check();
};

// --- One dimension, and errors ---------------------------------------------------------------------------

// Expects the answers to queries of the map. Their arrays have exactly the size of the answers.
void expect_order_domain_and_points(CheckedCase& c, const Map& map) {
  const std::size_t dimensions = map.two ? 2 : 1, count = map.coefficients().size();
  const bool doubles = c.can_call(gl::EntryPoint::GetMapdv);
  c.expect_values(c.GetMapfv(map.target, GL_ORDER, gl::out<GLfloat>(dimensions)), map.orders());
  if (doubles) c.expect_values(c.GetMapdv(map.target, GL_ORDER, gl::out<GLdouble>(dimensions)), map.orders());
  c.expect_values(c.GetMapiv(map.target, GL_ORDER, gl::out<GLint>(dimensions)), map.orders());
  c.expect_values_near(c.GetMapfv(map.target, GL_DOMAIN, gl::out<GLfloat>(2 * dimensions)), map.domain());
  if (doubles)
    c.expect_values_near(c.GetMapdv(map.target, GL_DOMAIN, gl::out<GLdouble>(2 * dimensions)), map.domain());
  c.expect_values_near(c.GetMapfv(map.target, GL_COEFF, gl::out<GLfloat>(count)), map.coefficients());
  if (doubles)
    c.expect_values_near(c.GetMapdv(map.target, GL_COEFF, gl::out<GLdouble>(count)), map.coefficients());
}

// The array has exactly the size of the answer, so that a further value is written into the guard after it.
EVALCTS_TEST(GetMap, OrderDomainAndPoints, kMust, "EV-GETMAP-ORDER1", "EV-GETMAP-DOMAIN1", "EV-GETMAP-COEFF1",
             "EV-GETMAP-COUNT/1-D", "EV-GETMAP-FLOAT/1-D", combine(gl::kMap1Targets))
(Test& t, GLenum target) {
  const int k = gl::components_of(target);
  for (const int order : {1, 3, t.max_order()})
    for (const Form& form : existing_forms(t, {kCurves})) {
      const Map map = over(random_map(t, target, order, k + 2), {5, -2.25});
      CheckedCase c(t, fmt::format("order {} form {}, domain (5, -2.25), stride k+2", order, form.name));
      define(c, map, form.doubles);
      expect_order_domain_and_points(c, map);
      const auto count = static_cast<std::size_t>(order * k);
      expect_count(c, c.GetMapiv(target, GL_DOMAIN, gl::out<GLint>(2)), 2);
      expect_count(c, c.GetMapiv(target, GL_COEFF, gl::out<GLint>(count)), count);
      c.check();
    }
};

constexpr GLenum kOutside = GL_POLYGON + 1;

void expect_rejected(Test& t, const Getter& getter, GLenum target, GLenum query, GLenum error,
                     GLenum primitive = kOutside) {
  const bool inside = primitive != kOutside;
  gl::Case c(gl::token_name(target) + " " + gl::token_name(query) +
             (inside ? " in " + gl::primitive_name(primitive) : ""));
  if (inside) c.Begin(primitive);
  if (inside && primitive != GL_POINTS) c.Vertex3f(1, 2, 3);
  const gl::Ref get = getter.get(c, target, query, 256);
  if (inside) c.End();
  expect_query_rejected(t, c, get, {error});
}

EVALCTS_TEST(GetMap, BadTarget, kMust, "EV-GETMAP-ERR-TARGET", "EV-GETMAP-ERR-NOWRITE", combine(kGetters))
(Test& t, const Getter& getter) {
  for (const GLenum target : {0u, 0x0D8Fu, 0x0D99u, 0x0DA0u, 0x0DAFu, 0x0DB9u, 0x10D90u, 0x80000DB7u,
                              static_cast<GLenum>(GL_TEXTURE_2D), static_cast<GLenum>(GL_AUTO_NORMAL),
                              static_cast<GLenum>(GL_MAP1_GRID_DOMAIN)})
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN})
      expect_rejected(t, getter, target, query, GL_INVALID_ENUM);
};

EVALCTS_TEST(GetMap, BadQuery, kMust, "EV-GETMAP-ERR-QUERY", "EV-GETMAP-ERR-NOWRITE", combine(kGetters))
(Test& t, const Getter& getter) {
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_INDEX, GL_MAP2_COLOR_4})
    for (const GLenum query : {0u, 0x09FFu, 0x0A03u, 0x0B01u, 0x10A00u,
                               static_cast<GLenum>(GL_MAX_EVAL_ORDER), static_cast<GLenum>(GL_MAP1_VERTEX_3)})
      expect_rejected(t, getter, target, query, GL_INVALID_ENUM);
};

EVALCTS_TEST(GetMap, BetweenBeginAndEnd, kMust, "EV-GETMAP-ERR-BEGINEND", "EV-GETMAP-ERR-NOWRITE",
             combine(kGetters))
(Test& t, const Getter& getter) {
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP2_INDEX})
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN})
      for (const GLenum primitive : {GL_POINTS, GL_TRIANGLES, GL_POLYGON})
        expect_rejected(t, getter, target, query, GL_INVALID_OPERATION, primitive);
};

EVALCTS_TEST(GetMap, ChangesNothing, kMust, "EV-GETMAP-NOSIDE/1-D", combine(kGetters))
(Test& t, const Getter& getter) {
  CheckedCase c(t, "all queries of all maps between two snapshots");
  for (const GLenum target : gl::kMap1Targets) define(c, random_map(t, target, 3, 4));
  const std::vector<gl::Ref> before = c.query_everything();
  for (const GLenum target : gl::kMap1Targets)
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN}) getter.get(c, target, query, 32);
  c.expect_unchanged(before);
  c.check();
};

// Queries do not clear an earlier error.
EVALCTS_TEST(GetMap, KeepsTheErrorThatWaits, kMust, "EV-GETMAP-NOSIDE", combine(kGetters))
(Test& t, const Getter& getter) {
  CheckedCase c(t, "MapGrid1 of no segments, then all queries of all maps");
  c.MapGrid1f(0, 0, 1);
  for (std::size_t i = 0; i < gl::kMap1Targets.size(); ++i)
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN}) {
      getter.get(c, gl::kMap1Targets[i], query, 8);
      getter.get(c, gl::kMap2Targets[i], query, 8);
    }
  c.expect_error(GL_INVALID_VALUE);
  c.expect_no_error();
  c.check();
};

// --- Two dimensions --------------------------------------------------------------------------------------

// Expects the orders, the domain and the points of a map in both forms and in several layouts. The arrays
// have exactly the size of the answers, so that a further value is written into the guard after them.
void expect_answered(Test& t, GLenum target, int uorder, int vorder) {
  const int max = t.max_order();
  const auto shown = [max](int order) { return order == max ? "MAX" : std::to_string(order); };
  CheckedCase c(t, fmt::format("order {}x{}, domain (5, -2.25, 0.5, 7)", shown(uorder), shown(vorder)));
  for (const Layout& layout : {kLayouts[0], kLayouts[1], kLayouts[2], kLayouts[3]})
    for (const Form& form : existing_forms(t, {kSurfaces})) {
      const Map map = over(random_map(t, target, {uorder, vorder}, layout), {5, -2.25}, {0.5, 7});
      define(c, map, form.doubles);
      expect_order_domain_and_points(c, map);
    }
  c.check();
}

// COEFF has v varying fastest. For different orders the formula in the specification is evidently wrong
// (C-COEFF-ORDER).
EVALCTS_TEST(GetMap2, OrderDomainAndPoints, kMust, "EV-GETMAP-ORDER2", "EV-GETMAP-DOMAIN2",
             "EV-GETMAP-COEFF2", "EV-GETMAP-COUNT/2-D", "EV-GETMAP-FLOAT/2-D", combine(gl::kMap2Targets))
(Test& t, GLenum target) {
  const int max = t.max_order();
  for (const auto& [u, v] : {std::pair{2, 3}, {3, 2}, {1, 4}, {4, 1}, {1, 1}, {max, 2}, {3, max}})
    expect_answered(t, target, u, v);
};

// For equal orders the formula in all versions of the specification is the one that the test above expects.
EVALCTS_TEST(GetMap2, SquareNet, kMust, "EV-GETMAP-COEFF2-SQUARE", "EV-GETMAP-COUNT/2-D",
             combine(gl::kMap2Targets))
(Test& t, GLenum target) {
  for (const int order : {2, 3, t.max_order()}) expect_answered(t, target, order, order);
};

EVALCTS_TEST(GetMap2, ChangesNothing, kMust, "EV-GETMAP-NOSIDE/2-D")
(Test& t) {
  CheckedCase c(t, "all queries of all maps between two snapshots");
  for (const GLenum target : gl::kMap2Targets) define(c, random_map(t, target, {3, 2}));
  const std::vector<gl::Ref> before = c.query_everything();
  for (const GLenum target : gl::kMap2Targets)
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN})
      for (const Getter& getter : existing_getters(t)) getter.get(c, target, query, 32);
  c.expect_unchanged(before);
  c.check();
};

// --- Get -------------------------------------------------------------------------------------------------

// No value is near n + 1/2, so that all interpretations round it to the same integer.
EVALCTS_TEST(Get, Grid1, kMust, "EV-GET-GRIDDOMAIN/1-D", "EV-GET-GRIDSEG/1-D")
(Test& t) {
  struct Grid {
    GLint segments;
    float u1, u2;
    std::vector<GLint> rounded;
  };
  const Grid grids[] = {{1, 0, 1, {0, 1}},
                        {5, 2.25f, -1.75f, {2, -2}},
                        {1000, -7.125f, 0, {-7, 0}},
                        {256, 0.25f, -0.375f, {0, 0}},
                        {65536, -0x1p-30f, 300, {0, 300}}};
  for (const Grid& grid : grids)
    for (const bool defined : {true, false}) {
      if (!defined && grid.segments != 1) continue;  // the first grid is the initial one
      CheckedCase c(t, fmt::format("MapGrid1f({}, {}, {}){}", grid.segments, grid.u1, grid.u2,
                                   defined ? "" : ", the initial grid"));
      if (defined) c.MapGrid1f(grid.segments, grid.u1, grid.u2);
      const std::vector<double> domain = {grid.u1, grid.u2};
      c.expect_values_near(c.GetFloatv(GL_MAP1_GRID_DOMAIN, gl::out<GLfloat>(2)), domain);
      const gl::Ref rounded = c.GetIntegerv(GL_MAP1_GRID_DOMAIN, gl::out<GLint>(2));
      c.expect([&, rounded](CheckedTrace& checked) { expect_rounded(t, checked, rounded, grid.rounded); });
      c.expect_values(c.GetBooleanv(GL_MAP1_GRID_DOMAIN, gl::out<GLboolean>(2)),
                      std::vector<GLboolean>{grid.u1 != 0, grid.u2 != 0});
      const std::vector<GLint> segments = {grid.segments};
      c.expect_values(c.GetFloatv(GL_MAP1_GRID_SEGMENTS, gl::out<GLfloat>(1)), segments);
      if (c.can_call(gl::EntryPoint::GetDoublev)) {
        c.expect_values_near(c.GetDoublev(GL_MAP1_GRID_DOMAIN, gl::out<GLdouble>(2)), domain);
        c.expect_values(c.GetDoublev(GL_MAP1_GRID_SEGMENTS, gl::out<GLdouble>(1)), segments);
      }
      c.expect_values(c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1)), segments);
      c.expect_values(c.GetBooleanv(GL_MAP1_GRID_SEGMENTS, gl::out<GLboolean>(1)), {GL_TRUE});
      c.check();
    }
};

EVALCTS_TEST(Get, MaxEvalOrder, kMust, "EV-GET-MAXORDER")
(Test& t) {
  CheckedCase c(t, "every form, before and after maps are defined");
  const std::vector<GLint> expected = {t.gl().max_eval_order};
  for (int round = 0; round < 2; ++round) {
    c.expect_values(c.GetIntegerv(GL_MAX_EVAL_ORDER, gl::out<GLint>(1)), expected);
    c.expect_values(c.GetFloatv(GL_MAX_EVAL_ORDER, gl::out<GLfloat>(1)), expected);
    if (c.can_call(gl::EntryPoint::GetDoublev))
      c.expect_values(c.GetDoublev(GL_MAX_EVAL_ORDER, gl::out<GLdouble>(1)), expected);
    for (const GLenum target : gl::kMap1Targets) define(c, random_map(t, target, t.max_order(), 4));
  }
  c.expect_values(c.GetBooleanv(GL_MAX_EVAL_ORDER, gl::out<GLboolean>(1)), {GL_TRUE});
  c.check();
};

EVALCTS_TEST(Get, BetweenBeginAndEnd, kMust, "EV-GET-ERR-BEGINEND")
(Test& t) {
  for (const GLenum name : {GL_MAX_EVAL_ORDER, GL_MAP1_GRID_DOMAIN, GL_MAP1_GRID_SEGMENTS,
                            GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS, GL_MAP1_VERTEX_3, GL_AUTO_NORMAL})
    for (int form = 0; form < 8; ++form) {
      const GLenum primitive = form < 4 ? GL_LINES : GL_TRIANGLES;
      CheckedCase c(t, fmt::format("{} form {} in {}", gl::token_name(name), "bifd"[form % 4],
                                   gl::primitive_name(primitive)));
      c.Begin(primitive);
      if (form >= 4) c.Vertex3f(1, 2, 3);
      const gl::Ref get = form % 4 == 0   ? c.GetBooleanv(name, gl::out<GLboolean>(8))
                          : form % 4 == 1 ? c.GetIntegerv(name, gl::out<GLint>(8))
                          : form % 4 == 2 ? c.GetFloatv(name, gl::out<GLfloat>(8))
                                          : c.GetDoublev(name, gl::out<GLdouble>(8));
      c.End();
      c.expect_error(GL_INVALID_OPERATION);
      c.expect([=](CheckedTrace& checked) { checked.expect_nothing_written(get); });
      c.check();
    }
};

}  // namespace
}  // namespace evalcts::suite_get_map
