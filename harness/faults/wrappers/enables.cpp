// Section 6: the 18 map enables and AUTO_NORMAL.
#include "map_calls.h"

namespace evalcts::faults {
namespace {

EVALCTS_FAULT(EnablingTwiceIsAnError, production, must, "EV-EN-CAPS",
              "Enable of a texture map that is enabled raises INVALID_OPERATION") {
  in.gl.Enable = [](GLenum cap) {
    const bool again = (is_texture_map1(cap) || is_texture_map2(cap)) && sound.IsEnabled(cap);
    sound.Enable(cap);
    if (again) leave_error(GL_INVALID_OPERATION);
  };
}

EVALCTS_FAULT(DisableOfIndexRefused, production, must, "EV-EN-CAPS",
              "Disable does not know MAP2_INDEX in RGBA contexts") {
  in.gl.Disable = [](GLenum cap) { sound.Disable(cap == GL_MAP2_INDEX ? 0 : cap); };
}

EVALCTS_FAULT(AutoNormalNotAskedFor, production, must, "EV-EN-CAPS",
              "IsEnabled of AUTO_NORMAL raises INVALID_ENUM") {
  in.gl.IsEnabled = [](GLenum cap) -> GLboolean {
    if (cap != GL_AUTO_NORMAL) return sound.IsEnabled(cap);
    leave_error(GL_INVALID_ENUM);
    return GL_FALSE;
  };
}

EVALCTS_FAULT(EnableToggles, production, must, "EV-EN-CAPS", "Enable of MAP1_VERTEX_4 toggles it") {
  in.gl.Enable = [](GLenum cap) {
    if (cap == GL_MAP1_VERTEX_4 && sound.IsEnabled(cap))
      sound.Disable(cap);
    else
      sound.Enable(cap);
  };
}

EVALCTS_FAULT(WinnerSwitchesLosersOff, production, must, "EV-EN-INDEP",
              "Enable of MAP1_TEXTURE_COORD_4 disables MAP1_TEXTURE_COORD_1, which it outranks") {
  in.gl.Enable = [](GLenum cap) {
    sound.Enable(cap);
    if (cap == GL_MAP1_TEXTURE_COORD_4) sound.Disable(GL_MAP1_TEXTURE_COORD_1);
  };
}

EVALCTS_FAULT(AutoNormalSwitchesNormalsOff, production, must, "EV-EN-INDEP",
              "Enable of AUTO_NORMAL disables MAP2_NORMAL") {
  in.gl.Enable = [](GLenum cap) {
    sound.Enable(cap);
    if (cap == GL_AUTO_NORMAL) sound.Disable(GL_MAP2_NORMAL);
  };
}

EVALCTS_FAULT(DisableOfOneDimensionClearsBoth, production, must, "EV-EN-INDEP",
              "Disable of MAP2_COLOR_4 disables MAP1_COLOR_4 as well") {
  in.gl.Disable = [](GLenum cap) {
    sound.Disable(cap);
    if (cap == GL_MAP2_COLOR_4) sound.Disable(GL_MAP1_COLOR_4);
  };
}

EVALCTS_FAULT(GridSwitchesVertexMapOff, production, must, "EV-EN-INDEP",
              "MapGrid2 of more than four segments disables MAP2_VERTEX_3") {
  map_grid2(in, [](auto call, auto go) {
    go(call);
    if (call.un > 4) sound.Disable(GL_MAP2_VERTEX_3);
  });
}

EVALCTS_FAULT(FlagsAreMinusOne, production, must, "EV-EN-GETS",
              "GetIntegerv of AUTO_NORMAL gives -1 for TRUE") {
  in.gl.GetIntegerv = [](GLenum pname, GLint* v) {
    sound.GetIntegerv(pname, v);
    if (pname == GL_AUTO_NORMAL && *v == 1) *v = -1;
  };
}

EVALCTS_FAULT(FlagsAreBitsInBoolean, production, must, "EV-EN-GETS",
              "GetBooleanv gives the bit of the map instead of TRUE") {
  in.gl.GetBooleanv = [](GLenum pname, GLboolean* v) {
    sound.GetBooleanv(pname, v);
    if (is_map2(pname) && *v) *v = static_cast<GLboolean>(1u << (pname & 7));
  };
}

EVALCTS_FAULT(FlagNormalizedInDoubles, production, must, "EV-EN-GETS",
              "GetDoublev gives flags of MAP1 maps divided by the largest int") {
  in.gl.GetDoublev = [](GLenum pname, GLdouble* v) {
    sound.GetDoublev(pname, v);
    if (is_map1(pname)) *v /= 2147483647.0;
  };
}

EVALCTS_FAULT(FlagAnsweredTwice, production, must, "EV-EN-GETS",
              "GetFloatv of a texture map writes two values") {
  in.gl.GetFloatv = [](GLenum pname, GLfloat* v) {
    sound.GetFloatv(pname, v);
    if (is_texture_map1(pname)) v[1] = v[0];
  };
}

EVALCTS_FAULT(BothVertexMapsRefused, production, must, "EV-EN-MULTI",
              "Enable of MAP2_VERTEX_3 with MAP2_VERTEX_4 enabled raises INVALID_OPERATION") {
  in.gl.Enable = [](GLenum cap) {
    if (cap == GL_MAP2_VERTEX_3 && sound.IsEnabled(GL_MAP2_VERTEX_4))
      return leave_error(GL_INVALID_OPERATION);
    sound.Enable(cap);
  };
}

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

EVALCTS_FAULT(EnableInPrimitiveIsKept, production, must, "EV-EN-BEGINEND",
              "Enable of a map of one dimension in a primitive raises its error and enables it") {
  follow_primitives(in);
  in.gl.End = [] {
    memory.flag = false;
    sound.End();
    if (memory.count) sound.Enable(static_cast<GLenum>(memory.count));
    memory.count = 0;
  };
  in.gl.Enable = [](GLenum cap) {
    if (memory.flag && is_map1(cap)) memory.count = cap;
    sound.Enable(cap);
  };
}

EVALCTS_FAULT(DisableInPrimitiveIsSilent, production, must, "EV-EN-BEGINEND",
              "Disable of AUTO_NORMAL in a primitive raises no error") {
  follow_primitives(in);
  in.gl.Disable = [](GLenum cap) {
    if (!memory.flag || cap != GL_AUTO_NORMAL) sound.Disable(cap);
  };
}

EVALCTS_FAULT(TextureMapsPerUnit, production, must, "EV-EN-NOTUNIT",
              "Enable of a texture map counts for the active unit only") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.flag = texture != GL_TEXTURE0;
    sound.ActiveTexture(texture);
  };
  in.gl.Enable = [](GLenum cap) {
    if (!memory.flag || !is_texture_map2(cap)) sound.Enable(cap);
  };
}

