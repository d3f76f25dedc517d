// Sections 3 and 4 of the requirements, the state: what Map1 and Map2 keep, where they read it, and what they
// leave unchanged.
#include <fmt/format.h>

#include <functional>
#include <span>
#include <utility>

#include <evalcts/testkit/registration.h>

#include "maps.h"

namespace evalcts::suite_map_state {
namespace {

// --- Rules of both dimensions ----------------------------------------------------------------------------

// Queries the maps after the commands of `c`, which have to have defined them.
template <class Map>
void expect_maps(Test& t, gl::Case c, const std::vector<Map>& maps, bool doubles = false) {
  std::vector<MapQuery> queries;
  for (const Map& map : maps) queries.push_back(query_map(c, map.target, t.max_order(), doubles));
  Played played = t.play(c);
  for (std::size_t i = 0; i < maps.size(); ++i) expect_map(played, queries[i], maps[i], doubles);
}

// Defines a map of the same target as one of `others` after them, and then another.
template <class Map>
void expect_replaced(Test& t, gl::Case c, std::vector<Map> others, const Map& first, const Map& second) {
  for (const Map& other : others) define(c, other);
  define(c, first);
  define(c, second);
  for (Map& other : others)
    if (other.target == second.target) other = second;
  expect_maps(t, c, others);
}

template <class Map>
void expect_independent(Test& t, const std::vector<Map>& maps) {
  for (const bool reversed : {false, true}) {
    gl::Case c(reversed ? "defined from the last to the first" : "defined from the first to the last");
    for (std::size_t i = 0; i < maps.size(); ++i) define(c, maps[reversed ? maps.size() - 1 - i : i]);
    expect_maps(t, c, maps);
  }
}

// `define_map` defines a map of the target: a constant one, or a longer one. It enables and disables nothing.
void expect_enables_untouched(Test& t, GLenum target, std::span<const GLenum> caps,
                              const std::function<void(gl::Case&, bool constant)>& define_map) {
  gl::Case c("all disabled; it alone enabled; all enabled");
  std::vector<std::pair<gl::Ref, GLboolean>> expected;
  for (const int stage : {0, 1, 2}) {
    if (stage == 1) c.Enable(target);
    if (stage == 2)
      for (const GLenum other : caps) c.Enable(other);
    for (const bool constant : {false, true}) {
      define_map(c, constant);
      for (const GLenum other : caps)
        expected.emplace_back(c.IsEnabled(other), stage == 2 || (stage == 1 && other == target));
    }
  }
  Played played = t.play(c);
  for (const auto& [query, enabled] : expected) played.expect_result(query, enabled);

  gl::Case first("enabled before anything was defined");
  for (const GLenum other : caps) first.Enable(other);
  define_map(first, false);
  std::vector<gl::Ref> enabled;
  for (const GLenum other : caps) enabled.push_back(first.IsEnabled(other));
  Played played_first = t.play(first);
  for (const gl::Ref query : enabled) played_first.expect_result(query, GL_TRUE);
}

// Sets pixel store modes, which must not affect how control points are read.
gl::Case with_pixel_store() {
  gl::Case c("swapped bytes, row length, skips, alignment");
  c.PixelStorei(GL_UNPACK_SWAP_BYTES, GL_TRUE);
  c.PixelStorei(GL_UNPACK_LSB_FIRST, GL_TRUE);
  c.PixelStorei(GL_UNPACK_ROW_LENGTH, 7);
  c.PixelStorei(GL_UNPACK_SKIP_ROWS, 1);
  c.PixelStorei(GL_UNPACK_SKIP_PIXELS, 3);
  c.PixelStorei(GL_UNPACK_ALIGNMENT, 8);
  return c;
}
// The same of bound buffers.
gl::Case with_buffers(const Test& t) {
  t.require(1, 5, "GL_ARB_vertex_buffer_object");
  gl::Case c("ARRAY_BUFFER and, from 2.1 on, PIXEL_UNPACK_BUFFER bound");
  const gl::ResultOf buffer{c.GenBuffers(1, gl::out<GLuint>(1)).index, 0};
  c.BindBuffer(GL_ARRAY_BUFFER, buffer);
  c.BufferData(GL_ARRAY_BUFFER, 4096, nullptr, GL_STATIC_DRAW);
  if (t.gl().at_least(2, 1)) c.BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
  return c;
}

// --- One-dimensional maps --------------------------------------------------------------------------------

// Nine maps that differ in everything.
std::vector<Map1> nine_maps1(Test& t) {
  std::vector<Map1> maps;
  for (std::size_t i = 0; i < gl::kMap1Targets.size(); ++i) {
    Map1 map = random_map(t, gl::kMap1Targets[i], 1 + static_cast<int>(i) % 8, 5);
    map.u1 = static_cast<double>(i);
    map.u2 = 20.0 + static_cast<double>(i);
    maps.push_back(map);
  }
  return maps;
}

}  // namespace

EVALCTS_TEST(Map1State, EveryOrderAccepted, must, "EV-MAP1-ORDER-ALL",
             combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  gl::Case c("orders 1 to MAX");
  std::vector<std::pair<gl::Ref, gl::Ref>> answers;
  for (int order = 1; order <= t.max_order(); ++order) {
    define(c, random_map(t, form.target, order, 4), form.doubles);
    const gl::Ref error = c.GetError();
    answers.emplace_back(error, c.GetMapiv(form.target, GL_ORDER, gl::out<GLint>(1)));
  }
  Played played = t.play(c);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    played.expect_no_error(answers[i].first);
    played.expect_values(answers[i].second, std::vector<GLint>{static_cast<GLint>(i) + 1});
  }
};

