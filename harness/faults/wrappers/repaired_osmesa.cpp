// Rules of several sections that no implementation at hand follows: faults in OSMesa as repaired_osmesa.h
// makes it, or as the version that has the rule.
#include "harness/faults/repaired_osmesa.h"

#include <array>
#include <vector>

#include "harness/faults/evaluating.h"

#define REPAIRED_FAULT(name, requirements, what) \
  EVALCTS_FAULT_IN(kRepairedOSMesa, name, must, requirements, what)

namespace evalcts::faults::on_repaired_osmesa {
namespace {

bool is_on(GLenum cap) { return sound.IsEnabled(cap) == GL_TRUE; }

// --- Normals with a vertex program -------------------------------------------------------------------------

REPAIRED_FAULT(NormalsOfShadersAreUnits, "EV-AUTON-SHADER",
               "generated normals are normalised for shaders, too") {
  in.gl.Begin = [](GLenum mode) {
    GLint program = 0;
    sound.GetIntegerv(GL_CURRENT_PROGRAM, &program);
    memory.flag = program != 0;
    sound.Begin(mode);
  };
  in.gl.EvalCoord2f = [](GLfloat u, GLfloat v) {
    memory.flag ? unrepaired().EvalCoord2f(u, v) : sound.EvalCoord2f(u, v);
  };
}

REPAIRED_FAULT(NormalsOfVertexProgramsAreUnits, "EV-AUTON-VP",
               "generated normals are normalised for vertex programs, too") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = is_on(GL_VERTEX_PROGRAM_ARB);
    sound.Begin(mode);
  };
  in.gl.EvalCoord2f = [](GLfloat u, GLfloat v) {
    memory.flag ? unrepaired().EvalCoord2f(u, v) : sound.EvalCoord2f(u, v);
  };
}

// --- Colours that materials track --------------------------------------------------------------------------

REPAIRED_FAULT(TrackedMaterialKeepsColor, "EV-CMAT-NOSTATE",
               "after an evaluation GetMaterial tells the evaluated colour of what tracks it") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = is_on(GL_COLOR_MATERIAL);
    sound.Begin(mode);
  };
  points(in, [](auto go) {
    memory.count += memory.flag;
    go();
  });
  in.gl.GetMaterialfv = [](GLenum face, GLenum property, GLfloat* values) {
    sound.GetMaterialfv(face, property, values);
    GLint tracked = 0;
    sound.GetIntegerv(GL_COLOR_MATERIAL_PARAMETER, &tracked);
    if (memory.count && (static_cast<GLenum>(tracked) == property ||
                         (tracked == GL_AMBIENT_AND_DIFFUSE && property == GL_DIFFUSE)))
      values[0] = 1;
  };
}

REPAIRED_FAULT(TrackedColorBecomesCurrent, "EV-CMAT-NOCURRENT",
               "an evaluated colour that a material tracks becomes the current one") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = is_on(GL_COLOR_MATERIAL);
    sound.Begin(mode);
  };
  points(in, [](auto go) {
    go();
    if (memory.flag) sound.Color4f(1, 0.5f, 0, 1);
  });
}

REPAIRED_FAULT(NextVertexHasTrackedColor, "EV-CMAT-NEXT",
               "a vertex behind an evaluation is lit with the colour that was tracked there") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = is_on(GL_COLOR_MATERIAL);
    memory.numbers.assign(4, 0);
    sound.GetDoublev(GL_CURRENT_COLOR, memory.numbers.data());
    sound.Begin(mode);
  };
  points(in, [](auto go) {
    go();
    if (memory.flag) sound.Color4f(1, 0.5f, 0, 1);
  });
  in.gl.End = [] {
    if (memory.flag) sound.Color4dv(memory.numbers.data());
    sound.End();
  };
}

// --- Filled meshes -----------------------------------------------------------------------------------------

// body(i, j): a vertex of it.
template <class Vertex>
void filled(GLenum mode, GLenum as, GLint i1, GLint i2, GLint j1, GLint j2, Vertex vertex) {
  if (mode != GL_FILL) return sound.EvalMesh2(mode, i1, i2, j1, j2);
  for (GLint j = j1; j < j2; ++j) {
    sound.Begin(as);
    for (GLint i = i1; i <= i2; ++i) vertex(i, j);
    sound.End();
  }
}

REPAIRED_FAULT(FilledMeshOfTriangles, "EV-MESH2-ISQUADS EV-MESH2-FLAT",
               "EvalMesh2 with FILL draws triangle strips") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    filled(mode, GL_TRIANGLE_STRIP, i1, i2, j1, j2, [](GLint i, GLint j) {
      sound.EvalPoint2(i, j);
      sound.EvalPoint2(i, j + 1);
    });
  };
}

REPAIRED_FAULT(FlatQuadsByAnotherCorner, "EV-MESH2-FLAT EV-MESH2-FLAT-FIRST",
               "EvalMesh2 with FILL begins its strips with the upper row") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    filled(mode, GL_QUAD_STRIP, i1, i2, j1, j2, [](GLint i, GLint j) {
      sound.EvalPoint2(i, j + 1);
      sound.EvalPoint2(i, j);
    });
  };
}

