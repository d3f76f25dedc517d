// Faults against section 20 of the requirements: evaluator commands in display lists.
#include <algorithm>
#include <cmath>

#include "grid_steps.h"

namespace evalcts::faults::display_lists {
namespace {

// --- Compiled, not executed --------------------------------------------------------------------------------

FAULT(MeshDrawnAtEndList, "EV-DL-COMPILED EV-DL-COMPEXEC", "EndList draws the last EvalMesh1 of the list",
      before(EvalMesh1, kListMode, {drop(), hold()}), after(EndList, release()));
FAULT(GridSetAtEndList, "EV-DL-COMPILED", "EndList executes the last MapGrid1d of the list",
      before(MapGrid1d, kCompiling, {drop(), hold()}), after(EndList, release()));

// --- Called ------------------------------------------------------------------------------------------------

FAULT(AutoNormalNotCompiled, "EV-DL-EXECUTE", "Enable and Disable of AUTO_NORMAL are left out of lists",
      skip(kSwitches, kListMode == GL_COMPILE && kName == GL_AUTO_NORMAL));
FAULT(CompiledGridSwapsDirections, "EV-DL-EXECUTE",
      "a compiled MapGrid2d has the segments of u and v the other way round",
      before(MapGrid2d, kListMode, swap(kSegments, kVSegments)));
FAULT(CompiledIndicesAreShorts, "EV-DL-EXECUTE", "the index of a compiled EvalPoint1 is kept in sixteen bits",
      before(EvalPoint1, kListMode, set(kI, in_bits(kI, 16))));
FAULT(CompiledNegativeIndexIsZero, "EV-DL-EXECUTE", "a compiled EvalMesh1 begins at index 0 or above",
      before(EvalMesh1, kListMode, set(kI1, max(kI1, 0))));
FAULT(CompiledMesh2RangeIsShort, "EV-DL-EXECUTE",
      "the range of j of a compiled EvalMesh2 is kept in sixteen bits without a sign",
      before(EvalMesh2, kListMode, {set(kJ1, kJ1 & 0xFFFF), set(kJ2, kJ2 & 0xFFFF)}));
FAULT(CompiledSegmentsAreShorts, "EV-DL-EXECUTE",
      "the segments of a compiled MapGrid1f are kept in sixteen bits",
      before(MapGrid1f, kListMode != 0 && kSegments > 0, set(kSegments, kSegments & 0xFFFF)));
FAULT(CompiledOrderInFourBits, "EV-DL-EXECUTE EV-DL-STRIDE-KEPT", "orders from 16 on are compiled as 15",
      before(kMap1, kListMode != 0 && kOrder > 15 && kOrder <= state(GL_MAX_EVAL_ORDER), set(kOrder, 15)));
FAULT(CallRestoresGrid, "EV-DL-EXECUTE", "CallList leaves the grid of one dimension as it was",
      keeping(CallList, !kInside && !kListMode, grid1_state()));
FAULT(CompiledLargeNetCut, "EV-DL-EXECUTE",
      "of a compiled net of more than 256 points the last row repeats the one before",
      before(kMap2, kListMode != 0 && kOrder * kVOrder > 256, change_points([](Net& net) {
               std::copy_n(net.point(net.rows - 2), net.columns * net.components, net.point(net.rows - 1));
             })));

// --- Compiled and executed ---------------------------------------------------------------------------------

FAULT(EvalPointCompiledTwice, "EV-DL-COMPEXEC",
      "EvalPoint2 in a list that is compiled and executed is there twice",
      after(EvalPoint2, kListMode == GL_COMPILE_AND_EXECUTE, kGo));
FAULT(ExecutedErrorNotCompiled, "EV-DL-COMPEXEC",
      "a Map1 whose domain is empty raises its error while it is compiled and executed, and never again",
      instead(kMap1, kListMode == GL_COMPILE_AND_EXECUTE && kU1 == kU2, error_now(GL_INVALID_VALUE)));

// --- Control points ----------------------------------------------------------------------------------------

FAULT(CompiledMap2fReadAtEndList, "EV-DL-POINTS-COPIED", "the points of a compiled Map2f are read by EndList",
      instead(Map2f, kListMode, hold()), before(EndList, release()));
FAULT(CompiledPointsFoundByAddress, "EV-DL-POINTS-COPIED",
      "a list takes points from an address that an earlier list had as they were then",
      before(kMap1, kListMode != 0 && kIsLegal,
             {set(kFlag, kNumber == kAddress), set(kNumber, kAddress), repeat_points(kFlag)}));
FAULT(CompiledStrideInAByte, "EV-DL-STRIDE-KEPT", "the stride of a compiled Map1 is kept in a byte",
      before(kMap1, kListMode != 0 && kStride > 255, set(kStride, 255)));
FAULT(CompiledMap1dPacked, "EV-DL-STRIDE-KEPT", "a compiled Map1d of colours takes its points for packed",
      before(Map1d, kListMode != 0 && kTarget == GL_MAP1_COLOR_4 && kStride > 4, set(kStride, 4)));
FAULT(CompiledRowsWithoutPadding, "EV-DL-STRIDE-KEPT",
      "a compiled Map2f whose rows are longer than the net takes them for packed",
      before(Map2f, kListMode != 0 && kStride > kVOrder * kVStride, set(kStride, kVOrder* kVStride)));
FAULT(CompiledVMajorTransposed, "EV-DL-STRIDE-KEPT",
      "a compiled Map2d in which u runs faster is taken for one in which v does",
      before(Map2d, kListMode != 0 && kStride < kVStride && kVStride == kStride * kOrder,
             {set(kVStride, kStride), set(kStride, kVOrder* kVStride)}));

// --- Doubles -----------------------------------------------------------------------------------------------

FAULT(CompiledEvalCoord2dvTakesUTwice, "EV-DL-DOUBLE", "a compiled EvalCoord2dv has u for v, too",
      before(EvalCoord2dv, kListMode, set(kV, kU)));
FAULT(CompiledMap2dSwapsDomains, "EV-DL-DOUBLE",
      "a compiled Map2d has the domains of u and v the other way round",
      before(Map2d, kListMode, {swap(kU1, kV1), swap(kU2, kV2)}));
FAULT(CompiledArgumentInHalf, "EV-DL-DOUBLE", "a compiled EvalCoord1d keeps eleven bits of its argument",
      before(EvalCoord1d, kListMode, set(kU, with_precision(kU, 11))));

// --- Errors ------------------------------------------------------------------------------------------------

FAULT(CompiledOrderCheckedAtOnce, "EV-DL-ERR-LATE", "an order that is too low is an error of the compilation",
      instead(kMap1, kListMode == GL_COMPILE && kOrder < 1, error_now(GL_INVALID_VALUE)));
FAULT(CompiledMeshCheckedAtOnce, "EV-DL-ERR-LATE",
      "a mode that EvalMesh2 does not know is an error of the compilation as well",
      before(EvalMesh2, kCompiling && !kIsMode2, error_now(GL_INVALID_ENUM)));
FAULT(CompiledErrorAtEndList, "EV-DL-ERR-LATE", "EndList raises the error of a compiled MapGrid",
      before(kMapGrid1, kListMode == GL_COMPILE && kSegments <= 0, set(kFlag, 1)),
      after(EndList, kFlag, {set(kFlag, 0), error_now(GL_INVALID_VALUE)}));
FAULT(CompiledBadTargetDropped, "EV-DL-ERR-ALL", "a Map2 with an invalid target is left out of lists",
      skip(kMap2, kCompiling && (kComponents == 0 || kTarget < GL_MAP2_COLOR_4)));
FAULT(CompiledSmallVStrideDropped, "EV-DL-ERR-ALL", "in lists a vstride below k is taken for k",
      before(kMap2, kListMode != 0 && kVStride > 0, set(kVStride, max(kVStride, kComponents))));
FAULT(CompiledEqualEndsMoved, "EV-DL-ERR-ALL", "in lists v1 equal to v2 raises no error",
      before(kMap2, kListMode != 0 && kV1 == kV2, set(kV2, kV2 + 1)));
FAULT(CompiledGridErrorIsInvalidEnum, "EV-DL-ERR-ALL",
      "MapGrid2 without segments in a list raises INVALID_ENUM",
      instead(kMapGrid2, kListMode && (kSegments <= 0 || kVSegments <= 0), call(EvalMesh1, {GL_FILL, 0, 0})));
FAULT(CompiledFillTakenForLine, "EV-DL-ERR-ALL", "EvalMesh1 with FILL in a list draws lines",
      before(EvalMesh1, kListMode != 0 && kMode == GL_FILL, set(kMode, GL_LINE)));
FAULT(CompiledStrideZeroMeansPacked, "EV-DL-ERR-ALL", "stride 0 of a compiled Map1f means packed points",
      before(Map1f, kListMode != 0 && kStride == 0, set(kStride, kComponents)));
FAULT(CompiledHighOrderClamped, "EV-DL-ERR-ALL",
      "an order of a compiled Map1d above MAX_EVAL_ORDER is clamped",
      before(Map1d, kListMode, set(kOrder, min(kOrder, state(GL_MAX_EVAL_ORDER)))));
FAULT(CompiledHighUOrderDropped, "EV-DL-ERR-ALL",
      "a Map2f of a uorder above MAX_EVAL_ORDER is left out of lists",
      skip(Map2f, kListMode == GL_COMPILE && kOrder > state(GL_MAX_EVAL_ORDER)));
FAULT(CompiledEmptyGridDropped, "EV-DL-ERR-ALL", "a MapGrid1d of no segments is left out of lists",
      skip(MapGrid1d, kListMode == GL_COMPILE && kSegments == 0));
FAULT(CompiledMesh2ModeIsInvalidValue, "EV-DL-ERR-ALL",
      "EvalMesh2 with a mode of Begin in a list raises INVALID_VALUE",
      instead(EvalMesh2, kListMode && (kMode == GL_TRIANGLES || kMode == GL_QUAD_STRIP),
              error(GL_INVALID_VALUE)));
FAULT(CompiledHighVOrderDropped, "EV-DL-ERR-ALL",
      "a Map2d of a vorder above MAX_EVAL_ORDER is left out of lists",
      skip(Map2d, kListMode == GL_COMPILE && kVOrder > state(GL_MAX_EVAL_ORDER)));
FAULT(CompiledNegativeUOrderDropped, "EV-DL-ERR-ALL", "a Map2f of a negative uorder is left out of lists",
      skip(Map2f, kListMode == GL_COMPILE && kOrder < 0));
FAULT(CompiledEmptyGrid2fInVDropped, "EV-DL-ERR-ALL", "a MapGrid2f of no segments in v is left out of lists",
      skip(MapGrid2f, kListMode == GL_COMPILE && kVSegments <= 0));
FAULT(CompiledEmptyGrid2dInUDropped, "EV-DL-ERR-ALL", "a MapGrid2d of no segments in u is left out of lists",
      skip(MapGrid2d, kListMode == GL_COMPILE && kSegments <= 0));
FAULT(CompiledStrideOfOnePointNotChecked, "EV-DL-ERR-ALL",
      "the stride of a compiled Map1 of order 1 is not checked",
      before(kMap1, kListMode != 0 && kOrder == 1, set(kStride, max(kStride, kComponents))));
FAULT(CompiledNegativeOrderIsInvalidEnum, "EV-DL-ERR-ALL", "a negative vorder in a list raises INVALID_ENUM",
      before(kMap2, kListMode != 0 && kVOrder < 0, set(kTarget, 0)));

// --- State of the compilation instead of the call ----------------------------------------------------------

FAULT(CompiledMeshCarriesMap, "EV-DL-EXECSTATE-MAP",
      "a compiled EvalMesh1 brings the vertex map of the compilation along",
      before(EvalMesh1, kListMode == GL_COMPILE && enabled(GL_MAP1_VERTEX_3),
             send(map_of(GL_MAP1_VERTEX_3))));
FAULT(CompiledMeshCarriesEnable, "EV-DL-EXECSTATE-MAP",
      "a compiled EvalMesh2 has colours if the colour map was on while it was compiled",
      before(EvalMesh2, kCompiling, switch_to(GL_MAP2_COLOR_4, enabled(GL_MAP2_COLOR_4))));
FAULT(EvaluationWithoutMapsNotCompiled, "EV-DL-EXECSTATE-MAP",
      "EvalCoord2 is left out of a list that is compiled while no vertex map is on",
      skip(kEvalCoord2, kCompiling && !evaluates()));
FAULT(CompiledMeshCarriesGrid, "EV-DL-EXECSTATE-GRID",
      "a compiled EvalMesh2 brings the grid of the compilation along",
      before(EvalMesh2, kCompiling, send(grid2_state())));
FAULT(CompiledEvalPointIsEvalCoord, "EV-DL-EXECSTATE-GRID",
      "EvalPoint1 is compiled as EvalCoord1 of the grid of the compilation",
      instead(EvalPoint1, kCompiling,
              call(EvalCoord1d,
                   {choose(kI == grid1(0), grid1(2), grid1(1) + kI * (grid1(2) - grid1(1)) / grid1(0))})));
FAULT(CompiledEvalPoint2IsEvalCoord, "EV-DL-EXECSTATE-GRID",
      "EvalPoint2 is compiled as EvalCoord2 of the grid of the compilation",
      instead(EvalPoint2, kCompiling,
              call(EvalCoord2d, {grid2(1) + kI * (grid2(2) - grid2(1)) / grid2(0),
                                 grid2(4) + kJ*(grid2(5) - grid2(4)) / grid2(3)})));
FAULT(ActiveTextureOfTheCompilation, "EV-DL-ACTIVETEX", "ACTIVE_TEXTURE is judged while Map1 is compiled",
      instead(kMap1, kListMode == GL_COMPILE && state(GL_ACTIVE_TEXTURE) != GL_TEXTURE0,
              call(NewList, {1, GL_COMPILE})));

// --- Queries while a list is open --------------------------------------------------------------------------

FAULT(IsEnabledSeesCompiled, "EV-DL-GETMAP", "IsEnabled answers for what the open list enables",
      before(Enable, kCompiling, set(remembered(kName), 1)), after(EndList, forget()),
      after(IsEnabled, kListMode == GL_COMPILE && remembered(kName), set(kResult, 1)));
FAULT(GetMapSeesCompiledOrder, "EV-DL-GETMAP", "GetMapiv tells the order of the Map1 that the open list has",
      before(kMap1, kListMode == GL_COMPILE && kOrder > 0, set(remembered(kTarget), kOrder)),
      after(EndList, forget()),
      after(GetMapiv, kQuery == GL_ORDER && kCompiling && remembered(kTarget), put(0, remembered(kTarget))));
FAULT(GetnMapWritesNothingInLists, "EV-DL-GETMAP", "GetnMapfv does nothing while a list is open",
      skip(GetnMapfv, kListMode));
FAULT(GetDoublevSeesCompiledGrid, "EV-DL-GETMAP",
      "GetDoublev tells the ends of the grid that the open list has",
      before(MapGrid1f, kCompiling, {set(kFlag, 1), keep({kU1, kU2})}), after(EndList, forget()),
      after(kGet, kName == GL_MAP1_GRID_DOMAIN && kFlag, answer(kept_values(2))));
FAULT(GetBooleanvIgnoredInLists, "EV-DL-GETMAP", "GetBooleanv of a map does nothing while a list is open",
      skip(GetBooleanv, kListMode != 0 && is_map(kName)));
FAULT(GetnMapdvIgnoredInLists, "EV-DL-GETMAP", "GetnMapdv does nothing while a list is open",
      skip(GetnMapdv, kListMode));
FAULT(GetMapIgnoredWhileExecuted, "EV-DL-GETMAP",
      "GetMapfv does nothing while a list is compiled and executed",
      skip(GetMapfv, kListMode == GL_COMPILE_AND_EXECUTE));
FAULT(GetMapOfCompiledDomain, "EV-DL-GETMAP", "GetMapdv tells the domain of the Map2 that the open list has",
      before(kMap2, kCompiling, {set(kFlag, 1), keep({kU1, kU2, kV1, kV2})}), after(EndList, forget()),
      after(GetMapdv, kQuery == GL_DOMAIN && kTarget >= GL_MAP2_COLOR_4 && kFlag, answer(kept_values(4))));
FAULT(MaxOrderUnknownInLists, "EV-DL-GETMAP", "MAX_EVAL_ORDER is 0 while a list is open",
      after(GetIntegerv, kListMode != 0 && kName == GL_MAX_EVAL_ORDER, put(0, 0)));

// --- Begin and End -----------------------------------------------------------------------------------------

FAULT(CallListIgnoredInPrimitives, "EV-DL-INBEGIN", "CallList between Begin and End does nothing",
      skip(CallList, kInside));
FAULT(ImmediatePointsNeedImmediateBegin, "EV-DL-SPLIT",
      "EvalCoord1f does nothing in a primitive that a list has begun",
      before(Begin, !kCompiling, set(kFlag, 1)), before(End, !kCompiling, set(kFlag, 0)),
      skip(EvalCoord1f, !kCompiling && !kFlag));

// --- Called again ------------------------------------------------------------------------------------------

FAULT(SecondCallRoundsOtherwise, "EV-DL-REPEAT",
      "from the second call of a list on the last bit of x of the last evaluated vertex is another",
      before(kPoints | kMeshes, set(kFlag, 1)), after(CallList, set(kCount, kCount + 1)),
      change_output(kCount >= 2 && kFlag, [](Primitives& all) {
        if (all.empty() || all.back().vertices.empty()) return;
        auto& x = all.back().vertices.back().position[0];
        x = std::nextafter(x, 1e30f);
      }));
FAULT(SecondCallForgetsErrors, "EV-DL-REPEAT", "a list raises its errors at its first call only",
      after(NewList, set(remembered(kFirst), 0)),
      after(CallList, {when(remembered(kFirst), call(GetError)), set(remembered(kFirst), 1)}));
FAULT(SecondCallIgnored, "EV-DL-REPEAT",
      "a list that is called twice in a row is executed once where something was evaluated",
      before(kPoints | kMeshes, set(kFlag, 1)), before(NewList, set(kCount, 0)),
      around(CallList, true, 0, set(kCount, kFirst)), skip(CallList, kCount == kFirst && kFlag));

// --- Lists that call lists ---------------------------------------------------------------------------------

FAULT(InnerListLookedUpByTheCompilation, "EV-DL-NESTED",
      "a call of a list that is not defined yet is left out of the outer list",
      skip(CallList, kCompiling && !call(IsList, {kFirst})));
FAULT(InnerListKeepsGridToItself, "EV-DL-NESTED",
      "the grid and the enables that an inner list sets end with it",
      around(CallList, kCompiling, call(PushAttrib, {GL_EVAL_BIT}), call(PopAttrib)));

}  // namespace
}  // namespace evalcts::faults::display_lists
