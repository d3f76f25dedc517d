// Quantities without a limit in the specification: vertices of a primitive, definitions, lists and
// evaluations in a context; and grids whose steps vanish.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <evalcts/gl/explicit_vertices.h>
#include <evalcts/testkit/registration.h>
#include "dimensions.h"
#include "grid_cases.h"
#include "maps.h"

namespace evalcts::suite_without_limits {
namespace {

// Returns x of each point, or of the end of each line. Captures may show strips as lines.
std::vector<float> ends_of(const Observation& seen, PrimitiveKind kind) {
  std::vector<float> ends;
  for (const ObservedPrimitive& primitive : seen.primitives) {
    const bool has_pairs = kind == kLines && primitive.mode == GL_LINES;
    for (std::size_t i = kind == kLines ? 1 : 0; i < primitive.vertices.size(); i += has_pairs ? 2 : 1)
      ends.push_back(primitive.vertices[i].position[0]);
  }
  return ends;
}

// Expects this number of points or lines. `x_of`: x of a point or of the end of a line by its number, which
// rises; a library may draw a mesh in another order.
void expect_count(Test& t, const gl::Case& c, PrimitiveKind kind, std::size_t count,
                  const std::function<double(std::size_t)>& x_of) {
  constexpr double kMostError = 0.02;  // other tests judge values
  const auto judge = [=](const Observation& seen) {
    std::vector<Mismatch> mismatches;
    std::vector<float> x = ends_of(seen, kind);
    std::ranges::sort(x);
    if (x.size() != count) {
      Mismatch mismatch;
      mismatch.kind = Mismatch::Kind::kVertices;
      mismatch.what = "number of vertices";
      mismatch.got = static_cast<double>(x.size());
      mismatch.lowest = mismatch.highest = static_cast<double>(count);
      mismatch.expected = std::to_string(count);
      mismatch.captured = std::to_string(x.size()) + (seen.overflow ? " or more" : "");
      mismatch.message = fmt::format("{} {} are drawn, expected {}", mismatch.captured,
                                     kind == kLines ? "lines" : "points", count);
      return std::vector{mismatch};
    }
    for (std::size_t i = 0; i < count && mismatches.empty(); ++i) {
      const double expected = x_of(i);
      if (std::abs(x[i] - expected) <= kMostError) continue;
      Mismatch mismatch;
      mismatch.what = fmt::format("position.x of vertex {}", i);
      mismatch.got = x[i];
      mismatch.lowest = expected - kMostError;
      mismatch.highest = expected + kMostError;
      mismatch.expected = fmt::format("{} +- {}", expected, kMostError);
      mismatch.captured = fmt::format("{}", x[i]);
      mismatch.message =
          fmt::format("{} is {}, expected {}", mismatch.what, mismatch.captured, mismatch.expected);
      mismatches.push_back(std::move(mismatch));
    }
    return mismatches;
  };
  t.expect_observation(c, kPosition, 2 * count + 64, kind, judge);
}

// --- Vertices of one primitive ----------------------------------------------------------------------------

constexpr int kVertices = 70000;  // more than 16 bits count

// A line in x from 0 to 1 over the domain [0, 1].
void define_line(gl::Case& c, bool two) {
  define_and_enable(c, two ? make_map2(GL_MAP2_VERTEX_3, 2, 1, {0, 0, 0, 1, 0, 0})
                           : make_map1(GL_MAP1_VERTEX_3, {0, 0, 0, 1, 0, 0}));
}

double on_line(std::size_t i) { return static_cast<double>(i) / kVertices; }

EVALCTS_TEST_PAIR(LongPrimitives.MoreThan16BitsCount, LongPrimitives.MoreThan16BitsCount2, kMust,
                  decide("EV-BE-NOLIMIT/1-D", "EV-BE-NOLIMIT/2-D"))
(Test& t, bool two) {
  gl::Case points(fmt::format("{} points", kVertices));
  define_line(points, two);
  points.Begin(GL_POINTS);
  for (int i = 0; i < kVertices; ++i) eval_coord(points, two, on_line(static_cast<std::size_t>(i)), 0);
  points.End();
  expect_count(t, points, kPoints, kVertices, on_line);

  gl::Case strip(fmt::format("a line strip of {} vertices", kVertices));
  define_line(strip, two);
  strip.Begin(GL_LINE_STRIP);
  for (int i = 0; i < kVertices; ++i) eval_coord(strip, two, on_line(static_cast<std::size_t>(i)), 0);
  strip.End();
  expect_count(t, strip, kLines, kVertices - 1, [](std::size_t i) { return on_line(i + 1); });
};

EVALCTS_TEST_PAIR(LongPrimitives.LongPointMesh, LongPrimitives.LongPointMesh2, kMust,
                  decide("EV-BE-NOLIMIT/1-D", "EV-BE-NOLIMIT/2-D"))
(Test& t, bool two) {
  gl::Case c(fmt::format("{} steps", kVertices));
  define_line(c, two);
  two ? c.MapGrid2f(kVertices, 0, 1, 1, 0, 1) : c.MapGrid1f(kVertices, 0, 1);
  eval_mesh(c, two, GL_POINT, 0, kVertices, 0, 0);
  expect_count(t, c, kPoints, kVertices + 1, on_line);
};

// --- Definitions, lists and evaluations of one context ----------------------------------------------------

EVALCTS_TEST_PAIR(Contexts.ManyDefinitions, Contexts.ManyDefinitions2, kMust,
                  decide("EV-CTX-UNBOUNDED/1-D", "EV-CTX-UNBOUNDED/2-D"))
(Test& t, bool two) {
  const int times = t.by_depth(1500, 12000, 12000);
  const GLenum target = target_in(two, GL_MAP1_VERTEX_3);
  gl::Case c(fmt::format("{} definitions of a map and a grid", times));
  c.Enable(target);
  const Map map = random_map(t, target, {2, 2});
  for (int i = 0; i < times; ++i) {
    define_in_slot(c, map, false, 0);
    two ? c.MapGrid2f(1 + i % 5, 0, 1, 2, 0, 1) : c.MapGrid1f(1 + i % 5, 0, 1);
  }
  define(c, random_map(t, target, {4, 3}));
  map_grid(c, two, {3, 0, 1}, {2, 0, 1});
  query_map(t, c, target, false);
  eval_mesh(c, two, GL_POINT, 0, 3, 0, 2);
  t.judge(c);
};

EVALCTS_TEST_PAIR(Contexts.ManyLists, Contexts.ManyLists2, kMust,
                  decide("EV-CTX-UNBOUNDED/1-D", "EV-CTX-UNBOUNDED/2-D"))
(Test& t, bool two) {
  const int lists = t.by_depth(300, 3000, 3000);
  const GLenum target = target_in(two, GL_MAP1_VERTEX_3);
  gl::Case c(fmt::format("{} lists that define a map and evaluate it", lists));
  c.Enable(target);
  for (int i = 1; i <= lists; ++i) {
    c.NewList(static_cast<GLuint>(i), GL_COMPILE);
    const auto x = static_cast<double>(i);
    define(c, two ? make_map2(target, 1, 1, {x, 0, 0}) : make_map1(target, {x, 0, 0}));
    c.Begin(GL_POINTS);
    eval_coord(c, two, 0.5, 0.5);
    c.End();
    c.EndList();
  }
  for (int i = 1; i <= lists; i += 7) c.CallList(static_cast<GLuint>(i));
  c.CallList(static_cast<GLuint>(lists));
  query_map(t, c, target, false);
  t.judge(c);
};

// Evaluations without a vertex map draw nothing, and those with one behind them draw as the first would.
EVALCTS_TEST_PAIR(Contexts.ManyEvaluations, Contexts.ManyEvaluations2, kMust,
                  decide("EV-CTX-UNBOUNDED/1-D", "EV-CTX-UNBOUNDED/2-D"))
(Test& t, bool two) {
  const int times = t.by_depth(120000, 120000, 1000000);  // a million takes 560 MB
  const GLenum target = target_in(two, GL_MAP1_VERTEX_3);
  gl::Case c(fmt::format("{} evaluations", times));
  define(c, random_map(t, target, {3, 2}));
  define_and_enable(c, random_map(t, target_in(two, GL_MAP1_NORMAL), {2, 2}));
  constexpr int kInOne = 1000;
  for (int i = 0; i < times; i += kInOne) {
    c.Begin(GL_POINTS);
    for (int j = 0; j < kInOne; ++j) eval_coord(c, two, 0.25, 0.5);
    c.End();
  }
  c.Enable(target);
  c.Begin(GL_POINTS);
  for (const double u : {0.0, 0.25, 0.5, 1.0}) eval_coord(c, two, u, 0.75);
  c.End();
  t.judge_vertices(c, kPosition);
};

// --- Memory ------------------------------------------------------------------------------------------------

constexpr int kRepetitions = 128;  // of a command in a case

#ifdef __SANITIZE_ADDRESS__
constexpr bool kKeepsWhatIsFreed = true;
#else
constexpr bool kKeepsWhatIsFreed = false;
#endif

// Fails if the library keeps more than `most` bytes for each of the commands, beyond what it keeps for
// explicit ones in their place. It has to do so twice, because caches and huge pages may grow once.
void expect_no_growth(Test& t, const gl::Case& c, const std::string& what, int times, double most) {
  if (kKeepsWhatIsFreed) throw NotObservable("AddressSanitizer keeps what is freed");
  const bool in_new_contexts = times == 1;
  gl::Case control = gl::with_explicit_commands(c);
  control.set_identity(gl::control(c.identity()));
  double kept = 0;
  for (int attempt = 0; attempt < 2; ++attempt) {
    kept = t.kept_memory(c, in_new_contexts) / times;
    if (kept <= most) return;
    kept -= t.kept_memory(control, in_new_contexts) / times;
    if (kept <= most) return;
  }
  const std::string captured = fmt::format("{:.0f} bytes", kept);
  t.fail(failure_of(c, "memory", fmt::format("memory grows by {} with each {}", captured, what),
                    fmt::format("at most {:.0f} bytes", most), captured));
}

EVALCTS_TEST_PAIR(Contexts.MemoryOfMaps, Contexts.MemoryOfMaps2, kQuality,
                  decide("EV-CTX-UNBOUNDED/1-D", "EV-CTX-UNBOUNDED/2-D"))
(Test& t, bool two) {
  t.prefer_fresh_contexts();
  const GLenum target = target_in(two, GL_MAP1_VERTEX_3);
  gl::Case maps(fmt::format("{} definitions of a map", kRepetitions));
  const Map small = random_map(t, target, {2, 2}), large = random_map(t, target, {8, 8});
  for (int i = 0; i < kRepetitions; ++i) define_in_slot(maps, i % 2 ? large : small, false, 0);
  expect_no_growth(t, maps, two ? "Map2f" : "Map1f", kRepetitions, 64);

  gl::Case lists(fmt::format("{} lists that define a map and evaluate it", kRepetitions));
  lists.Enable(target);
  for (int i = 0; i < kRepetitions; ++i) {
    lists.NewList(1, GL_COMPILE);
    define_in_slot(lists, large, false, 0);
    lists.Begin(GL_POINTS);
    eval_coord(lists, two, 0.5, 0.5);
    lists.End();
    lists.EndList();
  }
  expect_no_growth(t, lists, "display list with a map", kRepetitions, 64);

  gl::Case context("a context with a map");
  define_and_enable(context, large);
  expect_no_growth(t, context, "context with a map", 1, 4096);
};

// --- Grids whose steps vanish ------------------------------------------------------------------------------

struct Steps {
  const char* name;
  float first, last;
};
// The smallest steps are a fraction of the distance of adjacent numbers. Steps that overflow give arguments
// that are not numbers, for which the output is not defined (GL 2.1 section 2.1.1).
constexpr Steps kSteps[] = {{"FAR_FROM_ZERO", 0x1p24f, 0x1p24f + 4},
                            {"VERY_FAR", 0x1p100f, 0x1.000002p100f},
                            {"SUBNORMAL", 0, 0x1p-145f},
                            {"HUGE", -0x1p126f, 0x1p126f}};

// A map of order 1 has the same point at every argument, so only the number of vertices is judged.
EVALCTS_TEST_PAIR(Numeric.EveryPointOfVanishingSteps1, Numeric.EveryPointOfVanishingSteps2, kMust,
                  decide("EV-NUM-ENDS/1-D", "EV-NUM-ENDS/2-D"), combine(kSteps))
(Test& t, bool two, const Steps& steps) {
  constexpr int kSegments = 40;
  const auto begin = [&](const char* identity) {
    gl::Case c(identity);
    define_and_enable(
        c, two ? make_map2(GL_MAP2_VERTEX_3, 1, 1, {0.5, 0, 0}) : make_map1(GL_MAP1_VERTEX_3, {0.5, 0, 0}));
    const Grid grid = {kSegments, steps.first, steps.last};
    map_grid(c, two, grid, {1, 0, 1});
    return c;
  };
  const auto same = [](std::size_t) { return 0.5; };
  gl::Case mesh = begin("EvalMesh of points");
  eval_mesh(mesh, two, GL_POINT, 0, kSegments, 0, 0);
  expect_count(t, mesh, kPoints, kSegments + 1, same);
  gl::Case lines = begin("EvalMesh of lines");
  eval_mesh(lines, two, GL_LINE, 0, kSegments, 0, 0);
  expect_count(t, lines, kLines, kSegments, same);
  gl::Case points = begin("EvalPoint and EvalCoord");
  points.Begin(GL_POINTS);
  for (int i = 0; i <= kSegments; ++i) eval_point(points, two, i, 0);
  for (const float u : {steps.first, steps.last}) eval_coord(points, two, u, 0);
  points.End();
  expect_count(t, points, kPoints, kSegments + 3, same);
};

}  // namespace
}  // namespace evalcts::suite_without_limits
