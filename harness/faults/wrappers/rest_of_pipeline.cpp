// Section 22: evaluated primitives in the stages of the pipeline after evaluation.
#include <algorithm>

#include "around.h"
#include "forms.h"
#include "rules.h"

namespace evalcts::faults::rest_of_pipeline {
namespace {

Value has_program() { return state(GL_CURRENT_PROGRAM) != 0; }
Value is_incomplete() {
  return call(CheckFramebufferStatus, {GL_DRAW_FRAMEBUFFER}) != GL_FRAMEBUFFER_COMPLETE;
}
// kCount is 1 + the mode of the transform feedback, or what the query counts.
Rule note_recording() { return after(BeginTransformFeedback, true, set(kCount, kFirst + 1)); }
Rule forget_recording() { return after(EndTransformFeedback, true, set(kCount, 0)); }
Rule note_query() { return after(BeginQuery, true, set(kCount, kFirst)); }
Rule forget_query() { return after(EndQuery, true, set(kCount, 0)); }

// --- Texture coordinates -----------------------------------------------------------------------------------

EVALCTS_RULES(CurveMeshWithoutTexGen, osmesa, must, "EV-PIPE-TEXGEN",
              "t is not generated for meshes of one dimension", without(EvalMesh1, true, GL_TEXTURE_GEN_T));
EVALCTS_RULES(TexGenBeforeAutoNormal, osmesa, must, "EV-PIPE-TEXGEN",
              "coordinates are generated from the current normal where AUTO_NORMAL gives another",
              without(EvalMesh2, enabled(GL_TEXTURE_GEN_S), GL_AUTO_NORMAL));
EVALCTS_RULES(SphereMapOfCurrentNormal, osmesa, must, "EV-PIPE-TEXGEN",
              "SPHERE_MAP has the current normal for meshes of one dimension",
              after(TexGeni, kSecond == GL_TEXTURE_GEN_MODE, set(kCount, kThird)),
              without(EvalMesh1, kCount == GL_SPHERE_MAP, GL_MAP1_NORMAL));
EVALCTS_RULES(MeshesWithoutGeneratedQ, osmesa, must, "EV-PIPE-TEXGEN", "q is not generated for meshes",
              without(kMeshes, true, GL_TEXTURE_GEN_Q));
EVALCTS_RULES(SurfaceWithoutGeneratedR, osmesa, must, "EV-PIPE-TEXGEN", "r is not generated for FILL meshes",
              without(EvalMesh2, kMode == GL_FILL, GL_TEXTURE_GEN_R));
EVALCTS_RULES(ReflectionOfCurrentNormal, osmesa, must, "EV-PIPE-TEXGEN",
              "REFLECTION_MAP has the current normal for LINE meshes of two dimensions",
              after(TexGeni, kSecond == GL_TEXTURE_GEN_MODE, set(kCount, kThird)),
              without(EvalMesh2, kCount == GL_REFLECTION_MAP && kMode == GL_LINE, GL_MAP2_NORMAL));

EVALCTS_FAULT(FilledMeshTextureMatrixWithoutQ, osmesa, must, "EV-PIPE-TEXMATRIX",
              "for FILL meshes the texture matrix does not scale q") {
  mesh2(in, [](auto call) {
    if (call.mode != GL_FILL) return go2(call);
    GLfloat matrix[16];
    const auto mode = static_cast<GLenum>(integer(GL_MATRIX_MODE));
    sound.GetFloatv(GL_TEXTURE_MATRIX, matrix);
    matrix[15] = 1;
    sound.MatrixMode(GL_TEXTURE);
    sound.PushMatrix();
    sound.LoadMatrixf(matrix);
    go2(call);
    sound.PopMatrix();
    sound.MatrixMode(mode);
  });
}

EVALCTS_RULES(PointMeshSkipsTextureMatrix, osmesa, must, "EV-PIPE-TEXMATRIX",
              "the texture matrix does not apply to POINT meshes of two dimensions",
              around(EvalMesh2, kMode == GL_POINT,
                     sequence({set(kNumber, state(GL_MATRIX_MODE)), call(MatrixMode, {GL_TEXTURE}),
                               call(PushMatrix), call(LoadIdentity)}),
                     sequence({call(PopMatrix), call(MatrixMode, {kNumber})})));

EVALCTS_FAULT(TextureMatrixWithoutLastColumn, osmesa, must, "EV-PIPE-TEXMATRIX",
              "for meshes of one dimension the texture matrix does not move") {
  mesh1(in, [](auto call) {
    GLfloat matrix[16];
    const auto mode = static_cast<GLenum>(integer(GL_MATRIX_MODE));
    sound.GetFloatv(GL_TEXTURE_MATRIX, matrix);
    std::fill_n(matrix + 12, 3, 0.0f);
    sound.MatrixMode(GL_TEXTURE);
    sound.PushMatrix();
    sound.LoadMatrixf(matrix);
    go1(call);
    sound.PopMatrix();
    sound.MatrixMode(mode);
  });
}

// --- Clip planes, fog, flat shading ------------------------------------------------------------------------

EVALCTS_RULES(MeshForgetsSecondClipPlane, osmesa, must, "EV-PIPE-CLIPPLANE",
              "LINE meshes are clipped by the first clip plane alone",
              without(kMeshes, kMode == GL_LINE, GL_CLIP_PLANE1));
EVALCTS_RULES(FilledMeshNotClipped, osmesa, must, "EV-PIPE-CLIPPLANE", "clip planes leave FILL meshes alone",
              without(kMeshes, kMode == GL_FILL, GL_CLIP_PLANE0));
EVALCTS_RULES(FilledMeshForgetsSecondClipPlane, osmesa, must, "EV-PIPE-CLIPPLANE",
              "FILL meshes are clipped by the first clip plane alone",
              without(kMeshes, kMode == GL_FILL, GL_CLIP_PLANE1));
EVALCTS_RULES(MeshesHaveFiveClipPlanes, osmesa, must, "EV-PIPE-CLIPPLANE",
              "the sixth clip plane leaves meshes alone", without(kMeshes, true, GL_CLIP_PLANE5));
EVALCTS_RULES(LineMeshesWithoutFog, osmesa, must, "EV-PIPE-FOG", "LINE meshes are drawn without fog",
              without(kMeshes, kMode == GL_LINE, GL_FOG));
EVALCTS_RULES(CurvePointsNotClipped, osmesa, must, "EV-PIPE-CLIPPLANE",
              "clip planes leave POINT meshes of one dimension alone",
              without(EvalMesh1, kMode == GL_POINT, GL_CLIP_PLANE0));
EVALCTS_RULES(SquaredFogIsPlain, osmesa, must, "EV-PIPE-FOG", "EXP2 fog of meshes of one dimension is EXP",
              around(EvalMesh1, state(GL_FOG_MODE) == GL_EXP2, call(Fogi, {GL_FOG_MODE, GL_EXP}),
                     call(Fogi, {GL_FOG_MODE, GL_EXP2})));

EVALCTS_FAULT(FogOfFirstVertex, osmesa, must, "EV-PIPE-FOG",
              "all points of a POINT mesh have fog coordinate 1 where the coordinate is selected") {
  meshes(in, [](GLenum mode, auto go) {
    if (mode != GL_POINT || integer(GL_FOG_COORD_SRC) != GL_FOG_COORD) return go();
    GLfloat coordinate = 0;
    sound.GetFloatv(GL_CURRENT_FOG_COORD, &coordinate);
    sound.FogCoordf(1);
    go();
    sound.FogCoordf(coordinate);
  });
}

EVALCTS_RULES(MeshesWithoutExponentialFog, osmesa, must, "EV-PIPE-FOG",
              "fog of meshes of two dimensions is linear whatever the mode",
              around(EvalMesh2, true,
                     sequence({set(kNumber, state(GL_FOG_MODE)), call(Fogi, {GL_FOG_MODE, GL_LINEAR})}),
                     call(Fogi, {GL_FOG_MODE, kNumber})));
EVALCTS_RULES(CurveMeshIgnoresFogCoordinate, osmesa, must, "EV-PIPE-FOG",
              "fog of meshes of one dimension goes by the distance though the coordinate is selected",
              around(EvalMesh1, true,
                     sequence({set(kNumber, state(GL_FOG_COORD_SRC)),
                               call(Fogi, {GL_FOG_COORD_SRC, GL_FRAGMENT_DEPTH})}),
                     call(Fogi, {GL_FOG_COORD_SRC, kNumber})));

EVALCTS_FAULT(MeshResetsFogCoordinate, osmesa, must, "EV-PIPE-FOG",
              "a mesh of two dimensions has fog coordinate 0") {
  mesh2(in, [](auto call) {
    GLfloat coordinate = 0;
    sound.GetFloatv(GL_CURRENT_FOG_COORD, &coordinate);
    sound.FogCoordf(0);
    go2(call);
    sound.FogCoordf(coordinate);
  });
}

EVALCTS_RULES(FlatLinesByFirstVertex, osmesa, must, "EV-PIPE-FLATLINE",
              "flat segments of LINE meshes have the colour of their first vertices",
              around(kMeshes, kMode == GL_LINE, call(ProvokingVertex, {GL_FIRST_VERTEX_CONVENTION}),
                     call(ProvokingVertex, {GL_LAST_VERTEX_CONVENTION})));

EVALCTS_FAULT(FlatColumnsBackwards, osmesa, must, "EV-PIPE-FLATLINE",
              "flat columns of LINE meshes have the colours of their first vertices, rows are right") {
  mesh2(in, [](auto call) {
    if (call.mode != GL_LINE) return go2(call);
    for (GLint j = call.j1; j <= call.j2; ++j) sound.EvalMesh2(GL_LINE, call.i1, call.i2, j, j);
    for (GLint i = call.i1; i <= call.i2; ++i) {
      sound.Begin(GL_LINE_STRIP);
      for (GLint j = call.j2; j >= call.j1; --j) sound.EvalPoint2(i, j);
      sound.End();
    }
  });
}

// --- Programs ----------------------------------------------------------------------------------------------

EVALCTS_RULES(MeshSkipsVertexProgram, osmesa, must, "EV-PIPE-VS",
              "no vertex program runs for LINE meshes of two dimensions",
              without(EvalMesh2, kMode == GL_LINE, GL_VERTEX_PROGRAM_ARB));
EVALCTS_RULES(MeshSkipsVertexShader, osmesa, must, "EV-PIPE-VS",
              "no vertex shader runs for POINT meshes of one dimension",
              around(EvalMesh1, kMode == GL_POINT && has_program(),
                     sequence({set(kNumber, state(GL_CURRENT_PROGRAM)), call(UseProgram, {0})}),
                     call(UseProgram, {kNumber})));
EVALCTS_RULES(ShaderSeesNoEvaluatedNormal, osmesa, must, "EV-PIPE-VS",
              "gl_Normal of meshes of two dimensions is the current normal",
              without(EvalMesh2, has_program(), GL_MAP2_NORMAL));

EVALCTS_FAULT(ShaderSeesNoSecondaryColor, osmesa, must, "EV-PIPE-VS",
              "the secondary colour of evaluated primitives is black") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = evaluates();
    if (memory.flag) {
      memory.numbers.assign(4, 0);
      sound.GetDoublev(GL_CURRENT_SECONDARY_COLOR, memory.numbers.data());
      sound.SecondaryColor3f(0, 0, 0);
    }
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.flag)
      sound.SecondaryColor3f(static_cast<GLfloat>(memory.numbers[0]), static_cast<GLfloat>(memory.numbers[1]),
                             static_cast<GLfloat>(memory.numbers[2]));
  };
}

