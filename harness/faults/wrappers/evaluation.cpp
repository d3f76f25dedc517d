// Faults against section 7 of the requirements: effects of evaluation, and state that it must not change.
#include "rules.h"

namespace evalcts::faults::evaluation {
namespace {

const Value kMapsVertices = maps_vertices(1) || maps_vertices(2);

// The command does nothing after an evaluation in the same primitive.
Rules lost_after_evaluation(const Entries& command) {
  return {before(Begin | End, set(kFlag, 0)), before(kPoints, set(kFlag, 1)), skip(command, kFlag)};
}
// Sets kFlag when the array is enabled.
Rule note_array(GLenum array) { return before(EnableClientState, kFirst == array, set(kFlag, 1)); }

FAULT(MeshesOf16Bits, "EV-BE-NOLIMIT", "EvalMesh ends at point 65,535",
      before(kMeshes, kI2 > 65535, set(kI2, 65535)));
FAULT(PrimitivesOf16Bits, "EV-BE-NOLIMIT", "a primitive is cut after 65,535 vertices",
      change_primitives([](ObservedPrimitive& primitive) {
        if (primitive.vertices.size() > 65535) primitive.vertices.resize(65535);
      }));
FAULT(ColorMapOfSurfacesColorsCurves, "EV-COORD-DIM1", "Enable of MAP2_COLOR_4 enables MAP1_COLOR_4",
      after(kSwitches, kName == GL_MAP2_COLOR_4, switch_to(GL_MAP1_COLOR_4, noted_on(kName))));
FAULT(NormalMapOfCurvesServesSurfaces, "EV-COORD-DIM2", "Enable of MAP1_NORMAL enables MAP2_NORMAL",
      after(kSwitches, kName == GL_MAP1_NORMAL, switch_to(GL_MAP2_NORMAL, noted_on(kName))));
FAULT(TextureMapOfSurfacesOutranksThatOfCurves, "EV-COORD-DIM1",
      "TEXTURE_COORD_4 of surfaces suppresses the smaller texture maps of curves",
      only_if(GL_MAP1_TEXTURE_COORD_2, !noted_on(GL_MAP2_TEXTURE_COORD_4)));
FAULT(VertexMapOfCurvesOutranksThatOfSurfaces, "EV-COORD-DIM2",
      "VERTEX_4 of curves suppresses VERTEX_3 of surfaces",
      only_if(GL_MAP2_VERTEX_3, !noted_on(GL_MAP1_VERTEX_4)));
FAULT(DimensionFixedByFirstVertex, "EV-COORD-MIXDIM",
      "EvalPoint of the other dimension than the first vertex of a primitive does nothing",
      before(Begin | End, set(kCount, 0)), before(kEvalCoord1, !kCount, set(kCount, 1)),
      before(kEvalCoord2, !kCount, set(kCount, 2)), skip(EvalPoint1, kCount == 2),
      skip(EvalPoint2, kCount == 1));
FAULT(SurfaceAfterCurveUsesItsArgument, "EV-COORD-MIXDIM", "EvalCoord2 after EvalCoord1 takes u from there",
      before(kEvalCoord1, {set(kNumber, kU), set(kFlag, 1)}),
      before(EvalPoint1, {set(kNumber, 0.75), set(kFlag, 1)}),
      before(kEvalCoord2, {when(kFlag && abs(kNumber - kU) > 0.1, set(kU, kNumber)), set(kFlag, 0)}));
FAULT(EvalCoord2dvTakesVFirst, "EV-COORD-ARGORDER", "EvalCoord2dv takes v, then u",
      before(EvalCoord2dv, swap(kU, kV)));
FAULT(EvalPoint2TakesJFirstInSquareGrids, "EV-COORD-ARGORDER EV-POINT2-EQUIV",
      "EvalPoint2 mixes i and j up, unless one is 0", before(EvalPoint2, kI != 0 && kJ, swap(kI, kJ)));
FAULT(IndexMapWithoutVertexMapIsAnError, "EV-COORD-NOVERTEX",
      "EvalCoord1 with an index map and no vertex map raises INVALID_OPERATION",
      before(kPoints1, noted_on(GL_MAP1_INDEX) && !maps_vertices(1), error_inside()));
FAULT(AnyVertexMapWillDo, "EV-COORD-NOVERTEX-OTHERDIM",
      "EvalCoord1 asks whether any vertex map is enabled, then draws the initial point",
      before(kPoints1, !maps_vertices(1) && maps_vertices(2), call(Vertex4f, {0, 0, 0, 1})));
FAULT(SurfacePointOfVertexCurve, "EV-COORD-NOVERTEX-OTHERDIM",
      "EvalPoint2 asks for MAP1_VERTEX_4 as well as for the maps of its own dimension",
      before(EvalPoint2, !maps_vertices(2) && noted_on(GL_MAP1_VERTEX_4), call(Vertex4f, {0, 0, 0, 1})));
FAULT(EvalCoordRefusedInAdjacency, "EV-COORD-INBEGIN",
      "EvalCoord1 raises INVALID_OPERATION in primitives with adjacency, which it is older than",
      before(kEvalCoord1, kOpenMode > GL_POLYGON && kInside, error_inside()));
FAULT(EvalPoint2RefusedInQuads, "EV-COORD-INBEGIN EV-BE-ALLOWED",
      "EvalPoint2 is not on the list of commands that are legal in QUADS",
      before(EvalPoint2, kOpenMode == GL_QUADS, error_inside()));
FAULT(LoopOfEvaluatedVerticesStaysOpen, "EV-COORD-PRIMS", "a LINE_LOOP with evaluated vertices is not closed",
      change_primitives([](ObservedPrimitive& primitive) {
        if (primitive.mode == GL_LINE_LOOP) primitive.mode = GL_LINE_STRIP;
      }));
FAULT(ColorInsidePrimitiveWaits, "EV-COORD-CURRENT", "a Color after an evaluation waits for End",
      before(kPoints, set(kFlag, 1)), before(Begin, set(kFlag, 0)),
      instead(Color4f, kInside != 0 && kFlag, {drop(), hold()}), after(End, release()));
FAULT(ColorOfTheVertexBefore, "EV-COORD-VERTEXLAST EV-COORD-ASIF",
      "a vertex has the colour of the one before it",
      change_pairs([](ObservedVertex& now, const ObservedVertex& before) { now.color = before.color; }));
FAULT(NormalOfTheVertexBefore, "EV-COORD-VERTEXLAST",
      "from the third vertex of a primitive on, the vertex goes out before its normal",
      change_pairs([](ObservedVertex& now, const ObservedVertex& before) { now.normal = before.normal; }, 2));
FAULT(AllKindsTogetherLoseTheColor, "EV-COORD-ASIF EV-PREC-PERKIND",
      "where colour, normal, texture and index maps are enabled together, the colour is the current one",
      only_if(GL_MAP1_COLOR_4,
              !noted_on(GL_MAP1_NORMAL) || !noted_on(GL_MAP1_INDEX) ||
                  (!noted_on(GL_MAP1_TEXTURE_COORD_3) && !noted_on(GL_MAP1_TEXTURE_COORD_4))));
FAULT(HugeArgumentIsAnError, "EV-COORD-NOERR/1-D", "EvalCoord1 raises INVALID_OPERATION above 2^120",
      before(kEvalCoord1, kU > 0x1p120, error_inside()));
FAULT(DenormalUIsAnError, "EV-COORD-NOERR/2-D", "EvalCoord2f raises INVALID_OPERATION where u is denormal",
      before(kEvalCoord2, is_subnormal(kU), error_inside()));
FAULT(DoubleArgumentsInFixedPoint, "EV-COORD-FD", "EvalCoord1d keeps 10 bits behind the point of u",
      before(EvalCoord1d | EvalCoord1dv, set(kU, round(kU * 1024) / 1024)));
FAULT(DoubleVInFixedPoint, "EV-COORD-FD", "EvalCoord2d keeps 10 bits behind the point of v",
      before(EvalCoord2d | EvalCoord2dv, set(kV, round(kV * 1024) / 1024)));
FAULT(EveryFifthEvaluationOneUlpOff, "EV-COORD-REPEAT", "every fifth EvalCoord1f takes the next number",
      before(EvalCoord1f, {set(kCount, kCount + 1), when(kCount % 5 == 0, set(kU, next_float(kU, 2)))}));
FAULT(SecondPrimitiveHalfAnUlpOff, "EV-COORD-REPEAT", "from the second primitive on EvalCoord2 is a bit off",
      after(End, set(kFlag, 1)), before(kEvalCoord2, kFlag, set(kU, next_float(kU, 2))));

namespace on_osmesa {
constexpr std::string_view kImplementation = "osmesa";
FAULT(MaterialBetweenEvaluationsLost, "EV-COORD-MATERIAL",
      "a Material after an evaluation in the same primitive is lost", lost_after_evaluation(Materialfv));
FAULT(ListBetweenEvaluationsLost, "EV-COORD-MATERIAL",
      "CallList after an evaluation in the same primitive calls nothing", lost_after_evaluation(CallList));
FAULT(ColorArrayColorsEvaluatedVertices, "EV-COORD-NOARRAYS",
      "with an enabled colour array, evaluated vertices without a colour map have its first colour",
      note_array(GL_COLOR_ARRAY), before(kPoints, kFlag, call(Color4f, {0.625, 0.625, 0.625, 0.625})));
FAULT(NormalArrayTurnsNormalMapsOff, "EV-COORD-NOARRAYS", "an enabled normal array replaces normal maps",
      note_array(GL_NORMAL_ARRAY), skip(Enable, kName == GL_MAP1_NORMAL && kFlag));
// The next fault spares the control with explicit vertices, in which no vertex map is enabled.
FAULT(EvaluatedVerticesHaveNoFog, "EV-COORD-TRANSFORM", "evaluated vertices are not fogged",
      without(Begin, kMapsVertices, GL_FOG));
FAULT(EvaluatedColorsAreNotLit, "EV-COORD-TRANSFORM", "evaluated vertices with a colour map are not lit",
      without(Begin, noted_on(GL_MAP1_COLOR_4) || noted_on(GL_MAP2_COLOR_4), GL_LIGHTING));
}  // namespace on_osmesa

}  // namespace
}  // namespace evalcts::faults::evaluation
