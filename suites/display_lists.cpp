// Section 20 of the requirements: what is special about evaluator commands in display lists. That a list does
// what its commands do is shown by the other suites, whose cases go through lists as well
// (gl/display_lists.h).
#include <fmt/format.h>

#include "suites/grid_cases.h"
#include "suites/refusal.h"

namespace evalcts::suite_display_lists {
namespace {

constexpr GLuint kList = 3, kOther = 4, kThird = 5;

void compile(gl::Case& c, GLuint list, const Calls& calls, GLenum mode = GL_COMPILE) {
  c.NewList(list, mode);
  calls(c);
  c.EndList();
}

// Commands that change state, away from the initial one.
using Setting = NamedCalls;

std::vector<Setting> settings() {
  std::vector<Setting> all;
  for (const bool doubles : {false, true}) {
    const char* const form = doubles ? "d" : "f";
    all.push_back({fmt::format("Map1{}", form), [=](gl::Case& c) {
                     for (const GLenum target : gl::kMap1Targets) {
                       const auto k = static_cast<std::size_t>(gl::components_of(target));
                       define(c, make_map1(target, 0.25, -1.5, 6, std::vector<double>(3 * k, 0.625)),
                              doubles);
                     }
                   }});
    all.push_back({fmt::format("Map2{}", form), [=](gl::Case& c) {
                     for (const GLenum target : gl::kMap2Targets) {
                       const auto k = static_cast<std::size_t>(gl::components_of(target));
                       define(c, make_map2(target, 2, 3, 20, 5, std::vector<double>(6 * k, 0.625)), doubles);
                     }
                   }});
    all.push_back({fmt::format("MapGrid1{}", form), [=](gl::Case& c) {
                     if (doubles)
                       c.MapGrid1d(5, 2.0, 0.25);
                     else
                       c.MapGrid1f(5, 2.0f, 0.25f);
                   }});
    all.push_back({fmt::format("MapGrid2{}", form), [=](gl::Case& c) {
                     if (doubles)
                       c.MapGrid2d(5, 2.0, 0.25, 7, -1.0, 3.0);
                     else
                       c.MapGrid2f(5, 2.0f, 0.25f, 7, -1.0f, 3.0f);
                   }});
  }
  all.push_back({"Enable", [](gl::Case& c) {
                   for (const GLenum target : gl::kMap1Targets) c.Enable(target);
                   for (const GLenum target : gl::kMap2Targets) c.Enable(target);
                   c.Enable(GL_AUTO_NORMAL);
                 }});
  all.push_back({"Disable", [](gl::Case& c) {
                   for (const GLenum target : gl::kMap1Targets) c.Disable(target);
                   for (const GLenum target : gl::kMap2Targets) c.Disable(target);
                   c.Disable(GL_AUTO_NORMAL);
                 }});
  return all;
}

// So that Disable has something to do.
void prepare_for(gl::Case& c, const Setting& setting) {
  if (setting.name != "Disable") return;
  for (const GLenum target : gl::kMap1Targets) c.Enable(target);
  for (const GLenum target : gl::kMap2Targets) c.Enable(target);
  c.Enable(GL_AUTO_NORMAL);
}

// Three points by EvalCoord, three by EvalPoint.
void evaluate_and_eval_points(gl::Case& c, bool two) {
  c.Begin(GL_POINTS);
  for (const float u : {0.0f, 0.375f, 1.0f}) {
    if (two)
      c.EvalCoord2f(u, 1.5f);
    else
      c.EvalCoord1f(u);
  }
  for (const GLint i : {0, 2, 5}) {
    if (two)
      c.EvalPoint2(i, 1);
    else
      c.EvalPoint1(i);
  }
  c.End();
}

void mesh_of_points(gl::Case& c, bool two) {
  if (two)
    c.EvalMesh2(GL_POINT, 1, 3, 0, 1);
  else
    c.EvalMesh1(GL_POINT, 1, 4);
}

void set_grid(gl::Case& c, bool two, const Grid& u = {4, -0.5f, 2.0f}) {
  if (two)
    map_grid(c, u, {3, 1.25f, 2.0f});
  else
    map_grid(c, u);
}

// Other points for the vertex map of enable_maps.
void define_vertices(Test& t, gl::Case& c, bool two) {
  if (two)
    define(c, random_map2(t, GL_MAP2_VERTEX_3, 2, 3));
  else
    define(c, random_map(t, GL_MAP1_VERTEX_3, 3));
}

}  // namespace

// --- Compiling -------------------------------------------------------------------------------------------

EVALCTS_TESTS(DisplayLists, CompilingExecutesNothing, settings(), const Setting& setting, must,
              "EV-DL-COMPILED", "EV-DL-GETMAP") {
  gl::Case c("queried before the list, in it and after it");
  prepare_for(c, setting);
  const std::vector<gl::Ref> before = query_everything(c, t.max_order());
  c.NewList(kList, GL_COMPILE);
  setting.issue(c);
  const std::vector<gl::Ref> inside = query_everything(c, t.max_order());
  c.EndList();
  const std::vector<gl::Ref> after = query_everything(c, t.max_order());
  const gl::Ref error = c.GetError();
  Played played = t.play(c);
  expect_unchanged(played, before, inside);
  expect_unchanged(played, before, after);
  played.expect_no_error(error);
}

EVALCTS_TESTS(DisplayLists, CompilingDrawsNothing, kDimensions, const Dimension& dimension, must,
              "EV-DL-COMPILED") {
  gl::Case c("EvalCoord, EvalPoint and EvalMesh compiled, then a point");
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two);
  compile(c, kList, [&](gl::Case& list) {
    evaluate_and_eval_points(list, dimension.two);
    mesh_of_points(list, dimension.two);
  });
  c.Begin(GL_POINTS);
  c.Vertex3f(0.25f, 0.5f, 0.75f);
  c.End();
  t.expect_emission(c, kUnit0);
}

// --- Calling ---------------------------------------------------------------------------------------------

// The command itself, issued once more, changes nothing then.
EVALCTS_TESTS(DisplayLists, CallHasLastingEffect, settings(), const Setting& setting, must, "EV-DL-EXECUTE") {
  gl::Case c("queried before the call, after it, and after the commands themselves");
  prepare_for(c, setting);
  compile(c, kList, setting.issue);
  const std::vector<gl::Ref> before = query_everything(c, t.max_order());
  c.CallList(kList);
  const std::vector<gl::Ref> called = query_everything(c, t.max_order());
  setting.issue(c);
  const std::vector<gl::Ref> issued = query_everything(c, t.max_order());
  Played played = t.play(c);
  expect_unchanged(played, called, issued);
  std::size_t changed = before.size();
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!played.trace().same(before[i], played.trace(), called[i])) changed = i;
  played.expect(changed < before.size(), called.front(),
                "the list has no effect: all queries answer as before", "other answers", "the same answers");
}

