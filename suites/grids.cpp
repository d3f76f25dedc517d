// Section 13 of the requirements: the state that MapGrid sets, and the calls that it rejects.
#include <fmt/format.h>

#include <optional>

#include <evalcts/testkit/registration.h>

#include "dimensions.h"
#include "grid_cases.h"
#include "rejection.h"

namespace evalcts::suite_grids {
namespace {

// The arguments of MapGrid1 or, with `v`, of MapGrid2.
struct Grids {
  Grids(int n, float u1, float u2) : u{n, u1, u2} {}
  Grids(int un, float u1, float u2, int vn, float v1, float v2) : u{un, u1, u2}, v{{vn, v1, v2}} {}

  Grid u;
  std::optional<Grid> v;
};

// Grids whose ends are representable in single precision, so that all queries return them unchanged.
const std::vector<Grids>& some_grids1() {
  static const std::vector<Grids> kGrids = {{1, 0, 1},
                                            {7, -2.5, 3.25},
                                            {9, -2.5, 3.25},  // only the count differs
                                            {9, -2.5, 4},     // only one end differs
                                            {3, 9, -4},       // reversed
                                            {1000, 0x1p-20, 0x1.8p30},
                                            {65536, -1, -0.5},
                                            {kHighest, 0.25, 0.5},
                                            {49, 0.1f, 1.7f},  // ends with 24 significant bits
                                            {10, -0x1.fffffep0, 0x1.555556p-2},
                                            {2, -0x1p100, 0x1p100}};
  return kGrids;
}
const std::vector<Grids>& some_grids2() {
  static const std::vector<Grids> kGrids = {
      {2, 3.5, 4.25, 5, 6.75, 7.125}, {2, 3.5, 4.25, 5, -1, 7.125},
      {2, 3.5, 4.25, 6, -1, 7.125},   {2, 3, 4.25, 6, -1, 7.125},
      {3, 3, 4.25, 6, -1, 7.125},     {5, 7, -8, 2, 9.5, 10},  // u reversed
      {1, -3, -2, 6, 12, 11},                                  // v reversed
      {4, 2, 1, 3, 0.5, -0.5},                                 // both reversed
      {1, 0, 1, kHighest, 0.125, 8},  {kHighest, -16, 0.375, 1, -0x1p100, 0x1p100},
      {70000, 1, 2, 40000, 3, 4},     {7, 0.1f, 0x1.fffffep0, 3, -1.7f, 0x1.555556p-2}};
  return kGrids;
}

void set(gl::Case& c, const Grids& grid, bool doubles) {
  const auto& [u, v] = grid;
  if (!doubles) {
    v ? map_grid(c, u, *v) : map_grid(c, u);
  } else if (v) {
    c.MapGrid2d(u.segments, u.first, u.last, v->segments, v->first, v->last);
  } else {
    c.MapGrid1d(u.segments, u.first, u.last);
  }
}

// Appends queries of a grid through the forms of Get that do not round.
void query_grid(Test& t, gl::Case& c, bool two) {
  const GLenum domain = two ? GL_MAP2_GRID_DOMAIN : GL_MAP1_GRID_DOMAIN;
  c.GetIntegerv(two ? GL_MAP2_GRID_SEGMENTS : GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(2));
  c.GetFloatv(domain, gl::out<GLfloat>(4));
  if (t.can_call(gl::EntryPoint::GetDoublev)) c.GetDoublev(domain, gl::out<GLdouble>(4));
}

// Throws NotObservable if the implementation rejects queries of grids, for tests of other rules than those of
// the queries.
void require_queries(Test& t) {
  for (const GLenum name :
       {GL_MAP1_GRID_DOMAIN, GL_MAP1_GRID_SEGMENTS, GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS})
    if (!t.can_query_grid(name)) throw NotObservable("queries of grids are rejected");
}

// Sets each of the grids after the commands `before`, and judges errors and the grid.
void judge_grids(Test& t, const std::string& identity, const std::vector<Grids>& grids, bool doubles,
                 const Calls& before = {}) {
  require_queries(t);
  gl::Case c(identity);
  if (before) before(c);
  for (const Grids& grid : grids) {
    set(c, grid, doubles);
    c.GetError();
    query_grid(t, c, grid.v.has_value());
  }
  t.judge(c);
}

std::vector<Calls> setting(const std::vector<Grids>& grids, bool doubles) {
  std::vector<Calls> calls;
  for (const Grids& grid : grids) calls.push_back([=](gl::Case& c) { set(c, grid, doubles); });
  return calls;
}

const auto kEachForm = combine(kForms).by(gl::list_deliveries());

EVALCTS_TEST(Grids, MapGrid1Sets, kMust, "EV-GRID-SET1", kEachForm)
(Test& t, const Form& form) { judge_grids(t, "several grids", some_grids1(), form.doubles); };

EVALCTS_TEST(Grids, MapGrid2Sets, kMust, "EV-GRID-SET2", kEachForm)
(Test& t, const Form& form) { judge_grids(t, "several grids", some_grids2(), form.doubles); };

EVALCTS_TEST(Grids, Independent, kMust, "EV-GRID-INDEP", kEachForm)
(Test& t, const Form& form) {
  require_queries(t);
  const Grids first{2, 1, 3}, second{4, 5, 6, 10, 11, 12}, third{9, 8, 7};
  // The last two grids have one row and one column.
  for (const Grids& last : {Grids{3, 20, 30}, Grids{3, 20, 30, 4, 50, 60}, Grids{3, 20, 30, 1, 50, 60},
                            Grids{1, 20, 30, 4, 50, 60}}) {
    gl::Case c("one after the other, both queried after each, and everything else before and after the last");
    for (const Grids& grid : {first, second, third}) {
      set(c, grid, form.doubles);
      for (const bool two : {false, true}) query_grid(t, c, two);
    }
    take_snapshot(t, c);
    set(c, last, form.doubles);
    take_snapshot(t, c);
    c.GetError();
    t.judge(c);
  }
};

EVALCTS_TEST(Grids, NotPositive, kMust, "EV-GRID-ERR-N", "EV-GRID-ERR-NOEFFECT", kEachForm)
(Test& t, const Form& form) {
  judge_rejected(t, "MapGrid1 of 0, -1, -100 and the lowest int segments",
                 setting({{0, 2, 3}, {-1, 2, 3}, {-100, 3, 2}, {kLowest, 2, 3}}, form.doubles));
};

EVALCTS_TEST_PAIR(Grids.UNotPositive, Grids.VNotPositive, kMust, decide("EV-GRID-ERR-UN", "EV-GRID-ERR-VN"),
                  "EV-GRID-ERR-NOEFFECT", kEachForm)
(Test& t, bool along_v, const Form& form) {
  std::vector<Grids> bad = {
      {4, 2, 3, 0, 5, 6}, {4, 2, 3, -1, 5, 6}, {1, 3, 2, -100, 5, 6}, {1000, 2, 3, kLowest, 6, 5}};
  if (!along_v)
    for (Grids& grids : bad) std::swap(grids.u.segments, grids.v->segments);
  judge_rejected(t, fmt::format("{} of 0, -1, -100 and the lowest int", along_v ? "vn" : "un"),
                 setting(bad, form.doubles));
};

EVALCTS_TEST(Grids, NeitherPositive, kMust, "EV-GRID-ERR-UN", "EV-GRID-ERR-VN", "EV-GRID-ERR-NOEFFECT",
             kEachForm)
(Test& t, const Form& form) {
  judge_rejected(t, "both counts bad",
                 setting({{0, 2, 3, 0, 5, 6}, {-1, 2, 3, 0, 5, 6}, {-2, 2, 3, -3, 5, 6}}, form.doubles));
};

EVALCTS_TEST(Grids, BetweenBeginAndEnd, kMust, "EV-GRID-ERR-BEGINEND", "EV-GRID-ERR-NOEFFECT", kEachForm)
(Test& t, const Form& form) {
  for (const bool two : {false, true}) {
    std::vector<Calls> bad;
    for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode)
      for (const bool after_vertex : {false, true})
        bad.push_back(in_primitive(mode, after_vertex, [&form, two](gl::Case& c) {
          set(c, two ? Grids{3, 4, 5, 6, 7, 8} : Grids{3, 4, 5}, form.doubles);
        }));
    judge_rejected(t, two ? "MapGrid2" : "MapGrid1", bad);
  }
};

// A rejected MapGrid does not end the primitive around it, and later points are evaluated on the old grid.
EVALCTS_TEST(Grids, PrimitiveUndisturbed, kMust, "EV-GRID-ERR-BEGINEND", "EV-GRID-ERR-NOEFFECT", kEachForm)
(Test& t, const Form& form) {
  gl::Case c("points of both grids around MapGrid1 and MapGrid2");
  define(c, random_map(t, GL_MAP1_VERTEX_3, 3));
  define(c, random_map(t, GL_MAP2_VERTEX_3, {3, 2}));
  c.Enable(GL_MAP1_VERTEX_3);
  c.Enable(GL_MAP2_VERTEX_3);
  set(c, Grids{4, 0, 1}, form.doubles);
  set(c, Grids{4, 0, 1, 2, 1, 0}, form.doubles);
  const auto points = [&c] {
    c.EvalPoint1(1);
    c.EvalPoint2(3, 1);
    c.Vertex3f(0.5f, 0.25f, -1);
  };
  c.Begin(GL_POINTS);
  points();
  set(c, Grids{8, 2, 3}, form.doubles);
  points();
  set(c, Grids{8, 2, 3, 5, 6, 7}, form.doubles);
  points();
  c.End();
  c.Begin(GL_POINTS);
  points();
  c.End();
  t.judge_vertices(c, kPosition);
};

// A legal call after a rejected one sets the grid.
EVALCTS_TEST(Grids, LegalCallAfterwards, kMust, "EV-GRID-ERR-NOEFFECT", kEachForm)
(Test& t, const Form& form) {
  require_queries(t);
  gl::Case c("rejected, then legal");
  for (const Grids& grid : {Grids{0, 1, 2}, Grids{2, 1, 2, 0, 1, 2}, Grids{4, 6, 8}, Grids{3, 6, 8, 5, 9, 7}})
    set(c, grid, form.doubles);
  c.GetError();  // the legal calls do not clear the error
  c.GetError();
  for (const bool two : {false, true}) query_grid(t, c, two);
  t.judge(c);
};

EVALCTS_TEST(Grids, EqualEndsAreLegal, kMust, "EV-GRID-EQUAL", kEachForm)
(Test& t, const Form& form) {
  judge_grids(t, "MapGrid1", {{3, 5, 5}, {1, 0, 0}, {8, -2.5, -2.5}, {kHighest, 1, 1}}, form.doubles);
  judge_grids(
      t, "MapGrid2",
      {{3, 5, 5, 4, 1, 2}, {3, 1, 2, 4, 6, 6}, {3, 7, 7, 4, -8, -8}, {1, 0, 0, 1, 0, 0}, {2, 9, 9, 2, 9, 9}},
      form.doubles);
};

// Counts up to the largest int are accepted; with the largest, the first and the last grid point are the
// ends.
EVALCTS_TEST(Grids, LargestCount, kMust, "EV-GRID-LARGE", kEachForm)
(Test& t, const Form& form) {
  judge_grids(t, "MapGrid1", {{kHighest, 0, 1}, {kHighest - 1, 3, -3}, {0x1000001, 0, 1}}, form.doubles);
  judge_grids(t, "MapGrid2",
              {{kHighest, 0, 1, kHighest, 0, 1}, {kHighest, 2, 3, 1, 4, 5}, {1, 2, 3, kHighest, 5, 4}},
              form.doubles);

  for (const bool two : {false, true}) {
    gl::Case c(two ? "EvalPoint2 of the corners" : "EvalPoint1 of the first and the last");
    define_and_enable(
        c, two ? random_map(t, GL_MAP2_VERTEX_3, {2, 3}) : make_map1(GL_MAP1_VERTEX_3, {1, 2, 3, 4, 5, 6}));
    set(c, two ? Grids{kHighest, 0, 1, kHighest, 0, 1} : Grids{kHighest, 0, 1}, form.doubles);
    c.Begin(GL_POINTS);
    for (const GLint i : {kHighest, 0})
      for (const GLint j : {kHighest, 0})
        if (two || j == 0) eval_point(c, two, i, j);
    c.End();
    c.GetError();
    t.judge_answers(c);
    t.judge_vertices(c, kPosition);
  }
};

EVALCTS_TEST(Grids, AnyTextureUnit, kMust, "EV-GRID-NOUNIT", kEachForm)
(Test& t, const Form& form) {
  require_texture_units(t);
  const Calls other_unit = [](gl::Case& c) { c.ActiveTexture(GL_TEXTURE1); };
  judge_grids(t, "MapGrid1, TEXTURE1 active", some_grids1(), form.doubles, other_unit);
  judge_grids(t, "MapGrid2, TEXTURE1 active", some_grids2(), form.doubles, other_unit);

  const Calls use_last_unit = [&t](gl::Case& c) { c.ActiveTexture(last_unit(t)); };
  judge_grids(t, "MapGrid1, the last unit active", some_grids1(), form.doubles, use_last_unit);
  judge_grids(t, "MapGrid2, the last unit active", some_grids2(), form.doubles, use_last_unit);

  gl::Case c("set on TEXTURE1, queried on TEXTURE0 and replaced there");
  c.ActiveTexture(GL_TEXTURE1);
  set(c, Grids{4, 6, 8}, form.doubles);
  set(c, Grids{3, 6, 8, 5, 9, 7}, form.doubles);
  c.ActiveTexture(GL_TEXTURE0);
  for (const bool two : {false, true}) query_grid(t, c, two);
  set(c, Grids{2, 3, 5}, form.doubles);
  c.ActiveTexture(GL_TEXTURE1);
  query_grid(t, c, kCurves);
  t.judge(c);
};

// MapGrid in floats replaces the grid that MapGrid in doubles set, and vice versa.
EVALCTS_TEST(Grids, FormsShareState, kMust, "EV-GRID-FD", "EV-API-FD/2-D", by(gl::list_deliveries()))
(Test& t) {
  require_queries(t);
  for (const bool doubles_first : {false, true}) {
    gl::Case c(doubles_first ? "d, f, d, ..." : "f, d, f, ...");
    bool doubles = doubles_first;
    for (const auto& grids : {some_grids1(), some_grids2()})
      for (const Grids& grid : grids) {
        set(c, grid, doubles);
        doubles = !doubles;
        query_grid(t, c, grid.v.has_value());
      }
    t.judge(c);
  }
};

}  // namespace
}  // namespace evalcts::suite_grids
