// Faults against requirements of several sections that no available implementation meets. They are put into
// a repaired OSMesa, or into the version of Mesa that has the requirement.
#include "grid_steps.h"

namespace evalcts::faults::repaired_osmesa {
namespace {

// --- Repairs -----------------------------------------------------------------------------------------------

// The repairs are needed because no available implementation, not even `dropin`, satisfies these
// requirements: edge flags of filled meshes, which are quad strips whose edges are all boundary edges, and
// CopyContext of two attribute groups. They affect the commands that the plain deliveries of the
// requirements' tests use. Only tests that pass on the repaired implementation count.

// Flush: without it, Mesa ignores a flag that is set just before the vertices.
Value begin_with_flag(Value mode) {
  return Steps{set(kFlag, state(GL_EDGE_FLAG)), when(mode == GL_QUAD_STRIP, call(EdgeFlag, {GL_TRUE})),
               call(Flush)};
}
const Value kRestoreFlag = Steps{call(Flush), call(EdgeFlag, {kFlag})};
const Value kRepairedStrip =
    Steps{begin_with_flag(GL_QUAD_STRIP),
          primitive(GL_QUAD_STRIP, loop(kColumn, kI1, kI2, {point(kColumn, kRow), point(kColumn, kRow + 1)})),
          kRestoreFlag};

void copy_context(Call& call) {
  const auto from = static_cast<GLuint>(kFirst(call)), to = static_cast<GLuint>(kSecond(call));
  std::vector<State> states;
  if ((kThird & GL_COLOR_BUFFER_BIT).holds(call)) states.push_back(current(ClearColor, GL_COLOR_CLEAR_VALUE));
  if ((kThird & GL_EVAL_BIT).holds(call)) {
    for (const GLenum target : gl::kMap1Targets) states.push_back(enable_of(target));
    for (const GLenum target : gl::kMap2Targets) states.push_back(enable_of(target));
    states.insert(states.end(), {enable_of(GL_AUTO_NORMAL), grid1_state(), grid2_state()});
  }
  unmodified.OtherContextEVALCTS(from);
  std::vector<Restore> restores;
  for (const State& state : states) restores.push_back(state());
  unmodified.OtherContextEVALCTS(to);
  for (const Restore& restore : restores) restore();
  unmodified.OtherContextEVALCTS(from);
}

const Registration kRepairs{{kRepairedOSMesa, kRepair, "osmesa", Level::kMust, "",
                             "edge flags of filled meshes, and CopyContext", [] {
                               return Rules{before(Begin, !kInside, {set(kCount, 1), begin_with_flag(kMode)}),
                                            after(End, kCount, {set(kCount, 0), kRestoreFlag}),
                                            instead(EvalMesh2, kMode == GL_FILL && !kInside,
                                                    loop(kRow, kJ1, kJ2 - 1, kRepairedStrip)),
                                            provide(CopyContextEVALCTS, copy_context)};
                             }}};

// --- Faults ------------------------------------------------------------------------------------------------

constexpr std::string_view kImplementation = kRepairedOSMesa;

FAULT(FilledMeshOfSeparateQuads, "EV-MESH2-EDGEFLAG",
      "EvalMesh2 with FILL draws separate quads, whose edges have the edge flag",
      instead(EvalMesh2, kMode == GL_FILL, draw_quads(GL_QUADS, {0, 1, 2, 3})));

// --- Copies of contexts ------------------------------------------------------------------------------------

FAULT(CopyLacksAutoNormal, "EV-CTX-COPY", "CopyContext of EVAL_BIT leaves AUTO_NORMAL out",
      after(CopyContextEVALCTS,
            {call(OtherContextEVALCTS, {kSecond}), when(kThird& GL_EVAL_BIT, disable(GL_AUTO_NORMAL)),
             call(OtherContextEVALCTS, {kFirst})}));
FAULT(CopyLacksSegments, "EV-CTX-COPY", "CopyContext of EVAL_BIT does not copy how many segments grids have",
      after(CopyContextEVALCTS, {call(OtherContextEVALCTS, {kSecond}),
                                 call(MapGrid2f, {1, grid2(1), grid2(2), 1, grid2(4), grid2(5)}),
                                 call(OtherContextEVALCTS, {kFirst})}));
FAULT(CopyDefinesMap, "EV-CTX-COPY-NOMAPS", "CopyContext defines the map of positions of the copy",
      after(CopyContextEVALCTS, {call(OtherContextEVALCTS, {kSecond}), define(GL_MAP1_VERTEX_3, {1, 2, 3}),
                                 call(OtherContextEVALCTS, {kFirst})}));

namespace on_osmesa_30 {
constexpr std::string_view kImplementation = kOSMesa30;
FAULT(DeprecatedMapIsGone, "EV-PROF-DEPRECATED", "Enable does not know MAP2_NORMAL, since that is deprecated",
      instead(Enable, kName == GL_MAP2_NORMAL, error(GL_INVALID_ENUM)));
FAULT(DeprecatedMeshDoesNothing, "EV-PROF-DEPRECATED", "EvalMesh2 does nothing, since it is deprecated",
      skip(EvalMesh2, true));
}  // namespace on_osmesa_30

}  // namespace
}  // namespace evalcts::faults::repaired_osmesa
