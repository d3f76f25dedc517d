// Section 11 of the requirements: evaluation does not change current values, maps, grids and enables.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include <evalcts/gl/lift.h>
#include <evalcts/testkit/registration.h>
#include "dimensions.h"
#include "maps.h"

namespace evalcts::suite_current_values {
namespace {

// A current value and its number of components.
struct Query {
  const char* name;
  GLenum value;
  std::size_t count;

  gl::Ref ask(gl::Case& c) const { return c.GetFloatv(value, gl::out<GLfloat>(count)); }
};
constexpr Query kQueries[] = {{"COLOR", GL_CURRENT_COLOR, 4},
                              {"NORMAL", GL_CURRENT_NORMAL, 3},
                              {"TEXTURE_COORDS", GL_CURRENT_TEXTURE_COORDS, 4}};

// A function that sets a current value; `variant` chooses the command by its number of components.
using Setter = void (*)(gl::Case&, int variant);

void set_color(gl::Case& c, int variant) {
  variant % 2 ? c.Color4f(0.1f, 0.2f, 0.3f, 0.4f) : c.Color3f(0.9f, 0.8f, 0.7f);
}
void set_normal(gl::Case& c, int variant) { c.Normal3f(0.25f, static_cast<float>(variant), -0.5f); }
void set_texture(gl::Case& c, int variant) {
  variant % 4 == 0   ? c.TexCoord4f(5, 6, 7, 8)
  : variant % 4 == 1 ? c.TexCoord3f(5, 6, 7)
  : variant % 4 == 2 ? c.TexCoord2f(5, 6)
                     : c.TexCoord1f(5);
}

// Appends one vertex, evaluated or explicit.
void emit(gl::Case& c, bool evaluated, float u) { evaluated ? c.EvalCoord1f(u) : c.Vertex3f(u, 0, 0); }

constexpr int kVariants = 6;
// Sets the current value before a primitive: alone, after others (the layout of an implementation's vertices
// depends on which values were set, and in which order), or not at all.
void set_before(gl::Case& c, int variant, Setter set) {
  switch (variant) {
    case 2:
      set_color(c, 1);
      set_texture(c, 0);
      break;
    case 3:
      set_texture(c, 0);
      set_normal(c, 1);
      set_color(c, 1);
      break;
    case 4:
      return;  // keeps the initial value
    case 5:
      set_color(c, 1);
      return;
    default:
      break;
  }
  set(c, variant);
}

// A case, and the pairs of queries in it that have to give the same answers.
struct PairedQueries {
  gl::Case script;
  std::vector<std::pair<gl::Ref, gl::Ref>> alike;
};

// Expects the evaluated case to keep the current values. Returns false, without a failure, if the control
// with explicit vertices loses one: then evaluation is not the cause.
bool expect_kept(Test& t, const std::function<PairedQueries(bool evaluated)>& write) {
  const PairedQueries control = write(false), evaluated = write(true);
  const CheckedTrace of_control = t.play(control.script);
  for (const auto& [before, after] : control.alike)
    if (!of_control.trace().same(before, of_control.trace(), after)) return false;
  CheckedTrace checked = t.play(evaluated.script);
  for (const auto& [before, after] : evaluated.alike) checked.expect_same(before, after);
  return true;
}

// The maps and enables of an evaluation, and a function that appends one evaluation or, for the control, an
// explicit vertex.
struct Evaluated {
  std::string name;
  std::function<void(gl::Case&)> prepare;
  void (*draw)(gl::Case&, bool evaluated, float u) = emit;
};

// Sets the value, evaluates, and compares the query before and after. There are cases with one evaluation and
// with so many that an implementation flushes between them; at quick depth each variant runs one of these.
// `evaluated_of` is called for each case. Throws NotObservable if no case can be judged.
void expect_current_untouched(Test& t, const std::function<Evaluated()>& evaluated_of, const Query& query,
                              Setter set, bool flush) {
  bool observed = false;
  for (int variant = 0; variant < kVariants; ++variant)
    for (const bool short_one : {true, false}) {
      if (t.depth() == Depth::kQuick && short_one == (variant % 2 == 1)) continue;
      const int vertices = short_one ? 1 : t.by_depth(300, 1000, 30000);
      const Evaluated what = evaluated_of();
      observed |= expect_kept(t, [&](bool evaluated) {
        const std::string identity =
            fmt::format("{}: setting {} then {} vertices", what.name, variant, vertices);
        gl::Case c(evaluated ? identity : gl::control(identity));
        what.prepare(c);
        set_before(c, variant, set);
        const gl::Ref before = query.ask(c);
        c.Begin(GL_POINTS);
        for (int i = 0; i < vertices; ++i)
          what.draw(c, evaluated, static_cast<float>(i + 1) / static_cast<float>(vertices));
        c.End();
        if (flush) c.Flush();
        const gl::Ref after = query.ask(c);
        // A value that is set between Begin and End stays current after the evaluation.
        c.Begin(GL_POINTS);
        set(c, variant + 1);
        what.draw(c, evaluated, 0.5f);
        c.End();
        const gl::Ref inside = query.ask(c);
        set(c, variant + 1);
        const gl::Ref again = query.ask(c);
        return PairedQueries{c, {{before, after}, {again, inside}}};
      });
    }
  if (!observed) throw NotObservable("explicit vertices lose the current value as well");
}

// The same with a map of the target and a vertex map.
void expect_current_untouched(Test& t, GLenum target, const Query& query, Setter set, bool flush) {
  const auto evaluated = [&] {
    const Map map = random_map(t, target, 4), carrier = random_map(t, GL_MAP1_VERTEX_3, 4);
    return Evaluated{label(target), [=](gl::Case& c) {
                       define(c, map);
                       define(c, carrier);
                       c.Enable(GL_MAP1_VERTEX_3);
                       c.Enable(target);
                     }};
  };
  expect_current_untouched(t, evaluated, query, set, flush);
}

// The queries come immediately or after a Flush, which hides some bugs and reveals others.
constexpr NamedValue<bool> kMoments[] = {{"AT_ONCE", false}, {"FLUSHED", true}};

EVALCTS_TEST(CurrentValues, Color, kMust, "EV-CUR-COLOR/1-D", combine(kMoments).by(gl::curve_deliveries()))
(Test& t, const NamedValue<bool>& moment) {
  expect_current_untouched(t, GL_MAP1_COLOR_4, kQueries[0], set_color, moment.value);
};

EVALCTS_TEST(CurrentValues, Normal, kMust, "EV-CUR-NORMAL/1-D", combine(kMoments).by(gl::curve_deliveries()))
(Test& t, const NamedValue<bool>& moment) {
  expect_current_untouched(t, GL_MAP1_NORMAL, kQueries[1], set_normal, moment.value);
};

void emit_of_surface(gl::Case& c, bool evaluated, float u) {
  evaluated ? c.EvalCoord2f(u, 0.25f) : c.Vertex3f(u, 0, 0);
}

// Normals that AUTO_NORMAL generates from surfaces of orders 1 to 3 do not become current.
EVALCTS_TEST(CurrentValues, AutomaticNormal, kMust, "EV-AUTON-CURRENT",
             combine(kMoments).by(gl::surface_deliveries()))
(Test& t, const NamedValue<bool>& moment) {
  Orders orders = {3, 1};
  const auto evaluated = [&] {
    const GLenum target = orders.v == 2 ? GL_MAP2_VERTEX_4 : GL_MAP2_VERTEX_3;
    orders = {orders.u % 3 + 1, orders.v % 3 + 1};
    return Evaluated{label(target) + " with AUTO_NORMAL",
                     [map = random_map(t, target, orders)](gl::Case& c) {
                       define_and_enable(c, map);
                       c.Enable(GL_AUTO_NORMAL);
                     },
                     emit_of_surface};
  };
  expect_current_untouched(t, evaluated, kQueries[1], set_normal, moment.value);
};

// Without a vertex map an evaluation does nothing, so the control has no command in its place.
EVALCTS_TEST(CurrentValues, AutomaticNormalWithoutVertices, kMust, "EV-AUTON-NOVERTEX",
             combine(kMoments).by(gl::surface_deliveries()))
(Test& t, const NamedValue<bool>& moment) {
  const auto evaluated = [] {
    return Evaluated{"AUTO_NORMAL alone", [](gl::Case& c) { c.Enable(GL_AUTO_NORMAL); },
                     [](gl::Case& c, bool is_evaluated, float u) {
                       if (is_evaluated) c.EvalCoord2f(u, 0.25f);
                     }};
  };
  expect_current_untouched(t, evaluated, kQueries[1], set_normal, moment.value);
};

struct Attribute {
  const char* name;
  GLenum target;
  std::size_t query;
  Setter set;
};
constexpr Attribute kAttributes[] = {{"COLOR_4", GL_MAP1_COLOR_4, 0, set_color},
                                     {"NORMAL", GL_MAP1_NORMAL, 1, set_normal},
                                     {"TEXTURE_COORD_1", GL_MAP1_TEXTURE_COORD_1, 2, set_texture},
                                     {"TEXTURE_COORD_4", GL_MAP1_TEXTURE_COORD_4, 2, set_texture}};

EVALCTS_TEST(CurrentValues, EvaluationWithoutVertices, kMust, "EV-COORD-NOVERTEX/1-D",
             combine(kAttributes).combine(kMoments).by(gl::curve_deliveries()))
(Test& t, const Attribute& attribute, const NamedValue<bool>& moment) {
  const auto evaluated = [&] {
    return Evaluated{label(attribute.target) + " alone",
                     [map = random_map(t, attribute.target, 3)](gl::Case& c) { define_and_enable(c, map); },
                     [](gl::Case& c, bool is_evaluated, float u) {
                       if (is_evaluated) c.EvalCoord1f(u);
                     }};
  };
  expect_current_untouched(t, evaluated, kQueries[attribute.query], attribute.set, moment.value);
};

EVALCTS_TEST(CurrentValues, Index, kMust, "EV-CUR-INDEX/1-D", combine(kMoments).by(gl::curve_deliveries()))
(Test& t, const NamedValue<bool>& moment) {
  const auto set_index = [](gl::Case& c, int variant) { c.Indexf(7.0f + static_cast<float>(variant)); };
  expect_current_untouched(t, GL_MAP1_INDEX, {"INDEX", GL_CURRENT_INDEX, 1}, set_index, moment.value);
};

EVALCTS_TEST(CurrentValues, TextureCoordinates, kMust, "EV-CUR-TEX/1-D",
             combine(kMoments).by(gl::curve_deliveries()))
(Test& t, const NamedValue<bool>& moment) {
  std::vector<GLenum> targets = {GL_MAP1_TEXTURE_COORD_1, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_TEXTURE_COORD_3,
                                 GL_MAP1_TEXTURE_COORD_4};
  if (t.depth() == Depth::kQuick) targets = {targets[t.random()() % targets.size()]};
  for (const GLenum target : targets)
    expect_current_untouched(t, target, kQueries[2], set_texture, moment.value);
};

// Current values stay the same over a primitive of tens of thousands of vertices, also if they are set in its
// middle.
constexpr NamedValue<GLenum> kStrips[] = {{"LINE_STRIP", GL_LINE_STRIP},
                                          {"TRIANGLE_STRIP", GL_TRIANGLE_STRIP}};

EVALCTS_TEST(CurrentValues, LongPrimitives, kMust, "EV-CUR-COLOR/1-D", "EV-CUR-NORMAL/1-D", "EV-CUR-TEX/1-D",
             combine(kStrips).by(sparing(gl::without(gl::kMeshes | gl::kArrays, gl::curve_deliveries()))))
(Test& t, const NamedValue<GLenum>& mode) {
  t.prefer_fresh_contexts();  // vertex buffers are filled differently in a used context
  const int vertices = t.by_depth(10000, 40000, 66000);
  std::vector<Map> maps;
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_4})
    maps.push_back(random_map(t, target, 2));
  bool observed = false;
  for (const bool set_inside : {false, true})
    observed |= expect_kept(t, [&](bool evaluated) {
      const std::string identity =
          fmt::format("{} vertices, {}", vertices, set_inside ? "set inside" : "set before");
      gl::Case c(evaluated ? identity : gl::control(identity));
      for (const Map& map : maps) define_and_enable(c, map);
      const auto set = [&] {
        set_color(c, 1);
        set_normal(c, 1);
        set_texture(c, 0);
      };
      std::array<gl::Ref, std::size(kQueries)> before, after;
      set();
      std::ranges::transform(kQueries, before.begin(), [&](const Query& query) { return query.ask(c); });
      if (set_inside) {
        set_color(c, 0);
        set_normal(c, 2);
        set_texture(c, 1);
      }
      c.Begin(mode.value);
      for (int i = 0; i < vertices; ++i) {
        if (set_inside && i == vertices / 2) set();
        emit(c, evaluated, static_cast<float>(i % 40000) * 0x1p-16f);
      }
      c.End();
      std::ranges::transform(kQueries, after.begin(), [&](const Query& query) { return query.ask(c); });
      PairedQueries written{c, {}};
      for (std::size_t i = 0; i < before.size(); ++i) written.alike.emplace_back(before[i], after[i]);
      return written;
    });
  if (!observed) throw NotObservable("explicit vertices lose the current value as well");
};

