// Sections 3 and 4 of the requirements, the values of maps. Each case has many values, which the acceptance
// intervals judge. The two-dimensional nets vary in both directions, because the one-dimensional tests are
// lifted to nets that are constant in one direction.
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include <evalcts/testkit/registration.h>

#include "maps.h"

namespace evalcts::suite_map_values {

EVALCTS_LIFTED_SUITE(Map1Values, Map2Values);

// --- One-dimensional maps --------------------------------------------------------------------------------

const auto kEachTarget = combine(visible_targets(kCurves)).by(gl::curve_deliveries());

// All orders of one target are in one case, which redefines the map before each Begin.
EVALCTS_TEST(Map1Values, AllOrders, kMust, "EV-MAP1-BEZIER", "EV-NUM-ACCURACY/1-D", kEachTarget)
(Test& t, GLenum target) {
  gl::Case c("orders 1 to the largest");
  enable_visibly(c, target);
  for (int order = 1; order <= t.max_order(); ++order) {
    define(c, random_map(t, target, order));
    evaluate_all(c, arguments(t, {0, 1}, t.by_depth(8, order <= 32 ? 32 : 8, 400)));
  }
  t.judge_vertices(c, attribute_of(target));
};

// Points whose terms cancel: alternating signs, steps, lines, large offsets; and a single nonzero point.
EVALCTS_TEST(Map1Values, AwkwardData, kMust, "EV-MAP1-BEZIER", "EV-NUM-ACCURACY/1-D", kEachTarget)
(Test& t, GLenum target) {
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
  t.judge_vertices(c, attribute_of(target));
};

// At the ends of the domain only the first or the last point has an influence, because 0^0 is 1 and the other
// basis functions are 0, however large the other points are.
EVALCTS_TEST(Map1Values, Ends, kMust, "EV-MAP1-ZEROPOW", kEachTarget)
(Test& t, GLenum target) {
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
    for (const Interval domain : {Interval{0, 1}, Interval{2, 5}, Interval{1, -3}}) {
      define(c, over(make_map1(target, points), domain));
      evaluate_all(c, {domain.first, domain.last});
    }
  }
  t.judge_vertices(c, attribute_of(target));
};

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
  const Interval domain = {named.u1, named.u2};
  for (const auto& [name, targets] : kKinds1) {
    gl::Case c(fmt::format("{}, COLOR_4, NORMAL and {}", label(targets[0]), label(targets[3])));
    for (const GLenum target : targets) c.Enable(target);
    for (const int order : {1, 2, 3, 4, 6, 8, 20}) {
      if (order > t.max_order()) continue;
      for (const GLenum target : targets) define(c, over(random_map(t, target, order), domain));
      evaluate_all(c, arguments(t, domain, t.by_depth(6, 12, 200)));
    }
    t.judge_vertices(c, kPosition | kTextureCoordinate0);
  }
}

EVALCTS_TEST(Map1Values, Domain, kMust, "EV-MAP1-DOMAIN", combine(kDomains).by(gl::curve_deliveries()))
(Test& t, const NamedDomain& domain) { expect_over_domain(t, domain); };

// The first point is 0, so that values at the floats next to the first end show how accurately an
// implementation maps the argument to [0,1].
EVALCTS_TEST(Map1Values, NextToTheFirstEnd, kMust, "EV-MAP1-DOMAIN", kEachTarget)
(Test& t, GLenum target) {
  gl::Case c("ramps that begin with zero");
  enable_visibly(c, target);
  const auto k = static_cast<std::size_t>(gl::components_of(target));
  for (const Interval domain :
       {Interval{1e3, 1e3 + 8}, {1, 1 + 0x1p-16}, {-77, -76.5}, {5, 4.75}, {0.1f, 0.7f}})
    for (const int order : {2, 3}) {
      std::vector<double> points(static_cast<std::size_t>(order) * k);
      for (std::size_t i = k; i < points.size(); ++i) points[i] = points[i - k] + 1;
      define(c, over(make_map1(target, points), domain));
      std::vector<double> us;
      auto u = static_cast<float>(domain.first);
      const auto towards = static_cast<float>(domain.last);
      for (int i = 0; i < 4; ++i) us.push_back(u = std::nextafter(u, towards));
      evaluate_all(c, us);
    }
  t.judge_vertices(c, attribute_of(target));
};

