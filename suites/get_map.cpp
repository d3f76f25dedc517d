// Section 18 of the requirements: GetMap in its three forms, and Get.
#include <fmt/format.h>

#include <span>

#include <evalcts/testkit/registration.h>

#include "maps.h"

namespace evalcts::suite_get_map {
namespace {

// The targets of one dimension whose maps' integer queries are plainly rounded under every interpretation
// (C-GETMAPIV-NORM).
std::vector<GLenum> plain(std::span<const GLenum> targets) {
  std::vector<GLenum> all(targets.begin(), targets.end());
  for (const GLenum other : {GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP2_COLOR_4, GL_MAP2_NORMAL})
    std::erase(all, static_cast<GLenum>(other));
  return all;
}
const std::vector<GLenum>& plain_targets() {
  static const std::vector<GLenum> targets = plain(gl::kMap1Targets);
  return targets;
}
const std::vector<GLenum>& plain_targets2() {
  static const std::vector<GLenum> targets = plain(gl::kMap2Targets);
  return targets;
}

void expect_count(Played& played, gl::Ref query, std::size_t count) {
  const std::size_t written = played.trace().written(query);
  played.expect(written == count, query, "another number of values is answered",
                fmt::format("{} values", count), fmt::format("{} values", written));
}

// --- Rules of both dimensions ----------------------------------------------------------------------------

// Float data are returned unchanged, which is more than the sources promise of a conversion.
template <class Map>
void expect_float_data_unchanged(Test& t, const Map& map) {
  gl::Case c("random data of 24 bits");
  define(c, map);
  const std::size_t ends = map.domain().size(), count = map.coefficients().size();
  const gl::Ref domain = c.GetMapfv(map.target, GL_DOMAIN, gl::out<GLfloat>(ends));
  const gl::Ref real_domain = c.GetMapdv(map.target, GL_DOMAIN, gl::out<GLdouble>(ends));
  const gl::Ref single = c.GetMapfv(map.target, GL_COEFF, gl::out<GLfloat>(count));
  const gl::Ref real = c.GetMapdv(map.target, GL_COEFF, gl::out<GLdouble>(count));
  Played played = t.play(c);
  for (const gl::Ref query : {domain, real_domain}) played.expect_values(query, map.domain());
  played.expect_values(single, map.coefficients());
  played.expect_values(real, map.coefficients());
}

// The values 1/3, 1/4, ...
std::vector<double> fractions(int count) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(1.0 / (i + 3));
  return all;
}
template <class Map>
void expect_double_data(Test& t, const Map& map) {
  gl::Case c("thirds, quarters, fifths");
  define(c, map, true);
  const MapQuery query = query_map(c, map.target, t.max_order(), true);
  Played played = t.play(c);
  expect_map(played, query, map, true);
}

// The map is tightly packed and gets points away from halves.
template <class Map>
void expect_rounded(Test& t, Map map, const std::vector<GLint>& domain) {
  constexpr double kValues[] = {1.4, -1.6, 2.51, -0.3, 7.0, -100.75, 1000.499, 0.0};
  constexpr int kRounded[] = {1, -2, 3, 0, 7, -101, 1000, 0};
  std::vector<GLint> expected;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    map.points[i] = kValues[i % 8];
    expected.push_back(kRounded[i % 8]);
  }
  for (const Form& form : kForms) {
    gl::Case c(fmt::format("values away from halves, form {}", form.name));
    define(c, map, form.doubles);
    const gl::Ref ends = c.GetMapiv(map.target, GL_DOMAIN, gl::out<GLint>(domain.size()));
    const gl::Ref coefficients = c.GetMapiv(map.target, GL_COEFF, gl::out<GLint>(expected.size()));
    Played played = t.play(c);
    played.expect_values(ends, domain);
    played.expect_values(coefficients, expected);
  }
}

