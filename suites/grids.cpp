// Section 13 of the requirements, state and errors: what MapGrid sets and refuses.
#include <fmt/format.h>

#include <cmath>

#include <evalcts/testkit/registration.h>

#include "refusal.h"

namespace evalcts::suite_grids {
namespace {

struct Grid1 {
  GLint n = 1;
  double u1 = 0, u2 = 1;
};
struct Grid2 {
  GLint un = 1;
  double u1 = 0, u2 = 1;
  GLint vn = 1;
  double v1 = 0, v2 = 1;
};

// All ends are representable in single precision: they read back equal through any query.
const std::vector<Grid1>& some_grids1() {
  static const std::vector<Grid1> grids = {{1, 0, 1},
                                           {7, -2.5, 3.25},
                                           {9, -2.5, 3.25},  // only the count is another
                                           {9, -2.5, 4},     // only one end is
                                           {3, 9, -4},       // reversed
                                           {1000, 0x1p-20, 0x1.8p30},
                                           {65536, -1, -0.5},
                                           {kHighest, 0.25, 0.5},
                                           {49, 0.1f, 1.7f},  // all 24 bits
                                           {10, -0x1.fffffep0, 0x1.555556p-2},
                                           {2, -0x1p100, 0x1p100}};
  return grids;
}
const std::vector<Grid2>& some_grids2() {
  static const std::vector<Grid2> grids = {
      {2, 3.5, 4.25, 5, 6.75, 7.125}, {2, 3.5, 4.25, 5, -1, 7.125},
      {2, 3.5, 4.25, 6, -1, 7.125},   {2, 3, 4.25, 6, -1, 7.125},
      {3, 3, 4.25, 6, -1, 7.125},     {5, 7, -8, 2, 9.5, 10},  // u reversed
      {1, -3, -2, 6, 12, 11},                                  // v reversed
      {4, 2, 1, 3, 0.5, -0.5},                                 // both
      {1, 0, 1, kHighest, 0.125, 8},  {kHighest, -16, 0.375, 1, -0x1p100, 0x1p100},
      {70000, 1, 2, 40000, 3, 4},     {7, 0.1f, 0x1.fffffep0, 3, -1.7f, 0x1.555556p-2}};
  return grids;
}

void set(gl::Case& c, const Grid1& grid, bool doubles) {
  if (doubles) {
    c.MapGrid1d(grid.n, grid.u1, grid.u2);
  } else {
    c.MapGrid1f(grid.n, grid.u1, grid.u2);
  }
}
void set(gl::Case& c, const Grid2& grid, bool doubles) {
  if (doubles) {
    c.MapGrid2d(grid.un, grid.u1, grid.u2, grid.vn, grid.v1, grid.v2);
  } else {
    c.MapGrid2f(grid.un, grid.u1, grid.u2, grid.vn, grid.v1, grid.v2);
  }
}

// The values and how many they are, through the forms of Get that lose nothing.
struct Answers {
  gl::Ref segments, single, real;
};
Answers query(gl::Case& c, GLenum segments, GLenum domain) {
  return {c.GetIntegerv(segments, gl::out<GLint>(2)), c.GetFloatv(domain, gl::out<GLfloat>(4)),
          c.GetDoublev(domain, gl::out<GLdouble>(4))};
}
Answers query1(gl::Case& c) { return query(c, GL_MAP1_GRID_SEGMENTS, GL_MAP1_GRID_DOMAIN); }
Answers query2(gl::Case& c) { return query(c, GL_MAP2_GRID_SEGMENTS, GL_MAP2_GRID_DOMAIN); }

void expect_domain(Played& played, const Answers& answers, const std::vector<double>& domain) {
  played.expect_values(answers.single, domain);
  played.expect_values(answers.real, domain);
}
void expect_grid(Played& played, const Answers& answers, const Grid1& grid) {
  played.expect_values(answers.segments, std::vector<GLint>{grid.n});
  expect_domain(played, answers, {grid.u1, grid.u2});
}
void expect_grid(Played& played, const Answers& answers, const Grid2& grid) {
  played.expect_values(answers.segments, std::vector<GLint>{grid.un, grid.vn});
  expect_domain(played, answers, {grid.u1, grid.u2, grid.v1, grid.v2});
}

// Each of the grids is set without error, and is what is then answered.
template <class Grid>
void expect_set(Test& t, const std::string& identity, const std::vector<Grid>& grids, bool doubles,
                const Calls& before = {}) {
  gl::Case c(identity);
  if (before) before(c);
  std::vector<std::pair<gl::Ref, Answers>> answers;
  for (const Grid& grid : grids) {
    set(c, grid, doubles);
    const gl::Ref error = c.GetError();
    answers.emplace_back(error, std::is_same_v<Grid, Grid1> ? query1(c) : query2(c));
  }
  Played played = t.play(c);
  for (std::size_t i = 0; i < grids.size(); ++i) {
    played.expect_no_error(answers[i].first);
    expect_grid(played, answers[i].second, grids[i]);
  }
}

// The places of the grids among the answers of query_everything.
constexpr std::size_t kPlaceOfGrid1 = 4 * gl::kMap1Targets.size() + 1;
constexpr std::size_t kPlaceOfGrid2 = kPlaceOfGrid1 + 2;

void expect_nothing_else(Test& t, const std::string& identity, std::size_t place, const Calls& call) {
  gl::Case c(identity);
  set(c, Grid1{6, -3, 2}, false);
  set(c, Grid2{7, -5, 4, 8, 9, 11}, false);
  const std::vector<gl::Ref> before = query_everything(c, t.max_order());
  call(c);
  const gl::Ref error = c.GetError();
  const std::vector<gl::Ref> after = query_everything(c, t.max_order());
  Played played = t.play(c);
  played.expect_no_error(error);
  for (std::size_t i = 0; i < before.size(); ++i)
    if (i != place && i != place + 1) played.expect_same(before[i], after[i]);
}

std::vector<Calls> setting(const std::vector<Grid1>& grids, bool doubles) {
  std::vector<Calls> calls;
  for (const Grid1& grid : grids) calls.push_back([=](gl::Case& c) { set(c, grid, doubles); });
  return calls;
}
std::vector<Calls> setting(const std::vector<Grid2>& grids, bool doubles) {
  std::vector<Calls> calls;
  for (const Grid2& grid : grids) calls.push_back([=](gl::Case& c) { set(c, grid, doubles); });
  return calls;
}

EVALCTS_TEST(Grids, MapGrid1Sets, must, "EV-GRID-SET1", combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) { expect_set(t, "several grids", some_grids1(), form.doubles); };

EVALCTS_TEST(Grids, MapGrid2Sets, must, "EV-GRID-SET2", combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) { expect_set(t, "several grids", some_grids2(), form.doubles); };

EVALCTS_TEST(Grids, Independent, must, "EV-GRID-INDEP", combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  expect_nothing_else(t, "MapGrid1", kPlaceOfGrid1, [&](gl::Case& c) {
    set(c, Grid1{3, 20, 30}, form.doubles);
  });
  expect_nothing_else(t, "MapGrid2", kPlaceOfGrid2, [&](gl::Case& c) {
    set(c, Grid2{3, 20, 30, 4, 50, 60}, form.doubles);
  });

  expect_nothing_else(t, "MapGrid2 of one row", kPlaceOfGrid2, [&](gl::Case& c) {
    set(c, Grid2{3, 20, 30, 1, 50, 60}, form.doubles);
  });
  expect_nothing_else(t, "MapGrid2 of one column", kPlaceOfGrid2, [&](gl::Case& c) {
    set(c, Grid2{1, 20, 30, 4, 50, 60}, form.doubles);
  });

  gl::Case c("one after the other, both queried after each");
  const Grid1 first{2, 1, 3}, third{9, 8, 7};
  const Grid2 second{4, 5, 6, 10, 11, 12};
  set(c, first, form.doubles);
  set(c, second, form.doubles);
  const Answers one = query1(c), two = query2(c);
  set(c, third, form.doubles);
  const Answers new_one = query1(c), same_two = query2(c);
  Played played = t.play(c);
  expect_grid(played, one, first);
  expect_grid(played, two, second);
  expect_grid(played, new_one, third);
  expect_grid(played, same_two, second);
};

EVALCTS_TEST(Grids, NotPositive, must, "EV-GRID-ERR-N", "EV-GRID-ERR-NOEFFECT",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  expect_refused(
      t, "MapGrid1 of 0, -1, -100 and the lowest int segments",
      setting(std::vector<Grid1>{{0, 2, 3}, {-1, 2, 3}, {-100, 3, 2}, {kLowest, 2, 3}}, form.doubles),
      {GL_INVALID_VALUE});
};

EVALCTS_TEST(Grids, UNotPositive, must, "EV-GRID-ERR-UN", "EV-GRID-ERR-NOEFFECT",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  expect_refused(
      t, "un of 0, -1, -100 and the lowest int",
      setting(
          std::vector<Grid2>{
              {0, 2, 3, 4, 5, 6}, {-1, 2, 3, 4, 5, 6}, {-100, 3, 2, 1, 5, 6}, {kLowest, 2, 3, 1000, 6, 5}},
          form.doubles),
      {GL_INVALID_VALUE});
};

EVALCTS_TEST(Grids, VNotPositive, must, "EV-GRID-ERR-VN", "EV-GRID-ERR-NOEFFECT",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  expect_refused(
      t, "vn of 0, -1, -100 and the lowest int",
      setting(
          std::vector<Grid2>{
              {4, 2, 3, 0, 5, 6}, {4, 2, 3, -1, 5, 6}, {1, 3, 2, -100, 5, 6}, {1000, 2, 3, kLowest, 6, 5}},
          form.doubles),
      {GL_INVALID_VALUE});
};

EVALCTS_TEST(Grids, NeitherPositive, must, "EV-GRID-ERR-UN", "EV-GRID-ERR-VN", "EV-GRID-ERR-NOEFFECT",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  expect_refused(t, "both counts bad",
                 setting(std::vector<Grid2>{{0, 2, 3, 0, 5, 6}, {-1, 2, 3, 0, 5, 6}, {-2, 2, 3, -3, 5, 6}},
                         form.doubles),
                 {GL_INVALID_VALUE});
};

EVALCTS_TEST(Grids, BetweenBeginAndEnd, must, "EV-GRID-ERR-BEGINEND", "EV-GRID-ERR-NOEFFECT",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  for (const bool two : {false, true}) {
    std::vector<Calls> bad;
    for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode)
      for (const bool after_vertex : {false, true})
        bad.push_back([&form, two, mode, after_vertex](gl::Case& c) {
          c.Begin(mode);
          if (after_vertex) c.Vertex3f(1, 2, 3);
          if (two) {
            set(c, Grid2{3, 4, 5, 6, 7, 8}, form.doubles);
          } else {
            set(c, Grid1{3, 4, 5}, form.doubles);
          }
          c.End();
        });
    expect_refused(t, two ? "MapGrid2" : "MapGrid1", bad, {GL_INVALID_OPERATION});
  }
};

// The primitive goes on, and what follows is evaluated on the old grid.
EVALCTS_TEST(Grids, PrimitiveUndisturbed, must, "EV-GRID-ERR-BEGINEND", "EV-GRID-ERR-NOEFFECT",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  gl::Case c("points of both grids around MapGrid1 and MapGrid2");
  define(c, random_map(t, GL_MAP1_VERTEX_3, 3));
  define(c, random_map(t, GL_MAP2_VERTEX_3, {3, 2}));
  c.Enable(GL_MAP1_VERTEX_3);
  c.Enable(GL_MAP2_VERTEX_3);
  set(c, Grid1{4, 0, 1}, form.doubles);
  set(c, Grid2{4, 0, 1, 2, 1, 0}, form.doubles);
  const auto points = [&c] {
    c.EvalPoint1(1);
    c.EvalPoint2(3, 1);
    c.Vertex3f(0.5f, 0.25f, -1);
  };
  c.Begin(GL_POINTS);
  points();
  set(c, Grid1{8, 2, 3}, form.doubles);
  points();
  set(c, Grid2{8, 2, 3, 5, 6, 7}, form.doubles);
  points();
  c.End();
  c.Begin(GL_POINTS);
  points();
  c.End();
  t.expect_emission(c, kPosition);
};

// A refused call is over with its error: the next legal one sets the grid.
EVALCTS_TEST(Grids, LegalCallAfterwards, must, "EV-GRID-ERR-NOEFFECT",
             combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  gl::Case c("refused, then legal");
  set(c, Grid1{0, 1, 2}, form.doubles);
  set(c, Grid2{2, 1, 2, 0, 1, 2}, form.doubles);
  const Grid1 one{4, 6, 8};
  const Grid2 two{3, 6, 8, 5, 9, 7};
  set(c, one, form.doubles);
  set(c, two, form.doubles);
  const gl::Ref first = c.GetError();  // not cleared by the legal calls
  const gl::Ref second = c.GetError();
  const Answers answers1 = query1(c), answers2 = query2(c);
  Played played = t.play(c);
  played.expect_error(first, {GL_INVALID_VALUE});
  // Distributed implementations may keep several flags (GL 2.1 §2.5).
  played.expect_error(second, {GL_NO_ERROR, GL_INVALID_VALUE});
  expect_grid(played, answers1, one);
  expect_grid(played, answers2, two);
};

EVALCTS_TEST(Grids, EqualEndsAreLegal, must, "EV-GRID-EQUAL", combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  expect_set(t, "MapGrid1", std::vector<Grid1>{{3, 5, 5}, {1, 0, 0}, {8, -2.5, -2.5}, {kHighest, 1, 1}},
             form.doubles);
  expect_set(t, "MapGrid2",
             std::vector<Grid2>{{3, 5, 5, 4, 1, 2},
                                {3, 1, 2, 4, 6, 6},
                                {3, 7, 7, 4, -8, -8},
                                {1, 0, 0, 1, 0, 0},
                                {2, 9, 9, 2, 9, 9}},
             form.doubles);
};

// Any count; the first and the last grid point of the largest are the ends of the grid.
EVALCTS_TEST(Grids, LargestCount, must, "EV-GRID-LARGE", combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  expect_set(t, "MapGrid1", std::vector<Grid1>{{kHighest, 0, 1}, {kHighest - 1, 3, -3}, {0x1000001, 0, 1}},
             form.doubles);
  expect_set(t, "MapGrid2",
             std::vector<Grid2>{
                 {kHighest, 0, 1, kHighest, 0, 1}, {kHighest, 2, 3, 1, 4, 5}, {1, 2, 3, kHighest, 5, 4}},
             form.doubles);

  gl::Case one("EvalPoint1 of the first and the last");
  define(one, make_map1(GL_MAP1_VERTEX_3, {1, 2, 3, 4, 5, 6}));
  one.Enable(GL_MAP1_VERTEX_3);
  set(one, Grid1{kHighest, 0, 1}, form.doubles);
  one.Begin(GL_POINTS);
  for (const GLint i : {kHighest, 0}) one.EvalPoint1(i);
  one.End();
  const gl::Ref error1 = one.GetError();
  Played played1 = t.play(one);
  played1.expect_no_error(error1);
  t.expect_emission(one, kPosition);

  gl::Case two("EvalPoint2 of the corners");
  define(two, random_map(t, GL_MAP2_VERTEX_3, {2, 3}));
  two.Enable(GL_MAP2_VERTEX_3);
  set(two, Grid2{kHighest, 0, 1, kHighest, 0, 1}, form.doubles);
  two.Begin(GL_POINTS);
  for (const GLint i : {kHighest, 0})
    for (const GLint j : {kHighest, 0}) two.EvalPoint2(i, j);
  two.End();
  const gl::Ref error2 = two.GetError();
  Played played2 = t.play(two);
  played2.expect_no_error(error2);
  t.expect_emission(two, kPosition);
};

EVALCTS_TEST(Grids, AnyTextureUnit, must, "EV-GRID-NOUNIT", combine(kForms).by(gl::list_deliveries()))
(Test& t, const Form& form) {
  t.require(1, 3, "GL_ARB_multitexture");
  if (t.gl().texture_units < 2) throw NotSupported("has one texture unit only");
  const Calls other_unit = [](gl::Case& c) { c.ActiveTexture(GL_TEXTURE1); };
  expect_set(t, "MapGrid1, TEXTURE1 active", some_grids1(), form.doubles, other_unit);
  expect_set(t, "MapGrid2, TEXTURE1 active", some_grids2(), form.doubles, other_unit);

  const Calls last_unit = [&t](gl::Case& c) {
    c.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(t.gl().texture_units) - 1);
  };
  expect_set(t, "MapGrid1, the last unit active", some_grids1(), form.doubles, last_unit);
  expect_set(t, "MapGrid2, the last unit active", some_grids2(), form.doubles, last_unit);

