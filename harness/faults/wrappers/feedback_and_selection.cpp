// Faults against section 22 of the requirements: evaluated primitives in feedback and selection mode.
#include <algorithm>

#include "grid_steps.h"

namespace evalcts::faults::feedback_and_selection {
namespace {

constexpr std::string_view kImplementation = "osmesa";

Value in_feedback() { return state(GL_RENDER_MODE) == GL_FEEDBACK; }
Value in_selection() { return state(GL_RENDER_MODE) == GL_SELECT; }
Value draw_point(double z) { return primitive(GL_POINTS, call(Vertex3f, {0, 0, z})); }

// --- Feedback mode -----------------------------------------------------------------------------------------

FAULT(FeedbackFirstPointTwice, "EV-FB-POINT", "in feedback mode the first point of EvalMesh1 comes twice",
      before(EvalMesh1, kMode == GL_POINT && in_feedback(), call(EvalMesh1, {GL_POINT, kI1, kI1})));
FAULT(FeedbackPointsUnclipped, "EV-FB-POINT", "in feedback mode no point of a mesh is clipped",
      around(kMeshes, kMode == GL_POINT && in_feedback(), {call(PushMatrix), call(LoadIdentity)},
             call(PopMatrix)));
FAULT(FeedbackLosesLastSegment, "EV-FB-LINE",
      "in feedback mode the last segment of a LINE mesh of one dimension is missing",
      before(EvalMesh1, kMode == GL_LINE && in_feedback(), set(kI2, kI2 - 1)));
FAULT(FeedbackLosesLastColumn, "EV-FB-LINE", "in feedback mode a LINE mesh lacks its last column",
      instead(EvalMesh2, kMode == GL_LINE && in_feedback(), {kRows, set(kI2, kI2 - 1), kColumns}));
FAULT(FeedbackQuadTwice, "EV-FB-FILL", "in feedback mode the first quad of a FILL mesh comes twice",
      before(EvalMesh2, kMode == GL_FILL && in_feedback(),
             call(EvalMesh2, {GL_FILL, kI1, kI1 + 1, kJ1, kJ1 + 1})));
QUALITY_FAULT(EverySegmentResetsStipple, "EV-FB-LINE", "each segment of a LINE mesh has LINE_RESET_TOKEN",
              after(FeedbackBuffer, {set(kNumber, kAddress), set(kCount, kFirst), set(kFlag, 0)}),
              after(kMeshes, set(kFlag, 1)),
              after(RenderMode, kFirst == GL_RENDER && kFlag && kNumber && kResult <= kCount, [](Call& c) {
                // NOLINTNEXTLINE(performance-no-int-to-ptr)
                auto* const values = reinterpret_cast<GLfloat*>(static_cast<std::uintptr_t>(kNumber(c)));
                std::replace(values,
                             values + std::max<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(c.result), 0),
                             GLfloat{GL_LINE_TOKEN}, GLfloat{GL_LINE_RESET_TOKEN});
              }));
FAULT(FeedbackLosesLastQuad, "EV-FB-FILL",
      "in feedback mode the last quad of the last row of a FILL mesh is missing",
      instead(EvalMesh2, kMode == GL_FILL && in_feedback(),
              {call(EvalMesh2, {GL_FILL, kI1, kI2, kJ1, kJ2 - 1}),
               call(EvalMesh2, {GL_FILL, kI1, kI2 - 1, kJ2 - 1, kJ2})}));
FAULT(FeedbackFirstQuadIsTriangle, "EV-FB-FILL",
      "in feedback mode the first quad of a FILL mesh is a triangle",
      instead(EvalMesh2, kMode == GL_FILL && in_feedback(),
              {primitive(GL_TRIANGLES, {point(kI1, kJ1), point(kI1, kJ1 + 1), point(kI1 + 1, kJ1 + 1)}),
               surface(GL_FILL, kI1 + 1, kI2, kJ1, kJ1 + 1), surface(GL_FILL, kI1, kI2, kJ1 + 1, kJ2)}));
FAULT(FeedbackOutlinesQuads, "EV-FB-FILL", "in feedback mode a FILL mesh gives the outlines of its polygons",
      around(EvalMesh2, kMode == GL_FILL && in_feedback(), call(PolygonMode, {GL_FRONT_AND_BACK, GL_LINE}),
             call(PolygonMode, {GL_FRONT_AND_BACK, GL_FILL})));
FAULT(FeedbackWithoutThirdCoordinateMap, "EV-FB-TEX",
      "in feedback mode the map of three texture coordinates does not count",
      without(EvalMesh1, in_feedback(), GL_MAP1_TEXTURE_COORD_3));
FAULT(FeedbackOfSurfacesHasCurrentTexture, "EV-FB-TEX",
      "in feedback mode the map of s alone does not count for surfaces",
      without(EvalMesh2, in_feedback(), GL_MAP2_TEXTURE_COORD_1));
FAULT(FeedbackOfUnitOne, "EV-FB-TEX", "without a map surfaces feed back the texture coordinates of unit 1",
      keeping(EvalMesh2,
              !(enabled(GL_MAP2_TEXTURE_COORD_1) || enabled(GL_MAP2_TEXTURE_COORD_2) ||
                enabled(GL_MAP2_TEXTURE_COORD_3) || enabled(GL_MAP2_TEXTURE_COORD_4)) &&
                  in_feedback(),
              current(TexCoord4d, GL_CURRENT_TEXTURE_COORDS),
              {call(ActiveTexture, {GL_TEXTURE1}), keep_state(GL_CURRENT_TEXTURE_COORDS),
               call(ActiveTexture, {GL_TEXTURE0}), call(TexCoord4d, kept_values(4))}));
FAULT(FeedbackOfQuadsHasCurrentTexture, "EV-FB-TEX",
      "in feedback mode FILL meshes have the current texture coordinates",
      without(EvalMesh2, kMode == GL_FILL && in_feedback(), GL_MAP2_TEXTURE_COORD_4));
FAULT(FeedbackOfEvalCoordHasCurrentTexture, "EV-FB-TEX",
      "in feedback mode EvalCoord1 gives no texture coordinates",
      without(Begin, in_feedback(), GL_MAP1_TEXTURE_COORD_4));
FAULT(FilledMeshUnlitInFeedback, "EV-FB-COLOR",
      "in feedback mode FILL meshes have the colours of before lighting",
      without(EvalMesh2, kMode == GL_FILL && in_feedback(), GL_LIGHTING));
FAULT(FeedbackColorsNotClamped, "EV-FB-COLOR",
      "in feedback mode the colours of meshes of one dimension are not clamped",
      around(EvalMesh1, in_feedback(), call(ClampColor, {GL_CLAMP_VERTEX_COLOR, GL_FALSE}),
             call(ClampColor, {GL_CLAMP_VERTEX_COLOR, GL_TRUE})));
FAULT(FeedbackLightsWithCurrentNormal, "EV-FB-COLOR",
      "in feedback mode LINE meshes are lit with the current normal",
      without(EvalMesh2, kMode == GL_LINE && in_feedback() && enabled(GL_LIGHTING), GL_MAP2_NORMAL));

// --- Selection mode ----------------------------------------------------------------------------------------

FAULT(SelectionOmitsMeshPoints, "EV-SEL-HIT", "POINT meshes never hit",
      skip(kMeshes, kMode == GL_POINT && in_selection()));
FAULT(SelectionDepthOfFirstRow, "EV-SEL-HIT", "the depths of a hit by a LINE mesh are those of its first row",
      before(EvalMesh2, kMode == GL_LINE && in_selection(), set(kJ2, kJ1)));
FAULT(SelectionUnclipped, "EV-SEL-HIT", "FILL meshes outside the clip volume hit",
      around(EvalMesh2, kMode == GL_FILL && in_selection(), {call(PushMatrix), call(LoadIdentity)},
             call(PopMatrix)));
FAULT(SelectionOmitsEvalPoint, "EV-SEL-HIT", "in selection mode EvalPoint1 does nothing",
      before(Begin, set(kFlag, in_selection())), after(End, set(kFlag, 0)), skip(EvalPoint1, kFlag));
FAULT(SelectionNeverCulls, "EV-SEL-CULLED", "in selection mode FILL meshes are not culled",
      without(EvalMesh2, in_selection(), GL_CULL_FACE));
FAULT(SelectionCullsOtherFace, "EV-SEL-CULLED",
      "in selection mode meshes have front and back the other way round",
      around(EvalMesh2, in_selection(),
             {set(kNumber, state(GL_FRONT_FACE)), call(FrontFace, {GL_CW + GL_CCW - kNumber})},
             call(FrontFace, {kNumber})));
FAULT(SelectionHitsThoughBothAreCulled, "EV-SEL-CULLED",
      "in selection mode CullFace(FRONT_AND_BACK) leaves meshes alone",
      without(EvalMesh2, in_selection() && state(GL_CULL_FACE_MODE) == GL_FRONT_AND_BACK, GL_CULL_FACE));
FAULT(EmptyRangeOfIHits, "EV-SEL-EMPTY",
      "in selection mode an EvalMesh2 of an empty range of i hits with its first point",
      before(EvalMesh2, in_selection() && kI1 > kI2 && kJ1 <= kJ2, set(kI2, kI1)));
FAULT(MeshWithoutVerticesHits, "EV-SEL-EMPTY",
      "in selection mode EvalMesh1 without a vertex map hits at the origin",
      after(EvalMesh1, in_selection() && !enabled(GL_MAP1_VERTEX_3) && !enabled(GL_MAP1_VERTEX_4),
            draw_point(0)));
FAULT(SelectionOmitsEvalCoord2, "EV-SEL-HIT", "in selection mode EvalCoord2 does nothing",
      before(Begin, set(kFlag, in_selection())), after(End, set(kFlag, 0)), skip(kEvalCoord2, kFlag));
FAULT(SelectionMeshDepthFromOrigin, "EV-SEL-HIT",
      "the depths of a hit by EvalMesh1 include that of the origin",
      after(EvalMesh1, in_selection() && enabled(GL_MAP1_VERTEX_3), draw_point(-1)));
FAULT(EmptyRangeOfJHits, "EV-SEL-EMPTY",
      "in selection mode a FILL mesh of an empty range of j hits with its first row",
      before(EvalMesh2, in_selection() && kMode == GL_FILL && kJ1 > kJ2,
             call(EvalMesh2, {GL_LINE, kI1, kI2, kJ2, kJ2})));

}  // namespace
}  // namespace evalcts::faults::feedback_and_selection