EVALCTS_FAULT(ShaderSeesUnitOneOfMeshReset, osmesa, must, "EV-PIPE-VS",
              "gl_MultiTexCoord1 of meshes of one dimension is (0, 0, 0, 1)") {
  mesh1(in, [](auto call) {
    GLfloat one[4];
    sound.ActiveTexture(GL_TEXTURE1);
    sound.GetFloatv(GL_CURRENT_TEXTURE_COORDS, one);
    sound.ActiveTexture(GL_TEXTURE0);
    sound.MultiTexCoord4f(GL_TEXTURE1, 0, 0, 0, 1);
    go1(call);
    sound.MultiTexCoord4f(GL_TEXTURE1, one[0], one[1], one[2], one[3]);
  });
}

EVALCTS_RULES(ProgramOfPrimitivesSeesNoColorMap, osmesa, must, "EV-PIPE-VS",
              "between Begin and End vertex programs see the current colour for that of surfaces",
              before(Begin, enabled(GL_MAP2_COLOR_4) && enabled(GL_VERTEX_PROGRAM_ARB),
                     sequence({set(kFlag, 1), call(Disable, {GL_MAP2_COLOR_4})})),
              after(End, kFlag, sequence({set(kFlag, 0), call(Enable, {GL_MAP2_COLOR_4})})));