// The maps of one vertex have different domains.
EVALCTS_TEST(Map1Values, OwnDomains, kMust, "EV-MAP1-DOMAIN", by(gl::curve_deliveries()))
(Test& t) {
  constexpr Interval kOwn[] = {{0, 1}, {-1, 2}, {1.5, -0.5}, {0.25, 4.25}};
  gl::Case c("vertex, colour, normal and texture maps over four domains, exchanged four times");
  for (const Kinds& kinds : kKinds1) {
    for (const GLenum target : kinds.targets) c.Enable(target);
    for (std::size_t round = 0; round < 4; ++round) {
      for (std::size_t i = 0; i < 4; ++i)
        define(c, over(random_map(t, kinds.targets[i], 4), kOwn[(i + round) % 4]));
      evaluate_all(c, arguments(t, {0, 1}, t.by_depth(6, 8, 60)));
    }
  }
  t.judge_vertices(c, kUnit0);
};

EVALCTS_TEST(Map1Values, ReversedDomain, kMust, "EV-MAP1-REVERSED",
             combine(kReversedDomains).by(gl::curve_deliveries()))
(Test& t, const NamedDomain& domain) { expect_over_domain(t, domain); };

EVALCTS_TEST(Map1Values, OutsideDomain, kMust, "EV-MAP1-EXTRAPOLATE", "EV-NUM-ACCURACY/1-D", kEachTarget)
(Test& t, GLenum target) {
  gl::Case c("every order, to the left and to the right of the domain");
  enable_visibly(c, target);
  for (const Interval domain : {Interval{0, 1}, Interval{2, 5}, Interval{1, 0}}) {
    for (int order = 2; order <= t.max_order(); ++order) {
      define(c, over(random_map(t, target, order), domain));
      std::vector<double> us;
      for (const double t_outside : {-1.5, 2.5, -0.001, 1.001, -3.0, 4.0, -0.125, 1.125}) {
        // High orders are judged near the domain only, because farther away values leave the range that GL
        // guarantees.
        if (order > 8 && std::abs(t_outside - 0.5) > 0.7) continue;
        us.push_back(static_cast<float>(domain.first + (domain.last - domain.first) * t_outside));
      }
      evaluate_all(c, us);
    }
  }
  t.judge_vertices(c, attribute_of(target));
};

// The arguments are so far outside the domain that their powers are large; the points are so small that the
// results are not.
EVALCTS_TEST(Map1Values, FarOutsideDomain, kMust, "EV-MAP1-EXTRAPOLATE", "EV-NUM-ACCURACY/1-D", kEachTarget)
(Test& t, GLenum target) {
  gl::Case c("2^15 to 2^20 widths of the domain away");
  enable_visibly(c, target);
  for (const Interval domain : {Interval{0, 1}, {3, 1}})
    for (const int order : {2, 3, 4}) {
      Map map = over(random_map(t, target, order), domain);
      for (double& value : map.points) value = std::ldexp(value, -20 * (order - 1) + 6);
      define(c, map);
      std::vector<double> us;
      for (const double widths : {0x1p15, -0x1.5p16, 0x1.3p17, -0x1p18, 0x1.8p20})
        us.push_back(static_cast<float>(domain.first + (domain.last - domain.first) * widths));
      evaluate_all(c, us);
    }
  t.judge_vertices(c, attribute_of(target));
};

EVALCTS_TEST(Map1Values, OrderOneIsConstant, kMust, "EV-MAP1-ORDER-ONE", kEachTarget)
(Test& t, GLenum target) {
  gl::Case c("one point, arguments in and outside the domain");
  enable_visibly(c, target);
  for (const int stride : {4, 9}) {
    define(c, over(random_map(t, target, 1, stride), {2, 5}));
    c.GetError();
    evaluate_all(c, {2, 5, 3.3, -7, 100});
  }
  t.judge_vertices(c, attribute_of(target));
};

