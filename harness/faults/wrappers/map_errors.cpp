// Faults against section 5 of the requirements: errors of Map1 and Map2.
#include "rules.h"

namespace evalcts::faults::map_errors {
namespace {

Value is_legal_order(Value order) { return order >= 1 && order <= kMaxOrder; }
Value has_bad_orders() { return !is_legal_order(kOrder) || !is_legal_order(kVOrder); }

// Raises a stride that is too small to the number of components.
Value widen(Place stride) { return set(stride, max(stride, kComponents)); }

// Products are computed with 32 bits.
Value wraps(Value product) { return in_bits(product, 32) <= 64; }
FAULT(WrappingOrdersTaken, "EV-MAP-ERR-WRAP", "orders whose product with k wraps at 32 bits are taken as 1",
      before(kMap1, kOrder > kMaxOrder && wraps(kOrder * kComponents), set(kOrder, 1)),
      before(kMap2, kOrder > kMaxOrder && wraps(kOrder * kVOrder), {set(kOrder, 1), set(kVOrder, 1)}));
FAULT(OrderZeroTaken, "EV-MAP1-ERR-ORDER-LOW", "Map1 takes order 0 as 1",
      before(kMap1, kOrder == 0, set(kOrder, 1)));
FAULT(NegativeOrderIgnored, "EV-MAP1-ERR-ORDER-LOW",
      "Map1f of a negative order copies no point and raises no error", skip(Map1f, kOrder < 0));
FAULT(OrdersInOneByte, "EV-MAP1-ERR-ORDER-HIGH EV-MAP2-ERR-VORDER", "orders are kept in a byte: 257 is 1",
      before(kMap1, kOrder > 255, set(kOrder, kOrder & 255)),
      before(kMap2, kVOrder > 255, set(kVOrder, kVOrder & 255)));
FAULT(HighOrderIsInvalidOperation, "EV-MAP1-ERR-ORDER-HIGH",
      "an order far above the limit raises INVALID_OPERATION, as if a resource were short",
      instead(kMap1, is_map1(kTarget) && kOrder >= kMaxOrder + 100, error(GL_INVALID_OPERATION)));
FAULT(NegativeStrideTurned, "EV-MAP1-ERR-STRIDE", "a stride of -17 or less counts as its magnitude",
      before(kMap1, kStride <= -17 && kStride > -10000, set(kStride, -kStride)));
FAULT(StrideOfOrder1Unchecked, "EV-MAP1-ERR-STRIDE-ORDER1 EV-MAP2-ERR-USTRIDE",
      "the stride of u is not checked at order 1", before(kMaps, kOrder == 1, widen(kStride)));
FAULT(StrideOfOrder1ZeroOnly, "EV-MAP1-ERR-STRIDE-ORDER1", "Map1d of order 1 rejects strides below 1 only",
      before(Map1d, kOrder == 1 && kStride > 0, widen(kStride)));
FAULT(EqualEndsIgnoredInDoubles, "EV-MAP1-ERR-DOMAIN",
      "Map1d with equal ends does nothing and raises nothing", skip(Map1d, kU1 == kU2));
FAULT(MapdInPrimitiveIsInvalidEnum, "EV-MAP1-ERR-BEGINEND EV-MAP2-ERR-BEGINEND",
      "Map1d and Map2d in a primitive raise INVALID_ENUM", before(Map1d | Map2d, kInside, set(kTarget, 0)));
FAULT(Map1dTakenOnAnyUnit, "EV-MAP1-ERR-ACTIVETEX", "Map1d of INDEX is rejected on no unit",
      on_unit_0(Map1d, kTarget == GL_MAP1_INDEX));
FAULT(DomainSetBeforeStrideCheck, "EV-MAP1-ERR-NOEFFECT", "a Map1 rejected for its stride has set the domain",
      before(kMap1, is_map1(kTarget) && is_legal_order(kOrder) && kU1 != kU2 && kStride < kComponents,
             redefine(kTarget, take_u)));
FAULT(UOrderCutToLargest, "EV-MAP2-ERR-UORDER", "Map2d cuts a uorder above the limit to it",
      before(Map2d, set(kOrder, min(kOrder, kMaxOrder))));
FAULT(NegativeVStrideTurned, "EV-MAP2-ERR-VSTRIDE", "a vstride of -17 counts as 17",
      before(kMap2, kVStride == -17, set(kVStride, 17)));
FAULT(VDomainCheckedOnlyWithU, "EV-MAP2-ERR-VDOMAIN", "v1 = v2 is taken where u is as wide as 1",
      before(kMap2, kV1 == kV2 && abs(kU1 - kU2) >= 1, set(kV2, kV1 + 1)));
FAULT(EqualEndsOfVAreInvalidOperation, "EV-MAP2-ERR-VDOMAIN", "Map2f with v1 = v2 raises INVALID_OPERATION",
      instead(Map2f, is_map2(kTarget) && kV1 == kV2 && kU1 != kU2, error(GL_INVALID_OPERATION)));
FAULT(EqualEndsOfConstantTaken, "EV-MAP1-ERR-DOMAIN EV-MAP2-ERR-UDOMAIN",
      "u1 = u2 is taken for one point, as nothing is divided by the difference",
      before(kMap1, kOrder == 1 && kU1 == kU2, set(kU2, kU1 + 1)),
      before(kMap2, kOrder == 1 && kVOrder == 1 && kU1 == kU2, set(kU2, kU1 + 1024)));
FAULT(EqualNegativeEndsOfUTaken, "EV-MAP2-ERR-UDOMAIN", "u1 = u2 is taken where both are negative",
      before(kMap2, kU1 == kU2 && kU1 < 0, set(kU2, -kU1)));
FAULT(OnlyTextureNetsNeedUnit0, "EV-MAP2-ERR-ACTIVETEX", "with another unit active Map2 takes vertex nets",
      on_unit_0(kMap2, kTarget >= GL_MAP2_VERTEX_3));
FAULT(UDirectionSetBeforeVIsChecked, "EV-MAP2-ERR-NOEFFECT", "a Map2 rejected for v1 = v2 has set u1 and u2",
      before(kMap2, is_map2(kTarget) && kU1 != kU2 && kV1 == kV2, redefine(kTarget, take_u)));
FAULT(TwoErrorsForTwoMistakes, "EV-MAP-ERR-ANY",
      "a bad target with a bad order raises two errors, the second once the first was asked for",
      after(kMap1, !is_map1(kTarget) && !is_legal_order(kOrder), set(kFlag, 1)),
      after(kMap2, !is_map2(kTarget) && has_bad_orders(), set(kFlag, 1)),
      after(GetError, kResult == GL_NO_ERROR && kFlag, {set(kFlag, 0), set(kResult, GL_INVALID_VALUE)}));
FAULT(TwoMistakesCancel, "EV-MAP-ERR-ANY/1-D", "a Map1 with three mistakes at once raises nothing",
      skip(kMap1, kOrder < 1 && kStride < kComponents && kU1 == kU2));
FAULT(SeveralMistakesAreInvalidOperation, "EV-MAP-ERR-ANY/2-D",
      "a Map2 with a bad value in both directions raises INVALID_OPERATION",
      instead(kMap2, is_map2(kTarget) && kStride < kComponents && kV1 == kV2, error(GL_INVALID_OPERATION)));
FAULT(ReversedConstantRefused, "EV-MAP-NOERR-OTHER/1-D", "u1 > u2 is rejected at order 1",
      before(kMap1, kOrder == 1 && kU1 > kU2, set(kOrder, 0)));
FAULT(SubnormalPointsRefused, "EV-MAP-NOERR-OTHER", "a subnormal control point raises INVALID_VALUE",
      before(kMaps, kIsLegal != 0 && abs(element(0)) < 1e-38 && element(0) != 0, set(kOrder, 0)));
FAULT(TouchingIntervalsRefused, "EV-MAP-NOERR-OTHER/2-D", "Map2 raises INVALID_VALUE if u2 = v1 and v2 = u1",
      before(kMap2, kU2 == kV1 && kV2 == kU1, set(kV2, kV1)));
FAULT(TargetInSixteenBits, "EV-MAP1-ERR-TARGET EV-MAP2-ERR-TARGET", "targets are kept in 16 bits",
      before(kMap1, is_map1(kTarget & 0xFFFF), set(kTarget, kTarget & 0xFFFF)),
      before(kMap2, is_map2(kTarget & 0xFFFF), set(kTarget, kTarget & 0xFFFF)));
FAULT(GapBetweenNamesIgnored, "EV-MAP1-ERR-TARGET EV-MAP2-ERR-TARGET",
      "Map1 and Map2 of 0x0DA0, between the names of both dimensions, are ignored without an error",
      skip(kMaps, kTarget == 0x0DA0));
FAULT(ErrorForgottenByLegalMap, "EV-MAP1-ERR-NOEFFECT EV-MAP2-ERR-NOEFFECT",
      "a legal Map1 or Map2 clears the error that waits", before(kMaps, kIsLegal, call(GetError)));
FAULT(SecondBadOrderSilent, "EV-MAP2-ERR-UORDER EV-MAP2-ERR-VORDER",
      "of two Map2 with bad orders in a row the second raises no error",
      skip(kMap2, kFlag != 0 && has_bad_orders()), before(kMap2, set(kFlag, has_bad_orders())));
FAULT(MapsTakenOnLastUnit, "EV-MAP1-ERR-ACTIVETEX EV-MAP2-ERR-ACTIVETEX",
      "Map1 and Map2 reject unit 1, but none of those above", on_unit_0(kMaps, kUnit > GL_TEXTURE1));
FAULT(MapsIgnoredInLineLoops, "EV-MAP1-ERR-BEGINEND EV-MAP2-ERR-BEGINEND",
      "Map1 and Map2 in a LINE_LOOP do nothing and raise nothing", skip(kMaps, kOpenMode == GL_LINE_LOOP));

}  // namespace
}  // namespace evalcts::faults::map_errors