// Values far beyond the range of int, and values that 32 bits without a sign or a float still hold. The map
// is tightly packed.
template <class Map>
void expect_saturated(Test& t, Map map, const std::vector<GLint>& domain) {
  constexpr double kValues[] = {1e20, -1e20, 3e9, -3e9};
  std::vector<GLint> expected;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    map.points[i] = kValues[i % 4];
    expected.push_back(i % 2 ? kLowest : kHighest);
  }
  gl::Case c("1e20, -1e20, 3e9 and -3e9");
  define(c, map);
  const gl::Ref coefficients = c.GetMapiv(map.target, GL_COEFF, gl::out<GLint>(expected.size()));
  const gl::Ref ends = c.GetMapiv(map.target, GL_DOMAIN, gl::out<GLint>(domain.size()));
  Played played = t.play(c);
  played.expect_values(coefficients, expected);
  played.expect_values(ends, domain);
}

template <class Map>
void expect_any_texture_unit(Test& t, const Map& map) {
  t.require(1, 3, "GL_ARB_multitexture");
  if (t.gl().texture_units < 2) throw NotSupported("has one texture unit only");
  for (const int unit : {1, t.gl().texture_units - 1}) {
    gl::Case c(unit == 1 ? "TEXTURE1 active" : "the last unit active");
    define(c, map);
    c.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    const MapQuery query = query_map(c, map.target, t.max_order());
    const MapQuery real = query_map(c, map.target, t.max_order(), true);
    const gl::Ref error = c.GetError();
    Played played = t.play(c);
    played.expect_no_error(error);
    expect_map(played, query, map);
    expect_map(played, real, map, true);
  }
}

template <class Map>
void expect_pack_buffer_ignored(Test& t, const Map& map) {
  t.require(2, 1, "GL_ARB_pixel_buffer_object");
  gl::Case c("a buffer bound to PIXEL_PACK_BUFFER");
  define(c, map);
  const gl::ResultOf buffer{c.GenBuffers(1, gl::out<GLuint>(1)).index, 0};
  c.BindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
  c.BufferData(GL_PIXEL_PACK_BUFFER, 4096, std::vector<GLubyte>(4096, 0x5A), GL_STREAM_READ);
  const gl::Ref none = c.GetError();
  const MapQuery single = query_map(c, map.target, t.max_order());
  const MapQuery real = query_map(c, map.target, t.max_order(), true);
  const gl::Ref error = c.GetError();
  Played played = t.play(c);
  played.expect_no_error(none);
  played.expect_no_error(error);
  expect_map(played, single, map);
  expect_map(played, real, map, true);
}

}  // namespace

// The array ends with the answer: one value more would land in the guard behind it and be seen.
EVALCTS_TEST(GetMap, OrderDomainAndPoints, must, "EV-GETMAP-ORDER1", "EV-GETMAP-DOMAIN1", "EV-GETMAP-COEFF1",
             "EV-GETMAP-COUNT/1-D", "EV-GETMAP-FLOAT/1-D", combine(gl::kMap1Targets))
(Test& t, GLenum target) {
  const int k = gl::components_of(target);
  for (const int order : {1, 3, t.max_order()})
    for (const Form& form : kForms) {
      Map1 map = random_map(t, target, order, k + 2);
      map.u1 = 5, map.u2 = -2.25;
      gl::Case c(fmt::format("order {} form {}, domain (5, -2.25), stride k+2", order, form.name));
      define(c, map, form.doubles);
      const auto count = static_cast<std::size_t>(order * k);
      const gl::Ref orders[] = {c.GetMapfv(target, GL_ORDER, gl::out<GLfloat>(1)),
                                c.GetMapdv(target, GL_ORDER, gl::out<GLdouble>(1)),
                                c.GetMapiv(target, GL_ORDER, gl::out<GLint>(1))};
      const gl::Ref domains[] = {c.GetMapfv(target, GL_DOMAIN, gl::out<GLfloat>(2)),
                                 c.GetMapdv(target, GL_DOMAIN, gl::out<GLdouble>(2))};
      const gl::Ref points[] = {c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(count)),
                                c.GetMapdv(target, GL_COEFF, gl::out<GLdouble>(count))};
      const gl::Ref integer_domain = c.GetMapiv(target, GL_DOMAIN, gl::out<GLint>(2));
      const gl::Ref integer_points = c.GetMapiv(target, GL_COEFF, gl::out<GLint>(count));
      Played played = t.play(c);
      expect_count(played, integer_domain, 2);
      expect_count(played, integer_points, count);
      for (const gl::Ref query : orders)
        played.expect_values(query, std::vector<double>{static_cast<double>(order)});
      for (const gl::Ref query : domains)
        played.expect_values_near(query, std::vector<double>{5, -2.25}, 1e-5);
      for (const gl::Ref query : points) played.expect_values_near(query, map.coefficients(), 1e-5);
    }
};

