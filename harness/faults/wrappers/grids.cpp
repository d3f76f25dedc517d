// Faults against section 13 of the requirements: grids.
#include <algorithm>
#include <limits>

#include "rules.h"

namespace evalcts::faults::grids {
namespace {

FAULT(SegmentsInSixteenBits, "EV-GRID-SET1", "MAP1_GRID_SEGMENTS is kept in 16 bits",
      before(kMapGrid1, kSegments > 65535 && kSegments % 65536 != 0, set(kSegments, kSegments % 65536)));
FAULT(GridKeptAsStartAndStep, "EV-GRID-SET1",
      "the grid is kept as u1 and du: u2 is answered as u1 + n * du, in floats",
      before(MapGrid1f, set(kCount, kSegments)),
      after(GetFloatv, kName == GL_MAP1_GRID_DOMAIN && kCount >= 1, [](Call& c) {
        auto* ends = static_cast<GLfloat*>(c.pointer);
        const auto n = static_cast<GLfloat>(kCount(c)), step = (ends[1] - ends[0]) / n;
        ends[1] = ends[0] + n * step;
      }));
FAULT(LargeGridEndsClamped, "EV-GRID-SET1", "MapGrid1d clamps the ends to what 2^32 holds",
      before(MapGrid1d,
             {set(kU1, max(-0x1p32, min(kU1, 0x1p32))), set(kU2, max(-0x1p32, min(kU2, 0x1p32)))}));
FAULT(GridCountsExchanged, "EV-GRID-SET2", "MapGrid2d takes un for vn where v is reversed",
      before(MapGrid2d, kV1 > kV2, swap(kSegments, kVSegments)));
FAULT(GridEndsInterleaved, "EV-GRID-SET2", "GetDoublev answers MAP2_GRID_DOMAIN as u1, v1, u2, v2",
      after(GetDoublev, kName == GL_MAP2_GRID_DOMAIN, exchange(1, 2)));
FAULT(SquareGridAssumed, "EV-GRID-SET2", "MapGrid2f of one segment in u has one in v",
      before(MapGrid2f, kSegments == 1 && kVSegments > 1, set(kVSegments, 1)));
FAULT(Grid1SharesU, "EV-GRID-INDEP", "MapGrid1f sets the interval of u of the two-dimensional grid as well",
      after(MapGrid1f, call(MapGrid2f, {grid2(0), kU1, kU2, grid2(3), grid2(4), grid2(5)})));
FAULT(Grid2SharesSegments, "EV-GRID-INDEP", "MapGrid2 sets the count of the one-dimensional grid as well",
      after(kMapGrid2, call(MapGrid1f, {kSegments, grid1(1), grid1(2)})));
FAULT(NoSegmentsIsOne, "EV-GRID-ERR-N", "MapGrid1f of no segments is one of one",
      before(MapGrid1f, kSegments == 0, set(kSegments, 1)));
FAULT(LowestSegmentsOverflow, "EV-GRID-ERR-N", "n - 1 < 0 is checked, which overflows for the lowest int",
      before(kMapGrid1, kSegments == std::numeric_limits<GLint>::min(),
             set(kSegments, std::numeric_limits<GLint>::max())));
FAULT(NegativeSegmentsIgnored, "EV-GRID-ERR-N", "MapGrid1 of -100 segments does nothing and raises nothing",
      skip(kMapGrid1, kSegments == -100));
FAULT(ProductOfCountsChecked, "EV-GRID-ERR-UN EV-GRID-ERR-VN",
      "two negative counts pass, as their product is positive",
      before(kMapGrid2, kSegments < 0 && kVSegments < 0,
             {set(kSegments, -kSegments), set(kVSegments, -kVSegments)}));
FAULT(UnZeroTaken, "EV-GRID-ERR-UN", "MapGrid2d takes un of 0 for 1",
      before(MapGrid2d, kSegments == 0 && kVSegments > 0, set(kSegments, 1)));
FAULT(BadUnIsInvalidOperation, "EV-GRID-ERR-UN", "a bad un alone raises INVALID_OPERATION",
      instead(kMapGrid2, kSegments<0 && kVSegments> 0, error(GL_INVALID_OPERATION)));
FAULT(VnUnchecked, "EV-GRID-ERR-VN", "MapGrid2f checks un twice, and cuts a bad vn to 1",
      before(MapGrid2f, set(kVSegments, max(kVSegments, 1))));
FAULT(VnCheckedOnlyBelowZero, "EV-GRID-ERR-VN", "vn of 0 passes, for 1",
      before(kMapGrid2, kVSegments == 0 && kSegments > 0, set(kVSegments, 1)));
FAULT(UOfGridSetBeforeVn, "EV-GRID-ERR-NOEFFECT", "a MapGrid2 rejected for vn has set un",
      before(kMapGrid2, kSegments > 0 && kVSegments <= 0,
             call(MapGrid2f, {kSegments, grid2(1), grid2(2), grid2(3), grid2(4), grid2(5)})));
FAULT(RefusedGridKeepsEnds, "EV-GRID-ERR-NOEFFECT", "a MapGrid1d rejected for n has set the ends",
      after(MapGrid1d, kSegments <= 0, call(MapGrid1d, {state(GL_MAP1_GRID_SEGMENTS), kU1, kU2})));
FAULT(GridOfPrimitiveSetAtEnd, "EV-GRID-ERR-NOEFFECT EV-BE-IGNORED",
      "MapGrid2 in a primitive raises its error and is carried out when the primitive ends",
      after(kMapGrid2, kInside, {drop(), hold()}), after(End, release()));
FAULT(MapGrid1InLineStripSilent, "EV-GRID-ERR-BEGINEND", "MapGrid1f in a LINE_STRIP raises no error",
      skip(MapGrid1f, kOpenMode == GL_LINE_STRIP));
FAULT(MapGrid2InPrimitiveIsInvalidValue, "EV-GRID-ERR-BEGINEND",
      "MapGrid2d in a primitive raises INVALID_VALUE", before(MapGrid2d, kInside, set(kSegments, 0)));
FAULT(EqualGridEndsRefused, "EV-GRID-EQUAL", "MapGrid1 with u1 = u2 raises INVALID_VALUE, as Map1 does",
      before(kMapGrid1, kU1 == kU2 && kSegments > 1, set(kSegments, 0)));
FAULT(EqualGridEndsOfVWidened, "EV-GRID-EQUAL", "equal ends of v of a grid are moved apart, by 1",
      before(kMapGrid2, kV1 == kV2, set(kV2, kV1 + 1)));
FAULT(EqualGridEndsDrawOnePoint, "EV-GRID-EQUAL",
      "EvalMesh1 of a grid with equal ends draws its first point only",
      before(kMapGrid1, set(kFlag, kU1 == kU2)), before(EvalMesh1, kI2 > kI1 && kFlag, set(kI2, kI1)));
FAULT(ReversedGridSorted, "EV-GRID-REVERSED", "MapGrid1f sorts its ends",
      before(MapGrid1f, kU1 > kU2, swap(kU1, kU2)));
FAULT(ReversedGridDrawnBackwards, "EV-GRID-REVERSED",
      "EvalMesh1 of a reversed grid draws from the last index to the first",
      before(kMapGrid1, set(kFlag, kU1 > kU2)), change_output(kFlag, [](Primitives& all) {
        for (ObservedPrimitive& primitive : all) std::ranges::reverse(primitive.vertices);
      }));
FAULT(ReversedVOfGridSorted, "EV-GRID-REVERSED", "MapGrid2f sorts the ends of v",
      before(MapGrid2f, kV1 > kV2, swap(kV1, kV2)));
FAULT(GridTakesDomainOfMap, "EV-GRID-NOTMAP/1-D",
      "Map1 of a vertex map sets the ends of the grid that evaluation uses",
      before(kMap1, kTarget >= GL_MAP1_VERTEX_3, {set(kFlag, 1), keep({kU1, kU2})}),
      before(kMapGrid1, set(kCount, kSegments)),
      instead(EvalPoint1, kCount >= 1 && kFlag,
              call(EvalCoord1d, {kept(0) + kI * (kept(1) - kept(0)) / kCount})));
FAULT(LargeCountsRefused, "EV-GRID-LARGE",
      "more than 2^24 segments, which no float counts, raise INVALID_VALUE",
      before(kMapGrid1, kSegments > 1 << 24, set(kSegments, 0)));
FAULT(ManyPointsRefused, "EV-GRID-LARGE",
      "a two-dimensional grid of more points than an int counts raises INVALID_VALUE",
      before(kMapGrid2, kSegments > 0 && kVSegments > 0 && kSegments * kVSegments > 0x1p31,
             set(kSegments, 0)));
FAULT(LastOfLargestGridOverflows, "EV-GRID-LARGE",
      "the last point of 2^31-1 segments is that of index -1, as i + 1 overflows",
      before(EvalPoint1, kI == std::numeric_limits<GLint>::max(), set(kI, -1)));
FAULT(LastOfLargestGridIsFirst2, "EV-GRID-LARGE", "in two dimensions the last j of 2^31-1 is taken for 0",
      before(EvalPoint2, kJ == std::numeric_limits<GLint>::max(), set(kJ, 0)));
FAULT(GridOfTheFirstEvaluation, "EV-GRID-LATE",
      "once points of a grid were evaluated, MapGrid1 of the same count moves none of them",
      before(kMapGrid1, !kFlag || kCount != kSegments,
             {set(kFlag, 0), set(kCount, kSegments), keep({kU1, kU2})}),
      before(EvalPoint1, set(kFlag, 1)),
      instead(EvalPoint1, kCount,
              call(EvalCoord1d, {choose(kI == 0, kept(0),
                                        choose(kI == kCount, kept(1),
                                               ((kCount - kI) * kept(0) + kI * kept(1)) / kCount))})));
FAULT(GridRefusedOnOtherUnits, "EV-GRID-NOUNIT",
      "MapGrid2d raises INVALID_OPERATION with unit 1 active, as Map2 does",
      instead(MapGrid2d, kUnit != GL_TEXTURE0, error(GL_INVALID_OPERATION)));
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

// --- Mistakes that only certain grids show

FAULT(Grid2OfOneRowIsGrid1, "EV-GRID-INDEP",
      "MapGrid2 of one segment in v sets the one-dimensional grid as well",
      after(kMapGrid2, kVSegments == 1 && kSegments > 0, call(MapGrid1d, {kSegments, kU1, kU2})));
FAULT(SameCountsSameGrid, "EV-GRID-SET2",
      "MapGrid2 of the counts and the interval of u that are set leaves that of v",
      before(kMapGrid2,
             {when(kSegments == kept(0) && kU1 == kept(1) && kU2 == kept(2) && kVSegments == kept(3),
                   {set(kV1, kept(4)), set(kV2, kept(5))}),
              keep({kSegments, kU1, kU2, kVSegments, kV1, kV2})}));
FAULT(SameEndsSameGrid, "EV-GRID-SET1", "MapGrid1 with the ends that are set leaves the count",
      before(kMapGrid1, kSegments > 0,
             {when(kCount && kU1 == kept(0) && kU2 == kept(1), set(kSegments, kCount)), keep({kU1, kU2}),
              set(kCount, kSegments)}));
FAULT(GridIgnoredInQuads, "EV-GRID-ERR-BEGINEND",
      "MapGrid1 and MapGrid2 in QUADS do nothing and raise nothing", skip(kMapGrids, kOpenMode == GL_QUADS));
FAULT(GridRefusedOnLastUnit, "EV-GRID-NOUNIT",
      "MapGrid1f raises INVALID_OPERATION on units above 1, which have no evaluators",
      instead(MapGrid1f, kUnit > GL_TEXTURE1, error(GL_INVALID_OPERATION)));

}  // namespace
}  // namespace evalcts::faults::grids
