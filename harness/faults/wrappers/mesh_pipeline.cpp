// Sections 15 and 16, further down the pipeline: stippling, faces, polygon modes.
#include "evaluating.h"

namespace evalcts::faults {
namespace {

EVALCTS_FAULT(CurveMeshOfSeparateLines, osmesa, must, "EV-MESH1-STIPPLE",
              "EvalMesh1 with LINE draws separate lines: the stipple starts anew at each") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (mode != GL_LINE) return sound.EvalMesh1(mode, i1, i2);
    for (GLint i = i1; i < i2; ++i) sound.EvalMesh1(mode, i, i + 1);
  };
}

EVALCTS_FAULT(CurveMeshInTwoStrips, osmesa, must, "EV-MESH1-STIPPLE",
              "EvalMesh1 with LINE draws a second strip from the middle on") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    if (mode != GL_LINE || i2 - i1 < 2) return sound.EvalMesh1(mode, i1, i2);
    const GLint middle = i1 + (i2 - i1) / 2;
    sound.EvalMesh1(mode, i1, middle);
    sound.EvalMesh1(mode, middle, i2);
  };
}

EVALCTS_FAULT(RowsInTwoStrips, osmesa, must, "EV-MESH2-STIPPLE",
              "strips along u of EvalMesh2 are drawn in two halves") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_LINE || i2 - i1 < 2) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    const GLint middle = i1 + (i2 - i1) / 2;
    for (GLint j = j1; j <= j2; ++j) {
      sound.EvalMesh2(mode, i1, middle, j, j);
      sound.EvalMesh2(mode, middle, i2, j, j);
    }
    for (GLint i = i1; i <= i2; ++i) sound.EvalMesh2(mode, i, i, j1, j2);
  };
}

EVALCTS_FAULT(SurfaceMeshOfSeparateLines, osmesa, must, "EV-MESH2-STIPPLE",
              "strips along v of EvalMesh2 are separate lines") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_LINE) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    for (GLint j = j1; j <= j2; ++j) sound.EvalMesh2(mode, i1, i2, j, j);
    for (GLint i = i1; i <= i2; ++i)
      for (GLint j = j1; j < j2; ++j) sound.EvalMesh2(mode, i, i, j, j + 1);
  };
}

EVALCTS_FAULT(StripsOfMeshesClockwise, osmesa, must, "EV-MESH2-WINDING EV-MESH2-TWOSIDE",
              "EvalMesh2 with FILL turns its quads the other way") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_FILL) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    for (GLint j = j1; j < j2; ++j) {
      sound.Begin(GL_QUAD_STRIP);
      for (GLint i = i1; i <= i2; ++i) {
        sound.EvalPoint2(i, j + 1);
        sound.EvalPoint2(i, j);
      }
      sound.End();
    }
  };
}

EVALCTS_FAULT(MeshesHaveFrontsOnly, osmesa, must, "EV-MESH2-TWOSIDE",
              "EvalMesh2 with AUTO_NORMAL lights the front alone") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    GLint two_sides = 0;
    sound.GetIntegerv(GL_LIGHT_MODEL_TWO_SIDE, &two_sides);
    const GLfloat off = 0, back = static_cast<GLfloat>(two_sides);
    if (sound.IsEnabled(GL_AUTO_NORMAL)) sound.LightModelfv(GL_LIGHT_MODEL_TWO_SIDE, &off);
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    sound.LightModelfv(GL_LIGHT_MODEL_TWO_SIDE, &back);
  };
}

