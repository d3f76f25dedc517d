// Faults against section 22 of the requirements: evaluated primitives in feedback and selection mode.
#include "grid_steps.h"

namespace evalcts::faults::feedback_and_selection {
namespace {

constexpr std::string_view kImplementation = "osmesa";

Value in_feedback() { return state(GL_RENDER_MODE) == GL_FEEDBACK; }
Value in_selection() { return state(GL_RENDER_MODE) == GL_SELECT; }
Value draw_point(double z) { return primitive(GL_POINTS, call(Vertex3f, {0, 0, z})); }

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
FAULT(FeedbackOutlinesQuads, "EV-FB-FILL", "in feedback mode a FILL mesh gives the outlines of its polygons",
      around(EvalMesh2, kMode == GL_FILL && in_feedback(), call(PolygonMode, {GL_FRONT_AND_BACK, GL_LINE}),
             call(PolygonMode, {GL_FRONT_AND_BACK, GL_FILL})));
FAULT(FeedbackOfQuadsHasCurrentTexture, "EV-FB-TEX", "FILL meshes feed back the current texture coordinates",
      without(EvalMesh2, kMode == GL_FILL && in_feedback(), GL_MAP2_TEXTURE_COORD_4));
FAULT(FeedbackOfEvalCoordHasCurrentTexture, "EV-FB-TEX", "EvalCoord1 feeds no texture coordinates back",
      without(Begin, in_feedback(), GL_MAP1_TEXTURE_COORD_4));
FAULT(FilledMeshUnlitInFeedback, "EV-FB-COLOR", "in feedback mode FILL meshes are not lit",
      without(EvalMesh2, kMode == GL_FILL && in_feedback(), GL_LIGHTING));
FAULT(FeedbackLightsWithCurrentNormal, "EV-FB-COLOR", "feedback lights LINE meshes with the current normal",
      without(EvalMesh2, kMode == GL_LINE && in_feedback() && enabled(GL_LIGHTING), GL_MAP2_NORMAL));
FAULT(SelectionNeverCulls, "EV-SEL-CULLED", "in selection mode FILL meshes are not culled",
      without(EvalMesh2, in_selection(), GL_CULL_FACE));
FAULT(SelectionHitsThoughBothAreCulled, "EV-SEL-CULLED", "selection ignores CullFace(FRONT_AND_BACK)",
      without(EvalMesh2, in_selection() && state(GL_CULL_FACE_MODE) == GL_FRONT_AND_BACK, GL_CULL_FACE));
FAULT(MeshWithoutVerticesHits, "EV-SEL-EMPTY", "EvalMesh1 without a vertex map hits at the origin",
      after(EvalMesh1, in_selection() && !enabled(GL_MAP1_VERTEX_3) && !enabled(GL_MAP1_VERTEX_4),
            draw_point(0)));
FAULT(SelectionOmitsEvalCoord2, "EV-SEL-HIT", "in selection mode EvalCoord2 does nothing",
      before(Begin, set(kFlag, in_selection())), after(End, set(kFlag, 0)), skip(kEvalCoord2, kFlag));
FAULT(SelectionMeshDepthFromOrigin, "EV-SEL-HIT", "depths of hits by EvalMesh1 include that of the origin",
      after(EvalMesh1, in_selection() && enabled(GL_MAP1_VERTEX_3), draw_point(-1)));
FAULT(EmptyRangeOfJHits, "EV-SEL-EMPTY", "a FILL mesh of an empty range of j hits with its first row",
      before(EvalMesh2, in_selection() && kMode == GL_FILL && kJ1 > kJ2,
             call(EvalMesh2, {GL_LINE, kI1, kI2, kJ2, kJ2})));

}  // namespace
}  // namespace evalcts::faults::feedback_and_selection
