// Section 20 of the requirements: rules of evaluator commands in display lists. That a list has the effects
// of its commands is tested by the other suites, whose cases go through lists as well (gl/display_lists.h).
#include <fmt/format.h>

#include <evalcts/testkit/registration.h>

#include "display_lists.h"

namespace evalcts::suite_display_lists {
void compile(gl::Case& c, GLuint list, const Calls& calls, GLenum mode) {
  c.NewList(list, mode);
  calls(c);
  c.EndList();
}

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
    all.push_back({fmt::format("MapGrid1{}", form),
                   [=](gl::Case& c) { doubles ? c.MapGrid1d(5, 2.0, 0.25) : c.MapGrid1f(5, 2.0, 0.25); }});
    all.push_back({fmt::format("MapGrid2{}", form), [=](gl::Case& c) {
                     doubles ? c.MapGrid2d(5, 2.0, 0.25, 7, -1.0, 3.0)
                             : c.MapGrid2f(5, 2.0, 0.25, 7, -1.0, 3.0);
                   }});
  }
  all.push_back({"Enable", [](gl::Case& c) {
                   for (const GLenum cap : all_caps()) c.Enable(cap);
                 }});
  all.push_back({"Disable", [](gl::Case& c) {
                   for (const GLenum cap : all_caps()) c.Disable(cap);
                 }});
  return all;
}

void prepare_for(gl::Case& c, const Setting& setting) {
  if (setting.name != "Disable") return;
  for (const GLenum cap : all_caps()) c.Enable(cap);
}

void evaluate_and_eval_points(gl::Case& c, bool two) {
  c.Begin(GL_POINTS);
  for (const double u : {0.0, 0.375, 1.0}) eval_coord(c, two, u, 1.5);
  for (const GLint i : {0, 2, 5}) eval_point(c, two, i, 1);
  c.End();
}

void mesh_of_points(gl::Case& c, bool two) { eval_mesh(c, two, GL_POINT, 1, two ? 3 : 4, 0, 1); }

void compile_points(gl::Case& c, GLuint list, bool two, GLenum mode) {
  c.NewList(list, mode);
  evaluate_and_eval_points(c, two);
  mesh_of_points(c, two);
  c.EndList();
}

void set_grid(gl::Case& c, bool two, const Grid& u) { map_grid(c, two, u, {3, 1.25f, 2.0f}); }

gl::Case with_maps(Test& t, const std::string& identity, bool two, const Grid& u) {
  gl::Case c(identity);
  enable_maps(t, c, two);
  set_grid(c, two, u);
  return c;
}

void define_vertices(Test& t, gl::Case& c, bool two) {
  define(c, random_map(t, target_in(two, GL_MAP1_VERTEX_3), two ? Orders{2, 3} : Orders{3}));
}

namespace {

// --- Compiling -------------------------------------------------------------------------------------------

EVALCTS_TEST(DisplayLists, CompilingExecutesNothing, kMust, "EV-DL-COMPILED", "EV-DL-GETMAP",
             combine(settings()))
(Test& t, const Setting& setting) {
  gl::Case c("queried before the list, in it and after it");
  prepare_for(c, setting);
  take_snapshot(t, c);
  c.NewList(kList, GL_COMPILE);
  setting.issue(c);
  take_snapshot(t, c);
  c.EndList();
  take_snapshot(t, c);
  c.GetError();
  t.judge(c);
};

EVALCTS_TEST(DisplayLists, CompilingDrawsNothing, kMust, "EV-DL-COMPILED", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  gl::Case c = with_maps(t, "EvalCoord, EvalPoint and EvalMesh compiled, then a point", dimension.two);
  compile_points(c, kList, dimension.two);
  c.Begin(GL_POINTS);
  c.Vertex3f(0.25f, 0.5f, 0.75f);
  c.End();
  t.judge_vertices(c, kUnit0);
};

// --- Calling ---------------------------------------------------------------------------------------------

// Expects `set` to be the state after a setting: at least one answer is another one than `before`, and the
// later queries answer the same. The answers are only compared, because other tests judge whether they are
// right. Throws NotObservable if the queries that may show it were left out.
using Queries = std::vector<gl::Ref>;
void expect_lasting(Test& t, const gl::Case& c, const Queries& before, const Queries& set,
                    const std::vector<Queries>& later) {
  CheckedTrace checked = t.play(c);
  for (const Queries& queries : later) expect_unchanged(checked, set, queries);
  bool changed = false, left_out = false;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool is_asked = before[i].index >= 0 && set[i].index >= 0;
    left_out = left_out || !is_asked;
    changed = changed || (is_asked && !checked.trace().same(before[i], checked.trace(), set[i]));
  }
  if (!changed && left_out) throw NotObservable("the queries that may show it crash or are rejected");
  checked.expect(changed, set.front(), "the setting in the list has no effect: all queries answer as before",
                 "other answers", "the same answers");
}

