// Section 17 of the requirements, the rules about particular values: the ends of domains, large and small
// magnitudes, and non-finite values. See unrelated_state.cpp for state that must not change results, and
// metamorphic.cpp for rules that relate maps.
#include <fmt/format.h>
#include <reference/map.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/hexadecimal.h>
#include <evalcts/testkit/registration.h>
#include "dimensions.h"
#include "maps.h"
#include "numeric.h"

namespace evalcts::suite_numeric {
std::vector<gl::Delivery> of_curves() {
  return gl::without(gl::kArrays | gl::kRepetition, gl::curve_deliveries());
}
std::vector<gl::Delivery> of_surfaces() {
  return gl::without(gl::kArrays | gl::kRepetition, gl::surface_deliveries());
}
std::vector<gl::Delivery> in_one_dimension() {
  std::vector<gl::Delivery> deliveries = of_curves();
  std::erase_if(deliveries, [](const gl::Delivery& delivery) { return delivery.lifted; });
  return deliveries;
}

namespace {

// A component of a vertex, with its name.
struct Value {
  std::string name;
  float value;
};
std::vector<Value> values_of(const ObservedVertex& vertex, Attributes attributes) {
  std::vector<Value> values;
  const auto add = [&](Attribute attribute, const char* name, const char* components, const auto& from) {
    if (!(attributes & attribute)) return;
    for (std::size_t i = 0; i < from.size(); ++i)
      values.push_back({fmt::format("{}.{}", name, components[i]), from[i]});
  };
  add(kPosition, "position", "xyzw", vertex.position);
  add(kColor, "color", "RGBA", vertex.color);
  add(kNormal, "normal", "xyz", vertex.normal);
  add(kTextureCoordinate0, "texture coordinate", "strq", vertex.texture_coordinate[0]);
  return values;
}

}  // namespace

bool same_bits(float a, float b) {
  return a == b || (std::isnan(a) && std::isnan(b));  // -0 counts as +0: not every capture keeps it
}

void fail(Test& t, const gl::Case& c, const std::string& what, const std::string& why, float expected,
          float got) {
  Failure failure;
  failure.case_identity = c.identity();
  failure.what = what;
  failure.expected = fmt::format("{:.9g} ({})", expected, hexadecimal(expected));
  failure.captured = fmt::format("{:.9g} ({})", got, hexadecimal(got));
  failure.message = fmt::format("{} is {}, {} {}", what, failure.captured, why, failure.expected);
  t.fail(std::move(failure), [&c] { return gl::all_calls(c); });
}

void expect_same(Test& t, const gl::Case& c, std::span<const ObservedVertex> expected,
                 std::span<const ObservedVertex> got, Attributes attributes, const std::string& why,
                 const std::function<std::string(std::size_t)>& name) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::vector<Value> was = values_of(expected[i], attributes), is = values_of(got[i], attributes);
    for (std::size_t k = 0; k < was.size(); ++k)
      if (!same_bits(was[k].value, is[k].value))
        fail(t, c, fmt::format("{} of {}", is[k].name, name(i)), why, was[k].value, is[k].value);
  }
}

void define_random(Test& t, gl::Case& c, const Kinds& kinds, int order, const Interval& domain) {
  for (const GLenum target : kinds.targets) {
    c.Enable(target);
    define(c, over(random_map(t, target, {order, order % 4 + 1}), domain, domain));
  }
}

void evaluate_at(gl::Case& c, bool two, double u) { eval_coord(c, two, u, u); }

// --- The ends --------------------------------------------------------------------------------------------

