// Faults against section 14 of the requirements: EvalPoint.
#include <cmath>
#include <limits>

#include "grid_steps.h"

namespace evalcts::faults::grid_points {
namespace {

constexpr Coordinate kFromEnd = [](const GridIndex& index) { return index.from_end(); };

FAULT(StepInFixedPoint, "EV-POINT1-EQUIV EV-POINT-LIKEMESH",
      "EvalPoint1 keeps 16 bits behind the point of the step",
      point1_at(kI != noted_grid1(0), [](const GridIndex& u) {
        return static_cast<GLfloat>(u.i) * (std::round(u.step() * 65536) / 65536) + u.first;
      }));
FAULT(EvalPoint1TakesTheGridOfU, "EV-POINT1-EQUIV",
      "EvalPoint1 takes the grid of u of two dimensions where a vertex map of those is enabled", note_grids(),
      instead(EvalPoint1, maps_vertices(2),
              call(EvalCoord1f, {noted_grid2(1) + kI * (noted_grid2(2) - noted_grid2(1)) / noted_grid2(0)})));
FAULT(StepOfVFromSegmentsOfU, "EV-POINT2-EQUIV",
      "EvalPoint2 divides the range of v by the segments of u, but for the last index", note_grids(),
      instead(EvalPoint2, kJ != noted_grid2(3),
              call(EvalCoord2f, {noted_grid2(1) + kI * (noted_grid2(2) - noted_grid2(1)) / noted_grid2(0),
                                 noted_grid2(4) + kJ*(noted_grid2(5) - noted_grid2(4)) / noted_grid2(0)})));
FAULT(PointsFromTheLastEnd, "EV-POINT-EXACT-0",
      "EvalPoint1 counts from the last end of the grid: the first one is rounded", point1_at(true, kFromEnd));
FAULT(FirstRowFromTheLastEnd, "EV-POINT-EXACT-0",
      "EvalPoint2 counts v from the last end of the grid: the first row is rounded",
      point2_at(kJ == 0, kExact, kFromEnd));
FAULT(LastRowByArithmetic, "EV-POINT-EXACT-N", "EvalPoint2 has no rule for the last index of v",
      point2_at(kJ == noted_grid2(3), kExact, kInexact));
FAULT(LastPointByArithmeticInLongGrids, "EV-POINT-EXACT-N",
      "EvalPoint1 has the rule for the last index up to 64 segments",
      point1_at(kI == noted_grid1(0) && kI > 64, kInexact));
FAULT(IndexIn16Bits, "EV-POINT1-EQUIV", "EvalPoint1 keeps 16 bits of its index",
      before(EvalPoint1, abs(kI) < 1 << 20, set(kI, in_bits(kI, 16))));
FAULT(RowIn8Bits, "EV-POINT2-EQUIV", "EvalPoint2 keeps 8 bits of j",
      before(EvalPoint2, abs(kJ) < 1 << 20, set(kJ, in_bits(kJ, 8))));
FAULT(NegativeIndexOfListIsFirst, "EV-POINT-RANGE", "lists keep a negative index of EvalPoint1 as 0",
      before(EvalPoint1, kCompiling, set(kI, max(kI, 0))));
FAULT(LastPointExactInRisingGridsOnly, "EV-POINT-EXACT-N",
      "EvalPoint1 has the rule for the last index where u1 is below u2",
      point1_at(kI == noted_grid1(0) && noted_grid1(1) > noted_grid1(2), kInexact));
FAULT(LastPointOfOneSegmentByArithmetic, "EV-POINT-EXACT-N",
      "EvalPoint2 has no rule for the last index of u if this index is 1",
      point2_at(kI == 1 && noted_grid2(0) == 1, kInexact, kExact));
FAULT(NegativeIndexIsFirst, "EV-POINT-RANGE", "EvalPoint2 takes a negative j as 0",
      before(EvalPoint2, set(kJ, max(kJ, 0))));
FAULT(IndexBeyondTheGridIsLast, "EV-POINT-RANGE",
      "EvalPoint1 takes an index above the segments by more than one as the last", note_grids(),
      before(EvalPoint1, kI > noted_grid1(0) + 1, set(kI, noted_grid1(0))));
FAULT(LowestIndexIsAnError, "EV-POINT-RANGE", "EvalPoint2 with the lowest int as j raises an error",
      before(EvalPoint2, kJ == std::numeric_limits<GLint>::min(), error_inside()));
QUALITY_FAULT(PointsInSinglePrecision, "EV-POINT-LIKEMESH",
              "EvalPoint rounds its argument to single precision, meshes do not", point1_at(true, kExact));

}  // namespace
}  // namespace evalcts::faults::grid_points