EVALCTS_FAULT(EnableRefusedOnOtherUnits, production, must, "EV-EN-NOTUNIT",
              "Enable of MAP1_TEXTURE_COORD_3 with unit 1 active raises INVALID_OPERATION, as Map1 does") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.flag = texture != GL_TEXTURE0;
    sound.ActiveTexture(texture);
  };
  in.gl.Enable = [](GLenum cap) {
    sound.Enable(cap);
    if (memory.flag && cap == GL_MAP1_TEXTURE_COORD_3) leave_error(GL_INVALID_OPERATION);
  };
}

EVALCTS_FAULT(DisabledOnUnit1StaysOn, production, must, "EV-EN-NOTUNIT",
              "what was enabled with unit 1 active is not disabled with unit 0 active") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.flag = texture != GL_TEXTURE0;
    sound.ActiveTexture(texture);
  };
  in.gl.Enable = [](GLenum cap) {
    memory.counts[cap] = memory.flag;
    sound.Enable(cap);
  };
  in.gl.Disable = [](GLenum cap) {
    if (memory.flag || !memory.counts[cap]) sound.Disable(cap);
  };
}

// With the namesake of an enabled map switched on while a primitive is open.
template <GLenum kEnabled, GLenum kNamesake>
void leak_into_other_dimension(Injection& in) {
  in.gl.Enable = [](GLenum cap) {
    if (cap == kEnabled) memory.flag = true;
    sound.Enable(cap);
  };
  in.gl.Disable = [](GLenum cap) {
    if (cap == kEnabled) memory.flag = false;
    sound.Disable(cap);
  };
  in.gl.Begin = [](GLenum mode) {
    if (memory.flag) sound.Enable(kNamesake);
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.flag) sound.Disable(kNamesake);
  };
}

