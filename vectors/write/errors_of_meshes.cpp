// Errors of commands for grids and meshes.
#include <limits>

#include "errors.h"
#include "kinds.h"
#include "sequences.h"

namespace evalcts::vectors {
namespace {

constexpr GLint kLeast = std::numeric_limits<GLint>::min(), kMost = std::numeric_limits<GLint>::max();

}  // namespace

namespace errors_of {

void ready(gl::Case& c) {
  define(c, Type::kSingle, {GL_MAP1_VERTEX_3, {2, 0, 1}, {}, numbered(6)});
  define(c, Type::kSingle, {GL_MAP2_VERTEX_3, {2, 0, 1}, {2, 0, 1}, numbered(12)});
  c.Enable(GL_MAP1_VERTEX_3);
  c.Enable(GL_MAP2_VERTEX_3);
}

// --- Grids

void grids(Document& document) {
  const auto set = [](gl::Case& c) {
    c.MapGrid1f(3, 0.25f, 0.75f);
    c.MapGrid2f(5, -1, 2, 7, 3, -4);
  };
  Theme one(document, "grid1-segments", "MapGrid1 with n <= 0", {"EV-GRID-ERR-N", "EV-GRID-ERR-NOEFFECT"});
  Theme u(document, "grid2-usegments", "MapGrid2 with un <= 0", {"EV-GRID-ERR-UN", "EV-GRID-ERR-NOEFFECT"});
  Theme v(document, "grid2-vsegments", "MapGrid2 with vn <= 0", {"EV-GRID-ERR-VN", "EV-GRID-ERR-NOEFFECT"});
  Theme inside(document, "grid-begin-end", "MapGrid between Begin and End", {"EV-GRID-ERR-BEGINEND"});
  Theme legal(document, "grid-legal", "unusual grids, and no error",
              {"EV-GRID-EQUAL", "EV-GRID-REVERSED", "EV-GRID-LARGE", "EV-GRID-NOUNIT"});
  const auto add = [&](Theme& theme, const std::function<void(gl::Case&)>& what) {
    gl::Case c;
    set(c);
    what(c);
    query_grids(c);
    theme.add(sequence(c));
  };
  for (const Type type : kTypes) {
    for (const int n : {0, -1, kLeast}) {
      add(one, [&](gl::Case& c) { grid1(c, type, n, 0, 1); });
      add(u, [&](gl::Case& c) { grid2(c, type, n, 0, 1, 2, 0, 1); });
      add(v, [&](gl::Case& c) { grid2(c, type, 2, 0, 1, n, 0, 1); });
    }
    add(u, [&](gl::Case& c) { grid2(c, type, 0, 0, 1, -1, 0, 1); });
    add(inside, [&](gl::Case& c) {
      c.Begin(GL_LINES);
      grid1(c, type, 2, 0, 1);
      c.End();
    });
    add(inside, [&](gl::Case& c) {
      c.Begin(GL_POINTS);
      grid2(c, type, 2, 0, 1, 2, 0, 1);
      c.End();
    });
    add(legal, [&](gl::Case& c) { grid1(c, type, 3, 5, 5); });
    add(legal, [&](gl::Case& c) { grid2(c, type, 3, 5, 5, 1, -2, -2); });
    add(legal, [&](gl::Case& c) { grid1(c, type, kMost, 1, 0); });
    add(legal, [&](gl::Case& c) { grid2(c, type, kMost, 2, -3, kMost, 0, 0.5); });
    add(legal, [&](gl::Case& c) {
      c.ActiveTexture(GL_TEXTURE1);
      grid1(c, type, 4, 0, 2);
    });
  }
}

// --- Meshes

void meshes(Document& document) {
  Theme mode1(document, "mesh1-mode", "EvalMesh1 with another mode than POINT and LINE",
              {"EV-MESH1-ERR-MODE", "EV-MESH1-ERR-FIRST"});
  Theme mode2(document, "mesh2-mode", "EvalMesh2 with another mode than POINT, LINE and FILL",
              {"EV-MESH2-ERR-MODE", "EV-MESH2-ERR-FIRST"});
  Theme inside(document, "mesh-begin-end",
               "EvalMesh between Begin and End: the open primitive is not disturbed",
               {"EV-MESH1-ERR-BEGINEND", "EV-MESH2-ERR-BEGINEND", "EV-BE-MESHNOTINSIDE"});
  Theme quiet(document, "mesh-nothing",
              "meshes without vertex map or of no points: nothing is drawn, and no error",
              {"EV-MESH1-NOVERTEX", "EV-MESH2-NOVERTEX", "EV-MESH1-EMPTY", "EV-MESH2-EMPTY"});
  for (const bool enabled : {true, false}) {
    for (const GLenum mode : {GL_FILL, GL_POINTS, GL_LINES, GL_LINE_STRIP, GL_TEXTURE_2D, GL_POINT - 1}) {
      gl::Case c;
      if (enabled) ready(c);
      c.EvalMesh1(mode, 0, 1);
      mode1.add(sequence(c));
    }
    for (const GLenum mode : {GL_QUADS, GL_QUAD_STRIP, GL_LINES, GL_POINTS, GL_TEXTURE_2D, GL_FILL + 1}) {
      gl::Case c;
      if (enabled) ready(c);
      c.EvalMesh2(mode, 0, enabled ? 1 : -1, 0, 1);
      mode2.add(sequence(c));
    }
  }
  for (const GLenum mode : {GL_POINT, GL_LINE, GL_FILL}) {
    gl::Case c;
    ready(c);
    c.Begin(GL_POINTS);
    c.EvalCoord1f(0.5f);
    c.EvalMesh2(mode, 0, 1, 0, 1);
    if (mode != GL_FILL) c.EvalMesh1(mode, 0, 1);
    c.EvalCoord2f(0.5f, 0.25f);
    c.End();
    inside.add(sequence(c));

    gl::Case d;
    d.EvalMesh2(mode, 0, 3, 0, 3);
    if (mode != GL_FILL) d.EvalMesh1(mode, 0, 3);
    quiet.add(sequence(d));

    gl::Case e;
    ready(e);
    e.EvalMesh2(mode, 1, 0, 0, 1);
    e.EvalMesh2(mode, 0, 1, 3, 2);
    if (mode != GL_FILL) e.EvalMesh1(mode, 2, 1);
    quiet.add(sequence(e));
  }
}

}  // namespace errors_of

}  // namespace evalcts::vectors
