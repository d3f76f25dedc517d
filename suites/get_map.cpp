// Section 18 of the requirements: GetMap in its three forms, and Get.
#include <fmt/format.h>

#include <utility>

#include <evalcts/testkit/registration.h>

#include "dimensions.h"
#include "grid_cases.h"
#include "rejection.h"

namespace evalcts::suite_get_map {
namespace {

const auto kEachTarget = [](bool two) { return combine(targets(two)); };

// Appends queries of the orders, the domain and the points of a map through all forms of GetMap that the
// implementation has. The arrays have exactly the size of the answers, so that a further value is written
// into the guard behind them.
void query_in_all_forms(Test& t, gl::Case& c, const Map& map) {
  for (const Getter& getter : existing_getters(t)) {
    getter.get(c, map.target, GL_ORDER, map.orders().size());
    getter.get(c, map.target, GL_DOMAIN, map.domain().size());
    getter.get(c, map.target, GL_COEFF, map.coefficients().size());
  }
}

// --- Rules of both dimensions ----------------------------------------------------------------------------

// Floats are returned unchanged, which is more than the specification requires of a conversion.
EVALCTS_TEST_PAIR(GetMap.FloatDataUnchanged, GetMap2.FloatDataUnchanged, kQuality,
                  decide("EV-GETMAP-FLOAT/1-D", "EV-GETMAP-FLOAT/2-D"), kEachTarget)
(Test& t, bool, GLenum target) {
  const Map map = over(random_map(t, target, {6, 4}), {-1000.1f, 0.3f}, {1.1f, 0x1.555556p-2});
  gl::Case c("random data of 24 bits");
  define(c, map);
  query_in_all_forms(t, c, map);
  t.judge(c);
};

EVALCTS_TEST_PAIR(GetMap.DoubleData, GetMap2.DoubleData, kMust,
                  decide("EV-GETMAP-DOUBLE/1-D", "EV-GETMAP-DOUBLE/2-D"), kEachTarget)
(Test& t, bool two, GLenum target) {
  std::vector<double> fractions;
  for (int i = 0; i < (two ? 6 : 2) * gl::components_of(target); ++i) fractions.push_back(1.0 / (i + 3));
  const Map map = two ? make_map2(target, 2, 3, fractions) : make_map1(target, fractions);
  gl::Case c("thirds, quarters, fifths");
  define(c, over(map, {1.0 / 3, 2.0 / 3}, {-1.0 / 7, 10.0 / 3}), true);
  query_map(t, c, target, true);
  t.judge(c);
};

// Appends Map with these points in turn, and queries of its points and its domain as integers.
void define_and_query_integers(gl::Case& c, Map map, const std::vector<double>& points, bool doubles) {
  for (std::size_t i = 0; i < map.points.size(); ++i) map.points[i] = points[i % points.size()];
  define(c, map, doubles);
  c.GetMapiv(map.target, GL_DOMAIN, gl::out<GLint>(map.domain().size()));
  c.GetMapiv(map.target, GL_COEFF, gl::out<GLint>(map.points.size()));
}

// No point and no end is near n + 1/2.
EVALCTS_TEST_PAIR(GetMap.IntegersAreRounded, GetMap2.IntegersAreRounded, kMust,
                  decide("EV-GETMAP-ROUND/1-D", "EV-GETMAP-ROUND/2-D"), kEachTarget)
(Test& t, bool two, GLenum target) {
  const Map map = over(random_map(t, target, two ? Orders{2, 4} : Orders{8}), {-1.6, 2.4}, {7.75, -0.25});
  gl::Case c("values away from halves");
  for (const Form& form : existing_forms(t, {two}))
    define_and_query_integers(c, map, {1.4, -1.6, 2.51, -0.3, 7.0, -100.75, 1000.499, 0.0}, form.doubles);
  t.judge(c);
};

// Values far outside the range of int, and values that an unsigned int can hold.
EVALCTS_TEST_PAIR(GetMap.IntegersSaturate, GetMap2.IntegersSaturate, kMust,
                  decide("EV-GETMAP-SATURATE/1-D", "EV-GETMAP-SATURATE/2-D"), kEachTarget)
(Test& t, bool two, GLenum target) {
  const Map map = over(random_map(t, target, two ? Orders{2, 2} : Orders{4}), {-3e9, 4e9}, {2.5e9, -2.5e9});
  gl::Case c("1e20, -1e20, 3e9 and -3e9");
  define_and_query_integers(c, map, {1e20, -1e20, 3e9, -3e9}, false);
  t.judge(c);
};

EVALCTS_TEST_PAIR(GetMap.DisabledAndUndefined, GetMap2.DisabledAndUndefined, kMust,
                  decide("EV-GETMAP-DISABLED/1-D", "EV-GETMAP-DISABLED/2-D"), kEachTarget)
(Test& t, bool two, GLenum target) {
  gl::Case c("never defined; defined and never enabled; enabled and disabled again");
  const auto ask = [&] {
    c.GetMapiv(target, GL_ORDER, gl::out<GLint>(two ? 2 : 1));
    c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(two ? 32 : 16));
    if (t.can_call(gl::EntryPoint::GetMapdv)) c.GetMapdv(target, GL_DOMAIN, gl::out<GLdouble>(two ? 4 : 2));
    c.GetError();
  };
  ask();
  define(c, two ? random_map(t, target, {2, 3}) : random_map(t, target, 2, 4));
  ask();
  c.Enable(target);
  c.Disable(target);
  ask();
  t.judge(c);
};

EVALCTS_TEST_PAIR(GetMap.AnyTextureUnit, GetMap2.AnyTextureUnit, kMust,
                  decide("EV-GETMAP-NOUNIT/1-D", "EV-GETMAP-NOUNIT/2-D"), kEachTarget)
(Test& t, bool two, GLenum target) {
  const Map map = two ? random_map(t, target, {3, 4}) : random_map(t, target, 3, 4);
  require_texture_units(t);
  for (const GLenum unit : {static_cast<GLenum>(GL_TEXTURE1), last_unit(t)}) {
    gl::Case c(unit == GL_TEXTURE1 ? "TEXTURE1 active" : "the last unit active");
    define(c, map);
    c.ActiveTexture(unit);
    query_in_all_forms(t, c, map);
    c.GetError();
    t.judge(c);
  }
};

EVALCTS_TEST_PAIR(GetMap.PackBufferIgnored, GetMap2.PackBufferIgnored, kMust,
                  decide("EV-GETMAP-NOPBO/1-D", "EV-GETMAP-NOPBO/2-D"), kEachTarget)
(Test& t, bool two, GLenum target) {
  const Map map = two ? random_map(t, target, {3, 4}) : random_map(t, target, 3, 4);
  t.require(2, 1, "GL_ARB_pixel_buffer_object");
  gl::Case c("a buffer bound to PIXEL_PACK_BUFFER");
  define(c, map);
  const gl::ResultOf buffer{c.GenBuffers(1, gl::out<GLuint>(1)).index, 0};
  c.BindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
  c.BufferData(GL_PIXEL_PACK_BUFFER, 4096, std::vector<GLubyte>(4096, 0x5A), GL_STREAM_READ);
  c.GetError();
  query_in_all_forms(t, c, map);
  c.GetError();
  t.judge(c);
};

// --- One dimension, and errors ---------------------------------------------------------------------------

EVALCTS_TEST(GetMap, OrderDomainAndPoints, kMust, "EV-GETMAP-ORDER1", "EV-GETMAP-DOMAIN1", "EV-GETMAP-COEFF1",
             "EV-GETMAP-COUNT/1-D", "EV-GETMAP-FLOAT/1-D", combine(gl::kMap1Targets))
(Test& t, GLenum target) {
  gl::Case c("orders 1, 3 and MAX, domain (5, -2.25), stride k+2");
  for (const int order : {1, 3, t.max_order()})
    for (const Form& form : existing_forms(t, {kCurves})) {
      const Map map = over(random_map(t, target, order, gl::components_of(target) + 2), {5, -2.25});
      define(c, map, form.doubles);
      query_in_all_forms(t, c, map);
    }
  t.judge(c);
};

// Appends the query and GetError, twice: a rejected query raises one error, and writes nothing.
void query_twice(gl::Case& c, const Getter& getter, GLenum target, GLenum query) {
  getter.get(c, target, query, 256);
  c.GetError();
  c.GetError();
}

EVALCTS_TEST(GetMap, BadTarget, kMust, "EV-GETMAP-ERR-TARGET", "EV-GETMAP-ERR-NOWRITE", combine(kGetters))
(Test& t, const Getter& getter) {
  gl::Case c("invalid targets, and those next to valid ones");
  for (const GLenum target : {0u, 0x0D8Fu, 0x0D99u, 0x0DA0u, 0x0DAFu, 0x0DB9u, 0x10D90u, 0x80000DB7u,
                              static_cast<GLenum>(GL_TEXTURE_2D), static_cast<GLenum>(GL_AUTO_NORMAL),
                              static_cast<GLenum>(GL_MAP1_GRID_DOMAIN)})
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN}) query_twice(c, getter, target, query);
  t.judge(c);
};

