// Faults against section 22 of the requirements: evaluated primitives in the stages of the pipeline after
// evaluation.
#include <algorithm>

#include "grid_steps.h"

namespace evalcts::faults::rest_of_pipeline {
namespace {

constexpr std::string_view kImplementation = "osmesa";

Value has_program() { return state(GL_CURRENT_PROGRAM) != 0; }
Value is_incomplete() {
  return call(CheckFramebufferStatus, {GL_DRAW_FRAMEBUFFER}) != GL_FRAMEBUFFER_COMPLETE;
}
const Value kRestartIndex = state(GL_PRIMITIVE_RESTART_INDEX);

// Mode of the transform feedback + 1, target of the query, query and mode of the conditional rendering; 0 if
// none is active.
const Place kRecorded = kept(0), kQueried = kept(1), kCondition = kept(2), kConditionMode = kept(3);
Rules note_recording() {
  return {after(BeginTransformFeedback, set(kRecorded, kFirst + 1)),
          after(EndTransformFeedback, set(kRecorded, 0))};
}
Rules note_query() { return {after(BeginQuery, set(kQueried, kFirst)), after(EndQuery, set(kQueried, 0))}; }
Rules note_condition() {
  return {after(BeginConditionalRender, {set(kCondition, kFirst), set(kConditionMode, kSecond)}),
          after(EndConditionalRender, set(kCondition, 0))};
}
Value pause_condition() { return call(EndConditionalRender); }
// Calls Finish first, because earlier primitives must not become conditional.
Value resume_condition() {
  return Steps{call(Finish), call(BeginConditionalRender, {kCondition, kConditionMode})};
}

State current_texture_coordinates(GLenum unit) {
  return [unit]() -> Restore {
    std::array<GLfloat, 4> now{};
    unmodified.ActiveTexture(unit);
    unmodified.GetFloatv(GL_CURRENT_TEXTURE_COORDS, now.data());
    unmodified.ActiveTexture(GL_TEXTURE0);
    return [=] { unmodified.MultiTexCoord4f(unit, now[0], now[1], now[2], now[3]); };
  };
}

// Makes the call with a changed texture matrix.
Rules with_texture_matrix(const Entries& entries, Value condition, void (*change)(GLfloat* matrix)) {
  const auto push = [change](Call&) {
    std::array<GLfloat, 16> matrix{};
    unmodified.GetFloatv(GL_TEXTURE_MATRIX, matrix.data());
    change(matrix.data());
    unmodified.MatrixMode(GL_TEXTURE);
    unmodified.PushMatrix();
    unmodified.LoadMatrixf(matrix.data());
  };
  return around(entries, condition, {set(kNumber, state(GL_MATRIX_MODE)), push},
                {call(PopMatrix), call(MatrixMode, {kNumber})});
}

FAULT(MeshesWithoutGeneratedQ, "EV-PIPE-TEXGEN", "q is not generated for meshes",
      without(kMeshes, true, GL_TEXTURE_GEN_Q));
FAULT(SurfaceWithoutGeneratedR, "EV-PIPE-TEXGEN", "r is not generated for FILL meshes",
      without(EvalMesh2, kMode == GL_FILL, GL_TEXTURE_GEN_R));
FAULT(ReflectionOfCurrentNormal, "EV-PIPE-TEXGEN",
      "REFLECTION_MAP has the current normal for LINE meshes of two dimensions",
      after(TexGeni, kSecond == GL_TEXTURE_GEN_MODE, set(kCount, kThird)),
      without(EvalMesh2, kCount == GL_REFLECTION_MAP && kMode == GL_LINE, GL_MAP2_NORMAL));
FAULT(FilledMeshTextureMatrixWithoutQ, "EV-PIPE-TEXMATRIX", "with FILL the texture matrix does not scale q",
      with_texture_matrix(EvalMesh2, kMode == GL_FILL, [](GLfloat* matrix) { matrix[15] = 1; }));
FAULT(TextureMatrixWithoutLastColumn, "EV-PIPE-TEXMATRIX", "for EvalMesh1 the texture matrix does not move",
      with_texture_matrix(EvalMesh1, true, [](GLfloat* matrix) { std::fill_n(matrix + 12, 3, 0.0f); }));
FAULT(FilledMeshForgetsSecondClipPlane, "EV-PIPE-CLIPPLANE", "FILL meshes have one clip plane",
      without(kMeshes, kMode == GL_FILL, GL_CLIP_PLANE1));
FAULT(MeshesHaveFiveClipPlanes, "EV-PIPE-CLIPPLANE", "the sixth clip plane leaves meshes alone",
      without(kMeshes, true, GL_CLIP_PLANE5));
FAULT(LineMeshesWithoutFog, "EV-PIPE-FOG", "LINE meshes have no fog",
      without(kMeshes, kMode == GL_LINE, GL_FOG));
FAULT(CurvePointsNotClipped, "EV-PIPE-CLIPPLANE", "clip planes leave POINT meshes of one dimension alone",
      without(EvalMesh1, kMode == GL_POINT, GL_CLIP_PLANE0));
FAULT(SquaredFogIsPlain, "EV-PIPE-FOG", "EXP2 fog of meshes of one dimension is EXP",
      around(EvalMesh1, state(GL_FOG_MODE) == GL_EXP2, call(Fogi, {GL_FOG_MODE, GL_EXP}),
             call(Fogi, {GL_FOG_MODE, GL_EXP2})));
FAULT(FogOfFirstVertex, "EV-PIPE-FOG", "POINT meshes have fog coordinate 1 where it is selected",
      keeping(kMeshes, kMode == GL_POINT && state(GL_FOG_COORD_SRC) == GL_FOG_COORD,
              current(FogCoordf, GL_CURRENT_FOG_COORD), call(FogCoordf, {1})));
FAULT(FlatLinesByFirstVertex, "EV-PIPE-FLATLINE",
      "flat segments of LINE have the colour of their first vertex",
      around(kMeshes, kMode == GL_LINE, call(ProvokingVertex, {GL_FIRST_VERTEX_CONVENTION}),
             call(ProvokingVertex, {GL_LAST_VERTEX_CONVENTION})));
FAULT(ShaderSeesUnitOneOfMeshReset, "EV-PIPE-VS", "gl_MultiTexCoord1 of EvalMesh1 is (0, 0, 0, 1)",
      keeping(EvalMesh1, true, current_texture_coordinates(GL_TEXTURE1),
              call(MultiTexCoord4f, {GL_TEXTURE1, 0, 0, 0, 1})));
FAULT(ProgramOfPrimitivesSeesNoColorMap, "EV-PIPE-VS",
      "between Begin and End vertex programs see the current colour for that of surfaces",
      without(Begin, enabled(GL_VERTEX_PROGRAM_ARB), GL_MAP2_COLOR_4));
FAULT(RestartIndexSplitsPrimitive, "EV-PIPE-NORESTART",
      "the second EvalCoord2 of a primitive is lost where the restart index is 1",
      before(Begin, {set(kFlag, enabled(GL_PRIMITIVE_RESTART) && kRestartIndex == 1), set(kCount, 0)}),
      before(kEvalCoord2, set(kCount, kCount + 1)), skip(kEvalCoord2, kCount == 2 && kFlag));
FAULT(FixedRestartIndexDropsMesh, "EV-PIPE-NORESTART",
      "with PRIMITIVE_RESTART_FIXED_INDEX the first row of a POINT mesh is missing",
      before(EvalMesh2, kMode == GL_POINT && enabled(GL_PRIMITIVE_RESTART_FIXED_INDEX), set(kJ1, kJ1 + 1)));
FAULT(ColumnsUnconditional, "EV-PIPE-CONDRENDER",
      "the columns of a LINE mesh are drawn though no sample passed", note_condition(),
      after(EvalMesh2, kMode == GL_LINE && kCondition, {pause_condition(), kColumns, resume_condition()}));
FAULT(ConditionalMeshNeverDrawn, "EV-PIPE-CONDRENDER", "conditional rendering always discards EvalMesh1",
      note_condition(), skip(EvalMesh1, kCondition));
FAULT(EvaluatedPrimitiveUnconditional, "EV-PIPE-CONDRENDER-COORD",
      "conditional rendering leaves evaluated primitives alone", note_condition(),
      around(Begin, kCondition != 0 && evaluates(), pause_condition(), resume_condition()));
FAULT(ConditionalEvalPointNeverDrawn, "EV-PIPE-CONDRENDER-COORD",
      "EvalCoord and EvalPoint of surfaces do nothing under conditional rendering", note_condition(),
      skip(kPoints2, kCondition));
FAULT(IncompleteFramebufferIsInvalidOperation, "EV-PIPE-FBO",
      "EvalMesh1 with an incomplete framebuffer raises INVALID_OPERATION",
      instead(EvalMesh1, is_incomplete(), error_now(GL_INVALID_OPERATION)));
FAULT(IncompleteFramebufferErrorTwice, "EV-PIPE-FBO",
      "each strip of a LINE mesh with an incomplete framebuffer raises an error: a second one is left",
      before(EvalMesh2, set(kFlag, kMode == GL_LINE && is_incomplete())),
      after(GetError, kResult == GL_NO_ERROR && kFlag,
            {set(kFlag, 0), set(kResult, GL_INVALID_FRAMEBUFFER_OPERATION)}));
FAULT(InvalidProgramIsInvalidValue, "EV-PIPE-INVALIDPROGRAM", "LINE without a program raises INVALID_VALUE",
      after(kMeshes, kMode == GL_LINE, replace_error(GL_INVALID_OPERATION, GL_INVALID_VALUE)));
FAULT(InvalidFragmentProgramIsSilent, "EV-PIPE-INVALIDPROGRAM",
      "EvalMesh2 without a valid fragment program raises no error",
      after(EvalMesh2, enabled(GL_FRAGMENT_PROGRAM_ARB), replace_error(GL_INVALID_OPERATION, GL_NO_ERROR)));
FAULT(RecordedCurveBackwards, "EV-PIPE-XFB",
      "transform feedback records the segments of EvalMesh1 from the last to the first", note_recording(),
      instead(EvalMesh1, kMode == GL_LINE && kRecorded,
              loop(kColumn, kI2, kI1 + 1, curve(GL_LINE, kColumn - 1, kColumn), -1)));
FAULT(RecordedQuadsOneTriangleShort, "EV-PIPE-XFB",
      "transform feedback records the last quad of a FILL mesh as one triangle", note_recording(),
      instead(EvalMesh2, kMode == GL_FILL && kRecorded,
              {surface(GL_FILL, kI1, kI2, kJ1, kJ2 - 1), surface(GL_FILL, kI1, kI2 - 1, kJ2 - 1, kJ2),
               primitive(GL_TRIANGLES, {point(kI2 - 1, kJ2 - 1), point(kI2 - 1, kJ2), point(kI2, kJ2)})}));
FAULT(FilledMeshRecordedAsLines, "EV-PIPE-XFB-MODE",
      "a FILL mesh in transform feedback of LINES is recorded as its lines", note_recording(),
      before(EvalMesh2, kRecorded == GL_LINES + 1 && kMode == GL_FILL, set(kMode, GL_LINE)));
FAULT(RecordedModeMismatchIsInvalidEnum, "EV-PIPE-XFB-MODE",
      "meshes that do not fit transform feedback of POINTS raise INVALID_ENUM", note_recording(),
      after(kMeshes, kRecorded == GL_POINTS + 1, replace_error(GL_INVALID_OPERATION, GL_INVALID_ENUM)));
FAULT(GeometryInputMismatchIsSilent, "EV-PIPE-GS", "POINT meshes that do not fit the shader are ignored",
      after(kMeshes, kMode == GL_POINT && has_program(), replace_error(GL_INVALID_OPERATION, GL_NO_ERROR)));
FAULT(GeometryInputMismatchIsInvalidValue, "EV-PIPE-GS",
      "EvalMesh1 in LINE that does not fit the geometry shader raises INVALID_VALUE",
      after(EvalMesh1, kMode == GL_LINE && has_program(),
            replace_error(GL_INVALID_OPERATION, GL_INVALID_VALUE)));
FAULT(TessellatedMeshIsSilent, "EV-PIPE-TESS", "FILL meshes are ignored while tessellation is active",
      after(EvalMesh2, kMode == GL_FILL && has_program(), replace_error(GL_INVALID_OPERATION, GL_NO_ERROR)));
FAULT(TessellatedMeshIsDrawn, "EV-PIPE-TESS", "EvalMesh1 draws without the active tessellation",
      keeping(EvalMesh1, has_program(), setting(UseProgram, {state(GL_CURRENT_PROGRAM)}),
              call(UseProgram, {0})));
FAULT(SamplesOfEvalPointNotCounted, "EV-PIPE-QUERY", "samples of EvalPoint2 and EvalCoord2 are not counted",
      note_query(), skip(kPoints2, kQueried == GL_SAMPLES_PASSED));
FAULT(SamplesOfColumnsNotCounted, "EV-PIPE-QUERY", "of a LINE mesh the samples of the rows alone are counted",
      note_query(), instead(EvalMesh2, kQueried == GL_SAMPLES_PASSED && kMode == GL_LINE, kRows));
FAULT(PointMeshIsOnePrimitive, "EV-PIPE-PRIMGEN", "a POINT mesh counts as one primitive", note_query(),
      before(EvalMesh2, kQueried == GL_PRIMITIVES_GENERATED && kMode == GL_POINT && kI1 <= kI2,
             {set(kI2, kI1), set(kJ2, kJ1)}));
FAULT(EmptyMeshCountsAPrimitive, "EV-PIPE-PRIMGEN", "an empty EvalMesh1 counts as a primitive", note_query(),
      before(EvalMesh1, kQueried == GL_PRIMITIVES_GENERATED && kI1 > kI2,
             call(EvalMesh1, {GL_POINT, kI1, kI1})));
FAULT(EvaluatedPrimitiveNotDiscarded, "EV-PIPE-DISCARD", "RASTERIZER_DISCARD spares evaluated primitives",
      without(Begin, evaluates(), GL_RASTERIZER_DISCARD));
FAULT(DiscardedMeshInBeginIsSilent, "EV-PIPE-DISCARD",
      "EvalMesh2 between Begin and End raises no error with RASTERIZER_DISCARD",
      before(Begin, set(kFlag, enabled(GL_RASTERIZER_DISCARD))), after(End, set(kFlag, 0)),
      skip(EvalMesh2, kFlag));

}  // namespace
}  // namespace evalcts::faults::rest_of_pipeline
