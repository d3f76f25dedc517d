// Faults against sections 15 and 16 of the requirements: the drawing and the errors of meshes.
#include "grid_steps.h"

namespace evalcts::faults::meshes {
namespace {

// True for a LINE mesh of more than one row and column.
const Value kIsNet = kMode == GL_LINE && !kInside && kI1 < kI2 && kJ1 < kJ2;

// Adds the steps up in single precision.
GLfloat add_steps(const GridIndex& index) {
  static GLfloat sum;
  sum = index.i == index.from ? index.at() : sum + index.step();
  return index.is_last() ? index.last : index.i == 0 ? index.first : sum;
}
GLfloat at_last_corner(const GridIndex& index) {
  return index.is_last() && index.other_is_last ? index.at() : index.exact();
}

FAULT(StripCutAfter64Vertices, "EV-MESH1-LINE", "EvalMesh1 with LINE begins another strip after 64 vertices",
      instead(EvalMesh1, kMode == GL_LINE && kI1 <= kI2 && !kInside && kI2 - kI1 <= 1 << 20,
              loop(kColumn, kI1, kI2, curve(GL_LINE, kColumn, min(kColumn + 63, kI2)), 64)));
FAULT(PointsLostAfter255, "EV-MESH1-POINT", "EvalMesh1 with POINT counts its points in a byte",
      before(EvalMesh1, kMode == GL_POINT && kI2 - kI1 > 255, set(kI2, kI1 + (kI2 - kI1) % 256)));
FAULT(PartOfMeshFromTheBeginning, "EV-MESH1-COORDS EV-MESH1-SUBRANGE",
      "EvalMesh1 begins at the first end of the grid, regardless of i1",
      before(EvalMesh1, kI1 > 0 && kI2 >= kI1, {set(kI2, kI2 - kI1), set(kI1, 0)}));
FAULT(PartOfMeshHasStepOfOneMore, "EV-MESH1-COORDS EV-MESH1-SUBRANGE",
      "EvalMesh1 of a part of the grid from index 1 on counts points instead of segments",
      keeping(EvalMesh1, !kInside && kI1 >= 1 && kI2 < grid1(0), grid1_state(),
              call(MapGrid1f, {grid1(0) + 1, grid1(1), grid1(2)})));
FAULT(MeshAddsItsSteps, "EV-MESH1-NOACCUM",
      "EvalMesh1 adds the step to the last argument in single precision", curve_at(true, add_steps));
FAULT(CurveMeshByArithmeticAtItsLastIndex, "EV-MESH1-EXACT-N",
      "EvalMesh1 does its last vertex after the loop, and without the rule for the last index",
      curve_at(kI2 == grid1(0), kInexact));
FAULT(CurveMeshExactAtItsOwnEndOnly, "EV-MESH1-EXACT-N",
      "EvalMesh1 is exact at the last index only if it ends there", curve_at(kI2 > grid1(0), kInexact));
FAULT(CurveMeshFromNegativeIndexInexact, "EV-MESH1-EXACT-0", "EvalMesh1 from below 0 is inexact at 0",
      curve_at(kI1 < 0, [](const GridIndex& u) { return u.is_last() ? u.last : u.from_start(); }));
FAULT(CurveMeshFromZeroInexact, "EV-MESH1-EXACT-0", "EvalMesh1 from index 0 counts down from the last end",
      curve_at(kI1 == 0, [](const GridIndex& u) { return u.from_end(); }));
FAULT(NegativeIndicesCutOff, "EV-MESH1-NEGATIVE EV-MESH2-RANGE",
      "EvalMesh begins at 0 where only i1 is negative", before(kMeshes, kI2 >= 0, set(kI1, max(kI1, 0))));
FAULT(IndicesBeyondTheGridCutOff, "EV-MESH1-NEGATIVE", "EvalMesh1 with LINE ends at the end of the grid",
      before(EvalMesh1, kMode == GL_LINE && !kInside && kI1 <= grid1(0), set(kI2, min(kI2, grid1(0)))));
FAULT(EmptyMeshIsAnError, "EV-MESH1-EMPTY EV-MESH2-EMPTY", "EvalMesh of an empty range raises INVALID_VALUE",
      before(kMeshes, kI1 > kI2 + 1 && kIsMode1, error(GL_INVALID_VALUE)));
FAULT(EmptyCurveBackwards, "EV-MESH1-EMPTY", "EvalMesh1 with LINE and i1 above i2 draws from i2 to i1",
      instead(EvalMesh1, kMode == GL_LINE && kI1 > kI2, call(EvalMesh1, {kMode, kI2, kI1})));
FAULT(LineOfOneVertexIsAPoint, "EV-MESH1-SINGLE EV-MESH2-LINE-DEGENERATE",
      "EvalMesh with LINE and one vertex draws a point",
      before(kMeshes, kMode == GL_LINE && kI1 == kI2 && (kMeshDimension == 1 || kJ1 == kJ2),
             set(kMode, GL_POINT)));
FAULT(SinglePointIsNothing, "EV-MESH1-SINGLE", "EvalMesh1 with POINT and i1 = i2 draws nothing",
      before(EvalMesh1, kMode == GL_POINT && kI1 == kI2, set(kI2, kI1 - 1)));
FAULT(BadModeIsInvalidValue, "EV-MESH1-ERR-MODE EV-MESH2-ERR-MODE", "modes of Begin raise INVALID_VALUE",
      instead(kMeshes, kMode <= GL_POLYGON, error(GL_INVALID_VALUE)));
FAULT(MeshInsideWithoutMapIsIgnored, "EV-MESH1-ERR-BEGINEND EV-MESH2-ERR-BEGINEND",
      "EvalMesh between Begin and End without a vertex map raises no error",
      skip(kMeshes, kInside && !maps_vertices(kMeshDimension)));
FAULT(ModeUncheckedWithoutMap, "EV-MESH1-ERR-FIRST EV-MESH2-ERR-FIRST",
      "EvalMesh without a vertex map ignores its mode", skip(kMeshes, !maps_vertices(kMeshDimension)));
FAULT(ModeOfEmptyMeshUnchecked, "EV-MESH1-ERR-FIRST EV-MESH2-ERR-FIRST",
      "EvalMesh with an empty range of i does not look at the mode", skip(kMeshes, kI1 > kI2));
FAULT(MeshWithoutVertexMapIsAnError, "EV-MESH1-NOVERTEX EV-MESH2-NOVERTEX",
      "EvalMesh without a vertex map raises INVALID_OPERATION",
      before(kMeshes, !maps_vertices(kMeshDimension) && kIsMode1 && !kInside, call(End)));
FAULT(CurveMeshTakesTheGridOfU, "EV-MESH1-ONLY1D", "EvalMesh1 takes the segments of u of MapGrid2",
      keeping(EvalMesh1, !kInside && enabled(GL_MAP2_COLOR_4), grid1_state(),
              call(MapGrid1f, {grid2(0), grid1(1), grid1(2)})));
FAULT(CurveMeshTakesTheColorMapOfSurfaces, "EV-MESH1-ONLY1D",
      "EvalMesh1 with a colour map of surfaces enabled colours by that of curves",
      around(EvalMesh1, !kInside && enabled(GL_MAP2_COLOR_4) && !enabled(GL_MAP1_COLOR_4),
             enable(GL_MAP1_COLOR_4), disable(GL_MAP1_COLOR_4)));
FAULT(CurveMeshWhiteWithoutColorMap, "EV-MESH1-CURRENT", "EvalMesh1 without a colour map is opaque",
      keeping(EvalMesh1, !kInside, current(Color4d, GL_CURRENT_COLOR),
              {keep_state(GL_CURRENT_COLOR), set(kept(3), 1), call(Color4d, kept_values(4))}));
FAULT(CurveMeshKeepsTheFirstTexCoord, "EV-MESH1-CURRENT",
      "a second EvalMesh1 has the texture coordinates that were current at the first",
      keeping(EvalMesh1, !kInside, current(TexCoord4d, GL_CURRENT_TEXTURE_COORDS),
              {when(!kFlag, {set(kFlag, 1), keep_state(GL_CURRENT_TEXTURE_COORDS)}),
               call(TexCoord4d, kept_values(4))}));
FAULT(CurveMeshInsideIsInvalidEnum, "EV-MESH1-ERR-BEGINEND",
      "EvalMesh1 with LINE between Begin and End raises INVALID_ENUM",
      instead(EvalMesh1, kMode == GL_LINE && kInside, error(GL_INVALID_ENUM)));
FAULT(CurveMeshAfterDisableOfItsMap, "EV-MESH1-NOVERTEX", "EvalMesh1 still draws a disabled vertex map",
      after(kSwitches, kName == GL_MAP1_VERTEX_3 || kName == GL_MAP1_VERTEX_4,
            set(kNumber, choose(noted_on(kName), 0, kName))),
      around(EvalMesh1, kNumber && !kInside && !maps_vertices(1), enable(kNumber), disable(kNumber)));
FAULT(CurveMeshOfListNeedsItsMapAtOnce, "EV-MESH1-POINT",
      "EvalMesh1 goes into a list only where a vertex map is enabled while it is compiled",
      skip(EvalMesh1,
           kIsMode1 && !kInside && kCompiling && !enabled(GL_MAP1_VERTEX_3) && !enabled(GL_MAP1_VERTEX_4)));
FAULT(BadModeOfListLost, "EV-MESH1-ERR-MODE", "EvalMesh1 with a wrong mode is left out of lists",
      skip(EvalMesh1, !kIsMode1 && !kInside && kCompiling));
FAULT(MeshOfListIn8Bits, "EV-MESH2-COORDS", "lists keep 8 bits of the indices of rows of EvalMesh2",
      before(EvalMesh2, kCompiling, {set(kJ1, in_bits(kJ1, 8)), set(kJ2, in_bits(kJ2, 8))}));
FAULT(LastCornerByArithmetic, "EV-MESH2-EXACT",
      "EvalMesh2 with POINT has the rules for the last indices, but not where both are",
      surface_at(GL_POINT, true, at_last_corner, at_last_corner));
FAULT(SurfaceMeshWithoutVertexMapSetsNormal, "EV-COORD-NOVERTEX",
      "EvalMesh2 with a normal map and no vertex map sets the current normal",
      after(EvalMesh2, noted_on(GL_MAP2_NORMAL) && !maps_vertices(2) && !kInside, call(Normal3f, {0, 0, 1})));
FAULT(SurfacePointsByColumns, "EV-MESH2-POINT", "EvalMesh2 with POINT has j in its inner loop",
      instead(EvalMesh2, kMode == GL_POINT && kI1 <= kI2,
              loop(kColumn, kI1, kI2, surface(GL_POINT, kColumn, kColumn, kJ1, kJ2))));
FAULT(LastRowOfPointsForgotten, "EV-MESH2-POINT", "POINT does not draw row j2 unless it is the only one",
      before(EvalMesh2, kMode == GL_POINT && kJ2 > kJ1, set(kJ2, kJ2 - 1)));
FAULT(LastColumnForgotten, "EV-MESH2-LINE EV-MESH2-LINE-OVERLAP", "LINE draws no strip along v at i2",
      instead(EvalMesh2, kIsNet, {kRows, set(kI2, kI2 - 1), kColumns}));
FAULT(InnerColumnsMerged, "EV-MESH2-LINE-OVERLAP", "LINE draws strips along v at the borders only",
      instead(EvalMesh2, kIsNet,
              {kRows, call(EvalMesh2, {GL_LINE, kI1, kI1, kJ1, kJ2}),
               call(EvalMesh2, {GL_LINE, kI2, kI2, kJ1, kJ2})}));
FAULT(QuadsTurnedRound, "EV-MESH2-FILL", "EvalMesh2 with FILL gives (i, j+1) before (i, j)",
      instead(EvalMesh2, kMode == GL_FILL && !kInside, draw_strips(GL_QUAD_STRIP, 1)));
FAULT(StepOfRowsFromSegmentsOfU, "EV-MESH2-COORDS", "EvalMesh2 divides the range of v by the segments of u",
      keeping(EvalMesh2, !kInside, grid2_state(),
              call(MapGrid2f, {grid2(0), grid2(1), grid2(2), grid2(0), grid2(4), grid2(5)})));
FAULT(ColumnsEndByArithmetic, "EV-MESH2-EXACT", "strips along v of LINE have no rule for the last index of v",
      surface_at(GL_LINE, kJ1 < kJ2, kExact, kInexact));
FAULT(ColumnsAddTheirSteps, "EV-MESH2-NOACCUM", "EvalMesh2 with LINE adds up the steps of v in floats",
      surface_at(GL_LINE, true, kExact, add_steps));
FAULT(RowsOfPointsAddTheirSteps, "EV-MESH2-NOACCUM", "POINT adds up the steps of u in single precision",
      surface_at(GL_POINT, true, add_steps, kExact));
FAULT(CracksBetweenStrips, "EV-MESH2-SHAREDROW",
      "the upper side of a strip is evaluated one bit above the lower side of the next",
      surface_at(GL_FILL, true, kExact, [](const GridIndex& v) {
        return v.i == v.lower || v.is_last() ? v.exact() : v.exact(v.lower) + v.step();
      }));
FAULT(CrossingsOfLinesMissByABit, "EV-MESH2-SHAREDROW",
      "strips along v of LINE are evaluated in single precision, those along u in double",
      surface_at(GL_LINE, kJ1 < kJ2, kExact, kExact));
QUALITY_FAULT(FillInSinglePrecision, "EV-MESH2-MODESAGREE",
              "the arguments of FILL are rounded to single precision, those of LINE and POINT are not",
              surface_at(GL_FILL, true, kExact, kExact));
FAULT(StripOfNoHeightIsDrawn, "EV-MESH2-EMPTY", "EvalMesh2 with FILL and j1 = j2 draws one strip",
      before(EvalMesh2, kMode == GL_FILL && kJ1 == kJ2, set(kJ2, kJ2 + 1)));
FAULT(LinesOfOneColumnAreNothing, "EV-MESH2-LINE-DEGENERATE", "EvalMesh2 with LINE and i1 = i2 draws nothing",
      skip(EvalMesh2, kMode == GL_LINE && kI1 == kI2));
FAULT(RowsBeyondTheGridCutOff, "EV-MESH2-RANGE", "EvalMesh2 with FILL ends at the last row of the grid",
      before(EvalMesh2, kMode == GL_FILL && !kInside && kJ1 < grid2(3), set(kJ2, min(kJ2, grid2(3)))));
FAULT(BadModeOfSurfaceDraws, "EV-MESH2-ERR-MODE", "EvalMesh2 raises INVALID_ENUM for QUADS, and draws points",
      before(EvalMesh2, kMode == GL_QUADS && !kInside, call(EvalMesh2, {GL_POINT, kI1, kI2, kJ1, kJ2})));
FAULT(SurfaceMeshInsideEndsPrimitive, "EV-MESH2-ERR-BEGINEND",
      "EvalMesh2 between Begin and End raises the error and begins the primitive again",
      after(EvalMesh2, kInside, {call(End), call(Begin, {kOpenMode})}));
FAULT(SurfaceMeshOfNormalMapDraws, "EV-MESH2-NOVERTEX",
      "EvalMesh2 with a normal map and no vertex map draws the initial point",
      before(EvalMesh2, noted_on(GL_MAP2_NORMAL) && !maps_vertices(2) && kIsMode2 && !kInside,
             draw_origins(choose(kMode == GL_POINT, GL_POINTS,
                                 choose(kMode == GL_LINE, GL_LINE_STRIP, GL_QUAD_STRIP)))));
FAULT(SurfaceMeshTakesTheGridOfCurves, "EV-MESH2-ONLY2D",
      "EvalMesh2 takes the one-dimensional grid for u where a vertex map of curves is enabled",
      keeping(EvalMesh2, !kInside && (enabled(GL_MAP1_VERTEX_3) || enabled(GL_MAP1_VERTEX_4)), grid2_state(),
              call(MapGrid2f, {grid1(0), grid1(1), grid1(2), grid2(3), grid2(4), grid2(5)})));
FAULT(SurfaceMeshTakesTheEnableOfCurves, "EV-MESH2-ONLY2D", "LINE asks whether MAP1_NORMAL is enabled",
      around(EvalMesh2, !kInside && kMode == GL_LINE && enabled(GL_MAP1_NORMAL) && !enabled(GL_MAP2_NORMAL),
             enable(GL_MAP2_NORMAL), disable(GL_MAP2_NORMAL)));

}  // namespace
}  // namespace evalcts::faults::meshes