// Indices are signed and of 32 bits in lists, too.
EVALCTS_TESTS(DisplayLists, IndicesKept, kDimensions, const Dimension& dimension, must, "EV-DL-EXECUTE") {
  gl::Case c("points outside the grid, and far in a fine one");
  dimension.two ? define(c, random_map2(t, GL_MAP2_VERTEX_3, 3, 2))
                : define(c, random_map(t, GL_MAP1_VERTEX_3, 3));
  c.Enable(dimension.two ? GL_MAP2_VERTEX_3 : GL_MAP1_VERTEX_3);
  const auto points = [&](gl::Case& list, std::initializer_list<GLint> indices) {
    list.Begin(GL_POINTS);
    for (const GLint i : indices) dimension.two ? list.EvalPoint2(i, 1 - i) : list.EvalPoint1(i);
    list.End();
  };
  compile(c, kList, [&](gl::Case& list) {
    dimension.two ? list.MapGrid2f(4, 0.0f, 1.0f, 4, 1.0f, 0.0f) : list.MapGrid1f(4, 0.0f, 1.0f);
    points(list, {-2, 6});
    if (dimension.two) {
      list.EvalMesh2(GL_POINT, -2, -1, 3, 5);
      list.EvalMesh2(GL_POINT, 4, 5, -1, 0);
    } else {
      list.EvalMesh1(GL_POINT, -2, 5);
    }
    dimension.two ? list.MapGrid2f(100000, 0.0f, 1.0f, 100000, 1.0f, 0.0f)
                  : list.MapGrid1f(100000, 0.0f, 1.0f);
    points(list, {300, 40000, 70000, -40000});
    dimension.two ? list.EvalMesh2(GL_POINT, 70000, 70000, 40000, 40001)
                  : list.EvalMesh1(GL_POINT, 70000, 70001);
  });
  c.CallList(kList);
  t.expect_emission(c, kPosition);
}

EVALCTS_TESTS(DisplayLists, CompileAndExecuteDrawsOnce, kDimensions, const Dimension& dimension, must,
              "EV-DL-COMPEXEC") {
  gl::Case c("compiled and executed, a point, then called");
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two);
  compile(
      c, kList,
      [&](gl::Case& list) {
        evaluate_and_eval_points(list, dimension.two);
        mesh_of_points(list, dimension.two);
      },
      GL_COMPILE_AND_EXECUTE);
  c.Begin(GL_POINTS);
  c.Vertex3f(0.25f, 0.5f, 0.75f);
  c.End();
  c.CallList(kList);
  t.expect_emission(c, kUnit0);
}

EVALCTS_TESTS(DisplayLists, CompileAndExecuteSets, settings(), const Setting& setting, must, "EV-DL-COMPEXEC",
              "EV-DL-GETMAP") {
  gl::Case c("queried in the list, after it, and after the commands themselves");
  prepare_for(c, setting);
  const std::vector<gl::Ref> before = query_everything(c, t.max_order());
  c.NewList(kList, GL_COMPILE_AND_EXECUTE);
  setting.issue(c);
  const std::vector<gl::Ref> inside = query_everything(c, t.max_order());
  c.EndList();
  const std::vector<gl::Ref> after = query_everything(c, t.max_order());
  setting.issue(c);
  const std::vector<gl::Ref> issued = query_everything(c, t.max_order());
  Played played = t.play(c);
  expect_unchanged(played, inside, after);
  expect_unchanged(played, inside, issued);
  bool changed = false;
  for (std::size_t i = 0; i < before.size(); ++i)
    changed = changed || !played.trace().same(before[i], played.trace(), inside[i]);
  played.expect(changed, inside.front(),
                "the list is compiled, but not executed: all queries answer as before", "other answers",
                "the same answers");
}

// --- Memory ----------------------------------------------------------------------------------------------

EVALCTS_TESTS(DisplayLists, PointsReadWhileCompiling, kFates, const Fate& fate, must, "EV-DL-POINTS-COPIED") {
  for (const TargetForm& form : target_forms()) {
    gl::Case c(form.name);
    const Map1 map = random_map(t, form.target, 5, 6);
    compile(c, kList, [&](gl::Case& list) { define(list, map, form.doubles, fate.after); });
    c.CallList(kList);
    const MapQuery query = query_map(c, form.target, t.max_order(), form.doubles);
    Played played = t.play(c);
    expect_map(played, query, map, form.doubles);
  }
  for (const TargetForm& form : target_forms2()) {
    gl::Case c(form.name);
    const Map2 map = random_map2(t, form.target, 3, 4, kLayouts[3]);
    compile(c, kList, [&](gl::Case& list) { define(list, map, form.doubles, fate.after); });
    c.CallList(kList);
    const MapQuery query = query_map(c, form.target, t.max_order(), form.doubles);
    Played played = t.play(c);
    expect_map(played, query, map, form.doubles);
  }
}

// Two lists from the same memory with other contents.
EVALCTS_TESTS(DisplayLists, SamePointerNewPoints, kForms, const Form& form, must, "EV-DL-POINTS-COPIED") {
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP1_TEXTURE_COORD_1}) {
    gl::Case c(label(target));
    const Map1 first = random_map(t, target, 4, 5), second = random_map(t, target, 4, 5);
    compile(c, kList, [&](gl::Case& list) { define_in_slot(list, first, form.doubles, 0); });
    compile(c, kOther, [&](gl::Case& list) { define_in_slot(list, second, form.doubles, 0); });
    c.CallList(kList);
    const MapQuery one = query_map(c, target, t.max_order(), form.doubles);
    c.CallList(kOther);
    const MapQuery two = query_map(c, target, t.max_order(), form.doubles);
    Played played = t.play(c);
    expect_map(played, one, first, form.doubles);
    expect_map(played, two, second, form.doubles);
  }
}

EVALCTS_TESTS(DisplayLists, StrideKept1, target_forms(), const TargetForm& form, must, "EV-DL-STRIDE-KEPT") {
  const int k = gl::components_of(form.target);
  for (const int stride : {k, k + 1, 2 * k, 17, 257})
    for (const int order : {1, 2, 5, t.max_order()}) {
      gl::Case c(fmt::format("stride {} order {}", stride, order));
      const Map1 map = random_map(t, form.target, order, stride);
      compile(c, kList, [&](gl::Case& list) { define(list, map, form.doubles); });
      c.CallList(kList);
      const MapQuery query = query_map(c, form.target, t.max_order(), form.doubles);
      Played played = t.play(c);
      expect_map(played, query, map, form.doubles);
    }
}

