// Faults against section 20 of the requirements: evaluator commands in display lists.
#include <algorithm>

#include "rules.h"

namespace evalcts::faults::display_lists {
namespace {

FAULT(CompiledIndicesAreShorts, "EV-DL-EXECUTE", "the index of a compiled EvalPoint1 is kept in sixteen bits",
      before(EvalPoint1, kListMode, set(kI, in_bits(kI, 16))));
FAULT(CompiledNegativeIndexIsZero, "EV-DL-EXECUTE", "a compiled EvalMesh1 begins at index 0 or above",
      before(EvalMesh1, kListMode, set(kI1, max(kI1, 0))));
FAULT(CompiledMesh2RangeIsShort, "EV-DL-EXECUTE",
      "the range of j of a compiled EvalMesh2 is kept in sixteen bits without a sign",
      before(EvalMesh2, kListMode, {set(kJ1, kJ1 & 0xFFFF), set(kJ2, kJ2 & 0xFFFF)}));
FAULT(CompiledSegmentsAreShorts, "EV-DL-EXECUTE", "a compiled MapGrid1f keeps 16 bits of the segments",
      before(MapGrid1f, kListMode != 0 && kSegments > 0, set(kSegments, kSegments & 0xFFFF)));
FAULT(CompiledOrderInFourBits, "EV-DL-EXECUTE EV-DL-STRIDE-KEPT", "orders from 16 on are compiled as 15",
      before(kMap1, kListMode != 0 && kOrder > 15 && kOrder <= state(GL_MAX_EVAL_ORDER), set(kOrder, 15)));
FAULT(CompiledLargeNetCut, "EV-DL-EXECUTE", "the last row of a large compiled net repeats the one before",
      before(kMap2, kListMode != 0 && kOrder * kVOrder > 256, change_points([](Net& net) {
               std::copy_n(net.point(net.rows - 2), net.columns * net.components, net.point(net.rows - 1));
             })));
FAULT(ExecutedErrorNotCompiled, "EV-DL-COMPEXEC",
      "a Map1 whose domain is empty raises its error while it is compiled and executed, and never again",
      instead(kMap1, kListMode == GL_COMPILE_AND_EXECUTE && kU1 == kU2, error_now(GL_INVALID_VALUE)));
FAULT(CompiledMap2fReadAtEndList, "EV-DL-POINTS-COPIED", "the points of a compiled Map2f are read by EndList",
      instead(Map2f, kListMode, hold()), before(EndList, release()));
FAULT(CompiledPointsFoundByAddress, "EV-DL-POINTS-COPIED",
      "a list takes points from an address that an earlier list had as they were then",
      before(kMap1, kListMode != 0 && kIsLegal,
             {set(kFlag, kNumber == kAddress), set(kNumber, kAddress), repeat_points(kFlag)}));
FAULT(CompiledMap1dPacked, "EV-DL-STRIDE-KEPT", "a compiled Map1d of colours takes its points for packed",
      before(Map1d, kListMode != 0 && kTarget == GL_MAP1_COLOR_4 && kStride > 4, set(kStride, 4)));
FAULT(CompiledEvalCoord2dvTakesUTwice, "EV-DL-DOUBLE", "a compiled EvalCoord2dv has u for v, too",
      before(EvalCoord2dv, kListMode, set(kV, kU)));
FAULT(CompiledArgumentInHalf, "EV-DL-DOUBLE", "a compiled EvalCoord1d keeps eleven bits of its argument",
      before(EvalCoord1d, kListMode, set(kU, with_precision(kU, 11))));
FAULT(CompiledOrderCheckedAtOnce, "EV-DL-ERR-LATE", "an order that is too low is an error of the compilation",
      instead(kMap1, kListMode == GL_COMPILE && kOrder < 1, error_now(GL_INVALID_VALUE)));
FAULT(CompiledErrorAtEndList, "EV-DL-ERR-LATE", "EndList raises the error of a compiled MapGrid",
      before(kMapGrid1, kListMode == GL_COMPILE && kSegments <= 0, set(kFlag, 1)),
      after(EndList, kFlag, {set(kFlag, 0), error_now(GL_INVALID_VALUE)}));
FAULT(CompiledStrideZeroMeansPacked, "EV-DL-ERR-ALL", "stride 0 of a compiled Map1f means packed points",
      before(Map1f, kListMode != 0 && kStride == 0, set(kStride, kComponents)));
FAULT(CompiledHighOrderClamped, "EV-DL-ERR-ALL", "a compiled Map1d clamps orders above MAX_EVAL_ORDER",
      before(Map1d, kListMode, set(kOrder, min(kOrder, state(GL_MAX_EVAL_ORDER)))));
FAULT(CompiledHighUOrderDropped, "EV-DL-ERR-ALL", "a Map2f of too high a uorder is left out of lists",
      skip(Map2f, kListMode == GL_COMPILE && kOrder > state(GL_MAX_EVAL_ORDER)));
FAULT(CompiledEmptyGridDropped, "EV-DL-ERR-ALL", "a MapGrid1d of no segments is left out of lists",
      skip(MapGrid1d, kListMode == GL_COMPILE && kSegments == 0));
FAULT(CompiledMesh2ModeIsInvalidValue, "EV-DL-ERR-ALL", "lists raise INVALID_VALUE for modes of Begin",
      instead(EvalMesh2, kListMode && (kMode == GL_TRIANGLES || kMode == GL_QUAD_STRIP),
              error(GL_INVALID_VALUE)));
FAULT(CompiledHighVOrderDropped, "EV-DL-ERR-ALL", "a Map2d of too high a vorder is left out of lists",
      skip(Map2d, kListMode == GL_COMPILE && kVOrder > state(GL_MAX_EVAL_ORDER)));
FAULT(CompiledNegativeUOrderDropped, "EV-DL-ERR-ALL", "a Map2f of a negative uorder is left out of lists",
      skip(Map2f, kListMode == GL_COMPILE && kOrder < 0));
FAULT(CompiledEmptyGrid2fInVDropped, "EV-DL-ERR-ALL", "a MapGrid2f of no segments in v is left out of lists",
      skip(MapGrid2f, kListMode == GL_COMPILE && kVSegments <= 0));
FAULT(CompiledEmptyGrid2dInUDropped, "EV-DL-ERR-ALL", "a MapGrid2d of no segments in u is left out of lists",
      skip(MapGrid2d, kListMode == GL_COMPILE && kSegments <= 0));
FAULT(CompiledStrideOfOnePointNotChecked, "EV-DL-ERR-ALL", "lists do not check the stride of Map1 of order 1",
      before(kMap1, kListMode != 0 && kOrder == 1, set(kStride, max(kStride, kComponents))));
FAULT(CompiledMeshCarriesEnable, "EV-DL-EXECSTATE-MAP",
      "a compiled EvalMesh2 has colours if the colour map was on while it was compiled",
      before(EvalMesh2, kCompiling, switch_to(GL_MAP2_COLOR_4, enabled(GL_MAP2_COLOR_4))));
FAULT(EvaluationWithoutMapsNotCompiled, "EV-DL-EXECSTATE-MAP",
      "EvalCoord2 is left out of a list that is compiled while no vertex map is on",
      skip(kEvalCoord2, kCompiling && !evaluates()));
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
FAULT(GetBooleanvIgnoredInLists, "EV-DL-GETMAP", "GetBooleanv of a map does nothing while a list is open",
      skip(GetBooleanv, kListMode != 0 && is_map(kName)));
FAULT(GetnMapdvIgnoredInLists, "EV-DL-GETMAP", "lists ignore GetnMapdv", skip(GetnMapdv, kListMode));
FAULT(GetMapIgnoredWhileExecuted, "EV-DL-GETMAP", "GetMapfv does nothing in COMPILE_AND_EXECUTE mode",
      skip(GetMapfv, kListMode == GL_COMPILE_AND_EXECUTE));
FAULT(GetMapOfCompiledDomain, "EV-DL-GETMAP", "GetMapdv tells the domain of the Map2 that the open list has",
      before(kMap2, kCompiling, {set(kFlag, 1), keep({kU1, kU2, kV1, kV2})}), after(EndList, set(kFlag, 0)),
      after(GetMapdv, kQuery == GL_DOMAIN && kTarget >= GL_MAP2_COLOR_4 && kFlag, answer(kept_values(4))));
FAULT(MaxOrderUnknownInLists, "EV-DL-GETMAP", "MAX_EVAL_ORDER is 0 while a list is open",
      after(GetIntegerv, kListMode != 0 && kName == GL_MAX_EVAL_ORDER, put(0, 0)));
FAULT(ImmediatePointsNeedImmediateBegin, "EV-DL-SPLIT",
      "EvalCoord1f does nothing in primitives that lists begin", before(Begin, !kCompiling, set(kFlag, 1)),
      before(End, !kCompiling, set(kFlag, 0)), skip(EvalCoord1f, !kCompiling && !kFlag));
FAULT(SecondCallForgetsErrors, "EV-DL-REPEAT", "a list raises its errors at its first call only",
      after(NewList, set(remembered(kFirst), 0)),
      after(CallList, {when(remembered(kFirst), call(GetError)), set(remembered(kFirst), 1)}));
FAULT(SecondCallIgnored, "EV-DL-REPEAT",
      "a list that is called twice in a row is executed once where something was evaluated",
      before(kPoints | kMeshes, set(kFlag, 1)), before(NewList, set(kCount, 0)),
      around(CallList, true, 0, set(kCount, kFirst)), skip(CallList, kCount == kFirst && kFlag));

}  // namespace
}  // namespace evalcts::faults::display_lists
