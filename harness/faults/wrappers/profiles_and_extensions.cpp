// Sections 23 and 24: contexts without evaluators, and extensions that touch them.
#include <algorithm>
#include <utility>

#include <evalcts/gl/tokens.h>
#include "around.h"
#include "forms.h"

namespace evalcts::faults::profiles_and_extensions {
namespace {

// --- Profiles ----------------------------------------------------------------------------------------------

// memory.count is the kind of the context of the case that has one; 0 where it is the usual one.
void watch_kind(Injection& in) {
  in.gl.ContextOfKindEVALCTS = [](GLuint context, GLuint kind) {
    sound.ContextOfKindEVALCTS(context, kind);
    memory.count = static_cast<long>(kind);
  };
}
bool is_core() { return memory.count == EVALCTS_CORE_PROFILE; }

EVALCTS_FAULT(CoreProfileAnswersGetMap, osmesa, must, "EV-PROF-CORE-FUNC",
              "GetMapiv is no error in a core profile") {
  watch_kind(in);
  in.gl.GetMapiv = [](GLenum target, GLenum query, GLint* v) {
    if (is_core())
      *v = 1;
    else
      sound.GetMapiv(target, query, v);
  };
}

EVALCTS_FAULT(CoreProfileIgnoresEvalPoint, osmesa, must, "EV-PROF-CORE-FUNC",
              "EvalPoint2 does nothing in a core profile, without an error") {
  watch_kind(in);
  in.gl.EvalPoint2 = [](GLint i, GLint j) {
    if (!is_core()) sound.EvalPoint2(i, j);
  };
}

EVALCTS_FAULT(CoreProfileGridIsInvalidValue, osmesa, must, "EV-PROF-CORE-FUNC",
              "MapGrid1d raises INVALID_VALUE in a core profile") {
  watch_kind(in);
  in.gl.MapGrid1d = [](GLint n, GLdouble u1, GLdouble u2) {
    if (is_core())
      sound.Viewport(0, 0, -1, -1);
    else
      sound.MapGrid1d(n, u1, u2);
  };
}

EVALCTS_FAULT(CoreProfileEnablesAutoNormal, osmesa, must, "EV-PROF-CORE-ENABLE",
              "AUTO_NORMAL can be enabled in a core profile") {
  watch_kind(in);
  in.gl.Enable = [](GLenum cap) {
    if (!is_core() || cap != GL_AUTO_NORMAL) sound.Enable(cap);
  };
}

EVALCTS_FAULT(CoreProfileTellsIndexMap, osmesa, must, "EV-PROF-CORE-ENABLE",
              "IsEnabled(MAP2_INDEX) is no error in a core profile") {
  watch_kind(in);
  in.gl.IsEnabled = [](GLenum cap) -> GLboolean {
    return is_core() && cap == GL_MAP2_INDEX ? GL_FALSE : sound.IsEnabled(cap);
  };
}

EVALCTS_FAULT(CoreProfileDisableIsInvalidOperation, osmesa, must, "EV-PROF-CORE-ENABLE",
              "Disable of a map raises INVALID_OPERATION in a core profile") {
  watch_kind(in);
  in.gl.Disable = [](GLenum cap) {
    if (is_core() && gl::components_of(cap))
      sound.EvalPoint1(0);
    else
      sound.Disable(cap);
  };
}

EVALCTS_FAULT(CoreProfileTellsMaxEvalOrder, dropin, must, "EV-PROF-CORE-GET",
              "GetIntegerv(MAX_EVAL_ORDER) answers in a core profile") {
  watch_kind(in);
  in.gl.GetIntegerv = [](GLenum pname, GLint* v) {
    if (is_core() && pname == GL_MAX_EVAL_ORDER)
      *v = 30;
    else
      sound.GetIntegerv(pname, v);
  };
}

EVALCTS_FAULT(CoreProfileTellsGrid, dropin, must, "EV-PROF-CORE-GET",
              "GetFloatv(MAP1_GRID_DOMAIN) answers in a core profile") {
  watch_kind(in);
  in.gl.GetFloatv = [](GLenum pname, GLfloat* v) {
    if (!is_core() || pname != GL_MAP1_GRID_DOMAIN) return sound.GetFloatv(pname, v);
    v[0] = 0;
    v[1] = 1;
  };
}

bool is_forward_compatible() { return memory.count == EVALCTS_FORWARD_COMPATIBLE; }

EVALCTS_FAULT(ForwardCompatibleTakesMap1f, egl, must, "EV-PROF-CORE-FUNC",
              "Map1f does nothing in a forward-compatible context, without an error") {
  watch_kind(in);
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    if (!is_forward_compatible()) sound.Map1f(target, u1, u2, stride, order, points);
  };
}

EVALCTS_FAULT(ForwardCompatibleDisablesMaps, egl, must, "EV-PROF-CORE-ENABLE",
              "Disable(MAP1_COLOR_4) is no error in a forward-compatible context") {
  watch_kind(in);
  in.gl.Disable = [](GLenum cap) {
    if (!is_forward_compatible() || cap != GL_MAP1_COLOR_4) sound.Disable(cap);
  };
}

bool reports_no_errors() { return memory.count == EVALCTS_NO_ERROR; }

EVALCTS_FAULT(NoErrorContextReportsMesh, egl, must, "EV-PROF-NOERROR",
              "a legal EvalMesh1 is reported as an error in a no-error context") {
  watch_kind(in);
  mesh1(in, [](auto call) {
    go1(call);
    memory.flag = reports_no_errors();
  });
  in.gl.GetError = []() -> GLenum {
    return std::exchange(memory.flag, false) ? GL_INVALID_VALUE : sound.GetError();
  };
}

EVALCTS_FAULT(NoErrorContextIgnoresGrid, egl, must, "EV-PROF-NOERROR",
              "a no-error context skips MapGrid1f together with the checks of its arguments") {
  watch_kind(in);
  in.gl.MapGrid1f = [](GLint n, GLfloat u1, GLfloat u2) {
    if (!reports_no_errors()) sound.MapGrid1f(n, u1, u2);
  };
}

EVALCTS_FAULT(MeshErrorsNotLogged, egl, quality, "EV-PIPE-DEBUG",
              "a debug context has no message for errors of EvalMesh1") {
  mesh1(in, [](auto call) {
    go1(call);
    const bool bad = call.mode != GL_POINT && call.mode != GL_LINE;
    if (bad) sound.GetDebugMessageLog(64, 0, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
  });
}

EVALCTS_FAULT(GridErrorsLoggedAsOthers, egl, quality, "EV-PIPE-DEBUG",
              "the message for an error of MapGrid is of type DEBUG_TYPE_OTHER") {
  map_grid1(in, [](auto n, auto u1, auto u2, auto go) {
    go(n, u1, u2);
    memory.flag = n <= 0;
  });
  in.gl.GetDebugMessageLog = [](GLuint count, GLsizei size, GLenum* sources, GLenum* types, GLuint* ids,
                                GLenum* severities, GLsizei* lengths, GLchar* text) -> GLuint {
    const GLuint found =
        sound.GetDebugMessageLog(count, size, sources, types, ids, severities, lengths, text);
    if (types && memory.flag) std::fill_n(types, found, GLenum{GL_DEBUG_TYPE_OTHER});
    memory.flag = false;
    return found;
  };
}

EVALCTS_FAULT(CompatibilityWithoutMap2d, production, must, "EV-PROF-COMPAT",
              "Map2d is removed from contexts of 3.1 and later") {
  in.gl.Map2d = [](GLenum, GLdouble, GLdouble, GLint, GLint, GLdouble, GLdouble, GLint, GLint,
                   const GLdouble*) { raise(GL_INVALID_OPERATION); };
}

EVALCTS_FAULT(CompatibilityWithoutIndexMaps, production, must, "EV-PROF-COMPAT",
              "MAP1_INDEX is removed from contexts of 3.1 and later") {
  in.gl.Enable = [](GLenum cap) {
    if (cap == GL_MAP1_INDEX)
      raise(GL_INVALID_ENUM);
    else
      sound.Enable(cap);
  };
}

EVALCTS_FAULT(CompatibilityOrderOfOldHardware, production, must, "EV-PROF-COMPAT",
              "MAX_EVAL_ORDER is 4 in contexts of 3.1 and later") {
  get(in, [](GLenum pname, auto v, auto go) {
    go(pname, v);
    if (pname == GL_MAX_EVAL_ORDER) *v = 4;
  });
}

EVALCTS_FAULT(CompatibilityMeshesDrawNothing, production, must, "EV-PROF-COMPAT",
              "EvalMesh1 is there in contexts of 3.1 and later, and does nothing") {
  mesh1(in, [](auto) {});
}

EVALCTS_FAULT(CompatibilityWithoutAutoNormal, production, must, "EV-PROF-COMPAT",
              "AUTO_NORMAL can be enabled in contexts of 3.1 and later, and does nothing") {
  in.gl.Enable = [](GLenum cap) {
    if (cap == GL_AUTO_NORMAL)
      memory.flag = true;
    else
      sound.Enable(cap);
  };
  in.gl.IsEnabled = [](GLenum cap) -> GLboolean {
    return cap == GL_AUTO_NORMAL ? memory.flag : sound.IsEnabled(cap);
  };
}

// --- ARB_multitexture --------------------------------------------------------------------------------------

template <class Call, class Go>
void whatever_unit(const Call& call, Go go) {
  const auto unit = static_cast<GLenum>(integer(GL_ACTIVE_TEXTURE));
  sound.ActiveTexture(GL_TEXTURE0);
  go(call);
  sound.ActiveTexture(unit);
}

EVALCTS_FAULT(ActiveTextureRuleForTexturesOnly, production, must, "EV-EXT-MT-RULE",
              "under another texture unit Map1 refuses maps of texture coordinates alone") {
  map1(in, [](auto call, auto go) {
    const bool texture = call.target >= GL_MAP1_TEXTURE_COORD_1 && call.target <= GL_MAP1_TEXTURE_COORD_4;
    if (texture)
      go(call);
    else
      whatever_unit(call, go);
  });
}

EVALCTS_FAULT(ActiveTextureRuleNotForMap2d, production, must, "EV-EXT-MT-RULE",
              "Map2d takes points whatever the texture unit") {
  in.gl.Map2d = [](GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                   GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    whatever_unit(
        0, [&](int) { sound.Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points); });
  };
}

EVALCTS_FAULT(ActiveTextureRuleForUnitOneOnly, production, must, "EV-EXT-MT-RULE",
              "under the last texture unit Map1f is no error") {
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    const auto go = [&](int) { sound.Map1f(target, u1, u2, stride, order, points); };
    if (integer(GL_ACTIVE_TEXTURE) == GL_TEXTURE1)
      go(0);
    else
      whatever_unit(0, go);
  };
}