EVALCTS_TEST_PAIR(CurrentValues.LongMeshes, CurrentValues.LongMeshes2, kMust, "EV-CUR-COLOR", "EV-CUR-NORMAL",
                  "EV-CUR-TEX", by(sparing(gl::list_deliveries())))
(Test& t, bool two) {
  const int steps = t.by_depth(2000, 40000, 66000);
  gl::Case c(fmt::format("{} steps", steps));
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP1_NORMAL, GL_MAP1_TEXTURE_COORD_4})
    define_and_enable(c, random_map(t, target_in(two, target), {2, 2}));
  set_current_values(c);
  two ? c.MapGrid2f(steps, 0, 1, 1, 0, 1) : c.MapGrid1f(steps, 0, 1);
  const auto ask = [&] {
    std::vector<gl::Ref> queries;
    for (const Query& query : kQueries) queries.push_back(query.ask(c));
    t.compare_only(queries);
  };
  ask();
  for (const GLenum mode : {GL_POINT, GL_LINE, GL_FILL}) {
    if (!two && mode == GL_FILL) continue;
    eval_mesh(c, two, mode, 0, steps, 0, 1);
    ask();
  }
  t.judge_answers(c);
};

// An order of Color (0), Normal (1) and TexCoord (2), and the numbers of components of colour and texture
// coordinates.
struct Setting {
  std::array<int, 3> order;
  int color, texture;
};

