// Rules of several sections that no implementation at hand follows: faults in OSMesa as repaired_osmesa.h
// makes it, or as the version that has the rule.
#include "repaired_osmesa.h"

#include <array>
#include <vector>

#include "evaluating.h"

#define REPAIRED_FAULT(name, requirements, what) \
  EVALCTS_FAULT_IN(kRepairedOSMesa, name, must, requirements, what)

namespace evalcts::faults::on_repaired_osmesa {
namespace {

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
