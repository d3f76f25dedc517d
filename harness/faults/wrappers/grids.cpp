// Faults against section 13 of the requirements: grids.
#include <algorithm>
#include <limits>

#include "rules.h"

namespace evalcts::faults {
namespace {

EVALCTS_RULES(SegmentsInSixteenBits, production, kMust, "EV-GRID-SET1",
              "MAP1_GRID_SEGMENTS is kept in 16 bits",
              before(kMapGrid1, kSegments > 65535 && kSegments % 65536 != 0,
                     set(kSegments, kSegments % 65536)));
EVALCTS_RULES(GridKeptAsStartAndStep, production, kMust, "EV-GRID-SET1",
              "the grid is kept as u1 and du: u2 is answered as u1 + n * du, in floats",
              before(MapGrid1f, set(kCount, kSegments)),
              after(GetFloatv, kName == GL_MAP1_GRID_DOMAIN && kCount >= 1, [](Call& c) {
                auto* ends = static_cast<GLfloat*>(c.pointer);
                const auto n = static_cast<GLfloat>(kCount(c)), step = (ends[1] - ends[0]) / n;
                ends[1] = ends[0] + n * step;
              }));
EVALCTS_RULES(LargeGridEndsClamped, production, kMust, "EV-GRID-SET1",
              "MapGrid1d clamps the ends to what 2^32 holds",
              before(MapGrid1d,
                     {set(kU1, max(-0x1p32, min(kU1, 0x1p32))), set(kU2, max(-0x1p32, min(kU2, 0x1p32)))}));
EVALCTS_RULES(GridCountsExchanged, production, kMust, "EV-GRID-SET2",
              "MapGrid2d takes un for vn where v is reversed",
              before(MapGrid2d, kV1 > kV2, swap(kSegments, kVSegments)));
EVALCTS_RULES(GridEndsInterleaved, production, kMust, "EV-GRID-SET2",
              "GetDoublev answers MAP2_GRID_DOMAIN as u1, v1, u2, v2",
              after(GetDoublev, kName == GL_MAP2_GRID_DOMAIN, exchange(1, 2)));
EVALCTS_RULES(SquareGridAssumed, production, kMust, "EV-GRID-SET2",
              "MapGrid2f of one segment in u has one in v",
              before(MapGrid2f, kSegments == 1 && kVSegments > 1, set(kVSegments, 1)));
EVALCTS_RULES(Grid1SharesU, production, kMust, "EV-GRID-INDEP",
              "MapGrid1f sets the interval of u of the two-dimensional grid as well",
              after(MapGrid1f, call(MapGrid2f, {grid2(0), kU1, kU2, grid2(3), grid2(4), grid2(5)})));
EVALCTS_RULES(Grid2SharesSegments, production, kMust, "EV-GRID-INDEP",
              "MapGrid2 sets the count of the one-dimensional grid as well",
              after(kMapGrid2, call(MapGrid1f, {kSegments, grid1(1), grid1(2)})));
EVALCTS_RULES(NoSegmentsIsOne, production, kMust, "EV-GRID-ERR-N", "MapGrid1f of no segments is one of one",
              before(MapGrid1f, kSegments == 0, set(kSegments, 1)));
EVALCTS_RULES(LowestSegmentsOverflow, production, kMust, "EV-GRID-ERR-N",
              "n - 1 < 0 is checked, which overflows for the lowest int",
              before(kMapGrid1, kSegments == std::numeric_limits<GLint>::min(),
                     set(kSegments, std::numeric_limits<GLint>::max())));
EVALCTS_RULES(NegativeSegmentsIgnored, production, kMust, "EV-GRID-ERR-N",
              "MapGrid1 of -100 segments does nothing and raises nothing",
              skip(kMapGrid1, kSegments == -100));
EVALCTS_RULES(ProductOfCountsChecked, production, kMust, "EV-GRID-ERR-UN EV-GRID-ERR-VN",
              "two negative counts pass, as their product is positive",
              before(kMapGrid2, kSegments < 0 && kVSegments < 0,
                     {set(kSegments, -kSegments), set(kVSegments, -kVSegments)}));
EVALCTS_RULES(UnZeroTaken, production, kMust, "EV-GRID-ERR-UN", "MapGrid2d takes un of 0 for 1",
              before(MapGrid2d, kSegments == 0 && kVSegments > 0, set(kSegments, 1)));
EVALCTS_RULES(BadUnIsInvalidOperation, production, kMust, "EV-GRID-ERR-UN",
              "a bad un alone raises INVALID_OPERATION",
              instead(kMapGrid2, kSegments<0 && kVSegments> 0, error(GL_INVALID_OPERATION)));
EVALCTS_RULES(VnUnchecked, production, kMust, "EV-GRID-ERR-VN",
              "MapGrid2f checks un twice, and cuts a bad vn to 1",
              before(MapGrid2f, set(kVSegments, max(kVSegments, 1))));
EVALCTS_RULES(VnCheckedOnlyBelowZero, production, kMust, "EV-GRID-ERR-VN", "vn of 0 passes, for 1",
              before(kMapGrid2, kVSegments == 0 && kSegments > 0, set(kVSegments, 1)));
EVALCTS_RULES(UOfGridSetBeforeVn, production, kMust, "EV-GRID-ERR-NOEFFECT",
              "a MapGrid2 rejected for vn has set un",
              before(kMapGrid2, kSegments > 0 && kVSegments <= 0,
                     call(MapGrid2f, {kSegments, grid2(1), grid2(2), grid2(3), grid2(4), grid2(5)})));
EVALCTS_RULES(RefusedGridKeepsEnds, production, kMust, "EV-GRID-ERR-NOEFFECT",
              "a MapGrid1d rejected for n has set the ends",
              after(MapGrid1d, kSegments <= 0, call(MapGrid1d, {state(GL_MAP1_GRID_SEGMENTS), kU1, kU2})));
EVALCTS_RULES(GridOfPrimitiveSetAtEnd, production, kMust, "EV-GRID-ERR-NOEFFECT EV-BE-IGNORED",
              "MapGrid2 in a primitive raises its error and is carried out when the primitive ends",
              after(kMapGrid2, kInside, {drop(), hold()}), after(End, release()));
EVALCTS_RULES(MapGrid1InLineStripSilent, production, kMust, "EV-GRID-ERR-BEGINEND",
              "MapGrid1f in a LINE_STRIP raises no error", skip(MapGrid1f, kOpenMode == GL_LINE_STRIP));
EVALCTS_RULES(MapGrid2InPrimitiveIsInvalidValue, production, kMust, "EV-GRID-ERR-BEGINEND",
              "MapGrid2d in a primitive raises INVALID_VALUE", before(MapGrid2d, kInside, set(kSegments, 0)));
EVALCTS_RULES(EqualGridEndsRefused, production, kMust, "EV-GRID-EQUAL",
              "MapGrid1 with u1 = u2 raises INVALID_VALUE, as Map1 does",
              before(kMapGrid1, kU1 == kU2 && kSegments > 1, set(kSegments, 0)));
EVALCTS_RULES(EqualGridEndsOfVWidened, production, kMust, "EV-GRID-EQUAL",
              "equal ends of v of a grid are moved apart, by 1",
              before(kMapGrid2, kV1 == kV2, set(kV2, kV1 + 1)));
EVALCTS_RULES(EqualGridEndsDrawOnePoint, production, kMust, "EV-GRID-EQUAL",
              "EvalMesh1 of a grid with equal ends draws its first point only",
              before(kMapGrid1, set(kFlag, kU1 == kU2)),
              before(EvalMesh1, kI2 > kI1 && kFlag, set(kI2, kI1)));
EVALCTS_RULES(ReversedGridSorted, production, kMust, "EV-GRID-REVERSED", "MapGrid1f sorts its ends",
              before(MapGrid1f, kU1 > kU2, swap(kU1, kU2)));
EVALCTS_RULES(ReversedGridDrawnBackwards, production, kMust, "EV-GRID-REVERSED",
              "EvalMesh1 of a reversed grid draws from the last index to the first",
              before(kMapGrid1, set(kFlag, kU1 > kU2)), change_output(kFlag, [](Primitives& all) {
                for (ObservedPrimitive& primitive : all) std::ranges::reverse(primitive.vertices);
              }));
EVALCTS_RULES(ReversedVOfGridSorted, production, kMust, "EV-GRID-REVERSED", "MapGrid2f sorts the ends of v",
              before(MapGrid2f, kV1 > kV2, swap(kV1, kV2)));
EVALCTS_RULES(GridTakesDomainOfMap, production, kMust, "EV-GRID-NOTMAP/1-D",
              "Map1 of a vertex map sets the ends of the grid that evaluation uses",
              before(kMap1, kTarget >= GL_MAP1_VERTEX_3, {set(kFlag, 1), keep({kU1, kU2})}),
              before(kMapGrid1, set(kCount, kSegments)),
              instead(EvalPoint1, kCount >= 1 && kFlag,
                      call(EvalCoord1d, {kept(0) + kI * (kept(1) - kept(0)) / kCount})));
EVALCTS_RULES(LargeCountsRefused, production, kMust, "EV-GRID-LARGE",
              "more than 2^24 segments, which no float counts, raise INVALID_VALUE",
              before(kMapGrid1, kSegments > 1 << 24, set(kSegments, 0)));
EVALCTS_RULES(ManyPointsRefused, production, kMust, "EV-GRID-LARGE",
              "a two-dimensional grid of more points than an int counts raises INVALID_VALUE",
              before(kMapGrid2, kSegments > 0 && kVSegments > 0 && kSegments * kVSegments > 0x1p31,
                     set(kSegments, 0)));
EVALCTS_RULES(LastOfLargestGridOverflows, production, kMust, "EV-GRID-LARGE",
              "the last point of 2^31-1 segments is that of index -1, as i + 1 overflows",
              before(EvalPoint1, kI == std::numeric_limits<GLint>::max(), set(kI, -1)));
EVALCTS_RULES(LastOfLargestGridIsFirst2, production, kMust, "EV-GRID-LARGE",
              "in two dimensions the last j of 2^31-1 is taken for 0",
              before(EvalPoint2, kJ == std::numeric_limits<GLint>::max(), set(kJ, 0)));
EVALCTS_RULES(GridOfTheFirstEvaluation, production, kMust, "EV-GRID-LATE",
              "once points of a grid were evaluated, MapGrid1 of the same count moves none of them",
              before(kMapGrid1, !kFlag || kCount != kSegments,
                     {set(kFlag, 0), set(kCount, kSegments), keep({kU1, kU2})}),
              before(EvalPoint1, set(kFlag, 1)),
              instead(EvalPoint1, kCount,
                      call(EvalCoord1d,
                           {choose(kI == 0, kept(0),
                                   choose(kI == kCount, kept(1),
                                          ((kCount - kI) * kept(0) + kI * kept(1)) / kCount))})));
EVALCTS_RULES(GridRefusedOnOtherUnits, production, kMust, "EV-GRID-NOUNIT",
              "MapGrid2d raises INVALID_OPERATION with unit 1 active, as Map2 does",
              instead(MapGrid2d, kUnit != GL_TEXTURE0, error(GL_INVALID_OPERATION)));
EVALCTS_RULES(GridPerUnit, production, kMust, "EV-GRID-NOUNIT",
              "MapGrid1 with unit 1 active sets a grid that unit 0 does not see",
              after(ActiveTexture,
                    {when(kFirst == GL_TEXTURE0 && kFlag, call(MapGrid1f, {1, 0, 1})), set(kFlag, 0)}),
              before(kMapGrid1, set(kFlag, kUnit != GL_TEXTURE0)));
EVALCTS_RULES(DoubleGridKeptApart, production, kMust, "EV-GRID-FD EV-API-FD/2-D",
              "GetDoublev answers the ends that MapGrid1d gave, although a MapGrid1f came after it",
              before(MapGrid1d, {set(kFlag, 1), keep({kU1, kU2})}),
              after(GetDoublev, kName == GL_MAP1_GRID_DOMAIN && kFlag, answer(kept_values(2))));
EVALCTS_RULES(DoubleGridInHalfPrecision, production, kMust, "EV-GRID-FD",
              "MapGrid2d rounds the ends to 11 bits",
              before(MapGrid2d, {set(kU1, with_precision(kU1, 11)), set(kU2, with_precision(kU2, 11)),
                                 set(kV1, with_precision(kV1, 11)), set(kV2, with_precision(kV2, 11))}));

// --- Mistakes that only certain grids show

EVALCTS_RULES(Grid2OfOneRowIsGrid1, production, kMust, "EV-GRID-INDEP",
              "MapGrid2 of one segment in v sets the one-dimensional grid as well",
              after(kMapGrid2, kVSegments == 1 && kSegments > 0, call(MapGrid1d, {kSegments, kU1, kU2})));
EVALCTS_RULES(SameCountsSameGrid, production, kMust, "EV-GRID-SET2",
              "MapGrid2 of the counts and the interval of u that are set leaves that of v",
              before(kMapGrid2,
                     {when(kSegments == kept(0) && kU1 == kept(1) && kU2 == kept(2) && kVSegments == kept(3),
                           {set(kV1, kept(4)), set(kV2, kept(5))}),
                      keep({kSegments, kU1, kU2, kVSegments, kV1, kV2})}));
EVALCTS_RULES(SameEndsSameGrid, production, kMust, "EV-GRID-SET1",
              "MapGrid1 with the ends that are set leaves the count",
              before(kMapGrid1, kSegments > 0,
                     {when(kCount && kU1 == kept(0) && kU2 == kept(1), set(kSegments, kCount)),
                      keep({kU1, kU2}), set(kCount, kSegments)}));
EVALCTS_RULES(GridIgnoredInQuads, production, kMust, "EV-GRID-ERR-BEGINEND",
              "MapGrid1 and MapGrid2 in QUADS do nothing and raise nothing",
              skip(kMapGrids, kOpenMode == GL_QUADS));
EVALCTS_RULES(GridRefusedOnLastUnit, production, kMust, "EV-GRID-NOUNIT",
              "MapGrid1f raises INVALID_OPERATION on units above 1, which have no evaluators",
              instead(MapGrid1f, kUnit > GL_TEXTURE1, error(GL_INVALID_OPERATION)));

}  // namespace
}  // namespace evalcts::faults
