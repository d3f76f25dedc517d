// Sections 14 to 16 of the requirements, the errors: EvalMesh rejects invalid modes and calls between Begin
// and End; EvalPoint accepts every index.
#include <fmt/format.h>

#include <evalcts/testkit/registration.h>

#include "dimensions.h"
#include "rejection.h"

namespace evalcts::suite_mesh_errors {
namespace {

// Appends EvalMesh1 or EvalMesh2 over a range that is small (see U-INTMAX-MESH) or empty.
void mesh(gl::Case& c, bool two, GLenum mode, bool empty = false) {
  const GLint last = empty ? -1 : 2;
  eval_mesh(c, two, mode, 0, last, 0, last);
}

// Returns invalid modes: primitives, the tokens next to the valid ones, and others.
std::vector<GLenum> bad_modes(bool two) {
  std::vector<GLenum> modes = {GL_POINTS,    GL_LINES,         GL_LINE_LOOP,     GL_LINE_STRIP,
                               GL_TRIANGLES, GL_QUADS,         GL_QUAD_STRIP,    GL_POLYGON,
                               0x1AFF,       0x1B03,           GL_FLAT,          GL_FRONT_AND_BACK,
                               0xFFFFFFFFu,  GL_MAP1_VERTEX_3, GL_MAP2_VERTEX_3, GL_TEXTURE_2D};
  if (!two) modes.push_back(GL_FILL);
  return modes;
}

std::vector<GLenum> good_modes(bool two) {
  if (two) return {GL_POINT, GL_LINE, GL_FILL};
  return {GL_POINT, GL_LINE};
}

// Enables a vertex map of each dimension; disable_maps() disables all maps.
void enable_vertices(gl::Case& c) {
  c.Enable(GL_MAP1_VERTEX_3);
  c.Enable(GL_MAP2_VERTEX_4);
}
void disable_maps(gl::Case& c) {
  for (const GLenum target : all_targets()) c.Disable(target);
}

std::vector<Calls> bad_meshes(bool two, bool empty = false) {
  std::vector<Calls> calls;
  for (const GLenum mode : bad_modes(two)) {
    calls.push_back([=](gl::Case& c) { mesh(c, two, mode, empty); });
    if (!two || !empty) continue;
    calls.push_back([=](gl::Case& c) { c.EvalMesh2(mode, 2, 1, 0, 2); });
    calls.push_back([=](gl::Case& c) { c.EvalMesh2(mode, 0, 2, 1, 0); });
  }
  return calls;
}

EVALCTS_TEST_PAIR(MeshErrors.Mesh1BadMode, MeshErrors.Mesh2BadMode, kMust,
                  decide("EV-MESH1-ERR-MODE", "EV-MESH2-ERR-MODE"), by(gl::list_deliveries()))
(Test& t, bool two) {
  judge_rejected(t, "every second map enabled", bad_meshes(two));

  // The mode causes the error: the same call with a valid mode raises none.
  gl::Case c("good modes, vertex maps enabled");
  enable_vertices(c);
  for (const GLenum mode : good_modes(two)) {
    mesh(c, two, mode);
    c.GetError();
  }
  t.judge_answers(c);
};

EVALCTS_TEST_PAIR(MeshErrors.Mesh1ModeCheckedFirst, MeshErrors.Mesh2ModeCheckedFirst, kMust,
                  decide("EV-MESH1-ERR-FIRST", "EV-MESH2-ERR-FIRST"), by(gl::list_deliveries()))
(Test& t, bool two) {
  for (const bool enabled : {false, true})
    for (const bool empty : {false, true}) {
      if (enabled && !empty) continue;
      gl::Case c(fmt::format("{}, {} range", enabled ? "vertex maps enabled" : "all maps disabled",
                             empty ? "empty" : "small"));
      enabled ? enable_vertices(c) : disable_maps(c);
      take_snapshot(t, c);
      for (const Calls& call : bad_meshes(two, empty)) {
        call(c);
        c.GetError();
        c.GetError();
      }
      for (const GLenum mode : good_modes(two)) {
        mesh(c, two, mode, empty);
        c.GetError();
      }
      take_snapshot(t, c);
      t.judge(c);
    }
};

EVALCTS_TEST_PAIR(MeshErrors.Mesh1BetweenBeginAndEnd, MeshErrors.Mesh2BetweenBeginAndEnd, kMust,
                  decide("EV-MESH1-ERR-BEGINEND", "EV-MESH2-ERR-BEGINEND"), by(gl::list_deliveries()))
(Test& t, bool two) {
  const auto inside = [two](GLenum primitive, GLenum mode, bool empty, bool after_vertex) {
    return in_primitive(primitive, after_vertex, [=](gl::Case& c) { mesh(c, two, mode, empty); });
  };
  std::vector<Calls> bad;
  for (const GLenum primitive : {GL_POINTS, GL_LINE_STRIP, GL_QUADS, GL_POLYGON})
    for (const GLenum mode : good_modes(two))
      for (const bool after_vertex : {false, true})
        bad.push_back(inside(primitive, mode, false, after_vertex));
  for (const GLenum mode : good_modes(two)) bad.push_back(inside(GL_TRIANGLES, mode, true, false));
  // Two errors apply to these calls; either is accepted.
  for (const GLenum mode : {GL_QUADS, GL_LINES, 0x1B03})
    bad.push_back(inside(GL_TRIANGLES, mode, false, false));
  judge_rejected(t, "good modes, also of an empty range, and bad modes", bad);

  gl::Case c("all maps disabled");
  disable_maps(c);
  for (const GLenum mode : good_modes(two)) {
    inside(GL_LINES, mode, false, false)(c);
    c.GetError();
  }
  t.judge(c);
};

// Defines and enables maps and sets grids of both dimensions, with which a mesh draws something.
void define_vertices(gl::Case& c) {
  define(c, make_map1(GL_MAP1_VERTEX_3, {0.5, -0.25, 0.125, 0.75, 0.5, -0.5}));
  define(c, make_map2(GL_MAP2_VERTEX_3, 2, 2,
                      {0.1, 0.2, 0.3, 0.4, -0.5, 0.6, -0.7, 0.8, -0.9, 0.25, 0.5, 0.75}));
  c.Enable(GL_MAP1_VERTEX_3);
  c.Enable(GL_MAP2_VERTEX_3);
  c.MapGrid1f(2, 0, 1);
  c.MapGrid2f(2, 0, 1, 2, 0, 1);
}

// A rejected mesh draws nothing, and does not end the primitive around it.
EVALCTS_TEST_PAIR(MeshErrors.Mesh1PrimitiveUndisturbed, MeshErrors.Mesh2PrimitiveUndisturbed, kMust,
                  decide("EV-MESH1-ERR-BEGINEND", "EV-MESH2-ERR-BEGINEND"),
                  decide("EV-BE-IGNORED/1-D", "EV-BE-IGNORED/2-D"), by(gl::list_deliveries()))
(Test& t, bool two) {
  for (const GLenum primitive : {GL_POINTS, GL_LINE_STRIP, GL_TRIANGLES})
    for (const GLenum mode : good_modes(two)) {
      gl::Case c(
          fmt::format("{} between two vertices of {}", gl::token_name(mode), gl::primitive_name(primitive)));
      define_vertices(c);
      c.Begin(primitive);
      c.EvalCoord1f(0.25f);
      mesh(c, two, mode);
      c.EvalCoord2f(0.75f, 0.5f);
      c.Vertex3f(-1, 0.5, 3);
      c.End();
      t.judge_vertices(c, kPosition);
    }
};

EVALCTS_TEST_PAIR(MeshErrors.Mesh1RefusedDrawsNothing, MeshErrors.Mesh2RefusedDrawsNothing, kMust,
                  decide("EV-MESH1-ERR-MODE", "EV-MESH2-ERR-MODE"), by(gl::list_deliveries()))
(Test& t, bool two) {
  gl::Case c("bad modes between two points");
  define_vertices(c);
  const auto point = [&c](float x) {
    c.Begin(GL_POINTS);
    c.Vertex3f(x, 0.25, 0.5);
    c.End();
  };
  point(0.125);
  for (const Calls& call : bad_meshes(two)) {
    call(c);
    c.GetError();
  }
  point(0.75);
  t.judge_vertices(c, kPosition);
};

// The GL is outside Begin/End after any mesh, drawn or rejected: Begin is legal and End alone is not.
EVALCTS_TEST(MeshErrors, LeavesNothingOpen, kMust, "EV-BE-MESHNOTINSIDE", by(gl::list_deliveries()))
(Test& t) {
  std::vector<Calls> attempts;
  for (const bool two : {false, true}) {
    for (const GLenum mode : good_modes(two)) {
      attempts.push_back([=](gl::Case& c) { mesh(c, two, mode); });
      attempts.push_back([=](gl::Case& c) { mesh(c, two, mode, true); });
      attempts.push_back([=](gl::Case& c) {
        disable_maps(c);
        mesh(c, two, mode);
      });
      attempts.push_back(in_primitive(GL_LINES, false, [=](gl::Case& c) { mesh(c, two, mode); }));
    }
    for (const GLenum mode : good_modes(two))  // meshes of one point
      attempts.push_back([=](gl::Case& c) { eval_mesh(c, two, mode, 1, 1, 0, 0); });
    attempts.push_back([=](gl::Case& c) { mesh(c, two, GL_QUADS); });
  }
  for (const bool begin : {true, false}) {
    gl::Case c(begin ? "Begin and End after each" : "End alone after each");
    for (const Calls& attempt : attempts) {
      enable_vertices(c);
      attempt(c);
      c.GetError();
      if (begin) c.Begin(GL_POINTS);
      c.End();
      c.GetError();
    }
    t.judge_answers(c);
  }
};

// Indices far outside the grid, up to the ends of int, raise no error and crash nothing (U-INTMIN-POINT).
EVALCTS_TEST(PointErrors, NoIndexIsAnError, kMust, "EV-POINT-RANGE", by(gl::list_deliveries()))
(Test& t) {
  constexpr GLint kIndices[] = {-3, 12, -1, 0x1000001, kHighest, -0x7FFFFFFF, kLowest};
  gl::Case c("-3, n+4, -1, 2^24+1, the highest, the lowest but one and the lowest int");
  define(c, make_map1(GL_MAP1_VERTEX_3, {1, 2, 3, 4, 5, 6}));
  define(c, make_map2(GL_MAP2_VERTEX_3, 1, 2, {1, 2, 3, 4, 5, 6}));
  c.Enable(GL_MAP1_VERTEX_3);
  c.Enable(GL_MAP2_VERTEX_3);
  c.MapGrid1f(8, 0.25f, 0.75f);
  c.MapGrid2f(8, 0.25f, 0.75f, 5, 1, -1);
  take_snapshot(t, c);
  for (const GLint i : kIndices) {
    c.Begin(GL_POINTS);
    c.EvalPoint1(i);
    c.End();
    c.GetError();
    c.Begin(GL_POINTS);
    for (const GLint j : kIndices) c.EvalPoint2(i, j);
    c.End();
    c.GetError();
  }
  take_snapshot(t, c);
  t.judge_answers(c);
};

}  // namespace
}  // namespace evalcts::suite_mesh_errors