EVALCTS_FAULT(LineMeshesAreCulled, osmesa, must, "EV-MESH2-NOPOLYMODE",
              "EvalMesh2 with LINE draws nothing where front and back faces are culled") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    GLint face = GL_BACK;
    sound.GetIntegerv(GL_CULL_FACE_MODE, &face);
    if (mode == GL_LINE && sound.IsEnabled(GL_CULL_FACE) && face == GL_FRONT_AND_BACK) return;
    sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(LineMeshesFollowPolygonMode, osmesa, must, "EV-MESH2-NOPOLYMODE",
              "EvalMesh2 with LINE draws points in polygon mode POINT") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    GLint modes[2] = {GL_FILL, GL_FILL};
    sound.GetIntegerv(GL_POLYGON_MODE, modes);
    sound.EvalMesh2(mode == GL_LINE && modes[0] == GL_POINT ? GL_POINT : mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(FilledMeshesAlwaysFilled, osmesa, must, "EV-MESH2-NOPOLYMODE",
              "EvalMesh2 with FILL ignores the polygon mode") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    GLint modes[2] = {GL_FILL, GL_FILL};
    sound.GetIntegerv(GL_POLYGON_MODE, modes);
    sound.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    sound.PolygonMode(GL_FRONT, static_cast<GLenum>(modes[0]));
    sound.PolygonMode(GL_BACK, static_cast<GLenum>(modes[1]));
  };
}

EVALCTS_FAULT(FilledMeshesNeverCulled, osmesa, must, "EV-MESH2-NOPOLYMODE",
              "EvalMesh2 with FILL is not culled") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const bool culled = sound.IsEnabled(GL_CULL_FACE);
    sound.Disable(GL_CULL_FACE);
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (culled) sound.Enable(GL_CULL_FACE);
  };
}

EVALCTS_FAULT(HalfOfEachQuad, osmesa, quality, "EV-MESH2-PLANAR",
              "EvalMesh2 with FILL draws three corners of each quad") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_FILL) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    sound.Begin(GL_TRIANGLES);
    for (GLint j = j1; j < j2; ++j)
      for (GLint i = i1; i < i2; ++i) {
        sound.EvalPoint2(i, j);
        sound.EvalPoint2(i, j + 1);
        sound.EvalPoint2(i + 1, j);
      }
    sound.End();
  };
}

// --- Whole quads -------------------------------------------------------------------------------------------

EVALCTS_FAULT(FilledMeshesOfTriangleStrips, dropin, must, "EV-MESH2-ISQUADS EV-MESH2-FLAT",
              "EvalMesh2 with FILL draws triangle strips") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_FILL) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    for (GLint j = j1; j < j2; ++j) {
      sound.Begin(GL_TRIANGLE_STRIP);
      for (GLint i = i1; i <= i2; ++i) {
        sound.EvalPoint2(i, j);
        sound.EvalPoint2(i, j + 1);
      }
      sound.End();
    }
  };
}

// As quads that begin one corner further, or two.
void turned_quads(GLint i1, GLint i2, GLint j1, GLint j2, int turns) {
  constexpr GLint kCorners[4][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  sound.Begin(GL_QUADS);
  for (GLint j = j1; j < j2; ++j)
    for (GLint i = i1; i < i2; ++i)
      for (int k = 0; k < 4; ++k) {
        const auto& corner = kCorners[(k + turns) % 4];
        sound.EvalPoint2(i + corner[0], j + corner[1]);
      }
  sound.End();
}

EVALCTS_FAULT(FlatColorOfAnotherCorner, dropin, must, "EV-MESH2-FLAT",
              "EvalMesh2 with FILL draws quads whose last vertex is (i,j+1)") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_FILL) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    turned_quads(i1, i2, j1, j2, 2);
  };
}

EVALCTS_FAULT(FlatColorByFirstVertexOfAnotherCorner, dropin, must, "EV-MESH2-FLAT-FIRST",
              "by the first vertex convention quads of EvalMesh2 begin at (i,j+1) and end at (i,j)") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    GLint convention = 0;
    sound.GetIntegerv(GL_PROVOKING_VERTEX, &convention);
    if (mode != GL_FILL || convention != GL_FIRST_VERTEX_CONVENTION)
      return sound.EvalMesh2(mode, i1, i2, j1, j2);
    turned_quads(i1, i2, j1, j2, 1);
  };
}

}  // namespace
}  // namespace evalcts::faults