EVALCTS_FAULT(ColorsOfSurfacesOnCurves, production, must, "EV-EN-DIM/1-D",
              "an enabled MAP2_COLOR_4 makes EvalCoord1 evaluate MAP1_COLOR_4") {
  leak_into_other_dimension<GL_MAP2_COLOR_4, GL_MAP1_COLOR_4>(in);
}

EVALCTS_FAULT(TexturesOfSurfacesOnCurves, production, must, "EV-EN-DIM/1-D",
              "an enabled MAP2_TEXTURE_COORD_2 makes EvalCoord1 evaluate MAP1_TEXTURE_COORD_2") {
  leak_into_other_dimension<GL_MAP2_TEXTURE_COORD_2, GL_MAP1_TEXTURE_COORD_2>(in);
}

EVALCTS_FAULT(NormalsOfCurvesOnSurfaces, production, must, "EV-EN-DIM/2-D",
              "an enabled MAP1_NORMAL makes EvalCoord2 evaluate MAP2_NORMAL") {
  leak_into_other_dimension<GL_MAP1_NORMAL, GL_MAP2_NORMAL>(in);
}

EVALCTS_FAULT(EnableInPointsSilent, production, must, "EV-EN-BEGINEND",
              "Enable in POINTS and LINES does nothing and raises nothing") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = mode < GL_LINE_LOOP;
    sound.Begin(mode);
  };
  in.gl.End = [] {
    memory.flag = false;
    sound.End();
  };
  in.gl.Enable = [](GLenum cap) {
    if (!memory.flag || !is_map(cap)) sound.Enable(cap);
  };
}

EVALCTS_FAULT(IsEnabledSilentAfterVertex, production, must, "EV-EN-BEGINEND",
              "IsEnabled after the first vertex of a primitive gives FALSE without an error") {
  in.gl.Vertex3f = [](GLfloat x, GLfloat y, GLfloat z) {
    memory.flag = true;
    sound.Vertex3f(x, y, z);
  };
  in.gl.End = [] {
    memory.flag = false;
    sound.End();
  };
  in.gl.IsEnabled = [](GLenum cap) -> GLboolean {
    return memory.flag && is_map(cap) ? GL_FALSE : sound.IsEnabled(cap);
  };
}

EVALCTS_FAULT(EnableLostOnLastUnit, production, must, "EV-EN-NOTUNIT",
              "Enable of a texture map is lost on units above 1, which have no evaluators") {
  in.gl.ActiveTexture = [](GLenum texture) {
    memory.flag = texture > GL_TEXTURE1;
    sound.ActiveTexture(texture);
  };
  in.gl.Enable = [](GLenum cap) {
    if (!memory.flag || !(is_texture_map1(cap) || is_texture_map2(cap))) sound.Enable(cap);
  };
}

EVALCTS_FAULT(EnableLostAtFirstDefinition, production, must, "EV-EN-INDEP",
              "Enable of a one-dimensional map without a definition is forgotten by its first definition") {
  map1(in, [](auto call, auto go) {
    go(call);
    if (legal(call) && memory.counts[call.target]++ == 0) sound.Disable(call.target);
  });
}

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

EVALCTS_FAULT(DisabledFlagStaysInGet, production, must, "EV-EN-GETS",
              "GetDoublev of a map that was enabled once goes on giving 1") {
  in.gl.Enable = [](GLenum cap) {
    memory.counts[cap] = 1;
    sound.Enable(cap);
  };
  in.gl.GetDoublev = [](GLenum pname, GLdouble* v) {
    sound.GetDoublev(pname, v);
    if (is_map(pname) && memory.counts[pname]) *v = 1;
  };
}

EVALCTS_FAULT(
    OnePerKindAtEnable, production, must, "EV-EN-MULTI",
    "Enable of MAP1_TEXTURE_COORD_1 is lost while MAP1_TEXTURE_COORD_3 is enabled, which outranks it") {
  in.gl.Enable = [](GLenum cap) {
    if (cap != GL_MAP1_TEXTURE_COORD_1 || !sound.IsEnabled(GL_MAP1_TEXTURE_COORD_3)) sound.Enable(cap);
  };
}

}  // namespace
}  // namespace evalcts::faults