// Calling the list changes the state, and issuing the commands themselves afterwards changes nothing more.
EVALCTS_TEST(DisplayLists, CallHasLastingEffect, kMust, "EV-DL-EXECUTE", combine(settings()))
(Test& t, const Setting& setting) {
  gl::Case c("queried before the call, after it, and after the commands themselves");
  prepare_for(c, setting);
  compile(c, kList, setting.issue);
  const Queries before = query_everything(t, c);
  c.CallList(kList);
  const Queries called = query_everything(t, c);
  setting.issue(c);
  const Queries issued = query_everything(t, c);
  expect_lasting(t, c, before, called, {issued});
};

// Lists keep negative indices and indices that need more than 16 bits.
EVALCTS_TEST(DisplayLists, IndicesKept, kMust, "EV-DL-EXECUTE", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  const bool two = dimension.two;
  gl::Case c("points outside the grid, and far in a fine one");
  define_and_enable(c, random_map(t, target_in(two, GL_MAP1_VERTEX_3), {3, 2}));
  const auto points = [&](gl::Case& list, std::initializer_list<GLint> indices) {
    list.Begin(GL_POINTS);
    for (const GLint i : indices) eval_point(list, two, i, 1 - i);
    list.End();
  };
  compile(c, kList, [&](gl::Case& list) {
    map_grid(list, two, {4, 0, 1}, {4, 1, 0});
    points(list, {-2, 6});
    eval_mesh(list, two, GL_POINT, -2, two ? -1 : 5, 3, 5);
    if (two) list.EvalMesh2(GL_POINT, 4, 5, -1, 0);
    map_grid(list, two, {100000, 0, 1}, {100000, 1, 0});
    points(list, {300, 40000, 70000, -40000});
    eval_mesh(list, two, GL_POINT, 70000, two ? 70000 : 70001, 40000, 40001);
  });
  c.CallList(kList);
  t.judge_vertices(c, kPosition);
};

EVALCTS_TEST(DisplayLists, CompileAndExecuteDrawsOnce, kMust, "EV-DL-COMPEXEC", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  gl::Case c = with_maps(t, "compiled and executed, a point, then called", dimension.two);
  compile_points(c, kList, dimension.two, GL_COMPILE_AND_EXECUTE);
  c.Begin(GL_POINTS);
  c.Vertex3f(0.25f, 0.5f, 0.75f);
  c.End();
  c.CallList(kList);
  t.judge_vertices(c, kUnit0);
};

EVALCTS_TEST(DisplayLists, CompileAndExecuteSets, kMust, "EV-DL-COMPEXEC", "EV-DL-GETMAP",
             combine(settings()))
(Test& t, const Setting& setting) {
  gl::Case c("queried in the list, after it, and after the commands themselves");
  prepare_for(c, setting);
  const Queries before = query_everything(t, c);
  c.NewList(kList, GL_COMPILE_AND_EXECUTE);
  setting.issue(c);
  const Queries inside = query_everything(t, c);
  c.EndList();
  const Queries ended = query_everything(t, c);
  setting.issue(c);
  const Queries issued = query_everything(t, c);
  expect_lasting(t, c, before, inside, {ended, issued});
};

// --- Memory ----------------------------------------------------------------------------------------------

