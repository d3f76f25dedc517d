// Section 19: what may stand between Begin and End, and that commands act in order.
#include "map_calls.h"

namespace evalcts::faults {
namespace {

// Begin and End for faults that want the mode: memory.count is it, plus one, while a primitive is open.
void follow_modes(Injection& in) {
  in.gl.Begin = [](GLenum mode) {
    memory.count = mode + 1;
    sound.Begin(mode);
  };
  in.gl.End = [] {
    memory.count = 0;
    sound.End();
  };
}

EVALCTS_FAULT(EvalCoord1dvRefusedOnceInPrimitive, production, must, "EV-BE-ALLOWED",
              "the fourth EvalCoord1dv of a TRIANGLE_FAN raises INVALID_OPERATION") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = mode == GL_TRIANGLE_FAN;
    memory.count = 0;
    sound.Begin(mode);
  };
  in.gl.EvalCoord1dv = [](const GLdouble* u) {
    sound.EvalCoord1dv(u);
    if (memory.flag && ++memory.count == 4) leave_error(GL_INVALID_OPERATION);
  };
}

EVALCTS_FAULT(MeshIgnoredInPrimitives, production, must, "EV-BE-ALLOWED",
              "EvalMesh1 in a primitive does nothing and raises nothing") {
  follow_primitives(in);
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (!memory.flag) sound.EvalMesh1(mode, i1, i2);
  };
}

EVALCTS_FAULT(Map2SplitsPrimitive, production, must, "EV-BE-IGNORED/2-D",
              "Map2f in a primitive raises its error and begins a new primitive of the mode") {
  follow_modes(in);
  in.gl.Map2f = [](GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
                   GLint vstride, GLint vorder, const GLfloat* points) {
    sound.Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    if (memory.count == 0) return;
    sound.End();
    sound.Begin(static_cast<GLenum>(memory.count - 1));
  };
}

EVALCTS_FAULT(MeshDrawnIntoPrimitive, production, must, "EV-BE-IGNORED/1-D",
              "EvalMesh1 of points in a primitive raises its error and adds its vertices") {
  follow_primitives(in);
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    sound.EvalMesh1(mode, i1, i2);
    if (memory.flag && mode == GL_POINT)
      for (GLint i = i1; i <= i2; ++i) sound.EvalPoint1(i);
  };
}

EVALCTS_FAULT(RefusedMapSwallowsNextVertex, production, must, "EV-BE-IGNORED/1-D",
              "the EvalCoord1f that follows a Map1d in a primitive is lost") {
  follow_primitives(in);
  in.gl.Map1d = [](GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                   const GLdouble* points) {
    memory.count = memory.flag;
    sound.Map1d(target, u1, u2, stride, order, points);
  };
  in.gl.EvalCoord1f = [](GLfloat u) {
    if (memory.count == 0) sound.EvalCoord1f(u);
    memory.count = 0;
  };
}

EVALCTS_FAULT(RefusedQueryEndsPrimitive, production, must, "EV-BE-IGNORED",
              "GetMapdv in a primitive raises its error and ends the primitive") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = true;
    sound.Begin(mode);
  };
  in.gl.End = [] {
    if (memory.flag) sound.End();
    memory.flag = false;
  };
  in.gl.GetMapdv = [](GLenum target, GLenum query, GLdouble* v) {
    sound.GetMapdv(target, query, v);
    if (memory.flag) sound.End();
    memory.flag = false;
  };
}

EVALCTS_FAULT(
    RefusedEnableRestartsStrip, production, must, "EV-BE-IGNORED",
    "Disable of a map of two dimensions in a primitive raises its error and forgets the last vertex") {
  follow_primitives(in);
  in.gl.Disable = [](GLenum cap) {
    sound.Disable(cap);
    if (memory.flag && is_map2(cap)) memory.count = 1;
  };
  in.emitted = [](std::vector<ObservedPrimitive>& primitives) {
    if (memory.count && !primitives.empty() && primitives.front().vertices.size() > 1)
      primitives.front().vertices.erase(primitives.front().vertices.begin());
  };
}

EVALCTS_FAULT(BadMeshModeLeavesPrimitiveOpen, production, must, "EV-BE-MESHNOTINSIDE",
              "EvalMesh2 with a bad mode raises its error inside a primitive that it never ends") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (mode < GL_POINT || mode > GL_FILL) sound.Begin(GL_POINTS);
  };
}

EVALCTS_FAULT(EmptyLineMeshLeavesStripOpen, production, must, "EV-BE-MESHNOTINSIDE",
              "EvalMesh1 LINE with an empty range begins a strip and returns") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    sound.EvalMesh1(mode, i1, i2);
    if (mode == GL_LINE && i1 > i2) sound.Begin(GL_LINE_STRIP);
  };
}

EVALCTS_FAULT(MeshWithoutMapsLeavesPrimitiveOpen, production, must, "EV-BE-MESHNOTINSIDE",
              "EvalMesh2 FILL without a vertex map begins a strip and returns") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (mode == GL_FILL && !sound.IsEnabled(GL_MAP2_VERTEX_3) && !sound.IsEnabled(GL_MAP2_VERTEX_4))
      sound.Begin(GL_QUAD_STRIP);
  };
}