// --- Primitive restart -------------------------------------------------------------------------------------

EVALCTS_FAULT(RestartIndexSplitsMesh, osmesa, must, "EV-PIPE-NORESTART",
              "a LINE mesh of one dimension starts anew at the restart index") {
  mesh1(in, [](auto call) {
    const GLint index = integer(GL_PRIMITIVE_RESTART_INDEX);
    if (call.mode != GL_LINE || !is_on(GL_PRIMITIVE_RESTART) || index < call.i1 || index > call.i2)
      return go1(call);
    sound.EvalMesh1(GL_LINE, call.i1, index - 1);
    sound.EvalMesh1(GL_LINE, index + 1, call.i2);
  });
}

EVALCTS_FAULT(RestartIndexSplitsPrimitive, osmesa, must, "EV-PIPE-NORESTART",
              "the second EvalCoord2 of a primitive is lost where the restart index is 1") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = is_on(GL_PRIMITIVE_RESTART) && integer(GL_PRIMITIVE_RESTART_INDEX) == 1;
    memory.count = 0;
    sound.Begin(mode);
  };
  eval_coord2(in, [](auto u, auto v, auto go) {
    if (++memory.count != 2 || !memory.flag) go(u, v);
  });
}

EVALCTS_RULES(FixedRestartIndexDropsMesh, osmesa, must, "EV-PIPE-NORESTART",
              "with PRIMITIVE_RESTART_FIXED_INDEX the first row of a POINT mesh is missing",
              before(EvalMesh2, kMode == GL_POINT && enabled(GL_PRIMITIVE_RESTART_FIXED_INDEX),
                     set(kJ1, kJ1 + 1)));

