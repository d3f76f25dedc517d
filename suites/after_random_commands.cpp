// Rules of other suites, with random commands (the "past") before the commands under test, so that an
// implementation that does not update some internal state fails. The case of a failure contains its past.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <evalcts/fuzz/random_program.h>
#include <evalcts/gl/roles.h>
#include <evalcts/judge/prediction.h>
#include <evalcts/testkit/registration.h>
#include "maps.h"

namespace evalcts::suite_after_random_commands {
namespace {

constexpr CurrentValues kCurrent = {{0.125f, 0.25f, 0.5f, 0.75f}, {0.6f, 0, -0.8f}};

// Returns the commands that choose texture units only if GL 1.3 has them, and MultiTexCoord only of units
// that the implementation has, because others are undefined (GL 1.3 2.7).
gl::Case with_units_of(const Test& t, const gl::Case& past) {
  gl::Case left = past.without_commands();
  for (const gl::Command& command : past.commands()) {
    const std::string stem = gl::stem_of(command.entry);
    const bool is_of_units = stem == "MultiTexCoord" || stem == "ActiveTexture";
    if (is_of_units &&
        (!t.gl().at_least(1, 3) ||
         (stem == "MultiTexCoord" && gl::integer_of(command, 0) >= GL_TEXTURE0 + t.texture_units())))
      continue;
    left.add(command);
  }
  return left;
}

// Calls `play` with several cases, each with a different past. `play` appends the commands under test and
// runs the case.
void after_random_commands(Test& t, const std::function<void(gl::Case&)>& play) {
  // A baseline has one verdict for all depths, so full depth must not find more failures than quick depth.
  const auto cases = static_cast<std::uint32_t>(t.by_depth(6, 6, 60));
  const auto seed = static_cast<std::uint32_t>(t.random()());
  for (std::uint32_t i = 0; i < cases; ++i) {
    gl::Case c = with_units_of(t, fuzz::random_past(seed, i, t.by_depth(120, 120, 240), t.max_order()));
    c.set_identity(fmt::format("past {}", i));
    play(c);
  }
}

// Judges the points that the commands after `past` draw: the last ones that are captured.
void expect_last_points(Test& t, const gl::Case& past, const gl::Case& c) {
  const Prediction all = predict(c, t.max_order());
  const std::size_t count = all.vertex_count() - predict(past, t.max_order()).vertex_count();
  const Attributes shown = t.shown_exactly(kUnit0);
  const auto judge_last = [&](const Prediction& prediction, const Observation& seen) {
    if (seen.overflow) throw NotObservable("there are far too many vertices, which other tests report");
    Prediction last = prediction;
    std::size_t points = last.vertex_count();
    while (!last.primitives.empty() && points >= count + last.primitives.front().vertices.size()) {
      points -= last.primitives.front().vertices.size();
      last.primitives.erase(last.primitives.begin());
    }
    Observation tail = seen;
    std::vector<ObservedVertex> vertices = vertices_of(seen);
    if (vertices.size() > points)
      vertices.erase(vertices.begin(), vertices.end() - static_cast<std::ptrdiff_t>(points));
    tail.primitives = {{GL_POINTS, vertices}};
    tail.attributes &= shown;
    const JudgeOptions options{.version = t.gl().version_number()};
    const Topology order = with_meshes_in_own_order(last, Topology::points(points), tail, options);
    return judge(last, order, tail, options).mismatches;
  };
  // Room for an implementation that draws the whole past twice. If the last points are not captured, the test
  // cannot judge them.
  t.expect_observation(
      c, shown, 2 * all.vertex_count() + 8, kPoints,
      [&](const Observation& seen) { return judge_last(all, seen); }, judge_last);
}

// Returns true for queries of current values, which section 11 of the requirements is about.
bool asks_for_current_value(const gl::Command& command) {
  const auto* name = command.arguments.empty() ? nullptr : std::get_if<std::int64_t>(&command.arguments[0]);
  return name && *name >= GL_CURRENT_COLOR && *name <= GL_CURRENT_TEXTURE_COORDS;
}

void draw_points(gl::Case& c) {
  c.Begin(GL_POINTS);
  for (const float u : {0.0f, 0.375f, 1.0f}) c.EvalCoord1f(u);
  for (const float u : {0.25f, 1.0f}) c.EvalCoord2f(u, 0.5f);
  c.End();
}

// Maps, enables and current values are set after the past, so that no state of it remains.
EVALCTS_TEST(AfterRandomCommands, Evaluates, kMust, "EV-BE-ORDER")
(Test& t) {
  after_random_commands(t, [&](gl::Case& c) {
    const gl::Case past = c;
    for (const GLenum cap : all_caps()) c.Disable(cap);
    set_current_values(c, kCurrent);
    for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4})
      define_and_enable(c, random_map(t, target, 3));
    for (const GLenum target : {GL_MAP2_VERTEX_4, GL_MAP2_TEXTURE_COORD_2})
      define_and_enable(c, random_map(t, target, {2, 3}));
    draw_points(c);
    expect_last_points(t, past, c);
  });
};

// Maps, enables and current values are those of the past, except which vertex maps are enabled.
EVALCTS_TEST(AfterRandomCommands, EvaluatesWhatThePastDefined, kMust, "EV-BE-ORDER")
(Test& t) {
  after_random_commands(t, [&](gl::Case& c) {
    const gl::Case past = c;
    for (const GLenum cap : {GL_MAP1_VERTEX_4, GL_MAP2_VERTEX_4, GL_AUTO_NORMAL}) c.Disable(cap);
    c.Enable(GL_MAP1_VERTEX_3);
    c.Enable(GL_MAP2_VERTEX_3);
    draw_points(c);
    expect_last_points(t, past, c);
  });
};

