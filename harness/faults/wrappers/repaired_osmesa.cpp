// Faults against requirements of several sections that no available implementation meets. They are put into
// the OSMesa of repaired_osmesa.h, or into the version of Mesa that has the requirement.
#include "repaired_osmesa.h"

#include "grid_steps.h"

#define REPAIRED_RULES(name, requirements, what, ...) \
  EVALCTS_RULES_IN(kRepairedOSMesa, name, kMust, requirements, what, __VA_ARGS__)

namespace evalcts::faults::on_repaired_osmesa {
namespace {

REPAIRED_RULES(FilledMeshOfSeparateQuads, "EV-MESH2-EDGEFLAG",
               "EvalMesh2 with FILL draws separate quads, whose edges have the edge flag",
               instead(EvalMesh2, kMode == GL_FILL, draw_quads(GL_QUADS, {0, 1, 2, 3})));

// --- Profiles ----------------------------------------------------------------------------------------------

EVALCTS_RULES_IN(kOSMesa30, DeprecatedMapIsGone, kMust, "EV-PROF-DEPRECATED",
                 "Enable does not know MAP2_NORMAL, since that is deprecated",
                 instead(Enable, kName == GL_MAP2_NORMAL, error(GL_INVALID_ENUM)));
EVALCTS_RULES_IN(kOSMesa30, DeprecatedMeshDoesNothing, kMust, "EV-PROF-DEPRECATED",
                 "EvalMesh2 does nothing, since it is deprecated", skip(EvalMesh2, true));

// --- Copies of contexts ------------------------------------------------------------------------------------

REPAIRED_RULES(CopyLacksAutoNormal, "EV-CTX-COPY", "CopyContext of EVAL_BIT leaves AUTO_NORMAL out",
               after(CopyContextEVALCTS, {call(OtherContextEVALCTS, {kSecond}),
                                          when(kThird& GL_EVAL_BIT, disable(GL_AUTO_NORMAL)),
                                          call(OtherContextEVALCTS, {kFirst})}));
REPAIRED_RULES(CopyLacksSegments, "EV-CTX-COPY",
               "CopyContext of EVAL_BIT does not copy how many segments grids have",
               after(CopyContextEVALCTS, {call(OtherContextEVALCTS, {kSecond}),
                                          call(MapGrid2f, {1, grid2(1), grid2(2), 1, grid2(4), grid2(5)}),
                                          call(OtherContextEVALCTS, {kFirst})}));
REPAIRED_RULES(CopyTakesMapsAlong, "EV-CTX-COPY-NOMAPS", "CopyContext copies the map of positions, too",
               instead(CopyContextEVALCTS, [](Call& c) {
                 const auto from = static_cast<GLuint>(c.argument('0')),
                            to = static_cast<GLuint>(c.argument('1'));
                 unmodified.OtherContextEVALCTS(from);
                 const Map map = current_map(GL_MAP1_VERTEX_3);
                 c.go();
                 unmodified.OtherContextEVALCTS(to);
                 map.define();
                 unmodified.OtherContextEVALCTS(from);
               }));

}  // namespace
}  // namespace evalcts::faults::on_repaired_osmesa