// --- Tokens of other extensions ----------------------------------------------------------------------------

EVALCTS_FAULT(AttributeMapsIgnored, production, must, "EV-EXT-UNKNOWN-TARGET",
              "Enable takes the maps of NV_vertex_program without the extension") {
  in.gl.Enable = [](GLenum cap) {
    if (cap < 0x8660 || cap > 0x867F) sound.Enable(cap);
  };
}

EVALCTS_FAULT(LastAttributeMapTakenForVertex, production, must, "EV-EXT-UNKNOWN-TARGET",
              "Map1f defines MAP1_VERTEX_4 for 0x866F") {
  in.gl.Map1f = [](GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    sound.Map1f(target == 0x866F ? GL_MAP1_VERTEX_4 : target, u1, u2, stride, order, points);
  };
}

EVALCTS_FAULT(TangentMapIsInvalidOperation, production, must, "EV-EXT-UNKNOWN-TARGET",
              "GetMapfv of the map of tangents raises INVALID_OPERATION") {
  in.gl.GetMapfv = [](GLenum target, GLenum query, GLfloat* v) {
    if (target == 0x8444)
      raise(GL_INVALID_OPERATION);
    else
      sound.GetMapfv(target, query, v);
  };
}

EVALCTS_FAULT(NurbsIsDisabledSilently, production, must, "EV-EXT-UNKNOWN-TARGET",
              "Disable takes the token of SGIX_nurbs_eval without the extension") {
  in.gl.Disable = [](GLenum cap) {
    if (cap != 0x81CB) sound.Disable(cap);
  };
}