  gl::Case c("set on TEXTURE1, queried on TEXTURE0 and replaced there");
  const Grid1 one{4, 6, 8}, new_one{2, 3, 5};
  const Grid2 two{3, 6, 8, 5, 9, 7};
  c.ActiveTexture(GL_TEXTURE1);
  set(c, one, form.doubles);
  set(c, two, form.doubles);
  c.ActiveTexture(GL_TEXTURE0);
  const Answers answers1 = query1(c), answers2 = query2(c);
  set(c, new_one, form.doubles);
  c.ActiveTexture(GL_TEXTURE1);
  const Answers replaced = query1(c);
  Played played = t.play(c);
  expect_grid(played, answers1, one);
  expect_grid(played, answers2, two);
  expect_grid(played, replaced, new_one);
};

// Each form replaces what the other set.
EVALCTS_TEST(Grids, FormsShareState, must, "EV-GRID-FD", "EV-API-FD/2-D", by(gl::list_deliveries()))
(Test& t) {
  for (const bool doubles_first : {false, true}) {
    gl::Case c(doubles_first ? "d, f, d, ..." : "f, d, f, ...");
    bool doubles = doubles_first;
    std::vector<Answers> answers1, answers2;
    for (const Grid1& grid : some_grids1()) {
      set(c, grid, doubles);
      doubles = !doubles;
      answers1.push_back(query1(c));
    }
    for (const Grid2& grid : some_grids2()) {
      set(c, grid, doubles);
      doubles = !doubles;
      answers2.push_back(query2(c));
    }
    Played played = t.play(c);
    for (std::size_t i = 0; i < answers1.size(); ++i) expect_grid(played, answers1[i], some_grids1()[i]);
    for (std::size_t i = 0; i < answers2.size(); ++i) expect_grid(played, answers2[i], some_grids2()[i]);
  }
};

