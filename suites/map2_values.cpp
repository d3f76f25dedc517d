// Section 4 of the requirements, the values: what a two-dimensional map evaluates to, with nets that differ
// in both directions. (Nets that are constant in one are the one-dimensional tests, lifted.)
#include <fmt/format.h>

#include <cmath>

#include "suites/grid_cases.h"

namespace evalcts::suite_map2_values {
namespace {

using Orders = std::pair<int, int>;

struct Interval {
  double first, last;
};

// u and v of one evaluation.
struct At {
  double u, v;
};

Map2 over(Map2 map, Interval u, Interval v) {
  map.u1 = u.first;
  map.u2 = u.last;
  map.v1 = v.first;
  map.v2 = v.last;
  return map;
}

void evaluate_all(gl::Case& c, const std::vector<At>& arguments) {
  c.Begin(GL_POINTS);
  for (const auto& [u, v] : arguments) evaluate2(c, u, v);
  c.End();
}

double random_between(Test& t, Interval interval) {
  const double value = std::abs(random_values(t.random(), 1).front());
  return static_cast<float>(interval.first + (interval.last - interval.first) * value);
}

// Corners, edges and points inside; the first is always inside.
std::vector<At> arguments(Test& t, Interval u, Interval v, int count) {
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

// A case of all kinds of data at once: `write` is called with what defines the four maps of a vertex, first
// for VERTEX_3, then for VERTEX_4, which has precedence.
using DefineAll = std::function<void(int uorder, int vorder, Interval u, Interval v)>;
void expect_of_all_kinds(Test& t, const std::string& identity,
                         const std::function<void(gl::Case&, const DefineAll&)>& write) {
  gl::Case c(identity);
  for (const Kinds& kinds : kKinds2) {
    for (const GLenum target : kinds.targets) c.Enable(target);
    write(c, [&](int uorder, int vorder, Interval u, Interval v) {
      for (const GLenum target : kinds.targets) define(c, over(random_map2(t, target, uorder, vorder), u, v));
    });
  }
  t.expect_emission(c, kUnit0);
}

// How Map2 is called matters here, how the map is evaluated does not.
std::vector<gl::Delivery> both_forms() {
  std::vector<gl::Delivery> forms = gl::surface_deliveries();
  std::erase_if(forms, [](const gl::Delivery& delivery) {
    return delivery.evaluation != gl::Delivery::Evaluation::coordinates;
  });
  return forms;
}

}  // namespace

EVALCTS_TESTS_BY(gl::surface_deliveries(), Map2Values, OrderPairs, visible_targets2(), GLenum target, must,
                 "EV-MAP2-BEZIER", "EV-NUM-ACCURACY/2-D", "EV-MAP2-ASYM") {
  gl::Case c("all pairs of orders up to 8x8");
  enable_visibly(c, target);
  for (int uorder = 1; uorder <= 8; ++uorder)
    for (int vorder = 1; vorder <= 8; ++vorder) {
      define(c, random_map2(t, target, uorder, vorder));
      evaluate_all(c, arguments(t, {0, 1}, {0, 1}, t.by_depth(1, 5, 100)));
    }
  t.expect_emission(c, attribute_of(target));
}

EVALCTS_TEST_BY(both_forms(), Map2Values, LargeOrders, must, "EV-MAP2-BEZIER", "EV-NUM-ACCURACY/2-D",
                "EV-MAP2-ASYM") {
  const int max = t.max_order();
  expect_of_all_kinds(t, "orders above 8", [&](gl::Case& c, const DefineAll& define_all) {
    for (const Orders& orders :
         {Orders{9, 9}, {10, 4}, {3, 17}, {13, 12}, {max, 2}, {5, max}, {max - 1, max - 2}, {max, max}}) {
      if (orders.first > max || orders.second > max) continue;
      define_all(orders.first, orders.second, {0, 1}, {0, 1});
      const bool large = orders.first * orders.second > 256;
      evaluate_all(c, arguments(t, {0, 1}, {0, 1}, large ? t.by_depth(1, 1, 10) : t.by_depth(2, 4, 40)));
    }
  });
}

// Every point of a grid: long runs of neighbours, along u and then along v.
EVALCTS_TEST_BY(gl::without(gl::kArrays, gl::surface_deliveries()), Map2Values, GridOfArguments, must,
                "EV-MAP2-BEZIER") {
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
}

// R_ij begins ustride*i + vstride*j values after the first; everything between is poisoned.
EVALCTS_TESTS_BY(both_forms(), Map2Values, Layouts, kLayouts, const Layout& layout, must, "EV-MAP2-ADDRESS",
                 "EV-MAP2-STRIDE-FREE", "EV-MAP2-PADDING") {
  gl::Case c("orders 3x5, 4x2, 1x6, 6x1");
  for (const GLenum target : kKinds2[1].targets) c.Enable(target);
  for (const auto& [uorder, vorder] : {Orders{3, 5}, {4, 2}, {1, 6}, {6, 1}}) {
    for (const GLenum target : kKinds2[1].targets) define(c, random_map2(t, target, uorder, vorder, layout));
    evaluate_all(c, arguments(t, {0, 1}, {0, 1}, t.by_depth(4, 8, 100)));
  }
  t.expect_emission(c, kUnit0);
}

EVALCTS_TEST_BY(both_forms(), Map2Values, PaddingOfNaN, must, "EV-MAP2-PADDING") {
  gl::Case c("padding of NaN and infinity");
  for (const GLenum target : kKinds2[1].targets) c.Enable(target);
  for (const double padding : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    for (const Layout& layout : {kLayouts[2], kLayouts[3]}) {
      for (const GLenum target : kKinds2[1].targets) {
        Map2 map = random_map2(t, target, 4, 3, layout);
        for (double& value : map.points)
          if (value == kPoison) value = padding;
        define(c, map);
      }
      evaluate_all(c, arguments(t, {0, 1}, {0, 1}, 6));
    }
  t.expect_emission(c, kUnit0);
}

EVALCTS_TEST_BY(gl::without(gl::kArrays, gl::surface_deliveries()), Map2Values, TwoIntervals, must,
                "EV-MAP2-DOMAIN") {
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
}

// Each of the maps that make one vertex has intervals of its own, some of them as wide in u as in v.
EVALCTS_TEST_BY(gl::without(gl::kArrays, gl::surface_deliveries()), Map2Values, OwnIntervals, must,
                "EV-MAP2-DOMAIN") {
  constexpr std::pair<Interval, Interval> kOwn[] = {
      {{0, 1}, {1, 2}}, {{-1, 2}, {0.5, 1.5}}, {{0, 1}, {0.25, 2.25}}, {{1.5, -0.5}, {2, 0}}};
  gl::Case c("vertex, colour, normal and texture maps over four domains, exchanged four times");
  for (const Kinds& kinds : kKinds2) {
    for (const GLenum target : kinds.targets) c.Enable(target);
    for (std::size_t round = 0; round < 4; ++round) {
      for (std::size_t i = 0; i < 4; ++i) {
        const auto& [u, v] = kOwn[(i + round) % 4];
        define(c, over(random_map2(t, kinds.targets[i], 3, 4), u, v));
      }
      evaluate_all(c, arguments(t, {0, 1}, {0.5, 1.5}, t.by_depth(4, 6, 60)));
    }
  }
  t.expect_emission(c, kUnit0);
}

EVALCTS_TEST_BY(gl::without(gl::kArrays, gl::surface_deliveries()), Map2Values, ReversedIntervals, must,
                "EV-MAP2-REVERSED") {
  expect_of_all_kinds(
      t, "neither interval reversed, either, both", [&](gl::Case& c, const DefineAll& define_all) {
        for (const Interval u : {Interval{0, 1}, {1, 0}, {-2, 5}, {5, -2}})
          for (const Interval v : {Interval{2, 3}, {3, 2}}) {
            define_all(4, 3, u, v);
            evaluate_all(c, {{u.first, v.first}, {u.last, v.first}, {u.first, v.last}, {u.last, v.last}});
            evaluate_all(c, arguments(t, u, v, t.by_depth(2, 5, 60)));
          }
      });
}

EVALCTS_TEST_BY(gl::without(gl::kArrays, gl::surface_deliveries()), Map2Values, OutsideTheRectangle, must,
                "EV-MAP2-EXTRAPOLATE", "EV-NUM-ACCURACY/2-D") {
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
}

EVALCTS_TEST_BY(gl::without(gl::kArrays, gl::surface_deliveries()), Map2Values, UnequalOrders, must,
                "EV-MAP2-ASYM", "EV-MAP2-BEZIER") {
  const int max = t.max_order();
  expect_of_all_kinds(t, "2x5, 7x1, 1x7, MAXx1, 1xMAX", [&](gl::Case& c, const DefineAll& define_all) {
    for (const auto& [uorder, vorder] : {Orders{2, 5}, {5, 2}, {7, 1}, {1, 7}, {max, 1}, {1, max}}) {
      define_all(uorder, vorder, {-1, 1}, {0, 2});
      evaluate_all(c, arguments(t, {-1, 1}, {0, 2}, t.by_depth(2, 6, 60)));
    }
  });
}

// Constant in the direction of order 1, far outside the domain as well; 1x1 is constant everywhere.
EVALCTS_TEST_BY(gl::without(gl::kArrays, gl::surface_deliveries()), Map2Values, OrderOneInOneDirection, must,
                "EV-MAP2-ORDER-ONE") {
  expect_of_all_kinds(t, "1x1, 1x4, 4x1", [&](gl::Case& c, const DefineAll& define_all) {
    define_all(1, 1, {2, 5}, {0, 1});
    evaluate_all(c, {{2, 0}, {5, 1}, {-7, 100}, {3.25, -40}});
    define_all(1, 4, {2, 5}, {0, 1});
    for (const double u : {2.0, 3.0, 5.0, -7.0, 100.0}) evaluate_all(c, {{u, 0.375}, {u, 1}});
    define_all(4, 1, {2, 5}, {0, 1});
    for (const double v : {0.0, 0.5, 1.0, -7.0, 100.0}) evaluate_all(c, {{3.125, v}, {5, v}});
  });
}

// The weights of the other direction sum to 1 wherever it is evaluated.
EVALCTS_TEST_BY(gl::without(gl::kArrays, gl::surface_deliveries()), Map2Values, ConstantInOneDirection, must,
                "EV-MAP2-SEPARABLE") {
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
  t.expect_emission(c, kUnit0);
}

// At the corners all other points, however large, have no weight.
EVALCTS_TEST_BY(gl::without(gl::kArrays, gl::surface_deliveries()), Map2Values, Corners, must,
                "EV-NUM-CORNERS") {
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
  t.expect_emission(c, kUnit0);
}

namespace {}  // namespace

// The points are gone when the map is evaluated.
EVALCTS_TESTS_BY(both_forms(), Map2Values, PointsGone, kFates, const Fate& fate, must, "EV-MAP2-COPY") {
  gl::Case c("four maps in three layouts");
  for (const GLenum target : kKinds2[1].targets) c.Enable(target);
  for (const Layout& layout : {kLayouts[0], kLayouts[3], kLayouts[5]}) {
    for (const GLenum target : kKinds2[1].targets)
      define(c, random_map2(t, target, 4, 3, layout), false, fate.after);
    evaluate_all(c, arguments(t, {0, 1}, {0, 1}, 6));
  }
  t.expect_emission(c, kUnit0);
}

// A map is redefined, through the same memory or with other orders and domains, between evaluations.
EVALCTS_TEST_BY(both_forms(), Map2Values, Redefinition, must, "EV-MAP2-REPLACE", "EV-MAP2-COPY") {
  gl::Case c("one map after the other, of each target in turn");
  for (const GLenum target : kKinds2[1].targets) {
    define(c, random_map2(t, target, 2, 2));
    c.Enable(target);
  }
  for (int round = 0; round < t.by_depth(2, 4, 30); ++round)
    for (const GLenum target : kKinds2[1].targets) {
      define_in_slot(c, random_map2(t, target, 4, 3), false, static_cast<int>(target));
      evaluate_all(c, {{0.25, 0.75}, {1, 0.5}});
      for (int same_orders = 0; same_orders < 2; ++same_orders) {
        define_in_slot(c, random_map2(t, target, 3, 4), false, static_cast<int>(target));
        evaluate_all(c, {{0.25, 0.75}, {1, 0.5}});
      }
      define(c, over(random_map2(t, target, 1 + round % 5, 5 - round % 4), {round + 0.5, -1}, {-1, 3}));
      evaluate_all(c, {{0.25, 0.75}, {-1, 3}});
    }
  t.expect_emission(c, kUnit0);
}

namespace {

// The cross-check that gives a library its accuracy figures: ordinary and cancelling data, values spread over
// the domain and crowded at its edges.
void measure(Test& t, GLenum target, int values_per_map) {
  gl::Case c("pairs of orders up to MAX, random and alternating points");
  enable_visibly(c, target);
  const int max = t.max_order();
  for (const auto& [uorder, vorder] : {Orders{1, 1},
                                       {2, 2},
                                       {3, 3},
                                       {4, 4},
                                       {6, 3},
                                       {3, 6},
                                       {8, 8},
                                       {12, 5},
                                       {max, 3},
                                       {2, max},
                                       {max, max}})
    for (const bool alternating : {false, true}) {
      Map2 map = random_map2(t, target, uorder, vorder);
      if (alternating) {
        const int k = map.components();
        for (std::size_t i = 0; i < map.points.size(); ++i) {
          const int point = static_cast<int>(i) / k;
          map.points[i] = std::abs(map.points[i]) * ((point / vorder + point % vorder) % 2 ? -1 : 1);
        }
      }
      define(c, map);
      // The exact route slows down with the order.
      const int count = uorder * vorder <= 16   ? values_per_map
                        : uorder * vorder < 256 ? values_per_map / 4 + 1
                                                : values_per_map / 20 + 1;
      std::vector<At> all = arguments(t, {0, 1}, {0, 1}, count);
      if (count > 4) {
        all.push_back({std::ldexp(1.0, -20), 1 - std::ldexp(1.0, -20)});
        all.push_back({1 - std::ldexp(1.0, -9), std::ldexp(1.0, -9)});
      }
      evaluate_all(c, all);
    }
  t.expect_emission(c, attribute_of(target));
}

}  // namespace

// One test to fail where a result leaves the acceptance interval ...
EVALCTS_TESTS(Map2Accuracy, Acceptable, visible_targets2(), GLenum target, must, "EV-NUM-ACCURACY/2-D") {
  measure(t, target, t.by_depth(12, 30, 1000));
}

// ... and one to warn where it is worse than good single precision.
EVALCTS_TESTS(Map2Accuracy, GoodSinglePrecision, visible_targets2(), GLenum target, quality,
              "EV-NUM-ACCURACY/2-D") {
  measure(t, target, t.by_depth(4, 8, 500));
}

}  // namespace evalcts::suite_map2_values