EVALCTS_TESTS(DisplayLists, StrideKept2, target_forms2(), const TargetForm& form, must, "EV-DL-STRIDE-KEPT") {
  for (const Layout& layout : kLayouts) {
    gl::Case c(layout.name);
    const Map2 map = random_map2(t, form.target, 3, 5, layout);
    compile(c, kList, [&](gl::Case& list) { define(list, map, form.doubles); });
    c.CallList(kList);
    const MapQuery query = query_map(c, form.target, t.max_order(), form.doubles);
    Played played = t.play(c);
    expect_map(played, query, map, form.doubles);
  }
}

// Over domains where single precision would tell another argument.
EVALCTS_TESTS(DisplayLists, DoubleForms, kDimensions, const Dimension& dimension, must, "EV-DL-DOUBLE") {
  for (const auto& [u1, u2] : {std::pair{0.1, 0.7}, {1.0 / 3, -2.0}}) {
    gl::Case c(fmt::format("all commands with doubles, over [{}, {}]", u1, u2));
    compile(c, kList, [&, u1 = u1, u2 = u2](gl::Case& list) {
      if (dimension.two) {
        Map2 map = random_map2(t, GL_MAP2_VERTEX_4, 3, 4);
        map.u1 = u1, map.u2 = u2, map.v1 = u2, map.v2 = u1;
        define(list, map, true);
        list.Enable(GL_MAP2_VERTEX_4);
        list.MapGrid2d(3, u1, u2, 5, u2, u1);
        list.Begin(GL_POINTS);
        for (const double x : {u1, 0.5 * (u1 + u2), u2}) {
          list.EvalCoord2d(x, u1);
          list.EvalCoord2dv(std::vector<double>{u2, x});
        }
        for (const GLint i : {0, 1, 3}) list.EvalPoint2(i, 5 - i);
        list.End();
      } else {
        Map1 map = random_map(t, GL_MAP1_VERTEX_4, 5);
        map.u1 = u1, map.u2 = u2;
        define(list, map, true);
        list.Enable(GL_MAP1_VERTEX_4);
        list.MapGrid1d(3, u1, u2);
        list.Begin(GL_POINTS);
        for (const double x : {u1, 0.5 * (u1 + u2), u2}) {
          list.EvalCoord1d(x);
          list.EvalCoord1dv(std::vector<double>{x});
        }
        for (const GLint i : {0, 1, 3}) list.EvalPoint1(i);
        list.End();
      }
    });
    c.CallList(kList);
    t.expect_emission(c, kPosition);
  }
}

// --- Errors ----------------------------------------------------------------------------------------------

namespace {

struct Bad {
  std::string name;
  GLenum error;
  Calls issue;
};

std::vector<Bad> bad_maps(bool doubles, const char* form, int max_order) {
  std::vector<Bad> all;
  const auto add1 = [&](const std::string& what, GLenum error, GLenum target, double u1, double u2,
                        GLint stride, GLint order) {
    all.push_back({fmt::format("Map1{} with {}", form, what), error, [=](gl::Case& c) {
                     const std::vector<double> points(512, 0.5);
                     if (doubles)
                       c.Map1d(target, u1, u2, stride, order, points);
                     else
                       c.Map1f(target, u1, u2, stride, order, converted<float>(points));
                   }});
  };
  add1("a target that is none", GL_INVALID_ENUM, GL_TEXTURE_2D, 0, 1, 4, 4);
  add1("a target of Map2", GL_INVALID_ENUM, GL_MAP2_VERTEX_3, 0, 1, 4, 4);
  add1("order 0", GL_INVALID_VALUE, GL_MAP1_VERTEX_3, 0, 1, 3, 0);
  add1("order -1", GL_INVALID_VALUE, GL_MAP1_VERTEX_3, 0, 1, 3, -1);
  add1("order MAX_EVAL_ORDER + 1", GL_INVALID_VALUE, GL_MAP1_VERTEX_3, 0, 1, 3, max_order + 1);
  add1("a stride below 3", GL_INVALID_VALUE, GL_MAP1_VERTEX_3, 0, 1, 2, 4);
  add1("a stride below 4 and one point", GL_INVALID_VALUE, GL_MAP1_VERTEX_4, 0, 1, 3, 1);
  add1("stride 0", GL_INVALID_VALUE, GL_MAP1_INDEX, 0, 1, 0, 4);
  add1("stride -4", GL_INVALID_VALUE, GL_MAP1_COLOR_4, 0, 1, -4, 4);
  add1("u1 equal to u2", GL_INVALID_VALUE, GL_MAP1_VERTEX_4, 2, 2, 4, 4);

  const auto add2 = [&](const std::string& what, GLenum error, GLenum target, double u2, GLint ustride,
                        GLint uorder, double v2, GLint vstride, GLint vorder) {
    all.push_back({fmt::format("Map2{} with {}", form, what), error, [=](gl::Case& c) {
                     const std::vector<double> points(2048, 0.5);
                     if (doubles)
                       c.Map2d(target, 0.0, u2, ustride, uorder, 0.0, v2, vstride, vorder, points);
                     else
                       c.Map2f(target, 0.0f, static_cast<float>(u2), ustride, uorder, 0.0f,
                               static_cast<float>(v2), vstride, vorder, converted<float>(points));
                   }});
  };
  add2("a target that is none", GL_INVALID_ENUM, GL_AUTO_NORMAL, 1, 8, 2, 1, 4, 2);
  add2("a target of Map1", GL_INVALID_ENUM, GL_MAP1_VERTEX_3, 1, 8, 2, 1, 4, 2);
  add2("uorder 0", GL_INVALID_VALUE, GL_MAP2_VERTEX_3, 1, 8, 0, 1, 4, 2);
  add2("vorder 0", GL_INVALID_VALUE, GL_MAP2_VERTEX_3, 1, 8, 2, 1, 4, 0);
  add2("uorder MAX_EVAL_ORDER + 1", GL_INVALID_VALUE, GL_MAP2_VERTEX_3, 1, 8, max_order + 1, 1, 4, 2);
  add2("vorder -2", GL_INVALID_VALUE, GL_MAP2_VERTEX_3, 1, 8, 2, 1, 4, -2);
  add2("a ustride below 3", GL_INVALID_VALUE, GL_MAP2_VERTEX_3, 1, 2, 2, 1, 6, 2);
  add2("a vstride below 3", GL_INVALID_VALUE, GL_MAP2_VERTEX_3, 1, 6, 2, 1, 2, 2);
  add2("a ustride below 4 and one point", GL_INVALID_VALUE, GL_MAP2_VERTEX_4, 1, 3, 1, 1, 4, 1);
  add2("ustride -8", GL_INVALID_VALUE, GL_MAP2_COLOR_4, 1, -8, 2, 1, 4, 2);
  add2("uorder -1", GL_INVALID_VALUE, GL_MAP2_VERTEX_3, 1, 8, -1, 1, 4, 2);
  add2("vorder MAX_EVAL_ORDER + 1", GL_INVALID_VALUE, GL_MAP2_VERTEX_3, 1, 8, 2, 1, 4, max_order + 1);
  add2("u1 equal to u2", GL_INVALID_VALUE, GL_MAP2_VERTEX_3, 0, 8, 2, 1, 4, 2);
  add2("v1 equal to v2", GL_INVALID_VALUE, GL_MAP2_VERTEX_3, 1, 8, 2, 0, 4, 2);
  return all;
}

std::vector<Bad> bad_grids_and_meshes() {
  std::vector<Bad> all;
  for (const GLint n : {0, -1}) {
    all.push_back({fmt::format("MapGrid1f of {} segments", n), GL_INVALID_VALUE,
                   [=](gl::Case& c) { c.MapGrid1f(n, 3.0f, 4.0f); }});
    all.push_back({fmt::format("MapGrid1d of {} segments", n), GL_INVALID_VALUE,
                   [=](gl::Case& c) { c.MapGrid1d(n, 3.0, 4.0); }});
    all.push_back({fmt::format("MapGrid2f of {} segments in u", n), GL_INVALID_VALUE,
                   [=](gl::Case& c) { c.MapGrid2f(n, 3.0f, 4.0f, 2, 5.0f, 6.0f); }});
    all.push_back({fmt::format("MapGrid2f of {} segments in v", n), GL_INVALID_VALUE,
                   [=](gl::Case& c) { c.MapGrid2f(2, 3.0f, 4.0f, n, 5.0f, 6.0f); }});
    all.push_back({fmt::format("MapGrid2d of {} segments in u", n), GL_INVALID_VALUE,
                   [=](gl::Case& c) { c.MapGrid2d(n, 3.0, 4.0, 2, 5.0, 6.0); }});
    all.push_back({fmt::format("MapGrid2d of {} segments in v", n), GL_INVALID_VALUE,
                   [=](gl::Case& c) { c.MapGrid2d(2, 3.0, 4.0, n, 5.0, 6.0); }});
  }
  for (const GLenum mode : {static_cast<GLenum>(GL_FILL), static_cast<GLenum>(GL_POINTS), 0u})
    all.push_back({fmt::format("EvalMesh1 with mode 0x{:x}", mode), GL_INVALID_ENUM,
                   [=](gl::Case& c) { c.EvalMesh1(mode, 0, 1); }});
  for (const GLenum mode : {static_cast<GLenum>(GL_TRIANGLES), static_cast<GLenum>(GL_QUAD_STRIP), 0x1B03u})
    all.push_back({fmt::format("EvalMesh2 with mode 0x{:x}", mode), GL_INVALID_ENUM,
                   [=](gl::Case& c) { c.EvalMesh2(mode, 0, 1, 0, 1); }});
  for (const Form& form : kForms)
    all.push_back({fmt::format("Map1{} between Begin and End", form.name), GL_INVALID_OPERATION,
                   [doubles = form.doubles](gl::Case& c) {
                     c.Begin(GL_POINTS);
                     define(c, make_map1(GL_MAP1_VERTEX_3, {1, 2, 3, 4, 5, 6}), doubles);
                     c.End();
                   }});
  return all;
}

enum class Kind { maps_f, maps_d, grids_and_meshes };
struct KindOfBad {
  const char* name;
  Kind kind;
};
constexpr KindOfBad kKindsOfBad[] = {
    {"MAPS_f", Kind::maps_f}, {"MAPS_d", Kind::maps_d}, {"GRIDS_AND_MESHES", Kind::grids_and_meshes}};

std::vector<Bad> bad_commands(const KindOfBad& of, int max_order) {
  if (of.kind == Kind::grids_and_meshes) return bad_grids_and_meshes();
  return bad_maps(of.kind == Kind::maps_d, of.kind == Kind::maps_d ? "d" : "f", max_order);
}

}  // namespace

