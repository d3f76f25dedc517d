// Sections 3 and 4 of the requirements, the state: what Map1 and Map2 store, where in memory they read it,
// and what they leave unchanged.
#include <fmt/format.h>

#include <utility>

#include <evalcts/testkit/registration.h>

#include "dimensions.h"
#include "rejection.h"

namespace evalcts::suite_map_state {
namespace {

using gl::list_deliveries;

const auto kEachTarget = [](bool two) { return combine(targets(two)).by(list_deliveries()); };
const auto kEachTargetForm = [](bool two) { return combine(target_forms(two)).by(list_deliveries()); };

// Returns a map for each target of the dimension; they differ in orders, layout and domain.
std::vector<Map> nine_maps(Test& t, bool two) {
  std::vector<Map> maps;
  for (std::size_t i = 0; i < 9; ++i) {
    const int n = static_cast<int>(i), order = 1 + n % 8;
    const GLenum target = targets(two)[i];
    const Map map = two ? random_map(t, target, {order, 1 + (3 * n + 2) % 8}, kLayouts[i % 4])
                        : random_map(t, target, order, 5);
    maps.push_back(over(map, {1.0 * n, 20.0 + n}, {40.0 - n, 30.0 - n}));
  }
  return maps;
}

// Returns equal and different orders, up to the largest.
std::vector<Orders> some_orders(int max) {
  return {{1, 1}, {2, 3}, {3, 2}, {4, 4}, {1, 5}, {5, 1}, {max, 1}, {1, max}, {2, max}, {max, 3}, {max, max}};
}

// Judges queries of the maps after the commands.
void judge_maps(Test& t, gl::Case c, const std::vector<Map>& maps, bool doubles = false) {
  for (const Map& map : maps) query_map(t, c, map.target, doubles);
  t.judge(c);
}

// Defines a map, and asks for an error and for the map.
void define_and_query(Test& t, gl::Case& c, const Map& map, bool doubles,
                      gl::AfterCall after = gl::AfterCall::kKeep) {
  define(c, map, doubles, after);
  c.GetError();
  query_map(t, c, map.target, doubles);
}

// Judges queries of the maps `others` after the two maps of the target of one of them.
void judge_replaced(Test& t, gl::Case c, const std::vector<Map>& others, const Map& first,
                    const Map& second) {
  for (const Map& other : others) define(c, other);
  define(c, first);
  define(c, second);
  judge_maps(t, c, others);
}

// --- Rules of both dimensions ----------------------------------------------------------------------------

EVALCTS_TEST_PAIR(Map1State.EveryOrderAccepted, Map2State.EveryOrderAccepted, kMust,
                  decide("EV-MAP1-ORDER-ALL", "EV-MAP2-ORDER-ALL"), kEachTargetForm)
(Test& t, bool two, const TargetForm& form) {
  const int max = t.max_order(), small = two ? t.by_depth(4, 8, max) : max;
  std::vector<Orders> all;
  for (int u = 1; u <= small; ++u)
    for (int v = 1; v <= (two ? small : 1); ++v) all.push_back({u, v});
  if (two)
    for (const int order : {1, 2, max - 1, max}) all.insert(all.end(), {{order, max}, {max, order}});
  gl::Case c(two ? "all small pairs, and those with MAX" : "orders 1 to MAX");
  for (const Orders& orders : all) {
    const Map map = two ? random_map(t, form.target, orders) : random_map(t, form.target, orders.u, 4);
    define(c, map, form.doubles);
    c.GetError();
    c.GetMapiv(form.target, GL_ORDER, gl::out<GLint>(map.orders().size()));
  }
  t.judge(c);
};

// The number of values per point k determines the least stride that is accepted, and the number of values of
// COEFF.
EVALCTS_TEST_PAIR(Map1State.ValuesPerPoint, Map2State.ValuesPerPoint, kMust, decide("EV-MAP1-K", "EV-MAP2-K"),
                  kEachTarget)
(Test& t, bool two, GLenum target) {
  const int k = gl::components_of(target);
  gl::Case c("strides k and k-1; size of COEFF");
  const Map map = random_map(t, target, {3, 2}, k, k);
  define(c, map);
  c.GetError();
  c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(two ? 64 : 32));
  for (const Direction& direction : directions(two)) {
    Map narrow = two ? map : random_map(t, target, 3, k);
    narrow.*direction.stride = k - 1;
    define(c, narrow);
    c.GetError();
  }
  t.judge(c);
};

// Each map is queried after its definition, and two maps may have members in common, so that a library that
// caches answers fails.
EVALCTS_TEST_PAIR(Map1State.ReplaceAfterQuery, Map2State.ReplaceAfterQuery, kMust,
                  decide("EV-MAP1-REPLACE", "EV-MAP2-REPLACE"), kEachTarget)
(Test& t, bool two, GLenum target) {
  gl::Case c(two ? "the same values in other shapes, over other domains; another vorder"
                 : "another domain, other points, another order, the first once more");
  std::vector<Map> maps;
  if (two) {
    const std::vector<double> values =
        random_values(t.random(), static_cast<std::size_t>(12 * gl::components_of(target)));
    for (const auto& [u, v] : {Orders{2, 6}, {3, 4}, {4, 3}, {6, 2}, {12, 1}, {1, 12}}) {
      if (std::max(u, v) > t.max_order()) continue;
      const Map map = make_map2(target, u, v, values);
      maps.insert(maps.end(), {map, over(map, {0, 3}), over(map, {0, 3}, {-1, 1})});
    }
    for (const int vorder : {3, 5, 2, 3}) maps.push_back(random_map(t, target, {3, vorder}));
  } else {
    const Map first = random_map(t, target, 4, 5);
    maps = {first, over(first, {-1, 3}), over(random_map(t, target, 4, 5), {-1, 3}),
            random_map(t, target, 2, 4), first};
  }
  for (const Map& map : maps) define_and_query(t, c, map, false);
  t.judge(c);
};

EVALCTS_TEST_PAIR(Map1State.Independent, Map2State.Independent, kMust,
                  decide("EV-MAP1-INDEP", "EV-MAP2-REPLACE"), by(list_deliveries()))
(Test& t, bool two) {
  const std::vector<Map> maps = nine_maps(t, two);
  for (const bool reversed : {false, true}) {
    gl::Case c(reversed ? "defined from the last to the first" : "defined from the first to the last");
    for (std::size_t i = 0; i < maps.size(); ++i) define(c, maps[reversed ? maps.size() - 1 - i : i]);
    judge_maps(t, c, maps);
  }
};

// Definitions of maps do not change maps of the other dimension, grids, AUTO_NORMAL and current values.
EVALCTS_TEST_PAIR(Map1State.LeavesMap2Alone, Map2State.LeavesTheRestAlone, kMust,
                  decide("EV-MAP1-VS-MAP2/1-D", "EV-MAP1-VS-MAP2/2-D"),
                  decide("EV-MAP1-REPLACE", "EV-MAP2-REPLACE"), by(list_deliveries()))
(Test& t, bool two) {
  for (const Form& form : existing_forms(t, {two})) {
    gl::Case c(fmt::format("all nine defined, {} form", form.name));
    if (two)
      for (const GLenum target : gl::kMap1Targets) define(c, random_map(t, target, 3));
    take_snapshot(t, c);
    for (const Map& map : nine_maps(t, two)) define(c, map, form.doubles);
    take_snapshot(t, c);
    t.judge(c);
  }
};

// The definition of a map, constant or not, enables and disables nothing.
EVALCTS_TEST_PAIR(Map1State.EnableUntouched, Map2State.EnableUntouched, kMust,
                  decide("EV-MAP1-NOENABLE", "EV-MAP2-NOENABLE"), kEachTargetForm)
(Test& t, bool two, const TargetForm& form) {
  const std::vector<GLenum> caps =
      two ? all_caps() : std::vector<GLenum>(gl::kMap1Targets.begin(), gl::kMap1Targets.end());
  const auto define_map = [&](gl::Case& c, bool constant) {
    define(c, random_map(t, form.target, constant ? Orders{1, 1} : Orders{3, 2}, two ? 15 : 4, 4),
           form.doubles);
  };
  const auto ask = [&](gl::Case& c) {
    for (const GLenum cap : caps) c.IsEnabled(cap);
  };
  gl::Case c("all disabled; it alone enabled; all enabled");
  for (const int stage : {0, 1, 2}) {
    if (stage == 1) c.Enable(form.target);
    if (stage == 2)
      for (const GLenum other : caps) c.Enable(other);
    for (const bool constant : {false, true}) {
      define_map(c, constant);
      ask(c);
    }
  }
  t.judge(c);

  gl::Case first("enabled before anything was defined");
  for (const GLenum other : caps) first.Enable(other);
  define_map(first, false);
  ask(first);
  t.judge(first);
};

// Points are read from client memory, whatever the pixel store modes and (in the next test) the bound
// buffers.
EVALCTS_TEST_PAIR(Map1State.PixelStoreIgnored, Map2State.PixelStoreIgnored, kMust,
                  decide("EV-MAP1-NOPIXELSTORE", "EV-MAP2-ADDRESS"), kEachTargetForm)
(Test& t, bool two, const TargetForm& form) {
  gl::Case c("swapped bytes, row length, skips, alignment");
  c.PixelStorei(GL_UNPACK_SWAP_BYTES, GL_TRUE);
  c.PixelStorei(GL_UNPACK_LSB_FIRST, GL_TRUE);
  c.PixelStorei(GL_UNPACK_ROW_LENGTH, 7);
  c.PixelStorei(GL_UNPACK_SKIP_ROWS, 1);
  c.PixelStorei(GL_UNPACK_SKIP_PIXELS, 3);
  c.PixelStorei(GL_UNPACK_ALIGNMENT, 8);
  define_and_query(t, c, random_map(t, form.target, {4, 3}, two ? 20 : 5, 5), form.doubles);
  t.judge(c);
};

EVALCTS_TEST_PAIR(Map1State.BuffersIgnored, Map2State.BuffersIgnored, kMust,
                  decide("EV-MAP1-NOBUFFER", "EV-MAP2-ADDRESS"), kEachTargetForm)
(Test& t, bool two, const TargetForm& form) {
  t.require(1, 5, "GL_ARB_vertex_buffer_object");
  gl::Case c("ARRAY_BUFFER and, from 2.1 on, PIXEL_UNPACK_BUFFER bound");
  const gl::ResultOf buffer{c.GenBuffers(1, gl::out<GLuint>(1)).index, 0};
  c.BindBuffer(GL_ARRAY_BUFFER, buffer);
  c.BufferData(GL_ARRAY_BUFFER, 4096, nullptr, GL_STATIC_DRAW);
  if (t.gl().at_least(2, 1)) c.BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
  define_and_query(t, c, random_map(t, form.target, {4, 3}, two ? 20 : 5, 5), form.doubles);
  t.judge(c);
};

// --- One-dimensional maps --------------------------------------------------------------------------------

EVALCTS_TEST(Map1State, Stride, kMust, "EV-MAP1-STRIDE", "EV-MAP1-PADDING", kEachTargetForm(kCurves))
(Test& t, const TargetForm& form) {
  const int k = gl::components_of(form.target);
  gl::Case c("strides k to 2^16 + k, orders 1 to MAX");
  for (const int stride : {k, k + 1, 2 * k, 17, 257, 1000, 0x10000 + k})
    for (const int order : {1, 2, 5, t.max_order()}) {
      if (stride > 0x10000 && order != 2) continue;  // a point takes half a megabyte
      define_and_query(t, c, random_map(t, form.target, order, stride), form.doubles);
    }
  t.judge(c);
};

EVALCTS_TEST(Map1State, SmallestStride, kMust, "EV-MAP1-STRIDE-MIN", kEachTargetForm(kCurves))
(Test& t, const TargetForm& form) {
  gl::Case c("stride k, orders 1, 2 and MAX");
  for (const int order : {1, 2, t.max_order()}) {
    define(c, random_map(t, form.target, order, gl::components_of(form.target)), form.doubles);
    c.GetError();
    c.GetMapiv(form.target, GL_ORDER, gl::out<GLint>(1));
  }
  t.judge(c);
};

EVALCTS_TEST(Map1State, CopyOnCall, kMust, "EV-MAP1-COPY", combine(kTreatments).by(list_deliveries()))
(Test& t, const Treatment& treatment) {
  for (const TargetForm& form : existing_target_forms(t, kCurves)) {
    gl::Case c(form.name);
    for (const int order : {1, 4, t.max_order()})
      for (const int stride : {gl::components_of(form.target), 5})
        define_and_query(t, c, random_map(t, form.target, order, stride), form.doubles, treatment.after);
    t.judge(c);
  }
};

EVALCTS_TEST(Map1State, CopyOnCallEvaluated, kMust, "EV-MAP1-COPY",
             combine(kTreatments).by(list_deliveries()))
(Test& t, const Treatment& treatment) {
  for (const GLenum target : visible_targets(kCurves)) {
    gl::Case c(label(target) + ", both forms");
    enable_visibly(c, target);
    for (const Form& form : existing_forms(t, {kCurves}))
      for (const int order : {1, 4, t.max_order()})
        for (const int stride : {gl::components_of(target), 5}) {
          define(c, random_map(t, target, order, stride), form.doubles, treatment.after);
          evaluate_some(c);
        }
    t.judge_vertices(c, attribute_of(target));
  }
};

// A definition reads the points again even if the pointer is the same as before.
EVALCTS_TEST(Map1State, SamePointerNewPoints, kMust, "EV-MAP1-COPY", "EV-MAP1-REPLACE", "EV-MAP1-LIVE",
             combine(visible_target_forms(kCurves)).by(list_deliveries()))
(Test& t, const TargetForm& form) {
  gl::Case c("three definitions through one array");
  enable_visibly(c, form.target);
  for (int round = 0; round < 3; ++round) {
    define_in_slot(c, random_map(t, form.target, 4, 5), form.doubles, 0);
    evaluate_some(c);
  }
  t.judge_vertices(c, attribute_of(form.target));

  gl::Case queried("two definitions through one array, queried");
  define_in_slot(queried, random_map(t, form.target, 3, 5), form.doubles, 0);
  const Map second = random_map(t, form.target, 3, 5);
  define_in_slot(queried, second, form.doubles, 0);
  judge_maps(t, queried, {second}, form.doubles);
};

EVALCTS_TEST(Map1State, Replace, kMust, "EV-MAP1-REPLACE", kEachTarget(kCurves))
(Test& t, GLenum target) {
  for (const auto& [before, after] :
       {std::pair{5, 2}, {2, 5}, {4, 4}, {1, 1}, {1, t.max_order()}, {t.max_order(), 1}}) {
    const Map first = over(random_map(t, target, before, 4), {3, 4});
    const Map second = over(random_map(t, target, after, 6), {-1, 0.5});
    judge_replaced(t, gl::Case(fmt::format("order {} then {}", before, after)), nine_maps(t, kCurves), first,
                   second);
  }
};

EVALCTS_TEST(Map1State, IndependentLongMaps, kMust, "EV-MAP1-INDEP", by(list_deliveries()))
(Test& t) {
  for (const int fewer : {0, 1}) {
    gl::Case c(fewer == 0 ? "all of the largest order" : "all of one less");
    std::vector<Map> maps;
    for (const GLenum target : gl::kMap1Targets) {
      maps.push_back(random_map(t, target, t.max_order() - fewer, 4));
      define(c, maps.back());
    }
    judge_maps(t, c, maps);
  }
};

// Evaluation uses the new map, also at the argument that was evaluated last, and if the order stays the same.
EVALCTS_TEST(Map1State, Live, kMust, "EV-MAP1-LIVE",
             combine(visible_target_forms(kCurves)).by(list_deliveries()))
(Test& t, const TargetForm& form) {
  gl::Case c("evaluate, define again, evaluate");
  enable_visibly(c, form.target);
  Map map;
  const auto define_and_evaluate = [&] {
    define(c, map, form.doubles);
    c.Begin(GL_POINTS);
    for (const double u : {0.375, 0.0, 1.0, 0.375}) evaluate(c, u, form.doubles);
    c.End();
  };
  for (const int order : {4, 2, 6, 6, 1, 1, 6}) {
    map = random_map(t, form.target, order, 4);
    define_and_evaluate();
  }
  map.u2 = 2;  // changes the domain only
  define_and_evaluate();
  c.Disable(form.target);
  define(c, random_map(t, form.target, 6, 4), form.doubles);
  enable_visibly(c, form.target);
  evaluate_some(c);
  t.judge_vertices(c, attribute_of(form.target));
};

// --- Two-dimensional maps --------------------------------------------------------------------------------

// Judges maps of these layouts. The memory of each net ends before an inaccessible page.
void judge_layouts(Test& t, const TargetForm& form, bool shared) {
  for (const Layout& layout : kLayouts) {
    if (layout.shared != shared) continue;
    gl::Case c(layout.name);
    for (const Orders& orders : some_orders(t.max_order()))
      define_and_query(t, c, random_map(t, form.target, orders, layout), form.doubles);
    t.judge(c);
  }
}

EVALCTS_TEST(Map2State, Layouts, kMust, "EV-MAP2-ADDRESS", "EV-MAP2-PADDING", "EV-MAP2-STRIDE-FREE",
             kEachTargetForm(kSurfaces))
(Test& t, const TargetForm& form) { judge_layouts(t, form, false); };

EVALCTS_TEST(Map2State, SharedPoints, kMust, "EV-MAP2-STRIDE-FREE", "EV-MAP2-ADDRESS",
             kEachTargetForm(kSurfaces))
(Test& t, const TargetForm& form) { judge_layouts(t, form, true); };

EVALCTS_TEST(Map2State, LargeStrides, kMust, "EV-MAP2-ADDRESS", "EV-MAP2-PADDING", "EV-MAP2-STRIDE-FREE",
             kEachTargetForm(kSurfaces))
(Test& t, const TargetForm& form) {
  gl::Case c("strides up to 1000");
  for (const auto& [ustride, vstride] :
       {std::pair{1000, 17}, {17, 1000}, {257, 64}, {64, 257}, {300, 5}, {5, 300}})
    for (const auto& [u, v] : {Orders{3, 4}, {4, 3}, {1, 6}, {6, 1}})
      define_and_query(t, c, random_map(t, form.target, {u, v}, ustride, vstride), form.doubles);
  // These strides need more than 16 bits.
  define_and_query(t, c, random_map(t, form.target, {2, 3}, 0x10000 + 20, 5), form.doubles);
  define_and_query(t, c, random_map(t, form.target, {3, 2}, 5, 0x10000 + 20), form.doubles);
  t.judge(c);
};

// The same net in row-major and in column-major order is the same map.
EVALCTS_TEST(Map2State, SameNetEitherWay, kMust, "EV-MAP2-ADDRESS", kEachTargetForm(kSurfaces))
(Test& t, const TargetForm& form) {
  const int k = gl::components_of(form.target);
  gl::Case c("3x5 in both orders of memory");
  const std::vector<double> net = random_values(t.random(), static_cast<std::size_t>(3 * 5 * k));
  for (const Layout& layout : {kLayouts[0], kLayouts[1]}) {
    define(c, random_map(t, form.target, {2, 2}), form.doubles);  // overwrites the previous net
    define(c, make_map2(form.target, 3, 5, layout.ustride(k, 3, 5), layout.vstride(k, 3, 5), net),
           form.doubles);
    query_map(t, c, form.target, true);
  }
  t.judge(c);
};

EVALCTS_TEST(Map2State, StridesCountValues, kMust, "EV-MAP2-STRIDE-UNITS", kEachTarget(kSurfaces))
(Test& t, GLenum target) {
  gl::Case c("the same integers in both forms");
  for (const auto& [ustride, vstride] : {std::pair{24, 6}, {6, 24}, {7, 50}, {5, 5}})
    for (const Form& form : existing_forms(t, {kSurfaces}))
      define_and_query(t, c, random_map(t, target, {4, 3}, ustride, vstride), form.doubles);
  t.judge(c);
};

EVALCTS_TEST(Map2State, CopyOnCall, kMust, "EV-MAP2-COPY", combine(kTreatments).by(list_deliveries()))
(Test& t, const Treatment& treatment) {
  for (const TargetForm& form : existing_target_forms(t, kSurfaces)) {
    gl::Case c(form.name);
    const int max = t.max_order();
    for (const Layout& layout : kLayouts)
      for (const auto& [u, v] : {Orders{1, 1}, {3, 4}, {max, 2}, {max, max}})
        define_and_query(t, c, random_map(t, form.target, {u, v}, layout), form.doubles, treatment.after);
    t.judge(c);
  }
};

// The queries come after all definitions, when none of the arrays exists unchanged.
EVALCTS_TEST(Map2State, CopiesOfAll, kMust, "EV-MAP2-COPY", combine(kTreatments).by(list_deliveries()))
(Test& t, const Treatment& treatment) {
  const std::vector<Map> maps = nine_maps(t, kSurfaces);
  for (const Form& form : existing_forms(t, {kSurfaces})) {
    gl::Case c(fmt::format("all nine, form {}", form.name));
    for (const Map& map : maps) define(c, map, form.doubles, treatment.after);
    judge_maps(t, c, maps, form.doubles);
  }
};

// A definition reads the points again even if the pointer is the same as before.
EVALCTS_TEST(Map2State, SamePointerNewPoints, kMust, "EV-MAP2-COPY", "EV-MAP2-REPLACE",
             kEachTargetForm(kSurfaces))
(Test& t, const TargetForm& form) {
  gl::Case c("three definitions through one array");
  for (int round = 0; round < 3; ++round) {
    define_in_slot(c, random_map(t, form.target, {4, 3}, 15, 5), form.doubles, 0);
    c.GetError();
    query_map(t, c, form.target, form.doubles);
  }
  t.judge(c);
};

EVALCTS_TEST(Map2State, Replace, kMust, "EV-MAP2-REPLACE", kEachTarget(kSurfaces))
(Test& t, GLenum target) {
  const int max = t.max_order();
  const std::vector<Map> others = nine_maps(t, kSurfaces);
  for (const auto& [before, after] : {std::pair{Orders{5, 2}, Orders{2, 5}},
                                      {{2, 2}, {4, 4}},
                                      {{4, 4}, {2, 2}},
                                      {{3, 3}, {3, 3}},
                                      {{1, 1}, {max, max}},
                                      {{max, max}, {1, 1}},
                                      {{6, 2}, {4, 3}}}) {
    const auto shown = [&](const Orders& orders) {
      return orders == Orders{max, max} ? "MAXxMAX" : fmt::format("{}x{}", orders.u, orders.v);
    };
    const Map first = over(random_map(t, target, before, kLayouts[2]), {3, 4}, {-7, -8});
    const Map second = over(random_map(t, target, after, kLayouts[3]), {-1, 0.5}, {11, 13});
    judge_replaced(t, gl::Case(shown(before) + " then " + shown(after)), others, first, second);
  }
};

EVALCTS_TEST(Map2State, IndependentLargeNets, kMust, "EV-MAP2-REPLACE", by(list_deliveries()))
(Test& t) {
  const int max = t.max_order();
  for (const auto& [u, v] : {Orders{max, 3}, {4, max}}) {
    gl::Case c(u == max ? "all MAXx3" : "all 4xMAX");
    std::vector<Map> maps;
    for (const GLenum target : gl::kMap2Targets) {
      maps.push_back(random_map(t, target, {u, v}));
      define(c, maps.back());
    }
    judge_maps(t, c, maps);
  }
};

// MAP1 and MAP2 targets of the same name hold separate maps, in whichever order they are defined.
EVALCTS_TEST(Map2State, Namesakes, kMust, "EV-MAP1-VS-MAP2/2-D", kEachTargetForm(kSurfaces))
(Test& t, const TargetForm& form) {
  const GLenum namesake = form.target - gl::kMap2Targets[0] + gl::kMap1Targets[0];
  for (const bool two_first : {false, true}) {
    gl::Case c(two_first ? "Map2 then Map1" : "Map1 then Map2");
    const Map two = over(random_map(t, form.target, {4, 3}), {6, 7}, {8, 9});
    const Map one = random_map(t, namesake, 5);
    if (two_first) define(c, two, form.doubles);
    define(c, one, form.doubles);
    if (!two_first) define(c, two, form.doubles);
    judge_maps(t, c, {one, two}, form.doubles);
  }
};

}  // namespace
}  // namespace evalcts::suite_map_state