std::vector<Setting> settings(Test& t) {
  std::vector<Setting> all;
  std::array<int, 3> order = {0, 1, 2};
  do {
    for (const int color : {3, 4})
      for (int texture = 1; texture <= 4; ++texture) all.push_back({order, color, texture});
  } while (std::next_permutation(order.begin(), order.end()));
  // The steps have no common factor with the numbers of components, so that every number is among those
  // chosen.
  std::vector<Setting> chosen;
  for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(t.by_depth(11, 5, 1)))
    chosen.push_back(all[i]);
  return chosen;
}

void set_all(gl::Case& c, const Setting& setting) {
  for (const int which : setting.order) {
    if (which == 0) {
      set_color(c, setting.color == 4 ? 1 : 0);
    } else if (which == 1) {
      set_normal(c, 2);
    } else {
      set_texture(c, 4 - setting.texture);
    }
  }
}

// The layout of an implementation's vertices depends on which values were set, in which order, and with how
// many components. So there is a primitive with all maps enabled after every order of setting.
EVALCTS_TEST(CurrentValues, EveryOrderOfSetting, kMust, "EV-CUR-COLOR/1-D", "EV-CUR-NORMAL/1-D",
             "EV-CUR-TEX/1-D", combine(kQueries).by(gl::without(gl::kMeshes, gl::curve_deliveries())))