// Compiles the definition of the map, calls the list, and asks for the map. `after`: what happens to the
// points after the definition.
void define_by_list(Test& t, gl::Case& c, const Map& map, bool doubles,
                    gl::AfterCall after = gl::AfterCall::kKeep) {
  compile(c, kList, [&](gl::Case& list) { define(list, map, doubles, after); });
  c.CallList(kList);
  query_map(t, c, map.target, doubles);
}

EVALCTS_TEST(DisplayLists, PointsReadWhileCompiling, kMust, "EV-DL-POINTS-COPIED", combine(kTreatments))
(Test& t, const Treatment& treatment) {
  for (const bool two : {false, true})
    for (const TargetForm& form : existing_target_forms(t, two)) {
      gl::Case c(form.name);
      const Map map =
          two ? random_map(t, form.target, {3, 4}, kLayouts[3]) : random_map(t, form.target, 5, 6);
      define_by_list(t, c, map, form.doubles, treatment.after);
      t.judge(c);
    }
};

// Two lists are compiled from the same memory, with different contents.
EVALCTS_TEST(DisplayLists, SamePointerNewPoints, kMust, "EV-DL-POINTS-COPIED", combine(kForms))
(Test& t, const Form& form) {
  for (const GLenum target : {GL_MAP1_VERTEX_3, GL_MAP1_COLOR_4, GL_MAP1_TEXTURE_COORD_1}) {
    gl::Case c(label(target));
    for (const GLuint list : {kList, kOther})
      compile(c, list,
              [&](gl::Case& to) { define_in_slot(to, random_map(t, target, 4, 5), form.doubles, 0); });
    for (const GLuint list : {kList, kOther}) {
      c.CallList(list);
      query_map(t, c, target, form.doubles);
    }
    t.judge(c);
  }
};

EVALCTS_TEST(DisplayLists, StrideKept1, kMust, "EV-DL-STRIDE-KEPT", combine(target_forms(kCurves)))
(Test& t, const TargetForm& form) {
  const int k = gl::components_of(form.target);
  gl::Case c("strides k to 257, orders 1 to MAX");
  for (const int stride : {k, k + 1, 2 * k, 17, 257})
    for (const int order : {1, 2, 5, t.max_order()})
      define_by_list(t, c, random_map(t, form.target, order, stride), form.doubles);
  t.judge(c);
};

EVALCTS_TEST(DisplayLists, StrideKept2, kMust, "EV-DL-STRIDE-KEPT", combine(target_forms(kSurfaces)))
(Test& t, const TargetForm& form) {
  gl::Case c("every layout");
  for (const Layout& layout : kLayouts)
    define_by_list(t, c, random_map(t, form.target, {3, 5}, layout), form.doubles);
  t.judge(c);
};

// The commands in doubles are judged over domains whose ends are not representable in single precision.
EVALCTS_TEST(DisplayLists, DoubleForms, kMust, "EV-DL-DOUBLE", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  for (const auto& [u1, u2] : {std::pair{0.1, 0.7}, {1.0 / 3, -2.0}}) {
    gl::Case c(fmt::format("all commands with doubles, over [{}, {}]", u1, u2));
    compile(c, kList, [&, u1 = u1, u2 = u2, two = dimension.two](gl::Case& list) {
      const Map map = random_map(t, target_in(two, GL_MAP1_VERTEX_4), two ? Orders{3, 4} : Orders{5});
      define_and_enable(list, over(map, {u1, u2}, {u2, u1}), true);
      two ? list.MapGrid2d(3, u1, u2, 5, u2, u1) : list.MapGrid1d(3, u1, u2);
      list.Begin(GL_POINTS);
      for (const double x : {u1, 0.5 * (u1 + u2), u2}) {
        eval_coord(list, two, x, u1, true);
        eval_coord_vector(list, two, two ? u2 : x, x, true);
      }
      for (const GLint i : {0, 1, 3}) eval_point(list, two, i, 5 - i);
      list.End();
    });
    c.CallList(kList);
    t.judge_vertices(c, kPosition);
  }
};

// --- Begin and End ---------------------------------------------------------------------------------------

EVALCTS_TEST(DisplayLists, CalledBetweenBeginAndEnd, kMust, "EV-DL-INBEGIN", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  gl::Case c = with_maps(t, "points of a list among those of the primitive", dimension.two);
  const auto points = [&](gl::Case& list, float u, GLint i) {
    eval_coord(list, dimension.two, u, 1.25);
    eval_point(list, dimension.two, i, 2);
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
    t.judge_vertices(drawn, kUnit0);
  }
};