// k shows in two ways: where the stride error begins, and in how much COEFF answers.
EVALCTS_TEST(Map1State, ValuesPerPoint, must, "EV-MAP1-K",
             combine(gl::kMap1Targets).by(gl::list_deliveries()))
(Test& t, GLenum target) {
  const int k = gl::components_of(target);
  gl::Case c("strides k and k-1; size of COEFF");
  define(c, random_map(t, target, 3, k));
  const gl::Ref accepted = c.GetError();
  const gl::Ref coefficients = c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(32));
  Map1 narrow = random_map(t, target, 3, k);
  narrow.stride = k - 1;
  define(c, narrow);
  const gl::Ref refused = c.GetError();
  Played played = t.play(c);
  played.expect_no_error(accepted);
  played.expect_error(refused, {GL_INVALID_VALUE});
  played.expect(played.trace().written(coefficients) == static_cast<std::size_t>(3 * k), coefficients,
                "COEFF of a map of order 3 does not answer 3*k values", fmt::format("{} values", 3 * k),
                fmt::format("{} values", played.trace().written(coefficients)));
};

EVALCTS_TEST(Map1State, Stride, must, "EV-MAP1-STRIDE", "EV-MAP1-PADDING",
             combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  const int k = gl::components_of(form.target);
  for (const int stride : {k, k + 1, 2 * k, 17, 257, 1000, 0x10000 + k})
    for (const int order : {1, 2, 5, t.max_order()}) {
      if (stride > 0x10000 && order != 2) continue;  // half a megabyte for each point
      const Map1 map = random_map(t, form.target, order, stride);
      gl::Case c(fmt::format("stride {} order {}", stride, order));
      define(c, map, form.doubles);
      const gl::Ref error = c.GetError();
      const MapQuery query = query_map(c, form.target, t.max_order(), form.doubles);
      Played played = t.play(c);
      played.expect_no_error(error);
      expect_map(played, query, map, form.doubles);
    }
};

EVALCTS_TEST(Map1State, SmallestStride, must, "EV-MAP1-STRIDE-MIN",
             combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  for (const int order : {1, 2, t.max_order()}) {
    gl::Case c(fmt::format("stride k, order {}", order));
    define(c, random_map(t, form.target, order, gl::components_of(form.target)), form.doubles);
    const gl::Ref error = c.GetError();
    const gl::Ref defined = c.GetMapiv(form.target, GL_ORDER, gl::out<GLint>(1));
    Played played = t.play(c);
    played.expect_no_error(error);
    played.expect_values(defined, std::vector<GLint>{order});
  }
};