// All components differ, so that a permutation of them is noticed.
EVALCTS_TEST(Map1Values, ComponentOrder, kMust, "EV-MAP1-COMPORDER", kEachTarget)
(Test& t, GLenum target) {
  gl::Case c("components 1/8, 3/8, 5/8, 7/8");
  std::vector<double> points;
  for (int i = 0; i < 2; ++i)
    for (int component = 0; component < gl::components_of(target); ++component)
      points.push_back((2.0 * component + 1) / 8);
  define(c, make_map1(target, points));
  enable_visibly(c, target);
  evaluate_all(c, {0, 0.5, 1});
  t.judge_vertices(c, attribute_of(target));
};

EVALCTS_TEST(Map1Values, Stride, kMust, "EV-MAP1-STRIDE", "EV-MAP1-PADDING", kEachTarget)
(Test& t, GLenum target) {
  gl::Case c("strides k, k+1, 2k, 17 with poisoned padding");
  enable_visibly(c, target);
  const int k = gl::components_of(target);
  for (const int stride : {k, k + 1, 2 * k, 17, 257})
    for (const int order : {1, 2, 5}) {
      define(c, random_map(t, target, order, stride));
      evaluate_all(c, {0, 0.25, 0.625, 1});
    }
  t.judge_vertices(c, attribute_of(target));
};

EVALCTS_TEST(Map1Values, PaddingNaN, kMust, "EV-MAP1-PADDING", kEachTarget)
(Test& t, GLenum target) {
  gl::Case c("padding of NaN and infinity");
  enable_visibly(c, target);
  const int k = gl::components_of(target);
  for (const double padding : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Map map = random_map(t, target, 4, k + 3);
    for (double& value : map.points)
      if (value == kPoison) value = padding;
    define(c, map);
    evaluate_all(c, {0, 0.25, 0.625, 1});
  }
  t.judge_vertices(c, attribute_of(target));
};

// --- Two-dimensional maps --------------------------------------------------------------------------------

const auto kEachCommand = by(gl::without(gl::kArrays, gl::surface_deliveries()));

// Judges a case with maps of four attributes. `write` appends evaluations, first with the targets of
// VERTEX_3, then with those of VERTEX_4, which has precedence; it gets a function that defines random maps of
// these targets.
using DefineAll = std::function<void(int uorder, int vorder, Interval u, Interval v)>;
void expect_of_all_kinds(Test& t, const std::string& identity,
                         const std::function<void(gl::Case&, const DefineAll&)>& write) {
  gl::Case c(identity);
  for (const Kinds& kinds : kKinds2) {
    for (const GLenum target : kinds.targets) c.Enable(target);
    write(c, [&](int uorder, int vorder, Interval u, Interval v) {
      for (const GLenum target : kinds.targets)
        define(c, over(random_map(t, target, {uorder, vorder}), u, v));
    });
  }
  t.judge_vertices(c, kUnit0);
}

// Deliveries with EvalCoord2 only, for tests in which the form of Map2 matters and the evaluation command
// does not.
std::vector<gl::Delivery> both_forms() {
  std::vector<gl::Delivery> forms = gl::surface_deliveries();
  std::erase_if(forms, [](const gl::Delivery& delivery) {
    return delivery.evaluation != gl::Delivery::Evaluation::kCoordinates;
  });
  return forms;
}

EVALCTS_TEST(Map2Values, OrderPairs, kMust, "EV-MAP2-BEZIER", "EV-NUM-ACCURACY/2-D", "EV-MAP2-ASYM",
             combine(visible_targets(kSurfaces)).by(gl::surface_deliveries()))
(Test& t, GLenum target) {
  gl::Case c("all pairs of orders up to 8x8");
  enable_visibly(c, target);
  for (int uorder = 1; uorder <= 8; ++uorder)
    for (int vorder = 1; vorder <= 8; ++vorder) {
      define(c, random_map(t, target, {uorder, vorder}));
      evaluate_all(c, arguments(t, {0, 1}, {0, 1}, t.by_depth(1, 5, 100)));
    }
  t.judge_vertices(c, attribute_of(target));
};