// A list whose first command is an error between Begin and End and whose second one is legal is called there:
// the second one still draws its point.
EVALCTS_TEST(DisplayLists, ForbiddenBetweenBeginAndEnd, kMust, "EV-DL-INBEGIN",
             combine(forbidden_in_primitives()))
(Test& t, const NamedCalls& command) {
  gl::Case c("called between Begin and End");
  for (const bool two : {false, true}) enable_maps(t, c, two);
  compile(c, kList, [&](gl::Case& list) {
    command.issue(list);
    list.EvalCoord1f(0.75f);
  });
  take_snapshot(t, c);
  c.Begin(GL_POINTS);
  c.EvalCoord1f(0.25f);
  c.CallList(kList);
  c.EvalCoord1f(0.5f);
  c.End();
  c.GetError();
  c.GetError();
  take_snapshot(t, c);
  t.judge(c);
};

EVALCTS_TEST(DisplayLists, BeginAndEndFromDifferentLists, kMust, "EV-DL-SPLIT", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  const auto point = [&](gl::Case& c, double u) { eval_coord(c, dimension.two, u, 1.75); };
  for (const GLenum mode : {GL_POINTS, GL_LINE_STRIP}) {
    gl::Case c(fmt::format("mode {}: Begin, points and End in lists and not", mode));
    enable_maps(t, c, dimension.two);
    compile(c, kList, [&](gl::Case& list) {
      list.Begin(mode);
      point(list, 0.125);
    });
    compile(c, kOther, [&](gl::Case& list) {
      point(list, 0.5);
      point(list, 0.625);
    });
    compile(c, kThird, [&](gl::Case& list) {
      point(list, 0.875);
      list.End();
    });
    c.CallList(kList);
    c.CallList(kOther);
    c.CallList(kThird);
    c.CallList(kList);
    point(c, 0.375);
    c.CallList(kThird);
    c.Begin(mode);
    c.CallList(kOther);
    c.End();
    t.judge_vertices(c, kUnit0);
  }
};

// --- Lists and lists -------------------------------------------------------------------------------------

EVALCTS_TEST(DisplayLists, CalledTwiceSameBits, kMust, "EV-DL-REPEAT", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  gl::Case c = with_maps(t, "one list, called twice, with another evaluation between", dimension.two);
  compile_points(c, kList, dimension.two);
  c.CallList(kList);
  evaluate_and_eval_points(c, dimension.two);
  c.CallList(kList);
  const std::size_t between = 6, once = 6 + (dimension.two ? 6 : 4), all = 2 * once + between;
  const Attributes shown = t.shown_exactly(kUnit0);
  t.expect_observation(c, shown, all, kPoints, [&](const Observation& seen) {
    const std::vector<ObservedVertex> vertices = vertices_of(seen);
    std::vector<Mismatch> mismatches;
    if (vertices.size() != all) {
      Mismatch& mismatch = mismatches.emplace_back();
      mismatch.what = "vertices";
      mismatch.expected = std::to_string(all);
      mismatch.captured = std::to_string(vertices.size());
      mismatch.message = fmt::format("{} vertices are drawn, expected {}", vertices.size(), all);
      mismatch.kind = Mismatch::Kind::kVertices;
      return mismatches;
    }
    for (std::size_t i = 0; i < once; ++i) {
      const ObservedVertex &first = vertices[i], &second = vertices[once + between + i];
      if (same_vertex(first, second, shown)) continue;
      Mismatch& mismatch = mismatches.emplace_back();
      mismatch.what = fmt::format("vertex {} of the second call", i);
      mismatch.expected = fmt::format("{}", first.position[0]);
      mismatch.captured = fmt::format("{}", second.position[0]);
      mismatch.message = fmt::format("vertex {} of the second call has other bits than that of the first", i);
    }
    return mismatches;
  });
};

