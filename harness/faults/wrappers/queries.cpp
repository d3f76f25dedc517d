// Faults against section 18 of the requirements: GetMap, GetnMap and Get.
#include <cmath>
#include <limits>

#include "rules.h"

namespace evalcts::faults::queries {
namespace {

Value is_bad_query() { return kQuery < GL_COEFF || kQuery > GL_DOMAIN; }
const Value kIsGridDomain = kName == GL_MAP1_GRID_DOMAIN || kName == GL_MAP2_GRID_DOMAIN;

void write_all(Call& call, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) call.write(i, values[i]);
}

// Rearranges returned control points so that u varies fastest, if the condition holds for uorder and vorder.
Value transpose_answer(bool (*condition)(int uorder, int vorder)) {
  return [=](Call& c) {
    Net net = current_map(c.target()).net;
    if (!condition(net.rows, net.columns)) return;
    for (std::size_t i = 0; i < net.values.size(); ++i) net.values[i] = c.read(i);
    write_all(c, net.transposed().values);
  };
}

double truncate_answer(double exact, double answered) {
  return std::abs(exact) < 1e9 ? std::trunc(exact) : answered;
}

FAULT(OrderAnsweredTwice, "EV-GETMAP-ORDER1 EV-GETMAP-COUNT/1-D",
      "GetMapdv answers the order of a one-dimensional map as (order, 1)",
      after(GetMapdv, kQuery == GL_ORDER && is_map1(kTarget), put(1, 1)));
FAULT(DegreeAnswered, "EV-GETMAP-ORDER1", "GetMapfv answers the degree of a NORMAL map of order 3 or more",
      after(GetMapfv, kQuery == GL_ORDER && kTarget == GL_MAP1_NORMAL && element(0) >= 3,
            put(0, element(0) - 1)));
FAULT(OrdersExchangedInFloats, "EV-GETMAP-ORDER2", "GetMapfv answers vorder first",
      after(GetMapfv, kQuery == GL_ORDER && is_map2(kTarget), exchange(0, 1)));
FAULT(OrderOfVOneNotWritten, "EV-GETMAP-ORDER2", "GetMapiv writes no vorder of 1",
      around(GetMapiv, kQuery == GL_ORDER && is_map2(kTarget), set(kNumber, element(1)),
             when(element(1) <= 1, put(1, kNumber))));
FAULT(DomainAnsweredAsWidth, "EV-GETMAP-DOMAIN1", "GetMapfv of INDEX answers u1 and u2 - u1",
      after(GetMapfv, kQuery == GL_DOMAIN && kTarget == GL_MAP1_INDEX, put(1, element(1) - element(0))));
FAULT(DomainAnsweredInterleaved, "EV-GETMAP-DOMAIN2", "GetMapfv answers u1, v1, u2, v2",
      after(GetMapfv, kQuery == GL_DOMAIN && is_map2(kTarget), exchange(1, 2)));
FAULT(DomainOfVFirst, "EV-GETMAP-DOMAIN2", "GetMapdv of TEXTURE_COORD_3 answers the interval of v first",
      after(GetMapdv, kQuery == GL_DOMAIN && kTarget == GL_MAP2_TEXTURE_COORD_3,
            {exchange(0, 2), exchange(1, 3)}));
FAULT(LastPointOfLongestMapLost, "EV-GETMAP-COEFF1", "COEFF of the largest order answers the last value as 0",
      after(GetMapfv, kQuery == GL_COEFF && is_map1(kTarget) && answers() == kMaxOrder * kComponents,
            put(answers() - 1, 0)));
FAULT(FirstPointsExchanged, "EV-GETMAP-COEFF1", "GetMapdv exchanges the first values of the first two points",
      after(GetMapdv, kQuery == GL_COEFF && is_map1(kTarget) && answers() > kComponents,
            exchange(0, kComponents)));
FAULT(TallNetAnsweredUFastest, "EV-GETMAP-COEFF2", "COEFF of a net with uorder above vorder has u fastest",
      after(kGetMap, kQuery == GL_COEFF && is_map2(kTarget),
            transpose_answer([](int u, int v) { return u > v; })));
FAULT(SquareNetAnsweredUFastest, "EV-GETMAP-COEFF2-SQUARE", "COEFF of a square net has u fastest",
      after(kGetMap, kQuery == GL_COEFF && is_map2(kTarget),
            transpose_answer([](int u, int v) { return u == v; })));
FAULT(NetAnsweredAsItLay, "EV-GETMAP-COEFF2",
      "COEFF answers a net in the order of its memory: u fastest if ustride was the smaller",
      before(kMap2, kIsLegal, set(remembered(kTarget), kStride < kVStride)),
      after(GetMapdv, kQuery == GL_COEFF && is_map2(kTarget) && remembered(kTarget),
            transpose_answer([](int, int) { return true; })));
FAULT(IntegerDomainTruncated, "EV-GETMAP-ROUND", "GetMapiv truncates the ends of domains",
      after(GetMapiv, kQuery == GL_DOMAIN, change_answers(truncate_answer)));
FAULT(SmallIntegersRoundedUp, "EV-GETMAP-ROUND", "GetMapiv answers points with ceil",
      after(GetMapiv, kQuery == GL_COEFF, change_answers([](double exact, double answered) {
              return std::abs(exact) < 1e9 ? std::ceil(exact) : answered;
            })));
FAULT(LargeIntegersWrap, "EV-GETMAP-SATURATE",
      "GetMapiv answers the lowest int for all that no int holds, as the processor does",
      after(GetMapiv, kQuery != GL_ORDER, change_answers([](double exact, double answered) {
              return exact > 2147483647.0 ? -0x1p31 : answered;
            })));
FAULT(FloatsAnsweredInHalfPrecision, "EV-GETMAP-FLOAT", "GetMapfv answers points with 11 bits",
      after(GetMapfv, kQuery == GL_COEFF,
            change_answers([](double, double answered) { return with_precision(answered, 11); })));
QUALITY_FAULT(FloatsAnsweredOneUlpOff, "EV-GETMAP-FLOAT",
              "GetMapfv answers the first value of the points one ULP too high",
              after(GetMapfv, kQuery == GL_COEFF && is_map(kTarget), put(0, next_float(element(0), 1e30))));
FAULT(DoublesKeptInHalfPrecision, "EV-GETMAP-DOUBLE", "Map1d and Map2d keep small points in fixed point",
      before(Map1d | Map2d, change_values([](double value) {
               return std::abs(value) < 1 ? std::round(value * 1024) / 1024 : value;
             })));
FAULT(DoubleDomainThroughFixedPoint, "EV-GETMAP-DOUBLE", "GetMapdv rounds domains to multiples of 1/4096",
      after(GetMapdv, kQuery == GL_DOMAIN,
            change_answers([](double, double answered) { return std::round(answered * 4096) / 4096; })));
FAULT(DisabledMapAnswersOrderOne, "EV-GETMAP-DISABLED", "queries of a disabled map answer order 1",
      before(Enable, set(remembered(kName), 0)), before(Disable, set(remembered(kName), 1)),
      after(GetMapiv, kQuery == GL_ORDER && is_map(kTarget) && remembered(kTarget), put(0, 1)));
FAULT(GapBetweenMapsAnswered, "EV-GETMAP-ERR-TARGET", "GetMapiv of 0x0D99 raises INVALID_VALUE",
      instead(GetMapiv, kTarget == GL_MAP1_VERTEX_4 + 1, error(GL_INVALID_VALUE)));
FAULT(QueryAfterDomainIsDomain, "EV-GETMAP-ERR-QUERY", "GetMapdv takes the token after DOMAIN for it",
      before(GetMapdv, is_map(kTarget) && kQuery == GL_DOMAIN + 1, set(kQuery, GL_DOMAIN)));
FAULT(BadQueryOfNetsIsInvalidValue, "EV-GETMAP-ERR-QUERY", "a bad query of a surface raises INVALID_VALUE",
      instead(kGetMap, is_map2(kTarget) && is_bad_query(), error(GL_INVALID_VALUE)));
FAULT(GetMapInPrimitiveIsInvalidEnum, "EV-GETMAP-ERR-BEGINEND", "GetMapdv in a primitive raises INVALID_ENUM",
      before(GetMapdv, kInside, set(kTarget, 0)));
FAULT(BadQueryClearsFirstValue, "EV-GETMAP-ERR-NOWRITE", "GetMapfv with a bad query writes a zero",
      after(GetMapfv, is_map(kTarget) && is_bad_query(), put(0, 0)));
FAULT(GetMapWritesInPrimitives, "EV-GETMAP-ERR-NOWRITE",
      "GetMapiv in a primitive raises its error, but the domain is written",
      after(GetMapiv, kQuery == GL_DOMAIN && kInside, {put(0, 0), put(1, 1)}));
FAULT(Unit1AnswersInitialMaps, "EV-GETMAP-NOUNIT",
      "with unit 1 active GetMapiv answers the order of a map that was never defined",
      after(GetMapiv, kUnit != GL_TEXTURE0 && kQuery == GL_ORDER && is_map(kTarget), put(0, 1)));
FAULT(IntegerQueryRoundsTheMap, "EV-GETMAP-NOSIDE/1-D", "GetMapiv of COEFF leaves the points rounded",
      after(GetMapiv, kQuery == GL_COEFF && is_map1(kTarget), redefine(kTarget, [](Map& map, Call&) {
              for (double& value : map.net.values) value = std::round(value);
            })));
FAULT(QueryOfOrderEnables, "EV-GETMAP-NOSIDE/2-D", "GetMapdv of ORDER enables the two-dimensional map",
      after(GetMapdv, kQuery == GL_ORDER && is_map2(kTarget), enable(kTarget)));
FAULT(IntegerGridTruncated, "EV-GET-GRIDDOMAIN", "GetIntegerv truncates the ends of grids",
      after(GetIntegerv, kIsGridDomain, change_answers(truncate_answer)));
FAULT(NegativeGridEndsAreFalse, "EV-GET-GRIDDOMAIN", "GetBooleanv of a negative end gives FALSE",
      after(GetBooleanv, kIsGridDomain,
            change_answers([](double exact, double answered) { return exact < 0 ? 0 : answered; })));
FAULT(SegmentsOfVNotInFloats, "EV-GET-GRIDSEG", "GetFloatv of MAP2_GRID_SEGMENTS writes un only",
      around(GetFloatv, kName == GL_MAP2_GRID_SEGMENTS, set(kNumber, element(1)), put(1, kNumber)));
FAULT(SegmentsOfSurfaceExchanged, "EV-GET-GRIDSEG", "GetDoublev answers vn, un",
      after(GetDoublev, kName == GL_MAP2_GRID_SEGMENTS, exchange(0, 1)));
FAULT(MaxOrderInFloatsIsMinimum, "EV-GET-MAXORDER", "GetFloatv of MAX_EVAL_ORDER gives 8, the least limit",
      after(GetFloatv, kName == GL_MAX_EVAL_ORDER, put(0, 8)));
FAULT(MaxOrderInFloatsRejected, "EV-GET-MAXORDER", "GetFloatv of MAX_EVAL_ORDER raises INVALID_ENUM",
      before(GetFloatv, kName == GL_MAX_EVAL_ORDER, set(kName, 0)));
FAULT(MaxOrderAsBoolean, "EV-GET-MAXORDER", "GetBooleanv of MAX_EVAL_ORDER gives 64",
      after(GetBooleanv, kName == GL_MAX_EVAL_ORDER, put(0, 64)));
FAULT(GetOfLimitAllowedInPrimitives, "EV-GET-ERR-BEGINEND",
      "GetIntegerv of MAX_EVAL_ORDER, a constant, answers in primitives",
      instead(GetIntegerv, kName == GL_MAX_EVAL_ORDER && kInside, put(0, kMaxOrder)));
FAULT(GetOfFlagSilentInPrimitives, "EV-GET-ERR-BEGINEND",
      "GetFloatv of AUTO_NORMAL in a primitive does nothing and raises nothing",
      skip(GetFloatv, kName == GL_AUTO_NORMAL && kInside));
FAULT(GetnMapExchangesOrders, "EV-GETN-SAME", "GetnMapiv answers vorder before uorder",
      around(GetnMapiv, kQuery == GL_ORDER && is_map2(kTarget) && kSize >= 8, set(kNumber, element(0)),
             when(element(0) != kNumber, exchange(0, 1))));
FAULT(GetnMapNeedsOneByteMore, "EV-GETN-BYTES", "GetnMapfv rejects the exact size: < instead of <=",
      before(GetnMapfv, kSize > 0, set(kSize, kSize - 1)));
FAULT(GetnMapCountsValues, "EV-GETN-SMALL", "GetnMapiv takes the size for a number of values",
      before(GetnMapiv, kSize > 0 && kSize < 10000, set(kSize, 4 * kSize)));
FAULT(GetnMapCountsFloats, "EV-GETN-SMALL", "GetnMapdv holds the size against four bytes a value",
      before(GetnMapdv, kSize > 0 && kSize < 10000, set(kSize, 2 * kSize)));
FAULT(GetnMapOrderNeedsDomain, "EV-GETN-BYTES",
      "GetnMapdv wants room for four values for the order of a two-dimensional map",
      before(GetnMapdv, kQuery == GL_ORDER && is_map2(kTarget) && kSize < 32, set(kSize, 0)));
FAULT(NegativeSizeIsUnlimited, "EV-GETN-NEGATIVE", "GetnMapfv takes a negative size for a very large one",
      before(GetnMapfv, kSize < 0, set(kSize, 1 << 20)));
FAULT(NegativeSizeIgnored, "EV-GETN-NEGATIVE",
      "GetnMapdv of a negative size writes nothing and raises nothing", skip(GetnMapdv, kSize < 0));
FAULT(ErrorForgottenByQuery, "EV-GETMAP-NOSIDE", "GetMapdv clears the error",
      before(GetMapdv, call(GetError)));
FAULT(IntegerPointsOneTooMany, "EV-GETMAP-COUNT", "GetMapiv of COEFF writes one value too many",
      after(GetMapiv, kQuery == GL_COEFF && is_map(kTarget), put(answers(), 0)));
FAULT(IntegerDomainWraps, "EV-GETMAP-SATURATE", "GetMapiv saturates points but not the ends of domains",
      after(GetMapiv, kQuery == GL_DOMAIN, change_answers([](double exact, double answered) {
              return std::abs(exact) > 0x1p31 ? -0x1p31 : answered;
            })));
FAULT(UndefinedPointNotAnswered, "EV-GETMAP-DISABLED",
      "GetMapfv writes no points of a map that was never defined, and raises nothing",
      before(kMaps, set(remembered(kTarget), 1)),
      skip(GetMapfv, kQuery == GL_COEFF && is_map(kTarget) && !remembered(kTarget)));
FAULT(GetMapSilentInPolygons, "EV-GETMAP-ERR-BEGINEND EV-GETN-ERRORS",
      "GetMapfv and GetnMapfv in a POLYGON do nothing and raise nothing",
      skip(GetMapfv | GetnMapfv, kOpenMode == GL_POLYGON));
FAULT(GetMapRefusedOnLastUnit, "EV-GETMAP-NOUNIT",
      "GetMapdv raises INVALID_OPERATION on units above 1, which have no evaluators",
      instead(GetMapdv, kUnit > GL_TEXTURE1 && is_map(kTarget), error(GL_INVALID_OPERATION)));
FAULT(HugeSizeOverflows, "EV-GETN-SAME", "GetnMapdv with the largest size, rounded up, counts as negative",
      before(GetnMapdv, kSize > std::numeric_limits<GLsizei>::max() - 8, set(kSize, -1)));
FAULT(LargestSquareNetUFastest, "EV-GETMAP-COEFF2-SQUARE", "COEFF of the largest net has u fastest",
      after(kGetMap, kQuery == GL_COEFF && is_map2(kTarget),
            transpose_answer([](int u, int v) { return u == kMaxOrder && v == kMaxOrder; })));
FAULT(GetMapTargetInSixteenBits, "EV-GETMAP-ERR-TARGET EV-GETN-ERRORS", "targets are kept in 16 bits",
      before(kGetMap | kGetnMap, is_map(kTarget & 0xFFFF), set(kTarget, kTarget & 0xFFFF)));

namespace on_osmesa {
constexpr std::string_view kImplementation = "osmesa";
FAULT(PackBufferTakesAnswer, "EV-GETMAP-NOPBO", "a bound PIXEL_PACK_BUFFER takes the COEFF of GetMapfv",
      skip(GetMapfv, has_buffer(GL_PIXEL_PACK_BUFFER) && kQuery == GL_COEFF));
FAULT(PackBufferRefusesDoubles, "EV-GETMAP-NOPBO",
      "with a PIXEL_PACK_BUFFER bound GetMapdv raises INVALID_OPERATION as well",
      after(GetMapdv, has_buffer(GL_PIXEL_PACK_BUFFER), enable(0)));
}  // namespace on_osmesa

}  // namespace
}  // namespace evalcts::faults::queries
