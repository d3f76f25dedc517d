// Faults against section 21 of the requirements: the attribute stack and several contexts.
#include <algorithm>

#include "rules.h"

namespace evalcts::faults::attribute_stack {
namespace {

Value is_enable_only(Value mask) { return (mask & GL_ENABLE_BIT) && !(mask & GL_EVAL_BIT); }
const Value kIsEvalOnly = (kLevelMask & GL_EVAL_BIT) && !(kLevelMask & GL_ENABLE_BIT);
const Value kHasNeither = !(kLevelMask & (GL_ENABLE_BIT | GL_EVAL_BIT));

// Returns a part of a map as a State. It is restored into the definition that is current at the
// time of PopAttrib.
template <class Bring>
State part_of(GLenum target, Bring bring) {
  return [=]() -> Restore {
    return [=, saved = current_map(target)] {
      Map map = current_map(target);
      bring(saved, map);
      map.define();
    };
  };
}
State domain_of(GLenum target) {
  return part_of(target, [](const Map& saved, Map& map) {
    map = {map.target, saved.u1, saved.u2, saved.v1, saved.v2, map.net};
  });
}
State points_of(GLenum target) {
  return part_of(target, [](const Map& saved, Map& map) {
    const std::size_t count = std::min(saved.net.values.size(), map.net.values.size());
    std::copy_n(saved.net.values.begin(), count, map.net.values.begin());
  });
}

// True if the context becomes current for the first time.
const Value kIsNewContext = kFirst && !remembered(kFirst);
Rule note_contexts() { return before(kOtherContexts, set(remembered(kFirst), 1)); }

// --- EVAL_BIT ----------------------------------------------------------------------------------------------

FAULT(EvalBitForgetsAutoNormal, "EV-ATTRIB-EVALBIT",
      "EVAL_BIT restores AUTO_NORMAL only together with ENABLE_BIT",
      not_restored(enable_of(GL_AUTO_NORMAL), kIsEvalOnly));
FAULT(EvalBitForgetsLastMap, "EV-ATTRIB-EVALBIT", "EVAL_BIT does not restore the enable of MAP2_VERTEX_4",
      not_restored(enable_of(GL_MAP2_VERTEX_4), kIsEvalOnly));
FAULT(EvalBitForgetsSegmentsOfV, "EV-ATTRIB-EVALBIT", "EVAL_BIT does not restore the number of segments in v",
      not_restored(grid2_state(3), kLevelMask& GL_EVAL_BIT));
FAULT(EvalBitForgetsSecondEndOfU, "EV-ATTRIB-EVALBIT",
      "EVAL_BIT does not restore u2 of the grid of one dimension",
      not_restored(grid1_state(2), kLevelMask& GL_EVAL_BIT));
FAULT(PushResetsGrid, "EV-ATTRIB-EVALBIT",
      "after PushAttrib(EVAL_BIT) the grid of one dimension is the initial one until PopAttrib",
      after(PushAttrib, kFirst& GL_EVAL_BIT, call(MapGrid1d, {1, 0, 1})));
FAULT(PushTurnsAutoNormalOff, "EV-ATTRIB-ENABLEBIT",
      "after PushAttrib(ENABLE_BIT) AUTO_NORMAL is off until PopAttrib",
      after(PushAttrib, is_enable_only(kFirst), disable(GL_AUTO_NORMAL)));
FAULT(EnableBitHidesEvalBit, "EV-ATTRIB-EVALBIT",
      "of EVAL_BIT and ENABLE_BIT together the latter counts: the grid of two dimensions stays",
      not_restored(grid2_state(), kLevelMask == (GL_EVAL_BIT | GL_ENABLE_BIT)));
FAULT(PopOnlyEnables, "EV-ATTRIB-EVALBIT EV-ATTRIB-ENABLEBIT",
      "PopAttrib enables MAP1_INDEX again if it was enabled, but never disables it",
      around(PopAttrib, kLevel > 0 && enabled(GL_MAP1_INDEX), 0, enable(GL_MAP1_INDEX)));

// --- ENABLE_BIT --------------------------------------------------------------------------------------------

FAULT(EnableBitForgetsAutoNormal, "EV-ATTRIB-ENABLEBIT",
      "ENABLE_BIT does not cover AUTO_NORMAL, as in GL 1.0",
      not_restored(enable_of(GL_AUTO_NORMAL), is_enable_only(kLevelMask)));
FAULT(EnableBitForgetsMap2Normal, "EV-ATTRIB-ENABLEBIT", "ENABLE_BIT does not cover MAP2_NORMAL",
      not_restored(enable_of(GL_MAP2_NORMAL), is_enable_only(kLevelMask)));
FAULT(EnableBitRestoresSegments, "EV-ATTRIB-ENABLEBIT-NOGRID",
      "ENABLE_BIT restores the number of segments of the grid of one dimension",
      restored(grid1_state(0), is_enable_only(kLevelMask)));

// --- Maps --------------------------------------------------------------------------------------------------

FAULT(EvalBitRestoresDomain, "EV-ATTRIB-NOMAPS", "EVAL_BIT restores the domain of MAP1_VERTEX_3",
      restored(domain_of(GL_MAP1_VERTEX_3), kLevelMask& GL_EVAL_BIT));
FAULT(PushTakesIndexMapAway, "EV-ATTRIB-NOMAPS", "PushAttrib(EVAL_BIT) leaves MAP1_INDEX as it is initially",
      after(PushAttrib, kFirst == GL_EVAL_BIT, define(GL_MAP1_INDEX, {1})));
FAULT(AllBitsResetSmallMaps, "EV-ATTRIB-NOMAPS",
      "after PushAttrib of all groups the definition of MAP2_INDEX is lost",
      after(PopAttrib, kLevel > 0 && kLevelMask == 0xFFFFFFFFu, define(GL_MAP2_INDEX, {1})));

// --- ALL_ATTRIB_BITS ---------------------------------------------------------------------------------------

FAULT(AllBitsWithoutEval, "EV-ATTRIB-ALL", "0xFFFFFFFF does not mean the group of evaluators",
      before(PushAttrib, kFirst == 0xFFFFFFFFu, set(kFirst, kFirst - GL_EVAL_BIT)));
FAULT(AllBitsOf10AreCurrentOnly, "EV-ATTRIB-ALL",
      "with the ALL_ATTRIB_BITS of GL 1.0 the grid of two dimensions is not restored",
      not_restored(grid2_state(), kLevelMask == 0x000FFFFFu));

// --- Other groups ------------------------------------------------------------------------------------------

FAULT(TransformBitRestoresAutoNormal, "EV-ATTRIB-OTHERBITS", "AUTO_NORMAL is in the group of NORMALIZE",
      restored(enable_of(GL_AUTO_NORMAL), (kLevelMask & GL_TRANSFORM_BIT) != 0 && kHasNeither));
FAULT(TextureBitRestoresTextureMap, "EV-ATTRIB-OTHERBITS", "MAP2_TEXTURE_COORD_2 is in the group of textures",
      restored(enable_of(GL_MAP2_TEXTURE_COORD_2), (kLevelMask & GL_TEXTURE_BIT) != 0 && kHasNeither));
FAULT(NoBitRestoresGrid, "EV-ATTRIB-OTHERBITS", "PushAttrib(0) saves the grid of two dimensions",
      restored(grid2_state(), kLevelMask == 0));
FAULT(HintBitRestoresIndexMap, "EV-ATTRIB-OTHERBITS", "HINT_BIT restores the enable of MAP1_INDEX",
      restored(enable_of(GL_MAP1_INDEX), kLevelMask == GL_HINT_BIT));

// --- Nesting -----------------------------------------------------------------------------------------------

FAULT(OneSlotForTheGrid, "EV-ATTRIB-NEST",
      "the grid is saved in one place for all levels: each PopAttrib brings back the last saved",
      before(PushAttrib, kFirst& GL_EVAL_BIT, keep({grid1(0), grid1(1), grid1(2)})),
      after(PopAttrib, kept(0), call(MapGrid1d, kept_values(3))));
FAULT(OneSlotForEnables, "EV-ATTRIB-NEST", "ENABLE_BIT saves MAP2_NORMAL in one place for all levels",
      before(PushAttrib, is_enable_only(kFirst), set(kFlag, enabled(GL_MAP2_NORMAL))),
      after(PopAttrib, kLevel > 0 && is_enable_only(kLevelMask), switch_to(GL_MAP2_NORMAL, kFlag)));
FAULT(NinthLevelOverwritesEighth, "EV-ATTRIB-NEST",
      "the ninth level of the stack takes the place of the eighth",
      before(PushAttrib, kLevel == 8, set(kNumber, grid1(0))),
      after(PopAttrib, kLevel == 8 && kNumber, call(MapGrid1d, {kNumber, grid1(1), grid1(2)})));
FAULT(InnerPopRestoresOuterEnables, "EV-ATTRIB-NEST",
      "a level without evaluators restores AUTO_NORMAL of the level around it",
      before(PushAttrib, !kListMode, set(remembered(kLevel + 1), enabled(GL_AUTO_NORMAL))),
      after(PopAttrib, !kListMode && kLevel > 1 && kHasNeither,
            switch_to(GL_AUTO_NORMAL, remembered(kLevel - 1))));

FAULT(ChangesBehindInnerLevelStay, "EV-ATTRIB-NEST",
      "a grid that is set behind a nested level of another group stays when the outer level is popped",
      after(MapGrid1f, kListMode == 0 && kLevel > 1 && kHasNeither, set(kFlag, 1)),
      not_restored(grid1_state(), kFlag && (kLevelMask & GL_EVAL_BIT) != 0));

// --- Contexts ----------------------------------------------------------------------------------------------

FAULT(NewContextInheritsGrid, "EV-CTX-FRESH",
      "a new context begins with the grid of the one that was current",
      keeping(kOtherContexts, kIsNewContext, grid2_state()), note_contexts());
FAULT(NewContextInheritsAutoNormal, "EV-CTX-FRESH",
      "a new context begins with AUTO_NORMAL as it is elsewhere",
      keeping(kOtherContexts, kIsNewContext, enable_of(GL_AUTO_NORMAL)), note_contexts());
FAULT(ContextsShareGrid, "EV-CTX-PRIVATE", "all contexts have the grid of one dimension together",
      keeping(kOtherContexts, true, grid1_state()));
FAULT(ContextsShareEnable, "EV-CTX-PRIVATE", "all contexts have the enable of MAP2_TEXTURE_COORD_4 together",
      keeping(kOtherContexts, true, enable_of(GL_MAP2_TEXTURE_COORD_4)));
FAULT(ContextsShareDomain, "EV-CTX-PRIVATE", "a second context has the domain of MAP2_COLOR_4 of the first",
      keeping(kOtherContexts, true, domain_of(GL_MAP2_COLOR_4)));
FAULT(ContextsShareControlPoints, "EV-CTX-PRIVATE",
      "the control points of MAP1_NORMAL are one array for all contexts",
      keeping(kOtherContexts, true, points_of(GL_MAP1_NORMAL)));
FAULT(ThirdSwitchLosesEnable, "EV-CTX-SWITCH",
      "MAP2_TEXTURE_COORD_1 is off when a context is current for the fourth time",
      after(kOtherContexts, kFirst == 0,
            {set(kCount, kCount + 1), when(kCount == 3, disable(GL_MAP2_TEXTURE_COORD_1))}));
FAULT(SwitchLosesAutoNormal, "EV-CTX-SWITCH", "AUTO_NORMAL is off when the first context is current again",
      after(kOtherContexts, kFirst == 0, disable(GL_AUTO_NORMAL)));
FAULT(SwitchRevertsGridDomain, "EV-CTX-SWITCH",
      "the ends of the grid in v are (0, 1) when the first context is current again",
      after(kOtherContexts, kFirst == 0, call(MapGrid2d, {grid2(0), grid2(1), grid2(2), grid2(3), 0, 1})));

namespace on_osmesa {

constexpr std::string_view kImplementation = "osmesa";

FAULT(SharingContextInheritsMap, "EV-CTX-FRESH",
      "a new context that shares objects begins with MAP1_INDEX as it is defined elsewhere",
      keeping(SharingContextEVALCTS, true, map_of(GL_MAP1_INDEX)));
FAULT(SharingContextsShareAutoNormal, "EV-CTX-PRIVATE",
      "contexts that share objects have AUTO_NORMAL together", after(SharingContextEVALCTS, set(kFlag, 1)),
      keeping(OtherContextEVALCTS, kFirst < 2 && kFlag, enable_of(GL_AUTO_NORMAL)));
FAULT(SharedListDefinesInItsMaker, "EV-CTX-PRIVATE", "a shared list defines maps in the context that made it",
      after(SharingContextEVALCTS, set(kCount, kFirst)),
      after(OtherContextEVALCTS, set(kFlag, kFirst == 0 && kCount)),
      around(CallList, kFlag, call(OtherContextEVALCTS, {kCount}), call(OtherContextEVALCTS, {0})));
FAULT(SwitchKeepsOldPlan, "EV-CTX-SWITCH",
      "back in the first context the colours of curves are those of the current colour",
      after(kOtherContexts, set(kFlag, kFirst == 0)), before(Begin, kFlag, disable(GL_MAP1_COLOR_4)));

}  // namespace on_osmesa

}  // namespace
}  // namespace evalcts::faults::attribute_stack