EVALCTS_TEST(Map1State, CopyOnCall, must, "EV-MAP1-COPY", combine(kFates).by(gl::list_deliveries()))
(Test& t, const Fate& fate) {
  for (const TargetForm& form : target_forms())
    for (const int order : {1, 4, t.max_order()})
      for (const int stride : {gl::components_of(form.target), 5}) {
        const Map1 map = random_map(t, form.target, order, stride);
        gl::Case c(fmt::format("{} order {} stride {}", form.name, order, stride));
        define(c, map, form.doubles, fate.after);
        const MapQuery query = query_map(c, form.target, t.max_order(), form.doubles);
        Played played = t.play(c);
        expect_map(played, query, map, form.doubles);
      }
};

EVALCTS_TEST(Map1State, CopyOnCallEvaluated, must, "EV-MAP1-COPY", combine(kFates).by(gl::list_deliveries()))
(Test& t, const Fate& fate) {
  for (const GLenum target : visible_targets()) {
    gl::Case c(label(target) + ", both forms");
    enable_visibly(c, target);
    for (const Form& form : kForms)
      for (const int order : {1, 4, t.max_order()})
        for (const int stride : {gl::components_of(target), 5}) {
          define(c, random_map(t, target, order, stride), form.doubles, fate.after);
          evaluate_some(c);
        }
    t.expect_emission(c, attribute_of(target));
  }
};

