// Section 17 of the requirements, the accuracy of evaluated values. The reports take the accuracy of an
// implementation from these tests.

#include <algorithm>
#include <cmath>

#include <evalcts/testkit/registration.h>

#include "dimensions.h"
#include "maps.h"

namespace evalcts::suite_map_accuracy {
namespace {

// Returns the distance to the next order to measure: 1, but 9 at quick depth beyond order 10; the largest
// order is always measured.
int step(Test& t, int order) {
  return order < 10 || t.depth() != Depth::kQuick ? 1 : std::max(1, std::min(9, t.max_order() - order));
}

// Evaluates curves of every order with random and with alternating points, at random arguments and close to
// both ends of the domain, and judges the values. All in one case, so that the capture compiles its shaders
// once.
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
      // Exact evaluation is slow at high orders, so orders beyond those of common libraries get fewer values.
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
  t.judge_vertices(c, attribute_of(target));
}

// The same for surfaces of some pairs of orders.
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
      // Exact evaluation is slow at high orders.
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
  t.judge_vertices(c, attribute_of(target));
}

const auto kEachTarget = [](bool two) { return combine(visible_targets(two)); };

// Fails if a value leaves the acceptance interval.
EVALCTS_TEST_PAIR(Map1Accuracy.Acceptable, Map2Accuracy.Acceptable, kMust,
                  decide("EV-NUM-ACCURACY/1-D", "EV-NUM-ACCURACY/2-D"), kEachTarget)
(Test& t, bool two, GLenum target) {
  two ? measure2(t, target, t.by_depth(12, 30, 1000)) : measure1(t, target, t.by_depth(20, 40, 2000));
};

// Warns if a value is less accurate than good single precision.
EVALCTS_TEST_PAIR(Map1Accuracy.GoodSinglePrecision, Map2Accuracy.GoodSinglePrecision, kQuality,
                  decide("EV-NUM-ACCURACY/1-D", "EV-NUM-ACCURACY/2-D"), kEachTarget)
(Test& t, bool two, GLenum target) {
  two ? measure2(t, target, t.by_depth(4, 8, 500)) : measure1(t, target, t.by_depth(4, 4, 1000));
};

// Warns about inaccurate values next to an end of the domain. There t or s = 1 - t is small and inaccurate if
// it is computed from the other one after rounding. The control point at that end is 0, so that nothing hides
// the error.
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
  t.judge_vertices(c, attribute_of(target));
};

}  // namespace
}  // namespace evalcts::suite_map_accuracy
