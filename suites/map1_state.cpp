// Section 3 of the requirements, the state: what Map1 keeps, and what it leaves alone.
#include <fmt/format.h>

#include "suites/maps.h"

namespace evalcts::suite_map1_state {
namespace {

// Nine maps that differ in everything.
std::vector<Map1> nine_maps(Test& t) {
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

EVALCTS_LISTED_TESTS(Map1State, EveryOrderAccepted, target_forms(), const TargetForm& form, must,
                     "EV-MAP1-ORDER-ALL") {
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
}

// k shows in two ways: where the stride error begins, and in how much COEFF answers.
EVALCTS_LISTED_TESTS(Map1State, ValuesPerPoint, gl::kMap1Targets, GLenum target, must, "EV-MAP1-K") {
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
}

EVALCTS_LISTED_TESTS(Map1State, Stride, target_forms(), const TargetForm& form, must, "EV-MAP1-STRIDE",
                     "EV-MAP1-PADDING") {
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
}

EVALCTS_LISTED_TESTS(Map1State, SmallestStride, target_forms(), const TargetForm& form, must,
                     "EV-MAP1-STRIDE-MIN") {
  for (const int order : {1, 2, t.max_order()}) {
    gl::Case c(fmt::format("stride k, order {}", order));
    define(c, random_map(t, form.target, order, gl::components_of(form.target)), form.doubles);
    const gl::Ref error = c.GetError();
    const gl::Ref defined = c.GetMapiv(form.target, GL_ORDER, gl::out<GLint>(1));
    Played played = t.play(c);
    played.expect_no_error(error);
    played.expect_values(defined, std::vector<GLint>{order});
  }
}

EVALCTS_LISTED_TESTS(Map1State, CopyOnCall, kFates, const Fate& fate, must, "EV-MAP1-COPY") {
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
}

EVALCTS_LISTED_TESTS(Map1State, CopyOnCallEvaluated, kFates, const Fate& fate, must, "EV-MAP1-COPY") {
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
}

// The same memory with other contents is another definition, whatever a library remembers of the pointer.
EVALCTS_LISTED_TESTS(Map1State, SamePointerNewPoints, visible_target_forms(), const TargetForm& form, must,
                     "EV-MAP1-COPY", "EV-MAP1-REPLACE", "EV-MAP1-LIVE") {
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
}

EVALCTS_LISTED_TESTS(Map1State, Replace, gl::kMap1Targets, GLenum target, must, "EV-MAP1-REPLACE") {
  for (const std::pair<int, int>& orders :
       {std::pair{5, 2}, {2, 5}, {4, 4}, {1, 1}, {1, t.max_order()}, {t.max_order(), 1}}) {
    gl::Case c(fmt::format("order {} then {}", orders.first, orders.second));
    Map1 first = random_map(t, target, orders.first, 4);
    Map1 second = random_map(t, target, orders.second, 6);
    first.u1 = 3, first.u2 = 4, second.u1 = -1, second.u2 = 0.5;
    std::vector<Map1> others = nine_maps(t);
    for (const Map1& other : others) define(c, other);
    define(c, first);
    define(c, second);
    std::vector<MapQuery> queries;
    for (const Map1& other : others) queries.push_back(query_map(c, other.target, t.max_order()));
    Played played = t.play(c);
    for (std::size_t i = 0; i < others.size(); ++i)
      expect_map(played, queries[i], others[i].target == target ? second : others[i]);
  }
}

// Each definition is queried before the next: nothing of an answer is left, whatever stays the same.
EVALCTS_LISTED_TESTS(Map1State, ReplaceAfterQuery, gl::kMap1Targets, GLenum target, must, "EV-MAP1-REPLACE") {
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
}

EVALCTS_LISTED_TEST(Map1State, IndependentLongMaps, must, "EV-MAP1-INDEP") {
  for (const int fewer : {0, 1}) {
    gl::Case c(fewer == 0 ? "all of the largest order" : "all of one less");
    std::vector<Map1> maps;
    for (const GLenum target : gl::kMap1Targets) {
      maps.push_back(random_map(t, target, t.max_order() - fewer, 4));
      define(c, maps.back());
    }
    std::vector<MapQuery> queries;
    for (const Map1& map : maps) queries.push_back(query_map(c, map.target, t.max_order()));
    Played played = t.play(c);
    for (std::size_t i = 0; i < maps.size(); ++i) expect_map(played, queries[i], maps[i]);
  }
}

EVALCTS_LISTED_TEST(Map1State, Independent, must, "EV-MAP1-INDEP") {
  const std::vector<Map1> maps = nine_maps(t);
  for (const bool reversed : {false, true}) {
    gl::Case c(reversed ? "defined from the last to the first" : "defined from the first to the last");
    for (std::size_t i = 0; i < maps.size(); ++i) define(c, maps[reversed ? maps.size() - 1 - i : i]);
    std::vector<MapQuery> queries;
    for (const Map1& map : maps) queries.push_back(query_map(c, map.target, t.max_order()));
    Played played = t.play(c);
    for (std::size_t i = 0; i < maps.size(); ++i) expect_map(played, queries[i], maps[i]);
  }
}

// A one-dimensional definition leaves all two-dimensional maps alone; the reverse needs Map2.
EVALCTS_LISTED_TEST(Map1State, LeavesMap2Alone, must, "EV-MAP1-VS-MAP2/1-D", "EV-MAP1-REPLACE") {
  for (const Form& form : kForms) {
    gl::Case c(fmt::format("all nine defined, {} form", form.name));
    const std::vector<gl::Ref> before = query_everything(c, t.max_order());
    for (const Map1& map : nine_maps(t)) define(c, map, form.doubles);
    const std::vector<gl::Ref> after = query_everything(c, t.max_order());
    Played played = t.play(c);
    // All but the four answers for each of the nine MAP1 maps: grids, AUTO_NORMAL and current values, too.
    for (std::size_t i = 4 * gl::kMap1Targets.size(); i < before.size(); ++i)
      played.expect_same(before[i], after[i]);
  }
}

EVALCTS_LISTED_TESTS(Map1State, EnableUntouched, target_forms(), const TargetForm& form, must,
                     "EV-MAP1-NOENABLE") {
  gl::Case c("all disabled; it alone enabled; all enabled");
  std::vector<std::pair<gl::Ref, GLboolean>> expected;
  for (const int stage : {0, 1, 2}) {
    if (stage == 1) c.Enable(form.target);
    if (stage == 2)
      for (const GLenum other : gl::kMap1Targets) c.Enable(other);
    for (const int order : {3, 1}) {
      define(c, random_map(t, form.target, order, 4), form.doubles);
      for (const GLenum other : gl::kMap1Targets)
        expected.emplace_back(c.IsEnabled(other), stage == 2 || (stage == 1 && other == form.target));
    }
  }
  Played played = t.play(c);
  for (const auto& [query, enabled] : expected) played.expect_result(query, enabled);

  gl::Case first("enabled before anything was defined");
  for (const GLenum other : gl::kMap1Targets) first.Enable(other);
  define(first, random_map(t, form.target, 3, 4), form.doubles);
  std::vector<gl::Ref> enabled;
  for (const GLenum other : gl::kMap1Targets) enabled.push_back(first.IsEnabled(other));
  Played played_first = t.play(first);
  for (const gl::Ref query : enabled) played_first.expect_result(query, GL_TRUE);
}

// Also at the argument that was evaluated last, and with the order that the map had.
EVALCTS_LISTED_TESTS(Map1State, Live, visible_target_forms(), const TargetForm& form, must, "EV-MAP1-LIVE") {
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
}

EVALCTS_LISTED_TESTS(Map1State, PixelStoreIgnored, target_forms(), const TargetForm& form, must,
                     "EV-MAP1-NOPIXELSTORE") {
  const Map1 map = random_map(t, form.target, 4, 5);
  gl::Case c("swapped bytes, row length, skips, alignment");
  c.PixelStorei(GL_UNPACK_SWAP_BYTES, GL_TRUE);
  c.PixelStorei(GL_UNPACK_LSB_FIRST, GL_TRUE);
  c.PixelStorei(GL_UNPACK_ROW_LENGTH, 7);
  c.PixelStorei(GL_UNPACK_SKIP_ROWS, 1);
  c.PixelStorei(GL_UNPACK_SKIP_PIXELS, 3);
  c.PixelStorei(GL_UNPACK_ALIGNMENT, 8);
  define(c, map, form.doubles);
  const MapQuery query = query_map(c, form.target, t.max_order(), form.doubles);
  Played played = t.play(c);
  expect_map(played, query, map, form.doubles);
}

EVALCTS_LISTED_TESTS(Map1State, BuffersIgnored, target_forms(), const TargetForm& form, must,
                     "EV-MAP1-NOBUFFER") {
  t.require(1, 5, "GL_ARB_vertex_buffer_object");
  const Map1 map = random_map(t, form.target, 4, 5);
  gl::Case c("ARRAY_BUFFER and, from 2.1 on, PIXEL_UNPACK_BUFFER bound");
  const gl::ResultOf buffer{c.GenBuffers(1, gl::out<GLuint>(1)).index, 0};
  c.BindBuffer(GL_ARRAY_BUFFER, buffer);
  c.BufferData(GL_ARRAY_BUFFER, 4096, nullptr, GL_STATIC_DRAW);
  if (t.gl().at_least(2, 1)) c.BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
  define(c, map, form.doubles);
  const MapQuery query = query_map(c, form.target, t.max_order(), form.doubles);
  Played played = t.play(c);
  expect_map(played, query, map, form.doubles);
}

}  // namespace evalcts::suite_map1_state