(Test& t, const Query& queried) {
  std::vector<Map> maps;
  for (const GLenum target : visible_targets(kCurves)) maps.push_back(random_map(t, target, 3));
  bool observed = false;
  for (const Setting& setting : settings(t)) {
    observed |= expect_kept(t, [&](bool evaluated) {
      const std::string identity =
          fmt::format("order {}{}{} with {} colour and {} texture components", setting.order[0],
                      setting.order[1], setting.order[2], setting.color, setting.texture);
      gl::Case c(evaluated ? identity : gl::control(identity));
      for (const Map& map : maps) define_and_enable(c, map);
      set_all(c, setting);
      const gl::Ref before = queried.ask(c);
      c.Begin(GL_TRIANGLE_STRIP);
      emit(c, evaluated, 0.25f);
      set_all(c, setting);
      for (int i = 0; i < 4; ++i) emit(c, evaluated, static_cast<float>(i) / 4);
      c.End();
      const gl::Ref after = queried.ask(c);
      // With fewer maps, the vertices of the next primitive are smaller.
      for (const Map& map : maps)
        if (map.target != GL_MAP1_VERTEX_3) c.Disable(map.target);
      c.Begin(GL_POINTS);
      emit(c, evaluated, 0.5f);
      c.End();
      const gl::Ref later = queried.ask(c);
      return PairedQueries{c, {{before, after}, {before, later}}};
    });
  }
  if (!observed) throw NotObservable("explicit vertices lose the current value as well");
};

