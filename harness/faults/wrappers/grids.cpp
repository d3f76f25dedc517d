// Faults against sections 13 and 14 of the requirements: grids and EvalPoint.
#include <cmath>
#include <limits>

#include "grid_steps.h"

namespace evalcts::faults::grids {
namespace {

FAULT(SegmentsInSixteenBits, "EV-GRID-SET1", "MAP1_GRID_SEGMENTS is kept in 16 bits",
      before(kMapGrid1, kSegments > 65535 && kSegments % 65536 != 0, set(kSegments, kSegments % 65536)));
FAULT(LargeGridEndsClamped, "EV-GRID-SET1", "MapGrid1d clamps the ends to what 2^32 holds",
      before(MapGrid1d,
             {set(kU1, max(-0x1p32, min(kU1, 0x1p32))), set(kU2, max(-0x1p32, min(kU2, 0x1p32)))}));
FAULT(GridEndsInterleaved, "EV-GRID-SET2", "GetDoublev answers MAP2_GRID_DOMAIN as u1, v1, u2, v2",
      after(GetDoublev, kName == GL_MAP2_GRID_DOMAIN, exchange(1, 2)));
FAULT(SquareGridAssumed, "EV-GRID-SET2", "MapGrid2f of one segment in u has one in v",
      before(MapGrid2f, kSegments == 1 && kVSegments > 1, set(kVSegments, 1)));
FAULT(Grid1SharesU, "EV-GRID-INDEP", "MapGrid1f sets the interval of u of the two-dimensional grid as well",
      after(MapGrid1f, call(MapGrid2f, {grid2(0), kU1, kU2, grid2(3), grid2(4), grid2(5)})));
FAULT(Grid2SharesSegments, "EV-GRID-INDEP", "MapGrid2 sets the count of the one-dimensional grid as well",
      after(kMapGrid2, call(MapGrid1f, {kSegments, grid1(1), grid1(2)})));
FAULT(NoSegmentsIsOne, "EV-GRID-ERR-N EV-GRID-ERR-UN", "MapGrid1f and MapGrid2f of no segments in u have one",
      before(MapGrid1f | MapGrid2f, kSegments == 0, set(kSegments, 1)));
FAULT(NegativeSegmentsIgnored, "EV-GRID-ERR-N", "MapGrid1 of -100 segments does nothing and raises nothing",
      skip(kMapGrid1, kSegments == -100));
FAULT(ProductOfCountsChecked, "EV-GRID-ERR-UN EV-GRID-ERR-VN", "two negative counts pass as positive ones",
      before(kMapGrid2, kSegments < 0 && kVSegments < 0,
             {set(kSegments, -kSegments), set(kVSegments, -kVSegments)}));
FAULT(VnUnchecked, "EV-GRID-ERR-VN", "MapGrid2f checks un twice, and cuts a bad vn to 1",
      before(MapGrid2f, set(kVSegments, max(kVSegments, 1))));
FAULT(RefusedGridKeepsEnds, "EV-GRID-ERR-NOEFFECT", "a MapGrid1d rejected for n has set the ends",
      after(MapGrid1d, kSegments <= 0, call(MapGrid1d, {state(GL_MAP1_GRID_SEGMENTS), kU1, kU2})));
FAULT(GridOfPrimitiveSetAtEnd, "EV-GRID-ERR-NOEFFECT EV-BE-IGNORED",
      "MapGrid2 in a primitive raises its error and is carried out when the primitive ends",
      after(kMapGrid2, kInside, {drop(), hold()}), after(End, release()));
FAULT(MapGrid2InPrimitiveIsInvalidValue, "EV-GRID-ERR-BEGINEND",
      "MapGrid2d in a primitive raises INVALID_VALUE", before(MapGrid2d, kInside, set(kSegments, 0)));
FAULT(EqualGridEndsRefused, "EV-GRID-EQUAL", "MapGrid1 with u1 = u2 raises INVALID_VALUE, as Map1 does",
      before(kMapGrid1, kU1 == kU2 && kSegments > 1, set(kSegments, 0)));
FAULT(EqualGridEndsOfVWidened, "EV-GRID-EQUAL", "equal ends of v of a grid are moved apart, by 1",
      before(kMapGrid2, kV1 == kV2, set(kV2, kV1 + 1)));
FAULT(ReversedGridSorted, "EV-GRID-REVERSED", "MapGrid1f sorts its ends",
      before(MapGrid1f, kU1 > kU2, swap(kU1, kU2)));
FAULT(ReversedVOfGridSorted, "EV-GRID-REVERSED", "MapGrid2f sorts the ends of v",
      before(MapGrid2f, kV1 > kV2, swap(kV1, kV2)));
FAULT(GridTakesDomainOfMap, "EV-GRID-NOTMAP/1-D", "evaluation takes the ends of the grid from Map1",
      before(kMap1, kTarget >= GL_MAP1_VERTEX_3, {set(kFlag, 1), keep({kU1, kU2})}),
      before(kMapGrid1, set(kCount, kSegments)),
      instead(EvalPoint1, kCount >= 1 && kFlag,
              call(EvalCoord1d, {kept(0) + kI * (kept(1) - kept(0)) / kCount})));
FAULT(LargeCountsRefused, "EV-GRID-LARGE", "more than 2^24 segments raise INVALID_VALUE",
      before(kMapGrid1, kSegments > 1 << 24, set(kSegments, 0)));
FAULT(LastOfLargestGridIsFirst2, "EV-GRID-LARGE", "in two dimensions the last j of 2^31-1 is taken for 0",
      before(EvalPoint2, kJ == std::numeric_limits<GLint>::max(), set(kJ, 0)));
FAULT(GridPerUnit, "EV-GRID-NOUNIT", "MapGrid1 with unit 1 active sets a grid that unit 0 does not see",
      after(ActiveTexture, {when(kFirst == GL_TEXTURE0 && kFlag, call(MapGrid1f, {1, 0, 1})), set(kFlag, 0)}),
      before(kMapGrid1, set(kFlag, kUnit != GL_TEXTURE0)));
FAULT(DoubleGridKeptApart, "EV-GRID-FD EV-API-FD/2-D",
      "GetDoublev answers the ends that MapGrid1d gave, although a MapGrid1f came after it",
      before(MapGrid1d, {set(kFlag, 1), keep({kU1, kU2})}),
      after(GetDoublev, kName == GL_MAP1_GRID_DOMAIN && kFlag, answer(kept_values(2))));
FAULT(DoubleGridInHalfPrecision, "EV-GRID-FD", "MapGrid2d rounds the ends to 11 bits",
      before(MapGrid2d, {set(kU1, with_precision(kU1, 11)), set(kU2, with_precision(kU2, 11)),
                         set(kV1, with_precision(kV1, 11)), set(kV2, with_precision(kV2, 11))}));
FAULT(GridIgnoredInQuads, "EV-GRID-ERR-BEGINEND",
      "MapGrid1 and MapGrid2 in QUADS do nothing and raise nothing", skip(kMapGrids, kOpenMode == GL_QUADS));
FAULT(GridRefusedOnLastUnit, "EV-GRID-NOUNIT",
      "MapGrid1f raises INVALID_OPERATION on units above 1, which have no evaluators",
      instead(MapGrid1f, kUnit > GL_TEXTURE1, error(GL_INVALID_OPERATION)));

constexpr Coordinate kFromEnd = [](const GridIndex& index) { return index.from_end(); };

FAULT(StepInFixedPoint, "EV-POINT1-EQUIV EV-POINT-LIKEMESH", "EvalPoint1 keeps the step in fixed point",
      point1_at(kI != noted_grid1(0), [](const GridIndex& u) {
        return static_cast<GLfloat>(u.i) * (std::round(u.step() * 65536) / 65536) + u.first;
      }));
FAULT(PointsFromTheLastEnd, "EV-POINT-EXACT-0",
      "EvalPoint1 counts from the last end of the grid: the first one is rounded", point1_at(true, kFromEnd));
FAULT(FirstRowFromTheLastEnd, "EV-POINT-EXACT-0", "EvalPoint2 counts v of the first row from the last end",
      point2_at(kJ == 0, kExact, kFromEnd));
FAULT(IndicesIn8Bits, "EV-POINT1-EQUIV EV-POINT2-EQUIV", "EvalPoint keeps 8 bits of i",
      before(EvalPoint1 | EvalPoint2, abs(kI) < 1 << 20, set(kI, in_bits(kI, 8))));
FAULT(NegativeIndexOfListIsFirst, "EV-POINT-RANGE", "lists keep a negative index of EvalPoint1 as 0",
      before(EvalPoint1, kCompiling, set(kI, max(kI, 0))));
FAULT(LastPointExactInRisingGridsOnly, "EV-POINT-EXACT-N",
      "EvalPoint1 has the rule for the last index where u1 is below u2",
      point1_at(kI == noted_grid1(0) && noted_grid1(1) > noted_grid1(2), kInexact));
FAULT(LastPointByArithmetic, "EV-POINT-EXACT-N", "EvalPoint1 has no rule for the last index",
      point1_at(kI == noted_grid1(0), kInexact));
FAULT(LastPointOfOneSegmentByArithmetic, "EV-POINT-EXACT-N",
      "EvalPoint2 has no rule for the last index of u if this index is 1",
      point2_at(kI == 1 && noted_grid2(0) == 1, kInexact, kExact));
FAULT(LowestIndexIsAnError, "EV-POINT-RANGE", "EvalPoint2 with the lowest int as j raises an error",
      before(EvalPoint2, kJ == std::numeric_limits<GLint>::min(), error_inside()));
QUALITY_FAULT(PointsInSinglePrecision, "EV-POINT-LIKEMESH",
              "EvalPoint rounds its argument to single precision, meshes do not", point1_at(true, kExact));

}  // namespace
}  // namespace evalcts::faults::grids