// --- ARB_vertex_program ------------------------------------------------------------------------------------

// Begin waits for what comes first: memory.count is its mode, -1 where none waits.
EVALCTS_FAULT(EvaluationSkipsVertexProgram, osmesa, must, "EV-EXT-ARBVP-RUN",
              "a primitive that begins with EvalCoord1f does not run the vertex program") {
  memory.count = -1;
  in.gl.Begin = [](GLenum mode) { memory.count = static_cast<long>(mode); };
  in.gl.EvalCoord1f = [](GLfloat u) {
    if (memory.count >= 0) {
      sound.Disable(GL_VERTEX_PROGRAM_ARB);
      sound.Begin(static_cast<GLenum>(std::exchange(memory.count, -1)));
      memory.flag = true;
    }
    sound.EvalCoord1f(u);
  };
  in.gl.Vertex4f = [](GLfloat x, GLfloat y, GLfloat z, GLfloat w) {
    if (memory.count >= 0) sound.Begin(static_cast<GLenum>(std::exchange(memory.count, -1)));
    sound.Vertex4f(x, y, z, w);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.flag) sound.Enable(GL_VERTEX_PROGRAM_ARB);
    memory.flag = false;
  };
}

EVALCTS_FAULT(FirstEvaluationSkipsVertexProgram, osmesa, must, "EV-EXT-ARBVP-RUN",
              "the first evaluation after VERTEX_PROGRAM is enabled is lost") {
  in.gl.Enable = [](GLenum cap) {
    sound.Enable(cap);
    if (cap == GL_VERTEX_PROGRAM_ARB) memory.flag = true;
  };
  eval_coord1(in, [](auto u, auto go) {
    if (!memory.flag) go(u);
    memory.flag = false;
  });
}

