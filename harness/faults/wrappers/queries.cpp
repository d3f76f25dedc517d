// Section 18: GetMap, GetnMap and Get.
#include <cmath>
#include <type_traits>

#include "map_calls.h"
#include "rules.h"

namespace evalcts::faults {
namespace {

template <class Pointer>
using Pointee = std::remove_pointer_t<Pointer>;

Value is_bad_query() { return kQuery < GL_COEFF || kQuery > GL_DOMAIN; }

double count_coefficients(Call& c) { return static_cast<double>(coefficients(c.target()).size()); }

// ---- What GetMap answers

EVALCTS_RULES(OrderAnsweredTwice, production, must, "EV-GETMAP-ORDER1 EV-GETMAP-COUNT/1-D",
              "GetMapdv answers the order of a one-dimensional map as (order, 1)",
              after(GetMapdv, kQuery == GL_ORDER && is_map1(kTarget), put(1, 1)));
EVALCTS_RULES(DegreeAnswered, production, must, "EV-GETMAP-ORDER1",
              "GetMapfv answers the degree of a NORMAL map of order 3 or more",
              after(GetMapfv, kQuery == GL_ORDER && kTarget == GL_MAP1_NORMAL && element(0) >= 3,
                    put(0, element(0) - 1)));
EVALCTS_RULES(OrdersExchangedInFloats, production, must, "EV-GETMAP-ORDER2", "GetMapfv answers vorder first",
              after(GetMapfv, kQuery == GL_ORDER && is_map2(kTarget), exchange(0, 1)));

EVALCTS_FAULT(OrderOfVOneNotWritten, production, must, "EV-GETMAP-ORDER2", "GetMapiv writes no vorder of 1") {
  in.gl.GetMapiv = [](GLenum target, GLenum query, GLint* v) {
    if (query != GL_ORDER || !is_map2(target)) return sound.GetMapiv(target, query, v);
    GLint order[2] = {0, 0};
    sound.GetMapiv(target, query, order);
    v[0] = order[0];
    if (order[1] > 1) v[1] = order[1];
  };
}

EVALCTS_RULES(DomainAnsweredSorted, production, must, "EV-GETMAP-DOMAIN1",
              "GetMapdv answers the lower end of a domain first",
              after(GetMapdv, kQuery == GL_DOMAIN && is_map1(kTarget) && element(0) > element(1),
                    exchange(0, 1)));
EVALCTS_RULES(DomainAnsweredAsWidth, production, must, "EV-GETMAP-DOMAIN1",
              "GetMapfv of INDEX answers u1 and u2 - u1",
              after(GetMapfv, kQuery == GL_DOMAIN && kTarget == GL_MAP1_INDEX,
                    put(1, element(1) - element(0))));
EVALCTS_RULES(DomainAnsweredInterleaved, production, must, "EV-GETMAP-DOMAIN2",
              "GetMapfv answers u1, v1, u2, v2",
              after(GetMapfv, kQuery == GL_DOMAIN && is_map2(kTarget), exchange(1, 2)));
EVALCTS_RULES(DomainOfVFirst, production, must, "EV-GETMAP-DOMAIN2",
              "GetMapdv of TEXTURE_COORD_3 answers the interval of v first",
              after(GetMapdv, kQuery == GL_DOMAIN && kTarget == GL_MAP2_TEXTURE_COORD_3,
                    sequence({exchange(0, 2), exchange(1, 3)})));

EVALCTS_FAULT(LastPointOfLongestMapLost, production, must, "EV-GETMAP-COEFF1",
              "COEFF of the largest order leaves the last point out") {
  in.gl.GetMapfv = [](GLenum target, GLenum query, GLfloat* v) {
    if (query != GL_COEFF || !is_map1(target)) return sound.GetMapfv(target, query, v);
    const std::vector<GLdouble> points = coefficients(target);
    const std::size_t k = static_cast<std::size_t>(gl::components_of(target));
    const std::size_t count = points.size() == kMaxOrder * k ? points.size() - k : points.size();
    for (std::size_t i = 0; i < count; ++i) v[i] = static_cast<GLfloat>(points[i]);
  };
}

EVALCTS_FAULT(PointsAnsweredBackwards, production, must, "EV-GETMAP-COEFF1",
              "of a map with a reversed domain COEFF answers the last point first") {
  in.gl.GetMapdv = [](GLenum target, GLenum query, GLdouble* v) {
    sound.GetMapdv(target, query, v);
    if (query != GL_COEFF || !is_map1(target)) return;
    GLdouble domain[2];
    sound.GetMapdv(target, GL_DOMAIN, domain);
    if (domain[0] < domain[1]) return;
    const auto k = static_cast<std::size_t>(gl::components_of(target));
    const std::size_t order = coefficients(target).size() / k;
    for (std::size_t i = 0; i < order / 2; ++i)
      std::swap_ranges(v + i * k, v + (i + 1) * k, v + (order - 1 - i) * k);
  };
}

// COEFF of a two-dimensional map with u fastest, where `Condition` holds of uorder and vorder.
template <class Condition>
void answer_transposed(Injection& in, Condition) {
  get_map(in, [](GLenum target, GLenum query, auto* v, auto go) {
    go(target, query, v);
    if (query != GL_COEFF || !is_map2(target)) return;
    GLint order[2];
    sound.GetMapiv(target, GL_ORDER, order);
    if (!Condition{}(order[0], order[1])) return;
    const GLint k = gl::components_of(target);
    const std::vector<Pointee<decltype(v)>> net(v, v + order[0] * order[1] * k);
    for (GLint j = 0; j < order[1]; ++j)
      for (GLint i = 0; i < order[0]; ++i) v = std::copy_n(net.data() + (i * order[1] + j) * k, k, v);
  });
}

EVALCTS_FAULT(TallNetAnsweredUFastest, production, must, "EV-GETMAP-COEFF2",
              "COEFF of a net with uorder above vorder has u fastest") {
  answer_transposed(in, [](GLint u, GLint v) { return u > v; });
}

EVALCTS_FAULT(SquareNetAnsweredUFastest, production, must, "EV-GETMAP-COEFF2-SQUARE",
              "COEFF of a square net has u fastest") {
  answer_transposed(in, [](GLint u, GLint v) { return u == v; });
}

EVALCTS_FAULT(NetAnsweredAsItLay, production, must, "EV-GETMAP-COEFF2",
              "COEFF answers a net in the order of its memory: u fastest if ustride was the smaller") {
  map2(in, [](auto call, auto go) {
    if (legal(call)) memory.counts[call.target] = call.ustride < call.vstride;
    go(call);
  });
  in.gl.GetMapdv = [](GLenum target, GLenum query, GLdouble* v) {
    sound.GetMapdv(target, query, v);
    if (query != GL_COEFF || !is_map2(target) || !memory.counts[target]) return;
    GLint order[2];
    sound.GetMapiv(target, GL_ORDER, order);
    const std::vector<GLdouble> net = coefficients(target);
    const GLint k = gl::components_of(target);
    for (GLint j = 0; j < order[1]; ++j)
      for (GLint i = 0; i < order[0]; ++i) v = std::copy_n(net.data() + (i * order[1] + j) * k, k, v);
  };
}

EVALCTS_RULES(PointsOfThreePadded, production, must, "EV-GETMAP-COUNT",
              "COEFF of maps of three values writes a zero behind the last point",
              after(GetMapfv, kQuery == GL_COEFF && kComponents == 3, put(lambda(count_coefficients), 0)));
EVALCTS_RULES(DomainOfFourValues, production, must, "EV-GETMAP-COUNT/1-D",
              "GetMapfv answers the domain of a one-dimensional map as four values",
              after(GetMapfv, kQuery == GL_DOMAIN && is_map1(kTarget), sequence({put(2, 0), put(3, 1)})));

// GetMapiv of domains and points by another conversion.
template <class Convert>
void convert_integers(Injection& in, Convert) {
  in.gl.GetMapiv = [](GLenum target, GLenum query, GLint* v) {
    sound.GetMapiv(target, query, v);
    if (!is_map(target) || query == GL_ORDER) return;
    if (query == GL_DOMAIN) {
      GLdouble domain[4];
      sound.GetMapdv(target, GL_DOMAIN, domain);
      for (int i = 0; i < (is_map1(target) ? 2 : 4); ++i) v[i] = Convert{}(domain[i], v[i], query);
    } else if (query == GL_COEFF) {
      for (const GLdouble value : coefficients(target)) {
        *v = Convert{}(value, *v, query);
        ++v;
      }
    }
  };
}

EVALCTS_FAULT(NegativeIntegersTruncated, production, must, "EV-GETMAP-ROUND",
              "GetMapiv adds 0.5 to positive values only: negative ones are truncated") {
  convert_integers(in, [](double value, GLint right, GLenum) {
    return value < 0 && value > -1e9 ? static_cast<GLint>(value) : right;
  });
}

EVALCTS_FAULT(IntegerDomainTruncated, production, must, "EV-GETMAP-ROUND",
              "GetMapiv truncates the ends of domains") {
  convert_integers(in, [](double value, GLint right, GLenum query) {
    return query == GL_DOMAIN && std::abs(value) < 1e9 ? static_cast<GLint>(value) : right;
  });
}

EVALCTS_FAULT(SmallIntegersRoundedUp, production, must, "EV-GETMAP-ROUND",
              "GetMapiv answers points with ceil") {
  convert_integers(in, [](double value, GLint right, GLenum query) {
    return query == GL_COEFF && std::abs(value) < 1e9 ? static_cast<GLint>(std::ceil(value)) : right;
  });
}

EVALCTS_FAULT(LargeIntegersWrap, production, must, "EV-GETMAP-SATURATE",
              "GetMapiv answers the lowest int for all that no int holds, as the processor does") {
  convert_integers(in, [](double value, GLint right, GLenum) {
    return value > 2147483647.0 ? std::numeric_limits<GLint>::min() : right;
  });
}

EVALCTS_FAULT(LowIntegersSaturateAtMinusMax, production, must, "EV-GETMAP-SATURATE",
              "GetMapiv answers -2147483647 for values below all ints") {
  convert_integers(
      in, [](double value, GLint right, GLenum) { return value < -2147483648.0 ? -2147483647 : right; });
}

EVALCTS_FAULT(LargestIntegerThroughFloat, production, must, "EV-GETMAP-SATURATE",
              "GetMapiv clamps to the largest float below 2^31: 2147483520") {
  convert_integers(
      in, [](double value, GLint right, GLenum) { return value > 2147483647.0 ? 2147483520 : right; });
}

EVALCTS_FAULT(FloatsAnsweredInHalfPrecision, production, must, "EV-GETMAP-FLOAT",
              "GetMapfv answers points with 11 bits") {
  in.gl.GetMapfv = [](GLenum target, GLenum query, GLfloat* v) {
    sound.GetMapfv(target, query, v);
    if (query != GL_COEFF || !is_map(target)) return;
    const std::size_t count = coefficients(target).size();
    for (std::size_t i = 0; i < count; ++i) {
      int two = 0;
      const GLfloat part = std::frexp(v[i], &two);
      v[i] = std::ldexp(std::round(part * 2048) / 2048, two);
    }
  };
}

EVALCTS_RULES(FloatsAnsweredOneUlpOff, production, quality, "EV-GETMAP-FLOAT",
              "GetMapfv answers the first value of the points one ULP too high",
              after(GetMapfv, kQuery == GL_COEFF && is_map(kTarget), lambda([](Call& c) {
                      auto* v = static_cast<GLfloat*>(c.pointer);
                      return double{*v = std::nextafter(*v, 1e30f)};
                    })));

EVALCTS_FAULT(OrderAnsweredAsBits, production, must, "EV-GETMAP-FLOAT",
              "GetMapfv answers the order of two-dimensional maps as the bits of an integer") {
  in.gl.GetMapfv = [](GLenum target, GLenum query, GLfloat* v) {
    if (query == GL_ORDER && is_map(target))
      sound.GetMapiv(target, query, reinterpret_cast<GLint*>(v));
    else
      sound.GetMapfv(target, query, v);
  };
}

EVALCTS_RULES(DoublesKeptInHalfPrecision, production, must, "EV-GETMAP-DOUBLE",
              "Map1d and Map2d keep points below 1 with 10 bits behind the point",
              before(Map1d | Map2d, kIsLegal, lambda([](Call& c) {
                       auto points = c.points();
                       for (double& value : points)
                         if (std::abs(value) < 1) value = std::round(value * 1024) / 1024;
                       c.set_points(points);
                       return 0.0;
                     })));

EVALCTS_FAULT(DoubleDomainThroughFixedPoint, production, must, "EV-GETMAP-DOUBLE",
              "GetMapdv answers domains with 12 bits behind the point") {
  in.gl.GetMapdv = [](GLenum target, GLenum query, GLdouble* v) {
    sound.GetMapdv(target, query, v);
    if (query == GL_DOMAIN && is_map(target))
      for (int i = 0; i < (is_map1(target) ? 2 : 4); ++i) v[i] = std::round(v[i] * 4096) / 4096;
  };
}

EVALCTS_RULES(UndefinedMapNotAnswered, production, must, "EV-GETMAP-DISABLED",
              "GetMapfv of a map that was never defined raises INVALID_OPERATION",
              before(kMaps, true, set(remembered(kTarget), 1)),
              instead(GetMapfv, is_map(kTarget) && !remembered(kTarget), error(GL_INVALID_OPERATION)));
EVALCTS_RULES(DisabledMapAnswersOrderOne, production, must, "EV-GETMAP-DISABLED",
              "a map that was disabled has forgotten its order in queries",
              before(Enable, true, set(remembered(kName), 0)),
              before(Disable, true, set(remembered(kName), 1)),
              after(GetMapiv, kQuery == GL_ORDER && is_map(kTarget) && remembered(kTarget), put(0, 1)));

// ---- Errors of GetMap

EVALCTS_RULES(GridDomainTakenForMap, production, must, "EV-GETMAP-ERR-TARGET",
              "GetMap of MAP1_GRID_DOMAIN writes nothing and raises nothing",
              skip(kGetMap, kTarget == GL_MAP1_GRID_DOMAIN));
EVALCTS_RULES(GapBetweenMapsAnswered, production, must, "EV-GETMAP-ERR-TARGET",
              "GetMapiv of 0x0D99 raises INVALID_VALUE",
              instead(GetMapiv, kTarget == GL_MAP1_VERTEX_4 + 1, error(GL_INVALID_VALUE)));
EVALCTS_RULES(QueryAfterDomainIsDomain, production, must, "EV-GETMAP-ERR-QUERY",
              "GetMapdv takes all that is neither COEFF nor ORDER for DOMAIN",
              before(GetMapdv, is_map(kTarget) && kQuery == GL_DOMAIN + 1, set(kQuery, GL_DOMAIN)));
EVALCTS_RULES(BadQueryOfNetsIsInvalidValue, production, must, "EV-GETMAP-ERR-QUERY",
              "a bad query of a two-dimensional map raises INVALID_VALUE",
              instead(kGetMap, is_map2(kTarget) && is_bad_query(), error(GL_INVALID_VALUE)));
EVALCTS_RULES(GetMapIgnoredInPrimitives, production, must, "EV-GETMAP-ERR-BEGINEND",
              "GetMapiv of ORDER in a primitive does nothing and raises nothing",
              skip(GetMapiv, kInside&& kQuery == GL_ORDER));
EVALCTS_RULES(GetMapInPrimitiveIsInvalidEnum, production, must, "EV-GETMAP-ERR-BEGINEND",
              "GetMapdv in a primitive raises INVALID_ENUM", before(GetMapdv, kInside, set(kTarget, 0)));
EVALCTS_RULES(BadQueryClearsFirstValue, production, must, "EV-GETMAP-ERR-NOWRITE",
              "GetMapfv with a bad query writes a zero",
              after(GetMapfv, is_map(kTarget) && is_bad_query(), put(0, 0)));
EVALCTS_RULES(GetMapWritesInPrimitives, production, must, "EV-GETMAP-ERR-NOWRITE",
              "GetMapiv in a primitive raises its error, but the domain is written",
              after(GetMapiv, kInside&& kQuery == GL_DOMAIN, sequence({put(0, 0), put(1, 1)})));
EVALCTS_RULES(GetMapOfTexturesNeedsUnit0, production, must, "EV-GETMAP-NOUNIT",
              "GetMapfv of a texture map with unit 1 active raises INVALID_OPERATION",
              instead(GetMapfv, kUnit != GL_TEXTURE0 && is_texture_map(kTarget),
                      error(GL_INVALID_OPERATION)));
EVALCTS_RULES(Unit1AnswersInitialMaps, production, must, "EV-GETMAP-NOUNIT",
              "with unit 1 active GetMapiv answers the order of a map that was never defined",
              after(GetMapiv, kUnit != GL_TEXTURE0 && kQuery == GL_ORDER && is_map(kTarget), put(0, 1)));
EVALCTS_RULES(PackBufferTakesAnswer, osmesa, must, "EV-GETMAP-NOPBO",
              "with a PIXEL_PACK_BUFFER bound GetMapfv writes COEFF into it",
              skip(GetMapfv, has_buffer(GL_PIXEL_PACK_BUFFER) && kQuery == GL_COEFF));
EVALCTS_RULES(PackBufferRefusesDoubles, osmesa, must, "EV-GETMAP-NOPBO",
              "with a PIXEL_PACK_BUFFER bound GetMapdv raises INVALID_OPERATION as well",
              after(GetMapdv, has_buffer(GL_PIXEL_PACK_BUFFER), call(Enable, {0})));

EVALCTS_FAULT(IntegerQueryRoundsTheMap, production, must, "EV-GETMAP-NOSIDE/1-D",
              "GetMapiv of COEFF leaves the points rounded") {
  in.gl.GetMapiv = [](GLenum target, GLenum query, GLint* v) {
    sound.GetMapiv(target, query, v);
    if (query != GL_COEFF || !is_map1(target)) return;
    std::vector<GLdouble> points = coefficients(target);
    GLdouble domain[2];
    sound.GetMapdv(target, GL_DOMAIN, domain);
    for (GLdouble& value : points) value = std::round(value);
    const GLint k = gl::components_of(target);
    sound.Map1d(target, domain[0], domain[1], k, static_cast<GLint>(points.size()) / k, points.data());
  };
}

EVALCTS_RULES(QueryOfOrderEnables, production, must, "EV-GETMAP-NOSIDE/2-D",
              "GetMapdv of ORDER enables the two-dimensional map",
              after(GetMapdv, kQuery == GL_ORDER && is_map2(kTarget), call(Enable, {kTarget})));

// ---- Get

EVALCTS_FAULT(IntegerGridTruncated, production, must, "EV-GET-GRIDDOMAIN",
              "GetIntegerv truncates the ends of grids") {
  in.gl.GetIntegerv = [](GLenum pname, GLint* v) {
    sound.GetIntegerv(pname, v);
    if (pname != GL_MAP1_GRID_DOMAIN && pname != GL_MAP2_GRID_DOMAIN) return;
    GLdouble ends[4];
    sound.GetDoublev(pname, ends);
    for (int i = 0; i < (pname == GL_MAP1_GRID_DOMAIN ? 2 : 4); ++i)
      if (std::abs(ends[i]) < 1e9) v[i] = static_cast<GLint>(ends[i]);
  };
}

EVALCTS_FAULT(BooleanGridRoundedFirst, production, must, "EV-GET-GRIDDOMAIN",
              "GetBooleanv of an end between -0.5 and 0.5 gives FALSE") {
  in.gl.GetBooleanv = [](GLenum pname, GLboolean* v) {
    sound.GetBooleanv(pname, v);
    if (pname != GL_MAP1_GRID_DOMAIN && pname != GL_MAP2_GRID_DOMAIN) return;
    GLdouble ends[4];
    sound.GetDoublev(pname, ends);
    for (int i = 0; i < (pname == GL_MAP1_GRID_DOMAIN ? 2 : 4); ++i)
      if (std::abs(ends[i]) < 0.5) v[i] = GL_FALSE;
  };
}

EVALCTS_FAULT(NegativeGridEndsAreFalse, production, must, "EV-GET-GRIDDOMAIN",
              "GetBooleanv of a negative end gives FALSE") {
  in.gl.GetBooleanv = [](GLenum pname, GLboolean* v) {
    sound.GetBooleanv(pname, v);
    if (pname != GL_MAP1_GRID_DOMAIN && pname != GL_MAP2_GRID_DOMAIN) return;
    GLdouble ends[4];
    sound.GetDoublev(pname, ends);
    for (int i = 0; i < (pname == GL_MAP1_GRID_DOMAIN ? 2 : 4); ++i)
      if (ends[i] < 0) v[i] = GL_FALSE;
  };
}

EVALCTS_FAULT(SegmentsOfVNotInFloats, production, must, "EV-GET-GRIDSEG",
              "GetFloatv of MAP2_GRID_SEGMENTS writes un only") {
  in.gl.GetFloatv = [](GLenum pname, GLfloat* v) {
    if (pname != GL_MAP2_GRID_SEGMENTS) return sound.GetFloatv(pname, v);
    GLfloat both[2];
    sound.GetFloatv(pname, both);
    v[0] = both[0];
  };
}

EVALCTS_RULES(SegmentsTruncatedInBoolean, production, must, "EV-GET-GRIDSEG",
              "GetBooleanv gives the lowest byte of the number of segments",
              after(GetBooleanv, kName == GL_MAP1_GRID_SEGMENTS, put(0, state(kName) & 255)));

EVALCTS_FAULT(SegmentsOf256AreFalse, production, must, "EV-GET-GRIDSEG",
              "GetBooleanv of a number of segments whose lowest byte is 0 gives FALSE") {
  in.gl.GetBooleanv = [](GLenum pname, GLboolean* v) {
    sound.GetBooleanv(pname, v);
    if (pname != GL_MAP1_GRID_SEGMENTS && pname != GL_MAP2_GRID_SEGMENTS) return;
    GLint n[2] = {1, 1};
    sound.GetIntegerv(pname, n);
    for (int i = 0; i < (pname == GL_MAP1_GRID_SEGMENTS ? 1 : 2); ++i)
      if ((n[i] & 255) == 0) v[i] = GL_FALSE;
  };
}

EVALCTS_RULES(SegmentsOfSurfaceExchanged, production, must, "EV-GET-GRIDSEG", "GetDoublev answers vn, un",
              after(GetDoublev, kName == GL_MAP2_GRID_SEGMENTS, exchange(0, 1)));
EVALCTS_RULES(MaxOrderInFloatsIsMinimum, production, must, "EV-GET-MAXORDER",
              "GetFloatv of MAX_EVAL_ORDER gives 8, which the specification demands",
              after(GetFloatv, kName == GL_MAX_EVAL_ORDER, put(0, 8)));
EVALCTS_RULES(MaxOrderShrinksWithUse, production, must, "EV-GET-MAXORDER",
              "MAX_EVAL_ORDER is one less once a map of the largest order was defined",
              before(kMap1, kOrder == kMaxOrder, set(kFlag, 1)),
              after(GetDoublev, kName == GL_MAX_EVAL_ORDER && kFlag, put(0, element(0) - 1)));
EVALCTS_RULES(MaxOrderAsBoolean, production, must, "EV-GET-MAXORDER",
              "GetBooleanv of MAX_EVAL_ORDER gives 64",
              after(GetBooleanv, kName == GL_MAX_EVAL_ORDER, put(0, 64)));
EVALCTS_RULES(GetOfLimitAllowedInPrimitives, production, must, "EV-GET-ERR-BEGINEND",
              "GetIntegerv of MAX_EVAL_ORDER, a constant, answers in primitives",
              instead(GetIntegerv, kInside&& kName == GL_MAX_EVAL_ORDER, put(0, kMaxOrder)));
EVALCTS_RULES(GetOfGridWritesInPrimitives, production, must, "EV-GET-ERR-BEGINEND",
              "GetDoublev of MAP2_GRID_DOMAIN in a primitive raises its error and writes",
              after(GetDoublev, kInside&& kName == GL_MAP2_GRID_DOMAIN, put(0, 0)));
EVALCTS_RULES(GetOfFlagSilentInPrimitives, production, must, "EV-GET-ERR-BEGINEND",
              "GetFloatv of AUTO_NORMAL in a primitive does nothing and raises nothing",
              skip(GetFloatv, kInside&& kName == GL_AUTO_NORMAL));

// ---- GetnMap

EVALCTS_FAULT(GetnMapExchangesOrders, production, must, "EV-GETN-SAME",
              "GetnMapiv answers vorder before uorder") {
  in.gl.GetnMapiv = [](GLenum target, GLenum query, GLsizei size, GLint* v) {
    GLint before[] = {v[0], 0};
    sound.GetnMapiv(target, query, size, v);
    if (query == GL_ORDER && is_map2(target) && v[0] != before[0] && size >= 8) std::swap(v[0], v[1]);
  };
}

EVALCTS_FAULT(GetnMapInFixedPoint, production, must, "EV-GETN-SAME",
              "GetnMapdv answers points rounded to 10 bits behind the point") {
  in.gl.GetnMapdv = [](GLenum target, GLenum query, GLsizei size, GLdouble* v) {
    sound.GetnMapdv(target, query, size, v);
    if (query != GL_COEFF || !is_map2(target)) return;
    const std::size_t count = coefficients(target).size();
    if (static_cast<std::size_t>(size) < 8 * count) return;
    for (std::size_t i = 0; i < count; ++i) v[i] = std::round(v[i] * 1024) / 1024;
  };
}

EVALCTS_RULES(GetnMapNeedsOneByteMore, production, must, "EV-GETN-BYTES",
              "GetnMapfv refuses the exact size: < instead of <=",
              before(GetnMapfv, kSize > 0, set(kSize, kSize - 1)));
EVALCTS_RULES(GetnMapCountsValues, production, must, "EV-GETN-SMALL",
              "GetnMapiv takes the size for a number of values",
              before(GetnMapiv, kSize > 0 && kSize < 10000, set(kSize, 4 * kSize)));
EVALCTS_RULES(GetnMapCountsFloats, production, must, "EV-GETN-SMALL",
              "GetnMapdv holds the size against four bytes a value",
              before(GetnMapdv, kSize > 0 && kSize < 10000, set(kSize, 2 * kSize)));
EVALCTS_RULES(GetnMapOrderNeedsDomain, production, must, "EV-GETN-BYTES",
              "GetnMapdv wants room for four values for the order of a two-dimensional map",
              before(GetnMapdv, kQuery == GL_ORDER && is_map2(kTarget) && kSize < 32, set(kSize, 0)));

EVALCTS_FAULT(GetnMapWritesWhatFits, production, must, "EV-GETN-SMALL",
              "GetnMapfv that is refused for its size has written what there is room for") {
  in.gl.GetnMapfv = [](GLenum target, GLenum query, GLsizei size, GLfloat* v) {
    sound.GetnMapfv(target, query, size, v);
    if (query != GL_COEFF || !is_map(target)) return;
    const std::vector<GLdouble> points = coefficients(target);
    for (std::size_t i = 0; i < points.size() && static_cast<GLsizei>(4 * i + 4) <= size; ++i)
      v[i] = static_cast<GLfloat>(points[i]);
  };
}

EVALCTS_RULES(GetnMapRoundsSizeUp, production, must, "EV-GETN-SMALL",
              "GetnMapiv rounds the size up to whole values",
              before(GetnMapiv, kSize > 0, set(kSize, kSize + (4 - kSize % 4) % 4)));
EVALCTS_RULES(NegativeSizeIsUnlimited, production, must, "EV-GETN-NEGATIVE",
              "GetnMapfv takes a negative size for a very large one",
              before(GetnMapfv, kSize < 0, set(kSize, 1 << 20)));
EVALCTS_RULES(NegativeSizeIgnored, production, must, "EV-GETN-NEGATIVE",
              "GetnMapdv of a negative size writes nothing and raises nothing", skip(GetnMapdv, kSize < 0));
EVALCTS_RULES(NegativeSizeIsInvalidEnum, production, must, "EV-GETN-NEGATIVE",
              "GetnMapiv of a negative size raises INVALID_ENUM",
              before(GetnMapiv, kSize < 0, sequence({set(kTarget, 0), set(kSize, 0)})));
EVALCTS_RULES(GetnMapInPrimitiveIsInvalidValue, production, must, "EV-GETN-ERRORS",
              "GetnMapfv in a primitive raises INVALID_VALUE", before(GetnMapfv, kInside, set(kSize, -1)));
EVALCTS_RULES(GetnMapIgnoresBadTarget, production, must, "EV-GETN-ERRORS",
              "GetnMapdv of AUTO_NORMAL does nothing and raises nothing",
              skip(GetnMapdv, kTarget == GL_AUTO_NORMAL));
EVALCTS_RULES(GetnMapBadQueryIsSizeError, production, must, "EV-GETN-ERRORS",
              "GetnMapiv of a bad query raises INVALID_OPERATION, as no size is enough",
              instead(GetnMapiv, is_map(kTarget) && is_bad_query(), error(GL_INVALID_OPERATION)));

// ---- What only certain values or a certain past show

EVALCTS_RULES(ErrorForgottenByQuery, production, must, "EV-GETMAP-NOSIDE",
              "GetMapdv clears the error that waits", before(GetMapdv, true, call(GetError)));
EVALCTS_RULES(IntegerPointsOneTooMany, production, must, "EV-GETMAP-COUNT",
              "GetMapiv of COEFF writes one value too many",
              after(GetMapiv, kQuery == GL_COEFF && is_map(kTarget), put(lambda(count_coefficients), 0)));

EVALCTS_FAULT(JustBeyondIntWraps, production, must, "EV-GETMAP-SATURATE",
              "GetMapiv goes through 64 bits: what 2^32 holds wraps, only what is beyond saturates") {
  convert_integers(in, [](double value, GLint right, GLenum) {
    return std::abs(value) < 0x1p32 ? static_cast<GLint>(static_cast<long long>(std::round(value))) : right;
  });
}

EVALCTS_FAULT(IntegerDomainWraps, production, must, "EV-GETMAP-SATURATE",
              "GetMapiv saturates points but not the ends of domains") {
  convert_integers(in, [](double value, GLint right, GLenum query) {
    return query == GL_DOMAIN && std::abs(value) > 0x1p31 ? std::numeric_limits<GLint>::min() : right;
  });
}

EVALCTS_RULES(DomainAnsweredThroughWidth, production, quality, "EV-GETMAP-FLOAT",
              "GetMapfv answers u2 as u1 + (u2 - u1), in floats",
              after(GetMapfv, kQuery == GL_DOMAIN && is_map(kTarget), lambda([](Call& c) {
                      auto* v = static_cast<GLfloat*>(c.pointer);
                      return double{v[1] = v[0] + (v[1] - v[0])};
                    })));
EVALCTS_RULES(UndefinedPointNotAnswered, production, must, "EV-GETMAP-DISABLED",
              "GetMapfv writes no points of a map that was never defined, and raises nothing",
              before(kMaps, true, set(remembered(kTarget), 1)),
              skip(GetMapfv, kQuery == GL_COEFF && is_map(kTarget) && !remembered(kTarget)));
EVALCTS_RULES(GetMapSilentInPolygons, production, must, "EV-GETMAP-ERR-BEGINEND EV-GETN-ERRORS",
              "GetMapfv and GetnMapfv in a POLYGON do nothing and raise nothing",
              skip(GetMapfv | GetnMapfv, kOpenMode == GL_POLYGON));
EVALCTS_RULES(GetSilentInTriangles, production, must, "EV-GET-ERR-BEGINEND",
              "GetIntegerv of the number of segments in TRIANGLES does nothing and raises nothing",
              skip(GetIntegerv, kOpenMode == GL_TRIANGLES));
EVALCTS_RULES(GetMapRefusedOnLastUnit, production, must, "EV-GETMAP-NOUNIT",
              "GetMapdv raises INVALID_OPERATION on units above 1, which have no evaluators",
              instead(GetMapdv, kUnit > GL_TEXTURE1 && is_map(kTarget), error(GL_INVALID_OPERATION)));
EVALCTS_RULES(HugeSizeOverflows, production, must, "EV-GETN-SAME",
              "GetnMapdv with the largest size, rounded up, counts as negative",
              before(GetnMapdv, kSize > std::numeric_limits<GLsizei>::max() - 8, set(kSize, -1)));
EVALCTS_RULES(GetnMapOfNetSilentInPrimitives, production, must, "EV-GETN-ERRORS",
              "GetnMapfv of a two-dimensional map in a primitive does nothing and raises nothing",
              skip(GetnMapfv, kInside&& is_map2(kTarget)));

EVALCTS_FAULT(LargestSquareNetUFastest, production, must, "EV-GETMAP-COEFF2-SQUARE",
              "COEFF of the largest net has u fastest") {
  answer_transposed(in, [](GLint u, GLint v) { return u == kMaxOrder && v == kMaxOrder; });
}

EVALCTS_RULES(GetMapTargetInSixteenBits, production, must, "EV-GETMAP-ERR-TARGET EV-GETN-ERRORS",
              "only the low 16 bits of a target are looked at",
              before(kGetMap | kGetnMap, is_map(kTarget & 0xFFFF), set(kTarget, kTarget & 0xFFFF)));
EVALCTS_RULES(QueryInOneByte, production, must, "EV-GETMAP-ERR-QUERY EV-GETN-ERRORS",
              "only the low byte of a query is looked at",
              before(kGetMap | kGetnMap, kQuery > 0xFF && (kQuery & 0xFF) < 3,
                     set(kQuery, GL_COEFF + (kQuery & 0xFF))));
EVALCTS_RULES(GapBeyondVertex4Answered2, production, must, "EV-GETMAP-ERR-NOWRITE",
              "GetMapdv of 0x0DB9 to 0x0DBF raises its error and writes a zero",
              after(GetMapdv, kTarget > GL_MAP2_VERTEX_4 && kTarget < GL_MAP2_VERTEX_4 + 8, put(0, 0)));

}  // namespace
}  // namespace evalcts::faults