EVALCTS_TEST(GetMap, BadQuery, kMust, "EV-GETMAP-ERR-QUERY", "EV-GETMAP-ERR-NOWRITE", combine(kGetters))
(Test& t, const Getter& getter) {
  gl::Case c("invalid queries, and those next to valid ones");
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_INDEX, GL_MAP2_COLOR_4})
    for (const GLenum query : {0u, 0x09FFu, 0x0A03u, 0x0B01u, 0x10A00u,
                               static_cast<GLenum>(GL_MAX_EVAL_ORDER), static_cast<GLenum>(GL_MAP1_VERTEX_3)})
      query_twice(c, getter, target, query);
  t.judge(c);
};

EVALCTS_TEST(GetMap, BetweenBeginAndEnd, kMust, "EV-GETMAP-ERR-BEGINEND", "EV-GETMAP-ERR-NOWRITE",
             combine(kGetters))
(Test& t, const Getter& getter) {
  gl::Case c("in POINTS, and after a Vertex in TRIANGLES and POLYGON");
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP2_INDEX})
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN})
      for (const GLenum primitive : {GL_POINTS, GL_TRIANGLES, GL_POLYGON}) {
        c.Begin(primitive);
        if (primitive != GL_POINTS) c.Vertex3f(1, 2, 3);
        getter.get(c, target, query, 256);
        c.End();
        c.GetError();
        c.GetError();
      }
  t.judge_answers(c);
};