REPAIRED_FAULT(FilledMeshOfSeparateQuads, "EV-MESH2-EDGEFLAG",
               "EvalMesh2 with FILL draws separate quads, whose edges have the edge flag") {
  in.gl.EvalMesh2 = [](GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    if (mode != GL_FILL) return sound.EvalMesh2(mode, i1, i2, j1, j2);
    sound.Begin(GL_QUADS);
    for (GLint j = j1; j < j2; ++j)
      for (GLint i = i1; i < i2; ++i) {
        sound.EvalPoint2(i, j);
        sound.EvalPoint2(i, j + 1);
        sound.EvalPoint2(i + 1, j + 1);
        sound.EvalPoint2(i + 1, j);
      }
    sound.End();
  };
}

// --- Profiles ----------------------------------------------------------------------------------------------

REPAIRED_FAULT(CoreHasMaxEvalOrder, "EV-PROF-CORE-GET",
               "GetDoublev answers for MAX_EVAL_ORDER in any profile") {
  in.gl.GetDoublev = [](GLenum name, GLdouble* values) {
    if (name != GL_MAX_EVAL_ORDER) return sound.GetDoublev(name, values);
    values[0] = 8;
  };
}

REPAIRED_FAULT(CoreAnswersForAMap, "EV-PROF-CORE-GET", "GetBooleanv answers for MAP2_INDEX in any profile") {
  in.gl.GetBooleanv = [](GLenum name, GLboolean* values) {
    if (name != GL_MAP2_INDEX) return sound.GetBooleanv(name, values);
    values[0] = GL_FALSE;
  };
}

EVALCTS_FAULT_IN(kOSMesa30, DeprecatedMapIsGone, must, "EV-PROF-DEPRECATED",
                 "Enable does not know MAP2_NORMAL, since that is deprecated") {
  in.gl.Enable = [](GLenum cap) { cap == GL_MAP2_NORMAL ? raise_invalid_enum() : sound.Enable(cap); };
}

EVALCTS_FAULT_IN(kOSMesa30, DeprecatedMeshDoesNothing, must, "EV-PROF-DEPRECATED",
                 "EvalMesh2 does nothing, since it is deprecated") {
  in.gl.EvalMesh2 = [](GLenum, GLint, GLint, GLint, GLint) {};
}

// --- Copies of contexts ------------------------------------------------------------------------------------

REPAIRED_FAULT(CopyLacksAutoNormal, "EV-CTX-COPY", "CopyContext of EVAL_BIT leaves AUTO_NORMAL out") {
  in.gl.CopyContextEVALCTS = [](GLuint from, GLuint to, GLbitfield mask) {
    sound.CopyContextEVALCTS(from, to, mask);
    sound.OtherContextEVALCTS(to);
    if (mask & GL_EVAL_BIT) sound.Disable(GL_AUTO_NORMAL);
    sound.OtherContextEVALCTS(from);
  };
}

REPAIRED_FAULT(CopyLacksSegments, "EV-CTX-COPY",
               "CopyContext of EVAL_BIT does not copy how many segments grids have") {
  in.gl.CopyContextEVALCTS = [](GLuint from, GLuint to, GLbitfield mask) {
    sound.CopyContextEVALCTS(from, to, mask);
    sound.OtherContextEVALCTS(to);
    std::array<GLfloat, 4> domain{};
    sound.GetFloatv(GL_MAP2_GRID_DOMAIN, domain.data());
    sound.MapGrid2f(1, domain[0], domain[1], 1, domain[2], domain[3]);
    sound.OtherContextEVALCTS(from);
  };
}

REPAIRED_FAULT(CopyTakesMapsAlong, "EV-CTX-COPY-NOMAPS", "CopyContext copies the map of positions, too") {
  in.gl.CopyContextEVALCTS = [](GLuint from, GLuint to, GLbitfield mask) {
    constexpr GLint kComponents = 3;
    GLint order = 0;
    std::array<GLfloat, 2> domain{};
    sound.OtherContextEVALCTS(from);
    sound.GetMapiv(GL_MAP1_VERTEX_3, GL_ORDER, &order);
    sound.GetMapfv(GL_MAP1_VERTEX_3, GL_DOMAIN, domain.data());
    std::vector<GLfloat> points(static_cast<std::size_t>(order * kComponents));
    sound.GetMapfv(GL_MAP1_VERTEX_3, GL_COEFF, points.data());
    sound.CopyContextEVALCTS(from, to, mask);
    sound.OtherContextEVALCTS(to);
    sound.Map1f(GL_MAP1_VERTEX_3, domain[0], domain[1], kComponents, order, points.data());
    sound.OtherContextEVALCTS(from);
  };
}

}  // namespace
}  // namespace evalcts::faults::on_repaired_osmesa