EVALCTS_TEST(GetMap, FloatDataUnchanged, quality, "EV-GETMAP-FLOAT/1-D", combine(gl::kMap1Targets))
(Test& t, GLenum target) {
  Map1 map = random_map(t, target, 6);
  map.u1 = -1000.1f, map.u2 = 0.3f;
  expect_float_data_unchanged(t, map);
};

EVALCTS_TEST(GetMap, DoubleData, must, "EV-GETMAP-DOUBLE/1-D", combine(gl::kMap1Targets))
(Test& t, GLenum target) {
  const int k = gl::components_of(target);
  expect_double_data(t, make_map1(target, 1.0 / 3, 2.0 / 3, k, fractions(2 * k)));
};

EVALCTS_TEST(GetMap, IntegersAreRounded, must, "EV-GETMAP-ROUND/1-D", combine(plain_targets()))
(Test& t, GLenum target) {
  Map1 map = random_map(t, target, 8);
  map.u1 = -1.6, map.u2 = 2.4;
  expect_rounded(t, map, {-2, 2});
};

EVALCTS_TEST(GetMap, IntegersSaturate, must, "EV-GETMAP-SATURATE/1-D", combine(plain_targets()))
(Test& t, GLenum target) {
  Map1 map = random_map(t, target, 4);
  map.u1 = -3e9, map.u2 = 4e9;
  expect_saturated(t, map, {kLowest, kHighest});
};

EVALCTS_TEST(GetMap, DisabledAndUndefined, must, "EV-GETMAP-DISABLED/1-D", combine(gl::kMap1Targets))
(Test& t, GLenum target) {
  gl::Case c("never defined; defined and never enabled; enabled and disabled again");
  std::vector<gl::Ref> errors, orders, domains, points;
  const auto ask = [&] {
    orders.push_back(c.GetMapiv(target, GL_ORDER, gl::out<GLint>(1)));
    errors.push_back(c.GetError());
    points.push_back(c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(16)));
    errors.push_back(c.GetError());
    domains.push_back(c.GetMapdv(target, GL_DOMAIN, gl::out<GLdouble>(2)));
    errors.push_back(c.GetError());
  };
  ask();
  define(c, random_map(t, target, 2, 4));
  ask();
  c.Enable(target);
  c.Disable(target);
  ask();
  Played played = t.play(c);
  for (const gl::Ref error : errors) played.expect_no_error(error);
  for (std::size_t i = 0; i < orders.size(); ++i) {
    const int order = i == 0 ? 1 : 2;
    played.expect_values(orders[i], std::vector<GLint>{order});
    expect_count(played, points[i], static_cast<std::size_t>(order * gl::components_of(target)));
    expect_count(played, domains[i], 2);
  }
};

namespace {

constexpr GLenum kOutside = GL_POLYGON + 1;

void expect_refused(Test& t, const Getter& getter, GLenum target, GLenum query, GLenum error,
                    GLenum primitive = kOutside) {
  const bool inside = primitive != kOutside;
  gl::Case c(gl::token_name(target) + " " + gl::token_name(query) +
             (inside ? " in " + gl::primitive_name(primitive) : ""));
  if (inside) c.Begin(primitive);
  if (inside && primitive != GL_POINTS) c.Vertex3f(1, 2, 3);
  const gl::Ref get = getter.get(c, target, query, 256);
  if (inside) c.End();
  expect_query_refused(t, c, get, {error});
}

}  // namespace

EVALCTS_TEST(GetMap, BadTarget, must, "EV-GETMAP-ERR-TARGET", "EV-GETMAP-ERR-NOWRITE", combine(kGetters))
(Test& t, const Getter& getter) {
  for (const GLenum target : {0u, 0x0D8Fu, 0x0D99u, 0x0DA0u, 0x0DAFu, 0x0DB9u, 0x10D90u, 0x80000DB7u,
                              static_cast<GLenum>(GL_TEXTURE_2D), static_cast<GLenum>(GL_AUTO_NORMAL),
                              static_cast<GLenum>(GL_MAP1_GRID_DOMAIN)})
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN})
      expect_refused(t, getter, target, query, GL_INVALID_ENUM);
};