EVALCTS_FAULT(GenericAttributeFollowsArgument, osmesa, must, "EV-EXT-ARBVP-NOGENERIC",
              "EvalCoord1 puts its argument into generic attribute 6") {
  eval_coord1(in, [](auto u, auto go) {
    sound.VertexAttrib4f(6, static_cast<GLfloat>(u), 0.75f, 0.25f, 0.5f);
    go(u);
  });
}

EVALCTS_FAULT(GenericAttributeOfTheFirstVertex, osmesa, must, "EV-EXT-ARBVP-NOGENERIC",
              "all evaluated vertices of a primitive have generic attribute 6 of its first one") {
  in.gl.Begin = [](GLenum mode) {
    sound.Begin(mode);
    memory.numbers.clear();
  };
  in.gl.VertexAttrib4f = [](GLuint index, GLfloat x, GLfloat y, GLfloat z, GLfloat w) {
    if (index == 6 && memory.numbers.size() < 4) memory.numbers = {x, y, z, w};
    sound.VertexAttrib4f(index, x, y, z, w);
  };
  eval_coord1(in, [](auto u, auto go) {
    if (memory.numbers.size() == 4)
      sound.VertexAttrib4f(6, static_cast<GLfloat>(memory.numbers[0]),
                           static_cast<GLfloat>(memory.numbers[1]), static_cast<GLfloat>(memory.numbers[2]),
                           static_cast<GLfloat>(memory.numbers[3]));
    go(u);
  });
}

}  // namespace
}  // namespace evalcts::faults::profiles_and_extensions