// --- Conditional rendering ---------------------------------------------------------------------------------

// memory.counts[0] is the query of the conditional rendering, memory.counts[1] its mode.
void watch_conditions(Injection& in) {
  in.gl.BeginConditionalRender = [](GLuint query, GLenum mode) {
    sound.BeginConditionalRender(query, mode);
    memory.counts[0] = query;
    memory.counts[1] = static_cast<long>(mode);
  };
  in.gl.EndConditionalRender = [] {
    sound.EndConditionalRender();
    memory.counts[0] = 0;
  };
}
// What was drawn before is drawn before it begins.
void begin_condition() {
  sound.Finish();
  sound.BeginConditionalRender(static_cast<GLuint>(memory.counts[0]), static_cast<GLenum>(memory.counts[1]));
}

EVALCTS_FAULT(PointMeshUnconditional, osmesa, must, "EV-PIPE-CONDRENDER",
              "conditional rendering leaves POINT meshes alone") {
  watch_conditions(in);
  meshes(in, [](GLenum mode, auto go) {
    if (mode != GL_POINT || !memory.counts[0]) return go();
    sound.EndConditionalRender();
    go();
    begin_condition();
  });
}

EVALCTS_FAULT(FilledMeshUnconditional, osmesa, must, "EV-PIPE-CONDRENDER",
              "the first row of a FILL mesh is drawn though no sample passed") {
  watch_conditions(in);
  mesh2(in, [](auto call) {
    if (call.mode == GL_FILL && memory.counts[0]) {
      sound.EndConditionalRender();
      sound.EvalMesh2(GL_FILL, call.i1, call.i2, call.j1, call.j1 + 1);
      begin_condition();
    }
    go2(call);
  });
}

