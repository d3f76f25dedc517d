// Section 10: normals that AUTO_NORMAL generates.
#include <cmath>

#include "harness/faults/evaluating.h"

namespace evalcts::faults {
namespace {

EVALCTS_FAULT(NormalMapEnabledLastWins, production, must, "EV-AUTON-OVERRIDE",
              "a normal map that was enabled after AUTO_NORMAL wins") {
  switches(in, [](GLenum cap, bool on, auto go) {
    go();
    if (cap == GL_MAP2_NORMAL && on && is_on(GL_AUTO_NORMAL)) sound.Disable(GL_AUTO_NORMAL);
  });
}

EVALCTS_FAULT(NormalMapLostAfterAutoNormal, production, must, "EV-AUTON-OFF-MAP",
              "Disable of AUTO_NORMAL disables the normal map") {
  switches(in, [](GLenum cap, bool on, auto go) {
    go();
    if (cap == GL_AUTO_NORMAL && !on) sound.Disable(GL_MAP2_NORMAL);
  });
}

EVALCTS_FAULT(DisableOfAutoNormalResetsNormal, production, must, "EV-AUTON-OFF-NONE",
              "Disable of AUTO_NORMAL resets the current normal") {
  switches(in, [](GLenum cap, bool on, auto go) {
    go();
    if (cap == GL_AUTO_NORMAL && !on) sound.Normal3f(0, 0, 1);
  });
}

EVALCTS_FAULT(GeneratedNormalStaysCurrent, production, must, "EV-AUTON-CURRENT",
              "EvalPoint2 with AUTO_NORMAL leaves a normal of its own as the current one") {
  note_switches(in);
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    sound.EvalPoint2(i, j);
    if (is_on(GL_AUTO_NORMAL) && has_vertex_map(2)) sound.Normal3f(0, 0.6f, 0.8f);
  };
}

EVALCTS_FAULT(MeshWithAutoNormalSetsNormal, production, must, "EV-AUTON-CURRENT",
              "EvalMesh2 with AUTO_NORMAL resets the current normal") {
  note_switches(in);
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (is_on(GL_AUTO_NORMAL) && has_vertex_map(2)) sound.Normal3f(0, 0, 1);
  };
}

EVALCTS_FAULT(AutoNormalNeedsNoVertexMap, production, must, "EV-AUTON-NOVERTEX",
              "AUTO_NORMAL counts as a map: EvalCoord2 draws the initial point without a vertex map") {
  note_switches(in);
  points2(in, [](auto go) {
    if (is_on(GL_AUTO_NORMAL) && !has_vertex_map(2)) sound.Vertex4f(0, 0, 0, 1);
    go();
  });
}

EVALCTS_FAULT(AutoNormalMeshNeedsNoVertexMap, production, must, "EV-AUTON-NOVERTEX",
              "EvalMesh2 with AUTO_NORMAL and no vertex map raises INVALID_OPERATION") {
  note_switches(in);
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (is_on(GL_AUTO_NORMAL) && !has_vertex_map(2)) sound.End();
    sound.EvalMesh2(mode, i1, i2, j1, j2);
  };
}

EVALCTS_FAULT(AutoNormalDividesByW, production, must, "EV-AUTON-SAMEVERTEX",
              "with AUTO_NORMAL the vertex goes out divided by w") {
  switches(in, [](GLenum cap, bool, auto go) {
    go();
    if (cap == GL_AUTO_NORMAL) memory.flag = true;
  });
  in.emitted = [](std::vector<ObservedPrimitive>& all) {
    if (!memory.flag) return;
    for (ObservedPrimitive& primitive : all)
      for (ObservedVertex& vertex : primitive.vertices) {
        const float w = vertex.position[3];
        if (w != 0)
          for (float& x : vertex.position) x /= w;
      }
  };
}

EVALCTS_FAULT(AutoNormalDropsTextureMap, production, must, "EV-AUTON-SAMEVERTEX",
              "with AUTO_NORMAL there is no room for TEXTURE_COORD_3 in the vertex") {
  switches(in, [](GLenum cap, bool, auto go) {
    go();
    if (cap != GL_AUTO_NORMAL && cap != GL_MAP2_TEXTURE_COORD_3) return;
    is_on(GL_MAP2_TEXTURE_COORD_3) && !is_on(GL_AUTO_NORMAL) ? sound.Enable(GL_MAP2_TEXTURE_COORD_3)
                                                             : sound.Disable(GL_MAP2_TEXTURE_COORD_3);
  });
}

EVALCTS_FAULT(AutoNormalMovesVertexByABit, production, quality, "EV-AUTON-SAMEVERTEX EV-NUM-UNRELATEDMAPS",
              "with AUTO_NORMAL the vertex is evaluated by another path") {
  note_switches(in);
  eval_coord2(in, [](auto u, auto v, auto go) {
    go(is_on(GL_AUTO_NORMAL) ? std::nextafter(static_cast<float>(u), 2.0f) : u, v);
  });
}