EVALCTS_TEST(GetMap, BadQuery, must, "EV-GETMAP-ERR-QUERY", "EV-GETMAP-ERR-NOWRITE", combine(kGetters))
(Test& t, const Getter& getter) {
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_INDEX, GL_MAP2_COLOR_4})
    for (const GLenum query : {0u, 0x09FFu, 0x0A03u, 0x0B01u, 0x10A00u,
                               static_cast<GLenum>(GL_MAX_EVAL_ORDER), static_cast<GLenum>(GL_MAP1_VERTEX_3)})
      expect_refused(t, getter, target, query, GL_INVALID_ENUM);
};

EVALCTS_TEST(GetMap, BetweenBeginAndEnd, must, "EV-GETMAP-ERR-BEGINEND", "EV-GETMAP-ERR-NOWRITE",
             combine(kGetters))
(Test& t, const Getter& getter) {
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP2_INDEX})
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN})
      for (const GLenum primitive : {GL_POINTS, GL_TRIANGLES, GL_POLYGON})
        expect_refused(t, getter, target, query, GL_INVALID_OPERATION, primitive);
};

EVALCTS_TEST(GetMap, AnyTextureUnit, must, "EV-GETMAP-NOUNIT/1-D", combine(gl::kMap1Targets))
(Test& t, GLenum target) { expect_any_texture_unit(t, random_map(t, target, 3, 4)); };

EVALCTS_TEST(GetMap, ChangesNothing, must, "EV-GETMAP-NOSIDE/1-D", combine(kGetters))
(Test& t, const Getter& getter) {
  gl::Case c("all queries of all maps between two snapshots");
  for (const GLenum target : gl::kMap1Targets) define(c, random_map(t, target, 3, 4));
  const std::vector<gl::Ref> before = query_everything(c, t.max_order());
  for (const GLenum target : gl::kMap1Targets)
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN}) getter.get(c, target, query, 32);
  const std::vector<gl::Ref> after = query_everything(c, t.max_order());
  Played played = t.play(c);
  expect_unchanged(played, before, after);
};

// An error that waits goes on waiting.
EVALCTS_TEST(GetMap, KeepsTheErrorThatWaits, must, "EV-GETMAP-NOSIDE", combine(kGetters))
(Test& t, const Getter& getter) {
  gl::Case c("MapGrid1 of no segments, then all queries of all maps");
  c.MapGrid1f(0, 0, 1);
  for (std::size_t i = 0; i < gl::kMap1Targets.size(); ++i)
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN}) {
      getter.get(c, gl::kMap1Targets[i], query, 8);
      getter.get(c, gl::kMap2Targets[i], query, 8);
    }
  const gl::Ref error = c.GetError(), none = c.GetError();
  Played played = t.play(c);
  played.expect_error(error, {GL_INVALID_VALUE});
  played.expect_no_error(none);
};

EVALCTS_TEST(GetMap, PackBufferIgnored, must, "EV-GETMAP-NOPBO/1-D", combine(gl::kMap1Targets))
(Test& t, GLenum target) { expect_pack_buffer_ignored(t, random_map(t, target, 3, 4)); };

// --- Two-dimensional maps --------------------------------------------------------------------------------

