// Section 6: the 18 map enables and AUTO_NORMAL.
#include "map_calls.h"
#include "rules.h"

namespace evalcts::faults {
namespace {

EVALCTS_RULES(EnablingTwiceIsAnError, production, must, "EV-EN-CAPS",
              "Enable of a texture map that is enabled raises INVALID_OPERATION",
              around(Enable, is_texture_map(kName) && enabled(kName), 0, error(GL_INVALID_OPERATION)));
EVALCTS_RULES(DisableOfIndexRefused, production, must, "EV-EN-CAPS",
              "Disable does not know MAP2_INDEX in RGBA contexts",
              before(Disable, kName == GL_MAP2_INDEX, set(kName, 0)));
EVALCTS_RULES(AutoNormalNotAskedFor, production, must, "EV-EN-CAPS",
              "IsEnabled of AUTO_NORMAL raises INVALID_ENUM",
              instead(IsEnabled, kName == GL_AUTO_NORMAL, error(GL_INVALID_ENUM)));
EVALCTS_RULES(EnableToggles, production, must, "EV-EN-CAPS", "Enable of MAP1_VERTEX_4 toggles it",
              instead(Enable, kName == GL_MAP1_VERTEX_4 && enabled(kName), call(Disable, {kName})));
EVALCTS_RULES(WinnerSwitchesLosersOff, production, must, "EV-EN-INDEP",
              "Enable of MAP1_TEXTURE_COORD_4 disables MAP1_TEXTURE_COORD_1, which it outranks",
              after(Enable, kName == GL_MAP1_TEXTURE_COORD_4, call(Disable, {GL_MAP1_TEXTURE_COORD_1})));
EVALCTS_RULES(AutoNormalSwitchesNormalsOff, production, must, "EV-EN-INDEP",
              "Enable of AUTO_NORMAL disables MAP2_NORMAL",
              after(Enable, kName == GL_AUTO_NORMAL, call(Disable, {GL_MAP2_NORMAL})));
EVALCTS_RULES(DisableOfOneDimensionClearsBoth, production, must, "EV-EN-INDEP",
              "Disable of MAP2_COLOR_4 disables MAP1_COLOR_4 as well",
              after(Disable, kName == GL_MAP2_COLOR_4, call(Disable, {GL_MAP1_COLOR_4})));
EVALCTS_RULES(GridSwitchesVertexMapOff, production, must, "EV-EN-INDEP",
              "MapGrid2 of more than four segments disables MAP2_VERTEX_3",
              after(kMapGrid2, kSegments > 4, call(Disable, {GL_MAP2_VERTEX_3})));
EVALCTS_RULES(FlagsAreMinusOne, production, must, "EV-EN-GETS",
              "GetIntegerv of AUTO_NORMAL gives -1 for TRUE",
              after(GetIntegerv, kName == GL_AUTO_NORMAL && element(0) == 1, put(0, -1)));

EVALCTS_FAULT(FlagsAreBitsInBoolean, production, must, "EV-EN-GETS",
              "GetBooleanv gives the bit of the map instead of TRUE") {
  in.gl.GetBooleanv = [](GLenum pname, GLboolean* v) {
    sound.GetBooleanv(pname, v);
    if (is_map2(pname) && *v) *v = static_cast<GLboolean>(1u << (pname & 7));
  };
}

EVALCTS_RULES(FlagNormalizedInDoubles, production, must, "EV-EN-GETS",
              "GetDoublev gives flags of MAP1 maps divided by the largest int",
              after(GetDoublev, is_map1(kName), put(0, element(0) / 2147483647.0)));
EVALCTS_RULES(FlagAnsweredTwice, production, must, "EV-EN-GETS",
              "GetFloatv of a texture map writes two values",
              after(GetFloatv, is_map1(kName) && is_texture_map(kName), put(1, element(0))));
EVALCTS_RULES(BothVertexMapsRefused, production, must, "EV-EN-MULTI",
              "Enable of MAP2_VERTEX_3 with MAP2_VERTEX_4 enabled raises INVALID_OPERATION",
              instead(Enable, kName == GL_MAP2_VERTEX_3 && enabled(GL_MAP2_VERTEX_4),
                      error(GL_INVALID_OPERATION)));

EVALCTS_FAULT(SixteenMapsAtMost, production, must, "EV-EN-MULTI",
              "the 17th map that is enabled is lost, as there are 16 bits for all") {
  in.gl.Enable = [](GLenum cap) {
    sound.Enable(cap);
    if (!is_map(cap)) return;
    long enabled = 0;
    for (const GLenum target : gl::kMap1Targets) enabled += sound.IsEnabled(target);
    for (const GLenum target : gl::kMap2Targets) enabled += sound.IsEnabled(target);
    if (enabled > 16) sound.Disable(cap);
  };
}

EVALCTS_FAULT(IsEnabledAnswersInPrimitives, production, must, "EV-EN-BEGINEND",
              "IsEnabled in a primitive raises its error and answers all the same") {
  follow_primitives(in);
  in.gl.Enable = [](GLenum cap) {
    if (!memory.flag) memory.counts[cap] = 1;
    sound.Enable(cap);
  };
  in.gl.IsEnabled = [](GLenum cap) -> GLboolean {
    const GLboolean sound_answer = sound.IsEnabled(cap);
    return memory.flag ? static_cast<GLboolean>(memory.counts[cap]) : sound_answer;
  };
}

EVALCTS_RULES(EnableInPrimitiveIsKept, production, must, "EV-EN-BEGINEND",
              "Enable of a map of one dimension in a primitive raises its error and enables it",
              before(Enable, kInside&& is_map1(kName), set(kCount, kName)),
              after(End, kCount, sequence({call(Enable, {kCount}), set(kCount, 0)})));
EVALCTS_RULES(DisableInPrimitiveIsSilent, production, must, "EV-EN-BEGINEND",
              "Disable of AUTO_NORMAL in a primitive raises no error",
              skip(Disable, kInside&& kName == GL_AUTO_NORMAL));
EVALCTS_RULES(TextureMapsPerUnit, production, must, "EV-EN-NOTUNIT",
              "Enable of a texture map counts for the active unit only",
              skip(Enable, kUnit != GL_TEXTURE0 && is_map2(kName) && is_texture_map(kName)));
EVALCTS_RULES(EnableRefusedOnOtherUnits, production, must, "EV-EN-NOTUNIT",
              "Enable of MAP1_TEXTURE_COORD_3 with unit 1 active raises INVALID_OPERATION, as Map1 does",
              after(Enable, kUnit != GL_TEXTURE0 && kName == GL_MAP1_TEXTURE_COORD_3,
                    error(GL_INVALID_OPERATION)));
EVALCTS_RULES(DisabledOnUnit1StaysOn, production, must, "EV-EN-NOTUNIT",
              "what was enabled with unit 1 active is not disabled with unit 0 active",
              before(Enable, true, set(remembered(kName), kUnit != GL_TEXTURE0)),
              skip(Disable, kUnit == GL_TEXTURE0 && remembered(kName)));

EVALCTS_RULES(ColorsOfSurfacesOnCurves, production, must, "EV-EN-DIM/1-D",
              "an enabled MAP2_COLOR_4 makes EvalCoord1 evaluate MAP1_COLOR_4",
              before(Begin, noted_on(GL_MAP2_COLOR_4), call(Enable, {GL_MAP1_COLOR_4})),
              after(End, noted_on(GL_MAP2_COLOR_4), call(Disable, {GL_MAP1_COLOR_4})));
EVALCTS_RULES(TexturesOfSurfacesOnCurves, production, must, "EV-EN-DIM/1-D",
              "an enabled MAP2_TEXTURE_COORD_2 makes EvalCoord1 evaluate MAP1_TEXTURE_COORD_2",
              before(Begin, noted_on(GL_MAP2_TEXTURE_COORD_2), call(Enable, {GL_MAP1_TEXTURE_COORD_2})),
              after(End, noted_on(GL_MAP2_TEXTURE_COORD_2), call(Disable, {GL_MAP1_TEXTURE_COORD_2})));
EVALCTS_RULES(NormalsOfCurvesOnSurfaces, production, must, "EV-EN-DIM/2-D",
              "an enabled MAP1_NORMAL makes EvalCoord2 evaluate MAP2_NORMAL",
              before(Begin, noted_on(GL_MAP1_NORMAL), call(Enable, {GL_MAP2_NORMAL})),
              after(End, noted_on(GL_MAP1_NORMAL), call(Disable, {GL_MAP2_NORMAL})));
EVALCTS_RULES(EnableInPointsSilent, production, must, "EV-EN-BEGINEND",
              "Enable in POINTS and LINES does nothing and raises nothing",
              skip(Enable, kOpenMode < GL_LINE_LOOP && is_map(kName)));
EVALCTS_RULES(IsEnabledSilentAfterVertex, production, must, "EV-EN-BEGINEND",
              "IsEnabled after the first vertex of a primitive gives FALSE without an error",
              before(Vertex3f, true, set(kFlag, 1)), before(End, true, set(kFlag, 0)),
              skip(IsEnabled, kFlag&& is_map(kName)));
EVALCTS_RULES(EnableLostOnLastUnit, production, must, "EV-EN-NOTUNIT",
              "Enable of a texture map is lost on units above 1, which have no evaluators",
              skip(Enable, kUnit > GL_TEXTURE1 && is_texture_map(kName)));
EVALCTS_RULES(EnableLostAtFirstDefinition, production, must, "EV-EN-INDEP",
              "Enable of a one-dimensional map without a definition is forgotten by its first definition",
              after(kMap1, kIsLegal && !remembered(kTarget),
                    sequence({set(remembered(kTarget), 1), call(Disable, {kTarget})})));

EVALCTS_FAULT(DisableOfCurveStopsSurface, production, must, "EV-EN-DIM/2-D",
              "Disable of MAP1_TEXTURE_COORD_4 stops EvalCoord2 from evaluating MAP2_TEXTURE_COORD_4") {
  in.gl.Disable = [](GLenum cap) {
    if (cap == GL_MAP1_TEXTURE_COORD_4) memory.flag = true;
    sound.Disable(cap);
  };
  in.gl.Begin = [](GLenum mode) {
    if (memory.flag && sound.IsEnabled(GL_MAP2_TEXTURE_COORD_4)) {
      memory.count = 1;
      sound.Disable(GL_MAP2_TEXTURE_COORD_4);
    }
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.count) sound.Enable(GL_MAP2_TEXTURE_COORD_4);
    memory.count = 0;
  };
}

EVALCTS_RULES(DisabledFlagStaysInGet, production, must, "EV-EN-GETS",
              "GetDoublev of a map that was enabled once goes on giving 1",
              before(Enable, true, set(remembered(kName), 1)),
              after(GetDoublev, is_map(kName) && remembered(kName), put(0, 1)));
EVALCTS_RULES(
    OnePerKindAtEnable, production, must, "EV-EN-MULTI",
    "Enable of MAP1_TEXTURE_COORD_1 is lost while MAP1_TEXTURE_COORD_3 is enabled, which outranks it",
    skip(Enable, kName == GL_MAP1_TEXTURE_COORD_1 && enabled(GL_MAP1_TEXTURE_COORD_3)));

}  // namespace
}  // namespace evalcts::faults
