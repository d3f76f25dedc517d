// Faults against sections 23 and 24 of the requirements: contexts without evaluators, and extensions that
// affect evaluators.
#include "grid_steps.h"

namespace evalcts::faults::profiles_and_extensions {
namespace {

constexpr std::string_view kImplementation = "osmesa";

const Value kIsCore = kKind == EVALCTS_CORE_PROFILE;

void clear_log(Call&) {
  unmodified.GetDebugMessageLog(64, 0, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
}
// Executes a delayed Begin; kCount is its mode + 1.
Value begin_late() { return Steps{call(Begin, {kCount - 1}), set(kCount, 0)}; }

FAULT(CoreProfileIgnoresEvalPoint, "EV-PROF-CORE-FUNC",
      "EvalPoint2 does nothing in a core profile, without an error", skip(EvalPoint2, kIsCore));
FAULT(CoreProfileEnablesAutoNormal, "EV-PROF-CORE-ENABLE", "AUTO_NORMAL can be enabled in a core profile",
      skip(Enable, kName == GL_AUTO_NORMAL && kIsCore));

// Begin is delayed until the first command of its primitive.
FAULT(EvaluationSkipsVertexProgram, "EV-EXT-ARBVP-RUN",
      "a primitive that EvalCoord1f begins runs no vertex program", instead(Begin, set(kCount, kFirst + 1)),
      before(EvalCoord1f, kCount, {disable(GL_VERTEX_PROGRAM_ARB), begin_late(), set(kFlag, 1)}),
      before(Vertex4f, kCount, begin_late()),
      after(End, kFlag, {set(kFlag, 0), enable(GL_VERTEX_PROGRAM_ARB)}));
FAULT(FirstEvaluationSkipsVertexProgram, "EV-EXT-ARBVP-RUN", "Enable of VERTEX_PROGRAM loses an evaluation",
      after(Enable, kName == GL_VERTEX_PROGRAM_ARB, set(kFlag, 1)),
      instead(kEvalCoord1, kFlag, set(kFlag, 0)));
FAULT(GenericAttributeFollowsArgument, "EV-EXT-ARBVP-NOGENERIC", "EvalCoord1 sets generic attribute 6 to u",
      before(kEvalCoord1, call(VertexAttrib4f, {6, kU, 0.75, 0.25, 0.5})));
FAULT(GenericAttributeOfTheFirstVertex, "EV-EXT-ARBVP-NOGENERIC",
      "a primitive has generic attribute 6 of its first vertex", after(Begin, set(kFlag, 0)),
      before(VertexAttrib4f, kFirst == 6 && !kFlag,
             {set(kFlag, 1), keep({kSecond, kThird, kFourth, kFifth})}),
      before(kEvalCoord1, kFlag, call(VertexAttrib4f, {6, kept(0), kept(1), kept(2), kept(3)})));

namespace on_dropin {
constexpr std::string_view kImplementation = "dropin";
FAULT(CoreProfileTellsMaxEvalOrder, "EV-PROF-CORE-GET", "a core profile answers MAX_EVAL_ORDER",
      instead(GetIntegerv, kName == GL_MAX_EVAL_ORDER && kIsCore, put(0, 30)));
FAULT(CoreProfileTellsGrid, "EV-PROF-CORE-GET", "GetFloatv(MAP1_GRID_DOMAIN) answers in a core profile",
      instead(GetFloatv, kName == GL_MAP1_GRID_DOMAIN && kIsCore, answer({0, 1})));
}  // namespace on_dropin

namespace on_egl {
constexpr std::string_view kImplementation = "egl";
FAULT(ForwardCompatibleTakesMap1f, "EV-PROF-CORE-FUNC",
      "Map1f does nothing in a forward-compatible context, without an error",
      skip(Map1f, kKind == EVALCTS_FORWARD_COMPATIBLE));
FAULT(ForwardCompatibleDisablesMaps, "EV-PROF-CORE-ENABLE",
      "Disable(MAP1_COLOR_4) raises no error in a forward-compatible context",
      skip(Disable, kKind == EVALCTS_FORWARD_COMPATIBLE && kName == GL_MAP1_COLOR_4));
FAULT(NoErrorContextReportsMesh, "EV-PROF-NOERROR", "a no-error context reports a legal EvalMesh1",
      after(EvalMesh1, set(kFlag, kKind == EVALCTS_NO_ERROR)),
      instead(GetError, kFlag, {set(kFlag, 0), set(kResult, GL_INVALID_VALUE)}));
FAULT(NoErrorContextIgnoresGrid, "EV-PROF-NOERROR",
      "a no-error context skips MapGrid1f together with the checks of its arguments",
      skip(MapGrid1f, kKind == EVALCTS_NO_ERROR));
QUALITY_FAULT(MeshErrorsNotLogged, "EV-PIPE-DEBUG", "a debug context has no message for errors of EvalMesh1",
              after(EvalMesh1, !kIsMode1, clear_log));
QUALITY_FAULT(GridErrorsNotLogged, "EV-PIPE-DEBUG", "a debug context has no message for errors of MapGrid1",
              after(kMapGrid1, kSegments <= 0, clear_log));
}  // namespace on_egl

namespace on_production {
constexpr std::string_view kImplementation = "production";
FAULT(CompatibilityMeshesDrawNothing, "EV-PROF-COMPAT",
      "EvalMesh1 is there in contexts of 3.1 and later, and does nothing", skip(EvalMesh1, true));
FAULT(CompatibilityWithoutAutoNormal, "EV-PROF-COMPAT",
      "AUTO_NORMAL can be enabled in contexts of 3.1 and later, and does nothing",
      instead(Enable, kName == GL_AUTO_NORMAL, set(kFlag, 1)),
      instead(IsEnabled, kName == GL_AUTO_NORMAL, set(kResult, kFlag)));
FAULT(ActiveTextureRuleNotForMap2d, "EV-EXT-MT-RULE", "Map2d takes points regardless of the texture unit",
      on_unit_0(Map2d, true));
FAULT(ActiveTextureRuleForUnitOneOnly, "EV-EXT-MT-RULE", "under the last texture unit Map1f raises no error",
      on_unit_0(Map1f, kUnit != GL_TEXTURE1));
FAULT(LastAttributeMapTakenForVertex, "EV-EXT-UNKNOWN-TARGET", "Map1f defines MAP1_VERTEX_4 for 0x866F",
      before(Map1f, kTarget == 0x866F, set(kTarget, GL_MAP1_VERTEX_4)));
FAULT(NurbsIsDisabledSilently, "EV-EXT-UNKNOWN-TARGET",
      "Disable takes the token of SGIX_nurbs_eval without the extension", skip(Disable, kName == 0x81CB));
}  // namespace on_production

}  // namespace
}  // namespace evalcts::faults::profiles_and_extensions