// One map of each attribute is enabled from the beginning. Each further map takes precedence over an earlier
// one.
EVALCTS_TEST(Map2Values, OrderPairsOfAllMaps, kMust, "EV-MAP2-BEZIER", "EV-NUM-ACCURACY/2-D", "EV-MAP2-ASYM",
             by(both_forms()))
(Test& t) {
  gl::Case c("all pairs of orders up to 4x4 of each map");
  const std::array<GLenum, 4> first = {GL_MAP2_VERTEX_3, GL_MAP2_COLOR_4, GL_MAP2_NORMAL,
                                       GL_MAP2_TEXTURE_COORD_1};
  for (const GLenum target : first) define_and_enable(c, random_map(t, target, {3, 2}));
  for (const GLenum target :
       {GL_MAP2_COLOR_4, GL_MAP2_NORMAL, GL_MAP2_TEXTURE_COORD_1, GL_MAP2_TEXTURE_COORD_2,
        GL_MAP2_TEXTURE_COORD_3, GL_MAP2_TEXTURE_COORD_4, GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4}) {
    if (std::ranges::count(first, target) == 0) define_and_enable(c, random_map(t, target, {3, 2}));
    for (int uorder = 1; uorder <= 4; ++uorder)
      for (int vorder = 1; vorder <= 4; ++vorder) {
        define(c, random_map(t, target, {uorder, vorder}));
        evaluate_all(c, std::vector<At>{{0.25, 0.875}});
      }
  }
  t.judge_vertices(c, kUnit0);
};

EVALCTS_TEST(Map2Values, LargeOrders, kMust, "EV-MAP2-BEZIER", "EV-NUM-ACCURACY/2-D", "EV-MAP2-ASYM",
             by(both_forms()))
(Test& t) {
  const int max = t.max_order();
  const Orders all_orders[] = {
      {9, 9}, {10, 4}, {3, 17}, {13, 12}, {max, 2}, {5, max}, {50, 50}, {max - 1, max - 2}, {max, max}};
  expect_of_all_kinds(t, "orders above 8", [&](gl::Case& c, const DefineAll& define_all) {
    for (const auto& [uorder, vorder] : all_orders) {
      if (uorder > max || vorder > max) continue;
      define_all(uorder, vorder, {0, 1}, {0, 1});
      const bool large = uorder * vorder > 256;
      evaluate_all(c, arguments(t, {0, 1}, {0, 1}, large ? t.by_depth(1, 1, 10) : t.by_depth(2, 4, 40)));
      // Near the corner the last points matter, but not in nets of 64 by 64 points, for which the accuracy
      // rule accepts nearly everything.
      if (large) evaluate_all(c, std::vector<At>{{0x1.f8p-1, 0x1.f8p-1}});
    }
  });
};

// All points of a grid, row by row along u, for one map along v.
EVALCTS_TEST(Map2Values, GridOfArguments, kMust, "EV-MAP2-BEZIER", kEachCommand)
(Test& t) {
  expect_of_all_kinds(t, "8x8 arguments", [](gl::Case& c, const DefineAll& define_all) {
    for (const auto& [uorder, vorder] : {Orders{4, 4}, {3, 5}, {2, 2}}) {
      define_all(uorder, vorder, {0, 1}, {0, 1});
      for (int row = 0; row <= 7; ++row) {
        c.Begin(GL_POINTS);
        for (int i = 0; i <= 7; ++i)
          uorder == 3 ? evaluate2(c, row / 8.0, i / 8.0) : evaluate2(c, i / 8.0, row / 8.0);
        c.End();
      }
    }
  });
};

// R_ij begins ustride*i + vstride*j values after the first one; the padding is kPoison.
EVALCTS_TEST(Map2Values, Layouts, kMust, "EV-MAP2-ADDRESS", "EV-MAP2-STRIDE-FREE", "EV-MAP2-PADDING",
             combine(kLayouts).by(both_forms()))