// One list for each condition; each step is asked for its error.
EVALCTS_TESTS(DisplayLists, ErrorsOfTheCall, kKindsOfBad, const KindOfBad& kind, must, "EV-DL-ERR-LATE",
              "EV-DL-ERR-ALL") {
  for (const Bad& bad : bad_commands(kind, t.max_order())) {
    gl::Case c(bad.name);
    c.NewList(kList, GL_COMPILE);
    bad.issue(c);
    const gl::Ref compiled = c.GetError();
    c.EndList();
    const gl::Ref ended = c.GetError();
    const std::vector<gl::Ref> before = query_everything(c, t.max_order());
    c.CallList(kList);
    const gl::Ref called = c.GetError(), no_more = c.GetError();
    const std::vector<gl::Ref> after = query_everything(c, t.max_order());
    Played played = t.play(c);
    played.expect_no_error(compiled);
    played.expect_no_error(ended);
    played.expect_error(called, {bad.error});
    played.expect_no_error(no_more);
    expect_unchanged(played, before, after);
  }
}

EVALCTS_TESTS(DisplayLists, ErrorsWhileCompilingAndExecuting, kKindsOfBad, const KindOfBad& kind, must,
              "EV-DL-ERR-ALL", "EV-DL-COMPEXEC") {
  for (const Bad& bad : bad_commands(kind, t.max_order())) {
    gl::Case c(bad.name);
    c.NewList(kList, GL_COMPILE_AND_EXECUTE);
    bad.issue(c);
    const gl::Ref executed = c.GetError(), no_more = c.GetError();
    c.EndList();
    const gl::Ref ended = c.GetError();
    c.CallList(kList);
    const gl::Ref called = c.GetError();
    Played played = t.play(c);
    played.expect_error(executed, {bad.error});
    played.expect_no_error(no_more);
    played.expect_no_error(ended);
    played.expect_error(called, {bad.error});
  }
}

// A good command before and behind each bad one.
EVALCTS_TESTS(DisplayLists, ErrorDoesNotEndTheList, kKindsOfBad, const KindOfBad& kind, must,
              "EV-DL-ERR-CONTINUE") {
  for (const Bad& bad : bad_commands(kind, t.max_order())) {
    gl::Case c(bad.name + " between MapGrid1, Map1, Enable");
    const Map1 map = random_map(t, GL_MAP1_NORMAL, 4);
    compile(c, kList, [&](gl::Case& list) {
      list.MapGrid1f(6, 0.5f, 2.5f);
      bad.issue(list);
      define(list, map);
      list.Enable(GL_MAP1_NORMAL);
    });
    c.CallList(kList);
    const gl::Ref error = c.GetError();
    const gl::Ref segments = c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
    const MapQuery query = query_map(c, GL_MAP1_NORMAL, t.max_order());
    const gl::Ref enabled = c.IsEnabled(GL_MAP1_NORMAL);
    Played played = t.play(c);
    played.expect_error(error, {bad.error});
    played.expect_values(segments, std::vector<GLint>{6});
    expect_map(played, query, map);
    played.expect_result(enabled, GL_TRUE);
  }
}

