// Section 20 of the requirements: what is special about evaluator commands in display lists. That a list does
// what its commands do is shown by the other suites, whose cases go through lists as well
// (gl/display_lists.h).
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

void prepare_for(gl::Case& c, const Setting& setting) {
  if (setting.name != "Disable") return;
  for (const GLenum target : gl::kMap1Targets) c.Enable(target);
  for (const GLenum target : gl::kMap2Targets) c.Enable(target);
  c.Enable(GL_AUTO_NORMAL);
}

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

void set_grid(gl::Case& c, bool two, const Grid& u) {
  if (two)
    map_grid(c, u, {3, 1.25f, 2.0f});
  else
    map_grid(c, u);
}

void define_vertices(Test& t, gl::Case& c, bool two) {
  if (two)
    define(c, random_map2(t, GL_MAP2_VERTEX_3, 2, 3));
  else
    define(c, random_map(t, GL_MAP1_VERTEX_3, 3));
}

// --- Compiling -------------------------------------------------------------------------------------------

EVALCTS_TEST(DisplayLists, CompilingExecutesNothing, must, "EV-DL-COMPILED", "EV-DL-GETMAP",
             combine(settings()))
(Test& t, const Setting& setting) {
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
};

EVALCTS_TEST(DisplayLists, CompilingDrawsNothing, must, "EV-DL-COMPILED", combine(kDimensions))
(Test& t, const Dimension& dimension) {
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
};

// --- Calling ---------------------------------------------------------------------------------------------

// The command itself, issued once more, changes nothing then.
EVALCTS_TEST(DisplayLists, CallHasLastingEffect, must, "EV-DL-EXECUTE", combine(settings()))
(Test& t, const Setting& setting) {
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
};

// Indices are signed and of 32 bits in lists, too.
EVALCTS_TEST(DisplayLists, IndicesKept, must, "EV-DL-EXECUTE", combine(kDimensions))
(Test& t, const Dimension& dimension) {
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
};

EVALCTS_TEST(DisplayLists, CompileAndExecuteDrawsOnce, must, "EV-DL-COMPEXEC", combine(kDimensions))
(Test& t, const Dimension& dimension) {
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
};

EVALCTS_TEST(DisplayLists, CompileAndExecuteSets, must, "EV-DL-COMPEXEC", "EV-DL-GETMAP", combine(settings()))
(Test& t, const Setting& setting) {
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
};

// --- Memory ----------------------------------------------------------------------------------------------

EVALCTS_TEST(DisplayLists, PointsReadWhileCompiling, must, "EV-DL-POINTS-COPIED", combine(kFates))
(Test& t, const Fate& fate) {
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
};

// Two lists from the same memory with other contents.
EVALCTS_TEST(DisplayLists, SamePointerNewPoints, must, "EV-DL-POINTS-COPIED", combine(kForms))
(Test& t, const Form& form) {
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
};

EVALCTS_TEST(DisplayLists, StrideKept1, must, "EV-DL-STRIDE-KEPT", combine(target_forms()))
(Test& t, const TargetForm& form) {
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
};

EVALCTS_TEST(DisplayLists, StrideKept2, must, "EV-DL-STRIDE-KEPT", combine(target_forms2()))
(Test& t, const TargetForm& form) {
  for (const Layout& layout : kLayouts) {
    gl::Case c(layout.name);
    const Map2 map = random_map2(t, form.target, 3, 5, layout);
    compile(c, kList, [&](gl::Case& list) { define(list, map, form.doubles); });
    c.CallList(kList);
    const MapQuery query = query_map(c, form.target, t.max_order(), form.doubles);
    Played played = t.play(c);
    expect_map(played, query, map, form.doubles);
  }
};

// Over domains where single precision would tell another argument.
EVALCTS_TEST(DisplayLists, DoubleForms, must, "EV-DL-DOUBLE", combine(kDimensions))
(Test& t, const Dimension& dimension) {
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
};

// --- Begin and End ---------------------------------------------------------------------------------------

EVALCTS_TEST(DisplayLists, CalledBetweenBeginAndEnd, must, "EV-DL-INBEGIN", combine(kDimensions))
(Test& t, const Dimension& dimension) {
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
};

// The list is called between two points; a further command of it is legal there.
EVALCTS_TEST(DisplayLists, ForbiddenBetweenBeginAndEnd, must, "EV-DL-INBEGIN",
             combine(forbidden_in_primitives()))
(Test& t, const NamedCalls& command) {
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
};

EVALCTS_TEST(DisplayLists, BeginAndEndFromDifferentLists, must, "EV-DL-SPLIT", combine(kDimensions))
(Test& t, const Dimension& dimension) {
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
};

// --- Lists and lists -------------------------------------------------------------------------------------

EVALCTS_TEST(DisplayLists, CalledTwiceSameBits, must, "EV-DL-REPEAT", combine(kDimensions))
(Test& t, const Dimension& dimension) {
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
};

// The definitions of the inner list apply from its call on.
EVALCTS_TEST(DisplayLists, MapsOfAnInnerList, must, "EV-DL-NESTED", combine(kDimensions))
(Test& t, const Dimension& dimension) {
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
};

// The inner list is looked up at the call: defined later, and defined anew.
EVALCTS_TEST(DisplayLists, InnerListOfTheCall, must, "EV-DL-NESTED")
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
  t.expect_emission(c, kPosition);
};

EVALCTS_TEST(DisplayLists, NestedDeeply, must, "EV-DL-NESTED", combine(kDimensions))
(Test& t, const Dimension& dimension) {
  constexpr GLuint kDepth = 60;  // MAX_LIST_NESTING is at least 64
  gl::Case c("an evaluation sixty lists deep");
  enable_maps(t, c, dimension.two);
  set_grid(c, dimension.two);
  compile(c, 100, [&](gl::Case& list) { evaluate_and_eval_points(list, dimension.two); });
  for (GLuint depth = 1; depth < kDepth; ++depth)
    compile(c, 100 + depth, [&](gl::Case& list) { list.CallList(100 + depth - 1); });
  c.CallList(100 + kDepth - 1);
  t.expect_emission(c, kUnit0);
};

// --- Current values --------------------------------------------------------------------------------------

// Texture maps of fewer components than the last TexCoord, and vertices that take the current values.
EVALCTS_TEST(DisplayLists, CurrentValuesUntouched, must, "EV-DL-CURRENT", combine(kDimensions))
(Test& t, const Dimension& dimension) {
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
};

// Whatever evaluates: a mesh, or points between Begin and End.
EVALCTS_TEST(DisplayLists, CurrentValuesAfterTheCall, must, "EV-DL-CURRENT", combine(kDimensions))
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
    const gl::Ref color = c.GetFloatv(GL_CURRENT_COLOR, gl::out<GLfloat>(4));
    const gl::Ref normal = c.GetFloatv(GL_CURRENT_NORMAL, gl::out<GLfloat>(3));
    const gl::Ref texture = c.GetFloatv(GL_CURRENT_TEXTURE_COORDS, gl::out<GLfloat>(4));
    Played played = t.play(c);
    played.expect_values_near(color, std::vector<GLfloat>{0.125f, 0.25f, 0.5f, 0.75f}, 1e-5);
    played.expect_values_near(normal, std::vector<GLfloat>{0.6f, 0.8f, 0}, 1e-5);
    played.expect_values(texture, std::vector<GLfloat>{5, 6, 7, 8});
  }
};

}  // namespace evalcts::suite_display_lists
