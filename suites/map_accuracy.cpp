// Section 17 of the requirements, the accuracy of values: the cross-check that gives a library its figures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <evalcts/testkit/registration.h>

#include "dimensions.h"
#include "maps.h"

namespace evalcts::suite_map_accuracy {
namespace {

// Every order; at quick depth those up to 10, a few between, and the largest.
int step(Test& t, int order) {
  return order < 10 || t.depth() != Depth::kQuick ? 1 : std::max(1, std::min(9, t.max_order() - order));
}

// The cross-check that gives a library its accuracy figures: every order, values spread over the domain and
// crowded at its ends, ordinary and cancelling data. One case, so that a library compiles its shaders once.
void measure1(Test& t, GLenum target, int values_per_map) {
  const auto k = static_cast<std::size_t>(gl::components_of(target));
  gl::Case c("every order, random and alternating points");
  enable_visibly(c, target);
  for (int order = 1; order <= t.max_order(); order += step(t, order)) {
    for (int kind = 0; kind < 2; ++kind) {
      Map map = random_map(t, target, order);
      if (kind == 1)
        for (std::size_t i = 0; i < map.points.size(); ++i)
          map.points[i] = std::abs(map.points[i]) * (i / k % 2 ? -1 : 1);
      define(c, map);
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

// The cross-check that gives a library its accuracy figures: ordinary and cancelling data, values spread over
// the domain and crowded at its edges.
void measure2(Test& t, GLenum target, int values_per_map) {
  gl::Case c("pairs of orders up to MAX, random and alternating points");
  enable_visibly(c, target);
  const int max = t.max_order();
  const std::vector<Orders> all_orders = {{1, 1}, {2, 2},  {3, 3},   {4, 4},   {6, 3},    {3, 6},
                                          {8, 8}, {12, 5}, {max, 3}, {2, max}, {max, max}};
  for (const auto& [uorder, vorder] : all_orders)
    for (const bool alternating : {false, true}) {
      Map map = random_map(t, target, {uorder, vorder});
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

const auto kEachTarget = [](bool two) { return combine(visible_targets(two)); };

// One test to fail where a result leaves the acceptance interval ...
EVALCTS_TEST_PAIR(Map1Accuracy.Acceptable, Map2Accuracy.Acceptable, kMust,
                  decide("EV-NUM-ACCURACY/1-D", "EV-NUM-ACCURACY/2-D"), kEachTarget)
(Test& t, bool two, GLenum target) {
  two ? measure2(t, target, t.by_depth(12, 30, 1000)) : measure1(t, target, t.by_depth(20, 40, 2000));
};

// ... and one to warn where it is worse than good single precision.
EVALCTS_TEST_PAIR(Map1Accuracy.GoodSinglePrecision, Map2Accuracy.GoodSinglePrecision, kQuality,
                  decide("EV-NUM-ACCURACY/1-D", "EV-NUM-ACCURACY/2-D"), kEachTarget)
(Test& t, bool two, GLenum target) {
  two ? measure2(t, target, t.by_depth(4, 8, 500)) : measure1(t, target, t.by_depth(4, 4, 1000));
};

// ... also next to an end of the domain, where one of t and s is small and may not be what rounding the other
// one left of it: the point there is 0, so that nothing hides the error.
EVALCTS_TEST(Map1Accuracy, GoodNearTheEnds, kQuality, "EV-NUM-ACCURACY/1-D",
             combine(visible_targets(kCurves)))
(Test& t, GLenum target) {
  const auto k = static_cast<std::size_t>(gl::components_of(target));
  gl::Case c("the numbers next to each end");
  enable_visibly(c, target);
  for (const Interval domain : {Interval{0.1f, 0.7f}, {2, 5}, {-3, -1}, {1e3, 1e3 + 7}, {5, -2}})
    for (const int order : {2, 3, 4, 7})
      for (const bool last : {false, true}) {
        Map map = over(random_map(t, target, order), domain);
        std::fill_n(last ? map.points.end() - static_cast<std::ptrdiff_t>(k) : map.points.begin(), k, 0.0);
        define(c, map);
        const auto end = static_cast<float>(last ? domain.last : domain.first);
        const auto other = static_cast<float>(last ? domain.first : domain.last);
        std::vector<double> us = {std::nextafter(end, other)};
        for (const float part : {0x1p-20f, 0x1p-16f, 0x1p-12f, 0x1p-8f})
          us.push_back(end + (other - end) * part);
        evaluate_all(c, us);
      }
  t.expect_emission(c, attribute_of(target));
};

}  // namespace
}  // namespace evalcts::suite_map_accuracy