// A list in which an error occurs may be called by others, which go on.
EVALCTS_TEST(DisplayLists, ErrorInAnInnerList, must, "EV-DL-ERR-CONTINUE") {
  const Bad bad[] = {
      {"MapGrid1f of no segments", GL_INVALID_VALUE, [](gl::Case& c) { c.MapGrid1f(0, 3.0f, 4.0f); }},
      {"EvalMesh1 with FILL", GL_INVALID_ENUM, [](gl::Case& c) { c.EvalMesh1(GL_FILL, 0, 1); }}};
  for (const Bad& of_inner : bad) {
    gl::Case c(of_inner.name + " in an inner list");
    const Map1 map = random_map(t, GL_MAP1_NORMAL, 4);
    compile(c, kOther, [&](gl::Case& list) {
      of_inner.issue(list);
      list.Enable(GL_AUTO_NORMAL);
    });
    compile(c, kList, [&](gl::Case& list) {
      list.CallList(kOther);
      define(list, map);
      list.Enable(GL_MAP1_NORMAL);
    });
    c.CallList(kList);
    const gl::Ref error = c.GetError();
    const gl::Ref inner = c.IsEnabled(GL_AUTO_NORMAL), outer = c.IsEnabled(GL_MAP1_NORMAL);
    const MapQuery query = query_map(c, GL_MAP1_NORMAL, t.max_order());
    Played played = t.play(c);
    played.expect_error(error, {of_inner.error});
    played.expect_result(inner, GL_TRUE);
    played.expect_result(outer, GL_TRUE);
    expect_map(played, query, map);
  }
}

// --- The state that counts -------------------------------------------------------------------------------

// Points, enables and what wins are those of the call.
EVALCTS_TESTS(DisplayLists, MapsOfTheCall, kDimensions, const Dimension& dimension, must,
              "EV-DL-EXECSTATE-MAP") {
  gl::Case c("compiled with some maps, called with others, with one of them off, and with none");
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two);
  compile(c, kList, [&](gl::Case& list) {
    evaluate_and_eval_points(list, dimension.two);
    mesh_of_points(list, dimension.two);
  });
  c.CallList(kList);
  define_vertices(t, c, dimension.two);
  c.Color4f(0.125f, 0.25f, 0.5f, 0.75f);
  c.CallList(kList);
  c.Disable(dimension.two ? GL_MAP2_COLOR_4 : GL_MAP1_COLOR_4);
  c.CallList(kList);
  c.Disable(dimension.two ? GL_MAP2_VERTEX_4 : GL_MAP1_VERTEX_4);
  c.CallList(kList);
  c.Disable(dimension.two ? GL_MAP2_VERTEX_3 : GL_MAP1_VERTEX_3);
  c.CallList(kList);
  t.expect_emission(c, kUnit0);
}

// Positions alone: the map that is drawn defined anew, then outranked by another, then off.
EVALCTS_TESTS(DisplayLists, VertexMapsOfTheCall, kDimensions, const Dimension& dimension, must,
              "EV-DL-EXECSTATE-MAP") {
  const GLenum three = dimension.two ? GL_MAP2_VERTEX_3 : GL_MAP1_VERTEX_3;
  const GLenum four = dimension.two ? GL_MAP2_VERTEX_4 : GL_MAP1_VERTEX_4;
  const auto define_anew = [&](gl::Case& c, GLenum target) {
    dimension.two ? define(c, random_map2(t, target, 2, 3)) : define(c, random_map(t, target, 3));
  };
  gl::Case c("compiled with a map of VERTEX_3, called after it was defined anew, with VERTEX_4, and without");
  define_anew(c, three);
  c.Enable(three);
  set_grid(c, dimension.two);
  compile(c, kList, [&](gl::Case& list) {
    evaluate_and_eval_points(list, dimension.two);
    mesh_of_points(list, dimension.two);
  });
  define_anew(c, three);
  c.CallList(kList);
  define_anew(c, four);
  c.Enable(four);
  c.CallList(kList);
  define_anew(c, four);
  c.CallList(kList);
  c.Disable(four);
  c.CallList(kList);
  c.Disable(three);
  c.CallList(kList);
  t.expect_emission(c, kPosition);
}

// Compiled while no map was enabled at all.
EVALCTS_TESTS(DisplayLists, MapsEnabledAfterwards, kDimensions, const Dimension& dimension, must,
              "EV-DL-EXECSTATE-MAP") {
  gl::Case c("compiled with no map enabled");
  compile(c, kList, [&](gl::Case& list) {
    evaluate_and_eval_points(list, dimension.two);
    mesh_of_points(list, dimension.two);
  });
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two);
  c.CallList(kList);
  t.expect_emission(c, kUnit0);
}

EVALCTS_TESTS(DisplayLists, GridOfTheCall, kDimensions, const Dimension& dimension, must,
              "EV-DL-EXECSTATE-GRID") {
  gl::Case c("compiled under one grid, called under two others");
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two, {7, 0.0f, 1.0f});
  compile(c, kList, [&](gl::Case& list) {
    evaluate_and_eval_points(list, dimension.two);
    mesh_of_points(list, dimension.two);
  });
  for (const Grid& grid : {Grid{4, 3.0f, -0.5f}, Grid{9, 0.75f, 1.5f}}) {
    set_grid(c, dimension.two, grid);
    c.CallList(kList);
  }
  t.expect_emission(c, kUnit0);
}

EVALCTS_TESTS(DisplayLists, ActiveTextureOfTheCall, kForms, const Form& form, must, "EV-DL-ACTIVETEX") {
  t.require(1, 3, "GL_ARB_multitexture");
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_TEXTURE_COORD_2, GL_MAP1_COLOR_4}) {
    const Map1 map = random_map(t, target, 3);
    gl::Case c(label(target) + ": compiled under TEXTURE1, called under TEXTURE0, then under TEXTURE1");
    c.ActiveTexture(GL_TEXTURE1);
    compile(c, kList, [&](gl::Case& list) { define(list, map, form.doubles); });
    c.ActiveTexture(GL_TEXTURE0);
    c.CallList(kList);
    const gl::Ref fine = c.GetError();
    const MapQuery query = query_map(c, target, t.max_order(), form.doubles);
    define(c, random_map(t, target, 2), form.doubles);
    const std::vector<gl::Ref> before = query_everything(c, t.max_order());
    c.ActiveTexture(GL_TEXTURE1);
    c.CallList(kList);
    const gl::Ref refused = c.GetError();
    c.ActiveTexture(GL_TEXTURE0);
    const std::vector<gl::Ref> after = query_everything(c, t.max_order());
    Played played = t.play(c);
    played.expect_no_error(fine);
    expect_map(played, query, map, form.doubles);
    played.expect_error(refused, {GL_INVALID_OPERATION});
    expect_unchanged(played, before, after);
  }
  for (const GLenum target : {GL_MAP2_VERTEX_4, GL_MAP2_NORMAL}) {
    const Map2 map = random_map2(t, target, 3, 2);
    gl::Case c(label(target) + ": compiled under TEXTURE0, called under TEXTURE1, then under TEXTURE0");
    compile(c, kList, [&](gl::Case& list) { define(list, map, form.doubles); });
    c.ActiveTexture(GL_TEXTURE1);
    c.CallList(kList);
    const gl::Ref refused = c.GetError();
    c.ActiveTexture(GL_TEXTURE0);
    c.CallList(kList);
    const gl::Ref fine = c.GetError();
    const MapQuery query = query_map(c, target, t.max_order(), form.doubles);
    Played played = t.play(c);
    played.expect_error(refused, {GL_INVALID_OPERATION});
    played.expect_no_error(fine);
    expect_map(played, query, map, form.doubles);
  }
}

