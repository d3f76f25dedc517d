// Faults against sections 23 and 24 of the requirements: contexts without evaluators, and extensions that
// affect evaluators.
#include <algorithm>

#include "grid_steps.h"

namespace evalcts::faults::profiles_and_extensions {
namespace {

const Value kIsCore = kKind == EVALCTS_CORE_PROFILE;

// Executes a delayed Begin; kCount is its mode + 1.
Value begin_late() { return Steps{call(Begin, {kCount - 1}), set(kCount, 0)}; }

// --- Profiles ----------------------------------------------------------------------------------------------

EVALCTS_RULES(CoreProfileAnswersGetMap, osmesa, kMust, "EV-PROF-CORE-FUNC",
              "GetMapiv raises no error in a core profile", instead(GetMapiv, kIsCore, put(0, 1)));
EVALCTS_RULES(CoreProfileIgnoresEvalPoint, osmesa, kMust, "EV-PROF-CORE-FUNC",
              "EvalPoint2 does nothing in a core profile, without an error", skip(EvalPoint2, kIsCore));
EVALCTS_RULES(CoreProfileGridIsInvalidValue, osmesa, kMust, "EV-PROF-CORE-FUNC",
              "MapGrid1d raises INVALID_VALUE in a core profile",
              instead(MapGrid1d, kIsCore, call(Viewport, {0, 0, -1, -1})));
EVALCTS_RULES(CoreProfileEnablesAutoNormal, osmesa, kMust, "EV-PROF-CORE-ENABLE",
              "AUTO_NORMAL can be enabled in a core profile",
              skip(Enable, kName == GL_AUTO_NORMAL && kIsCore));
EVALCTS_RULES(CoreProfileTellsIndexMap, osmesa, kMust, "EV-PROF-CORE-ENABLE",
              "IsEnabled(MAP2_INDEX) raises no error in a core profile",
              instead(IsEnabled, kName == GL_MAP2_INDEX && kIsCore, set(kResult, GL_FALSE)));
EVALCTS_RULES(CoreProfileDisableIsInvalidOperation, osmesa, kMust, "EV-PROF-CORE-ENABLE",
              "Disable of a map raises INVALID_OPERATION in a core profile",
              instead(Disable, is_map(kName) && kIsCore, call(EvalPoint1, {0})));
EVALCTS_RULES(CoreProfileTellsMaxEvalOrder, dropin, kMust, "EV-PROF-CORE-GET",
              "GetIntegerv(MAX_EVAL_ORDER) answers in a core profile",
              instead(GetIntegerv, kName == GL_MAX_EVAL_ORDER && kIsCore, put(0, 30)));
EVALCTS_RULES(CoreProfileTellsGrid, dropin, kMust, "EV-PROF-CORE-GET",
              "GetFloatv(MAP1_GRID_DOMAIN) answers in a core profile",
              instead(GetFloatv, kName == GL_MAP1_GRID_DOMAIN && kIsCore, answer({0, 1})));

EVALCTS_RULES(ForwardCompatibleTakesMap1f, egl, kMust, "EV-PROF-CORE-FUNC",
              "Map1f does nothing in a forward-compatible context, without an error",
              skip(Map1f, kKind == EVALCTS_FORWARD_COMPATIBLE));
EVALCTS_RULES(ForwardCompatibleDisablesMaps, egl, kMust, "EV-PROF-CORE-ENABLE",
              "Disable(MAP1_COLOR_4) raises no error in a forward-compatible context",
              skip(Disable, kKind == EVALCTS_FORWARD_COMPATIBLE && kName == GL_MAP1_COLOR_4));

EVALCTS_RULES(NoErrorContextReportsMesh, egl, kMust, "EV-PROF-NOERROR",
              "a legal EvalMesh1 is reported as an error in a no-error context",
              after(EvalMesh1, set(kFlag, kKind == EVALCTS_NO_ERROR)),
              instead(GetError, kFlag, {set(kFlag, 0), set(kResult, GL_INVALID_VALUE)}));
EVALCTS_RULES(NoErrorContextIgnoresGrid, egl, kMust, "EV-PROF-NOERROR",
              "a no-error context skips MapGrid1f together with the checks of its arguments",
              skip(MapGrid1f, kKind == EVALCTS_NO_ERROR));
EVALCTS_RULES(MeshErrorsNotLogged, egl, kQuality, "EV-PIPE-DEBUG",
              "a debug context has no message for errors of EvalMesh1",
              after(EvalMesh1, !kIsMode1, [](Call&) {
                unmodified.GetDebugMessageLog(64, 0, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
              }));
EVALCTS_RULES(GridErrorsLoggedAsOthers, egl, kQuality, "EV-PIPE-DEBUG",
              "the message for an error of MapGrid is of type DEBUG_TYPE_OTHER",
              after(kMapGrid1, set(kFlag, kSegments <= 0)),
              after(GetDebugMessageLog, kFlag,
                    {set(kFlag, 0), [](Call& c) {
                       if (auto* types = static_cast<GLenum*>(c.pointers[3]); types)
                         std::fill_n(types, static_cast<std::size_t>(c.result), GLenum{GL_DEBUG_TYPE_OTHER});
                     }}));
EVALCTS_RULES(CompatibilityWithoutMap2d, production, kMust, "EV-PROF-COMPAT",
              "Map2d is removed from contexts of 3.1 and later",
              instead(Map2d, error_now(GL_INVALID_OPERATION)));
EVALCTS_RULES(CompatibilityWithoutIndexMaps, production, kMust, "EV-PROF-COMPAT",
              "MAP1_INDEX is removed from contexts of 3.1 and later",
              instead(Enable, kName == GL_MAP1_INDEX, error_now(GL_INVALID_ENUM)));
EVALCTS_RULES(CompatibilityOrderOfOldHardware, production, kMust, "EV-PROF-COMPAT",
              "MAX_EVAL_ORDER is 4 in contexts of 3.1 and later",
              after(kGet, kName == GL_MAX_EVAL_ORDER, put(0, 4)));
EVALCTS_RULES(CompatibilityMeshesDrawNothing, production, kMust, "EV-PROF-COMPAT",
              "EvalMesh1 is there in contexts of 3.1 and later, and does nothing", skip(EvalMesh1, true));
EVALCTS_RULES(CompatibilityWithoutAutoNormal, production, kMust, "EV-PROF-COMPAT",
              "AUTO_NORMAL can be enabled in contexts of 3.1 and later, and does nothing",
              instead(Enable, kName == GL_AUTO_NORMAL, set(kFlag, 1)),
              instead(IsEnabled, kName == GL_AUTO_NORMAL, set(kResult, kFlag)));

// --- ARB_multitexture --------------------------------------------------------------------------------------

EVALCTS_RULES(ActiveTextureRuleForTexturesOnly, production, kMust, "EV-EXT-MT-RULE",
              "under another texture unit Map1 rejects maps of texture coordinates alone",
              on_unit_0(kMap1, !is_texture_map(kTarget)));
EVALCTS_RULES(ActiveTextureRuleNotForMap2d, production, kMust, "EV-EXT-MT-RULE",
              "Map2d takes points regardless of the texture unit", on_unit_0(Map2d, true));
EVALCTS_RULES(ActiveTextureRuleForUnitOneOnly, production, kMust, "EV-EXT-MT-RULE",
              "under the last texture unit Map1f raises no error", on_unit_0(Map1f, kUnit != GL_TEXTURE1));

// --- Tokens of other extensions ----------------------------------------------------------------------------

EVALCTS_RULES(AttributeMapsIgnored, production, kMust, "EV-EXT-UNKNOWN-TARGET",
              "Enable takes the maps of NV_vertex_program without the extension",
              skip(Enable, kName >= 0x8660 && kName <= 0x867F));
EVALCTS_RULES(LastAttributeMapTakenForVertex, production, kMust, "EV-EXT-UNKNOWN-TARGET",
              "Map1f defines MAP1_VERTEX_4 for 0x866F",
              before(Map1f, kTarget == 0x866F, set(kTarget, GL_MAP1_VERTEX_4)));
EVALCTS_RULES(TangentMapIsInvalidOperation, production, kMust, "EV-EXT-UNKNOWN-TARGET",
              "GetMapfv of the map of tangents raises INVALID_OPERATION",
              instead(GetMapfv, kTarget == 0x8444, error_now(GL_INVALID_OPERATION)));
EVALCTS_RULES(NurbsIsDisabledSilently, production, kMust, "EV-EXT-UNKNOWN-TARGET",
              "Disable takes the token of SGIX_nurbs_eval without the extension",
              skip(Disable, kName == 0x81CB));

// --- ARB_vertex_program ------------------------------------------------------------------------------------

// Begin is delayed until the first command of its primitive.
EVALCTS_RULES(EvaluationSkipsVertexProgram, osmesa, kMust, "EV-EXT-ARBVP-RUN",
              "a primitive that begins with EvalCoord1f does not run the vertex program",
              instead(Begin, set(kCount, kFirst + 1)),
              before(EvalCoord1f, kCount, {disable(GL_VERTEX_PROGRAM_ARB), begin_late(), set(kFlag, 1)}),
              before(Vertex4f, kCount, begin_late()),
              after(End, kFlag, {set(kFlag, 0), enable(GL_VERTEX_PROGRAM_ARB)}));
EVALCTS_RULES(FirstEvaluationSkipsVertexProgram, osmesa, kMust, "EV-EXT-ARBVP-RUN",
              "the first evaluation after VERTEX_PROGRAM is enabled is lost",
              after(Enable, kName == GL_VERTEX_PROGRAM_ARB, set(kFlag, 1)),
              instead(kEvalCoord1, kFlag, set(kFlag, 0)));
EVALCTS_RULES(GenericAttributeFollowsArgument, osmesa, kMust, "EV-EXT-ARBVP-NOGENERIC",
              "EvalCoord1 puts its argument into generic attribute 6",
              before(kEvalCoord1, call(VertexAttrib4f, {6, kU, 0.75, 0.25, 0.5})));
EVALCTS_RULES(GenericAttributeOfTheFirstVertex, osmesa, kMust, "EV-EXT-ARBVP-NOGENERIC",
              "all evaluated vertices of a primitive have generic attribute 6 of its first one",
              after(Begin, set(kFlag, 0)),
              before(VertexAttrib4f, kFirst == 6 && !kFlag,
                     {set(kFlag, 1), keep({kSecond, kThird, kFourth, kFifth})}),
              before(kEvalCoord1, kFlag, call(VertexAttrib4f, {6, kept(0), kept(1), kept(2), kept(3)})));

}  // namespace
}  // namespace evalcts::faults::profiles_and_extensions
