// Section 20 of the requirements: commands in a display list raise their errors when the list is called.
#include <fmt/format.h>

#include <optional>

#include <evalcts/testkit/registration.h>
#include "display_lists.h"

namespace evalcts::suite_display_lists {

namespace {

// Returns definitions of maps that have to be rejected. No stride is negative, because a library that copies
// the points before it checks the arguments would read memory before the array, with an unpredictable
// outcome. `limit`: MAX_EVAL_ORDER, if it is known.
std::vector<NamedCalls> bad_maps(bool doubles, const char* form, std::optional<int> limit) {
  std::vector<NamedCalls> all;
  const auto add = [&](const std::string& what, const Map& map) {
    all.push_back({fmt::format("Map{}{} with {}", map.two ? 2 : 1, form, what), defining(map, doubles)});
  };
  const auto add1 = [&](const std::string& what, GLenum target, double u1, double u2, GLint stride,
                        GLint order) {
    const std::vector<double> points(512, 0.5);
    add(what, {target, u1, u2, 0, 1, stride, stride, order, 1, points, kCurves});
  };
  add1("an invalid target", GL_TEXTURE_2D, 0, 1, 4, 4);
  add1("a target of Map2", GL_MAP2_VERTEX_3, 0, 1, 4, 4);
  add1("order 0", GL_MAP1_VERTEX_3, 0, 1, 3, 0);
  add1("order -1", GL_MAP1_VERTEX_3, 0, 1, 3, -1);
  if (limit) add1("order MAX_EVAL_ORDER + 1", GL_MAP1_VERTEX_3, 0, 1, 3, *limit + 1);
  add1("a stride below 3", GL_MAP1_VERTEX_3, 0, 1, 2, 4);
  add1("a stride below 4 and one point", GL_MAP1_VERTEX_4, 0, 1, 3, 1);
  add1("stride 0", GL_MAP1_INDEX, 0, 1, 0, 4);
  add1("u1 equal to u2", GL_MAP1_VERTEX_4, 2, 2, 4, 4);

  const auto add2 = [&](const std::string& what, GLenum target, double u2, GLint ustride, GLint uorder,
                        double v2, GLint vstride, GLint vorder) {
    const std::vector<double> points(2048, 0.5);
    add(what, {target, 0, u2, 0, v2, ustride, vstride, uorder, vorder, points, kSurfaces});
  };
  add2("an invalid target", GL_AUTO_NORMAL, 1, 8, 2, 1, 4, 2);
  add2("a target of Map1", GL_MAP1_VERTEX_3, 1, 8, 2, 1, 4, 2);
  add2("uorder 0", GL_MAP2_VERTEX_3, 1, 8, 0, 1, 4, 2);
  add2("vorder 0", GL_MAP2_VERTEX_3, 1, 8, 2, 1, 4, 0);
  if (limit) add2("uorder MAX_EVAL_ORDER + 1", GL_MAP2_VERTEX_3, 1, 8, *limit + 1, 1, 4, 2);
  add2("vorder -2", GL_MAP2_VERTEX_3, 1, 8, 2, 1, 4, -2);
  add2("a ustride below 3", GL_MAP2_VERTEX_3, 1, 2, 2, 1, 6, 2);
  add2("a vstride below 3", GL_MAP2_VERTEX_3, 1, 6, 2, 1, 2, 2);
  add2("a ustride below 4 and one point", GL_MAP2_VERTEX_4, 1, 3, 1, 1, 4, 1);
  add2("uorder -1", GL_MAP2_VERTEX_3, 1, 8, -1, 1, 4, 2);
  if (limit) add2("vorder MAX_EVAL_ORDER + 1", GL_MAP2_VERTEX_3, 1, 8, 2, 1, 4, *limit + 1);
  add2("u1 equal to u2", GL_MAP2_VERTEX_3, 0, 8, 2, 1, 4, 2);
  add2("v1 equal to v2", GL_MAP2_VERTEX_3, 1, 8, 2, 0, 4, 2);
  return all;
}

std::vector<NamedCalls> bad_grids_and_meshes() {
  std::vector<NamedCalls> all;
  for (const GLint n : {0, -1}) {
    all.push_back(
        {fmt::format("MapGrid1f of {} segments", n), [=](gl::Case& c) { c.MapGrid1f(n, 3.0f, 4.0f); }});
    all.push_back(
        {fmt::format("MapGrid1d of {} segments", n), [=](gl::Case& c) { c.MapGrid1d(n, 3.0, 4.0); }});
    all.push_back({fmt::format("MapGrid2f of {} segments in u", n),
                   [=](gl::Case& c) { c.MapGrid2f(n, 3.0f, 4.0f, 2, 5.0f, 6.0f); }});
    all.push_back({fmt::format("MapGrid2f of {} segments in v", n),
                   [=](gl::Case& c) { c.MapGrid2f(2, 3.0f, 4.0f, n, 5.0f, 6.0f); }});
    all.push_back({fmt::format("MapGrid2d of {} segments in u", n),
                   [=](gl::Case& c) { c.MapGrid2d(n, 3.0, 4.0, 2, 5.0, 6.0); }});
    all.push_back({fmt::format("MapGrid2d of {} segments in v", n),
                   [=](gl::Case& c) { c.MapGrid2d(2, 3.0, 4.0, n, 5.0, 6.0); }});
  }
  for (const GLenum mode : {static_cast<GLenum>(GL_FILL), static_cast<GLenum>(GL_POINTS), 0u})
    all.push_back(
        {fmt::format("EvalMesh1 with mode 0x{:x}", mode), [=](gl::Case& c) { c.EvalMesh1(mode, 0, 1); }});
  for (const GLenum mode : {static_cast<GLenum>(GL_TRIANGLES), static_cast<GLenum>(GL_QUAD_STRIP), 0x1B03u})
    all.push_back({fmt::format("EvalMesh2 with mode 0x{:x}", mode),
                   [=](gl::Case& c) { c.EvalMesh2(mode, 0, 1, 0, 1); }});
  for (const Form& form : kForms)
    all.push_back(
        {fmt::format("Map1{} between Begin and End", form.name), [doubles = form.doubles](gl::Case& c) {
           c.Begin(GL_POINTS);
           define(c, make_map1(GL_MAP1_VERTEX_3, {1, 2, 3, 4, 5, 6}), doubles);
           c.End();
         }});
  return all;
}

enum class Kind { kMapsF, kMapsD, kGridsAndMeshes };
constexpr NamedValue<Kind> kKindsOfBad[] = {
    {"MAPS_f", Kind::kMapsF}, {"MAPS_d", Kind::kMapsD}, {"GRIDS_AND_MESHES", Kind::kGridsAndMeshes}};

std::optional<int> known_order_limit(const Test& t) {
  constexpr int kLargest = 64;  // the arrays of bad_maps() have room for order 65
  try {
    return t.order_limit() <= kLargest ? std::optional(t.order_limit()) : std::nullopt;
  } catch (const NotObservable&) {
    return {};
  }
}

std::vector<NamedCalls> bad_commands(const NamedValue<Kind>& of, Test& t) {
  return existing_calls(t, of.value == Kind::kGridsAndMeshes
                               ? bad_grids_and_meshes()
                               : bad_maps(of.value == Kind::kMapsD, of.value == Kind::kMapsD ? "d" : "f",
                                          known_order_limit(t)));
}

// There is a list for each condition, and a GetError after each step.
EVALCTS_TEST(DisplayLists, ErrorsOfTheCall, kMust, "EV-DL-ERR-LATE", "EV-DL-ERR-ALL", combine(kKindsOfBad))
(Test& t, const NamedValue<Kind>& kind) {
  for (const NamedCalls& bad : bad_commands(kind, t)) {
    gl::Case c(bad.name);
    c.NewList(kList, GL_COMPILE);
    bad.issue(c);
    c.GetError();
    c.EndList();
    c.GetError();
    take_snapshot(t, c);
    c.CallList(kList);
    c.GetError();
    c.GetError();
    take_snapshot(t, c);
    t.judge(c);
  }
};

EVALCTS_TEST(DisplayLists, ErrorsWhileCompilingAndExecuting, kMust, "EV-DL-ERR-ALL", "EV-DL-COMPEXEC",
             combine(kKindsOfBad))
(Test& t, const NamedValue<Kind>& kind) {
  for (const NamedCalls& bad : bad_commands(kind, t)) {
    gl::Case c(bad.name);
    c.NewList(kList, GL_COMPILE_AND_EXECUTE);
    bad.issue(c);
    c.GetError();
    c.GetError();
    c.EndList();
    c.GetError();
    c.CallList(kList);
    c.GetError();
    t.judge(c);
  }
};

// The commands before and after a rejected one in the list take effect.
EVALCTS_TEST(DisplayLists, ErrorDoesNotEndTheList, kMust, "EV-DL-ERR-CONTINUE", "EV-DL-ERR-ALL",
             combine(kKindsOfBad))
(Test& t, const NamedValue<Kind>& kind) {
  for (const NamedCalls& bad : bad_commands(kind, t)) {
    gl::Case c(bad.name + " between MapGrid1, Map1, Enable");
    const Map map = random_map(t, GL_MAP1_NORMAL, 4);
    compile(c, kList, [&](gl::Case& list) {
      list.MapGrid1f(6, 0.5f, 2.5f);
      bad.issue(list);
      define_and_enable(list, map);
    });
    c.CallList(kList);
    c.GetError();
    if (t.can_query_grid(GL_MAP1_GRID_SEGMENTS)) c.GetIntegerv(GL_MAP1_GRID_SEGMENTS, gl::out<GLint>(1));
    query_map(t, c, GL_MAP1_NORMAL);
    c.IsEnabled(GL_MAP1_NORMAL);
    t.judge(c);
  }
};

// An error in an inner list ends neither this list nor the outer one.
EVALCTS_TEST(DisplayLists, ErrorInAnInnerList, kMust, "EV-DL-ERR-CONTINUE", "EV-DL-ERR-ALL")
(Test& t) {
  for (const NamedCalls& bad :
       {NamedCalls{"MapGrid1f of no segments", [](gl::Case& c) { c.MapGrid1f(0, 3.0f, 4.0f); }},
        NamedCalls{"EvalMesh1 with FILL", [](gl::Case& c) { c.EvalMesh1(GL_FILL, 0, 1); }}}) {
    gl::Case c(bad.name + " in an inner list");
    compile(c, kOther, [&](gl::Case& list) {
      bad.issue(list);
      list.Enable(GL_AUTO_NORMAL);
    });
    compile(c, kList, [&](gl::Case& list) {
      list.CallList(kOther);
      define_and_enable(list, random_map(t, GL_MAP1_NORMAL, 4));
    });
    c.CallList(kList);
    c.GetError();
    for (const GLenum cap : {GL_AUTO_NORMAL, GL_MAP1_NORMAL}) c.IsEnabled(cap);
    query_map(t, c, GL_MAP1_NORMAL);
    t.judge(c);
  }
};

}  // namespace
}  // namespace evalcts::suite_display_lists
