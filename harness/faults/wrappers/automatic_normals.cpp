// Section 10: normals that AUTO_NORMAL generates.
#include <cmath>

#include "evaluating.h"

namespace evalcts::faults {
namespace {

EVALCTS_FAULT(NormalMapEnabledLastWins, production, must, "EV-AUTON-OVERRIDE",
              "a normal map that was enabled after AUTO_NORMAL wins") {
  switches(in, [](GLenum cap, bool on, auto go) {
    go();
    if (cap == GL_MAP2_NORMAL && on && is_noted_on(GL_AUTO_NORMAL)) sound.Disable(GL_AUTO_NORMAL);
  });
}

EVALCTS_FAULT(AutoNormalBeforeVertexMapLost, production, must, "EV-AUTON-USED",
              "Enable of AUTO_NORMAL before that of a vertex map of surfaces has no effect") {
  switches(in, [](GLenum cap, bool on, auto go) {
    if (cap != GL_AUTO_NORMAL || !on || has_vertex_map(2)) go();
  });
}

EVALCTS_FAULT(AutoNormalSuppressesNormalMapOfCurves, production, must, "EV-AUTON-1D",
              "AUTO_NORMAL suppresses the normal map of curves") {
  switches(in, [](GLenum cap, bool, auto go) {
    go();
    if (cap != GL_AUTO_NORMAL && cap != GL_MAP1_NORMAL) return;
    is_noted_on(GL_MAP1_NORMAL) && !is_noted_on(GL_AUTO_NORMAL) ? sound.Enable(GL_MAP1_NORMAL)
                                                                : sound.Disable(GL_MAP1_NORMAL);
  });
}

EVALCTS_FAULT(NoAutoNormalOfTwoVertexMaps, production, must, "EV-AUTON-VERTEX4WINS",
              "where both vertex maps are enabled no normal is generated") {
  switches(in, [](GLenum cap, bool, auto go) {
    go();
    if (cap != GL_AUTO_NORMAL && cap != GL_MAP2_VERTEX_3 && cap != GL_MAP2_VERTEX_4) return;
    const bool both = is_noted_on(GL_MAP2_VERTEX_3) && is_noted_on(GL_MAP2_VERTEX_4);
    is_noted_on(GL_AUTO_NORMAL) && !both ? sound.Enable(GL_AUTO_NORMAL) : sound.Disable(GL_AUTO_NORMAL);
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
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    sound.EvalPoint2(i, j);
    if (is_noted_on(GL_AUTO_NORMAL) && has_vertex_map(2)) sound.Normal3f(0, 0.6f, 0.8f);
  };
}

EVALCTS_FAULT(MeshWithAutoNormalSetsNormal, production, must, "EV-AUTON-CURRENT",
              "EvalMesh2 with AUTO_NORMAL resets the current normal") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (is_noted_on(GL_AUTO_NORMAL) && has_vertex_map(2)) sound.Normal3f(0, 0, 1);
  };
}

EVALCTS_FAULT(AutoNormalNeedsNoVertexMap, production, must, "EV-AUTON-NOVERTEX",
              "AUTO_NORMAL counts as a map: EvalCoord2 draws the initial point without a vertex map") {
  points2(in, [](auto go) {
    if (is_noted_on(GL_AUTO_NORMAL) && !has_vertex_map(2)) sound.Vertex4f(0, 0, 0, 1);
    go();
  });
}

EVALCTS_FAULT(AutoNormalMeshNeedsNoVertexMap, production, must, "EV-AUTON-NOVERTEX",
              "EvalMesh2 with AUTO_NORMAL and no vertex map raises INVALID_OPERATION") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (is_noted_on(GL_AUTO_NORMAL) && !has_vertex_map(2)) sound.End();
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
    is_noted_on(GL_MAP2_TEXTURE_COORD_3) && !is_noted_on(GL_AUTO_NORMAL)
        ? sound.Enable(GL_MAP2_TEXTURE_COORD_3)
        : sound.Disable(GL_MAP2_TEXTURE_COORD_3);
  });
}