namespace {

// The orders, the domain and the points of each map, in both forms and memory orders. The arrays end with the
// answers: one value more would land in the guard behind them and be seen.
void expect_answered(Test& t, GLenum target, int uorder, int vorder) {
  const int k = gl::components_of(target), max = t.max_order();
  const auto shown = [max](int order) { return order == max ? "MAX" : std::to_string(order); };
  gl::Case c(fmt::format("order {}x{}, domain (5, -2.25, 0.5, 7)", shown(uorder), shown(vorder)));
  struct Asked {
    std::vector<double> net;
    std::vector<gl::Ref> orders, domains, points;
  };
  std::vector<Asked> all;
  for (const Layout& layout : {kLayouts[0], kLayouts[1], kLayouts[2], kLayouts[3]})
    for (const Form& form : kForms) {
      Map2 map = random_map2(t, target, uorder, vorder, layout);
      map.u1 = 5, map.u2 = -2.25, map.v1 = 0.5, map.v2 = 7;
      define(c, map, form.doubles);
      const auto count = static_cast<std::size_t>(uorder * vorder * k);
      all.push_back({map.coefficients(),
                     {c.GetMapfv(target, GL_ORDER, gl::out<GLfloat>(2)),
                      c.GetMapdv(target, GL_ORDER, gl::out<GLdouble>(2)),
                      c.GetMapiv(target, GL_ORDER, gl::out<GLint>(2))},
                     {c.GetMapfv(target, GL_DOMAIN, gl::out<GLfloat>(4)),
                      c.GetMapdv(target, GL_DOMAIN, gl::out<GLdouble>(4))},
                     {c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(count)),
                      c.GetMapdv(target, GL_COEFF, gl::out<GLdouble>(count))}});
    }
  Played played = t.play(c);
  for (const Asked& asked : all) {
    for (const gl::Ref query : asked.orders)
      played.expect_values(query,
                           std::vector<double>{static_cast<double>(uorder), static_cast<double>(vorder)});
    for (const gl::Ref query : asked.domains)
      played.expect_values_near(query, std::vector<double>{5, -2.25, 0.5, 7}, 1e-5);
    for (const gl::Ref query : asked.points) played.expect_values_near(query, asked.net, 1e-5);
  }
}

}  // namespace

// v fastest, also where the orders differ and the printed formula cannot be meant (C-COEFF-ORDER).
EVALCTS_TEST(GetMap2, OrderDomainAndPoints, must, "EV-GETMAP-ORDER2", "EV-GETMAP-DOMAIN2", "EV-GETMAP-COEFF2",
             "EV-GETMAP-COUNT/2-D", "EV-GETMAP-FLOAT/2-D", combine(gl::kMap2Targets))
(Test& t, GLenum target) {
  const int max = t.max_order();
  for (const auto& [u, v] : {std::pair{2, 3}, {3, 2}, {1, 4}, {4, 1}, {1, 1}, {max, 2}, {3, max}})
    expect_answered(t, target, u, v);
};

// Here every specification prints the formula that the test above expects.
EVALCTS_TEST(GetMap2, SquareNet, must, "EV-GETMAP-COEFF2-SQUARE", "EV-GETMAP-COUNT/2-D",
             combine(gl::kMap2Targets))
(Test& t, GLenum target) {
  for (const int order : {2, 3, t.max_order()}) expect_answered(t, target, order, order);
};

EVALCTS_TEST(GetMap2, FloatDataUnchanged, quality, "EV-GETMAP-FLOAT/2-D", combine(gl::kMap2Targets))
(Test& t, GLenum target) {
  Map2 map = random_map2(t, target, 6, 4);
  map.u1 = -1000.1f, map.u2 = 0.3f, map.v1 = 1.1f, map.v2 = 0x1.555556p-2;
  expect_float_data_unchanged(t, map);
};

EVALCTS_TEST(GetMap2, DoubleData, must, "EV-GETMAP-DOUBLE/2-D", combine(gl::kMap2Targets))
(Test& t, GLenum target) {
  Map2 map = make_map2(target, 2, 3, fractions(2 * 3 * gl::components_of(target)));
  map.u1 = 1.0 / 3, map.u2 = 2.0 / 3, map.v1 = -1.0 / 7, map.v2 = 10.0 / 3;
  expect_double_data(t, map);
};

EVALCTS_TEST(GetMap2, IntegersAreRounded, must, "EV-GETMAP-ROUND/2-D", combine(plain_targets2()))
(Test& t, GLenum target) {
  Map2 map = random_map2(t, target, 2, 4);
  map.u1 = -1.6, map.u2 = 2.4, map.v1 = 7.75, map.v2 = -0.25;
  expect_rounded(t, map, {-2, 2, 8, 0});
};