// ActiveTexture itself may be in the list.
EVALCTS_TEST(DisplayLists, ActiveTextureInTheList, must, "EV-DL-ACTIVETEX") {
  t.require(1, 3, "GL_ARB_multitexture");
  const Map1 good = random_map(t, GL_MAP1_VERTEX_3, 3);
  gl::Case c("Map1 after ActiveTexture(TEXTURE1), and after ActiveTexture(TEXTURE0)");
  compile(c, kList, [&](gl::Case& list) {
    list.ActiveTexture(GL_TEXTURE1);
    define(list, random_map(t, GL_MAP1_NORMAL, 3));
    list.ActiveTexture(GL_TEXTURE0);
    define(list, good);
  });
  c.CallList(kList);
  const gl::Ref error = c.GetError(), no_more = c.GetError();
  const gl::Ref order = c.GetMapiv(GL_MAP1_NORMAL, GL_ORDER, gl::out<GLint>(1));
  const MapQuery query = query_map(c, GL_MAP1_VERTEX_3, t.max_order());
  Played played = t.play(c);
  played.expect_error(error, {GL_INVALID_OPERATION});
  played.expect_no_error(no_more);
  played.expect_values(order, std::vector<GLint>{1});
  expect_map(played, query, good);
}

// GetMap and GetnMap write when they are issued, never when the list is called.
EVALCTS_TESTS(DisplayLists, QueriesAreNotCompiled, kForms, const Form& form, must, "EV-DL-GETMAP") {
  gl::Case c("GetMap and IsEnabled between compiled commands");
  const Map1 old = random_map(t, GL_MAP1_COLOR_4, 2), changed = random_map(t, GL_MAP1_COLOR_4, 3);
  define(c, old, form.doubles);
  c.NewList(kList, GL_COMPILE);
  define(c, changed, form.doubles);
  c.Enable(GL_MAP1_COLOR_4);
  const MapQuery inside = query_map(c, GL_MAP1_COLOR_4, t.max_order(), form.doubles);
  const gl::Ref off = c.IsEnabled(GL_MAP1_COLOR_4);
  c.EndList();
  c.CallList(kList);
  const MapQuery called = query_map(c, GL_MAP1_COLOR_4, t.max_order(), form.doubles);
  const gl::Ref on = c.IsEnabled(GL_MAP1_COLOR_4);
  Played played = t.play(c);
  expect_map(played, inside, old, form.doubles);
  played.expect_result(off, GL_FALSE);
  expect_map(played, called, changed, form.doubles);
  played.expect_result(on, GL_TRUE);
}

EVALCTS_TEST(DisplayLists, GetnMapIsNotCompiled, must, "EV-DL-GETMAP") {
  t.require(4, 5, "GL_ARB_robustness");
  gl::Case c("GetnMapfv between compiled commands");
  const Map1 old = make_map1(GL_MAP1_INDEX, {1, 2}), changed = make_map1(GL_MAP1_INDEX, {3, 4, 5});
  define(c, old);
  c.NewList(kList, GL_COMPILE);
  define(c, changed);
  const gl::Ref inside = c.GetnMapfv(GL_MAP1_INDEX, GL_COEFF, 64, gl::out<GLfloat>(16));
  c.EndList();
  c.CallList(kList);
  const gl::Ref called = c.GetnMapfv(GL_MAP1_INDEX, GL_COEFF, 64, gl::out<GLfloat>(16));
  Played played = t.play(c);
  played.expect_values(inside, std::vector<GLfloat>{1, 2});
  played.expect_values(called, std::vector<GLfloat>{3, 4, 5});
}

namespace {

struct Mode {
  const char* name;
  GLenum mode;
};
constexpr Mode kModes[] = {{"COMPILE", GL_COMPILE}, {"COMPILE_AND_EXECUTE", GL_COMPILE_AND_EXECUTE}};

// Each query that there is, in each of its forms.
std::vector<gl::Ref> ask_in_every_form(gl::Case& c, bool getn) {
  std::vector<gl::Ref> answers;
  constexpr std::size_t kRoom = 64;
  constexpr GLsizei kBytes = kRoom * sizeof(GLint);
  for (const GLenum target : {GL_MAP1_COLOR_4, GL_MAP2_NORMAL})
    for (const GLenum query : {GL_ORDER, GL_DOMAIN, GL_COEFF}) {
      for (const Getter& form : kGetters) answers.push_back(form.get(c, target, query, kRoom));
      if (!getn) continue;
      answers.push_back(c.GetnMapfv(target, query, kBytes, gl::out<GLfloat>(kRoom)));
      answers.push_back(c.GetnMapdv(target, query, 2 * kBytes, gl::out<GLdouble>(kRoom)));
      answers.push_back(c.GetnMapiv(target, query, kBytes, gl::out<GLint>(kRoom)));
    }
  for (const GLenum state :
       {GL_MAP1_COLOR_4, GL_MAP2_NORMAL, GL_AUTO_NORMAL, GL_MAX_EVAL_ORDER, GL_MAP1_GRID_DOMAIN,
        GL_MAP1_GRID_SEGMENTS, GL_MAP2_GRID_DOMAIN, GL_MAP2_GRID_SEGMENTS}) {
    answers.push_back(c.GetBooleanv(state, gl::out<GLboolean>(4)));
    answers.push_back(c.GetIntegerv(state, gl::out<GLint>(4)));
    answers.push_back(c.GetFloatv(state, gl::out<GLfloat>(4)));
    answers.push_back(c.GetDoublev(state, gl::out<GLdouble>(4)));
  }
  for (const GLenum cap : {GL_MAP1_COLOR_4, GL_MAP2_NORMAL, GL_AUTO_NORMAL})
    answers.push_back(c.IsEnabled(cap));
  return answers;
}

}  // namespace