// The same memory with other contents is another definition, whatever a library remembers of the pointer.
EVALCTS_TEST(Map1State, SamePointerNewPoints, must, "EV-MAP1-COPY", "EV-MAP1-REPLACE", "EV-MAP1-LIVE",
             combine(visible_target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  gl::Case c("three definitions through one array");
  enable_visibly(c, form.target);
  for (int round = 0; round < 3; ++round) {
    define_in_slot(c, random_map(t, form.target, 4, 5), form.doubles, 0);
    evaluate_some(c);
  }
  t.expect_emission(c, attribute_of(form.target));

  gl::Case queried("two definitions through one array, queried");
  define_in_slot(queried, random_map(t, form.target, 3, 5), form.doubles, 0);
  const Map1 second = random_map(t, form.target, 3, 5);
  define_in_slot(queried, second, form.doubles, 0);
  const MapQuery query = query_map(queried, form.target, t.max_order(), form.doubles);
  Played played = t.play(queried);
  expect_map(played, query, second, form.doubles);
};

EVALCTS_TEST(Map1State, Replace, must, "EV-MAP1-REPLACE", combine(gl::kMap1Targets).by(gl::list_deliveries()))
(Test& t, GLenum target) {
  for (const std::pair<int, int>& orders :
       {std::pair{5, 2}, {2, 5}, {4, 4}, {1, 1}, {1, t.max_order()}, {t.max_order(), 1}}) {
    gl::Case c(fmt::format("order {} then {}", orders.first, orders.second));
    Map1 first = random_map(t, target, orders.first, 4);
    Map1 second = random_map(t, target, orders.second, 6);
    first.u1 = 3, first.u2 = 4, second.u1 = -1, second.u2 = 0.5;
    expect_replaced(t, c, nine_maps1(t), first, second);
  }
};

// Each definition is queried before the next: nothing of an answer is left, whatever stays the same.
EVALCTS_TEST(Map1State, ReplaceAfterQuery, must, "EV-MAP1-REPLACE",
             combine(gl::kMap1Targets).by(gl::list_deliveries()))
(Test& t, GLenum target) {
  gl::Case c("another domain, other points, another order, the first once more");
  std::vector<Map1> maps = {random_map(t, target, 4, 5)};
  maps.push_back(maps[0]);
  maps[1].u1 = -1, maps[1].u2 = 3;
  maps.push_back(random_map(t, target, 4, 5));
  maps[2].u1 = -1, maps[2].u2 = 3;
  maps.push_back(random_map(t, target, 2, 4));
  maps.push_back(maps[0]);
  std::vector<MapQuery> queries;
  for (const Map1& map : maps) {
    define(c, map);
    queries.push_back(query_map(c, target, t.max_order()));
  }
  Played played = t.play(c);
  for (std::size_t i = 0; i < maps.size(); ++i) expect_map(played, queries[i], maps[i]);
};

EVALCTS_TEST(Map1State, IndependentLongMaps, must, "EV-MAP1-INDEP", by(gl::list_deliveries()))
(Test& t) {
  for (const int fewer : {0, 1}) {
    gl::Case c(fewer == 0 ? "all of the largest order" : "all of one less");
    std::vector<Map1> maps;
    for (const GLenum target : gl::kMap1Targets) {
      maps.push_back(random_map(t, target, t.max_order() - fewer, 4));
      define(c, maps.back());
    }
    expect_maps(t, c, maps);
  }
};

EVALCTS_TEST(Map1State, Independent, must, "EV-MAP1-INDEP", by(gl::list_deliveries()))
(Test& t) { expect_independent(t, nine_maps1(t)); };

// A one-dimensional definition leaves all two-dimensional maps alone; the reverse needs Map2.
EVALCTS_TEST(Map1State, LeavesMap2Alone, must, "EV-MAP1-VS-MAP2/1-D", "EV-MAP1-REPLACE",
             by(gl::list_deliveries()))
(Test& t) {
  for (const Form& form : kForms) {
    gl::Case c(fmt::format("all nine defined, {} form", form.name));
    const std::vector<gl::Ref> before = query_everything(c, t.max_order());
    for (const Map1& map : nine_maps1(t)) define(c, map, form.doubles);
    const std::vector<gl::Ref> after = query_everything(c, t.max_order());
    Played played = t.play(c);
    // All but the four answers for each of the nine MAP1 maps: grids, AUTO_NORMAL and current values, too.
    for (std::size_t i = 4 * gl::kMap1Targets.size(); i < before.size(); ++i)
      played.expect_same(before[i], after[i]);
  }
};

EVALCTS_TEST(Map1State, EnableUntouched, must, "EV-MAP1-NOENABLE",
             combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  expect_enables_untouched(t, form.target, gl::kMap1Targets, [&](gl::Case& c, bool constant) {
    define(c, random_map(t, form.target, constant ? 1 : 3, 4), form.doubles);
  });
};

// Also at the argument that was evaluated last, and with the order that the map had.
EVALCTS_TEST(Map1State, Live, must, "EV-MAP1-LIVE", combine(visible_target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  gl::Case c("evaluate, define anew, evaluate");
  enable_visibly(c, form.target);
  Map1 map;
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
  map.u2 = 2;  // and nothing else
  define_and_evaluate();
  c.Disable(form.target);
  define(c, random_map(t, form.target, 6, 4), form.doubles);
  enable_visibly(c, form.target);
  evaluate_some(c);
  t.expect_emission(c, attribute_of(form.target));
};

EVALCTS_TEST(Map1State, PixelStoreIgnored, must, "EV-MAP1-NOPIXELSTORE",
             combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  gl::Case c = with_pixel_store();
  const Map1 map = random_map(t, form.target, 4, 5);
  define(c, map, form.doubles);
  expect_maps(t, c, std::vector{map}, form.doubles);
};

EVALCTS_TEST(Map1State, BuffersIgnored, must, "EV-MAP1-NOBUFFER",
             combine(target_forms()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  gl::Case c = with_buffers(t);
  const Map1 map = random_map(t, form.target, 4, 5);
  define(c, map, form.doubles);
  expect_maps(t, c, std::vector{map}, form.doubles);
};

// --- Two-dimensional maps --------------------------------------------------------------------------------

namespace {

using Orders = std::pair<int, int>;

// Square and not, in either direction, up to the largest.
std::vector<Orders> some_orders(int max) {
  return {{1, 1}, {2, 3}, {3, 2}, {4, 4}, {1, 5}, {5, 1}, {max, 1}, {1, max}, {2, max}, {max, 3}, {max, max}};
}

// Nine maps that differ in everything.
std::vector<Map2> nine_maps2(Test& t) {
  std::vector<Map2> maps;
  for (std::size_t i = 0; i < gl::kMap2Targets.size(); ++i) {
    const int n = static_cast<int>(i);
    Map2 map = random_map2(t, gl::kMap2Targets[i], 1 + n % 8, 1 + (3 * n + 2) % 8, kLayouts[i % 4]);
    map.u1 = n, map.u2 = 20 + n, map.v1 = 40 - n, map.v2 = 30 - n;
    maps.push_back(map);
  }
  return maps;
}

// Defines maps one behind the other in one case: none is an error, each is what GetMap then answers.
class Definitions {
 public:
  Definitions(Test& t, const std::string& identity) : Definitions(t, gl::Case(identity)) {}
  // After these commands.
  Definitions(Test& t, gl::Case script) : t_(t), script_(std::move(script)) {}

  void add(const Map2& map, bool doubles, gl::AfterCall after = gl::AfterCall::keep) {
    define(script_, map, doubles, after);
    add_defined(map, doubles);
  }
  void add_in_slot(const Map2& map, bool doubles, int slot) {
    define_in_slot(script_, map, doubles, slot);
    add_defined(map, doubles);
  }

  void check() {
    Played played = t_.play(script_);
    for (const Definition& definition : definitions_) {
      played.expect_no_error(definition.error);
      expect_map(played, definition.query, definition.map, definition.doubles);
    }
  }

 private:
  struct Definition {
    Map2 map;
    bool doubles;
    gl::Ref error;
    MapQuery query;
  };

  void add_defined(const Map2& map, bool doubles) {
    const gl::Ref error = script_.GetError();
    definitions_.push_back({map, doubles, error, query_map(script_, map.target, t_.max_order(), doubles)});
  }

  Test& t_;
  gl::Case script_;
  std::vector<Definition> definitions_;
};

}  // namespace

EVALCTS_TEST(Map2State, EveryOrderAccepted, must, "EV-MAP2-ORDER-ALL",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  const int max = t.max_order();
  std::vector<Orders> pairs;
  const int small = t.by_depth(4, 8, max);
  for (int u = 1; u <= small; ++u)
    for (int v = 1; v <= small; ++v) pairs.emplace_back(u, v);
  for (const int order : {1, 2, max - 1, max}) {
    pairs.emplace_back(order, max);
    pairs.emplace_back(max, order);
  }
  gl::Case c("all small pairs, and those with MAX");
  std::vector<std::pair<gl::Ref, gl::Ref>> answers;
  for (const auto& [u, v] : pairs) {
    define(c, random_map2(t, form.target, u, v), form.doubles);
    const gl::Ref error = c.GetError();
    answers.emplace_back(error, c.GetMapiv(form.target, GL_ORDER, gl::out<GLint>(2)));
  }
  Played played = t.play(c);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    played.expect_no_error(answers[i].first);
    played.expect_values(answers[i].second, std::vector<GLint>{pairs[i].first, pairs[i].second});
  }
};

// k shows in two ways: where the stride errors begin, and in how much COEFF answers.
EVALCTS_TEST(Map2State, ValuesPerPoint, must, "EV-MAP2-K",
             combine(gl::kMap2Targets).by(gl::list_deliveries()))
(Test& t, GLenum target) {
  const int k = gl::components_of(target);
  gl::Case c("strides k and k-1; size of COEFF");
  Map2 map = random_map2(t, target, 3, 2, k, k);
  define(c, map);
  const gl::Ref accepted = c.GetError();
  const gl::Ref coefficients = c.GetMapfv(target, GL_COEFF, gl::out<GLfloat>(64));
  std::vector<gl::Ref> refused;
  for (int Map2::*const stride : {&Map2::ustride, &Map2::vstride}) {
    Map2 narrow = map;
    narrow.*stride = k - 1;
    define(c, narrow);
    refused.push_back(c.GetError());
  }
  Played played = t.play(c);
  played.expect_no_error(accepted);
  for (const gl::Ref error : refused) played.expect_error(error, {GL_INVALID_VALUE});
  played.expect(played.trace().written(coefficients) == static_cast<std::size_t>(6 * k), coefficients,
                "COEFF of a map of order 3x2 does not answer 6*k values", fmt::format("{} values", 6 * k),
                fmt::format("{} values", played.trace().written(coefficients)));
};

// Each net, whatever its layout, ends before an inaccessible page.
EVALCTS_TEST(Map2State, Layouts, must, "EV-MAP2-ADDRESS", "EV-MAP2-PADDING", "EV-MAP2-STRIDE-FREE",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  for (const Layout& layout : kLayouts) {
    if (layout.shared) continue;
    Definitions definitions(t, layout.name);
    for (const auto& [u, v] : some_orders(t.max_order()))
      definitions.add(random_map2(t, form.target, u, v, layout), form.doubles);
    definitions.check();
  }
};

EVALCTS_TEST(Map2State, LargeStrides, must, "EV-MAP2-ADDRESS", "EV-MAP2-PADDING", "EV-MAP2-STRIDE-FREE",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  Definitions definitions(t, "strides up to 1000");
  for (const auto& [ustride, vstride] :
       {std::pair{1000, 17}, {17, 1000}, {257, 64}, {64, 257}, {300, 5}, {5, 300}})
    for (const auto& [u, v] : {Orders{3, 4}, {4, 3}, {1, 6}, {6, 1}})
      definitions.add(random_map2(t, form.target, u, v, ustride, vstride), form.doubles);
  // More than 16 bits hold.
  definitions.add(random_map2(t, form.target, 2, 3, 0x10000 + 20, 5), form.doubles);
  definitions.add(random_map2(t, form.target, 3, 2, 5, 0x10000 + 20), form.doubles);
  definitions.check();
};

// The same net from either order of memory is the same map.
EVALCTS_TEST(Map2State, SameNetEitherWay, must, "EV-MAP2-ADDRESS",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  const int k = gl::components_of(form.target);
  gl::Case c("3x5 in both orders of memory");
  const std::vector<double> net = random_values(t.random(), static_cast<std::size_t>(3 * 5 * k));
  std::vector<gl::Ref> answers;
  for (const Layout& layout : {kLayouts[0], kLayouts[1]}) {
    define(c, random_map2(t, form.target, 2, 2), form.doubles);  // so that nothing is left of the net before
    define(c, make_map2(form.target, 3, 5, layout.ustride(k, 3, 5), layout.vstride(k, 3, 5), net),
           form.doubles);
    answers.push_back(c.GetMapdv(form.target, GL_COEFF, gl::out<GLdouble>(net.size())));
  }
  Played played = t.play(c);
  played.expect_same(answers[0], answers[1]);
  for (const gl::Ref answer : answers) played.expect_values_near(answer, net, 1e-5);
};

EVALCTS_TEST(Map2State, SharedPoints, must, "EV-MAP2-STRIDE-FREE", "EV-MAP2-ADDRESS",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  for (const Layout& layout : kLayouts) {
    if (!layout.shared) continue;
    Definitions definitions(t, layout.name);
    for (const auto& [u, v] : some_orders(t.max_order()))
      definitions.add(random_map2(t, form.target, u, v, layout), form.doubles);
    definitions.check();
  }
};

EVALCTS_TEST(Map2State, StridesCountValues, must, "EV-MAP2-STRIDE-UNITS",
             combine(gl::kMap2Targets).by(gl::list_deliveries()))
(Test& t, GLenum target) {
  Definitions definitions(t, "the same integers in both forms");
  for (const auto& [ustride, vstride] : {std::pair{24, 6}, {6, 24}, {7, 50}, {5, 5}})
    for (const Form& form : kForms)
      definitions.add(random_map2(t, target, 4, 3, ustride, vstride), form.doubles);
  definitions.check();
};

EVALCTS_TEST(Map2State, CopyOnCall, must, "EV-MAP2-COPY", combine(kFates).by(gl::list_deliveries()))
(Test& t, const Fate& fate) {
  for (const TargetForm& form : target_forms2()) {
    Definitions definitions(t, form.name);
    const int max = t.max_order();
    for (const Layout& layout : kLayouts)
      for (const auto& [u, v] : {Orders{1, 1}, {3, 4}, {max, 2}, {max, max}})
        definitions.add(random_map2(t, form.target, u, v, layout), form.doubles, fate.after);
    definitions.check();
  }
};

// Asked only when all are defined and gone.
EVALCTS_TEST(Map2State, CopiesOfAll, must, "EV-MAP2-COPY", combine(kFates).by(gl::list_deliveries()))
(Test& t, const Fate& fate) {
  const std::vector<Map2> maps = nine_maps2(t);
  for (const Form& form : kForms) {
    gl::Case c(fmt::format("all nine, form {}", form.name));
    for (const Map2& map : maps) define(c, map, form.doubles, fate.after);
    expect_maps(t, c, maps, form.doubles);
  }
};

// The same memory with other contents is another definition, whatever a library remembers of the pointer.
EVALCTS_TEST(Map2State, SamePointerNewPoints, must, "EV-MAP2-COPY", "EV-MAP2-REPLACE",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  Definitions definitions(t, "three definitions through one array");
  for (int round = 0; round < 3; ++round)
    definitions.add_in_slot(random_map2(t, form.target, 4, 3, 15, 5), form.doubles, 0);
  definitions.check();
};

EVALCTS_TEST(Map2State, Replace, must, "EV-MAP2-REPLACE", combine(gl::kMap2Targets).by(gl::list_deliveries()))
(Test& t, GLenum target) {
  const int max = t.max_order();
  const std::vector<Map2> others = nine_maps2(t);
  for (const auto& [before, after] : {std::pair{Orders{5, 2}, Orders{2, 5}},
                                      {{2, 2}, {4, 4}},
                                      {{4, 4}, {2, 2}},
                                      {{3, 3}, {3, 3}},
                                      {{1, 1}, {max, max}},
                                      {{max, max}, {1, 1}},
                                      {{6, 2}, {4, 3}}}) {
    gl::Case c(fmt::format(
        "{} then {}",
        before == Orders{max, max} ? "MAXxMAX" : fmt::format("{}x{}", before.first, before.second),
        after == Orders{max, max} ? "MAXxMAX" : fmt::format("{}x{}", after.first, after.second)));
    Map2 first = random_map2(t, target, before.first, before.second, kLayouts[2]);
    Map2 second = random_map2(t, target, after.first, after.second, kLayouts[3]);
    first.u1 = 3, first.u2 = 4, first.v1 = -7, first.v2 = -8;
    second.u1 = -1, second.u2 = 0.5, second.v1 = 11, second.v2 = 13;
    expect_replaced(t, c, others, first, second);
  }
};

// Each definition is queried before the next: nothing of an answer is left, whatever stays the same.
EVALCTS_TEST(Map2State, ReplaceAfterQuery, must, "EV-MAP2-REPLACE",
             combine(gl::kMap2Targets).by(gl::list_deliveries()))
(Test& t, GLenum target) {
  Definitions definitions(t, "the same values in other shapes, over other domains; another vorder");
  const std::vector<double> values =
      random_values(t.random(), static_cast<std::size_t>(12 * gl::components_of(target)));
  for (const auto& [u, v] : {Orders{2, 6}, {3, 4}, {4, 3}, {6, 2}, {12, 1}, {1, 12}}) {
    if (std::max(u, v) > t.max_order()) continue;
    Map2 map = make_map2(target, u, v, values);
    definitions.add(map, false);
    map.u2 = 3;
    definitions.add(map, false);
    map.v1 = -1;
    definitions.add(map, false);
  }
  for (const int vorder : {3, 5, 2, 3}) definitions.add(random_map2(t, target, 3, vorder), false);
  definitions.check();
};

EVALCTS_TEST(Map2State, IndependentLargeNets, must, "EV-MAP2-REPLACE", by(gl::list_deliveries()))
(Test& t) {
  const int max = t.max_order();
  for (const auto& [u, v] : {Orders{max, 3}, {4, max}}) {
    gl::Case c(u == max ? "all MAXx3" : "all 4xMAX");
    std::vector<Map2> maps;
    for (const GLenum target : gl::kMap2Targets) {
      maps.push_back(random_map2(t, target, u, v));
      define(c, maps.back());
    }
    expect_maps(t, c, maps);
  }
};

EVALCTS_TEST(Map2State, Independent, must, "EV-MAP2-REPLACE", by(gl::list_deliveries()))
(Test& t) { expect_independent(t, nine_maps2(t)); };

// Everything but the MAP2 maps themselves: one-dimensional maps, grids, AUTO_NORMAL, current values.
EVALCTS_TEST(Map2State, LeavesTheRestAlone, must, "EV-MAP1-VS-MAP2/2-D", "EV-MAP2-REPLACE",
             by(gl::list_deliveries()))
(Test& t) {
  for (const Form& form : kForms) {
    gl::Case c(fmt::format("all nine defined, {} form", form.name));
    for (const GLenum target : gl::kMap1Targets) define(c, random_map(t, target, 3));
    const std::vector<gl::Ref> before = query_everything(c, t.max_order());
    for (const Map2& map : nine_maps2(t)) define(c, map, form.doubles);
    const std::vector<gl::Ref> after = query_everything(c, t.max_order());
    Played played = t.play(c);
    // The last four answers for each of the nine MAP2 maps are those that may change.
    for (std::size_t i = 0; i < before.size() - 4 * gl::kMap2Targets.size(); ++i)
      played.expect_same(before[i], after[i]);
  }
};

// A pair of namesakes, defined in either order, queried together.
EVALCTS_TEST(Map2State, Namesakes, must, "EV-MAP1-VS-MAP2/2-D",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  const GLenum namesake = form.target - gl::kMap2Targets[0] + gl::kMap1Targets[0];
  for (const bool two_first : {false, true}) {
    gl::Case c(two_first ? "Map2 then Map1" : "Map1 then Map2");
    Map2 two = random_map2(t, form.target, 4, 3);
    two.u1 = 6, two.u2 = 7, two.v1 = 8, two.v2 = 9;
    const Map1 one = random_map(t, namesake, 5);
    if (two_first) define(c, two, form.doubles);
    define(c, one, form.doubles);
    if (!two_first) define(c, two, form.doubles);
    const MapQuery query1 = query_map(c, namesake, t.max_order(), form.doubles);
    const MapQuery query2 = query_map(c, form.target, t.max_order(), form.doubles);
    Played played = t.play(c);
    expect_map(played, query1, one, form.doubles);
    expect_map(played, query2, two, form.doubles);
  }
};

EVALCTS_TEST(Map2State, EnableUntouched, must, "EV-MAP2-NOENABLE",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  std::vector<GLenum> caps(gl::kMap1Targets.begin(), gl::kMap1Targets.end());
  caps.insert(caps.end(), gl::kMap2Targets.begin(), gl::kMap2Targets.end());
  caps.push_back(GL_AUTO_NORMAL);
  expect_enables_untouched(t, form.target, caps, [&](gl::Case& c, bool constant) {
    define(c, random_map2(t, form.target, constant ? 1 : 3, constant ? 1 : 2, 15, 4), form.doubles);
  });
};

// The points are plain client memory: pixel store modes and bound buffers move nothing.
EVALCTS_TEST(Map2State, PixelStoreIgnored, must, "EV-MAP2-ADDRESS",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  Definitions definitions(t, with_pixel_store());
  definitions.add(random_map2(t, form.target, 4, 3, 20, 5), form.doubles);
  definitions.check();
};

EVALCTS_TEST(Map2State, BuffersIgnored, must, "EV-MAP2-ADDRESS",
             combine(target_forms2()).by(gl::list_deliveries()))
(Test& t, const TargetForm& form) {
  Definitions definitions(t, with_buffers(t));
  definitions.add(random_map2(t, form.target, 4, 3, 20, 5), form.doubles);
  definitions.check();
};

}  // namespace evalcts::suite_map_state
