// Section 3 of the requirements, the values: what a one-dimensional map evaluates to. Each case holds many
// values; each is judged against the exact one by the acceptance interval.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "maps.h"

namespace evalcts::suite_map1_values {
namespace {

struct Domain {
  double u1, u2;
};

// A map of the order with random points over the domain.
Map1 random_map(Test& t, GLenum target, int order, Domain domain) {
  Map1 map = random_map(t, target, order);
  map.u1 = domain.u1;
  map.u2 = domain.u2;
  return map;
}

// Points: the ends, what is next to them, and values in between.
std::vector<double> arguments(Test& t, Domain domain, int count) {
  const auto u1 = static_cast<float>(domain.u1), u2 = static_cast<float>(domain.u2);
  std::vector<double> us = {u1, u2, std::nextafter(u1, u2), std::nextafter(u2, u1), (u1 + u2) / 2};
  for (const double value : random_values(t.random(), static_cast<std::size_t>(std::max(0, count - 5))))
    us.push_back(static_cast<float>(u1 + (u2 - u1) * std::abs(value)));
  return us;
}

void evaluate_all(gl::Case& c, const std::vector<double>& us) {
  c.Begin(GL_POINTS);
  for (const double u : us) evaluate(c, u);
  c.End();
}

}  // namespace

// All orders of one target in one case: the map is defined anew before each Begin.
EVALCTS_DELIVERED_TESTS(Map1Values, AllOrders, visible_targets(), GLenum target, must, "EV-MAP1-BEZIER",
                        "EV-NUM-ACCURACY/1-D") {
  gl::Case c(fmt::format("orders 1 to MAX, {} form" ? "d" : "f"));
  enable_visibly(c, target);
  for (int order = 1; order <= t.max_order(); ++order) {
    define(c, random_map(t, target, order));
    evaluate_all(c, arguments(t, {0, 1}, t.by_depth(8, order <= 32 ? 32 : 8, 400)));
  }
  t.expect_emission(c, attribute_of(target));
}

// Data on which terms cancel: alternating signs, steep steps, near-linear points, large offsets.
EVALCTS_DELIVERED_TESTS(Map1Values, AwkwardData, visible_targets(), GLenum target, must, "EV-MAP1-BEZIER",
                        "EV-NUM-ACCURACY/1-D") {
  gl::Case c("alternating, step, line, offset, one spike");
  enable_visibly(c, target);
  const int k = gl::components_of(target);
  for (const int order : {2, 3, 4, 5, 8, t.max_order()}) {
    for (int kind = 0; kind < 5; ++kind) {
      std::vector<double> points;
      for (int i = 0; i < order; ++i)
        for (int component = 0; component < k; ++component) {
          const double sign = (i + component) % 2 ? -1 : 1;
          const double values[] = {sign, 2 * i < order ? 1.0 : -1.0, i + 0.5 * component, 512 + sign * 0.25,
                                   i == order / 2 ? 1.0 + component : 0.0};
          points.push_back(values[kind]);
        }
      define(c, make_map1(target, points));
      evaluate_all(c, arguments(t, {0, 1}, t.by_depth(6, 12, 60)));
    }
  }
  t.expect_emission(c, attribute_of(target));
}

// At uh = 0 and uh = 1 all powers but one are 0^0: other points, however large, do not show.
EVALCTS_DELIVERED_TESTS(Map1Values, Ends, visible_targets(), GLenum target, must, "EV-MAP1-ZEROPOW") {
  gl::Case c("first and last point among points near the largest that the GL promises to hold");
  enable_visibly(c, target);
  const auto k = static_cast<std::size_t>(gl::components_of(target));
  const double large = target == GL_MAP1_COLOR_4 ? 0x1p9 : 0x1p30;
  for (int order = 1; order <= t.max_order(); ++order) {
    std::vector<double> points(static_cast<std::size_t>(order) * k, large);
    for (std::size_t component = 0; component < k; ++component) {
      points[component] = 0.5 + static_cast<double>(component);
      points[points.size() - k + component] = -0.25 - static_cast<double>(component);
    }
    for (const Domain domain : {Domain{0, 1}, Domain{2, 5}, Domain{1, -3}}) {
      define(c, make_map1(target, domain.u1, domain.u2, static_cast<int>(k), points));
      evaluate_all(c, {domain.u1, domain.u2});
    }
  }
  t.expect_emission(c, attribute_of(target));
}

namespace {

struct NamedDomain {
  const char* name;
  double u1, u2;
};
constexpr NamedDomain kDomains[] = {
    {"UNIT", 0, 1},          {"SHIFTED", 2, 5},   {"NEGATIVE", -3, -1},       {"FAR", 1e3, 1e3 + 8},
    {"ACROSS_ZERO", -1, 2},  {"WIDE", -1e6, 3e6}, {"NARROW", 1, 1 + 0x1p-16}, {"TINY", 0, 0x1p-50},
    {"AWKWARD", 0.1f, 0.7f}, {"SYMMETRIC", -2, 2}};
constexpr NamedDomain kReversedDomains[] = {{"1_TO_0", 1, 0}, {"5_TO_-2", 5, -2}, {"-1_TO_-3", -1, -3}};

void expect_over_domain(Test& t, const NamedDomain& named) {
  const Domain domain{named.u1, named.u2};
  // All kinds of data in one primitive: each attribute has a map of its own.
  using Pair = std::pair<GLenum, GLenum>;
  for (const auto& [vertex, texture] :
       {Pair{GL_MAP1_VERTEX_3, GL_MAP1_TEXTURE_COORD_3}, Pair{GL_MAP1_VERTEX_4, GL_MAP1_TEXTURE_COORD_4}}) {
    const std::array<GLenum, 4> targets = {vertex, GL_MAP1_COLOR_4, GL_MAP1_NORMAL, texture};
    gl::Case c(fmt::format("{}, COLOR_4, NORMAL and {}", label(vertex), label(texture)));
    for (const GLenum target : targets) c.Enable(target);
    for (const int order : {1, 2, 3, 4, 6, 8, 20}) {
      if (order > t.max_order()) continue;
      for (const GLenum target : targets) define(c, random_map(t, target, order, domain));
      evaluate_all(c, arguments(t, domain, t.by_depth(6, 12, 200)));
    }
    t.expect_emission(c, kPosition | kTextureCoordinate0);
  }
}

}  // namespace

EVALCTS_DELIVERED_TESTS(Map1Values, Domain, kDomains, const NamedDomain& domain, must, "EV-MAP1-DOMAIN") {
  expect_over_domain(t, domain);
}

// Where all points but the first few are far from zero what is next to the first end tells how exactly the
// argument is taken apart.
EVALCTS_DELIVERED_TESTS(Map1Values, NextToTheFirstEnd, visible_targets(), GLenum target, must,
                        "EV-MAP1-DOMAIN") {
  gl::Case c("ramps that begin with zero");
  enable_visibly(c, target);
  const auto k = static_cast<std::size_t>(gl::components_of(target));
  for (const Domain domain : {Domain{1e3, 1e3 + 8}, {1, 1 + 0x1p-16}, {-77, -76.5}, {5, 4.75}, {0.1f, 0.7f}})
    for (const int order : {2, 3}) {
      std::vector<double> points(static_cast<std::size_t>(order) * k);
      for (std::size_t i = k; i < points.size(); ++i) points[i] = points[i - k] + 1;
      define(c, make_map1(target, domain.u1, domain.u2, static_cast<int>(k), points));
      std::vector<double> us;
      auto u = static_cast<float>(domain.u1);
      const auto towards = static_cast<float>(domain.u2);
      for (int i = 0; i < 4; ++i) us.push_back(u = std::nextafter(u, towards));
      evaluate_all(c, us);
    }
  t.expect_emission(c, attribute_of(target));
}

// Each of the maps that make one vertex has a domain of its own.
EVALCTS_DELIVERED_TEST(Map1Values, OwnDomains, must, "EV-MAP1-DOMAIN") {
  constexpr Domain kOwn[] = {{0, 1}, {-1, 2}, {1.5, -0.5}, {0.25, 4.25}};
  gl::Case c("vertex, colour, normal and texture maps over four domains, exchanged four times");
  for (const Kinds& kinds : kKinds1) {
    for (const GLenum target : kinds.targets) c.Enable(target);
    for (std::size_t round = 0; round < 4; ++round) {
      for (std::size_t i = 0; i < 4; ++i)
        define(c, random_map(t, kinds.targets[i], 4, kOwn[(i + round) % 4]));
      evaluate_all(c, arguments(t, {0, 1}, t.by_depth(6, 8, 60)));
    }
  }
  t.expect_emission(c, kPosition | kColor | kNormal | kTextureCoordinate0);
}

EVALCTS_DELIVERED_TESTS(Map1Values, ReversedDomain, kReversedDomains, const NamedDomain& domain, must,
                        "EV-MAP1-REVERSED") {
  expect_over_domain(t, domain);
}

EVALCTS_DELIVERED_TESTS(Map1Values, OutsideDomain, visible_targets(), GLenum target, must,
                        "EV-MAP1-EXTRAPOLATE", "EV-NUM-ACCURACY/1-D") {
  gl::Case c("every order, to the left and to the right of the domain");
  enable_visibly(c, target);
  for (const Domain domain : {Domain{0, 1}, Domain{2, 5}, Domain{1, 0}}) {
    for (int order = 2; order <= t.max_order(); ++order) {
      define(c, random_map(t, target, order, domain));
      std::vector<double> us;
      for (const double t_outside : {-1.5, 2.5, -0.001, 1.001, -3.0, 4.0, -0.125, 1.125}) {
        // High orders are judged near the domain only: further out the GL promises no range.
        if (order > 8 && std::abs(t_outside - 0.5) > 0.7) continue;
        us.push_back(static_cast<float>(domain.u1 + (domain.u2 - domain.u1) * t_outside));
      }
      evaluate_all(c, us);
    }
  }
  t.expect_emission(c, attribute_of(target));
}

// So far that powers of the argument leave the usual range of magnitudes; the results do not.
EVALCTS_DELIVERED_TESTS(Map1Values, FarOutsideDomain, visible_targets(), GLenum target, must,
                        "EV-MAP1-EXTRAPOLATE", "EV-NUM-ACCURACY/1-D") {
  gl::Case c("2^15 to 2^20 widths of the domain away");
  enable_visibly(c, target);
  for (const Domain domain : {Domain{0, 1}, {3, 1}})
    for (const int order : {2, 3, 4}) {
      Map1 map = random_map(t, target, order, domain);
      for (double& value : map.points) value = std::ldexp(value, -20 * (order - 1) + 6);
      define(c, map);
      std::vector<double> us;
      for (const double widths : {0x1p15, -0x1.5p16, 0x1.3p17, -0x1p18, 0x1.8p20})
        us.push_back(static_cast<float>(domain.u1 + (domain.u2 - domain.u1) * widths));
      evaluate_all(c, us);
    }
  t.expect_emission(c, attribute_of(target));
}

EVALCTS_DELIVERED_TESTS(Map1Values, OrderOneIsConstant, visible_targets(), GLenum target, must,
                        "EV-MAP1-ORDER-ONE") {
  gl::Case c("one point, arguments in and outside the domain");
  enable_visibly(c, target);
  for (const int stride : {4, 9}) {
    Map1 map = random_map(t, target, 1, {2, 5});
    map = make_map1(target, 2, 5, stride, map.coefficients());
    define(c, map);
    const gl::Ref unused = c.GetError();
    static_cast<void>(unused);
    evaluate_all(c, {2, 5, 3.3, -7, 100});
  }
  t.expect_emission(c, attribute_of(target));
}

// Values that differ in every component, so that no permutation of them goes unseen.
EVALCTS_DELIVERED_TESTS(Map1Values, ComponentOrder, visible_targets(), GLenum target, must,
                        "EV-MAP1-COMPORDER") {
  gl::Case c("components 1/8, 3/8, 5/8, 7/8");
  const auto k = static_cast<std::size_t>(gl::components_of(target));
  std::vector<double> points;
  for (int i = 0; i < 2; ++i)
    for (std::size_t component = 0; component < k; ++component)
      points.push_back((2.0 * static_cast<double>(component) + 1) / 8);
  define(c, make_map1(target, points));
  enable_visibly(c, target);
  evaluate_all(c, {0, 0.5, 1});
  t.expect_emission(c, attribute_of(target));
}

EVALCTS_DELIVERED_TESTS(Map1Values, Stride, visible_targets(), GLenum target, must, "EV-MAP1-STRIDE",
                        "EV-MAP1-PADDING") {
  gl::Case c("strides k, k+1, 2k, 17 with poisoned padding");
  enable_visibly(c, target);
  const int k = gl::components_of(target);
  for (const int stride : {k, k + 1, 2 * k, 17, 257})
    for (const int order : {1, 2, 5}) {
      const Map1 tight = random_map(t, target, order);
      define(c, make_map1(target, 0, 1, stride, tight.coefficients()));
      evaluate_all(c, {0, 0.25, 0.625, 1});
    }
  t.expect_emission(c, attribute_of(target));
}

EVALCTS_DELIVERED_TESTS(Map1Values, PaddingNaN, visible_targets(), GLenum target, must, "EV-MAP1-PADDING") {
  gl::Case c("padding of NaN and infinity");
  enable_visibly(c, target);
  const int k = gl::components_of(target);
  for (const double padding : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    const Map1 tight = random_map(t, target, 4);
    Map1 map = make_map1(target, 0, 1, k + 3, tight.coefficients());
    for (double& value : map.points)
      if (value == kPoison) value = padding;
    define(c, map);
    evaluate_all(c, {0, 0.25, 0.625, 1});
  }
  t.expect_emission(c, attribute_of(target));
}

namespace {

// Every order; at quick depth those up to 10, a few between, and the largest.
int step(Test& t, int order) {
  return order < 10 || t.depth() != Depth::quick ? 1 : std::max(1, std::min(9, t.max_order() - order));
}

// The cross-check that gives a library its accuracy figures: every order, values spread over the domain and
// crowded at its ends, ordinary and cancelling data. One case, so that a library compiles its shaders once.
void measure(Test& t, GLenum target, int values_per_map) {
  const int k = gl::components_of(target);
  gl::Case c("every order, random and alternating points");
  enable_visibly(c, target);
  for (int order = 1; order <= t.max_order(); order += step(t, order)) {
    for (int kind = 0; kind < 2; ++kind) {
      std::vector<double> points = random_values(t.random(), static_cast<std::size_t>(order * k));
      if (kind == 1)
        for (std::size_t i = 0; i < points.size(); ++i)
          points[i] = std::abs(points[i]) * (i / static_cast<std::size_t>(k) % 2 ? -1 : 1);
      define(c, make_map1(target, points));
      std::vector<double> us;
      // The exact route slows down with the order: fewer values beyond those that libraries offer.
      const int count = order <= 32 ? values_per_map : values_per_map / 4;
      for (const double value : random_values(t.random(), static_cast<std::size_t>(count)))
        us.push_back(std::abs(value));
      for (int i = 1; i < 20; i += 6) {
        us.push_back(std::ldexp(1.0, -i));
        us.push_back(1 - std::ldexp(1.0, -i));
      }
      evaluate_all(c, us);
    }
  }
  t.expect_emission(c, attribute_of(target));
}

}  // namespace

// One test to fail where a result leaves the acceptance interval ...
EVALCTS_TESTS(Map1Accuracy, Acceptable, visible_targets(), GLenum target, must, "EV-NUM-ACCURACY/1-D") {
  measure(t, target, t.by_depth(20, 40, 2000));
}

// ... and one to warn where it is worse than good single precision.
EVALCTS_TESTS(Map1Accuracy, GoodSinglePrecision, visible_targets(), GLenum target, quality,
              "EV-NUM-ACCURACY/1-D") {
  measure(t, target, t.by_depth(4, 4, 1000));
}

// ... also next to an end of the domain, where one of t and s is small and may not be what rounding the other
// one left of it: the point there is 0, so that nothing hides the error.
EVALCTS_TESTS(Map1Accuracy, GoodNearTheEnds, visible_targets(), GLenum target, quality,
              "EV-NUM-ACCURACY/1-D") {
  const auto k = static_cast<std::size_t>(gl::components_of(target));
  gl::Case c("the numbers next to each end");
  enable_visibly(c, target);
  for (const Domain domain : {Domain{0.1f, 0.7f}, {2, 5}, {-3, -1}, {1e3, 1e3 + 7}, {5, -2}})
    for (const int order : {2, 3, 4, 7})
      for (const bool last : {false, true}) {
        Map1 map = random_map(t, target, order, domain);
        std::fill_n(last ? map.points.end() - static_cast<std::ptrdiff_t>(k) : map.points.begin(), k, 0.0);
        define(c, map);
        const auto end = static_cast<float>(last ? domain.u2 : domain.u1);
        const auto other = static_cast<float>(last ? domain.u1 : domain.u2);
        std::vector<double> us = {std::nextafter(end, other)};
        for (const float part : {0x1p-20f, 0x1p-16f, 0x1p-12f, 0x1p-8f})
          us.push_back(end + (other - end) * part);
        evaluate_all(c, us);
      }
  t.expect_emission(c, attribute_of(target));
}

}  // namespace evalcts::suite_map1_values