EVALCTS_TEST(AfterRandomCommands, Meshes, kMust, "EV-BE-ORDER")
(Test& t) {
  after_random_commands(t, [&](gl::Case& c) {
    const gl::Case past = c;
    for (const GLenum cap : {GL_MAP1_VERTEX_4, GL_MAP2_VERTEX_4, GL_AUTO_NORMAL}) c.Disable(cap);
    define(c, random_map(t, GL_MAP1_VERTEX_3, 4));
    define(c, random_map(t, GL_MAP2_VERTEX_3, {2, 3}));
    c.Enable(GL_MAP1_VERTEX_3);
    c.Enable(GL_MAP2_VERTEX_3);
    set_current_values(c, kCurrent);
    c.MapGrid1f(4, 0, 1);
    c.MapGrid2f(2, 0, 1, 4, 1, 0);
    c.EvalMesh1(GL_POINT, 0, 4);
    c.EvalMesh2(GL_POINT, 0, 2, 1, 3);
    expect_last_points(t, past, c);
  });
};

// Returns the commands of the case that do not evaluate.
gl::Case without_evaluations(const gl::Case& c) {
  gl::Case rest(gl::control(c.identity()));
  for (const gl::Command& command : c.commands())
    if (!gl::is_evaluation(command.entry)) rest.add(command);
  return rest;
}

// Returns the answer to a query as numbers.
std::vector<double> numbers(const gl::Trace& trace, gl::Ref query) {
  if (!trace.has_output(query)) return {static_cast<double>(trace.result(query))};
  const auto written = [&](const auto& values) {
    return std::vector<double>(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                                    trace.written(query), values.size())));
  };
  switch (trace.type(query)) {
    case gl::Scalar::kI32:
      return written(trace.values<GLint>(query));
    case gl::Scalar::kF32:
      return written(trace.values<GLfloat>(query));
    default:
      return written(trace.values<GLdouble>(query));
  }
}

constexpr double kTolerance = 1e-5;  // single precision (EV-GETMAP-FLOAT, EV-GETMAP-DOUBLE)

bool are_near(const std::vector<double>& got, const std::vector<double>& expected) {
  return std::ranges::equal(got, expected, [](double a, double b) {
    return a == b || std::abs(a - b) <= kTolerance * std::abs(b);
  });
}

// All queries return what the executable specification returns. An answer is judged only if evaluation has
// changed it, and if it is right without the evaluations.
EVALCTS_TEST(AfterRandomCommands, State, kMust, "EV-CUR-GRIDMAPS")
(Test& t) {
  after_random_commands(t, [&](gl::Case& c) {
    const std::vector<gl::Ref> queries = query_everything(t, c);
    const gl::Ref error = c.GetError();
    const gl::Trace expected = specify(c, t.max_order()).answers;
    const gl::Case rest = without_evaluations(c);
    const int evaluations = static_cast<int>(c.commands().size() - rest.commands().size());
    const gl::Trace unevaluated = t.play(rest).trace();
    CheckedTrace checked = t.play(c);
    checked.expect_no_error(error);
    for (const gl::Ref query : queries) {
      if (query.index < 0) continue;
      if (asks_for_current_value(c.commands()[static_cast<std::size_t>(query.index)])) continue;
      const gl::Ref before = {query.index - evaluations};
      const std::vector<double> right = numbers(expected, query);
      if (checked.trace().same(query, unevaluated, before)) continue;
      if (!are_near(numbers(unevaluated, before), right)) continue;
      if (!expected.has_output(query)) {
        checked.expect_result(query, expected.result(query));
      } else if (expected.type(query) == gl::Scalar::kI32) {
        checked.expect_values(query, right);
      } else {
        checked.expect_values_near(query, right, kTolerance);
      }
    }
  });
};

// Returns the commands of the past that ask for nothing, because other tests judge the answers.
gl::Case without_queries(const gl::Case& past) {
  gl::Case rest(past.identity());
  for (const gl::Command& command : past.commands())
    if (!gl::asks(command.entry)) rest.add(command);
  return rest;
}

EVALCTS_TEST(AfterRandomCommands, Refuses, kMust, "EV-MAP1-ERR-NOEFFECT", "EV-MAP2-ERR-NOEFFECT")
(Test& t) {
  after_random_commands(t, [&](const gl::Case& past) {
    gl::Case c = without_queries(past);
    c.GetError();
    take_snapshot(t, c);
    for (const auto& [name, doubles] : existing_forms(t)) {
      Map curve = random_map(t, GL_MAP1_VERTEX_3, 4), net = random_map(t, GL_MAP2_VERTEX_4, {2, 2});
      curve.ustride = 2;
      net.u2 = net.u1;
      for (const Map& map : {curve, net}) {
        define(c, map, doubles);
        c.GetError();
      }
    }
    c.MapGrid2f(2, 0, 1, 0, 0, 1);
    c.GetError();
    c.EvalMesh2(GL_POINTS, 0, 1, 0, 1);
    c.GetError();
    take_snapshot(t, c);
    t.judge_answers(c);
  });
};

}  // namespace
}  // namespace evalcts::suite_after_random_commands
