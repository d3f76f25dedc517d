// Section 18 of the requirements for two-dimensional maps: GetMap in its three forms.
#include <fmt/format.h>

#include <algorithm>

#include "suites/maps.h"

namespace evalcts::suite_get_map2 {
namespace {

// Maps whose integer queries are plainly rounded, whatever one reads (C-GETMAPIV-NORM).
const std::vector<GLenum>& plain_targets() {
  static const std::vector<GLenum> targets = [] {
    std::vector<GLenum> all(gl::kMap2Targets.begin(), gl::kMap2Targets.end());
    std::erase_if(all, [](GLenum target) { return target == GL_MAP2_COLOR_4 || target == GL_MAP2_NORMAL; });
    return all;
  }();
  return targets;
}

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
EVALCTS_TESTS(GetMap2, OrderDomainAndPoints, gl::kMap2Targets, GLenum target, must, "EV-GETMAP-ORDER2",
              "EV-GETMAP-DOMAIN2", "EV-GETMAP-COEFF2", "EV-GETMAP-COUNT/2-D", "EV-GETMAP-FLOAT/2-D") {
  const int max = t.max_order();
  for (const auto& [u, v] : {std::pair{2, 3}, {3, 2}, {1, 4}, {4, 1}, {1, 1}, {max, 2}, {3, max}})
    expect_answered(t, target, u, v);
}

// Here every specification prints the formula that the test above expects.
EVALCTS_TESTS(GetMap2, SquareNet, gl::kMap2Targets, GLenum target, must, "EV-GETMAP-COEFF2-SQUARE",
              "EV-GETMAP-COUNT/2-D") {
  for (const int order : {2, 3, t.max_order()}) expect_answered(t, target, order, order);
}

// Float data come back as they were: more than the sources promise of a conversion.
EVALCTS_TESTS(GetMap2, FloatDataUnchanged, gl::kMap2Targets, GLenum target, quality, "EV-GETMAP-FLOAT/2-D") {
  Map2 map = random_map2(t, target, 6, 4);
  map.u1 = -1000.1f, map.u2 = 0.3f, map.v1 = 1.1f, map.v2 = 0x1.555556p-2;
  gl::Case c("random data of 24 bits");
  define(c, map);
  const gl::Ref domain = c.GetMapfv(target, GL_DOMAIN, gl::out<GLfloat>(4));
  const gl::Ref real_domain = c.GetMapdv(target, GL_DOMAIN, gl::out<GLdouble>(4));
  const std::size_t count = map.coefficients().size();
  const gl::Ref single = c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(count));
  const gl::Ref real = c.GetMapdv(target, GL_COEFF, gl::out<GLdouble>(count));
  Played played = t.play(c);
  for (const gl::Ref query : {domain, real_domain})
    played.expect_values(query, std::vector<double>{map.u1, map.u2, map.v1, map.v2});
  played.expect_values(single, map.coefficients());
  played.expect_values(real, map.coefficients());
}

EVALCTS_TESTS(GetMap2, DoubleData, gl::kMap2Targets, GLenum target, must, "EV-GETMAP-DOUBLE/2-D") {
  std::vector<double> fractions;
  for (int i = 0; i < 2 * 3 * gl::components_of(target); ++i) fractions.push_back(1.0 / (i + 3));
  Map2 map = make_map2(target, 2, 3, fractions);
  map.u1 = 1.0 / 3, map.u2 = 2.0 / 3, map.v1 = -1.0 / 7, map.v2 = 10.0 / 3;
  gl::Case c("thirds, quarters, fifths");
  define(c, map, true);
  const MapQuery query = query_map(c, target, t.max_order(), true);
  Played played = t.play(c);
  expect_map(played, query, map, true);
}

EVALCTS_TESTS(GetMap2, IntegersAreRounded, plain_targets(), GLenum target, must, "EV-GETMAP-ROUND/2-D") {
  const double values[] = {1.4, -1.6, 2.51, -0.3, 7.0, -100.75, 1000.499, 0.0};
  const int rounded[] = {1, -2, 3, 0, 7, -101, 1000, 0};
  std::vector<double> points;
  std::vector<GLint> expected;
  for (std::size_t i = 0; i < static_cast<std::size_t>(2 * 4 * gl::components_of(target)); ++i) {
    points.push_back(values[i % 8]);
    expected.push_back(rounded[i % 8]);
  }
  Map2 map = make_map2(target, 2, 4, points);
  map.u1 = -1.6, map.u2 = 2.4, map.v1 = 7.75, map.v2 = -0.25;
  for (const Form& form : kForms) {
    gl::Case c(fmt::format("values away from halves, form {}", form.name));
    define(c, map, form.doubles);
    const gl::Ref domain = c.GetMapiv(target, GL_DOMAIN, gl::out<GLint>(4));
    const gl::Ref coefficients = c.GetMapiv(target, GL_COEFF, gl::out<GLint>(expected.size()));
    Played played = t.play(c);
    played.expect_values(domain, std::vector<GLint>{-2, 2, 8, 0});
    played.expect_values(coefficients, expected);
  }
}

// Far beyond the ints, and where 32 bits without a sign or a float still hold the values.
EVALCTS_TESTS(GetMap2, IntegersSaturate, plain_targets(), GLenum target, must, "EV-GETMAP-SATURATE/2-D") {
  constexpr GLint kLeast = std::numeric_limits<GLint>::min(), kMost = std::numeric_limits<GLint>::max();
  const double values[] = {1e20, -1e20, 3e9, -3e9};
  std::vector<double> points;
  std::vector<GLint> expected;
  for (std::size_t i = 0; i < static_cast<std::size_t>(2 * 2 * gl::components_of(target)); ++i) {
    points.push_back(values[i % 4]);
    expected.push_back(i % 2 ? kLeast : kMost);
  }
  gl::Case c("1e20, -1e20, 3e9 and -3e9");
  Map2 map = make_map2(target, 2, 2, points);
  map.u1 = -3e9, map.u2 = 4e9, map.v1 = 2.5e9, map.v2 = -2.5e9;
  define(c, map);
  const gl::Ref coefficients = c.GetMapiv(target, GL_COEFF, gl::out<GLint>(expected.size()));
  const gl::Ref domain = c.GetMapiv(target, GL_DOMAIN, gl::out<GLint>(4));
  Played played = t.play(c);
  played.expect_values(coefficients, expected);
  played.expect_values(domain, std::vector<GLint>{kLeast, kMost, kMost, kLeast});
}

EVALCTS_TESTS(GetMap2, DisabledAndUndefined, gl::kMap2Targets, GLenum target, must,
              "EV-GETMAP-DISABLED/2-D") {
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
}

EVALCTS_TESTS(GetMap2, AnyTextureUnit, gl::kMap2Targets, GLenum target, must, "EV-GETMAP-NOUNIT/2-D") {
  t.require(1, 3, "GL_ARB_multitexture");
  if (t.gl().texture_units < 2) throw NotSupported("has one texture unit only");
  const Map2 map = random_map2(t, target, 3, 4);
  for (const int unit : {1, t.gl().texture_units - 1}) {
    gl::Case c(unit == 1 ? "TEXTURE1 active" : "the last unit active");
    define(c, map);
    c.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    const MapQuery query = query_map(c, target, t.max_order());
    const MapQuery real = query_map(c, target, t.max_order(), true);
    const gl::Ref error = c.GetError();
    Played played = t.play(c);
    played.expect_no_error(error);
    expect_map(played, query, map);
    expect_map(played, real, map, true);
  }
}

EVALCTS_TEST(GetMap2, ChangesNothing, must, "EV-GETMAP-NOSIDE/2-D") {
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
}

EVALCTS_TESTS(GetMap2, PackBufferIgnored, gl::kMap2Targets, GLenum target, must, "EV-GETMAP-NOPBO/2-D") {
  t.require(2, 1, "GL_ARB_pixel_buffer_object");
  const Map2 map = random_map2(t, target, 3, 4);
  gl::Case c("a buffer bound to PIXEL_PACK_BUFFER");
  define(c, map);
  const gl::ResultOf buffer{c.GenBuffers(1, gl::out<GLuint>(1)).index, 0};
  c.BindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
  c.BufferData(GL_PIXEL_PACK_BUFFER, 4096, std::vector<GLubyte>(4096, 0x5A), GL_STREAM_READ);
  const gl::Ref none = c.GetError();
  const MapQuery single = query_map(c, target, t.max_order());
  const MapQuery real = query_map(c, target, t.max_order(), true);
  const gl::Ref error = c.GetError();
  Played played = t.play(c);
  played.expect_no_error(none);
  played.expect_no_error(error);
  expect_map(played, single, map);
  expect_map(played, real, map, true);
}

}  // namespace evalcts::suite_get_map2
