// Section 11: what evaluation has to leave alone.
#include "evaluating.h"

namespace evalcts::faults {
namespace {

EVALCTS_FAULT(MeshLeavesWhite, production, must, "EV-CUR-COLOR",
              "EvalMesh1 with a colour map resets the current colour") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    sound.EvalMesh1(mode, i1, i2);
    if (is_noted_on(GL_MAP1_COLOR_4)) sound.Color4f(1, 1, 1, 1);
  };
}

// A flush in the middle of a primitive, as it is rarely seen.
EVALCTS_FAULT(ColorLostInLongPrimitives, production, must, "EV-CUR-COLOR",
              "the 257th evaluated vertex of a primitive leaves its colour as the current one") {
  primitives(
      in, [] { memory.count = 0; }, [] {});
  points1(in, [](auto go) {
    go();
    if (++memory.count == 257 && is_noted_on(GL_MAP1_COLOR_4)) sound.Color4f(0.5f, 0.25f, 0.5f, 1);
  });
}

EVALCTS_FAULT(NormalLostAfterStrips, production, must, "EV-CUR-NORMAL",
              "End of a TRIANGLE_STRIP with a normal map leaves the last normal as the current one") {
  primitives(
      in, [] { memory.number = 0; },
      [] {
        if (memory.number == 2) sound.Normal3f(0, 0, 1);
      });
  points1(in, [](auto go) {
    go();
    if (is_noted_on(GL_MAP1_NORMAL)) memory.number = open_mode() == GL_TRIANGLE_STRIP ? 2 : 1;
  });
}

EVALCTS_FAULT(VertexAfterEvaluationHasInitialNormal, production, must, "EV-CUR-NEXTVERTEX EV-COORD-MIX",
              "a Vertex right after an evaluation with a normal map has the normal (0,0,1)") {
  points(in, [](auto go) {
    memory.flag = is_noted_on(GL_MAP1_NORMAL) || is_noted_on(GL_MAP2_NORMAL);
    go();
  });
  in.gl.Vertex3f = [](GLfloat x, GLfloat y, GLfloat z) {
    if (memory.flag) sound.Normal3f(0, 0, 1);
    memory.flag = false;
    sound.Vertex3f(x, y, z);
  };
}

EVALCTS_FAULT(NormalLostAfterMeshes, production, must, "EV-CUR-NORMAL",
              "EvalMesh2 with a normal map leaves the last normal as the current one") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (is_noted_on(GL_MAP2_NORMAL)) sound.Normal3f(0.6f, 0, 0.8f);
  };
}

EVALCTS_FAULT(MeshCompletesTexCoord, production, must, "EV-CUR-TEX",
              "EvalMesh1 with a texture map leaves r = 0 and q = 1 in the current texture coordinates") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    sound.EvalMesh1(mode, i1, i2);
    GLfloat now[4] = {0, 0, 0, 1};
    sound.GetFloatv(GL_CURRENT_TEXTURE_COORDS, now);
    for (GLenum map = GL_MAP1_TEXTURE_COORD_1; map <= GL_MAP1_TEXTURE_COORD_4; ++map)
      if (is_noted_on(map)) sound.TexCoord4f(now[0], now[1], 0, 1);
  };
}

EVALCTS_FAULT(MeshSetsIndex, production, must, "EV-CUR-INDEX",
              "EvalMesh2 with an index map leaves its index as the current one") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (is_noted_on(GL_MAP2_INDEX)) sound.Indexf(4.5f);
  };
}

EVALCTS_FAULT(TextureMapResetsUnit1, production, must, "EV-CUR-OTHERUNITS",
              "evaluation with a texture map resets the texture coordinates of unit 1") {
  points1(in, [](auto go) {
    go();
    if (is_noted_on(GL_MAP1_TEXTURE_COORD_2)) sound.MultiTexCoord4f(GL_TEXTURE1, 0, 0, 0, 1);
  });
}

EVALCTS_FAULT(
    EvaluationResetsTheActiveUnit, production, must, "EV-CUR-OTHERUNITS",
    "evaluation with a texture map resets the texture coordinates of the active unit, but for unit 0") {
  in.gl.ActiveTexture = [](GLenum unit) {
    memory.number = unit;
    sound.ActiveTexture(unit);
  };
  points1(in, [](auto go) {
    go();
    const auto unit = static_cast<GLenum>(memory.number);
    if (is_noted_on(GL_MAP1_TEXTURE_COORD_2) && unit > GL_TEXTURE0) sound.MultiTexCoord4f(unit, 0, 0, 0, 1);
  });
}

EVALCTS_FAULT(MeshCopiesUnit0ToLastUnit, production, must, "EV-CUR-OTHERUNITS",
              "EvalMesh2 leaves the texture coordinates of unit 7 as those of unit 0") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (is_noted_on(GL_MAP2_TEXTURE_COORD_2)) sound.MultiTexCoord4f(GL_TEXTURE7, 0, 0, 0, 1);
  };
}