(Test& t, const Layout& layout) {
  gl::Case c("orders 3x5, 4x2, 1x6, 6x1");
  for (const GLenum target : kKinds2[1].targets) c.Enable(target);
  for (const auto& [uorder, vorder] : {Orders{3, 5}, {4, 2}, {1, 6}, {6, 1}}) {
    for (const GLenum target : kKinds2[1].targets) define(c, random_map(t, target, {uorder, vorder}, layout));
    evaluate_all(c, arguments(t, {0, 1}, {0, 1}, t.by_depth(4, 8, 100)));
  }
  t.judge_vertices(c, kUnit0);
};

EVALCTS_TEST(Map2Values, PaddingOfNaN, kMust, "EV-MAP2-PADDING", by(both_forms()))
(Test& t) {
  gl::Case c("padding of NaN and infinity");
  for (const GLenum target : kKinds2[1].targets) c.Enable(target);
  for (const double padding : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    for (const Layout& layout : {kLayouts[2], kLayouts[3]}) {
      for (const GLenum target : kKinds2[1].targets) {
        Map map = random_map(t, target, {4, 3}, layout);
        for (double& value : map.points)
          if (value == kPoison) value = padding;
        define(c, map);
      }
      evaluate_all(c, arguments(t, {0, 1}, {0, 1}, 6));
    }
  t.judge_vertices(c, kUnit0);
};

EVALCTS_TEST(Map2Values, TwoIntervals, kMust, "EV-MAP2-DOMAIN", kEachCommand)
(Test& t) {
  const std::pair<Interval, Interval> domains[] = {{{0, 1}, {2, 5}},
                                                   {{-3, -1}, {0, 1}},
                                                   {{1e3, 1e3 + 8}, {-1, 2}},
                                                   {{-1e6, 3e6}, {0.25, 0.375}},
                                                   {{0.1f, 0.7f}, {-0.3f, 1.9f}},
                                                   {{1, 1 + 0x1p-16}, {-7, 77}}};
  expect_of_all_kinds(t, "an interval for u and another for v",
                      [&](gl::Case& c, const DefineAll& define_all) {
                        for (const auto& [u, v] : domains)
                          for (const auto& [uorder, vorder] : {Orders{2, 2}, {4, 3}, {3, 6}}) {
                            define_all(uorder, vorder, u, v);
                            evaluate_all(c, {{u.first, v.first}, {u.last, v.last}});
                            evaluate_all(c, arguments(t, u, v, t.by_depth(2, 5, 60)));
                          }
                      });
};

// The maps of one vertex have different domains, some of which are as wide in u as in v.
EVALCTS_TEST(Map2Values, OwnIntervals, kMust, "EV-MAP2-DOMAIN", kEachCommand)
(Test& t) {
  constexpr std::pair<Interval, Interval> kOwn[] = {
      {{0, 1}, {1, 2}}, {{-1, 2}, {0.5, 1.5}}, {{0, 1}, {0.25, 2.25}}, {{1.5, -0.5}, {2, 0}}};
  gl::Case c("vertex, colour, normal and texture maps over four domains, exchanged four times");
  for (const Kinds& kinds : kKinds2) {
    for (const GLenum target : kinds.targets) c.Enable(target);
    for (std::size_t round = 0; round < 4; ++round) {
      for (std::size_t i = 0; i < 4; ++i) {
        const auto& [u, v] = kOwn[(i + round) % 4];
        define(c, over(random_map(t, kinds.targets[i], {3, 4}), u, v));
      }
      evaluate_all(c, arguments(t, {0, 1}, {0.5, 1.5}, t.by_depth(4, 6, 60)));
    }
  }
  t.judge_vertices(c, kUnit0);
};

EVALCTS_TEST(Map2Values, ReversedIntervals, kMust, "EV-MAP2-REVERSED", kEachCommand)
(Test& t) {
  expect_of_all_kinds(
      t, "neither interval reversed, either, both", [&](gl::Case& c, const DefineAll& define_all) {
        for (const Interval u : {Interval{0, 1}, {1, 0}, {-2, 5}, {5, -2}})
          for (const Interval v : {Interval{2, 3}, {3, 2}}) {
            define_all(4, 3, u, v);
            evaluate_all(c, {{u.first, v.first}, {u.last, v.first}, {u.first, v.last}, {u.last, v.last}});
            evaluate_all(c, arguments(t, u, v, t.by_depth(2, 5, 60)));
          }
      });
};

EVALCTS_TEST(Map2Values, OutsideTheRectangle, kMust, "EV-MAP2-EXTRAPOLATE", "EV-NUM-ACCURACY/2-D",
             kEachCommand)
(Test& t) {
  expect_of_all_kinds(t, "beyond each edge and each corner", [&](gl::Case& c, const DefineAll& define_all) {
    for (const auto& [u, v] : {std::pair{Interval{0, 1}, Interval{0, 1}}, {{2, 5}, {1, -1}}})
      for (const auto& [uorder, vorder] : {Orders{2, 2}, {4, 3}, {2, 7}, {6, 6}}) {
        define_all(uorder, vorder, u, v);
        std::vector<At> outside;
        for (const auto& [s, r] :
             {At{-1, 2}, {0.5, -0.25}, {0.5, 1.75}, {-0.125, 0.3}, {1.5, 0.7}, {1.001, -0.001}, {2, 2}})
          outside.push_back({u.first + (u.last - u.first) * s, v.first + (v.last - v.first) * r});
        for (At& at : outside) at = {static_cast<float>(at.u), static_cast<float>(at.v)};
        evaluate_all(c, outside);
      }
  });
};

EVALCTS_TEST(Map2Values, UnequalOrders, kMust, "EV-MAP2-ASYM", "EV-MAP2-BEZIER", kEachCommand)
(Test& t) {
  const int max = t.max_order();
  expect_of_all_kinds(t, "2x5, 7x1, 1x7, MAXx1, 1xMAX", [&](gl::Case& c, const DefineAll& define_all) {
    for (const auto& [uorder, vorder] : {Orders{2, 5}, {5, 2}, {7, 1}, {1, 7}, {max, 1}, {1, max}}) {
      define_all(uorder, vorder, {-1, 1}, {0, 2});
      evaluate_all(c, arguments(t, {-1, 1}, {0, 2}, t.by_depth(2, 6, 60)));
    }
  });
};

// Constant in the direction of order 1, far outside the domain as well; 1x1 is constant everywhere.
EVALCTS_TEST(Map2Values, OrderOneInOneDirection, kMust, "EV-MAP2-ORDER-ONE", kEachCommand)
(Test& t) {
  expect_of_all_kinds(t, "1x1, 1x4, 4x1", [&](gl::Case& c, const DefineAll& define_all) {
    define_all(1, 1, {2, 5}, {0, 1});
    evaluate_all(c, {{2, 0}, {5, 1}, {-7, 100}, {3.25, -40}});
    define_all(1, 4, {2, 5}, {0, 1});
    for (const double u : {2.0, 3.0, 5.0, -7.0, 100.0}) evaluate_all(c, {{u, 0.375}, {u, 1}});
    define_all(4, 1, {2, 5}, {0, 1});
    for (const double v : {0.0, 0.5, 1.0, -7.0, 100.0}) evaluate_all(c, {{3.125, v}, {5, v}});
  });
};

// The weights of the other direction sum to 1 wherever it is evaluated.
EVALCTS_TEST(Map2Values, ConstantInOneDirection, kMust, "EV-MAP2-SEPARABLE", kEachCommand)
(Test& t) {
  gl::Case c("R_ij = R_i and R_ij = R_j");
  for (const Kinds& kinds : kKinds2) {
    for (const GLenum target : kinds.targets) c.Enable(target);
    for (const auto& [uorder, vorder] : {Orders{4, 2}, {4, 5}, {3, 8}, {2, t.max_order()}, {6, 3}})
      for (const bool along_v : {false, true}) {
        for (const GLenum target : kinds.targets) {
          const auto k = static_cast<std::size_t>(gl::components_of(target));
          const std::vector<double> curve =
              random_values(t.random(), static_cast<std::size_t>(along_v ? vorder : uorder) * k);
          std::vector<double> net;
          for (int i = 0; i < uorder; ++i)
            for (int j = 0; j < vorder; ++j) {
              const auto point = curve.begin() + (along_v ? j : i) * static_cast<std::ptrdiff_t>(k);
              net.insert(net.end(), point, point + static_cast<std::ptrdiff_t>(k));
            }
          define(c, make_map2(target, uorder, vorder, net));
        }
        evaluate_all(c, arguments(t, {0, 1}, {0, 1}, t.by_depth(3, 6, 60)));
        evaluate_all(c, along_v ? std::vector<At>{{-0.25, 0.5}, {1.125, 1}}
                                : std::vector<At>{{0.5, -0.25}, {1, 1.125}});
      }
  }
  t.judge_vertices(c, kUnit0);
};

// At the corners all other points, however large, have no weight.
EVALCTS_TEST(Map2Values, Corners, kMust, "EV-NUM-CORNERS", kEachCommand)
(Test& t) {
  gl::Case c("among points near the largest that the GL promises to hold");
  for (const Kinds& kinds : kKinds2) {
    for (const GLenum target : kinds.targets) c.Enable(target);
    const int max = t.max_order();
    for (const auto& [uorder, vorder] : {Orders{2, 2}, {3, 4}, {5, 2}, {8, 8}, {max, 2}, {1, 3}})
      for (const auto& [u, v] : {std::pair{Interval{0, 1}, Interval{0, 1}}, {{2, 5}, {3, -1}}}) {
        for (const GLenum target : kinds.targets) {
          const double large = attribute_of(target) == kPosition || target == GL_MAP2_NORMAL ? 0x1p30 : 0x1p9;
          std::vector<double> net;
          for (int i = 0; i < uorder; ++i)
            for (int j = 0; j < vorder; ++j)
              for (int component = 0; component < gl::components_of(target); ++component) {
                const bool corner = (i == 0 || i == uorder - 1) && (j == 0 || j == vorder - 1);
                net.push_back(corner ? (component + 1) * (i ? -0.5 : 0.25) + (j ? 0.125 : 0) : large);
              }
          define(c, over(make_map2(target, uorder, vorder, net), u, v));
        }
        evaluate_all(c, {{u.first, v.first}, {u.last, v.first}, {u.first, v.last}, {u.last, v.last}});
      }
  }
  t.judge_vertices(c, kUnit0);
};

// The points are gone when the map is evaluated.
EVALCTS_TEST(Map2Values, PointsGone, kMust, "EV-MAP2-COPY", combine(kTreatments).by(both_forms()))
(Test& t, const Treatment& treatment) {
  gl::Case c("four maps in three layouts");
  for (const GLenum target : kKinds2[1].targets) c.Enable(target);
  for (const Layout& layout : {kLayouts[0], kLayouts[3], kLayouts[5]}) {
    for (const GLenum target : kKinds2[1].targets)
      define(c, random_map(t, target, {4, 3}, layout), false, treatment.after);
    evaluate_all(c, arguments(t, {0, 1}, {0, 1}, 6));
  }
  t.judge_vertices(c, kUnit0);
};

// A map is redefined, through the same memory or with other orders and domains, between evaluations.
EVALCTS_TEST(Map2Values, Redefinition, kMust, "EV-MAP2-REPLACE", "EV-MAP2-COPY", by(both_forms()))
(Test& t) {
  gl::Case c("one map after the other, of each target in turn");
  for (const GLenum target : kKinds2[1].targets) define_and_enable(c, random_map(t, target, {2, 2}));
  for (int round = 0; round < t.by_depth(2, 4, 30); ++round)
    for (const GLenum target : kKinds2[1].targets) {
      define_in_slot(c, random_map(t, target, {4, 3}), false, static_cast<int>(target));
      evaluate_all(c, {{0.25, 0.75}, {1, 0.5}});
      for (int same_orders = 0; same_orders < 2; ++same_orders) {
        define_in_slot(c, random_map(t, target, {3, 4}), false, static_cast<int>(target));
        evaluate_all(c, {{0.25, 0.75}, {1, 0.5}});
      }
      define(c, over(random_map(t, target, {1 + round % 5, 5 - round % 4}), {round + 0.5, -1}, {-1, 3}));
      evaluate_all(c, {{0.25, 0.75}, {-1, 3}});
    }
  t.judge_vertices(c, kUnit0);
};

}  // namespace
}  // namespace evalcts::suite_map_values