EVALCTS_FAULT(ColumnsUnconditional, osmesa, must, "EV-PIPE-CONDRENDER",
              "the columns of a LINE mesh are drawn though no sample passed") {
  watch_conditions(in);
  mesh2(in, [](auto call) {
    go2(call);
    if (call.mode != GL_LINE || !memory.counts[0]) return;
    sound.EndConditionalRender();
    for (GLint i = call.i1; i <= call.i2; ++i) sound.EvalMesh2(GL_LINE, i, i, call.j1, call.j2);
    begin_condition();
  });
}

EVALCTS_RULES(ConditionalMeshNeverDrawn, osmesa, must, "EV-PIPE-CONDRENDER",
              "conditional rendering discards EvalMesh1 whatever the query says",
              after(BeginConditionalRender, true, set(kFlag, 1)),
              after(EndConditionalRender, true, set(kFlag, 0)), skip(EvalMesh1, kFlag));

EVALCTS_FAULT(EvaluatedPrimitiveUnconditional, osmesa, must, "EV-PIPE-CONDRENDER-COORD",
              "conditional rendering leaves evaluated primitives alone") {
  watch_conditions(in);
  in.gl.Begin = [](GLenum mode) {
    memory.flag = memory.counts[0] && evaluates();
    if (memory.flag) sound.EndConditionalRender();
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.flag) begin_condition();
    memory.flag = false;
  };
}

EVALCTS_RULES(ConditionalEvalPointNeverDrawn, osmesa, must, "EV-PIPE-CONDRENDER-COORD",
              "EvalCoord and EvalPoint of surfaces do nothing under conditional rendering",
              after(BeginConditionalRender, true, set(kFlag, 1)),
              after(EndConditionalRender, true, set(kFlag, 0)), skip(kPoints2, kFlag));

// --- Refused primitives ------------------------------------------------------------------------------------

// Where the sound command raises `error` it is this one instead, or none.
template <class Go>
void change_error(GLenum error, GLenum instead, Go go) {
  go();
  const GLenum seen = sound.GetError();
  raise(seen == error ? instead : seen);
}

bool framebuffer_is_incomplete() {
  return sound.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE;
}

EVALCTS_FAULT(IncompleteFramebufferIsInvalidOperation, osmesa, must, "EV-PIPE-FBO",
              "EvalMesh1 with an incomplete framebuffer raises INVALID_OPERATION") {
  mesh1(in, [](auto call) {
    if (framebuffer_is_incomplete())
      raise(GL_INVALID_OPERATION);
    else
      go1(call);
  });
}

EVALCTS_RULES(IncompleteFramebufferIsSilent, osmesa, must, "EV-PIPE-FBO",
              "FILL meshes with an incomplete framebuffer draw nothing, without an error",
              skip(EvalMesh2, kMode == GL_FILL && is_incomplete()));
EVALCTS_RULES(
    IncompleteFramebufferErrorTwice, osmesa, must, "EV-PIPE-FBO",
    "each strip of a LINE mesh with an incomplete framebuffer raises an error: a second one is left",
    before(EvalMesh2, true, set(kFlag, kMode == GL_LINE && is_incomplete())),
    after(GetError, kResult == GL_NO_ERROR && kFlag,
          sequence({set(kFlag, 0), set(kResult, GL_INVALID_FRAMEBUFFER_OPERATION)})));

EVALCTS_FAULT(InvalidProgramIsInvalidValue, osmesa, must, "EV-PIPE-INVALIDPROGRAM",
              "LINE meshes without a valid program raise INVALID_VALUE") {
  meshes(in, [](GLenum mode, auto go) {
    if (mode != GL_LINE) return go();
    change_error(GL_INVALID_OPERATION, GL_INVALID_VALUE, go);
  });
}