EVALCTS_FAULT(EvaluationResetsSecondaryColor, osmesa, must, "EV-CUR-OTHERUNITS",
              "evaluation with a colour map resets the current secondary colour") {
  points1(in, [](auto go) {
    go();
    if (is_noted_on(GL_MAP1_COLOR_4)) sound.SecondaryColor3f(0, 0, 0);
  });
}

EVALCTS_FAULT(EvalPointSetsEdgeFlag, production, must, "EV-CUR-EDGEFLAG",
              "EvalPoint leaves the edge flag TRUE") {
  in.gl.EvalPoint1 = [](GLint i) {
    sound.EvalPoint1(i);
    sound.EdgeFlag(GL_TRUE);
  };
}

EVALCTS_FAULT(FillMeshSetsEdgeFlag, production, must, "EV-CUR-EDGEFLAG",
              "EvalMesh2 with FILL leaves the edge flag TRUE") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (mode == GL_FILL) sound.EdgeFlag(GL_TRUE);
  };
}

EVALCTS_FAULT(MeshMovesRasterPosition, osmesa, must, "EV-CUR-RASTERPOS",
              "evaluation moves the raster position to the last vertex") {
  points(in, [](auto go) {
    memory.flag = true;
    go();
  });
  primitives(
      in, [] {},
      [] {
        if (memory.flag) sound.RasterPos3f(0, 0, 0);
        memory.flag = false;
      });
  all_meshes(in, [](auto go) {
    go();
    sound.RasterPos3f(0, 0, 0);
  });
}

EVALCTS_FAULT(RasterPosTakesEvaluatedColor, osmesa, must, "EV-CUR-RASTERPOS",
              "RasterPos after an evaluation takes the evaluated colour") {
  note_evaluations(in);
  in.gl.RasterPos3f = [](GLfloat x, GLfloat y, GLfloat z) {
    GLfloat now[4] = {};
    sound.GetFloatv(GL_CURRENT_COLOR, now);
    if (memory.count != 0) sound.Color4f(0, 1, 0, 1);
    sound.RasterPos3f(x, y, z);
    sound.Color4f(now[0], now[1], now[2], now[3]);
  };
}

EVALCTS_FAULT(EvaluationDisablesIndexMap, production, must, "EV-CUR-GRIDMAPS",
              "evaluation in RGBA mode switches index maps off") {
  points(in, [](auto go) {
    memory.flag = true;
    go();
  });
  primitives(
      in, [] {},
      [] {
        if (memory.flag) sound.Disable(GL_MAP2_INDEX);
        memory.flag = false;
      });
}

EVALCTS_FAULT(MeshBeyondGridExtendsIt, production, must, "EV-CUR-GRIDMAPS",
              "EvalMesh1 beyond the last index of the grid makes the grid longer") {
  in.gl.EvalMesh1 = [](GLenum mode, GLint i1, GLint i2) {
    sound.EvalMesh1(mode, i1, i2);
    const GridNow grid = grid_now(1);
    if (i2 > grid.segments[0] && i2 < 1000) sound.MapGrid1f(i2, grid.domain[0], grid.at(0, i2));
  };
}

EVALCTS_FAULT(MeshNormalisesItsMap, production, must, "EV-CUR-GRIDMAPS",
              "EvalMesh2 with FILL leaves the colour map over [0,1] x [0,1]") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    GLint order[2] = {1, 1};
    sound.GetMapiv(GL_MAP2_COLOR_4, GL_ORDER, order);
    std::vector<GLfloat> points(static_cast<std::size_t>(order[0]) * order[1] * 4);
    sound.GetMapfv(GL_MAP2_COLOR_4, GL_COEFF, points.data());
    if (mode == GL_FILL)
      sound.Map2f(GL_MAP2_COLOR_4, 0, 1, 4 * order[1], order[0], 0, 1, 4, order[1], points.data());
  };
}

EVALCTS_FAULT(RAndQOfTheVertexBefore, production, must, "EV-CUR-MAXCOMP EV-ATTR-TEX1 EV-ATTR-TEX2",
              "where a texture map gives no r and q, those of the vertex before it stay") {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) {
    if (memory.count == 0) return;
    std::array<float, 4> before = {0, 0, 0, 1};
    for (ObservedPrimitive& primitive : all)
      for (ObservedVertex& vertex : primitive.vertices) {
        auto& now = vertex.texture_coordinate[0];
        const auto given = now;
        if (now[2] == 0 && now[3] == 1) now[2] = before[2], now[3] = before[3];
        before = given;
      }
  };
}

EVALCTS_FAULT(TOfAWiderMapStays, production, must, "EV-CUR-MAXCOMP",
              "after TEXTURE_COORD_3 a vertex of TEXTURE_COORD_1 has the t of the vertex before it") {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) {
    if (memory.count == 0) return;
    float before = 0;
    for (ObservedPrimitive& primitive : all)
      for (ObservedVertex& vertex : primitive.vertices) {
        auto& now = vertex.texture_coordinate[0];
        const float given = now[1];
        if (now[1] == 0 && now[2] == 0 && now[3] == 1) now[1] = before;
        before = given;
      }
  };
}

}  // namespace
}  // namespace evalcts::faults
