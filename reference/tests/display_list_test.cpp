// Tests display lists (GL 2.1 section 5.4): every command in a list, names, nesting and errors. The golden
// vectors (vectors/state.json) hold what lists do with maps and grids.
#include <gtest/gtest.h>
#include <reference/specification.h>

#include <vector>

#include "context.h"
#include "lists.h"

namespace evalcts::reference {
namespace {

// Returns a context with two enabled maps, a line and a constant surface, and a short list of the name 7.
Specification evaluating() {
  Specification gl;
  define_line(gl, GL_MAP1_VERTEX_3, 1);
  gl.Enable(GL_MAP1_VERTEX_3);
  gl.Enable(GL_MAP2_VERTEX_3);
  compile(gl, 7, [](Specification& c) { c.Indexf(77); });
  return gl;
}

// Returns all queryable state, and the primitives drawn since the last call, as numbers that can be compared.
std::vector<std::vector<GLdouble>> seen(Specification& gl) {
  std::vector<std::vector<GLdouble>> all = queryable_state(gl);
  for (const GLenum pname : {GL_LIST_BASE, GL_LIST_INDEX, GL_LIST_MODE, GL_ATTRIB_STACK_DEPTH}) {
    all.push_back(get(gl, pname));
  }
  for (const Primitive& primitive : gl.take_primitives()) {
    all.push_back({double(primitive.mode)});
    for (const Vertex& vertex : primitive.vertices) {
      std::vector<GLdouble> values{double(vertex.edge_flag), rounded(vertex.index)};
      const auto add = [&](const auto& part) { values.insert(values.end(), part.begin(), part.end()); };
      add(rounded(vertex.position));
      add(rounded(vertex.color));
      add(rounded(vertex.normal));
      for (std::size_t unit = 0; unit < kTextureUnits; ++unit) add(rounded(vertex.texture_coordinate[unit]));
      all.push_back(values);
    }
  }
  return all;
}

// The commands that lists can contain, in at least one form each.
struct Compiled {
  const char* name;
  Commands issue;
  bool inside;  // issued between Begin and End, before a vertex
};
const GLfloat kFloats[] = {1.5f, 2.5f, 3.5f, 4.5f, 5.5f, 6.5f, 7.5f, 8.5f, 9.5f, 10.5f, 11.5f, 12.5f};
const GLdouble kDoubles[] = {1.25, 2.25, 3.25, 4.25, 5.25, 6.25, 7.25, 8.25, 9.25, 10.25, 11.25, 12.25};
const GLboolean kFlag = GL_FALSE;
const GLubyte kOffsets[] = {7, 0};
const Compiled kCompiled[] = {
    {"Map1f", [](Specification& c) { c.Map1f(GL_MAP1_NORMAL, 1, 2, 4, 3, kFloats); }, false},
    {"Map1d", [](Specification& c) { c.Map1d(GL_MAP1_NORMAL, 1, 2, 4, 3, kDoubles); }, false},
    {"Map2f", [](Specification& c) { c.Map2f(GL_MAP2_INDEX, 1, 2, 4, 2, 3, 4, 2, 2, kFloats); }, false},
    {"Map2d", [](Specification& c) { c.Map2d(GL_MAP2_INDEX, 1, 2, 4, 2, 3, 4, 2, 2, kDoubles); }, false},
    {"MapGrid1f", [](Specification& c) { c.MapGrid1f(3, 4, 5); }, false},
    {"MapGrid1d", [](Specification& c) { c.MapGrid1d(3, 0.1, 5); }, false},
    {"MapGrid2f", [](Specification& c) { c.MapGrid2f(3, 4, 5, 6, 7, 8); }, false},
    {"MapGrid2d", [](Specification& c) { c.MapGrid2d(3, 0.1, 5, 6, 7, 8); }, false},
    {"EvalCoord1f", [](Specification& c) { c.EvalCoord1f(0.5f); }, true},
    {"EvalCoord1d", [](Specification& c) { c.EvalCoord1d(0.1); }, true},
    {"EvalCoord1fv", [](Specification& c) { c.EvalCoord1fv(kFloats); }, true},
    {"EvalCoord1dv", [](Specification& c) { c.EvalCoord1dv(kDoubles); }, true},
    {"EvalCoord2f", [](Specification& c) { c.EvalCoord2f(0.5f, 0.25f); }, true},
    {"EvalCoord2d", [](Specification& c) { c.EvalCoord2d(0.1, 0.2); }, true},
    {"EvalCoord2fv", [](Specification& c) { c.EvalCoord2fv(kFloats); }, true},
    {"EvalCoord2dv", [](Specification& c) { c.EvalCoord2dv(kDoubles); }, true},
    {"EvalPoint1", [](Specification& c) { c.EvalPoint1(1); }, true},
    {"EvalPoint2", [](Specification& c) { c.EvalPoint2(1, 0); }, true},
    {"EvalMesh1", [](Specification& c) { c.EvalMesh1(GL_LINE, 0, 3); }, false},
    {"EvalMesh2", [](Specification& c) { c.EvalMesh2(GL_FILL, 0, 1, 0, 1); }, false},
    {"Enable", [](Specification& c) { c.Enable(GL_AUTO_NORMAL); }, false},
    {"Disable", [](Specification& c) { c.Disable(GL_MAP1_VERTEX_3); }, false},
    {"Begin and End", [](Specification& c) { (c.Begin(GL_LINES), c.End()); }, false},
    {"Vertex3f", [](Specification& c) { c.Vertex3f(1, 2, 3); }, true},
    {"Vertex4dv", [](Specification& c) { c.Vertex4dv(kDoubles); }, true},
    {"Color4f", [](Specification& c) { c.Color4f(0.1f, 0.2f, 0.3f, 0.4f); }, true},
    {"Color3fv", [](Specification& c) { c.Color3fv(kFloats); }, true},
    {"Normal3d", [](Specification& c) { c.Normal3d(1, 2, 3); }, true},
    {"TexCoord4f", [](Specification& c) { c.TexCoord4f(1, 2, 3, 4); }, true},
    {"MultiTexCoord2fv", [](Specification& c) { c.MultiTexCoord2fv(GL_TEXTURE0, kFloats); }, true},
    {"Indexf", [](Specification& c) { c.Indexf(5); }, true},
    {"EdgeFlag", [](Specification& c) { c.EdgeFlag(GL_FALSE); }, true},
    {"EdgeFlagv", [](Specification& c) { c.EdgeFlagv(&kFlag); }, true},
    {"ActiveTexture", [](Specification& c) { c.ActiveTexture(GL_TEXTURE3); }, false},
    {"PushAttrib", [](Specification& c) { c.PushAttrib(GL_EVAL_BIT); }, false},
    {"PopAttrib", [](Specification& c) { (c.PushAttrib(0), c.PushAttrib(0), c.PopAttrib()); }, false},
    {"CallList", [](Specification& c) { c.CallList(7); }, true},
    {"CallLists", [](Specification& c) { c.CallLists(2, GL_UNSIGNED_BYTE, kOffsets); }, true},
    {"ListBase", [](Specification& c) { c.ListBase(5); }, false}};

void issue(Specification& gl, const Compiled& command, const Commands& how) {
  if (command.inside) gl.Begin(GL_POINTS);
  how(gl);
  if (command.inside) (gl.Vertex2f(0, 0), gl.End());  // the vertex shows current values
}

TEST(DisplayLists, HoldCommandsUntilTheyAreCalled) {  // EV-DL-COMPILED, EV-DL-EXECUTE, EV-DL-REPEAT
  for (const Compiled& command : kCompiled) {
    SCOPED_TRACE(command.name);
    Specification immediate = evaluating(), gl = evaluating();
    const auto before = seen(gl);
    compile(gl, 1, command.issue);
    EXPECT_EQ(gl.permitted_errors(), std::vector<GLenum>{});
    EXPECT_EQ(seen(gl), before);
    for (int i = 0; i < 2; ++i) {
      issue(immediate, command, command.issue);
      issue(gl, command, [](Specification& c) { c.CallList(1); });
      const auto expected = seen(immediate);
      EXPECT_NE(expected, before);  // so the command does something
      EXPECT_EQ(seen(gl), expected);
    }
    expect_error(gl, GL_NO_ERROR);
  }
}

TEST(DisplayLists, AreExecutedOnceWhileTheyAreCompiled) {  // EV-DL-COMPEXEC
  for (const Compiled& command : kCompiled) {
    SCOPED_TRACE(command.name);
    Specification immediate = evaluating(), gl = evaluating();
    const auto commands = [&](Specification& c) { issue(c, command, command.issue); };
    commands(immediate);
    compile(gl, 1, commands, GL_COMPILE_AND_EXECUTE);
    EXPECT_EQ(seen(gl), seen(immediate));
    commands(immediate);
    gl.CallList(1);
    EXPECT_EQ(seen(gl), seen(immediate));
    expect_error(gl, GL_NO_ERROR);
  }
}

TEST(DisplayLists, CopyOtherArrays) {  // EV-DL-POINTS-COPIED
  Specification gl = evaluating();
  compile(gl, 1, [](Specification& c) {
    auto color = heap<GLdouble>({0.5, 0.25, 0.125, 0.75});
    c.Color4dv(color.get());
    color.reset();
    auto argument = heap<GLfloat>({0.5f});
    c.EvalCoord1fv(argument.get());
    argument.reset();
    auto lists = heap<GLushort>({7});
    c.CallLists(1, GL_UNSIGNED_SHORT, lists.get());
    lists.reset();
  });
  gl.Begin(GL_POINTS);
  gl.CallList(1);
  gl.End();
  EXPECT_EQ(drawn_x(gl), std::vector<float>{6});
  EXPECT_EQ(get(gl, GL_CURRENT_COLOR), (std::vector<GLdouble>{0.5, 0.25, 0.125, 0.75}));
  EXPECT_EQ(current_index(gl), 77);
}

TEST(DisplayLists, ReportTheFirstOfTheirErrorsAndPermitAll) {
  Specification gl;
  compile(gl, 1, [](Specification& c) { c.Indexf(1); });
  compile(gl, 2, [](Specification& c) {
    c.CallList(1);
    c.MapGrid1f(0, 0, 1);             // INVALID_VALUE
    c.Map1f(0, 1, 1, 0, 0, nullptr);  // INVALID_ENUM or INVALID_VALUE
    c.CallList(1);
  });
  compile(gl, 3, [](Specification& c) { c.Enable(0); });  // INVALID_ENUM
  const GLubyte lists[] = {1, 2, 3};
  gl.CallLists(3, GL_UNSIGNED_BYTE, lists);
  EXPECT_EQ(gl.permitted_errors(), (std::vector<GLenum>{GL_INVALID_VALUE, GL_INVALID_ENUM}));
  EXPECT_EQ(gl.raised_errors(), 3u);
  expect_error(gl, GL_INVALID_VALUE);
  gl.CallList(1);
  EXPECT_EQ(gl.permitted_errors(), std::vector<GLenum>{});
  compile(gl, 4, [](Specification& c) { c.Map1f(0, 1, 1, 0, 0, nullptr); });
  gl.CallList(4);
  EXPECT_EQ(gl.permitted_errors(), (std::vector<GLenum>{GL_INVALID_ENUM, GL_INVALID_VALUE}));
  EXPECT_EQ(gl.raised_errors(), 1u);
}

TEST(DisplayLists, DoNotHoldWhatTheGlExecutesAtOnce) {  // EV-DL-GETMAP
  Specification gl;
  gl.NewList(1, GL_COMPILE);
  define_line(gl, GL_MAP1_INDEX, 5);
  gl.Enable(GL_MAP1_INDEX);
  EXPECT_EQ(get_map(gl, GL_MAP1_INDEX, GL_ORDER), std::vector<GLdouble>{1});
  GLint order = 0;
  gl.GetnMapiv(GL_MAP1_INDEX, GL_ORDER, 4, &order);
  EXPECT_EQ(order, 1);
  EXPECT_EQ(gl.IsEnabled(GL_MAP1_INDEX), GL_FALSE);
  EXPECT_NE(gl.GetString(GL_VERSION), nullptr);
  gl.Flush();
  gl.Finish();
  gl.GetIntegerv(0, &order);
  expect_error(gl, GL_INVALID_ENUM);
  const GLuint names = gl.GenLists(2);
  EXPECT_EQ(names, 2u);  // 1 is the name of the open list
  EXPECT_EQ(gl.IsList(names), GL_TRUE);
  gl.DeleteLists(names, 1);
  EXPECT_EQ(gl.IsList(names), GL_FALSE);
  gl.EndList();
  gl.Begin(GL_POINTS);  // the commands above would be errors here
  gl.CallList(1);
  gl.End();
  expect_error(gl, GL_INVALID_OPERATION);  // from Map1f and Enable
  gl.DeleteLists(3, 1);
  gl.CallList(1);
  expect_error(gl, GL_NO_ERROR);
  EXPECT_EQ(gl.IsList(names), GL_FALSE);
}

TEST(DisplayLists, OpenAndCloseOutsideBeginAndEnd) {
  Specification gl;
  gl.Begin(GL_POINTS);
  gl.NewList(1, GL_COMPILE);
  EXPECT_EQ(gl.permitted_errors(), std::vector<GLenum>{GL_INVALID_OPERATION});
  gl.Vertex2f(1, 0);  // executed
  gl.End();
  expect_error(gl, GL_INVALID_OPERATION);
  EXPECT_EQ(drawn_x(gl), std::vector<float>{1});

  gl.NewList(1, GL_COMPILE_AND_EXECUTE);
  gl.Begin(GL_POINTS);
  gl.EndList();
  EXPECT_EQ(gl.permitted_errors(), std::vector<GLenum>{GL_INVALID_OPERATION});
  gl.Vertex2f(2, 0);  // still compiled
  gl.End();
  EXPECT_EQ(get(gl, GL_LIST_INDEX), std::vector<GLdouble>{1});
  gl.EndList();
  expect_error(gl, GL_INVALID_OPERATION);
  gl.CallList(1);
  EXPECT_EQ(drawn_x(gl), (std::vector<float>{2, 2}));
}

TEST(DisplayLists, HaveErrorsOfTheirOwn) {
  struct Wrong {
    std::vector<GLenum> errors;
    Commands issue;
  };
  const Wrong all[] = {
      {{GL_INVALID_VALUE}, [](Specification& c) { c.NewList(0, GL_COMPILE); }},
      {{GL_INVALID_ENUM}, [](Specification& c) { c.NewList(1, GL_COMPILE_AND_EXECUTE + 1); }},
      {{GL_INVALID_VALUE, GL_INVALID_ENUM}, [](Specification& c) { c.NewList(0, 0); }},
      {{GL_INVALID_OPERATION}, [](Specification& c) { c.EndList(); }},
      {{GL_INVALID_VALUE}, [](Specification& c) { EXPECT_EQ(c.GenLists(-1), 0u); }},
      {{GL_OUT_OF_MEMORY}, [](Specification& c) { EXPECT_EQ(c.GenLists(0x7FFFFFFF), 0u); }},
      {{GL_INVALID_VALUE}, [](Specification& c) { c.DeleteLists(1, -1); }},
      {{GL_INVALID_VALUE}, [](Specification& c) { c.CallLists(-1, GL_INT, kOffsets); }},
      {{GL_INVALID_ENUM}, [](Specification& c) { c.CallLists(0, GL_DOUBLE, kOffsets); }},
      {{GL_INVALID_ENUM}, [](Specification& c) { c.CallLists(0, GL_BYTE - 1, kOffsets); }}};
  for (const Wrong& wrong : all) {
    SCOPED_TRACE(&wrong - all);
    Specification gl = evaluating();
    const auto before = seen(gl);
    wrong.issue(gl);
    EXPECT_EQ(gl.permitted_errors(), wrong.errors);
    expect_error(gl, wrong.errors.front());
    EXPECT_EQ(seen(gl), before);
    EXPECT_EQ(gl.IsList(7), GL_TRUE);
    EXPECT_EQ(gl.IsList(1), GL_FALSE);
  }
}

TEST(DisplayLists, ReplaceOthersWhenTheyAreComplete) {
  Specification gl;
  compile(gl, 1, [](Specification& c) { c.Indexf(5); });
  gl.NewList(1, GL_COMPILE_AND_EXECUTE);
  gl.CallList(1);  // calls the old list
  EXPECT_EQ(current_index(gl), 5);
  gl.NewList(2, GL_COMPILE);
  expect_error(gl, GL_INVALID_OPERATION);
  EXPECT_EQ(get(gl, GL_LIST_INDEX), std::vector<GLdouble>{1});
  gl.DeleteLists(1, 1);
  EXPECT_EQ(gl.IsList(1), GL_FALSE);
  gl.Indexf(6);
  gl.EndList();
  EXPECT_EQ(gl.IsList(1), GL_TRUE);
  EXPECT_EQ(gl.IsList(2), GL_FALSE);
  gl.Indexf(0);
  gl.CallList(1);
  EXPECT_EQ(current_index(gl), 6);
  compile(gl, 1, [](Specification&) {});
  gl.Indexf(0);
  gl.CallList(1);
  EXPECT_EQ(current_index(gl), 0);
  expect_error(gl, GL_NO_ERROR);
}

TEST(DisplayLists, OfOtherNamesAreIgnored) {
  Specification gl;
  gl.CallList(0);
  gl.CallList(5);
  const GLuint names[] = {0, 5, 0xFFFFFFFF};
  gl.CallLists(3, GL_UNSIGNED_INT, names);
  gl.DeleteLists(0, 0x7FFFFFFF);
  gl.CallLists(3, GL_UNSIGNED_INT, nullptr);  // U-NULL
  EXPECT_EQ(gl.IsList(0), GL_FALSE);
  expect_error(gl, GL_NO_ERROR);
}

TEST(DisplayLists, NestToALimit) {
  Specification gl;
  for (GLuint i = 1; i <= 70; ++i) {
    compile(gl, i, [&](Specification& c) {
      c.Indexf(static_cast<GLfloat>(i));
      c.CallList(i + 1);
    });
  }
  gl.CallList(7);  // nests 64 lists
  EXPECT_EQ(current_index(gl), 70);
  gl.CallList(6);  // nests 65 lists
  EXPECT_EQ(current_index(gl), 69);
  expect_error(gl, GL_NO_ERROR);

  compile(gl, 1, [](Specification& c) {
    c.Begin(GL_POINTS);
    c.End();
    c.CallList(1);
  });
  for (int i = 0; i < 2; ++i) {  // the nesting depth is reset
    gl.CallList(1);
    EXPECT_EQ(gl.take_primitives().size(), 64u);
  }
  expect_error(gl, GL_NO_ERROR);
}

TEST(DisplayLists, GetFreeNames) {
  Specification gl;
  EXPECT_EQ(gl.GenLists(0), 0u);
  compile(gl, 3, [](Specification&) {});
  EXPECT_EQ(gl.GenLists(2), 1u);
  EXPECT_EQ(gl.IsList(2), GL_TRUE);
  gl.CallList(2);  // empty
  EXPECT_EQ(gl.GenLists(2), 4u);
  gl.DeleteLists(2, 3);
  EXPECT_EQ(gl.IsList(1), GL_TRUE);
  EXPECT_EQ(gl.IsList(2), GL_FALSE);
  EXPECT_EQ(gl.IsList(4), GL_FALSE);
  EXPECT_EQ(gl.IsList(5), GL_TRUE);
  EXPECT_EQ(gl.GenLists(4), 6u);
  EXPECT_EQ(gl.GenLists(3), 2u);
  compile(gl, 0xFFFFFFFF, [](Specification&) {});
  EXPECT_EQ(gl.GenLists(1), 10u);
  gl.DeleteLists(0xFFFFFFFF, 5);  // does not wrap around to 0
  EXPECT_EQ(gl.IsList(0xFFFFFFFF), GL_FALSE);
  EXPECT_EQ(gl.IsList(1), GL_TRUE);
  expect_error(gl, GL_NO_ERROR);
}

TEST(DisplayLists, ShowInQueries) {
  Specification gl;
  gl.ListBase(12);
  gl.NewList(5, GL_COMPILE);
  EXPECT_EQ(get(gl, GL_LIST_BASE), std::vector<GLdouble>{12});
  EXPECT_EQ(get(gl, GL_LIST_INDEX), std::vector<GLdouble>{5});
  EXPECT_EQ(get(gl, GL_LIST_MODE), std::vector<GLdouble>{GL_COMPILE});
  gl.EndList();
  EXPECT_EQ(get(gl, GL_LIST_INDEX), std::vector<GLdouble>{0});
  EXPECT_EQ(get(gl, GL_LIST_MODE), std::vector<GLdouble>{0});
  gl.NewList(5, GL_COMPILE_AND_EXECUTE);
  EXPECT_EQ(get(gl, GL_LIST_MODE), std::vector<GLdouble>{GL_COMPILE_AND_EXECUTE});
  expect_error(gl, GL_NO_ERROR);
}

TEST(DisplayLists, AreCopiedWithTheContext) {
  Specification gl;
  compile(gl, 1, [](Specification& c) { c.Indexf(5); });
  gl.NewList(2, GL_COMPILE);
  Specification copy = gl;
  gl.EndList();
  gl.DeleteLists(1, 1);
  EXPECT_EQ(copy.IsList(2), GL_FALSE);
  copy.Indexf(6);
  copy.EndList();
  gl.CallList(2);
  EXPECT_EQ(current_index(gl), 1);
  copy.CallList(1);
  EXPECT_EQ(current_index(copy), 5);
  copy.CallList(2);
  EXPECT_EQ(current_index(copy), 6);
  EXPECT_EQ(current_index(gl), 1);  // a command acts on the context that executes it
}

}  // namespace
}  // namespace evalcts::reference