// What is asked while the list is open is answered as outside of it: before it, or after it where its
// commands are executed.
EVALCTS_TESTS(DisplayLists, EveryQueryInAnOpenList, kModes, const Mode& mode, must, "EV-DL-GETMAP") {
  const bool getn = t.gl().at_least(4, 5) || t.gl().extensions.contains("GL_ARB_robustness");
  const auto set = [&](gl::Case& c, int order, bool on) {
    define(c, random_map(t, GL_MAP1_COLOR_4, order));
    Map2 net = random_map2(t, GL_MAP2_NORMAL, order, 2);
    net.u2 = order, net.v1 = -order;
    define(c, net);
    c.MapGrid1f(order, 0.5f * static_cast<float>(order), -2);
    c.MapGrid2f(order, 3, static_cast<float>(order), order + 1, 7, -static_cast<float>(order));
    for (const GLenum cap : {GL_MAP1_COLOR_4, GL_MAP2_NORMAL, GL_AUTO_NORMAL})
      on ? c.Enable(cap) : c.Disable(cap);
  };
  gl::Case c("asked before the list, in it and after it");
  set(c, 2, false);
  const std::vector<gl::Ref> before = ask_in_every_form(c, getn);
  c.NewList(kList, mode.mode);
  set(c, 4, true);
  const std::vector<gl::Ref> inside = ask_in_every_form(c, getn);
  c.EndList();
  const std::vector<gl::Ref> after = ask_in_every_form(c, getn);
  const gl::Ref error = c.GetError();
  Played played = t.play(c);
  expect_unchanged(played, mode.mode == GL_COMPILE ? before : after, inside);
  expect_unchanged(played, inside, after);
  played.expect_no_error(error);
}

// --- Begin and End ---------------------------------------------------------------------------------------

EVALCTS_TESTS(DisplayLists, CalledBetweenBeginAndEnd, kDimensions, const Dimension& dimension, must,
              "EV-DL-INBEGIN") {
  gl::Case c("points of a list among those of the primitive");
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two);
  const auto points = [&](gl::Case& list, float u, GLint i) {
    if (dimension.two) {
      list.EvalCoord2f(u, 1.25f);
      list.EvalPoint2(i, 2);
    } else {
      list.EvalCoord1f(u);
      list.EvalPoint1(i);
    }
  };
  compile(c, kList, [&](gl::Case& list) { points(list, 0.625f, 3); });
  for (const GLenum mode : {GL_POINTS, GL_LINE_STRIP}) {
    gl::Case drawn(fmt::format("{}, mode {}", c.identity(), mode));
    drawn.append(c);
    drawn.Begin(mode);
    points(drawn, 0.125f, 1);
    drawn.CallList(kList);
    points(drawn, 1.75f, 4);
    drawn.CallList(kList);
    drawn.End();
    t.expect_emission(drawn, kUnit0);
  }
}

// The list is called between two points; a further command of it is legal there.
EVALCTS_TESTS(DisplayLists, ForbiddenBetweenBeginAndEnd, forbidden_in_primitives(), const NamedCalls& command,
              must, "EV-DL-INBEGIN") {
  gl::Case c("called between Begin and End");
  for (const bool two : {false, true}) enable_maps(t, c, two);
  compile(c, kList, [&](gl::Case& list) {
    command.issue(list);
    list.EvalCoord1f(0.75f);
  });
  const std::vector<gl::Ref> before = query_everything(c, t.max_order());
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.25f);
  c.CallList(kList);
  c.EvalCoord1f(0.5f);
  c.End();
  const gl::Ref error = c.GetError(), no_more = c.GetError();
  const std::vector<gl::Ref> after = query_everything(c, t.max_order());
  Played played = t.play(c);
  played.expect_error(error, {GL_INVALID_OPERATION});
  played.expect_no_error(no_more);
  expect_unchanged(played, before, after);
  t.expect_emission(c, kUnit0);
}

EVALCTS_TESTS(DisplayLists, BeginAndEndFromDifferentLists, kDimensions, const Dimension& dimension, must,
              "EV-DL-SPLIT") {
  const auto point = [&](gl::Case& c, float u) {
    if (dimension.two)
      c.EvalCoord2f(u, 1.75f);
    else
      c.EvalCoord1f(u);
  };
  for (const GLenum mode : {GL_POINTS, GL_LINE_STRIP}) {
    gl::Case c(fmt::format("mode {}: Begin, points and End in lists and not", mode));
    enable_maps(t, c, dimension.two);
    compile(c, kList, [&](gl::Case& list) {
      list.Begin(mode);
      point(list, 0.125f);
    });
    compile(c, kOther, [&](gl::Case& list) {
      point(list, 0.5f);
      point(list, 0.625f);
    });
    compile(c, kThird, [&](gl::Case& list) {
      point(list, 0.875f);
      list.End();
    });
    c.CallList(kList);
    c.CallList(kOther);
    c.CallList(kThird);
    c.CallList(kList);
    point(c, 0.375f);
    c.CallList(kThird);
    c.Begin(mode);
    c.CallList(kOther);
    c.End();
    t.expect_emission(c, kUnit0);
  }
}

// --- Lists and lists -------------------------------------------------------------------------------------

EVALCTS_TESTS(DisplayLists, CalledTwiceSameBits, kDimensions, const Dimension& dimension, must,
              "EV-DL-REPEAT") {
  gl::Case c("one list, called twice, with another evaluation between");
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two);
  compile(c, kList, [&](gl::Case& list) {
    evaluate_and_eval_points(list, dimension.two);
    mesh_of_points(list, dimension.two);
  });
  c.CallList(kList);
  evaluate_and_eval_points(c, dimension.two);
  c.CallList(kList);
  const std::size_t between = 6, once = 6 + (dimension.two ? 6 : 4), all = 2 * once + between;
  t.expect_observation(c, kUnit0, all, kPoints, [&](const Observation& seen) {
    std::vector<ObservedVertex> vertices;
    for (const ObservedPrimitive& primitive : seen.primitives)
      vertices.insert(vertices.end(), primitive.vertices.begin(), primitive.vertices.end());
    std::vector<Mismatch> mismatches;
    if (vertices.size() != all) {
      Mismatch& mismatch = mismatches.emplace_back();
      mismatch.what = "vertices";
      mismatch.expected = std::to_string(all);
      mismatch.captured = std::to_string(vertices.size());
      mismatch.message = fmt::format("{} vertices come out, expected {}", vertices.size(), all);
      mismatch.of = Mismatch::Of::vertices;
      return mismatches;
    }
    for (std::size_t i = 0; i < once; ++i) {
      const ObservedVertex &first = vertices[i], &second = vertices[once + between + i];
      if (first.position == second.position && first.color == second.color && first.normal == second.normal &&
          first.texture_coordinate[0] == second.texture_coordinate[0])
        continue;
      Mismatch& mismatch = mismatches.emplace_back();
      mismatch.what = fmt::format("vertex {} of the second call", i);
      mismatch.expected = fmt::format("{}", first.position[0]);
      mismatch.captured = fmt::format("{}", second.position[0]);
      mismatch.message = fmt::format("vertex {} of the second call has other bits than that of the first", i);
    }
    return mismatches;
  });
}