// Queries all maps of the dimension between two snapshots.
void judge_queries(Test& t, bool two, const std::vector<Getter>& getters) {
  gl::Case c("all queries of all maps between two snapshots");
  for (const GLenum target : targets(two)) define(c, random_map(t, target, {3, 2}));
  take_snapshot(t, c);
  for (const GLenum target : targets(two))
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN})
      for (const Getter& getter : getters) getter.get(c, target, query, 32);
  take_snapshot(t, c);
  t.judge(c);
}

EVALCTS_TEST(GetMap, ChangesNothing, kMust, "EV-GETMAP-NOSIDE/1-D", combine(kGetters))
(Test& t, const Getter& getter) { judge_queries(t, kCurves, {getter}); };

// Queries do not clear an earlier error.
EVALCTS_TEST(GetMap, KeepsTheErrorThatWaits, kMust, "EV-GETMAP-NOSIDE", combine(kGetters))
(Test& t, const Getter& getter) {
  gl::Case c("MapGrid1 of no segments, then all queries of all maps");
  c.MapGrid1f(0, 0, 1);
  for (std::size_t i = 0; i < gl::kMap1Targets.size(); ++i)
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN}) {
      getter.get(c, gl::kMap1Targets[i], query, 8);
      getter.get(c, gl::kMap2Targets[i], query, 8);
    }
  c.GetError();
  c.GetError();
  t.judge(c);
};

// --- Two dimensions --------------------------------------------------------------------------------------

// Judges queries of maps in both forms and in several layouts.
void judge_queries_of_orders(Test& t, GLenum target, int uorder, int vorder) {
  const int max = t.max_order();
  const auto shown = [max](int order) { return order == max ? "MAX" : std::to_string(order); };
  gl::Case c(fmt::format("order {}x{}, domain (5, -2.25, 0.5, 7)", shown(uorder), shown(vorder)));
  for (const Layout& layout : {kLayouts[0], kLayouts[1], kLayouts[2], kLayouts[3]})
    for (const Form& form : existing_forms(t, {kSurfaces})) {
      const Map map = over(random_map(t, target, {uorder, vorder}, layout), {5, -2.25}, {0.5, 7});
      define(c, map, form.doubles);
      query_in_all_forms(t, c, map);
    }
  t.judge(c);
}

// COEFF has v varying fastest. For different orders the formula in the specification is evidently wrong
// (C-COEFF-ORDER).
EVALCTS_TEST(GetMap2, OrderDomainAndPoints, kMust, "EV-GETMAP-ORDER2", "EV-GETMAP-DOMAIN2",
             "EV-GETMAP-COEFF2", "EV-GETMAP-COUNT/2-D", "EV-GETMAP-FLOAT/2-D", combine(gl::kMap2Targets))
(Test& t, GLenum target) {
  const int max = t.max_order();
  for (const auto& [u, v] : {std::pair{2, 3}, {3, 2}, {1, 4}, {4, 1}, {1, 1}, {max, 2}, {3, max}})
    judge_queries_of_orders(t, target, u, v);
};

// For equal orders the formula in all versions of the specification is the one that the test above expects.
EVALCTS_TEST(GetMap2, SquareNet, kMust, "EV-GETMAP-COEFF2-SQUARE", "EV-GETMAP-COUNT/2-D",
             combine(gl::kMap2Targets))
(Test& t, GLenum target) {
  for (const int order : {2, 3, t.max_order()}) judge_queries_of_orders(t, target, order, order);
};

EVALCTS_TEST(GetMap2, ChangesNothing, kMust, "EV-GETMAP-NOSIDE/2-D")
(Test& t) { judge_queries(t, kSurfaces, existing_getters(t)); };