EVALCTS_FAULT(InvalidFragmentProgramIsSilent, osmesa, must, "EV-PIPE-INVALIDPROGRAM",
              "EvalMesh2 without a valid fragment program raises no error") {
  mesh2(in, [](auto call) {
    if (!is_on(GL_FRAGMENT_PROGRAM_ARB)) return go2(call);
    change_error(GL_INVALID_OPERATION, GL_NO_ERROR, [call] { go2(call); });
  });
}

EVALCTS_FAULT(RefusedMeshDrawsWithoutProgram, osmesa, must, "EV-PIPE-INVALIDPROGRAM",
              "EvalMesh1 with samplers in conflict raises the error and draws without the program") {
  mesh1(in, [](auto call) {
    const auto program = static_cast<GLuint>(integer(GL_CURRENT_PROGRAM));
    go1(call);
    const GLenum error = sound.GetError();
    if (error == GL_INVALID_OPERATION && program) {
      sound.UseProgram(0);
      go1(call);
      sound.UseProgram(program);
    }
    raise(error);
  });
}

// --- Transform feedback ------------------------------------------------------------------------------------

// memory.count is the mode of the transform feedback, -1 where there is none.
void watch_recording(Injection& in) {
  memory.count = -1;
  in.gl.BeginTransformFeedback = [](GLenum mode) {
    sound.BeginTransformFeedback(mode);
    memory.count = static_cast<long>(mode);
  };
  in.gl.EndTransformFeedback = [] {
    sound.EndTransformFeedback();
    memory.count = -1;
  };
}
bool records() { return memory.count >= 0; }

EVALCTS_FAULT(RecordedPointsColumnByColumn, osmesa, must, "EV-PIPE-XFB",
              "transform feedback records the points of EvalMesh2 column by column") {
  watch_recording(in);
  mesh2(in, [](auto call) {
    if (call.mode == GL_POINT && records())
      points_column_by_column(call);
    else
      go2(call);
  });
}

EVALCTS_FAULT(RecordedCurveBackwards, osmesa, must, "EV-PIPE-XFB",
              "transform feedback records the segments of EvalMesh1 from the last to the first") {
  watch_recording(in);
  mesh1(in, [](auto call) {
    if (call.mode != GL_LINE || !records()) return go1(call);
    for (GLint i = call.i2; i > call.i1; --i) sound.EvalMesh1(GL_LINE, i - 1, i);
  });
}

EVALCTS_FAULT(RecordedQuadsOneTriangleShort, osmesa, must, "EV-PIPE-XFB",
              "transform feedback records the last quad of a FILL mesh as one triangle") {
  watch_recording(in);
  mesh2(in, [](auto call) {
    if (call.mode != GL_FILL || !records()) return go2(call);
    sound.EvalMesh2(GL_FILL, call.i1, call.i2, call.j1, call.j2 - 1);
    sound.EvalMesh2(GL_FILL, call.i1, call.i2 - 1, call.j2 - 1, call.j2);
    sound.Begin(GL_TRIANGLES);
    sound.EvalPoint2(call.i2 - 1, call.j2 - 1);
    sound.EvalPoint2(call.i2 - 1, call.j2);
    sound.EvalPoint2(call.i2, call.j2);
    sound.End();
  });
}

EVALCTS_FAULT(RecordedFirstTriangleTurned, osmesa, must, "EV-PIPE-XFB",
              "the first row of a FILL mesh is recorded the other way round") {
  watch_recording(in);
  mesh2(in, [](auto call) {
    if (call.mode != GL_FILL || !records()) return go2(call);
    sound.Begin(GL_QUAD_STRIP);
    for (GLint i = call.i1; i <= call.i2; ++i) {
      sound.EvalPoint2(i, call.j1 + 1);
      sound.EvalPoint2(i, call.j1);
    }
    sound.End();
    sound.EvalMesh2(GL_FILL, call.i1, call.i2, call.j1 + 1, call.j2);
  });
}