EVALCTS_FAULT(AutoNormalMovesVertexByABit, production, quality, "EV-AUTON-SAMEVERTEX EV-NUM-UNRELATEDMAPS",
              "with AUTO_NORMAL the vertex is evaluated by another path") {
  eval_coord2(in, [](auto u, auto v, auto go) {
    go(is_noted_on(GL_AUTO_NORMAL) ? std::nextafter(static_cast<float>(u), 2.0f) : u, v);
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

EVALCTS_FAULT(NormalsOfWideDomainsShort, production, must, "EV-AUTON-UNIT",
              "normals over a domain wider than 50 are divided by its width") {
  with_auto_normal(in, [](ObservedPrimitive& primitive) {
    if (memory.number > 50)
      for (ObservedVertex& vertex : primitive.vertices)
        for (float& x : vertex.normal) x /= static_cast<float>(memory.number);
  });
  map2(in, [](auto call, auto go) {
    memory.number = std::abs(static_cast<double>(call.u2) - static_cast<double>(call.u1));
    go(call);
  });
}

EVALCTS_FAULT(NormalMapReadAfterAutoNormal, production, must, "EV-AUTON-OVERRIDE",
              "AUTO_NORMAL switched on a second time does not go before the normal map") {
  switches(in, [](GLenum cap, bool on, auto go) {
    if (cap == GL_AUTO_NORMAL && on && is_noted_on(GL_MAP2_NORMAL) && ++memory.count > 1) return;
    go();
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

EVALCTS_FAULT(NormalsOfTallPatchesTurned, production, must, "EV-AUTON-DIRECTION",
              "where the order in v is above that in u, the normal is dp/dv x dp/du") {
  with_auto_normal(in, [](ObservedPrimitive& primitive) {
    if (memory.count != 0)
      for (ObservedVertex& vertex : primitive.vertices)
        for (float& x : vertex.normal) x = -x;
  });
  map2(in, [](auto call, auto go) {
    if (call.target == GL_MAP2_VERTEX_3 && call.vorder > call.uorder) memory.count = 1;
    go(call);
  });
}

EVALCTS_FAULT(VertexAfterDegenerateOneLost, production, must, "EV-AUTON-DEGENERATE",
              "the vertex after one whose normal has length 0 is lost") {
  with_auto_normal(in, [](ObservedPrimitive& primitive) {
    auto& all = primitive.vertices;
    for (std::size_t i = 1; i < all.size(); ++i)
      if (all[i - 1].normal == std::array<float, 3>{0, 0, 0}) return void(all.erase(all.begin() + 1));
  });
}

EVALCTS_FAULT(NoNormalsOverReversedDomains, production, must, "EV-AUTON-CURVED",
              "over a domain that is reversed in v the normal is (0,0,1)") {
  with_auto_normal(in, [](ObservedPrimitive& primitive) {
    if (memory.count != 0)
      for (ObservedVertex& vertex : primitive.vertices) vertex.normal = {0, 0, 1};
  });
  map2(in, [](auto call, auto go) {
    if (call.v1 > call.v2) memory.count = 1;
    go(call);
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
  map2(in, [](auto call, auto go) {
    if (call.target == GL_MAP2_VERTEX_4) memory.flag = call.vorder == 1;
    go(call);
  });
  points2(in, [](auto go) {
    if (is_noted_on(GL_AUTO_NORMAL) && is_noted_on(GL_MAP2_VERTEX_4) && memory.flag) raise_inside();
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

EVALCTS_FAULT(NormalsInCoarseSteps, production, quality, "EV-AUTON-METHOD",
              "components of generated normals are rounded to multiples of 1/150") {
  note_evaluations(in);
  in.emitted = [](std::vector<ObservedPrimitive>& all) { pack_normals(all, 150); };
}

// As it comes through the pipeline; the explicit control has no AUTO_NORMAL.
EVALCTS_FAULT(GeneratedNormalsNotRescaled, osmesa, must, "EV-AUTON-FFTRANSFORM",
              "RESCALE_NORMAL has no effect on generated normals, which are units already") {
  primitives(
      in,
      [] {
        if (is_noted_on(GL_AUTO_NORMAL)) sound.Disable(GL_RESCALE_NORMAL);
      },
      [] {
        if (is_noted_on(GL_RESCALE_NORMAL)) sound.Enable(GL_RESCALE_NORMAL);
      });
}

EVALCTS_FAULT(GeneratedNormalsAlwaysNormalized, osmesa, must, "EV-AUTON-FFTRANSFORM",
              "generated normals are normalised in eye space") {
  primitives(
      in,
      [] {
        if (is_noted_on(GL_AUTO_NORMAL)) sound.Enable(GL_NORMALIZE);
      },
      [] {
        if (!is_noted_on(GL_NORMALIZE)) sound.Disable(GL_NORMALIZE);
      });
}

// --- With a vertex shader or a vertex program --------------------------------------------------------------

bool has_shader() {
  GLint program = 0;
  sound.GetIntegerv(GL_CURRENT_PROGRAM, &program);
  return program != 0 || sound.IsEnabled(GL_VERTEX_PROGRAM_ARB);
}

EVALCTS_FAULT(NoAutoNormalWithShader, dropin, must, "EV-AUTON-SHADER EV-AUTON-VP",
              "no normal is generated while a vertex shader or a vertex program is active") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = sound.IsEnabled(GL_AUTO_NORMAL) && has_shader();
    if (memory.flag) sound.Disable(GL_AUTO_NORMAL);
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.flag) sound.Enable(GL_AUTO_NORMAL);
  };
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const bool off = sound.IsEnabled(GL_AUTO_NORMAL) && has_shader();
    if (off) sound.Disable(GL_AUTO_NORMAL);
    sound.EvalMesh2(mode, i1, i2, j1, j2);
    if (off) sound.Enable(GL_AUTO_NORMAL);
  };
}

// As if u ran twice as fast: nothing but the length of m changes.
EVALCTS_FAULT(NormalsForShaderTooShort, dropin, must, "EV-AUTON-SHADER EV-AUTON-VP",
              "with a vertex shader or a vertex program generated normals have half their length") {
  map2(in, [](auto call, auto go) {
    call.u1 *= 2;
    call.u2 *= 2;
    go(call);
  });
  eval_coord2(in, [](auto u, auto v, auto go) { go(2 * u, v); });
  in.gl.MapGrid2f = [](GLint un, GLfloat u1, GLfloat u2, GLint vn, GLfloat v1, GLfloat v2) {
    sound.MapGrid2f(un, 2 * u1, 2 * u2, vn, v1, v2);
  };
  in.gl.MapGrid2d = [](GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2) {
    sound.MapGrid2d(un, 2 * u1, 2 * u2, vn, v1, v2);
  };
}

}  // namespace
}  // namespace evalcts::faults