EVALCTS_TEST(GetMap2, IntegersSaturate, must, "EV-GETMAP-SATURATE/2-D", combine(plain_targets2()))
(Test& t, GLenum target) {
  Map2 map = random_map2(t, target, 2, 2);
  map.u1 = -3e9, map.u2 = 4e9, map.v1 = 2.5e9, map.v2 = -2.5e9;
  expect_saturated(t, map, {kLowest, kHighest, kHighest, kLowest});
};

EVALCTS_TEST(GetMap2, DisabledAndUndefined, must, "EV-GETMAP-DISABLED/2-D", combine(gl::kMap2Targets))
(Test& t, GLenum target) {
  gl::Case c("never defined; defined and never enabled; enabled and disabled again");
  std::vector<gl::Ref> errors, orders;
  const auto ask = [&] {
    orders.push_back(c.GetMapiv(target, GL_ORDER, gl::out<GLint>(2)));
    errors.push_back(c.GetError());
    c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(32));
    errors.push_back(c.GetError());
    c.GetMapdv(target, GL_DOMAIN, gl::out<GLdouble>(4));
    errors.push_back(c.GetError());
  };
  ask();
  define(c, random_map2(t, target, 2, 3));
  ask();
  c.Enable(target);
  c.Disable(target);
  ask();
  Played played = t.play(c);
  for (const gl::Ref error : errors) played.expect_no_error(error);
  for (std::size_t i = 0; i < orders.size(); ++i)
    played.expect_values(orders[i], i == 0 ? std::vector<GLint>{1, 1} : std::vector<GLint>{2, 3});
};

EVALCTS_TEST(GetMap2, AnyTextureUnit, must, "EV-GETMAP-NOUNIT/2-D", combine(gl::kMap2Targets))
(Test& t, GLenum target) { expect_any_texture_unit(t, random_map2(t, target, 3, 4)); };

EVALCTS_TEST(GetMap2, ChangesNothing, must, "EV-GETMAP-NOSIDE/2-D")
(Test& t) {
  gl::Case c("all queries of all maps between two snapshots");
  for (const GLenum target : gl::kMap2Targets) define(c, random_map2(t, target, 3, 2));
  const std::vector<gl::Ref> before = query_everything(c, t.max_order());
  for (const GLenum target : gl::kMap2Targets)
    for (const GLenum query : {GL_COEFF, GL_ORDER, GL_DOMAIN}) {
      c.GetMapfv(target, query, gl::out<GLfloat>(32));
      c.GetMapdv(target, query, gl::out<GLdouble>(32));
      c.GetMapiv(target, query, gl::out<GLint>(32));
    }
  const std::vector<gl::Ref> after = query_everything(c, t.max_order());
  Played played = t.play(c);
  expect_unchanged(played, before, after);
};

EVALCTS_TEST(GetMap2, PackBufferIgnored, must, "EV-GETMAP-NOPBO/2-D", combine(gl::kMap2Targets))
(Test& t, GLenum target) { expect_pack_buffer_ignored(t, random_map2(t, target, 3, 4)); };

// --- Get -------------------------------------------------------------------------------------------------