EVALCTS_RULES(FilledMeshRecordedAsLines, osmesa, must, "EV-PIPE-XFB-MODE",
              "a FILL mesh in transform feedback of LINES is recorded as its lines", note_recording(),
              forget_recording(),
              before(EvalMesh2, kCount == GL_LINES + 1 && kMode == GL_FILL, set(kMode, GL_LINE)));
EVALCTS_RULES(RecordedModeMismatchIsSilent, osmesa, must, "EV-PIPE-XFB-MODE",
              "EvalMesh1 in LINE in transform feedback of TRIANGLES is ignored", note_recording(),
              forget_recording(), skip(EvalMesh1, kCount == GL_TRIANGLES + 1 && kMode == GL_LINE));

EVALCTS_FAULT(RecordedModeMismatchIsInvalidEnum, osmesa, must, "EV-PIPE-XFB-MODE",
              "meshes that do not fit transform feedback of POINTS raise INVALID_ENUM") {
  watch_recording(in);
  meshes(in, [](GLenum, auto go) {
    if (memory.count != GL_POINTS) return go();
    change_error(GL_INVALID_OPERATION, GL_INVALID_ENUM, go);
  });
}

// --- Geometry shaders and tessellation ---------------------------------------------------------------------

EVALCTS_FAULT(GeometryInputMismatchIsSilent, osmesa, must, "EV-PIPE-GS",
              "POINT meshes that do not fit the geometry shader are ignored") {
  meshes(in, [](GLenum mode, auto go) {
    if (mode != GL_POINT || !integer(GL_CURRENT_PROGRAM)) return go();
    change_error(GL_INVALID_OPERATION, GL_NO_ERROR, go);
  });
}

EVALCTS_FAULT(GeometryInputMismatchIsInvalidValue, osmesa, must, "EV-PIPE-GS",
              "EvalMesh1 in LINE that does not fit the geometry shader raises INVALID_VALUE") {
  mesh1(in, [](auto call) {
    if (call.mode != GL_LINE || !integer(GL_CURRENT_PROGRAM)) return go1(call);
    change_error(GL_INVALID_OPERATION, GL_INVALID_VALUE, [call] { go1(call); });
  });
}

EVALCTS_FAULT(TessellatedMeshIsSilent, osmesa, must, "EV-PIPE-TESS",
              "FILL meshes are ignored where tessellation is active") {
  mesh2(in, [](auto call) {
    if (call.mode != GL_FILL || !integer(GL_CURRENT_PROGRAM)) return go2(call);
    change_error(GL_INVALID_OPERATION, GL_NO_ERROR, [call] { go2(call); });
  });
}

EVALCTS_RULES(TessellatedMeshIsDrawn, osmesa, must, "EV-PIPE-TESS",
              "EvalMesh1 draws without tessellation where that is active",
              around(EvalMesh1, has_program(),
                     sequence({set(kNumber, state(GL_CURRENT_PROGRAM)), call(UseProgram, {0})}),
                     call(UseProgram, {kNumber})));

// --- Queries -----------------------------------------------------------------------------------------------

// memory.count is what the query counts, 0 where there is none.
void watch_queries(Injection& in) {
  in.gl.BeginQuery = [](GLenum target, GLuint query) {
    sound.BeginQuery(target, query);
    memory.count = static_cast<long>(target);
  };
  in.gl.EndQuery = [](GLenum target) {
    sound.EndQuery(target);
    memory.count = 0;
  };
}

EVALCTS_RULES(SamplesOfFirstPointTwice, osmesa, must, "EV-PIPE-QUERY",
              "the samples of the first point of a mesh of one dimension count twice", note_query(),
              forget_query(),
              before(EvalMesh1, kCount == GL_SAMPLES_PASSED && kMode == GL_POINT && kI1 <= kI2,
                     call(EvalMesh1, {GL_POINT, kI1, kI1})));
EVALCTS_RULES(SamplesOfEvalPointNotCounted, osmesa, must, "EV-PIPE-QUERY",
              "samples of EvalPoint2 and EvalCoord2 are not counted", note_query(), forget_query(),
              skip(kPoints2, kCount == GL_SAMPLES_PASSED));