EVALCTS_TEST(CurrentValues, EdgeFlag, kMust, "EV-CUR-EDGEFLAG/1-D",
             by(gl::without(gl::kMeshes, gl::curve_deliveries())))
(Test& t) {
  for (const GLboolean flag : {GL_FALSE, GL_TRUE}) {
    gl::Case c(flag ? "TRUE" : "FALSE");
    for (const GLenum target : gl::kMap1Targets) define_and_enable(c, random_map(t, target, 2));
    c.EdgeFlag(flag);
    c.Begin(GL_TRIANGLES);
    for (int i = 0; i < 6; ++i) c.EvalCoord1f(static_cast<float>(i) / 8);
    c.End();
    c.GetBooleanv(GL_EDGE_FLAG, gl::out<GLboolean>(1));
    t.judge_answers(c);
  }
};

// EvalMesh does not change the current edge flag.
EVALCTS_TEST(CurrentValues, EdgeFlagAfterMeshes, kMust, "EV-CUR-EDGEFLAG", by(gl::list_deliveries()))
(Test& t) {
  for (const GLboolean flag : {GL_FALSE, GL_TRUE}) {
    gl::Case c(flag ? "TRUE" : "FALSE");
    for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP2_VERTEX_3}) c.Enable(target);
    c.EdgeFlag(flag);
    for (const GLenum mode : {GL_POINT, GL_LINE, GL_FILL})
      for (const bool two : {false, true}) {
        if (!two && mode == GL_FILL) continue;
        eval_mesh(c, two, mode, 0, 2, 0, 2);
        c.GetBooleanv(GL_EDGE_FLAG, gl::out<GLboolean>(1));
      }
    t.judge_answers(c);
  }
};

// With all maps enabled, no query of evaluator state changes its answer.
EVALCTS_TEST_PAIR(CurrentValues.MapsGridsAndEnables, CurrentValues.MapsGridsAndEnables2, kMust,
                  decide("EV-CUR-GRIDMAPS/1-D", "EV-CUR-GRIDMAPS/2-D"))
(Test& t, bool two) {
  gl::Case c("all nine maps enabled");
  for (const GLenum target : gl::kMap1Targets) define_and_enable(c, over(random_map(t, target, 5), {-1, 3}));
  two ? c.MapGrid2f(3, 0.1f, 0.7f, 4, 2, 1) : c.MapGrid1f(3, 0.1f, 0.7f);
  const auto query = [&] {
    take_snapshot(t, c);
    t.compare_only({c.GetFloatv(GL_MAP1_GRID_DOMAIN, gl::out<GLfloat>(2)),
                    c.GetFloatv(GL_MAP2_GRID_DOMAIN, gl::out<GLfloat>(4))});
  };
  query();
  c.Begin(GL_LINE_STRIP);
  for (int i = 0; i < 40; ++i) c.EvalCoord1f(static_cast<float>(i) / 20 - 0.5f);
  c.EvalCoord1d(0.5);
  for (const GLint i : {0, 2, -1, 7}) eval_point(c, two, i, 3 - i);
  c.End();
  // Meshes inside the grid, beyond it, and of an empty range.
  for (const GLenum mode : {GL_POINT, GL_LINE, GL_FILL})
    for (const auto& [first, last] : {std::pair{0, 3}, {-2, 5}, {2, 1}})
      if (two || mode != GL_FILL) eval_mesh(c, two, mode, first, last, first, last);
  query();
  t.judge_answers(two ? gl::lift(c, true) : c);
};

