// Writes grid.json: values at points of grids.
#include <cmath>
#include <limits>

#include <evalcts/gl/tokens.h>
#include "exact_ends.h"
#include "kinds.h"
#include "values.h"

namespace evalcts::vectors {
namespace {

constexpr GLint kMost = std::numeric_limits<GLint>::max();

// Return curves and surfaces of one to three components.
Map some_curve(Dice& dice, int i, const Direction& u) {
  constexpr GLenum kTargets[] = {GL_MAP1_INDEX, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_VERTEX_3};
  return curve(kTargets[i % 3], u, [&](int, int) { return simple(dice); });
}
Map some_surface(Dice& dice, int i, const Direction& u, const Direction& v) {
  constexpr GLenum kTargets[] = {GL_MAP2_INDEX, GL_MAP2_TEXTURE_COORD_1, GL_MAP2_TEXTURE_COORD_2};
  return surface(kTargets[i % 3], u, v, [&](int, int, int) { return simple(dice); });
}

// A theme with cases of both dimensions: its grids, indices, and the domains of its maps.
struct Kind {
  const char *name, *meaning;
  Names requirements;
  std::vector<Ends> grids;
  std::vector<GLint> segments;
  // Returns an index for a grid with this number of segments.
  std::function<std::int64_t(Dice&, GLint segments)> index;
  std::vector<Ends> domains = {{0, 1}};
  int curves = 40, surfaces = 24;
  // True if the length of a segment must not be a number of the type.
  bool inexact_step = false;
};

std::int64_t anywhere(Dice& dice, GLint n) { return dice.below(std::int64_t{n} + 1); }

// Longer than 100 lines, because it is one table.
const std::vector<Kind>& all_kinds() {
  static const std::vector<Kind> kKinds = {
      {"inside",
       "points of ordinary grids",
       {"EV-POINT1-EQUIV", "EV-POINT2-EQUIV", "EV-MESH1-COORDS", "EV-MESH2-COORDS"},
       {{0, 1}, {0.25, 0.75}, {0, 0.5}},
       {1, 2, 3, 4, 7, 10, 16, 100},
       anywhere,
       {{0, 1}, {-1, 1}},
       80,
       60},
      {"awkward",
       "intervals and numbers of segments whose quotient is not a floating-point number",
       {"EV-POINT1-EQUIV", "EV-POINT2-EQUIV", "EV-MESH1-NOACCUM", "EV-MESH2-NOACCUM"},
       {{0.1, 0.7}, {-0.3, 1.1}, {1e-3, 0.9}, {1.0 / 3, 2.0 / 3}},
       {3, 7, 11, 13, 49, 97, 1000},
       anywhere,
       {{0, 1}, {0.1, 0.7}},
       60,
       36,
       true},
      {"first",
       "index 0: the first end (exact-first has the cases that tell it from its neighbours)",
       {"EV-POINT1-EQUIV", "EV-POINT2-EQUIV"},
       {{0.1, 0.7}, {-7.3, 11.9}, {0.3, -0.9}, {1000.1, 1000.7}},
       {1, 3, 10, 97, 1000, kMost},
       [](Dice&, GLint) { return std::int64_t{0}; },
       {{0, 1}, {0.1, 0.7}, {1000, 1001}}},
      {"last",
       "index N: the last end (exact-last has the cases that tell it from its neighbours)",
       {"EV-POINT1-EQUIV", "EV-POINT2-EQUIV"},
       {{0.1, 0.7}, {-7.3, 11.9}, {0.3, -0.9}, {1000.1, 1000.7}},
       {1, 3, 10, 97, 1000, kMost},
       [](Dice&, GLint n) { return std::int64_t{n}; },
       {{0, 1}, {0.1, 0.7}, {1000, 1001}}},
      {"index-outside",
       "indices below 0 and beyond N go on with the same steps",
       {"EV-POINT-RANGE", "EV-MESH1-NEGATIVE", "EV-MESH2-RANGE"},
       {{0, 1}, {0.1, 0.7}, {2, -1}},
       {1, 2, 3, 8, 10},
       [](Dice& dice, GLint n) {
         constexpr int kBeyond[] = {1, 2, 3, 5, 20};
         const int step = dice.pick(kBeyond);
         return dice.one_in(2) ? std::int64_t{-step} : std::int64_t{n} + step;
       }},
      {"reversed",
       "grids from a larger to a smaller number",
       {"EV-GRID-REVERSED", "EV-POINT1-EQUIV", "EV-POINT2-EQUIV"},
       {{1, 0}, {0.7, 0.1}, {1, -1}},
       {1, 2, 3, 5, 8, 10},
       anywhere,
       {{0, 1}, {1, 0}}},
      {"equal-ends",
       "grids whose ends are equal: all their points are the same",
       {"EV-GRID-EQUAL"},
       {{0.5, 0.5}, {0, 0}, {0.1, 0.1}, {3, 3}},
       {1, 3, 10},
       [](Dice& dice, GLint n) { return dice.below(2 * std::int64_t{n} + 1) - n; },
       {{0, 1}},
       24,
       16},
      {"outside-domain",
       "grids that have nothing to do with the domain of the map",
       {"EV-GRID-NOTMAP"},
       {{0, 10}, {-4, 4}, {2, 3}, {100, 104}},
       {1, 2, 5, 8},
       anywhere,
       {{2, 5}, {0, 1}, {-1, 1}, {5, 2}}},
      {"many-segments",
       "numbers of segments up to 2^31 - 1",
       {"EV-GRID-LARGE", "EV-MESH1-NOACCUM"},
       {{0, 1}, {0.1, 0.7}, {-1, 1}},
       {kMost, kMost - 1, 1 << 30, 1000003, 65536},
       anywhere},
      {"far-index",
       "the greatest and the least index",
       {"EV-POINT-RANGE", "EV-GRID-LARGE"},
       {{0, 1}, {0, 0x1p-20}, {0.25, 0.75}},
       {1, 1000, kMost},
       [](Dice& dice, GLint) {
         return dice.one_in(2) ? std::int64_t{kMost} : std::int64_t{std::numeric_limits<GLint>::min()};
       },
       {{0, 1}, {-0x1p31, 0x1p31}},
       24,
       16},
      {"cancelling",
       "an inner point at which i * du and u1 have opposite signs and cancel, in part or to zero",
       {"EV-POINT1-EQUIV", "EV-POINT2-EQUIV", "EV-NUM-ACCURACY"},
       {{-1, 1}, {-0.3, 0.9}, {-1000, 1000}, {-0.7, 0.1}},
       {2, 4, 8, 10},
       [](Dice&, GLint n) { return std::int64_t{n} / 2; },
       {{-1, 1}, {0, 1}}},
      {"offset",
       "short grids far from zero",
       {"EV-POINT1-EQUIV", "EV-POINT2-EQUIV"},
       {{1000, 1001}, {1e6, 1e6 + 1}, {-4096, -4095.5}},
       {1, 3, 10, 64},
       anywhere,
       {{1000, 1001}, {1e6, 1e6 + 4}, {-4100, -4090}}}};
  return kKinds;
}

// Returns a point of a grid of the kind in one direction.
Argument grid_point(Dice& dice, const Kind& kind, Type type, std::size_t& turn) {
  auto [first, last] = rounded(kind.grids[turn % kind.grids.size()], type);
  const GLint segments = kind.segments[static_cast<std::size_t>(dice.below(std::ssize(kind.segments)))];
  ++turn;
  const auto is_exact = [&, first = first](double end) {
    const Rational step = (Rational(end) - Rational(first)) / segments;
    return Rational(rounded(step, type)) == step;
  };
  while (kind.inexact_step && is_exact(last)) last = next_after(last, 100, type);
  return Argument::grid(kind.index(dice, segments), segments, first, last);
}

// A direction with a point at an end of a grid: the probe, and the argument.
struct AtEnd {
  Probe probe;
  Argument argument;
};
AtEnd at_end(Dice& dice, bool last, Type type, int order, int turn) {
  const GridEnds grid = missed_end(dice, last, type);
  const double end = last ? grid.last : grid.first;
  const Probe probe = turn % 3 == 0                          ? wide_probe(dice, order, end)
                      : turn % 3 == 1 || type == Type::kReal ? narrow_probe(order, end)
                                                             : probe_up_to(order, end);
  return {probe, Argument::grid(last ? grid.segments : 0, grid.segments, grid.first, grid.last)};
}

// Returns an interior point of a grid, for the direction that is not under test.
AtEnd across(Dice& dice, int order) {
  const int segments = dice.between(2, 9);
  return {{{order, 0, 1}, true}, Argument::grid(dice.between(1, segments - 1), segments, 0, 1)};
}

double nonzero(Dice& dice) { return static_cast<double>(dice.between(8, 128)) / 16 * dice.sign(); }

void exact_ends(Document& document) {
  constexpr GLenum kCurves[] = {GL_MAP1_INDEX, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_VERTEX_3};
  constexpr GLenum kSurfaces[] = {GL_MAP2_INDEX, GL_MAP2_TEXTURE_COORD_1, GL_MAP2_VERTEX_3};
  Theme first(
      document, "exact-first",
      "index 0 of grids for which u2 - N*du is not u1 in the precision of the type: the value is 0, and "
      "nothing else is accepted that such an argument would give",
      {"EV-POINT-EXACT-0", "EV-MESH1-EXACT-0", "EV-MESH2-EXACT"});
  Theme last(
      document, "exact-last",
      "index N of grids for which N*du + u1 is not u2 in the precision of the type: the value is 0, and "
      "nothing else is accepted that such an argument would give",
      {"EV-POINT-EXACT-N", "EV-MESH1-EXACT-N", "EV-MESH2-EXACT"});
  for (const bool is_last : {false, true}) {
    Theme& theme = is_last ? last : first;
    Dice& dice = theme.dice();
    const auto is_zero = [](const AtEnd& at, int i) {
      return i == (at.probe.zero_first ? 0 : at.probe.direction.order - 1);
    };
    for (int i = 0; i < 48; ++i) {
      const Type type = kTypes[i / 3 % 2];
      const AtEnd u = at_end(dice, is_last, type, dice.between(2, 6), i);
      const Map map = curve(kCurves[i % 3], u.probe.direction,
                            [&](int j, int) { return is_zero(u, j) ? 0 : nonzero(dice); });
      theme.add(value_case({map, type, u.argument}), {}, {"1-D"});
    }
    for (int i = 0; i < 36; ++i) {
      const Type type = kTypes[i / 6 % 2];
      const bool along_v = i % 2 == 1;
      const AtEnd end = at_end(dice, is_last, type, dice.between(2, 4), i / 2);
      const AtEnd other = across(dice, dice.between(1, 3));
      const AtEnd &u = along_v ? other : end, &v = along_v ? end : other;
      const Map map = surface(kSurfaces[i % 3], u.probe.direction, v.probe.direction, [&](int j, int k, int) {
        return is_zero(end, along_v ? k : j) ? 0 : nonzero(dice);
      });
      theme.add(value_case({map, type, u.argument, v.argument}), {}, {"2-D"});
    }
  }
}

void targets(Document& document) {
  Theme theme(document, "targets",
              "points of grids of every target, orders up to 30; with x/w, y/w and z/w where there is a w",
              {"EV-POINT1-EQUIV", "EV-POINT2-EQUIV", "EV-MESH1-COORDS", "EV-MESH2-COORDS"});
  Dice& dice = theme.dice();
  const auto value = [&](GLenum target, int c) {
    const double x = simple(dice);
    const bool is_w = c == 3 && (target == GL_MAP1_VERTEX_4 || target == GL_MAP2_VERTEX_4);
    return is_w ? 1 + std::abs(x) : x;
  };
  const auto point = [&](Type type) {
    constexpr Ends kGrids[] = {{0, 1}, {0.1, 0.7}, {1, 0}, {-0.3, 1.1}};
    constexpr GLint kSegments[] = {3, 7, 10, 49, 100};
    const Ends ends = rounded(dice.pick(kGrids), type);
    const GLint segments = dice.pick(kSegments);
    return Argument::grid(dice.between(-1, segments + 1), segments, ends.first, ends.second);
  };
  int turn = 0;
  for (const GLenum target : gl::kMap1Targets)
    for (const int order : {1, 2, 4, 9, 17, 30}) {
      const Type type = kTypes[turn++ % 2];
      const Map map = curve(target, along(order), [&](int, int c) { return value(target, c); });
      theme.add(value_case({map, type, point(type)}), {}, {"1-D"});
    }
  constexpr std::pair<int, int> kOrders[] = {{2, 3}, {4, 4}, {9, 2}, {3, 9}, {30, 1}, {2, 30}};
  for (const GLenum target : gl::kMap2Targets)
    for (const auto& [uorder, vorder] : kOrders) {
      const Type type = kTypes[turn++ % 2];
      const Map map =
          surface(target, along(uorder), along(vorder), [&](int, int, int c) { return value(target, c); });
      const Argument u = point(type), v = point(type);
      theme.add(value_case({map, type, u, v}), {}, {"2-D"});
    }
}

}  // namespace

Document grid() {
  Document document("grid",
                    "Values at the points of grids (MapGrid, EvalPoint, EvalMesh), whose arguments are the "
                    "real numbers i*(g2 - g1)/N + g1.");
  document.explain("1-D", "MapGrid1 and a curve");
  document.explain("2-D", "MapGrid2 and a surface");
  for (const Kind& kind : all_kinds()) {
    Theme theme(document, kind.name, kind.meaning, kind.requirements);
    Dice& dice = theme.dice();
    std::size_t turn = 0;
    for (int i = 0; i < kind.curves; ++i) {
      const Type type = kTypes[i % 2];
      const Ends domain = rounded(kind.domains[static_cast<std::size_t>(i) % kind.domains.size()], type);
      const Map map = some_curve(dice, i, along(dice.between(2, 7), domain));
      theme.add(value_case({map, type, grid_point(dice, kind, type, turn)}), {}, {"1-D"});
    }
    for (int i = 0; i < kind.surfaces; ++i) {
      const Type type = kTypes[i % 2];
      const auto domain = [&](int which) {
        return rounded(kind.domains[static_cast<std::size_t>(i + which) % kind.domains.size()], type);
      };
      const Direction u = along(dice.between(1, 4), domain(0)), v = along(dice.between(1, 4), domain(1));
      const Map map = some_surface(dice, i, u, v);
      const Argument x = grid_point(dice, kind, type, turn), y = grid_point(dice, kind, type, turn);
      theme.add(value_case({map, type, x, y}), {}, {"2-D"});
    }
  }
  exact_ends(document);
  targets(document);
  return document;
}

}  // namespace evalcts::vectors
