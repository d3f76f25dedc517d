// Faults against section 1 of the requirements: entry points, tokens and forms.
#include "grid_steps.h"

namespace evalcts::faults::entry_points {
namespace {

FAULT(GetMapdvNotExported, "EV-API-ENTRY/1-D", "GetMapdv is missing", missing(GetMapdv));
FAULT(EvalCoord2dvIsAStub, "EV-API-ENTRY/2-D", "EvalCoord2dv is a stub that raises INVALID_OPERATION",
      instead(EvalCoord2dv, error(GL_INVALID_OPERATION)));
FAULT(FirstMapGrid2dFails, "EV-API-ENTRY/2-D",
      "the first MapGrid2d of a context raises INVALID_OPERATION as well",
      after(MapGrid2d, !kFlag, {set(kFlag, 1), error(GL_INVALID_OPERATION)}));
FAULT(IndexAndTexture1TokensSwapped, "EV-API-ENUM-MAP1",
      "MAP1_INDEX and MAP1_TEXTURE_COORD_1 have each other's number",
      swap_targets(GL_MAP1_INDEX, GL_MAP1_TEXTURE_COORD_1));
FAULT(Texture3AndVertex3TokensSwapped, "EV-API-ENUM-MAP1",
      "MAP1_TEXTURE_COORD_3 and MAP1_VERTEX_3, alike but for their effect, have each other's number",
      swap_targets(GL_MAP1_TEXTURE_COORD_3, GL_MAP1_VERTEX_3));
FAULT(NormalAndVertex3TokensSwapped2, "EV-API-ENUM-MAP2",
      "MAP2_NORMAL and MAP2_VERTEX_3 have each other's number",
      swap_targets(GL_MAP2_NORMAL, GL_MAP2_VERTEX_3));
FAULT(Texture4AndVertex4TokensSwapped2, "EV-API-ENUM-MAP2",
      "MAP2_TEXTURE_COORD_4 and MAP2_VERTEX_4, alike but for their effect, have each other's number",
      swap_targets(GL_MAP2_TEXTURE_COORD_4, GL_MAP2_VERTEX_4));
FAULT(CoeffAndDomainTokensSwapped, "EV-API-ENUM-OTHER", "COEFF and DOMAIN have each other's number",
      before(kGetMap, set(kQuery, swapped(kQuery, GL_COEFF, GL_DOMAIN))));
FAULT(MeshModesShifted, "EV-API-ENUM-OTHER/2-D",
      "mesh modes begin at 0x1B01: POINT draws lines, LINE fills, FILL draws points",
      before(EvalMesh2, kIsMode2, set(kMode, choose(kMode == GL_FILL, GL_POINT, kMode + 1))));
FAULT(MeshPointAndLineSwapped, "EV-API-ENUM-OTHER/1-D", "EvalMesh1 takes POINT for LINE and LINE for POINT",
      before(EvalMesh1, set(kMode, swapped(kMode, GL_POINT, GL_LINE))));
FAULT(GridSegmentTokensSwapped, "EV-API-ENUM-OTHER/1-D",
      "MAP1_GRID_SEGMENTS and MAP2_GRID_SEGMENTS have each other's number",
      before(kGet, set(kName, swapped(kName, GL_MAP1_GRID_SEGMENTS, GL_MAP2_GRID_SEGMENTS))));
FAULT(EvalBitIsListBit, "EV-API-ENUM-OTHER", "EVAL_BIT and LIST_BIT have each other's number",
      before(PushAttrib, set(kFirst, kFirst - (kFirst & (GL_EVAL_BIT | GL_LIST_BIT)) +
                                         choose(kFirst & GL_EVAL_BIT, GL_LIST_BIT, 0) +
                                         choose(kFirst & GL_LIST_BIT, GL_EVAL_BIT, 0))));
FAULT(Map1fKeepsPointsOfMap1d, "EV-API-FD/1-D",
      "Map1f after Map1d of the same target and order sets the domain and leaves the points",
      before(Map1d, kIsLegal, set(remembered(kTarget), kOrder)),
      instead(Map1f, is_map1(kTarget) && remembered(kTarget) == kOrder, redefine(kTarget, take_u)));
FAULT(GetMapdvAnswersFromLastMap2d, "EV-API-FD/2-D",
      "GetMapdv answers the domain that the last Map2d gave, although a Map2f came after it",
      before(Map2d, {set(kNumber, kTarget), keep({kU1, kU2, kV1, kV2})}),
      after(GetMapdv, kQuery == GL_DOMAIN && is_map2(kTarget) && kTarget == kNumber, answer(kept_values(4))));
FAULT(MapGrid2fKeepsVOfMapGrid2d, "EV-API-FD/2-D EV-GRID-FD",
      "MapGrid2f leaves the v interval that MapGrid2d set",
      before(MapGrid2d, {set(kFlag, 1), keep({kV1, kV2})}),
      instead(MapGrid2f, kFlag, call(MapGrid2d, {kSegments, kU1, kU2, kVSegments, kept(0), kept(1)})));
FAULT(EvalCoord1fAfterMap1dIsRelative, "EV-API-FD/1-D",
      "EvalCoord1f takes u for a normalised coordinate while the last map came from Map1d",
      before(Map1d, {set(kFlag, 1), keep({kU1, kU2})}), before(Map1f, set(kFlag, 0)),
      instead(EvalCoord1f, kFlag, call(EvalCoord1d, {kept(0) + kU * (kept(1) - kept(0))})));
FAULT(EvalCoord2fvReadsVFirst, "EV-API-V/2-D", "EvalCoord2fv takes the first value for v",
      before(EvalCoord2fv, swap(kU, kV)));
FAULT(EvalCoord1dvReadsTwoValues, "EV-API-V/1-D", "EvalCoord1dv loads two values where there is one",
      before(EvalCoord1dv, set(kNumber, element(1))));
FAULT(EvalCoord2dvCountsInFloats, "EV-API-V/2-D", "EvalCoord2dv reads v from its place in an array of floats",
      before(EvalCoord2dv, set(kV, [](Call& c) { return static_cast<const GLfloat*>(c.pointer)[1]; })));
QUALITY_FAULT(EvalCoord1fvOneUlpOff, "EV-API-V/1-D", "EvalCoord1fv evaluates at the next float",
              before(EvalCoord1fv, set(kU, next_float(kU, 2))));
QUALITY_FAULT(EvalCoord2dvThroughFloats, "EV-API-V/2-D", "EvalCoord2dv takes v from the float below it",
              before(EvalCoord2dv, set(kV, next_float(kV, -2))));
FAULT(Color4AndTexture4TokensSwapped, "EV-API-ENUM-MAP1",
      "MAP1_COLOR_4 and MAP1_TEXTURE_COORD_4 have each other's number",
      swap_targets(GL_MAP1_COLOR_4, GL_MAP1_TEXTURE_COORD_4));
FAULT(Texture3AndVertex3TokensSwapped2, "EV-API-ENUM-MAP2",
      "MAP2_TEXTURE_COORD_3 and MAP2_VERTEX_3, alike but for their effect, have each other's number",
      swap_targets(GL_MAP2_TEXTURE_COORD_3, GL_MAP2_VERTEX_3));
FAULT(EvalCoord2dAfterMap2fIsRelative, "EV-API-FD/2-D",
      "EvalCoord2d takes u for a normalised coordinate while the last map came from Map2f",
      before(Map2f, {set(kFlag, 1), keep({kU1, kU2})}), before(Map2d, set(kFlag, 0)),
      before(EvalCoord2d, kFlag, set(kU, kept(0) + kU * (kept(1) - kept(0)))));

}  // namespace
}  // namespace evalcts::faults::entry_points