// With texture maps of 1, 4, 2 and 3 components in turn, no component of one vertex appears in another one.
EVALCTS_TEST(CurrentValues, NoComponentLeaks, kMust, "EV-CUR-MAXCOMP/1-D", by(gl::curve_deliveries()))
(Test& t) {
  gl::Case c("texture maps of 1, 4, 2, 3, 1 components, explicit vertices between them");
  define_and_enable(c, random_map(t, GL_MAP1_VERTEX_3, 3));
  const GLenum sequence[] = {GL_MAP1_TEXTURE_COORD_1, GL_MAP1_TEXTURE_COORD_4, GL_MAP1_TEXTURE_COORD_2,
                             GL_MAP1_TEXTURE_COORD_3, GL_MAP1_TEXTURE_COORD_1};
  for (const GLenum target : sequence) define(c, random_map(t, target, 3));
  for (int round = 0; round < 2; ++round)
    for (const GLenum target : sequence) {
      c.Enable(target);
      c.Begin(GL_POINTS);
      c.EvalCoord1f(0.375f);
      c.Vertex3f(1, 2, 3);
      c.EvalCoord1f(0.625f);
      c.End();
      c.Disable(target);
      if (round) c.TexCoord4f(5, 6, 7, 8);
    }
  t.judge_vertices(c, kPosition | kTextureCoordinate0);
};

EVALCTS_TEST(CurrentValues, OtherUnits, kMust, "EV-CUR-OTHERUNITS/1-D", by(gl::curve_deliveries()))
(Test& t) {
  require_texture_units(t);
  for (const GLenum active : {GL_TEXTURE0, GL_TEXTURE1}) {
    gl::Case c("every unit, TEXTURE_COORD_2 enabled, " + gl::token_name(active) + " active");
    c.ActiveTexture(GL_TEXTURE0);  // other units reject maps, and some deliveries run the commands twice
    define(c, random_map(t, GL_MAP1_TEXTURE_COORD_2, 3));
    enable_visibly(c, GL_MAP1_TEXTURE_COORD_2);
    const int units = t.texture_units();
    for (int unit = 0; unit < units; ++unit)
      c.MultiTexCoord4f(GL_TEXTURE0 + static_cast<GLenum>(unit), 10.0f + static_cast<float>(unit), 2, 3, 4);
    c.ActiveTexture(active);
    evaluate_all(c, {0, 0.25, 0.5, 0.75, 1});
    for (int unit = 1; unit < units; ++unit) {
      c.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
      kQueries[2].ask(c);
    }
    t.judge_answers(c);
  }
};

std::string text_of(const std::vector<GLfloat>& values) {
  return fmt::format("{{{}}}", fmt::join(values, ", "));
}

// A query, and the first values of the answer that is due; others are not specified.
struct Due {
  gl::Ref query;
  std::vector<GLfloat> values;
};

// Runs the commands of `write` with EvalCoord and, as the control, with Vertex, and expects the queries that
// it returns to have the answers that are due, or those of the control, whose precision may be low. A query
// that the control answers wrongly is not judged. Throws NotObservable if none is left.
void expect_due_or_as_explicit(Test& t, const std::string& identity,
                               const std::function<std::vector<Due>(gl::Case&, bool evaluated)>& write) {
  constexpr float kMostError = 1.0f / 64;
  gl::Case with_vertex(gl::control(identity)), with_evaluation(identity);
  write(with_vertex, false);
  const std::vector<Due> all = write(with_evaluation, true);
  const CheckedTrace control = t.play(with_vertex);
  CheckedTrace checked = t.play(with_evaluation);
  bool observed = false;
  for (const auto& [query, due] : all) {
    const auto is_near = [](GLfloat a, GLfloat b) { return std::abs(a - b) <= kMostError; };
    const std::vector<GLfloat> explicit_answer = control.trace().values<GLfloat>(query);
    if (!std::equal(due.begin(), due.end(), explicit_answer.begin(), is_near)) continue;
    observed = true;
    const std::vector<GLfloat> answer = checked.trace().values<GLfloat>(query);
    checked.expect(answer == explicit_answer || std::equal(due.begin(), due.end(), answer.begin()), query,
                   fmt::format("after an evaluation the query answers {}, after explicit vertices {}",
                               text_of(answer), text_of(explicit_answer)),
                   text_of(due), text_of(answer));
  }
  if (!observed) throw NotObservable("pipeline: the queries are wrong after explicit vertices as well");
}

