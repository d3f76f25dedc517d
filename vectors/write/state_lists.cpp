// The themes of display lists in state.json.
#include "state.h"

namespace evalcts::vectors::states {
namespace {

void single_lists(Theme& theme, GLenum mode, bool two) {
  const GLenum vertex = target_of(two, GL_MAP1_VERTEX_3);
  // One list contains all commands.
  add(theme, kPositions, [&](gl::Case& c) {
    c.NewList(1, mode);
    define_and_enable(c, vertex);
    c.MapGrid1f(2, 0, 1);
    c.MapGrid2f(2, 0, 1, 1, 0, 1);
    draw(c, two);
    if (two)
      c.EvalMesh2(GL_LINE, 0, 1, 0, 1);
    else
      c.EvalMesh1(GL_POINT, 0, 2);
    c.EndList();
    c.IsEnabled(vertex);
    c.CallList(1);
    c.IsEnabled(vertex);
    c.CallList(1);
  });
  // A list evaluates with the maps and grids at the time of its execution.
  add(theme, kEverything,
      [&](gl::Case& c) {
        define_and_enable(c, vertex);
        c.NewList(1, mode);
        draw(c, two);
        c.EndList();
        define(c, Type::kReal, some_map(vertex, 3));
        define_and_enable(c, target_of(two, GL_MAP1_COLOR_4));
        current_values(c);
        c.CallList(1);
        c.Disable(vertex);
        c.CallList(1);
      },
      {"EV-DL-CURRENT"});
}

void nested_lists(Theme& theme, GLenum mode, bool two) {
  const GLenum vertex = target_of(two, GL_MAP1_VERTEX_3);
  // A nested list is the one that is defined at the time of the call.
  add(theme, kPositions,
      [&](gl::Case& c) {
        define_and_enable(c, vertex);
        c.NewList(1, GL_COMPILE);
        evaluate(c, two, 0, 0);
        c.EndList();
        c.NewList(2, mode);
        c.Begin(GL_LINES);
        c.CallList(1);
        evaluate(c, two, 1, 1);
        c.End();
        c.EndList();
        c.CallList(2);
        c.NewList(1, GL_COMPILE);
        evaluate(c, two, 0.5, 0.25);
        c.EndList();
        c.CallList(2);
      },
      {"EV-DL-NESTED", "EV-DL-INBEGIN"});
  // Begin, vertices and End come from lists and from commands outside them.
  add(theme, kPositions,
      [&](gl::Case& c) {
        define_and_enable(c, vertex);
        c.NewList(1, GL_COMPILE);
        c.Begin(GL_LINE_STRIP);
        evaluate(c, two, 0, 0);
        c.EndList();
        c.NewList(2, GL_COMPILE);
        evaluate(c, two, 1, 1);
        c.End();
        c.EndList();
        c.CallList(1);
        evaluate(c, two);
        c.CallList(2);
      },
      {"EV-DL-SPLIT", "EV-DL-INBEGIN"});
}

void several_lists(Theme& theme, GLenum mode, bool two) {
  const GLenum vertex = target_of(two, GL_MAP1_VERTEX_3);
  // CallLists calls several lists.
  add(theme, kPositions, [&](gl::Case& c) {
    define_and_enable(c, vertex);
    for (GLuint list = 1; list <= 3; ++list) {
      c.NewList(list, GL_COMPILE);
      draw(c, two, list / 4.0, 0.5);
      c.EndList();
    }
    c.CallLists(3, GL_UNSIGNED_BYTE, std::vector<GLubyte>{3, 1, 2});
    c.ListBase(1);
    c.CallLists(2, GL_UNSIGNED_BYTE, std::vector<GLubyte>{0, 2});
    c.IsList(3);
    c.DeleteLists(3, 1);
    c.IsList(3);
    c.CallList(3);
  });
  // The active texture unit at the time of execution decides.
  add(theme, kPositions,
      [&](gl::Case& c) {
        define(c, Type::kSingle, some_map(vertex));
        c.NewList(1, mode);
        define(c, Type::kSingle, some_map(vertex, 3));
        c.EndList();
        c.ActiveTexture(GL_TEXTURE1);
        c.CallList(1);
        c.ActiveTexture(GL_TEXTURE0);
        c.GetMapiv(vertex, GL_ORDER, gl::out<GLint>(2));
        c.CallList(1);
        c.GetMapiv(vertex, GL_ORDER, gl::out<GLint>(2));
      },
      {"EV-DL-ACTIVETEX"});
}

}  // namespace

void lists(Document& document) {
  Theme theme(
      document, "lists",
      "display lists of maps, grids, enables and evaluation, compiled, executed, nested, called twice",
      {"EV-DL-COMPILED", "EV-DL-EXECUTE", "EV-DL-COMPEXEC", "EV-DL-REPEAT", "EV-DL-EXECSTATE-MAP",
       "EV-DL-EXECSTATE-GRID"});
  for (const GLenum mode : {GL_COMPILE, GL_COMPILE_AND_EXECUTE})
    for (const bool two : {false, true}) {
      single_lists(theme, mode, two);
      nested_lists(theme, mode, two);
      several_lists(theme, mode, two);
    }
}

}  // namespace evalcts::vectors::states