// Values away from halves, so that rounding to integers is the same whatever one reads.
EVALCTS_TEST(Get, Grid1, must, "EV-GET-GRIDDOMAIN/1-D", "EV-GET-GRIDSEG/1-D")
(Test& t) {
  struct Grid {
    GLint segments;
    float u1, u2;
    GLint rounded[2];
  };
  const Grid grids[] = {{1, 0, 1, {0, 1}},
                        {5, 2.25f, -1.75f, {2, -2}},
                        {1000, -7.125f, 0, {-7, 0}},
                        {256, 0.25f, -0.375f, {0, 0}},
                        {65536, -0x1p-30f, 300, {0, 300}}};
  for (const Grid& grid : grids)
    for (const bool defined : {true, false}) {
      if (!defined && grid.segments != 1) continue;  // the initial grid is the first of them
      gl::Case c(fmt::format("MapGrid1f({}, {}, {}){}", grid.segments, grid.u1, grid.u2,
                             defined ? "" : ", the initial grid"));
      if (defined) c.MapGrid1f(grid.segments, grid.u1, grid.u2);
      const gl::Ref domain_f = c.GetFloatv(GL_MAP1_GRID_DOMAIN, gl::out<GLfloat>(2));
      const gl::Ref domain_d = c.GetDoublev(GL_MAP1_GRID_DOMAIN, gl::out<GLdouble>(2));
      const gl::Ref domain_i = c.GetIntegerv(GL_MAP1_GRID_DOMAIN, gl::out<GLint>(2));
      const gl::Ref domain_b = c.GetBooleanv(GL_MAP1_GRID_DOMAIN, gl::out<GLboolean>(2));
      const gl::Ref segments_f = c.GetFloatv(GL_MAP1_GRID_SEGMENTS, gl::out<GLfloat>(1));
      const gl::Ref segments_d = c.GetDoublev(GL_MAP1_GRID_SEGMENTS, gl::out<GLdouble>(1));
      const gl::Ref segments_i = c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
      const gl::Ref segments_b = c.GetBooleanv(GL_MAP1_GRID_SEGMENTS, gl::out<GLboolean>(1));
      Played played = t.play(c);
      const std::vector<double> domain = {grid.u1, grid.u2};
      played.expect_values_near(domain_f, domain, 1e-5);
      played.expect_values_near(domain_d, domain, 1e-5);
      played.expect_values(domain_i, std::vector<GLint>{grid.rounded[0], grid.rounded[1]});
      played.expect_values(domain_b, std::vector<GLboolean>{static_cast<GLboolean>(grid.u1 != 0),
                                                            static_cast<GLboolean>(grid.u2 != 0)});
      const std::vector<double> segments = {static_cast<double>(grid.segments)};
      for (const gl::Ref query : {segments_f, segments_d, segments_i}) played.expect_values(query, segments);
      played.expect_values(segments_b, std::vector<GLboolean>{GL_TRUE});
    }
};

EVALCTS_TEST(Get, MaxEvalOrder, must, "EV-GET-MAXORDER")
(Test& t) {
  gl::Case c("every form, before and after maps are defined");
  std::vector<gl::Ref> queries;
  for (int round = 0; round < 2; ++round) {
    queries.push_back(c.GetIntegerv(GL_MAX_EVAL_ORDER, gl::out<GLint>(1)));
    queries.push_back(c.GetFloatv(GL_MAX_EVAL_ORDER, gl::out<GLfloat>(1)));
    queries.push_back(c.GetDoublev(GL_MAX_EVAL_ORDER, gl::out<GLdouble>(1)));
    for (const GLenum target : gl::kMap1Targets) define(c, random_map(t, target, t.max_order(), 4));
  }
  const gl::Ref boolean = c.GetBooleanv(GL_MAX_EVAL_ORDER, gl::out<GLboolean>(1));
  Played played = t.play(c);
  for (const gl::Ref query : queries)
    played.expect_values(query, std::vector<double>{static_cast<double>(t.gl().max_eval_order)});
  played.expect_values(boolean, std::vector<GLboolean>{GL_TRUE});
};

EVALCTS_TEST(Get, BetweenBeginAndEnd, must, "EV-GET-ERR-BEGINEND")
(Test& t) {
  for (const GLenum name : {GL_MAX_EVAL_ORDER, GL_MAP1_GRID_DOMAIN, GL_MAP1_GRID_SEGMENTS,
                            GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS, GL_MAP1_VERTEX_3, GL_AUTO_NORMAL})
    for (int form = 0; form < 8; ++form) {
      const GLenum primitive = form < 4 ? GL_LINES : GL_TRIANGLES;
      gl::Case c(fmt::format("{} form {} in {}", gl::token_name(name), "bifd"[form % 4],
                             gl::primitive_name(primitive)));
      c.Begin(primitive);
      if (form >= 4) c.Vertex3f(1, 2, 3);
      const gl::Ref get = form % 4 == 0   ? c.GetBooleanv(name, gl::out<GLboolean>(8))
                          : form % 4 == 1 ? c.GetIntegerv(name, gl::out<GLint>(8))
                          : form % 4 == 2 ? c.GetFloatv(name, gl::out<GLfloat>(8))
                                          : c.GetDoublev(name, gl::out<GLdouble>(8));
      c.End();
      const gl::Ref error = c.GetError();
      Played played = t.play(c);
      played.expect_error(error, {GL_INVALID_OPERATION});
      played.expect_nothing_written(get);
    }
};

}  // namespace evalcts::suite_get_map
