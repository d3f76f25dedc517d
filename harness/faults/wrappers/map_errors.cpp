// Faults against section 5 of the requirements: errors of Map1 and Map2.
#include <algorithm>
#include <limits>

#include "rules.h"

namespace evalcts::faults::map_errors {
namespace {

Value is_legal_order(Value order) { return order >= 1 && order <= kMaxOrder; }
Value has_bad_orders() { return !is_legal_order(kOrder) || !is_legal_order(kVOrder); }

// Raises a stride that is too small to the number of components.
Value widen(Place stride) { return set(stride, max(stride, kComponents)); }

Value differ_in_sign(Value a, Value b) { return a == b && is_negative_zero(a) != is_negative_zero(b); }

// True if the first three control points (along v, for surfaces) are equal.
const Value kBeginsWithEqualPoints = [](Call& c) {
  if (!c.is_legal()) return false;
  Net net = c.net();
  const auto point = [&](int i) { return net.columns == 1 ? net.point(i) : net.point(0, i); };
  const auto is_first = [&](int i) { return std::equal(point(0), point(0) + net.components, point(i)); };
  return is_first(1) && is_first(2);
};

// ---- Map1

FAULT(OrderZeroTaken, "EV-MAP1-ERR-ORDER-LOW", "Map1 takes order 0 as 1",
      before(kMap1, kOrder == 0, set(kOrder, 1)));
FAULT(StrideErrorIsInvalidEnum, "EV-MAP1-ERR-STRIDE", "Map1d with a stride below k raises INVALID_ENUM",
      before(Map1d, kComponents > kStride, set(kTarget, 0)));
FAULT(Map1TakesMap2Names, "EV-MAP1-ERR-TARGET",
      "Map1d takes the name of a two-dimensional map for its namesake",
      before(Map1d, is_map2(kTarget), set(kTarget, kTarget - 0x20)));
FAULT(OnePastVertex4Ignored, "EV-MAP1-ERR-TARGET",
      "Map1 of 0x0D99, one past the last name, is ignored without an error",
      skip(kMap1, kTarget == GL_MAP1_VERTEX_4 + 1));
FAULT(UnknownTargetIsInvalidValue, "EV-MAP1-ERR-TARGET",
      "Map1 of a capability that is not a map raises INVALID_VALUE",
      before(kMap1, kTarget == GL_AUTO_NORMAL || kTarget == GL_TEXTURE_2D,
             {set(kTarget, GL_MAP1_VERTEX_4), set(kOrder, 0)}));
FAULT(NegativeOrderIgnored, "EV-MAP1-ERR-ORDER-LOW",
      "Map1f of a negative order copies no point and raises no error", skip(Map1f, kOrder < 0));
FAULT(LowestOrderOverflows, "EV-MAP1-ERR-ORDER-LOW",
      "order - 1 of the lowest int overflows to a large degree, which is cut to the largest",
      before(kMap1, kOrder == std::numeric_limits<GLint>::min(), set(kOrder, kMaxOrder)));
FAULT(DegreeChecked, "EV-MAP1-ERR-ORDER-HIGH",
      "the degree instead of the order is held against the limit: MAX + 1 is taken, as MAX",
      before(kMap1, kOrder == kMaxOrder + 1, set(kOrder, kMaxOrder)));
FAULT(OrderInOneByte, "EV-MAP1-ERR-ORDER-HIGH",
      "Map1d keeps the order in a byte before it checks it: 257 is 1",
      before(Map1d, kOrder > 255, set(kOrder, kOrder & 255)));
FAULT(OrderInSixteenBits, "EV-MAP1-ERR-ORDER-HIGH", "the order is checked as 16 bits: 65537 is 1",
      before(kMap1, kOrder > 65535, set(kOrder, kOrder & 65535)));
FAULT(HighOrderIsInvalidOperation, "EV-MAP1-ERR-ORDER-HIGH",
      "an order far above the limit raises INVALID_OPERATION, as if a resource were short",
      instead(kMap1, is_map1(kTarget) && kOrder >= kMaxOrder + 100, error(GL_INVALID_OPERATION)));
FAULT(NegativeStrideTurned, "EV-MAP1-ERR-STRIDE", "a stride of -17 or less counts as its magnitude",
      before(kMap1, kStride <= -17 && kStride > -10000, set(kStride, -kStride)));
FAULT(StrideOfTexture2Unchecked, "EV-MAP1-ERR-STRIDE",
      "Map1f of TEXTURE_COORD_2 is content with a stride of 1",
      before(Map1f, kTarget == GL_MAP1_TEXTURE_COORD_2 && kStride == 1, set(kStride, 2)));
FAULT(StrideZeroMeansPacked, "EV-MAP1-ERR-STRIDE", "stride 0 means packed points, as in vertex arrays",
      before(kMap1, kStride == 0 && kOrder > 1, set(kStride, kComponents)));
FAULT(StrideOfOrder1Unchecked, "EV-MAP1-ERR-STRIDE-ORDER1",
      "the stride is not checked at order 1, where it is not used",
      before(kMap1, kOrder == 1, widen(kStride)));
FAULT(StrideOfOrder1ZeroOnly, "EV-MAP1-ERR-STRIDE-ORDER1", "Map1d of order 1 rejects strides below 1 only",
      before(Map1d, kOrder == 1 && kStride > 0, widen(kStride)));
FAULT(EqualEndsOfConstantTaken, "EV-MAP1-ERR-DOMAIN",
      "equal ends of a map of order 1 are taken, as nothing is divided by their difference",
      before(kMap1, kOrder == 1 && kU1 == kU2, set(kU2, kU1 + 1)));
FAULT(EqualLargeEndsTaken, "EV-MAP1-ERR-DOMAIN", "equal ends beyond 1e5 are taken for different ones",
      before(kMap1, kU1 == kU2 && abs(kU1) > 1e5, set(kU2, kU1 + 1024)));
FAULT(EqualEndsIgnoredInDoubles, "EV-MAP1-ERR-DOMAIN",
      "Map1d with equal ends does nothing and raises nothing", skip(Map1d, kU1 == kU2));
QUALITY_FAULT(EndsComparedByBits, "EV-MAP1-ERR-DOMAIN",
              "the ends are compared bit by bit, and so +0 and -0 count as different",
              before(kMap1, differ_in_sign(kU1, kU2), set(kU2, 1)));
FAULT(Map1TakenInPolygons, "EV-MAP1-ERR-BEGINEND", "Map1 inside a POLYGON is ignored without an error",
      skip(kMap1, kOpenMode == GL_POLYGON));
FAULT(Map1RefusedAfterFirstVertex, "EV-MAP1-ERR-BEGINEND",
      "Map1 is rejected from the first vertex of a primitive on, and ignored before",
      before(Begin, set(kFlag, 1)), before(Vertex3f | End, set(kFlag, 0)), skip(kMap1, kFlag));
FAULT(Map1dInPrimitiveIsInvalidEnum, "EV-MAP1-ERR-BEGINEND", "Map1d in a primitive raises INVALID_ENUM",
      before(Map1d, kInside, set(kTarget, 0)));
FAULT(Map1DefinedWhenPrimitiveEnds, "EV-MAP1-ERR-NOEFFECT",
      "Map1 in a primitive raises its error, and is carried out when the primitive ends",
      after(kMap1, kInside != 0 && kIsLegal, keep({kTarget, element(0)})), after(End, kept(0), [](Call& c) {
        const int k = gl::components_of(static_cast<GLenum>(kept(0)(c)));
        std::vector<double> point(static_cast<std::size_t>(k));
        point[0] = kept(1)(c);
        Map{static_cast<GLenum>(kept(0)(c)), 0, 1, 0, 1, {k, 1, 1, point}}.define();
        kept(0).assign(c, 0);
      }));
FAULT(OnlyTextureMapsNeedUnit0, "EV-MAP1-ERR-ACTIVETEX",
      "with another unit active Map1 rejects the texture maps only",
      on_unit_0(kMap1, !is_texture_map(kTarget)));
FAULT(Map1dTakenOnAnyUnit, "EV-MAP1-ERR-ACTIVETEX", "Map1d of INDEX is rejected on no unit",
      on_unit_0(Map1d, kTarget == GL_MAP1_INDEX));
FAULT(RefusedMap1SelectsUnit0, "EV-MAP1-ERR-ACTIVETEX",
      "after the error for another active unit unit 0 is active",
      after(kMap1, kUnit != GL_TEXTURE0 && kIsLegal, call(ActiveTexture, {GL_TEXTURE0})));
FAULT(UnitErrorIsInvalidEnum, "EV-MAP1-ERR-ACTIVETEX", "Map1 of VERTEX_4 on another unit raises INVALID_ENUM",
      before(kMap1, kUnit != GL_TEXTURE0 && kTarget == GL_MAP1_VERTEX_4, set(kTarget, 0)));
FAULT(DomainSetBeforeStrideCheck, "EV-MAP1-ERR-NOEFFECT", "a Map1 rejected for its stride has set the domain",
      before(kMap1, is_map1(kTarget) && is_legal_order(kOrder) && kU1 != kU2 && kStride < kComponents,
             redefine(kTarget, take_u)));
FAULT(RefusedOrderSwitchesOff, "EV-MAP1-ERR-NOEFFECT", "a Map1d rejected for its order disables the map",
      after(Map1d, is_map1(kTarget) && !is_legal_order(kOrder), disable(kTarget)));
FAULT(RefusedDomainForgetsMap, "EV-MAP1-ERR-NOEFFECT",
      "a Map1 rejected for its domain leaves the map with its first point only",
      before(kMap1, is_map1(kTarget) && kU1 == kU2,
             redefine(kTarget, [](Map& map, Call&) { map.net.rows = 1; })));
FAULT(RefusedNameDefinesNamesake, "EV-MAP1-ERR-NOEFFECT",
      "a Map1 with a two-dimensional name raises its error and defines the one-dimensional map",
      after(kMap1, is_map2(kTarget), {set(kTarget, kTarget - 0x20), kGo}));

// ---- Map2

FAULT(Map2TakesMap1Names, "EV-MAP2-ERR-TARGET",
      "Map2f takes the name of a one-dimensional map for its namesake",
      before(Map2f, is_map1(kTarget), set(kTarget, kTarget + 0x20)));
FAULT(OneBeforeColor2IsInvalidValue, "EV-MAP2-ERR-TARGET",
      "Map2 of 0x0DAF, one before the first name, raises INVALID_VALUE",
      before(kMap2, kTarget == GL_MAP2_COLOR_4 - 1, {set(kTarget, GL_MAP2_COLOR_4), set(kOrder, 0)}));
FAULT(UOrderZeroTaken, "EV-MAP2-ERR-UORDER", "Map2 takes uorder 0 as 1",
      before(kMap2, kOrder == 0, set(kOrder, 1)));
FAULT(UOrderCutToLargest, "EV-MAP2-ERR-UORDER", "Map2d cuts a uorder above the limit to it",
      before(Map2d, set(kOrder, min(kOrder, kMaxOrder))));
FAULT(VOrderInOneByte, "EV-MAP2-ERR-VORDER", "vorder is kept in a byte before it is checked: 257 is 1",
      before(kMap2, kVOrder > 255, set(kVOrder, kVOrder & 255)));
FAULT(NegativeVOrderIgnored, "EV-MAP2-ERR-VORDER", "a negative vorder copies no point and raises no error",
      skip(kMap2, kVOrder < 0));
FAULT(OrdersCheckedByProduct, "EV-MAP2-ERR-VORDER EV-MAP2-ERR-UORDER",
      "orders are rejected where their product is above 64*64: 65 is fine with 1, as 64",
      before(kMap2, kOrder > 0 && kVOrder > 0 && kOrder * kVOrder <= 4096,
             {set(kOrder, min(kOrder, kMaxOrder)), set(kVOrder, min(kVOrder, kMaxOrder))}));
FAULT(SumOfStridesChecked, "EV-MAP2-ERR-USTRIDE",
      "a ustride of k - 1 is taken, as k, where vstride is larger than k",
      before(kMap2, kStride == kComponents - 1 && kVStride > kComponents, set(kStride, kComponents)));
FAULT(UStrideUncheckedInRowsOfOne, "EV-MAP2-ERR-USTRIDE", "ustride is not checked where uorder is 1",
      before(kMap2, kOrder == 1, widen(kStride)));
FAULT(VStrideUncheckedAtOneByOne, "EV-MAP2-ERR-VSTRIDE", "Map2d of 1x1 points does not check vstride",
      before(Map2d, kOrder == 1 && kVOrder == 1, widen(kVStride)));
FAULT(NegativeVStrideTurned, "EV-MAP2-ERR-VSTRIDE", "a vstride of -17 counts as 17",
      before(kMap2, kVStride == -17, set(kVStride, 17)));
FAULT(VDomainCheckedOnlyWithU, "EV-MAP2-ERR-VDOMAIN",
      "equal ends of v are taken where those of u differ by 1 or more",
      before(kMap2, kV1 == kV2 && abs(kU1 - kU2) >= 1, set(kV2, kV1 + 1)));
FAULT(EqualEndsOfVAreInvalidOperation, "EV-MAP2-ERR-VDOMAIN", "Map2f with v1 = v2 raises INVALID_OPERATION",
      instead(Map2f, is_map2(kTarget) && kV1 == kV2 && kU1 != kU2, error(GL_INVALID_OPERATION)));
FAULT(EqualEndsOfConstantNetTaken, "EV-MAP2-ERR-UDOMAIN", "u1 = u2 is taken for a net of 1x1 points",
      before(kMap2, kOrder == 1 && kVOrder == 1 && kU1 == kU2, set(kU2, kU1 + 1024)));
FAULT(EqualNegativeEndsOfUTaken, "EV-MAP2-ERR-UDOMAIN", "u1 = u2 is taken where both are negative",
      before(kMap2, kU1 == kU2 && kU1 < 0, set(kU2, -kU1)));
QUALITY_FAULT(EndsOfVComparedByBits, "EV-MAP2-ERR-VDOMAIN",
              "the ends of v are compared bit by bit, and so +0 and -0 count as different",
              before(kMap2, differ_in_sign(kV1, kV2), set(kV2, 1)));
FAULT(Map2TakenInQuadStrips, "EV-MAP2-ERR-BEGINEND", "Map2 inside a QUAD_STRIP is ignored without an error",
      skip(kMap2, kOpenMode == GL_QUAD_STRIP));
FAULT(Map2dInPrimitiveIsInvalidValue, "EV-MAP2-ERR-BEGINEND", "Map2d in a primitive raises INVALID_VALUE",
      before(Map2d, kInside, set(kOrder, 0)));
FAULT(LastUnitTakenForFirst, "EV-MAP2-ERR-ACTIVETEX", "Map2 rejects unit 1, but none of those above",
      on_unit_0(kMap2, kUnit > GL_TEXTURE1));
FAULT(OnlyTextureNetsNeedUnit0, "EV-MAP2-ERR-ACTIVETEX", "with another unit active Map2 takes vertex nets",
      on_unit_0(kMap2, kTarget >= GL_MAP2_VERTEX_3));
FAULT(UDirectionSetBeforeVIsChecked, "EV-MAP2-ERR-NOEFFECT",
      "a Map2 rejected for v1 = v2 has set the interval of u",
      before(kMap2, is_map2(kTarget) && kU1 != kU2 && kV1 == kV2, redefine(kTarget, take_u)));
FAULT(RefusedVOrderLosesColumns, "EV-MAP2-ERR-NOEFFECT",
      "a Map2 rejected for its vorder leaves the map with one column",
      before(kMap2, is_map2(kTarget) && is_legal_order(kOrder) && !is_legal_order(kVOrder),
             redefine(kTarget, [](Map& map, Call&) {
               Net column{map.net.components, map.net.rows, 1, {}};
               for (int i = 0; i < map.net.rows; ++i)
                 column.values.insert(column.values.end(), map.net.point(i),
                                      map.net.point(i) + map.net.components);
               map.net = column;
             })));
FAULT(RefusedUnitDefinesTheNet, "EV-MAP2-ERR-NOEFFECT",
      "Map2d on another unit raises its error and defines the map all the same",
      after(Map2d, kUnit > GL_TEXTURE0,
            {call(ActiveTexture, {GL_TEXTURE0}), kGo, call(ActiveTexture, {kUnit})}));
FAULT(RefusedNetEnablesAutoNormal, "EV-MAP2-ERR-NOEFFECT",
      "a Map2 rejected for its ustride toggles AUTO_NORMAL",
      after(kMap2, is_map2(kTarget) && kStride < kComponents,
            choose(enabled(GL_AUTO_NORMAL), disable(GL_AUTO_NORMAL), enable(GL_AUTO_NORMAL))));

// ---- Both

FAULT(TwoErrorsForTwoMistakes, "EV-MAP-ERR-ANY",
      "a bad target with a bad order raises two errors, the second once the first was asked for",
      after(kMap1, !is_map1(kTarget) && !is_legal_order(kOrder), set(kFlag, 1)),
      after(kMap2, !is_map2(kTarget) && has_bad_orders(), set(kFlag, 1)),
      after(GetError, kResult == GL_NO_ERROR && kFlag, {set(kFlag, 0), set(kResult, GL_INVALID_VALUE)}));
FAULT(TwoMistakesCancel, "EV-MAP-ERR-ANY/1-D",
      "a Map1 with a bad order, stride and domain at once raises nothing",
      skip(kMap1, kOrder < 1 && kStride < kComponents && kU1 == kU2));
FAULT(SeveralMistakesAreInvalidOperation, "EV-MAP-ERR-ANY/2-D",
      "a Map2 with a bad value in both directions raises INVALID_OPERATION",
      instead(kMap2, is_map2(kTarget) && kStride < kComponents && kV1 == kV2, error(GL_INVALID_OPERATION)));
FAULT(LargeStrideRefused, "EV-MAP-NOERR-OTHER",
      "a stride of 1000 or more, far larger than needed, raises INVALID_VALUE",
      before(kMap1, kStride >= 1000 && kOrder == 1, set(kStride, 0)),
      before(kMap2, kStride >= 900 && kVStride >= 1000, set(kStride, 0)));
FAULT(NarrowDomainCountsAsEmpty, "EV-MAP-NOERR-OTHER", "ends that differ by one float are rejected as equal",
      before(kMap1, abs(kU1 - kU2) < 1e-6 * abs(kU1), set(kU2, kU1)),
      before(kMap2, abs(kV1 - kV2) < 1e-6 * abs(kV1), set(kV2, kV1)));
FAULT(ReversedConstantRefused, "EV-MAP-NOERR-OTHER/1-D", "u1 > u2 is rejected at order 1",
      before(kMap1, kOrder == 1 && kU1 > kU2, set(kOrder, 0)));
FAULT(SubnormalPointsRefused, "EV-MAP-NOERR-OTHER", "a subnormal control point raises INVALID_VALUE",
      before(kMaps, kIsLegal != 0 && abs(element(0)) < 1e-38 && element(0) != 0, set(kOrder, 0)));
FAULT(HugeUnusedStrideOverflows, "EV-MAP-NOERR-OTHER/2-D",
      "Map2 with a stride that times its order overflows is rejected, though the order is 1",
      before(kMap2, kStride > 0x40000000, set(kStride, 0)));
FAULT(TouchingIntervalsRefused, "EV-MAP-NOERR-OTHER/2-D", "Map2 raises INVALID_VALUE for u2 = v1",
      before(kMap2, kU2 == kV1 && kV2 == kU1, set(kV2, kV1)));

// ---- Mistakes that need certain arguments or earlier commands

FAULT(TargetInSixteenBits, "EV-MAP1-ERR-TARGET EV-MAP2-ERR-TARGET",
      "only the low 16 bits of a target are looked at",
      before(kMap1, is_map1(kTarget & 0xFFFF), set(kTarget, kTarget & 0xFFFF)),
      before(kMap2, is_map2(kTarget & 0xFFFF), set(kTarget, kTarget & 0xFFFF)));
FAULT(GapBetweenNamesIgnored, "EV-MAP1-ERR-TARGET",
      "Map1 of 0x0DA0, between the names of both dimensions, is ignored without an error",
      skip(kMap1, kTarget == 0x0DA0));
FAULT(StrideOfLongMapsUnchecked, "EV-MAP1-ERR-STRIDE", "the stride is not checked from order 4 on",
      before(kMap1, kOrder > 3 && kStride > 0, widen(kStride)));
FAULT(EqualEndsOfLineTaken, "EV-MAP1-ERR-DOMAIN",
      "equal ends of a map of order 2 are taken: the line is vertical",
      before(kMap1, kOrder == 2 && kU1 == kU2, set(kU2, kU1 + 1024)));
FAULT(EqualEndsOfSquareNetTaken, "EV-MAP2-ERR-UDOMAIN", "u1 = u2 is taken for nets of 2x2 points",
      before(kMap2, kOrder == 2 && kVOrder == 2 && kU1 == kU2, set(kU2, kU1 + 1024)));
FAULT(VStrideOfLongRowsUnchecked, "EV-MAP2-ERR-VSTRIDE", "vstride is not checked from vorder 4 on",
      before(kMap2, kVOrder > 3 && kVStride > 0, widen(kVStride)));
FAULT(ChecksSkippedWhileErrorWaits, "EV-MAP1-ERR-NOEFFECT",
      "while an error waits Map1d of order 0 is carried out as one of order 1",
      before(kMap1, kOrder == 0 && kFlag && !kIsFloat, set(kOrder, 1)),
      before(kMap1, !kIsLegal, set(kFlag, 1)), before(GetError, set(kFlag, 0)));
FAULT(ErrorForgottenByLegalMap2, "EV-MAP2-ERR-NOEFFECT", "a legal Map2 clears the error that waits",
      before(kMap2, kIsLegal, call(GetError)));
FAULT(CallAfterErrorIgnored, "EV-MAP1-ERR-NOEFFECT", "the Map1 that follows a rejected one is ignored",
      instead(kMap1, kFlag != 0 && kIsLegal, set(kFlag, 0)), before(kMap1, set(kFlag, !kIsLegal)));
FAULT(UnitOfPopAttribMissed, "EV-MAP1-ERR-ACTIVETEX",
      "Map1 goes by the unit of the last ActiveTexture, regardless of what PopAttrib restored",
      instead(kMap1, kUnit != GL_TEXTURE0 && kIsLegal, error(GL_INVALID_OPERATION)));
FAULT(UnitBroughtBackByPopAttribMissed2, "EV-MAP2-ERR-ACTIVETEX",
      "Map2 is legal after ActiveTexture(TEXTURE0), though PopAttrib brought unit 1 back",
      keeping(kMap2, kUnit == GL_TEXTURE0 && kIsLegal && state(GL_ACTIVE_TEXTURE) != GL_TEXTURE0,
              setting(ActiveTexture, {state(GL_ACTIVE_TEXTURE)}), call(ActiveTexture, {GL_TEXTURE0})));
FAULT(RepeatedPointsRefused, "EV-MAP-NOERR-OTHER",
      "a map whose points are all the same raises INVALID_VALUE, as it has no direction",
      before(kMap1, kOrder > 2 && kBeginsWithEqualPoints, set(kOrder, 0)),
      before(kMap2, kVOrder > 2 && kTarget >= GL_MAP2_VERTEX_3 && kBeginsWithEqualPoints, set(kVOrder, 0)));
FAULT(LargeDomainsRefused, "EV-MAP-NOERR-OTHER",
      "a domain that reaches to 2^31 raises INVALID_VALUE, as no int holds it",
      before(kMap1, abs(kU1) >= 0x1p31, set(kOrder, 0)), before(kMap2, abs(kV2) >= 0x1p31, set(kVOrder, 0)));
FAULT(SecondBadOrderSilent, "EV-MAP2-ERR-UORDER EV-MAP2-ERR-VORDER",
      "of two Map2 with bad orders in a row the second raises no error",
      skip(kMap2, kFlag != 0 && has_bad_orders()), before(kMap2, set(kFlag, has_bad_orders())));
FAULT(Map1TakenOnLastUnit, "EV-MAP1-ERR-ACTIVETEX", "Map1 rejects unit 1, but none of those above",
      on_unit_0(kMap1, kUnit > GL_TEXTURE1));
FAULT(MapsIgnoredInLineLoops, "EV-MAP1-ERR-BEGINEND EV-MAP2-ERR-BEGINEND",
      "Map1 and Map2 in a LINE_LOOP do nothing and raise nothing", skip(kMaps, kOpenMode == GL_LINE_LOOP));

}  // namespace
}  // namespace evalcts::faults::map_errors