// The state that an inner list sets is used by the commands after its call in the outer list.
EVALCTS_TEST(DisplayLists, MapsOfAnInnerList, kMust, "EV-DL-NESTED", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  gl::Case c = with_maps(t, "a list that evaluates calls one that defines and enables, between evaluations",
                         dimension.two);
  compile(c, kOther, [&](gl::Case& list) {
    define_vertices(t, list, dimension.two);
    list.Disable(target_in(dimension.two, GL_MAP1_VERTEX_4));
    list.Enable(target_in(dimension.two, GL_MAP1_VERTEX_3));
    set_grid(list, dimension.two, {3, 0.25f, 0.75f});
  });
  compile(c, kList, [&](gl::Case& list) {
    evaluate_and_eval_points(list, dimension.two);
    list.CallList(kOther);
    evaluate_and_eval_points(list, dimension.two);
    mesh_of_points(list, dimension.two);
  });
  c.CallList(kList);
  t.judge_vertices(c, kUnit0);
};

// The outer list calls whatever inner list is defined at the time of its own call.
EVALCTS_TEST(DisplayLists, InnerListOfTheCall, kMust, "EV-DL-NESTED")
(Test& t) {
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
  t.judge_vertices(c, kPosition);
};

EVALCTS_TEST(DisplayLists, NestedDeeply, kMust, "EV-DL-NESTED", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  constexpr GLuint kDepth = 60;  // MAX_LIST_NESTING is at least 64
  gl::Case c = with_maps(t, "an evaluation sixty lists deep", dimension.two);
  compile(c, 100, [&](gl::Case& list) { evaluate_and_eval_points(list, dimension.two); });
  for (GLuint depth = 1; depth < kDepth; ++depth)
    compile(c, 100 + depth, [&](gl::Case& list) { list.CallList(100 + depth - 1); });
  c.CallList(100 + kDepth - 1);
  t.judge_vertices(c, kUnit0);
};

// --- Current values --------------------------------------------------------------------------------------

// Texture maps with one to four components after TexCoord4, and explicit vertices, which have the current
// values.
EVALCTS_TEST(DisplayLists, CurrentValuesUntouched, kMust, "EV-DL-CURRENT", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  for (const int components : {1, 2, 3, 4}) {
    gl::Case c(fmt::format("TexCoord4, a map of {} components, Vertex, in one list", components));
    const auto offset = static_cast<GLenum>(components - 1);
    const auto enable_textures = [&](gl::Case& list) {
      const GLenum targets[] = {target_in(dimension.two, GL_MAP1_VERTEX_3),
                                target_in(dimension.two, GL_MAP1_TEXTURE_COORD_1) + offset,
                                target_in(dimension.two, GL_MAP1_COLOR_4)};
      define(list, random_map(t, targets[0], {2, 2}));
      define(list, random_map(t, targets[1], dimension.two ? Orders{2, 3} : Orders{3}));
      define(list, random_map(t, targets[2], {2, 2}));
      for (const GLenum target : targets) list.Enable(target);
    };
    compile(c, kList, [&](gl::Case& list) {
      enable_textures(list);
      list.TexCoord4f(5, 6, 7, 8);
      list.Color4f(0.125f, 0.25f, 0.5f, 0.75f);
      list.Begin(GL_POINTS);
      for (const double u : {0.25, 0.5}) {
        eval_coord(list, dimension.two, u, u);
        list.Vertex3f(u, 1, 2);
      }
      list.Normal3f(0.6f, 0.8f, 0);
      list.Vertex3f(3, 1, 2);
      list.End();
    });
    gl::Case queried = c;
    queried.CallList(kList);
    queried.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4));
    queried.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4));
    t.judge_answers(queried);

    c.CallList(kList);
    t.judge_vertices(c, kUnit0);
  }
};

// Meshes and points between Begin and End do not change the current values that the list set before them.
EVALCTS_TEST(DisplayLists, CurrentValuesAfterTheCall, kMust, "EV-DL-CURRENT", combine(kDimensions))
(Test& t, const Dimension& dimension) {
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
    c.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4));
    c.GetFloatv(GL_CURRENT_NORMAL, gl::out<GLfloat>(3));
    c.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4));
    t.judge_answers(c);
  }
};

}  // namespace
}  // namespace evalcts::suite_display_lists