namespace {

EVALCTS_TEST_PAIR(Numeric.StartOfDomain, Numeric.EndOfDomain, kMust,
                  decide("EV-NUM-START/1-D", "EV-NUM-END/1-D"), by(of_curves()))
(Test& t, bool last) {
  gl::Case c(last ? "u2, every order" : "u1, every order");
  for (const Kinds& kinds : kKinds1)
    for (int order = 1; order <= t.max_order(); order += order < 8 || t.depth() != Depth::kQuick ? 1 : 5) {
      const Interval& domain = kDomains[static_cast<std::size_t>(order) % std::size(kDomains)];
      define_random(t, c, kinds, order, domain);
      c.Begin(GL_POINTS);
      evaluate(c, last ? domain.last : domain.first);
      c.End();
    }
  t.judge_vertices(c, kUnit0);
};

// The start of the domain gives the first control point, bit for bit.
EVALCTS_TEST_PAIR(Numeric.StartIsFirstPoint, Numeric.StartIsCorner, kQuality,
                  decide("EV-NUM-START/1-D", "EV-NUM-START/2-D"),
                  [](bool two) { return by(two ? of_surfaces() : in_one_dimension()); })
(Test& t, bool two) {
  gl::Case c("u1 of each domain");
  std::vector<ObservedVertex> expected;
  for (const Kinds& kinds : kinds_of(two))
    for (const Interval& domain : kDomains)
      for (const int order : {1, 2, 3, 4, 7, t.max_order()}) {
        ObservedVertex vertex;
        vertex.position[3] = vertex.texture_coordinate[0][3] = 1;
        for (const GLenum target : kinds.targets) {
          const Map map = over(random_map(t, target, {order, 3}), domain, domain);
          define_and_enable(c, map);
          const Attributes attribute = attribute_of(target);
          float* first = attribute == kPosition ? vertex.position.data()
                         : attribute == kColor  ? vertex.color.data()
                         : attribute == kNormal ? vertex.normal.data()
                                                : vertex.texture_coordinate[0].data();
          for (std::size_t k = 0; k < static_cast<std::size_t>(gl::components_of(target)); ++k)
            first[k] = static_cast<float>(map.points[k]);
        }
        c.Begin(GL_POINTS);
        evaluate_at(c, two, domain.first);
        c.End();
        expected.push_back(vertex);
      }
  const Attributes shown = t.shown_exactly(kUnit0);
  const Observation seen = t.observe(c, shown, expected.size() + 8);
  const std::vector<ObservedVertex> got = vertices_of(seen, expected.size());
  const Attributes compared = seen.clamped_colors ? shown & ~static_cast<Attributes>(kColor) : shown;
  const auto require_near = [&](Attribute attribute, const auto& values, const auto& right) {
    const auto is_near = [](float a, float b) {
      return std::abs(a - b) <= 0.01f * std::max(1.0f, std::abs(b));
    };
    if ((compared & attribute) && !std::ranges::equal(values, right, is_near))
      throw NotObservable("values at the start of a domain are wrong altogether, which other tests report");
  };
  for (std::size_t i = 0; i < std::min(got.size(), expected.size()); ++i) {
    require_near(kPosition, got[i].position, expected[i].position);
    require_near(kColor, got[i].color, expected[i].color);
    require_near(kNormal, got[i].normal, expected[i].normal);
    require_near(kTextureCoordinate0, got[i].texture_coordinate[0], expected[i].texture_coordinate[0]);
  }
  expect_same(t, c, expected, got, compared, "the first control point is",
              [](std::size_t i) { return fmt::format("vertex {}", i); });
};

// --- Magnitudes ------------------------------------------------------------------------------------------

double largest(Test& t, GLenum target) {
  return std::ldexp(1.0, reference::guaranteed_range(target, t.gl().version_number()));
}

// Returns control points up to the largest magnitude that GL guarantees for the target, which is among them
// with both signs.
std::vector<double> large_points(Test& t, GLenum target, int order) {
  std::vector<double> points =
      random_values(t.random(), static_cast<std::size_t>(order * gl::components_of(target)));
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = (i % 3 == 1 ? (i % 2 ? 1 : -1) : points[i]) * largest(t, target);
  return points;
}

void judge_large_points(Test& t, const std::vector<GLenum>& curve_targets) {
  for (const Form& form : existing_forms(t)) {
    gl::Case c(fmt::format("form {}", form.name));
    for (const GLenum target : curve_targets) {
      const GLenum namesake = target_in(kSurfaces, target);
      for (const Map& map : {make_map1(target, large_points(t, target, 4)),
                             make_map2(namesake, 2, 3, large_points(t, namesake, 6))}) {
        define(c, map, form.doubles);
        query_map(t, c, map.target, form.doubles);
      }
    }
    t.judge(c);
  }
}

const std::vector<GLenum> kNotColors = {
    GL_MAP1_VERTEX_3,        GL_MAP1_VERTEX_4,        GL_MAP1_NORMAL,         GL_MAP1_TEXTURE_COORD_1,
    GL_MAP1_TEXTURE_COORD_2, GL_MAP1_TEXTURE_COORD_3, GL_MAP1_TEXTURE_COORD_4};

EVALCTS_TEST(Numeric, LargePoints, kMust, "EV-NUM-RANGE-POS/1-D", "EV-NUM-RANGE-COLOR/1-D", by(of_curves()))
(Test& t) {
  gl::Case c("points up to the largest of each target");
  for (const Kinds& kinds : kKinds1)
    for (const int order : {1, 2, 3, 4, 7, 12}) {
      if (order > t.max_order()) continue;
      for (const GLenum target : kinds.targets)
        define_and_enable(c, make_map1(target, large_points(t, target, order)));
      c.Begin(GL_POINTS);
      for (const double u : {0.0, 0.25, 0.7, 0.9375, 1.0}) evaluate(c, static_cast<float>(u));
      c.End();
    }
  t.judge_vertices(c, kUnit0);
};
EVALCTS_TEST(Numeric, LargePointsKept, kMust, "EV-NUM-RANGE-POS/1-D", "EV-NUM-RANGE-POS/2-D", by(in_lists()))
(Test& t) { judge_large_points(t, kNotColors); };
EVALCTS_TEST(Numeric, LargeColorsKept, kMust, "EV-NUM-RANGE-COLOR/1-D", "EV-NUM-RANGE-COLOR/2-D",
             by(in_lists()))
(Test& t) { judge_large_points(t, {GL_MAP1_COLOR_4}); };

// Domains and arguments up to 2^32.
EVALCTS_TEST(Numeric, LargeDomain, kMust, "EV-NUM-RANGE-POS/1-D", by(of_curves()))
(Test& t) {
  gl::Case c("domains up to 2^32");
  for (const Kinds& kinds : kKinds1)
    for (const Interval& domain : {Interval{0, 0x1p32}, {-0x1p32, 0x1p32}, {0x1p31, 0x1p32}, {-0x1p32, 1}})
      for (const int order : {2, 4, 7}) {
        define_random(t, c, kinds, order, domain);
        c.Begin(GL_POINTS);
        for (const double x : {0.0, 0.25, 0.7, 1.0})
          evaluate(c, static_cast<float>(domain.first + (domain.last - domain.first) * x));
        c.End();
      }
  t.judge_vertices(c, kUnit0);
};

// Negative zero, subnormal numbers and the least normal numbers as arguments and points; negative zero also
// as an end of the domain.
EVALCTS_TEST(Numeric, DenormalsAndNegativeZero, kMust, "EV-NUM-DENORMAL/1-D", by(of_curves()))
(Test& t) {
  constexpr double kSmall[] = {-0.0, 0x1p-149, -0x1p-149, 0x1p-130, -0x1.8p-127, 0x1p-126, -0x1p-126};
  gl::Case c("arguments and points");
  for (const Kinds& kinds : kKinds1)
    for (const Interval& domain : {Interval{0, 1}, {-0.0, 2}, {-1, 3}, {1, -0.0}})
      for (const int order : {1, 2, 4, 8}) {
        for (const GLenum target : kinds.targets) {
          Map map = over(random_map(t, target, order), domain);
          // One of the domains gets such values only, the others in every second place.
          for (std::size_t i = 0; i < map.points.size(); ++i)
            if (domain.last == 3 || i % 2) map.points[i] = kSmall[i % std::size(kSmall)];
          define_and_enable(c, map);
        }
        c.Begin(GL_POINTS);
        for (const double u : kSmall) evaluate(c, u);
        evaluate(c, domain.last);
        evaluate(c, 0.5);
        c.End();
      }
  t.judge_vertices(c, kUnit0);
};

EVALCTS_TEST_PAIR(Numeric.NegativeZeroIsZero1, Numeric.NegativeZeroIsZero2, kQuality,
                  decide("EV-NUM-DENORMAL/1-D", "EV-NUM-DENORMAL/2-D"), by(in_lists()))
(Test& t, bool two) {
  for (const Kinds& kinds : kinds_of(two)) {
    gl::Case c(fmt::format("{}: u = -0, u = 0", kinds.name));
    std::size_t count = 0;
    for (const Interval& domain : {Interval{0, 1}, {-1, 3}, {0.1f, 0.7f}, {1, 0}})
      for (const int order : {2, 4, t.max_order()}) {
        define_random(t, c, kinds, order, domain);
        c.Begin(GL_POINTS);
        evaluate_at(c, two, 0.0);
        evaluate_at(c, two, -0.0);
        c.End();
        count += 2;
      }
    const Attributes shown = t.shown_exactly(kUnit0);
    const std::vector<ObservedVertex> seen = vertices_of(t.observe(c, shown, count + 8), count);
    for (std::size_t i = 0; i < count; i += 2)
      expect_same(t, c, {&seen[i], 1}, {&seen[i + 1], 1}, shown, "at u = 0 it was",
                  [&](std::size_t) { return fmt::format("vertex {} (u = -0)", i + 1); });
  }
};

// --- Non-finite values -----------------------------------------------------------------------------------

// Values that are not finite in single precision; the last one is finite in double precision.
constexpr double kSpecials[] = {kNaN, kInfinity, -kInfinity, 1e300};

// Modes of the meshes to draw. A test with a capture uses one mode, because a capture sees one kind of
// primitive.
using Modes = std::vector<GLenum>;

struct Special {
  const char* name;
  // Passes the value to GL commands of the form (`doubles`) and draws with it.
  void (*feed)(Test& t, gl::Case& c, bool two, bool doubles, double value, const Modes& modes);
};

void draw_with_maps(gl::Case& c, bool two, bool doubles, const Modes& modes) {
  evaluate_all(c, two, {{0, 0.25}, {0.5, 0.25}, {1, 0.25}}, doubles);
  for (const GLenum mode : modes)
    if (two || mode != GL_FILL) eval_mesh(c, two, mode, two ? 0 : -1, two ? 2 : 3, -1, 2);
}

void feed_argument(Test&, gl::Case& c, bool two, bool doubles, double value, const Modes&) {
  c.Begin(GL_POINTS);
  eval_coord(c, two, value, 0.5, doubles);
  if (two) evaluate2(c, 0.5, value, doubles);
  eval_coord_vector(c, two, value, value, doubles);
  c.End();
}

void feed_points(Test& t, gl::Case& c, bool two, bool doubles, double value, const Modes& modes) {
  for (const GLenum target : kinds_of(two)[1].targets) {
    Map map = random_map(t, target, two ? Orders{3, 4} : Orders{4});
    map.points[0] = map.points[5] = map.points.back() = value;
    define(c, map, doubles);
    draw_with_maps(c, two, doubles, modes);
  }
}

// Returns intervals with the value at one end or at both.
std::vector<Interval> intervals_with(double value) {
  return {{value, 1}, {0, value}, {value, value}, {value, -value}};
}

void feed_domain(Test& t, gl::Case& c, bool two, bool doubles, double value, const Modes& modes) {
  for (const Interval& domain : intervals_with(value))
    for (const GLenum target : kinds_of(two)[1].targets) {
      define(c, over(random_map(t, target, two ? Orders{3, 4} : Orders{4}), domain), doubles);
      if (two) define(c, over(random_map(t, target, {3, 4}), {0, 1}, domain), doubles);
      draw_with_maps(c, two, doubles, modes);
    }
}

void feed_grid(Test&, gl::Case& c, bool two, bool doubles, double value, const Modes& modes) {
  for (const Interval& ends : intervals_with(value)) {
    if (two && doubles) {
      c.MapGrid2d(2, ends.first, ends.last, 3, 0, 1);
      c.MapGrid2d(2, 0, 1, 3, ends.first, ends.last);
    } else if (two) {
      c.MapGrid2f(2, ends.first, ends.last, 3, 0, 1);
      c.MapGrid2f(2, 0, 1, 3, ends.first, ends.last);
    } else if (doubles) {
      c.MapGrid1d(3, ends.first, ends.last);
    } else {
      c.MapGrid1f(3, ends.first, ends.last);
    }
    draw_with_maps(c, two, doubles, modes);
    c.Begin(GL_POINTS);
    for (const int i : {0, 1, 2, 5}) eval_point(c, two, i, 1);
    c.End();
  }
}

constexpr Special kFeeds[] = {
    {"ARGUMENT", feed_argument}, {"POINTS", feed_points}, {"DOMAIN", feed_domain}, {"GRID", feed_grid}};

// Draws points of finite maps and grids by EvalCoord, EvalPoint and EvalMesh. Returns the number of points.
std::size_t draw_finite(gl::Case& c, bool two, const std::vector<Map>& maps) {
  for (const Map& map : maps) define(c, map);
  map_grid(c, two, {3, 0, 1}, {2, 1, 0.5f});
  c.Begin(GL_POINTS);
  for (int i = 0; i <= 3; ++i) {
    eval_coord(c, two, i / 4.0, 0.25);
    eval_point(c, two, i, 1);
  }
  c.End();
  eval_mesh(c, two, GL_POINT, 0, 3, 0, 2);
  return 8 + (two ? 12 : 4);
}

// Non-finite values must not affect later drawing.
EVALCTS_TEST_PAIR(Numeric.ResultsAfterSpecials1, Numeric.ResultsAfterSpecials2, kMust,
                  decide("EV-NUM-SPECIAL-SAFE/1-D", "EV-NUM-SPECIAL-SAFE/2-D"),
                  combine(kFeeds).by(in_lists()))
(Test& t, bool two, const Special& special) {
  const Kinds& kinds = kinds_of(two)[1];
  // Before the non-finite values other maps are drawn, so that those drawn afterwards are defined afterwards
  // too.
  std::vector<Map> maps, maps_before;
  for (const GLenum target : kinds.targets) {
    maps.push_back(random_map(t, target, {4, 3}));
    maps_before.push_back(random_map(t, target, two ? Orders{2, 5} : Orders{6}));
  }
  const auto begin = [&](gl::Case& c) {
    for (const GLenum target : kinds.targets) c.Enable(target);
    return draw_finite(c, two, maps_before);
  };
  gl::Case clean("finite values only");
  const std::size_t before = begin(clean);
  const std::size_t count = draw_finite(clean, two, maps);
  const Attributes shown = t.shown_exactly(kUnit0);
  const std::vector<ObservedVertex> expected =
      vertices_of(t.observe(clean, shown, before + count + 8), before + count);

  gl::Case c("NaN, infinity and overflow");
  begin(c);
  for (const double value : kSpecials)
    for (const Form& form : kForms) {
      gl::Case part;
      special.feed(t, part, two, form.doubles, value, {GL_POINT});
      if (!missing_command(t, part)) c.append(part);
    }
  c.GetError();  // it is unspecified if such a domain is an error (U-NAN-DOMAIN)
  draw_finite(c, two, maps);
  const std::vector<ObservedVertex> got = vertices_of(t.observe(c, shown, 20000));
  if (got.size() < count) {
    fail(t, c, "the number of vertices", "expected at least", static_cast<float>(count),
         static_cast<float>(got.size()));
    return;
  }
  expect_same(t, c, std::span(expected).last(count), std::span(got).last(count), shown,
              "without non-finite values it is",
              [&](std::size_t i) { return fmt::format("vertex {} of those drawn afterwards", i); });
};

// Non-finite values in meshes of all modes crash nothing and do not affect other maps and enables, and maps
// can be defined afterwards. The specification cannot judge this test, because no document says whether a
// domain of NaN is an error (U-NAN-DOMAIN).
EVALCTS_TEST_PAIR(Numeric.StateAfterSpecials1, Numeric.StateAfterSpecials2, kMust,
                  decide("EV-NUM-SPECIAL-SAFE/1-D", "EV-NUM-SPECIAL-SAFE/2-D"),
                  combine(kFeeds).by(in_lists()))
(Test& t, bool two, const Special& special) {
  const Kinds& kinds = kinds_of(two)[1];
  gl::Case c("NaN, infinity and overflow");
  const Map others[] = {random_map(t, GL_MAP1_TEXTURE_COORD_1, 5),
                        random_map(t, GL_MAP2_TEXTURE_COORD_1, {3, 2})};
  for (const Map& other : others) define(c, other);
  for (const GLenum target : kinds.targets) c.Enable(target);
  c.Enable(GL_AUTO_NORMAL);
  for (const double value : kSpecials)
    for (const Form& form : kForms) {
      gl::Case part;
      define_random(t, part, kinds, 4, {0, 1});
      special.feed(t, part, two, form.doubles, value, {GL_POINT, GL_LINE, GL_FILL});
      if (!missing_command(t, part)) c.append(part);
    }
  c.GetError();  // U-NAN-DOMAIN
  const auto query = [&](const Map& map) { return query_map(t, c, map.target); };
  std::array<MapQuery, 2> queries, new_queries;
  std::ranges::transform(others, queries.begin(), query);
  const gl::Ref enabled = c.IsEnabled(kinds.targets[0]);
  // A new definition works again.
  const Map maps[] = {random_map(t, GL_MAP1_VERTEX_4, 4), random_map(t, GL_MAP2_VERTEX_4, {3, 4})};
  for (const Map& map : maps) define(c, map);
  const gl::Ref error = c.GetError();
  std::ranges::transform(maps, new_queries.begin(), query);
  CheckedTrace checked = t.play(c);
  for (std::size_t i = 0; i < queries.size(); ++i) expect_map(checked, queries[i], others[i]);
  checked.expect_result(enabled, GL_TRUE);
  checked.expect_no_error(error);
  for (std::size_t i = 0; i < queries.size(); ++i) expect_map(checked, new_queries[i], maps[i]);
};

}  // namespace
}  // namespace evalcts::suite_numeric
