// Faults against section 17 of the requirements: evaluated values. Mistakes of the arithmetic itself are
// mutations of production.
#include <algorithm>
#include <cmath>

#include "grid_steps.h"

namespace evalcts::faults::numeric {
namespace {

Value is_nan(Value a) { return a != a; }

// Evaluates at an adjacent argument if the condition holds.
Rules evaluate_otherwise(Value condition) {
  return {before(kEvalCoord1, condition, set(kU, next_float(kU, 2))),
          before(kEvalCoord2, condition, set(kV, next_float(kV, 2)))};
}

FAULT(VanishingStepsEndMeshes, "EV-NUM-ENDS/1-D",
      "EvalMesh1 ends at the first point if the step is too small to change u1",
      before(EvalMesh1, !kInside && to_float(grid1(1) + (grid1(2) - grid1(1)) / grid1(0)) == grid1(1),
             set(kI2, kI1)));
FAULT(HugeStepsDrawNothing, "EV-NUM-ENDS", "EvalMesh2 over a grid wider than 2^126 draws nothing",
      skip(EvalMesh2, !kInside && abs(grid2(2) - grid2(1)) > 0x1p126));
QUALITY_FAULT(StartOneBitOff, "EV-NUM-START/1-D EV-NUM-START/2-D",
              "at u1 of the last map the curve or surface is evaluated at the next number",
              before(kMaps, set(kNumber, kU1)),
              before(kEvalCoords, kU == kNumber, set(kU, next_float(kU, 1e9))));
FAULT(StartOfReversedDomainMissed, "EV-NUM-START", "u1 of a reversed domain is moved inside by a thousandth",
      before(kMap1, keep({kU1, kU2})),
      before(kEvalCoord1, kept(0) > kept(1) && kU == kept(0), set(kU, kU + (kept(1) - kept(0)) / 1000)));
FAULT(EndOfHighOrdersMissed, "EV-NUM-END",
      "at u2 of a map of order 17 and above the curve is evaluated a thousandth before",
      before(kMap1, {set(kFlag, kOrder >= 17), keep({kU1, kU2})}),
      before(kEvalCoord1, kU == kept(1) && kFlag, set(kU, kU + (kept(0) - kept(1)) / 1000)));
FAULT(EndOfReversedSurfaceMissed, "EV-NUM-END EV-NUM-CORNERS",
      "v2 of a surface is moved inside by a hundredth where v1 is not 0", before(kMap2, keep({kV1, kV2})),
      before(kEvalCoord2, kept(0) && kV == kept(1), set(kV, kV + (kept(0) - kept(1)) / 100)));
FAULT(ReversedDomainsOnACoarseLattice, "EV-NUM-SYMMETRY",
      "arguments of a map over a reversed domain are rounded to quarters",
      before(kMaps, set(kFlag, kU1 > kU2)), before(kEvalCoords, kFlag, set(kU, round(kU * 4) / 4)));
FAULT(FarDomainsLoseBits, "EV-NUM-DOMAINSHIFT", "EvalCoord2 rounds u above 2000 to steps of 1/16",
      before(kEvalCoord2, abs(kU) > 2000 && abs(kU) < 1e6, set(kU, round(kU * 16) / 16)));
FAULT(CornersMixedUp, "EV-NUM-CORNERS", "at (u2, v1) the surface is evaluated at (u2, v2)",
      before(kMap2, {set(kFlag, 1), keep({kU2, kV1, kV2})}),
      before(kEvalCoord2, kU == kept(0) && kFlag && kV == kept(1), set(kV, kept(2))));
FAULT(PointsSaturateAt2To31, "EV-NUM-RANGE-POS EV-NUM-RANGE-POS/2-D", "control points above 2^31 become 2^31",
      before(kMaps, change_values([](double x) { return std::clamp(x, -0x1p31, 0x1p31); })));
FAULT(DomainEndsSaturate, "EV-NUM-RANGE-POS/1-D", "arguments of EvalCoord1 above 2^31 become 2^31",
      before(kEvalCoord1, set(kU, min(kU, 0x1p31))));
FAULT(ColorsSaturateAt1000, "EV-NUM-RANGE-COLOR", "points of colour maps are kept up to 1000",
      before(kMap1, kTarget == GL_MAP1_COLOR_4,
             change_values([](double x) { return std::clamp(x, -1000.0, 1000.0); })));
FAULT(SurfaceColorsSaturateBelow, "EV-NUM-RANGE-COLOR/2-D", "colours of surfaces saturate at -512",
      before(kMap2, kTarget == GL_MAP2_COLOR_4, change_values([](double x) { return std::max(x, -512.0); })));
FAULT(SmallPointsFlushedInBigMaps, "EV-NUM-AFFINE", "small control points are multiples of 1/4096",
      before(kMap1,
             change_values([](double x) { return std::abs(x) < 1 ? std::round(x * 4096) / 4096 : x; })));
FAULT(InfiniteGridStays, "EV-NUM-SPECIAL-SAFE/2-D",
      "after a grid with an infinite u1 or v2, MapGrid2 is lost", skip(kMapGrid2, kFlag),
      after(kMapGrid2, abs(kU1) == HUGE_VAL || abs(kV2) == HUGE_VAL, set(kFlag, 1)));
FAULT(NaNPointDisablesMap, "EV-NUM-SPECIAL-SAFE", "a map with a NaN point is disabled",
      after(kMaps, kOrder > 0 && kComponents && is_nan(element(0)), disable(kTarget)));
FAULT(MapAfterNaNIsLost, "EV-NUM-SPECIAL-SAFE/1-D", "the first Map1 after a NaN argument does nothing",
      before(kEvalCoord1, is_nan(kU), set(kFlag, 1)), instead(kMap1, kFlag, set(kFlag, 0)));
FAULT(NegativeZeroIsOutside, "EV-NUM-DENORMAL", "EvalCoord1 at -0 evaluates a little below 0",
      before(kEvalCoord1, is_negative_zero(kU), set(kU, -1.0 / 512)));
FAULT(DenormalArgumentLosesVertex, "EV-NUM-DENORMAL", "EvalCoord1 at a negative subnormal draws nothing",
      skip(kEvalCoord1, kU <= 0 && is_subnormal(kU)));
FAULT(OtherPathOnUnit1, "EV-NUM-INVARIANT-STATE", "with TEXTURE1 active, evaluation is a bit off",
      evaluate_otherwise(kUnit != GL_TEXTURE0));
FAULT(OtherPathAfterRefusedMap, "EV-NUM-INVARIANT-STATE/1-D",
      "after a Map1 that was rejected, evaluation takes another path, a bit off",
      before(kMap1, kOrder < 1, set(kFlag, 1)), evaluate_otherwise(kFlag));
FAULT(OtherPathAfterQuery, "EV-NUM-INVARIANT-STATE/2-D",
      "after GetMapdv of a map, evaluation takes another path, a bit off",
      before(GetMapdv, kQuery == GL_COEFF, set(kFlag, 1)), evaluate_otherwise(kFlag));
QUALITY_FAULT(OtherPathBesideColors, "EV-NUM-UNRELATEDMAPS/1-D",
              "with a colour map enabled, curves are evaluated by another path, a bit off",
              before(kEvalCoord1, noted_on(GL_MAP1_COLOR_4), set(kU, next_float(kU, 2))));
QUALITY_FAULT(OtherPathBesideTexture, "EV-NUM-UNRELATEDMAPS/2-D",
              "with TEXTURE_COORD_1 enabled, EvalPoint2 is evaluated by another path, a bit off",
              point2_at(
                  noted_on(GL_MAP2_TEXTURE_COORD_1),
                  [](const GridIndex& u) { return std::nextafter(u.at(), 2.0f); }, kInexact));

}  // namespace
}  // namespace evalcts::faults::numeric
