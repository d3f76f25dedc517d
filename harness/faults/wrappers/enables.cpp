// Faults against section 6 of the requirements: the 18 map enables and AUTO_NORMAL.
#include <algorithm>

#include "rules.h"

namespace evalcts::faults::enables {
namespace {

const Value kEnabledMaps = [](Call&) {
  return std::ranges::count_if(gl::kMap1Targets, unmodified.IsEnabled) +
         std::ranges::count_if(gl::kMap2Targets, unmodified.IsEnabled);
};

FAULT(EnablingTwiceIsAnError, "EV-EN-CAPS",
      "Enable of a texture map that is enabled raises INVALID_OPERATION",
      around(Enable, is_texture_map(kName) && enabled(kName), 0, error(GL_INVALID_OPERATION)));
FAULT(DisableOfIndexRefused, "EV-EN-CAPS", "Disable does not know MAP2_INDEX in RGBA contexts",
      before(Disable, kName == GL_MAP2_INDEX, set(kName, 0)));
FAULT(AutoNormalNotAskedFor, "EV-EN-CAPS", "IsEnabled of AUTO_NORMAL raises INVALID_ENUM",
      instead(IsEnabled, kName == GL_AUTO_NORMAL, error(GL_INVALID_ENUM)));
FAULT(EnableToggles, "EV-EN-CAPS", "Enable of MAP1_VERTEX_4 toggles it",
      instead(Enable, kName == GL_MAP1_VERTEX_4 && enabled(kName), disable(kName)));
FAULT(WinnerSwitchesLosersOff, "EV-EN-INDEP",
      "Enable of MAP1_TEXTURE_COORD_4 disables MAP1_TEXTURE_COORD_1, which it outranks",
      after(Enable, kName == GL_MAP1_TEXTURE_COORD_4, disable(GL_MAP1_TEXTURE_COORD_1)));
FAULT(AutoNormalSwitchesNormalsOff, "EV-EN-INDEP", "Enable of AUTO_NORMAL disables MAP2_NORMAL",
      after(Enable, kName == GL_AUTO_NORMAL, disable(GL_MAP2_NORMAL)));
FAULT(DisableOfOneDimensionClearsBoth, "EV-EN-INDEP", "Disable of MAP2_COLOR_4 disables MAP1_COLOR_4 as well",
      after(Disable, kName == GL_MAP2_COLOR_4, disable(GL_MAP1_COLOR_4)));
FAULT(GridSwitchesVertexMapOff, "EV-EN-INDEP", "MapGrid2 of more than four segments disables MAP2_VERTEX_3",
      after(kMapGrid2, kSegments > 4, disable(GL_MAP2_VERTEX_3)));
FAULT(FlagsAreMinusOne, "EV-EN-GETS", "GetIntegerv of AUTO_NORMAL gives -1 for TRUE",
      after(GetIntegerv, kName == GL_AUTO_NORMAL && element(0) == 1, put(0, -1)));
FAULT(FlagsAreBitsInBoolean, "EV-EN-GETS", "GetBooleanv gives the bit of the map instead of TRUE",
      after(GetBooleanv, is_map2(kName) && element(0),
            put(0, [](Call& c) { return 1 << (c.integer('e') & 7); })));
FAULT(FlagNormalizedInDoubles, "EV-EN-GETS", "GetDoublev gives flags of MAP1 maps divided by the largest int",
      after(GetDoublev, is_map1(kName), put(0, element(0) / 2147483647.0)));
FAULT(FlagAnsweredTwice, "EV-EN-GETS", "GetFloatv of a texture map writes two values",
      after(GetFloatv, is_map1(kName) && is_texture_map(kName), put(1, element(0))));
FAULT(BothVertexMapsRefused, "EV-EN-MULTI",
      "Enable of MAP2_VERTEX_3 with MAP2_VERTEX_4 enabled raises INVALID_OPERATION",
      instead(Enable, kName == GL_MAP2_VERTEX_3 && enabled(GL_MAP2_VERTEX_4), error(GL_INVALID_OPERATION)));
FAULT(SixteenMapsAtMost, "EV-EN-MULTI", "the 17th map that is enabled is lost, as there are 16 bits for all",
      after(Enable, is_map(kName) && kEnabledMaps > 16, disable(kName)));
FAULT(IsEnabledAnswersInPrimitives, "EV-EN-BEGINEND",
      "IsEnabled in a primitive raises its error and answers all the same",
      before(Enable, !kInside, set(remembered(kName), 1)),
      after(IsEnabled, kInside, set(kResult, remembered(kName))));
FAULT(EnableInPrimitiveIsKept, "EV-EN-BEGINEND",
      "Enable of a map of one dimension in a primitive raises its error and enables it",
      before(Enable, is_map1(kName) && kInside, set(kCount, kName)),
      after(End, kCount, {enable(kCount), set(kCount, 0)}));
FAULT(DisableInPrimitiveIsSilent, "EV-EN-BEGINEND", "Disable of AUTO_NORMAL in a primitive raises no error",
      skip(Disable, kName == GL_AUTO_NORMAL && kInside));
FAULT(TextureMapsPerUnit, "EV-EN-NOTUNIT", "Enable of a texture map counts for the active unit only",
      skip(Enable, kUnit != GL_TEXTURE0 && is_map2(kName) && is_texture_map(kName)));
FAULT(EnableRefusedOnOtherUnits, "EV-EN-NOTUNIT",
      "Enable of MAP1_TEXTURE_COORD_3 with unit 1 active raises INVALID_OPERATION, as Map1 does",
      after(Enable, kUnit != GL_TEXTURE0 && kName == GL_MAP1_TEXTURE_COORD_3, error(GL_INVALID_OPERATION)));
FAULT(DisabledOnUnit1StaysOn, "EV-EN-NOTUNIT",
      "what was enabled with unit 1 active is not disabled with unit 0 active",
      before(Enable, set(remembered(kName), kUnit != GL_TEXTURE0)),
      skip(Disable, kUnit == GL_TEXTURE0 && remembered(kName)));
FAULT(ColorsOfSurfacesOnCurves, "EV-EN-DIM/1-D",
      "an enabled MAP2_COLOR_4 makes EvalCoord1 evaluate MAP1_COLOR_4",
      before(Begin, noted_on(GL_MAP2_COLOR_4), enable(GL_MAP1_COLOR_4)),
      after(End, noted_on(GL_MAP2_COLOR_4), disable(GL_MAP1_COLOR_4)));
FAULT(TexturesOfSurfacesOnCurves, "EV-EN-DIM/1-D",
      "an enabled MAP2_TEXTURE_COORD_2 makes EvalCoord1 evaluate MAP1_TEXTURE_COORD_2",
      before(Begin, noted_on(GL_MAP2_TEXTURE_COORD_2), enable(GL_MAP1_TEXTURE_COORD_2)),
      after(End, noted_on(GL_MAP2_TEXTURE_COORD_2), disable(GL_MAP1_TEXTURE_COORD_2)));
FAULT(NormalsOfCurvesOnSurfaces, "EV-EN-DIM/2-D",
      "an enabled MAP1_NORMAL makes EvalCoord2 evaluate MAP2_NORMAL",
      before(Begin, noted_on(GL_MAP1_NORMAL), enable(GL_MAP2_NORMAL)),
      after(End, noted_on(GL_MAP1_NORMAL), disable(GL_MAP2_NORMAL)));
FAULT(EnableInPointsSilent, "EV-EN-BEGINEND", "Enable in POINTS and LINES does nothing and raises nothing",
      skip(Enable, kOpenMode < GL_LINE_LOOP && is_map(kName)));
FAULT(IsEnabledSilentAfterVertex, "EV-EN-BEGINEND",
      "IsEnabled after the first vertex of a primitive gives FALSE without an error",
      before(Vertex3f, set(kFlag, 1)), before(End, set(kFlag, 0)), skip(IsEnabled, is_map(kName) && kFlag));
FAULT(EnableLostOnLastUnit, "EV-EN-NOTUNIT",
      "Enable of a texture map is lost on units above 1, which have no evaluators",
      skip(Enable, kUnit > GL_TEXTURE1 && is_texture_map(kName)));
FAULT(EnableLostAtFirstDefinition, "EV-EN-INDEP",
      "Enable of a one-dimensional map without a definition is forgotten by its first definition",
      after(kMap1, kIsLegal && !remembered(kTarget), {set(remembered(kTarget), 1), disable(kTarget)}));
FAULT(DisableOfCurveStopsSurface, "EV-EN-DIM/2-D",
      "Disable of MAP1_TEXTURE_COORD_4 stops EvalCoord2 from evaluating MAP2_TEXTURE_COORD_4",
      before(Disable, kName == GL_MAP1_TEXTURE_COORD_4, set(kFlag, 1)),
      without(Begin, kFlag, GL_MAP2_TEXTURE_COORD_4));
FAULT(DisabledFlagStaysInGet, "EV-EN-GETS", "GetDoublev of a map that was enabled once goes on giving 1",
      before(Enable, set(remembered(kName), 1)),
      after(GetDoublev, is_map(kName) && remembered(kName), put(0, 1)));
FAULT(OnePerKindAtEnable, "EV-EN-MULTI",
      "Enable of MAP1_TEXTURE_COORD_1 is lost while MAP1_TEXTURE_COORD_3 is enabled, which outranks it",
      skip(Enable, kName == GL_MAP1_TEXTURE_COORD_1 && enabled(GL_MAP1_TEXTURE_COORD_3)));

}  // namespace
}  // namespace evalcts::faults::enables