// Values away from halves, so that rounding to integers is the same whatever one reads.
EVALCTS_TEST(Get, Grid2, must, "EV-GET-GRIDDOMAIN/2-D", "EV-GET-GRIDSEG/2-D", by(gl::list_deliveries()))
(Test& t) {
  struct Rounded {
    Grid2 grid;
    std::vector<GLint> ends;
  };
  for (const Rounded& expected : {Rounded{{1, 0, 1, 1, 0, 1}, {0, 1, 0, 1}},
                                  {{5, 2.25, -1.75, 9, 3.125, -4.25}, {2, -2, 3, -4}},
                                  {{1000, -7.125, 0, 2, 0, 6.75}, {-7, 0, 0, 7}},
                                  {{256, 0.25, -0.375, 65536, -0x1p-30, 300}, {0, 0, 0, 300}}})
    for (const bool defined : {true, false}) {
      const Grid2& grid = expected.grid;
      if (!defined && grid.un != 1) continue;  // the initial grid is the first of them
      gl::Case c(fmt::format("{}x{} segments{}", grid.un, grid.vn, defined ? "" : ", the initial grid"));
      if (defined) set(c, grid, false);
      const std::vector<double> ends = {grid.u1, grid.u2, grid.v1, grid.v2};
      std::vector<GLboolean> nonzero;
      for (const double end : ends) nonzero.push_back(end != 0 ? GL_TRUE : GL_FALSE);
      const Answers answers = query2(c);
      const gl::Ref domain_i = c.GetIntegerv(GL_MAP2_GRID_DOMAIN, gl::out<GLint>(4));
      const gl::Ref domain_b = c.GetBooleanv(GL_MAP2_GRID_DOMAIN, gl::out<GLboolean>(4));
      const gl::Ref segments_f = c.GetFloatv(GL_MAP2_GRID_SEGMENTS, gl::out<GLfloat>(2));
      const gl::Ref segments_d = c.GetDoublev(GL_MAP2_GRID_SEGMENTS, gl::out<GLdouble>(2));
      const gl::Ref segments_b = c.GetBooleanv(GL_MAP2_GRID_SEGMENTS, gl::out<GLboolean>(2));
      Played played = t.play(c);
      expect_grid(played, answers, grid);
      played.expect_values(domain_i, expected.ends);
      played.expect_values(domain_b, nonzero);
      for (const gl::Ref segments : {segments_f, segments_d})
        played.expect_values(segments, std::vector<GLint>{grid.un, grid.vn});
      played.expect_values(segments_b, std::vector<GLboolean>{GL_TRUE, GL_TRUE});
    }
};

}  // namespace
}  // namespace evalcts::suite_grids