// The definitions of the inner list apply from its call on.
EVALCTS_TESTS(DisplayLists, MapsOfAnInnerList, kDimensions, const Dimension& dimension, must,
              "EV-DL-NESTED") {
  gl::Case c("a list that evaluates calls one that defines and enables, between evaluations");
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two);
  compile(c, kOther, [&](gl::Case& list) {
    define_vertices(t, list, dimension.two);
    list.Disable(dimension.two ? GL_MAP2_VERTEX_4 : GL_MAP1_VERTEX_4);
    list.Enable(dimension.two ? GL_MAP2_VERTEX_3 : GL_MAP1_VERTEX_3);
    set_grid(list, dimension.two, {3, 0.25f, 0.75f});
  });
  compile(c, kList, [&](gl::Case& list) {
    evaluate_and_eval_points(list, dimension.two);
    list.CallList(kOther);
    evaluate_and_eval_points(list, dimension.two);
    mesh_of_points(list, dimension.two);
  });
  c.CallList(kList);
  t.expect_emission(c, kUnit0);
}

// The inner list is looked up at the call: defined later, and defined anew.
EVALCTS_TEST(DisplayLists, InnerListOfTheCall, must, "EV-DL-NESTED") {
  gl::Case c("an inner list that is defined after the outer one, and once more");
  c.Enable(GL_MAP1_VERTEX_3);
  compile(c, kList, [&](gl::Case& list) {
    list.CallList(kOther);
    evaluate_and_eval_points(list, false);
  });
  for (int round = 0; round < 2; ++round) {
    compile(c, kOther, [&](gl::Case& list) { define(list, random_map(t, GL_MAP1_VERTEX_3, 3 + round)); });
    c.CallList(kList);
  }
  t.expect_emission(c, kPosition);
}

EVALCTS_TESTS(DisplayLists, NestedDeeply, kDimensions, const Dimension& dimension, must, "EV-DL-NESTED") {
  constexpr GLuint kDepth = 60;  // MAX_LIST_NESTING is at least 64
  gl::Case c("an evaluation sixty lists deep");
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two);
  compile(c, 100, [&](gl::Case& list) { evaluate_and_eval_points(list, dimension.two); });
  for (GLuint depth = 1; depth < kDepth; ++depth)
    compile(c, 100 + depth, [&](gl::Case& list) { list.CallList(100 + depth - 1); });
  c.CallList(100 + kDepth - 1);
  t.expect_emission(c, kUnit0);
}

// --- Current values --------------------------------------------------------------------------------------

// Texture maps of fewer components than the last TexCoord, and vertices that take the current values.
EVALCTS_TESTS(DisplayLists, CurrentValuesUntouched, kDimensions, const Dimension& dimension, must,
              "EV-DL-CURRENT") {
  for (const int components : {1, 2, 3, 4}) {
    gl::Case c(fmt::format("TexCoord4, a map of {} components, Vertex, in one list", components));
    const auto offset = static_cast<GLenum>(components - 1);
    const auto enable_textures = [&](gl::Case& list) {
      if (dimension.two) {
        define(list, random_map2(t, GL_MAP2_VERTEX_3, 2, 2));
        define(list, random_map2(t, GL_MAP2_TEXTURE_COORD_1 + offset, 2, 3));
        define(list, random_map2(t, GL_MAP2_COLOR_4, 2, 2));
        for (const GLenum target : {static_cast<GLenum>(GL_MAP2_VERTEX_3), GL_MAP2_TEXTURE_COORD_1 + offset,
                                    static_cast<GLenum>(GL_MAP2_COLOR_4)})
          list.Enable(target);
      } else {
        define(list, random_map(t, GL_MAP1_VERTEX_3, 2));
        define(list, random_map(t, GL_MAP1_TEXTURE_COORD_1 + offset, 3));
        define(list, random_map(t, GL_MAP1_COLOR_4, 2));
        for (const GLenum target : {static_cast<GLenum>(GL_MAP1_VERTEX_3), GL_MAP1_TEXTURE_COORD_1 + offset,
                                    static_cast<GLenum>(GL_MAP1_COLOR_4)})
          list.Enable(target);
      }
    };
    compile(c, kList, [&](gl::Case& list) {
      enable_textures(list);
      list.TexCoord4f(5, 6, 7, 8);
      list.Color4f(0.125f, 0.25f, 0.5f, 0.75f);
      list.Begin(GL_POINTS);
      for (const float u : {0.25f, 0.5f}) {
        if (dimension.two)
          list.EvalCoord2f(u, u);
        else
          list.EvalCoord1f(u);
        list.Vertex3f(u, 1, 2);
      }
      list.Normal3f(0.6f, 0.8f, 0);
      list.Vertex3f(3, 1, 2);
      list.End();
    });
    gl::Case queried = c;
    queried.CallList(kList);
    const gl::Ref texture = queried.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4));
    const gl::Ref color = queried.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4));
    Played played = t.play(queried);
    played.expect_values(texture, std::vector<GLfloat>{5, 6, 7, 8});
    played.expect_values_near(color, std::vector<GLfloat>{0.125f, 0.25f, 0.5f, 0.75f}, 1e-5);

    c.CallList(kList);
    t.expect_emission(c, kUnit0);
  }
}

// Whatever evaluates: a mesh, or points between Begin and End.
EVALCTS_TESTS(DisplayLists, CurrentValuesAfterTheCall, kDimensions, const Dimension& dimension, must,
              "EV-DL-CURRENT") {
  for (const bool mesh : {true, false}) {
    gl::Case c(mesh ? "a mesh" : "a primitive");
    enable_maps(t, c, dimension.two);
    set_grid(c, dimension.two);
    compile(c, kList, [&](gl::Case& list) {
      list.Color4f(0.125f, 0.25f, 0.5f, 0.75f);
      list.Normal3f(0.6f, 0.8f, 0);
      list.TexCoord4f(5, 6, 7, 8);
      mesh ? mesh_of_points(list, dimension.two) : evaluate_and_eval_points(list, dimension.two);
    });
    c.CallList(kList);
    const gl::Ref color = c.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4));
    const gl::Ref normal = c.GetFloatv(GL_CURRENT_NORMAL, gl::out<GLfloat>(3));
    const gl::Ref texture = c.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4));
    Played played = t.play(c);
    played.expect_values_near(color, std::vector<GLfloat>{0.125f, 0.25f, 0.5f, 0.75f}, 1e-5);
    played.expect_values_near(normal, std::vector<GLfloat>{0.6f, 0.8f, 0}, 1e-5);
    played.expect_values(texture, std::vector<GLfloat>{5, 6, 7, 8});
  }
}

}  // namespace evalcts::suite_display_lists