// --- Get -------------------------------------------------------------------------------------------------

// Appends queries of a name through all forms of Get that the implementation has.
void get_in_all_forms(Test& t, gl::Case& c, GLenum name, std::size_t count) {
  c.GetFloatv(name, gl::out<GLfloat>(count));
  if (t.can_call(gl::EntryPoint::GetDoublev)) c.GetDoublev(name, gl::out<GLdouble>(count));
  c.GetIntegerv(name, gl::out<GLint>(count));
  c.GetBooleanv(name, gl::out<GLboolean>(count));
}

// The initial grids, and grids whose ends are not near n + 1/2, so that all interpretations round them to the
// same integer.
EVALCTS_TEST_PAIR(Get.Grid1, Get.Grid2, kMust, decide("EV-GET-GRIDDOMAIN/1-D", "EV-GET-GRIDDOMAIN/2-D"),
                  decide("EV-GET-GRIDSEG/1-D", "EV-GET-GRIDSEG/2-D"),
                  [](bool two) { return two ? by(gl::list_deliveries()) : Parameters<>(); })
(Test& t, bool two) {
  gl::Case c("the initial grid, and others");
  const auto ask = [&] {
    get_in_all_forms(t, c, two ? GL_MAP2_GRID_DOMAIN : GL_MAP1_GRID_DOMAIN, two ? 4 : 2);
    get_in_all_forms(t, c, two ? GL_MAP2_GRID_SEGMENTS : GL_MAP1_GRID_SEGMENTS, two ? 2 : 1);
  };
  ask();
  for (const auto& [u, v] : {std::pair{Grid{1, 0, 1}, Grid{1, 0, 1}},
                             {{5, 2.25f, -1.75f}, {9, 3.125f, -4.25f}},
                             {{1000, -7.125f, 0}, {2, 0, 6.75f}},
                             {{256, 0.25f, -0.375f}, {65536, -0x1p-30f, 300}},
                             {{65536, -0x1p-30f, 300}, {256, 0.25f, -0.375f}}}) {
    map_grid(c, two, u, v);
    ask();
  }
  t.judge(c);
};

// The specification cannot judge this test, because the answer is a limit of the implementation, which all
// forms of Get have to give.
EVALCTS_TEST(Get, MaxEvalOrder, kMust, "EV-GET-MAXORDER")
(Test& t) {
  gl::Case c("every form, before and after maps are defined");
  std::vector<gl::Ref> limits;
  for (int round = 0; round < 2; ++round) {
    limits.push_back(c.GetIntegerv(GL_MAX_EVAL_ORDER, gl::out<GLint>(1)));
    limits.push_back(c.GetFloatv(GL_MAX_EVAL_ORDER, gl::out<GLfloat>(1)));
    if (t.can_call(gl::EntryPoint::GetDoublev))
      limits.push_back(c.GetDoublev(GL_MAX_EVAL_ORDER, gl::out<GLdouble>(1)));
    for (const GLenum target : gl::kMap1Targets) define(c, random_map(t, target, t.max_order(), 4));
  }
  const gl::Ref boolean = c.GetBooleanv(GL_MAX_EVAL_ORDER, gl::out<GLboolean>(1));
  CheckedTrace checked = t.play(c);
  for (const gl::Ref limit : limits) checked.expect_values(limit, std::vector{t.gl().max_eval_order});
  checked.expect_values(boolean, std::vector<GLboolean>{GL_TRUE});
};

EVALCTS_TEST(Get, BetweenBeginAndEnd, kMust, "EV-GET-ERR-BEGINEND")
(Test& t) {
  gl::Case c("in LINES, and after a Vertex in TRIANGLES");
  for (const GLenum name : {GL_MAX_EVAL_ORDER, GL_MAP1_GRID_DOMAIN, GL_MAP1_GRID_SEGMENTS,
                            GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS, GL_MAP1_VERTEX_3, GL_AUTO_NORMAL})
    for (const bool after_vertex : {false, true}) {
      const auto inside = [&](const Calls& query) {
        in_primitive(after_vertex ? GL_TRIANGLES : GL_LINES, after_vertex, query)(c);
        c.GetError();
      };
      inside([&](gl::Case& to) { to.GetBooleanv(name, gl::out<GLboolean>(8)); });
      inside([&](gl::Case& to) { to.GetIntegerv(name, gl::out<GLint>(8)); });
      inside([&](gl::Case& to) { to.GetFloatv(name, gl::out<GLfloat>(8)); });
      if (t.can_call(gl::EntryPoint::GetDoublev))
        inside([&](gl::Case& to) { to.GetDoublev(name, gl::out<GLdouble>(8)); });
    }
  t.judge_answers(c);
};

}  // namespace
}  // namespace evalcts::suite_get_map
