// Faults against section 2 of the requirements: the initial state of a context.
#include "rules.h"

namespace evalcts::faults::initial_state {
namespace {

const Entries kGetNumbers = GetIntegerv | GetFloatv | Entries(GetDoublev);
FAULT(IndexMapInitiallyOn, "EV-INIT-MAPS-OFF", "MAP1_INDEX is on at first", initially(enable(GL_MAP1_INDEX)));
FAULT(LastMap2FlagUninitialized, "EV-INIT-MAPS-OFF",
      "MAP2_VERTEX_4, the last of the flags, is enabled at first", initially(enable(GL_MAP2_VERTEX_4)));
FAULT(AutoNormalInitiallyOn, "EV-INIT-AUTON-OFF",
      "AUTO_NORMAL is enabled at first, as the glMap2 page has it", initially(enable(GL_AUTO_NORMAL)));
FAULT(InitialTextureMapIsLinear, "EV-INIT-ORDER1", "MAP1_TEXTURE_COORD_2 has order 2 at first",
      initially(define(GL_MAP1_TEXTURE_COORD_2, {0, 0, 0, 0})));
FAULT(InitialOrderIsDegree, "EV-INIT-ORDER1", "GetMapdv answers order 0 of a map that was never defined",
      before(kMap1, set(remembered(kTarget), 1)),
      after(GetMapdv, kQuery == GL_ORDER && is_map1(kTarget) && !remembered(kTarget), put(0, 0)));
FAULT(InitialVOrderForgotten, "EV-INIT-ORDER2", "ORDER of MAP2_INDEX is (1, 2) at first",
      initially(define(GL_MAP2_INDEX, {1, 1})));
FAULT(InitialOrderOfOneValue, "EV-INIT-ORDER2",
      "GetMapfv writes uorder only while a two-dimensional map has its initial order",
      around(GetMapfv, kQuery == GL_ORDER && is_map2(kTarget), set(kNumber, element(1)),
             when(element(0) == 1 && element(1) == 1, put(1, kNumber))));
FAULT(InitialPointsAreZero,
      "EV-INIT-COEFF-VERTEX EV-INIT-COEFF-NORMAL EV-INIT-COEFF-COLOR EV-INIT-COEFF-TEX EV-INIT-COEFF-INDEX",
      "the initial points of some maps of each kind are zeros",
      initially({define(GL_MAP2_VERTEX_4, {0, 0, 0, 0}), define(GL_MAP1_NORMAL, {0, 0, 0}),
                 define(GL_MAP2_COLOR_4, {0, 0, 0, 0}), define(GL_MAP1_TEXTURE_COORD_4, {0, 0, 0, 0}),
                 define(GL_MAP2_INDEX, {0})}));
FAULT(InitialVertex3CopiedFromW, "EV-INIT-COEFF-VERTEX", "the initial point of MAP1_VERTEX_3 is (0,0,1)",
      initially(define(GL_MAP1_VERTEX_3, {0, 0, 1})));
FAULT(InitialNormalAlongX, "EV-INIT-COEFF-NORMAL", "the initial point of MAP2_NORMAL is (1,0,0)",
      initially(define(GL_MAP2_NORMAL, {1, 0, 0})));
FAULT(InitialColorHasNoAlpha, "EV-INIT-COEFF-COLOR", "the initial point of MAP1_COLOR_4 is (1,1,1,0)",
      initially(define(GL_MAP1_COLOR_4, {1, 1, 1, 0})));
FAULT(InitialTextureTakesLastValues, "EV-INIT-COEFF-TEX",
      "the initial point of MAP2_TEXTURE_COORD_2 has the last two values of (0,0,0,1)",
      initially(define(GL_MAP2_TEXTURE_COORD_2, {0, 1})));
QUALITY_FAULT(InitialVDomainMissing, "EV-INIT-DOMAIN",
              "the initial domain of MAP2_NORMAL is (0,1) in u and (0,0) in v", before(Map2f, set(kFlag, 1)),
              after(kGetMap, !kFlag && kTarget == GL_MAP2_NORMAL && kQuery == GL_DOMAIN, put(3, 0)));
QUALITY_FAULT(InitialDomainSymmetric, "EV-INIT-DOMAIN", "the initial domain of MAP1_INDEX is (-1,1)",
              initially(redefine(GL_MAP1_INDEX, [](Map& map, Call&) { map.u1 = -1; })));
FAULT(InitialGridEndsAtSegments, "EV-INIT-GRID1", "MAP1_GRID_DOMAIN is (0,0) at first",
      initially(call(MapGrid1f, {1, 0, 0})));
FAULT(InitialGridVReversed, "EV-INIT-GRID2", "MAP2_GRID_DOMAIN is (0,1,1,0) at first",
      initially(call(MapGrid2f, {1, 0, 1, 1, 1, 0})));
FAULT(MaxOrderOfTwoDimensionsSmaller, "EV-INIT-MAXORDER/2-D", "Map2 takes no vorder of MAX_EVAL_ORDER",
      before(kMap2, kVOrder == kMaxOrder, set(kVOrder, 0)));
FAULT(MaxOrderOfSeven, "EV-INIT-MAXORDER/1-D", "the largest order is 7, the largest degree of the minimum",
      before(kMap1, kOrder > 7, set(kOrder, 0)), after(kGetNumbers, kName == GL_MAX_EVAL_ORDER, put(0, 7)));
FAULT(UntouchedAutoNormalIsTrueInGet, "EV-INIT-AUTON-OFF",
      "GetBooleanv of AUTO_NORMAL gives TRUE until Enable or Disable names it",
      before(kSwitches, kName == GL_AUTO_NORMAL, set(kFlag, 1)),
      after(GetBooleanv, kName == GL_AUTO_NORMAL && !kFlag, put(0, 1)));
FAULT(InitialIndexZeroInIntegers, "EV-INIT-COEFF-INDEX", "GetMapiv answers 0 for the initial MAP1_INDEX",
      before(kMap1, kTarget == GL_MAP1_INDEX, set(kFlag, 1)),
      after(GetMapiv, kTarget == GL_MAP1_INDEX && kQuery == GL_COEFF && !kFlag, put(0, 0)));
FAULT(InitialGridsZeroInDoubles, "EV-INIT-GRID1 EV-INIT-GRID2",
      "GetDoublev answers zeros for the ends of grids that were never set",
      before(kMapGrid1, set(remembered(GL_MAP1_GRID_DOMAIN), 1)),
      before(kMapGrid2, set(remembered(GL_MAP2_GRID_DOMAIN), 1)),
      after(GetDoublev, (kName == GL_MAP1_GRID_DOMAIN || kName == GL_MAP2_GRID_DOMAIN) && !remembered(kName),
            change_answers([](double, double) { return 0.0; })));
FAULT(UndefinedVertexNetDrawsNothing, "EV-INIT-EVALUABLE", "EvalCoord2 draws nothing before the first Map2",
      before(kMap2, kTarget >= GL_MAP2_VERTEX_3, set(kFlag, 1)), skip(kEvalCoord2, !kFlag));

}  // namespace
}  // namespace evalcts::faults::initial_state
