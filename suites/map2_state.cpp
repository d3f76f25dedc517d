// Section 4 of the requirements, the state: what Map2 keeps, where it reads it, and what it leaves alone.
#include <fmt/format.h>

#include <utility>

#include "suites/maps.h"

namespace evalcts::suite_map2_state {
namespace {

using Orders = std::pair<int, int>;

// Square and not, in either direction, up to the largest.
std::vector<Orders> some_orders(int max) {
  return {{1, 1}, {2, 3}, {3, 2}, {4, 4}, {1, 5}, {5, 1}, {max, 1}, {1, max}, {2, max}, {max, 3}, {max, max}};
}

// Nine maps that differ in everything.
std::vector<Map2> nine_maps(Test& t) {
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
  Definitions(Test& t, const std::string& identity) : t_(t), script_(identity) {}

  void add(const Map2& map, bool doubles, gl::AfterCall after = gl::AfterCall::keep) {
    define(script_, map, doubles, after);
    add_defined(map, doubles);
  }
  void add_in_slot(const Map2& map, bool doubles, int slot) {
    define_in_slot(script_, map, doubles, slot);
    add_defined(map, doubles);
  }
  gl::Case& script() { return script_; }

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

EVALCTS_LISTED_TESTS(Map2State, EveryOrderAccepted, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-ORDER-ALL") {
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
}

// k shows in two ways: where the stride errors begin, and in how much COEFF answers.
EVALCTS_LISTED_TESTS(Map2State, ValuesPerPoint, gl::kMap2Targets, GLenum target, must, "EV-MAP2-K") {
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
}

// Each net, whatever its layout, ends before an inaccessible page.
EVALCTS_LISTED_TESTS(Map2State, Layouts, target_forms2(), const TargetForm& form, must, "EV-MAP2-ADDRESS",
                     "EV-MAP2-PADDING", "EV-MAP2-STRIDE-FREE") {
  for (const Layout& layout : kLayouts) {
    if (layout.shared) continue;
    Definitions definitions(t, layout.name);
    for (const auto& [u, v] : some_orders(t.max_order()))
      definitions.add(random_map2(t, form.target, u, v, layout), form.doubles);
    definitions.check();
  }
}

EVALCTS_LISTED_TESTS(Map2State, LargeStrides, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-ADDRESS", "EV-MAP2-PADDING", "EV-MAP2-STRIDE-FREE") {
  Definitions definitions(t, "strides up to 1000");
  for (const auto& [ustride, vstride] :
       {std::pair{1000, 17}, {17, 1000}, {257, 64}, {64, 257}, {300, 5}, {5, 300}})
    for (const auto& [u, v] : {Orders{3, 4}, {4, 3}, {1, 6}, {6, 1}})
      definitions.add(random_map2(t, form.target, u, v, ustride, vstride), form.doubles);
  // More than 16 bits hold.
  definitions.add(random_map2(t, form.target, 2, 3, 0x10000 + 20, 5), form.doubles);
  definitions.add(random_map2(t, form.target, 3, 2, 5, 0x10000 + 20), form.doubles);
  definitions.check();
}

// The same net from either order of memory is the same map.
EVALCTS_LISTED_TESTS(Map2State, SameNetEitherWay, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-ADDRESS") {
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
}

EVALCTS_LISTED_TESTS(Map2State, SharedPoints, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-STRIDE-FREE", "EV-MAP2-ADDRESS") {
  for (const Layout& layout : kLayouts) {
    if (!layout.shared) continue;
    Definitions definitions(t, layout.name);
    for (const auto& [u, v] : some_orders(t.max_order()))
      definitions.add(random_map2(t, form.target, u, v, layout), form.doubles);
    definitions.check();
  }
}

EVALCTS_LISTED_TESTS(Map2State, StridesCountValues, gl::kMap2Targets, GLenum target, must,
                     "EV-MAP2-STRIDE-UNITS") {
  Definitions definitions(t, "the same integers in both forms");
  for (const auto& [ustride, vstride] : {std::pair{24, 6}, {6, 24}, {7, 50}, {5, 5}})
    for (const Form& form : kForms)
      definitions.add(random_map2(t, target, 4, 3, ustride, vstride), form.doubles);
  definitions.check();
}

EVALCTS_LISTED_TESTS(Map2State, CopyOnCall, kFates, const Fate& fate, must, "EV-MAP2-COPY") {
  for (const TargetForm& form : target_forms2()) {
    Definitions definitions(t, form.name);
    const int max = t.max_order();
    for (const Layout& layout : kLayouts)
      for (const auto& [u, v] : {Orders{1, 1}, {3, 4}, {max, 2}, {max, max}})
        definitions.add(random_map2(t, form.target, u, v, layout), form.doubles, fate.after);
    definitions.check();
  }
}

// Asked only when all are defined and gone.
EVALCTS_LISTED_TESTS(Map2State, CopiesOfAll, kFates, const Fate& fate, must, "EV-MAP2-COPY") {
  const std::vector<Map2> maps = nine_maps(t);
  for (const Form& form : kForms) {
    gl::Case c(fmt::format("all nine, form {}", form.name));
    for (const Map2& map : maps) define(c, map, form.doubles, fate.after);
    std::vector<MapQuery> queries;
    for (const Map2& map : maps) queries.push_back(query_map(c, map.target, t.max_order(), form.doubles));
    Played played = t.play(c);
    for (std::size_t i = 0; i < maps.size(); ++i) expect_map(played, queries[i], maps[i], form.doubles);
  }
}

// The same memory with other contents is another definition, whatever a library remembers of the pointer.
EVALCTS_LISTED_TESTS(Map2State, SamePointerNewPoints, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-COPY", "EV-MAP2-REPLACE") {
  Definitions definitions(t, "three definitions through one array");
  for (int round = 0; round < 3; ++round)
    definitions.add_in_slot(random_map2(t, form.target, 4, 3, 15, 5), form.doubles, 0);
  definitions.check();
}

EVALCTS_LISTED_TESTS(Map2State, Replace, gl::kMap2Targets, GLenum target, must, "EV-MAP2-REPLACE") {
  const int max = t.max_order();
  const std::vector<Map2> others = nine_maps(t);
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
    for (const Map2& other : others) define(c, other);
    define(c, first);
    define(c, second);
    std::vector<MapQuery> queries;
    for (const Map2& other : others) queries.push_back(query_map(c, other.target, max));
    Played played = t.play(c);
    for (std::size_t i = 0; i < others.size(); ++i)
      expect_map(played, queries[i], others[i].target == target ? second : others[i]);
  }
}

// Each definition is queried before the next: nothing of an answer is left, whatever stays the same.
EVALCTS_LISTED_TESTS(Map2State, ReplaceAfterQuery, gl::kMap2Targets, GLenum target, must, "EV-MAP2-REPLACE") {
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
}

EVALCTS_LISTED_TEST(Map2State, IndependentLargeNets, must, "EV-MAP2-REPLACE") {
  const int max = t.max_order();
  for (const auto& [u, v] : {Orders{max, 3}, {4, max}}) {
    gl::Case c(u == max ? "all MAXx3" : "all 4xMAX");
    std::vector<Map2> maps;
    for (const GLenum target : gl::kMap2Targets) {
      maps.push_back(random_map2(t, target, u, v));
      define(c, maps.back());
    }
    std::vector<MapQuery> queries;
    for (const Map2& map : maps) queries.push_back(query_map(c, map.target, max));
    Played played = t.play(c);
    for (std::size_t i = 0; i < maps.size(); ++i) expect_map(played, queries[i], maps[i]);
  }
}

EVALCTS_LISTED_TEST(Map2State, Independent, must, "EV-MAP2-REPLACE") {
  const std::vector<Map2> maps = nine_maps(t);
  for (const bool reversed : {false, true}) {
    gl::Case c(reversed ? "defined from the last to the first" : "defined from the first to the last");
    for (std::size_t i = 0; i < maps.size(); ++i) define(c, maps[reversed ? maps.size() - 1 - i : i]);
    std::vector<MapQuery> queries;
    for (const Map2& map : maps) queries.push_back(query_map(c, map.target, t.max_order()));
    Played played = t.play(c);
    for (std::size_t i = 0; i < maps.size(); ++i) expect_map(played, queries[i], maps[i]);
  }
}

// Everything but the MAP2 maps themselves: one-dimensional maps, grids, AUTO_NORMAL, current values.
EVALCTS_LISTED_TEST(Map2State, LeavesTheRestAlone, must, "EV-MAP1-VS-MAP2/2-D", "EV-MAP2-REPLACE") {
  for (const Form& form : kForms) {
    gl::Case c(fmt::format("all nine defined, {} form", form.name));
    for (const GLenum target : gl::kMap1Targets) define(c, random_map(t, target, 3));
    const std::vector<gl::Ref> before = query_everything(c, t.max_order());
    for (const Map2& map : nine_maps(t)) define(c, map, form.doubles);
    const std::vector<gl::Ref> after = query_everything(c, t.max_order());
    Played played = t.play(c);
    // The last four answers for each of the nine MAP2 maps are those that may change.
    for (std::size_t i = 0; i < before.size() - 4 * gl::kMap2Targets.size(); ++i)
      played.expect_same(before[i], after[i]);
  }
}

// A pair of namesakes, defined in either order, queried together.
EVALCTS_LISTED_TESTS(Map2State, Namesakes, target_forms2(), const TargetForm& form, must,
                     "EV-MAP1-VS-MAP2/2-D") {
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
}

EVALCTS_LISTED_TESTS(Map2State, EnableUntouched, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-NOENABLE") {
  std::vector<GLenum> caps(gl::kMap1Targets.begin(), gl::kMap1Targets.end());
  caps.insert(caps.end(), gl::kMap2Targets.begin(), gl::kMap2Targets.end());
  caps.push_back(GL_AUTO_NORMAL);
  gl::Case c("all disabled; it alone enabled; all enabled");
  std::vector<std::pair<gl::Ref, GLboolean>> expected;
  for (const int stage : {0, 1, 2}) {
    if (stage == 1) c.Enable(form.target);
    if (stage == 2)
      for (const GLenum other : caps) c.Enable(other);
    for (const auto& [u, v] : {Orders{3, 2}, {1, 1}}) {
      define(c, random_map2(t, form.target, u, v, 15, 4), form.doubles);
      for (const GLenum other : caps)
        expected.emplace_back(c.IsEnabled(other), stage == 2 || (stage == 1 && other == form.target));
    }
  }
  Played played = t.play(c);
  for (const auto& [query, enabled] : expected) played.expect_result(query, enabled);

  gl::Case first("enabled before anything was defined");
  for (const GLenum other : caps) first.Enable(other);
  define(first, random_map2(t, form.target, 3, 2, 15, 4), form.doubles);
  std::vector<gl::Ref> enabled;
  for (const GLenum other : caps) enabled.push_back(first.IsEnabled(other));
  Played played_first = t.play(first);
  for (const gl::Ref query : enabled) played_first.expect_result(query, GL_TRUE);
}

// The points are plain client memory: pixel store modes and bound buffers move nothing.
EVALCTS_LISTED_TESTS(Map2State, PixelStoreIgnored, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-ADDRESS") {
  Definitions definitions(t, "swapped bytes, row length, skips, alignment");
  gl::Case& c = definitions.script();
  c.PixelStorei(GL_UNPACK_SWAP_BYTES, GL_TRUE);
  c.PixelStorei(GL_UNPACK_LSB_FIRST, GL_TRUE);
  c.PixelStorei(GL_UNPACK_ROW_LENGTH, 7);
  c.PixelStorei(GL_UNPACK_SKIP_ROWS, 1);
  c.PixelStorei(GL_UNPACK_SKIP_PIXELS, 3);
  c.PixelStorei(GL_UNPACK_ALIGNMENT, 8);
  definitions.add(random_map2(t, form.target, 4, 3, 20, 5), form.doubles);
  definitions.check();
}

EVALCTS_LISTED_TESTS(Map2State, BuffersIgnored, target_forms2(), const TargetForm& form, must,
                     "EV-MAP2-ADDRESS") {
  t.require(1, 5, "GL_ARB_vertex_buffer_object");
  Definitions definitions(t, "ARRAY_BUFFER and, from 2.1 on, PIXEL_UNPACK_BUFFER bound");
  gl::Case& c = definitions.script();
  const gl::ResultOf buffer{c.GenBuffers(1, gl::out<GLuint>(1)).index, 0};
  c.BindBuffer(GL_ARRAY_BUFFER, buffer);
  c.BufferData(GL_ARRAY_BUFFER, 4096, nullptr, GL_STATIC_DRAW);
  if (t.gl().at_least(2, 1)) c.BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
  definitions.add(random_map2(t, form.target, 4, 3, 20, 5), form.doubles);
  definitions.check();
}

}  // namespace evalcts::suite_map2_state