EVALCTS_FAULT(SamplesOfColumnsNotCounted, osmesa, must, "EV-PIPE-QUERY",
              "of a LINE mesh the samples of the rows alone are counted") {
  watch_queries(in);
  mesh2(in, [](auto call) {
    if (memory.count != GL_SAMPLES_PASSED || call.mode != GL_LINE) return go2(call);
    for (GLint j = call.j1; j <= call.j2; ++j) sound.EvalMesh2(GL_LINE, call.i1, call.i2, j, j);
  });
}

EVALCTS_RULES(PointMeshIsOnePrimitive, osmesa, must, "EV-PIPE-PRIMGEN",
              "a POINT mesh of two dimensions counts as one primitive", note_query(), forget_query(),
              before(EvalMesh2, kCount == GL_PRIMITIVES_GENERATED && kMode == GL_POINT && kI1 <= kI2,
                     sequence({set(kI2, kI1), set(kJ2, kJ1)})));
EVALCTS_RULES(EmptyMeshCountsAPrimitive, osmesa, must, "EV-PIPE-PRIMGEN",
              "an EvalMesh1 of an empty range counts as a primitive", note_query(), forget_query(),
              before(EvalMesh1, kCount == GL_PRIMITIVES_GENERATED && kI1 > kI2,
                     call(EvalMesh1, {GL_POINT, kI1, kI1})));

EVALCTS_FAULT(RowsCountAsPrimitives, osmesa, must, "EV-PIPE-PRIMGEN",
              "of a LINE mesh of two dimensions each strip counts one primitive more") {
  watch_queries(in);
  mesh2(in, [](auto call) {
    go2(call);
    if (memory.count != GL_PRIMITIVES_GENERATED || call.mode != GL_LINE) return;
    for (GLint j = call.j1; j <= call.j2; ++j) sound.EvalMesh2(GL_POINT, call.i1, call.i1, j, j);
  });
}

// --- Rasterizer discard ------------------------------------------------------------------------------------

EVALCTS_RULES(MeshNotDiscarded, osmesa, must, "EV-PIPE-DISCARD", "RASTERIZER_DISCARD leaves EvalMesh2 alone",
              without(EvalMesh2, true, GL_RASTERIZER_DISCARD));
EVALCTS_RULES(DiscardedMeshNotRecorded, osmesa, must, "EV-PIPE-DISCARD",
              "EvalMesh1 in LINE does nothing with RASTERIZER_DISCARD",
              skip(EvalMesh1, kMode == GL_LINE && enabled(GL_RASTERIZER_DISCARD)));

EVALCTS_FAULT(EvaluatedPrimitiveNotDiscarded, osmesa, must, "EV-PIPE-DISCARD",
              "RASTERIZER_DISCARD leaves evaluated primitives alone") {
  in.gl.Begin = [](GLenum mode) {
    memory.flag = evaluates() && is_on(GL_RASTERIZER_DISCARD);
    if (memory.flag) sound.Disable(GL_RASTERIZER_DISCARD);
    sound.Begin(mode);
  };
  in.gl.End = [] {
    sound.End();
    if (memory.flag) sound.Enable(GL_RASTERIZER_DISCARD);
  };
}

EVALCTS_RULES(DiscardedMeshInBeginIsSilent, osmesa, must, "EV-PIPE-DISCARD",
              "EvalMesh2 between Begin and End is no error with RASTERIZER_DISCARD",
              before(Begin, true, set(kFlag, enabled(GL_RASTERIZER_DISCARD))),
              after(End, true, set(kFlag, 0)), skip(EvalMesh2, kFlag));
EVALCTS_RULES(DiscardHidesErrors, osmesa, must, "EV-PIPE-DISCARD",
              "a bad mode of EvalMesh2 is no error with RASTERIZER_DISCARD",
              skip(EvalMesh2, kMode != GL_POINT && kMode != GL_LINE && kMode != GL_FILL &&
                                  enabled(GL_RASTERIZER_DISCARD)));

}  // namespace
}  // namespace evalcts::faults::rest_of_pipeline