// Secondary colour, fog coordinate and generic attributes have no maps, and evaluation does not change them.
EVALCTS_TEST(CurrentValues, AttributesWithoutMaps, kMust, "EV-CUR-OTHERUNITS/1-D", by(gl::curve_deliveries()))
(Test& t) {
  t.require(2, 0);
  std::vector<Map> maps;
  for (const GLenum target : gl::kMap1Targets) maps.push_back(random_map(t, target, 3));
  expect_due_or_as_explicit(t, "all nine maps enabled", [&](gl::Case& c, bool evaluated) {
    for (const Map& map : maps) define_and_enable(c, map);
    c.SecondaryColor3f(0.25f, 0.5f, 0.75f);
    c.FogCoordf(3.5f);
    c.VertexAttrib4f(6, 1, 2, 3, 4);
    std::vector<Due> all;
    const auto query = [&] {
      all.push_back({c.GetFloatv(GL_CURRENT_SECONDARY_COLOR, gl::out<GLfloat>(4)), {0.25f, 0.5f, 0.75f}});
      all.push_back({c.GetFloatv(GL_CURRENT_FOG_COORD, gl::out<GLfloat>(1)), {3.5f}});
      all.push_back({c.GetVertexAttribfv(6, GL_CURRENT_VERTEX_ATTRIB, gl::out<GLfloat>(4)), {1, 2, 3, 4}});
    };
    c.Begin(GL_POINTS);
    for (int i = 0; i < 7; ++i) emit(c, evaluated, static_cast<float>(i) / 6);
    c.End();
    query();
    c.Flush();
    query();
    return all;
  });
};

EVALCTS_TEST(CurrentValues, RasterPosition, kMust, "EV-CUR-RASTERPOS/1-D", by(gl::curve_deliveries()))
(Test& t) {
  // The position is in window coordinates, the distance that from the eye in z.
  struct Raster {
    std::vector<GLfloat> position, color, texture;
    GLfloat distance;
  };
  const auto query = [&](gl::Case& c, const Raster& due, std::vector<Due>& all) {
    all.push_back({c.GetFloatv(GL_CURRENT_RASTER_POSITION, gl::out<GLfloat>(4)), due.position});
    all.push_back({c.GetFloatv(GL_CURRENT_RASTER_COLOR, gl::out<GLfloat>(4)), due.color});
    all.push_back({c.GetFloatv(GL_CURRENT_RASTER_TEXTURE_COORDS, gl::out<GLfloat>(4)), due.texture});
    all.push_back({c.GetFloatv(GL_CURRENT_RASTER_DISTANCE, gl::out<GLfloat>(1)), {due.distance}});
  };
  std::vector<Map> maps;
  for (const GLenum target : visible_targets(kCurves)) maps.push_back(random_map(t, target, 3));
  const auto draw = [&](gl::Case& c, bool evaluated) {
    c.Begin(GL_POINTS);
    for (int i = 0; i < 5; ++i) emit(c, evaluated, static_cast<float>(i) / 4);
    c.End();
  };
  expect_due_or_as_explicit(t, "RasterPos before and after", [&](gl::Case& c, bool evaluated) {
    for (const Map& map : maps) define_and_enable(c, map);
    std::vector<Due> all;
    c.Viewport(0, 0, 64, 64);
    c.Color4f(0.75f, 0.5f, 0.25f, 1);
    c.TexCoord4f(5, 6, 7, 8);
    c.RasterPos3f(0.25f, 0.5f, 0.125f);
    draw(c, evaluated);
    query(c, {{40, 48, 0.5625f, 1}, {0.75f, 0.5f, 0.25f, 1}, {5, 6, 7, 8}, 0.125f}, all);
    c.Color4f(0.5f, 0.25f, 0.75f, 1);
    c.TexCoord4f(1, 2, 3, 4);
    draw(c, evaluated);
    c.RasterPos3f(-0.25f, 0.25f, 0);  // takes the current values
    query(c, {{24, 40, 0.5f, 1}, {0.5f, 0.25f, 0.75f, 1}, {1, 2, 3, 4}, 0}, all);
    return all;
  });
};

}  // namespace
}  // namespace evalcts::suite_current_values