EVALCTS_FAULT(MeshInPrimitiveEndsIt, production, must, "EV-BE-IGNORED/2-D",
              "EvalMesh2 in a primitive raises its error and leaves the GL outside it") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = true;
    sound.Begin(mode);
  };
  in.gl.End = [] {
    if (memory.flag) sound.End();
    memory.flag = false;
  };
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (memory.flag) sound.End();
    memory.flag = false;
  };
}

EVALCTS_FAULT(GridWaitsForMesh, production, must, "EV-BE-ORDER",
              "MapGrid1f after a mesh takes effect after the next mesh") {
  in.gl.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) {
    if (memory.count == 0) return sound.MapGrid1f(n, u1, u2);
    memory.numbers = {static_cast<double>(n), u1, u2};
  };
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    sound.EvalMesh1(mode, i1, i2);
    memory.count = 1;
    if (memory.numbers.empty()) return;
    sound.MapGrid1f(static_cast<GLint>(memory.numbers[0]), static_cast<GLfloat>(memory.numbers[1]),
                    static_cast<GLfloat>(memory.numbers[2]));
    memory.numbers.clear();
  };
}

EVALCTS_FAULT(ColorWaitsForEnd, production, must, "EV-BE-ORDER",
              "Color4f outside of primitives takes effect after the next primitive") {
  follow_primitives(in);
  in.gl.Color4f = [](GLfloat r, GLfloat g, GLfloat b, GLfloat a) {
    if (memory.flag) return sound.Color4f(r, g, b, a);
    memory.numbers = {r, g, b, a};
  };
  in.gl.End = [] {
    memory.flag = false;
    sound.End();
    if (memory.numbers.empty()) return;
    sound.Color4d(memory.numbers[0], memory.numbers[1], memory.numbers[2], memory.numbers[3]);
    memory.numbers.clear();
  };
}

EVALCTS_FAULT(DisableWaitsForBegin, production, must, "EV-BE-ORDER",
              "Disable of MAP1_NORMAL is seen by the primitive after the next") {
  in.gl.Disable = [](GLenum cap) {
    if (cap == GL_MAP1_NORMAL)
      memory.flag = true;
    else
      sound.Disable(cap);
  };
  in.gl.Enable = [](GLenum cap) {
    if (cap == GL_MAP1_NORMAL) memory.flag = false;
    sound.Enable(cap);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.flag) sound.Disable(GL_MAP1_NORMAL);
    memory.flag = false;
  };
}

// A whole GL, which shows matrices and materials.

void load_late_matrix() {
  if (memory.numbers.empty()) return;
  sound.LoadMatrixf(std::vector<GLfloat>(memory.numbers.begin(), memory.numbers.end()).data());
  memory.numbers.clear();
}

EVALCTS_FAULT(MatrixWaitsForMesh, osmesa, must, "EV-BE-ORDER/2-D",
              "LoadMatrixf is carried out after the mesh of two dimensions that follows it") {
  in.gl.LoadMatrixf = [](const GLfloat* matrix) { memory.numbers.assign(matrix, matrix + 16); };
  in.gl.Begin = [](GLenum mode) {
    load_late_matrix();
    sound.Begin(mode);
  };
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    load_late_matrix();
    sound.EvalMesh1(mode, i1, i2);
  };
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    load_late_matrix();
  };
}

void draw_late_mesh() {
  if (memory.numbers.empty()) return;
  const std::vector<double>& mesh = memory.numbers;
  sound.EvalMesh1(static_cast<GLenum>(mesh[0]), static_cast<GLint>(mesh[1]), static_cast<GLint>(mesh[2]));
  memory.numbers.clear();
}

EVALCTS_FAULT(
    MeshTakesLaterColor, osmesa, must, "EV-BE-ORDER/1-D",
    "EvalMesh1 is carried out with the next command that draws, and takes the current colour from there") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    draw_late_mesh();
    memory.numbers = {static_cast<double>(mode), static_cast<double>(i1), static_cast<double>(i2)};
  };
  // All that the suite calls behind a mesh but Color4f.
  map1(in, [](auto call, auto go) {
    draw_late_mesh();
    go(call);
  });
  map_grid1(in, [](GLint n, auto u1, auto u2, auto go) {
    draw_late_mesh();
    go(n, u1, u2);
  });
  in.gl.Enable = [](GLenum cap) {
    draw_late_mesh();
    sound.Enable(cap);
  };
  in.gl.Disable = [](GLenum cap) {
    draw_late_mesh();
    sound.Disable(cap);
  };
  in.gl.LoadMatrixf = [](const GLfloat* matrix) {
    draw_late_mesh();
    sound.LoadMatrixf(matrix);
  };
  in.gl.Materialfv = [](GLenum face, GLenum pname, const GLfloat* values) {
    draw_late_mesh();
    sound.Materialfv(face, pname, values);
  };
  in.gl.Begin = [](GLenum mode) {
    draw_late_mesh();
    sound.Begin(mode);
  };
  in.gl.RenderMode = [](GLenum mode) {
    draw_late_mesh();
    return sound.RenderMode(mode);
  };
  in.gl.GetError = [] {
    draw_late_mesh();
    return sound.GetError();
  };
}

EVALCTS_FAULT(MeshOfOnePointLeavesStripOpen, production, must, "EV-BE-MESHNOTINSIDE",
              "EvalMesh2 LINE of a single row and column begins a strip and returns") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (mode == GL_LINE && i1 == i2 && j1 == j2) sound.Begin(GL_LINE_STRIP);
  };
}

}  // namespace
}  // namespace evalcts::faults