// Calls body(primitive) with what comes out once AUTO_NORMAL was enabled.
template <class Body>
void with_auto_normal(Injection& in, Body) {
  switches(in, [](GLenum cap, bool on, auto go) {
    go();
    if (cap == GL_AUTO_NORMAL && on) memory.flag = true;
  });
  in.emitted = [](std::vector<ObservedPrimitive>& all) {
    for (ObservedPrimitive& primitive : all)
      if (memory.flag) Body{}(primitive);
  };
}

EVALCTS_FAULT(OneNormalForThePrimitive, production, must, "EV-AUTON-USED EV-AUTON-CURVED",
              "the normal of its first vertex is that of a whole primitive") {
  with_auto_normal(in, [](ObservedPrimitive& primitive) {
    for (ObservedVertex& vertex : primitive.vertices) vertex.normal = primitive.vertices[0].normal;
  });
}

EVALCTS_FAULT(NormalsTowardsTheViewer, production, must, "EV-AUTON-DIRECTION",
              "generated normals that point away from the viewer are turned round") {
  with_auto_normal(in, [](ObservedPrimitive& primitive) {
    for (ObservedVertex& vertex : primitive.vertices)
      if (vertex.normal[2] < 0)
        for (float& x : vertex.normal) x = -x;
  });
}

EVALCTS_FAULT(VertexWithoutNormalLost, production, must, "EV-AUTON-DEGENERATE",
              "a vertex whose normal has length 0 is not drawn") {
  with_auto_normal(in, [](ObservedPrimitive& primitive) {
    std::erase_if(primitive.vertices, [](const ObservedVertex& vertex) {
      return vertex.normal == std::array<float, 3>{0, 0, 0};
    });
  });
}

EVALCTS_FAULT(LineMeshesHaveNoNormals, production, must, "EV-AUTON-MESH",
              "AUTO_NORMAL has no effect on EvalMesh2 with LINE") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const bool on = sound.IsEnabled(GL_AUTO_NORMAL);
    if (on && mode == GL_LINE) sound.Disable(GL_AUTO_NORMAL);
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (on && mode == GL_LINE) sound.Enable(GL_AUTO_NORMAL);
  };
}

EVALCTS_FAULT(PatchOfOrderOneIsAnError, production, must, "EV-AUTON-DEGENERATE",
              "with AUTO_NORMAL, EvalCoord2 of a patch of order 1 in v raises INVALID_OPERATION") {
  note_switches(in);
  map2(in, [](auto call, auto go) {
    if (call.target == GL_MAP2_VERTEX_4) memory.flag = call.vorder == 1;
    go(call);
  });
  points2(in, [](auto go) {
    if (is_on(GL_AUTO_NORMAL) && is_on(GL_MAP2_VERTEX_4) && memory.flag) raise_inside();
    go();
  });
}

namespace {

void pack_normals(std::vector<ObservedPrimitive>& all, float levels) {
  if (memory.count == 0) return;
  for (ObservedPrimitive& primitive : all)
    for (ObservedVertex& vertex : primitive.vertices)
      for (float& x : vertex.normal)
        if (std::abs(x) <= 1) x = std::round(x * levels) / levels;
}

}  // namespace

EVALCTS_FAULT(NormalsPackedInBytes, production, must, "EV-AUTON-METHOD EV-AUTON-CURVED",
              "generated normals are packed in 7 bits a component") {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) { pack_normals(all, 63); };
}

EVALCTS_FAULT(NormalsPackedInNineBits, production, quality, "EV-AUTON-METHOD",
              "generated normals are packed in 9 bits a component") {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) { pack_normals(all, 255); };
}

// As it comes through the pipeline; the explicit control has no AUTO_NORMAL.
EVALCTS_FAULT(GeneratedNormalsNotRescaled, osmesa, must, "EV-AUTON-FFTRANSFORM",
              "RESCALE_NORMAL has no effect on generated normals, which are units already") {
  note_switches(in);
  primitives(
      in,
      [] {
        if (is_on(GL_AUTO_NORMAL)) sound.Disable(GL_RESCALE_NORMAL);
      },
      [] {
        if (is_on(GL_RESCALE_NORMAL)) sound.Enable(GL_RESCALE_NORMAL);
      });
}

EVALCTS_FAULT(GeneratedNormalsAlwaysNormalized, osmesa, must, "EV-AUTON-FFTRANSFORM",
              "generated normals are normalised in eye space") {
  note_switches(in);
  primitives(
      in,
      [] {
        if (is_on(GL_AUTO_NORMAL)) sound.Enable(GL_NORMALIZE);
      },
      [] {
        if (!is_on(GL_NORMALIZE)) sound.Disable(GL_NORMALIZE);
      });
}

}  // namespace
}  // namespace evalcts::faults
