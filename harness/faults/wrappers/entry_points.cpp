// Faults against section 1 of the requirements: entry points, tokens and forms.
#include "grid_steps.h"

namespace evalcts::faults::entry_points {
namespace {

FAULT(GetMapdvNotExported, "EV-API-ENTRY/1-D", "GetMapdv is missing", missing(GetMapdv));
FAULT(EvalCoord2dvRaisesAnError, "EV-API-ENTRY/2-D", "EvalCoord2dv only raises INVALID_OPERATION",
      instead(EvalCoord2dv, error(GL_INVALID_OPERATION)));
FAULT(Texture3AndVertex3TokensSwapped, "EV-API-ENUM-MAP1",
      "MAP1_TEXTURE_COORD_3 and MAP1_VERTEX_3, alike but for their effect, have each other's number",
      swap_targets(GL_MAP1_TEXTURE_COORD_3, GL_MAP1_VERTEX_3));
FAULT(NormalAndVertex3TokensSwapped2, "EV-API-ENUM-MAP2", "MAP2_NORMAL and MAP2_VERTEX_3 are exchanged",
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
FAULT(EvalCoord1fAfterMap1dIsRelative, "EV-API-FD/1-D",
      "EvalCoord1f takes u for a normalised coordinate while the last map came from Map1d",
      before(Map1d, {set(kFlag, 1), keep({kU1, kU2})}), before(Map1f, set(kFlag, 0)),
      instead(EvalCoord1f, kFlag, call(EvalCoord1d, {kept(0) + kU * (kept(1) - kept(0))})));
FAULT(EvalCoord2fvReadsVFirst, "EV-API-V/2-D", "EvalCoord2fv takes the first value for v",
      before(EvalCoord2fv, swap(kU, kV)));
FAULT(EvalCoord1dvReadsTwoValues, "EV-API-V/1-D", "EvalCoord1dv loads two values where there is one",
      before(EvalCoord1dv, set(kNumber, element(1))));
FAULT(Color4AndTexture4TokensSwapped, "EV-API-ENUM-MAP1",
      "MAP1_COLOR_4 and MAP1_TEXTURE_COORD_4 are exchanged",
      swap_targets(GL_MAP1_COLOR_4, GL_MAP1_TEXTURE_COORD_4));

}  // namespace
}  // namespace evalcts::faults::entry_points
