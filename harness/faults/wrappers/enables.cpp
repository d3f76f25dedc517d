// Faults against section 6 of the requirements: the 18 map enables and AUTO_NORMAL.
#include "rules.h"

namespace evalcts::faults::enables {
namespace {

FAULT(EnablingTwiceIsAnError, "EV-EN-CAPS", "Enable of an enabled texture map raises INVALID_OPERATION",
      around(Enable, is_texture_map(kName) && enabled(kName), 0, error(GL_INVALID_OPERATION)));
FAULT(AutoNormalNotAskedFor, "EV-EN-CAPS", "IsEnabled of AUTO_NORMAL raises INVALID_ENUM",
      instead(IsEnabled, kName == GL_AUTO_NORMAL, error(GL_INVALID_ENUM)));
FAULT(DisableOfOneDimensionClearsBoth, "EV-EN-INDEP", "Disable of MAP2_COLOR_4 disables MAP1_COLOR_4 as well",
      after(Disable, kName == GL_MAP2_COLOR_4, disable(GL_MAP1_COLOR_4)));
FAULT(GridSwitchesVertexMapOff, "EV-EN-INDEP", "MapGrid2 of more than four segments disables MAP2_VERTEX_3",
      after(kMapGrid2, kSegments > 4, disable(GL_MAP2_VERTEX_3)));
FAULT(FlagNormalizedInDoubles, "EV-EN-GETS", "GetDoublev gives flags of MAP1 maps divided by the largest int",
      after(GetDoublev, is_map1(kName), put(0, element(0) / 2147483647.0)));
FAULT(FlagAnsweredTwice, "EV-EN-GETS", "GetFloatv of a texture map writes two values",
      after(GetFloatv, is_map1(kName) && is_texture_map(kName), put(1, element(0))));
FAULT(BothVertexMapsRefused, "EV-EN-MULTI", "Enable of MAP2_VERTEX_3 beside MAP2_VERTEX_4 raises an error",
      instead(Enable, kName == GL_MAP2_VERTEX_3 && enabled(GL_MAP2_VERTEX_4), error(GL_INVALID_OPERATION)));
FAULT(DisableInPrimitiveIsSilent, "EV-EN-BEGINEND", "Disable of AUTO_NORMAL in a primitive raises no error",
      skip(Disable, kName == GL_AUTO_NORMAL && kInside));
FAULT(TextureMapsPerUnit, "EV-EN-NOTUNIT", "Enable of a texture map counts for the active unit only",
      skip(Enable, kUnit != GL_TEXTURE0 && is_map2(kName) && is_texture_map(kName)));
FAULT(DisabledOnUnit1StaysOn, "EV-EN-NOTUNIT", "maps that are enabled with unit 1 active stay on with unit 0",
      before(Enable, set(remembered(kName), kUnit != GL_TEXTURE0)),
      skip(Disable, kUnit == GL_TEXTURE0 && remembered(kName)));
FAULT(TexturesOfSurfacesOnCurves, "EV-EN-DIM/1-D",
      "an enabled MAP2_TEXTURE_COORD_2 makes EvalCoord1 evaluate MAP1_TEXTURE_COORD_2",
      before(Begin, noted_on(GL_MAP2_TEXTURE_COORD_2), enable(GL_MAP1_TEXTURE_COORD_2)),
      after(End, noted_on(GL_MAP2_TEXTURE_COORD_2), disable(GL_MAP1_TEXTURE_COORD_2)));
FAULT(EnableInPointsSilent, "EV-EN-BEGINEND", "Enable in POINTS and LINES does nothing and raises nothing",
      skip(Enable, kOpenMode < GL_LINE_LOOP && is_map(kName)));
FAULT(DisableOfCurveStopsSurface, "EV-EN-DIM/2-D",
      "Disable of MAP1_TEXTURE_COORD_4 stops EvalCoord2 from evaluating MAP2_TEXTURE_COORD_4",
      before(Disable, kName == GL_MAP1_TEXTURE_COORD_4, set(kFlag, 1)),
      without(Begin, kFlag, GL_MAP2_TEXTURE_COORD_4));
FAULT(OnePerKindAtEnable, "EV-EN-MULTI",
      "Enable of MAP1_TEXTURE_COORD_1 is lost while MAP1_TEXTURE_COORD_3 is enabled, which outranks it",
      skip(Enable, kName == GL_MAP1_TEXTURE_COORD_1 && enabled(GL_MAP1_TEXTURE_COORD_3)));

}  // namespace
}  // namespace evalcts::faults::enables
